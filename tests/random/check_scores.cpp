#include "tests/random/check_scores.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/transport/readout.hpp"

namespace luxodus::test {

namespace {

/// Bound for the deviation of the roulette's balance per event: it ends a weight w or raises it to
/// q, and the variance w (q - w) is at most q^2 / 4.
constexpr double roulette_deviation = 0x1p29;
/// In a million scenes with one balance each, the chance of a false report is 3e-6.
constexpr double standard_errors = 7;
/// Number of bins of a block that are read; in larger blocks, evenly chosen.
constexpr uint32_t bins_read = 256;

/// Scores of one block of a batch.
class BlockScores {
 public:
  BlockScores(const CompiledScene& scene, const BatchScores& batch, uint32_t block)
      : layout_(scene.layout), block_(block), scores_(batch.scores.data()) {}

  const TallyBlock& block() const { return layout_.block(block_); }
  int bands() const { return block().banded ? layout_.bands() : 1; }
  int64_t at(uint32_t bin, int band, uint32_t quantity) const {
    return scores_[layout_.score_index(block_, bin, band, quantity)];
  }
  Int128 sum(uint32_t quantity) const {
    Int128 sum = 0;
    for (uint32_t bin = 0; bin < block().bins; ++bin)
      for (int band = 0; band < bands(); ++band) sum += at(bin, band, quantity);
    return sum;
  }

 private:
  const TallyLayout& layout_;
  const uint32_t block_;
  const int64_t* scores_;
};

std::string place_in(const TallyBlock& block, uint32_t bin, int band, uint32_t quantity) {
  return block.name + " " + std::to_string(bin) + ", band " + std::to_string(band) + ", quantity " +
         std::to_string(quantity);
}

/// Only components of a current may be negative, and what arrives from the surround of a sign,
/// since an obstacle before it hides a part of the veil.
bool may_be_negative(const TallyBlock& block, uint32_t quantity) {
  if (block.name == "views") return quantity == static_cast<uint32_t>(EyeQuantity::reflected);
  if (block.name == "views_by_group")
    return quantity == static_cast<uint32_t>(GroupEyeQuantity::reflected);
  // Fluences, and mean squares of the direction's components, are sums of non-negative terms.
  return block.name == "voxels" && quantity != 0 && quantity != first_scattered_quantity &&
         quantity != first_scattered_quantity + 4 && quantity != first_scattered_quantity + 5;
}

void check_signs(const BlockScores& scores, Findings& findings) {
  const TallyBlock& block = scores.block();
  for (uint32_t bin = 0; bin < block.bins; ++bin) {
    for (int band = 0; band < scores.bands(); ++band) {
      for (uint32_t q = 0; q < block.quantities; ++q) {
        const int64_t score = scores.at(bin, band, q);
        if (score >= 0 || may_be_negative(block, q)) continue;
        // A probe next to a light may receive more than is counted, which is an error of the run.
        if (block.unit == ScoreUnit::value && score == limits::out_of_range) continue;
        const bool nothing = score == std::numeric_limits<int64_t>::min();
        findings.push_back((nothing ? "not a number: " : "negative: ") +
                           place_in(block, bin, band, q) + ": " + std::to_string(score));
        return;
      }
    }
  }
}

/// A current and a product of components is at most its fluence, and scattered light at most all
/// light, up to the rounding of each piece of flight.
void check_currents(const BlockScores& voxels, uint64_t pieces, Findings& findings) {
  for (uint32_t bin = 0; bin < voxels.block().bins; ++bin) {
    for (int band = 0; band < voxels.bands(); ++band) {
      for (uint32_t q = 1; q < voxel_quantities; ++q) {
        const uint32_t of = q <= first_scattered_quantity ? 0 : first_scattered_quantity;
        const auto fluence = static_cast<double>(voxels.at(bin, band, of));
        const double most = fluence * (1 + 1e-5) + static_cast<double>(pieces);
        if (std::abs(static_cast<double>(voxels.at(bin, band, q))) <= most) continue;
        findings.push_back("a current above its fluence: " +
                           place_in(voxels.block(), bin, band, q));
        return;
      }
    }
  }
}

void check_equal(const std::string& what, Int128 counted, Int128 balance, Findings& findings) {
  if (counted != balance)
    findings.push_back(what + " in bins and in the ledger differ by " +
                       std::to_string(static_cast<double>(counted - balance) * 0x1p-32) +
                       " particles");
}

void check_finite(const Estimate& e, double least, const std::string& what, Findings& findings) {
  if (!std::isfinite(e.value) || !(e.value >= least))
    findings.push_back(what + " reads " + std::to_string(e.value));
  if (!std::isfinite(e.standard_error) || e.standard_error < 0)
    findings.push_back(what + " has the error " + std::to_string(e.standard_error));
}

}  // namespace

void check_ledger(const CompiledScene& scene, const EnergyBalance& l, const Expected& expected,
                  Findings& findings) {
  if (!l.closes()) findings.push_back("the ledger does not close");
  if (l.emitted != static_cast<Int128>(l.particles) * unit_weight)
    findings.push_back("other than whole particles were emitted");
  for (const Int128 part : {l.roulette_gain, l.absorbed_surfaces, l.absorbed_media, l.escaped,
                            l.roulette_loss, l.lost_too_long}) {
    if (part < 0) findings.push_back("a negative entry of the ledger");
  }
  if (l.lost() > 0 && !expected.patient)
    findings.push_back("a history without end where each event takes some of it");
  if (l.escaped > 0 && expected.closed)
    findings.push_back(std::to_string(static_cast<double>(l.escaped) * 0x1p-32) + " of " +
                       std::to_string(l.particles) + " particles left a closed room");
  if (l.absorbed_media > 0 && scene.features.media == MediaNeed::none)
    findings.push_back("media absorb where there are none");
  const auto balance = static_cast<double>(l.roulette_gain - l.roulette_loss);
  const auto events = static_cast<double>(l.hits + l.collisions);
  if (std::abs(balance) > standard_errors * roulette_deviation * (std::sqrt(events) + 1))
    findings.push_back("the roulette gave or took " + std::to_string(balance * 0x1p-32) +
                       " particles in " + std::to_string(l.hits + l.collisions) + " events");
}

void check_batch(const CompiledScene& scene, const BatchScores& batch, Findings& findings) {
  const TallyBlocks& blocks = scene.blocks;
  const auto block = [&](uint32_t b) { return BlockScores(scene, batch, b); };
  for (uint32_t b = 0; b < scene.layout.blocks().size(); ++b) check_signs(block(b), findings);
  const EnergyBalance& balance = batch.balance;
  const BlockScores patches = block(blocks.patches);
  check_equal("what surfaces absorb", patches.sum(0) - patches.sum(1), balance.absorbed_surfaces,
              findings);
  check_equal("what escapes", block(blocks.escape).sum(0), balance.escaped, findings);
  if (blocks.media_power != none_index)
    check_equal("what media absorb", block(blocks.media_power).sum(0), balance.absorbed_media,
                findings);
  if (blocks.voxels != none_index) {
    check_currents(block(blocks.voxels), balance.rays * 64, findings);
    if (block(blocks.voxel_power).sum(0) > balance.absorbed_media)
      findings.push_back("voxels absorb more than the media in them");
  }
}

void check_readout(const CompiledScene& scene, const Totals& totals, Findings& findings) {
  const Readout read(scene, totals);
  const bool out_of_range = !read.check_range().ok();
  const size_t before = findings.size();
  for (uint32_t b = 0; b < scene.layout.blocks().size(); ++b) {
    const TallyBlock& block = scene.layout.block(b);
    const uint32_t step = std::max(1u, block.bins / bins_read);
    for (uint32_t bin = 0; bin < block.bins; bin += step) {
      for (uint32_t q = 0; q < block.quantities; ++q) {
        if (findings.size() > before) return;
        const double least = may_be_negative(block, q) ? -1e300 : 0;
        const std::string where = block.name + " " + std::to_string(bin);
        if (block.unit == ScoreUnit::value) {
          // Beyond the range of values, which is an error of the run.
          if (out_of_range && std::isinf(read.value(b, bin, q).value)) continue;
          check_finite(read.value(b, bin, q), least, where, findings);
          continue;
        }
        check_finite(read.lumens(b, bin, q), least, where + " [lm]", findings);
        for (int band = 0; band < scene.bands.count(); ++band)
          check_finite(read.watts(b, bin, band, q), least, where + " [W]", findings);
      }
    }
  }
  if (std::isnan(read.worst_relative_error())) findings.push_back("the worst error is no number");
}

void check_same(const Totals& totals, const Totals& again, const std::string& way,
                Findings& findings) {
  for (int g = 0; g < totals.groups(); ++g) {
    const auto& a = totals.state(g).totals;
    const auto& b = again.state(g).totals;
    for (size_t i = 0; i < a.size(); ++i) {
      if (a[i].sum == b[i].sum && a[i].squares == b[i].squares) continue;
      findings.push_back("other bits " + way + ": total " + std::to_string(i) + " of group " +
                         std::to_string(g));
      return;
    }
  }
}

}  // namespace luxodus::test

#include "scenes/transport/readout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenes/transport/look.hpp"

namespace luxodus {

namespace {

/// Watts that one particle of unit weight stands for, times the particles of a group.
double watts_per_share(const Group& group, size_t band) {
  const double share = group.band_share[band];
  return share > 0 ? group.power_w[band] / share : 0;
}

double largest_lumens_per_share(const CompiledScene& scene, const Group& group) {
  double most = 0;
  for (int b = 0; b < scene.bands.count(); ++b) {
    most = std::max(most, watts_per_share(group, static_cast<size_t>(b)) * scene.bands[b].lm_per_w);
  }
  return most;
}

/// NaN stands for fewer than two batches: not known, so not small.
double known_error(const Estimate& e) {
  const double error = e.relative_error();
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

}  // namespace

double Estimate::relative_error() const {
  if (value == 0) return standard_error == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(standard_error / value);
}

std::vector<std::vector<int64_t>> photopic_weights(const CompiledScene& scene) {
  std::vector<std::vector<int64_t>> out;
  for (const Group& group : scene.groups) {
    const double most = largest_lumens_per_share(scene, group);
    std::vector<int64_t> weights;
    for (int b = 0; b < scene.bands.count(); ++b) {
      const double lumens =
          watts_per_share(group, static_cast<size_t>(b)) * scene.bands[b].lm_per_w;
      weights.push_back(most > 0 ? std::llround(std::ldexp(lumens / most, Totals::photopic_shift))
                                 : 0);
    }
    out.push_back(std::move(weights));
  }
  return out;
}

double Readout::scale(int group, int channel, ScoreUnit unit) const {
  if (unit == ScoreUnit::value) return limits::value_quantum;
  const Group& g = scene_.groups[static_cast<size_t>(group)];
  const double per_particle = 1.0 / (static_cast<double>(scene_.batch_particles) * 0x1p32);
  const double length = unit == ScoreUnit::weight_length ? scene_.length_unit_m : 1;
  const double carried = channel < scene_.bands.count()
                             ? watts_per_share(g, static_cast<size_t>(channel))
                             : largest_lumens_per_share(scene_, g);
  return carried * per_particle * length;
}

Estimate Readout::sum_groups(uint32_t block, uint32_t bin, int channel, uint32_t quantity,
                             int group) const {
  const int64_t index = scene_.layout.total_index(block, bin, channel, quantity);
  const ScoreUnit unit = scene_.layout.block(block).unit;
  Estimate out;
  double variance = 0;
  const int first = group < 0 ? 0 : group, end = group < 0 ? totals_.groups() : group + 1;
  for (int g = first; g < end; ++g) {
    const BatchMean m = totals_.mean(g, index);
    const double k = scale(g, channel, unit);
    out.value += m.mean * k;
    variance += m.standard_error * m.standard_error * k * k;
  }
  out.standard_error = std::sqrt(variance);
  return out;
}

Estimate Readout::watts(uint32_t block, uint32_t bin, int band, uint32_t quantity,
                        int group) const {
  return sum_groups(block, bin, band, quantity, group);
}

Estimate Readout::lumens(uint32_t block, uint32_t bin, uint32_t quantity, int group) const {
  const int channel = scene_.layout.photopic_channel();
  const Estimate e = sum_groups(block, bin, channel, quantity, group);
  return scene_.bands.count() == 1 ? e * scene_.bands[0].lm_per_w : e;
}

Estimate Readout::value(uint32_t block, uint32_t bin, uint32_t quantity) const {
  // Values come with every batch, whatever its group: the groups' samples are pooled.
  const int64_t index = scene_.layout.total_index(block, bin, 0, quantity);
  const BatchMean m = totals_.pooled_mean(index);
  return {m.mean * limits::value_quantum, m.standard_error * limits::value_quantum};
}

std::vector<Readout::JudgedFlux> Readout::judged_planes() const {
  std::vector<JudgedFlux> fluxes;
  for (const uint32_t i : scene_.judged.planes)
    fluxes.push_back({scene_.blocks.planes, i, 1, lumens(scene_.blocks.planes, i, 0).value});
  return fluxes;
}

std::vector<Readout::JudgedFlux> Readout::judged_surfaces() const {
  std::vector<JudgedFlux> fluxes;
  if (!scene_.judged.surfaces) return fluxes;
  std::vector<double> in;
  for (uint32_t s = 0; s < scene_.surfaces.size(); ++s)
    in.push_back(lumens(scene_.blocks.surfaces, s, 0).value);
  const double total = std::accumulate(in.begin(), in.end(), 0.0);
  for (uint32_t s = 0; s < scene_.surfaces.size(); ++s)
    if (in[s] > 0.01 * total) fluxes.push_back({scene_.blocks.surfaces, s, 0});
  return fluxes;
}

std::vector<Readout::JudgedFlux> Readout::judged_patches() const {
  std::vector<JudgedFlux> fluxes;
  if (!scene_.judged.patches) return fluxes;
  for (uint32_t p = 0; p < scene_.patch_count; ++p) fluxes.push_back({scene_.blocks.patches, p, 0});
  return fluxes;
}

double Readout::worst_relative_error() const {
  const Judged& judged = scene_.judged;
  double worst = 0;
  bool asked = false;
  const auto judge = [&](const Estimate& e) {
    if (e.value <= 0) return;
    asked = true;
    worst = std::max(worst, known_error(e));
  };
  const auto judge_flux = [&](const JudgedFlux& f) {
    Estimate e = lumens(f.block, f.bin, f.quantity);
    e.value += f.sure_lm;
    judge(e);
  };
  for (const JudgedFlux& f : judged_planes()) judge_flux(f);
  for (const uint32_t i : judged.probes) judge(value(scene_.blocks.probes, i, 0));
  for (const uint32_t i : judged.targets) {
    const auto at_eye = static_cast<uint32_t>(EyeQuantity::at_eye);
    judge(value(scene_.blocks.views, scene_.eye_targets[i].first_bin, at_eye));
  }
  for (const JudgedFlux& f : judged_surfaces()) judge_flux(f);
  const std::optional<double> of_patches = patch_error();
  asked |= of_patches.has_value();
  worst = std::max(worst, of_patches.value_or(0));
  return asked ? worst : std::numeric_limits<double>::infinity();
}

std::optional<double> Readout::patch_error() const {
  constexpr double percentile = 0.95;
  std::vector<double> errors;
  for (const JudgedFlux& f : judged_patches()) {
    const Estimate in = lumens(f.block, f.bin, f.quantity);
    if (in.value > 0) errors.push_back(known_error(in));
  }
  if (errors.empty()) return std::nullopt;
  const auto at = static_cast<std::ptrdiff_t>(percentile * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + at, errors.end());
  return errors[static_cast<size_t>(at)];
}

}  // namespace luxodus

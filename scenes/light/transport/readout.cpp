#include "scenes/light/transport/readout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenes/light/transport/value_scores.hpp"

namespace luxodus {

namespace {

/// Watts that one particle of unit weight represents, times the particles of a group.
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

/// NaN (fewer than two batches) means unknown, so it must not count as small.
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
  // Every batch has value scores, whatever its group: the groups' samples are pooled.
  const int64_t index = scene_.layout.total_index(block, bin, 0, quantity);
  const BatchMean m = totals_.pooled_mean(index);
  return Estimate{m.mean, m.standard_error} * quantum_of(scene_, block, quantity);
}

std::vector<Readout::TargetFlux> Readout::target_planes() const {
  std::vector<TargetFlux> fluxes;
  for (const uint32_t i : scene_.error_target.planes)
    fluxes.push_back({scene_.blocks.planes, i, 1, lumens(scene_.blocks.planes, i, 0).value});
  return fluxes;
}

std::vector<Readout::TargetFlux> Readout::target_surfaces() const {
  std::vector<TargetFlux> fluxes;
  if (!scene_.error_target.surfaces) return fluxes;
  std::vector<double> in;
  for (uint32_t s = 0; s < scene_.surfaces.size(); ++s)
    in.push_back(lumens(scene_.blocks.surfaces, s, 0).value);
  const double total = std::accumulate(in.begin(), in.end(), 0.0);
  for (uint32_t s = 0; s < scene_.surfaces.size(); ++s)
    if (in[s] > 0.01 * total) fluxes.push_back({scene_.blocks.surfaces, s, 0});
  return fluxes;
}

std::vector<Readout::TargetFlux> Readout::target_patches() const {
  std::vector<TargetFlux> fluxes;
  if (!scene_.error_target.patches) return fluxes;
  for (uint32_t p = 0; p < scene_.patch_count; ++p) fluxes.push_back({scene_.blocks.patches, p, 0});
  return fluxes;
}

std::vector<Readout::TargetFlux> Readout::target_cells(uint32_t plane) const {
  std::vector<TargetFlux> fluxes;
  const CompiledPlane& p = scene_.planes[plane];
  const uint32_t cells = scene_.blocks.plane_cells;
  const auto end = p.first_bin + static_cast<uint32_t>(p.cells_u * p.cells_v);
  for (uint32_t c = p.first_bin; c < end; ++c)
    fluxes.push_back({cells, c, 1, lumens(cells, c, 0).value});
  return fluxes;
}

Estimate Readout::flux(const TargetFlux& judged) const {
  Estimate e = lumens(judged.block, judged.bin, judged.quantity);
  e.value += judged.sure_lm;
  return e;
}

std::vector<Readout::TargetValue> Readout::target_values() const {
  const SceneDescription& d = *scene_.description;
  std::vector<TargetValue> values;
  for (const TargetFlux& f : target_planes())
    values.push_back({"plane " + d.planes[f.bin].name, flux(f)});
  for (const uint32_t i : scene_.error_target.probes)
    values.push_back(
        {"indirect light at probe " + d.probes[i].name, value(scene_.blocks.probes, i, 0)});
  for (const uint32_t i : scene_.error_target.targets) {
    const EyeTarget& target = scene_.eye_targets[i];
    const auto at_eye = static_cast<uint32_t>(EyeQuantity::at_eye);
    values.push_back({"sign " + d.signs[scene_.signs[target.sign].sign].name + " from " +
                          d.observers[target.observer].name,
                      value(scene_.blocks.views, target.first_bin, at_eye)});
  }
  for (const TargetFlux& f : target_surfaces())
    values.push_back({"surface " + scene_.surfaces[f.bin].name, flux(f)});
  return values;
}

std::vector<Readout::TargetPercentile> Readout::target_percentiles() const {
  std::vector<TargetPercentile> many;
  for (const uint32_t i : scene_.error_target.cells)
    many.push_back({"cells of plane " + scene_.description->planes[i].name, target_cells(i)});
  if (scene_.error_target.patches) many.push_back({"patches", target_patches()});
  return many;
}

double Readout::worst_relative_error() const {
  std::optional<double> worst;
  const auto judge = [&](double error) { worst = std::max(worst.value_or(0), error); };
  for (const TargetValue& v : target_values()) {
    // One that is out of range gets no better, however long a run takes.
    if (v.value.value > 0) judge(std::isinf(v.value.value) ? 0 : known_error(v.value));
  }
  for (const TargetPercentile& many : target_percentiles()) {
    if (const auto error = percentile_error(many.fluxes)) judge(*error);
  }
  return worst.value_or(std::numeric_limits<double>::infinity());
}

bool Readout::is_beyond(uint32_t block, uint32_t bin) const {
  if (block == none_index) return false;
  for (uint32_t q = 0; q < scene_.layout.block(block).quantities; ++q)
    if (std::isinf(value(block, bin, q).value)) return true;
  return false;
}

Result<void> Readout::check_range() const {
  const SceneDescription& d = *scene_.description;
  const auto refused = [&](const std::string& what) {
    return problem_in(
        d.file, "the light at " + what +
                    " exceeds the largest value that is counted, which follows the flux of all "
                    "sources: lower the luminance of the source next to it, or move it away");
  };
  for (uint32_t p = 0; p < d.probes.size(); ++p)
    if (is_beyond(scene_.blocks.probes, p)) return refused("probe \"" + d.probes[p].name + "\"");
  constexpr uint32_t parts = 3;
  const auto mixtures = static_cast<uint32_t>(scene_.mixtures.size());
  for (const EyeTarget& target : scene_.eye_targets)
    for (uint32_t bin = target.first_bin; bin < target.first_bin + parts; ++bin) {
      bool beyond = is_beyond(scene_.blocks.views, bin);
      for (uint32_t m = 0; m < mixtures; ++m)
        beyond = beyond || is_beyond(scene_.blocks.views_by_mixture, bin * mixtures + m);
      if (beyond)
        return refused("sign \"" + d.signs[scene_.signs[target.sign].sign].name + "\" from \"" +
                       d.observers[target.observer].name + "\"");
    }
  return {};
}

std::vector<std::string> Readout::unlit() const {
  std::vector<std::string> names;
  for (const TargetValue& v : target_values()) {
    if (!(v.value.value > 0)) names.push_back(v.name);
  }
  for (const TargetPercentile& many : target_percentiles()) {
    const auto dark = std::count_if(many.fluxes.begin(), many.fluxes.end(),
                                    [&](const TargetFlux& f) { return !(flux(f).value > 0); });
    if (dark > 0) {
      names.push_back(std::to_string(dark) + " of " + std::to_string(many.fluxes.size()) + " " +
                      many.name);
    }
  }
  return names;
}

std::optional<double> Readout::percentile_error(const std::vector<TargetFlux>& fluxes) const {
  constexpr double percentile = 0.95;
  std::vector<double> errors;
  for (const TargetFlux& f : fluxes) {
    const Estimate in = flux(f);
    if (in.value > 0) errors.push_back(known_error(in));
  }
  if (errors.empty()) return std::nullopt;
  const auto at = static_cast<std::ptrdiff_t>(percentile * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + at, errors.end());
  return errors[static_cast<size_t>(at)];
}

}  // namespace luxodus

// Luminaires share a sheet where all that it states is equal. Its spacing table has the heights
// that data sheets have, and those at which the scene mounts it.
#include "actors/judge/assess/luminaire_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scenes/emergency/far_field.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/emergency/spacing.hpp"

namespace luxodus {

namespace {

/// Step of the drawn intensities: finer than most files.
constexpr double curve_step_deg = 2.5;
/// Heights of spacing tables as data sheets have them [m].
constexpr double usual_heights[] = {2.5, 3, 3.5, 4};
/// Rows of a table: the usual heights and as many mounting heights.
constexpr size_t max_heights = 8;
/// Heights of the scene are rounded to this, and a luminaire that hangs lower is not listed [m].
constexpr double height_step_m = 0.05, lowest_m = 1.5;
/// A luminaire hangs level if its axis is no further than this from straight down [deg].
constexpr double level_deg = 1;

bool has_curves(const Emitter& e) {
  return e.distribution != Distribution::spot && e.distribution != Distribution::collimated &&
         !e.radiometric;
}

/// Intensity [cd] per lumen in the luminaire's frame.
Intensity per_lm(const Emitter& e) {
  return [&e](const glm::dvec3& local) { return intensity_per_lm(e, e.frame.axes * local); };
}

/// Four digits, so that files stay small.
double drawn(double value) {
  return drawn_lux(value).lux;
}

SheetRecord sheet_of(const Emitter& e) {
  SheetRecord out{.maker = e.facts.maker,
                  .article = e.facts.article,
                  .battery = e.facts.battery,
                  .watts = {},
                  .duration_h = {},
                  .body_m = {},
                  .body_round = e.facts.body_round,
                  .curve_step_deg = curve_step_deg,
                  .c0_c180 = {},
                  .c90_c270 = {},
                  .spacing = {}};
  if (e.facts.watts > 0) out.watts = e.facts.watts;
  if (e.duration_s) out.duration_h = *e.duration_s / 3600;
  if (e.facts.body_m != glm::dvec3(0)) out.body_m = e.facts.body_m;
  out.c0_c180 = intensity_curve(e, 0, curve_step_deg);
  out.c90_c270 = intensity_curve(e, 90, curve_step_deg);
  return out;
}

bool hangs_level(const Emitter& e) {
  return -(e.frame.axes * glm::dvec3(0, 0, -1)).z >= std::cos(level_deg * std::numbers::pi / 180);
}

std::optional<RowSpacingRecord> record_of(const std::optional<RowSpacing>& spacing) {
  if (!spacing) return std::nullopt;
  return RowSpacingRecord{spacing->to_wall_m, spacing->between_m};
}

/// The table of new luminaires, where their flux is known, and at the end of life.
std::vector<SpacingRowRecord> spacing_of(const Emitter& e, const std::set<double>& mounted) {
  std::set<double> heights(std::begin(usual_heights), std::end(usual_heights));
  for (const double height : mounted)
    if (heights.size() < max_heights) heights.insert(height);
  const double new_lm = e.emergency_flux / e.emergency_ageing;
  SpacingRequest request{{heights.begin(), heights.end()},
                         {std::begin(usual_spacing_levels), std::end(usual_spacing_levels)},
                         {},
                         floor_plane_m};
  if (e.initial_flux_known) request.factors.push_back(1);
  if (e.emergency_ageing < 1 || request.factors.empty())
    request.factors.push_back(e.emergency_ageing);
  const Intensity of_new = [per = per_lm(e), new_lm](const glm::dvec3& d) {
    return per(d) * new_lm;
  };
  std::vector<SpacingRowRecord> out;
  for (const SpacingRow& row : spacing_table(of_new, request))
    out.push_back(
        {row.height_m, row.level_lx, row.factor, record_of(row.along), record_of(row.across)});
  return out;
}

/// Emergency luminaires of one sheet that hang level.
struct Mounted {
  const Emitter* one = nullptr;
  std::set<double> heights_m;
};

}  // namespace

std::vector<double> intensity_curve(const Emitter& e, double c_deg, double step_deg) {
  if (!has_curves(e)) return {};
  const Intensity intensity = per_lm(e);
  const double c = c_deg * std::numbers::pi / 180;
  const int half = static_cast<int>(180 / step_deg);
  std::vector<double> out;
  for (int i = -half; i <= half; ++i) {
    const double gamma = i * step_deg * std::numbers::pi / 180, sine = std::sin(gamma);
    const glm::dvec3 local(sine * std::cos(c), sine * std::sin(c), -std::cos(gamma));
    out.push_back(drawn(1000 * intensity(local)));
  }
  return out;
}

void add_sheets(const SceneDescription& scene, AssessmentRecord& record) {
  struct Key {
    SheetRecord sheet;
    double emergency_lm, ageing;
    bool operator==(const Key&) const = default;
  };
  std::vector<Key> keys;
  std::vector<Mounted> mounted;
  for (size_t i = 0; i < scene.emitters.size(); ++i) {
    const Emitter& e = scene.emitters[i];
    Key key{sheet_of(e), e.emergency_flux, e.emergency_ageing};
    const auto known = std::find(keys.begin(), keys.end(), key);
    const auto number = static_cast<size_t>(known - keys.begin());
    record.luminaires[i].sheet = number;
    if (known == keys.end()) {
      keys.push_back(std::move(key));
      mounted.emplace_back();
    }
    const bool is_spaced = e.emergency_flux > 0 && has_curves(e) && hangs_level(e);
    const auto floor = record.luminaires[i].floor_m;
    if (!is_spaced || !floor) continue;
    mounted[number].one = &e;
    const double height = centre_of(e).z - *floor;
    if (height >= lowest_m)
      mounted[number].heights_m.insert(std::round(height / height_step_m) * height_step_m);
  }
  for (size_t i = 0; i < keys.size(); ++i) {
    if (mounted[i].one) keys[i].sheet.spacing = spacing_of(*mounted[i].one, mounted[i].heights_m);
    record.sheets.push_back(std::move(keys[i].sheet));
  }
}

}  // namespace luxodus

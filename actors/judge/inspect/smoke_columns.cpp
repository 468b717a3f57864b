// Inspects smoke over the judged places, from floor to ceiling: smoke that is over none of them, on
// the floor under clear air, interrupted by a gap, or above all eyes.
#include <algorithm>
#include <array>

#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Spacing of places, and their largest number [m].
constexpr double column_spacing_m = 2;
constexpr size_t max_columns = 400;
/// Samples of a column, and the distance of its ends from floor and ceiling [m].
constexpr size_t column_steps = 48;
constexpr double from_ends_m = 0.01;
/// A ceiling is searched from above furniture [m].
constexpr double over_furniture_m = 1.9;
constexpr Real highest_ceiling_m = 200;
/// Lower extinctions count as clear air [1/m].
constexpr double clear_air = 1e-3;
/// Smoke rises: its lower half is denser than its upper half by this factor only in cooled layers.
constexpr double upside_down = 1.5;
constexpr double min_gap_m = 0.1;

/// A place of a person.
struct JudgedPlace {
  std::string of;  // route "corridor"
  SourcePlace place;
  glm::dvec3 foot{0};
};

std::vector<JudgedPlace> judged_feet(const SceneDescription& scene) {
  std::vector<JudgedPlace> all, out;
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : places_along(route, column_spacing_m))
      all.push_back({"route \"" + route.name + "\"", route.place, p});
  for (const AssessedArea& area : scene.open_areas)
    for (const glm::dvec3& p : places_within(area, 0.5, column_spacing_m))
      all.push_back({"open area \"" + area.name + "\"", area.place, p});
  const size_t step = all.size() / max_columns + 1;
  for (size_t i = 0; i < all.size(); i += step) out.push_back(all[i]);
  return out;
}

/// Extinctions from the floor up; none without a ceiling.
struct Column {
  bool any = false;
  double floor_m = 0, ceiling_m = 0;
  std::array<double, column_steps> sigma{};

  double height(size_t i) const {
    const double low = floor_m + from_ends_m, high = ceiling_m - from_ends_m;
    return low + (high - low) * static_cast<double>(i) / (column_steps - 1);
  }
  double step_m() const { return (ceiling_m - floor_m) / (column_steps - 1); }
  bool smoky(size_t i) const { return sigma[i] > clear_air; }
  bool smoky() const {
    return std::any_of(sigma.begin(), sigma.end(), [](double s) { return s > clear_air; });
  }
  double mean(size_t from, size_t to) const {
    double sum = 0;
    for (size_t i = from; i < to; ++i) sum += sigma[i];
    return sum / static_cast<double>(to - from);
  }
};

Column column_over(const Building& smoky, const GeometryAccess& access, const glm::dvec3& foot) {
  const CompiledScene& scene = smoky.scene();
  Column column;
  const glm::dvec3 start = foot + glm::dvec3(0, 0, over_furniture_m);
  const auto ceiling =
      first_stop(scene, access, smoky.local(start), Vec3(0, 0, 1), highest_ceiling_m,
                 [](const FacedSurface& f) { return lets_light_through(f.kind); });
  if (!ceiling) return column;
  column.any = true;
  column.floor_m = foot.z;
  column.ceiling_m = start.z + static_cast<double>(ceiling->distance_m);
  ResidentBricks bricks(scene.media);
  const auto& media = scene.description->media;
  const int band = scene.bands.count() / 2;
  for (size_t i = 0; i < column_steps; ++i) {
    const glm::dvec3 at(foot.x, foot.y, column.height(i));
    for_each_medium_at(scene.media, band, Vec3(at - scene.local_origin), bricks,
                       [&](int medium, int, double sigma, double) {
                         const Medium& m = media[static_cast<size_t>(medium)];
                         if (!m.emission || m.kind == MediumKind::data_set)
                           column.sigma[i] += sigma;
                       });
  }
  return column;
}

/// What is wrong with one column, the worst first.
struct ColumnFault {
  int rank = 0;  // severity of the fault; 0: none
  std::string text;
};

ColumnFault fault_of(const Column& c) {
  const size_t half = column_steps / 2;
  const double low = c.mean(0, half), high = c.mean(half, column_steps);
  if (low > upside_down * high + clear_air)
    return {3, fmt::format("is denser below than above: {:.3g} /m in the lower half of the room, "
                           "{:.3g} /m in the upper one, from z = {:.4g} to {:.4g} m. Smoke rises: "
                           "are its layers upside down, or does it end below the ceiling?",
                           low, high, c.floor_m, c.ceiling_m)};
  size_t top = column_steps;  // index above the highest smoke
  while (top > 0 && !c.smoky(top - 1)) --top;
  size_t bottom = 0;
  while (bottom < top && !c.smoky(bottom)) ++bottom;
  const size_t middle = bottom + (top - bottom) / 2;
  if (middle > bottom && c.mean(bottom, middle) > upside_down * c.mean(middle, top))
    return {3, fmt::format("is densest below: {:.3g} /m in its lower half, {:.3g} /m in its upper "
                           "one, between z = {:.3g} and {:.3g} m. Smoke is denser above: are its "
                           "layers upside down?",
                           c.mean(bottom, middle), c.mean(middle, top), c.height(bottom),
                           c.height(top - 1))};
  const double above_m = static_cast<double>(column_steps - top) * c.step_m();
  if (top < column_steps && above_m >= min_gap_m)
    return {2, fmt::format("ends at z = {:.3g} m and leaves clear air above it, up to the ceiling "
                           "at {:.4g} m: smoke gathers under the ceiling; is its z_high too low?",
                           c.height(top - 1), c.ceiling_m)};
  size_t gap = 0, longest = 0, at = 0;
  for (size_t i = bottom; i < top; ++i) {
    gap = c.smoky(i) ? 0 : gap + 1;
    if (gap > longest) {
      longest = gap;
      at = i;
    }
  }
  if (static_cast<double>(longest) * c.step_m() < min_gap_m) return {};
  return {1, fmt::format("leaves clear air between two layers, about z = {:.3g} m: do their z_low "
                         "and z_high meet?",
                         c.height(at - longest / 2))};
}

/// Whether all eyes there are in clear air below smoke.
bool eyes_below(const SceneDescription& scene, const Column& c) {
  const auto& heights = scene.assessment.eye_heights_m;
  const double highest = c.floor_m + *std::max_element(heights.begin(), heights.end());
  for (size_t i = 0; i < column_steps; ++i)
    if (c.smoky(i) && c.height(i) <= highest) return false;
  return c.smoky();
}

const Medium* first_smoke(const CompiledScene& scene) {
  for (const Medium& m : scene.description->media)
    if ((!m.emission || m.kind == MediumKind::data_set) && factor_of_medium(scene.scenario, m) > 0)
      return &m;
  return nullptr;
}

}  // namespace

void inspect_columns(const SceneDescription& scene, const Building& smoky, Findings& out) {
  const Medium* smoke = first_smoke(smoky.scene());
  const auto places = judged_feet(scene);
  if (smoke == nullptr || places.empty()) return;
  std::vector<Column> columns(places.size());
  smoky.each(places.size(), [&](const GeometryAccess& access, size_t i) {
    columns[i] = column_over(smoky, access, places[i].foot);
  });
  size_t with_ceiling = 0, in_smoke = 0, below = 0;
  ColumnFault worst;
  size_t where = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    if (!columns[i].any) continue;
    ++with_ceiling;
    if (!columns[i].smoky()) continue;
    ++in_smoke;
    below += eyes_below(scene, columns[i]) ? 1 : 0;
    ColumnFault fault = fault_of(columns[i]);
    if (fault.rank <= worst.rank) continue;
    worst = std::move(fault);
    where = i;
  }
  if (with_ceiling > 0 && in_smoke == 0)
    out.push_back({Severity::warning,
                   "smoke",
                   {smoke->place,
                    "the smoke of this state lies over no route and no open area: "
                    "people there are in clear air; are the places and heights of \"" +
                        smoke->name + "\" right?"}});
  if (worst.rank > 0)
    out.push_back({Severity::warning,
                   "smoke",
                   {smoke->place, "the smoke over " + places[where].of + ", at " +
                                      place_text(places[where].foot) + ", " + worst.text}});
  if (in_smoke > 0 && 2 * in_smoke < with_ceiling)
    out.push_back({Severity::note,
                   "smoke",
                   {smoke->place, fmt::format("the smoke of this state lies over {} of the {} "
                                              "places that were tried on routes and in open areas: "
                                              "people elsewhere are in clear air",
                                              in_smoke, with_ceiling)}});
  if (in_smoke > 0 && below == in_smoke)
    out.push_back({Severity::note,
                   "smoke",
                   {smoke->place,
                    "all eyes on routes and in open areas are below the smoke, in "
                    "clear air (eye_heights_m): a lower layer, or one that sinks, "
                    "gives other verdicts"}});
}

}  // namespace luxodus

// Mounting heights at which signs begin or end to be read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/inspect/building.hpp"
#include "actors/judge/thresholds/thresholds.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

/// Heights that are tried first, evenly from lowest to highest.
constexpr int first_heights = 5;
/// How often the middle between two heights on different sides of a limit is tried.
constexpr int halvings_of_height = 3;
/// Distance of a face's edge from floor and ceiling, and of rays from the face [m].
constexpr double clearance_m = 0.02, before_face_m = 0.05;
/// Height of a room without a ceiling [m].
constexpr double open_height_m = 10;
/// Tried heights of a sign nearer than this are one [m].
constexpr double same_height_m = 0.01;

/// Where a sign can hang.
struct Shaft {
  double floor_z = 0;
  double low = 0, high = 0;  // of the face's centre above the floor
  double now = 0;

  double at(int number) const { return low + (high - low) * number / (first_heights - 1); }
};

/// Distance to the first surface that light does not pass, from a place just before a face.
double free_way_m(const Building& building, const GeometryAccess& access, const Sign& sign,
                  const glm::vec3& direction, double otherwise_m) {
  const CompiledScene& scene = building.scene();
  const glm::dvec3 place = sign.frame.origin + before_face_m * sign.frame.axes[2];
  const auto stop = first_stop(scene, access, building.local(place), direction,
                               static_cast<float>(otherwise_m), [&](const FacedSurface& f) {
                                 return f.surface >= scene.description->objects.size() ||
                                        lets_light_through(f.kind);
                               });
  return stop ? static_cast<double>(stop->distance_m) : otherwise_m;
}

Result<std::vector<Shaft>> shafts_of(const ThresholdSearch& search) {
  const auto made = Building::make(search.scene, search.scenario, search.options.threads);
  if (!made) return made.problem();
  const Building& building = *made.value();
  std::vector<Shaft> out(search.scene.signs.size());
  building.each(out.size(), [&](const GeometryAccess& access, size_t i) {
    const Sign& sign = search.scene.signs[i];
    const double z = sign.frame.origin.z;
    const double down = free_way_m(building, access, sign, {0, 0, -1}, open_height_m);
    const double up = free_way_m(building, access, sign, {0, 0, 1}, open_height_m);
    Shaft& shaft = out[i];
    shaft.floor_z = floor_below(search.scene, sign.frame.origin).value_or(z - down);
    // The face's vertical half, also of a tilted one.
    const double half = (std::abs(sign.frame.axes[0].z) * sign.width_m +
                         std::abs(sign.frame.axes[1].z) * sign.height_m) /
                        2;
    shaft.now = z - shaft.floor_z;
    shaft.low = std::min(shaft.now, half + clearance_m);
    shaft.high = std::max(shaft.now, z + up - half - clearance_m - shaft.floor_z);
  });
  return out;
}

/// The levels of a view by the height of its sign.
struct ByHeight {
  const SightRow* row = nullptr;
  size_t sign = 0;
  std::vector<std::vector<LevelPoint>> reading, seeing;  // by eyes, heights ascending

  void add(double height, const std::vector<Sight>& sights) {
    const auto insert = [](std::vector<LevelPoint>& points, const LevelPoint& point) {
      const auto at = std::lower_bound(points.begin(), points.end(), point.at,
                                       [](const LevelPoint& p, double x) { return p.at < x; });
      if (at != points.end() && at->at == point.at)
        *at = point;
      else
        points.insert(at, point);
    };
    for (size_t e = 0; e < reading.size(); ++e) {
      const bool there = e < sights.size();
      insert(reading[e], there ? point_of(height, sights[e], true) : impossible_point(height));
      insert(seeing[e], there ? point_of(height, sights[e], false) : impossible_point(height));
    }
  }
  /// The places in the list of heights after which any limit is passed.
  std::set<size_t> passed_after() const {
    std::set<size_t> out;
    for (const auto* of_eyes : {&reading, &seeing})
      for (const auto& points : *of_eyes)
        for (size_t i = 0; i + 1 < points.size(); ++i)
          if (points[i].holds() != points[i + 1].holds()) out.insert(i);
    return out;
  }
};

using Views = std::map<ViewKey, ByHeight>;

/// Views by their places and signs, with the levels of the assessment.
Views views_now(const ThresholdSearch& search, const std::vector<Shaft>& shafts) {
  Views out;
  const size_t eyes = eyes_of(search.scene).size();
  for (const SightRow& row : search.assessed.sights) {
    const auto number =
        static_cast<size_t>(&sign_of(search.scene, row) - search.scene.signs.data());
    const std::vector<std::vector<LevelPoint>> none(eyes);
    ByHeight& view = out.emplace(key_of(row), ByHeight{&row, number, none, none}).first->second;
    view.add(shafts[number].now, sights_of(row));
  }
  return out;
}

/// Traces views with their signs at other heights above their floors. Errors: as assess_sights.
Result<void> trace_at(const ThresholdSearch& search, const std::vector<Shaft>& shafts,
                      const std::map<size_t, double>& heights, const std::set<ViewKey>& asked,
                      Views& views) {
  SceneDescription moved = search.scene;
  for (const auto& [sign, height] : heights)
    moved.signs[sign].frame.origin.z = shafts[sign].floor_z + height;
  AssessOptions options = looking_at(asked, search.options);
  options.executor = nullptr;  // nodes know the scene of the file only
  Assessment found;
  if (auto ok = assess_sights(moved, search.scenario, {}, options, search.interrupt,
                              search.progress, found);
      !ok)
    return ok;
  for (const ViewKey& key : asked) views.at(key).add(heights.at(views.at(key).sign), {});
  for (const SightRow& row : found.sights) {
    ByHeight& view = views.at(key_of(row));
    view.add(heights.at(view.sign), sights_of(row));
  }
  return {};
}

/// All views at a few heights. Errors: as assess_sights.
Result<void> trace_evenly(const ThresholdSearch& search, const std::vector<Shaft>& shafts,
                          Views& views) {
  for (int i = 0; i < first_heights; ++i) {
    std::map<size_t, double> heights;
    for (size_t sign = 0; sign < shafts.size(); ++sign)
      if (std::abs(shafts[sign].at(i) - shafts[sign].now) > same_height_m)
        heights[sign] = shafts[sign].at(i);
    std::set<ViewKey> asked;
    for (const auto& [key, view] : views)
      if (heights.contains(view.sign)) asked.insert(key);
    if (asked.empty()) continue;
    if (auto ok = trace_at(search, shafts, heights, asked, views); !ok) return ok;
  }
  return {};
}

/// The middle of each pair of heights between which a limit is passed. Errors: as assess_sights.
Result<void> trace_between(const ThresholdSearch& search, const std::vector<Shaft>& shafts,
                           Views& views) {
  // By the lower of the two heights: views of one sign share their heights.
  std::map<size_t, std::pair<std::map<size_t, double>, std::set<ViewKey>>> work;
  for (const auto& [key, view] : views)
    for (const size_t i : view.passed_after()) {
      const double low = view.reading.front()[i].at, high = view.reading.front()[i + 1].at;
      if (high - low < 2 * same_height_m) continue;
      work[i].first[view.sign] = (low + high) / 2;
      work[i].second.insert(key);
    }
  for (const auto& [number, one] : work)
    if (auto ok = trace_at(search, shafts, one.first, one.second, views); !ok) return ok;
  return {};
}

void add_records(const ByHeight& view, const std::string& eyes, size_t e, bool read,
                 ThresholdRows& out) {
  const std::vector<LevelPoint>& points = (read ? view.reading : view.seeing)[e];
  const auto found = crossings(points);
  ThresholdRecord blank = record_for(Sought::height, *view.row, eyes, read);
  const bool assessed =
      std::any_of(points.begin(), points.end(), [](const LevelPoint& p) { return p.possible; });
  if (assessed)
    blank.end = points.front().holds() ? ThresholdEnd::everywhere : ThresholdEnd::nowhere;
  if (found.empty()) out.push_back(blank);
  for (const Crossing& crossing : found) {
    ThresholdRecord& record = out.emplace_back(blank);
    record.end = ThresholdEnd::found;
    record.at = value_of(crossing);
    record.above = crossing.above;
  }
}

}  // namespace

Result<ThresholdRows> find_heights(const ThresholdSearch& search) {
  const auto shafts = shafts_of(search);
  if (!shafts) return shafts.problem();
  Views views = views_now(search, shafts.value());
  if (auto ok = trace_evenly(search, shafts.value(), views); !ok) return ok.problem();
  for (int i = 0; i < halvings_of_height; ++i)
    if (auto ok = trace_between(search, shafts.value(), views); !ok) return ok.problem();
  ThresholdRows out;
  const auto eyes = eyes_of(search.scene);
  for (const SightRow& row : search.assessed.sights)
    for (size_t e = 0; e < eyes.size(); ++e)
      for (const bool read : {true, false})
        add_records(views.at(key_of(row)), eyes[e], e, read, out);
  return out;
}

}  // namespace luxodus

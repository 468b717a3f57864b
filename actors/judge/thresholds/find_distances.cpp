// Distances along routes at which signs begin or end to be read.
#include <algorithm>
#include <map>

#include "actors/judge/thresholds/thresholds.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// The views of a sign from one route at one eye height, by place.
using Walk = std::map<double, const SightRow*>;

/// The points of a walk; places from which the sign is not faced are impossible ones.
std::vector<LevelPoint> points_along(const std::vector<Walker>& walkers, const Walk& walk,
                                     size_t eye, bool read) {
  std::vector<LevelPoint> out;
  for (const Walker& walker : walkers) {
    const auto at = walk.find(walker.along_m);
    const auto sights = at == walk.end() ? std::vector<Sight>{} : sights_of(*at->second);
    out.push_back(eye < sights.size() ? point_of(walker.along_m, sights[eye], read)
                                      : impossible_point(walker.along_m));
  }
  return out;
}

/// A record for each crossing; one that says so if there is none.
void add_crossings(const std::vector<LevelPoint>& points, const EscapeRoute& route,
                   const Sign& sign, const ThresholdRecord& blank, ThresholdRows& out) {
  const auto found = crossings(points);
  for (const Crossing& crossing : found) {
    ThresholdRecord& record = out.emplace_back(blank);
    record.end = ThresholdEnd::found;
    record.at = value_of(crossing);
    record.above = crossing.above;
    record.along_m = crossing.at.value;
    glm::dvec3 eye = place_along(route, crossing.at.value);
    eye.z += record.eye_height_m;
    record.amounts_to = {glm::length(sign.frame.origin - eye), "m"};
  }
  if (!found.empty()) return;
  ThresholdRecord& record = out.emplace_back(blank);
  record.along_m = 0;
  const bool assessed =
      std::any_of(points.begin(), points.end(), [](const LevelPoint& p) { return p.possible; });
  if (assessed)
    record.end = points.front().holds() ? ThresholdEnd::everywhere : ThresholdEnd::nowhere;
}

}  // namespace

ThresholdRows find_distances(const ThresholdSearch& search) {
  ThresholdRows out;
  const auto eyes = eyes_of(search.scene);
  for (const EscapeRoute& route : search.scene.routes) {
    const auto people = walkers(route, search.scene.assessment.spacing_m);
    std::map<std::pair<std::string, double>, Walk> walks;
    for (const SightRow& row : search.assessed.sights)
      if (row.from == subject_of(route)) walks[{row.sign, row.height_m}][row.along_m] = &row;
    for (const auto& [sign_and_height, walk] : walks) {
      const SightRow& any = *walk.begin()->second;
      for (size_t e = 0; e < eyes.size(); ++e)
        for (const bool read : {true, false})
          add_crossings(points_along(people, walk, e, read), route, sign_of(search.scene, any),
                        record_for(Sought::distance, any, eyes[e], read), out);
    }
  }
  return out;
}

}  // namespace luxodus

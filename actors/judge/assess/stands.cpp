#include "actors/judge/assess/stands.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/judge/texts/texts.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

/// Distance that people keep from the walls of an area [m].
constexpr double area_border_m = 0.3;

Stand standing(const Subject& from, const glm::dvec3& foot, double height_m) {
  Stand stand;
  stand.from = from;
  stand.height_m = height_m;
  stand.observer.eye = foot + glm::dvec3(0, 0, height_m);
  stand.observer.name = fmt::format("{} at ({:.2f}, {:.2f}), {:.2f} m high",
                                    english().subject(from), foot.x, foot.y, height_m);
  return stand;
}

void stand_on_routes(const SceneDescription& scene, std::vector<Stand>& out) {
  for (const EscapeRoute& route : scene.routes) {
    const auto people = walkers(route, scene.assessment.spacing_m);
    for (const Walker& walker : people)
      for (const double height : scene.assessment.eye_heights_m) {
        Stand stand = standing(subject_of(route), walker.foot, height);
        stand.along_m = walker.along_m;
        stand.stands_for = length_of(route) / static_cast<double>(people.size());
        stand.observer.gaze = walker.ahead;
        out.push_back(std::move(stand));
      }
  }
}

/// At the first eye height only: people who cross an area walk upright.
void stand_in_areas(const SceneDescription& scene, std::vector<Stand>& out) {
  for (const AssessedArea& area : scene.open_areas) {
    const auto places = within(area, area_border_m, scene.assessment.spacing_m);
    for (const glm::dvec3& place : places) {
      Stand stand = standing({SubjectKind::open_area, area.name}, place,
                             scene.assessment.eye_heights_m.front());
      stand.stands_for = std::abs(signed_area(area.outline)) / static_cast<double>(places.size());
      stand.looks_ahead = false;
      out.push_back(std::move(stand));
    }
  }
}

}  // namespace

std::vector<Stand> stands_of(const SceneDescription& scene,
                             const std::vector<Observer>& observers) {
  std::vector<Stand> out;
  stand_on_routes(scene, out);
  stand_in_areas(scene, out);
  for (const Observer& observer : observers) {
    Stand stand;
    stand.from = {SubjectKind::observer, observer.name};
    stand.height_m = observer.eye.z;
    stand.observer = observer;
    out.push_back(std::move(stand));
  }
  return out;
}

}  // namespace luxodus

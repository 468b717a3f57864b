#include "scenes/light/transport/near_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Less than this share of the largest intensity counts as no light.
constexpr double faint = 1e-3;

struct Luminaire {
  const Emitter* emitter;
  double opening_m;
};

double opening_of(const Emitter& e) {
  const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
  return largest(e.opening_m) > 0 ? largest(e.opening_m) : largest(e.size);
}

std::vector<Luminaire> lit_luminaires(const SceneDescription& scene, const Scenario& scenario) {
  std::vector<Luminaire> out;
  for (const ActiveSource& source : active_sources(scene, scenario)) {
    if (source.emitter == nullptr || !source.emitter->web) continue;
    const double opening = opening_of(*source.emitter);
    if (opening > 0) out.push_back({source.emitter, opening});
  }
  return out;
}

/// A flat place at the luminaire's own height gets no light from it, only past it.
bool sends_light(const Emitter& e, const glm::dvec3& to, bool flat) {
  constexpr double same_place_m = 1e-6;
  const glm::dvec3 way = to - e.frame.origin;
  if (glm::length(way) < same_place_m) return !flat;
  const glm::dvec3 local = glm::transpose(e.frame.axes) * glm::normalize(way);
  return e.web->intensity(local) > faint * e.web->peak_cd();
}

// ---- the point of a place that is nearest to another --------------------------------------------

glm::dvec3 nearest_on_segment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  const glm::dvec3 way = b - a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0, 1.0) : 0.0;
  return a + way * t;
}

/// The nearest point of a flat outline: the foot of the perpendicular if it is inside, else on an
/// edge.
glm::dvec3 nearest_in_outline(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal,
                              const glm::dvec3& p) {
  const glm::dvec3 foot = p - normal * glm::dot(normal, p - corners.front());
  bool inside = false;
  glm::dvec3 best = corners.front();
  const glm::dvec3 u = glm::normalize(corners[1] - corners[0]), v = glm::cross(normal, u);
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const glm::dvec3 on_edge = nearest_on_segment(corners[j], corners[i], p);
    if (glm::distance(on_edge, p) < glm::distance(best, p)) best = on_edge;
    const glm::dvec2 a(glm::dot(corners[j] - foot, u), glm::dot(corners[j] - foot, v));
    const glm::dvec2 b(glm::dot(corners[i] - foot, u), glm::dot(corners[i] - foot, v));
    if ((a.y > 0) != (b.y > 0) && a.x + (b.x - a.x) * a.y / (a.y - b.y) > 0) inside = !inside;
  }
  return inside ? foot : best;
}

glm::dvec3 nearest_in_plane(const PlaneMeasure& plane, const glm::dvec3& p) {
  const glm::dvec3 normal = glm::normalize(glm::cross(plane.edge_u, plane.edge_v));
  return nearest_in_outline(
      {plane.corner, plane.corner + plane.edge_u, plane.corner + plane.edge_u + plane.edge_v,
       plane.corner + plane.edge_v},
      normal, p);
}

glm::dvec3 nearest_in_area(const AssessedArea& area, const glm::dvec3& p) {
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& c : area.outline) corners.emplace_back(c, area.z_m);
  return nearest_in_outline(corners, {0, 0, 1}, p);
}

/// The nearest point on a strip of the route's width.
glm::dvec3 nearest_on_route(const EscapeRoute& route, const glm::dvec3& p) {
  glm::dvec3 best = route.path.front();
  for (size_t i = 0; i + 1 < route.path.size(); ++i) {
    glm::dvec3 place = nearest_on_segment(route.path[i], route.path[i + 1], p);
    const glm::dvec2 beside(p - place);
    const double away = glm::length(beside);
    if (away > 0) place += glm::dvec3(beside / away * std::min(away, route.width_m / 2), 0);
    if (glm::distance(place, p) < glm::distance(best, p)) best = place;
  }
  return best;
}

// ---- places -------------------------------------------------------------------------------------

std::string metres(double m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", m);
  return text;
}

class NearField {
 public:
  NearField(const SceneDescription& scene, const Scenario& scenario, const SeesPlace& sees)
      : luminaires_(lit_luminaires(scene, scenario)), sees_(sees) {}

  /// `nearest(p)`: the point of the place that is nearest to p.
  template <class Nearest>
  void look_at(const std::string& what, bool judged, const SourcePlace& place,
               const Nearest& nearest, bool flat = false) {
    const Luminaire* worst = nullptr;
    double worst_m = 0;
    size_t near = 0;
    for (const Luminaire& l : luminaires_) {
      const glm::dvec3& from = l.emitter->frame.origin;
      const glm::dvec3 to = nearest(from);
      const double distance = glm::distance(from, to);
      if (distance >= far_field_openings * l.opening_m || !sends_light(*l.emitter, to, flat))
        continue;
      if (sees_ && !sees_(*l.emitter, to)) continue;
      ++near;
      if (worst != nullptr && distance / l.opening_m >= worst_m / worst->opening_m) continue;
      worst = &l;
      worst_m = distance;
    }
    if (worst == nullptr) return;
    std::string text = what + " is " + metres(worst_m) + " from luminaire \"" +
                       worst->emitter->name + "\", nearer than five of its luminous openings (" +
                       metres(far_field_openings * worst->opening_m) +
                       "): there the intensities of a photometric file, measured from far away, "
                       "are uncertain; verify by measurement";
    if (near > 1)
      text += " (" + std::to_string(near - 1) + (near > 2 ? " other luminaires are" : " other is") +
              " as near)";
    places_.push_back({{place, std::move(text)}, judged});
  }

  std::vector<NearPlace> take() { return std::move(places_); }

 private:
  const std::vector<Luminaire> luminaires_;
  const SeesPlace& sees_;
  std::vector<NearPlace> places_;
};

bool is_looked_at(const SceneDescription& scene, uint32_t sign) {
  const bool people = !scene.routes.empty() || !scene.open_areas.empty();
  if (people && scene.signs[sign].lighting == SignLighting::external) return true;
  return std::any_of(scene.observers.begin(), scene.observers.end(), [&](const Observer& o) {
    return !o.signs || std::find(o.signs->begin(), o.signs->end(), sign) != o.signs->end();
  });
}

}  // namespace

std::vector<NearPlace> near_field_places(const SceneDescription& scene, const Scenario& scenario,
                                         const SeesPlace& sees) {
  NearField near(scene, scenario, sees);
  const bool judged = scenario.operation == Operation::emergency;
  const auto called = [](const char* kind, const std::string& name) {
    return std::string(kind) + " \"" + name + "\"";
  };
  for (const PlaneMeasure& plane : scene.planes)
    near.look_at(
        called("plane", plane.name), false, plane.place,
        [&](const glm::dvec3& p) { return nearest_in_plane(plane, p); }, true);
  for (const ProbeMeasure& probe : scene.probes)
    near.look_at(called("probe", probe.name), false, probe.place,
                 [&](const glm::dvec3&) { return probe.position; });
  for (const EscapeRoute& route : scene.routes)
    near.look_at(called("route", route.name), judged, route.place,
                 [&](const glm::dvec3& p) { return nearest_on_route(route, p); });
  for (const auto* areas : {&scene.open_areas, &scene.task_areas})
    for (const AssessedArea& area : *areas)
      near.look_at(
          called("area", area.name), judged, area.place,
          [&](const glm::dvec3& p) { return nearest_in_area(area, p); }, true);
  for (uint32_t i = 0; i < scene.signs.size(); ++i) {
    const Sign& sign = scene.signs[i];
    if (is_looked_at(scene, i))
      near.look_at(called("sign", sign.name), judged && sign.lighting == SignLighting::external,
                   sign.place, [&](const glm::dvec3&) { return sign.frame.origin; });
  }
  return near.take();
}

}  // namespace luxodus

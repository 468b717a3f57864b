// Inspects signs from where they should be read: faces seen edge-on from a route, signs in
// doorways.
#include <algorithm>
#include <cmath>

#include "actors/judge/inspect/doorway.hpp"
#include "actors/judge/inspect/ways_size.hpp"

namespace luxodus {

namespace {

/// A face is seen edge-on if its normal is more than 75 degrees from the eye.
constexpr double edge_cosine = 0.26;
/// A sign serves routes that pass within the first distance; it is read between the two [m].
constexpr double serves_m = 6;
constexpr double furthest_reader_m = 20;
constexpr double nearest_reader_m = 1;
/// A sign higher above an eye than this belongs to another storey [m].
constexpr double highest_above_eye_m = 4;
/// Cosine of half of 120 degrees around the direction ahead.
constexpr double ahead_cosine = 0.5;
constexpr double reader_eye_m = 1.65;
constexpr double reader_step_m = 0.5;
/// Fewer places are not enough to judge a route.
constexpr size_t min_readers = 4;
/// Beside a sign's edge, and in front of its face [m].
constexpr double beside_sign_m = 0.05;
/// The first is the largest distance of a lintel above a sign in its opening; below the second,
/// people strike the sign [m].
constexpr double under_lintel_m = 0.6;
constexpr double strikes_head_m = 2;

/// Cosine between the face turned to an eye and the eye; negative: only a back is visible.
double turned_to(const Sign& sign, const glm::dvec3& eye) {
  const glm::dvec3 to = eye - sign.frame.origin;
  const double cosine = glm::dot(sign.frame.axes[2], to) / glm::length(to);
  return sign.double_sided ? std::abs(cosine) : cosine;
}

bool sees_place_of(const Site& site, const GeometryAccess& access, const Sign& sign,
                   const glm::dvec3& eye) {
  const glm::dvec3 to = glm::normalize(eye - sign.frame.origin);
  const double off = std::max(sign.width_m, sign.thickness_m) / 2 + beside_sign_m;
  return clear_share(site.building.scene(), access, site.building.local(eye),
                     site.building.local(sign.frame.origin + to * off)) > 0;
}

enum class EdgeView { none, edge, back, face };

/// How people on a route with the sign ahead see it: the best of their views. A back may be
/// correct, if the sign serves the other direction.
EdgeView view_from_route(const Site& site, const GeometryAccess& access, const Sign& sign,
                         const EscapeRoute& route) {
  size_t readers = 0, backs = 0;
  double least = furthest_reader_m;
  for (const Walker& w : steps_along(route, reader_step_m)) {
    const glm::dvec3 eye = w.foot + glm::dvec3(0, 0, reader_eye_m);
    const glm::dvec3 to = sign.frame.origin - eye;
    const double distance = glm::length(to);
    if (distance < furthest_reader_m && sign.frame.origin.z > w.foot.z &&
        to.z < highest_above_eye_m)
      least = std::min(least, glm::length(glm::dvec2(to)));
    if (distance < nearest_reader_m || distance > furthest_reader_m ||
        glm::dot(to / distance, w.ahead) < ahead_cosine || !sees_place_of(site, access, sign, eye))
      continue;
    if (turned_to(sign, eye) > edge_cosine) return EdgeView::face;
    backs += turned_to(sign, eye) < -edge_cosine ? 1 : 0;
    ++readers;
  }
  if (backs > 0) return backs >= min_readers && least < serves_m ? EdgeView::back : EdgeView::none;
  return readers >= min_readers && least < serves_m ? EdgeView::edge : EdgeView::none;
}

bool serves_area(const Site& site, const GeometryAccess& access, const Sign& sign) {
  for (const AssessedArea& area : site.scene.open_areas)
    for (const glm::dvec3& place : places_within(area, 0.5, 1)) {
      const glm::dvec3 eye = place + glm::dvec3(0, 0, reader_eye_m);
      if (glm::length(eye - sign.frame.origin) < furthest_reader_m &&
          turned_to(sign, eye) > edge_cosine && sees_place_of(site, access, sign, eye))
        return true;
    }
  return false;
}

std::optional<Finding> shows_edge(const Site& site, const GeometryAccess& access,
                                  const Sign& sign) {
  const EscapeRoute *edge = nullptr, *back = nullptr;
  for (const EscapeRoute& route : site.scene.routes) {
    const EdgeView view = view_from_route(site, access, sign, route);
    if (view == EdgeView::face) return std::nullopt;
    if (view == EdgeView::edge && edge == nullptr) edge = &route;
    if (view == EdgeView::back && back == nullptr) back = &route;
  }
  const EscapeRoute* served = edge != nullptr && back == nullptr ? edge : back;
  if (served == nullptr || serves_area(site, access, sign)) return std::nullopt;
  const char* how = back == nullptr
                        ? "shows only its edge to route \"{}\" (line {}), which leads by: its face "
                          "is turned from all on it by more than 75 degrees"
                        : "shows only its back to those on route \"{}\" (line {}), who have it "
                          "ahead, and its face to nobody on any route or area: turn it round, or "
                          "write the route of those it is for";
  return Finding{
      back == nullptr ? Severity::warning : Severity::note,
      "blind",
      {sign.place, "sign \"" + sign.name + "\" " +
                       fmt::format(fmt::runtime(how), served->name, served->place.line) +
                       "; 'facing' is the direction from the face to the person who reads it"}};
}

std::optional<Finding> hangs_in_doorway(const Site& site, const GeometryAccess& access,
                                        const Sign& sign) {
  const glm::dvec3& origin = sign.frame.origin;
  const auto floor = solid_ahead(site, access, origin, glm::dvec3(0, 0, -1), floor_below_m, false);
  if (!floor) return std::nullopt;
  const double edge = static_cast<double>(floor->distance_m) - sign.height_m / 2;
  if (edge > strikes_head_m) return std::nullopt;
  for (const glm::dvec3& axis : {sign.frame.axes[2], sign.frame.axes[0]}) {
    const glm::dvec3 level(axis.x, axis.y, 0);
    if (glm::length(level) < 0.5) continue;
    const auto doorway = doorway_at(site, access, origin, glm::normalize(level));
    if (!doorway || !doorway->lintel_m || *doorway->lintel_m > sign.height_m / 2 + under_lintel_m)
      continue;
    return Finding{
        Severity::warning,
        "inside",
        {sign.place, fmt::format("sign \"{}\" hangs in the opening of a doorway, its lower edge {} "
                                 "above the floor: people and the door's leaf strike it; hang it "
                                 "above the opening",
                                 sign.name, length_text(edge))}};
  }
  return std::nullopt;
}

}  // namespace

void inspect_sign_sight(const Site& site, const std::vector<char>& misplaced, Findings& out) {
  const auto& signs = site.scene.signs;
  std::vector<std::optional<Finding>> found(signs.size());
  site.building.each(signs.size(), [&](const GeometryAccess& access, size_t i) {
    if (misplaced[i] != 0 || std::abs(signs[i].frame.axes[2].z) > 0.7) return;
    found[i] = hangs_in_doorway(site, access, signs[i]);
    if (!found[i]) found[i] = shows_edge(site, access, signs[i]);
  });
  for (auto& finding : found)
    if (finding) out.push_back(std::move(*finding));
}

}  // namespace luxodus

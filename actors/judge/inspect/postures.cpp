// Inspects the orientation of signs and eyes: faces that look up or lie on their side, implausible
// heights and sizes, arrows that point back; eyes that look away, pictures upside down.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"
#include "scenes/emergency/sign_geometry.hpp"

namespace luxodus {

namespace {

/// Cosine of more than 45 degrees from horizontal, or from upright.
constexpr double steep = 0.7;
/// Faces of exit signs are 5 cm to 1.5 m high [m].
constexpr double min_face_m = 0.05;
constexpr double max_face_m = 1.5;
/// A face with a larger share of the room's height is too large; codes derive the viewing distance
/// from its height.
constexpr double max_of_room = 0.2;
/// ISO 3864: the viewing distance of a lit sign is 200 times its height.
constexpr double lit_distance_factor = 200;
/// Signs hang above people, or low on walls for guidance in smoke: with the lower edge between
/// these heights above the floor, people and furniture hide them [m].
constexpr double low_sign_m = 0.6;
constexpr double high_sign_m = 1.5;
/// Limits on the height of an observer's eye above the floor [m].
constexpr double min_eye_m = 0.2;
constexpr double max_eye_m = 2.3;
/// A sign's arrow applies to a route that passes within the first distance, and goes on for the
/// second [m].
constexpr double passes_near_m = 6;
constexpr double leads_on_m = 2;
constexpr double against = -0.7;

std::optional<Finding> turned_wrong(const Sign& sign) {
  const glm::dvec3 &up = sign.frame.axes[1], &normal = sign.frame.axes[2];
  if (std::abs(normal.z) > steep)
    return sign_finding(Severity::warning, "turned", sign,
                        std::string("faces the ") + (normal.z > 0 ? "ceiling" : "floor") +
                            ": 'facing' is the direction from the face to the person who reads it");
  if (up.z < steep)
    return sign_finding(Severity::warning, "turned", sign,
                        std::string(up.z < -steep ? "hangs upside down" : "hangs on its side") +
                            ", so that an arrow on it points elsewhere: leave out 'up', or say "
                            "up = [0, 0, 1]");
  return std::nullopt;
}

std::optional<Finding> sized_wrong(const Sign& sign) {
  if (sign.height_m >= min_face_m && sign.height_m <= max_face_m) return std::nullopt;
  return sign_finding(Severity::warning, "unit", sign,
                      fmt::format("is {} wide and {} high: width and height are in metres",
                                  length_text(sign.width_m), length_text(sign.height_m)));
}

/// Reports a wall, ceiling or leaf that cuts the face: between its centre and a corner.
std::optional<Finding> cut_face(const Site& site, const GeometryAccess& access, const Sign& sign) {
  constexpr double before_m = 2e-3;
  const auto& axes = sign.frame.axes;
  const glm::dvec3 middle = sign.frame.origin + axes[2] * before_m;
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
    const glm::dvec3 way = axes[0] * (corner.x * sign.width_m / 2 * 0.98) +
                           axes[1] * (corner.y * sign.height_m / 2 * 0.98);
    const double length = glm::length(way);
    const auto met = solid_ahead(site, access, middle, way / length, length);
    if (met)
      return sign_finding(Severity::warning, "inside", sign,
                          "sticks through " + object_text(site.scene.objects[met->surface]) +
                              ", which hides a part of its face: move it, or make it smaller");
  }
  return std::nullopt;
}

std::optional<Finding> hung_wrong(const Site& site, const GeometryAccess& access,
                                  const Sign& sign) {
  if (auto cut = cut_face(site, access, sign)) return cut;
  const glm::dvec3 front = sign.frame.origin + sign.frame.axes[2] * 0.05;
  const auto floor = solid_ahead(site, access, front, glm::dvec3(0, 0, -1), floor_below_m, false);
  if (!floor) return std::nullopt;
  if (site.is_back(*floor) && site.is_outside(access, front))
    return sign_finding(Severity::warning, "outside", sign,
                        "hangs above the ceiling, where nobody sees it: lower it into the room");
  const auto ceiling = solid_ahead(site, access, front, glm::dvec3(0, 0, 1), floor_below_m, false);
  const double room_m = static_cast<double>(floor->distance_m) +
                        (ceiling ? static_cast<double>(ceiling->distance_m) : 0);
  if (ceiling && sign.height_m > max_of_room * room_m)
    return sign_finding(
        Severity::warning, "unit", sign,
        fmt::format("is {} high in a room of {}: its verdicts follow from its height, by which "
                    "codes let it be seen from {} (EN 1838: 200 heights where it is lit); are "
                    "width and height right?",
                    length_text(sign.height_m), length_text(room_m),
                    length_text(lit_distance_factor * sign.height_m)));
  const double edge = static_cast<double>(floor->distance_m) - sign.height_m / 2;
  if (edge > low_sign_m && edge < high_sign_m)
    return sign_finding(Severity::note, "height", sign,
                        fmt::format("has its lower edge {} above the floor, where people and "
                                    "furniture hide it: EN 1838 asks for 2 m; is its z right?",
                                    length_text(edge)));
  return std::nullopt;
}

/// 1: its arrow points to the reader's right, -1: to the left, 0: neither, or unknown. Decided by
/// the name of its drawing, as in ISO 7010, or by an arrow in its text.
int arrow_of(const Sign& sign) {
  std::string words = sign.file.substr(sign.file.find_last_of('/') + 1) + " " + sign.text;
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto says = [&](const char* word) { return words.find(word) != std::string::npos; };
  const bool diagonal = says("up") || says("down");
  const bool left = says("left") || says("links") || says("<") || says("\u2190");
  const bool right = says("right") || says("rechts") || says(">") || says("\u2192");
  if (diagonal || left == right) return 0;
  return right ? 1 : -1;
}

/// Direction in which a route continues from its point nearest to the sign; none if it ends there,
/// or if nobody on it reads the sign.
std::optional<glm::dvec3> way_on(const EscapeRoute& route, const Sign& sign) {
  const auto steps = steps_along(route, 0.5);
  if (steps.empty()) return std::nullopt;
  const auto distance = [&](const Walker& w) {
    return glm::length(glm::dvec2(w.foot - sign.frame.origin));
  };
  const auto near =
      std::min_element(steps.begin(), steps.end(),
                       [&](const Walker& a, const Walker& b) { return distance(a) < distance(b); });
  if (distance(*near) > passes_near_m) return std::nullopt;
  const double rises = near->foot.z - sign.frame.origin.z;
  if (rises > 0 || rises < -passes_near_m) return std::nullopt;
  const bool read = std::any_of(steps.begin(), near + 1, [&](const Walker& w) {
    return !view_of_sign(sign, w.foot + glm::dvec3(0, 0, 1.65)).behind;
  });
  const auto on = std::find_if(
      near, steps.end(), [&](const Walker& w) { return w.along_m >= near->along_m + leads_on_m; });
  if (!read || on == steps.end()) return std::nullopt;
  return glm::normalize(on->foot - near->foot);
}

/// Reports an arrow that points back on every route that passes.
std::optional<Finding> points_back(const SceneDescription& scene, const Sign& sign) {
  const int arrow = arrow_of(sign);
  if (arrow == 0) return std::nullopt;
  const EscapeRoute* wrong = nullptr;
  for (const EscapeRoute& route : scene.routes) {
    const auto way = way_on(route, sign);
    if (!way) continue;
    if (arrow * glm::dot(*way, sign.frame.axes[0]) > against) return std::nullopt;
    wrong = &route;
  }
  if (wrong == nullptr) return std::nullopt;
  return sign_finding(Severity::warning, "arrow", sign,
                      fmt::format("points to the {}, and route \"{}\" (line {}) leads on to the "
                                  "{} from there: take the other drawing, or turn the route round",
                                  arrow > 0 ? "right" : "left", wrong->name, wrong->place.line,
                                  arrow > 0 ? "left" : "right"));
}

std::optional<std::string> looks_wrong(const Site& site, const GeometryAccess& access,
                                       const Observer& o) {
  if (std::abs(o.gaze.z) > steep)
    return std::string("looks at the ") + (o.gaze.z > 0 ? "ceiling" : "floor") +
           ": glare is judged for where it looks; give it the sign as its target";
  const auto floor = solid_ahead(site, access, o.eye, glm::dvec3(0, 0, -1), floor_below_m);
  const double height = floor ? static_cast<double>(floor->distance_m) : 1;
  if (height < min_eye_m || height > max_eye_m)
    return fmt::format(
        "has its eye {} above what is below it: people's eyes are 0.6 m (crawling) "
        "to 1.8 m above the floor",
        length_text(height));
  const auto& signs = site.scene.signs;
  bool any = false;
  for (uint32_t i = 0; i < signs.size(); ++i) {
    if (o.signs && std::find(o.signs->begin(), o.signs->end(), i) == o.signs->end()) continue;
    const SignView view = view_of_sign(signs[i], o.eye);
    if (view.behind || !(site.building.seen_share(access, signs[i], view, o.eye) > 0)) continue;
    if (glm::dot(view.centre - o.eye, o.gaze) > 0) return std::nullopt;
    any = true;
  }
  if (!any) return std::nullopt;
  return "looks away from every sign that it could see: give it one as its target";
}

}  // namespace

void inspect_postures(const Site& site, const std::vector<char>& misplaced, Findings& out) {
  const SceneDescription& scene = site.scene;
  std::vector<std::optional<Finding>> of_signs(scene.signs.size());
  std::vector<std::optional<std::string>> of_eyes(scene.observers.size());
  site.building.each(of_signs.size() + of_eyes.size(), [&](const GeometryAccess& access, size_t i) {
    if (i >= of_signs.size()) {
      const Observer& o = scene.observers[i - of_signs.size()];
      if (!site.in_body(access, o.eye) && !site.remote.told("", o.eye))
        of_eyes[i - of_signs.size()] = looks_wrong(site, access, o);
      return;
    }
    const Sign& sign = scene.signs[i];
    of_signs[i] = sized_wrong(sign);
    if (!of_signs[i]) of_signs[i] = turned_wrong(sign);
    if (!of_signs[i] && misplaced[i] == 0) of_signs[i] = points_back(scene, sign);
    if (!of_signs[i] && !site.remote.told("", sign.frame.origin))
      of_signs[i] = hung_wrong(site, access, sign);
  });
  for (auto& finding : of_signs)
    if (finding) out.push_back(std::move(*finding));
  for (size_t i = 0; i < of_eyes.size(); ++i)
    if (of_eyes[i])
      out.push_back({Severity::warning,
                     "looks away",
                     {scene.observers[i].place,
                      "observer \"" + scene.observers[i].name + "\" " + *of_eyes[i]}});
  for (const Camera& c : scene.cameras)
    if (c.up.z < -steep)
      out.push_back({Severity::note,
                     "turned",
                     {c.place, "camera \"" + c.name +
                                   "\" makes a picture upside down: say "
                                   "up = [0, 0, 1]"}});
}

}  // namespace luxodus

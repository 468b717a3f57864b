// Inspects escape routes and areas: whether people can be where they are judged. People walk around
// furniture.
#include <algorithm>

#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"

namespace luxodus {

namespace {

/// A floor is searched within this distance above and below a route [m].
constexpr double floor_within_m = 0.3;
/// If there is none, the nearest floor within this distance is reported.
constexpr double floor_far_m = 100;
/// A horizontal route farther from its floor than this is not on it [m].
constexpr double on_floor_m = 0.05;
constexpr double standing_eye_m = 1.65;
/// An obstacle from here up to the eye is not a step, sill or table [m].
constexpr double waist_m = 1.0;
/// Higher than any step, and lower than a sill or a barrier [m].
constexpr double knee_m = 0.35;
constexpr double chest_m = 1.35;
/// People walk upright below obstacles higher than this [m].
constexpr double headroom_m = 1.9;
/// Spacing of width measurements along a route [m].
constexpr double width_step_m = 0.5;
/// A smaller difference is plaster [m].
constexpr double width_slack_m = 0.05;
/// Doorways are narrower than routes: only if more than this share is too narrow, the corridor is.
constexpr double narrow_share = 0.1;
constexpr size_t narrow_steps = 3;
/// Escape routes are at least 0.8 m wide for few people (a person's shoulders need 0.6 m).
constexpr double min_width_m = 0.6;
/// A shorter route leads nowhere [m].
constexpr double min_length_m = 0.5;
/// EN 1838: wider routes are judged in strips [m].
constexpr double strip_m = 2;
/// Spacing of points in areas, and their distance from the outline [m].
constexpr double area_step_m = 1;
constexpr double area_border_m = 0.25;
/// If more than this share of its points is wrong, an area is misplaced.
constexpr double area_share = 0.1;

/// What obstructs people: objects that are not furniture. People pass under signs and luminaires.
auto passable(const Site& site) {
  return [&site](const FacedSurface& f) {
    return f.surface >= site.scene.objects.size() || f.kind == MaterialKind::open ||
           is_furniture(site.scene.objects[f.surface]);
  };
}

std::optional<FacedSurface> first_wall(const Site& site, const GeometryAccess& access,
                                       const glm::dvec3& from, const glm::dvec3& direction,
                                       double length_m) {
  return first_stop(site.building.scene(), access, site.building.local(from), Vec3(direction),
                    static_cast<Real>(length_m), passable(site));
}

/// Height of a place above the nearest floor below it, within `below_m`; floors slightly above it
/// count, too.
std::optional<double> above_floor(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& place, double below_m) {
  const auto may_pass = passable(site);
  std::optional<double> foot;
  const auto met = first_stop(
      site.building.scene(), access, site.building.local(place + glm::dvec3(0, 0, floor_within_m)),
      Vec3(0, 0, -1), static_cast<Real>(floor_within_m + below_m), [&](const FacedSurface& f) {
        const bool passes = may_pass(f);
        if (passes && !f.front && f.surface < site.scene.objects.size())
          foot = static_cast<double>(f.distance_m) - floor_within_m;
        return passes;
      });
  std::optional<double> floor;
  if (met) floor = static_cast<double>(met->distance_m) - floor_within_m;
  // Furniture on the floor has its bottom in the floor's plane, where a ray hits one of the two:
  // then the furniture's bottom counts as the floor.
  const bool stands_here = foot && std::abs(*foot) <= on_floor_m;
  if (stands_here && (!floor || std::abs(*floor) > on_floor_m)) return foot;
  return floor;
}

/// What is wrong along one route, by place.
struct Walk {
  std::vector<glm::dvec3> places;
  std::vector<std::optional<double>> above;  // height above the floor; none: no floor near
  std::vector<char> inside;                  // whether the eye is in a wall
};

Walk walk_along(const Site& site, const EscapeRoute& route) {
  Walk walk;
  walk.places = places_along(route, 1);
  walk.above.resize(walk.places.size());
  walk.inside.resize(walk.places.size());
  const std::vector<char> furniture = furniture_of(site);
  site.building.each(walk.places.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3& place = walk.places[i];
    walk.above[i] = above_floor(site, access, place, floor_within_m);
    if (!walk.above[i]) walk.above[i] = above_floor(site, access, place, floor_far_m);
    const glm::dvec3 eye = place + glm::dvec3(0, 0, standing_eye_m);
    walk.inside[i] = site.building.in_solid(access, eye, furniture) ? 1 : 0;
  });
  return walk;
}

struct Obstacle {
  const Object* object = nullptr;
  glm::dvec3 place{0};  // on the floor
};

std::vector<Obstacle> met_between(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& from, const glm::dvec3& to, double height_m) {
  constexpr double beyond_m = 1e-3;
  const glm::dvec3 start = from + glm::dvec3(0, 0, height_m);
  const double length = glm::length(to - from);
  std::vector<Obstacle> out;
  if (!(length > beyond_m)) return out;
  const glm::dvec3 direction = (to - from) / length;
  for (double gone = 0; gone < length && out.size() < limits::surfaces_passed;) {
    const auto met = first_wall(site, access, start + direction * gone, direction, length - gone);
    if (!met) break;
    gone += static_cast<double>(met->distance_m);
    out.push_back({&site.scene.objects[met->surface], from + (to - from) * (gone / length)});
    gone += beyond_m;
  }
  return out;
}

bool among(const std::vector<Obstacle>& list, const Obstacle& one) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Obstacle& other) { return other.object == one.object; });
}

/// Obstacles from waist to eye, each object once.
std::vector<Obstacle> obstacles(const Site& site, const Walk& walk) {
  const size_t legs = walk.places.empty() ? 0 : walk.places.size() - 1;
  std::vector<std::vector<Obstacle>> met(legs);
  site.building.each(legs, [&](const GeometryAccess& access, size_t i) {
    const auto low = met_between(site, access, walk.places[i], walk.places[i + 1], waist_m);
    const auto high = met_between(site, access, walk.places[i], walk.places[i + 1], standing_eye_m);
    for (const Obstacle& one : low)
      if (among(high, one)) met[i].push_back(one);
  });
  std::vector<Obstacle> out;
  for (const auto& some : met)
    for (const Obstacle& one : some)
      if (!among(out, one)) out.push_back(one);
  return out;
}

/// Obstacles on level ground at one height only: a barrier, a sill or a beam.
std::optional<Obstacle> met_at(const Site& site, const Walk& walk, double height_m) {
  const size_t legs = walk.places.empty() ? 0 : walk.places.size() - 1;
  std::vector<std::vector<Obstacle>> met(legs);
  site.building.each(legs, [&](const GeometryAccess& access, size_t i) {
    if (std::abs(walk.places[i].z - walk.places[i + 1].z) > 1e-6) return;
    met[i] = met_between(site, access, walk.places[i], walk.places[i + 1], height_m);
  });
  for (const auto& some : met)
    for (const Obstacle& one : some)
      if (!one.object->door) return one;
  return std::nullopt;
}

Finding of_route(Severity severity, const EscapeRoute& route, const std::string& what) {
  return {severity, "route", {route.place, "route \"" + route.name + "\" " + what}};
}

void tell_floor(const EscapeRoute& route, const Walk& walk, Findings& out) {
  for (size_t i = 0; i < walk.places.size(); ++i) {
    const std::string at = place_text(walk.places[i]);
    const auto& above = walk.above[i];
    if (!above || *above > floor_within_m) {
      const std::string where =
          above ? fmt::format("the floor lies {} below it", length_text(*above))
                : std::string("is it outside the building, or at another height?");
      out.push_back(
          of_route(Severity::error, route, "has no floor under it: " + where + ", at " + at));
      return;
    }
    const bool level = is_level(route);
    if (!level || std::abs(*above) <= on_floor_m) continue;
    out.push_back(
        of_route(Severity::warning, route,
                 fmt::format("lies {} {} its floor, at {}: give its points the height "
                             "of the floor",
                             length_text(std::abs(*above)), *above > 0 ? "above" : "below", at)));
    return;
  }
}

/// Free distances to the left and right of the places of a route [m], up to its width.
struct Width {
  std::vector<double> left, right;
  std::vector<glm::dvec3> places;
};

Width width_along(const Site& site, const EscapeRoute& route) {
  const auto steps = steps_along(route, width_step_m);
  Width width;
  width.left.assign(steps.size(), 0);
  width.right.assign(steps.size(), 0);
  for (const Walker& w : steps) width.places.push_back(w.foot);
  site.building.each(steps.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 left = glm::normalize(glm::dvec3(-steps[i].ahead.y, steps[i].ahead.x, 0));
    const auto clear = [&](const glm::dvec3& aside) {
      double most = 0;
      for (const double height : {waist_m, standing_eye_m}) {
        const auto met = first_wall(site, access, steps[i].foot + glm::dvec3(0, 0, height), aside,
                                    route.width_m);
        most = std::max(most, met ? static_cast<double>(met->distance_m) : route.width_m);
      }
      return most;
    };
    width.left[i] = clear(left);
    width.right[i] = clear(-left);
  });
  return width;
}

/// Places with less than `wanted_m` free; none if there are no more than doorways explain.
std::optional<size_t> too_narrow(const std::vector<double>& aside, double wanted_m) {
  std::optional<size_t> first;
  size_t count = 0;
  for (size_t i = 0; i < aside.size(); ++i) {
    if (aside[i] >= wanted_m - width_slack_m) continue;
    if (!first) first = i;
    ++count;
  }
  const double most = narrow_share * static_cast<double>(aside.size());
  const bool doorways = count < narrow_steps || static_cast<double>(count) <= most;
  return doorways ? std::nullopt : first;
}

void tell_width(const Site& site, const EscapeRoute& route, Findings& out) {
  const Width width = width_along(site, route);
  const double half = route.width_m / 2;
  const int strips = std::max(1, static_cast<int>(std::ceil(route.width_m / strip_m * (1 - 1e-9))));
  const double outermost = half - half / strips;  // centre of the outermost strip
  for (const auto* aside : {&width.left, &width.right}) {
    const bool strip_in_wall = outermost > 0 && too_narrow(*aside, outermost + width_slack_m);
    const auto at = too_narrow(*aside, half);
    if (!at) continue;
    const double clear = width.left[*at] + width.right[*at];
    const std::string what = fmt::format(
        "is {} wide, and free is {} to the left and {} to the right of its line at {}: ",
        length_text(route.width_m), length_text(std::min(width.left[*at], half)),
        length_text(std::min(width.right[*at], half)), place_text(width.places[*at]));
    const std::string why = strip_in_wall ? "strips of it are judged inside walls; "
                                          : "its edges are judged inside walls; ";
    const std::string advice = clear >= route.width_m - 2 * width_slack_m
                                   ? "move its line to the middle"
                                   : "give it the width of what it leads through";
    out.push_back(
        of_route(strip_in_wall ? Severity::error : Severity::warning, route, what + why + advice));
    return;
  }
}

/// Reports obstacles that are missed at waist and eye height, or hit at only one of them.
void tell_barriers(const Site& site, const EscapeRoute& route, const Walk& walk, Findings& out) {
  const auto told = [&](double height_m, const char* how, const char* advice) {
    const auto met = met_at(site, walk, height_m);
    if (!met) return false;
    out.push_back(of_route(Severity::warning, route,
                           fmt::format("{} {} at {}: {}", how, object_text(*met->object),
                                       place_text(met->place), advice)));
    return true;
  };
  const char* over =
      "people cannot walk there; lead it around, draw its opening from the floor, "
      "or give its points the heights of the steps";
  if (told(knee_m, "climbs over", over) || told(chest_m, "ducks under", over) ||
      told(waist_m, "climbs over or ducks under", over))
    return;
  told(headroom_m, "has less than 1.9 m of headroom under",
       "is its height right, and that of the opening?");
}

void inspect_route(const Site& site, const EscapeRoute& route, Findings& out) {
  const Walk walk = walk_along(site, route);
  const size_t before = out.size();
  tell_floor(route, walk, out);
  const auto met = obstacles(site, walk);
  const Obstacle* wall = nullptr;
  for (const Obstacle& one : met) {
    if (!one.object->door && wall == nullptr) wall = &one;
    if (one.object->door)
      out.push_back(of_route(Severity::warning, route,
                             fmt::format("leads through the closed door {} at {}: behind it, light "
                                         "and signs are those of the closed door",
                                         object_text(*one.object), place_text(one.place))));
  }
  const auto inside = std::find(walk.inside.begin(), walk.inside.end(), 1);
  if (wall != nullptr) {
    out.push_back(of_route(Severity::error, route,
                           fmt::format("leads through the wall or body {} at {}",
                                       object_text(*wall->object), place_text(wall->place))));
  } else if (inside != walk.inside.end()) {
    const auto at = static_cast<size_t>(inside - walk.inside.begin());
    out.push_back(of_route(Severity::error, route,
                           "leads through a wall, at " + place_text(walk.places[at])));
  }
  if (wall == nullptr && inside == walk.inside.end()) tell_barriers(site, route, walk, out);
  if (const double length = length_of(route); length < min_length_m)
    out.push_back(of_route(Severity::warning, route,
                           fmt::format("is {} long, less than a few steps: nobody on it is judged "
                                       "farther away; points are in metres",
                                       length_text(length))));
  const bool wrong = std::any_of(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
                                 [](const Finding& f) { return f.severity == Severity::error; });
  if (route.width_m < min_width_m)
    out.push_back(
        of_route(Severity::warning, route,
                 fmt::format("is {} wide, narrower than a person: light is judged on so "
                             "narrow a strip alone; 'width' is that of the way, in metres",
                             length_text(route.width_m))));
  if (!wrong) tell_width(site, route, out);
}

void inspect_area(const Site& site, const char* word, const AssessedArea& area, bool is_floor,
                  Findings& out) {
  const auto places = places_within(area, area_border_m, area_step_m);
  std::vector<std::optional<double>> above(places.size());
  std::vector<char> inside(places.size(), 0), outside(places.size(), 0);
  const std::vector<char> furniture = furniture_of(site);
  site.building.each(places.size(), [&](const GeometryAccess& access, size_t i) {
    above[i] = above_floor(site, access, places[i], floor_far_m);
    const bool near = above[i] && std::abs(*above[i]) <= floor_within_m;
    const glm::dvec3 body = places[i] + glm::dvec3(0, 0, near ? waist_m : 0.02);
    inside[i] = site.building.in_solid(access, body, furniture) ? 1 : 0;
    outside[i] = !is_floor && site.is_outside(access, body) ? 1 : 0;
  });
  const auto many = [&](size_t count) {
    return static_cast<double>(count) > area_share * static_cast<double>(places.size());
  };
  const auto tell = [&](Severity severity, const std::string& what) {
    out.push_back(
        {severity, "area", {area.place, fmt::format("{} \"{}\" ", word, area.name) + what}});
  };
  size_t floorless = 0, walled = 0, aloft = 0, beyond = 0;
  double height = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    walled += inside[i] != 0 ? 1 : 0;
    beyond += outside[i] != 0 ? 1 : 0;
    floorless += above[i] ? 0 : 1;
    if (!above[i] || std::abs(*above[i]) <= on_floor_m) continue;
    ++aloft;
    height = *above[i];
  }
  if (2 * floorless > places.size())
    tell(Severity::error, "has no floor under most of it: is it outside the building?");
  else if (many(floorless))
    tell(Severity::warning, "has no floor under a part of it: is its outline too large?");
  else if (2 * beyond > places.size())
    tell(Severity::warning,
         fmt::format("lies outside the building, {} above what is below it: is its z in metres?",
                     length_text(std::abs(height))));
  if (is_floor && 2 * aloft > places.size())
    tell(Severity::warning,
         fmt::format("lies {} {} its floor: give it the height of the floor",
                     length_text(std::abs(height)), height > 0 ? "above" : "below"));
  if (many(walled))
    tell(Severity::warning,
         fmt::format("lies to {:.0f} % in walls or bodies: is its outline too "
                     "large?",
                     100.0 * static_cast<double>(walled) / static_cast<double>(places.size())));
}

}  // namespace

void inspect_routes(const Site& site, Findings& out) {
  for (const EscapeRoute& route : site.scene.routes) inspect_route(site, route, out);
}

void inspect_areas(const Site& site, Findings& out) {
  for (const AssessedArea& area : site.scene.open_areas)
    inspect_area(site, "open area", area, true, out);
  for (const AssessedArea& area : site.scene.task_areas)
    inspect_area(site, "task area", area, false, out);
}

}  // namespace luxodus

// Inspects the places of luminaires and emitters. Whether one is in a wall is decided by its light,
// emitted as by the tracer, so that lamps in a ceiling's plane or in their own body are accepted if
// the tracer's light escapes.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "actors/judge/inspect/route_floor.hpp"
#include "actors/judge/inspect/same_place.hpp"
#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/transport/emitted_light.hpp"
#include "scenes/light/transport/near_field.hpp"

namespace luxodus {

namespace {

/// Light that ends this close has not left the wall [m].
constexpr Real near_m = 0.02_r;
/// A lamp outside, whose light ends this close on the outer side of a room, was meant to be inside
/// [m].
constexpr Real recess_m = 0.5_r;
constexpr Real light_reach_m = 1e5_r;
/// An object that hides more of a luminaire's light, is no larger, and within whose bounds the
/// luminaire is, may be its body.
constexpr double body_share = 0.05, largest_body_m = 3, at_body_m = 0.02;
/// Rays of a first test, which most luminaires pass, and of a second one.
constexpr int few_rays = 64;
constexpr int many_rays = 1024;
constexpr double few_share = 0.25;
/// More than a half by two standard errors of the second test: a lamp directly in front of a wall
/// that shines in all directions loses a half, which is no mistake.
constexpr double lost_share = 0.5 + 2 * 0.5 / 32;
constexpr uint64_t ends_seed = 17;
/// Two things closer than this are in the same place [m].
constexpr double one_place_m = 0.01;
/// A luminaire outside whose light hits no wall, but that is this close above the ceiling of a
/// room, was meant to be inside [m].
constexpr double above_ceiling_m = 1;
/// Thickness of a ceiling with its beams, at most, and steps in which a room is sought below it
/// [m].
constexpr double ceiling_depth_m = 1, ceiling_step_m = 0.05;
/// People who walk this close to a luminaire on a roof have it for themselves [m].
constexpr double roof_way_m = 10;
/// A panel that represents the sky is several times as large as the building; no lamp is.
constexpr double times_building = 5;
/// Two directions within 8 degrees count as equal.
constexpr double one_direction = 0.99;

std::string emitter_text(const Emitter& e) {
  return (e.distribution == Distribution::web ? "luminaire \"" : "emitter \"") + e.name + "\"";
}

glm::dvec3 middle_of(const Emitter& e) {
  if (e.shape != EmitterShape::mesh || e.mesh.positions.empty()) return e.frame.origin;
  const auto& p = e.mesh.positions;
  return std::accumulate(p.begin(), p.end(), glm::dvec3(0)) / static_cast<double>(p.size());
}

/// Where the light of one emitter ends: shares of its flux.
struct Ends {
  double near = 0;                // within near_m
  double back = 0;                // on backs: the inside of a body, or the outside of a room
  double close_back = 0;          // of these, within recess_m
  uint32_t surface = none_index;  // the surface that gets most of either
  std::map<uint32_t, double> on;  // by surface
};

Ends ends_of(const Site& site, const GeometryAccess& access, uint32_t emitter, int rays) {
  const CompiledScene& scene = site.building.scene();
  const CompiledEmitter& e = scene.emitters[emitter];
  std::map<uint32_t, int> by_surface, all_by_surface;
  int near = 0, back = 0, close_back = 0;
  for (const auto& [point, direction] : emitted_rays(scene, access, emitter, ends_seed, rays)) {
    Vec3 origin = point.position;
    if (e.distribution != Distribution::collimated) {
      const Vec3 side = glm::dot(point.axis, direction) >= 0 ? point.axis : -point.axis;
      origin = offset_ray(origin, side, scene.min_offset_m);
    }
    const auto end =
        first_stop(scene, access, origin, direction, light_reach_m, [&](const FacedSurface& f) {
          const CompiledSurface& surface = scene.surfaces[f.surface];
          return lets_light_through(f.kind) || surface.body_emitter == emitter ||
                 (e.body != 0 && surface.body == e.body);
        });
    if (!end) continue;
    ++all_by_surface[end->surface];
    near += end->distance_m <= near_m ? 1 : 0;
    back += site.is_back(*end) ? 1 : 0;
    close_back += site.is_back(*end) && end->distance_m <= recess_m ? 1 : 0;
    if (end->distance_m <= near_m || site.is_back(*end)) ++by_surface[end->surface];
  }
  const double all = rays;
  Ends out{near / all, back / all, close_back / all, none_index, {}};
  for (const auto& [surface, count] : all_by_surface) out.on[surface] = count / all;
  const auto most =
      std::max_element(by_surface.begin(), by_surface.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != by_surface.end()) out.surface = most->first;
  return out;
}

std::string surface_text(const Site& site, uint32_t surface) {
  if (surface < site.scene.objects.size()) return object_text(site.scene.objects[surface]);
  return surface == none_index ? "a body"
                               : "\"" + site.building.scene().surfaces[surface].name + "\"";
}

/// The bounds of each object.
std::vector<Bounds> boxes_of(const SceneDescription& scene) {
  std::vector<Bounds> out;
  for (const Object& object : scene.objects) out.push_back(bounds_of(object.mesh));
  return out;
}

/// The longest side of the building; 0 without geometry.
double building_length(const std::vector<Bounds>& boxes) {
  Bounds all;
  for (const Bounds& box : boxes) all.extend(box);
  if (all.empty()) return 0;
  const glm::dvec3 size = all.high - all.low;
  return std::max({size.x, size.y, size.z});
}

/// An object that hides light of a luminaire and may be its body, whose shadow the intensities lack
/// already; none if there is none, or if it is said to be the body. `boxes`: of all objects.
const Object* unsaid_body(const Site& site, const std::vector<Bounds>& boxes, const Emitter& e,
                          const Ends& ends) {
  if (e.distribution != Distribution::web) return nullptr;
  const glm::dvec3 margin(at_body_m), at = e.frame.origin;
  for (const auto& [surface, share] : ends.on) {
    if (share < body_share || surface >= site.scene.objects.size()) continue;
    const Bounds& bounds = boxes[surface];
    const glm::dvec3 size = bounds.high - bounds.low;
    const bool around = glm::all(glm::lessThanEqual(bounds.low - margin, at)) &&
                        glm::all(glm::lessThanEqual(at, bounds.high + margin));
    if (around && std::max({size.x, size.y, size.z}) <= largest_body_m)
      return &site.scene.objects[surface];
  }
  return nullptr;
}

/// Whether people walk at this height near a place: a roof may be an escape route.
bool people_walk_near(const SceneDescription& scene, const glm::dvec3& place, double floor_m) {
  const auto is_close = [&](const glm::dvec3& foot) {
    return std::abs(foot.z - floor_m) < above_ceiling_m &&
           glm::length(glm::dvec2(foot - place)) < roof_way_m;
  };
  for (const EscapeRoute& route : scene.routes)
    for (const Walker& walker : steps_along(route, 1))
      if (is_close(walker.foot)) return true;
  return std::any_of(scene.open_areas.begin(), scene.open_areas.end(), [&](const auto& area) {
    return std::abs(area.z_m - floor_m) < above_ceiling_m;
  });
}

/// Light on a roof that looks to the sky is meant to be there. Emitters look along their -z.
bool looks_up(const Emitter& e) {
  return e.distribution != Distribution::isotropic && e.frame.axes[2].z < -0.5;
}

/// The ceiling above which a place outside is: the object below it, where there is a room under
/// that.
const Object* ceiling_below(const Site& site, const GeometryAccess& access,
                            const glm::dvec3& place) {
  const auto below = solid_ahead(site, access, place, glm::dvec3(0, 0, -1), above_ceiling_m, false);
  if (!below || below->surface >= site.scene.objects.size()) return nullptr;
  glm::dvec3 under = place;
  under.z -= static_cast<double>(below->distance_m);
  if (people_walk_near(site.scene, place, under.z)) return nullptr;
  for (double depth = ceiling_step_m; depth < ceiling_depth_m; depth += ceiling_step_m) {
    under.z -= ceiling_step_m;
    if (site.in_body(access, under)) continue;
    return site.is_outside(access, under) ? nullptr : &site.scene.objects[below->surface];
  }
  return nullptr;
}

/// What is wrong with one emitter's place; sets `stands_outside` if it is outside. `boxes`: of all
/// objects.
std::optional<Finding> wrong_emitter(const Site& site, const GeometryAccess& access,
                                     const std::vector<Bounds>& boxes, uint32_t emitter,
                                     double building_m, char& stands_outside) {
  const Emitter& e = site.scene.emitters[emitter];
  const glm::dvec3 middle = middle_of(e);
  const double large_m = std::max({e.size.x, e.size.y, e.size.z});
  if (building_m > 0 && large_m > times_building * building_m) {
    stands_outside = 1;
    return Finding{
        Severity::warning,
        "unit",
        {e.place, fmt::format("{} is {} large, and the building {}: sizes are in metres",
                              emitter_text(e), length_text(large_m), length_text(building_m))}};
  }
  if (auto far = site.remote.told(emitter_text(e), middle)) {
    stands_outside = 1;
    return Finding{Severity::error, "far", {e.place, *far}};
  }
  Ends ends = ends_of(site, access, emitter, few_rays);
  if (ends.near > few_share) ends = ends_of(site, access, emitter, many_rays);
  if (ends.near > lost_share)
    return Finding{Severity::error,
                   "inside",
                   {e.place, fmt::format("{} lies in a wall or body: {} of its light ends "
                                         "within 2 cm, most of that on {}: move it out",
                                         emitter_text(e), percent_text(ends.near),
                                         surface_text(site, ends.surface))}};
  if (ends.back > 0.5 && site.in_body(access, middle))
    return Finding{Severity::error,
                   "inside",
                   {e.place, fmt::format("{} lies inside {}, where {} of its light ends: "
                                         "move it out",
                                         emitter_text(e), surface_text(site, ends.surface),
                                         percent_text(ends.back))}};
  if (const Object* body = unsaid_body(site, boxes, e, ends))
    return Finding{
        Severity::warning,
        "body",
        {e.place,
         fmt::format(
             "{} sends {} of its light onto {}, at which it is: if that is its body, the "
             "intensities of its file lack that light already, and the body needs "
             "body_of = [\"{}\"]",
             emitter_text(e),
             percent_text(ends.on.at(static_cast<uint32_t>(body - site.scene.objects.data()))),
             object_text(*body), e.name)}};
  if (!site.is_outside(access, middle)) return std::nullopt;
  stands_outside = 1;
  const Object* ceiling = looks_up(e) ? nullptr : ceiling_below(site, access, middle);
  if (ceiling != nullptr)
    return Finding{Severity::error,
                   "outside",
                   {e.place, fmt::format("{} is above the ceiling: {} lies below it, and a room "
                                         "below that; lower it into the room",
                                         emitter_text(e), object_text(*ceiling))}};
  if (ends.close_back > 0.5)
    return Finding{
        Severity::warning,
        "outside",
        {e.place,
         fmt::format("{} stands outside, and {} of its light ends on the outer side "
                     "of {}: is it above the ceiling? Move it into the room",
                     emitter_text(e), percent_text(ends.back), surface_text(site, ends.surface))}};
  return Finding{
      Severity::note,
      "outside",
      {e.place, emitter_text(e) + " stands outside the building, as luminaires at final exits do"}};
}

/// Both shine in the same operation, with the same distribution, in one direction.
bool same_light(const Emitter& a, const Emitter& b) {
  const bool together =
      (a.mains_flux > 0 && b.mains_flux > 0) || (a.emergency_flux > 0 && b.emergency_flux > 0);
  return together && a.web == b.web && a.shape == b.shape && a.distribution == b.distribution &&
         glm::dot(a.frame.axes[2], b.frame.axes[2]) > one_direction;
}

void find_double_emitters(const SceneDescription& scene, Findings& out) {
  const auto& emitters = scene.emitters;
  const auto place = [&](size_t i) {
    return emitters[i].shape == EmitterShape::mesh ? std::nullopt
                                                   : std::optional(emitters[i].frame.origin);
  };
  const auto alike = [&](size_t a, size_t b) { return same_light(emitters[a], emitters[b]); };
  const auto firsts = first_in_same_place(emitters.size(), one_place_m, place, alike);
  for (size_t i = 0; i < emitters.size(); ++i) {
    if (!firsts[i]) continue;
    const Emitter &first = emitters[*firsts[i]], &second = emitters[i];
    out.push_back(
        {Severity::warning,
         "same place",
         {second.place,
          fmt::format("{} stands where {} (line {}) does, at {}: its light counts twice; remove "
                      "one of them",
                      emitter_text(second), emitter_text(first), first.place.line,
                      place_text(second.frame.origin))}});
  }
}

// ---- places that are judged ---------------------------------------------------------------------

/// Spacing of points of calculation, and their height above a floor [m].
constexpr double grid_m = 1;
constexpr double above_floor_m = 0.02;
constexpr size_t max_places = 4000;
/// A fiftieth of the 0.5 lx that EN 1838 requires: less counts as dark.
constexpr double min_lx = 0.01;
/// Limits for one route or area: a few dark places may be corners, or a doorway's shadow.
constexpr size_t max_places_of_way = 400;
constexpr double dark_share = 0.05;
/// A place of a route has its floor within this distance below it [m].
constexpr double on_floor_within_m = 0.5;
/// A luminaire farther away is not the missing one [m].
constexpr double could_light_m = 8;
/// Among fewer luminaires with one file, none is exceptional.
constexpr size_t alike_at_least = 3;

std::vector<glm::dvec3> judged_places(const SceneDescription& scene) {
  std::vector<glm::dvec3> all;
  const auto add = [&](const std::vector<glm::dvec3>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const EscapeRoute& route : scene.routes)
    add(places_within(route, route.width_m / 4, grid_m));
  for (const AssessedArea& area : scene.open_areas) add(places_within(area, 0.5, grid_m));
  for (const AssessedArea& area : scene.task_areas) add(places_within(area, 0, grid_m));
  for (glm::dvec3& p : all) p.z += above_floor_m;
  if (all.empty()) return all;
  std::vector<glm::dvec3> out;
  for (const EmphasisPoint& point : scene.emphasis)
    out.push_back(point.position + (point.facing ? *point.facing : glm::dvec3(0, 0, 1)) * 0.05);
  for (const Sign& sign : scene.signs)
    if (sign.lighting == SignLighting::external)
      out.push_back(sign.frame.origin + sign.frame.axes[2] * 0.01);
  const size_t step = all.size() / max_places + 1;
  for (size_t i = 0; i < all.size(); i += step) out.push_back(all[i]);
  return out;
}

/// `furnished`: furniture blocks light; codes also judge rooms without it.
bool lights(const Site& site, const GeometryAccess& access, uint32_t emitter,
            const std::vector<glm::dvec3>& places, bool furnished = true) {
  const CompiledScene& scene = site.building.scene();
  const CompiledEmitter& e = scene.emitters[emitter];
  const double lumens = site.scene.emitters[emitter].emergency_flux;
  const Vec3 middle =
      e.kind == EmitterKind::mesh ? emission_point(e, 0.4_r, 0.4_r, 0.5).position : e.origin;
  return std::any_of(places.begin(), places.end(), [&](const glm::dvec3& place) {
    const Vec3 way = Vec3(site.building.local(place)) - middle;
    const auto distance = static_cast<double>(glm::length(way));
    if (!(distance > 0)) return true;
    const Vec3 direction = way / static_cast<Real>(distance);
    // Round bodies shine from the side that faces the place.
    const bool round = e.kind == EmitterKind::sphere || e.kind == EmitterKind::tube;
    const EmissionPoint point{middle, round ? direction : -e.axes[2]};
    const auto density =
        static_cast<double>(emitted_density(scene, access, emitter, point, direction));
    const double watt_to_lm = site.scene.emitters[emitter].radiometric ? 100 : 1;
    if (lumens * watt_to_lm * density / (distance * distance) < min_lx) return false;
    const Vec3 before = middle + direction * std::min(0.01_r, static_cast<Real>(distance) / 2);
    if (furnished)
      return clear_share(scene, access, site.building.local(place), before, e.body) > 0;
    return !solid_ahead(site, access, place, glm::dvec3(-direction),
                        static_cast<double>(glm::length(before - site.building.local(place))),
                        false, e.body);
  });
}

/// Places of a route or an open area that no emergency luminaire illuminates.
struct DarkPlaces {
  size_t all = 0, dark = 0;
  glm::dvec3 first{0};
};

DarkPlaces dark_places(const Site& site, const std::vector<uint32_t>& luminaires,
                       const std::vector<glm::dvec3>& places) {
  const size_t step = places.size() / max_places_of_way + 1;
  std::vector<glm::dvec3> some;
  for (size_t i = 0; i < places.size(); i += step)
    some.push_back(places[i] + glm::dvec3(0, 0, above_floor_m));
  std::vector<char> dark(some.size(), 0);
  site.building.each(some.size(), [&](const GeometryAccess& access, size_t i) {
    // Routes off their floor or in walls are reported elsewhere.
    if (!solid_ahead(site, access, some[i], glm::dvec3(0, 0, -1), on_floor_within_m) ||
        site.in_body(access, some[i] + glm::dvec3(0, 0, on_floor_within_m)))
      return;
    std::vector<uint32_t> nearest = luminaires;
    const auto away = [&](uint32_t e) {
      return glm::length(middle_of(site.scene.emitters[e]) - some[i]);
    };
    std::sort(nearest.begin(), nearest.end(),
              [&](uint32_t a, uint32_t b) { return away(a) < away(b); });
    dark[i] = std::none_of(nearest.begin(), nearest.end(), [&](uint32_t e) {
      return site.scene.emitters[e].distribution == Distribution::collimated ||
             lights(site, access, e, {some[i]}, false);
    });
  });
  DarkPlaces out{some.size(), 0, {}};
  for (size_t i = 0; i < some.size(); ++i)
    if (dark[i] != 0 && out.dark++ == 0) out.first = some[i];
  return out;
}

/// The nearest luminaire that goes off with the mains, and could be meant to light a dark place.
std::string dark_lamp_near(const SceneDescription& scene, const glm::dvec3& place) {
  const Emitter* nearest = nullptr;
  double least = could_light_m;
  for (const Emitter& e : scene.emitters) {
    const double away = glm::length(middle_of(e) - place);
    if (e.emergency_flux > 0 || !(e.mains_flux > 0) || middle_of(e).z < place.z || away >= least)
      continue;
    least = away;
    nearest = &e;
  }
  if (nearest == nullptr) return "";
  return fmt::format(
      "; {} (line {}) hangs {} from there and fails with the mains: is its "
      "'emergency' missing?",
      emitter_text(*nearest), nearest->place.line, length_text(least));
}

/// Along the middle of a route and both quarters of its width; on stairs on their treads.
std::vector<glm::dvec3> places_on_way(const Site& site, const EscapeRoute& route) {
  const RouteFloor floor(site.building);
  std::vector<glm::dvec3> out;
  for (const double aside : {-route.width_m / 4, 0.0, route.width_m / 4})
    for (const GridLeg& leg : floor.line(route, aside, grid_m))
      out.insert(out.end(), leg.places.begin(), leg.places.end());
  return out;
}

void tell_dark_ways(const Site& site, const std::vector<uint32_t>& luminaires, Findings& out) {
  const auto tell = [&](const std::string& of, const SourcePlace& place, const DarkPlaces& found) {
    if (static_cast<double>(found.dark) <= dark_share * static_cast<double>(found.all)) return;
    out.push_back({Severity::warning,
                   "no emergency light",
                   {place, fmt::format("{} gets no direct light of an emergency luminaire on {} of "
                                       "the {} places that were tried, first at {}{}",
                                       of, found.dark, found.all, place_text(found.first),
                                       dark_lamp_near(site.scene, found.first))}});
  };
  for (const EscapeRoute& route : site.scene.routes)
    tell("route \"" + route.name + "\"", route.place,
         dark_places(site, luminaires, places_on_way(site, route)));
  for (const AssessedArea& area : site.scene.open_areas)
    tell("open area \"" + area.name + "\"", area.place,
         dark_places(site, luminaires, places_within(area, 0.5, grid_m)));
}

}  // namespace

void inspect_odd_ones(const SceneDescription& scene, Findings& out) {
  struct OfFile {
    size_t all = 0, fail = 0;
    const Emitter* first = nullptr;  // of those that go off with the mains
  };
  std::map<std::string, OfFile> files;
  for (const Emitter& e : scene.emitters) {
    if (e.file.empty()) continue;
    OfFile& file = files[e.file];
    ++file.all;
    if (e.emergency_flux > 0) continue;
    if (file.fail++ == 0) file.first = &e;
  }
  for (const auto& [name, file] : files)
    if (file.fail == 1 && file.all >= alike_at_least)
      out.push_back(
          {Severity::note,
           "flux",
           {file.first->place,
            fmt::format("{} fails with the mains, and the other {} of its file \"{}\" are "
                        "emergency luminaires: is its 'emergency' missing?",
                        emitter_text(*file.first), file.all - 1, name)}});
}

void inspect_luminaires(const Site& site, Findings& out, std::vector<char>& outside) {
  const size_t count = site.scene.emitters.size();
  std::vector<std::optional<Finding>> found(count);
  outside.assign(count, 0);
  const std::vector<Bounds> boxes = boxes_of(site.scene);
  const double building_m = building_length(boxes);
  site.building.each(count, [&](const GeometryAccess& access, size_t i) {
    found[i] = wrong_emitter(site, access, boxes, static_cast<uint32_t>(i), building_m, outside[i]);
  });
  for (auto& finding : found)
    if (finding) out.push_back(std::move(*finding));
  find_double_emitters(site.scene, out);
}

void inspect_judged_places(const Site& site, Findings& out) {
  const auto places = judged_places(site.scene);
  if (places.empty()) return;
  const auto luminaires = emergency_luminaires(site.scene);
  if (luminaires.empty()) return;  // reported for the state without any
  tell_dark_ways(site, luminaires, out);
  std::vector<char> useful(luminaires.size(), 0);
  site.building.each(luminaires.size(), [&](const GeometryAccess& access, size_t i) {
    const bool beam = site.scene.emitters[luminaires[i]].distribution == Distribution::collimated;
    useful[i] = beam || lights(site, access, luminaires[i], places) ? 1 : 0;
  });
  for (size_t i = 0; i < luminaires.size(); ++i) {
    if (useful[i] != 0) continue;
    const Emitter& e = site.scene.emitters[luminaires[i]];
    out.push_back({Severity::note,
                   "no judged place",
                   {e.place, emitter_text(e) +
                                 " is an emergency luminaire whose direct light reaches no route, "
                                 "area, point of emphasis or externally lit sign: nothing there "
                                 "is judged"}});
  }
}

void inspect_near_field(const Site& site, const Scenario& scenario, Findings& out) {
  std::vector<NearPlace> places;
  site.building.each(1, [&](const GeometryAccess& access, size_t) {
    const auto sees = [&](const Emitter& luminaire, const glm::dvec3& place) {
      return clear_share(site.building.scene(), access, site.building.local(luminaire.frame.origin),
                         site.building.local(place), luminaire.body) > 0;
    };
    places = near_field_places(site.scene, scenario, sees);
  });
  for (NearPlace& place : places)
    out.push_back({place.judged ? Severity::warning : Severity::note, "near field",
                   std::move(place.problem)});
}

}  // namespace luxodus

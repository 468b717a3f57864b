#include "actors/judge/inspect/doorway.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Half the width of the widest opening that counts as a doorway [m].
constexpr double half_opening_m = 2;
/// Distance from the middle of the thickest wall to a place in front of it [m].
constexpr double before_opening_m = 0.6;
/// The space behind an opening is wider and higher by at least this [m].
constexpr double wider_m = 0.15;
constexpr double max_lintel_m = 3;

struct Clear {
  double width = 0, height = 0;  // the search range if nothing is hit
};

Clear clear_at(const Site& site, const GeometryAccess& access, const glm::dvec3& place,
               const glm::dvec3& aside) {
  const auto clear = [&](const glm::dvec3& direction, double most) {
    const auto met = wall_ahead(site, access, place, direction, most);
    return met ? static_cast<double>(met->distance_m) : most;
  };
  return {clear(aside, half_opening_m) + clear(-aside, half_opening_m),
          clear(glm::dvec3(0, 0, 1), max_lintel_m)};
}

}  // namespace

std::optional<FacedSurface> wall_ahead(const Site& site, const GeometryAccess& access,
                                       const glm::dvec3& from, const glm::dvec3& direction,
                                       double length_m) {
  return first_stop(site.building.scene(), access, site.building.local(from), Vec3(direction),
                    static_cast<Real>(length_m), [&](const FacedSurface& f) {
                      if (f.surface >= site.scene.objects.size() || lets_light_through(f.kind))
                        return true;
                      const Object& object = site.scene.objects[f.surface];
                      return object.door.has_value() || is_furniture(object);
                    });
}

std::optional<Doorway> doorway_at(const Site& site, const GeometryAccess& access,
                                  const glm::dvec3& place, const glm::dvec3& way) {
  const glm::dvec3 aside(-way.y, way.x, 0);
  for (const glm::dvec3& side : {aside, -aside})
    if (!wall_ahead(site, access, place, side, half_opening_m)) return std::nullopt;
  const Clear here = clear_at(site, access, place, aside);
  bool has_lintel = true;
  for (const glm::dvec3& on : {way, -way}) {
    if (wall_ahead(site, access, place, on, before_opening_m)) return std::nullopt;
    const Clear there = clear_at(site, access, place + on * before_opening_m, aside);
    if (there.width < here.width + wider_m) return std::nullopt;
    has_lintel = has_lintel && there.height >= here.height + wider_m;
  }
  return Doorway{here.width, has_lintel ? std::optional(here.height) : std::nullopt};
}

}  // namespace luxodus

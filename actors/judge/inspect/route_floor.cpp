#include "actors/judge/inspect/route_floor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/stair_legs.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

/// The floor is searched within this distance above and below the line. `check` refuses lines
/// farther than 0.3 m from their floor; a tread may be that far above the next lower one.
constexpr double near_line_m = 0.6;
/// Spacing of rays along a line: a tread of 0.25 m gets 25 of them, and its edge is known to 1 cm.
constexpr double ray_step_m = 0.01;
constexpr int max_rays = 20'000;
/// Neighbouring rays on one tread or ramp differ in height by less: 1 mm, and a slope of 14
/// degrees.
constexpr double same_tread_m = 0.001, ramp_slope = 0.25;
/// A narrower part of the floor is no tread but a nosing or an edge [m].
constexpr double narrowest_tread_m = 0.05;
/// A tread of less depth has one point, in its middle: nearer to a riser, light from ahead is cut
/// off [m].
constexpr double ordinary_tread_m = 0.4;
/// A lower step is none but an edge of a finish [m].
constexpr double riser_m = 0.02;
/// A line this close to its floor is on it [m].
constexpr double on_floor_m = 0.001;
/// Legs whose ends differ by less in height are level [m].
constexpr double level_m = 1e-6;

/// Height of the floor at a place of a line; none if there is none near it.
std::optional<double> floor_near(const Building& building, const GeometryAccess& access,
                                 const glm::dvec3& place) {
  const auto& objects = building.scene().description->objects;
  const glm::dvec3 above = place + glm::dvec3(0, 0, near_line_m);
  std::optional<double> foot;
  const auto met = first_stop(building.scene(), access, building.local(above), Vec3(0, 0, -1),
                              static_cast<Real>(2 * near_line_m), [&](const FacedSurface& f) {
                                if (f.surface >= objects.size() || f.kind == MaterialKind::open)
                                  return true;
                                if (!is_furniture(objects[f.surface])) return false;
                                // The bottom of furniture lies in the plane of the floor, and a ray
                                // hits one of the two.
                                if (!f.front) foot = above.z - static_cast<double>(f.distance_m);
                                return true;
                              });
  const auto floor =
      met ? std::optional(above.z - static_cast<double>(met->distance_m)) : std::nullopt;
  return foot && (!floor || *floor < *foot) ? foot : floor;
}

/// Moves the first or the last point of a leg off the riser at which the stairs of its neighbour
/// begin. `tread`: the nearest one of the stairs.
void end_before_riser(GridLeg& leg, bool at_first, const glm::dvec3& tread, const GridLeg& stairs) {
  if (leg.is_stairs() || !stairs.is_stairs()) return;
  glm::dvec3& end = at_first ? leg.places.front() : leg.places.back();
  const glm::dvec3& next = at_first ? leg.places[1] : leg.places[leg.places.size() - 2];
  if (tread.z > end.z + riser_m) end = (end + next) / 2.0;
}

}  // namespace

struct RouteFloor::Profile {
  glm::dvec3 from{0}, way{0};  // horizontal
  double step_m = 0;
  std::vector<std::optional<double>> heights;  // in the middle of each step

  /// A place on the floor; the height is that of the nearest ray.
  glm::dvec3 at(double along_m) const {
    const auto ray = static_cast<size_t>(
        std::clamp(std::floor(along_m / step_m), 0.0, static_cast<double>(heights.size() - 1)));
    return {glm::dvec2(from + way * along_m), heights[ray].value_or(from.z)};
  }

  /// Parts of the floor between risers, by their first ray and the one after the last. A floor
  /// without any riser is one part.
  std::vector<std::pair<size_t, size_t>> parts() const {
    std::vector<std::pair<size_t, size_t>> out;
    for (size_t i = 0; i < heights.size(); ++i) {
      if (!heights[i]) continue;
      const bool goes_on =
          i > 0 && heights[i - 1] &&
          std::abs(*heights[i] - *heights[i - 1]) < same_tread_m + ramp_slope * step_m;
      if (goes_on)
        out.back().second = i + 1;
      else
        out.emplace_back(i, i + 1);
    }
    return out;
  }

  /// Treads; none where there are no risers.
  std::vector<std::pair<size_t, size_t>> treads() const {
    auto out = parts();
    if (out.size() < 2) return {};
    std::erase_if(out, [&](const auto& part) {
      return static_cast<double>(part.second - part.first) * step_m < narrowest_tread_m;
    });
    return out;
  }
};

RouteFloor::Profile RouteFloor::profile(const glm::dvec3& from, const glm::dvec3& to) const {
  Profile out;
  out.from = from;
  const double length = glm::length(glm::dvec2(to - from));
  out.way = glm::dvec3(glm::dvec2(to - from) / length, 0);
  const int rays = std::clamp(static_cast<int>(std::ceil(length / ray_step_m)), 1, max_rays);
  out.step_m = length / rays;
  out.heights.resize(static_cast<size_t>(rays));
  building_.each(out.heights.size(), [&](const GeometryAccess& access, size_t i) {
    const double share = (static_cast<double>(i) + 0.5) / rays;
    out.heights[i] = floor_near(building_, access, glm::mix(from, to, share));
  });
  return out;
}

GridLeg RouteFloor::leg(const glm::dvec3& from, const glm::dvec3& to, double aside_m,
                        double spacing_m) const {
  GridLeg out{along_leg(from, to, aside_m, spacing_m), {}};
  if (std::abs(to.z - from.z) < level_m) return out;
  const Profile floor = profile(out.places.front(), out.places.back());
  const auto treads = floor.treads();
  if (treads.empty()) {
    for (glm::dvec3& place : out.places) {
      const double along = glm::length(glm::dvec2(place - floor.from));
      const auto ray =
          std::min(floor.heights.size() - 1, static_cast<size_t>(along / floor.step_m));
      const auto height = floor.heights[ray];
      if (height && std::abs(*height - place.z) > on_floor_m + ramp_slope * floor.step_m)
        place.z = *height;
    }
    return out;
  }
  out.places.clear();
  for (const auto& [first, end] : treads) {
    const double low = static_cast<double>(first) * floor.step_m;
    const double depth = static_cast<double>(end - first) * floor.step_m;
    const int n = depth < ordinary_tread_m ? 1 : pieces_of(depth, spacing_m);
    for (int k = 0; k < n; ++k) {
      out.places.push_back(floor.at(low + depth * (k + 0.5) / n));
      out.riser_follows.push_back(k + 1 == n ? 1 : 0);
    }
  }
  return out;
}

GridLine RouteFloor::line(const EscapeRoute& route, double aside_m, double spacing_m) const {
  GridLine out;
  for (size_t i = 1; i < route.path.size(); ++i)
    out.push_back(leg(route.path[i - 1], route.path[i], aside_m, spacing_m));
  for (size_t i = 0; i + 1 < out.size(); ++i) {
    end_before_riser(out[i], false, out[i + 1].places.front(), out[i + 1]);
    end_before_riser(out[i + 1], true, out[i].places.back(), out[i]);
  }
  return out;
}

std::vector<FlightOfRoute> RouteFloor::flights_of(const EscapeRoute& route) const {
  std::vector<FlightOfRoute> out;
  for (size_t i = 1; i < route.path.size(); ++i) {
    const glm::dvec3 from = route.path[i - 1], to = route.path[i];
    if (!climbs_stairs(from, to)) continue;
    FlightOfRoute flight{flight_name(route, out.size() + 1), {}};
    const Profile floor = profile(from, to);
    for (const auto& [first, end] : floor.treads())
      flight.treads.push_back(floor.at(static_cast<double>(first + end) / 2 * floor.step_m));
    if (flight.treads.empty()) flight.treads = treads_on_line(from, to);
    out.push_back(std::move(flight));
  }
  return out;
}

}  // namespace luxodus

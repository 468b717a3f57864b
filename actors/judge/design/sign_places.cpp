// A route is followed leg by leg at the height of the sign. Walls that the line meets are lintels
// over doors or walls at ends of legs; a sign hangs on each, facing the walker. On both sides of it
// there are two more places if the wall is flat there.
#include "actors/judge/design/sign_places.hpp"

#include <algorithm>
#include <cmath>

#include "actors/judge/design/candidates.hpp"
#include "actors/judge/design/wall_probe.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace {

/// Largest distance to a wall beyond the end of a leg [m].
constexpr double ahead_m = 12;
/// Thickest wall behind which the line continues, and step through the wall [m].
constexpr double thickest_wall_m = 1, wall_step_m = 0.1;
/// Distance from the middle of a doorway to the edge of a sign beside it [m].
constexpr double beside_door_m = 0.6;
/// Gap between a sign and the wall behind it, or the ceiling above it [m].
constexpr double gap_m = 0.005, below_ceiling_m = 0.02;
/// Distance before a wall from which it is examined [m].
constexpr double before_wall_m = 0.5;
/// A wall is flat if its points behind a sign lie in one plane to this [m].
constexpr double flat_m = 0.01;
/// Walls at a larger angle to the line hold no sign for the walker [tangent of 40 degrees].
constexpr double max_aslant = 0.84;
/// Largest distance of a ceiling above a sign [m].
constexpr double highest_ceiling_m = 50;
/// Signs closer than this with equal facing are at one place [m].
constexpr double one_sign_place_m = 0.3;
/// Legs shorter than this in plan have no direction [m].
constexpr double level_leg_m = 0.05;

const glm::dvec3 upwards(0, 0, 1);

class SignSpotFinder {
 public:
  SignSpotFinder(const SceneDescription& scene, const DesignSettings& design, const Sign& sign,
                 const Building& bare, const Building& furnished, SignsLeftOut& left_out)
      : scene_(scene),
        design_(design),
        sign_(sign),
        bare_(bare),
        furnished_(furnished),
        left_out_(left_out) {}

  std::vector<SignSpot> find() {
    bare_.each(1, [&](const GeometryAccess& access, size_t) {
      for (route_ = 0; route_ < scene_.routes.size(); ++route_)
        for (size_t i = 1; i < scene_.routes[route_].path.size(); ++i)
          follow_leg(access, scene_.routes[route_], i);
    });
    keep_free();
    return std::move(spots_);
  }

 private:
  double middle_m() const { return design_.sign_height_m + sign_.height_m / 2; }

  void follow_leg(const GeometryAccess& access, const EscapeRoute& route, size_t i) {
    const glm::dvec3 from = route.path[i - 1], to = route.path[i];
    glm::dvec3 level = to - from;
    level.z = 0;
    if (glm::length(level) < level_leg_m) return;
    level = glm::normalize(level);
    follow(access, from, to, level);
    follow(access, to, to + level * ahead_m, level, true);
    EscapeRoute leg = route;
    leg.path = {from, to};
    for (const glm::dvec3& floor : along(leg, 0, design_.sign_spacing_m))
      hang(access, floor, -level);
  }

  /// Finds walls on a line above the floor from `from` to `to`; with `first_alone` only the first.
  void follow(const GeometryAccess& access, const glm::dvec3& from, const glm::dvec3& to,
              const glm::dvec3& level, bool first_alone = false) {
    const glm::dvec3 raised(0, 0, middle_m());
    const glm::dvec3 way = to - from;
    const double length = glm::length(way);
    const glm::dvec3 direction = way / length;
    double gone = 0;
    while (gone < length) {
      const auto met = stop_at(access, from + raised + direction * gone, direction, length - gone);
      if (!met) return;
      const glm::dvec3 wall = from + raised + direction * (gone + *met);
      put_on_wall(access, wall, level, SignMount::above);
      const glm::dvec3 aside = glm::cross(upwards, level) * (beside_door_m + sign_.width_m / 2);
      put_on_wall(access, wall + aside, level, SignMount::beside);
      put_on_wall(access, wall - aside, level, SignMount::beside);
      if (first_alone) return;
      gone += *met + wall_step_m;
      for (double in = 0; in < thickest_wall_m && gone < length; in += wall_step_m) {
        if (!bare_.in_solid(access, from + raised + direction * gone)) break;
        gone += wall_step_m;
      }
    }
  }

  std::optional<double> stop_at(const GeometryAccess& access, const glm::dvec3& from,
                                const glm::dvec3& direction, double length_m) const {
    return wall_distance(bare_, access, from, direction, length_m);
  }

  /// Lowers the sign to fit below the ceiling. False if there is no ceiling.
  bool fit_below_ceiling(const GeometryAccess& access, glm::dvec3& middle,
                         const glm::dvec3& before) const {
    // Measured from below the sign: at its height there may be no free space.
    const double low = middle_m();
    const auto up = stop_at(access, before - glm::dvec3(0, 0, low / 2), upwards, highest_ceiling_m);
    if (!up) return false;
    const double highest = before.z - low / 2 + *up - below_ceiling_m - sign_.height_m / 2;
    middle.z = std::min(middle.z, highest);
    return true;
  }

  /// `wall`: approximate point of the wall, met along `level`.
  void put_on_wall(const GeometryAccess& access, glm::dvec3 wall, const glm::dvec3& level,
                   SignMount mount) {
    const glm::dvec3 before = wall - level * before_wall_m;
    fit_below_ceiling(access, wall, before);
    const glm::dvec3 across = glm::cross(upwards, level);
    const glm::dvec3 eye(before.x, before.y, wall.z);
    // Distances to the wall behind the edges; columns: left, middle, right.
    std::array<double, 3> depth{};
    for (int column = 0; column < 3; ++column) {
      const glm::dvec3 aside = eye + across * ((column - 1) * sign_.width_m / 2);
      const glm::dvec3 half = upwards * (sign_.height_m / 2);
      const double reach = 2 * before_wall_m + sign_.width_m;
      const auto below = stop_at(access, aside - half, level, reach);
      const auto above = stop_at(access, aside + half, level, reach);
      if (!below || !above || std::abs(*above - *below) > flat_m) return void(++left_out_.no_room);
      depth[static_cast<size_t>(column)] = (*below + *above) / 2;
    }
    const double slope = (depth[2] - depth[0]) / sign_.width_m;
    if (std::abs(depth[0] + depth[2] - 2 * depth[1]) > flat_m || std::abs(slope) > max_aslant)
      return void(++left_out_.no_room);
    const glm::dvec3 along_wall = glm::normalize(across + level * slope);
    glm::dvec3 facing = glm::cross(along_wall, upwards);
    if (glm::dot(facing, level) > 0) facing = -facing;
    offer(access, eye + level * depth[1] + facing * (sign_.thickness_m / 2 + gap_m), facing, mount);
  }

  void hang(const GeometryAccess& access, const glm::dvec3& floor, const glm::dvec3& facing) {
    glm::dvec3 middle = floor + glm::dvec3(0, 0, middle_m());
    if (!fit_below_ceiling(access, middle, middle)) return void(++left_out_.no_room);
    const glm::dvec3 across = glm::cross(upwards, facing);
    for (const double side : {-1.0, 1.0})
      if (stop_at(access, middle, across * side, sign_.width_m / 2 + gap_m))
        return void(++left_out_.no_room);
    offer(access, middle, facing, SignMount::hanging);
  }

  /// Adds a place, rounded to a millimetre, if the sign fits there.
  void offer(const GeometryAccess& access, const glm::dvec3& middle, const glm::dvec3& facing,
             SignMount mount) {
    SignSpot spot{told_place(middle), told_direction(facing), mount, {route_}};
    constexpr double alike = 0.9;  // cosine
    for (SignSpot& other : spots_) {
      if (glm::length(other.position - spot.position) >= one_sign_place_m ||
          glm::dot(other.facing, spot.facing) < alike)
        continue;
      if (other.of_routes.back() != route_) other.of_routes.push_back(route_);
      return;
    }
    if (is_within_bodies(bare_, access, spot)) return void(++left_out_.no_room);
    spots_.push_back(spot);
  }

  /// Whether a corner of the sign, or the middle of a long edge, is inside a body.
  bool is_within_bodies(const Building& building, const GeometryAccess& access,
                        const SignSpot& spot) const {
    const Sign sign = sign_at(sign_, spot);
    for (const double u : {-0.5, 0.0, 0.5})
      for (const double v : {-0.5, 0.5})
        if (building.in_solid(access, spot.position + sign.frame.axes[0] * (u * sign.width_m) +
                                          sign.frame.axes[1] * (v * sign.height_m)))
          return true;
    return building.in_solid(access, spot.position);
  }

  /// Removes places in furniture, in keep-out zones, and at signs that stay.
  void keep_free() {
    std::vector<char> good(spots_.size(), 1);
    furnished_.each(spots_.size(), [&](const GeometryAccess& access, size_t i) {
      good[i] = is_within_bodies(furnished_, access, spots_[i]) ? 0 : 1;
    });
    std::vector<SignSpot> out;
    for (size_t i = 0; i < spots_.size(); ++i) {
      const glm::dvec3& p = spots_[i].position;
      const bool taken = std::any_of(scene_.signs.begin(), scene_.signs.end(), [&](const Sign& s) {
        return glm::length(s.frame.origin - p) < (s.width_m + sign_.width_m) / 2;
      });
      if (good[i] == 0)
        ++left_out_.no_room;
      else if (kept_out(scene_, design_, p))
        ++left_out_.keep_out;
      else if (taken)
        ++left_out_.near_signs;
      else
        out.push_back(spots_[i]);
    }
    spots_ = std::move(out);
  }

  const SceneDescription& scene_;
  const DesignSettings& design_;
  const Sign& sign_;
  const Building& bare_;
  const Building& furnished_;
  SignsLeftOut& left_out_;
  size_t route_ = 0;  // the route being followed
  std::vector<SignSpot> spots_;
};

}  // namespace

std::vector<SignSpot> sign_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Sign& sign, const Building& bare, const Building& furnished,
                                 SignsLeftOut& left_out) {
  return SignSpotFinder(scene, design, sign, bare, furnished, left_out).find();
}

Sign sign_at(const Sign& type, const SignSpot& spot) {
  Sign out = type;
  out.frame = frame_facing(spot.position, spot.facing, {0, 0, 1}).value();
  return out;
}

}  // namespace luxodus

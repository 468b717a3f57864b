// Floors to walk on, and the exact length of a shortest way past two corners. Any thread.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "actors/judge/walk/wall_check.hpp"
#include "actors/judge/walkers/free_space.hpp"
#include "tests/kit/described.hpp"

namespace luxodus::test {

/// A closed room with its floor at z = 0, 3 m high.
inline std::string room_text(double x, double y) {
  return fmt::format(
      "\n[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [{}, {}, 3]\n"
      "material = \"grey50\"\n",
      x, y);
}

/// A box in it.
inline std::string box_text(const std::string& name, const glm::dvec3& low, const glm::dvec3& high,
                            const std::string& more = "") {
  return fmt::format(
      "\n[[object]]\nname = \"{}\"\nshape = \"box\"\nlow = [{}, {}, {}]\nhigh = [{}, {}, {}]\n"
      "material = \"grey50\"\n{}",
      name, low.x, low.y, low.z, high.x, high.y, high.z, more);
}

inline std::string route_text(const std::string& name, const std::string& path) {
  return fmt::format("\n[[route]]\nname = \"{}\"\npath = {}\nwidth = 1\n", name, path);
}

/// A lamp, since a scene needs light, and a state.
inline const std::string mains_text =
    "\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\ndistribution = \"isotropic\"\nposition = "
    "[1, 1, 2.9]\nflux_lm = 300\n[[scenario]]\nname = \"mains\"\noperation = \"mains\"\n";

/// A described floor with its walls; the space is made of them.
struct Floor {
  explicit Floor(const std::string& text, double cell_m = 0.1, double floor_m = 0)
      : scene(described_text(text + mains_text)) {
    auto made = walls_alone(*scene, scene->scenarios.front(), 1);
    if (!made) UNSCOPED_INFO(made.problem().text());
    REQUIRE(made.ok());
    auto free = FreeSpace::make(*made.value(),
                                {.floor_m = floor_m, .radius_m = body_radius_m, .cell_m = cell_m});
    if (!free) UNSCOPED_INFO(free.problem().text());
    REQUIRE(free.ok());
    space.emplace(std::move(free).value());
  }
  CellNumber cell(double x, double y) const {
    const auto out = space->nearest_free({x, y}, 0.2);
    REQUIRE(out);
    return *out;
  }
  std::shared_ptr<const SceneDescription> scene;
  std::optional<FreeSpace> space;
};

/// Length of the shortest way of a disc from one point to another, left round two corners: straight
/// to a circle about the first, along it, straight to the circle about the second, and so on. Both
/// corners may be the same.
inline double way_round(const glm::dvec2& from, const glm::dvec2& first, const glm::dvec2& second,
                        const glm::dvec2& to, double radius_m) {
  const auto heading = [](const glm::dvec2& v) { return std::atan2(v.y, v.x); };
  const double d1 = glm::distance(from, first), d2 = glm::distance(second, to);
  // Headings of the straight parts; the way turns clockwise and keeps the corners on its right.
  const double h1 = heading(first - from) + std::asin(radius_m / d1);
  const double h2 = heading(to - second) - std::asin(radius_m / d2);
  const double turned = std::remainder(h1 - h2, 2 * std::numbers::pi);
  return std::sqrt(d1 * d1 - radius_m * radius_m) + glm::distance(first, second) +
         std::sqrt(d2 * d2 - radius_m * radius_m) + radius_m * turned;
}

}  // namespace luxodus::test

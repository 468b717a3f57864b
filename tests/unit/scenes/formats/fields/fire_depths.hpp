// Optical depths along lines and extinctions at points of a fire that was read, as the tracer finds
// them. For tests; any thread.
#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/light/optics/media_set.hpp"

namespace luxodus::test {

struct ResidentMedia {
  const MediaSet& set;
  const Brick& brick(int medium, int brick) { return set.brick(medium, brick); }
};

/// The smoke of a fire, compiled as a scene's.
inline MediaSet compiled_smoke(const LoadedFire& fire) {
  std::vector<Medium> media;
  for (const FireGrid& grid : fire.grids) {
    Medium m;
    m.name = "smoke";
    m.kind = MediumKind::data_set;
    m.data = grid.data;
    m.frame.origin = grid.origin;
    media.push_back(std::move(m));
  }
  std::vector<MediumInput> inputs;
  for (const Medium& m : media) inputs.push_back({&m, 1, nullptr});
  auto set = MediaSet::compile(
      inputs, 1, [](const Spectrum& s, int) { return s.value[0]; }, glm::dvec3(0));
  REQUIRE(set.ok());
  return std::move(set.value());
}

inline double depth_along(const MediaSet& set, const glm::dvec3& from, const glm::dvec3& to) {
  ResidentMedia bricks{set};
  const double length = glm::length(to - from);
  return optical_depth<MediaNeed::general>(set, 0, Vec3(from), Vec3((to - from) / length),
                                           static_cast<Real>(length), bricks);
}

/// Extinction at a place [1/m].
inline double extinction_at(const LoadedFire& fire, const glm::dvec3& place) {
  double sum = 0;
  for (const FireGrid& grid : fire.grids) {
    const glm::ivec3 n(grid.data.nx, grid.data.ny, grid.data.nz);
    const glm::dvec3 at = (place - grid.origin) / grid.data.extent * glm::dvec3(n);
    const glm::ivec3 cell(glm::floor(at));
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, n)))
      continue;
    sum += static_cast<double>(
        grid.data.extinction[static_cast<size_t>((cell.z * n.y + cell.y) * n.x + cell.x)]);
  }
  return sum;
}

}  // namespace luxodus::test

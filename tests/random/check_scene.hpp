// Properties of every scene: it is compiled or refused in one sentence; every unit of weight is
// accounted for; every result is finite, and negative only where allowed; no bin gets more light
// than there is; walls are opaque; all ways of tracing give equal bits. Any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/light/intersect/embree_scene.hpp"
#include "tests/random/random_scene.hpp"

namespace luxodus::test {

namespace limits {
/// Rays of one batch after which no further particle is started: limits a scene's work.
inline constexpr uint64_t rays_per_batch = 1 << 13;
/// Scores and triangles up to which a scene is traced in a test; larger ones are only compiled.
inline constexpr int64_t scores_checked = 1 << 22;
inline constexpr uint64_t triangles_checked = 1 << 16;
}  // namespace limits

struct Verdict {
  bool accepted = false;
  std::string refusal;                // why it was refused, without its names and numbers
  std::vector<std::string> findings;  // properties that do not hold; empty if all hold
  uint64_t rays = 0;
};

/// Also traces it in other ways and compares, if `number` is a multiple of certain numbers.
Verdict check_scene(const RandomScene& scene, uint64_t number, const EmbreeDevice& device);

/// A refusal without the parts that differ between scenes.
std::string kind_of_refusal(const std::string& what);

}  // namespace luxodus::test

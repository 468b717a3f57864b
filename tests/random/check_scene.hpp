// What must hold of any scene at all: it is compiled or refused in one sentence; every unit of
// weight is accounted for; every result is finite, and negative only where it may be; nothing gets
// more than there is; walls hold; the same bits come out whoever traces. Any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/light/intersect/embree_scene.hpp"
#include "tests/random/random_scene.hpp"

namespace luxodus::test {

namespace limits {
/// Rays of one batch after which no further particle is begun: what bounds a scene's work.
inline constexpr uint64_t rays_per_batch = 1 << 13;
/// Scores and triangles of a scene that is worth a test's time; others are compiled alone.
inline constexpr int64_t scores_checked = 1 << 22;
inline constexpr uint64_t triangles_checked = 1 << 16;
}  // namespace limits

struct Verdict {
  bool accepted = false;
  std::string refusal;                // where it is not: why, without its names and numbers
  std::vector<std::string> findings;  // what does not hold; empty where all is well
  uint64_t rays = 0;
};

/// Also traces it by other ways and compares, where `number` is a multiple of some.
Verdict check_scene(const RandomScene& scene, uint64_t number, const EmbreeDevice& device);

/// A refusal without what differs from scene to scene.
std::string kind_of_refusal(const std::string& what);

}  // namespace luxodus::test

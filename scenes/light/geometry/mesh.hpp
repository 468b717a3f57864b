// A triangle mesh as read or generated, in double precision and scene coordinates [m]. The tracer
// does not use it: compiling a scene moves it to a local origin and converts it to float. Plain
// values; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace luxodus {

struct Mesh {
  std::vector<glm::dvec3> positions;  // [m]
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from the front
  std::vector<glm::vec2> texture_uv;  // one per position, or empty
};

struct Bounds {
  glm::dvec3 low{1e300};
  glm::dvec3 high{-1e300};

  bool empty() const { return low.x > high.x; }
  void extend(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void extend(const Bounds& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
};

}  // namespace luxodus

// A room in smoke with two lamps, one behind a screen, seen by two cameras; and comparison of
// pictures bit for bit.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus::test {

/// `width`: of the first picture [px].
inline std::string smoky_room(const std::string& width) {
  return R"(
[run]
voxel_edge_m = 0.5
max_bands = 2
[[material]]
name = "ochre"
reflectance = [[400, 0.3], [700, 0.7]]
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [3, 3, 2.5]
material = "ochre"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.5
albedo = 0.8
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [1.5, 1.5, 2.4]
flux_lm = 1000
[[object]]
name = "screen"
shape = "box"
low = [1.9, 0.3, 0]
high = [2, 1.1, 1.6]
material = "ochre"
[[emitter]]
name = "lamp behind it"
shape = "point"
distribution = "isotropic"
position = [2.4, 0.7, 1]
flux_lm = 300
[[camera]]
name = "view"
eye = [0.5, 1.2, 1.2]
target = [3, 2, 1.1]
height = 11
width = )" +
         width + R"(
[[camera]]
name = "other"
eye = [2.5, 1.2, 1.2]
target = [0, 2, 1.1]
height = 9
width = 12
)";
}

inline void check_same(const TracedPicture& a, const TracedPicture& b) {
  CHECK(a.light.xyz == b.light.xyz);
  CHECK(a.light.scotopic == b.light.scotopic);
  CHECK(a.standard_error_y == b.standard_error_y);
  CHECK(a.flux_error_y == b.flux_error_y);
  CHECK(a.emitted == b.emitted);
  CHECK(a.noisy.features == b.noisy.features);
  for (const size_t h : {size_t{0}, size_t{1}}) {
    CHECK(a.noisy.half[h].light == b.noisy.half[h].light);
    CHECK(a.noisy.half[h].variance == b.noisy.half[h].variance);
  }
}

}  // namespace luxodus::test

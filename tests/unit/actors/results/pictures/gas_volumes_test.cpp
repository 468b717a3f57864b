// The part of a voxel that one room's gas fills.
#include "actors/results/pictures/gas_volumes.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "scenes/light/transport/detectors.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Voxels of half a metre from the corner of a room, which ends 0.1 m into the uppermost ones. A
/// box stands in one voxel; a wall without thickness lies along a face of voxels (x = 2), and one
/// in the middle of others (x = 3.25), each with light on both sides.
const char* const room = R"(
[run]
voxel_edge_m = 0.5
max_bands = 1
[[material]]
name = "grey"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [5, 2, 2.1]
material = "grey"
[[object]]
name = "post"
shape = "box"
low = [0.6, 0.6, 0.5]
high = [0.85, 0.9, 1]
material = "grey"
[[object]]
name = "along a face"
shape = "quad"
corner = [2, 0, 0]
edge_u = [0, 2, 0]
edge_v = [0, 0, 2.1]
material = "grey"
back_material = "grey"
[[object]]
name = "through voxels"
shape = "quad"
corner = [3.25, 0, 0]
edge_u = [0, 2, 0]
edge_v = [0, 0, 2.1]
material = "grey"
back_material = "grey"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.5
albedo = 0.5
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.2, 0.2]
position = [1.5, 1, 2]
flux_lm = 1000
)";

struct Found {
  std::unique_ptr<LocalRun> run;
  LitGas gas;

  size_t voxel(double x, double y, double z) const {
    const CompiledScene& scene = run->scene();
    return voxel_of(scene.voxels, Vec3(glm::dvec3(x, y, z) - scene.local_origin));
  }
  double share(double x, double y, double z) const {
    return static_cast<double>(gas.share[voxel(x, y, z)]);
  }
  bool open(double x, double y, double z, int axis) const {
    return (gas.open[voxel(x, y, z)] >> axis & 1) != 0;
  }
};

/// All voxels are lit, and all sides except the insides of solids.
Found find() {
  Found out{traced(room, 1 << 10), {}};
  const CompiledScene& scene = out.run->scene();
  const LitPlaces lit{[](uint32_t) { return true; },
                      [&](const TriangleRecord& t, bool front) {
                        const std::string& name = scene.surfaces[t.surface].name;
                        const bool solid = name.rfind("room", 0) == 0 || name.rfind("post", 0) == 0;
                        return front || !solid ? 100.0 : 0.0;
                      }};
  auto gas = find_lit_gas(scene, lit, 2);
  REQUIRE(gas.ok());
  out.gas = std::move(gas).value();
  return out;
}

}  // namespace

TEST_CASE("a voxel's gas is its cube minus solids", "[display]") {
  const Found found = find();
  CHECK(found.share(1.2, 1.2, 1.2) == 1);
  CHECK(found.share(1.2, 1.2, 0.2) == Approx(1).margin(0.01));                // on the floor
  CHECK(found.share(1.2, 1.2, 2.05) == Approx(0.2).margin(0.02));             // under the ceiling
  CHECK(found.share(0.95, 0.95, 0.7) == Approx(1 - 0.5 * 0.6).margin(0.02));  // around the post
}

TEST_CASE("a voxel divided by a wall is not known, one beside a wall is", "[display]") {
  const Found found = find();
  CHECK(found.share(3.1, 1.2, 1.2) == 0);
  CHECK(found.share(1.8, 1.2, 1.2) == Approx(1).margin(0.01));
  CHECK(found.share(2.2, 1.2, 1.2) == Approx(1).margin(0.01));
  CHECK_FALSE(found.open(1.8, 1.2, 1.2, 0));  // through the wall
  CHECK(found.open(1.8, 1.2, 1.2, 1));        // along it
  CHECK(found.open(1.2, 1.2, 1.2, 2));
}

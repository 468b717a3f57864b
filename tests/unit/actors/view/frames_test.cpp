// What frames for the page hold.
#include "actors/view/frames.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "tests/unit/actors/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string flame = R"(
[[medium]]
name = "fire"
kind = "bounded"
body = "cone"
position = [3, 2, 0.5]
radius = 0.3
height = 1
extinction = 1
albedo = 0
emission = { power_w = 1000, temperature_k = 1800 }
)";

/// Lumens that all voxels of a frame send out.
double lumens_in(const LiveFrame& frame, const VoxelGrid& grid) {
  constexpr double of_channel[] = {0.2126, 0.7152, 0.0722};
  const size_t head = sizeof(FrameHead);
  REQUIRE(frame->size() == head + size_t{grid.count()} * 3 * sizeof(uint16_t));
  double sum = 0;
  for (size_t i = 0; i < size_t{grid.count()} * 3; ++i) {
    uint16_t half;
    std::memcpy(&half, frame->data() + head + i * sizeof half, sizeof half);
    sum += of_channel[i % 3] * static_cast<double>(glm::unpackHalf1x16(half));
  }
  const auto edge = static_cast<double>(grid.edge);
  return sum * 4 * std::numbers::pi * edge * edge * edge;
}

}  // namespace

TEST_CASE("a flame's own light is in the voxels that it is in", "[view]") {
  const LiveRoom room(flame);
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  const CompiledScene& scene = run.scene();
  int group = -1;
  double lumens = 0;
  for (const CompiledEmitter& e : scene.emitters)
    if (e.kind == EmitterKind::volume) {
      group = e.group;
      lumens = e.luminous_flux_lm;
    }
  REQUIRE(group >= 0);
  REQUIRE(lumens > 0);
  ThreadExecutor threads(1);
  CHECK(run.trace(
      2, LiveRun::Scope::all, threads, [] { return LiveRun::Stop::none; }, [] {}));
  run.tell(run.news());
  const auto geometry = geometry_of(scene, 1);
  REQUIRE(geometry.ok());
  // Nothing scatters, so no other group has light in the air.
  const auto frames = light_frames(run, geometry->patches, 1, {group, left});
  REQUIRE(frames.size() == 4);
  CHECK(lumens_in(frames[2], scene.voxels) == Approx(lumens).epsilon(0.01));
  CHECK(lumens_in(frames[3], scene.voxels) == 0);
}

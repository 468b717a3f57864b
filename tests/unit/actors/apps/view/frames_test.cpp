// The content of frames for the page.
#include "actors/apps/view/frames.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "scenes/light/transport/flame_moment.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

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

/// What smoke of one kind, in all of the room, scatters.
const std::string haze = R"(
[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.3
albedo = 0.8
phase = "hg"
g = 0.7
)";

constexpr double of_channel[] = {0.2126, 0.7152, 0.0722};

/// The half floats of a frame.
std::vector<double> halves_of(const LiveFrame& frame) {
  std::vector<double> out((frame->size() - sizeof(FrameHead)) / sizeof(uint16_t));
  for (size_t i = 0; i < out.size(); ++i) {
    uint16_t half;
    std::memcpy(&half, frame->data() + sizeof(FrameHead) + i * sizeof half, sizeof half);
    out[i] = static_cast<double>(glm::unpackHalf1x16(half));
  }
  return out;
}

/// A voxel of a frame of light in smoke.
struct SmokeGlow {
  double luminance = 0;  // of a metre, as the mean over directions
  glm::dvec3 beam{0};
};
std::vector<SmokeGlow> glows_of(const LiveFrame& frame, const VoxelGrid& grid) {
  const std::vector<double> halves = halves_of(frame);
  REQUIRE(halves.size() == size_t{grid.count()} * 6);
  std::vector<SmokeGlow> out(grid.count());
  for (size_t i = 0; i < out.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) out[i].luminance += of_channel[c] * halves[6 * i + c];
    out[i].beam = {halves[6 * i + 3], halves[6 * i + 4], halves[6 * i + 5]};
  }
  return out;
}

/// Lumens emitted by all voxels of a frame.
double lumens_in(const LiveFrame& frame, const VoxelGrid& grid) {
  double sum = 0;
  for (const SmokeGlow& glow : glows_of(frame, grid)) sum += glow.luminance;
  const auto edge = static_cast<double>(grid.edge);
  return sum * 4 * std::numbers::pi * edge * edge * edge;
}

/// The run of a room, traced so far.
void trace_some(LiveRun& run, int64_t level) {
  ThreadExecutor threads(1);
  CHECK(run.trace(
      level, LiveRun::Scope::all, threads, [] { return LiveRun::Stop::none; }, [] {}));
  run.tell(run.news());
}

}  // namespace

TEST_CASE("a flame has its shape and its light, and voxels do not repeat its glow", "[view]") {
  const LiveRoom room(flame);
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  const CompiledScene& scene = run.scene();
  double lumens = 0;
  for (const CompiledEmitter& e : scene.emitters)
    if (e.kind == EmitterKind::volume) lumens = e.luminous_flux_lm;
  REQUIRE(lumens > 0);
  const LiveSmoke smoke = smoke_of(scene, run.index(), 1);
  REQUIRE(smoke.flames->size() == 1);
  const LiveFlame& shown = smoke.flames->front();
  CHECK(shown.group == group_of_flame("fire"));
  // A cone of 1 m over a disc of 0.3 m: within its box, and wide at the bottom, narrow at the top.
  CHECK(shown.low.z == Approx(0.5).margin(0.1));
  CHECK(shown.size.z == Approx(1).margin(0.15));
  CHECK(shown.size.x == Approx(0.6).margin(0.1));
  REQUIRE(shown.cells.size() == static_cast<size_t>(shown.count.x) *
                                    static_cast<size_t>(shown.count.y) *
                                    static_cast<size_t>(shown.count.z));
  const auto lit_at = [&](int z) {
    int cells = 0;
    for (int i = 0; i < shown.count.x * shown.count.y; ++i)
      if (shown.cells[static_cast<size_t>(z * shown.count.x * shown.count.y + i)] != 0) ++cells;
    return cells;
  };
  CHECK(lit_at(2) > 4 * lit_at(shown.count.z - 4));
  double sum = 0;
  for (const char byte : shown.cells) sum += static_cast<unsigned char>(byte);
  const glm::dvec3 cell = shown.size / glm::dvec3(shown.count);
  double luminance = 0;
  for (size_t c = 0; c < 3; ++c) luminance += of_channel[c] * shown.colour[c];
  CHECK(luminance * sum / 255 * cell.x * cell.y * cell.z * 4 * std::numbers::pi ==
        Approx(lumens).epsilon(0.01));
  // What its shape at a moment follows from.
  REQUIRE(shown.shape);
  CHECK(shown.shape->low.z == Approx(0.5));
  CHECK(shown.shape->size.x == Approx(0.6));
  CHECK(shown.shape->size.z == Approx(1));
  CHECK(shown.shape->extinction_per_m == Approx(1));
  CHECK(shown.shape->seed == steady_flames(scene).front().seed);
  trace_some(run, 2);
  const auto geometry = geometry_of(scene, 1);
  REQUIRE(geometry.ok());
  // Nothing scatters, so no group has light in the air.
  int group = -1;
  for (const CompiledEmitter& e : scene.emitters)
    if (e.kind == EmitterKind::volume) group = e.group;
  const auto frames = light_frames(run, geometry->patches, smoke, 1, {group, left});
  REQUIRE(frames.size() == 4);
  CHECK(lumens_in(frames[2], scene.voxels) == 0);
  CHECK(lumens_in(frames[3], scene.voxels) == 0);
  // A flame that is not shown separately glows in its voxels.
  LiveSmoke none = smoke;
  none.flames = std::make_shared<const std::vector<LiveFlame>>();
  const auto evenly = light_frames(run, geometry->patches, none, 1, {group});
  CHECK(lumens_in(evenly[1], scene.voxels) == Approx(lumens).epsilon(0.01));
}

TEST_CASE("the light on surfaces ends with a white surface in it", "[view]") {
  const LiveRoom room(haze);
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  const CompiledScene& scene = run.scene();
  trace_some(run, 16);
  const auto geometry = geometry_of(scene, 1);
  REQUIRE(geometry.ok());
  const auto frames =
      light_frames(run, geometry->patches, smoke_of(scene, run.index(), 1), 1, {left});
  const std::vector<double> halves = halves_of(frames[0]);
  REQUIRE(halves.size() == 8 * geometry->patches.size() + 3);
  const Readout readout(scene, run.shown(left));
  for (const size_t triangle : {size_t{0}, geometry->patches.size() - 1}) {
    const LivePatch& patch = geometry->patches[triangle];
    CHECK(halves[8 * triangle + 3] ==
          Approx(readout.lumens(scene.blocks.patches, patch.front, 0, left).value / patch.area_m2)
              .epsilon(1e-3)
              .margin(1e-6));
  }
  double lumens = 0, area_m2 = 0;
  for (const LivePatch& patch : geometry->patches)
    for (const uint32_t bin : {patch.front, patch.back}) {
      const double arrives = readout.lumens(scene.blocks.patches, bin, 0, left).value;
      lumens += arrives;
      if (arrives > 0) area_m2 += patch.area_m2;
    }
  REQUIRE(lumens > 0);
  double luminance = 0;
  for (size_t c = 0; c < 3; ++c) luminance += of_channel[c] * halves[halves.size() - 3 + c];
  CHECK(luminance == Approx(lumens / (std::numbers::pi * area_m2)).epsilon(0.01));
}

TEST_CASE("smoke has the extinction and the mean cosine of its media", "[view]") {
  const LiveRoom room(haze);
  const LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  const LiveSmoke smoke = smoke_of(run.scene(), run.index(), 1);
  const std::vector<double> halves = halves_of(smoke.frame);
  REQUIRE(halves.size() == size_t{run.scene().voxels.count()} * 2);
  CHECK(halves[0] == Approx(0.3).epsilon(1e-3));
  CHECK(halves[1] == Approx(0.7).epsilon(1e-3));
  CHECK(smoke.scattering->front() == Approx(0.24).epsilon(1e-3));
  CHECK(smoke_of(*LiveRoom().compiled({}), run.index(), 1).frame == nullptr);
}

TEST_CASE("smoke emits the run's scattered light, along the light that it comes from", "[view]") {
  const LiveRoom room(haze);
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  const CompiledScene& scene = run.scene();
  trace_some(run, 64);
  const auto geometry = geometry_of(scene, 1);
  REQUIRE(geometry.ok());
  const auto frames =
      light_frames(run, geometry->patches, smoke_of(scene, run.index(), 1), 1, {left});
  REQUIRE(frames.size() == 2);
  // Collisions score it, too: with more noise, but independent of voxel volumes.
  const Readout readout(scene, run.shown(left));
  double scattered = 0, variance = 0;
  for (uint32_t voxel = 0; voxel < scene.voxels.count(); ++voxel) {
    const Estimate own = readout.lumens(scene.blocks.voxel_power, voxel, 1, left);
    scattered += own.value;
    variance += own.standard_error * own.standard_error;
  }
  REQUIRE(std::sqrt(variance) < 0.01 * scattered);
  CHECK(lumens_in(frames[1], scene.voxels) == Approx(scattered).epsilon(0.03));
  // Near the point lamp most light is direct: at 0.8 m, with walls of 108 m2 that reflect a half,
  // 1000 lm exp(-0.24) / (4 pi 0.64 m2) against about 40 lx indirect.
  const VoxelGrid& grid = scene.voxels;
  const std::vector<SmokeGlow> glows = glows_of(frames[1], grid);
  const glm::dvec3 lamp = glm::dvec3(2, 2, 2) - scene.local_origin;
  size_t beside = 0;
  for (uint32_t voxel = 0; voxel < grid.count(); ++voxel) {
    const auto nx = static_cast<uint32_t>(grid.nx), ny = static_cast<uint32_t>(grid.ny);
    const glm::vec3 cell(voxel % nx, voxel / nx % ny, voxel / nx / ny);
    const glm::dvec3 away = glm::dvec3(grid.low + (cell + 0.5f) * grid.edge) - lamp;
    const SmokeGlow& glow = glows[voxel];
    CHECK(glm::length(glow.beam) <= 1.01 * glow.luminance);
    const double distance = glm::length(away);
    if (distance < 0.5 || distance > 0.8) continue;
    ++beside;
    CHECK(glm::dot(glow.beam, away) > 0.97 * glm::length(glow.beam) * distance);
    CHECK(glm::length(glow.beam) > 0.5 * glow.luminance);
  }
  CHECK(beside > 100);
}

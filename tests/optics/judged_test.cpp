// Error targets of a run, and how they distribute its paths.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/error_target.hpp"
#include "tests/optics/light_kit.hpp"

using namespace luxodus;
using namespace luxodus::light;

namespace {

/// A lamp in a room; one plane below it, a small one in a corner; a probe at each place.
const char* const lit_room = R"(
[run]
max_bands = 1
batch_particles = 4096

[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
patch_edge_m = 1

[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [3, 2, 2.5]
flux_lm = 1000
spectrum = "E"

[[plane]]
name = "below"
corner = [0.5, 0.5, 0.8]
edge_u = [5, 0, 0]
edge_v = [0, 3, 0]
cell_m = 0.5

[[plane]]
name = "corner"
corner = [0.1, 0.1, 0.05]
edge_u = [0.1, 0, 0]
edge_v = [0, 0.1, 0]
cell_m = 0.1

[[probe]]
name = "under the lamp"
position = [3, 2, 0]

[[probe]]
name = "in the corner"
position = [0.5, 0.5, 0]
)";

std::shared_ptr<const CompiledScene> judged_scene(const std::vector<std::string>& words) {
  SceneDescription scene = scene_from_toml(lit_room);
  scene.run.error_of = words;
  return compile(std::move(scene));
}

/// The error of a run of so many batches for these targets.
double error_by(const std::vector<std::string>& words) {
  SceneDescription scene = scene_from_toml(lit_room);
  scene.run.error_of = words;
  RunOptions options;
  options.particles = 64 * 4096;
  const Run run(std::move(scene), options);
  return Readout(run.scene(), run.local().totals()).worst_relative_error();
}

}  // namespace

TEST_CASE("the error of a run is the largest among its targets") {
  const double below = error_by({"plane below"});
  const double corner = error_by({"plane corner"});
  CHECK(below > 0);
  CHECK(corner > 5 * below);
  CHECK(error_by({"planes"}) == corner);
  CHECK(error_by({"plane below", "plane corner"}) == corner);
  const double probes = error_by({"probes"});
  CHECK(probes == std::max(error_by({"probe under the lamp"}), error_by({"probe in the corner"})));
}

TEST_CASE("the error of patches is their 95th percentile, among those that get light") {
  SceneDescription scene = scene_from_toml(lit_room);
  scene.run.error_of = {"patches"};
  const Run run(std::move(scene), {.particles = 64 * 4096});
  const Readout readout(run.scene(), run.local().totals());
  const double error = readout.worst_relative_error();
  int lit = 0, within = 0;
  for (uint32_t p = 0; p < run.scene().patch_count; ++p) {
    const Estimate in = readout.lumens(run.scene().blocks.patches, p, 0);
    if (in.value <= 0) continue;
    ++lit;
    within += in.relative_error() <= error ? 1 : 0;
  }
  REQUIRE(lit > 100);
  CHECK(within >= 0.94 * lit);
  CHECK(within <= 0.96 * lit);
}

TEST_CASE("the error of a plane's cells is their 95th percentile") {
  SceneDescription scene = scene_from_toml(lit_room);
  scene.run.error_of = {"cells below"};
  const Run run(std::move(scene), {.particles = 64 * 4096});
  const Readout readout(run.scene(), run.local().totals());
  const double error = readout.worst_relative_error();
  const auto cells = readout.target_cells(0);
  REQUIRE(cells.size() == 60);
  int within = 0;
  for (const Readout::TargetFlux& cell : cells) {
    const Estimate indirect = readout.lumens(cell.block, cell.bin, 1);
    const double direct = readout.lumens(cell.block, cell.bin, 0).value;
    within += indirect.standard_error <= error * (indirect.value + direct) * (1 + 1e-12) ? 1 : 0;
  }
  CHECK(within == 57);
  CHECK(error > 2 * error_by({"plane below"}));
  CHECK(error_by({"cells"}) == std::max(error, error_by({"cells corner"})));
}

TEST_CASE("a target without light is named and excluded from the error") {
  SceneDescription scene = scene_from_toml(lit_room);
  // Inside a box of its own, without lamps.
  for (const BoxFace& f : faces_of_box({0.05, 0.05, 0.01}, {0.3, 0.3, 0.2}))
    add_quad(scene, "box " + f.name, f.corner, f.u, f.v, add_grey(scene, 0.5));
  scene.run.error_of = {"planes", "cells", "patches"};
  const Run run(std::move(scene), {.particles = 64 * 4096});
  const Readout readout(run.scene(), run.local().totals());
  CHECK(std::isfinite(readout.worst_relative_error()));
  const std::vector<std::string> unlit = readout.unlit();
  REQUIRE(unlit.size() == 3);
  CHECK(unlit[0] == "plane corner");
  CHECK(unlit[1] == "1 of 1 cells of plane corner");
  CHECK(unlit[2].ends_with(" of " + std::to_string(run.scene().patch_count) + " patches"));
}

TEST_CASE("paths go to eyes if only eyes are targets, to particles if only bins are") {
  const int usual = judged_scene({})->eye_paths_per_batch;
  CHECK(judged_scene({"all"})->eye_paths_per_batch == usual);
  CHECK(judged_scene({"planes", "probes"})->eye_paths_per_batch == usual);
  CHECK(judged_scene({"probe in the corner"})->eye_paths_per_batch > 6 * usual);
  CHECK(judged_scene({"patches"})->eye_paths_per_batch < usual / 6);
  // A scene that has only eyes gets the default number of paths, unless targets are given.
  SceneDescription eyes_alone = scene_from_toml(lit_room);
  eyes_alone.planes.clear();
  CHECK(compile(std::move(eyes_alone))->eye_paths_per_batch == usual);
}

TEST_CASE("an error target that a scene does not have is refused with those it has") {
  const auto refusal = [](const std::string& word) {
    const auto judged = error_target_of(*judged_scene({}), {word});
    REQUIRE_FALSE(judged.ok());
    return judged.problem().what;
  };
  CHECK(refusal("plane desk") ==
        "an error is wanted of the plane \"desk\", but there are \"below\", \"corner\"");
  CHECK(refusal("cells desk") ==
        "an error is wanted of the plane \"desk\", but there are \"below\", \"corner\"");
  CHECK(refusal("signs") == "the scene has no signs");
  CHECK(refusal("sign exit") == "an error is wanted of the sign \"exit\", but there are none");
  CHECK(refusal("walls").find("not of \"walls\"") != std::string::npos);
  CHECK(refusal("").find("not of \"\"") != std::string::npos);
}

TEST_CASE("a scene file with a missing error target is refused at its line") {
  SceneDescription scene = scene_from_toml(std::string(lit_room));
  scene.run.error_of = {"plane desk"};
  scene.run.error_of_place = {"room.toml", 3};
  const Scenario plain = find_scenario(scene, "").value();
  const auto shared = std::make_shared<const SceneDescription>(std::move(scene));
  const auto refused = compile_scene(shared, plain, {});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().where.line == 3);
  // A command line overrides it.
  CHECK(compile_scene(shared, plain, {1, {"plane below"}}).ok());
}

// When a run of threads stops.
#include "actors/results/run/local_run.hpp"

#include <catch2/catch.hpp>

#include "scenes/light/transport/compile.hpp"
#include "tests/kit/described.hpp"

using namespace luxodus;

namespace {

std::shared_ptr<const CompiledScene> room_of(const std::string& reflectance) {
  const auto scene = test::described_text(
      "[[material]]\nname = \"m\"\nreflectance = " + reflectance +
      "\n[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [2, 2, 2]\n"
      "material = \"m\"\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\n"
      "distribution = \"isotropic\"\nposition = [1, 1, 1]\nflux_lm = 1000\n");
  auto compiled = compile_scene(scene, find_scenario(*scene, "").value(), {});
  REQUIRE(compiled.ok());
  return std::move(compiled).value();
}

StopRule at_once() {
  StopRule stop;
  stop.seconds = 0;
  stop.waits_s = 0.1;
  return stop;
}

}  // namespace

TEST_CASE("a run stops in time where no particle ends, and counts no part of a batch", "[run]") {
  LocalRun run(room_of("1.0"), 1, 2);
  StopRule stop;
  stop.seconds = 0.1;
  stop.waits_s = 0.1;
  const std::atomic<bool> interrupt{false};
  CHECK(run.run(stop, interrupt, [](const Progress&) {}) == StopReason::time);
  CHECK(run.traced() == 0);
  CHECK(run.missing().size() == static_cast<size_t>(run.batches()));
  CHECK(run.totals().balance().particles == 0);
}

TEST_CASE("batches that a stop has left out are traced when the run goes on", "[run]") {
  const std::atomic<bool> interrupt{false};
  const auto ignore = [](const Progress&) {};
  LocalRun plain(room_of("0.5"), 1, 2), resumed(room_of("0.5"), 1, 2);
  StopRule four;
  four.particles = 4 * plain.scene().batch_particles;
  CHECK(plain.run(four, interrupt, ignore) == StopReason::particles);
  resumed.resume(3, {0, 1, 2});
  CHECK(resumed.run(at_once(), interrupt, ignore) == StopReason::time);
  CHECK(resumed.run(four, interrupt, ignore) == StopReason::particles);
  CHECK(resumed.missing().empty());
  CHECK(resumed.traced() == 4);
  CHECK(resumed.totals().balance().absorbed_surfaces == plain.totals().balance().absorbed_surfaces);
}

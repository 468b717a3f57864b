// Changing states of a scene, traced by simulated nodes under faults drawn from seeds. More seeds:
// `luxodus sim SCENE --states --seeds 0..10000`.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>

#include "actors/lab/simulate/state_simulation.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/test_length.hpp"

using namespace luxodus;

namespace {

constexpr int64_t particles_of_a_state = 1000;
constexpr int64_t batches_of_a_state = 20;

SimStates states_of(const std::string& name) {
  spdlog::set_level(spdlog::level::off);
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + name + ".toml");
  REQUIRE(read.scene);
  auto description = std::make_shared<SceneDescription>(std::move(*read.scene));
  description->run.batch_particles = particles_of_a_state / batches_of_a_state;
  const auto scenario = find_scenario(*description, "");
  REQUIRE(scenario.ok());
  auto scene = compile_scene(description, scenario.value(), {});
  REQUIRE(scene.ok());
  return {scene.value(), 1, particles_of_a_state};
}

SimOptions options_of_states(uint64_t seed, int nodes) {
  SimOptions options;
  options.seed = seed;
  options.nodes = nodes;
  options.work = seconds(30);
  options.faults_last = seconds(15);
  return options;
}

}  // namespace

TEST_CASE("swarms of faults change no bit of states that are traced, left and resumed", "[sim]") {
  const SimStates states = states_of("empty_room");
  uint64_t crashes = 0, lost = 0, fenced = 0, refused = 0;
  const uint64_t seeds = test::in_full() ? 200 : 25;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const SimOptions options = options_of_states(seed, 1 + static_cast<int>(seed % 6));
    const auto once = simulate_states(states, options), twice = simulate_states(states, options);
    REQUIRE(once.ok());
    REQUIRE(twice.ok());
    INFO("luxodus sim scenes/library/empty_room.toml --states --seed "
         << seed << " --nodes " << options.nodes << " --particles 1000 --batches 20 --work 30s "
         << "--faults-last 15s");
    CHECK(once->failure == "");
    CHECK(once->trace_hash == twice->trace_hash);
    crashes += once->world.crashes;
    lost += once->world.lost;
    fenced += once->leases_fenced;
    refused += once->flushes_refused;
  }
  // The faults did happen.
  CHECK(crashes > 0);
  CHECK(lost > 100);
  CHECK(fenced > 100);
  CHECK(refused > 0);
}

// A node whose leases had all been fenced once waited forever: it asked for none, and was offered
// none, since it had never been told that there were none.
TEST_CASE("a state that was left is resumed by all nodes", "[sim]") {
  const SimStates states = states_of("empty_room");
  SimOptions options = options_of_states(5, 4);
  options.draw_nodes = false;
  options.faults = false;
  const auto report = simulate_states(states, options);
  REQUIRE(report.ok());
  CHECK(report->failure == "");
  CHECK(report->leases_fenced > 0);
  // Three states take one worker 90 s.
  CHECK(report->virtual_time < seconds(90));
}

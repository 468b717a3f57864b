// Rounds of an assessment as text, and traced by nodes that know only the scene: real nodes of this
// process, over inproc.
#include "actors/judge/assess/round_state.hpp"

#include "actors/results/run/run_in_pieces.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/compile_light.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"
#include "tests/unit/actors/judge/assess/round_nodes.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const auto nobody_hears = [](const std::string&, double) {};

/// Lamps with two ageing factors, so that there are two source groups, and scattering smoke.
std::string two_ageings() {
  const std::string second = replaced(middle_lamp, "name = \"lamp\"", "name = \"second\"");
  return with_smoke(0.3, 0.6) + replaced(second, "0.75", "0.5");
}

void same_look(const SignLook& a, const SignLook& b) {
  CHECK(a.legend.value == b.legend.value);
  CHECK(a.legend.error == b.legend.error);
  CHECK(a.difference.value == b.difference.value);
  CHECK(a.surround.value == b.surround.value);
  CHECK(a.transmission == b.transmission);
}

}  // namespace

TEST_CASE("a round of an assessment is read back from its text to the bit", "[assess]") {
  RoundState round{"smoke \"grey\"", 60.25, {1.0 / 3, 0.1, true}, true, 0.1, {}};
  Observer observer;
  observer.name = "somebody";
  observer.eye = {1e-17, -2.0 / 3, 1.65};
  observer.gaze = {0, 1, 0};
  observer.signs = {4, 0};
  round.observers = {observer, observer};
  const auto read = parse_round(round_text(round));
  REQUIRE(read.ok());
  CHECK(read->scenario == round.scenario);
  CHECK(read->at_s == round.at_s);
  CHECK(read->smoke.factor == round.smoke.factor);
  CHECK(read->smoke.albedo == round.smoke.albedo);
  CHECK(read->smoke.by_errors);
  CHECK(read->signs_apart);
  CHECK(read->eye_path_factor == round.eye_path_factor);
  REQUIRE(read->observers.size() == 2);
  CHECK(read->observers[1].name == observer.name);
  CHECK(read->observers[1].eye == observer.eye);
  CHECK(read->observers[1].gaze == observer.gaze);
  CHECK(*read->observers[1].signs == *observer.signs);
}

TEST_CASE("a text that is no round of an assessment is refused with a message", "[assess]") {
  const auto scene = described_text(with_smoke(0.3, 0.5));
  RoundStates states(scene);
  const auto refused = [&](const std::string& text, const std::string& words) {
    const auto made = states.make(text);
    REQUIRE_FALSE(made.ok());
    INFO(made.problem().what);
    CHECK(made.problem().what.find(words) != std::string::npos);
  };
  refused("", "no round");
  refused("{}", "no round");
  refused("[1, 2]", "no round");
  RoundState round{"failed", {}, {}, false, 1, {}};
  round.observers.emplace_back().signs = {7};
  refused(round_text(round), "a sign that the scene has not");
  refused(round_text({"there is none", {}, {}, false, 1, {}}), "there is none");
}

TEST_CASE("nodes that know only the scene give the same luminances and verdicts as threads",
          "[assess][nodes]") {
  const auto scene = described_text(with_smoke(0.3, 0.6));
  RoundNodes nodes(scene);
  // As in a cluster: the executor takes a lock of its own. The two locks were once taken in two
  // orders.
  NodeExecutor& executor = *nodes.nodes->executor();
  RunInPieces pieces(executor, [&]() -> Result<void> {
    return executor.counters().workers > 2 ? problem("there are two") : executor.goes_on();
  });
  AssessOptions options;
  options.rules = {"en1838-2013"};
  options.rounds = 2;
  options.smoke_factors = {0.5};
  const std::atomic<bool> interrupt{false};
  const auto here = assess(scene, options, interrupt, nobody_hears);
  options.executor = &pieces;
  const auto there = assess(scene, options, interrupt, nobody_hears);
  REQUIRE(here.ok());
  REQUIRE(there.ok());
  CHECK(there->paths == here->paths);
  CHECK(here->paths > 0);
  REQUIRE(there->sights.size() == here->sights.size());
  for (size_t i = 0; i < here->sights.size(); ++i) {
    CHECK(there->sights[i].sight.verdict == here->sights[i].sight.verdict);
    same_look(there->sights[i].look, here->sights[i].look);
  }
  REQUIRE(there->sweep.size() == 1);
  CHECK(there->sweep[0].legible == here->sweep[0].legible);
  CHECK(nodes.nodes->executor()->counters().leases >= 64);
}

TEST_CASE("an assessment whose nodes refuse to go on ends with their reason", "[assess][nodes]") {
  const auto scene = described_text(with_smoke(0.3, 0.5));
  RoundNodes nodes(scene);
  RunInPieces pieces(*nodes.nodes->executor(),
                     [] { return Result<void>(problem("they have gone home")); });
  AssessOptions options;
  options.rules = {"en1838-2013"};
  options.executor = &pieces;
  const auto ended = assess(scene, options, std::atomic<bool>{false}, nobody_hears);
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what == "they have gone home");
}

TEST_CASE("a run in pieces continues after an interrupt with the same result", "[run][nodes]") {
  const auto scene = described_text(two_ageings());
  RoundNodes nodes(scene);
  const auto judged = judged_scene(*scene, find_scenario(*scene, "failed").value());
  REQUIRE(judged.ok());
  RoundState round{"failed", {}, {}, false, 1, {}};
  Observer& observer = round.observers.emplace_back();
  observer.eye = {2, 0.5, 1.65};
  observer.signs = {0};
  const auto compiled = compile_round(judged.value(), round);
  REQUIRE(compiled.ok());
  StopRule stop;
  stop.particles = 96 * limits::round_batch_particles;
  const auto nobody = [](const Progress&) {};
  LocalRun threads(compiled.value(), 5, 1);
  REQUIRE(threads.run(stop, std::atomic<bool>{false}, nobody) == StopReason::particles);

  std::atomic<bool> interrupt{false};
  std::atomic<int> asked = 0;
  int patience = 4;  // the run is interrupted at this question
  RunInPieces pieces(*nodes.nodes->executor(), [&]() -> Result<void> {
    if (++asked >= patience) interrupt = true;
    return {};
  });
  pieces.enter({5, round_text(round)});
  LocalRun run(compiled.value(), 5, 1);
  int interrupted = 0;
  for (;; patience *= 2, ++interrupted) {
    interrupt = false;
    asked = 0;
    const auto reason = pieces.run(
        run, stop, interrupt, [&](const Progress& p) { CHECK(p.particles <= *stop.particles); });
    REQUIRE(reason.ok());
    if (reason.value() == StopReason::particles) break;
    CHECK(reason.value() == StopReason::interrupted);
  }
  CHECK(interrupted > 0);
  CHECK(run.missing().empty());
  CHECK(run.batches() == threads.batches());
  for (int group = 0; group < run.totals().groups(); ++group) {
    const auto &a = run.totals().state(group).totals, &b = threads.totals().state(group).totals;
    REQUIRE(a.size() == b.size());
    size_t differences = 0;
    for (size_t i = 0; i < a.size(); ++i)
      differences += a[i].sum != b[i].sum || a[i].squares != b[i].squares;
    CHECK(differences == 0);
  }
}

TEST_CASE("raising simulated smoke by its error never thins it, even in a medium that emits light",
          "[assess]") {
  const auto base = described_text(with_smoke(0.3, 0.6));
  SceneDescription scene = *base;
  Medium fire;
  fire.name = "fire";
  fire.kind = MediumKind::data_set;
  fire.emission = MediumEmission{};
  fire.simulation.emplace();
  fire.simulation->depth_error = 0.1;
  Medium second = fire;  // another grid of the same simulation
  second.simulation->depth_error = 0.05;
  scene.media.push_back(fire);
  scene.media.push_back(second);
  Scenario scenario = find_scenario(*base, "failed").value();
  for (const double of_all : {0.0, 0.5, 1.0, 3.0}) {
    for (const double factor : {1.0, 2.0}) {
      scenario.smoke_factor = of_all;
      const auto said = judged_scene(scene, scenario, {factor, {}, false});
      const auto denser = judged_scene(scene, scenario, {factor, {}, true});
      REQUIRE(said.ok());
      REQUIRE(denser.ok());
      CAPTURE(of_all, factor);
      for (const Medium& medium : scene.media) {
        const double before = factor_of_medium(said->scenario, medium);
        const double after = factor_of_medium(denser->scenario, medium);
        const bool simulated = medium.simulation.has_value();
        CHECK(before == Approx(of_all * factor));
        CHECK(after ==
              Approx(simulated ? 1.1 * before : before));  // the largest error, applied once
      }
    }
  }
}

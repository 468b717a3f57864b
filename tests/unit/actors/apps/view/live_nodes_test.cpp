// A live view traced by nodes: their light equals that of threads, bit for bit, whichever nodes
// join and leave. Real nodes of this process, over inproc.
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "actors/apps/view/edits_text.hpp"
#include "actors/apps/view/live_run.hpp"
#include "actors/apps/view/live_states.hpp"
#include "actors/cast/process/process_executor.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr int64_t level_batches = 24;

const auto never_stop = [] { return LiveRun::Stop::none; };
const auto no_tick = [] {};

/// Nodes of this process, and the maker of their states.
struct LiveNodes {
  explicit LiveNodes(const LiveRoom& room, const NodesOptions& options = {})
      : states(room.scene()) {
    // The scene that nodes agree on may have bins that no state has: here those of a probe.
    const auto other = std::make_shared<SceneDescription>(*room.scene());
    other->probes.emplace_back().position = {1, 1, 1};
    auto compiled = compile_scene(other, find_scenario(*other, "").value(), {1});
    REQUIRE(compiled.ok());
    CHECK(compiled.value()->layout.totals() != room.compiled({})->layout.totals());
    auto started = ProcessExecutor::start(compiled.value(), states, options);
    REQUIRE(started.ok());
    nodes = std::move(started).value();
  }
  NodeExecutor& executor() { return *nodes->executor(); }

  LiveStates states;
  std::unique_ptr<ProcessExecutor> nodes;
};

StateObject state_of(const SceneEdits& edits) {
  return {1, edits_text(edits)};
}

void same_light(const LiveRun& a, const LiveRun& b) {
  for (int group = 0; group < static_cast<int>(a.lights().size()); ++group) {
    const auto& x = a.shown(group).state(group);
    const auto& y = b.shown(group).state(group);
    CHECK(x.batches == y.batches);
    REQUIRE(x.totals.size() == y.totals.size());
    size_t differences = 0;
    for (size_t i = 0; i < x.totals.size(); ++i)
      differences +=
          x.totals[i].sum != y.totals[i].sum || x.totals[i].squares != y.totals[i].squares;
    CHECK(differences == 0);
  }
}

/// The light traced by threads.
LiveRun traced_here(const LiveRoom& room, const SceneEdits& edits) {
  LiveRun run(room.compiled(edits), 1, 1, nullptr, false);
  ThreadExecutor threads(1);
  CHECK(run.trace(level_batches, LiveRun::Scope::all, threads, never_stop, no_tick));
  return run;
}

}  // namespace

TEST_CASE("nodes give a live view the light of threads, state after state", "[view][nodes]") {
  const LiveRoom room;
  LiveNodes nodes(room);
  NodeExecutor& executor = nodes.executor();
  executor.enter(state_of({}));
  LiveRun first(room.compiled({}), 1, 1, nullptr, false);
  CHECK(first.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  same_light(first, traced_here(room, {}));
  CHECK(executor.counters().workers == 2);
  first.tell(first.news());
  // A lamp moves: the nodes trace only its group, in the other building.
  const int64_t particles = first.particles();
  executor.foresee(state_of(moved_lamp()));
  executor.enter(state_of(moved_lamp()));
  LiveRun second(room.compiled(moved_lamp()), 1, 1, &first, true);
  CHECK(second.light(right) == ShownLight::own);
  CHECK(second.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  same_light(second, traced_here(room, moved_lamp()));
  CHECK(second.particles() == particles);
}

TEST_CASE("nodes trace additions of a viewer, with their own random numbers", "[view][nodes]") {
  const LiveRoom room;
  LiveNodes nodes(room);
  NodeExecutor& executor = nodes.executor();
  LiveRun first(room.compiled({}), 1, 1, nullptr, false);
  LiveRun beside(room.compiled({}), 1, 1, nullptr, false);
  ThreadExecutor threads(1);
  executor.enter(state_of({}));
  CHECK(first.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  CHECK(beside.trace(level_batches, LiveRun::Scope::all, threads, never_stop, no_tick));
  first.tell(first.news());
  beside.tell(beside.news());
  SceneEdits edits;
  edits.added = {{false, "left", "left copy"}};
  edits.luminaires["left copy"] = {{1, 1, 1}, std::nullopt};
  executor.enter(state_of(edits));
  LiveRun second(room.compiled(edits), 1, 1, &first, true);
  LiveRun second_beside(room.compiled(edits), 1, 1, &beside, true);
  CHECK(second.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  CHECK(second_beside.trace(level_batches, LiveRun::Scope::all, threads, never_stop, no_tick));
  REQUIRE(second.lights().size() == 4);
  same_light(second, second_beside);
}

TEST_CASE("a building that was announced and never entered changes nothing", "[view][nodes]") {
  const LiveRoom room;
  LiveNodes nodes(room);
  NodeExecutor& executor = nodes.executor();
  executor.enter(state_of({}));
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  CHECK(run.trace(4, LiveRun::Scope::all, executor, never_stop, no_tick));
  SceneEdits refused;
  refused.scenario = "there is none";
  executor.foresee(state_of(refused));
  CHECK(run.trace(8, LiveRun::Scope::all, executor, never_stop, no_tick));
  executor.foresee(state_of(moved_lamp()));
  CHECK(run.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  same_light(run, traced_here(room, {}));
}

TEST_CASE("batches that nodes have not returned when tracing stops are traced later",
          "[view][nodes]") {
  const LiveRoom room;
  LiveNodes nodes(room);
  NodeExecutor& executor = nodes.executor();
  executor.enter(state_of({}));
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  int stops = 0;
  bool done = false;
  // Any thread may ask; after a number of answers each call ends, the first long before all is
  // lent.
  for (int patience = 6; !done; patience *= 2) {
    std::atomic<int> asked = 0;
    done = run.trace(
        level_batches, LiveRun::Scope::all, executor,
        [&] { return ++asked > patience ? LiveRun::Stop::now : LiveRun::Stop::none; }, no_tick);
    stops += done ? 0 : 1;
  }
  CHECK(stops > 0);
  same_light(run, traced_here(room, {}));
}

TEST_CASE("a state that no node can make is given back, and the next one is traced",
          "[view][nodes][failure]") {
  const LiveRoom room;
  LiveNodes nodes(room);
  NodeExecutor& executor = nodes.executor();
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  SceneEdits impossible;
  impossible.scenario = "there is none";
  executor.enter(state_of(impossible));
  std::atomic<int> asked = 0;
  const auto soon = [&] { return ++asked > 100 ? LiveRun::Stop::now : LiveRun::Stop::none; };
  CHECK_FALSE(run.trace(level_batches, LiveRun::Scope::all, executor, soon, no_tick));
  CHECK(run.particles() == 0);
  executor.enter(state_of({}));
  CHECK(run.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  same_light(run, traced_here(room, {}));
}

TEST_CASE("a live view goes on when one of its nodes leaves", "[view][nodes][failure]") {
  const LiveRoom room;
  NodesOptions options;
  std::atomic<bool> one_leaves = false;
  std::atomic<std::thread::id> leaver{};
  // The first worker that asks after the signal has to leave.
  options.stop = [&] {
    if (!one_leaves) return false;
    std::thread::id nobody{};
    leaver.compare_exchange_strong(nobody, std::this_thread::get_id());
    return leaver.load() == std::this_thread::get_id();
  };
  LiveNodes nodes(room, options);
  NodeExecutor& executor = nodes.executor();
  executor.enter(state_of({}));
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  CHECK(run.trace(4, LiveRun::Scope::all, executor, never_stop, no_tick));
  one_leaves = true;
  CHECK(run.trace(level_batches, LiveRun::Scope::all, executor, never_stop, no_tick));
  same_light(run, traced_here(room, {}));
}

TEST_CASE("a live view without nodes waits until it is told to stop", "[view][nodes][failure]") {
  const LiveRoom room;
  NodesOptions options;
  options.stop = [] { return true; };  // all workers leave at once
  LiveNodes nodes(room, options);
  NodeExecutor& executor = nodes.executor();
  executor.enter(state_of({}));
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  std::atomic<int> asked = 0;
  constexpr int64_t endless = int64_t{1} << 30;
  CHECK_FALSE(run.trace(
      endless, LiveRun::Scope::all, executor,
      [&] { return ++asked > 300 ? LiveRun::Stop::now : LiveRun::Stop::none; }, no_tick));
  CHECK(executor.counters().workers == 0);
}

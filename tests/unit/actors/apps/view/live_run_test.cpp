// What a state of a live building keeps from the previous one, and what it traces anew.
#include "actors/apps/view/live_run.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Its body is after all signs.
const std::string panel = R"(
[[emitter]]
name = "panel"
shape = "rectangle"
position = [3, 1, 2.9]
size = [0.5, 0.5]
flux_lm = 1000
body_material = "grey50"
)";

void reach(LiveRun& run, int64_t level, LiveRun::Scope scope = LiveRun::Scope::all) {
  ThreadExecutor threads(2);
  CHECK(run.trace(
      level, scope, threads, [] { return LiveRun::Stop::none; }, [] {}));
}

std::vector<int> told(LiveRun& run) {
  const auto groups = run.news();
  run.tell(groups);
  return groups;
}

SceneEdits moved_sign() {
  SceneEdits edits;
  edits.signs["exit"] = {{5.9, 1, 2.2}, std::nullopt};
  return edits;
}

/// Lumens of one group that arrive on all surfaces.
Estimate caught(const LiveRun& run, int group) {
  Estimate sum;
  const Readout readout(run.scene(), run.shown(group));
  for (uint32_t s = 0; s < run.scene().surfaces.size(); ++s) {
    const Estimate e = readout.lumens(run.scene().blocks.surfaces, s, 0, group);
    sum.value += e.value;
    sum.standard_error = std::hypot(sum.standard_error, e.standard_error);
  }
  return sum;
}

}  // namespace

TEST_CASE("a moved luminaire begins anew, and all other light is kept bit for bit", "[view]") {
  const LiveRoom room;
  LiveRun before(room.compiled({}), 1, 1, nullptr, false);
  reach(before, 8);
  CHECK(told(before) == std::vector<int>{left, right, sign});
  LiveRun after(room.compiled(moved_lamp()), 1, 1, &before, true);
  CHECK(after.same_geometry());
  CHECK(after.light(left) == ShownLight::none);
  for (const int group : {right, sign}) {
    CHECK(after.light(group) == ShownLight::own);
    CHECK(caught(after, group).value == caught(before, group).value);
    CHECK(after.shown(group).batches(group) == before.shown(group).batches(group));
  }
  const int64_t kept = after.shown(right).batches(right);
  reach(after, 4);
  CHECK(told(after) == std::vector<int>{left});
  CHECK(after.shown(right).batches(right) == kept);  // it had more already
  // A closed room with reflectance a half: each lumen arrives twice in all.
  const Estimate light = caught(after, left);
  CHECK(std::abs(light.value - 2000) < 5 * light.standard_error + 5);
}

TEST_CASE("light continued after a move equals that of one run", "[view]") {
  const LiveRoom room;
  LiveRun whole(room.compiled({}), 1, 1, nullptr, false);
  reach(whole, 8);
  LiveRun first(room.compiled({}), 1, 1, nullptr, false);
  reach(first, 2);
  told(first);
  LiveRun second(room.compiled(moved_lamp()), 1, 2, &first, true);
  reach(second, 8);
  CHECK(caught(second, right).value == caught(whole, right).value);
}

TEST_CASE("a moved sign leaves light of before, which ends when its own has caught up", "[view]") {
  const LiveRoom room;
  LiveRun before(room.compiled({}), 1, 1, nullptr, false);
  reach(before, 64);
  told(before);
  LiveRun after(room.compiled(moved_sign()), 1, 1, &before, true);
  CHECK_FALSE(after.same_geometry());
  CHECK(after.light(sign) == ShownLight::none);
  CHECK(after.groups_with(ShownLight::before) == 2);
  CHECK(caught(after, left).value == caught(before, left).value);
  reach(after, 4, LiveRun::Scope::own);
  CHECK(told(after) == std::vector<int>{sign});  // its own group first
  reach(after, 8);
  told(after);
  CHECK(after.light(left) == ShownLight::before);
  CHECK(caught(after, left).value == caught(before, left).value);
  // Moved again before anything has caught up: the light of before continues to be shown.
  const LiveRun again(room.compiled({}), 1, 1, &after, true);
  CHECK(again.groups_with(ShownLight::before) == 2);
  CHECK(caught(again, left).value == caught(before, left).value);
  reach(after, 24);
  told(after);
  CHECK(after.light(left) == ShownLight::own);
  CHECK(after.shown(left).batches(left) < before.shown(left).batches(left));
}

namespace {

bool same_bits(const LiveRun& a, int in_a, const LiveRun& b, int in_b) {
  const auto &x = a.shown(in_a).state(in_a).totals, &y = b.shown(in_b).state(in_b).totals;
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(Total)) == 0;
}

SceneEdits added_lamp() {
  SceneEdits edits;
  edits.added = {{false, "left", "left copy"}};
  edits.luminaires["left copy"] = {{1, 1, 1}, std::nullopt};
  return edits;
}
SceneEdits added_sign() {
  SceneEdits edits;
  edits.added = {{true, "exit", "exit copy"}};
  edits.signs["exit copy"] = {{0.1, 2, 2.2}, glm::dvec3(1, 0, 0)};
  return edits;
}

int group_of(const LiveRun& run, const std::string& name) {
  const auto& groups = run.scene().groups;
  const auto at = std::find_if(groups.begin(), groups.end(),
                               [&](const Group& group) { return group.name == name; });
  REQUIRE(at != groups.end());
  return static_cast<int>(at - groups.begin());
}

}  // namespace

TEST_CASE("an added luminaire is traced, and all other light is kept bit for bit", "[view]") {
  const LiveRoom room;
  LiveRun before(room.compiled({}), 1, 1, nullptr, false);
  reach(before, 8);
  told(before);
  LiveRun after(room.compiled(added_lamp()), 1, 1, &before, true);
  CHECK(after.same_geometry());
  const int copy = group_of(after, "left copy");
  CHECK(after.light(copy) == ShownLight::none);
  CHECK(after.groups_with(ShownLight::own) == 3);
  for (const char* name : {"left", "right", "sign exit"}) {
    const int now = group_of(after, name), was = group_of(before, name);
    CHECK(same_bits(after, now, before, was));
    CHECK(caught(after, now).value == caught(before, was).value);
  }
  reach(after, 4);
  CHECK(told(after) == std::vector<int>{copy});
  // A closed room with reflectance a half: each lumen arrives twice in all.
  const Estimate light = caught(after, copy);
  CHECK(std::abs(light.value - 2000) < 5 * light.standard_error + 5);
  // It is removed again: the others are unchanged.
  const LiveRun again(room.compiled({}), 1, 1, &after, true);
  CHECK(again.groups_with(ShownLight::own) == 3);
  for (const int group : {left, right, sign}) CHECK(same_bits(again, group, before, group));
}

TEST_CASE("light continued beside an added luminaire equals that of one run", "[view]") {
  const LiveRoom room;
  LiveRun whole(room.compiled({}), 1, 1, nullptr, false);
  reach(whole, 8);
  LiveRun first(room.compiled({}), 1, 1, nullptr, false);
  reach(first, 2);
  told(first);
  LiveRun second(room.compiled(added_lamp()), 1, 2, &first, true);
  reach(second, 8);
  const int now = group_of(second, "sign exit");
  REQUIRE(now != sign);  // an additional luminaire precedes it
  REQUIRE(second.shown(now).batches(now) == whole.shown(sign).batches(sign));
  CHECK(same_bits(second, now, whole, sign));
}

TEST_CASE("two copies in one place have different particles, after any sequence of edits",
          "[view]") {
  const LiveRoom room;
  const auto with = [&](const std::vector<std::string>& names) {
    SceneEdits edits;
    for (const std::string& name : names) {
      edits.added.push_back({false, "left", name});
      edits.luminaires[name] = {{1, 1, 1}, std::nullopt};
    }
    return room.compiled(edits);
  };
  LiveRun first(with({"gone", "stays"}), 1, 1, nullptr, false);
  reach(first, 4);
  told(first);
  LiveRun second(with({"stays", "comes"}), 1, 1, &first, true);
  CHECK(second.light(group_of(second, "stays")) == ShownLight::own);
  reach(second, 4);
  const int stays = group_of(second, "stays"), comes = group_of(second, "comes");
  CHECK(second.shown(stays).batches(stays) == second.shown(comes).batches(comes));
  CHECK_FALSE(same_bits(second, stays, second, comes));
}

TEST_CASE("an added sign leaves light of before, in the bins of the new building", "[view]") {
  const LiveRoom room;
  LiveRun before(room.compiled({}), 1, 1, nullptr, false);
  reach(before, 64);
  told(before);
  LiveRun after(room.compiled(added_sign()), 1, 1, &before, true);
  CHECK_FALSE(after.same_geometry());
  REQUIRE(after.bins());
  CHECK_FALSE(after.bins()->is_same());
  const int copy = group_of(after, "sign exit copy");
  CHECK(after.light(copy) == ShownLight::none);
  CHECK(after.groups_with(ShownLight::before) == 3);
  for (const int group : {left, right, sign})
    CHECK(caught(after, group).value == caught(before, group).value);
  reach(after, 4, LiveRun::Scope::own);
  CHECK(told(after) == std::vector<int>{copy});  // its own group first
  reach(after, 24);
  told(after);
  CHECK(after.groups_with(ShownLight::own) == 4);
  // Equal to a run that began with it.
  LiveRun fresh(room.compiled(added_sign()), 1, 1, nullptr, false);
  reach(fresh, 24);
  CHECK(caught(fresh, left).value == caught(after, left).value);
  // It is removed again: light of before once more.
  const LiveRun again(room.compiled({}), 1, 1, &after, true);
  CHECK(again.groups_with(ShownLight::before) == 3);
  CHECK(again.shown(left).batches(left) == after.shown(left).batches(left));
}

TEST_CASE("bins of a building with another sign are matched surface by surface", "[view]") {
  const LiveRoom room(panel);
  const auto a = room.compiled({}), b = room.compiled(added_sign());
  const auto bins = BinMap::between(*a, *b), back = BinMap::between(*b, *a);
  REQUIRE(bins);
  REQUIRE(back);
  for (const CompiledSurface& now : b->surfaces)
    for (uint32_t p = 0; p < now.patches; ++p) {
      const uint32_t was = bins->patch_before(now.first_patch + p);
      if (now.name == "exit copy") CHECK(was == none_index);
      if (now.name == "exit copy") continue;
      REQUIRE(was != none_index);
      CHECK(back->patch_before(was) == now.first_patch + p);
    }
  const auto& body = b->surfaces.back();
  REQUIRE(body.name == "panel body");
  CHECK(bins->patch_before(body.first_patch) == a->surfaces.back().first_patch);
  CHECK(a->surfaces.back().first_patch < body.first_patch);
  LiveRun before(a, 1, 1, nullptr, false);
  reach(before, 8);
  told(before);
  const LiveRun after(b, 1, 1, &before, true);
  for (const char* name : {"left", "panel", "sign exit"}) {
    const int was = group_of(before, name), now = group_of(after, name);
    const Readout then(*a, before.shown(was)), here(*b, after.shown(now));
    for (const uint32_t block : {a->blocks.patches, a->blocks.surfaces}) {
      const bool patches = block == a->blocks.patches;
      const auto last = [&](const CompiledScene& of) {
        return patches ? of.patch_count - 2 : static_cast<uint32_t>(of.surfaces.size()) - 1;
      };
      const double caught_then = then.lumens(block, last(*a), 0, was).value;
      CHECK(caught_then > 0);
      CHECK(here.lumens(block, last(*b), 0, now).value == caught_then);
    }
    CHECK(here.lumens(b->blocks.escape, 0, 0, now).value ==
          then.lumens(a->blocks.escape, 0, 0, was).value);
  }
  const auto same = BinMap::between(*a, *room.compiled(moved_sign()));
  REQUIRE(same);
  CHECK(same->is_same());
  SceneEdits beyond;  // then the room's centre, the origin of coordinates, is elsewhere
  beyond.luminaires["left"] = {{-3, 1, 1}, std::nullopt};
  CHECK_FALSE(BinMap::between(*a, *room.compiled(beyond)));
}

TEST_CASE("other smoke keeps nothing but the frame of geometry", "[view]") {
  const LiveRoom room;
  LiveRun before(room.compiled({}), 1, 1, nullptr, false);
  reach(before, 2);
  told(before);
  const LiveRun after(room.compiled({}), 1, 1, &before, false);
  CHECK(after.same_geometry());
  CHECK(after.groups_with(ShownLight::none) == 3);
}

TEST_CASE("tracing stops between batches on request, and continues", "[view]") {
  const LiveRoom room;
  LiveRun run(room.compiled({}), 1, 1, nullptr, false);
  int asked = 0;
  ThreadExecutor one(1);
  CHECK_FALSE(run.trace(
      8, LiveRun::Scope::all, one,
      [&] { return ++asked > 3 ? LiveRun::Stop::now : LiveRun::Stop::none; }, [] {}));
  CHECK(run.particles() == 3 * run.scene().batch_particles);
  reach(run, 8);
  CHECK(run.particles() >= 3 * 8 * run.scene().batch_particles - 3 * run.scene().batch_particles);
}

// Steps of edits, undone and redone.
#include "actors/apps/view/edit_history.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

using std::chrono::milliseconds;

constexpr EditHistory::Time start{};

EditHistory::Time after(int ms) {
  return start + std::chrono::hours(1) + milliseconds(ms);
}

EditedState with_smoke(double smoke) {
  EditedState state;
  state.edits.smoke = smoke;
  return state;
}

EditedState with_factor(const std::string& group, double factor, EditedState from = {}) {
  from.factors[group] = factor;
  return from;
}

EditStep factor_of(const std::string& group, double value) {
  return {EditKind::factor, {group}, value};
}

}  // namespace

TEST_CASE("steps are undone, redone, and forgotten by the next edit", "[view]") {
  EditHistory history({});
  history.note({EditKind::smoke, {}, 2}, with_smoke(2), after(0));
  history.note(factor_of("lamp", 0.5), with_factor("lamp", 0.5, with_smoke(2)), after(5000));
  REQUIRE(history.steps().size() == 2);
  CHECK(history.done() == 2);
  CHECK(history.go_to(1) == with_smoke(2));
  CHECK(history.go_to(0) == EditedState{});
  CHECK(history.go_to(2) == with_factor("lamp", 0.5, with_smoke(2)));
  (void)history.go_to(1);
  history.note({EditKind::smoke, {}, 3}, with_smoke(3), after(9000));
  CHECK(history.steps().size() == 2);
  CHECK(history.steps()[1].kind == EditKind::smoke);
  CHECK(history.go_to(1) == with_smoke(2));
}

TEST_CASE("a dragged slider and a click on many lights are one step", "[view]") {
  EditHistory history({});
  EditedState state;
  for (int i = 1; i <= 10; ++i) {
    state.factors["lamp"] = 0.1 * i;
    const auto noted = history.note(factor_of("lamp", 0.1 * i), state, after(500 * i));
    CHECK(noted == (i == 1 ? EditHistory::Noted::changed : EditHistory::Noted::continued));
  }
  REQUIRE(history.steps().size() == 1);
  CHECK(history.steps()[0].value == 1.0);
  CHECK(history.steps()[0].names == std::vector<std::string>{"lamp"});
  for (int i = 0; i < 3; ++i) {
    state.factors["lamp " + std::to_string(i)] = 0;
    history.note(factor_of("lamp " + std::to_string(i), 0), state, after(9000 + 100 * i));
  }
  REQUIRE(history.steps().size() == 2);
  CHECK(history.steps()[1].names.size() == 3);
  CHECK(history.go_to(0) == EditedState{});
  SECTION("after an undo, the next edit is a step of its own") {
    history.note(factor_of("lamp", 0.3), with_factor("lamp", 0.3), after(9300));
    CHECK(history.steps().size() == 1);
    CHECK(history.go_to(0) == EditedState{});
  }
}

TEST_CASE("what changes nothing, or only the time of the scene, is no step", "[view]") {
  EditHistory history(with_smoke(2));
  CHECK(history.note({EditKind::smoke, {}, 2}, with_smoke(2), after(0)) ==
        EditHistory::Noted::nothing);
  EditedState later = with_smoke(2);
  later.edits.at_s = 60;
  history.note({EditKind::smoke, {}, 2}, later, after(5000));
  CHECK(history.steps().empty());
}

TEST_CASE("refused steps are forgotten, and dimming between them stays", "[view]") {
  EditHistory history({});
  history.note({EditKind::smoke, {}, 2}, with_smoke(2), after(0));
  history.note({EditKind::smoke, {}, 3}, with_smoke(3), after(5000));
  history.note(factor_of("lamp", 0.5), with_factor("lamp", 0.5, with_smoke(3)), after(9000));
  // The smoke of 3 is refused; the lamp stays dimmed.
  const auto factors = history.take_back(with_factor("lamp", 0.5, with_smoke(2)));
  CHECK(factors == std::map<std::string, double>{{"lamp", 0.5}});
  REQUIRE(history.steps().size() == 2);
  CHECK(history.done() == 2);
  CHECK(history.steps()[1].kind == EditKind::factor);
  CHECK(history.go_to(2) == with_factor("lamp", 0.5, with_smoke(2)));
  CHECK(history.go_to(1) == with_smoke(2));
  CHECK(history.go_to(0) == EditedState{});
}

TEST_CASE("an undo that is refused loses no step, and its factors come back", "[view]") {
  EditHistory history({});
  const EditedState dimmed = with_factor("lamp", 0.5, with_smoke(2));
  history.note({EditKind::smoke, {}, 2}, with_smoke(2), after(0));
  history.note(factor_of("lamp", 0.5), dimmed, after(5000));
  history.note({EditKind::smoke, {}, 3}, with_factor("lamp", 0.5, with_smoke(3)), after(9000));
  for (const size_t wanted : {size_t{0}, size_t{1}}) {
    CHECK(history.go_to(3).edits.smoke == 3);
    (void)history.go_to(wanted);  // is refused, while the smoke of 3 is traced
    CHECK(history.take_back(with_smoke(3)) == dimmed.factors);
    CHECK(history.steps().size() == 3);
    CHECK(history.done() == 3);
    CHECK(history.go_to(0) == EditedState{});
  }
}

TEST_CASE("a drag that returns to where it began is no step", "[view]") {
  EditHistory history({});
  history.note(factor_of("lamp", 0.5), with_factor("lamp", 0.5), after(0));
  CHECK(history.note(factor_of("lamp", 1), {}, after(500)) == EditHistory::Noted::changed);
  CHECK(history.steps().empty());
  CHECK(history.done() == 0);
}

TEST_CASE("two moves of one thing are two steps, however quick", "[view]") {
  EditHistory history({});
  EditedState state;
  for (int i = 1; i <= 2; ++i) {
    state.edits.luminaires["lamp"] = {glm::dvec3(i), std::nullopt};
    history.note({EditKind::move, {"lamp"}, {}}, state, after(600 * i));
  }
  CHECK(history.steps().size() == 2);
}

TEST_CASE("the oldest of too many steps are forgotten", "[view]") {
  EditHistory history({});
  const size_t many = limits::view_steps + 5;
  for (size_t i = 1; i <= many; ++i)
    history.note({EditKind::smoke, {}, static_cast<double>(i)}, with_smoke(static_cast<double>(i)),
                 after(5000 * static_cast<int>(i)));
  CHECK(history.steps().size() == limits::view_steps);
  CHECK(history.done() == limits::view_steps);
  CHECK(history.go_to(0) == with_smoke(5));
}

#include "runtime/net/link_state.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace luxodus;

namespace {

enum class Event { greeted, unreachable, accepted, acknowledged, heard, bye, refused, silence };

constexpr LinkTimes times{};
constexpr Incarnation first_life{7}, second_life{8};

/// A link in this phase at time 0, with the peer's first incarnation.
LinkState in(LinkPhase phase) {
  LinkState link(times, 0);
  if (phase == LinkPhase::connecting) return link;
  link.greeted(0);
  if (phase == LinkPhase::greeting) return link;
  if (phase == LinkPhase::refused) {
    link.refuse(0);
    return link;
  }
  link.accept(first_life, 0);
  link.acknowledge(0);
  if (phase == LinkPhase::suspect) link.tick(3 * times.beat);
  if (phase == LinkPhase::down) link.bye(0);
  REQUIRE(link.phase() == phase);
  return link;
}

void feed(LinkState& link, Event event) {
  constexpr Nanoseconds now = 1;
  switch (event) {
    case Event::greeted:
      return link.greeted(now);
    case Event::unreachable:
      return link.unreachable(now);
    case Event::accepted:
      return (void)link.accept(second_life, now);
    case Event::acknowledged:
      return link.acknowledge(now);
    case Event::heard:
      return link.heard(now);
    case Event::bye:
      return link.bye(now);
    case Event::refused:
      return link.refuse(now);
    case Event::silence:
      return link.tick(times.patience + 1);
  }
}

}  // namespace

TEST_CASE("every phase of a link handles every event as in the diagram", "[runtime][link]") {
  using enum LinkPhase;
  struct Row {
    LinkPhase from;
    LinkPhase greeted, unreachable, accepted, acknowledged, heard, bye, refused, silence;
  };
  const Row table[] = {
      // from       greeted     unreachable accepted   acknowl.  heard     bye      refused  silence
      {connecting, greeting, connecting, greeting, connecting, connecting, down, refused, down},
      {greeting, greeting, connecting, greeting, greeting, greeting, down, refused, down},
      {up, up, down, greeting, up, up, down, refused, down},
      {suspect, suspect, down, greeting, up, up, down, refused, down},
      {down, down, down, greeting, down, down, down, refused, connecting},
      {refused, refused, refused, greeting, refused, refused, refused, refused, refused},
  };
  for (const Row& row : table) {
    const auto check = [&](Event event, LinkPhase to) {
      LinkState link = in(row.from);
      feed(link, event);
      INFO(name_of(row.from) << ", event " << static_cast<int>(event) << ": "
                             << name_of(link.phase()) << ", not " << name_of(to));
      CHECK(link.phase() == to);
    };
    check(Event::greeted, row.greeted);
    check(Event::unreachable, row.unreachable);
    check(Event::accepted, row.accepted);
    check(Event::acknowledged, row.acknowledged);
    check(Event::heard, row.heard);
    check(Event::bye, row.bye);
    check(Event::refused, row.refused);
    check(Event::silence, row.silence);
  }
}

TEST_CASE("a link is suspect after three silent beats and down after eight", "[runtime][link]") {
  LinkState link = in(LinkPhase::up);
  link.tick(3 * times.beat - 1);
  CHECK(link.phase() == LinkPhase::up);
  link.tick(3 * times.beat);
  CHECK(link.phase() == LinkPhase::suspect);
  CHECK(link.usable());
  link.tick(8 * times.beat - 1);
  CHECK(link.phase() == LinkPhase::suspect);
  link.tick(8 * times.beat);
  CHECK(link.phase() == LinkPhase::down);
  CHECK_FALSE(link.usable());
}

TEST_CASE("a node that was stalled itself suspects no neighbour", "[runtime][link]") {
  LinkState link = in(LinkPhase::up);
  link.forgive(seconds(5));
  link.tick(seconds(5));
  CHECK(link.phase() == LinkPhase::up);
}

TEST_CASE("hellos become rarer, up to a bound", "[runtime][link]") {
  LinkState link(times, 0);
  Nanoseconds now = 0, last_gap = 0;
  for (int i = 0; i < 8; ++i) {
    REQUIRE(link.hello_due(now));
    link.unreachable(now);
    CHECK_FALSE(link.hello_due(now));
    Nanoseconds due = now;
    while (!link.hello_due(due)) due += milliseconds(10);
    CHECK(due - now >= last_gap);
    last_gap = due - now;
    now = due;
    if (link.phase() != LinkPhase::connecting) break;
  }
  CHECK(last_gap <= times.max_backoff);
}

TEST_CASE("a peer that greets again and again, as it does not hear us, keeps no link up",
          "[runtime][link]") {
  LinkState link = in(LinkPhase::up);
  for (Nanoseconds now = 0; now <= 8 * times.beat; now += times.beat / 2) {
    CHECK_FALSE(link.accept(first_life, now));
    link.tick(now);
  }
  CHECK(link.phase() == LinkPhase::down);
}

TEST_CASE("a new incarnation of the peer is told from the same one", "[runtime][link]") {
  LinkState link = in(LinkPhase::up);
  CHECK_FALSE(link.accept(first_life, 1));
  CHECK(link.phase() == LinkPhase::up);
  CHECK(link.accept(second_life, 1));
  CHECK(link.phase() == LinkPhase::greeting);
  CHECK(link.peer() == second_life);
}

TEST_CASE("a link that was down comes up again with the same incarnation", "[runtime][link]") {
  LinkState link = in(LinkPhase::down);
  CHECK_FALSE(link.accept(first_life, 1));
  link.acknowledge(1);
  CHECK(link.phase() == LinkPhase::up);
}

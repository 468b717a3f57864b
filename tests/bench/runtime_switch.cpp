#include <fmt/core.h>

#include <functional>
#include <string>

#include "runtime/actor/actor.hpp"
#include "runtime/core/random.hpp"
#include "runtime/messaging/node_actor.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr size_t resumes_per_turn = 1'000'000;

/// `piece` performs `count` operations; prints the cost of one.
void print_cost(const std::string& name, int repeats, size_t count,
                const std::function<void()>& piece) {
  std::vector<double> ns;
  piece();  // touches stack pages and fills caches
  for (int r = 0; r < repeats; ++r) {
    const double start = thread_seconds();
    piece();
    ns.push_back((thread_seconds() - start) * 1e9 / static_cast<double>(count));
  }
  const Summary s = summarise(ns);
  fmt::print("{:<44} {:>8.1f} {:>8.1f}-{:.1f}\n", name, s.median, s.low, s.high);
}

FiberLimits limits_for(size_t count) {
  FiberLimits limits;
  limits.count = count;
  return limits;
}

/// Starts `count` fibers that yield until they are cancelled.
void start_yielding(Fibers& fibers, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const auto started = fibers.start("bench", [&fibers] {
      while (fibers.yield() == Wake::woken) {
      }
    });
    LUX_CHECK(started.has_value(), "the limits count every fiber of the benchmark");
  }
}

void end_all(Fibers& fibers) {
  fibers.cancel_all();
  while (fibers.live() > 0) fibers.run_next();
}

void print_switches(int repeats) {
  for (const size_t count : {1u, 100u, 1000u, 10'000u}) {
    Fibers fibers(limits_for(count));
    start_yielding(fibers, count);
    print_cost(fmt::format("resume and suspend, {} fibers", count), repeats, resumes_per_turn,
               [&fibers] {
                 for (size_t i = 0; i < resumes_per_turn; ++i) fibers.run_next();
               });
    end_all(fibers);
  }
}

/// The cost under the scheduler, which reads the clock after each resume.
void print_scheduled(int repeats) {
  const SystemClock clock;
  QuietSource source(clock);
  SchedulerLimits limits;
  limits.fibers = limits_for(1000);
  Scheduler scheduler(limits, clock, source);
  constexpr size_t turns = 10'000;
  print_cost("a turn with nothing to do", repeats, turns, [&] {
    for (size_t i = 0; i < turns; ++i) scheduler.turn();
  });
  start_yielding(scheduler.fibers(), 1000);
  print_cost("resume and suspend, 1000 fibers, scheduled", repeats, resumes_per_turn, [&] {
    const uint64_t end = scheduler.counters().resumes + resumes_per_turn;
    while (scheduler.counters().resumes < end) scheduler.turn();
  });
  end_all(scheduler.fibers());
}

struct Ping {
  uint64_t number;
};
struct Nudge {
  uint64_t number;
};

class Counter final : public Actor<Counter, ControlLane<Accepts<Nudge, 64, WhenFull::reject>>,
                                   DataLane<Accepts<Ping, 64, WhenFull::wait>>> {
 public:
  explicit Counter(Scheduler& scheduler) : Actor(scheduler, "counter") {}
  void on(const Ping& ping) { sum += ping.number; }
  void on(const Nudge& nudge) { sum += nudge.number; }
  uint64_t sum = 0;
};

void print_messages(int repeats) {
  const SystemClock clock;
  QuietSource source(clock);
  SchedulerLimits limits;
  limits.fibers = limits_for(2);
  Scheduler scheduler(limits, clock, source);
  Counter counter(scheduler);
  counter.start();
  constexpr uint64_t messages = 200'000;
  print_cost("data message sent and handled, mailbox of 64", repeats, messages, [&] {
    const auto sender = scheduler.fibers().start("sender", [&counter] {
      for (uint64_t i = 0; i < messages; ++i)
        if (counter.send(Ping{i}) != Offered::taken) return;
    });
    LUX_CHECK(sender.has_value(), "the sender before has ended");
    while (scheduler.fibers().live() > 1 || counter.waiting() > 0) scheduler.turn();
  });
  print_cost("control message sent and handled, 64 a turn", repeats, messages, [&] {
    for (uint64_t i = 0; i < messages; ++i)
      if (counter.offer(Nudge{i}) == Offered::rejected || i % 64 == 63) scheduler.turn();
  });
  end_all(scheduler.fibers());
}

/// Answers each message by one to its partner.
class Player final : public Actor<Player, ControlLane<Accepts<Nudge, 1, WhenFull::reject>>,
                                  DataLane<Accepts<Ping, 1, WhenFull::reject>>> {
 public:
  explicit Player(Scheduler& scheduler) : Actor(scheduler, "player") {}
  void on(const Nudge& nudge) { LUX_CHECK(give(nudge) == Offered::taken, "one ball"); }
  void on(const Ping& ping) { LUX_CHECK(give(ping) == Offered::taken, "one ball"); }
  Player* partner = nullptr;
  uint64_t played = 0;

 private:
  template <class Ball>
  Offered give(const Ball& ball) {
    ++played;
    return partner->offer(Ball{ball.number + 1});
  }
};

/// Two actors that answer each other: on the control lane each message takes a turn.
void print_ping_pong(int repeats) {
  const SystemClock clock;
  QuietSource source(clock);
  SchedulerLimits limits;
  limits.fibers = limits_for(2);
  constexpr uint64_t messages = 200'000;
  const auto measure = [&](const char* name, auto ball) {
    Scheduler scheduler(limits, clock, source);
    Player first(scheduler), second(scheduler);
    first.partner = &second;
    second.partner = &first;
    first.start();
    second.start();
    LUX_CHECK(first.offer(ball) == Offered::taken, "its mailbox is empty");
    print_cost(name, repeats, messages, [&] {
      const uint64_t end = first.played + messages / 2;
      while (first.played < end) scheduler.turn();
    });
    end_all(scheduler.fibers());
  };
  measure("ping-pong on the control lane, one way", Nudge{0});
  measure("ping-pong on the data lane, one way", Ping{0});
}

/// For a node without neighbours.
class NoTransport final : public Transport {
 public:
  Sent send(NodeId, Lane, std::span<const std::byte>, std::span<const std::byte>) override {
    return Sent::unreachable;
  }
  void renew(NodeId) override {}
  std::optional<Arrival> receive() override { return std::nullopt; }
  void wait_until(Nanoseconds) override {}
  void wake() noexcept override {}
};
class NoHandler final : public NetHandler {
 public:
  bool deliver(const Delivery&) override { return true; }
  std::span<std::byte> room_for(const MessageId&, NodeId, ActorPair, size_t) override { return {}; }
  void abandoned(const MessageId&, Kind) override {}
  bool intercept(const Delivery&) override { return false; }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{no_node}}; }
};

class Lender final
    : public NodeActor<Lender, ControlLane<Accepts<Letter<RequestLease>, 64, WhenFull::reject>>,
                       DataLane<>> {
 public:
  Lender(Scheduler& scheduler, Sender& sender)
      : NodeActor(scheduler, sender, {{0}, ActorName{1}}, "lender") {}
  void on(const Letter<RequestLease>& request) { sum += request.body.batches; }
  uint64_t sum = 0;
};

/// Messages by address, as between actors of different nodes.
void print_letters(int repeats) {
  const SystemClock clock;
  QuietSource source(clock);
  SchedulerLimits limits;
  limits.fibers = limits_for(1);
  Scheduler scheduler(limits, clock, source);
  NoTransport transport;
  NoHandler handler;
  NetConfig config;
  config.self = {0};
  config.incarnation = {1};
  config.nodes = 1;
  Network network(config, transport, handler, clock.now());
  ActorSystem system({0}, network, 1 << 20);
  Lender lender(scheduler, system);
  system.add(ActorName{1}, lender, "lender");
  constexpr uint64_t letters = 200'000;
  print_cost("letter to an actor of the node, 64 a turn", repeats, letters, [&] {
    for (uint32_t i = 0; i < letters; ++i) {
      const SendOutcome sent =
          system.send({{0}, ActorName{2}}, lender.address(), system.next_id(), RequestLease{i});
      if (sent != SendOutcome::taken || i % 64 == 63) scheduler.turn();
    }
  });
}

void print_timers(int repeats) {
  constexpr size_t standing = 10'000;  // further timers, seconds ahead
  constexpr size_t count = 200'000;
  Timers timers(standing + 1, 0);
  Random random(1, RandomStream::test);
  random.start(0);
  for (size_t i = 0; i < standing; ++i)
    timers.set(seconds(1'000'000) + Nanoseconds{random.bits()}, [] {});
  Nanoseconds now = 0;
  print_cost("timer set and cancelled, 10 000 others", repeats, count, [&] {
    for (size_t i = 0; i < count; ++i) timers.cancel(timers.set(now + milliseconds(50), [] {}));
  });
  print_cost("timer set and fired, 10 000 others", repeats, count, [&] {
    for (size_t i = 0; i < count; ++i) {
      timers.set(now + milliseconds(1), [] {});
      timers.run_due(now += milliseconds(1), 1);
    }
  });
}

}  // namespace

void print_switch(int repeats) {
  fmt::print("\nRuntime [ns]\n{:<44} {:>8} {:>13}\n", "piece", "median", "spread");
  print_switches(repeats);
  print_scheduled(repeats);
  print_messages(repeats);
  print_ping_pong(repeats);
  print_letters(repeats);
  print_timers(repeats);
}

}  // namespace luxodus::bench

// Fiber switches under a scheduler; and frames between two networks over memory. Both ends run on
// one thread, so its CPU time is their whole cost. Links to other machines cost a node's thread the
// same; the work of kernels and I/O threads comes on top.
#include <algorithm>
#include <atomic>
#include <thread>

#include "actors/lab/study/calibrate.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/core/processor_time.hpp"
#include "runtime/net/net_pair.hpp"
#include "runtime/net/network.hpp"
#include "runtime/net/zmq_transport.hpp"

namespace luxodus {

namespace {

using net_pair::asker, net_pair::holder, net_pair::config_of;

constexpr size_t fibers = 256;
constexpr int turns = 20'000;
constexpr int questions = 20'000;
constexpr int objects = 1'000;
constexpr size_t object_bytes = 48 << 10;  // one frame of the bulk lane
constexpr int trips = 4'000;

const SystemClock& machine_clock() {
  static const SystemClock clock;
  return clock;
}

void measure_switches(SimCosts& costs) {
  QuietSource source(machine_clock());
  SchedulerLimits limits;
  limits.fibers.count = fibers;
  Scheduler scheduler(limits, machine_clock(), source);
  double start = thread_seconds();
  for (int i = 0; i < turns; ++i) scheduler.turn();
  costs.turn_ns = thread_nanoseconds_since(start) / turns;
  for (size_t i = 0; i < fibers; ++i)
    (void)scheduler.fibers().start("measured", [&scheduler] {
      while (scheduler.fibers().yield() == Wake::woken) {
      }
    });
  for (int i = 0; i < 100; ++i) scheduler.turn();
  const uint64_t before = scheduler.counters().resumes;
  start = thread_seconds();
  for (int i = 0; i < turns / 10; ++i) scheduler.turn();
  costs.switch_ns =
      thread_nanoseconds_since(start) /
      static_cast<double>(std::max<uint64_t>(1, scheduler.counters().resumes - before));
  scheduler.fibers().cancel_all();
  while (scheduler.fibers().live() > 0) (void)scheduler.fibers().run_next();
}

/// Sends requests, or answers them: for object 0 "not here", for object n with n bytes.
class Peer final : public NetHandler {
 public:
  Peer(ZmqContext& context, NodeId self)
      : transport(context, {self, std::nullopt, false}, machine_clock()),
        network(config_of(self), transport, *this, machine_clock().now()),
        room_(object_bytes / 8 + 64),
        object_(std::make_shared<std::vector<std::byte>>(object_bytes)) {}

  bool deliver(const Delivery& d) override {
    if (const auto* fetch = std::get_if<FetchObject>(&d.message)) {
      if (fetch->object.value == 0)
        return network.send(d.source, d.id, ObjectNotHere{}) == SendOutcome::taken;
      const std::span bytes = std::span(*object_).first(fetch->object.value);
      return network.send(d.source, d.id, ObjectFound{}, {bytes, object_}) == SendOutcome::taken;
    }
    ++answers;
    return true;
  }
  std::span<std::byte> room_for(const MessageId&, NodeId, ActorPair, size_t) override {
    return std::as_writable_bytes(std::span(room_));  // the content is ignored
  }
  void abandoned(const MessageId&, Kind) override {}
  bool intercept(const Delivery&) override { return false; }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{asker, holder}}; }

  void ask(uint64_t object) {
    while (network.send(holder, network.next_id(), FetchObject{{object}, 0, 1}) !=
           SendOutcome::taken)
      network.poll(machine_clock().now());
  }

  ZmqTransport transport;
  Network network;
  size_t answers = 0;

 private:
  std::vector<uint64_t> room_;
  std::shared_ptr<std::vector<std::byte>> object_;
};

void poll_both(Peer& first, Peer& second) {
  const Nanoseconds now = machine_clock().now();
  first.network.poll(now);
  second.network.poll(now);
}

/// Cost of one request with its answer, eight in flight at a time [ns].
double question_cost(Peer& first, Peer& second, uint64_t object, int count) {
  first.answers = 0;
  size_t asked = 0;
  const double start = thread_seconds();
  while (first.answers < static_cast<size_t>(count)) {
    while (asked < static_cast<size_t>(count) && asked - first.answers < 8) {
      first.ask(object);
      ++asked;
    }
    poll_both(first, second);
  }
  return thread_nanoseconds_since(start) / count;
}

/// Cost of a request with its answer between two threads that are idle meanwhile [ns].
struct RoundTrip {
  double span;  // from sending to the answer, median of many
  double work;  // CPU time of the asking thread
};

RoundTrip round_trip(Peer& first, Peer& second) {
  std::atomic<bool> done{false};
  const auto run = [](Peer& peer, auto&& until) {
    while (!until()) {
      if (!peer.network.poll(machine_clock().now()) && !until())
        peer.transport.wait_until(peer.network.next_deadline());
    }
  };
  std::thread answering([&] { run(second, [&] { return done.load(); }); });
  std::vector<double> spans;
  const double begun = thread_seconds();
  for (int i = 0; i < trips; ++i) {
    first.answers = 0;
    const Nanoseconds start = machine_clock().now();
    first.ask(0);
    run(first, [&] { return first.answers > 0; });
    spans.push_back(static_cast<double>(machine_clock().now() - start));
  }
  const double work = thread_nanoseconds_since(begun) / trips;
  done = true;
  second.transport.wake();
  answering.join();
  std::nth_element(spans.begin(), spans.begin() + trips / 2, spans.end());
  return {spans[trips / 2], work};
}

Result<void> measure_frames(SimCosts& costs) {
  ZmqContext context({});
  Peer first(context, asker), second(context, holder);
  const Endpoints where{"inproc://calibrate", "inproc://calibrate-bulk"};
  if (auto bound = first.transport.listen(where); !bound) return bound.problem();
  if (auto joined = second.transport.connect(asker, where, ""); !joined) return joined.problem();
  while (first.network.phase(holder) != LinkPhase::up ||
         second.network.phase(asker) != LinkPhase::up)
    poll_both(first, second);
  double start = thread_seconds();
  for (int i = 0; i < turns; ++i) poll_both(first, second);
  costs.turn_ns += thread_nanoseconds_since(start) / (2 * turns);
  (void)question_cost(first, second, 0, questions / 10);  // warm-up
  const double small = question_cost(first, second, 0, questions);
  const double large = question_cost(first, second, object_bytes, objects);
  // Two frames, each sent and received; the object's bytes at both ends.
  costs.send_ns = costs.receive_ns = small / 4;
  costs.frame_byte_ns = std::max(0.0, large - small) / (2.0 * object_bytes);
  const RoundTrip trip = round_trip(first, second);
  // Each end sends one frame, receives one, and goes idle once.
  costs.rest_ns = std::max(0.0, trip.work - small / 2);
  costs.wake_ns = std::max(0.0, trip.span / 2 - small / 2 - costs.rest_ns);
  return {};
}

}  // namespace

Result<void> measure_loop(SimCosts& costs) {
  measure_switches(costs);
  return measure_frames(costs);
}

}  // namespace luxodus

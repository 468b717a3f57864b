// The network alone, two nodes on two threads, one table: round trips of a small request (one at a
// time), requests a second (64 at a time), and objects a second with the size of a brick of smoke,
// of eight bricks, and of a geometry cell (8 at a time).
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "runtime/net/net_pair.hpp"
#include "runtime/net/network.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "tests/bench/net_tables.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::bench {

using namespace net_pair;

namespace {

constexpr size_t object_bytes[] = {16 << 10, 128 << 10, 1 << 20};
constexpr size_t max_object_bytes = 1 << 20;
constexpr size_t questions_at_once = 64;
constexpr size_t objects_at_once = 8;

const SystemClock system_clock;

/// Sends or answers requests; those for object 0 are answered "not here", those for object n with n
/// bytes.
class Peer final : public NetHandler {
 public:
  Peer(ZmqContext& context, const ZmqConfig& zmq)
      : self_(zmq.self),
        transport(context, zmq, system_clock),
        network(config_of(zmq.self), transport, *this, system_clock.now()),
        room_(max_object_bytes / 8 + 64),
        object_(std::make_shared<std::vector<std::byte>>(max_object_bytes)) {}

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
    return std::as_writable_bytes(std::span(room_));  // the content is ignored, so all share it
  }
  void abandoned(const MessageId&, Kind) override {}
  bool intercept(const Delivery&) override { return false; }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{asker, holder}}; }

  /// Polls, and waits between polls, until `done`.
  template <class Done>
  void run_until(Done done) {
    for (;;) {
      const bool more = network.poll(system_clock.now());
      if (done()) return;
      if (!more) transport.wait_until(network.next_deadline());
    }
  }
  /// Keeps `at_once` requests in flight for this long; returns answers per second.
  double load(uint64_t object, size_t at_once, Nanoseconds span) {
    answers = 0;
    size_t asked = 0;
    const Nanoseconds start = system_clock.now();
    while (system_clock.now() - start < span) {
      while (asked - answers < at_once &&
             network.send(holder, network.next_id(), FetchObject{{object}, 0, 1}) ==
                 SendOutcome::taken)
        ++asked;
      const size_t before = answers;
      run_until([&] { return answers > before; });
    }
    const double rate =
        static_cast<double>(answers) * 1e9 / static_cast<double>(system_clock.now() - start);
    run_until([&] { return answers == asked; });
    return rate;
  }
  /// Round trips of one request at a time [us], sorted.
  std::vector<double> round_trips(Nanoseconds span) {
    std::vector<double> out;
    const Nanoseconds end = system_clock.now() + span;
    while (system_clock.now() < end) {
      answers = 0;
      const Nanoseconds start = system_clock.now();
      network.send(holder, network.next_id(), FetchObject{});
      run_until([&] { return answers > 0; });
      out.push_back(1e-3 * static_cast<double>(system_clock.now() - start));
    }
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  NodeId self_;

 public:
  ZmqTransport transport;
  Network network;
  size_t answers = 0;

 private:
  std::vector<uint64_t> room_;
  std::shared_ptr<std::vector<std::byte>> object_;
};

void measure(const char* name, const Endpoints& where, bool curve, Nanoseconds span) {
  const KeyPair keys[2] = {make_keypair(), make_keypair()};
  ZmqContext shared({{holder, keys[1].public_key}});
  ZmqConfig zmq[2] = {{asker}, {holder}};
  if (curve)
    for (int i = 0; i < 2; ++i) zmq[i].keys = keys[i];
  Peer first(shared, zmq[0]), second(shared, zmq[1]);
  const auto bound = first.transport.listen(where);
  if (!bound || !second.transport.connect(asker, bound.value(), keys[0].public_key)) {
    fmt::print("{:<12} cannot be had here\n", name);
    return;
  }
  std::atomic<bool> done{false};
  std::thread answering([&] { second.run_until([&] { return done.load(); }); });
  first.run_until([&] { return first.network.phase(holder) == LinkPhase::up; });
  first.load(0, questions_at_once, span / 10);  // warm-up
  const auto trips = first.round_trips(span);
  const double questions = first.load(0, questions_at_once, span);
  std::string objects;
  for (const size_t bytes : object_bytes)
    objects += fmt::format(" {:>11.0f}", first.load(bytes, objects_at_once, span));
  done = true;
  second.transport.wake();
  answering.join();
  fmt::print("{:<12} {:>9.1f} {:>9.1f} {:>12.0f}{}\n", name, trips[trips.size() / 2],
             trips[trips.size() * 99 / 100], questions, objects);
}

}  // namespace

void print_links(Nanoseconds span) {
  const test::TemporaryFolder folder;
  const std::string path = "ipc://" + (folder / "link").string();
  const Endpoints tcp{"tcp://127.0.0.1:*", "tcp://127.0.0.1:*"};
  fmt::print("{:<12} {:>9} {:>9} {:>12} {:>11} {:>11} {:>11}\n", "transport", "p50 [us]",
             "p99 [us]", "questions/s", "16 KiB/s", "128 KiB/s", "1 MiB/s");
  measure("inproc", {"inproc://first", "inproc://first-bulk"}, false, span);
  measure("ipc", {path + ".control", path + ".bulk"}, false, span);
  measure("tcp", tcp, false, span);
  measure("tcp + CURVE", tcp, true, span);
}

}  // namespace luxodus::bench

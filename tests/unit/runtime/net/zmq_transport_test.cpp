// Real sockets on this machine. Nodes are polled until the expected event; a limit on polls ends a
// failing test. The tests wait only for libzmq's own timers.
#include "runtime/net/zmq_transport.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string_view>
#include <thread>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId a{0}, b{1};
const SystemClock system_clock;

/// A node on real sockets.
struct RealNode {
  RealNode(ZmqContext& context, const ZmqConfig& zmq, const NetConfig& net)
      : transport(context, zmq, system_clock),
        handler(net),
        network(net, transport, handler, system_clock.now()) {}
  ZmqTransport transport;
  Handler handler;
  Network network;
};

/// Polls until `done`, waiting for frames in between; false if it takes thousands of turns.
bool poll_until(std::vector<RealNode*> nodes, const std::function<bool()>& done) {
  spdlog::set_level(spdlog::level::off);
  for (int turn = 0; turn < 20'000; ++turn) {
    for (RealNode* node : nodes) node->network.poll(system_clock.now());
    if (done()) return true;
    nodes[static_cast<size_t>(turn) % nodes.size()]->transport.wait_until(system_clock.now() +
                                                                          milliseconds(1));
  }
  return false;
}

bool both_up(RealNode& one, RealNode& other) {
  return poll_until({&one, &other}, [&] {
    return one.network.phase(b) == LinkPhase::up && other.network.phase(a) == LinkPhase::up;
  });
}

/// A request, and an answer of several chunks.
void exchange(RealNode& one, RealNode& other) {
  const auto object = pattern(300'001);
  other.handler.on_deliver = [&](const Delivery& d) {
    if (!std::holds_alternative<FetchObject>(d.message)) return true;
    return other.network.send(d.source, d.id, ObjectFound{{7}, b}, share(object)) ==
           SendOutcome::taken;
  };
  REQUIRE(one.network.send(b, one.network.next_id(), FetchObject{{7}, 0, 1}) == SendOutcome::taken);
  REQUIRE(poll_until({&one, &other}, [&] { return one.handler.count<ObjectFound>() == 1; }));
  CHECK(one.handler.taken[0].payload == object);
}

Endpoints tcp() {
  return {"tcp://127.0.0.1:*", "tcp://127.0.0.1:*"};
}

/// A program that is no node, and accepts without waiting; port 0: any free one.
int listener_at(uint16_t port) {
  const int out = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  ::setsockopt(out, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(port);
  REQUIRE(::bind(out, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
  REQUIRE(::listen(out, 8) == 0);
  return out;
}

/// A pair over TCP with CURVE: two contexts, as in two processes.
struct CurvePair {
  CurvePair(const std::vector<Admitted>& listed_at_a, const KeyPair& keys_of_a,
            const KeyPair& keys_of_b, const std::string& expected_of_a)
      : context_a(listed_at_a),
        context_b({}),
        one(context_a, {a, keys_of_a}, config_of(0, 2, ring(2), 1000)),
        other(context_b, {b, keys_of_b}, config_of(1, 2, ring(2), 1001)) {
    const auto where = one.transport.listen(tcp());
    REQUIRE(where.ok());
    REQUIRE(other.transport.connect(a, where.value(), expected_of_a).ok());
  }
  ZmqContext context_a, context_b;
  RealNode one, other;
};

}  // namespace

TEST_CASE("nodes exchange frames over inproc, ipc and tcp", "[runtime][zmq]") {
  const test::TemporaryFolder folder;
  const std::string path = folder / "link";
  const Endpoints table[] = {
      {"inproc://a", "inproc://a-bulk"},
      {"ipc://" + path + ".control", "ipc://" + path + ".bulk"},
      tcp(),
  };
  for (const Endpoints& where : table) {
    INFO(where.control);
    ZmqContext context({});
    RealNode one(context, {a}, config_of(0, 2, ring(2), 1000));
    RealNode other(context, {b}, config_of(1, 2, ring(2), 1001));
    const auto bound = one.transport.listen(where);
    REQUIRE(bound.ok());
    REQUIRE(other.transport.connect(a, bound.value()).ok());
    REQUIRE(both_up(one, other));
    exchange(one, other);
  }
}

TEST_CASE("nodes whose keys are listed exchange frames over CURVE", "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  CurvePair pair({{b, keys_b.public_key}}, keys_a, keys_b, keys_a.public_key);
  REQUIRE(both_up(pair.one, pair.other));
  exchange(pair.one, pair.other);
  CHECK(pair.context_a.let_in() == 2);  // one for each lane
  CHECK(pair.context_a.turned_away() == 0);
}

TEST_CASE("a client whose key is not listed is rejected, and both ends count it",
          "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  CurvePair pair({{b, make_keypair().public_key}}, keys_a, keys_b, keys_a.public_key);
  CHECK(poll_until({&pair.one, &pair.other}, [&] {
    return pair.context_a.turned_away() >= 2 && pair.other.transport.counters().refused_us >= 2;
  }));
  CHECK(pair.one.network.counters().frames_received == 0);
}

TEST_CASE("a wrong server key ends the handshake, and both ends count it", "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  CurvePair pair({{b, keys_b.public_key}}, keys_a, keys_b, make_keypair().public_key);
  CHECK(poll_until({&pair.one, &pair.other}, [&] {
    return pair.one.transport.counters().handshake_failed >= 1 &&
           pair.other.transport.counters().handshake_failed >= 1;
  }));
  CHECK(pair.one.network.counters().frames_received == 0);
  CHECK(pair.other.network.phase(a) != LinkPhase::up);
}

TEST_CASE("an aborted handshake at a proven endpoint is not reported as a wrong key",
          "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  ZmqContext context_b({});
  RealNode other(context_b, {b, keys_b}, config_of(1, 2, ring(2), 1001));
  Endpoints where;
  {
    ZmqContext context_a({{b, keys_b.public_key}});
    RealNode one(context_a, {a, keys_a}, config_of(0, 2, ring(2), 1000));
    where = one.transport.listen(tcp()).value();
    REQUIRE(other.transport.connect(a, where, keys_a.public_key).ok());
    REQUIRE(both_up(one, other));
  }
  // What a reconnecting neighbour sees of a leaving node: it accepts, and is gone.
  const int leaving = listener_at(
      static_cast<uint16_t>(std::stoi(where.control.substr(where.control.rfind(':') + 1))));
  CHECK(poll_until({&other}, [&] {
    if (const int came = ::accept(leaving, nullptr, nullptr); came >= 0) ::close(came);
    return other.transport.counters().broken_off >= 1;
  }));
  ::close(leaving);
  CHECK(other.transport.counters().handshake_failed == 0);
}

TEST_CASE("another program at a neighbour's port is not reported as a wrong key",
          "[runtime][zmq]") {
  const KeyPair keys_b = make_keypair();
  ZmqContext context({});
  RealNode other(context, {b, keys_b}, config_of(1, 2, ring(2), 1001));
  const int foreign = listener_at(0);
  sockaddr_in place{};
  socklen_t size = sizeof place;
  REQUIRE(::getsockname(foreign, reinterpret_cast<sockaddr*>(&place), &size) == 0);
  const std::string where = "tcp://127.0.0.1:" + std::to_string(ntohs(place.sin_port));
  REQUIRE(other.transport.connect(a, {where, where}, make_keypair().public_key).ok());
  SECTION("one that answers in its own protocol") {
    CHECK(poll_until({&other}, [&] {
      if (const int came = ::accept(foreign, nullptr, nullptr); came >= 0) {
        std::array<char, 256> request;
        (void)::recv(came, request.data(), request.size(), 0);
        const std::string_view answer = "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
        (void)::send(came, answer.data(), answer.size(), MSG_NOSIGNAL);
        ::close(came);
      }
      return other.transport.counters().not_a_node >= 1;
    }));
  }
  SECTION("one that waits in silence") {
    CHECK(poll_until({&other}, [&] { return other.transport.counters().not_a_node >= 1; }));
  }
  ::close(foreign);
  CHECK(other.transport.counters().handshake_failed == 0);
}

TEST_CASE("a node without keys is rejected if keys are required", "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair();
  ZmqContext context_a({}), context_b({});
  RealNode one(context_a, {a, keys_a}, config_of(0, 2, ring(2), 1000));
  RealNode other(context_b, {b}, config_of(1, 2, ring(2), 1001));
  const auto where = one.transport.listen(tcp());
  REQUIRE(where.ok());
  REQUIRE(other.transport.connect(a, where.value()).ok());
  CHECK(poll_until({&one, &other}, [&] { return one.transport.counters().handshake_failed >= 1; }));
  CHECK(one.network.counters().frames_received == 0);
}

TEST_CASE("a listed key is valid only for its own node", "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  // The key of node 2, used by a node that claims to be node 1.
  CurvePair pair({{{2}, keys_b.public_key}}, keys_a, keys_b, keys_a.public_key);
  CHECK(poll_until({&pair.one, &pair.other},
                   [&] { return pair.one.transport.counters().strangers >= 1; }));
  CHECK(pair.one.network.counters().frames_received == 0);
}

TEST_CASE("endpoints beyond the host need keys or the option insecure", "[runtime][zmq]") {
  ZmqContext context({});
  ZmqTransport without(context, {a}, system_clock);
  const auto refused = without.listen({"tcp://*:*", "tcp://*:*"});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("keygen") != std::string::npos);
  CHECK_FALSE(without.connect(b, {"tcp://192.0.2.1:7000", "tcp://192.0.2.1:7001"}).ok());
  ZmqConfig spelled_out{b};
  spelled_out.insecure = true;
  ZmqTransport insecure(context, spelled_out, system_clock);
  CHECK(insecure.listen({"tcp://*:*", "tcp://*:*"}).ok());

  CHECK(stays_on_host("tcp://127.0.0.1:7000"));
  CHECK(stays_on_host("ipc:///run/luxodus/n1"));
  CHECK_FALSE(stays_on_host("tcp://*:7000"));
  CHECK_FALSE(stays_on_host("tcp://10.0.0.1:7000"));
}

TEST_CASE("an endpoint in use is reported with a message", "[runtime][zmq]") {
  ZmqContext context({});
  ZmqTransport one(context, {a}, system_clock), other(context, {b}, system_clock);
  const auto where = one.listen(tcp());
  REQUIRE(where.ok());
  const auto taken = other.listen(where.value());
  REQUIRE_FALSE(taken.ok());
  CHECK(taken.problem().text().find("cannot listen") != std::string::npos);
}

TEST_CASE("a neighbour that does not exist is unreachable, not silently lost", "[runtime][zmq]") {
  ZmqContext context({});
  ZmqTransport alone(context, {b}, system_clock);
  REQUIRE(alone.connect(a, {"tcp://127.0.0.1:9", "tcp://127.0.0.1:9"}).ok());
  const std::array<std::byte, 8> frame{};
  CHECK(alone.send(a, Lane::control, frame, {}) == Sent::unreachable);
}

TEST_CASE("a restarted process is accepted over the same sockets", "[runtime][zmq]") {
  ZmqContext context_a({});
  RealNode one(context_a, {a}, config_of(0, 2, ring(2), 1000));
  const auto where = one.transport.listen(tcp());
  REQUIRE(where.ok());
  for (const uint64_t life : {1001u, 2001u}) {
    ZmqContext context_b({});
    RealNode other(context_b, {b}, config_of(1, 2, ring(2), life));
    REQUIRE(other.transport.connect(a, where.value()).ok());
    REQUIRE(both_up(one, other));
    one.handler.taken.clear();
    exchange(one, other);
  }
  CHECK(one.network.counters().links_up == 2);
}

TEST_CASE("a renewed connection carries frames again", "[runtime][zmq]") {
  const KeyPair keys_a = make_keypair(), keys_b = make_keypair();
  CurvePair pair({{b, keys_b.public_key}}, keys_a, keys_b, keys_a.public_key);
  REQUIRE(both_up(pair.one, pair.other));
  for (int i = 0; i < 3; ++i) {
    const uint64_t before = pair.one.transport.counters().connected;
    pair.other.transport.renew(a);
    pair.one.transport.renew(b);  // it was not opened there: no effect
    REQUIRE(poll_until({&pair.one, &pair.other},
                       [&] { return pair.one.transport.counters().connected >= before + lanes; }));
    REQUIRE(both_up(pair.one, pair.other));
    pair.one.handler.taken.clear();
    exchange(pair.one, pair.other);
  }
}

TEST_CASE("a peer that ends with unread frames does no harm", "[runtime][zmq][hostile]") {
  ZmqContext context_a({});
  ZmqConfig config{a};
  config.high_water_frames = 8;
  ZmqTransport node(context_a, config, system_clock);
  const auto where = node.listen(tcp());
  REQUIRE(where.ok());
  const auto frame = pattern(60'000);
  bool full = false;  // for so long that all frames have come that may
  {
    ZmqContext context_b({});
    config.self = b;
    ZmqTransport flood(context_b, config, system_clock);
    REQUIRE(flood.connect(a, where.value()).ok());
    Nanoseconds not_full_at = system_clock.now();
    for (const Nanoseconds end = not_full_at + seconds(20); !full && system_clock.now() < end;) {
      const Sent sent = flood.send(a, Lane::bulk, frame, {});
      if (sent != Sent::full) not_full_at = system_clock.now();
      if (sent != Sent::taken) flood.wait_until(system_clock.now() + milliseconds(1));
      full = system_clock.now() - not_full_at > milliseconds(300);
    }
  }
  REQUIRE(full);
  // libzmq's own timers act on the connection in these seconds.
  ZmqContext quiet({});
  ZmqTransport alone(quiet, {b}, system_clock);
  for (const Nanoseconds end = system_clock.now() + seconds(3); system_clock.now() < end;)
    alone.wait_until(end);
  // The I/O thread hands frames on while the node reads, so a look may find none in between.
  int come = 0;
  for (const Nanoseconds end = system_clock.now() + seconds(10);
       come < 8 && system_clock.now() < end;)
    if (node.receive())
      ++come;
    else
      node.wait_until(system_clock.now() + milliseconds(1));
  CHECK(come >= 8);
}

TEST_CASE("a wait ends when another thread wakes the node", "[runtime][zmq]") {
  ZmqContext context({});
  ZmqTransport alone(context, {a}, system_clock);
  alone.wake();
  alone.wait_until(system_clock.now() + seconds(1000));  // a wake before the wait counts
  std::thread other([&] { alone.wake(); });
  alone.wait_until(system_clock.now() + seconds(1000));
  other.join();
  SUCCEED("both waits ended");
}

TEST_CASE("a flooding peer fills only bounded queues of a node that does not read",
          "[runtime][zmq][hostile]") {
  spdlog::set_level(spdlog::level::off);
  ZmqContext context_a({}), context_b({});
  ZmqConfig config{a};
  config.high_water_frames = 32;
  ZmqTransport node(context_a, config, system_clock);
  const auto where = node.listen(tcp());
  REQUIRE(where.ok());
  config.self = b;
  ZmqTransport flood(context_b, config, system_clock);
  REQUIRE(flood.connect(a, where.value()).ok());
  const auto frame = pattern(60'000);
  constexpr int in_a_row = 300;  // consecutive turns without progress
  uint64_t taken = 0;
  int full = 0;
  for (int turn = 0; turn < 20'000 && full < in_a_row; ++turn) {
    const Sent sent = flood.send(a, Lane::bulk, frame, {});
    taken += sent == Sent::taken ? 1 : 0;
    full = sent == Sent::full ? full + 1 : 0;
    if (sent != Sent::taken) flood.wait_until(system_clock.now() + milliseconds(1));
  }
  CHECK(full == in_a_row);
  // Both queues, and the system's socket buffers, at most 12 MB.
  CHECK(taken >= 32);
  CHECK(taken < 64 + 300);
  uint64_t come = 0;
  for (int turn = 0; turn < 20'000 && come < taken; ++turn) {
    while (node.receive()) ++come;
    node.wait_until(system_clock.now() + milliseconds(1));
  }
  CHECK(come == taken);  // nothing was lost
}

TEST_CASE("silent or noisy strangers at the ports do not prevent handshakes",
          "[runtime][zmq][hostile]") {
  ZmqContext context_a({}), context_b({});
  RealNode one(context_a, {a}, config_of(0, 2, ring(2), 1000));
  RealNode other(context_b, {b}, config_of(1, 2, ring(2), 1001));
  const auto where = one.transport.listen(tcp());
  REQUIRE(where.ok());
  std::vector<int> strangers;
  for (int i = 0; i < 60; ++i) {
    const std::string& endpoint = i % 2 == 0 ? where.value().control : where.value().bulk;
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port =
        htons(static_cast<uint16_t>(std::stoi(endpoint.substr(endpoint.rfind(':') + 1))));
    strangers.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    REQUIRE(::connect(strangers.back(), reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
    const auto noise = pattern(i % 3 * 1000u, static_cast<unsigned>(i));  // or nothing
    (void)::send(strangers.back(), noise.data(), noise.size(), MSG_NOSIGNAL);
  }
  REQUIRE(other.transport.connect(a, where.value()).ok());
  REQUIRE(both_up(one, other));
  exchange(one, other);
  for (const int stranger : strangers) ::close(stranger);
}

// libzmq's behaviour decides the options (all in set_options): a ROUTER that is not MANDATORY drops
// frames silently; HANDOVER lets a neighbour that lost its connection take its name again;
// IMMEDIATE prevents frames from queueing without a connection; TCP_MAXRT ends a connection whose
// bytes are not acknowledged. Dead hosts, stuck nodes and streams that have lost their framing are
// detected by the heartbeats of Link, sent by the node's own loop, which then reconnects. ZMTP
// heartbeats stay off: libzmq 4.3.4 writes one to a closed connection whose input waited for room
// or for authentication, and aborts ("Assertion failed: !_io_error").
//
// Asking a socket that has nothing costs a system call and a check for a fork, more than a short
// turn of the node. A busy node therefore asks an empty socket only every few microseconds, and a
// wait polls the sockets' descriptors itself: zmq_poll would ask each socket before and after it.
#include "runtime/net/zmq_transport.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string_view>
#include <zmq.hpp>

#include "proto/messages.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// The longest frame: an envelope and a message, or a chunk, which is no longer.
constexpr int64_t max_frame_bytes = limits::frame_head_bytes + limits::message_bytes;
constexpr Nanoseconds reminder_interval = seconds(60);
/// Interval of checks for connections made and lost while the node is busy; an idle node is woken.
constexpr Nanoseconds look_interval = milliseconds(10);
/// Interval of looks at a socket that was empty, while the node is busy: a look takes 0.4 us, and 2
/// us where system calls are slow. A message's way to another thread takes at least as long.
constexpr Nanoseconds empty_interval = microseconds(20);

std::optional<NodeId> node_of(std::string_view name) {
  uint16_t number = 0;
  if (name.size() < 2 || name[0] != 'n') return std::nullopt;
  const auto read = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (read.ec != std::errc() || read.ptr != name.data() + name.size()) return std::nullopt;
  return NodeId{number};
}

bool is_inproc(const std::string& endpoint) {
  return endpoint.starts_with("inproc://");
}

}  // namespace

bool stays_on_host(const std::string& endpoint) {
  for (const char* local :
       {"inproc://", "ipc://", "tcp://127.", "tcp://localhost:", "tcp://[::1]:"})
    if (endpoint.starts_with(local)) return true;
  return false;
}

struct ZmqTransport::LaneSockets {
  LaneSockets(zmq::context_t& context, const char* lane_name)
      : name(lane_name),
        router(context, zmq::socket_type::router),
        monitor(context, zmq::socket_type::pair),
        router_descriptor(router.get(zmq::sockopt::fd)),
        monitor_descriptor(monitor.get(zmq::sockopt::fd)) {}

  const char* name;
  zmq::socket_t router;
  zmq::socket_t monitor;  // reports connections made and lost
  /// Readable after a change, until the socket is used the next time.
  const int router_descriptor, monitor_descriptor;
  /// The router was found empty, and has not been used since: its descriptor tells of arrivals.
  bool tells_arrivals = false;
  Nanoseconds look_at = 0;  // not before, while the node is busy
  zmq::message_t sender;
  zmq::message_t frame;  // the frame that the last Arrival points into
  /// Endpoints, bound or connected, at which a handshake has succeeded.
  std::set<std::string> met;
  /// Endpoints that we have connected to, and at which no handshake has ended yet.
  std::set<std::string> greeted;
};

ZmqTransport::ZmqTransport(ZmqContext& context, const ZmqConfig& config, const Clock& clock)
    : context_(context), config_(config), clock_(clock) {
  wake_descriptor_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (wake_descriptor_ < 0) throw std::runtime_error("zmq transport: no descriptor left");
  constexpr const char* lane_names[lanes] = {"control", "bulk"};
  for (size_t i = 0; i < lanes; ++i) {
    lanes_[i] = std::make_unique<LaneSockets>(context.context(), lane_names[i]);
    set_options(*lanes_[i]);
  }
}

ZmqTransport::~ZmqTransport() {
  for (auto& lane : lanes_) zmq_socket_monitor(lane->router.handle(), nullptr, 0);
  ::close(wake_descriptor_);
}

void ZmqTransport::set_options(LaneSockets& lane) {
  zmq::socket_t& s = lane.router;
  s.set(zmq::sockopt::routing_id, routing_id(config_.self));
  s.set(zmq::sockopt::router_mandatory, true);
  s.set(zmq::sockopt::router_handover, true);
  s.set(zmq::sockopt::immediate, true);
  s.set(zmq::sockopt::linger, 0);
  s.set(zmq::sockopt::sndhwm, config_.high_water_frames);
  s.set(zmq::sockopt::rcvhwm, config_.high_water_frames);
  s.set(zmq::sockopt::maxmsgsize, max_frame_bytes);
  s.set(zmq::sockopt::handshake_ivl, 2000);  // [ms], as below
  s.set(zmq::sockopt::tcp_maxrt, 5000);
  s.set(zmq::sockopt::reconnect_ivl, 100);
  s.set(zmq::sockopt::reconnect_ivl_max, config_.max_reconnect_ms);

  // Sockets of one context share the namespace of inproc endpoints.
  const std::string told = "inproc://monitor-" + routing_id(config_.self) + "-" + lane.name;
  constexpr int events = ZMQ_EVENT_CONNECTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                         ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
                         ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;
  if (zmq_socket_monitor(s.handle(), told.c_str(), events) != 0) throw zmq::error_t();
  lane.monitor.set(zmq::sockopt::linger, 0);
  lane.monitor.connect(told);

  log_debug(
      "zmq=options node={} lane={} mandatory=1 handover=1 immediate=1 linger_ms=0 "
      "hwm_frames={} max_frame_bytes={} handshake_ms=2000 tcp_maxrt_ms=5000 "
      "reconnect_ms=100..{} curve={}",
      config_.self.value, lane.name, config_.high_water_frames, max_frame_bytes,
      config_.max_reconnect_ms, config_.keys.has_value());
}

Result<std::string> ZmqTransport::secure(LaneSockets& lane, const std::string& endpoint,
                                         bool server, const std::string& server_key) {
  zmq::socket_t& s = lane.router;
  // Only then: an IPv6 socket has another name for 127.0.0.1.
  s.set(zmq::sockopt::ipv6, endpoint.starts_with("tcp://["));
  const bool curve = config_.keys && !config_.insecure && !is_inproc(endpoint);
  if (!curve) {
    if (!stays_on_host(endpoint)) {
      if (!config_.insecure)
        return problem_in(endpoint,
                          "leads beyond this host and there are no keys: make them "
                          "with `luxodus keygen`, or say insecure");
      open_to_all_ = true;
    }
    s.set(zmq::sockopt::curve_server, false);  // back to no mechanism
    return endpoint;
  }
  // Options apply to endpoints bound or connected from now on, so one socket can be both.
  if (server) {
    s.set(zmq::sockopt::curve_server, true);
    s.set(zmq::sockopt::curve_secretkey, config_.keys->secret_key);
  } else {
    if (server_key.size() != 40) return problem_in(endpoint, "the neighbour's public key is none");
    s.set(zmq::sockopt::curve_serverkey, server_key);
    s.set(zmq::sockopt::curve_publickey, config_.keys->public_key);
    s.set(zmq::sockopt::curve_secretkey, config_.keys->secret_key);
  }
  return endpoint;
}

Result<Endpoints> ZmqTransport::listen(const Endpoints& where) {
  Endpoints bound = where;
  for (const auto& [lane, endpoint] :
       {std::pair{Lane::control, &bound.control}, std::pair{Lane::bulk, &bound.bulk}}) {
    LaneSockets& sockets = *lanes_[static_cast<size_t>(lane)];
    try {
      const auto secured = secure(sockets, *endpoint, true, {});
      if (!secured) return secured.problem();
      sockets.router.bind(*endpoint);
      *endpoint = sockets.router.get(zmq::sockopt::last_endpoint);
    } catch (const zmq::error_t& e) {
      return problem_in(*endpoint, std::string("cannot listen there: ") + e.what(),
                        kind_of_errno(e.num()));
    }
  }
  return bound;
}

Result<Endpoints> ZmqTransport::connect(NodeId neighbour, const Endpoints& where,
                                        const std::string& server_key) {
  for (const auto& [lane, endpoint] :
       {std::pair{Lane::control, &where.control}, std::pair{Lane::bulk, &where.bulk}}) {
    LaneSockets& sockets = *lanes_[static_cast<size_t>(lane)];
    try {
      const auto secured = secure(sockets, *endpoint, false, server_key);
      if (!secured) return secured.problem();
      // inproc takes the name from here; other transports receive it from the neighbour on
      // connection.
      if (is_inproc(*endpoint))
        sockets.router.set(zmq::sockopt::connect_routing_id, routing_id(neighbour));
      sockets.router.connect(*endpoint);
    } catch (const zmq::error_t& e) {
      return problem_in(*endpoint, std::string("cannot connect there: ") + e.what(),
                        kind_of_errno(e.num()));
    }
  }
  connected_[neighbour] = {where, server_key};
  return where;
}

/// A corrupted frame length makes the rest of the stream look like its body, and neither end
/// notices.
void ZmqTransport::renew(NodeId neighbour) {
  const auto found = connected_.find(neighbour);
  if (found == connected_.end() || is_inproc(found->second.where.control)) return;
  const Connected old = found->second;
  part(neighbour);
  const auto anew = connect(neighbour, old.where, old.server_key);
  if (!anew) log_error("zmq=renew node={} text=\"{}\"", config_.self.value, anew.problem().text());
}

void ZmqTransport::part(NodeId neighbour) {
  const auto found = connected_.find(neighbour);
  if (found == connected_.end() || is_inproc(found->second.where.control)) return;
  const Endpoints& where = found->second.where;
  for (const auto& [lane, endpoint] :
       {std::pair{Lane::control, &where.control}, std::pair{Lane::bulk, &where.bulk}})
    // It may have ended already.
    zmq_disconnect(lanes_[static_cast<size_t>(lane)]->router.handle(), endpoint->c_str());
}

Sent ZmqTransport::send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
                        std::span<const std::byte> body) {
  while (names_.size() <= neighbour.value)
    names_.push_back(routing_id({static_cast<uint16_t>(names_.size())}));
  const std::string& name = names_[neighbour.value];
  LaneSockets& sockets = *lanes_[static_cast<size_t>(lane)];
  sockets.tells_arrivals = false;
  void* router = sockets.router.handle();
  if (zmq_send(router, name.data(), name.size(), ZMQ_SNDMORE | ZMQ_DONTWAIT) < 0)
    return zmq_errno() == EHOSTUNREACH ? Sent::unreachable : Sent::full;
  zmq::message_t frame(head.size() + body.size());
  std::memcpy(frame.data(), head.data(), head.size());
  if (!body.empty())
    std::memcpy(static_cast<std::byte*>(frame.data()) + head.size(), body.data(), body.size());
  // Room was checked with the name; only the connection may have gone since.
  if (zmq_msg_send(frame.handle(), router, ZMQ_DONTWAIT) < 0) return Sent::unreachable;
  return Sent::taken;
}

std::optional<Arrival> ZmqTransport::receive() {
  if (auto arrival = receive_from(Lane::control)) return arrival;
  if (auto arrival = receive_from(Lane::bulk)) return arrival;
  if (clock_.now() >= look_at_) look_around();
  return std::nullopt;
}

/// Checks everything but frames. Each socket costs system calls, and a busy node takes a turn every
/// millisecond.
void ZmqTransport::look_around() {
  look_at_ = clock_.now() + look_interval;
  context_.answer_door();
  watch_connections();
  remind_of_insecurity();
}

std::optional<Arrival> ZmqTransport::receive_from(Lane lane) {
  LaneSockets& sockets = *lanes_[static_cast<size_t>(lane)];
  if (sockets.look_at != 0 && clock_.now() < sockets.look_at) return std::nullopt;
  sockets.look_at = 0;
  sockets.tells_arrivals = false;
  void* router = sockets.router.handle();
  while (zmq_msg_recv(sockets.sender.handle(), router, ZMQ_DONTWAIT) >= 0) {
    size_t parts = 0;
    for (bool more = sockets.sender.more(); more; more = sockets.frame.more()) {
      if (zmq_msg_recv(sockets.frame.handle(), router, ZMQ_DONTWAIT) < 0) return std::nullopt;
      ++parts;
    }
    const std::string_view name = sockets.sender.to_string_view();
    const auto node = node_of(name);
    // With CURVE, the authenticator has set User-Id to the key's node; a key may speak only for its
    // own node.
    const char* proven = parts == 1 ? zmq_msg_gets(sockets.frame.handle(), "User-Id") : nullptr;
    const bool honest = proven == nullptr || *proven == '\0' || name == proven;
    if (parts == 1 && node && honest)
      return Arrival{
          *node, lane, {static_cast<const std::byte*>(sockets.frame.data()), sockets.frame.size()}};
    ++counters_.strangers;
  }
  sockets.tells_arrivals = true;
  sockets.look_at = clock_.now() + empty_interval;
  return std::nullopt;
}

/// Whether a lane may have frames. Afterwards the descriptors of empty ones tell of arrivals.
bool ZmqTransport::has_arrivals() {
  for (const auto& lane : lanes_) {
    if (lane->tells_arrivals) continue;
    int events = 0;
    size_t size = sizeof events;
    const int known = zmq_getsockopt(lane->router.handle(), ZMQ_EVENTS, &events, &size);
    if (known != 0 || (events & ZMQ_POLLIN) != 0) return true;  // a signal may interrupt it
    lane->tells_arrivals = true;
  }
  return false;
}

void ZmqTransport::wait_until(Nanoseconds until) {
  // One second at most, so that other work is not delayed when no frame comes.
  const Nanoseconds left =
      has_arrivals() ? 0 : std::clamp<Nanoseconds>(until - clock_.now(), 0, seconds(1));
  pollfd items[] = {
      {lanes_[0]->router_descriptor, POLLIN, 0},  {lanes_[1]->router_descriptor, POLLIN, 0},
      {lanes_[0]->monitor_descriptor, POLLIN, 0}, {lanes_[1]->monitor_descriptor, POLLIN, 0},
      {context_.door_descriptor(), POLLIN, 0},    {wake_descriptor_, POLLIN, 0},
  };
  const timespec most{left / seconds(1), left % seconds(1)};
  if (::ppoll(items, std::size(items), &most, nullptr) < 0) return;  // a signal also ends it
  const auto came = [](const pollfd& item) { return (item.revents & POLLIN) != 0; };
  for (size_t i = 0; i < lanes; ++i)
    if (came(items[i]) || !lanes_[i]->tells_arrivals) lanes_[i]->look_at = 0;
  if (came(items[5])) {
    uint64_t wakes = 0;
    (void)!::read(wake_descriptor_, &wakes, sizeof wakes);  // nothing to read is fine
  }
  if (std::any_of(items + 2, items + 5, came)) look_around();
}

void ZmqTransport::wake() noexcept {
  const uint64_t one = 1;
  (void)!::write(wake_descriptor_, &one, sizeof one);  // full: it is awake already
}

void ZmqTransport::watch_connections() {
  for (const Lane lane : {Lane::control, Lane::bulk}) take_event(lane);
}

void ZmqTransport::take_event(Lane lane) {
  LaneSockets& sockets = *lanes_[static_cast<size_t>(lane)];
  zmq::message_t event, where;
  while (sockets.monitor.recv(event, zmq::recv_flags::dontwait)) {
    if (!event.more() || !sockets.monitor.recv(where, zmq::recv_flags::dontwait)) return;
    uint16_t kind = 0;
    uint32_t value = 0;
    if (event.size() < sizeof kind + sizeof value) continue;
    std::memcpy(&kind, event.data(), sizeof kind);
    std::memcpy(&value, static_cast<const char*>(event.data()) + sizeof kind, sizeof value);
    const auto say = [&](const char* what, const char* why) {
      log_warning("zmq={} node={} lane={} endpoint={} text=\"{}\"", what, config_.self.value,
                  sockets.name, where.to_string_view(), why);
    };
    const auto say_no_node = [&](const char* why) {
      if (counters_.not_a_node++ == 0) say("not_a_node", why);
    };
    const bool greeted =
        kind != ZMQ_EVENT_CONNECTED && sockets.greeted.erase(where.to_string()) > 0;
    switch (kind) {
      case ZMQ_EVENT_CONNECTED:
        sockets.greeted.insert(where.to_string());
        break;
      case ZMQ_EVENT_HANDSHAKE_SUCCEEDED:
        ++counters_.connected;
        sockets.met.insert(where.to_string());
        break;
      case ZMQ_EVENT_DISCONNECTED:
        ++counters_.disconnected;
        // ZeroMQ gives up without a word what answers in another protocol.
        if (greeted && sockets.met.count(where.to_string()) == 0)
          say_no_node("what listens there speaks another protocol: another program has this port");
        break;
      case ZMQ_EVENT_HANDSHAKE_FAILED_AUTH:
        if (counters_.refused_us++ == 0)
          say("refused_us",
              "the neighbour does not list our key: give it this "
              "node's public key, and start it again");
        break;
      case ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL:
        // A node that leaves breaks off handshakes of peers that reconnect to it. Keys that were
        // right at this endpoint still are; a wrong key is reported at its own end.
        if (sockets.met.count(where.to_string()) > 0) {
          ++counters_.broken_off;
          break;
        }
        // A node has answered long before the time of the handshake is over.
        if (greeted && value == EAGAIN) {
          say_no_node(
              "what listens there does not answer as a node: another program has this port, or "
              "the node hangs");
          break;
        }
        [[fallthrough]];
      case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
        if (counters_.handshake_failed++ == 0)
          say("handshake_failed",
              config_.keys ? "the neighbour's public key is not the one listed here, or only one "
                             "end has keys (give all nodes one folder of public keys), or what "
                             "listens there is no node of a run"
                           : "what listens there broke off: it has ended, or has keys, or is no "
                             "node of a run");
        break;
      default:
        break;
    }
  }
}

void ZmqTransport::remind_of_insecurity() {
  if (!open_to_all_ || clock_.now() < remind_at_) return;
  remind_at_ = clock_.now() + reminder_interval;
  log_warning(
      "zmq=insecure node={} text=\"links beyond this host are neither encrypted nor "
      "proven: anybody may send, and read\"",
      config_.self.value);
}

}  // namespace luxodus

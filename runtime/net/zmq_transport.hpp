// Frames over ZeroMQ: one ROUTER for urgent frames and one for bulk, over inproc, ipc and tcp.
// Beyond loopback, links are encrypted and both ends authenticated by CURVE keys; without keys such
// an endpoint is rejected, unless `insecure` is set, which is then logged every minute. Of two
// neighbours the one with the larger number connects; libzmq reconnects by itself, but not over
// inproc, whose nodes share one process. Thread rule: one node's thread, except wake().
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/net/keys.hpp"
#include "runtime/net/transport.hpp"
#include "runtime/net/zmq_context.hpp"

namespace luxodus {

/// Where a node listens: one endpoint per lane, in ZeroMQ's syntax.
struct Endpoints {
  std::string control;
  std::string bulk;
};

/// Whether frames to this endpoint stay on this host.
bool stays_on_host(const std::string& endpoint);

struct ZmqConfig {
  NodeId self;
  std::optional<KeyPair> keys = std::nullopt;
  bool insecure = false;
  /// High-water mark of a neighbour's queue, each way [frames]. Credit allows 5 classes x 2 kinds x
  /// 16 long frames; only frames shorter than 0.6 KB reach this many, and then wait a beat. It
  /// bounds the memory for a neighbour that ignores credit: 4096 x 64 KB.
  int high_water_frames = 4096;
  /// Longest pause between attempts to connect, which begin at 100 ms and double.
  int max_reconnect_ms = 5000;
};

struct ZmqCounters {
  uint64_t connected = 0;
  uint64_t disconnected = 0;
  uint64_t refused_us = 0;        // the other end does not list our key
  uint64_t handshake_failed = 0;  // broken off by the other end, such as for a wrong server key
  uint64_t not_a_node = 0;        // what we connected to does not speak our protocol, or is silent
  uint64_t broken_off = 0;        // by a leaving end, after others have succeeded
  uint64_t strangers = 0;         // frames of senders that are no nodes, or not who they claim
};

class ZmqTransport final : public Transport {
 public:
  /// Requires: the context outlives this. Errors (exception): no descriptors left.
  ZmqTransport(ZmqContext& context, const ZmqConfig& config, const Clock& clock);
  ~ZmqTransport() override;

  /// Listens; call it several times if a node has links of several kinds. Ports may be "*". Errors:
  /// an endpoint that is in use or invalid; one beyond this host without keys.
  Result<Endpoints> listen(const Endpoints& where);
  /// Connects to a neighbour with a smaller number, now or when it appears. Requires: its public
  /// key if it has keys. Errors: those of listen().
  Result<Endpoints> connect(NodeId neighbour, const Endpoints& where,
                            const std::string& server_key = {});

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override;
  void renew(NodeId neighbour) override;
  void part(NodeId neighbour) override;
  std::optional<Arrival> receive() override;
  uint64_t lost_connections() const override { return counters_.disconnected; }
  void wait_until(Nanoseconds until) override;
  void wake() noexcept override;

  const ZmqCounters& counters() const { return counters_; }

 private:
  struct LaneSockets;
  /// A neighbour's endpoints and expected key.
  struct Connected {
    Endpoints where;
    std::string server_key;
  };

  void set_options(LaneSockets& lane);
  Result<std::string> secure(LaneSockets& lane, const std::string& endpoint, bool server,
                             const std::string& server_key);
  std::optional<Arrival> receive_from(Lane lane);
  bool has_arrivals();
  void look_around();
  void watch_connections();
  void take_event(Lane lane);
  void remind_of_insecurity();

  ZmqContext& context_;
  ZmqConfig config_;
  const Clock& clock_;
  std::array<std::unique_ptr<LaneSockets>, lanes> lanes_;
  std::map<NodeId, Connected> connected_;
  std::vector<std::string> names_;  // routing ids of nodes met, by number
  ZmqCounters counters_;
  int wake_descriptor_ = -1;
  bool open_to_all_ = false;  // listens or connects beyond this host without keys
  Nanoseconds look_at_ = 0;
  Nanoseconds remind_at_ = 0;
};

}  // namespace luxodus

// Counters of a node's network: plain integers, written by the node's thread, each with a name and
// a sentence so that metrics can be exported from the table alone. Thread rule: one node's thread.
#pragma once

#include <array>
#include <cstdint>

#include "proto/messages.hpp"

namespace luxodus {

struct NetCounters {
  uint64_t frames_sent = 0;
  uint64_t bytes_sent = 0;
  uint64_t frames_received = 0;
  uint64_t bytes_received = 0;
  uint64_t messages_sent = 0;
  uint64_t messages_delivered = 0;
  uint64_t frames_forwarded = 0;
  uint64_t requests_intercepted = 0;
  uint64_t dropped_malformed = 0;
  uint64_t dropped_stranger = 0;
  uint64_t dropped_stale = 0;
  uint64_t dropped_over_credit = 0;
  uint64_t dropped_hop_limit = 0;
  uint64_t dropped_unreachable = 0;
  uint64_t dropped_unexpected = 0;
  uint64_t assemblies_abandoned = 0;
  uint64_t transport_full = 0;
  uint64_t transport_unreachable = 0;
  uint64_t beats_late = 0;
  uint64_t links_up = 0;
  uint64_t links_down = 0;
  uint64_t reroutes = 0;
  /// Refused handshakes by RefusalReason: refused by us, and by the peer.
  std::array<uint64_t, refusal_reasons> refused{};
  std::array<uint64_t, refusal_reasons> refused_by_peer{};
};

struct NetCounterName {
  uint64_t NetCounters::*value;
  const char* name;
  const char* help;
};

inline constexpr std::array net_counter_names{
    NetCounterName{&NetCounters::frames_sent, "frames_sent", "frames given to the transport"},
    NetCounterName{&NetCounters::bytes_sent, "bytes_sent", "bytes given to the transport"},
    NetCounterName{&NetCounters::frames_received, "frames_received", "frames that came"},
    NetCounterName{&NetCounters::bytes_received, "bytes_received", "bytes that came"},
    NetCounterName{&NetCounters::messages_sent, "messages_sent", "messages made here and sent"},
    NetCounterName{&NetCounters::messages_delivered, "messages_delivered",
                   "messages taken by their actors"},
    NetCounterName{&NetCounters::frames_forwarded, "frames_forwarded", "frames passed on"},
    NetCounterName{&NetCounters::requests_intercepted, "requests_intercepted",
                   "requests of others answered on their way"},
    NetCounterName{&NetCounters::dropped_malformed, "dropped_malformed", "frames not understood"},
    NetCounterName{&NetCounters::dropped_stranger, "dropped_stranger",
                   "frames of nodes that are no neighbours"},
    NetCounterName{&NetCounters::dropped_stale, "dropped_stale",
                   "frames from or for an earlier life of a node"},
    NetCounterName{&NetCounters::dropped_over_credit, "dropped_over_credit",
                   "frames sent beyond the window granted"},
    NetCounterName{&NetCounters::dropped_hop_limit, "dropped_hop_limit",
                   "frames that passed too many links"},
    NetCounterName{&NetCounters::dropped_unreachable, "dropped_unreachable",
                   "frames whose destination has no route"},
    NetCounterName{&NetCounters::dropped_unexpected, "dropped_unexpected",
                   "pieces of messages that nobody waits for"},
    NetCounterName{&NetCounters::assemblies_abandoned, "assemblies_abandoned",
                   "messages of which a piece never came"},
    NetCounterName{&NetCounters::transport_full, "transport_full",
                   "sends that the transport had no room for"},
    NetCounterName{&NetCounters::transport_unreachable, "transport_unreachable",
                   "sends without a connection"},
    NetCounterName{&NetCounters::beats_late, "beats_late",
                   "own beats late by more than an interval: this node lags"},
    NetCounterName{&NetCounters::links_up, "links_up", "times a link came up"},
    NetCounterName{&NetCounters::links_down, "links_down", "times a link that was up went down"},
    NetCounterName{&NetCounters::reroutes, "reroutes", "times the routes were made anew"},
};

/// The word for a reason in counters, in logs and in messages to the peer.
constexpr const char* name_of(RefusalReason reason) {
  constexpr std::array<const char*, refusal_reasons> names{
      "protocol", "wrong_node", "run",   "level",       "scene",
      "topology", "isa",        "build", "fingerprint", "taken"};
  return names[static_cast<size_t>(reason)];
}

}  // namespace luxodus

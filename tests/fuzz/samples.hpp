// One of every message with all fields set: the codec must carry them, and mutations start from
// them. Pure.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "proto/codec.hpp"

namespace luxodus::test {

inline std::vector<Message> sample_messages() {
  const Identity identity{1, {3}, Level::statistical, 5,      6,
                          7, 8,   "0.1.0 release",    "avx2", "/results"};
  Beat beat;
  beat.view_hash = 9;
  beat.pool_count = 3;
  beat.pools[0] = {Kind::control, 1, 100, 200};
  beat.pools[1] = {Kind::request, 2, ~uint64_t{0}, 0};
  beat.pools[2] = {Kind::commit, limits::hops, 1, 2};
  return {
      Hello{identity},
      Welcome{identity},
      Refuse{RefusalReason::scene, "node 1 has scene a, node 2 has scene b"},
      Bye{},
      beat,
      LinkChanges{{{{1}, {2}, 3}, {{4}, {5}, 6}}},
      FetchObject{{11}, 12, 13},
      ObjectFound{{14}, {15}},
      ObjectNotHere{{16}, {17}},
      RequestLease{18},
      LeaseGranted{19, 20, 22, 23, 24, {25}},
      LeasesFenced{{25, 26}},
      Flush{27, 28, {29, 30, 31}, {39, 40}},
      FlushTaken{},
      FlushRefused{{32}, "lease 32 was fenced"},
      RoundOpened{33, 34, {51}},
      RunEnded{35, "the error is small enough"},
      ProfileCounted{36, 37},
      AskStatus{},
      StatusAnswered{},
      EnterPhase{EndPhase::flush_commits, 38},
      FlushSlice{41},
      SliceHeld{},
      FlushDecided{{{42}, {43}, 44}, 45, true},
      FlushSettled{false},
      AskTotals{46, 47},
      TotalsTold{48, 49, 50},
      AskState{{52}},
      StateTold{{53}},
      ShowTotals{58, 59},
      TotalsShown{60, 61, 62, 63, 64, true, 2, 65, 66, 67, 68},
      FluxSaved{69, "the disk is full"},
  };
}

inline Envelope sample_envelope() {
  Envelope e;
  e.from = {1};
  e.from_incarnation = {2};
  e.to_incarnation = {3};
  e.source = {4};
  e.destination = {5};
  e.kind = Kind::reply;
  e.hops = 6;
  e.id = {{7}, {8}, 9};
  e.epoch = 10;
  e.chunk = 11;
  e.chunk_bytes = 12;
  e.total_bytes = 13;
  e.sent = 14;
  e.grant = {Kind::commit, 15, 16};
  return e;
}

/// A whole frame: envelope, message, payload.
inline std::vector<std::byte> sample_frame(Codec& codec, const Message& message,
                                           std::span<const std::byte> payload = {}) {
  std::vector<std::byte> body(limits::message_bytes);
  body.resize(codec.encode(message, body).value());
  body.insert(body.end(), payload.begin(), payload.end());
  std::vector<std::byte> frame(limits::frame_head_bytes);
  frame.resize(codec.encode(sample_envelope(), body, frame));
  frame.insert(frame.end(), body.begin(), body.end());
  return frame;
}

}  // namespace luxodus::test

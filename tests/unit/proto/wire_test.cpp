// The bytes of version 6. They must stay as they are, or nodes of two builds misread each other
// without a word. The hashes were recorded from a codec with a writer and a reader for each message
// by hand. A message that is added later needs no line here.
#include <xxhash.h>

#include <catch2/catch.hpp>
#include <vector>

#include "proto/codec.hpp"

using namespace luxodus;

namespace {

struct Recorded {
  Message message;
  uint64_t hash;  // XXH3 of its bytes
};

std::vector<Recorded> recorded_messages() {
  const Identity identity{1, {3}, Level::statistical, 5,      6,
                          7, 8,   "0.1.0 release",    "avx2", "/results"};
  Beat beat;
  beat.view_hash = 9;
  beat.pools.push_back({Kind::control, 1, 100, 200});
  beat.pools.push_back({Kind::request, 2, ~uint64_t{0}, 0});
  beat.pools.push_back({Kind::commit, limits::hops, 1, 2});
  return {
      {Hello{identity}, 0xc62dabcd2d7b278c},
      {Welcome{identity}, 0xcb2889f988efb647},
      {Refuse{RefusalReason::scene, "node 1 has scene a, node 2 has scene b"}, 0xe6cfab48bd6688f2},
      {Bye{}, 0x28e734592af71b09},
      {beat, 0xed2e76798567fb06},
      {LinkChanges{{{{1}, {2}, 3}, {{4}, {5}, 6}}}, 0x007050d1dffb77fe},
      {FetchObject{{11}, 12, 13}, 0x8db092c4045abe7f},
      {ObjectFound{{14}, {15}}, 0x3c348b65bb262270},
      {ObjectNotHere{{16}, {17}}, 0x0574c9d0b9df5c43},
      {RequestLease{18}, 0x80cc6806922f4e08},
      {LeaseGranted{19, 20, 22, 23, 24, {25}}, 0xc0eb3fe38b78f1b6},
      {LeasesFenced{{25, 26}}, 0x6ba4b62b08d0b94b},
      {Flush{27, 28, {29, 30, 31}, {39, 40}}, 0x5cc4c7cd3b3110e9},
      {FlushTaken{}, 0x5eae62f79aebed0d},
      {FlushRefused{{32}, "lease 32 was fenced"}, 0x8aa7eec92d04ac73},
      {RoundOpened{33, 34, {51}}, 0x4cc5783da4307f84},
      {RunEnded{35, "the error is small enough"}, 0xb4b1c0a1e4f88f4c},
      {ProfileCounted{36, 37}, 0xb306a7357aec9538},
      {AskStatus{}, 0x1d6c9e9b489ae650},
      {StatusAnswered{}, 0x315ce45d7a46bae1},
      {EnterPhase{EndPhase::flush_commits, 38}, 0x6b0159afe1b20926},
      {FlushSlice{41}, 0x146b84742396379b},
      {SliceHeld{}, 0x4569069c4c722601},
      {FlushDecided{{{42}, {43}, 44}, 45, true}, 0xa7e9ec16536031a3},
      {FlushSettled{false}, 0xc0158697eef54b5d},
      {AskTotals{46, 47}, 0xddc02eb11e8c4f95},
      {TotalsTold{48, 49, 50}, 0x6e6906fa83dc8775},
      {AskState{{52}}, 0xca23f130bd33bf43},
      {StateTold{{53}}, 0xad4aa2be9810ec32},
      {ShowTotals{58, 59}, 0x9c13b707d3fed3d6},
      {TotalsShown{60, 61, 62, 63, 64, true, 2, 65, 66, 67, 68}, 0xfc3d7bf25b8e1695},
      {FluxSaved{69, "the disk is full"}, 0x5c5fb599e3a2537d},
  };
}

}  // namespace

TEST_CASE("every message of version 6 has the bytes that it always had", "[proto][wire]") {
  static_assert(protocol_version == 6);
  Codec codec;
  std::vector<std::byte> out(limits::message_bytes);
  for (const auto& [message, hash] : recorded_messages()) {
    INFO(std::visit([](const auto& m) { return m.type.name; }, message));
    const size_t bytes = codec.encode(message, out).value();
    CHECK(XXH3_64bits(out.data(), bytes) == hash);
    const auto read = codec.open_message(std::span(out).first(bytes));
    REQUIRE(read.ok());
    CHECK(read->message == message);
  }
}

TEST_CASE("an envelope of version 6 has the bytes that it always had", "[proto][wire]") {
  const Envelope envelope{{1},
                          {2},
                          {3},
                          {4},
                          {5},
                          Kind::reply,
                          6,
                          {{7}, {8}, 9},
                          10,
                          11,
                          12,
                          13,
                          14,
                          {Kind::commit, 15, 16},
                          {ActorName{2}, ActorName{6}}};
  Codec codec;
  std::vector<std::byte> out(limits::frame_head_bytes);
  const size_t bytes = codec.encode(envelope, {}, out);
  CHECK(XXH3_64bits(out.data(), bytes) == 0xd867630001846dee);
  CHECK(codec.open_frame(std::span(out).first(bytes))->envelope == envelope);
}

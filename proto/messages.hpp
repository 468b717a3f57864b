// What nodes say to each other, as plain values: the envelope that every frame wears, and one
// struct per message. Facts are in the past tense, requests imperative. PROTOCOL.md says who may
// send what when; wire.capnp how it travels. Payload bytes (an object, a flush) follow a message
// and are no part of these values. Plain values, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "runtime/core/ids.hpp"

namespace luxodus {

/// Changes when a node of the old version would misunderstand a node of the new one.
inline constexpr uint16_t protocol_version = 6;

namespace limits {
/// Links a frame may pass. AMP graphs of 256 nodes have diameter 6; 15 leaves room for detours
/// and keeps a beat, which names every pool, under 1 KB.
inline constexpr uint8_t hops = 15;
/// A Message without its payload [bytes]. The longest is a flush that names all its leases.
inline constexpr size_t message_bytes = 65536;
/// The schema's envelope has 96 bytes; the rest is for fields of later versions.
inline constexpr size_t envelope_bytes = 256;
/// The check in front of it.
inline constexpr size_t check_bytes = 8;
/// All that may stand before the piece of message.
inline constexpr size_t frame_head_bytes = check_bytes + envelope_bytes;
/// Leases in one flush or fence: 8 bytes each, an eighth of a message.
inline constexpr size_t leases = 1024;
/// Shards of the totals: 8 bytes each in a flush, and a worker sends a slice to every one.
inline constexpr size_t tally_shards = 256;
/// Links of a graph that can be told of in one message: 1000 nodes of 4 links have 2000.
inline constexpr size_t link_changes = 4096;
/// A sentence for people, or the name of a build.
inline constexpr size_t text_bytes = 512;
}  // namespace limits

/// What a frame is for. Every kind but `link` has buffers and credit of its own, so that a kind
/// never waits for one that waits for it: requests lead to replies, replies to nothing.
enum class Kind : uint8_t { link = 0, control = 1, request = 2, reply = 3, commit = 4 };

/// Kinds that are routed, buffered and credited: all but `link`.
inline constexpr std::array routed_kinds{Kind::control, Kind::request, Kind::reply, Kind::commit};

/// Names a question and its answer: who asked, in which life, for the how-manieth time.
struct MessageId {
  NodeId node;
  Incarnation incarnation;
  uint64_t sequence = 0;

  friend bool operator==(const MessageId&, const MessageId&) = default;
};

/// The sender of a kind and hop class may charge `limit` bytes to it, counted from the beginning.
struct Grant {
  Kind kind = Kind::link;  // link: no grant
  uint8_t hop_class = 0;
  uint64_t limit = 0;
  friend bool operator==(const Grant&, const Grant&) = default;
};

/// The actors of nodes that others may send to. A byte from outside may be none of these.
enum class ActorName : uint8_t {
  none = 0,     // the network itself
  coordinator,  // lends batches, counts flushes
  tracer,       // traces them
  tally_shard,  // holds a range of the totals' bins
  part_server,  // fetches parts of the scene, and gives them to others
  display,      // shows what is counted, and writes the results
  journal,      // of its node's coordinator; no message from elsewhere is for it
};
inline constexpr std::array<const char*, 7> actor_names{
    "none", "coordinator", "tracer", "tally_shard", "part_server", "display", "journal"};

/// Of an actor, anywhere in the cluster.
struct Address {
  NodeId node;
  ActorName actor = ActorName::none;

  friend bool operator==(const Address&, const Address&) = default;
};

/// Who sends a message, and who gets it, on their nodes.
struct ActorPair {
  ActorName from = ActorName::none;
  ActorName to = ActorName::none;

  friend bool operator==(const ActorPair&, const ActorPair&) = default;
};

struct Envelope {
  NodeId from;  // the neighbour
  Incarnation from_incarnation;
  Incarnation to_incarnation;  // 0 while unknown
  NodeId source;               // where the message was made
  NodeId destination;
  Kind kind = Kind::link;
  uint8_t hops = 0;  // links passed on arrival
  MessageId id;
  uint64_t epoch = 0;  // of the links, as the source knew them
  uint32_t chunk = 0;
  uint32_t chunk_bytes = 0;  // of every chunk but the last
  uint32_t total_bytes = 0;  // of the message, payload included
  uint64_t sent = 0;         // charged to (kind, hops) on this link, this frame included
  Grant grant;
  ActorPair actors;

  friend bool operator==(const Envelope&, const Envelope&) = default;
};

/// How equal results must be: to the bit (one instruction set), or within the errors.
enum class Level : uint8_t { bit = 0, statistical = 1 };

struct Identity {
  uint16_t protocol = protocol_version;
  NodeId node;
  Level level = Level::bit;
  uint64_t scene_hash = 0;  // partition included
  uint64_t topology_hash = 0;
  uint64_t run_id = 0;
  uint64_t fingerprint = 0;  // of particles traced on a tiny scene
  std::string build;
  std::string isa;
  /// Where the results of its run go: what a controller says, and nobody else. Runs of one file are
  /// told apart by it, and a controller that begins anew is known again.
  std::string results = {};
  friend bool operator==(const Identity&, const Identity&) = default;
};

enum class RefusalReason : uint8_t {
  protocol = 0,
  wrong_node,
  run,
  level,
  scene,
  topology,
  isa,
  build,
  fingerprint,
  taken  // it works for another run already
};
inline constexpr size_t refusal_reasons = 10;

struct Hello {
  Identity identity;
  friend bool operator==(const Hello&, const Hello&) = default;
};
struct Welcome {
  Identity identity;
  friend bool operator==(const Welcome&, const Welcome&) = default;
};
struct Refuse {
  RefusalReason reason = RefusalReason::protocol;
  std::string text;
  friend bool operator==(const Refuse&, const Refuse&) = default;
};
struct Bye {
  friend bool operator==(const Bye&, const Bye&) = default;
};

struct PoolState {
  Kind kind = Kind::control;
  uint8_t hop_class = 0;
  uint64_t sent = 0;   // by the sender of the beat, so far
  uint64_t limit = 0;  // up to which the other end may send
  friend bool operator==(const PoolState&, const PoolState&) = default;
};
struct Beat {
  uint64_t view_hash = 0;  // of what the sender knows of links
  uint8_t pool_count = 0;
  std::array<PoolState, routed_kinds.size() * limits::hops> pools;
  friend bool operator==(const Beat&, const Beat&) = default;
};

/// The state of a link, newest version wins; odd versions say that it is down.
struct LinkChange {
  NodeId a, b;
  uint32_t version = 0;
  friend bool operator==(const LinkChange&, const LinkChange&) = default;
};
struct LinkChanges {
  std::vector<LinkChange> changes;
  friend bool operator==(const LinkChanges&, const LinkChanges&) = default;
};

struct FetchObject {
  ObjectId object;
  uint64_t budget_us = 0;  // left when it was sent: a span, since nodes share no clock
  uint16_t attempt = 0;
  friend bool operator==(const FetchObject&, const FetchObject&) = default;
};
/// The object's bytes follow as payload.
struct ObjectFound {
  ObjectId object;
  NodeId answered_by;
  friend bool operator==(const ObjectFound&, const ObjectFound&) = default;
};
struct ObjectNotHere {
  ObjectId object;
  NodeId answered_by;
  friend bool operator==(const ObjectNotHere&, const ObjectNotHere&) = default;
};

struct RequestLease {
  uint32_t batches = 0;
  friend bool operator==(const RequestLease&, const RequestLease&) = default;
};
/// Leases first_lease, first_lease + 1, ... for batches first_batch, first_batch + 1, ...: one
/// each.
struct LeaseGranted {
  uint64_t first_lease = 0;
  uint32_t round = 0;
  uint64_t first_batch = 0;
  uint32_t batches = 0;  // 0: none is left in this round
  uint32_t duration_ms = 0;
  ObjectId state = {};  // of the scene: what is to be traced
  friend bool operator==(const LeaseGranted&, const LeaseGranted&) = default;
};
struct LeasesFenced {
  std::vector<uint64_t> leases;
  friend bool operator==(const LeasesFenced&, const LeasesFenced&) = default;
};

/// Bins, squares and counts by fate follow as payload; the id names the flush. Where totals are
/// sharded, the payload has the bins of the first shard, and the others hold their slices already.
struct Flush {
  uint32_t round = 0;
  uint64_t payload_hash = 0;
  std::vector<uint64_t> leases;
  std::vector<uint64_t> slice_hashes = {};  // of shards 1, 2, ...
  friend bool operator==(const Flush&, const Flush&) = default;
};
struct FlushTaken {
  friend bool operator==(const FlushTaken&, const FlushTaken&) = default;
};
struct FlushRefused {
  std::vector<uint64_t> fenced;
  std::string text;
  friend bool operator==(const FlushRefused&, const FlushRefused&) = default;
};

/// What leases are of from now on, or what they may be of next.
struct RoundOpened {
  uint32_t round = 0;
  uint64_t batches = 0;
  ObjectId state = {};
  friend bool operator==(const RoundOpened&, const RoundOpened&) = default;
};
struct RunEnded {
  uint32_t round = 0;
  std::string text;
  friend bool operator==(const RunEnded&, const RunEnded&) = default;
};

/// References per object follow as payload.
struct ProfileCounted {
  uint64_t particles = 0;
  uint32_t objects = 0;
  friend bool operator==(const ProfileCounted&, const ProfileCounted&) = default;
};

struct AskStatus {
  friend bool operator==(const AskStatus&, const AskStatus&) = default;
};
/// What is to be shown follows as payload.
struct StatusAnswered {
  friend bool operator==(const StatusAnswered&, const StatusAnswered&) = default;
};

enum class EndPhase : uint8_t { stop_admitting = 0, finish_fibers, flush_commits, leave };
struct EnterPhase {
  EndPhase phase = EndPhase::stop_admitting;
  uint32_t duration_ms = 0;
  friend bool operator==(const EnterPhase&, const EnterPhase&) = default;
};

/// Part of the flush of this id, for one shard: its bins and squares follow as payload.
struct FlushSlice {
  uint64_t payload_hash = 0;
  friend bool operator==(const FlushSlice&, const FlushSlice&) = default;
};
/// The slice has been read, found right, and waits for what is decided about the flush.
struct SliceHeld {
  friend bool operator==(const SliceHeld&, const SliceHeld&) = default;
};
/// What became of a flush. One that was not taken goes for all earlier ones of the same life that
/// were not decided about, too: they never will be.
struct FlushDecided {
  MessageId flush;
  uint64_t slice_hash = 0;  // of the shard's slice, where it was taken
  bool taken = false;
  friend bool operator==(const FlushDecided&, const FlushDecided&) = default;
};
/// The slice is added, or dropped.
struct FlushSettled {
  bool whole = true;  // false: it should have been added, and is not here
  friend bool operator==(const FlushSettled&, const FlushSettled&) = default;
};
/// For the totals of a shard, from bin `first` on, in the how-manieth gathering. To ask for a piece
/// is to say that the one before has come.
struct AskTotals {
  uint32_t gather = 0;
  uint64_t first = 0;
  friend bool operator==(const AskTotals&, const AskTotals&) = default;
};
/// Bins [first, next) that are not zero follow as payload; the shard has them no more.
struct TotalsTold {
  uint32_t gather = 0;
  uint64_t first = 0;
  uint64_t next = 0;
  friend bool operator==(const TotalsTold&, const TotalsTold&) = default;
};

/// For what a state of the scene is made from, by who was lent batches of it and has not seen it.
struct AskState {
  ObjectId state;
  friend bool operator==(const AskState&, const AskState&) = default;
};
/// It follows as payload; without one it is gone, and no lease is of it any more.
struct StateTold {
  ObjectId state;
  friend bool operator==(const StateTold&, const StateTold&) = default;
};

/// For a piece of all totals as they are, in the how-manieth show. To ask for the first is to ask
/// for new ones.
struct ShowTotals {
  uint32_t show = 0;
  uint32_t piece = 0;
  friend bool operator==(const ShowTotals&, const ShowTotals&) = default;
};
/// What belongs to all pieces, and bins [first, next) that are not zero, as payload. Of the first
/// piece the payload is the numbers of missing batches, eight bytes each.
struct TotalsShown {
  uint32_t show = 0;
  uint32_t piece = 0;
  uint32_t pieces = 0;  // 0: this show is gone
  uint64_t first = 0;
  uint64_t next = 0;
  bool over = false;     // the run is
  uint8_t stopped = 0;   // why, where it is
  uint64_t batches = 0;  // given out
  uint64_t traced_us = 0;
  uint64_t untimed_batches = 0;
  uint64_t untimed_rays = 0;
  friend bool operator==(const TotalsShown&, const TotalsShown&) = default;
};
/// The flux of the run is on a disk, under its name.
struct FluxSaved {
  uint32_t show = 0;
  std::string fault;  // why it never will be; "" where it is
  friend bool operator==(const FluxSaved&, const FluxSaved&) = default;
};

using Message =
    std::variant<Hello, Welcome, Refuse, Bye, Beat, LinkChanges, FetchObject, ObjectFound,
                 ObjectNotHere, RequestLease, LeaseGranted, LeasesFenced, Flush, FlushTaken,
                 FlushRefused, RoundOpened, RunEnded, ProfileCounted, AskStatus, StatusAnswered,
                 EnterPhase, FlushSlice, SliceHeld, FlushDecided, FlushSettled, AskTotals,
                 TotalsTold, AskState, StateTold, ShowTotals, TotalsShown, FluxSaved>;

/// The kind whose buffers and credit a message uses.
Kind kind_of(const Message& message);

}  // namespace luxodus

// What nodes say to each other, as plain values: the envelope of every frame, and one struct for
// each message. The list of fields beside a struct is the only description of them besides the
// schema, wire.capnp (field_list.hpp). PROTOCOL.md says who sends what, and when. Facts are in the
// past tense, requests imperative. A payload (a scene part, a flush) follows a message and is no
// part of its value. Plain values, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "proto/field_list.hpp"
#include "runtime/core/ids.hpp"

namespace luxodus {

/// Raised when a node of the old version would misunderstand a node of the new one.
inline constexpr uint16_t protocol_version = 6;

namespace limits {
/// Links that a frame may pass. AMP graphs of 256 nodes have diameter 6; 15 leaves room for detours
/// and keeps a beat, which names every pool, under 1 KB.
inline constexpr uint8_t hops = 15;
/// A message without its payload [B]. The longest is a flush that names all its leases.
inline constexpr size_t message_bytes = 65536;
/// The envelope [B]: 104 with its segment table; the rest is for fields of later versions.
inline constexpr size_t envelope_bytes = 256;
/// The check in front of it [B].
inline constexpr size_t check_bytes = 8;
/// All that may stand before the chunk of a message [B].
inline constexpr size_t frame_head_bytes = check_bytes + envelope_bytes;
/// Leases in one flush or fence: 8 bytes each, an eighth of a message.
inline constexpr size_t leases = 1024;
/// Shards of the totals: 8 bytes each in a flush, and a worker sends a slice to every one.
inline constexpr size_t tally_shards = 256;
/// Links of a graph in one message: 1000 nodes of 4 links have 2000.
inline constexpr size_t link_changes = 4096;
/// A sentence for people, or the name of a build [B].
inline constexpr size_t text_bytes = 512;
}  // namespace limits

/// What a frame is for. Every kind but `link` has buffers and credit of its own, so that a kind
/// never waits for one that waits for it: requests lead to replies, replies to nothing.
enum class Kind : uint8_t { link = 0, control = 1, request = 2, reply = 3, commit = 4 };
template <>
inline constexpr Kind last_value<Kind> = Kind::commit;

/// Kinds that are routed, buffered and credited: all but `link`.
inline constexpr std::array routed_kinds{Kind::control, Kind::request, Kind::reply, Kind::commit};

/// Names a request and its answer: who asked, in which life, and its number in that life.
struct MessageId {
  NodeId node;
  Incarnation incarnation;
  uint64_t sequence = 0;

  static constexpr void fields(auto&& field, auto& m) {
    field("node", m.node, "of the id: the node that asked, or made the flush");
    field("incarnation", m.incarnation, "of the id: the life of that node");
    field("sequence", m.sequence, "of the id: a number that this life uses once");
  }
  friend bool operator==(const MessageId&, const MessageId&) = default;
};

/// The sender may charge `limit` bytes to a kind and hop class, counted from the beginning.
struct Grant {
  Kind kind = Kind::link;  // link: no grant
  uint8_t hop_class = 0;
  uint64_t limit = 0;

  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind, "kind that credit is granted for; 0: none is");
    field("hopClass", m.hop_class, "hop class that it is granted for", {limits::hops, "hops"});
    field("limit", m.limit, "bytes that may be charged to them, from the beginning [B]");
  }
  friend bool operator==(const Grant&, const Grant&) = default;
};

/// The actors of a node that others may send to. Whoever builds on the runtime gives the other
/// numbers a meaning; 8 to 255 are free. A byte from outside may be any.
enum class ActorName : uint8_t {
  none = 0,         // the network itself
  part_server = 4,  // fetches objects, and gives them to others
  application = 7,  // the actors of an application of the library: AppMessage names which
};

/// Where an actor is in the cluster: its node, and which actor of that node.
struct Address {
  NodeId node;
  ActorName actor = ActorName::none;

  friend bool operator==(const Address&, const Address&) = default;
};

/// Who sends a message, and who gets it, on their nodes.
struct ActorPair {
  ActorName from = ActorName::none;
  ActorName to = ActorName::none;

  static constexpr void fields(auto&& field, auto& m) {
    field("fromActor", m.from, "actor of the source; 0: the network itself");
    field("toActor", m.to, "actor of the destination");
  }
  friend bool operator==(const ActorPair&, const ActorPair&) = default;
};

struct Envelope {
  NodeId from;
  Incarnation from_incarnation;
  Incarnation to_incarnation;
  NodeId source;
  NodeId destination;
  Kind kind = Kind::link;
  uint8_t hops = 0;
  MessageId id;
  uint64_t epoch = 0;
  uint32_t chunk = 0;
  uint32_t chunk_bytes = 0;
  uint32_t total_bytes = 0;
  uint64_t sent = 0;
  Grant grant;
  ActorPair actors;

  static constexpr void fields(auto&& field, auto& m) {
    field("from", m.from, "the neighbour that sends the frame");
    field("fromIncarnation", m.from_incarnation, "life of that neighbour");
    field("toIncarnation", m.to_incarnation, "life of the receiver; 0 while it is unknown");
    field("source", m.source, "the node where the message was made");
    field("destination", m.destination, "the node that the message is for");
    field("kind", m.kind, "0 link, 1 control, 2 request, 3 reply, 4 commit");
    field("hops", m.hops, "links passed on arrival: the hop class", {limits::hops, "hops"});
    field("id", m.id);
    field("epoch", m.epoch, "version of the links, as the source knew them");
    field("chunk", m.chunk, "number of the chunk that follows, from 0");
    field("chunkBytes", m.chunk_bytes, "length of every chunk but the last [B]");
    field("totalBytes", m.total_bytes, "length of the message with its payload [B]");
    field("sent", m.sent, "bytes charged to kind and hops so far, this frame included [B]");
    field("grant", m.grant);
    field("", m.actors);
  }
  friend bool operator==(const Envelope&, const Envelope&) = default;
};

/// How equal results must be: to the bit (one instruction set), or within their errors.
enum class Level : uint8_t { bit = 0, statistical = 1 };
template <>
inline constexpr Level last_value<Level> = Level::statistical;

struct Identity {
  uint16_t protocol = protocol_version;
  NodeId node;
  Level level = Level::bit;
  uint64_t scene_hash = 0;
  uint64_t topology_hash = 0;
  uint64_t run_id = 0;
  uint64_t fingerprint = 0;
  std::string build;
  std::string isa;
  /// Only a controller says where the results of its run go. It tells runs of one file apart, and a
  /// controller that begins anew is known again by it.
  std::string results = {};

  static constexpr void fields(auto&& field, auto& m) {
    field("protocolVersion", m.protocol, "version of the protocol");
    field("node", m.node, "the node that says who it is");
    field("level", m.level, "results must be equal: 0 to the bit, 1 within their errors");
    field("sceneHash", m.scene_hash, "hash of the scene and of its partition");
    field("topologyHash", m.topology_hash, "hash of the graph of links");
    field("runId", m.run_id, "number of the run");
    field("fingerprint", m.fingerprint, "hash of particles that were traced on a tiny scene");
    field("build", m.build, "name of the build");
    field("isa", m.isa, "instruction set");
    field("results", m.results, "folder of the run's results, from a controller; else empty");
  }
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
template <>
inline constexpr RefusalReason last_value<RefusalReason> = RefusalReason{refusal_reasons - 1};

/// What a message is called, and the kind whose buffers and credit it uses.
struct MessageType {
  const char* name;
  Kind kind;
};

struct Hello {
  Identity identity;

  static constexpr MessageType type{"Hello", Kind::link};
  static constexpr void fields(auto&& field, auto& m) { field("", m.identity); }
  friend bool operator==(const Hello&, const Hello&) = default;
};

struct Welcome {
  Identity identity;

  static constexpr MessageType type{"Welcome", Kind::link};
  static constexpr void fields(auto&& field, auto& m) { field("", m.identity); }
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

struct Refuse {
  RefusalReason reason = RefusalReason::protocol;
  std::string text;

  static constexpr MessageType type{"Refuse", Kind::link};
  static constexpr void fields(auto&& field, auto& m) {
    field("reason", m.reason, "what differs: 0 protocol, 1 wrong_node, and on as under \"A link\"");
    field("text", m.text, "a sentence with both values");
  }
  friend bool operator==(const Refuse&, const Refuse&) = default;
};

struct Bye {
  static constexpr MessageType type{"Bye", Kind::link};
  friend bool operator==(const Bye&, const Bye&) = default;
};

struct PoolState {
  Kind kind = Kind::control;
  uint8_t hop_class = 0;
  uint64_t sent = 0;
  uint64_t limit = 0;

  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind, "kind of the pool");
    field("hopClass", m.hop_class, "hop class of the pool", {limits::hops, "hops"});
    field("sent", m.sent, "bytes that the sender of the beat has charged so far [B]");
    field("limit", m.limit, "bytes that the other end may charge [B]");
  }
  friend bool operator==(const PoolState&, const PoolState&) = default;
};

struct Beat {
  uint64_t view_hash = 0;
  FixedList<PoolState, routed_kinds.size() * limits::hops> pools;

  static constexpr MessageType type{"Beat", Kind::link};
  static constexpr void fields(auto&& field, auto& m) {
    field("viewHash", m.view_hash, "hash of what the sender knows of links");
    field("pools", m.pools, "the pools of the lane", {m.pools.capacity(), "pools"});
  }
  friend bool operator==(const Beat&, const Beat&) = default;
};

struct LinkChange {
  NodeId a, b;
  uint32_t version = 0;

  static constexpr void fields(auto&& field, auto& m) {
    field("a", m.a, "one end of the link");
    field("b", m.b, "the other end");
    field("version", m.version, "even: the link is up; odd: down. The larger version is newer");
  }
  friend bool operator==(const LinkChange&, const LinkChange&) = default;
};

struct LinkChanges {
  std::vector<LinkChange> changes;

  static constexpr MessageType type{"LinkChanges", Kind::link};
  static constexpr void fields(auto&& field, auto& m) {
    field("changes", m.changes, "states of links", {limits::link_changes, "links"});
  }
  friend bool operator==(const LinkChanges&, const LinkChanges&) = default;
};

struct FetchObject {
  ObjectId object;
  uint64_t budget_us = 0;
  uint16_t attempt = 0;

  static constexpr MessageType type{"FetchObject", Kind::request};
  static constexpr void fields(auto&& field, auto& m) {
    field("object", m.object, "hash of the scene part");
    field("budgetUs", m.budget_us, "time left, as a span, since nodes share no clock [us]");
    field("attempt", m.attempt, "number of the attempt");
  }
  friend bool operator==(const FetchObject&, const FetchObject&) = default;
};

/// The bytes of the scene part follow as payload.
struct ObjectFound {
  ObjectId object;
  NodeId answered_by;

  static constexpr MessageType type{"ObjectFound", Kind::reply};
  static constexpr void fields(auto&& field, auto& m) {
    field("object", m.object, "hash of the scene part");
    field("answeredBy", m.answered_by, "the node that had it");
  }
  friend bool operator==(const ObjectFound&, const ObjectFound&) = default;
};

struct ObjectNotHere {
  ObjectId object;
  NodeId answered_by;

  static constexpr MessageType type{"ObjectNotHere", Kind::reply};
  static constexpr void fields(auto&& field, auto& m) {
    field("object", m.object, "hash of the scene part");
    field("answeredBy", m.answered_by, "the node that does not have it");
  }
  friend bool operator==(const ObjectNotHere&, const ObjectNotHere&) = default;
};

struct RequestLease {
  uint32_t batches = 0;

  static constexpr MessageType type{"RequestLease", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("batches", m.batches, "how many are asked for; 0: the leases of the worker come back");
  }
  friend bool operator==(const RequestLease&, const RequestLease&) = default;
};

/// One lease a batch: leases first_lease, first_lease + 1, ... of batches first_batch,
/// first_batch + 1, ...
struct LeaseGranted {
  uint64_t first_lease = 0;
  uint32_t round = 0;
  uint64_t first_batch = 0;
  uint32_t batches = 0;
  uint32_t duration_ms = 0;
  ObjectId state = {};

  static constexpr MessageType type{"LeaseGranted", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("firstLease", m.first_lease, "the lease of the first batch; the next batch has the next");
    field("round", m.round, "round of the batches");
    field("firstBatch", m.first_batch, "the first batch");
    field("batches", m.batches, "how many; 0: none is left in this round");
    field("durationMs", m.duration_ms, "how long the leases stand [ms]");
    field("state", m.state, "state of the scene that is to be traced");
  }
  friend bool operator==(const LeaseGranted&, const LeaseGranted&) = default;
};

struct LeasesFenced {
  std::vector<uint64_t> leases;

  static constexpr MessageType type{"LeasesFenced", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("leases", m.leases, "leases that no flush may name any more", {limits::leases, "leases"});
  }
  friend bool operator==(const LeasesFenced&, const LeasesFenced&) = default;
};

/// Bins, squares and counts by fate follow as payload; the id of the envelope names the flush.
/// If totals are sharded, the payload has the bins of the first shard. The others hold their slices
/// already.
struct Flush {
  uint32_t round = 0;
  uint64_t payload_hash = 0;
  std::vector<uint64_t> leases;
  std::vector<uint64_t> slice_hashes = {};

  static constexpr MessageType type{"Flush", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("round", m.round, "round of the batches");
    field("payloadHash", m.payload_hash, "hash of the payload");
    field("leases", m.leases, "leases of the batches in it", {limits::leases, "leases"});
    field("sliceHashes", m.slice_hashes, "hashes of the slices of shards 1, 2, ...",
          {limits::tally_shards, "shards"});
  }
  friend bool operator==(const Flush&, const Flush&) = default;
};

struct FlushTaken {
  static constexpr MessageType type{"FlushTaken", Kind::control};
  friend bool operator==(const FlushTaken&, const FlushTaken&) = default;
};

struct FlushRefused {
  std::vector<uint64_t> fenced;
  std::string text;

  static constexpr MessageType type{"FlushRefused", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("fenced", m.fenced, "its leases that were fenced", {limits::leases, "leases"});
    field("text", m.text, "why it was refused");
  }
  friend bool operator==(const FlushRefused&, const FlushRefused&) = default;
};

/// Leases are of this round from now on, or may be next.
struct RoundOpened {
  uint32_t round = 0;
  uint64_t batches = 0;
  ObjectId state = {};

  static constexpr MessageType type{"RoundOpened", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("round", m.round, "the round");
    field("batches", m.batches, "how many it has");
    field("state", m.state, "state of the scene that is to be traced");
  }
  friend bool operator==(const RoundOpened&, const RoundOpened&) = default;
};

struct RunEnded {
  uint32_t round = 0;
  std::string text;

  static constexpr MessageType type{"RunEnded", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("round", m.round, "the last round");
    field("text", m.text, "why the run could not begin, or leaves no results; else empty");
  }
  friend bool operator==(const RunEnded&, const RunEnded&) = default;
};

/// References to each scene part follow as payload.
struct ProfileCounted {
  uint64_t particles = 0;
  uint32_t objects = 0;

  static constexpr MessageType type{"ProfileCounted", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("particles", m.particles, "particles that were traced");
    field("objects", m.objects, "scene parts that were counted");
  }
  friend bool operator==(const ProfileCounted&, const ProfileCounted&) = default;
};

struct AskStatus {
  static constexpr MessageType type{"AskStatus", Kind::control};
  friend bool operator==(const AskStatus&, const AskStatus&) = default;
};

/// What is to be shown follows as payload.
struct StatusAnswered {
  static constexpr MessageType type{"StatusAnswered", Kind::control};
  friend bool operator==(const StatusAnswered&, const StatusAnswered&) = default;
};

enum class EndPhase : uint8_t { stop_admitting = 0, finish_fibers, flush_commits, leave };
template <>
inline constexpr EndPhase last_value<EndPhase> = EndPhase::leave;

struct EnterPhase {
  EndPhase phase = EndPhase::stop_admitting;
  uint32_t duration_ms = 0;

  static constexpr MessageType type{"EnterPhase", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("phase", m.phase, "0 stop admitting, 1 finish fibers, 2 flush commits, 3 leave");
    field("durationMs", m.duration_ms, "how long the phase may last [ms]");
  }
  friend bool operator==(const EnterPhase&, const EnterPhase&) = default;
};

/// The part of a flush that is for one shard. The id is that of the flush; bins and squares follow
/// as payload.
struct FlushSlice {
  uint64_t payload_hash = 0;

  static constexpr MessageType type{"FlushSlice", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("payloadHash", m.payload_hash, "hash of the payload");
  }
  friend bool operator==(const FlushSlice&, const FlushSlice&) = default;
};

/// The shard has read the slice, found it right, and waits for the decision on the flush.
struct SliceHeld {
  static constexpr MessageType type{"SliceHeld", Kind::control};
  friend bool operator==(const SliceHeld&, const SliceHeld&) = default;
};

/// What became of a flush. If it was not taken, no earlier undecided flush of the same life will
/// be, either.
struct FlushDecided {
  MessageId flush;
  uint64_t slice_hash = 0;
  bool taken = false;

  static constexpr MessageType type{"FlushDecided", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("", m.flush);
    field("sliceHash", m.slice_hash, "hash of the shard's slice, if the flush was taken");
    field("taken", m.taken, "whether the flush was taken");
  }
  friend bool operator==(const FlushDecided&, const FlushDecided&) = default;
};

/// The slice is added, or dropped.
struct FlushSettled {
  bool whole = true;

  static constexpr MessageType type{"FlushSettled", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("whole", m.whole, "false: the slice should have been added, and is not here");
  }
  friend bool operator==(const FlushSettled&, const FlushSettled&) = default;
};

/// Asks a shard for a piece of its totals, and says that the piece before has come.
struct AskTotals {
  uint32_t gather = 0;
  uint64_t first = 0;

  static constexpr MessageType type{"AskTotals", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("gather", m.gather, "number of the gathering");
    field("first", m.first, "bin at which the piece begins");
  }
  friend bool operator==(const AskTotals&, const AskTotals&) = default;
};

/// Bins [first, next) that are not zero follow as payload; the shard has them no more.
struct TotalsTold {
  uint32_t gather = 0;
  uint64_t first = 0;
  uint64_t next = 0;

  static constexpr MessageType type{"TotalsTold", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("gather", m.gather, "number of the gathering");
    field("first", m.first, "bin at which the piece begins");
    field("next", m.next, "bin at which the next piece begins");
  }
  friend bool operator==(const TotalsTold&, const TotalsTold&) = default;
};

/// A worker that was leased batches of a state that it has not seen asks what it is made from.
struct AskState {
  ObjectId state;

  static constexpr MessageType type{"AskState", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("state", m.state, "hash of the bytes that the state is made from");
  }
  friend bool operator==(const AskState&, const AskState&) = default;
};

/// The bytes follow as payload. Without payload the state is gone, and no lease is of it any more.
struct StateTold {
  ObjectId state;

  static constexpr MessageType type{"StateTold", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("state", m.state, "hash of the bytes that the state is made from");
  }
  friend bool operator==(const StateTold&, const StateTold&) = default;
};

/// Asks for a piece of a copy of all totals. Asking for piece 0 has a new copy made.
struct ShowTotals {
  uint32_t show = 0;
  uint32_t piece = 0;

  static constexpr MessageType type{"ShowTotals", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("show", m.show, "number of the copy");
    field("piece", m.piece, "number of the piece, from 0");
  }
  friend bool operator==(const ShowTotals&, const ShowTotals&) = default;
};

/// Bins [first, next) that are not zero follow as payload. The payload of piece 0 is the numbers of
/// missing batches, 8 bytes each.
struct TotalsShown {
  uint32_t show = 0;
  uint32_t piece = 0;
  uint32_t pieces = 0;
  uint64_t first = 0;
  uint64_t next = 0;
  bool over = false;
  uint8_t stopped = 0;
  uint64_t batches = 0;
  uint64_t traced_us = 0;
  uint64_t untimed_batches = 0;
  uint64_t untimed_rays = 0;

  static constexpr MessageType type{"TotalsShown", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) {
    field("show", m.show, "number of the copy");
    field("piece", m.piece, "number of the piece, from 0");
    field("pieces", m.pieces, "how many the copy has; 0: it is gone");
    field("first", m.first, "bin at which the piece begins");
    field("next", m.next, "bin at which the next piece begins");
    field("over", m.over, "whether the run is over");
    field("stopped", m.stopped, "why, if it is");
    field("batches", m.batches, "batches that were given out");
    field("tracedUs", m.traced_us, "time that tracing took [us]");
    field("untimedBatches", m.untimed_batches, "batches of which no time is known");
    field("untimedRays", m.untimed_rays, "rays of those batches");
  }
  friend bool operator==(const TotalsShown&, const TotalsShown&) = default;
};

/// The flux of the run is on a disk, under its name, or never will be.
struct FluxSaved {
  uint32_t show = 0;
  std::string fault;

  static constexpr MessageType type{"FluxSaved", Kind::control};
  static constexpr void fields(auto&& field, auto& m) {
    field("show", m.show, "number of the copy that was written");
    field("fault", m.fault, "why it never will be; else empty");
  }
  friend bool operator==(const FluxSaved&, const FluxSaved&) = default;
};

/// Which actors of an application speak, and what the payload is. Numbers are hashes of the actors'
/// names.
struct AppHead {
  uint64_t from = 0;
  uint64_t to = 0;
  uint64_t schema = 0;
  bool answer = false;

  static constexpr void fields(auto&& field, auto& m) {
    field("from", m.from, "hash of the sender's name; 0: it has none");
    field("to", m.to, "hash of the receiver's name; of an answer: as the request's sender");
    field("schema", m.schema, "id of the payload's Cap'n Proto struct; 0: bytes");
    field("answer", m.answer, "whether it answers the request of this id");
  }
  friend bool operator==(const AppHead&, const AppHead&) = default;
};

/// A message of an application, in one frame of the control lane. Its content follows as payload.
struct AppMessage {
  AppHead head;

  static constexpr MessageType type{"AppMessage", Kind::control};
  static constexpr void fields(auto&& field, auto& m) { field("", m.head); }
  friend bool operator==(const AppMessage&, const AppMessage&) = default;
};

/// A longer one, which takes turns with others on the bulk lane.
struct AppBulk {
  AppHead head;

  static constexpr MessageType type{"AppBulk", Kind::commit};
  static constexpr void fields(auto&& field, auto& m) { field("", m.head); }
  friend bool operator==(const AppBulk&, const AppBulk&) = default;
};

/// One of each, in the order of the union in wire.capnp.
using Message = std::variant<Hello, Welcome, Refuse, Bye, Beat, LinkChanges, FetchObject,
                             ObjectFound, ObjectNotHere, RequestLease, LeaseGranted, LeasesFenced,
                             Flush, FlushTaken, FlushRefused, RoundOpened, RunEnded, ProfileCounted,
                             AskStatus, StatusAnswered, EnterPhase, FlushSlice, SliceHeld,
                             FlushDecided, FlushSettled, AskTotals, TotalsTold, AskState, StateTold,
                             ShowTotals, TotalsShown, FluxSaved, AppMessage, AppBulk>;

/// The kind whose buffers and credit a message uses.
inline Kind kind_of(const Message& message) {
  return std::visit([](const auto& m) { return m.type.kind; }, message);
}

/// Calls `each` with a new value of every message, in the order of the union.
void for_each_message(auto&& each) {
  [&]<size_t... index>(std::index_sequence<index...>) {
    (each(std::variant_alternative_t<index, Message>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Message>>{});
}

}  // namespace luxodus

// A frame's words are trusted in this order: first its segment table (here, by hand: one segment,
// no longer than the bytes at hand and the limit), then the pointers within (Cap'n Proto, with a
// traversal limit of the segment's own words, so that pointers which meet cannot multiply work),
// then the values (here: enumerations, list and text lengths).
#include "proto/codec.hpp"

#include <capnp/message.h>
#include <capnp/serialize.h>
#include <proto/wire.capnp.h>

#include <cstring>
#include <utility>

namespace luxodus {

namespace {

constexpr size_t word = sizeof(uint64_t);
static_assert(word == sizeof(capnp::word));

/// Messages are a struct, lists of structs, and text: depth 4. Deeper is malformed.
constexpr int max_nesting = 8;

/// Cap'n Proto counts the words it visits; every word is visited once, and the roots a few times.
constexpr uint64_t spare_words = 16;

constexpr auto last_kind = static_cast<uint8_t>(Kind::commit);
constexpr auto last_level = static_cast<uint8_t>(Level::statistical);
constexpr auto last_phase = static_cast<uint8_t>(EndPhase::leave);

Problem malformed(std::string what) {
  return {{}, "malformed frame: " + std::move(what)};
}

template <class... Parts>
struct Overloaded : Parts... {
  using Parts::operator()...;
};
template <class... Parts>
Overloaded(Parts...) -> Overloaded<Parts...>;

// ---- values to words

void write(wire::Identity::Builder out, const Identity& identity) {
  out.setProtocolVersion(identity.protocol);
  out.setNode(identity.node.value);
  out.setLevel(static_cast<uint8_t>(identity.level));
  out.setSceneHash(identity.scene_hash);
  out.setTopologyHash(identity.topology_hash);
  out.setRunId(identity.run_id);
  out.setFingerprint(identity.fingerprint);
  out.setBuild(identity.build.c_str());
  out.setIsa(identity.isa.c_str());
  out.setResults(identity.results.c_str());
}

void write(wire::Beat::Builder out, const Beat& beat) {
  out.setViewHash(beat.view_hash);
  auto pools = out.initPools(beat.pool_count);
  for (unsigned i = 0; i < beat.pool_count; ++i) {
    const PoolState& pool = beat.pools[i];
    pools[i].setKind(static_cast<uint8_t>(pool.kind));
    pools[i].setHopClass(pool.hop_class);
    pools[i].setSent(pool.sent);
    pools[i].setLimit(pool.limit);
  }
}

void write(capnp::List<wire::LinkChange>::Builder out, const LinkChanges& message) {
  for (unsigned i = 0; i < out.size(); ++i) {
    out[i].setA(message.changes[i].a.value);
    out[i].setB(message.changes[i].b.value);
    out[i].setVersion(message.changes[i].version);
  }
}

void write(capnp::List<uint64_t>::Builder out, const std::vector<uint64_t>& numbers) {
  for (unsigned i = 0; i < out.size(); ++i) out.set(i, numbers[i]);
}

template <class Answer>
void write_answer(wire::FetchAnswer::Builder out, const Answer& answer) {
  out.setObject(answer.object.value);
  out.setAnsweredBy(answer.answered_by.value);
}

unsigned count(size_t n) {
  return static_cast<unsigned>(n);
}

void write_lease(wire::LeaseGranted::Builder out, const LeaseGranted& m) {
  out.setFirstLease(m.first_lease);
  out.setRound(m.round);
  out.setFirstBatch(m.first_batch);
  out.setBatches(m.batches);
  out.setDurationMs(m.duration_ms);
  out.setState(m.state.value);
}

void write_flush(wire::Flush::Builder out, const Flush& m) {
  out.setRound(m.round);
  out.setPayloadHash(m.payload_hash);
  write(out.initLeases(count(m.leases.size())), m.leases);
  write(out.initSliceHashes(count(m.slice_hashes.size())), m.slice_hashes);
}

void write_decision(wire::FlushDecided::Builder out, const FlushDecided& m) {
  out.setNode(m.flush.node.value);
  out.setIncarnation(m.flush.incarnation.value);
  out.setSequence(m.flush.sequence);
  out.setSliceHash(m.slice_hash);
  out.setTaken(m.taken);
}

void write_shown(wire::TotalsShown::Builder out, const TotalsShown& m) {
  out.setShow(m.show);
  out.setPiece(m.piece);
  out.setPieces(m.pieces);
  out.setFirst(m.first);
  out.setNext(m.next);
  out.setOver(m.over);
  out.setStopped(m.stopped);
  out.setBatches(m.batches);
  out.setTracedUs(m.traced_us);
  out.setUntimedBatches(m.untimed_batches);
  out.setUntimedRays(m.untimed_rays);
}

TotalsShown read_shown(wire::TotalsShown::Reader in) {
  return {in.getShow(),     in.getPiece(),          in.getPieces(),     in.getFirst(),
          in.getNext(),     in.getOver(),           in.getStopped(),    in.getBatches(),
          in.getTracedUs(), in.getUntimedBatches(), in.getUntimedRays()};
}

void write(wire::Message::Builder out, const Message& message) {
  std::visit(
      Overloaded{
          [&](const Hello& m) { write(out.initHello(), m.identity); },
          [&](const Welcome& m) { write(out.initWelcome(), m.identity); },
          [&](const Refuse& m) {
            auto refuse = out.initRefuse();
            refuse.setReason(static_cast<uint8_t>(m.reason));
            refuse.setText(m.text.c_str());
          },
          [&](const Bye&) { out.setBye(); },
          [&](const Beat& m) { write(out.initBeat(), m); },
          [&](const LinkChanges& m) { write(out.initLinkChanges(count(m.changes.size())), m); },
          [&](const FetchObject& m) {
            auto fetch = out.initFetchObject();
            fetch.setObject(m.object.value);
            fetch.setBudgetUs(m.budget_us);
            fetch.setAttempt(m.attempt);
          },
          [&](const ObjectFound& m) { write_answer(out.initObjectFound(), m); },
          [&](const ObjectNotHere& m) { write_answer(out.initObjectNotHere(), m); },
          [&](const RequestLease& m) { out.initRequestLease().setBatches(m.batches); },
          [&](const LeaseGranted& m) { write_lease(out.initLeaseGranted(), m); },
          [&](const LeasesFenced& m) {
            write(out.initLeasesFenced(count(m.leases.size())), m.leases);
          },
          [&](const Flush& m) { write_flush(out.initFlush(), m); },
          [&](const FlushTaken&) { out.setFlushTaken(); },
          [&](const FlushRefused& m) {
            auto refused = out.initFlushRefused();
            write(refused.initFenced(count(m.fenced.size())), m.fenced);
            refused.setText(m.text.c_str());
          },
          [&](const RoundOpened& m) {
            auto opened = out.initRoundOpened();
            opened.setRound(m.round);
            opened.setBatches(m.batches);
            opened.setState(m.state.value);
          },
          [&](const RunEnded& m) {
            auto ended = out.initRunEnded();
            ended.setRound(m.round);
            ended.setText(m.text.c_str());
          },
          [&](const ProfileCounted& m) {
            auto counted = out.initProfileCounted();
            counted.setParticles(m.particles);
            counted.setObjects(m.objects);
          },
          [&](const AskStatus&) { out.setAskStatus(); },
          [&](const StatusAnswered&) { out.setStatusAnswered(); },
          [&](const EnterPhase& m) {
            auto enter = out.initEnterPhase();
            enter.setPhase(static_cast<uint8_t>(m.phase));
            enter.setDurationMs(m.duration_ms);
          },
          [&](const FlushSlice& m) { out.initFlushSlice().setPayloadHash(m.payload_hash); },
          [&](const SliceHeld&) { out.setSliceHeld(); },
          [&](const FlushDecided& m) { write_decision(out.initFlushDecided(), m); },
          [&](const FlushSettled& m) { out.initFlushSettled().setWhole(m.whole); },
          [&](const AskTotals& m) {
            auto ask = out.initAskTotals();
            ask.setGather(m.gather);
            ask.setFirst(m.first);
          },
          [&](const TotalsTold& m) {
            auto told = out.initTotalsTold();
            told.setGather(m.gather);
            told.setFirst(m.first);
            told.setNext(m.next);
          },
          [&](const AskState& m) { out.setAskState(m.state.value); },
          [&](const StateTold& m) { out.setStateTold(m.state.value); },
          [&](const ShowTotals& m) {
            auto show = out.initShowTotals();
            show.setShow(m.show);
            show.setPiece(m.piece);
          },
          [&](const TotalsShown& m) { write_shown(out.initTotalsShown(), m); },
          [&](const FluxSaved& m) {
            auto saved = out.initFluxSaved();
            saved.setShow(m.show);
            saved.setFault(m.fault.c_str());
          },
      },
      message);
}

/// What the other side would refuse is not sent: a list or text that is too long.
bool within_limits(const Message& message) {
  const auto leases_fit = [](const auto& list) { return list.size() <= limits::leases; };
  const auto text_fits = [](const std::string& text) { return text.size() <= limits::text_bytes; };
  const auto identity_fits = [&](const Identity& i) {
    return text_fits(i.build) && text_fits(i.isa) && text_fits(i.results);
  };
  return std::visit(
      Overloaded{
          [&](const Hello& m) { return identity_fits(m.identity); },
          [&](const Welcome& m) { return identity_fits(m.identity); },
          [&](const Refuse& m) { return text_fits(m.text); },
          [&](const LinkChanges& m) { return m.changes.size() <= limits::link_changes; },
          [&](const LeasesFenced& m) { return leases_fit(m.leases); },
          [&](const Flush& m) {
            return leases_fit(m.leases) && m.slice_hashes.size() <= limits::tally_shards;
          },
          [&](const FlushRefused& m) { return leases_fit(m.fenced) && text_fits(m.text); },
          [&](const RunEnded& m) { return text_fits(m.text); },
          [&](const FluxSaved& m) { return text_fits(m.fault); },
          [&](const auto&) { return true; },
      },
      message);
}

// ---- words to values; what breaks a limit is thrown as a Problem and caught at the boundary below

std::string read_text(capnp::Text::Reader text) {
  if (text.size() > limits::text_bytes) throw malformed("a text is too long");
  std::string out(text.begin(), text.end());
  // It is logged: a peer may not write control characters to an operator's terminal.
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return out;
}

template <class Enum>
Enum read_enum(uint8_t value, uint8_t last, const char* what) {
  if (value > last) throw malformed(std::string("no such ") + what);
  return static_cast<Enum>(value);
}

uint8_t read_class(uint8_t hop_class) {
  if (hop_class > limits::hops) throw malformed("too many hops");
  return hop_class;
}

std::vector<uint64_t> read_numbers(capnp::List<uint64_t>::Reader list, size_t most,
                                   const char* what, SpareLists& spare) {
  if (list.size() > most) throw malformed(what);
  std::vector<uint64_t> out = spare.take(list.size());
  for (const uint64_t number : list) out.push_back(number);
  return out;
}

std::vector<uint64_t> read_leases(capnp::List<uint64_t>::Reader list, SpareLists& spare) {
  return read_numbers(list, limits::leases, "too many leases", spare);
}

Identity read_identity(wire::Identity::Reader in) {
  Identity out;
  out.protocol = in.getProtocolVersion();
  out.node = {in.getNode()};
  out.level = read_enum<Level>(in.getLevel(), last_level, "level");
  out.scene_hash = in.getSceneHash();
  out.topology_hash = in.getTopologyHash();
  out.run_id = in.getRunId();
  out.fingerprint = in.getFingerprint();
  out.build = read_text(in.getBuild());
  out.isa = read_text(in.getIsa());
  out.results = read_text(in.getResults());
  return out;
}

Beat read_beat(wire::Beat::Reader in) {
  Beat out;
  out.view_hash = in.getViewHash();
  const auto pools = in.getPools();
  if (pools.size() > out.pools.size()) throw malformed("too many pools");
  for (const auto pool : pools)
    out.pools[out.pool_count++] = {read_enum<Kind>(pool.getKind(), last_kind, "kind"),
                                   read_class(pool.getHopClass()), pool.getSent(), pool.getLimit()};
  return out;
}

LinkChanges read_changes(capnp::List<wire::LinkChange>::Reader in) {
  if (in.size() > limits::link_changes) throw malformed("too many links");
  LinkChanges out;
  out.changes.reserve(in.size());
  for (const auto change : in)
    out.changes.push_back({{change.getA()}, {change.getB()}, change.getVersion()});
  return out;
}

Flush read_flush(wire::Flush::Reader in, SpareLists& spare) {
  return {in.getRound(), in.getPayloadHash(), read_leases(in.getLeases(), spare),
          read_numbers(in.getSliceHashes(), limits::tally_shards, "too many shards", spare)};
}

FlushDecided read_decision(wire::FlushDecided::Reader in) {
  return {
      {{in.getNode()}, {in.getIncarnation()}, in.getSequence()}, in.getSliceHash(), in.getTaken()};
}

template <class Answer>
Answer read_answer(wire::FetchAnswer::Reader in) {
  return {{in.getObject()}, {in.getAnsweredBy()}};
}

Refuse read_refuse(wire::Refuse::Reader in) {
  return {read_enum<RefusalReason>(in.getReason(), refusal_reasons - 1, "reason"),
          read_text(in.getText())};
}

LeaseGranted read_lease(wire::LeaseGranted::Reader in) {
  return {in.getFirstLease(), in.getRound(),      in.getFirstBatch(),
          in.getBatches(),    in.getDurationMs(), {in.getState()}};
}

FetchObject read_fetch(wire::FetchObject::Reader in) {
  return {{in.getObject()}, in.getBudgetUs(), in.getAttempt()};
}

Message read(wire::Message::Reader in, SpareLists& spare) {
  switch (in.which()) {
    case wire::Message::HELLO:
      return Hello{read_identity(in.getHello())};
    case wire::Message::WELCOME:
      return Welcome{read_identity(in.getWelcome())};
    case wire::Message::REFUSE:
      return read_refuse(in.getRefuse());
    case wire::Message::BYE:
      return Bye{};
    case wire::Message::BEAT:
      return read_beat(in.getBeat());
    case wire::Message::LINK_CHANGES:
      return read_changes(in.getLinkChanges());
    case wire::Message::FETCH_OBJECT:
      return read_fetch(in.getFetchObject());
    case wire::Message::OBJECT_FOUND:
      return read_answer<ObjectFound>(in.getObjectFound());
    case wire::Message::OBJECT_NOT_HERE:
      return read_answer<ObjectNotHere>(in.getObjectNotHere());
    case wire::Message::REQUEST_LEASE:
      return RequestLease{in.getRequestLease().getBatches()};
    case wire::Message::LEASE_GRANTED:
      return read_lease(in.getLeaseGranted());
    case wire::Message::LEASES_FENCED:
      return LeasesFenced{read_leases(in.getLeasesFenced(), spare)};
    case wire::Message::FLUSH:
      return read_flush(in.getFlush(), spare);
    case wire::Message::FLUSH_TAKEN:
      return FlushTaken{};
    case wire::Message::FLUSH_REFUSED: {
      const auto refused = in.getFlushRefused();
      return FlushRefused{read_leases(refused.getFenced(), spare), read_text(refused.getText())};
    }
    case wire::Message::ROUND_OPENED: {
      const auto opened = in.getRoundOpened();
      return RoundOpened{opened.getRound(), opened.getBatches(), {opened.getState()}};
    }
    case wire::Message::RUN_ENDED: {
      const auto ended = in.getRunEnded();
      return RunEnded{ended.getRound(), read_text(ended.getText())};
    }
    case wire::Message::PROFILE_COUNTED: {
      const auto counted = in.getProfileCounted();
      return ProfileCounted{counted.getParticles(), counted.getObjects()};
    }
    case wire::Message::ASK_STATUS:
      return AskStatus{};
    case wire::Message::STATUS_ANSWERED:
      return StatusAnswered{};
    case wire::Message::ENTER_PHASE: {
      const auto enter = in.getEnterPhase();
      return EnterPhase{read_enum<EndPhase>(enter.getPhase(), last_phase, "phase"),
                        enter.getDurationMs()};
    }
    case wire::Message::FLUSH_SLICE:
      return FlushSlice{in.getFlushSlice().getPayloadHash()};
    case wire::Message::SLICE_HELD:
      return SliceHeld{};
    case wire::Message::FLUSH_DECIDED:
      return read_decision(in.getFlushDecided());
    case wire::Message::FLUSH_SETTLED:
      return FlushSettled{in.getFlushSettled().getWhole()};
    case wire::Message::ASK_TOTALS:
      return AskTotals{in.getAskTotals().getGather(), in.getAskTotals().getFirst()};
    case wire::Message::TOTALS_TOLD: {
      const auto told = in.getTotalsTold();
      return TotalsTold{told.getGather(), told.getFirst(), told.getNext()};
    }
    case wire::Message::ASK_STATE:
      return AskState{{in.getAskState()}};
    case wire::Message::STATE_TOLD:
      return StateTold{{in.getStateTold()}};
    case wire::Message::SHOW_TOTALS:
      return ShowTotals{in.getShowTotals().getShow(), in.getShowTotals().getPiece()};
    case wire::Message::TOTALS_SHOWN:
      return read_shown(in.getTotalsShown());
    case wire::Message::FLUX_SAVED: {
      const auto saved = in.getFluxSaved();
      return FluxSaved{saved.getShow(), read_text(saved.getFault())};
    }
  }
  throw malformed("no such message");
}

Envelope read(wire::Envelope::Reader in) {
  Envelope out;
  out.from = {in.getFrom()};
  out.from_incarnation = {in.getFromIncarnation()};
  out.to_incarnation = {in.getToIncarnation()};
  out.source = {in.getSource()};
  out.destination = {in.getDestination()};
  out.kind = read_enum<Kind>(in.getKind(), last_kind, "kind");
  out.hops = read_class(in.getHops());
  out.id = {{in.getIdNode()}, {in.getIdIncarnation()}, in.getIdSequence()};
  out.epoch = in.getEpoch();
  out.chunk = in.getChunk();
  out.chunk_bytes = in.getChunkBytes();
  out.total_bytes = in.getTotalBytes();
  out.sent = in.getSent();
  out.grant = {read_enum<Kind>(in.getGrantKind(), last_kind, "kind"),
               read_class(in.getGrantClass()), in.getGrantLimit()};
  out.actors = {static_cast<ActorName>(in.getFromActor()), static_cast<ActorName>(in.getToActor())};
  return out;
}

void write(wire::Envelope::Builder out, const Envelope& envelope) {
  out.setFrom(envelope.from.value);
  out.setFromIncarnation(envelope.from_incarnation.value);
  out.setToIncarnation(envelope.to_incarnation.value);
  out.setSource(envelope.source.value);
  out.setDestination(envelope.destination.value);
  out.setKind(static_cast<uint8_t>(envelope.kind));
  out.setHops(envelope.hops);
  out.setIdNode(envelope.id.node.value);
  out.setIdIncarnation(envelope.id.incarnation.value);
  out.setIdSequence(envelope.id.sequence);
  out.setEpoch(envelope.epoch);
  out.setChunk(envelope.chunk);
  out.setChunkBytes(envelope.chunk_bytes);
  out.setTotalBytes(envelope.total_bytes);
  out.setSent(envelope.sent);
  out.setGrantKind(static_cast<uint8_t>(envelope.grant.kind));
  out.setGrantClass(envelope.grant.hop_class);
  out.setGrantLimit(envelope.grant.limit);
  out.setFromActor(static_cast<uint8_t>(envelope.actors.from));
  out.setToActor(static_cast<uint8_t>(envelope.actors.to));
}

// ---- the boundary

template <class Schema, class Value>
Result<size_t> encode_segment(const Value& value, std::span<uint64_t> scratch,
                              std::span<std::byte> out) {
  // The builder gives the scratch back zeroed, as it must find it.
  capnp::MallocMessageBuilder builder(
      kj::arrayPtr(reinterpret_cast<capnp::word*>(scratch.data()), scratch.size()));
  write(builder.initRoot<Schema>(), value);
  const auto segments = builder.getSegmentsForOutput();
  const auto bytes = segments[0].asBytes();
  const size_t total = word + bytes.size();
  if (segments.size() != 1 || total > out.size())
    return problem("a message is longer than its buffer");
  const uint32_t table[2] = {0, static_cast<uint32_t>(segments[0].size())};
  std::memcpy(out.data(), table, word);
  std::memcpy(out.data() + word, bytes.begin(), bytes.size());
  return total;
}

/// `more`: what reading takes beside the bytes.
template <class Schema, class... More>
auto decode_segment(const std::byte* begin, size_t bytes, More&... more)
    -> Result<decltype(read(std::declval<typename Schema::Reader>(), more...))> {
  try {
    const size_t words = bytes / word;
    capnp::ReaderOptions options;
    options.traversalLimitInWords = words + spare_words;
    options.nestingLimit = max_nesting;
    capnp::FlatArrayMessageReader reader(
        kj::arrayPtr(reinterpret_cast<const capnp::word*>(begin), words), options);
    return read(reader.getRoot<Schema>(), more...);
  } catch (const kj::Exception& e) {
    return malformed(e.getDescription().cStr());
  } catch (const Problem& problem) {
    return problem;
  }
}

}  // namespace

std::vector<uint64_t> SpareLists::take(size_t numbers) {
  std::vector<uint64_t> list;
  if (!lists_.empty() && numbers > 0) {
    list = std::move(lists_.back());
    lists_.pop_back();
  }
  constexpr size_t few = 16;  // a longer list is of a flush: the next one may be as long as any
  list.reserve(numbers > few ? limits::leases : numbers);
  return list;
}

void SpareLists::give_back(std::vector<uint64_t>&& list) {
  constexpr size_t max_kept = 256;  // 2 MB of the longest; more flushes seldom wait at once
  if (list.capacity() == 0 || lists_.size() == max_kept) return;
  list.clear();
  lists_.push_back(std::move(list));
}

Kind kind_of(const Message& message) {
  return std::visit(Overloaded{
                        [](const Hello&) { return Kind::link; },
                        [](const Welcome&) { return Kind::link; },
                        [](const Refuse&) { return Kind::link; },
                        [](const Bye&) { return Kind::link; },
                        [](const Beat&) { return Kind::link; },
                        [](const LinkChanges&) { return Kind::link; },
                        [](const FetchObject&) { return Kind::request; },
                        [](const ObjectFound&) { return Kind::reply; },
                        [](const ObjectNotHere&) { return Kind::reply; },
                        [](const Flush&) { return Kind::commit; },
                        [](const ProfileCounted&) { return Kind::commit; },
                        [](const FlushSlice&) { return Kind::commit; },
                        [](const TotalsTold&) { return Kind::commit; },
                        [](const StateTold&) { return Kind::commit; },
                        [](const TotalsShown&) { return Kind::commit; },
                        [](const auto&) { return Kind::control; },
                    },
                    message);
}

constexpr size_t scratch_words = limits::message_bytes / word;

Codec::Codec()
    : aligned_(std::make_unique<uint64_t[]>(scratch_words)),
      building_(std::make_unique<uint64_t[]>(scratch_words)) {}

size_t Codec::encode(const Envelope& envelope, std::span<const std::byte> body,
                     std::span<std::byte> out) {
  const std::span<std::byte> room = out.subspan(limits::check_bytes);
  const size_t bytes =
      encode_segment<wire::Envelope>(envelope, {building_.get(), scratch_words}, room).value();
  check_.reset();
  check_.add(room.data(), bytes);
  check_.add(body.data(), body.size());
  const uint64_t check = check_.value();
  std::memcpy(out.data(), &check, sizeof check);
  return limits::check_bytes + bytes;
}

namespace {
uint64_t check_of(std::span<const std::byte> frame) {
  const auto checked = frame.subspan(limits::check_bytes);
  return XXH3_64bits(checked.data(), checked.size());  // as Hasher
}
}  // namespace

void Codec::seal(std::span<std::byte> frame) {
  const uint64_t check = check_of(frame);
  std::memcpy(frame.data(), &check, sizeof check);
}

Result<size_t> Codec::encode(const Message& message, std::span<std::byte> out) {
  if (!within_limits(message)) return problem("a message has a list or a text over its limit");
  return encode_segment<wire::Message>(message, {building_.get(), scratch_words}, out);
}

Result<Codec::Segment> Codec::first_segment(std::span<const std::byte> bytes, size_t limit) {
  uint32_t table[2];  // segments less one, words of the first
  if (bytes.size() < word) return malformed("shorter than a word");
  std::memcpy(table, bytes.data(), word);
  if (table[0] != 0) return malformed("more than one segment");
  const uint64_t size = word + uint64_t{table[1]} * word;
  if (size > bytes.size()) return malformed("cut short");
  if (size > limit) return malformed("too long");
  if (reinterpret_cast<uintptr_t>(bytes.data()) % word == 0) return Segment{bytes.data(), size};
  std::memcpy(aligned_.get(), bytes.data(), size);
  return Segment{reinterpret_cast<const std::byte*>(aligned_.get()), size};
}

Result<OpenedFrame> Codec::open_frame(std::span<const std::byte> frame) {
  uint64_t check = 0;
  if (frame.size() < limits::check_bytes) return malformed("shorter than a check");
  std::memcpy(&check, frame.data(), sizeof check);
  if (check != check_of(frame)) return malformed("harmed on its way: its check does not hold");
  frame = frame.subspan(limits::check_bytes);
  const auto segment = first_segment(frame, limits::envelope_bytes);
  if (!segment) return segment.problem();
  auto envelope = decode_segment<wire::Envelope>(segment->begin, segment->bytes);
  if (!envelope) return envelope.problem();
  return OpenedFrame{envelope.value(), frame.subspan(segment->bytes)};
}

Result<OpenedMessage> Codec::open_message(std::span<const std::byte> bytes) {
  const auto segment = first_segment(bytes, limits::message_bytes);
  if (!segment) return segment.problem();
  auto message = decode_segment<wire::Message>(segment->begin, segment->bytes, spare_);
  if (!message) return message.problem();
  return OpenedMessage{std::move(message).value(), bytes.subspan(segment->bytes)};
}

}  // namespace luxodus

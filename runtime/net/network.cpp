#include "runtime/net/network.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// Frames taken from the transport per turn: as many as are forwarded per turn (router.cpp), so
/// that neither starves the other.
constexpr size_t arrivals_per_turn = 256;
constexpr size_t arriving_bytes_per_turn = 1 << 20;

/// One line a minute for each kind of trouble at each link, so that a peer cannot flood the log.
constexpr Nanoseconds log_interval = seconds(60);

/// Beats after a lost connection, beside the first, and the time between them: ZeroMQ closes within
/// a few milliseconds what it has told to be lost.
constexpr int beats_of_a_probe = 4;
constexpr Nanoseconds probe_interval = milliseconds(5);

void check(const NetConfig& config) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("network: ") + what);
  };
  require(config.self.value < config.nodes, "this node is none of the run's");
  require(config.nodes < no_node.value, "there are more nodes than ids");
  require(config.incarnation.value != 0, "an incarnation must not be 0");
  require(config.identity.node == config.self, "the identity is of another node");
  require(config.hop_limit >= 1 && config.hop_limit <= limits::hops, "hop_limit is out of range");
  for (const Kind kind : routed_kinds) {
    require(config.chunk_bytes(kind) % 8 == 0 && config.chunk_bytes(kind) > 0,
            "chunks must be of whole words");
    require(frame_charge(config.chunk_bytes(kind)) <= config.window_bytes(kind),
            "a window is too small for one chunk");
  }
}

}  // namespace

/// Last known state of a link, and when it may be logged again.
struct Network::Watched {
  bool usable = false;
  uint64_t sessions = 0;
  LinkPhase phase = LinkPhase::connecting;
  bool to_tell = false;  // the handler has not been told yet
  Nanoseconds may_log_at = 0;
  int denied = 0;  // beats during which others reported it down although it works
};

/// The router's interface to the network, hidden from network.hpp.
class Network::Here final : public Router::Destination {
 public:
  explicit Here(Network& network) : network_(network) {}
  bool take(const Envelope& envelope, std::span<const std::byte> body, Nanoseconds now) override {
    return network_.take_here(envelope, body, now);
  }

 private:
  Network& network_;
};

Network::~Network() = default;

Network::Network(const NetConfig& config, Transport& transport, NetHandler& handler,
                 Nanoseconds now)
    : config_((check(config), config)),
      transport_(transport),
      handler_(handler),
      scratch_(limits::message_bytes),
      view_(config.edges),
      assembler_(config.assemblies, config.max_message_bytes / config.bulk_chunk_bytes + 1),
      here_(std::make_unique<Here>(*this)),
      router_(config_, counters_, links_, *here_),
      next_beat_(now) {
  const LinkSurroundings around{config_, transport_, codec_, counters_, scratch_};
  for (const Edge& edge : config_.edges) {
    if (edge.b.value >= config_.nodes) throw std::invalid_argument("network: a link to no node");
    if (edge.a == config_.self) links_.emplace_back(around, edge.b, now);
    if (edge.b == config_.self) links_.emplace_back(around, edge.a, now);
  }
  watched_.resize(links_.size());
  link_samples_.resize(links_.size());
  router_.use(handler_.reroute({}));
}

// ---- between turns

MessageId Network::next_id() {
  return {config_.self, config_.incarnation, ++sequence_};
}

SendOutcome Network::send(NodeId destination, const MessageId& id, const Message& message,
                          SharedBytes payload, ActorPair actors) {
  const Kind kind = kind_of(message);
  if (kind == Kind::link || destination == config_.self)
    throw std::logic_error("network: send() is for messages to other nodes");
  if (!router_.reaches(destination)) return SendOutcome::unreachable;
  Outbox& outbox = router_.outbox(kind);
  if (outbox.full() || rarely(config_.buggify, Buggify::Site::full_outbox))
    return SendOutcome::full;
  const auto head = codec_.encode(message, scratch_);
  if (!head) throw std::length_error("network: " + head.problem().what);
  if (head.value() + payload.bytes.size() > config_.max_message_bytes)
    throw std::length_error("network: a message is longer than max_message_bytes");
  outbox.add(destination, id, actors, std::span(scratch_).first(head.value()), std::move(payload));
  given_ = true;
  return SendOutcome::taken;
}

void Network::say_bye() {
  for (Link& link : links_) link.say_bye();
}

LinkPhase Network::phase(NodeId neighbour) const {
  for (const Link& link : links_)
    if (link.neighbour() == neighbour) return link.state().phase();
  throw std::invalid_argument("network: no such neighbour");
}

std::string Network::refusal_of(NodeId neighbour) const {
  for (const Link& link : links_)
    if (link.neighbour() == neighbour) return link.refusal_text();
  return "";
}

std::optional<NodeId> Network::taken_elsewhere() const {
  for (const Link& link : links_)
    if (link.refused_as_taken()) return link.neighbour();
  return std::nullopt;
}

std::vector<NodeId> Network::neighbours() const {
  std::vector<NodeId> nodes;
  for (const Link& link : links_) nodes.push_back(link.neighbour());
  return nodes;
}

bool Network::meets_neighbour() const {
  return std::any_of(links_.begin(), links_.end(), [](const Link& link) {
    return link.state().accepted() && !link.state().usable();
  });
}

Link* Network::link_to(NodeId neighbour) {
  for (Link& link : links_)
    if (link.neighbour() == neighbour) return &link;
  return nullptr;
}

// ---- a turn

bool Network::poll(Nanoseconds now) {
  own_lag(now);
  const bool more_arrivals = receive(now);
  for (Link& link : links_) link.tick(now);
  watch_links(now);
  probe_if_disturbed(now);
  if (now >= next_beat_) {
    for (Link& link : links_) link.beat(view_.hash(), now);
    const bool probes = probes_ > 0;
    probes_ -= probes ? 1 : 0;
    next_beat_ = now + (probes ? std::min(probe_interval, config_.times.beat) : config_.times.beat);
    LinkChanges news;
    for (size_t i = 0; i < links_.size(); ++i) {
      // An end of a link knows its state best. It waits for as long as the other end may have been
      // silent before it contradicts; by then the report must be wrong.
      const Edge edge = edge_between(config_.self, links_[i].neighbour());
      const bool denied = links_[i].state().usable() && view_.version(edge) % 2 == 1;
      watched_[i].denied = denied ? watched_[i].denied + 1 : 0;
      if (watched_[i].denied <= 2 * config_.times.down_after_beats || !view_.set(edge, true))
        continue;
      news.changes.push_back({edge.a, edge.b, view_.version(edge)});
    }
    spread(news, nullptr);
  }
  given_ = false;
  const bool more_moves = router_.pump(view_.epoch(), now);
  for (Link& link : links_) link.tell_grants();
  watch_links(now);  // a send may have found a neighbour unreachable
  while (const auto idle = assembler_.close_idle(now - config_.assembly_patience)) {
    ++counters_.assemblies_abandoned;
    handler_.abandoned(idle->id, idle->kind);
  }
  return more_arrivals || more_moves;
}

void Network::send_out(Nanoseconds now) {
  if (given_) given_ = router_.pump(view_.epoch(), now);
}

// Fibers run after a turn's poll. Without this, a message sent just before the node goes idle would
// wait for the next beat.
Nanoseconds Network::next_deadline() const {
  if (given_) return 0;
  Nanoseconds earliest = next_beat_;
  for (const Link& link : links_) earliest = std::min(earliest, link.state().next_deadline());
  return earliest;
}

void Network::own_lag(Nanoseconds now) {
  const Nanoseconds late = now - next_beat_;
  if (late < config_.times.beat) return;
  ++counters_.beats_late;
  if (!links_.empty() && log_lag_.may(now)) {
    log_warning("net=lagging node={} late_ms={} times={}", config_.self.value,
                late / milliseconds(1), counters_.beats_late);
  }
  for (Link& link : links_) link.forgive(late);
}

/// A connection has been lost, and the transport does not tell whose: beats find out. The first may
/// still be taken for a connection that is being closed.
void Network::probe_if_disturbed(Nanoseconds now) {
  const uint64_t lost = transport_.lost_connections();
  if (std::exchange(lost_connections_, lost) == lost || !config_.falls_with_connection) return;
  next_beat_ = std::min(next_beat_, now);
  probes_ = beats_of_a_probe;
}

bool Network::receive(Nanoseconds now) {
  size_t bytes = 0;
  for (size_t n = 0; n < arrivals_per_turn && bytes < arriving_bytes_per_turn; ++n) {
    const auto arrival = transport_.receive();
    if (!arrival) return false;
    bytes += arrival->bytes.size();
    ++counters_.frames_received;
    counters_.bytes_received += arrival->bytes.size();
    take_frame(*arrival, now);
  }
  return true;
}

void Network::take_frame(const Arrival& arrival, Nanoseconds now) {
  Link* link = link_to(arrival.neighbour);
  if (link == nullptr) {
    ++counters_.dropped_stranger;
    return;
  }
  link->count_arrival(arrival.bytes.size());
  const auto frame = codec_.open_frame(arrival.bytes);
  if (!frame) return malformed(arrival.neighbour, frame.problem().what, now);
  if (frame->envelope.from != arrival.neighbour)
    return malformed(arrival.neighbour, "it names another sender than its connection", now);
  if (frame->envelope.kind == Kind::link)
    take_link_message(*link, frame.value(), arrival.lane, now);
  else
    take_routed(*link, frame.value(), arrival.lane, now);
}

void Network::take_link_message(Link& link, const OpenedFrame& frame, Lane lane, Nanoseconds now) {
  if (frame.body.empty()) {  // only a grant
    if (!link.admits(frame.envelope, now)) ++counters_.dropped_stale;
    return;
  }
  const auto opened = codec_.open_message(frame.body);
  if (!opened) return malformed(link.neighbour(), opened.problem().what, now);
  if (kind_of(opened->message) != Kind::link)
    return malformed(link.neighbour(), "its message is not of its kind", now);
  if (!link.take(frame.envelope, lane, opened->message, now) || !link.state().usable()) return;
  if (const auto* changes = std::get_if<LinkChanges>(&opened->message)) learn(*changes, link);
  if (const auto* beat = std::get_if<Beat>(&opened->message))
    if (beat->view_hash != view_.hash()) link.say(view_.changes());
}

bool Network::consistent(const Envelope& envelope, size_t body_bytes) const {
  const uint64_t begin = uint64_t{envelope.chunk} * envelope.chunk_bytes;
  return envelope.source.value < config_.nodes && envelope.destination.value < config_.nodes &&
         envelope.hops >= 1 && envelope.chunk_bytes > 0 &&
         envelope.chunk_bytes <= config_.chunk_bytes(envelope.kind) &&
         envelope.total_bytes <= config_.max_message_bytes && begin < envelope.total_bytes &&
         body_bytes == std::min<uint64_t>(envelope.chunk_bytes, envelope.total_bytes - begin);
}

void Network::take_routed(Link& link, const OpenedFrame& frame, Lane lane, Nanoseconds now) {
  const Envelope& envelope = frame.envelope;
  if (lane != lane_of(envelope.kind) || !consistent(envelope, frame.body.size()))
    return malformed(link.neighbour(), "its envelope contradicts itself", now);
  if (!link.admits(envelope, now)) {
    ++counters_.dropped_stale;
    return;
  }
  const bool arrived = envelope.destination == config_.self;
  if (envelope.hops > config_.hop_limit || (envelope.hops == config_.hop_limit && !arrived)) {
    if (envelope.hops <= config_.hop_limit) (void)link.pass(envelope, frame.body.size());
    ++counters_.dropped_hop_limit;
    return;
  }
  if (!arrived && envelope.kind == Kind::request && intercepted(envelope, frame.body)) {
    ++counters_.requests_intercepted;
    (void)link.pass(envelope, frame.body.size());
    return;
  }
  if (!link.hold(envelope, frame.body)) ++counters_.dropped_over_credit;
}

bool Network::intercepted(const Envelope& envelope, std::span<const std::byte> body) {
  if (body.size() != envelope.total_bytes) return false;  // a single chunk is no request yet
  auto opened = codec_.open_message(body);
  if (!opened || kind_of(opened->message) != Kind::request) return false;
  return handler_.intercept({envelope.source, envelope.id, envelope.hops, opened->message,
                             opened->payload, envelope.actors});
}

void Network::malformed(NodeId neighbour, const std::string& what, Nanoseconds now) {
  ++counters_.dropped_malformed;
  for (size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].neighbour() != neighbour || now < watched_[i].may_log_at) continue;
    watched_[i].may_log_at = now + log_interval;
    log_warning("net=malformed node={} neighbour={} total={} text=\"{}\"", config_.self.value,
                neighbour.value, counters_.dropped_malformed, what);
  }
}

// ---- messages for this node

bool Network::take_here(const Envelope& envelope, std::span<const std::byte> body,
                        Nanoseconds now) {
  if (envelope.id.node == config_.self && envelope.id.incarnation != config_.incarnation) {
    ++counters_.dropped_stale;  // an answer to a request of an earlier incarnation
    return true;
  }
  if (body.size() == envelope.total_bytes) return deliver(envelope, body);
  return take_piece(envelope, body, now);
}

bool Network::take_piece(const Envelope& envelope, std::span<const std::byte> body,
                         Nanoseconds now) {
  if (!assembler_.open(envelope)) {
    const auto room =
        handler_.room_for(envelope.id, envelope.source, envelope.actors, envelope.total_bytes);
    const bool welcome = room.size() >= envelope.total_bytes;
    if (welcome && assembler_.full()) make_room(envelope.from);
    if (!welcome || assembler_.full()) {
      if (welcome) handler_.abandoned(envelope.id, envelope.kind);
      ++counters_.dropped_unexpected;
      return true;
    }
    assembler_.begin(envelope, room, now);
  }
  switch (assembler_.add(envelope, body, now)) {
    case Assembler::Added::incomplete:
      return true;
    case Assembler::Added::inconsistent:
      ++counters_.dropped_unexpected;
      return true;
    case Assembler::Added::complete:
      break;
  }
  if (!deliver(envelope, assembler_.bytes(envelope))) return false;
  assembler_.close(envelope.id, envelope.kind);
  return true;
}

void Network::make_room(NodeId newcomer) {
  const auto closed = assembler_.make_room(newcomer);
  if (!closed) return;
  ++counters_.assemblies_abandoned;
  handler_.abandoned(closed->id, closed->kind);
}

bool Network::deliver(const Envelope& envelope, std::span<const std::byte> bytes) {
  auto opened = codec_.open_message(bytes);
  if (!opened || kind_of(opened->message) != envelope.kind) {
    ++counters_.dropped_malformed;
    if (bytes.size() > envelope.chunk_bytes) handler_.abandoned(envelope.id, envelope.kind);
    return true;
  }
  if (!handler_.deliver({envelope.source, envelope.id, envelope.hops, opened->message,
                         opened->payload, envelope.actors}))
    return false;
  ++counters_.messages_delivered;
  return true;
}

// ---- link changes

void Network::learn(const LinkChanges& told, const Link& by) {
  LinkChanges news;
  for (const LinkChange& change : told.changes)
    if (view_.merge(change)) news.changes.push_back(change);
  spread(news, &by);
}

void Network::watch_links(Nanoseconds now) {
  LinkChanges news;
  for (size_t i = 0; i < links_.size(); ++i) {
    const LinkState& state = links_[i].state();
    Watched& last = watched_[i];
    const bool another_session = links_[i].sessions() != last.sessions;
    if (last.phase == state.phase() && !another_session) continue;
    if (last.usable && (!state.usable() || another_session)) ++counters_.links_down;
    if (another_session) {
      ++counters_.links_up;
      links_[i].beat(view_.hash(), now);  // with the first grants
      links_[i].say(view_.changes());
    }
    last.usable = state.usable();
    last.sessions = links_[i].sessions();
    last.phase = state.phase();
    log_debug("link={} node={} neighbour={}", name_of(state.phase()), config_.self.value,
              links_[i].neighbour().value);
    last.to_tell = true;

    if (state.phase() == LinkPhase::down) transport_.renew(links_[i].neighbour());
    const bool gone = state.phase() == LinkPhase::down || state.phase() == LinkPhase::refused;
    if (!gone && !state.usable()) continue;  // in transition: wait for the outcome
    const Edge edge = edge_between(config_.self, links_[i].neighbour());
    if (view_.set(edge, !gone)) news.changes.push_back({edge.a, edge.b, view_.version(edge)});
  }
  spread(news, nullptr);
  // Only after the routes are updated: a handler told that a link is up may send over it.
  for (size_t i = 0; i < links_.size(); ++i)
    if (std::exchange(watched_[i].to_tell, false))
      handler_.link_changed(links_[i].neighbour(), watched_[i].phase);
}

void Network::spread(const LinkChanges& news, const Link* except) {
  if (news.changes.empty()) return;
  for (Link& link : links_)
    if (&link != except) link.say(news);
  router_.use(handler_.reroute(view_.down()));
  ++counters_.reroutes;
}

}  // namespace luxodus

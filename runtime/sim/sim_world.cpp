#include "runtime/sim/sim_world.hpp"

#include <algorithm>
#include <utility>

#include "runtime/actor/timers.hpp"
#include "runtime/core/check.hpp"

namespace luxodus {

struct SimWorld::Frame {
  Way* way = nullptr;
  Lane lane = Lane::control;
  uint64_t connection = 0;  // of the way when the frame was sent
  bool ghost = false;       // outlives its connection
  std::vector<std::byte> bytes;
};

/// An ordered pair of neighbours.
struct SimWorld::Way {
  NodeId from, to;
  uint64_t connection = 0;      // number of connections so far; both ways of a link agree
  Nanoseconds connects_at = 0;  // until then there is no connection
  Nanoseconds clogged_until = 0;
  Nanoseconds cut_until = 0;
  Nanoseconds free_at = 0;                // when the wire is free, by its bandwidth
  std::array<Nanoseconds, lanes> last{};  // arrival of the previous frame: order within a lane
  size_t queued_bytes = 0;
};

struct SimWorld::Event {
  enum class Kind : uint8_t { turn, arrival, fault_begins, fault_ends };
  Nanoseconds at = 0;
  uint64_t sequence = 0;
  Kind kind = Kind::turn;
  uint32_t subject = 0;  // node, slot or fault
  uint64_t ticket = 0;   // of a turn: only the last one requested counts

  static bool later(const Event& a, const Event& b) {
    return a.at != b.at ? a.at > b.at : a.sequence > b.sequence;
  }
};

struct SimWorld::Node {
  NodeId id;
  SimClock clock;
  std::unique_ptr<Port> port;
  std::unique_ptr<SimNode> node;  // null: crashed, or has left
  bool left = false;
  uint32_t life = 0;
  Nanoseconds paused_until = 0;
  Nanoseconds turn_at = never;
  bool rested = false;  // since its last turn
  uint64_t ticket = 0;
  std::array<std::deque<std::pair<NodeId, std::vector<std::byte>>>, lanes> inbox;
};

class SimWorld::Port final : public Transport {
 public:
  Port(SimWorld& world, Node& node) : world_(world), node_(node) {}

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override {
    return world_.send(node_.id, neighbour, lane, head, body);
  }
  void renew(NodeId) override {}  // frames are never torn
  std::optional<Arrival> receive() override {
    for (const Lane lane : {Lane::control, Lane::bulk}) {
      auto& queue = node_.inbox[static_cast<size_t>(lane)];
      if (queue.empty()) continue;
      given_ = std::move(queue.front());
      queue.pop_front();
      node_.clock.charge(world_.setup_.frame_cost, Spent::frames);
      world_.charge_bytes(node_, given_.second.size());
      return Arrival{given_.first, lane, given_.second};
    }
    return std::nullopt;
  }
  void wait_until(Nanoseconds) override {
    LUX_CHECK(false, "a simulated node waits between its turns, not in them");
  }
  void wake() noexcept override {}  // there is no other thread

 private:
  SimWorld& world_;
  Node& node_;
  std::pair<NodeId, std::vector<std::byte>> given_;  // the frame that the last Arrival points into
};

SimWorld::SimWorld(const SimSetup& setup)
    : setup_(setup), troubles_(setup.plan.links, setup.plan.seed, 0) {
  for (uint16_t i = 0; i < setup.nodes; ++i) {
    nodes_.push_back(std::make_unique<Node>());
    nodes_.back()->id = {i};
    nodes_.back()->port = std::make_unique<Port>(*this, *nodes_.back());
  }
  if (setup.cores > 0 && !setup.hosts.empty()) {
    LUX_CHECK(setup.hosts.size() == setup.nodes, "every node of a world has its machine");
    const uint16_t last_host = *std::max_element(setup.hosts.begin(), setup.hosts.end());
    cores_.assign(size_t{last_host} + 1, std::vector<Nanoseconds>(setup.cores, 0));
  }
  ways_.resize(size_t{setup.nodes} * setup.nodes);
  for (const Edge& edge : setup.edges)
    for (const auto& [from, to] : {std::pair{edge.a, edge.b}, std::pair{edge.b, edge.a}}) {
      auto& made = ways_[size_t{from.value} * setup.nodes + to.value];
      made = std::make_unique<Way>();
      made->from = from;
      made->to = to;
    }
}

SimWorld::~SimWorld() {
  for (auto& node : nodes_)
    if (node->node) node->node->die();
}

SimClock& SimWorld::clock(NodeId node) {
  return nodes_[node.value]->clock;
}
Transport& SimWorld::transport(NodeId node) {
  return *nodes_[node.value]->port;
}
SimNode* SimWorld::node(NodeId node) {
  return nodes_[node.value]->node.get();
}

void SimWorld::start(MakeNode make_node) {
  make_ = std::move(make_node);
  here_ = nodes_.size();
  for (auto& node : nodes_) make(*node);
  for (uint32_t i = 0; i < setup_.plan.faults.size(); ++i)
    if (!setup_.plan.faults[i].after_events)
      push({setup_.plan.faults[i].at, 0, Event::Kind::fault_begins, i, 0});
}

void SimWorld::make(Node& node) {
  node.node = make_(node.id, node.life);
  wake(node, now_);
}

// ---- events ------------------------------------------------------------------------------------

void SimWorld::push(Event event) {
  event.sequence = ++sequence_;
  events_.push_back(event);
  std::push_heap(events_.begin(), events_.end(), Event::later);
}

bool SimWorld::step() {
  departed_.reset();
  while (!events_.empty() && here_ > 0) {
    std::pop_heap(events_.begin(), events_.end(), Event::later);
    const Event event = events_.back();
    events_.pop_back();
    if (event.kind == Event::Kind::turn && event.ticket != nodes_[event.subject]->ticket) continue;
    now_ = event.at;
    last_ = no_node;
    ++counters_.events;
    trace_.add(static_cast<uint64_t>(now_));
    trace_.add((uint64_t{event.subject} << 8) | static_cast<uint64_t>(event.kind));
    switch (event.kind) {
      case Event::Kind::turn:
        take_turn(*nodes_[event.subject]);
        break;
      case Event::Kind::arrival:
        arrive(event.subject);
        break;
      case Event::Kind::fault_begins:
        begin(setup_.plan.faults[event.subject]);
        if (setup_.plan.faults[event.subject].lasts > 0)
          push({now_ + setup_.plan.faults[event.subject].lasts, 0, Event::Kind::fault_ends,
                event.subject, 0});
        break;
      case Event::Kind::fault_ends:
        end(setup_.plan.faults[event.subject]);
        break;
    }
    begin_counted();
    return true;
  }
  return false;
}

/// Begins faults that are triggered by a number of events.
void SimWorld::begin_counted() {
  for (uint32_t i = 0; i < setup_.plan.faults.size(); ++i)
    if (setup_.plan.faults[i].after_events == counters_.events)
      push({now_, 0, Event::Kind::fault_begins, i, 0});
}

/// Schedules the node's next turn at `at` or earlier, as soon as it is free.
void SimWorld::wake(Node& node, Nanoseconds at) {
  if (node.node == nullptr) return;
  at = std::max({at, now_, node.clock.now(), node.paused_until});
  if (at >= node.turn_at) return;
  node.turn_at = at;
  push({at, 0, Event::Kind::turn, node.id.value, ++node.ticket});
}

/// The core of the node's machine that is free first; null if every node has one of its own.
Nanoseconds* SimWorld::free_core(const Node& node) {
  if (cores_.empty()) return nullptr;
  std::vector<Nanoseconds>& cores = cores_[setup_.hosts[node.id.value]];
  return &*std::min_element(cores.begin(), cores.end());
}

void SimWorld::charge_bytes(Node& node, size_t bytes) {
  node.clock.charge(static_cast<Nanoseconds>(setup_.byte_cost_ns * static_cast<double>(bytes)),
                    Spent::frames);
}

void SimWorld::take_turn(Node& node) {
  last_ = node.id;
  node.turn_at = never;
  Nanoseconds* const core = free_core(node);
  if (core != nullptr && *core > now_) return wake(node, *core);
  node.clock.reach(now_);
  if (std::exchange(node.rested, false)) node.clock.charge(setup_.rest_cost, Spent::resting);
  const Nanoseconds due = node.node->turn();
  node.clock.charge(setup_.turn_cost);
  if (core != nullptr) *core = node.clock.now();
  if (node.node->finished()) {
    departed_ = std::move(node.node);
    node.left = true;
    --here_;
    for (const auto& way : ways_)
      if (way && way->from == node.id) break_connection(way->from, way->to);
    return;
  }
  const bool waiting = !node.inbox[0].empty() || !node.inbox[1].empty();
  node.rested = !waiting && due > node.clock.now();
  if (waiting || due != never) wake(node, waiting ? now_ : due);
}

// ---- links -------------------------------------------------------------------------------------

SimWorld::Way* SimWorld::way(NodeId from, NodeId to) {
  return ways_[size_t{from.value} * setup_.nodes + to.value].get();
}

Sent SimWorld::send(NodeId from, NodeId to, Lane lane, std::span<const std::byte> head,
                    std::span<const std::byte> body) {
  Way* const way = this->way(from, to);
  const Node& sender = *nodes_[from.value];
  const Node& receiver = *nodes_[to.value];
  const Nanoseconds sent_at = sender.clock.now();
  if (way == nullptr || sender.node == nullptr || receiver.node == nullptr ||
      sent_at < way->connects_at)
    return Sent::unreachable;
  const size_t bytes = head.size() + body.size();
  if (way->queued_bytes + bytes > setup_.plan.links.queue_bytes) {
    ++counters_.refused_full;
    return Sent::full;
  }
  const bool chosen = setup_.plan.lost_frame == counters_.frames;
  ++counters_.frames;
  counters_.bytes += bytes;
  nodes_[from.value]->clock.charge(setup_.send_cost, Spent::frames);
  charge_bytes(*nodes_[from.value], bytes);
  Frame frame{way, lane, way->connection, false, {}};
  frame.bytes.reserve(bytes);
  frame.bytes.insert(frame.bytes.end(), head.begin(), head.end());
  frame.bytes.insert(frame.bytes.end(), body.begin(), body.end());
  trace_.add(frame.bytes.data(), frame.bytes.size());

  way->free_at = std::max(way->free_at, sent_at) + troubles_.wire_time(bytes);
  const FrameFate fate = troubles_.next(healed());
  const Nanoseconds at = std::max(way->free_at, way->clogged_until) + fate.hold;
  if (now_ < way->cut_until || fate.lost || chosen) {
    ++counters_.lost;
    return Sent::taken;
  }
  if (fate.harmed) {
    ++counters_.corrupted;
    troubles_.harm(frame.bytes);
  }
  if (fate.again) {
    ++counters_.duplicated;
    launch(*way, frame, way->free_at + *fate.again);
  }
  if (fate.ghost) {
    ++counters_.ghosts;
    Frame late = frame;
    late.ghost = true;
    launch(*way, std::move(late), way->free_at + *fate.ghost);
  }
  Nanoseconds& before = way->last[static_cast<size_t>(lane)];
  if (fate.overtaken)
    ++counters_.reordered;
  else
    before = std::max(before, at);
  launch(*way, std::move(frame), fate.overtaken ? at : before);
  return Sent::taken;
}

void SimWorld::launch(Way& way, Frame frame, Nanoseconds at) {
  way.queued_bytes += frame.bytes.size();
  uint32_t slot = 0;
  if (free_slots_.empty()) {
    slot = static_cast<uint32_t>(frames_.size());
    frames_.push_back(std::move(frame));
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
    frames_[slot] = std::move(frame);
  }
  push({at, 0, Event::Kind::arrival, slot, 0});
}

void SimWorld::arrive(uint32_t slot) {
  Frame frame = std::move(frames_[slot]);
  free_slots_.push_back(slot);
  Way& way = *frame.way;
  way.queued_bytes -= frame.bytes.size();
  Node& node = *nodes_[way.to.value];
  last_ = way.to;
  const bool stands = frame.connection == way.connection || frame.ghost;
  if (node.node == nullptr || !stands || now_ < way.cut_until) {
    ++counters_.lost;
    return;
  }
  node.inbox[static_cast<size_t>(frame.lane)].emplace_back(way.from, std::move(frame.bytes));
  const bool rests = node.clock.now() <= now_ && node.turn_at > now_;
  wake(node, rests ? now_ + setup_.wake_cost : now_);
}

void SimWorld::break_connection(NodeId a, NodeId b) {
  for (Way* way : {this->way(a, b), this->way(b, a)}) {
    if (way == nullptr) continue;
    ++way->connection;
    way->connects_at = now_ + setup_.reconnect;
    way->free_at = 0;
    way->last = {};
    way->clogged_until = 0;
  }
}

// ---- faults ------------------------------------------------------------------------------------

void SimWorld::begin(const Fault& fault) {
  ++counters_.faults;
  const Nanoseconds until = now_ + fault.lasts;
  Node& node = *nodes_[fault.node.value];
  Way* const way = this->way(fault.node, fault.peer);
  switch (fault.kind) {
    case Fault::Kind::crash:
      return crash(node);
    case Fault::Kind::pause:
      node.paused_until = std::max(node.paused_until, until);
      if (node.turn_at == never) return;
      node.turn_at = never;  // its turn waits until the pause is over
      return wake(node, until);
    case Fault::Kind::slow:
      return node.clock.set_slowness(fault.factor);
    case Fault::Kind::cut:
      if (way != nullptr) way->cut_until = std::max(way->cut_until, until);
      return;
    case Fault::Kind::clog:
      if (way != nullptr) way->clogged_until = std::max(way->clogged_until, until);
      return;
    case Fault::Kind::disconnect:
      return break_connection(fault.node, fault.peer);
    case Fault::Kind::full_disk:
    case Fault::Kind::failed_read:
    case Fault::Kind::failure:
      return;  // the node's stores and supervisor consult the plan
  }
}

void SimWorld::end(const Fault& fault) {
  Node& node = *nodes_[fault.node.value];
  if (fault.kind == Fault::Kind::slow) node.clock.set_slowness(1);
  if (fault.kind != Fault::Kind::crash || node.node != nullptr || node.left) return;
  ++node.life;
  make(node);
}

void SimWorld::crash(Node& node) {
  if (node.node == nullptr) return;
  ++counters_.crashes;
  std::unique_ptr<SimNode> dying = std::move(node.node);
  dying->die();  // its messages are dropped
  node.inbox = {};
  ++node.ticket;
  node.turn_at = never;
  for (const auto& way : ways_)
    if (way && way->from == node.id) break_connection(way->from, way->to);
}

}  // namespace luxodus

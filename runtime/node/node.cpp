// What a node consists of is made by start(), once all that was given before has been checked. The
// parts refer to each other in the order in which they stand in Parts.
#include "runtime/node/node.hpp"

#include <fmt/core.h>
#include <sys/random.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "runtime/core/check.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "runtime/node/node_options.hpp"
#include "runtime/node/shortest_routes.hpp"

namespace luxodus {

namespace {

/// How long a fiber waits for room to send: a window of a link is free again within a round trip.
constexpr Nanoseconds room_patience = seconds(10);
constexpr Nanoseconds look_for_room = milliseconds(1);

/// Bytes of an AppMessage and its tables beside the content.
constexpr size_t head_bytes = 256;
/// Bytes of an answer beside the object.
constexpr size_t reply_bytes = 256;

/// Of a link, for each kind of small messages: requests of all fetches at once, 230 B each with
/// their overhead. With a quarter of that a node sent some, and waited for a grant.
constexpr size_t small_window_bytes = NamedObjects::fetches_at_once * 264;

constexpr size_t max_name_bytes = 100;

/// As app_link_times(): a peer that was started again is connected to soon.
constexpr int longest_reconnect_ms = 150;

Incarnation fresh_incarnation() {
  Incarnation life{};
  while (life.value == 0)
    LUX_CHECK(::getrandom(&life.value, sizeof life.value, 0) == sizeof life.value,
              "the system gives no random number");
  return life;
}

/// Names stand in metrics and logs.
bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= max_name_bytes &&
         std::none_of(name.begin(), name.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '"' || c == '\\';
         });
}

/// The sentences of all, in one.
Problem all_of(const Problems& found) {
  std::string text;
  for (const Problem& one : found.list()) text += (text.empty() ? "" : "; ") + one.text();
  return problem(text, found.kind());
}

}  // namespace

struct Node::Machine {
  Machine(const std::vector<Admitted>& admitted, const ZmqConfig& config, const Clock& clock)
      : context(admitted), sockets(context, config, clock) {}
  ZmqContext context;
  ZmqTransport sockets;
};

struct Node::Parts {
  Parts(const ShellConfig& config, const NamedObjectsConfig& named, const Clock& clock,
        Transport& transport)
      : shell(
            config,
            [self = config.net.self, nodes = config.net.nodes, links = config.net.edges](
                std::span<const Edge> down) { return shortest_routes(self, nodes, links, down); },
            clock, transport),
        actors(shell.scheduler(), shell.actors()),
        objects(named, shell.scheduler(), shell.actors(), actors) {}
  NodeShell shell;
  AppActors actors;
  NamedObjects objects;
  std::set<std::string> tags;  // of fibers, which keep pointers to them
};

Node::Node(NodeOptions options) : options_(std::move(options)) {
  static const SystemClock clock;
  clock_ = &clock;
}

Node::Node(NodeOptions options, const Clock& clock, Transport& transport)
    : options_(std::move(options)), clock_(&clock), transport_(&transport) {}

Node::~Node() {
  if (parts_ && !finished()) die();
}

// ---- before it starts

void Node::actor(std::string name, Handler handler, ActorOptions options) {
  LUX_CHECK(!parts_, "an actor was added to a node that has started");
  actor_specs_.push_back({std::move(name), std::move(handler), std::move(options)});
}

void Node::fiber(std::string name, std::function<void()> body) {
  LUX_CHECK(!parts_, "a fiber was added to a node that has started: spawn() does that");
  fiber_specs_.push_back(std::make_unique<FiberSpec>(FiberSpec{std::move(name), std::move(body)}));
}

void Node::hold(std::string name, const Content& content) {
  LUX_CHECK(!parts_, "an object was added to a node that has started: put() does that");
  object_specs_.push_back({std::move(name), {content.bytes.begin(), content.bytes.end()}});
}

// ---- the start

Problems Node::mistakes() const {
  Problems found = mistakes_in(options_);
  const auto add = [&](std::string text) { found.add(problem(std::move(text))); };
  std::set<uint64_t> names;
  for (const ActorSpec& actor : actor_specs_) {
    if (!is_name(actor.name) || actor.name == "part_server")
      add(
          fmt::format("actor '{}': a name has 1 to {} characters, without quotes, backslashes and "
                      "control characters, and is not 'part_server', which is the runtime's",
                      actor.name, max_name_bytes));
    if (!names.insert(name_hash(actor.name)).second)
      add(fmt::format("actor '{}': another actor of this node has this name: give each its own",
                      actor.name));
    if (actor.options.mailbox == 0 || actor.options.mailbox > limits::app_mailbox)
      add(fmt::format("actor '{}': its mailbox has {} places: give 1 to {}", actor.name,
                      actor.options.mailbox, limits::app_mailbox));
    if (!actor.handler) add(fmt::format("actor '{}': it has no handler", actor.name));
  }
  if (actor_specs_.size() + 1 > limits::watched_actors)
    add(fmt::format("the node has {} actors: {} are the most", actor_specs_.size(),
                    limits::watched_actors - 1));
  if (fiber_specs_.size() > options_.fibers)
    add(fmt::format("{} fibers begin at the start, and NodeOptions::fibers is {}: raise it",
                    fiber_specs_.size(), options_.fibers));
  return found;
}

NetConfig Node::net_config() const {
  NetConfig net;
  net.self = {options_.self};
  net.incarnation = fresh_incarnation();
  net.nodes = options_.nodes.size();
  net.edges = links_of(options_);
  net.times = options_.times;
  net.falls_with_connection = true;
  net.assemblies = net.outbox_messages = NamedObjects::fetches_at_once;
  net.small_window_bytes = small_window_bytes;
  net.max_message_bytes =
      std::max(options_.max_message_bytes + head_bytes, options_.max_object_bytes + reply_bytes);
  const size_t hops = longest_route(net.nodes, net.edges) + 2;  // a detour around one failure
  net.hop_limit =
      static_cast<uint8_t>(std::min<size_t>(limits::hops, std::max<size_t>(net.hop_limit, hops)));
  net.identity.node = net.self;
  net.identity.level = Level::statistical;
  net.identity.run_id = options_.cluster;
  Hasher links;
  links.add(uint64_t{net.nodes});
  for (const Edge& edge : net.edges) links.add(uint64_t{edge.a.value} << 16 | edge.b.value);
  net.identity.topology_hash = links.value();
  return net;
}

SchedulerLimits Node::limits_of() const {
  SchedulerLimits limits;
  limits.fibers.count = options_.fibers + actor_specs_.size() + 1;
  limits.fibers.stack_bytes = options_.stack_bytes;
  limits.timers_beside_fibers = NamedObjects::max_timers() + 16;
  return limits;
}

/// Listens, and connects to the neighbours with smaller numbers.
Result<void> Node::join() {
  const auto own = endpoints_of(options_.nodes[options_.self]).value();
  if (auto listens = machine_->sockets.listen(own); !listens) return listens.problem();
  for (const Edge& link : links_of(options_)) {
    if (link.b.value != options_.self) continue;
    const auto where = endpoints_of(options_.nodes[link.a.value]).value();
    const std::string key = options_.keys ? options_.public_keys[link.a.value] : std::string();
    if (auto to = machine_->sockets.connect(link.a, where, key); !to) return to.problem();
  }
  return {};
}

/// Its own sockets, unless someone else's are used.
Result<void> Node::open_machine() {
  if (transport_ != nullptr) return {};
  std::vector<Admitted> admitted;
  for (uint16_t node = 0; node < options_.public_keys.size(); ++node)
    admitted.push_back({{node}, options_.public_keys[node]});
  machine_ = std::make_unique<Machine>(admitted,
                                       ZmqConfig{.self = {options_.self},
                                                 .keys = options_.keys,
                                                 .insecure = options_.insecure,
                                                 .max_reconnect_ms = longest_reconnect_ms},
                                       *clock_);
  transport_ = &machine_->sockets;
  return join();
}

void Node::make_parts() {
  ShellConfig config;
  config.net = net_config();
  config.scheduler = limits_of();
  config.max_payload_bytes = options_.waiting_bytes;
  NamedObjectsConfig named;
  named.self = {options_.self};
  named.nodes = options_.nodes.size();
  named.cache_bytes = options_.cache_bytes;
  named.max_object_bytes = options_.max_object_bytes;
  named.store_bytes = options_.store_bytes;
  named.known = options_.objects;
  parts_ = std::make_unique<Parts>(config, named, *clock_, *transport_);
  const auto add = [&](ActorName name, auto& actor, const char* label) {
    parts_->shell.actors().add(name, actor, label);
  };
  add(ActorName::application, parts_->actors, "application");
  add(ActorName::part_server, parts_->objects.server(), "part_server");
  parts_->shell.supervisor().watch({ActorName::part_server}, {"part_server", "part server"},
                                   parts_->objects.server());
  for (ActorSpec& spec : actor_specs_) {
    AppActor& actor = parts_->actors.add(
        std::make_unique<AppActor>(parts_->shell.scheduler(), spec.name, spec.options.mailbox,
                                   spec.handler, spec.options.reset));
    parts_->shell.supervisor().watch(
        {ActorName::application, spec.options.restarts, spec.options.within, Remedy::leave},
        {spec.name, fmt::format("actor '{}'", spec.name)}, actor);
  }
}

Result<void> Node::start() {
  LUX_CHECK(!parts_, "a node was started twice");
  if (const Problems found = mistakes(); !found.empty()) return all_of(found);
  if (auto opened = open_machine(); !opened) return opened;
  make_parts();
  Problems found;
  for (const ObjectSpec& object : object_specs_)
    if (auto held = parts_->objects.put(object.name, object.bytes); !held)
      found.add(held.problem());
  object_specs_.clear();
  parts_->shell.begin([this] { return leaving_; });
  if (!found.empty()) {
    leaving_ = true;
    return all_of(found);
  }
  for (const ActorSpec& spec : actor_specs_) parts_->actors.find(name_hash(spec.name))->start();
  for (const auto& spec : fiber_specs_) start_fiber_of(spec.get());
  return {};
}

/// Runs the body on a fiber, and forgets it when the fiber ends.
void Node::start_fiber_of(FiberSpec* spec) {
  const char* tag = parts_->tags.insert(spec->name).first->c_str();
  const auto started = parts_->shell.scheduler().fibers().start(tag, [this, spec] {
    std::exception_ptr why;
    try {
      spec->body();
    } catch (...) {
      why = std::current_exception();
    }
    if (why)
      parts_->shell.supervisor().condemn(
          {ActorName::none, Remedy::leave,
           fmt::format("the fiber '{}' has failed: {}", spec->name, text_of(why))});
    std::erase_if(fiber_specs_, [&](const auto& one) { return one.get() == spec; });
  });
  LUX_CHECK(started.has_value(), "the limits count every fiber");
}

Result<void> Node::spawn(std::string name, std::function<void()> body) {
  LUX_CHECK(parts_ != nullptr, "a fiber was started before the node: fiber() adds one");
  const Fibers& fibers = parts_->shell.scheduler().fibers();
  if (fibers.live() == fibers.capacity())
    return problem(fmt::format("fiber '{}': all {} fibers are in use: raise NodeOptions::fibers",
                               name, options_.fibers),
                   ProblemKind::no_room);
  fiber_specs_.push_back(std::make_unique<FiberSpec>(FiberSpec{std::move(name), std::move(body)}));
  start_fiber_of(fiber_specs_.back().get());
  return {};
}

// ---- the run

int Node::run() {
  if (auto started = start(); !started) {
    fmt::print(stderr, "node {}: {}\n", options_.self, started.problem().text());
    return started.problem().kind == ProblemKind::bad_input ? 2 : 1;
  }
  parts_->shell.run();
  if (leaving_) return 0;
  fmt::print(stderr, "node {}: {}\n", options_.self, verdict()->text);
  return 1;
}

Nanoseconds Node::turn() {
  return parts_->shell.turn();
}

bool Node::finished() const {
  return parts_ && parts_->shell.finished();
}

const std::optional<Verdict>& Node::verdict() const {
  return parts_->shell.supervisor().verdict();
}

void Node::die() {
  Fibers& fibers = parts_->shell.scheduler().fibers();
  fibers.cancel_all();
  while (fibers.any_ready()) fibers.run_next();
}

void Node::leave() {
  if (!parts_ || !verdict()) leaving_ = true;
}

void Node::wake() noexcept {
  if (transport_ != nullptr) transport_->wake();
}

// ---- messages

Result<void> Node::check(const ActorRef& to, const Content& content) const {
  LUX_CHECK(parts_ != nullptr, "a message was sent before the node started");
  if (to.node.value >= options_.nodes.size())
    return problem(
        fmt::format("node {} is none of the cluster: its {} nodes have the numbers 0 to "
                    "{}",
                    to.node.value, options_.nodes.size(), options_.nodes.size() - 1));
  if (content.bytes.size() > options_.max_message_bytes)
    return problem(
        fmt::format("a message of {} bytes to node {}: max_message_bytes is {}: raise "
                    "it at all nodes, put() the bytes as an object, or cut them",
                    content.bytes.size(), to.node.value, options_.max_message_bytes));
  return {};
}

Result<void> Node::send_head(const AppHead& head, NodeId to, const MessageId& id,
                             const Content& content) {
  if (auto ok = check({to, head.to}, content); !ok) return ok;
  Scheduler& scheduler = parts_->shell.scheduler();
  const SharedBytes shared = shared_copy(content.bytes);
  const Nanoseconds end = now() + room_patience;
  for (;;) {
    const SendOutcome sent = parts_->actors.send(head, to, id, shared);
    if (sent == SendOutcome::taken) return {};
    if (sent == SendOutcome::unreachable)
      return problem(fmt::format("no link that is up leads to node {}", to.value),
                     ProblemKind::lost_peer);
    if (scheduler.fibers().current() == nullptr || now() >= end)
      return problem(fmt::format("there is no room for a message to node {}", to.value),
                     ProblemKind::no_room);
    if (!sleep(look_for_room)) return node_leaves();
  }
}

Result<void> Node::send(const ActorRef& to, const Content& content) {
  LUX_CHECK(parts_ != nullptr, "a message was sent before the node started");
  return send_head({0, to.name, content.schema, false}, to.node, parts_->shell.actors().next_id(),
                   content);
}

void Node::answer(const Mail& question, const Content& content) {
  const auto sent = send_head({0, question.from.name, content.schema, true}, question.from.node,
                              question.id, content);
  if (!sent && sent.problem().kind == ProblemKind::bad_input)
    throw std::length_error(sent.problem().what);
}

Result<void> Node::put(std::string_view name, const Content& content) {
  LUX_CHECK(parts_ != nullptr, "an object was put before the node started: hold() does that");
  return parts_->objects.put(name, content.bytes);
}

Result<Mail> Node::ask(const ActorRef& to, const Content& content, Nanoseconds patience) {
  if (auto ok = check(to, content); !ok) return ok.problem();
  return parts_->actors.ask(to, content.schema, shared_copy(content.bytes), patience);
}

Result<std::span<const std::byte>> Node::get(std::string_view name) {
  LUX_CHECK(parts_ != nullptr, "an object was wanted before the node started");
  return parts_->objects.get(name);
}

bool Node::sleep(Nanoseconds span) {
  return parts_->shell.scheduler().sleep_until(now() + span) != Wake::cancelled;
}

Nanoseconds Node::now() const {
  return clock_->now();
}

bool Node::is_up(uint16_t neighbour) const {
  const LinkPhase phase = parts_->shell.network().phase({neighbour});
  return phase == LinkPhase::up || phase == LinkPhase::suspect;
}

NodeShell& Node::shell() {
  return parts_->shell;
}

const NamedObjects& Node::objects() const {
  return parts_->objects;
}

const AppActors& Node::actors() const {
  return parts_->actors;
}

}  // namespace luxodus

// A node of an application: a process (or a thread) that has actors, holds objects for others, and
// reaches the actors and objects of all other nodes. This is the door to the runtime for programs
// that are not Luxodus; docs/guide/runtime.md leads through it.
//
//   int main() {
//     Node node({.self = 1, .nodes = {"tcp://127.0.0.1:7400", "tcp://127.0.0.1:7410"}});
//     node.actor("echo", [&](Mail& mail) { node.answer(mail, mail.bytes()); });
//     return node.run();
//   }
//
// Messages may be lost, come twice and overtake each other. ask() repeats a request under one id
// until it is answered, so what answers it must be able to do so twice. Everything is done on the
// node's one thread: a handler or fiber that waits here lets others run; one that computes for
// milliseconds delays them all.
//
// Mistakes in the options, names and sizes are reported by start() and run(), all at once. Thread
// rule: made and run on one thread, except wake().
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "runtime/net/keys.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/transport.hpp"
#include "runtime/node/mail.hpp"
#include "runtime/node/named_objects.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

/// A link that failed is tried again this often, so that a peer that comes back is used within 200
/// ms. An attempt costs one frame.
constexpr LinkTimes app_link_times() {
  LinkTimes times;
  times.backoff = milliseconds(100);
  times.max_backoff = milliseconds(150);
  return times;
}

struct NodeOptions {
  uint16_t self = 0;               // number of this node
  std::vector<std::string> nodes;  // where each node listens, by number: "tcp://10.0.0.1:7400"
  std::vector<Edge> links = {};    // a < b; empty: one between any two nodes
  uint64_t cluster = 0;            // a number that tells this cluster from others
  std::optional<KeyPair> keys = std::nullopt;  // needed beyond this host
  std::vector<std::string> public_keys = {};   // of all nodes, by number, if there are keys
  bool insecure = false;                       // without keys beyond this host, on trusted networks
  size_t fibers = 64;                          // at once, beside one for each actor
  size_t stack_bytes = default_stack_bytes();  // of each
  size_t max_message_bytes = 16 << 20;         // content of one message
  size_t waiting_bytes = 256 << 20;            // contents of messages that wait in mailboxes
  size_t cache_bytes = 64 << 20;               // objects of other nodes
  size_t max_object_bytes = 1 << 20;           // of one object; equal at all nodes
  size_t store_bytes = 1 << 30;                // objects that are put here
  size_t objects = 4096;                       // names of others' objects that are remembered
  LinkTimes times = app_link_times();
};

struct ActorOptions {
  size_t mailbox = 64;  // messages that wait; more are dropped, and asked again
  size_t restarts = 0;  // after failures, within `within`; then the node leaves
  Nanoseconds within = seconds(60);
  std::function<void()> reset = {};  // restores the state for a new life
};

class Node {
 public:
  using Handler = AppActor::Handler;

  explicit Node(NodeOptions options);
  /// In the time and network of someone else, such as a simulation. Requires: both outlive this.
  Node(NodeOptions options, const Clock& clock, Transport& transport);
  /// Requires: finished(), die() was called, or it was never started.
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // ---- before it starts ------------------------------------------------------------------------

  /// An actor with a name of its own on this node. `handler` may suspend; an exception that leaves
  /// it is a failure of the actor.
  void actor(std::string name, Handler handler, ActorOptions options = {});
  /// Runs `body` on a fiber of its own from the start on. An exception that leaves it makes the
  /// node leave. `name` is for messages.
  void fiber(std::string name, std::function<void()> body);
  /// Holds an object for all nodes from the start on.
  void hold(std::string name, const Content& content);

  // ---- the run ---------------------------------------------------------------------------------

  /// Starts, runs until leave(), and says on stderr what went wrong. Returns the exit code of a
  /// program: 0, 1 if an actor or fiber failed, 2 for a mistake in the options.
  int run();
  /// For those who give it its turns: Errors: all mistakes in options, actors and objects; an
  /// endpoint that cannot be used.
  Result<void> start();
  /// One turn, which never waits. Returns when the next is due if nothing arrives before.
  Nanoseconds turn();
  bool finished() const;
  /// Why it left, if that was no leave().
  const std::optional<Verdict>& verdict() const;
  /// Has all fibers return at once, for a node that is destroyed in the middle of its work.
  void die();
  /// Ends the current wait of run(). Any thread.
  void wake() noexcept;

  // ---- on the node's thread --------------------------------------------------------------------

  /// The node ends: fibers are cancelled, neighbours told. What fails because of that is no failure
  /// of the node.
  void leave();

  /// Sends a message. On a fiber it waits for room in the node's outbox. Errors: a content over
  /// max_message_bytes; no route to the node; no room. Suspends if it is on a fiber.
  Result<void> send(const ActorRef& to, const Content& content);
  /// Answers a request, as send() does; if there is no room or no route, the answer is dropped, and
  /// who asked asks again. Errors (exception): a content over max_message_bytes.
  void answer(const Mail& question, const Content& content);
  /// Sends a request and waits for the answer. Errors: as send(); no answer in time; the node
  /// leaves. Requires: on a fiber. Suspends.
  Result<Mail> ask(const ActorRef& to, const Content& content, Nanoseconds patience = seconds(10));

  /// Runs `body` on a fiber of its own from now on, as fiber() does. Errors: no fiber is left.
  Result<void> spawn(std::string name, std::function<void()> body);
  /// Holds an object for all nodes from now on. Errors: see NamedObjects::put.
  Result<void> put(std::string_view name, const Content& content);
  /// An object of any node, valid until the fiber next suspends. Errors: see NamedObjects::get.
  /// Requires: on a fiber. Suspends.
  Result<std::span<const std::byte>> get(std::string_view name);

  /// False: the node leaves. Requires: on a fiber. Suspends.
  [[nodiscard]] bool sleep(Nanoseconds span);
  Nanoseconds now() const;
  /// Whether the link to a neighbour is up.
  bool is_up(uint16_t neighbour) const;

  // ---- its parts, for metrics and tests. Requires: started
  // ----------------------------------------

  NodeShell& shell();
  const NamedObjects& objects() const;
  const AppActors& actors() const;

 private:
  struct Machine;  // its own clock and sockets
  struct Parts;    // what exists once it has started

  struct ActorSpec {
    std::string name;
    Handler handler;
    ActorOptions options;
  };
  struct FiberSpec {
    std::string name;
    std::function<void()> body;
  };
  struct ObjectSpec {
    std::string name;
    std::vector<std::byte> bytes;
  };

  Problems mistakes() const;
  NetConfig net_config() const;
  SchedulerLimits limits_of() const;
  Result<void> join();
  Result<void> open_machine();
  void make_parts();
  void start_fiber_of(FiberSpec* spec);
  Result<void> check(const ActorRef& to, const Content& content) const;
  Result<void> send_head(const AppHead& head, NodeId to, const MessageId& id,
                         const Content& content);

  const NodeOptions options_;
  const Clock* clock_ = nullptr;
  Transport* transport_ = nullptr;
  std::unique_ptr<Machine> machine_;  // null: clock and transport are someone else's
  std::vector<ActorSpec> actor_specs_;
  std::vector<std::unique_ptr<FiberSpec>> fiber_specs_;
  std::vector<ObjectSpec> object_specs_;
  std::unique_ptr<Parts> parts_;
  bool leaving_ = false;
};

}  // namespace luxodus

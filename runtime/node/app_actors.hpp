// The actors of an application on one node. Each has a mailbox of a size of its own, which is
// handled on a fiber of its own, so that its handler may suspend. A message to a full mailbox is
// dropped and counted, as everywhere between nodes; requests are sent again under the same id until
// they are answered. Thread rule: the node's thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>

#include "runtime/actor/supervised.hpp"
#include "runtime/core/ring.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/node/mail.hpp"

namespace luxodus {

namespace limits {
/// Messages that wait for one actor of an application. Each takes 150 bytes beside its content.
inline constexpr size_t app_mailbox = 1'000'000;
}  // namespace limits

/// Why a wait ended before what it waited for came.
inline Problem node_leaves() {
  return problem("the node leaves", ProblemKind::lost_peer);
}

/// One actor: what handles its mail, one message after another.
class AppActor final : public Supervised {
 public:
  using Handler = std::function<void(Mail&)>;

  /// `name` outlives this. Requires: `mailbox` > 0. `reset` restores the handler's state for a new
  /// life; may be empty.
  AppActor(Scheduler& scheduler, std::string name, size_t mailbox, Handler handler,
           std::function<void()> reset);

  const std::string& name() const { return name_; }
  /// Begins to handle mail. Requires: the limits of fibers count one for it.
  void start();
  /// False: the mailbox is full.
  [[nodiscard]] bool offer(Mail mail);
  size_t waiting() const { return mail_.size(); }
  /// Messages that found the mailbox full.
  uint64_t rejected() const { return rejected_; }

 private:
  void handle_control() override {}
  void reset() override;
  void forget_mailbox() override;
  void handle_mail();

  Scheduler& scheduler_;
  const std::string name_;
  Ring<Mail> mail_;
  Handler handler_;
  std::function<void()> reset_;
  WaitList idle_;
  uint64_t rejected_ = 0;
};

/// The receiver of all messages of the application on a node, and its sender.
class AppActors final : public Recipient {
 public:
  /// Handles what the runtime's own parts say to each other in this way.
  using OwnLine = std::function<void(const Mail&)>;

  AppActors(Scheduler& scheduler, ActorSystem& system) : scheduler_(scheduler), system_(system) {}

  /// Requires: no actor has this name; before the first turn.
  AppActor& add(std::unique_ptr<AppActor> actor);
  AppActor* find(uint64_t name);
  /// Messages to `number`, which is below that of any name, come to `line`.
  void add_line(uint64_t number, OwnLine line) { lines_[number] = std::move(line); }

  /// Sends one message; `full` and `unreachable` are left to the caller. Requires: a content within
  /// the network's limit.
  SendOutcome send(const AppHead& head, NodeId to, const MessageId& id, SharedBytes content);

  /// Sends a request, again and again under one id, until it is answered or `patience` is over.
  /// Errors: no answer in that time; the fiber was cancelled. Requires: on a fiber. Suspends.
  Result<Mail> ask(const ActorRef& to, uint64_t schema, SharedBytes content, Nanoseconds patience);

  std::optional<Offered> accept(IncomingMessage incoming) override;
  size_t waiting() const override;

  struct Counters {
    uint64_t no_actor = 0;  // messages for a name that no actor has here
    uint64_t late = 0;      // answers that nobody waited for any more
    uint64_t rejected = 0;  // messages to a full mailbox
    uint64_t retries = 0;   // requests that were sent again
  };
  const Counters& counters() const { return counters_; }

 private:
  /// A fiber that waits for an answer.
  struct Question {
    WaitList asker;
    std::optional<Mail> answer;
  };

  Scheduler& scheduler_;
  ActorSystem& system_;
  std::deque<std::unique_ptr<AppActor>> actors_;
  std::unordered_map<uint64_t, AppActor*> by_name_;
  std::unordered_map<uint64_t, OwnLine> lines_;
  std::unordered_map<uint64_t, Question*> questions_;  // by sequence of their id
  Counters counters_;
};

/// Shares a copy of these bytes.
SharedBytes shared_copy(std::span<const std::byte> bytes);

}  // namespace luxodus

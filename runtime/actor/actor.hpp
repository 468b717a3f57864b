// An actor: state that only its own handlers touch, and a mailbox of two lanes. A control message
// is handled in the turn in which it arrives, on the scheduler's stack: it overtakes all data,
// needs no fiber and cannot be starved, but its handler may not suspend. Data messages are handled
// one after another on the actor's own fiber, and their handlers may suspend; while one is
// suspended, a control message may be handled. A class declares what it accepts, and has a handler
// `void on(Message&&)` or `void on(const Message&)` for each:
//
//   struct Stop {};
//   struct Square { int number; WaitList* answered; };
//   class Squarer final : public Actor<Squarer, ControlLane<Accepts<Stop, 1, WhenFull::coalesce>>,
//                                      DataLane<Accepts<Square, 64, WhenFull::wait>>> { ... };
//
// An exception that leaves a handler is a failure of the actor (supervised.hpp). Thread rule:
// belongs to one node; all calls are made on its thread.
#pragma once

#include "runtime/actor/mailbox.hpp"
#include "runtime/actor/supervised.hpp"

namespace luxodus {

template <class... Kinds>
using ControlLane = MailboxLane<Kinds...>;
template <class... Kinds>
using DataLane = MailboxLane<Kinds...>;

template <class Derived, class Control, class Data>
class Actor : public Supervised {
 public:
  /// `name` is a literal, the tag of the actor's fiber.
  Actor(Scheduler& scheduler, const char* name) : scheduler_(scheduler), name_(name) {}
  Actor(const Actor&) = delete;
  Actor& operator=(const Actor&) = delete;

  /// Begins to handle data, including messages sent before. Requires: called once, before the
  /// scheduler is sealed; the scheduler's limits count this fiber.
  void start() {
    LUX_CHECK(!scheduler_.sealed(), "an actor started after the seal");
    const auto fiber = scheduler_.fibers().start(name_, [this] { handle_data(); });
    LUX_CHECK(fiber.has_value(), "no fiber for an actor; the limits must count one for each");
  }

  /// Sends without waiting. Returns `rejected` if the kind is full and does not coalesce.
  template <class Message>
  [[nodiscard]] Offered offer(Message message) {
    if constexpr (is_control<Message>) {
      scheduler_.call_for_control(*this);
      return control_.offer(std::move(message));
    } else {
      return announced(data_.offer(std::move(message)));
    }
  }

  /// Sends; waits if the kind is full and its reaction is `wait`. Returns `cancelled` if the
  /// sending fiber was cancelled. Requires: on a fiber. Suspends.
  template <class Message>
  [[nodiscard]] Offered send(Message message) {
    if constexpr (is_control<Message>)
      return offer(std::move(message));
    else
      return announced(data_.send(scheduler_.fibers(), std::move(message)));
  }

  size_t waiting() const { return control_.size() + data_.size(); }

  /// Whether the actor accepts messages of this type.
  template <class Message>
  static constexpr bool accepts =
      Control::template accepts<Message> || Data::template accepts<Message>;
  /// Memory of the mailbox.
  static constexpr size_t memory_bytes() { return Control::memory_bytes() + Data::memory_bytes(); }

 protected:
  Scheduler& scheduler() { return scheduler_; }
  const Scheduler& scheduler() const { return scheduler_; }

 private:
  static_assert(!Control::any_waits, "who sends control may be the loop itself, which never waits");
  template <class Message>
  static constexpr bool is_control = Control::template accepts<Message>;
  // Yields after this many messages, so that a long queue does not starve other fibers.
  static constexpr size_t messages_at_once = 32;

  void handle_control() final {
    for (size_t left = control_.size(); left > 0; --left)
      handle(control_.take(scheduler_.fibers()));
    if (!control_.empty()) scheduler_.call_for_control(*this);
  }

  void handle_data() {
    Fibers& fibers = scheduler_.fibers();
    for (size_t handled = 0; !fibers.cancelled();) {
      if (data_.empty() || failed()) {
        if (fibers.wait(idle_, failed() ? "failed" : "mailbox empty") == Wake::cancelled) return;
        continue;
      }
      handle(data_.take(fibers));
      if (++handled % messages_at_once == 0 && fibers.yield() == Wake::cancelled) return;
    }
  }

  template <class Any>
  void handle(Any any) {
    guarded([&] {
      std::visit(
          [this](auto& message) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(message)>, std::monostate>)
              static_cast<Derived*>(this)->on(std::move(message));
          },
          any);
    });
  }

  void forget_mailbox() final {
    while (!control_.empty()) (void)control_.take(scheduler_.fibers());
    while (!data_.empty()) (void)data_.take(scheduler_.fibers());
  }

  Offered announced(Offered sent) {
    if (sent == Offered::taken) scheduler_.fibers().wake_one(idle_);
    return sent;
  }

  Scheduler& scheduler_;
  const char* name_;
  Control control_;
  Data data_;
  WaitList idle_;  // the actor's fiber, while it has nothing to do
};

}  // namespace luxodus

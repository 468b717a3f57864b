// One lane of an actor's mailbox. Messages are small movable structs, kept by value in an array
// whose size is the sum of the limits of their kinds, so sending allocates nothing; large data is
// sent by a handle. Messages come out in the order in which they went in. Every kind has a limit
// and declares what happens beyond it: nothing is dropped silently. Thread rule: belongs to one
// node; sender and receiver are on its thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/core/check.hpp"
#include "runtime/fiber/fiber.hpp"

namespace luxodus {

/// What happens to a message whose kind has reached its limit.
enum class WhenFull {
  wait,      // the sender waits; senders are served in order
  reject,    // the sender is told, and decides
  coalesce,  // it replaces the message of its kind that was sent last
  fail,      // the memory plan rules it out: the process aborts
};

enum class Offered { taken, rejected, cancelled };

/// A kind of message that an actor accepts: at most `most` wait in the mailbox.
template <class MessageType, size_t most, WhenFull reaction>
struct Accepts {
  using Message = MessageType;
  static constexpr size_t limit = most;
  static constexpr WhenFull when_full = reaction;
  static_assert(std::is_nothrow_move_constructible_v<Message> &&
                    std::is_nothrow_move_assignable_v<Message>,
                "a message moves from its sender through the mailbox to its handler");
  static_assert(sizeof(Message) <= 256, "large things are sent by a handle");
  static_assert(most > 0);
};

template <class... Kinds>
class MailboxLane {
 public:
  /// Any message of the lane; monostate means none.
  using Any = std::variant<std::monostate, typename Kinds::Message...>;
  static constexpr size_t capacity = (Kinds::limit + ... + 0);
  static constexpr bool any_waits = ((Kinds::when_full == WhenFull::wait) || ...);

  template <class Message>
  static constexpr bool accepts = (std::is_same_v<Message, typename Kinds::Message> || ...);

  MailboxLane() : slots_(capacity) {}

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }
  /// For a memory plan.
  static constexpr size_t memory_bytes() { return capacity * sizeof(Any); }

  /// Takes `message` without waiting: a kind whose reaction is `wait` rejects instead.
  template <class Message>
  [[nodiscard]] Offered offer(Message message) {
    constexpr size_t kind = kind_of<Message>();
    if (counts_[kind].held < limits[kind]) {
      ++counts_[kind].held;
      append(kind, std::move(message));
      return Offered::taken;
    }
    constexpr WhenFull reaction = reactions[kind];
    if constexpr (reaction == WhenFull::coalesce) {
      slots_[counts_[kind].last % capacity] = std::move(message);
      return Offered::taken;
    } else {
      LUX_CHECK(reaction != WhenFull::fail, "a mailbox is full of a kind that may not wait");
      return Offered::rejected;
    }
  }

  /// Takes `message`, after a wait if necessary. Requires: on a fiber. Suspends if the kind's
  /// reaction is `wait`.
  template <class Message>
  [[nodiscard]] Offered send(Fibers& fibers, Message message) {
    constexpr size_t kind = kind_of<Message>();
    if constexpr (reactions[kind] == WhenFull::wait) {
      if (counts_[kind].held == limits[kind]) {
        if (fibers.wait(counts_[kind].senders, "mailbox full") != Wake::woken)
          return Offered::cancelled;
        append(kind, std::move(message));  // the slot that take() freed for us
        return Offered::taken;
      }
    }
    return offer(std::move(message));
  }

  /// Removes and returns the oldest message. Its slot goes to the sender that has waited longest
  /// for this kind, so that no later sender overtakes it. Requires: !empty().
  Any take(Fibers& fibers) {
    LUX_CHECK(!empty(), "took from an empty mailbox");
    Any oldest = std::exchange(slots_[first_ % capacity], Any());
    Count& count = counts_[oldest.index() - 1];
    ++first_;
    --size_;
    if (!fibers.wake_one(count.senders)) --count.held;
    return oldest;
  }

 private:
  static constexpr std::array<size_t, sizeof...(Kinds)> limits{Kinds::limit...};
  static constexpr std::array<WhenFull, sizeof...(Kinds)> reactions{Kinds::when_full...};

  struct Count {
    size_t held = 0;    // in the lane, or reserved for a sender that was woken
    uint64_t last = 0;  // number of the message sent last
    WaitList senders;
  };

  template <class Message>
  static constexpr size_t kind_of() {
    static_assert(accepts<Message>, "the actor does not accept this kind of message");
    size_t kind = 0;
    const bool found =
        ((std::is_same_v<Message, typename Kinds::Message> || (++kind, false)) || ...);
    return found ? kind : sizeof...(Kinds);
  }

  template <class Message>
  void append(size_t kind, Message&& message) {
    LUX_CHECK(size_ < capacity, "a mailbox holds more than its kinds may");
    const uint64_t number = first_ + size_;
    slots_[number % capacity] = std::move(message);
    counts_[kind].last = number;
    ++size_;
  }

  std::vector<Any> slots_;
  std::array<Count, sizeof...(Kinds)> counts_{};
  uint64_t first_ = 0;  // messages are numbered in order of arrival
  size_t size_ = 0;
};

}  // namespace luxodus

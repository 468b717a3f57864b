// One lane of an actor's mailbox. Messages are small structs that can be moved, kept by value in an
// array whose size is the sum of the limits of their kinds, so sending takes no memory: what is
// large is a handle in its message. They come out in the order in which they went in. Every kind
// has a limit and says what becomes of one more: nothing is ever dropped in silence. Belongs to one
// node: senders and receiver are on its thread.
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

/// What becomes of a message whose kind has reached its limit.
enum class WhenFull {
  wait,      // its sender waits, first come, first served
  reject,    // its sender is told, and decides
  coalesce,  // it takes the place of the one of its kind that was sent last
  fail,      // our own arithmetic forbids it: the process ends
};

enum class Offered { taken, rejected, cancelled };

/// A kind of message, as an actor declares it: at most `most` wait in the mailbox.
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
  /// Any message of the lane; monostate is none.
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

  /// Takes `message` in without waiting: a kind whose reaction is `wait` rejects instead.
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

  /// Takes `message` in, after a wait if need be. Requires: on a fiber. Suspends where the kind's
  /// reaction is `wait`.
  template <class Message>
  [[nodiscard]] Offered send(Fibers& fibers, Message message) {
    constexpr size_t kind = kind_of<Message>();
    if constexpr (reactions[kind] == WhenFull::wait) {
      if (counts_[kind].held == limits[kind]) {
        if (fibers.wait(counts_[kind].senders, "mailbox full") != Wake::woken)
          return Offered::cancelled;
        append(kind, std::move(message));  // in the place that take() left to us
        return Offered::taken;
      }
    }
    return offer(std::move(message));
  }

  /// The oldest message, taken out; its place goes to the sender that waits the longest for one of
  /// the kind, so that no later sender overtakes him. Requires: !empty().
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
    size_t held = 0;    // in the lane, or promised to a sender that was woken
    uint64_t last = 0;  // the number of the one sent last
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
  uint64_t first_ = 0;  // messages are numbered as they come
  size_t size_ = 0;
};

}  // namespace luxodus

// Numeric ids, one type for each kind of thing, so that a node's id cannot be passed as an
// object's. Plain values; any thread.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace luxodus {

/// A numeric id. Tag only tells types apart; Number is what is sent.
template <class Tag, class Number>
struct Id {
  Number value{};

  friend constexpr auto operator<=>(Id, Id) = default;
};

/// A node of a run, from 0; every process and host uses the same numbers.
using NodeId = Id<struct NodeTag, std::uint16_t>;

/// One start of one node: a random number, by which messages of an earlier start are recognised.
using Incarnation = Id<struct IncarnationTag, std::uint64_t>;

/// An immutable object, named by the hash of its bytes.
using ObjectId = Id<struct ObjectTag, std::uint64_t>;

}  // namespace luxodus

template <class Tag, class Number>
struct std::hash<luxodus::Id<Tag, Number>> {
  std::size_t operator()(luxodus::Id<Tag, Number> id) const noexcept {
    return std::hash<Number>{}(id.value);
  }
};

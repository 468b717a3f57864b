// Names of things as numbers, one type each, so that a node is never taken for an object.
// Plain values; any thread.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace luxodus {

/// A number that names one kind of thing. Tag is only a type; Number is what travels.
template <class Tag, class Number>
struct Id {
  Number value{};

  friend constexpr auto operator<=>(Id, Id) = default;
};

/// A node of a run, from 0; the same for every process, whatever hosts they run on.
using NodeId = Id<struct NodeTag, std::uint16_t>;

/// One start of one node: drawn at random, so that what an earlier life sent is known as such.
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

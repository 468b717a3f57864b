// How the fields of a message are listed. A struct that travels has a function beside its members
// that names each of them once:
//
//   static constexpr void fields(auto&& field, auto& m) {
//     field("durationMs", m.duration_ms, "how long the leases stand [ms]");
//   }
//
// The name is that of wire.capnp. Writer, reader, tests and the table in PROTOCOL.md are functions
// `field`, called with every member in turn. A member that is itself a struct with a list stands in
// place: its fields are fields of the message, and its name is put in front of theirs ("grant" and
// "limit" are `grantLimit`). Everything here is pure; any thread.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "runtime/core/members.hpp"

namespace luxodus {

/// The limit of a field: the largest number, or the most items of a list.
struct AtMost {
  size_t count = 0;       // 0: a number has no limit, and a list no items
  const char* what = "";  // is counted: "leases"
};

/// The last value of an enumeration that travels. A byte above it is malformed.
template <class Enum>
inline constexpr Enum last_value = static_cast<Enum>(0xff);

/// A list of at most `most` items, which allocates nothing.
template <class Item, uint8_t most>
struct FixedList {
  std::array<Item, most> items;
  uint8_t count = 0;

  static constexpr size_t capacity() { return most; }
  constexpr size_t size() const { return count; }
  constexpr const Item* begin() const { return items.data(); }
  constexpr const Item* end() const { return items.data() + count; }
  /// Requires: size() < capacity().
  constexpr void push_back(const Item& item) { items[count++] = item; }
  friend constexpr bool operator==(const FixedList&, const FixedList&) = default;
};

namespace detail {
struct AnyField {
  void operator()(const char*, auto&, const char* = "", AtMost = {}) const {}
};

struct FieldCount {
  size_t count = 0;
  constexpr void operator()(const char*, auto&, const char* = "", AtMost = {}) { ++count; }
};
}  // namespace detail

/// A struct with a list of its fields.
template <class Struct>
concept Listed = requires(Struct& m) {
  Struct::fields(detail::AnyField{}, m);
};

/// What travels as one unsigned number: integers, enumerations and ids.
template <class Value>
concept Number = std::is_enum_v<Value> ||
                 (std::unsigned_integral<Value> && !std::same_as<Value, bool>) ||
                 requires(Value id) {
  Value{id.value};
};

constexpr auto number_of(Number auto value) {
  if constexpr (std::is_enum_v<decltype(value)>)
    return static_cast<std::underlying_type_t<decltype(value)>>(value);
  else if constexpr (std::is_class_v<decltype(value)>)
    return value.value;
  else
    return value;
}

template <class List>
using ItemOf = std::remove_cvref_t<decltype(*std::declval<const List&>().begin())>;

template <class List>
concept StructList = Listed<ItemOf<List>>;

/// Calls `field` for every field of `m`; never, if it has none.
template <class Struct>
constexpr void for_each_field(auto&& field, Struct& m) {
  using Plain = std::remove_const_t<Struct>;
  if constexpr (Listed<Plain>) Plain::fields(field, m);
}

/// How many members of a struct its list names.
template <class Struct>
consteval size_t members_listed() {
  Struct m{};
  detail::FieldCount fields;
  for_each_field(fields, m);
  return fields.count;
}

/// The name of a field as wire.capnp has it: "grant" and "limit" are "grantLimit".
inline std::string wire_name(const std::string& prefix, std::string name) {
  if (!prefix.empty() && name[0] >= 'a') name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return prefix + name;
}

}  // namespace luxodus

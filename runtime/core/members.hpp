// How many members a struct has, which shows that a list of its fields names them all. At compile
// time; any thread.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace luxodus {

namespace detail {
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// Stands for a member of any type. An optional one would also take it as its value, which is
/// ambiguous: AnyOptional stands for that.
struct AnyMember {
  template <class Value>
  requires(!is_optional<Value>) operator Value() const;  // NOLINT: implicit on purpose
};
struct AnyOptional {
  template <class Value>
  operator std::optional<Value>() const;  // NOLINT: implicit on purpose
};
}  // namespace detail

/// How many members a struct has: with how many values it can be initialised.
template <class Struct, class... Members>
consteval size_t members_of() {
  if constexpr (requires { Struct{Members{}..., detail::AnyMember{}}; })
    return members_of<Struct, Members..., detail::AnyMember>();
  else if constexpr (requires { Struct{Members{}..., detail::AnyOptional{}}; })
    return members_of<Struct, Members..., detail::AnyOptional>();
  else
    return sizeof...(Members);
}

}  // namespace luxodus

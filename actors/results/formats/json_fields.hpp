// Types as JSON. A struct that is written has a function beside its members that lists them once:
//
//   static constexpr void fields(auto&& field, auto& m) {
//     field("name", m.name);
//     field("width", m.width_m, {.unit = "m"});
//   }
//
// `json_of` and `read_fields` are made of this list, and no key stands anywhere else. A member that
// its list does not name fails to compile. Whatever is read is checked: a key is there, its value
// is of the kind of its member, and texts and numbers are no larger than limits allow. Keys that no
// list names are ignored. These templates are compiled slowly: include this in the one source that
// writes and reads a type. Pure functions; any thread.
#pragma once

#include <concepts>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/members.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Characters of a text.
inline constexpr size_t field_text = 20'000;
/// Largest absolute value of a number: seeds are the largest, integers below 2^64.
inline constexpr double field_number = 1.9e19;
/// Largest coordinate, as in scenes [m].
inline constexpr double field_metres = 1e7;
}  // namespace limits

/// How a field is written.
struct FieldForm {
  std::string_view unit = {};  // of a number, which is then {"value": ..., "unit": ...}
  /// Null stands for an optional that has no value, and for a number that is not finite (NaN when
  /// read). Otherwise the key of such an optional is left out, and such a number is refused.
  bool or_null = false;
  bool or_left_out = false;  // an empty text or list is left out with its key
  size_t max_text = limits::field_text;
};

/// Where a value is in its document: "checks[3].limit".
struct JsonPlace {
  const JsonPlace* in = nullptr;
  const char* key = nullptr;  // null: the item of this index
  size_t index = 0;

  std::string text() const;
};

/// In place of a key: the fields of the member are fields of the struct that has it.
struct InPlace {};
inline constexpr InPlace in_place;

/// A value that follows from others. It is written for other programs, and when read only checked
/// to be there.
template <class Make>
struct Derived {
  Make make;
};
template <class Make>
constexpr Derived<Make> derived(Make make) {
  return {std::move(make)};
}

/// A flag that is written as one of two words.
template <class Flag>
struct Either {
  Flag& flag;
  const char *yes, *no;
};
template <class Flag>
constexpr Either<Flag> either(Flag& flag, const char* yes, const char* no) {
  return {flag, yes, no};
}

/// How many values an enumeration has whose values are written as their names (`name_of`).
template <class Enum>
inline constexpr size_t names_of = static_cast<size_t>(Enum::count);

/// The form of a type that neither is plain nor lists its fields: `static Json write(const T&,
/// const FieldForm&)`, and `static Result<void> read(const Json&, T&, const JsonPlace&, const
/// FieldForm&)`.
template <class T>
struct JsonForm;

// Reading of plain values. Errors: the place, and what it is not.
Result<void> read_plain(const Json& json, bool& out, const JsonPlace& at);
Result<void> read_plain(const Json& json, double& out, const JsonPlace& at, const FieldForm& form);
Result<void> read_plain(const Json& json, std::string& out, const JsonPlace& at,
                        const FieldForm& form);
/// Coordinates or another list of numbers. Errors: not `count`, or one that is farther off than any
/// scene.
Result<void> read_plain(const Json& json, double* out, size_t count, const JsonPlace& at);
/// Errors: not whole, or not from `low` to `high`.
Result<void> read_whole(const Json& json, int64_t low, uint64_t high, uint64_t& out,
                        const JsonPlace& at);
Problem not_of_kind(const JsonPlace& at, std::string_view kind);
Problem no_key(const JsonPlace& at, std::string_view key);
Problem unknown_word(const JsonPlace& at, const std::string& word);

namespace detail {

template <class T>
concept HasForm = requires {
  sizeof(JsonForm<T>);
};

template <class T>
inline constexpr bool is_derived = false;
template <class Make>
inline constexpr bool is_derived<Derived<Make>> = true;
template <class T>
inline constexpr bool is_either = false;
template <class Flag>
inline constexpr bool is_either<Either<Flag>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class T>
inline constexpr bool is_map<std::map<std::string, T>> = true;
template <class T>
inline constexpr size_t coordinates = 0;
template <glm::length_t n>
inline constexpr size_t coordinates<glm::vec<n, double>> = n;

struct AnyJsonField {
  constexpr AnyJsonField operator()(auto, auto&&, const FieldForm& = {}) const { return *this; }
};

struct JsonFieldCount {
  size_t count = 0;
  template <class Member>
  constexpr JsonFieldCount& operator()(auto, Member&&, const FieldForm& = {}) {
    count += is_derived<std::remove_cvref_t<Member>> ? 0 : 1;
    return *this;
  }
};

/// A struct that nobody makes, whose members are named only.
template <class Struct>
struct NeverMade {
  static Struct object;
};

}  // namespace detail

/// A struct with a list of its fields.
template <class Struct>
concept FieldsListed = requires(Struct& m) {
  Struct::fields(detail::AnyJsonField{}, m);
};

/// How many members the list of a struct has to name.
template <class Struct>
inline constexpr size_t members_to_list = members_of<Struct>();

template <class Struct>
consteval size_t fields_listed() {
  detail::JsonFieldCount count;
  Struct::fields(count, detail::NeverMade<Struct>::object);
  return count.count;
}

template <class T>
Json json_of(const T& value, const FieldForm& form = {});

/// Adds the fields of a struct to an object.
class FieldWriter {
 public:
  explicit FieldWriter(Json& object) : object_(object) {}

  template <class T>
  const FieldWriter& operator()(const char* key, const T& member,
                                const FieldForm& form = {}) const {
    if constexpr (detail::is_derived<T>) {
      return (*this)(key, member.make(), form);
    } else {
      if (!is_left_out(member, form)) object_[key] = json_of(member, form);
      return *this;
    }
  }
  template <class T>
  const FieldWriter& operator()(InPlace, const T& member) const {
    if constexpr (!detail::is_optional<T>)
      T::fields(*this, member);
    else if (member)
      (*this)(in_place, *member);
    return *this;
  }

 private:
  template <class T>
  static bool is_left_out(const T& member, const FieldForm& form) {
    if constexpr (detail::is_optional<T>)
      return !member && !form.or_null;
    else if constexpr (requires { member.empty(); })
      return member.empty() && form.or_left_out;
    else
      return false;
  }

  Json& object_;
};

/// The value as JSON.
template <class T>
Json json_of(const T& value, const FieldForm& form) {
  if constexpr (detail::HasForm<T>) {
    return JsonForm<T>::write(value, form);
  } else if constexpr (detail::is_either<T>) {
    return Json(value.flag ? value.yes : value.no);
  } else if constexpr (detail::is_optional<T>) {
    return value ? json_of(*value, form) : Json();
  } else if constexpr (std::is_enum_v<T>) {
    return Json(name_of(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return form.unit.empty() ? number_json(value) : exact_json(value, form.unit);
  } else if constexpr (FieldsListed<T>) {
    static_assert(fields_listed<T>() == members_to_list<T>,
                  "a member is missing in the list of fields beside its struct");
    Json out = Json::object();
    T::fields(FieldWriter(out), value);
    return out;
  } else if constexpr (detail::is_map<T>) {
    Json out = Json::object();
    for (const auto& [key, one] : value) out[key] = json_of(one, form);
    return out;
  } else if constexpr (detail::coordinates<T> > 0) {
    Json out = Json::array();
    for (glm::length_t i = 0; i < T::length(); ++i) out.push_back(value[i]);
    return out;
  } else if constexpr (requires { value.begin(); } && !std::same_as<T, std::string>) {
    Json out = Json::array();
    for (const auto& one : value) out.push_back(json_of(one, form));
    return out;
  } else {
    return Json(value);
  }
}

template <class T>
Result<void> read_fields(const Json& json, T& out, const JsonPlace& at = {},
                         const FieldForm& form = {});

/// Reads the fields of an object into a struct, until one is wrong.
class FieldReader {
 public:
  FieldReader(const Json& object, const JsonPlace& at, Result<void>& done)
      : object_(object), at_(at), done_(done) {}

  template <class Member>
  const FieldReader& operator()(const char* key, Member&& member,
                                const FieldForm& form = {}) const {
    using T = std::remove_cvref_t<Member>;
    if constexpr (detail::is_derived<T>) {
      std::remove_cvref_t<decltype(member.make())> ignored{};
      return (*this)(key, ignored, form);
    } else {
      if (done_) take(key, member, form);
      return *this;
    }
  }
  /// All fields of an optional struct are there, or none.
  template <class T>
  const FieldReader& operator()(InPlace, T& member) const {
    if constexpr (!detail::is_optional<T>) {
      T::fields(*this, member);
    } else {
      bool any = false;
      typename T::value_type fresh{};
      T::value_type::fields(AnyKey{object_, any}, fresh);
      if (any) (*this)(in_place, member.emplace());
    }
    return *this;
  }

 private:
  template <class T>
  void take(const char* key, T& member, const FieldForm& form) const {
    const auto value = object_.find(key);
    if (value == object_.end()) {
      const bool may_be_absent = form.or_left_out || (detail::is_optional<T> && !form.or_null);
      if (!may_be_absent) done_ = no_key(at_, key);
    } else if (!(value->is_null() && form.or_left_out)) {
      done_ = read_fields(*value, member, JsonPlace{&at_, key}, form);
    }
  }
  /// Whether an object has a key of a list.
  struct AnyKey {
    const Json& object;
    bool& any;
    const AnyKey& operator()(const char* key, auto&&, const FieldForm& = {}) const {
      any = any || object.contains(key);
      return *this;
    }
    template <class T>
    const AnyKey& operator()(InPlace, T& member) const {
      T::fields(*this, member);
      return *this;
    }
  };
  const Json& object_;
  const JsonPlace& at_;
  Result<void>& done_;
};

namespace detail {

template <class T>
Result<void> read_optional(const Json& json, T& out, const JsonPlace& at, const FieldForm& form) {
  out.reset();
  if (json.is_null()) return {};
  return read_fields(json, out.emplace(), at, form);
}

template <class T>
Result<void> read_word(const Json& json, T& out, const JsonPlace& at) {
  std::string word;
  if (auto ok = read_plain(json, word, at, {}); !ok) return ok;
  for (size_t i = 0; i < names_of<T>; ++i)
    if (name_of(static_cast<T>(i)) == word) {
      out = static_cast<T>(i);
      return {};
    }
  return unknown_word(at, word);
}

template <class T>
Result<void> read_either(const Json& json, T& out, const JsonPlace& at) {
  std::string word;
  if (auto ok = read_plain(json, word, at, {}); !ok) return ok;
  if (word != out.yes && word != out.no) return unknown_word(at, word);
  out.flag = word == out.yes;
  return {};
}

template <class T>
Result<void> read_number(const Json& json, T& out, const JsonPlace& at, const FieldForm& form) {
  if constexpr (std::same_as<T, bool>) {
    return read_plain(json, out, at);
  } else if constexpr (std::integral<T>) {
    uint64_t bits = 0;
    auto ok = read_whole(json, static_cast<int64_t>(std::numeric_limits<T>::min()),
                         static_cast<uint64_t>(std::numeric_limits<T>::max()), bits, at);
    out = static_cast<T>(bits);
    return ok;
  } else {
    return read_plain(json, out, at, form);
  }
}

template <class T>
Result<void> read_map(const Json& json, T& out, const JsonPlace& at, const FieldForm& form) {
  if (!json.is_object()) return not_of_kind(at, "a table");
  for (const auto& [key, one] : json.items())
    if (auto ok = read_fields(one, out[key], JsonPlace{&at, key.c_str()}, form); !ok) return ok;
  return {};
}

template <class T>
Result<void> read_list(const Json& json, T& out, const JsonPlace& at, const FieldForm& form) {
  if (!json.is_array()) return not_of_kind(at, "a list");
  out.resize(json.size());
  for (size_t i = 0; i < out.size(); ++i)
    if (auto ok = read_fields(json[i], out[i], JsonPlace{&at, nullptr, i}, form); !ok) return ok;
  return {};
}

template <class T>
Result<void> read_struct(const Json& json, T& out, const JsonPlace& at) {
  if (!json.is_object()) return not_of_kind(at, "a table");
  Result<void> done;
  T::fields(FieldReader(json, at, done), out);
  return done;
}

}  // namespace detail

/// Reads a value. Errors: the first place that is wrong, and how: "checks[3] has no \"limit\"".
template <class T>
Result<void> read_fields(const Json& json, T& out, const JsonPlace& at, const FieldForm& form) {
  if constexpr (detail::HasForm<T>) {
    return JsonForm<T>::read(json, out, at, form);
  } else if constexpr (detail::is_either<T>) {
    return detail::read_either(json, out, at);
  } else if constexpr (detail::is_optional<T>) {
    return detail::read_optional(json, out, at, form);
  } else if constexpr (std::is_enum_v<T>) {
    return detail::read_word(json, out, at);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return detail::read_number(json, out, at, form);
  } else if constexpr (std::same_as<T, std::string>) {
    return read_plain(json, out, at, form);
  } else if constexpr (FieldsListed<T>) {
    return detail::read_struct(json, out, at);
  } else if constexpr (detail::is_map<T>) {
    return detail::read_map(json, out, at, form);
  } else if constexpr (detail::coordinates<T> > 0) {
    return read_plain(json, &out[0], detail::coordinates<T>, at);
  } else {
    return detail::read_list(json, out, at, form);
  }
}

}  // namespace luxodus

// A JSON value: null, boolean, number, text, list, or object whose keys keep their order. Its
// interface and text are those of nlohmann::ordered_json; only json.cpp includes that library,
// which takes seconds to compile. Plain values; any thread.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace luxodus {

namespace limits {
/// Nesting of lists and objects that are read: deeper text is damaged or malicious.
inline constexpr size_t json_nesting = 500;
}  // namespace limits

class JsonItem;
struct JsonMember;

class Json {
 public:
  /// A value was accessed as another kind, or a key does not exist.
  class exception : public std::runtime_error {
   public:
    using std::runtime_error::runtime_error;
  };

  Json() noexcept = default;
  Json(std::nullptr_t) noexcept {}                                       // NOLINT: implicit
  Json(std::same_as<bool> auto value) noexcept : kind_(Kind::boolean) {  // NOLINT: implicit
    truth_ = value;
  }
  Json(std::signed_integral auto value) noexcept : kind_(Kind::integer) {  // NOLINT: implicit
    integer_ = value;
  }
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value)
  noexcept : kind_(Kind::natural) {  // NOLINT: implicit
    natural_ = value;
  }
  Json(std::floating_point auto value) noexcept : kind_(Kind::real) {  // NOLINT: implicit
    real_ = static_cast<double>(value);
  }
  Json(const char* text);       // NOLINT: implicit
  Json(std::string text);       // NOLINT: implicit
  Json(std::string_view text);  // NOLINT: implicit
  /// A list or an object from a container.
  template <class T>
  Json(const std::vector<T>& values) : Json(array()) {  // NOLINT: implicit
    for (const T& value : values) push_back(Json(value));
  }
  template <class T>
  Json(const std::map<std::string, T>& values) : Json(object()) {  // NOLINT: implicit
    for (const auto& [key, value] : values) member(key) = Json(value);
  }
  /// An object if all items are pairs of a text and a value; else a list.
  Json(std::initializer_list<JsonItem> items);

  Json(const Json& other);
  Json(Json&& other) noexcept { swap(other); }
  Json& operator=(Json other) noexcept {
    swap(other);
    return *this;
  }
  ~Json();
  void swap(Json& other) noexcept;

  static Json array();
  static Json array(std::initializer_list<JsonItem> items);
  static Json object();

  /// Parses a text. Errors: is_discarded() if it is not JSON.
  static Json parse(std::string_view text);
  /// The value as text: on one line, or indented by this many spaces. Bytes that are not UTF-8
  /// become U+FFFD, numbers that are not finite become null.
  std::string dump(int indent = -1) const;

  bool is_null() const { return kind_ == Kind::null; }
  bool is_boolean() const { return kind_ == Kind::boolean; }
  bool is_number() const { return is_number_integer() || kind_ == Kind::real; }
  bool is_number_integer() const { return kind_ == Kind::integer || kind_ == Kind::natural; }
  bool is_number_unsigned() const { return kind_ == Kind::natural; }
  bool is_number_float() const { return kind_ == Kind::real; }
  bool is_string() const { return kind_ == Kind::text; }
  bool is_array() const { return kind_ == Kind::list; }
  bool is_object() const { return kind_ == Kind::object; }
  bool is_structured() const { return is_array() || is_object(); }
  bool is_discarded() const { return kind_ == Kind::discarded; }

  /// The value as a T: boolean, number, text or vector. Errors: throws if it is of another kind.
  template <class T>
  T get() const {
    if constexpr (std::same_as<T, bool>) {
      return truth();
    } else if constexpr (std::floating_point<T>) {
      return static_cast<T>(real());
    } else if constexpr (std::integral<T>) {
      return static_cast<T>(whole());
    } else if constexpr (std::same_as<T, std::string>) {
      return text();
    } else {
      T out;
      for (const Json& one : *this) out.push_back(one.get<typename T::value_type>());
      return out;
    }
  }
  template <class T>
  requires((std::is_arithmetic_v<T> && !std::same_as<T, char>) || std::same_as<T, std::string>)
  operator T() const {  // NOLINT: implicit, as numbers and texts are taken out
    return get<T>();
  }
  /// Errors: throws if it is not a text.
  const std::string& text() const;

  /// Number of items of a list or of keys of an object; 0 for null, else 1.
  size_t size() const;
  bool empty() const { return size() == 0; }
  void clear();

  /// An item of a list; null becomes a list.
  template <std::integral I>
  Json& operator[](I index) {
    return item(static_cast<size_t>(index));
  }
  template <std::integral I>
  const Json& operator[](I index) const {
    return item(static_cast<size_t>(index));
  }
  /// The value of a key, which is added if it is missing; null becomes an object.
  Json& operator[](const char* key) { return member(key); }
  Json& operator[](const std::string& key) { return member(key); }
  Json& operator[](std::string_view key) { return member(key); }
  /// Errors: throws if there is no such key.
  const Json& operator[](const char* key) const { return at(key); }
  const Json& operator[](const std::string& key) const { return at(key); }
  const Json& operator[](std::string_view key) const { return at(key); }
  const Json& at(std::string_view key) const;
  Json& at(std::string_view key) { return const_cast<Json&>(std::as_const(*this).at(key)); }
  const Json& at(size_t index) const { return item(index); }
  Json& at(size_t index) { return item(index); }
  const Json& front() const { return item(0); }
  Json& front() { return item(0); }
  const Json& back() const { return item(size() - 1); }
  Json& back() { return item(size() - 1); }

  bool contains(std::string_view key) const { return value_of(key) != nullptr; }
  /// The value at a path of keys and item numbers, separated by slashes ("state/media/0"), or none.
  const Json* at_path(std::string_view path) const;
  Json* at_path(std::string_view path) {
    return const_cast<Json*>(std::as_const(*this).at_path(path));
  }
  /// The value of a key, or another if there is none. Errors: throws if it is not a T.
  template <class T>
  T value(std::string_view key, T otherwise) const {
    const Json* const found = value_of(key);
    if (found == nullptr) return otherwise;
    if constexpr (std::same_as<T, Json>) {
      return *found;
    } else {
      return found->get<T>();
    }
  }
  std::string value(std::string_view key, const char* otherwise) const {
    return value(key, std::string(otherwise));
  }

  void push_back(Json value);
  void emplace_back(Json value) { push_back(std::move(value)); }
  /// Sets all keys of the other object.
  void update(const Json& other);
  /// Removes a key, and returns how many were removed.
  size_t erase(std::string_view key);
  void erase(size_t index);

  /// Iterates over the items of a list or the values of an object.
  template <bool Const>
  class Walk {
   public:
    using Value = std::conditional_t<Const, const Json, Json>;
    using Member = std::conditional_t<Const, const JsonMember, JsonMember>;
    using iterator_category = std::forward_iterator_tag;
    using value_type = Json;
    using difference_type = std::ptrdiff_t;
    using pointer = Value*;
    using reference = Value&;

    Walk() = default;
    Walk(Value* item, Member* member) : item_(item), member_(member) {}
    template <bool Other>
    requires(Const && !Other) Walk(const Walk<Other>& other)  // NOLINT: implicit
        : item_(other.item_), member_(other.member_) {}

    Value& operator*() const;
    Value* operator->() const { return &**this; }
    const std::string& key() const;
    Value& value() const { return **this; }
    Walk& operator++();
    Walk operator++(int) {
      const Walk before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Walk& other) const = default;

   private:
    friend class Walk<true>;
    friend class Json;
    Value* item_ = nullptr;
    Member* member_ = nullptr;
  };
  using iterator = Walk<false>;
  using const_iterator = Walk<true>;
  iterator begin();
  iterator end();
  const_iterator begin() const;
  const_iterator end() const;
  iterator find(std::string_view key);
  const_iterator find(std::string_view key) const;
  /// The keys and values of an object, empty for null: `for (const auto& [key, value] : ...)`.
  /// Errors: throws for other kinds.
  const std::vector<JsonMember>& items() const;

  friend bool operator==(const Json& a, const Json& b) { return a.equals(b); }
  template <class T>
  requires std::is_arithmetic_v<T>
  friend bool operator==(const Json& a, T b) { return a.equals(Json(b)); }
  friend std::ostream& operator<<(std::ostream& out, const Json& value) { return value.print(out); }

 private:
  friend class JsonBuilder;
  friend class JsonWriter;
  using List = std::vector<Json>;
  using Object = std::vector<JsonMember>;
  enum class Kind : uint8_t {
    null,
    boolean,
    integer,
    natural,
    real,
    text,
    list,
    object,
    discarded,
  };

  bool truth() const;
  double real() const;
  int64_t whole() const;
  Json& item(size_t index);
  const Json& item(size_t index) const;
  Json& member(std::string_view key);
  const Json* value_of(std::string_view key) const;
  bool equals(const Json& other) const;
  std::ostream& print(std::ostream& out) const;

  Kind kind_ = Kind::null;
  union {
    bool truth_;
    int64_t integer_;
    uint64_t natural_ = 0;
    double real_;
    std::string* text_;
    List* list_;
    Object* object_;
  };
};

/// A key of an object and its value.
struct JsonMember {
  std::string key;
  Json value;
};

/// The content of an initializer list: a value, or a nested list.
class JsonItem {
 public:
  JsonItem() noexcept = default;
  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, JsonItem> && std::constructible_from<Json, T>)
      JsonItem(T&& value)
      : value_(std::forward<T>(value)) {}                             // NOLINT: implicit
  JsonItem(std::initializer_list<JsonItem> items) : value_(items) {}  // NOLINT: implicit

 private:
  friend class Json;
  mutable Json value_;  // an initializer list is const, and its values are moved out of it
};

template <bool Const>
typename Json::Walk<Const>::Value& Json::Walk<Const>::operator*() const {
  return member_ != nullptr ? member_->value : *item_;
}
template <bool Const>
const std::string& Json::Walk<Const>::key() const {
  return member_->key;
}
template <bool Const>
Json::Walk<Const>& Json::Walk<Const>::operator++() {
  if (member_ != nullptr) {
    ++member_;
  } else {
    ++item_;
  }
  return *this;
}

}  // namespace luxodus

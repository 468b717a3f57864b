#include "actors/results/formats/json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

namespace luxodus {

namespace {

[[noreturn]] void refuse(const char* what) {
  throw Json::exception(what);
}

}  // namespace

/// Builds a value from the events of nlohmann's parser, without recursion.
class JsonBuilder {
 public:
  explicit JsonBuilder(Json& out) : out_(out) {}

  bool null() { return put(Json()); }
  bool boolean(bool value) { return put(Json(value)); }
  bool number_integer(int64_t value) { return put(Json(value)); }
  bool number_unsigned(uint64_t value) { return put(Json(value)); }
  bool number_float(double value, const std::string&) { return put(Json(value)); }
  bool string(std::string& value) { return put(Json(std::move(value))); }
  bool binary(std::vector<uint8_t>&) { return false; }  // JSON has none
  bool start_object(size_t) { return open(Json::object()); }
  bool start_array(size_t) { return open(Json::array()); }
  bool key(std::string& key) {
    key_ = std::move(key);
    return true;
  }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) { return false; }

 private:
  Json& place(Json value) {
    if (open_.empty()) return out_ = std::move(value);
    Json& in = *open_.back();
    if (in.is_object()) return in.member(key_) = std::move(value);
    in.push_back(std::move(value));
    return in.back();
  }
  bool put(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json value) {
    if (open_.size() >= limits::json_nesting) return false;
    // Open values do not move: only the last of these grows.
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Json& out_;
  std::vector<Json*> open_;
  std::string key_;
};

/// Writes a value as nlohmann::ordered_json does.
class JsonWriter {
 public:
  explicit JsonWriter(int indent) : indent_(indent) {}

  void write(const Json& value, int depth) {
    switch (value.kind_) {
      case Json::Kind::null:
      case Json::Kind::discarded:
        out_ += "null";
        break;
      case Json::Kind::boolean:
        out_ += value.truth_ ? "true" : "false";
        break;
      case Json::Kind::integer:
        out_ += std::to_string(value.integer_);
        break;
      case Json::Kind::natural:
        out_ += std::to_string(value.natural_);
        break;
      case Json::Kind::real:
        write_real(value.real_);
        break;
      case Json::Kind::text:
        write_text(*value.text_);
        break;
      case Json::Kind::list:
        out_ += '[';
        for (const Json& one : *value.list_) {
          if (&one != value.list_->data()) out_ += ',';
          break_line(depth + 1);
          write(one, depth + 1);
        }
        if (!value.list_->empty()) break_line(depth);
        out_ += ']';
        break;
      case Json::Kind::object:
        out_ += '{';
        for (const JsonMember& one : *value.object_) {
          if (&one != value.object_->data()) out_ += ',';
          break_line(depth + 1);
          write_text(one.key);
          out_ += indent_ >= 0 ? ": " : ":";
          write(one.value, depth + 1);
        }
        if (!value.object_->empty()) break_line(depth);
        out_ += '}';
        break;
    }
  }
  std::string take() { return std::move(out_); }

 private:
  void break_line(int depth) {
    if (indent_ < 0) return;
    out_ += '\n';
    out_.append(static_cast<size_t>(depth) * static_cast<size_t>(indent_), ' ');
  }
  void write_real(double value) {
    if (!std::isfinite(value)) {
      out_ += "null";
      return;
    }
    char buffer[64];
    out_.append(buffer, nlohmann::detail::to_chars(buffer, buffer + sizeof buffer, value));
  }
  void write_text(const std::string& text) {
    const auto is_plain = [](char c) { return c >= ' ' && c < '\x7f' && c != '"' && c != '\\'; };
    if (std::all_of(text.begin(), text.end(), is_plain)) {
      out_ += '"';
      out_ += text;
      out_ += '"';
    } else {
      out_ += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
  }

  int indent_;
  std::string out_;
};

Json::Json(const char* text) : Json(std::string(text)) {}
Json::Json(std::string_view text) : Json(std::string(text)) {}
Json::Json(std::string text) {
  text_ = new std::string(std::move(text));
  kind_ = Kind::text;
}

Json::Json(std::initializer_list<JsonItem> items) {
  const bool all_pairs = std::all_of(items.begin(), items.end(), [](const JsonItem& item) {
    const Json& value = item.value_;
    return value.is_array() && value.size() == 2 && value.front().is_string();
  });
  if (!all_pairs) {
    *this = array(items);
    return;
  }
  *this = object();
  for (const JsonItem& item : items) {
    // The first of equal keys counts.
    if (!contains(item.value_.front().text()))
      object_->push_back({std::move(*item.value_[0].text_), std::move(item.value_[1])});
  }
}

Json::Json(const Json& other) : kind_(other.kind_) {
  switch (kind_) {
    case Kind::text:
      text_ = new std::string(*other.text_);
      break;
    case Kind::list:
      list_ = new List(*other.list_);
      break;
    case Kind::object:
      object_ = new Object(*other.object_);
      break;
    default:
      natural_ = other.natural_;
  }
}

Json::~Json() {
  switch (kind_) {
    case Kind::text:
      delete text_;
      break;
    case Kind::list:
      delete list_;
      break;
    case Kind::object:
      delete object_;
      break;
    default:
      break;
  }
}

void Json::swap(Json& other) noexcept {
  std::swap(kind_, other.kind_);
  std::swap(natural_, other.natural_);
}

Json Json::array() {
  Json out;
  out.list_ = new List;
  out.kind_ = Kind::list;
  return out;
}

Json Json::array(std::initializer_list<JsonItem> items) {
  Json out = array();
  out.list_->reserve(items.size());
  for (const JsonItem& item : items) out.list_->push_back(std::move(item.value_));
  return out;
}

Json Json::object() {
  Json out;
  out.object_ = new Object;
  out.kind_ = Kind::object;
  return out;
}

Json Json::parse(std::string_view text) {
  Json out;
  JsonBuilder builder(out);
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return out;
  Json none;
  none.kind_ = Kind::discarded;
  return none;
}

std::string Json::dump(int indent) const {
  JsonWriter writer(indent);
  writer.write(*this, 0);
  return writer.take();
}

std::ostream& Json::print(std::ostream& out) const {
  return out << dump();
}

const std::string& Json::text() const {
  if (kind_ != Kind::text) refuse("this JSON value is no text");
  return *text_;
}

bool Json::truth() const {
  if (kind_ != Kind::boolean) refuse("this JSON value is neither true nor false");
  return truth_;
}

double Json::real() const {
  switch (kind_) {
    case Kind::boolean:
      return truth_ ? 1 : 0;
    case Kind::integer:
      return static_cast<double>(integer_);
    case Kind::natural:
      return static_cast<double>(natural_);
    case Kind::real:
      return real_;
    default:
      refuse("this JSON value is no number");
  }
}

int64_t Json::whole() const {
  switch (kind_) {
    case Kind::boolean:
      return truth_ ? 1 : 0;
    case Kind::integer:
      return integer_;
    case Kind::natural:
      return static_cast<int64_t>(natural_);
    case Kind::real:
      return static_cast<int64_t>(real_);
    default:
      refuse("this JSON value is no number");
  }
}

size_t Json::size() const {
  switch (kind_) {
    case Kind::null:
      return 0;
    case Kind::list:
      return list_->size();
    case Kind::object:
      return object_->size();
    default:
      return 1;
  }
}

void Json::clear() {
  switch (kind_) {
    case Kind::text:
      text_->clear();
      break;
    case Kind::list:
      list_->clear();
      break;
    case Kind::object:
      object_->clear();
      break;
    default:
      natural_ = 0;
  }
}

Json& Json::item(size_t index) {
  if (is_null()) *this = array();
  if (kind_ != Kind::list) refuse("this JSON value is no list");
  if (index >= list_->size()) list_->resize(index + 1);
  return (*list_)[index];
}

const Json& Json::item(size_t index) const {
  if (kind_ != Kind::list || index >= list_->size()) refuse("this JSON list has no such item");
  return (*list_)[index];
}

const Json* Json::value_of(std::string_view key) const {
  if (kind_ != Kind::object) return nullptr;
  for (const JsonMember& one : *object_)
    if (one.key == key) return &one.value;
  return nullptr;
}

Json& Json::member(std::string_view key) {
  if (is_null()) *this = object();
  if (kind_ != Kind::object) refuse("this JSON value is no object");
  if (const Json* const found = value_of(key)) return const_cast<Json&>(*found);
  return object_->emplace_back(std::string(key), Json()).value;
}

const Json& Json::at(std::string_view key) const {
  const Json* const found = value_of(key);
  if (found == nullptr) throw exception("no key \"" + std::string(key) + "\" in this JSON value");
  return *found;
}

const Json* Json::at_path(std::string_view path) const {
  const Json* at = this;
  while (at != nullptr && !path.empty()) {
    const std::string_view word = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(word.size() + 1, path.size()));
    if (at->is_array()) {
      size_t index = 0;
      const auto read = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool is_there = read.ec == std::errc() && read.ptr == word.data() + word.size() &&
                            index < at->list_->size();
      at = is_there ? &(*at->list_)[index] : nullptr;
    } else {
      at = at->value_of(word);
    }
  }
  return at;
}

void Json::push_back(Json value) {
  if (is_null()) *this = array();
  if (kind_ != Kind::list) refuse("this JSON value is no list");
  list_->push_back(std::move(value));
}

void Json::update(const Json& other) {
  for (const JsonMember& one : other.items()) member(one.key) = one.value;
}

size_t Json::erase(std::string_view key) {
  return kind_ != Kind::object
             ? 0
             : std::erase_if(*object_, [&](const JsonMember& one) { return one.key == key; });
}

void Json::erase(size_t index) {
  if (kind_ != Kind::list || index >= list_->size()) refuse("this JSON list has no such item");
  list_->erase(list_->begin() + static_cast<std::ptrdiff_t>(index));
}

Json::iterator Json::begin() {
  if (kind_ == Kind::object) return {nullptr, object_->data()};
  return {kind_ == Kind::list ? list_->data() : nullptr, nullptr};
}
Json::iterator Json::end() {
  if (kind_ == Kind::object) return {nullptr, object_->data() + object_->size()};
  return {kind_ == Kind::list ? list_->data() + list_->size() : nullptr, nullptr};
}
Json::const_iterator Json::begin() const {
  return const_cast<Json&>(*this).begin();
}
Json::const_iterator Json::end() const {
  return const_cast<Json&>(*this).end();
}

Json::iterator Json::find(std::string_view key) {
  if (kind_ != Kind::object) return end();
  const auto found = std::find_if(object_->begin(), object_->end(),
                                  [&](const JsonMember& one) { return one.key == key; });
  return {nullptr, object_->data() + (found - object_->begin())};
}
Json::const_iterator Json::find(std::string_view key) const {
  return const_cast<Json&>(*this).find(key);
}

const std::vector<JsonMember>& Json::items() const {
  static const std::vector<JsonMember> none;
  if (is_null()) return none;
  if (kind_ != Kind::object) refuse("this JSON value is no object");
  return *object_;
}

bool Json::equals(const Json& other) const {
  if (is_number() && other.is_number()) {
    if (is_number_float() || other.is_number_float()) return real() == other.real();
    return whole() == other.whole();
  }
  if (kind_ != other.kind_) return false;
  switch (kind_) {
    case Kind::null:
      return true;
    case Kind::boolean:
      return truth_ == other.truth_;
    case Kind::text:
      return *text_ == *other.text_;
    case Kind::list:
      return *list_ == *other.list_;
    case Kind::object:
      return std::equal(object_->begin(), object_->end(), other.object_->begin(),
                        other.object_->end(), [](const JsonMember& a, const JsonMember& b) {
                          return a.key == b.key && a.value == b.value;
                        });
    default:
      return false;
  }
}

}  // namespace luxodus

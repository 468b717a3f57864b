#include "scenes/formats/ifc/step_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/text.hpp"

namespace luxodus {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}
bool is_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

/// The position after blanks and comments.
size_t skip(std::string_view text, size_t at) {
  for (;;) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (text.substr(at, 2) != "/*") return at;
    const size_t end = text.find("*/", at + 2);
    if (end == std::string_view::npos) return text.size();
    at = end + 2;
  }
}

/// The position of the semicolon that ends the statement at `at`, outside texts and comments.
size_t end_of_statement(std::string_view text, size_t at) {
  for (; at < text.size(); ++at) {
    if (text[at] == ';') return at;
    if (text[at] == '\'') {
      at = text.find('\'', at + 1);
      if (at == std::string_view::npos) return at;
    } else if (text[at] == '/' && text.substr(at, 2) == "/*") {
      at = text.find("*/", at + 2);
      if (at == std::string_view::npos) return at;
      ++at;
    }
  }
  return std::string_view::npos;
}

std::optional<uint32_t> hexadecimal(std::string_view digits) {
  uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// Appends code units of `digits` hexadecimal digits each, until \X0\; returns the length read.
size_t append_wide(std::string& out, std::string_view text, size_t digits) {
  size_t at = 0;
  uint32_t high = 0;
  while (at + digits <= text.size() && text[at] != '\\') {
    const auto unit = hexadecimal(text.substr(at, digits));
    if (!unit) break;
    at += digits;
    if (*unit >= 0xd800 && *unit < 0xdc00) {
      high = *unit;
      continue;
    }
    const bool low = *unit >= 0xdc00 && *unit < 0xe000 && high != 0;
    append_utf8(out, low ? 0x10000 + ((high - 0xd800) << 10) + (*unit - 0xdc00) : *unit);
    high = 0;
  }
  return text.substr(at, 4) == "\\X0\\" ? at + 4 : at;
}

/// Resolves a sequence that begins with a backslash; returns the length read.
size_t append_escape(std::string& out, std::string_view text) {
  if (text.starts_with("\\X2\\")) return 4 + append_wide(out, text.substr(4), 4);
  if (text.starts_with("\\X4\\")) return 4 + append_wide(out, text.substr(4), 8);
  if (text.starts_with("\\X\\") && text.size() >= 5)
    if (const auto code = hexadecimal(text.substr(3, 2))) {
      append_utf8(out, *code);
      return 5;
    }
  if (text.starts_with("\\S\\") && text.size() >= 4) {
    append_utf8(out, 0x80u + (static_cast<unsigned char>(text[3]) & 0x7f));
    return 4;
  }
  if (text.size() >= 4 && text.starts_with("\\P") && text[3] == '\\') return 4;
  if (text.starts_with("\\\\")) {
    out += '\\';
    return 2;
  }
  out += '\\';
  return 1;
}

/// Parses parameters. Recursion ends at limits::step_nesting.
class Parameters {
 public:
  explicit Parameters(std::string_view text) : text_(text) {}

  std::vector<StepValue> read() {
    std::vector<StepValue> out;
    read_items(out, 0);
    return out;
  }

 private:
  /// Reads up to the closing bracket, which is not consumed, or the end. False where the text is
  /// damaged.
  bool read_items(std::vector<StepValue>& out, int depth) {
    for (bool first = true;; first = false) {
      at_ = skip(text_, at_);
      if (at_ >= text_.size() || text_[at_] == ')') return true;
      if (!first) {
        if (text_[at_] != ',') return false;
        at_ = skip(text_, at_ + 1);
      }
      StepValue value;
      if (!read_value(value, depth)) return false;
      out.push_back(std::move(value));
    }
  }

  bool read_value(StepValue& value, int depth) {
    if (at_ >= text_.size()) return false;
    const char c = text_[at_];
    if (c == '$' || c == '*') {
      value.kind = c == '$' ? StepValue::Kind::omitted : StepValue::Kind::derived;
      ++at_;
      return true;
    }
    if (c == '\'') return read_text(value);
    if (c == '"') return read_binary(value);
    if (c == '.') return read_word(value);
    if (c == '#') return read_reference(value);
    if (c == '(') return read_list(value, depth);
    if (is_name(c) && !(c >= '0' && c <= '9')) return read_typed(value, depth);
    return read_number(value);
  }

  bool read_text(StepValue& value) {
    const size_t from = ++at_;
    for (;; ++at_) {
      at_ = text_.find('\'', at_);
      if (at_ == std::string_view::npos) {
        at_ = text_.size();
        return false;
      }
      if (text_.substr(at_, 2) != "''") break;
      ++at_;
    }
    value.kind = StepValue::Kind::text;
    value.text = step_text(text_.substr(from, at_ - from));
    ++at_;
    return true;
  }

  bool read_binary(StepValue& value) {
    const size_t end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) return false;
    value.kind = StepValue::Kind::derived;
    at_ = end + 1;
    return true;
  }

  bool read_word(StepValue& value) {
    const size_t end = text_.find('.', at_ + 1);
    if (end == std::string_view::npos) return false;
    value.kind = StepValue::Kind::word;
    value.text = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return true;
  }

  bool read_reference(StepValue& value) {
    const char* from = text_.data() + at_ + 1;
    const auto [end, error] = std::from_chars(from, text_.data() + text_.size(), value.id);
    if (error != std::errc()) return false;
    value.kind = StepValue::Kind::reference;
    at_ = static_cast<size_t>(end - text_.data());
    return true;
  }

  bool read_list(StepValue& value, int depth) {
    if (depth >= limits::step_nesting) return false;
    value.kind = StepValue::Kind::list;
    ++at_;
    if (!read_items(value.items, depth + 1) || at_ >= text_.size()) return false;
    ++at_;  // the closing bracket
    return true;
  }

  bool read_typed(StepValue& value, int depth) {
    const size_t from = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    const std::string_view type = text_.substr(from, at_ - from);
    at_ = skip(text_, at_);
    if (at_ >= text_.size() || text_[at_] != '(') return false;
    if (!read_list(value, depth)) return false;
    value.text = type;
    return true;
  }

  bool read_number(StepValue& value) {
    if (text_[at_] == '+') ++at_;
    const char* from = text_.data() + at_;
    const auto [end, error] = std::from_chars(from, text_.data() + text_.size(), value.number);
    if (error != std::errc() || !std::isfinite(value.number)) return false;
    value.kind = StepValue::Kind::number;
    at_ = static_cast<size_t>(end - text_.data());
    return true;
  }

  std::string_view text_;
  size_t at_ = 0;
};

}  // namespace

std::string step_text(std::string_view written) {
  std::string out;
  out.reserve(written.size());
  for (size_t at = 0; at < written.size();) {
    const char c = written[at];
    if (c == '\'') {
      out += c;
      at += written.substr(at, 2) == "''" ? 2 : 1;
    } else if (c == '\\') {
      at += append_escape(out, written.substr(at));
    } else if (const size_t length = utf8_length(written.substr(at))) {
      out += written.substr(at, length);
      at += length;
    } else {
      append_utf8(out, static_cast<unsigned char>(c));
      ++at;
    }
  }
  return out;
}

Result<StepFile> StepFile::of(std::string bytes, const std::string& file, ReadingShare* reading) {
  if (bytes.size() > limits::step_bytes)
    return problem_in(file, fmt::format("a model of {} bytes; the most are {}", bytes.size(),
                                        limits::step_bytes));
  StepFile out;
  out.text_ = std::make_unique<const std::string>(std::move(bytes));
  const std::string_view text = *out.text_;
  const size_t begin = skip(text, text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  if (!text.substr(begin).starts_with("ISO-10303-21"))
    return problem_in(file, text.starts_with("PK")
                                ? "this is a ZIP file (.ifczip?): unpack it and import the .ifc"
                                : "this is no IFC model: it does not begin with ISO-10303-21");
  out.index(file, reading);
  if (out.instances_.size() > limits::step_instances)
    return problem_in(file, fmt::format("more than {} instances", limits::step_instances));
  if (out.instances_.empty()) return problem_in(file, "there is nothing in this model");
  return out;
}

void StepFile::fault(const std::string& file, size_t at, std::string what) {
  ++fault_count_;
  if (faults_.size() >= limits::step_faults) return;
  const std::string_view before = std::string_view(*text_).substr(0, at);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  faults_.push_back(problem_in(file, static_cast<int>(lines) + 1, std::move(what)));
}

void StepFile::index(const std::string& file, ReadingShare* reading) {
  const std::string_view text = *text_;
  ReadingPart part(reading, text.size());
  for (size_t at = skip(text, 0); at < text.size(); at = skip(text, at)) {
    const size_t end = end_of_statement(text, at);
    if (end == std::string_view::npos) {
      fault(file, at, "the file ends within a statement: it is cut off");
      return;
    }
    part.at(at);
    const std::string_view statement = text.substr(at, end - at);
    const size_t from = at;
    at = end + 1;
    if (statement.starts_with("FILE_SCHEMA")) {
      const size_t quote = statement.find('\'');
      const size_t close = statement.find('\'', std::min(quote, statement.size() - 1) + 1);
      if (close != std::string_view::npos) schema_ = statement.substr(quote + 1, close - quote - 1);
      std::transform(schema_.begin(), schema_.end(), schema_.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    }
    if (!statement.starts_with('#')) continue;
    Instance instance;
    const auto [number_end, error] =
        std::from_chars(statement.data() + 1, statement.data() + statement.size(), instance.id);
    size_t in = skip(statement, static_cast<size_t>(number_end - statement.data()));
    if (error != std::errc() || in >= statement.size() || statement[in] != '=') {
      fault(file, from, "a statement that is no instance: \"" + excerpt(statement, 30) + "\"");
      continue;
    }
    in = skip(statement, in + 1);
    const size_t name = in;
    while (in < statement.size() && is_name(statement[in])) ++in;
    instance.type = statement.substr(name, in - name);
    const size_t open = skip(statement, in);
    const size_t close = statement.rfind(')');
    if (open >= statement.size() || statement[open] != '(' || close == std::string_view::npos ||
        close < open) {
      fault(file, from, fmt::format("instance #{} has no brackets", instance.id));
      continue;
    }
    instance.body = statement.substr(open + 1, close - open - 1);
    if (!by_id_.emplace(instance.id, static_cast<uint32_t>(instances_.size())).second) {
      fault(file, from, fmt::format("instance #{} stands twice; the first counts", instance.id));
      continue;
    }
    instances_.push_back(instance);
    if (instances_.size() > limits::step_instances) return;
  }
}

const StepFile::Instance* StepFile::find(uint64_t id) const {
  const auto it = by_id_.find(id);
  return it == by_id_.end() ? nullptr : &instances_[it->second];
}

std::vector<StepValue> StepFile::parameters(const Instance& instance) const {
  return Parameters(instance.body).read();
}

}  // namespace luxodus

#include "scenes/formats/fds_input/namelist.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "runtime/core/printable.hpp"

namespace luxodus::fds_input {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_quote(char c) {
  return c == '\'' || c == '"';
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

class NamelistReader {
 public:
  NamelistReader(std::string_view text, const std::string& file,
                 const std::set<std::string_view>& wanted)
      : text_(text), file_(file), wanted_(wanted) {}

  Result<std::vector<Group>> read() {
    while (at_ < text_.size() && !problem_) {
      if (opens_group()) {
        group();
      } else {
        to_next_line();
      }
    }
    if (problem_) return *problem_;
    return std::move(groups_);
  }

 private:
  void fail(int line, std::string what) {
    if (!problem_) problem_ = problem_in(file_, line, std::move(what));
  }

  void to_next_line() {
    const size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    ++line_;
  }

  /// Whether a wanted group begins at the start of a line: blanks and '&' with its name. Moves past
  /// them.
  bool opens_group() {
    size_t i = at_;
    while (i < text_.size() && (text_[i] == ' ' || text_[i] == '\t')) ++i;
    if (i >= text_.size() || text_[i] != '&') return false;
    size_t end = ++i;
    while (end < text_.size() && text_[end] >= 'A' && text_[end] <= 'Z') ++end;
    const std::string_view name = text_.substr(i, end - i);
    const bool ends = end >= text_.size() || is_blank(text_[end]) || text_[end] == '/';
    if (!ends || !wanted_.contains(name)) return false;
    if (groups_.size() >= limits::groups) {
      fail(line_, fmt::format("there are more than {} groups", limits::groups));
      return false;
    }
    groups_.push_back({std::string(name), line_, {}});
    at_ = end;
    return true;
  }

  /// Moves past blanks, line ends and comments; counts commas. False at the end of the text.
  bool skip(int& commas) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        ++at_;
      } else if (c == ',') {
        ++commas;
        ++at_;
      } else if (c == '!') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (is_blank(c)) {
        ++at_;
      } else {
        return true;
      }
    }
    return false;
  }

  void group() {
    const int opened = line_;
    const std::string name = groups_.back().name;
    int commas = 0;
    while (!problem_) {
      if (!skip(commas)) return fail(opened, fmt::format("&{} is not closed by '/'", name));
      const char c = text_[at_];
      if (c == '/') {
        to_next_line();  // the rest of the line is a comment
        return;
      }
      if (c == '&')
        return fail(opened, fmt::format("&{} is not closed by '/' before the next group", name));
      // Two commas with nothing between them stand for an omitted value.
      for (; commas > 1; --commas) add({}, 1);
      if (is_quote(c)) {
        quoted();
        commas = 0;
      } else if (!parameter()) {
        word();
        commas = 0;
      } else {
        commas = 1;  // a comma after '=' omits a value, too
      }
    }
  }

  /// "NAME =" or "NAME(1:3) ="; the position stays if it is neither.
  bool parameter() {
    size_t i = at_;
    std::string name;
    const auto is_letter = [](char c) {
      return (upper(c) >= 'A' && upper(c) <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    while (i < text_.size() && is_letter(text_[i])) name += upper(text_[i++]);
    constexpr size_t longest_name = 63;  // the limit of Fortran
    if (name.empty() || name.size() > longest_name || (name[0] >= '0' && name[0] <= '9'))
      return false;
    while (i < text_.size() && (text_[i] == ' ' || text_[i] == '\t')) ++i;
    int first = 1;
    if (i < text_.size() && text_[i] == '(') {
      constexpr size_t longest_range = 64;  // the search stops here: a line may be the whole file
      const std::string_view ahead = text_.substr(i + 1, longest_range);
      const size_t length = ahead.find_first_of(")\n");
      if (length == std::string_view::npos || ahead[length] != ')') return false;
      const size_t end = i + 1 + length;
      std::string_view inside = ahead.substr(0, length);
      while (!inside.empty() && inside.front() == ' ') inside.remove_prefix(1);
      std::from_chars(inside.data(), inside.data() + inside.size(), first);
      i = end + 1;
      while (i < text_.size() && (text_[i] == ' ' || text_[i] == '\t')) ++i;
    }
    if (i >= text_.size() || text_[i] != '=') return false;
    groups_.back().parameters.push_back({std::move(name), first, line_, {}});
    at_ = i + 1;
    return true;
  }

  void quoted() {
    const char quote = text_[at_];
    const size_t from = at_ + 1;
    size_t i = from;
    for (; i < text_.size() && text_[i] != '\n'; ++i) {
      if (text_[i] != quote) continue;
      if (i + 1 >= text_.size() || text_[i + 1] != quote) break;
      ++i;  // doubled: one quote in the text
    }
    if (i >= text_.size() || text_[i] == '\n')
      return fail(line_, "a text is not closed by its quote on this line");
    at_ = i + 1;
    add({text_.substr(from, i - from), true, line_}, 1);
  }

  /// A number or a word, possibly repeated: "0.5", "T", "3*0.5".
  void word() {
    const size_t from = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != ',' && text_[at_] != '/' &&
           text_[at_] != '!' && text_[at_] != '=' && !is_quote(text_[at_]))
      ++at_;
    std::string_view word = text_.substr(from, at_ - from);
    if (word.empty()) return fail(line_, "'=' without the name of a parameter");
    size_t times = 1;
    if (const size_t star = word.find('*'); star != std::string_view::npos) {
      const auto [end, error] = std::from_chars(word.data(), word.data() + star, times);
      if (error != std::errc() || end != word.data() + star || times == 0 || times > limits::values)
        return fail(line_, fmt::format("\"{}\" repeats no value", excerpt(word)));
      word.remove_prefix(star + 1);
      if (word.empty() && at_ < text_.size() && is_quote(text_[at_])) {
        quoted();
        if (!problem_) add(groups_.back().parameters.back().values.back(), times - 1);
        return;
      }
    }
    add({word, false, line_}, times);
  }

  void add(const Value& value, size_t times) {
    std::vector<Parameter>& parameters = groups_.back().parameters;
    if (problem_) return;
    if (parameters.empty())
      return fail(line_,
                  fmt::format("a value stands in &{} before any parameter", groups_.back().name));
    if (times > limits::values - values_)
      return fail(line_, fmt::format("there are more than {} values", limits::values));
    values_ += times;
    std::vector<Value>& values = parameters.back().values;
    values.insert(values.end(), times, value);
  }

  const std::string_view text_;
  const std::string& file_;
  const std::set<std::string_view>& wanted_;
  size_t at_ = 0;
  int line_ = 1;
  size_t values_ = 0;
  std::vector<Group> groups_;
  std::optional<Problem> problem_;
};

}  // namespace

Result<std::vector<Group>> read_namelists(std::string_view text, const std::string& file,
                                          const std::set<std::string_view>& wanted) {
  return NamelistReader(text, file, wanted).read();
}

}  // namespace luxodus::fds_input

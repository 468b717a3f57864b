#include "scenes/formats/dxf/dxf_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/core/printable.hpp"
#include "runtime/core/text.hpp"

namespace luxodus {
namespace {

constexpr std::string_view dxf_blanks = " \t";

/// Reads all of a word as a number, which may begin with a plus.
template <class Number>
bool parse_all(std::string_view word, Number& out) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

const DxfGroup* DxfRecord::find(int code) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return &group;
  return nullptr;
}

std::string_view DxfRecord::text(int code) const {
  const DxfGroup* group = find(code);
  return group != nullptr ? group->value : std::string_view();
}

std::string_view DxfRecords::take_line() {
  const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  const std::string_view line = text_.substr(at_, end - at_);
  at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : end < text_.size() ? 1 : 0);
  ++line_;
  return line;
}

bool DxfRecords::next_group(DxfGroup& group) {
  // After the last group there may be blank lines, and the end mark of DOS (1A).
  constexpr std::string_view nothing(" \t\r\n\x1a\0", 6);
  if (text_.find_first_not_of(nothing, at_) == std::string_view::npos) return false;
  const std::string_view code = trimmed(take_line(), dxf_blanks);
  if (!parse_all(code, group.code)) {
    fault_ = problem_in("", line_,
                        fmt::format("a group code is expected here, a whole number, and not \"{}\"",
                                    excerpt(code)));
    return false;
  }
  if (at_ >= text_.size()) return false;  // cut short after a code
  group.value = trimmed(take_line(), dxf_blanks);
  group.line = line_;
  return true;
}

bool DxfRecords::next(DxfRecord& record) {
  record.groups.clear();
  record.cut = false;
  DxfGroup group;
  // Comments may stand before the first record.
  while (!begun_ && next_group(group))
    if (group.code == 0) begun_ = group;
  if (!begun_) return false;
  record.kind = begun_->value;
  record.line = begun_->line;
  begun_.reset();
  if (record.kind == "EOF") return true;  // whatever follows is not of the drawing
  while (next_group(group)) {
    if (group.code == 0) {
      begun_ = group;
      break;
    }
    if (record.groups.size() < limits::dxf_record_groups)
      record.groups.push_back(group);
    else
      record.cut = true;
  }
  return !fault_;
}

Result<double> number_of(const DxfGroup& group) {
  double value = 0;
  if (parse_all(group.value, value) && std::isfinite(value)) return value;
  return problem_in("", group.line,
                    fmt::format("\"{}\" is no number, and the value of code {} has to be one",
                                excerpt(group.value), group.code));
}

Result<int> integer_of(const DxfGroup& group) {
  const auto value = number_of(group);  // some programs write 1.0
  if (!value) return value.problem();
  if (std::abs(value.value()) < 2e9 && value.value() == std::floor(value.value()))
    return static_cast<int>(value.value());
  return problem_in("", group.line,
                    fmt::format("\"{}\" is no whole number, and the value of code {} has to be one",
                                excerpt(group.value), group.code));
}

}  // namespace luxodus

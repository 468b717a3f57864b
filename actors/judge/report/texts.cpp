#include "actors/judge/report/texts.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

std::map<std::string_view, const ReportText*> index() {
  std::map<std::string_view, const ReportText*> out;
  for (const auto rows :
       {page_texts(), section_texts(), word_texts(), rule_texts(), design_texts()})
    for (const ReportText& row : rows)
      if (!out.emplace(row.key, &row).second)
        throw std::logic_error(std::string("two texts of reports are called ") + row.key);
  return out;
}

/// What stands in `text` for the places {0}, {1}, ... of `pattern`, which come in this order; none
/// where the words between them differ.
std::optional<std::vector<std::string_view>> filled_in(std::string_view pattern,
                                                       std::string_view text) {
  std::vector<std::string_view> out;
  for (;;) {
    const size_t place = pattern.find('{');
    const std::string_view before = pattern.substr(0, place);
    if (!text.starts_with(before)) return std::nullopt;
    text.remove_prefix(before.size());
    if (place == std::string_view::npos)
      return text.empty() ? std::optional(std::move(out)) : std::nullopt;
    pattern.remove_prefix(pattern.find('}', place) + 1);
    const std::string_view after = pattern.substr(0, pattern.find('{'));
    // What comes last reaches to the end: names may hold the words that follow others.
    const size_t end = pattern.find('{') == std::string_view::npos
                           ? (text.ends_with(after) ? text.size() - after.size() : text.npos)
                           : text.find(after);
    if (end == std::string_view::npos || end == 0) return std::nullopt;
    out.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

/// A clause, 4.1.2, is none: its points stay.
bool is_number(std::string_view text) {
  return text.find_first_not_of("0123456789.-") == std::string_view::npos &&
         text.find('.') == text.rfind('.');
}

}  // namespace

const ReportText* find_text(std::string_view key) {
  static const auto by_key = index();
  const auto at = by_key.find(key);
  return at == by_key.end() ? nullptr : at->second;
}

const char* Texts::operator()(std::string_view key) const {
  const ReportText* row = find_text(key);
  if (row == nullptr) throw std::logic_error("reports have no text " + std::string(key));
  return row->text[static_cast<size_t>(language_)];
}

std::string Texts::word(std::string_view list, std::string_view word) const {
  const ReportText* row = find_text(std::string(list) + "." + std::string(word));
  return row == nullptr ? std::string(word) : row->text[static_cast<size_t>(language_)];
}

std::optional<std::string> Texts::remark(std::string_view english) const {
  if (language_ == Language::en) return std::string(english);
  for (const ReportText& row : remark_texts()) {
    const auto values = filled_in(row.text[0], english);
    if (!values) continue;
    fmt::dynamic_format_arg_store<fmt::format_context> shown;
    for (const std::string_view value : *values)
      shown.push_back(is_number(value) ? localised(std::string(value))
                                       : remark(value).value_or(std::string(value)));
    return fmt::vformat(row.text[static_cast<size_t>(language_)], shown);
  }
  // Two sentences in one.
  const size_t end = english.find("; ");
  if (end == std::string_view::npos) return std::nullopt;
  const auto first = remark(english.substr(0, end)), second = remark(english.substr(end + 2));
  return first && second ? std::optional(*first + "; " + *second) : std::nullopt;
}

std::string Texts::localised(std::string text) const {
  if (language_ != Language::en)
    for (char& c : text)
      if (c == '.') c = ',';
  return text;
}

std::string Texts::number(double value, int digits) const {
  if (!std::isfinite(value)) return (*this)("word.none");
  return localised(readable_number(value, digits));
}

std::string Texts::fixed(double value, int decimals) const {
  // No "-0.00".
  const double step = std::pow(10.0, -decimals);
  return localised(fmt::format("{:.{}f}", std::abs(value) < step / 2 ? 0.0 : value, decimals));
}

std::string Texts::place(double x, double y, double z) const {
  const char* between = language_ == Language::en ? ", " : "; ";
  return "(" + fixed(x) + between + fixed(y) + between + fixed(z) + ")";
}

std::string Texts::percent(double share) const {
  const double value = 100 * share;
  const double shown = std::abs(value) < 0.5 ? 0.0 : value;
  return std::string(shown < 0 ? "−" : "+") + fixed(std::abs(shown), 0) + "\u00a0%";
}

}  // namespace luxodus

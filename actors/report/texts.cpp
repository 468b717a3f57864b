#include "actors/report/texts.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

std::map<std::string_view, const ReportText*> index() {
  std::map<std::string_view, const ReportText*> out;
  for (const auto rows : {page_texts(), section_texts(), word_texts(), rule_texts()})
    for (const ReportText& row : rows)
      if (!out.emplace(row.key, &row).second)
        throw std::logic_error(std::string("two texts of reports are called ") + row.key);
  return out;
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

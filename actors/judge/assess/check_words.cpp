#include "actors/judge/assess/check_words.hpp"

#include "actors/judge/texts/remark_json.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// " lx"; "" for a ratio, whose unit is 1.
std::string unit_words(const std::string& unit) {
  if (unit.empty() || unit == "1") return "";
  return " " + unit;
}

std::string value_words(const Json& check) {
  const Json value = check.value("value", Json());
  if (value.is_number())
    return readable_number(value.get<double>()) + unit_words(text_in(check, "unit"));
  const std::string reason = english_in(check, "reasons");
  return reason.empty() ? "no value" : reason;
}

}  // namespace

std::string check_words(const Json& check) {
  std::string text =
      english_in(check, "subject") + ": " + text_in(check, "title") + ": " + value_words(check);
  if (const Json limit = check.value("limit", Json()); limit.is_number())
    text += ", " + text_in(check, "sense") + " " + readable_number(limit.get<double>());
  const std::string condition = english_in(check, "conditions");
  return text + " (" + text_in(check, "rule") + (condition.empty() ? "" : ", ") + condition + ")";
}

}  // namespace luxodus

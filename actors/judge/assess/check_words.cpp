#include "actors/judge/assess/check_words.hpp"

#include "actors/judge/texts/texts.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// " lx"; "" for a ratio, whose unit is 1.
std::string unit_words(const std::string& unit) {
  if (unit.empty() || unit == "1") return "";
  return " " + unit;
}

std::string value_words(const Check& check) {
  if (check.value) return readable_number(*check.value) + unit_words(check.unit);
  const std::string reason = english().remarks(check.reasons);
  return reason.empty() ? "no value" : reason;
}

}  // namespace

std::string check_words(const Check& check) {
  const std::string rule(name_of(check.rule.id)), condition = english().remarks(check.conditions);
  std::string text = english().subject(check.subject) + ": " + english().rule_title(rule) + ": " +
                     value_words(check);
  if (check.limit)
    text +=
        std::string(check.at_least ? ", at least " : ", at most ") + readable_number(*check.limit);
  return text + " (" + rule + (condition.empty() ? "" : ", ") + condition + ")";
}

}  // namespace luxodus

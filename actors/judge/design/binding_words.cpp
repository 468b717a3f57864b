#include "actors/judge/design/binding_words.hpp"

#include <cmath>

namespace luxodus {

namespace {

std::string demand_of(const Texts& t, const DesignRecord& design, const BindingRecord& one) {
  if (one.luminaire) return t.say("design.because_failure", *one.luminaire);
  if (!one.constraint) return t("design.because_failures");
  const ConstraintRecord& group = design.constraints.at(*one.constraint);
  const std::string rule(name_of(group.rule));
  return t.subject(group.subject) + ": " + demand_text(t, group) +
         (rule.empty() ? "" : " (" + rule + ")");
}

/// "1 luminaire", "3 luminaires"; for another objective "240 (cost)".
std::string amount(const Texts& t, const std::string& objective, double value) {
  if (objective != "number")
    return t.say("design.because_amount", t.number(value, 4),
                 t.word("design.objective", objective));
  return std::llround(value) == 1 ? std::string(t("design.one_luminaire"))
                                  : t.say("design.some_luminaires", t.number(value, 4));
}

}  // namespace

std::vector<std::string> because_words(const Texts& t, const DesignRecord& design) {
  const std::string objective = design.objective.kind;
  std::vector<std::string> out;
  for (const BindingRecord& one : design.because)
    out.push_back(t.say(one.exact ? "design.because" : "design.because_at_least",
                        amount(t, objective, one.saved), demand_of(t, design, one),
                        amount(t, objective, one.objective_without)));
  return out;
}

std::string demand_text(const Texts& t, const ConstraintRecord& group) {
  const std::string key = std::string("design.kind_") + name_of(group.kind);
  return t.say(key, t.number(group.asked, 3));
}

}  // namespace luxodus

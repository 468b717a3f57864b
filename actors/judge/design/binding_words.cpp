#include "actors/judge/design/binding_words.hpp"

#include <cmath>

#include "actors/judge/design/json_cells.hpp"

namespace luxodus {

namespace {

std::string demand_of(const Texts& t, const Json& design, const Json& one) {
  const std::string what = text_in(one, "what");
  if (what == "failures") return t("design.because_failures");
  if (what == "failure") return t.say("design.because_failure", text_in(one, "luminaire"));
  const Json& group = design["constraints"][one["constraint"].get<size_t>()];
  const std::string rule = text_in(group, "rule");
  return subject_text(t, group["subject"]) + ": " + demand_text(t, group) +
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

Json because_json(const DesignResult& result) {
  Json out = Json::array();
  for (const BindingDemand& one : result.because) {
    const Relaxation& what = one.relaxed.without;
    Json json{{"what", what.all_failures  ? "failures"
                       : what.never_fails ? "failure"
                                          : "constraint"},
              {"saved", number_json(one.relaxed.saved)},
              {"objective_without", number_json(one.relaxed.objective)},
              {"fewer_luminaires", one.relaxed.fewer},
              {"exact", one.relaxed.exact}};
    if (what.group) json["constraint"] = *what.group;
    if (what.never_fails) json["luminaire"] = one.luminaire;
    out.push_back(std::move(json));
  }
  return out;
}

std::vector<std::string> because_words(const Texts& t, const Json& design) {
  const std::string objective = text_in(design["objective"], "kind");
  std::vector<std::string> out;
  for (const Json& one : design["because"])
    out.push_back(t.say(one["exact"].get<bool>() ? "design.because" : "design.because_at_least",
                        amount(t, objective, one["saved"].get<double>()), demand_of(t, design, one),
                        amount(t, objective, one["objective_without"].get<double>())));
  return out;
}

std::string demand_text(const Texts& t, const Json& group) {
  const std::string key = "design.kind_" + text_in(group, "kind");
  return t.say(key, t.number(group["asked"].get<double>(), 3));
}

}  // namespace luxodus

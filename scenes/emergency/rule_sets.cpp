#include "scenes/emergency/rule_sets.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "scenes/emergency/rule_table.hpp"

namespace luxodus {

namespace {

constexpr std::array sets{
    NamedRules{"en1838-2013", "EN 1838:2013", RemarkId::asks_european,
               "secondary texts: BSI excerpt, licht.wissen 10, makers' guides",
               RemarkId::superseded},
    NamedRules{"en1838-2024", "EN 1838:2024", RemarkId::asks_european_buildings,
               "liteplan.com on the draft FprEN 1838 of June 2024; what the draft is not known to "
               "change is carried over from EN 1838:2013",
               RemarkId::not_verified},
    NamedRules{"nfpa101", "NFPA 101", RemarkId::asks_united_states,
               "secondary texts: Signify, NYC code, UBC"},
};

constexpr std::array deviation_rows{
    NamedRules{"duration-3h", "national practice, United Kingdom and Germany",
               RemarkId::asks_three_hours, "fernkorn, table of durations"},
    NamedRules{"de-asr-a3.4-3", "ASR A3.4/3 (Germany)", RemarkId::asks_fifteen_seconds,
               "messefrankfurt"},
    NamedRules{"de-din4844-1", "DIN 4844-1 (Germany)", RemarkId::asks_white_500, "licht.wissen 10"},
    NamedRules{"uk-bs5266-1", "BS 5266-1 (United Kingdom)", RemarkId::asks_one_lux,
               "recollection of the 1 lx; fernkorn for the duration",
               RemarkId::one_lux_not_verified},
    NamedRules{"us-ibc", "IBC 1008.3.5", RemarkId::asks_ibc, "NYC code"},
    NamedRules{"us-ibc-group-i2", "IBC 1008.3.5, group I-2", RemarkId::asks_one_failed, "NYC code"},
};

std::string listed(std::span<const NamedRules> rows) {
  std::string out;
  for (const NamedRules& row : rows) out += (out.empty() ? "" : ", ") + std::string(row.id);
  return out;
}

std::optional<size_t> number_of(std::span<const NamedRules> rows, const std::string& id) {
  const auto at =
      std::find_if(rows.begin(), rows.end(), [&](const NamedRules& row) { return row.id == id; });
  return at == rows.end() ? std::nullopt : std::optional(static_cast<size_t>(at - rows.begin()));
}

}  // namespace

std::span<const NamedRules> rule_sets() {
  return sets;
}

std::span<const NamedRules> deviations() {
  return deviation_rows;
}

const NamedRules& named(RuleSet set) {
  return sets.at(static_cast<size_t>(set));
}

const NamedRules& named(Deviation deviation) {
  return deviation_rows.at(static_cast<size_t>(deviation));
}

bool deviates_from(Deviation deviation, RuleSet set) {
  const bool american = deviation == Deviation::us_ibc || deviation == Deviation::us_ibc_i2;
  return american == (set == RuleSet::nfpa101);
}

RuleId duration_rule(const CodeChoice& codes) {
  if (!codes.european()) return RuleId::N10;
  if (codes.has(Deviation::uk_bs_5266)) return RuleId::E11u;
  return codes.has(Deviation::duration_3h) ? RuleId::E11n : RuleId::E11;
}

double rated_duration_h(const CodeChoice& codes) {
  return limit_of(duration_rule(codes));
}

Result<std::vector<CodeChoice>> chosen_codes(const std::vector<std::string>& sets_named,
                                             const std::vector<std::string>& deviations_named) {
  if (sets_named.empty())
    return problem("no rule set is named, and none is assumed: give --rules, or rules = [\"" +
                   std::string(named(RuleSet::en1838_2024).id) +
                   "\"] in [assessment]; there are: " + listed(sets));
  std::set<RuleSet> wanted;
  for (const std::string& id : sets_named) {
    const auto number = number_of(sets, id);
    if (!number) return problem("there is no rule set \"" + id + "\"; there are: " + listed(sets));
    wanted.insert(static_cast<RuleSet>(*number));
  }
  std::vector<CodeChoice> out;
  for (const RuleSet set : wanted) out.push_back({set, {}});
  for (const std::string& id : deviations_named) {
    const auto number = number_of(deviation_rows, id);
    if (!number)
      return problem("there is no deviation \"" + id + "\"; there are: " + listed(deviation_rows));
    const auto deviation = static_cast<Deviation>(*number);
    bool used = false;
    for (CodeChoice& codes : out) {
      if (!deviates_from(deviation, codes.set)) continue;
      codes.deviations.insert(deviation);
      used = true;
    }
    if (!used) return problem("\"" + id + "\" deviates from none of the rule sets that are named");
  }
  return out;
}

}  // namespace luxodus

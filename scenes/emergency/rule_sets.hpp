// Rule sets that a building can be judged by, and national deviations from them. The user names
// each; none is a default. Constant data and pure functions; any thread.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/emergency/check.hpp"

namespace luxodus {

enum class RuleSet { en1838_2013, en1838_2024, nfpa101 };

/// Requirements of one country or authority that replace or extend those of a set.
enum class Deviation { duration_3h, de_asr, de_din_4844, uk_bs_5266, us_ibc, us_ibc_i2 };

/// A rule set or deviation, as output describes it.
struct NamedRules {
  const char* id;       // in scenes and options: "en1838-2024"
  const char* edition;  // "EN 1838:2024"
  RemarkId asks;        // what it requires
  const char* source;   // document that quotes it
  std::optional<RemarkId> status = std::nullopt;
};

/// In the order of RuleSet and of Deviation.
std::span<const NamedRules> rule_sets();
std::span<const NamedRules> deviations();
const NamedRules& named(RuleSet set);
const NamedRules& named(Deviation deviation);
/// Whether a deviation belongs to this set.
bool deviates_from(Deviation deviation, RuleSet set);

/// One rule set with its deviations.
struct CodeChoice {
  RuleSet set = RuleSet::en1838_2013;
  std::set<Deviation> deviations = {};

  bool european() const { return set != RuleSet::nfpa101; }
  bool has(Deviation deviation) const { return deviations.contains(deviation); }
};

/// The rule of how long emergency lighting has to last, by a set with its deviations.
RuleId duration_rule(const CodeChoice& codes);
/// Its limit [h].
double rated_duration_h(const CodeChoice& codes);

/// The named sets without duplicates, in the order of the enumeration.
/// Errors: no set; an unknown name (the message lists all); a deviation that belongs to none of the
/// sets.
Result<std::vector<CodeChoice>> chosen_codes(const std::vector<std::string>& sets,
                                             const std::vector<std::string>& deviations);

}  // namespace luxodus

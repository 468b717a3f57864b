// The sets of rules that a building can be judged by, and national deviations from them: each is
// named by whoever asks, none is a default. Constant data and pure functions; any thread.
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

/// What one country or authority asks otherwise, or beside a set.
enum class Deviation { duration_3h, de_asr, de_din_4844, uk_bs_5266, us_ibc, us_ibc_i2 };

/// What is said of a set or a deviation where it is used.
struct NamedRules {
  const char* id;       // as it is written in scenes and options: "en1838-2024"
  const char* edition;  // "EN 1838:2024"
  RemarkId asks;        // what it asks
  const char* source;   // what it is quoted from
  std::optional<RemarkId> status = std::nullopt;  // where there is something to say
};

/// In the order of RuleSet, of Deviation.
std::span<const NamedRules> rule_sets();
std::span<const NamedRules> deviations();
const NamedRules& named(RuleSet set);
const NamedRules& named(Deviation deviation);
/// Whether it deviates from this set, not from another.
bool deviates_from(Deviation deviation, RuleSet set);

/// One set of rules, with the deviations from it.
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

/// Every set that is named, once, in the order of the enumeration.
/// Errors: no set, an unknown name (all are listed), a deviation from none of the sets.
Result<std::vector<CodeChoice>> chosen_codes(const std::vector<std::string>& sets,
                                             const std::vector<std::string>& deviations);

}  // namespace luxodus

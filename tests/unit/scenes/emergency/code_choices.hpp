// Rule sets without deviations, for tests.
#pragma once

#include "scenes/emergency/rule_sets.hpp"

namespace luxodus {

inline const CodeChoice en13{RuleSet::en1838_2013, {}};
inline const CodeChoice en24{RuleSet::en1838_2024, {}};
inline const CodeChoice nfpa{RuleSet::nfpa101, {}};

}  // namespace luxodus

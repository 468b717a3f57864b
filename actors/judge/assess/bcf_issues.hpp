// Failed checks of an assessment as issues in the BIM Collaboration Format 2.1 of buildingSMART: a
// topic, a camera and the GlobalIds of the things that are meant, for each. Pure function; any
// thread.
#pragma once

#include <optional>
#include <string>

#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

namespace limits {
/// Issues of one file; programs list them one below the other.
inline constexpr size_t bcf_issues = 5'000;
}  // namespace limits

/// The bytes of a .bcf file. None if nothing of the scene has a GlobalId, or no check fails.
std::optional<std::string> bcf_issues(const AssessmentRecord& assessment);

}  // namespace luxodus

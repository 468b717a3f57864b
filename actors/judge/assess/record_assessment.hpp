// Makes the record of an assessment, which is all that reports, comparisons and the console take.
// It reads pictures that the scene names; everything else is pure. Any thread.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

/// `version`: of this program.
AssessmentRecord record_of(const SceneDescription& scene, const Assessment& assessment,
                           const std::string& version);

}  // namespace luxodus

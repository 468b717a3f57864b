// An assessment on disk: assessment.json (all of it), checks.csv, sights.csv. Reports
// (actors/judge/report) and comparisons are made from the JSON alone, so that they can be made
// again later. Pure but for write_assessment and read_assessment; any thread.
#pragma once

#include <filesystem>

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

namespace limits {
/// Largest assessment.json that is read back [bytes].
inline constexpr uint64_t assessment_bytes = uint64_t{256} << 20;
}  // namespace limits

inline constexpr const char* assessment_format = "luxodus assessment 2";

Json assessment_json(const SceneDescription& scene, const Assessment& assessment,
                     const std::string& version);

/// Tables that this one does not have are removed, as they are an earlier one's.
/// Errors: as write_file_atomically; a folder that cannot be made.
Result<void> write_assessment(const std::filesystem::path& folder, const Json& assessment);

/// Errors: one of these files is in the folder, and no assessment has written it: assessment.json
/// there is none, or is of another program.
Result<void> refuse_files_of_others(const std::filesystem::path& folder,
                                    const std::vector<std::string>& files);

/// Errors: no assessment.json in the folder, or none of ours.
Result<Json> read_assessment(const std::filesystem::path& folder);

/// What differs between two assessments: verdicts of checks and of sights, and values by how many
/// standard errors. Lines for a terminal.
Json comparison_of(const Json& before, const Json& after);
std::string comparison_text(const Json& comparison);

}  // namespace luxodus

// An assessment on disk: assessment.json (everything), checks.csv, sights.csv and other tables.
// Reports (actors/judge/report) and comparisons need the JSON only, so they can be made later.
// Functions are pure except those that read or write a folder; any thread.
#pragma once

#include <filesystem>

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

namespace limits {
/// Largest assessment.json that is read [bytes].
inline constexpr uint64_t assessment_bytes = uint64_t{256} << 20;
}  // namespace limits

inline constexpr const char* assessment_format = "luxodus assessment 2";

Json assessment_json(const SceneDescription& scene, const Assessment& assessment,
                     const std::string& version);

/// Writes the files, and removes tables of an earlier assessment that this one does not have.
/// Errors: as write_file_atomically; a folder that cannot be created.
Result<void> write_assessment(const std::filesystem::path& folder, const Json& assessment);

/// Errors: the folder holds one of these files but no assessment.json of this program, so another
/// program wrote it.
Result<void> refuse_files_of_others(const std::filesystem::path& folder,
                                    const std::vector<std::string>& files);

/// Errors: the folder has no assessment.json of this program.
Result<Json> read_assessment(const std::filesystem::path& folder);

/// Differences between two assessments: verdicts of checks and views, and values with their
/// distance in standard errors. comparison_text gives lines for a terminal.
Json comparison_of(const Json& before, const Json& after);
std::string comparison_text(const Json& comparison);

}  // namespace luxodus

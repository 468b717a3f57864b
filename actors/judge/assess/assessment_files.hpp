// An assessment on disk: assessment.json (everything), checks.csv, sights.csv and other tables.
// Reports (actors/judge/report) and comparisons need the record only, so they can be made later.
// Functions read or write a folder; any thread.
#pragma once

#include <filesystem>

#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

namespace limits {
/// Largest assessment.json that is read [bytes].
inline constexpr uint64_t assessment_bytes = uint64_t{256} << 20;
}  // namespace limits

/// Writes the files, and removes tables of an earlier assessment that this one does not have.
/// Errors: as write_file_atomically; a folder that cannot be created.
Result<void> write_assessment(const std::filesystem::path& folder,
                              const AssessmentRecord& assessment);

/// Errors: the folder holds one of these files but no assessment.json of this program, so another
/// program wrote it.
Result<void> refuse_files_of_others(const std::filesystem::path& folder,
                                    const std::vector<std::string>& files);

/// Errors: the folder has no assessment.json of this program, or a damaged one.
Result<AssessmentRecord> read_assessment(const std::filesystem::path& folder);

}  // namespace luxodus

// A design on disk: a variant of the scene (layout.toml) that assess, compare, run and view accept
// like any scene, the schedule (luminaires.csv), design.json, the page (design.html), plans, and
// the other layouts if they were judged in smoke (alternatives/). No file contains times, so the
// same scene and seed give the same bytes. Any thread; one design of a folder at a time.
#pragma once

#include <filesystem>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// A layout of the result as a variant to be written into `folder`, from which it includes the
/// scene. Requires everywhere: a result with a layout.
std::string variant_text(const SceneDescription& scene, const DesignResult& result,
                         const PlacedLayout& layout, const std::filesystem::path& folder);

CsvTable schedule_csv(const DesignResult& result);

/// Writes all files and removes alternatives of an earlier design. Errors: as
/// write_file_atomically; a folder that cannot be created.
Result<void> write_design(const std::filesystem::path& folder, const SceneDescription& scene,
                          const DesignResult& result, Language language,
                          const std::string& version);

/// "9 luminaires: the fewest possible": how the search ended, as an English sentence.
std::string outcome_words(const SceneDescription& scene, const DesignResult& result);

/// English sentences on why there is no layout, and what would make one possible.
std::vector<std::string> conflict_words(const SceneDescription& scene, const DesignResult& result);

/// An English sentence on the minima with luminaires mounted off their places.
std::string tolerance_words(const PlaceTolerance& tolerance);

/// Joins rules of one subject with equal numbers of points: "E6, E6d". In the order of the first.
std::vector<HiddenByFurniture> joined_by_subject(const std::vector<HiddenByFurniture>& hidden);

/// English sentences on failing checks that a design does not decide, one for each rule.
std::vector<std::string> others_words(const std::vector<Check>& others);

/// The requirement of a group in English: "at least 1.25 lx everywhere (E5, route "corridor")".
std::string demand_words(const ConstraintGroup& group);

}  // namespace luxodus

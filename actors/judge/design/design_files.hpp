// A layout on disk: a variant of the scene (layout.toml) that assess, compare, run and view take
// like any scene, the schedule (luminaires.csv), design.json, the page (design.html), plans, and
// where layouts were judged in smoke the others (alternatives/).
// Times are in none of them: the same scene and seed give the same bytes. Any thread; one design of
// a folder at a time.
#pragma once

#include <filesystem>

#include "actors/judge/design/design.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

inline constexpr const char* design_format = "luxodus design 2";

/// A layout of the result as a variant, to be written into `folder`, from which it includes the
/// scene. Requires everywhere: a result with a layout.
std::string variant_text(const SceneDescription& scene, const DesignResult& result,
                         const PlacedLayout& layout, const std::filesystem::path& folder);

CsvTable schedule_csv(const DesignResult& result);

Json design_json(const SceneDescription& scene, const DesignResult& result,
                 const std::string& version);

/// Writes all of them; alternatives of an earlier design are removed. Errors: as
/// write_file_atomically; a folder that cannot be made.
Result<void> write_design(const std::filesystem::path& folder, const SceneDescription& scene,
                          const DesignResult& result, Language language,
                          const std::string& version);

/// "9 luminaires: the fewest possible"; how the search ended, in a sentence. English.
std::string outcome_words(const SceneDescription& scene, const DesignResult& result);

/// Why there is no layout, and what would make one possible: sentences. English.
std::vector<std::string> conflict_words(const SceneDescription& scene, const DesignResult& result);

/// What is left of the minima with luminaires mounted off their places: a sentence. English.
std::string tolerance_words(const PlaceTolerance& tolerance);

/// Rules of one subject that lack as many points as one: "E6, E6d". In the order of the first.
std::vector<HiddenByFurniture> joined_by_subject(const std::vector<HiddenByFurniture>& hidden);

/// Checks that fail and that a design does not decide: sentences, one for many subjects of the same
/// rule. English.
std::vector<std::string> others_words(const std::vector<Check>& others);

/// What a group asks for: "at least 1.25 lx everywhere (E5, route "corridor")". English.
std::string demand_words(const ConstraintGroup& group);

}  // namespace luxodus

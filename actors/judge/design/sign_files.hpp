// The signs of a design on disk: as changes of a variant, as a schedule, as JSON, and in sentences.
// Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/sign_plan.hpp"
#include "actors/judge/design/smoke_stage.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// A text as TOML writes it between quotes.
std::string toml_text(const std::string& text);
/// A coordinate in metres, to a tenth of a millimetre.
std::string toml_metres(double value);

/// What a variant of the scene has otherwise by the plan: [[change]] tables.
std::string sign_changes(const SceneDescription& scene, const SignPlan& plan);

CsvTable signs_csv(const SceneDescription& scene, const SignPlan& plan);
Json signs_json(const SceneDescription& scene, const SignPlan& plan);

/// How many signs there are, whether fewer would do, and where nobody is guided. English.
std::vector<std::string> sign_words(const SignPlan& plan);

/// "left"
std::string_view arrow_word(SignArrow arrow);

/// Signs of a layout made brighter, and low ones added, as changes of a variant.
std::string changes_of_signs(const JudgedLayout& layout);

}  // namespace luxodus

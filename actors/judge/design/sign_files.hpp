// The signs of a design on disk: as changes of a variant, as a schedule, and as sentences.
// Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/sign_plan.hpp"
#include "actors/judge/design/smoke_stage.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// A quoted TOML string.
std::string toml_text(const std::string& text);
/// A coordinate in metres, rounded to a tenth of a millimetre.
std::string toml_metres(double value);

/// [[change]] tables that turn the scene into the variant with the plan's signs.
std::string sign_changes(const SceneDescription& scene, const SignPlan& plan);

CsvTable signs_csv(const SceneDescription& scene, const SignPlan& plan);

/// English sentences: number of signs, whether fewer would do, and places without guidance.
std::vector<std::string> sign_words(const SignPlan& plan);

/// "left"
std::string_view arrow_word(SignArrow arrow);

/// [[change]] tables for brighter signs and low-level signs of a layout.
std::string changes_of_signs(const JudgedLayout& layout);

}  // namespace luxodus

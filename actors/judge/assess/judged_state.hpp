// Which state of a building an assessment judges, and by which rules. Nothing is guessed: if a
// required name is missing, the error says what to write. Pure functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/record/assessment_record.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/emergency/sight.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Time after a failure of the mains from which pupil and retina have followed the light [s]; EN
/// 1838 assumes a minute. Bleached pigment, which takes longer, counts in the thresholds.
inline constexpr double adapted_after_s = 60;
/// Wavelength of stated extinctions [nm], as in most measurements.
inline constexpr double stated_nm = 633;

/// The judged state, which is printed before any verdict.
struct AssessedState {
  std::string scenario;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;  // none if the scenario states no time
  size_t luminaires = 0;                        // number in the scene
  std::vector<std::string> lit;                 // names of the luminaires lit in this state
  bool smoke = false;               // whether there is smoke, even if none where people look
  std::vector<StatedMedium> media;  // flames included
  std::vector<CodeChoice> codes;
  Remark light{RemarkId::no_luminaire_lit};  // the light by which views were judged
  Remarks remarks;
  Remarks warnings;  // those of `remarks` that are warnings
};

/// The state to judge: the named one, in whatever operation. Without a name, the only scenario in
/// emergency operation that has smoke; if no scenario has smoke, the only one in emergency
/// operation. The operation after the failure of the mains counts, even if a clock has not reached
/// the failure. A scenario in mains operation that also differs in media, flames, circuits or doors
/// makes the choice ambiguous, since its `operation` may have been forgotten.
/// Errors: no such scenario, none at all, or several; each says what to write.
Result<Scenario> judged_scenario(const SceneDescription& scene, const std::string& named);

/// The rule sets and deviations of the options, or else those that the scene names. Errors: as
/// chosen_codes, with the scene's place.
Result<std::vector<CodeChoice>> judged_codes(const SceneDescription& scene,
                                             const std::vector<std::string>& rules,
                                             const std::vector<std::string>& deviations);

/// Equivalent background of what the light before the failure of the mains has bleached [cd/m2], by
/// the stated time after it; 0 in mains operation and where no time is stated.
double equivalent_background_of(const AssessmentSettings& people, Operation operation,
                                std::optional<double> seconds_after_failure);

/// An eye of this age that has been where the people of the scene were, in a judged state.
Eye adapted_eye(const AssessmentSettings& people, const Scenario& scenario, double age_years);

/// Whether a scenario has media other than flames.
bool has_smoke(const SceneDescription& scene, const Scenario& scenario);

/// Whether a medium only emits light, and is therefore no smoke.
bool is_flame(const Medium& medium);

/// Errors: there is smoke, and the scene does not state `irritant_smoke`.
Result<void> irritation_is_said(const SceneDescription& scene, const Scenario& scenario);

/// Remarks that options override rule sets or deviations of the scene.
Remarks overruled(const SceneDescription& scene, const std::vector<std::string>& rules,
                  const std::vector<std::string>& deviations);

AssessedState state_of(const SceneDescription& scene, const Scenario& scenario,
                       std::vector<CodeChoice> codes);

}  // namespace luxodus

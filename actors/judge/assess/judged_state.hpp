// Which state of a building an assessment judges, and by which rules: what has to be named and is
// not is refused with what to write, never guessed. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Sooner after a failure of the mains eyes are not adapted to what is left of the light [s]: the
/// pupil takes seconds, cones take about two minutes, and EN 1838 counts with a minute.
inline constexpr double adapted_after_s = 60;
/// Extinctions are stated at this wavelength [nm], as most measurements are.
inline constexpr double stated_nm = 633;

/// Smallest and largest extinction of a medium where it is, at stated_nm, scenario applied [1/m].
struct StatedMedium {
  std::string name;
  std::string kind;   // "layered", "flame"
  std::string place;  // "office.toml:22"
  Remarks notes;      // 6 layers, times 0.5 in this scenario
  double extinction_min = 0, extinction_max = 0;
};

/// What was judged: said before any verdict.
struct AssessedState {
  std::string scenario;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;  // where the scenario says it
  size_t luminaires = 0;                        // in the scene
  std::vector<std::string> lit;                 // names, in this state
  bool smoke = false;                           // media that are no flames
  std::vector<StatedMedium> media;              // flames too
  std::vector<CodeChoice> codes;
  Remark light{RemarkId::no_luminaire_lit};  // what views were judged with
  Remarks remarks;
  Remarks warnings;  // those of the remarks that a designer is warned of at once
};

/// The state that is judged: the one that is named, in whatever operation. Without a name, the one
/// scenario in emergency operation that has smoke; in a scene none of whose scenarios has smoke,
/// the one in emergency operation. What counts is the operation after the mains have failed, which
/// a clock may not yet have reached. Nothing else in the scene may be mistaken for it: a scenario
/// in mains operation that differs in more than its operation (its media, flames, circuits, doors)
/// may be one whose `operation` was forgotten. Errors: no such scenario, none at all, or a choice;
/// each says what to write.
Result<Scenario> judged_scenario(const SceneDescription& scene, const std::string& named);

/// The rule sets and deviations that were asked for, else those that the scene names.
/// Errors: as chosen_codes, with the scene's place.
Result<std::vector<CodeChoice>> judged_codes(const SceneDescription& scene,
                                             const std::vector<std::string>& rules,
                                             const std::vector<std::string>& deviations);

/// Whether media other than flames are left in a scenario.
bool has_smoke(const SceneDescription& scene, const Scenario& scenario);

/// Of a scene's media, those that only glow: no smoke.
bool is_flame(const Medium& medium);

/// Errors: there is smoke, and the scene does not say whether it stings.
Result<void> irritation_is_said(const SceneDescription& scene, const Scenario& scenario);

/// What was asked for by options, and the scene says otherwise.
Remarks overruled(const SceneDescription& scene, const std::vector<std::string>& rules,
                  const std::vector<std::string>& deviations);

AssessedState state_of(const SceneDescription& scene, const Scenario& scenario,
                       std::vector<CodeChoice> codes);

}  // namespace luxodus

// The building as a live view has it: the scene's description with what viewers have moved, each
// luminaire, sign and flame a source group of its own, so that dimming one is a factor on what it
// has given already. Pure functions; any thread.
#pragma once

#include <map>
#include <memory>

#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// What viewers ask to be traced. Factors of groups are not among it: they need no tracing.
struct SceneEdits {
  std::string scenario;  // "": the first
  double smoke = 1;      // all extinctions times this
  struct Move {
    glm::dvec3 position{0};
    std::optional<glm::dvec3> facing;
  };
  std::map<std::string, Move> signs, luminaires;  // by name, copies' too
  /// A copy of a sign or luminaire of the scene, which stands where its own move says.
  struct Copy {
    bool is_sign = true;
    std::string of, name;
  };
  std::vector<Copy> added = {};  // in their order
  /// Of the state, where the scene has a clock; none: as it was opened [s].
  std::optional<double> at_s = {};
};

/// Which source group an emitter, a sign or a flame has.
std::string group_of_luminaire(const std::string& name);
std::string group_of_sign(const std::string& name);
std::string group_of_flame(const std::string& medium);

/// A description to be compiled: with what was added, moved, grouped, with nothing to tally but
/// surfaces and smoke. Errors: a facing that has no upright; a copy of what is not there.
Result<SceneDescription> live_description(const SceneDescription& scene, const SceneEdits& edits);

/// The same with luminaires, signs and flames dimmed by the factors of their groups.
/// Errors: as live_description.
Result<SceneDescription> dimmed_description(const SceneDescription& scene, const SceneEdits& edits,
                                            const std::map<std::string, double>& factors);

/// How long the mains have failed in a scenario; none where they have not, or it does not say.
std::optional<double> seconds_said(const Scenario& scenario);
/// Share of what is traced that groups give so long after the mains have failed:
/// luminaires by their onset, photoluminescent signs by their decay. Groups that are not named give
/// all, as all do where no time is given or the mains are there.
std::map<std::string, double> shares_after(const SceneDescription& scene, Operation operation,
                                           std::optional<double> seconds);

/// Luminaires are traced as fully on, photoluminescent signs as they are at first: what they give
/// at other times is a share of it. Bands are those of the scene without what was added, so that
/// all other light stays what it is. Errors: as compile_scene and live_description; no such
/// scenario.
Result<std::shared_ptr<const CompiledScene>> compile_live(const SceneDescription& scene,
                                                          const SceneEdits& edits);

/// As it stands with these factors, all of its light one source group: for pictures, which ask for
/// no more. Errors: as compile_live.
Result<std::shared_ptr<const CompiledScene>> compile_dimmed(
    const SceneDescription& scene, const SceneEdits& edits,
    const std::map<std::string, double>& factors);

/// A name for a copy of a sign or luminaire, that nothing in the scene or in the edits has: "exit
/// copy", then "exit copy 2"; also of copies, which are counted on.
std::string name_for_copy(const SceneDescription& scene, const SceneEdits& edits,
                          const std::string& of);

/// A scene file that includes the original and says what differs.
std::string variant_text(const SceneDescription& scene, const SceneEdits& edits,
                         const std::map<std::string, double>& factors, const std::string& name);

}  // namespace luxodus

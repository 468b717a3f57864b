// The building of a live view: the scene's description with the viewers' changes, in which each
// luminaire, sign and flame is a source group of its own, so that dimming one is a factor on its
// traced light. Pure functions; any thread.
#pragma once

#include <map>
#include <memory>

#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// Changes that need tracing. Factors of groups are not included, because they do not.
struct SceneEdits {
  std::string scenario;  // "": the first
  double smoke = 1;      // factor of all extinctions
  struct Move {
    glm::dvec3 position{0};
    std::optional<glm::dvec3> facing;
    bool operator==(const Move&) const = default;
  };
  std::map<std::string, Move> signs, luminaires;  // by name, including copies
  /// A copy of a sign or luminaire of the scene, or one of a type of its design; placed by its own
  /// move.
  struct Copy {
    bool is_sign = true;
    std::string of, name;
    bool of_type = false;  // `of` names a [[design.type]] or a [[design.sign]]
    bool operator==(const Copy&) const = default;
  };
  std::vector<Copy> added = {};  // in order of creation
  /// Time of the state, if the scene has a clock; none: as opened [s].
  std::optional<double> at_s = {};
  bool operator==(const SceneEdits&) const = default;
};

/// Name of the source group of an emitter, a sign or a flame.
std::string group_of_luminaire(const std::string& name);
std::string group_of_sign(const std::string& name);
std::string group_of_flame(const std::string& medium);

/// A description to compile: with additions, moves and groups, and with tallies for surfaces and
/// smoke only. Errors: a facing without an upright direction; a copy of something that does not
/// exist.
Result<SceneDescription> live_description(const SceneDescription& scene, const SceneEdits& edits);

/// The description with luminaires, signs and flames dimmed by the factors of their groups.
/// Errors: as live_description.
Result<SceneDescription> dimmed_description(const SceneDescription& scene, const SceneEdits& edits,
                                            const std::map<std::string, double>& factors);

/// Time since the mains failure in a scenario; none in mains operation, or if the scenario does not
/// state it.
std::optional<double> seconds_said(const Scenario& scenario);
/// Share of each group's traced light at a time after the mains failure: luminaires by their onset,
/// photoluminescent signs by their decay. Groups not listed have 1, as all have without a time or
/// in mains operation.
std::map<std::string, double> shares_after(const SceneDescription& scene, Operation operation,
                                           std::optional<double> seconds);

/// Luminaires are traced fully on, photoluminescent signs as at the start: at other times they give
/// a share of it. Bands are those of the scene without additions, so that all other light stays the
/// same. Errors: as compile_scene and live_description; no such scenario.
Result<std::shared_ptr<const CompiledScene>> compile_live(const SceneDescription& scene,
                                                          const SceneEdits& edits);

/// The state with these factors, with all light in one source group: for pictures, which need no
/// more. Errors: as compile_live.
Result<std::shared_ptr<const CompiledScene>> compile_dimmed(
    const SceneDescription& scene, const SceneEdits& edits,
    const std::map<std::string, double>& factors);

/// What a copy is made of, without its name and place; null if there is none.
const Emitter* luminaire_to_copy(const SceneDescription& scene, const SceneEdits::Copy& copy);
const Sign* sign_to_copy(const SceneDescription& scene, const SceneEdits::Copy& copy);

/// A name for a copy of a sign or luminaire that neither the scene nor the edits use: "exit copy",
/// then "exit copy 2"; copies of copies continue the numbering. Of a type: "downlight", then
/// "downlight 2".
std::string name_for_copy(const SceneDescription& scene, const SceneEdits& edits,
                          const std::string& of, bool of_type);

/// A scene file that includes the original and lists the differences.
std::string variant_text(const SceneDescription& scene, const SceneEdits& edits,
                         const std::map<std::string, double>& factors, const std::string& name);

}  // namespace luxodus

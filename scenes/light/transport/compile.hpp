// Compiles a scene description for the tracer, for one scenario and one partition. Pure; throws
// nothing; everything wrong is in Problems. Any thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// A weighted sum of source groups: factors by name; 1 for groups that are not named.
struct GroupMixture {
  std::map<std::string, double> factors;
  double of_others = 1;  // for groups without a factor

  double factor_of(const std::string& group) const {
    const auto at = factors.find(group);
    return at == factors.end() ? of_others : at->second;
  }
};

struct CompileOptions {
  int cells = 1;  // geometry cells; 1 is one merged scene; a packed scene is already partitioned
  std::vector<std::string> error_of = {};  // if not empty, overrides the scene's [run] error_of
  /// Share of all batches for each source group, in their order [1]. Empty: by BatchPlan's own
  /// rule. Requires: all above 0, with sum 1.
  std::vector<double> batch_shares = {};
  /// Mixtures of source groups that views are scored by, instead of single groups, beside the
  /// total.
  std::vector<GroupMixture> mixtures = {};
  /// If not null, bands are chosen for this description's light, so that totals of both can be
  /// compared bit by bit. Requires: it has every spectrum of the scene.
  const SceneDescription* bands_of = nullptr;
};

/// The scenario of that name; for an empty name the first, or plain mains if a scene has none.
Result<Scenario> find_scenario(const SceneDescription& description, const std::string& name);

/// Errors: no light at all, only media, an invalid medium or emitter, batch_shares for other
/// groups; each with its place.
Result<std::shared_ptr<const CompiledScene>> compile_scene(
    std::shared_ptr<const SceneDescription> description, const Scenario& scenario,
    const CompileOptions& options);

}  // namespace luxodus

// Compiling: from what a scene says to what the tracer needs, for one scenario and one partition.
// Pure; throws nothing; everything wrong is in Problems.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Light of the source groups, each times a factor, by name; 1 of those that are not named.
struct GroupMixture {
  std::map<std::string, double> factors;
  double of_others = 1;  // of groups without a factor

  double factor_of(const std::string& group) const {
    const auto at = factors.find(group);
    return at == factors.end() ? of_others : at->second;
  }
};

struct CompileOptions {
  int cells = 1;  // geometry cells; 1 is one merged scene; a packed scene has been cut already
  std::vector<std::string> error_of = {};  // instead of the scene's [run] error_of, if not empty
  /// Of all batches, those of each source group, in their order [1]. Empty: by BatchPlan's own
  /// rule. Requires: all above 0, 1 in all.
  std::vector<double> batch_shares = {};
  /// Sums of source groups that views are scored by, beside the whole; in place of single groups.
  std::vector<GroupMixture> mixtures = {};
  /// Bands as for this one's light, if it is not null, so that totals of both can be compared to
  /// the bit. Requires: every spectrum of the scene is in it.
  const SceneDescription* bands_of = nullptr;
};

/// The scenario of that name; with an empty name the first, or plain mains where a scene has none.
Result<Scenario> find_scenario(const SceneDescription& description, const std::string& name);

/// Errors: no light at all, nothing but media, a medium or emitter that cannot be, batch_shares of
/// other groups; each with its place.
Result<std::shared_ptr<const CompiledScene>> compile_scene(
    std::shared_ptr<const SceneDescription> description, const Scenario& scenario,
    const CompileOptions& options);

}  // namespace luxodus

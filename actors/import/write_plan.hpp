// Writes a plan as a scene that the user goes on with.
//   building.toml    overwritten by every import
//   plan.toml        the user's: what each layer and block becomes; new ones are added at its end
//   scene.toml, materials.toml, fixtures.toml    the user's, made if missing
// Nothing is guessed: until plan.toml says otherwise, layers and blocks become nothing. Any thread;
// one import at a time writes to a folder.
#pragma once

#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "runtime/toml/schema.hpp"
#include "scenes/formats/dxf/dxf_plan.hpp"

namespace luxodus {

struct WrittenPlan {
  size_t lines = 0, blocks = 0;  // of the plan, with those of opened blocks
  size_t walls = 0, luminaires = 0, signs = 0;
  std::vector<std::string> asked;  // messages about layers, blocks and types that the user must
                                   // complete
  std::vector<std::string> notes;  // of the plan, and what the scene does not say as it does
  bool kept_scene = false;
};

/// The keys of plan.toml.
const toml::Schema& plan_schema();

/// Errors: a plan.toml with mistakes, each with its line; files that cannot be written; a plan
/// larger than a building.
Result<WrittenPlan> write_plan(const DxfPlan& drawn, double metres_per_unit,
                               const std::string& drawing, const std::string& out);

}  // namespace luxodus

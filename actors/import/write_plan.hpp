// A plan on disk: a scene that a person goes on with.
//   building.toml    written anew by every import
//   plan.toml        a person's: what each layer and block becomes; new ones are added at its end
//   scene.toml, materials.toml, fixtures.toml    a person's, made where they are not there
// Nothing is guessed: until plan.toml says otherwise, layers and blocks become nothing.
#pragma once

#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "runtime/toml/schema.hpp"
#include "scenes/formats/dxf/dxf_plan.hpp"

namespace luxodus {

struct WrittenPlan {
  size_t walls = 0, luminaires = 0, signs = 0;
  std::vector<std::string> asked;  // layers, blocks and types that need a person, in words
  bool kept_scene = false;
};

/// The keys of plan.toml.
const toml::Schema& plan_schema();

/// Errors: a plan.toml with mistakes, each with its line; files that cannot be written; a plan
/// larger than a building.
Result<WrittenPlan> write_plan(const DxfPlan& drawn, double metres_per_unit,
                               const std::string& drawing, const std::string& out);

}  // namespace luxodus

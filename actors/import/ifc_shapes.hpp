// Computes the shapes of an IFC model with an external library (@ifc-lite/wasm) under Node.js, in a
// process of its own that is killed at a time limit. Its answer is a binary glTF, which is read
// like any other untrusted mesh. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

class ReadingShare;

struct IfcShapes {
  /// One part or several for each product: `name` begins with its GlobalId, up to a '#'. Scene axes
  /// [m], in double.
  std::vector<ImportedPart> parts;
  std::vector<std::string> notes;  // messages about what could not be computed
};

/// Opacity of a part, from the name of its material; 1 if that states none.
double opacity_of(const ImportedPart& part);

/// `script`: ifc_shapes.mjs, with node_modules beside it. `seconds`: time limit of the process.
/// `reading`, where given, receives twice a second the share of the model's products that are done.
/// Errors: no Node.js, no package, time limit exceeded, a model without shapes, an answer that is
/// malformed or lacks the position of the shapes.
Result<IfcShapes> ifc_shapes(const std::filesystem::path& model,
                             const std::filesystem::path& script, double seconds,
                             ReadingShare* reading = nullptr);

}  // namespace luxodus

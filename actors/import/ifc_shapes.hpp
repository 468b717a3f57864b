// The shapes of an IFC model, computed by a library of others (@ifc-lite/wasm) under Node.js in a
// process of its own that is ended when it takes too long. Its answer is a binary glTF, which is
// read like any other mesh of others. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

class ReadingShare;

struct IfcShapes {
  /// By product: `name` begins with its GlobalId, up to a '#'. Scene axes [m], in double.
  std::vector<ImportedPart> parts;
  std::vector<std::string> notes;  // what could not be computed, in words
};

/// Opacity of a part, from the name of its material; 1 where it says none.
double opacity_of(const ImportedPart& part);

/// `script`: ifc_shapes.mjs, with node_modules beside it. `seconds`: until the process is ended.
/// `reading`, where given, hears twice a second how much of the model's products is done.
/// Errors: no Node.js, no package, more time, a model without shapes, an answer that is none or
/// does not say where the shapes are.
Result<IfcShapes> ifc_shapes(const std::filesystem::path& model,
                             const std::filesystem::path& script, double seconds,
                             ReadingShare* reading = nullptr);

}  // namespace luxodus

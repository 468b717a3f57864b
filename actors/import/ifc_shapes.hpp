// Computes the shapes of an IFC model with an external library (@ifc-lite/wasm) under Node.js, in a
// process of its own that is killed at a time limit. Its answer is a binary glTF, which is read
// like any other untrusted mesh. Any thread.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/ifc/ifc_model.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

class ReadingShare;

struct IfcShapes {
  /// One part or several for each product: `name` begins with its GlobalId, up to a '#'. Scene axes
  /// [m], in double. None of a model without shapes, which `notes` may explain.
  std::vector<ImportedPart> parts;
  std::vector<std::string> notes;      // messages about what could not be computed
  std::map<uint64_t, uint64_t> uncut;  // number of a product, of its openings that were not cut
  std::map<std::string, double> open;  // solids that are not closed: GlobalId, missing area [m2]
  std::set<std::string> nothing;       // GlobalIds of solids that cut themselves away entirely
};

/// Opacity of a part, from the name of its material; 1 if that states none.
double opacity_of(const ImportedPart& part);

/// `script`: ifc_shapes.mjs, with node_modules beside it. `seconds`: time limit of the process.
/// `reading`, where given, receives twice a second the share of the model's products that are done.
/// `only`: numbers of the products whose shapes are wanted; empty for all.
/// Errors: no Node.js, no package, time limit exceeded, an answer that is malformed or lacks the
/// position of a shape.
Result<IfcShapes> ifc_shapes(const std::filesystem::path& model,
                             const std::filesystem::path& script, double seconds,
                             ReadingShare* reading = nullptr,
                             const std::vector<uint64_t>& only = {});

/// Shapes of a model from its exchange file, made ready for the library. Solids that come back open
/// or lost are cut by half spaces here and computed again; those that remain open are in `open`.
/// Errors: as ifc_shapes, a model without shapes.
Result<IfcShapes> shapes_of_model(const StepFile& step, const IfcModel& model,
                                  const std::filesystem::path& script, double seconds,
                                  ReadingShare* reading = nullptr);

}  // namespace luxodus

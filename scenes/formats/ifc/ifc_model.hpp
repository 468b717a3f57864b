// What an IFC model (2x3, 4, 4x3) says about a building, without its shapes: products with their
// GlobalIds, types, storeys, materials, properties and authored volumes, in metres and scene axes
// (z up). Entities and attributes are those of the schemas of buildingSMART. What is missing or
// refers to nothing is left out and reported with its instance number; nothing is guessed.
// Immutable; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/ifc/light_sources.hpp"
#include "scenes/formats/ifc/step_file.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace limits {
/// Faults of instances that are kept; step_faults limits those of the text.
inline constexpr size_t ifc_faults = 10'000;
}  // namespace limits

struct IfcProduct {
  uint64_t id = 0;   // of the instance: "#38"
  std::string guid;  // GlobalId, 22 characters
  std::string kind;  // "WALL" of IFCWALLSTANDARDCASE: without IFC and without subtype suffixes
  std::string name, long_name, object_type, tag;
  std::string type_name;               // of its type object
  std::string type_class;              // "IFCLIGHTFIXTURETYPE"
  std::string predefined;              // SECURITYLIGHTING; the product's, else its type's
  std::string operation;               // SINGLE_SWING_LEFT, of doors
  std::string storey;                  // name of the storey that contains it; "" where none does
  uint64_t storey_id = 0;              // several storeys may have one name
  uint64_t part_of = 0;                // id of the element that it is a part of; 0 where none is
  std::vector<std::string> materials;  // layers from the outside in, or all that are named
  std::string layer;                   // of the presentation (CAD)
  Transform placement;
  bool has_shape = false;           // a body, or should have one
  bool is_solid = false;            // its body is made of solids, which must be closed
  std::string other_shapes;         // representations that are no body: "Clearance"
  std::string taken_as;             // representation that was taken as the body for want of one
  std::optional<double> volume_m3;  // as authored; net where both are given
  uint64_t fills = 0, voids = 0;    // id of the opening it fills, of the element it voids
  std::map<std::string, std::string> properties;  // "Pset_DoorCommon.FireExit" -> "T"
  std::optional<IfcLightSource> light;

  /// A property of a property set, "SET.NAME"; "" where it is absent.
  std::string property(const std::string& path) const;
};

struct IfcStorey {
  uint64_t id = 0;
  std::string name;
  double elevation_m = 0;
};

struct IfcModel {
  std::string file, schema, project;
  double metres_per_unit = 1;
  std::vector<IfcStorey> storeys;    // upwards
  std::vector<IfcProduct> products;  // in the order of the file
  std::vector<Problem> faults;       // what could not be read, with lines or instance numbers
  size_t more_faults = 0;            // number of faults beyond those kept
};

/// Reads a model from its bytes; `reading`, where given, receives the progress.
/// Errors: not a STEP file, no unit of length, more than the limits.
Result<IfcModel> ifc_model_of(std::string bytes, const std::string& file,
                              ReadingShare* reading = nullptr);
/// The same from an exchange file. Errors: no unit of length.
Result<IfcModel> ifc_model_of(const StepFile& step, const std::string& file);

}  // namespace luxodus

// Which representations of a product are its body. A product may also have its axis, its
// footprint, the space that must stay clear in front of it, its light source: these are no solids.
// Internal to the reading of IFC; one thread, since it reads through a StepGraph.
#pragma once

#include <string>
#include <vector>

#include "scenes/formats/ifc/step_graph.hpp"

namespace luxodus {

struct IfcBody {
  std::vector<uint64_t> representations;  // of the body; empty if there is none
  std::vector<uint64_t> others;
  std::string taken_as;  // the identifier, where it is not "Body" or one that means it
  std::string left_out;  // identifiers of the others that hold a volume, with commas
};

/// Of an IfcProductDefinitionShape, or an IfcProductRepresentation of IFC2x3: "Body" of a model
/// view; else the next best that may be a body.
IfcBody ifc_body(StepGraph& graph, const StepNode& shape);

/// Whether all items of the body are solids by their kind: sweeps, booleans, breps, closed face
/// sets. A surface model may be open by intention.
bool is_solid_body(StepGraph& graph, const IfcBody& body);

}  // namespace luxodus

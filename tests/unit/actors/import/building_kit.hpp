// What tests of imported buildings share: boxes, and the buildings of models whose shapes are
// computed. One thread.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "actors/import/building.hpp"
#include "actors/import/ifc_shapes.hpp"
#include "scenes/light/geometry/primitives.hpp"

namespace luxodus::test {

namespace fs = std::filesystem;

inline Mesh block(const glm::dvec3& low, const glm::dvec3& high) {
  auto shape = shapes::box(high - low);
  REQUIRE(shape.ok());
  for (glm::dvec3& p : shape->mesh.positions) p += (low + high) / 2.0;
  return std::move(shape).value().mesh;
}

inline const fs::path script = fs::path(LUX_SOURCE_DIR) / "actors/import/shapes/ifc_shapes.mjs";

/// Whether shapes can be computed here.
inline bool can_compute() {
  if (fs::is_directory(script.parent_path() / "node_modules/@ifc-lite/wasm") &&
      std::system("node --version > /dev/null 2>&1") == 0)
    return true;
  WARN("skipped: Node.js or the package @ifc-lite/wasm is not there (./setup.sh)");
  return false;
}

/// The building of a model, with its shapes.
inline IfcBuilding building_of_text(const std::string& text, const fs::path& file) {
  const auto step = StepFile::of(text, file.string());
  REQUIRE(step.ok());
  const auto model = ifc_model_of(step.value(), file.string());
  REQUIRE(model.ok());
  auto shapes = shapes_of_model(step.value(), model.value(), script, 120);
  if (!shapes) FAIL(shapes.problem().text());
  return building_of(model.value(), std::move(shapes).value());
}

inline const BuildingPart& part_with(const IfcBuilding& building, const std::string& word) {
  for (const BuildingStorey& storey : building.storeys)
    for (const BuildingPart& part : storey.parts)
      if (part.name.find(word) != std::string::npos) return part;
  FAIL("no part " << word);
  return building.storeys.front().parts.front();
}

}  // namespace luxodus::test

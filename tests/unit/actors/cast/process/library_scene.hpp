// A shipped scene, in small batches, so that a short run has several. Test code; any thread.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

inline std::shared_ptr<SceneDescription> description_of(const char* name) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + name + ".toml");
  REQUIRE(read.scene);
  return std::make_shared<SceneDescription>(*read.scene);
}

inline std::shared_ptr<const CompiledScene> scene_of(const char* name, const char* scenario,
                                                     int cells) {
  const auto description = description_of(name);
  description->run.batch_particles = 4096;
  auto compiled =
      compile_scene(description, find_scenario(*description, scenario).value(), {cells});
  REQUIRE(compiled.ok());
  return compiled.value();
}

/// A tank of smoke with voxels so small that all bins take tens of megabytes.
inline std::shared_ptr<const CompiledScene> fine_tank() {
  const auto description = description_of("smoke_tank");
  description->run.batch_particles = 2048;
  description->run.voxel_edge_m = 0.05;
  auto compiled = compile_scene(description, find_scenario(*description, "").value(), {1});
  REQUIRE(compiled.ok());
  return compiled.value();
}

}  // namespace luxodus

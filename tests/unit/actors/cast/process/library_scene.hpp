// A shipped scene, in small batches, so that a short run has several. Test code; any thread.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

inline std::shared_ptr<const CompiledScene> scene_of(const char* name, const char* scenario,
                                                     int cells) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + name + ".toml");
  REQUIRE(read.scene);
  auto description = std::make_shared<SceneDescription>(*read.scene);
  description->run.batch_particles = 4096;
  auto compiled =
      compile_scene(description, find_scenario(*description, scenario).value(), {cells});
  REQUIRE(compiled.ok());
  return compiled.value();
}

}  // namespace luxodus

// A scene whose cells learn about emitters, for tests. One thread.
#pragma once

#include <memory>
#include <string>

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/emitter_sight.hpp"
#include "scenes/light/transport/resolver.hpp"
#include "tests/kit/described.hpp"

namespace luxodus::test {

struct SeenScene {
  std::shared_ptr<const CompiledScene> scene;
  EmbreeDevice device;
  SceneIndex index;
  MergedResolver resolver;
  EmitterSight sight;

  explicit SeenScene(const std::string& text) : SeenScene(described_text(text)) {}
  explicit SeenScene(const std::shared_ptr<const SceneDescription>& d)
      : scene(compile_scene(d, find_scenario(*d, "").value(), {}).value()),
        index(device, *scene),
        resolver(*scene, index),
        sight(*scene) {}

  /// Converts to local coordinates.
  Vec3 at(double x, double y, double z) const {
    return Vec3(glm::dvec3(x, y, z) - scene->local_origin);
  }
};

}  // namespace luxodus::test

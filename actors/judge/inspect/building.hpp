// A scene compiled for questions about places: the light of emitters there, and what is visible
// from there. Nothing is tallied. Thread rule: made and called from one thread; rows of work run on
// several.
#pragma once

#include "actors/results/run/parallel_for.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

class Building {
 public:
  /// Errors: as compile_scene.
  static Result<std::unique_ptr<Building>> make(SceneDescription scene, const Scenario& scenario,
                                                int threads);

  const CompiledScene& scene() const { return *scene_; }
  /// Surfaces of rooms whose backs face inwards, as turned_surfaces.
  const std::vector<char>& turned() const { return turned_; }
  glm::vec3 local(const glm::dvec3& place) const { return glm::vec3(place - scene_->local_origin); }
  /// Calls `work` with every number below `count`, on all threads.
  void each(size_t count,
            const std::function<void(const GeometryAccess& access, size_t i)>& work) const;

  /// Whether a place lies in a closed body, as in_body; rooms drawn with their faces outwards are
  /// not bodies, nor are `ignored` surfaces.
  bool in_solid(const GeometryAccess& access, const glm::dvec3& place,
                std::span<const char> ignored = {}) const;
  const ParallelFor& rows() const { return rows_; }
  /// Share of a sign's face with a clear line to an eye.
  double seen_share(const GeometryAccess& access, const Sign& sign, const SignView& view,
                    const glm::dvec3& eye) const;

 private:
  Building(std::shared_ptr<const CompiledScene> scene, int threads);

  std::shared_ptr<const CompiledScene> scene_;
  EmbreeDevice device_;
  SceneIndex index_;
  ResidentParallelFor rows_;
  std::vector<char> turned_;  // as turned_surfaces
};

/// A copy without measurements: no planes, probes, groups, observers, cameras, voxels.
SceneDescription without_measurements(const SceneDescription& scene);

}  // namespace luxodus

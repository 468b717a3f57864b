// Steady flames of a scene at a moment, along the rays of a picture: which factor their light has,
// and light from behind them (flame_shape.hpp). Flames of data sets, such as those of fire
// simulations, stay as they are. One thread or fiber at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/light/intersect/ray.hpp"
#include "scenes/light/optics/flame_shape.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/path_bands.hpp"

namespace luxodus {

/// A flame that a moment changes: a body that glows in the scenario.
struct SteadyFlame {
  int medium = -1, component = -1;
  const QuadricBody* body = nullptr;
  uint32_t seed = 0;  // of its shape; not 0
};

/// Requires: the scene outlives what is returned.
std::vector<SteadyFlame> steady_flames(const CompiledScene& scene);

class FlameMoment {
 public:
  /// Requires: the scene outlives this.
  FlameMoment(const CompiledScene& scene, double time_s);

  /// Finds the flames on the first `length` [m] of a ray, for bands of a path.
  void meet(const Ray& ray, Real length, const PathBands& bands);
  /// Factor on the light that a medium's flame sends against the ray, in the band in place `i`:
  /// its own, and that of flames before it. 1 for media that are no such flames.
  double on_emission(int medium, size_t i) const;
  /// Factor on light from a place of the ray, in the band in place `i`.
  double on_light_from(double distance_m, size_t i) const;

 private:
  struct Flame : SteadyFlame {
    FlameShape shape;
  };
  struct Met {
    int medium = -1;
    double begin_m = 0, end_m = 0;
    double factor = 1;
    BandValues behind;  // valid: the bands of the path
  };

  void add(const Flame& flame, const Ray& ray, const RayInterval& chord, double length_m,
           const PathBands& bands);

  const CompiledScene& scene_;
  double time_s_;
  std::vector<Flame> flames_;
  std::vector<Met> met_;
};

}  // namespace luxodus

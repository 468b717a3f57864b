// Tables for the free-flight kernels: all media of a scene compiled to one stack of slabs, prisms,
// quadric bodies and grids, with extinction and albedo of each component by band. Made by
// MediaSet::compile. Coordinates are relative to the scene's local origin [m]. Immutable once made;
// any thread.
#pragma once

#include <memory>
#include <vector>

#include "scenes/light/optics/footprint_prism.hpp"
#include "scenes/light/optics/layer_stack.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/quadric_body.hpp"
#include "scenes/light/optics/smoke_grid.hpp"
#include "scenes/light/optics/volume_emitter.hpp"

namespace luxodus {

namespace limits {
/// Segments of one ray in prisms and bodies together; they are kept on the stack of the tracing
/// loop (24 bytes each).
inline constexpr int max_ray_segments = 512;
/// Data sets of one scene; their cursors are on that stack, too (about 250 bytes each).
inline constexpr int max_grids = 16;
/// Glowing media of one scene.
inline constexpr int max_volume_emitters = 256;
/// Bands of one scene: one per sample of a spectrum.
inline constexpr int max_media_bands = 81;
}  // namespace limits

/// One homogeneous medium, layer, body, or data set.
struct MediaComponent {
  int medium = -1;
  int phase = 0;
  int emitter = -1;
};

/// A prism or a quadric body with its bounding box, used to skip it, never to clip it.
struct PlacedBody {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
  int prism = -1;
  int quadric = -1;
  int component = -1;  // component of the quadric
};

struct PlacedGrid {
  SmokeGrid grid;
  int component = -1;
};

struct MediaTables {
  std::vector<MediaComponent> components;
  /// [band][component]: extinction [1/m] times the scenario's factor; for a data set with an
  /// extinction array, the factor on that array.
  std::vector<double> sigma_t;
  std::vector<double> albedo;  // [band][component]
  LayerStack stack;
  std::vector<PlacedBody> bodies;
  std::vector<FootprintPrism> prisms;
  std::vector<QuadricBody> quadrics;
  std::vector<PlacedGrid> grids;
  std::vector<Phase> phases;  // distinct
  std::vector<VolumeEmitter> emitters;

  size_t row(int band) const { return static_cast<size_t>(band) * components.size(); }
  double sigma_of(int band, int component) const {
    return sigma_t[row(band) + static_cast<size_t>(component)];
  }
  double albedo_of(int band, int component) const {
    return albedo[row(band) + static_cast<size_t>(component)];
  }
  const MediaComponent& component(int i) const { return components[static_cast<size_t>(i)]; }
};

/// A data set's extinction [1/m] in a cell.
template <class Resolver>
double cell_sigma(const PlacedGrid& placed, double factor, const glm::ivec3& cell,
                  BrickReader<Resolver>& bricks) {
  if (factor == 0 || !placed.grid.has_extinction()) return factor;
  const Brick& brick = bricks.at(placed.grid.medium(), placed.grid.brick_of(cell));
  return factor *
         static_cast<double>(brick.extinction[static_cast<size_t>(Brick::cell_index(cell))]);
}

/// A data set's albedo in a cell; `constant` if it has no albedo array.
template <class Resolver>
double cell_albedo(const PlacedGrid& placed, double constant, const glm::ivec3& cell,
                   BrickReader<Resolver>& bricks) {
  if (!placed.grid.has_albedo()) return constant;
  const Brick& brick = bricks.at(placed.grid.medium(), placed.grid.brick_of(cell));
  return static_cast<double>(brick.albedo[static_cast<size_t>(Brick::cell_index(cell))]);
}

}  // namespace luxodus

// The measured scenes, made in memory: a furnished room of 661 quads under one lamp, clear or in
// smoke, and a landscape of any number of triangles. Every parameter that matters for speed is
// defined here. Pure; any thread.
#pragma once

#include <memory>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::bench {

enum class Air { clear, homogeneous, layered };

/// Tallies of the room besides the flux into and out of every patch, wall and piece of furniture.
struct FurnishedTallies {
  bool detectors = false;  // a working plane of 20 x 15 cells, a counting plane, a volume group
  bool voxels = false;     // about 20 000
};

/// 20 x 15 x 3 m, six walls and 131 boxes without bottoms, Lambertian 0.5, one ceiling rectangle.
/// Homogeneous: isotropic, 0.1/m, albedo 0.8. Layered: six layers of 0.5 m, 0.05 to 2/m upwards,
/// albedo 0.8.
SceneDescription furnished(Air air, const FurnishedTallies& tallies);
std::shared_ptr<const CompiledScene> furnished_room(Air air, const FurnishedTallies& tallies);

/// A room of 10 x 8 x 3 m, as densely furnished, with four ceiling lamps of 0.6 x 0.3 m and a
/// camera in a corner. Smoke as above, albedo 0.6.
std::shared_ptr<const CompiledScene> pictured_room(Air air, int width, int height);

/// A hilly floor of 2 n^2 triangles under a lamp, one patch on each side of each triangle.
std::shared_ptr<const CompiledScene> landscape(int n);

}  // namespace luxodus::bench

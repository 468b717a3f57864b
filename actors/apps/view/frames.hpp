// Makes the binary frames of PROTOCOL.md: geometry, light on surfaces, light in smoke, from a run's
// totals. Pure functions; any thread, while nobody adds to the totals.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/apps/view/flames.hpp"
#include "actors/apps/view/live_run.hpp"

namespace luxodus {

using LiveFrame = std::shared_ptr<const std::string>;

/// A triangle of a frame: the bins of both sides, and its area.
struct LivePatch {
  uint32_t front = 0, back = 0;
  uint32_t surface = 0;
  double area_m2 = 0;
};

struct LiveGeometry {
  LiveFrame frame;
  std::vector<LivePatch> patches;  // by triangle of the frame
};

/// Every flux patch as a triangle. Errors: a packed scene that cannot be read.
Result<LiveGeometry> geometry_of(const CompiledScene& scene, uint32_t generation);

/// The smoke of a generation; empty without media.
struct LiveSmoke {
  LiveFrame frame;
  /// Scattering coefficients by voxel and band [1/m].
  std::shared_ptr<const std::vector<float>> scattering;
  /// Flames that are shown separately, whose glow is not in voxels.
  std::shared_ptr<const std::vector<LiveFlame>> flames;
};

/// Extinction of the voxels, and how much they scatter forwards.
LiveSmoke smoke_of(const CompiledScene& scene, const SceneIndex& index, uint32_t generation);

/// Light of some source groups on surfaces and, if there is smoke, in it; computed on the run's
/// threads.
/// Requires: `smoke` belongs to the run's scene.
std::vector<LiveFrame> light_frames(const LiveRun& run, const std::vector<LivePatch>& patches,
                                    const LiveSmoke& smoke, uint32_t generation,
                                    const std::vector<int>& groups);

/// The head of a frame.
struct FrameHead {
  uint32_t kind = 0, generation = 0, a = 0, b = 0;
};
FrameHead head_of(const LiveFrame& frame);
/// Whether a frame is light of a group: then `a` is the group's number.
bool is_light(const FrameHead& head);
bool is_surface_light(const FrameHead& head);
/// The frame's content for another generation; light becomes that of the group `a`.
LiveFrame readdressed(const LiveFrame& frame, uint32_t generation, uint32_t a);

/// The triangle of before that corresponds to each triangle of now, or none_index.
std::shared_ptr<const std::vector<uint32_t>> triangles_from(const std::vector<LivePatch>& before,
                                                            const std::vector<LivePatch>& now,
                                                            const BinMap& bins);
/// Light on surfaces for other triangles: each takes that of its counterpart before, new ones none.
LiveFrame relaid(const LiveFrame& light, const std::vector<uint32_t>& triangles_before);

}  // namespace luxodus

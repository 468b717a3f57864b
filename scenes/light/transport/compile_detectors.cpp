#include "scenes/light/transport/compile_detectors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "scenes/light/transport/media_bounds.hpp"

namespace luxodus {

namespace limits {
inline constexpr int64_t voxels = 50'000'000;
inline constexpr int64_t all_plane_cells = 1 << 28;  // 17 GB of totals; bin indices have 32 bits
inline constexpr int64_t default_voxels = 20'000;    // if a scene gives no edge
}  // namespace limits

namespace {

CompiledPlane make_plane(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int nu,
                         int nv, const glm::dvec3& origin) {
  CompiledPlane out;
  const glm::dvec3 cross = glm::cross(u, v);
  const glm::dvec3 n = glm::normalize(cross);
  out.corner = Vec3(corner - origin);
  out.normal = Vec3(n);
  // Dual edges give coordinates along u and v even if the two are not perpendicular.
  out.dual_u = Vec3(glm::cross(v, n) / glm::dot(u, glm::cross(v, n)));
  out.dual_v = Vec3(glm::cross(n, u) / glm::dot(v, glm::cross(n, u)));
  out.cells_u = nu;
  out.cells_v = nv;
  out.cell_area_m2 = glm::length(cross) / (nu * nv);
  return out;
}

/// Reach beyond a flight's end, as a share of the offset of rays from surfaces: a plane in a wall
/// or on a floor is crossed by the flights that end there, however their ends are rounded (two ulps
/// of the largest coordinate), and reflected light crosses it from behind.
constexpr Real plane_reach_share = 0.5_r;

/// Media that this scenario does not remove.
std::vector<const Medium*> active_media(const CompiledScene& scene) {
  std::vector<const Medium*> out;
  for (const Medium& m : scene.description->media) {
    if (factor_of_medium(scene.scenario, m) > 0) out.push_back(&m);
  }
  return out;
}

/// Line of a key in a scene's main file; 0 if it is absent or the file is a pack. Values do not
/// carry their place this far.
SourcePlace place_of_key(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line.compare(at, key.size(), key) != 0) continue;
    const size_t next = line.find_first_not_of(" \t", at + key.size());
    if (next != std::string::npos && line[next] == '=') return {file, number};
  }
  return {file, 0};
}

Problem too_many_voxels(const CompiledScene& scene) {
  const Bounds box = media_bounds(active_media(scene), scene.bounds);
  const glm::dvec3 size = box.high - box.low;
  // Slightly above the cube root, since a side has a whole number of voxels.
  const double least =
      1.1 * std::cbrt(size.x * size.y * size.z / static_cast<double>(limits::voxels));
  std::ostringstream what;
  what << "the voxel grid would have more than " << limits::voxels / 1'000'000
       << " million voxels: set voxel_edge_m in [run] to about " << std::setprecision(2) << least
       << " or more";
  return {place_of_key(scene.description->file, "voxel_edge_m"), what.str()};
}

}  // namespace

Result<void> compile_detectors(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  int64_t plane_cells = 0;
  for (const PlaneMeasure& p : d.planes) plane_cells += int64_t{p.cells_u} * p.cells_v;
  if (plane_cells > limits::all_plane_cells)
    return problem_in(d.file, "the planes have " + std::to_string(plane_cells) +
                                  " cells in all: make their cells larger");
  uint32_t bin = 0;
  for (const PlaneMeasure& p : d.planes) {
    CompiledPlane plane =
        make_plane(p.corner, p.edge_u, p.edge_v, p.cells_u, p.cells_v, scene.local_origin);
    plane.first_bin = bin;
    bin += static_cast<uint32_t>(p.cells_u * p.cells_v);
    scene.planes.push_back(plane);
  }
  for (const CountingPlaneMeasure& p : d.counting_planes) {
    scene.counting_planes.push_back(
        make_plane(p.corner, p.edge_u, p.edge_v, 1, 1, scene.local_origin));
  }
  for (const auto* list : {&scene.planes, &scene.counting_planes}) {
    for (const CompiledPlane& p : *list)
      scene.plane_tests.push_back({p.normal, glm::dot(p.normal, p.corner)});
  }
  scene.plane_reach_m = scene.min_offset_m * plane_reach_share;
  for (const VolumeGroupMeasure& v : d.volume_groups) {
    CompiledVolumeGroup out;
    out.shape = v.shape;
    out.low = Vec3(v.low - scene.local_origin);
    out.high = Vec3(v.high - scene.local_origin);
    if (v.shape == VolumeGroupMeasure::Shape::layer) {
      out.low.x = out.low.y = -1e30_r;
      out.high.x = out.high.y = 1e30_r;
    }
    out.centre = Vec3(v.centre - scene.local_origin);
    out.radius = static_cast<Real>(v.radius);
    out.inner_radius = static_cast<Real>(v.inner_radius);
    scene.volume_groups.push_back(out);
  }
  return {};
}

Result<void> choose_voxels(CompiledScene& scene) {
  const RunSettings& run = scene.description->run;
  if (!run.voxels || scene.features.media == MediaNeed::none) return {};
  const Bounds box = media_bounds(active_media(scene), scene.bounds);
  if (box.empty()) return {};
  double edge = run.voxel_edge_m;
  if (edge <= 0) {
    // The whole scene's size counts: a small cloud needs no finer voxels than a large one.
    const glm::dvec3 size = scene.bounds.high - scene.bounds.low;
    const double volume = std::max(size.x, 1e-6) * std::max(size.y, 1e-6) * std::max(size.z, 1e-6);
    edge = std::cbrt(volume / static_cast<double>(limits::default_voxels));
  }
  // Cells of one lattice over the whole scene, so that other smoke gets the same voxels.
  const glm::dvec3 first = glm::floor((box.low - scene.bounds.low) / edge);
  const glm::dvec3 end = glm::ceil((box.high - scene.bounds.low) / edge);
  // Beyond the limit the number does not matter: the grid is refused anyway.
  const auto cells = [&](int axis) {
    const double most = static_cast<double>(limits::voxels) + 1;
    return static_cast<int>(std::clamp(end[axis] - first[axis], 1.0, most));
  };
  scene.voxels.edge = static_cast<float>(edge);
  scene.voxels.low = glm::vec3(scene.bounds.low + first * edge - scene.local_origin);
  scene.voxels.nx = cells(0);
  scene.voxels.ny = cells(1);
  scene.voxels.nz = cells(2);
  if (1.0 * scene.voxels.nx * scene.voxels.ny * scene.voxels.nz >
      static_cast<double>(limits::voxels))
    return too_many_voxels(scene);
  return {};
}

void choose_eye_targets(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  uint32_t bin = 0;
  for (uint32_t o = 0; o < d.observers.size(); ++o) {
    const auto& wanted = d.observers[o].signs;
    for (uint32_t s = 0; s < scene.signs.size(); ++s) {
      if (wanted && std::count(wanted->begin(), wanted->end(), scene.signs[s].sign) == 0) continue;
      const glm::dvec3 to_eye = d.observers[o].eye - scene.signs[s].frame.origin;
      if (glm::dot(to_eye, scene.signs[s].frame.axes[2]) <= 0) continue;  // its back
      scene.eye_targets.push_back({o, s, bin});
      bin += 3;  // white, green, surround
    }
  }
}

void lay_out_tally(CompiledScene& scene) {
  scene.layout = TallyLayout(scene.bands.count());
  TallyLayout& l = scene.layout;
  TallyBlocks& b = scene.blocks;
  const auto size = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
  b.patches = l.add_block({"patches", scene.patch_count, 2, ScoreUnit::weight});
  b.surfaces = l.add_block({"surfaces", size(scene.surfaces), 3, ScoreUnit::weight});
  b.escape = l.add_block({"escape", 6, 1, ScoreUnit::weight});
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    l.add_aggregate(
        {b.patches, scene.surfaces[i].first_patch, scene.surfaces[i].patches, b.surfaces, i});
  }
  if (!scene.surface_groups.empty()) {
    b.surface_groups =
        l.add_block({"surface_groups", size(scene.surface_groups), 3, ScoreUnit::weight});
    for (uint32_t g = 0; g < scene.surface_groups.size(); ++g) {
      for (const uint32_t s : scene.surface_groups[g]) {
        l.add_aggregate({b.surfaces, s, 1, b.surface_groups, g});
      }
    }
  }
  if (!scene.planes.empty()) {
    const CompiledPlane& last = scene.planes.back();
    const uint32_t cells = last.first_bin + static_cast<uint32_t>(last.cells_u * last.cells_v);
    b.plane_cells = l.add_block({"plane_cells", cells, 2, ScoreUnit::weight});
    b.planes = l.add_block({"planes", size(scene.planes), 2, ScoreUnit::weight});
    for (uint32_t i = 0; i < scene.planes.size(); ++i) {
      const CompiledPlane& p = scene.planes[i];
      l.add_aggregate(
          {b.plane_cells, p.first_bin, static_cast<uint32_t>(p.cells_u * p.cells_v), b.planes, i});
    }
  }
  if (!scene.counting_planes.empty())
    b.counting = l.add_block({"counting", size(scene.counting_planes), 4, ScoreUnit::weight});
  if (!scene.volume_groups.empty()) {
    b.volume_length =
        l.add_block({"volume_length", size(scene.volume_groups), 1, ScoreUnit::weight_length});
    b.volume_power = l.add_block({"volume_power", size(scene.volume_groups), 2, ScoreUnit::weight});
  }
  if (!scene.media_names.empty())
    b.media_power = l.add_block({"media_power", size(scene.media_names), 2, ScoreUnit::weight});
  if (scene.voxels.edge > 0) {
    b.voxels =
        l.add_block({"voxels", scene.voxels.count(), voxel_quantities, ScoreUnit::weight_length});
    b.voxel_power = l.add_block({"voxel_power", scene.voxels.count(), 2, ScoreUnit::weight});
  }
  const uint32_t groups = size(scene.groups);
  if (const uint32_t probes = size(scene.description->probes); probes > 0) {
    b.probes = l.add_block({"probes", probes, 2, ScoreUnit::value, false});
    if (groups > 1) {
      b.probes_by_group =
          l.add_block({"probes_by_group", probes * groups, 2, ScoreUnit::value, false});
    }
  }
  if (const uint32_t parts = 3 * size(scene.eye_targets); parts > 0) {
    b.views = l.add_block({"views", parts, eye_quantities, ScoreUnit::value, false});
    const uint32_t mixtures = size(scene.mixtures);
    if (mixtures > 0) {
      b.views_by_mixture = l.add_block(
          {"views_by_mixture", parts * mixtures, mixture_eye_quantities, ScoreUnit::value, false});
    } else if (groups > 1) {
      b.views_by_group = l.add_block(
          {"views_by_group", parts * groups, group_eye_quantities, ScoreUnit::value, false});
    }
  }
}

}  // namespace luxodus

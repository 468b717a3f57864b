// Writes the run's counts on surfaces and in the air for ParaView. Values are means over a patch or
// a voxel, with the standard error of that bin; errors of bins cannot be combined, so whole
// triangles, which are sums of patches, have none.

#include <cmath>

#include "actors/results/files/maps.hpp"
#include "actors/results/formats/write_vtk.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace {

/// The arrays of patches.vtp, front and back side of each patch or triangle.
struct SurfaceArrays {
  std::vector<float> incident[2], outgoing[2], incident_error[2], outgoing_error[2];
  std::vector<int32_t> surface, triangle;
};

constexpr const char* side_names[2] = {"front", "back"};

/// Appends a triangle's patches, which share corners.
void add_patches(const TriangleRecord& t, uint32_t n, const glm::dvec3& origin, VtkSurface& out) {
  const auto first = static_cast<uint32_t>(out.points.size());
  const glm::dvec3 a(t.corner[0]), b(t.corner[1]), c(t.corner[2]);
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; i + j <= n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      out.points.push_back(origin + a * (1 - u - v) + b * u + c * v);
    }
  }
  // Row i of the lattice holds n + 1 - i points.
  const auto point = [&](const glm::dvec2& uv) {
    const auto i = static_cast<uint32_t>(std::lround(uv.x * n));
    const auto j = static_cast<uint32_t>(std::lround(uv.y * n));
    return first + i * (2 * n + 3 - i) / 2 + j;
  };
  for (uint32_t k = 0; k < n * n; ++k) {
    const auto corners = sub_triangle_corners(k, n);
    out.triangles.push_back({point(corners[0]), point(corners[1]), point(corners[2])});
  }
}

class SurfaceCollector {
 public:
  SurfaceCollector(const CompiledScene& scene, const Readout& readout, bool whole_triangles)
      : scene_(scene), readout_(readout), whole_(whole_triangles) {}

  void add(const TriangleRecord& t) {
    const uint32_t patches = t.subdivision * t.subdivision;
    const uint32_t shown = whole_ ? 1 : patches;
    add_patches(t, whole_ ? 1 : t.subdivision, scene_.local_origin, surface_);
    const uint32_t summed = whole_ ? patches : 1;
    const double per_area = 1 / (summed * scene_.surfaces[t.surface].patch_area_m2(t));
    for (uint32_t k = 0; k < shown; ++k) {
      for (uint32_t side = 0; side < 2; ++side) {
        const uint32_t first = t.first_patch + side * patches + k;
        put(first, summed, 0, per_area, arrays_.incident[side], arrays_.incident_error[side]);
        put(first, summed, 1, per_area, arrays_.outgoing[side], arrays_.outgoing_error[side]);
      }
      arrays_.surface.push_back(static_cast<int32_t>(t.surface));
      arrays_.triangle.push_back(static_cast<int32_t>(t.global_triangle));
    }
  }

  VtkSurface take() {
    for (uint32_t side = 0; side < 2; ++side) {
      const std::string name = side_names[side];
      give("incident_" + name + "_lx", std::move(arrays_.incident[side]));
      give("outgoing_" + name + "_lm_m2", std::move(arrays_.outgoing[side]));
      if (whole_) continue;
      give("incident_" + name + "_standard_error_lx", std::move(arrays_.incident_error[side]));
      give("outgoing_" + name + "_standard_error_lm_m2", std::move(arrays_.outgoing_error[side]));
    }
    surface_.cell_data.push_back({"surface", 1, std::move(arrays_.surface)});
    surface_.cell_data.push_back({"triangle", 1, std::move(arrays_.triangle)});
    surface_.comment =
        std::string(whole_ ? "One cell per triangle, because the scene has more than " +
                                 std::to_string(limits::patches_drawn) +
                                 " patches; sums of patches have no standard error. "
                           : "One cell per flux patch. ") +
        "Values are means over the cell: incident_..._lx is the illuminance [lx], "
        "outgoing_..._lm_m2 the exitance [lm/m2]. \"surface\" counts the surfaces of result.json "
        "from 0, whose names are surface_names; the front is the side from which corners run "
        "counter-clockwise.";
    for (const CompiledSurface& surface : scene_.surfaces)
      surface_.surface_names.push_back(surface.name);
    return std::move(surface_);
  }

 private:
  void put(uint32_t first, uint32_t count, uint32_t quantity, double per_area,
           std::vector<float>& values, std::vector<float>& errors) {
    Estimate sum;
    for (uint32_t i = 0; i < count; ++i) {
      const Estimate e = readout_.lumens(scene_.blocks.patches, first + i, quantity);
      sum.value += e.value;
      sum.standard_error = e.standard_error;
    }
    values.push_back(static_cast<float>(sum.value * per_area));
    if (!whole_) errors.push_back(static_cast<float>(sum.standard_error * per_area));
  }
  void give(const std::string& name, std::vector<float> values) {
    surface_.cell_data.push_back({name, 1, std::move(values)});
  }

  const CompiledScene& scene_;
  const Readout& readout_;
  bool whole_;
  SurfaceArrays arrays_;
  VtkSurface surface_;
};

VtkVolume volume_of(const CompiledScene& scene, const Readout& readout) {
  const VoxelGrid& grid = scene.voxels;
  const auto edge = static_cast<double>(grid.edge);
  const double per_volume = 1 / (edge * edge * edge);
  std::vector<float> fluence, error, vector, absorbed, scattered;
  for (uint32_t i = 0; i < grid.count(); ++i) {
    const auto at = [&](uint32_t block, uint32_t quantity) {
      return readout.lumens(block, i, quantity) * per_volume;
    };
    const Estimate f = at(scene.blocks.voxels, 0);
    fluence.push_back(static_cast<float>(f.value));
    error.push_back(static_cast<float>(f.standard_error));
    for (uint32_t a = 1; a <= 3; ++a) {
      vector.push_back(static_cast<float>(at(scene.blocks.voxels, a).value));
    }
    absorbed.push_back(static_cast<float>(at(scene.blocks.voxel_power, 0).value));
    scattered.push_back(static_cast<float>(at(scene.blocks.voxel_power, 1).value));
  }
  VtkVolume out;
  out.comment =
      "Means over voxels. Fluence [lm/m2] counts light from all directions alike; vector_flux is "
      "in lm/m2, absorbed and scattered are powers per volume [lm/m3]. Voxels that walls cut are "
      "divided by their whole volume.";
  out.origin = glm::dvec3(grid.low) + scene.local_origin;
  out.spacing = glm::dvec3(edge);
  out.cells = {grid.nx, grid.ny, grid.nz};
  out.cell_data.push_back({"fluence_lm_m2", 1, std::move(fluence)});
  out.cell_data.push_back({"fluence_standard_error_lm_m2", 1, std::move(error)});
  out.cell_data.push_back({"vector_flux_lm_m2", 3, std::move(vector)});
  out.cell_data.push_back({"absorbed_lm_m3", 1, std::move(absorbed)});
  out.cell_data.push_back({"scattered_lm_m3", 1, std::move(scattered)});
  return out;
}

}  // namespace

Result<VtkSurface> surface_flux(const LocalRun& run) {
  const CompiledScene& scene = run.scene();
  if (scene.triangles > limits::triangles_drawn)
    return problem(std::to_string(scene.triangles) + " triangles are more than a viewer takes (" +
                   std::to_string(limits::triangles_drawn) + ")");
  const Readout readout(scene, run.totals());
  SurfaceCollector collector(scene, readout, scene.patch_count / 2 > limits::patches_drawn);
  const auto read = for_each_cell(scene, [&](const GeometryCell& cell) {
    for (const TriangleRecord& t : cell.triangles) collector.add(t);
  });
  if (!read) return read.problem();
  return collector.take();
}

VtkVolume volume_flux(const LocalRun& run) {
  return volume_of(run.scene(), Readout(run.scene(), run.totals()));
}

Result<void> write_flux_maps(const std::filesystem::path& folder, const LocalRun& run) {
  const CompiledScene& scene = run.scene();
  if (scene.triangles > limits::triangles_drawn) {
    log_info("patches.vtp is left out: {} triangles are more than a viewer takes ({})",
             scene.triangles, limits::triangles_drawn);
  } else {
    const auto surface = surface_flux(run);
    if (!surface) return surface.problem();
    if (auto ok = write_vtp(folder / "patches.vtp", surface.value()); !ok) return ok.problem();
  }
  if (!(scene.voxels.edge > 0)) return {};
  return write_vti(folder / "volume.vti", volume_flux(run));
}

}  // namespace luxodus

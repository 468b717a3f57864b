// Spatial results: planes as tables and false-colour pictures, patches and voxels for ParaView, and
// the planes of result.json. Direct light is computed deterministically, at the centres of a
// plane's cells and as means over them (plane_light.hpp); indirect light is traced by the run, with
// its standard error. Positions are scene coordinates [m]. Reads the run only; one call at a time
// per run.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "actors/results/files/plane_light.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/write_vtk.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

namespace limits {
/// Up to this many patches (of one side) patches.vtp shows each patch, above it whole triangles.
inline constexpr uint64_t patches_drawn = 2'000'000;
/// Above this many triangles no patches.vtp is written: viewers and this program would need
/// gigabytes.
inline constexpr uint64_t triangles_drawn = 4'000'000;
}  // namespace limits

/// Illuminance in the cells of one plane [lx], index v * cells_u + u.
struct PlaneMap {
  PlaneLight light;                   // direct
  std::vector<Estimate> indirect_lx;  // traced: scattered, reflected, collimated; means over cells
  /// Indices of cells in bodies: their values are NaN, and means and extremes exclude them.
  std::vector<uint32_t> left_out;

  const std::vector<glm::dvec3>& centres() const { return light.centres; }
  /// Mean over a cell.
  Estimate total(size_t cell) const {
    return {light.mean_lx[cell] + indirect_lx[cell].value, indirect_lx[cell].standard_error};
  }
  /// Value at a cell's centre, a grid point of the codes.
  Estimate at_point(size_t cell) const {
    return {light.point_lx[cell] + indirect_lx[cell].value, indirect_lx[cell].standard_error};
  }
};

/// One map per plane of the scene.
struct PlaneMaps {
  std::vector<PlaneMap> planes;
};

/// Computes the direct light of all planes on the run's threads, and reads out the indirect light.
PlaneMaps make_plane_maps(const LocalRun& run, const ShareDone& progress = {});

/// The planes of result.json. Means are separate bins, which gives their errors; minimum and
/// maximum are grid points, with the error of their cell's indirect light.
Json planes_json(const LocalRun& run, const Readout& readout, const PlaneMaps& maps);

/// Writes NAME.csv, NAME.png and NAME_direct_clear_air.png of every plane; NAME is that of
/// result_names(). A plane with more cells than limits::max_drawn_cells or max_grid_edge is written
/// as a table only. Errors: as write_csv and write_png.
Result<void> write_plane_maps(const std::filesystem::path& folder, const LocalRun& run,
                              const PlaneMaps& maps);

/// Flux on surfaces, a cell for each patch, or for each triangle above limits::patches_drawn.
/// Errors: a packed scene that cannot be read; more than limits::triangles_drawn.
Result<VtkSurface> surface_flux(const LocalRun& run);
/// Flux in the air. Requires: the scene has voxels.
VtkVolume volume_flux(const LocalRun& run);

/// Writes patches.vtp and, if the run has voxels, volume.vti. Errors: as write_vtp.
Result<void> write_flux_maps(const std::filesystem::path& folder, const LocalRun& run);

}  // namespace luxodus

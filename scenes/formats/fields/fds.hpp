// Smoke and flames of a fire that FDS (NIST) has computed, at one time: extinction by cell of grids
// that together are its meshes, and where its flames give how much heat. Read from what the case
// has, the most accurate first: cell-centred slices, node slices, PLOT3D, Smoke3D. FDS knows no
// albedo and no phase function: they are the caller's. Errors of sources are measured in
// tests/unit/scenes/formats/fields/fds_reference_test.cpp. Any thread; nothing is kept open.
//
// Formats: fds_case.hpp (index), fds_frames.hpp (records), fds_cells.hpp (values). Design:
// docs/decisions/0036-fire-simulations.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

class ReadingShare;

/// From what files extinction is taken; in the order of preference.
enum class FireSource {
  cell_extinction,  // 3-D cell-centred slice, 1/m
  cell_soot,        // 3-D cell-centred slice of soot density, kg/m3
  node_extinction,  // 3-D slice of nodes, 1/m
  node_soot,        // 3-D slice of nodes of soot density
  plot3d,           // PLOT3D, extinction or soot density
  smoke3d,          // Smoke3D, bytes of soot density
};

struct FireOptions {
  double at_s = 0;
  /// Those that may be taken; all where empty. Taken is the first, in the order of preference, with
  /// a frame within fire_window_s of `at_s`; else the one with the nearest frame. Between frames:
  /// the first with both frames around the time within fire_window_s, or with a frame at the time;
  /// else the one whose two frames around the time are nearest.
  std::vector<FireSource> sources;
  /// Instead of the one FDS used [m2/kg].
  std::optional<double> mass_extinction_m2_per_kg;
  /// Smoke and flames are linear between the two frames around the time, not those of the nearer.
  /// A time within a hundredth of the way between the two is that of the frame.
  bool between_frames = false;
  /// Flames are read: `emission` of the grids, in kW/m3, and extinction taken out where they are.
  bool flames = false;
  /// Hears how far it is; null where nobody asks.
  ReadingShare* reading = nullptr;
};

/// A better source is preferred if it has a frame so near to the time that is asked for [s]: smoke
/// layers move by centimetres in a second.
inline constexpr double fire_window_s = 1;

struct FireGrid {
  DataSet data;
  glm::dvec3 origin{0};  // low corner, in the coordinates of FDS [m]
  double heat_kw = 0;    // of the fire's heat release, in proportion to what its cells have
};

struct LoadedFire {
  std::vector<FireGrid> grids;
  FireSource source = FireSource::cell_extinction;
  double time_s = 0;               // of the frame, or between two
  double first_s = 0, last_s = 0;  // of the source's frames
  size_t frames = 0;               // that all meshes have
  /// Of the frames before and after the one at time_s; or of those that time_s lies between.
  std::optional<double> previous_s, next_s;
  bool between_frames = false;
  std::vector<Bounds> meshes;         // in the coordinates of FDS
  uint64_t cells = 0;                 // of all meshes
  size_t resampled_meshes = 0;        // stretched ones
  bool overlapping = false;           // meshes that do, in cells with smoke
  double heat_release_kw = 0;         // of the whole fire, where flames are read
  bool has_heat_release = false;      // the case has HRRPUV at this time
  double flame_extinction_share = 0;  // of the integral of extinction, taken out in flames
  std::string version;                // of FDS
};

/// Reads the frame nearest to the time that is asked for, or what lies between two.
/// Errors, with the file and for the index the line: what fds_case.hpp and fds_frames.hpp say; no
/// source that covers all meshes; a time beyond the results; values that are negative or no
/// numbers, with their cell; soot that is zero in all frames; flames without HRRPUV or _hrr.csv.
Result<LoadedFire> read_fire(const std::filesystem::path& index, const FireOptions& options);

/// What the source is, for people, and how far it is from cell-centred values.
const char* source_words(FireSource source);
const char* accuracy_words(FireSource source);
/// The largest relative difference of optical depths from those of FDS's cells in the reference
/// cases; 0 of cells.
double largest_depth_error(FireSource source);

}  // namespace luxodus

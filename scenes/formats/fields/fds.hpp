// Smoke and flames of a fire that FDS (NIST) has computed, at one time: extinction by cell, summed
// over all species that absorb light, on grids that together cover its meshes, and the heat release
// of its flames. It reads the most accurate source of the case: cell-centred slices, node slices,
// PLOT3D, Smoke3D. FDS knows no
// albedo and no phase function: the caller adds them. Errors of sources are measured in
// tests/unit/scenes/formats/fields/fds_reference_test.cpp. Any thread; no file is kept open.
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

/// The files that extinction is read from, in order of preference.
enum class FireSource {
  cell_extinction,  // 3-D cell-centred slice, 1/m
  cell_soot,        // 3-D cell-centred slice of a species' density, kg/m3
  node_extinction,  // 3-D slice of nodes, 1/m
  node_soot,        // 3-D slice of nodes of a species' density
  plot3d,           // PLOT3D, extinction or density
  smoke3d,          // Smoke3D, bytes of density
};

struct FireOptions {
  double at_s = 0;
  /// Allowed sources; all where empty. Used is the first, in order of preference, with a frame
  /// within fire_window_s of `at_s`; else the one with the nearest frame. Between frames: the first
  /// with both frames around the time within fire_window_s, or with a frame at the time; else the
  /// one whose two frames around the time are nearest. A species that the source lacks is read from
  /// the best other one.
  std::vector<FireSource> sources;
  /// Replaces the coefficient that FDS used for the only species that absorbs light [m2/kg].
  std::optional<double> mass_extinction_m2_per_kg;
  /// Interpolate smoke and flames linearly between the two frames around the time, instead of
  /// taking the nearer frame. A time within a hundredth of the interval from a frame is that of the
  /// frame.
  bool between_frames = false;
  /// Read flames: `emission` of the grids, in kW/m3; extinction is removed where they burn.
  bool flames = false;
  /// Receives the progress; null for none.
  ReadingShare* reading = nullptr;
};

/// A better source is preferred if it has a frame this near to the requested time [s]: smoke layers
/// move by centimetres in a second.
inline constexpr double fire_window_s = 1;

struct FireGrid {
  DataSet data;
  glm::dvec3 origin{0};  // low corner, in the coordinates of FDS [m]
  double heat_kw = 0;    // its share of the fire's heat release, in proportion to its cells'
};

/// What bytes of Smoke3D stand for.
enum class SmokeBytes { none, opacity, density };

/// A species that absorbs light, and where its extinction is read from.
struct FireSmoke {
  std::string species;
  FireSource source = FireSource::cell_extinction;
  SmokeBytes bytes = SmokeBytes::none;
  std::string formula;  // "density x 8700 m2/kg"
};

struct LoadedFire {
  std::vector<FireGrid> grids;
  std::vector<FireSmoke> smokes;   // one or more
  double time_s = 0;               // of the frame, or between two
  double first_s = 0, last_s = 0;  // of the source's frames
  size_t frames = 0;               // that all meshes have
  size_t partial_frames = 0;       // between the first and the last, that not all meshes have
  /// Times of the frames before and after the one at time_s, or of the two around time_s.
  std::optional<double> previous_s, next_s;
  bool between_frames = false;
  std::vector<Bounds> meshes;         // in the coordinates of FDS
  uint64_t cells = 0;                 // of all meshes
  size_t resampled_meshes = 0;        // stretched ones whose cells nest in no even cells
  bool overlapping = false;           // two meshes overlap in cells with smoke
  double heat_release_kw = 0;         // of the whole fire, if flames are read
  bool has_heat_release = false;      // the case has HRRPUV at this time
  double flame_extinction_share = 0;  // share of the integral of extinction that was removed in
                                      // flames
  std::string version;                // of FDS
  std::vector<std::string> notes;     // what the user should know: times that go back
};

/// Reads the frame nearest to the requested time, or interpolates between two.
/// Errors, with the file and for the index the line: those of fds_case.hpp and fds_frames.hpp; no
/// source that covers all meshes, for each species that absorbs light; a time beyond the results,
/// or farther from all frames than these usually are from each other; negative or undefined values,
/// with their cell; smoke that is zero in all frames; flames without HRRPUV or _hrr.csv.
Result<LoadedFire> read_fire(const std::filesystem::path& index, const FireOptions& options);

/// A time within the frames of smoke of a case: `at_s`, or the first or last frame where these do
/// not reach it; nothing where the case has no smoke that can be read.
std::optional<double> fire_time_near(const std::filesystem::path& index, double at_s);

/// Describes sources for users, and their deviation from cell-centred values.
const char* source_words(FireSource source);
std::string sources_words(const LoadedFire& fire);
std::string accuracy_words(const LoadedFire& fire);
/// The largest relative difference of optical depths from those of FDS's cells in the reference
/// cases; 0 for cell-centred sources.
double largest_depth_error(const LoadedFire& fire);

}  // namespace luxodus

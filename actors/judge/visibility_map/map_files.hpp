// The files of a visibility map: for pyFDS-Evac, for NumPy, for programs that read VTK, and as a
// table. Formats: docs/reference/results.md. One thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "actors/judge/visibility_map/evac_signs.hpp"
#include "actors/judge/visibility_map/visibility_map.hpp"

namespace luxodus {

/// Names of files and folders that write_map writes, without those of single states.
inline constexpr const char* evac_map_file = "visibility.npz";
inline constexpr const char* whole_map_file = "visibility_all.npz";
inline constexpr const char* map_table_file = "visibility.csv";
inline constexpr const char* map_states_folder = "visibility";

/// What a program that looks up the nearest place and time may be told without being told too much:
/// a border of false around the map, undecided is false, and between two times what holds at both.
struct EvacTable {
  std::vector<double> times_s, x_m, y_m;  // ascending
  std::vector<char> read, seen;           // [time][sign][y][x]
};
/// For the signs of another program, at one eye height.
EvacTable evac_table(const VisibilityMap& map, size_t height, const std::vector<EvacSign>& signs);

/// Errors: as write_file_atomically.
Result<void> write_map(const std::filesystem::path& folder, const VisibilityMap& map,
                       const std::vector<EvacSign>& signs, const Json& meta);

}  // namespace luxodus

// Trajectories of people, read from the files of evacuation programs and of experiments: SQLite of
// JuPedSim (versions 2 and 3), HDF5 of JuPedSim and of the data archive of pedestrian dynamics,
// text of PeTrack and of that archive, CSV and JSON of Pathfinder. The content decides the form,
// not the name. Coordinates are those of the file, in metres; nothing is moved or interpolated.
// Files of HDF5 are read by a process of its own. Plain values; any thread. Which program writes
// what, and why z is not always a height: docs/decisions/0094-people-who-walk.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Size of a file of trajectories [bytes]; it is held in memory while it is read.
inline constexpr uint64_t trajectory_file_bytes = uint64_t{1} << 30;
/// Places of all people together. Each takes 56 bytes while rows are ordered, and of HDF5 40 more;
/// then 32, or 48 with a direction.
inline constexpr size_t trajectory_rows = 10'000'000;
inline constexpr size_t trajectory_people = 100'000;
/// Frames per second.
inline constexpr double trajectory_fps = 1000;
/// Largest coordinate [m] and time [s].
inline constexpr double trajectory_m = 1e7, trajectory_s = 1e7;
/// Length of a text or row in SQLite [bytes].
inline constexpr size_t trajectory_text_bytes = size_t{16} << 20;
}  // namespace limits

/// One person's way.
struct Trajectory {
  int64_t id = 0;
  std::vector<double> times_s;     // ascending, at least one
  std::vector<glm::dvec3> places;  // one for each time [m]; z is 0 where the file has no heights
  /// Directions in which the person looks, of unit length, one for each time; empty: not given.
  std::vector<glm::dvec2> facing;
};

struct Trajectories {
  std::string form;                // "SQLite of JuPedSim, version 2"
  bool has_heights = false;        // z is the height of the floor under the person
  std::optional<double> fps;       // frames per second; none where the file states times
  std::vector<Trajectory> people;  // by ascending id, at least one
};

/// Errors: the file cannot be read; an unknown form or version; an unknown unit or rate of frames;
/// a value that is no number, or beyond the limits; a person who is twice at the same time, or, in
/// text and CSV, whose times do not ascend; nobody in the file; more than the limits.
Result<Trajectories> read_trajectories(const std::filesystem::path& file);

/// Reads the content of a file. `file` names it in messages; HDF5 is read from there, and needs no
/// more of `bytes` than its first eight.
Result<Trajectories> trajectories_of(std::string_view bytes, const std::filesystem::path& file);

}  // namespace luxodus

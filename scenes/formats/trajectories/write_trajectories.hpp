// Trajectories of people as JuPedSim writes them: SQLite, version 2, with the tables
// trajectory_data, metadata, geometry and frame_data. read_trajectories reads them back. Plain
// values; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Rows of a written file; it is made in memory, with some 100 bytes for each.
inline constexpr size_t written_rows = 5'000'000;
}  // namespace limits

/// Where a person is in a frame, and the unit direction of view; 0: not known.
struct WrittenPlace {
  int64_t frame = 0, id = 0;
  glm::dvec2 place{0}, facing{0};
};

struct WrittenTrajectories {
  int fps = 10;                // frames per second; the time of a frame is frame / fps
  glm::dvec2 low{0}, high{0};  // box around all places [m], written as the geometry, too
  std::vector<std::pair<std::string, std::string>> metadata;  // further keys, each once
  std::vector<WrittenPlace> places;                           // each frame and person once
};

/// The bytes of the file. Errors: more rows than limits::written_rows; what SQLite says.
Result<std::vector<std::byte>> jupedsim_bytes(const WrittenTrajectories& trajectories);

/// Writes the file; it appears only when it is complete. Errors: as jupedsim_bytes and
/// write_file_atomically.
Result<void> write_trajectories(const std::filesystem::path& file,
                                const WrittenTrajectories& trajectories);

}  // namespace luxodus

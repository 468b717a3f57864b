// Reads files of results of a fire simulation, frame by frame: Fortran records (length, payload,
// length; little-endian, 32 bits), read at their offsets, so that only one frame of one mesh is in
// memory. A frame that is cut off at the end of a file belongs to a run in progress and is ignored.
// Each object is for one thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/core/regular_file.hpp"
#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

namespace limits {
/// FDS writes 1000 frames unless told otherwise.
inline constexpr size_t frames = 1'000'000;
}  // namespace limits

struct Frame {
  double time_s = 0;
  uint64_t offset = 0;  // of the payload
  uint32_t bytes = 0;
  uint32_t file = 0;  // index in FrameFiles::files
};

/// One quantity of one mesh: its files, and the offsets of their whole frames. It holds no file
/// open, because a case has more meshes than a process may have open files.
struct FrameFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Frame> frames;
};

/// Errors, with the file: it does not exist, lies outside the folder of the case (links are
/// followed), is of another kind or another mesh, or is damaged before its end.
Result<FrameFiles> open_slice(const Case& fire, const Slice& slice);
Result<FrameFiles> open_smoke3d(const Case& fire, const Smoke3d& smoke);
/// Opens a PLOT3D file, which has one frame; none where the file is cut off. `quantity`: 0 to 4.
Result<FrameFiles> open_plot3d(const Case& fire, const Plot3d& plot, size_t quantity);

/// Whether `path`, and all targets of links on its way, lie within the folder of the case.
bool lies_within(const Case& fire, const std::filesystem::path& path);

/// Values of a frame of a slice or a PLOT3D file, x fastest, as stored.
Result<std::vector<float>> read_values(const FrameFiles& files, const Frame& frame);
/// Bytes of the nodes of a Smoke3D frame, x fastest. Requires: `nodes` is that of its mesh.
Result<std::vector<uint8_t>> read_bytes(const FrameFiles& files, const Frame& frame, size_t nodes);

}  // namespace luxodus::fds

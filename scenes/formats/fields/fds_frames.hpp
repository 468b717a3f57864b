// Reads files of results of a fire simulation, frame by frame: Fortran records (length, payload,
// length; little-endian, 32 bits), read at their offsets, so that only one frame of one mesh is in
// memory. A frame that is cut off at the end of a file belongs to a run in progress and is ignored.
// Each object is for one thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/regular_file.hpp"
#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

namespace limits {
/// FDS writes 1000 frames unless told otherwise.
inline constexpr size_t frames = 1'000'000;
}  // namespace limits

/// Frames of one tick of FDS have the same time in all files, except for the digits of PLOT3D's
/// names [s]. A restart may write a tick twice.
inline constexpr double same_tick_s = 0.006;

struct Frame {
  double time_s = 0;
  uint64_t offset = 0;  // of the payload
  uint32_t bytes = 0;
  uint32_t file = 0;   // index in FrameFiles::files
  double highest = 0;  // of Smoke3D by densities: the value of byte 254
};

/// A place in a file where times go back or repeat [s].
struct BackStep {
  double from_s = 0, to_s = 0;
};

/// How the bytes of a Smoke3D file stand for the density rho of a species: word 2 of its header.
enum class SmokeFormat {
  opacity = 0,  // up to FDS 6.10: 254 (1 - exp(-mass extinction x rho x dx)), dx the first along x
  density = 1,  // from FDS 6.11 on: 254 rho / the highest of the frame, which FILE.sz has
};

/// One quantity of one mesh: its files, and the offsets of their whole frames, in ascending order
/// of time. It holds no file open, because a case has more meshes than a process may have open
/// files.
struct FrameFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Frame> frames;
  std::optional<BackStep> back;  // the first in these files
  SmokeFormat format = SmokeFormat::opacity;
};

/// Drops the frames that a restart made void: where times go back or repeat, later frames hold. FDS
/// appends those of a restarted run behind those of the part that was abandoned.
void keep_later_frames(FrameFiles& files);

/// Errors, with the file: it does not exist, lies outside the folder of the case (links are
/// followed), is of another kind or another mesh, or is damaged before its end.
Result<FrameFiles> open_slice(const Case& fire, const Slice& slice);
/// Errors, in addition: another format than those of SmokeFormat; a file of sizes (.sz) that is not
/// there or does not go with the frames.
Result<FrameFiles> open_smoke3d(const Case& fire, const Smoke3d& smoke);
/// Opens a PLOT3D file, which has one frame; none where the file is cut off. `quantity`: 0 to 4.
Result<FrameFiles> open_plot3d(const Case& fire, const Plot3d& plot, size_t quantity);

/// Whether `path`, and all targets of links on its way, lie within the folder of the case.
bool lies_within(const Case& fire, const std::filesystem::path& path);

/// The text of a file. Errors: as read_regular_file; it lies outside the folder of the case.
Result<std::string> read_text_within(const Case& fire, const std::filesystem::path& path,
                                     uint64_t max_bytes);

/// Values of a frame of a slice or a PLOT3D file, x fastest, as stored.
Result<std::vector<float>> read_values(const FrameFiles& files, const Frame& frame);
/// Bytes of the nodes of a Smoke3D frame, x fastest. Requires: `nodes` is that of its mesh.
Result<std::vector<uint8_t>> read_bytes(const FrameFiles& files, const Frame& frame, size_t nodes);

}  // namespace luxodus::fds

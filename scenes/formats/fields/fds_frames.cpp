// Walks over records. No length is used before the file is known to hold that many bytes, and both
// length marks of a record must agree.
#include "scenes/formats/fields/fds_frames.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>

#include "scenes/formats/fields/fds_sizes.hpp"

namespace luxodus::fds {

namespace {

namespace fs = std::filesystem;

constexpr uint64_t mark_bytes = 4;
/// Bytes of a slice's label, short label and unit.
constexpr uint32_t label_bytes = 30;
constexpr uint32_t slice_head_bytes = 24, smoke_head_bytes = 32;
constexpr uint32_t time_bytes = 4, counts_bytes = 8;
/// The byte that begins a run; values are smaller.
constexpr uint8_t run_byte = 255;
/// Walks a file of results, record by record.
class RecordWalk {
 public:
  static Result<RecordWalk> open(const Case& fire, const fs::path& path) {
    if (!lies_within(fire, path))
      return problem_in(path.string(),
                        "this file is not in the folder of its index: results are read from there "
                        "alone");
    auto file = open_regular_file(path);
    if (!file) return file.problem();
    return RecordWalk(path, std::move(file.value()));
  }

  const fs::path& path() const { return path_; }
  uint64_t left() const { return bytes_ - at_; }
  uint64_t at() const { return at_; }
  bool has(uint64_t payload) const { return left() >= payload + 2 * mark_bytes; }

  Problem damage(const std::string& what) const {
    return problem_in(path_.string(), fmt::format("{}, at byte {}: the file is damaged, or of "
                                                  "another kind",
                                                  what, at_));
  }

  /// The payload of the next record, which must have this size. Requires: has(out.size()).
  Result<void> take(std::span<char> out) {
    std::vector<char> whole(out.size() + 2 * mark_bytes);
    if (auto ok = read(at_, whole); !ok) return ok;
    uint32_t before = 0, after = 0;
    std::memcpy(&before, whole.data(), mark_bytes);
    std::memcpy(&after, whole.data() + mark_bytes + out.size(), mark_bytes);
    if (before != out.size() || after != out.size())
      return damage(fmt::format("a record of {} bytes was expected", out.size()));
    std::copy_n(whole.data() + mark_bytes, out.size(), out.data());
    at_ += whole.size();
    return {};
  }

  template <class T, size_t N>
  Result<std::array<T, N>> numbers() {
    std::array<char, N * sizeof(T)> bytes;
    if (!has(bytes.size())) return damage("the file ends too early");
    if (auto ok = take(bytes); !ok) return ok.problem();
    std::array<T, N> out;
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  /// Skips a record of this size by its marks. Requires: has(payload).
  Result<void> pass(uint64_t payload) {
    uint32_t before = 0, after = 0;
    if (auto ok = read(at_, std::span(reinterpret_cast<char*>(&before), mark_bytes)); !ok)
      return ok;
    if (auto ok = read(at_ + mark_bytes + payload,
                       std::span(reinterpret_cast<char*>(&after), mark_bytes));
        !ok)
      return ok;
    if (before != payload || after != payload)
      return damage(fmt::format("a record of {} bytes was expected", payload));
    at_ += payload + 2 * mark_bytes;
    return {};
  }

  FrameFiles into(std::vector<Frame> frames) && {
    FrameFiles out;
    out.files = {path_};
    out.frames = std::move(frames);
    return out;
  }

 private:
  RecordWalk(fs::path path, RegularFile file)
      : path_(std::move(path)), descriptor_(std::move(file.descriptor)), bytes_(file.bytes) {}

  Result<void> read(uint64_t offset, std::span<char> out) const;

  fs::path path_;
  FileDescriptor descriptor_;
  uint64_t bytes_;
  uint64_t at_ = 0;
};

/// Reads exactly these bytes of a file.
Result<void> read_at(const fs::path& path, const FileDescriptor& file, uint64_t offset,
                     std::span<char> out) {
  size_t done = 0;
  while (done < out.size()) {
    const ssize_t n = ::pread(file.number(), out.data() + done, out.size() - done,
                              static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return system_problem(path.string(), "this file cannot be read", errno);
    if (n == 0) return problem_in(path.string(), "this file has become shorter while it was read");
    done += static_cast<size_t>(n);
  }
  return {};
}

Result<void> RecordWalk::read(uint64_t offset, std::span<char> out) const {
  return read_at(path_, descriptor_, offset, out);
}

Result<void> read_frame(const FrameFiles& files, const Frame& frame, std::span<char> out) {
  const fs::path& path = files.files[frame.file];
  const auto file = open_regular_file(path);
  if (!file) return file.problem();
  return read_at(path, file->descriptor, frame.offset, out);
}

Result<double> time_of(RecordWalk& walk) {
  const auto time = walk.numbers<float, 1>();
  if (!time) return time.problem();
  const auto seconds = static_cast<double>(time.value()[0]);
  if (!std::isfinite(seconds)) return walk.damage("a time is not finite");
  return seconds;
}

/// Frames that each have a time and a payload of one size, up to the last whole one.
Result<std::vector<Frame>> even_frames(RecordWalk& walk, uint64_t payload) {
  std::vector<Frame> frames;
  const uint64_t frame_bytes = time_bytes + payload + 4 * mark_bytes;
  while (walk.left() >= frame_bytes && frames.size() < limits::frames) {
    const auto time = time_of(walk);
    if (!time) return time.problem();
    frames.push_back({time.value(), walk.at() + mark_bytes, static_cast<uint32_t>(payload)});
    if (auto ok = walk.pass(payload); !ok) return ok.problem();
  }
  return frames;
}

/// The format of a Smoke3D file, by its header.
Result<SmokeFormat> format_of(const RecordWalk& walk, int32_t word) {
  for (const SmokeFormat known : {SmokeFormat::opacity, SmokeFormat::density})
    if (word == static_cast<int32_t>(known)) return known;
  return problem_in(
      walk.path().string(),
      fmt::format("this is Smoke3D of format {}, and what its bytes mean is known of 0 and 1 only: "
                  "take slices (&SLCF ... CELL_CENTERED=T)",
                  word));
}

}  // namespace

void keep_later_frames(FrameFiles& files) {
  std::vector<Frame> kept;
  kept.reserve(files.frames.size());
  for (const Frame& frame : files.frames) {
    if (!kept.empty() && frame.time_s <= kept.back().time_s) {
      if (!files.back) files.back = BackStep{kept.back().time_s, frame.time_s};
      // The abandoned part may have written the same tick a little earlier.
      while (!kept.empty() && kept.back().time_s >= frame.time_s - same_tick_s) kept.pop_back();
    }
    kept.push_back(frame);
  }
  files.frames = std::move(kept);
}

bool lies_within(const Case& fire, const fs::path& path) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path outer = fs::weakly_canonical(fire.folder.empty() ? "." : fire.folder, error);
  if (error) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

Result<std::string> read_text_within(const Case& fire, const fs::path& path, uint64_t max_bytes) {
  if (!lies_within(fire, path))
    return problem_in(path.string(), "this file is not in the folder of its index");
  return read_regular_file(path, max_bytes);
}

Result<FrameFiles> open_slice(const Case& fire, const Slice& slice) {
  auto walk = RecordWalk::open(fire, slice.file);
  if (!walk) return walk.problem();
  for (int i = 0; i < 3; ++i)
    if (auto label = walk->numbers<char, label_bytes>(); !label) return label.problem();
  const auto range = walk->numbers<int32_t, slice_head_bytes / 4>();
  if (!range) return range.problem();
  const auto& r = range.value();
  for (int axis = 0; axis < 3; ++axis)
    if (r[static_cast<size_t>(2 * axis)] != slice.nodes.low[axis] ||
        r[static_cast<size_t>(2 * axis) + 1] != slice.nodes.high[axis])
      return problem_in(
          slice.file.string(),
          fmt::format("this slice is not the one that line {} of the index says", slice.line));
  const glm::ivec3 n = slice.nodes.high - slice.nodes.low + 1;
  const uint64_t values =
      static_cast<uint64_t>(n.x) * static_cast<uint64_t>(n.y) * static_cast<uint64_t>(n.z);
  auto frames = even_frames(walk.value(), values * sizeof(float));
  if (!frames) return frames.problem();
  FrameFiles out = std::move(walk.value()).into(std::move(frames.value()));
  keep_later_frames(out);
  return out;
}

Result<FrameFiles> open_smoke3d(const Case& fire, const Smoke3d& smoke) {
  auto walk = RecordWalk::open(fire, smoke.file);
  if (!walk) return walk.problem();
  const auto head = walk->numbers<int32_t, smoke_head_bytes / 4>();
  if (!head) return head.problem();
  const Mesh& mesh = fire.meshes[smoke.mesh];
  const auto& h = head.value();
  if (h[3] != mesh.cells.x || h[5] != mesh.cells.y || h[7] != mesh.cells.z)
    return problem_in(
        smoke.file.string(),
        fmt::format("this file is of a mesh of {} x {} x {} cells, mesh {} has {} x "
                    "{} x {}",
                    h[3], h[5], h[7], smoke.mesh + 1, mesh.cells.x, mesh.cells.y, mesh.cells.z));
  const auto format = format_of(walk.value(), h[1]);
  if (!format) return format.problem();
  const size_t nodes = mesh.node_count();
  constexpr uint64_t frame_head = time_bytes + counts_bytes + 4 * mark_bytes;
  std::vector<Frame> frames;
  while (walk->left() >= frame_head && frames.size() < limits::frames) {
    const auto time = time_of(walk.value());
    if (!time) return time.problem();
    const auto counts = walk->numbers<int32_t, 2>();
    if (!counts) return counts.problem();
    const auto [all, packed] = counts.value();
    // A run takes 3 bytes and stands for 4 values or more; every other byte for itself.
    if (all < 0 || static_cast<size_t>(all) != nodes || packed < 0 ||
        static_cast<uint64_t>(packed) > 3 * static_cast<uint64_t>(nodes))
      return walk->damage(fmt::format("a frame of {} values in {} bytes, of a mesh of {} nodes",
                                      all, packed, nodes));
    if (!walk->has(static_cast<uint64_t>(packed))) break;
    frames.push_back({time.value(), walk->at() + mark_bytes, static_cast<uint32_t>(packed)});
    if (auto ok = walk->pass(static_cast<uint64_t>(packed)); !ok) return ok.problem();
  }
  FrameFiles out = std::move(walk.value()).into(std::move(frames));
  out.format = format.value();
  keep_later_frames(out);
  if (out.format == SmokeFormat::density)
    if (auto ok = add_highest_values(fire, out); !ok) return ok.problem();
  return out;
}

Result<FrameFiles> open_plot3d(const Case& fire, const Plot3d& plot, size_t quantity) {
  auto walk = RecordWalk::open(fire, plot.file);
  if (!walk) return walk.problem();
  const Mesh& mesh = fire.meshes[plot.mesh];
  const uint64_t values = mesh.node_count() * sizeof(float);
  const auto counts = walk->numbers<int32_t, 3>();
  if (!counts) return counts.problem();
  const glm::ivec3 n = mesh.node_counts();
  if (const auto& c = counts.value(); c[0] != n.x || c[1] != n.y || c[2] != n.z)
    return problem_in(plot.file.string(),
                      fmt::format("this file has {} x {} x {} nodes, mesh {} has {} x {} x {}",
                                  c[0], c[1], c[2], plot.mesh + 1, n.x, n.y, n.z));
  if (const auto constants = walk->numbers<float, 4>(); !constants) return constants.problem();
  std::vector<Frame> frames;
  if (walk->has(5 * values)) {
    frames.push_back(
        {plot.time_s, walk->at() + mark_bytes + quantity * values, static_cast<uint32_t>(values)});
    if (auto ok = walk->pass(5 * values); !ok) return ok.problem();
  }
  return std::move(walk.value()).into(std::move(frames));
}

Result<std::vector<float>> read_values(const FrameFiles& files, const Frame& frame) {
  std::vector<float> values(frame.bytes / sizeof(float));
  const std::span bytes(reinterpret_cast<char*>(values.data()), values.size() * sizeof(float));
  if (auto ok = read_frame(files, frame, bytes); !ok) return ok.problem();
  return values;
}

Result<std::vector<uint8_t>> read_bytes(const FrameFiles& files, const Frame& frame, size_t nodes) {
  std::vector<uint8_t> packed(frame.bytes);
  const std::span bytes(reinterpret_cast<char*>(packed.data()), packed.size());
  if (auto ok = read_frame(files, frame, bytes); !ok) return ok.problem();
  std::vector<uint8_t> out;
  out.reserve(nodes);
  const auto damaged = [&] {
    return problem_in(files.files[frame.file].string(),
                      fmt::format("the frame at {:g} s does not unpack to {} values: the file is "
                                  "damaged",
                                  frame.time_s, nodes));
  };
  for (size_t i = 0; i < packed.size(); ++i) {
    if (packed[i] != run_byte) {
      if (out.size() == nodes) return damaged();
      out.push_back(packed[i]);
      continue;
    }
    if (packed.size() - i < 3) return damaged();
    const size_t length = packed[i + 2];
    if (packed[i + 1] == run_byte || length > nodes - out.size()) return damaged();
    out.insert(out.end(), length, packed[i + 1]);
    i += 2;
  }
  if (out.size() != nodes) return damaged();
  return out;
}

}  // namespace luxodus::fds

#include "scenes/formats/fields/fds_visibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus {

namespace {

/// Nodes low to high of a mesh along an axis; a flat slice of cells lies in the middle of its cell.
std::vector<double> nodes_along(const fds::Mesh& mesh, const fds::Slice& slice, int axis) {
  const std::vector<double>& all = mesh.nodes[static_cast<size_t>(axis)];
  const auto low = static_cast<size_t>(slice.nodes.low[axis]);
  const auto high = static_cast<size_t>(slice.nodes.high[axis]);
  if (low == high && slice.of_cells && low > 0) return {(all[low - 1] + all[low]) / 2};
  return {all.begin() + static_cast<std::ptrdiff_t>(low),
          all.begin() + static_cast<std::ptrdiff_t>(high) + 1};
}

bool lies_in(const fds::Mesh& mesh, const fds::Slice& slice) {
  return glm::all(glm::greaterThanEqual(slice.nodes.low, glm::ivec3(0))) &&
         glm::all(glm::lessThanEqual(slice.nodes.low, slice.nodes.high)) &&
         glm::all(glm::lessThanEqual(slice.nodes.high, mesh.cells));
}

const fds::Frame* frame_near(const fds::FrameFiles& files, double time_s) {
  const auto at = std::min_element(
      files.frames.begin(), files.frames.end(), [&](const fds::Frame& a, const fds::Frame& b) {
        return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
      });
  return at != files.frames.end() && std::abs(at->time_s - time_s) <= fire_window_s ? &*at
                                                                                    : nullptr;
}

/// The interval of ascending nodes that holds a coordinate, and the share of the interval below it.
std::pair<size_t, double> interval(const std::vector<double>& nodes, double at) {
  if (nodes.size() < 2) return {0, 0};
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), at);
  const auto i = static_cast<size_t>(std::clamp<std::ptrdiff_t>(
      next - nodes.begin() - 1, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 2));
  return {i, std::clamp((at - nodes[i]) / (nodes[i + 1] - nodes[i]), 0.0, 1.0)};
}

}  // namespace

std::optional<double> FireVisibility::Sheet::distance(const glm::dvec3& place) const {
  double out = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& along = nodes[static_cast<size_t>(axis)];
    const double off = std::max({along.front() - place[axis], place[axis] - along.back(), 0.0});
    if (along.size() > 1 ? off > 0 : off > visibility_reach_m) return std::nullopt;
    out = std::max(out, off);
  }
  return out;
}

double FireVisibility::Sheet::value(const glm::dvec3& place) const {
  std::array<size_t, 3> first{};
  std::array<double, 3> share{};
  for (size_t axis = 0; axis < 3; ++axis) {
    std::tie(first[axis], share[axis]) = interval(nodes[axis], place[static_cast<int>(axis)]);
    // The value of a cell is stored at the node above; the first plane is a ghost.
    if (of_cells) share[axis] = counts[axis] > 1 ? 1 : 0;
  }
  double sum = 0;
  for (size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<size_t, 3> at{};
    for (size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis & 1) != 0;
      weight *= upper ? share[axis] : 1 - share[axis];
      at[axis] = std::min(first[axis] + (upper ? 1 : 0), counts[axis] - 1);
    }
    if (weight > 0)
      sum += weight * static_cast<double>(values[(at[2] * counts[1] + at[1]) * counts[0] + at[0]]);
  }
  return sum;
}

std::optional<double> FireVisibility::at(const glm::dvec3& place) const {
  const Sheet* nearest = nullptr;
  double least = 0;
  for (const Sheet& sheet : sheets_)
    if (const auto far = sheet.distance(place); far && (nearest == nullptr || *far < least)) {
      nearest = &sheet;
      least = *far;
    }
  return nearest != nullptr ? std::optional(nearest->value(place)) : std::nullopt;
}

Result<std::optional<FireVisibility>> read_visibility(const std::filesystem::path& index,
                                                      double time_s) {
  const auto fire = fds::read_case(index);
  if (!fire) return fire.problem();
  FireVisibility out;
  uint64_t all = 0;
  for (const fds::Slice& slice : fire->visibility) {
    const fds::Mesh& mesh = fire->meshes[slice.mesh];
    if (!lies_in(mesh, slice))
      return problem_in(fire->file, slice.line, "this slice does not lie in its mesh");
    const glm::ivec3 n = slice.nodes.high - slice.nodes.low + 1;
    all += static_cast<uint64_t>(n.x) * static_cast<uint64_t>(n.y) * static_cast<uint64_t>(n.z);
    if (all > limits::visibility_values)
      return problem_in(fire->file, slice.line,
                        fmt::format("slices of VISIBILITY have more than {} values at a time",
                                    limits::visibility_values));
    const auto files = fds::open_slice(fire.value(), slice);
    if (!files) return files.problem();
    const fds::Frame* frame = frame_near(files.value(), time_s);
    if (frame == nullptr) continue;
    auto values = fds::read_values(files.value(), *frame);
    if (!values) return values.problem();
    if (!std::all_of(values->begin(), values->end(), [](float v) { return v >= 0 && v < 1e9F; }))
      return problem_in(slice.file.string(), "a visibility is negative or no number");
    FireVisibility::Sheet& sheet = out.sheets_.emplace_back();
    sheet.of_cells = slice.of_cells;
    sheet.values = std::move(values).value();
    for (int axis = 0; axis < 3; ++axis) {
      sheet.nodes[static_cast<size_t>(axis)] = nodes_along(mesh, slice, axis);
      sheet.counts[static_cast<size_t>(axis)] = static_cast<size_t>(n[axis]);
    }
  }
  if (out.sheets_.empty()) return std::optional<FireVisibility>();
  return std::optional(std::move(out));
}

}  // namespace luxodus

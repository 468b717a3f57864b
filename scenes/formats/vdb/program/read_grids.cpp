// The job of luxodus_vdb: lists the grids of an OpenVDB file, and resamples one to even cells. It
// has limits on memory and time (isolated_job.hpp): a crash of the library on a damaged file ends
// only this process.
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/formats/vdb/program/file_watch.hpp"
#include "scenes/formats/vdb/vdb_answer.hpp"

namespace luxodus::vdb {
namespace {

using openvdb::FloatGrid;
using openvdb::GridBase;

/// Cells along an axis, in 64 bits: corners may be as far apart as indices go.
int64_t cells_along(const openvdb::CoordBBox& box, int axis) {
  return int64_t{box.max()[axis]} - int64_t{box.min()[axis]} + 1;
}

std::string sizes_text(const openvdb::CoordBBox& box) {
  return std::to_string(cells_along(box, 0)) + " x " + std::to_string(cells_along(box, 1)) + " x " +
         std::to_string(cells_along(box, 2));
}

/// Edges of a cell and the place of index 0, if the axes of the grid are those of the file's space;
/// nothing where they are rotated, mirrored or nonlinear.
struct Place {
  openvdb::Vec3d spacing, origin;
};

std::optional<Place> place_of(const GridBase& grid) {
  const openvdb::math::Transform& transform = grid.transform();
  if (!transform.isLinear()) return std::nullopt;
  const openvdb::Mat4R m = transform.baseMap()->getAffineMap()->getMat4();  // for row vectors
  Place place;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double value = m(row, column);
      if (row == column && !(value > 0 && std::isfinite(value))) return std::nullopt;
      if (row != column && std::abs(value) > 1e-9 * std::abs(m(row, row))) return std::nullopt;
    }
  for (int axis = 0; axis < 3; ++axis) {
    place.spacing[axis] = m(axis, axis);
    place.origin[axis] = m(3, axis);
    if (!std::isfinite(place.origin[axis])) return std::nullopt;
  }
  return place;
}

/// Why a grid is not read, by its metadata; "" where it is.
std::string fault_of(const GridBase& grid) {
  if (grid.valueType() != "float")
    return "its values are \"" + excerpt(grid.valueType()) + "\"; floats are read";
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
    return "it is a level set, the distance to a surface; a fog volume is read: convert it";
  if (!place_of(grid))
    return "its axes are turned, mirrored or bent (a frustum); resample it along x, y and z";
  return {};
}

std::string kind_of(const GridBase& grid) {
  return GridBase::gridClassToString(grid.getGridClass());
}

void answer_list(openvdb::io::File& file, PlainWriter& out) {
  std::vector<VdbGrid> grids;
  for (auto name = file.beginName(); name != file.endName(); ++name) {
    if (grids.size() >= limits::vdb_grids)
      throw std::runtime_error("more than " + std::to_string(limits::vdb_grids) + " grids");
    const GridBase::Ptr head = file.readGridMetadata(*name);
    VdbGrid grid{excerpt(*name, 100), excerpt(head->valueType()), kind_of(*head), 0,
                 fault_of(*head)};
    if (const auto count =
            head->getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT))
      grid.cells = static_cast<uint64_t>(std::max<int64_t>(0, count->value()));
    grids.push_back(std::move(grid));
  }
  out.put(uint8_t{1});
  out.put(static_cast<uint64_t>(grids.size()));
  for (const VdbGrid& grid : grids) put(out, grid);
}

/// The box of a grid's values, from the file's metadata where stated: before anything large is
/// read.
openvdb::CoordBBox checked_box(const openvdb::CoordBBox& box) {
  if (box.empty()) throw std::runtime_error("the grid has no values");
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) cells *= static_cast<double>(cells_along(box, axis));
  if (!(cells <= static_cast<double>(limits::vdb_cells)))
    throw std::runtime_error("the box around its values has " + sizes_text(box) +
                             " cells, the most are " + std::to_string(limits::vdb_cells) +
                             ": crop the grid, or resample it to larger cells");
  return box;
}

openvdb::CoordBBox box_of(const FloatGrid& grid) {
  return checked_box(grid.evalActiveVoxelBoundingBox());
}

void check_head(const GridBase& head) {
  if (const std::string fault = fault_of(head); !fault.empty()) throw std::runtime_error(fault);
  using Corner = openvdb::Vec3IMetadata;
  const auto low = head.getMetadata<Corner>(GridBase::META_FILE_BBOX_MIN);
  const auto high = head.getMetadata<Corner>(GridBase::META_FILE_BBOX_MAX);
  if (low && high) checked_box({openvdb::Coord(low->value()), openvdb::Coord(high->value())});
}

/// Share of the work that reading the file is; the rest is copying its cells.
constexpr double read_share = 0.5;

/// Copies the cells of a part of the box, over all of its x and y, to their place in the whole.
void copy_cells(const FloatGrid& grid, const openvdb::CoordBBox& box,
                const openvdb::CoordBBox& part, VdbSmoke& smoke) {
  const size_t begin = smoke.nx * smoke.ny * static_cast<size_t>(part.min().z() - box.min().z());
  const size_t end = begin + smoke.nx * smoke.ny * static_cast<size_t>(part.dim().z());
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(part, &smoke.values[begin]);
  openvdb::tools::copyToDense(grid, dense, true);
  for (size_t i = begin; i < end; ++i) {
    if (smoke.values[i] >= 0 && std::isfinite(smoke.values[i])) continue;
    const auto x = static_cast<int64_t>(i % smoke.nx),
               y = static_cast<int64_t>(i / smoke.nx % smoke.ny),
               z = static_cast<int64_t>(i / smoke.nx / smoke.ny);
    throw std::runtime_error("the value at index (" + std::to_string(box.min().x() + x) + ", " +
                             std::to_string(box.min().y() + y) + ", " +
                             std::to_string(box.min().z() + z) + ") is negative or no number");
  }
}

/// Cells in the file's own axes, x fastest.
VdbSmoke cells_of(const FloatGrid& grid, const Place& place) {
  const openvdb::CoordBBox box = box_of(grid);
  const openvdb::Coord dim = box.dim();
  VdbSmoke smoke;
  smoke.nx = static_cast<uint64_t>(dim.x());
  smoke.ny = static_cast<uint64_t>(dim.y());
  smoke.nz = static_cast<uint64_t>(dim.z());
  smoke.values.resize(smoke.nx * smoke.ny * smoke.nz);
  constexpr int64_t slab = 64;  // cells: done in parts, so that progress is reported
  for (int64_t z = box.min().z(); z <= box.max().z(); z += slab) {
    openvdb::CoordBBox part = box;
    part.min().z() = static_cast<int>(z);
    part.max().z() = static_cast<int>(std::min<int64_t>(z + slab - 1, box.max().z()));
    copy_cells(grid, box, part, smoke);
    tell_share(read_share + (1 - read_share) * (part.max().z() - box.min().z() + 1) / dim.z());
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = place.spacing[axis];
    smoke.spacing[axis] = edge;
    smoke.origin[axis] = place.origin[axis] + edge * (box.min()[axis] - 0.5);
  }
  return smoke;
}

/// Rotates cells of a file whose y is up: (x, y, z) becomes (x, -z, y).
VdbSmoke stood_up(const VdbSmoke& lying) {
  VdbSmoke out;
  out.nx = lying.nx;
  out.ny = lying.nz;
  out.nz = lying.ny;
  out.spacing = {lying.spacing.x, lying.spacing.z, lying.spacing.y};
  out.origin = {lying.origin.x, -(lying.origin.z + lying.spacing.z * static_cast<double>(lying.nz)),
                lying.origin.y};
  out.values.reserve(lying.values.size());
  for (uint64_t z = 0; z < out.nz; ++z)
    for (uint64_t y = 0; y < out.ny; ++y) {
      const uint64_t from = lying.nx * (z + lying.ny * (lying.nz - 1 - y));
      const auto row = lying.values.begin() + static_cast<std::ptrdiff_t>(from);
      out.values.insert(out.values.end(), row, row + static_cast<std::ptrdiff_t>(lying.nx));
    }
  return out;
}

void answer_grid(openvdb::io::File& file, const Question& question, PlainWriter& out) {
  if (!file.hasGrid(question.grid)) {
    std::string names;
    for (auto name = file.beginName(); name != file.endName() && names.size() < 300; ++name)
      names += (names.empty() ? "\"" : ", \"") + excerpt(*name, 100) + "\"";
    throw std::runtime_error("there is no grid \"" + excerpt(question.grid) + "\" in it" +
                             (names.empty() ? "" : "; there are " + names));
  }
  check_head(*file.readGridMetadata(question.grid));
  const auto grid = [&] {
    const FileWatch watch(question.file, read_share);
    return openvdb::gridPtrCast<FloatGrid>(file.readGrid(question.grid));
  }();
  if (!grid) throw std::runtime_error("its values are no floats");
  if (grid->background() != 0)
    throw std::runtime_error("the value outside of its cells (background) is " +
                             std::to_string(grid->background()) +
                             ", and smoke without end is not read: make it 0");
  const VdbSmoke smoke = cells_of(*grid, *place_of(*grid));
  out.put(uint8_t{1});
  put(out, question.up == UpAxis::y ? stood_up(smoke) : smoke);
}

void vdb_answer(PlainReader& in, PlainWriter& out) {
  Question question;
  if (!get(in, question)) throw std::runtime_error("no question");
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  try {
    openvdb::initialize();
    openvdb::io::File file(question.file);
    file.open(false);  // reads all at once: values are needed, and the file may change
    if (question.grid.empty())
      answer_list(file, out);
    else
      answer_grid(file, question, out);
  } catch (const std::bad_alloc&) {
    throw;  // reported with the limit
  } catch (const std::exception& error) {
    out.put(uint8_t{0});
    out.put(excerpt(error.what(), 600));
  }
}

const IsolatedJob vdb_job(job, vdb_answer);

}  // namespace
}  // namespace luxodus::vdb

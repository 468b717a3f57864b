#include "scenes/formats/fields/data_set.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>

#include "runtime/core/regular_file.hpp"
#include "scenes/formats/fields/data_set_fields.hpp"

namespace luxodus {
namespace data_set {

static_assert(std::endian::native == std::endian::little,
              "samples are copied as they lie in files");

bool is_known_field(std::string_view name) {
  return name == "extinction" || name == "soot_density" || name == "albedo" || name == "emission";
}

Result<void> check_grid(uint64_t nx, uint64_t ny, uint64_t nz) {
  for (const uint64_t side : {nx, ny, nz}) {
    if (side == 0) return problem("the grid has no cells along one of its axes");
    if (side > limits::data_set_side) {
      return problem(fmt::format("the grid has {} cells along one axis, the most are {}", side,
                                 limits::data_set_side));
    }
  }
  // Each side is at most 2^20, so that the product does not overflow.
  if (nx * ny * nz > limits::data_set_cells) {
    return problem(fmt::format("the grid has {} x {} x {} cells, the most are {}", nx, ny, nz,
                               limits::data_set_cells));
  }
  return {};
}

Result<void> check_memory(uint64_t cells, uint64_t fields) {
  const auto pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return {};
  const uint64_t has = static_cast<uint64_t>(pages) * static_cast<uint64_t>(page_bytes);
  const uint64_t takes = cells * fields * sizeof(float);
  if (takes <= has) return {};
  constexpr double gib = 1 << 30;
  return problem(
      fmt::format("its {} cells take {:.1f} GiB of memory, this machine has {:.1f}: make them "
                  "coarser",
                  cells, static_cast<double>(takes) / gib, static_cast<double>(has) / gib),
      ProblemKind::no_room);
}

}  // namespace data_set

namespace {

using data_set::Field;
using data_set::Grid;

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

struct Range {
  float most;
  const char* words;
};

/// The allowed values of a field; soot density has become extinction by then.
Range range_of(const Field& field) {
  if (field.name == "albedo") return {1.0f, "0 to 1"};
  if (field.name == "emission") return {3e38f, "a finite value of 0 or more"};
  return {limits::extinction_per_m,
          field.name == "extinction" ? "0 to 1e9 1/m" : "what makes an extinction of 0 to 1e9 1/m"};
}

/// Checks that every value is within the field's range; names the first cell that is not.
Result<void> check_values(const std::string& path, const Grid& grid, const Field& field) {
  const Range range = range_of(field);
  for (size_t i = 0; i < field.value.size(); ++i) {
    const float v = field.value[i];
    if (v >= 0 && v <= range.most) continue;  // NaN fails
    const uint64_t x = i % grid.nx, y = i / grid.nx % grid.ny, z = i / grid.nx / grid.ny;
    // Samples from a file that the header names are not shown: it may be any file on the machine.
    const std::string found = grid.files_read.size() > 1 ? "out of range" : fmt::format("{}", v);
    return problem_in(path, fmt::format("{} of cell ({}, {}, {}), index {}, is {}: give {}",
                                        field.name, x, y, z, i, found, range.words));
  }
  return {};
}

Result<void> check_placement(const std::string& path, const Grid& grid) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(grid.spacing[axis] > 0) || !std::isfinite(grid.spacing[axis])) {
      return problem_in(path, fmt::format("the spacing along {} is {}: give a length above 0",
                                          "xyz"[axis], grid.spacing[axis]));
    }
    if (!std::isfinite(grid.origin[axis])) return problem_in(path, "the origin is not finite");
  }
  return {};
}

Result<LoadedDataSet> assembled(const std::string& path, Grid grid, const DataSetOptions& options) {
  if (auto ok = check_placement(path, grid); !ok) return ok.problem();
  LoadedDataSet out;
  out.origin = grid.origin;
  out.spacing = grid.spacing;
  out.files_read = grid.files_read;
  DataSet& data = out.data;
  data.nx = static_cast<int>(grid.nx);
  data.ny = static_cast<int>(grid.ny);
  data.nz = static_cast<int>(grid.nz);
  data.extent = grid.spacing * glm::dvec3(data.nx, data.ny, data.nz);
  for (Field& field : grid.fields) {
    const bool soot = field.name == "soot_density";
    if (soot && options.mass_extinction_m2_per_kg) {
      // Multiplied before the check, so that the check finds an overflow, too.
      const auto factor = static_cast<float>(*options.mass_extinction_m2_per_kg);
      for (float& v : field.value) v *= factor;
    }
    if (auto ok = check_values(path, grid, field); !ok) return ok.problem();
    if (soot && !options.mass_extinction_m2_per_kg)
      out.lacks_mass_extinction = std::any_of(field.value.begin(), field.value.end(),
                                              [](float density) { return density > 0; });
    std::vector<float>& to = soot || field.name == "extinction" ? data.extinction
                             : field.name == "albedo"           ? data.albedo
                                                                : data.emission;
    if (!to.empty()) {
      return problem_in(path, fmt::format("\"{}\" would be given twice{}: keep one", field.name,
                                          soot || field.name == "extinction"
                                              ? " (extinction and soot density say the same)"
                                              : ""));
    }
    to = std::move(field.value);
  }
  return out;
}

}  // namespace

Result<LoadedDataSet> read_data_set(const std::string& path, const DataSetOptions& options) {
  if (const auto mass = options.mass_extinction_m2_per_kg;
      mass && !(*mass > 0 && std::isfinite(*mass)))
    return problem_in(path,
                      fmt::format("a mass extinction of {} m2/kg: give a value above 0", *mass));
  const std::string ending = ending_of(path);
  const bool nrrd = ending == ".nrrd" || ending == ".nhdr";
  if (!nrrd && ending != ".vti") {
    return problem_in(path, "unknown kind of data set: .nrrd, .nhdr and .vti are read");
  }
  if (const auto size = size_of_regular_file(path); !size) return size.problem();
  try {
    Result<Grid> grid = nrrd ? data_set::read_nrrd(path, options) : data_set::read_vti(path);
    if (!grid) return grid.problem();
    return assembled(path, std::move(grid.value()), options);
  } catch (const std::bad_alloc&) {
    return problem_in(path, "its cells take more memory than this process gets: make them coarser",
                      ProblemKind::no_room);
  }
}

}  // namespace luxodus

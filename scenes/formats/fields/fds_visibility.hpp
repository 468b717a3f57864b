// Visibility as FDS computes it (QUANTITY VISIBILITY: 3 / K at a point unless the case says
// otherwise, at most 30 m), if a case has slices of it, flat or solid. It knows no sign, no light
// and no line of sight, and is only shown beside verdicts. Immutable once read; any thread. No file
// is kept open.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Values of all slices at one time: those of 60 million cells.
inline constexpr uint64_t visibility_values = uint64_t{64} << 20;
}  // namespace limits

/// A place within this distance of a flat slice has its value [m]: slices are usually at eye
/// height.
inline constexpr double visibility_reach_m = 0.5;

class FireVisibility {
 public:
  /// Value of the nearest slice; nothing where none is in reach. `place`: in the simulation's
  /// coordinates [m].
  std::optional<double> at(const glm::dvec3& place) const;

 private:
  friend Result<std::optional<FireVisibility>> read_visibility(const std::filesystem::path& index,
                                                               double time_s);
  /// Values of nodes, or of cells, which are constant between two nodes. Across a flat slice there
  /// is one node, where the slice lies.
  struct Sheet {
    std::array<std::vector<double>, 3> nodes;  // [m]
    std::array<size_t, 3> counts{};            // number of values along each axis
    bool of_cells = false;
    std::vector<float> values;  // x fastest [m]

    std::optional<double> distance(const glm::dvec3& place) const;
    double value(const glm::dvec3& place) const;
  };
  std::vector<Sheet> sheets_;
};

/// Reads slices at a time, from frames within fire_window_s of it; nothing where there are none.
/// Errors: as fds_case.hpp and fds_frames.hpp; more than the limits.
Result<std::optional<FireVisibility>> read_visibility(const std::filesystem::path& index,
                                                      double time_s);

}  // namespace luxodus

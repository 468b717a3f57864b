// Visibility as FDS computes it (QUANTITY VISIBILITY: 3 / K at a point unless the case says
// otherwise, at most 30 m), where a case has slices of it, flat or solid. It knows no sign, no
// light and no way: it is shown beside verdicts. Any thread; nothing is kept open.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Of all slices at one time: those of 60 million cells.
inline constexpr uint64_t visibility_values = uint64_t{64} << 20;
}  // namespace limits

/// A place so far from a flat slice has its value [m]: slices are laid at the height of eyes.
inline constexpr double visibility_reach_m = 0.5;

class FireVisibility {
 public:
  /// Of the nearest slice; nothing where none reaches. `place`: in the simulation's coordinates
  /// [m].
  std::optional<double> at(const glm::dvec3& place) const;

 private:
  friend Result<std::optional<FireVisibility>> read_visibility(const std::filesystem::path& index,
                                                               double time_s);
  /// Values of nodes, or of cells, which are constant between two nodes. Along an axis that it is
  /// flat across there is one node, where the slice lies.
  struct Sheet {
    std::array<std::vector<double>, 3> nodes;  // [m]
    std::array<size_t, 3> counts{};            // of values
    bool of_cells = false;
    std::vector<float> values;  // x fastest [m]

    std::optional<double> distance(const glm::dvec3& place) const;
    double value(const glm::dvec3& place) const;
  };
  std::vector<Sheet> sheets_;
};

/// At a time, from frames within fire_window_s of it; nothing where there are none.
/// Errors: as fds_case.hpp and fds_frames.hpp say; more than the limits.
Result<std::optional<FireVisibility>> read_visibility(const std::filesystem::path& index,
                                                      double time_s);

}  // namespace luxodus

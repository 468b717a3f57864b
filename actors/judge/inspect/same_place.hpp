// Finds things that stand where an earlier one does, in a time that does not grow with the number
// of things in one place. Pure; any thread.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <vector>

namespace luxodus {

/// For each thing, the first one within `within_m` that is like it, if that comes before it; things
/// like an earlier one are no first ones. `place(i)`: of a thing; none if it has none. `alike(i,
/// k)`: whether two things in one place are alike.
template <class Place, class Alike>
std::vector<std::optional<size_t>> first_in_same_place(size_t count, double within_m,
                                                       const Place& place, const Alike& alike) {
  using Cell = std::array<double, 3>;
  std::map<Cell, std::vector<size_t>> firsts;
  const auto cell_of = [&](const glm::dvec3& p) {
    return Cell{std::floor(p.x / within_m), std::floor(p.y / within_m), std::floor(p.z / within_m)};
  };
  const auto find = [&](size_t i, const glm::dvec3& here) -> std::optional<size_t> {
    const Cell middle = cell_of(here);
    std::optional<size_t> out;
    for (const double dx : {-1, 0, 1})
      for (const double dy : {-1, 0, 1})
        for (const double dz : {-1, 0, 1}) {
          const auto at = firsts.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
          if (at == firsts.end()) continue;
          for (const size_t k : at->second)
            if ((!out || k < *out) && glm::length(*place(k) - here) < within_m && alike(k, i))
              out = k;
        }
    return out;
  };
  std::vector<std::optional<size_t>> out(count);
  for (size_t i = 0; i < count; ++i) {
    const std::optional<glm::dvec3> here = place(i);
    if (!here) continue;
    out[i] = find(i, *here);
    if (!out[i]) firsts[cell_of(*here)].push_back(i);
  }
  return out;
}

}  // namespace luxodus

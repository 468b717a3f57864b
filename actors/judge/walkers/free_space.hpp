// Where a body can stand on a floor: square cells, each free or not. A cell is free if a body
// stands clear of walls and furniture wherever in the cell its middle is, so that a line through
// free cells is a way. Floors are found by rays, walls by geometry. Design:
// docs/decisions/0098-people-who-choose.md. Thread rule: made on one thread, which has rays
// computed by others; then immutable, any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

namespace limits {
/// Cells of a floor; each takes a byte, and 8 bytes more in each walking field. At 0.1 m this is a
/// floor of 200 m by 200 m.
inline constexpr size_t floor_cells = 4'000'000;
}  // namespace limits

/// Number of a cell, row by row.
using CellNumber = uint32_t;

/// What a body on a floor is kept clear of.
struct BodyOnFloor {
  double floor_m = 0;
  double radius_m = 0.25;  // of an upright cylinder
  double cell_m = 0.1;     // edge of a cell
  /// Heights above the floor between which things are in the way: people step over lower ones.
  double from_m = 0.25, to_m = 1.8;
};

class FreeSpace {
 public:
  /// `walls`: the building of only what nobody walks through. Its meshes must be described.
  /// Errors: no surfaces; more cells than the limit.
  static Result<FreeSpace> make(const Building& walls, const BodyOnFloor& body);

  size_t columns() const { return columns_; }
  size_t rows() const { return rows_; }
  size_t cells() const { return columns_ * rows_; }
  double cell_m() const { return cell_m_; }
  /// Corners of all cells together [m].
  glm::dvec2 low() const { return low_; }
  glm::dvec2 high() const;

  bool is_free(CellNumber cell) const { return free_[cell] != 0; }
  size_t column_of(CellNumber cell) const { return cell % columns_; }
  size_t row_of(CellNumber cell) const { return cell / columns_; }
  CellNumber cell_at(size_t column, size_t row) const {
    return static_cast<CellNumber>(row * columns_ + column);
  }
  glm::dvec2 centre(CellNumber cell) const;
  /// The cell of a place; none beside the grid.
  std::optional<CellNumber> cell_of(const glm::dvec2& place) const;
  /// The free cell whose centre is nearest to a place, at most `within_m` away.
  std::optional<CellNumber> nearest_free(const glm::dvec2& place, double within_m) const;
  /// Whether the straight line between the centres of two cells touches free cells only.
  bool sees(CellNumber from, CellNumber to) const;

 private:
  FreeSpace() = default;
  void block(const glm::dvec3 (&corners)[3], const BodyOnFloor& body);
  void need_floor(const Building& walls, const BodyOnFloor& body);
  std::vector<std::vector<CellNumber>> parts() const;
  void leave_solids(const Building& walls, const BodyOnFloor& body);

  glm::dvec2 low_{0};
  double cell_m_ = 0;
  size_t columns_ = 0, rows_ = 0;
  std::vector<char> free_;
};

}  // namespace luxodus

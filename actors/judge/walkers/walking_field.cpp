#include "actors/judge/walkers/walking_field.hpp"

#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace luxodus {

namespace {

constexpr float not_reached = -1;

}  // namespace

/// Cells are closed in the order of their distance. A cell that is opened takes the parent of the
/// cell beside it, as if it saw that; whether it does is tested once, when it is closed.
struct WalkingField::Search {
  Search(const FreeSpace& free, WalkingField& field)
      : space(free), out(field), tentative(free.cells(), std::numeric_limits<float>::infinity()) {}

  float length(CellNumber a, CellNumber b) const {
    const auto apart = [](size_t p, size_t q) {
      return static_cast<float>(p) - static_cast<float>(q);
    };
    return std::hypot(apart(space.column_of(a), space.column_of(b)),
                      apart(space.row_of(a), space.row_of(b)));
  }

  /// Calls `visit` for each free cell beside a cell to which a step leads past no corner.
  template <class Visit>
  void each_beside(CellNumber cell, Visit&& visit) const {
    const size_t column = space.column_of(cell), row = space.row_of(cell);
    for (const int dy : {-1, 0, 1})
      for (const int dx : {-1, 0, 1}) {
        const size_t x = column + static_cast<size_t>(dx), y = row + static_cast<size_t>(dy);
        if ((dx == 0 && dy == 0) || x >= space.columns() || y >= space.rows()) continue;
        if (dx != 0 && dy != 0 &&
            !(space.is_free(space.cell_at(x, row)) && space.is_free(space.cell_at(column, y))))
          continue;
        if (const CellNumber beside = space.cell_at(x, y); space.is_free(beside)) visit(beside);
      }
  }

  void offer(CellNumber cell, CellNumber parent, float distance) {
    if (!(distance < tentative[cell])) return;
    tentative[cell] = distance;
    out.parent_[cell] = parent;
    open.emplace(distance, cell);
  }

  /// Takes the best parent among the closed cells beside it if it does not see its own.
  void settle(CellNumber cell) {
    const CellNumber parent = out.parent_[cell];
    float distance = tentative[cell];
    if (parent != cell && !space.sees(parent, cell)) {
      distance = std::numeric_limits<float>::infinity();
      each_beside(cell, [&](CellNumber beside) {
        if (out.distance_[beside] == not_reached) return;
        const float by = out.distance_[beside] + length(beside, cell);
        if (by < distance) {
          distance = by;
          out.parent_[cell] = beside;
        }
      });
    }
    out.distance_[cell] = distance;
  }

  void run(std::optional<CellNumber> until) {
    while (!open.empty()) {
      const CellNumber cell = std::get<1>(open.top());
      open.pop();
      if (out.distance_[cell] != not_reached) continue;
      settle(cell);
      if (cell == until) return;
      const CellNumber parent = out.parent_[cell];
      each_beside(cell, [&](CellNumber beside) {
        if (out.distance_[beside] == not_reached)
          offer(beside, parent, out.distance_[parent] + length(parent, beside));
      });
    }
  }

  using Entry = std::tuple<float, CellNumber>;
  const FreeSpace& space;
  WalkingField& out;
  std::vector<float> tentative;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
};

WalkingField::WalkingField(const FreeSpace& space, const std::vector<CellNumber>& goals,
                           std::optional<CellNumber> until)
    : space_(space), distance_(space.cells(), not_reached), parent_(space.cells()) {
  Search search(space, *this);
  for (const CellNumber goal : goals) search.offer(goal, goal, 0);
  search.run(until);
}

bool WalkingField::reaches(CellNumber cell) const {
  return distance_[cell] != not_reached;
}

double WalkingField::distance_m(CellNumber cell) const {
  return reaches(cell) ? static_cast<double>(distance_[cell]) * space_.cell_m()
                       : std::numeric_limits<double>::infinity();
}

std::vector<CellNumber> WalkingField::way_from(CellNumber cell) const {
  std::vector<CellNumber> turns{cell};
  while (parent_[turns.back()] != turns.back()) turns.push_back(parent_[turns.back()]);
  // Turns that are not needed: where a cell took a parent beside it.
  std::vector<CellNumber> out{cell};
  for (size_t i = 0; i + 1 < turns.size();) {
    size_t next = i + 1;
    for (size_t k = turns.size() - 1; k > next; --k)
      if (space_.sees(turns[i], turns[k])) next = k;
    out.push_back(turns[next]);
    i = next;
  }
  return out;
}

}  // namespace luxodus

// The integer program of a layout with those of its rows that have been asked for so far. Rows that
// are not there only make it easier, so its bound holds for the whole problem. Plain values; one
// thread.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"
#include "actors/judge/design/mixed_integer_program.hpp"

namespace luxodus {

namespace limits {
/// Rows that one round adds.
inline constexpr size_t rows_per_round = 80;
/// Rounds. Each adds rows that no earlier one had, so they end by themselves; this ends a mistake.
inline constexpr int row_rounds = 500;
}  // namespace limits

class GrowingProgram {
 public:
  /// `feasible_only`: any layout will do. Requires: the problem outlives this.
  GrowingProgram(const LayoutProblem& problem, bool feasible_only);

  const IntegerProgram& program() const { return program_; }
  /// Only the options of some regions cost anything, and the rows of others are left out.
  IntegerProgram of_regions(const std::set<uint32_t>& regions) const;
  /// All options but those of some regions are as a layout has them.
  IntegerProgram around(const Layout& layout, const std::set<uint32_t>& regions) const;
  /// No layout's options of the regions weigh less than this together.
  void add_region_bound(const std::set<uint32_t>& regions, double least);
  /// Rows that follow from the others; and those of places.
  static constexpr int of_bound = -2, of_place = -1;

  size_t rows() const { return program_.rows.size(); }
  /// Groups of the rows, as numbers of the problem; below 0: of none.
  const std::vector<int>& groups() const { return groups_; }

  /// Whether the row, or of failures that of all of them at its point, is there.
  bool has(const Violation& v) const;
  /// False where the row is there already: then it is asked for by a little more.
  bool add(const Violation& v);

  Layout layout_of(const std::vector<double>& values) const;

 private:
  /// What tells rows apart: kind, index, point, and the place or the brightest point.
  using RowKey = std::tuple<int, uint32_t, uint32_t, uint32_t>;

  static RowKey key_of(const Violation& v);
  /// Of all failures at a point.
  static RowKey whole_key(const Violation& v) { return {-1, v.index, v.point, 0}; }

  void add_row(LinearRow row, int group);
  void add_places();
  void add_pools();
  void add_cover(const std::vector<Term>& terms, double least, uint32_t but_place, uint32_t group);
  void add_failure(const std::vector<Term>& light, double least, uint32_t group);
  void add_spread(const Violation& v, double more);

  const LayoutProblem& problem_;
  IntegerProgram program_;
  std::vector<int> groups_, darkest_;
  std::set<RowKey> known_;
};

uint32_t group_of(const LayoutProblem& problem, const Violation& v);

/// The worst of them, none near to another of its group.
std::vector<Violation> spread_out(const LayoutProblem& problem, std::vector<Violation> all,
                                  size_t most);

/// Rows to begin with: of each group those that are hardest to satisfy, apart from each other.
std::vector<Violation> first_rows(const LayoutProblem& problem);

}  // namespace luxodus

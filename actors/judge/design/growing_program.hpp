// The integer program of a layout with the rows that were added so far (row generation). It is a
// relaxation of the whole problem, so its lower bound holds for the whole problem. Plain values;
// thread rule: one thread.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"
#include "actors/judge/design/mixed_integer_program.hpp"

namespace luxodus {

namespace limits {
/// Rows added in one round.
inline constexpr size_t rows_per_round = 80;
/// Largest number of rounds. Each round adds new rows, so rounds end without it; it only stops an
/// error.
inline constexpr int row_rounds = 500;
}  // namespace limits

class GrowingProgram {
 public:
  /// `feasible_only`: all costs are zero. Requires: the problem outlives this.
  GrowingProgram(const LayoutProblem& problem, bool feasible_only);

  const IntegerProgram& program() const { return program_; }
  /// The program in which only options of some regions have a cost, without the rows of other
  /// regions.
  IntegerProgram of_regions(const std::set<uint32_t>& regions) const;
  /// The program in which all options outside some regions are fixed as in a layout.
  IntegerProgram around(const Layout& layout, const std::set<uint32_t>& regions) const;
  /// Adds a row: the options of these regions weigh at least this in every layout.
  void add_region_bound(const std::set<uint32_t>& regions, double least);
  /// Groups of region bounds and of rows for places, which belong to no demand.
  static constexpr int of_bound = -2, of_place = -1;

  size_t rows() const { return program_.rows.size(); }
  /// Group of each row, as an index of the problem; negative: no demand.
  const std::vector<int>& groups() const { return groups_; }

  /// Whether a row was added; for a failure, whether its point has a row for all failures.
  bool has(const Violation& v) const;
  /// Adds a row. If it was added before, adds it again with a slightly larger requirement and
  /// returns false.
  bool add(const Violation& v);

  Layout layout_of(const std::vector<double>& values) const;

 private:
  /// Identifies a row: kind, index, point, and the place or the brightest point.
  using RowKey = std::tuple<int, uint32_t, uint32_t, uint32_t>;

  static RowKey key_of(const Violation& v);
  /// Key of the row for all failures at a point.
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

/// The worst violations, no two of one group close to each other.
std::vector<Violation> spread_out(const LayoutProblem& problem, std::vector<Violation> all,
                                  size_t most);

/// Rows to start with: in each group those that are hardest to satisfy, spaced apart.
std::vector<Violation> first_rows(const LayoutProblem& problem);

}  // namespace luxodus

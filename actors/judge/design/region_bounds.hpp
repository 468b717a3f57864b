// Lower bounds on the weight of each region (corridor, room). First each region is bounded
// separately, with luminaires of other regions at no cost: rounded-up integers of regions add up to
// more than the rounded-up total, and small programs are solved faster. If the sum stays below the
// weight of the best layout, regions that light each other are bounded together, so that neither
// uses the other's light at no cost. Every bound holds for all layouts. Thread rule: as
// mixed_integer_program.hpp.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "actors/judge/design/attainable_sums.hpp"
#include "actors/judge/design/growing_program.hpp"

namespace luxodus {

/// Coupling of two regions: the share of the requirements of one region's rows that options of the
/// other may contribute. By pairs, the smaller index first.
std::map<std::pair<uint32_t, uint32_t>, double> light_between_regions(const LayoutProblem& problem);

class RegionBounds {
 public:
  /// Adds to `growing` the rows that solutions violate, and the bounds. `known`: bounds of the same
  /// problem or of a relaxation of it, also for regions that are not in this one.
  /// Requires: all arguments but `known` outlive this.
  RegionBounds(const LayoutProblem& problem, const LayoutIndex& index, const AttainableSums& sums,
               const std::vector<RegionBound>& known, GrowingProgram& growing,
               const std::atomic<bool>& interrupt);

  /// Called with the sum of all bounds whenever it may have grown. Returns false if the sum is
  /// large enough.
  using Raised = std::function<bool(double sum)>;

  /// Bounds each region separately within a time; with a layout, only regions whose weight in it
  /// exceeds their bound.
  void bound_each(const Layout& layout, double seconds, const Raised& raised);
  /// Joins a region whose weight in the layout exceeds its bound with one that lights it: the first
  /// pair that raises the sum. False if none does, or time is out.
  bool join(const Layout& layout, double seconds, const Raised& raised);

  /// All regions, each in exactly one bound.
  const std::vector<RegionBound>& bounds() const { return bounds_; }
  double weight_of(const Layout& layout, const RegionBound& bound) const;
  /// Whether the weight of these regions in a layout exceeds their bound.
  bool is_loose(const Layout& layout, const RegionBound& bound) const;

 private:
  double sum() const;
  /// Indices by number of options: time that small regions leave over goes to large ones.
  std::vector<size_t> smallest_first() const;
  double light_between(const RegionBound& a, const RegionBound& b) const;
  /// Pairs with at least one loose bound, the most strongly coupled first.
  std::vector<std::pair<size_t, size_t>> pairs_to_try(const Layout& layout) const;
  struct Found {
    double least = 0;
    bool finished = false;  // more time would not raise it
  };
  Found bound_of(const std::set<uint32_t>& regions, const Layout& layout, double seconds);

  const LayoutProblem& problem_;
  const LayoutIndex& index_;
  const AttainableSums& sums_;
  GrowingProgram& growing_;
  const std::atomic<bool>& interrupt_;
  const std::map<std::pair<uint32_t, uint32_t>, double> light_;
  std::vector<RegionBound> bounds_;
  std::set<std::set<uint32_t>> tried_;  // sets of regions whose joint bound raised nothing
};

}  // namespace luxodus

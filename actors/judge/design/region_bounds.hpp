// What the regions of a problem (corridors, rooms) weigh at least. Each is bounded by itself, with
// the luminaires of others free: whole numbers of each region add up to more than the whole number
// of all of them, and each is found sooner. Where that leaves the best layout's weight open,
// regions that light each other are bounded together: then neither has the other's light for
// nothing. Every bound holds for all layouts. Thread rule: as mixed_integer_program.hpp.
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

/// How much two regions have to do with each other: the shares of what the rows of one ask for that
/// options of the other may give. By pairs, the smaller number first.
std::map<std::pair<uint32_t, uint32_t>, double> light_between_regions(const LayoutProblem& problem);

class RegionBounds {
 public:
  /// Adds to `growing` the rows that solutions break, and what regions weigh at least. `known`: of
  /// the same problem, or of one that asks for less; also of regions that are not in this one.
  /// Requires: all outlive this, but for `known`.
  RegionBounds(const LayoutProblem& problem, const LayoutIndex& index, const AttainableSums& sums,
               const std::vector<RegionBound>& known, GrowingProgram& growing,
               const std::atomic<bool>& interrupt);

  /// Called with the sum of all bounds, whenever it may be larger. False: it is large enough.
  using Raised = std::function<bool(double sum)>;

  /// Each region by itself, in a time; where a layout is there, those that it has more in than is
  /// known to be needed.
  void bound_each(const Layout& layout, double seconds, const Raised& raised);
  /// Joins regions that the layout has more in than they weigh at least with one that lights them,
  /// the first where that raises the sum. False where none does, or the time was too short.
  bool join(const Layout& layout, double seconds, const Raised& raised);

  /// All regions, each in one of them.
  const std::vector<RegionBound>& bounds() const { return bounds_; }
  double weight_of(const Layout& layout, const RegionBound& bound) const;
  /// Whether a layout has more in these regions than they weigh at least.
  bool is_loose(const Layout& layout, const RegionBound& bound) const;

 private:
  double sum() const;
  /// By number of options: what small ones leave of their time is for the large ones.
  std::vector<size_t> smallest_first() const;
  double light_between(const RegionBound& a, const RegionBound& b) const;
  /// Pairs of which one is loose, those first that light each other most.
  std::vector<std::pair<size_t, size_t>> pairs_to_try(const Layout& layout) const;
  struct Found {
    double least = 0;
    bool finished = false;  // no more time would tell more
  };
  Found bound_of(const std::set<uint32_t>& regions, const Layout& layout, double seconds);

  const LayoutProblem& problem_;
  const LayoutIndex& index_;
  const AttainableSums& sums_;
  GrowingProgram& growing_;
  const std::atomic<bool>& interrupt_;
  const std::map<std::pair<uint32_t, uint32_t>, double> light_;
  std::vector<RegionBound> bounds_;
  std::set<std::set<uint32_t>> tried_;  // together, and nothing was gained
};

}  // namespace luxodus

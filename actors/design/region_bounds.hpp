// What the regions of a problem (corridors, rooms) weigh at least. Each is bounded by itself, with
// the luminaires of others free: whole numbers of each region add up to more than the whole number
// of all of them, and each is found sooner. Where that leaves the best layout's weight open,
// regions that light each other are bounded together: then neither has the other's light for
// nothing. Every bound holds for all layouts. Thread rule: as mixed_integer_program.hpp.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "actors/design/attainable_sums.hpp"
#include "actors/design/growing_program.hpp"

namespace luxodus {

/// Regions that are bounded together: no layout's options of them weigh less.
struct RegionBound {
  std::set<uint32_t> regions;
  double least = 0;
};

/// How much two regions have to do with each other: the shares of what the rows of one ask for that
/// options of the other may give. By pairs, the smaller number first.
std::map<std::pair<uint32_t, uint32_t>, double> light_between_regions(const LayoutProblem& problem);

class RegionBounds {
 public:
  /// Adds to `growing` the rows that solutions break, and what regions weigh at least.
  /// Requires: all outlive this.
  RegionBounds(const LayoutProblem& problem, const LayoutIndex& index, const AttainableSums& sums,
               GrowingProgram& growing, const std::atomic<bool>& interrupt);

  /// Called with a larger sum of all bounds, whenever there is one.
  using Raised = std::function<void(double sum)>;

  /// Each region by itself, in a time.
  void bound_each(double seconds, const Raised& raised);
  /// Joins regions that the layout has more in than they weigh at least with one that lights them,
  /// the first where that raises the sum. False where none does, or the time was too short.
  /// `wanted_below`: the objective, without what is fixed, that layouts have to be below.
  bool join(const Layout& layout, double wanted_below, double seconds, const Raised& raised);

  /// All regions, each in one of them.
  const std::vector<RegionBound>& bounds() const { return bounds_; }
  double weight_of(const Layout& layout, const RegionBound& bound) const;
  /// Whether a layout has more in these regions than they weigh at least.
  bool is_loose(const Layout& layout, const RegionBound& bound) const;

 private:
  double sum() const;
  double light_between(const RegionBound& a, const RegionBound& b) const;
  /// Pairs of which one is loose, those first that light each other most.
  std::vector<std::pair<size_t, size_t>> pairs_to_try(const Layout& layout) const;
  double bound_of(const std::set<uint32_t>& regions, double seconds,
                  std::optional<double> wanted_below);

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

// The choice of luminaires as numbers: options (columns), their light at each point, and constraint
// rows. It contains no geometry and no rules, so tests compare solutions with a search over all
// subsets. Plain values, any thread; LayoutSums states its own rule.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scenes/emergency/check.hpp"

namespace luxodus {

/// Contribution of one option to a sum, such as the illuminance at a point [lx].
struct Term {
  uint32_t option = 0;
  float value = 0;
};
/// Terms by ascending option; other options contribute nothing. Shared, since several rows may use
/// one sum.
using Terms = std::shared_ptr<const std::vector<Term>>;

/// Region of options and constraints that belong to none.
inline constexpr uint32_t no_region = static_cast<uint32_t>(-1);

/// Pool of options that are no movable luminaires.
inline constexpr uint32_t no_pool = static_cast<uint32_t>(-1);

/// Kind of existing luminaires, which are of none of the types to be placed.
inline constexpr uint32_t no_kind = static_cast<uint32_t>(-1);

/// A luminaire of one type and rotation at one place.
struct LayoutOption {
  uint32_t place = 0;  // options of one place exclude each other
  double weight = 1;   // contribution to the objective
  bool fixed = false;  // chosen in every layout
  /// Options of different regions, which are in different rooms, hardly affect each other.
  uint32_t region = no_region;
  glm::dvec2 position{0};
  bool never_fails = false;  // exempt from demands on failures
  bool barred = false;       // chosen in no layout
  /// Pool of identical movable luminaires; each option is a place for one of them.
  uint32_t pool = no_pool;
  uint32_t kind = no_kind;  // its type
};

/// Stands for no place.
inline constexpr uint32_t no_place = static_cast<uint32_t>(-1);

/// What a group of constraints requires.
enum class DemandKind {
  minimum,   // illuminance at every point [lx]
  mean,      // illuminance [lx]
  early,     // illuminance at every point some time after the mains fail [lx]
  spread,    // largest over smallest illuminance
  two,       // this many luminaires over a route or an area
  failed,    // illuminance at every point with any one luminaire failed [lx]
  near,      // a luminaire within a distance [m]
  vertical,  // illuminance on the front of equipment [lx]
  face,      // illuminance on the face of a sign [lx]
  stairs,    // a luminaire whose light falls directly on a flight of stairs [lx on each tread]
};

/// Whether a demand is a lower limit of illuminance while all luminaires work. Refining makes these
/// hold with more to spare, and they must hold with luminaires off their places.
constexpr bool is_minimum(DemandKind kind) {
  return kind == DemandKind::minimum || kind == DemandKind::mean || kind == DemandKind::early ||
         kind == DemandKind::vertical || kind == DemandKind::face;
}

/// Constraints of one rule for one subject; they are relaxed together.
struct ConstraintGroup {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  double asked = 0;  // the planned value, margin included
  uint32_t region = no_region;
};

/// Cover constraint: the sum is at least `least`, which is above 0.
struct CoverRow {
  uint32_t group = 0;
  Terms terms;
  double least = 0;
  glm::dvec3 place{0};
};

struct ReceiverPoint {
  Terms light;  // [lx]
  glm::dvec3 place{0};
};

/// At each point the sum without the luminaire of any one place is at least `least`.
struct FailureRows {
  uint32_t group = 0;
  double least = 0;
  std::vector<uint32_t> points;
};

/// The largest sum at `high` is at most `ratio` times the smallest at `low`.
struct SpreadRows {
  uint32_t group = 0;
  double ratio = 40;
  std::vector<uint32_t> low, high;  // points
};

struct LayoutProblem {
  std::vector<LayoutOption> options;
  std::vector<ConstraintGroup> groups;
  std::vector<ReceiverPoint> points;
  std::vector<CoverRow> covers;
  std::vector<FailureRows> failures;
  std::vector<SpreadRows> spreads;
  std::vector<uint32_t> pools;  // number of options to choose from each pool, exactly

  size_t places() const;
};

/// Whether each option is chosen.
using Layout = std::vector<char>;

/// A lower bound on the weight of some regions' options, valid for every layout.
struct RegionBound {
  std::set<uint32_t> regions;
  double least = 0;
};

double objective_of(const LayoutProblem& problem, const Layout& layout);

/// Relative rounding tolerance of sums below their requirement.
inline constexpr double sum_tolerance = 1e-6;

/// A violated constraint of exactly one of the three kinds.
struct Violation {
  enum class Kind { cover, failure, spread } kind = Kind::cover;
  uint32_t index = 0;  // index into covers, failures or spreads
  uint32_t point = 0;  // of a failure; for a spread the darkest
  uint32_t place = 0;  // for a failure, where the luminaire failed; no_place: no luminaire can fail
  uint32_t brightest = 0;  // of a spread
  double share = 0;        // of the required value: below 1
};

/// Rows of a problem by option. Keeps a reference. Immutable; any thread.
class LayoutIndex {
 public:
  explicit LayoutIndex(const LayoutProblem& problem);

  struct Entry {
    uint32_t row;
    float value;
  };
  const LayoutProblem& problem() const { return problem_; }
  /// Contributions to cover rows, as shares of their requirement.
  const std::vector<Entry>& covers(size_t option) const { return covers_[option]; }
  /// Contributions at points of failure and spread rows [lx].
  const std::vector<Entry>& points(size_t option) const { return points_[option]; }

 private:
  const LayoutProblem& problem_;
  std::vector<std::vector<Entry>> covers_, points_;
};

/// Sums of all rows for a layout. Keeps a reference. Thread rule: one thread.
class LayoutSums {
 public:
  explicit LayoutSums(const LayoutIndex& index);

  void set(const Layout& layout);
  void add(uint32_t option) { change(option, 1); }
  void remove(uint32_t option) { change(option, -1); }

  const Layout& layout() const { return layout_; }
  /// Sum of a cover row as a share of its requirement.
  double cover(size_t row) const { return cover_[row]; }
  double at_point(size_t point) const { return light_[point]; }
  bool covers_hold() const;
  /// Number of luminaires that a pool lacks in the layout; negative if it has too many.
  int64_t lack_of(size_t pool) const;
  /// For each group, the least share of its requirement; infinite without rows.
  std::vector<double> tightest() const;
  /// All violated constraints, or all with less than `below` of their requirement.
  std::vector<Violation> violations(double below = 1 - sum_tolerance) const;
  /// Whether all constraints hold and each pool has its number of luminaires.
  bool holds() const;

 private:
  void change(uint32_t option, int sign);
  /// At each point, the largest light of one luminaire that may fail, and the place of that
  /// luminaire.
  void find_largest(std::vector<float>& largest, std::vector<uint32_t>& whose) const;

  const LayoutIndex& index_;
  const LayoutProblem& problem_;
  std::vector<double> cover_, light_;
  std::vector<int64_t> in_pool_;
  Layout layout_;
};

}  // namespace luxodus

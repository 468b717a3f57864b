// Which luminaires to choose, as numbers alone: options, what each gives at each point, and what
// must hold. No geometry and no rule is known here, so that solutions can be compared with those
// found by trying every subset. Plain values; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scenes/emergency/remark.hpp"

namespace luxodus {

/// What one option adds to a sum, such as illuminance at a point [lx].
struct Term {
  uint32_t option = 0;
  float value = 0;
};
/// By ascending option; those that are not named add nothing. Shared: several rows may ask for the
/// same sum.
using Terms = std::shared_ptr<const std::vector<Term>>;

/// Of options and constraints that belong to no region.
inline constexpr uint32_t no_region = static_cast<uint32_t>(-1);

/// Of options that are no luminaires to be moved.
inline constexpr uint32_t no_pool = static_cast<uint32_t>(-1);

/// Of options that are there already: they are of none of the types that are placed.
inline constexpr uint32_t no_kind = static_cast<uint32_t>(-1);

/// A luminaire of one type, turned in one way, at one place.
struct LayoutOption {
  uint32_t place = 0;  // options of one place exclude each other
  double weight = 1;   // what it adds to the objective
  bool fixed = false;  // chosen in every layout
  /// Options of different regions have little to do with each other: they are in other rooms.
  uint32_t region = no_region;
  glm::dvec2 position{0};
  bool never_fails = false;  // no demand on failures takes it away
  bool barred = false;       // chosen in no layout
  /// Of luminaires that are there, alike, and may move: each option is a place for one of them.
  uint32_t pool = no_pool;
  uint32_t kind = no_kind;  // its type
};

/// No number of a place.
inline constexpr uint32_t no_place = static_cast<uint32_t>(-1);

/// What a group of constraints asks for.
enum class DemandKind {
  minimum,   // illuminance at every point [lx]
  mean,      // illuminance [lx]
  early,     // illuminance at every point a while after the failure of the mains [lx]
  spread,    // largest over smallest illuminance
  two,       // so many luminaires over a route or an area
  failed,    // illuminance at every point with any one luminaire out [lx]
  near,      // a luminaire within a distance [m]
  vertical,  // illuminance on the front of equipment [lx]
  face,      // illuminance on the face of a sign [lx]
  stairs,    // a luminaire whose light falls directly on a flight of stairs [lx on each tread]
};

/// Illuminance that is not to be below a limit while all luminaires work: what is kept with more to
/// spare, and what has to hold off the places.
constexpr bool is_minimum(DemandKind kind) {
  return kind == DemandKind::minimum || kind == DemandKind::mean || kind == DemandKind::early ||
         kind == DemandKind::vertical || kind == DemandKind::face;
}

/// Constraints that stand and fall together: one rule for one subject.
struct ConstraintGroup {
  DemandKind kind = DemandKind::minimum;
  std::string rule;  // "E5"; "" of what is no code's
  Subject subject;
  double asked = 0;  // the planned value, margin included
  uint32_t region = no_region;
};

/// The sum is not below `least`, which is above 0.
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

/// At each of the points the sum is not below `least` when the luminaire of any one place is out.
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
  std::vector<uint32_t> pools;  // how many options of each are chosen, exactly

  size_t places() const;
};

/// Whether each option is chosen.
using Layout = std::vector<char>;

/// Regions that are bounded together: no layout's options of them weigh less.
struct RegionBound {
  std::set<uint32_t> regions;
  double least = 0;
};

double objective_of(const LayoutProblem& problem, const Layout& layout);

/// Sums may be below what is asked for by this share of it: rounding.
inline constexpr double sum_tolerance = 1e-6;

/// A sum that is not what is asked for. Exactly one of the three kinds.
struct Violation {
  enum class Kind { cover, failure, spread } kind = Kind::cover;
  uint32_t index = 0;      // of covers, failures or spreads
  uint32_t point = 0;      // of a failure; of a spread the darkest
  uint32_t place = 0;      // of a failure: whose luminaire is out; no_place: none can be
  uint32_t brightest = 0;  // of a spread
  double share = 0;        // of what is asked for that is there: below 1
};

/// The rows of a problem by option: what an option adds to which. Keeps a reference. Any thread.
class LayoutIndex {
 public:
  explicit LayoutIndex(const LayoutProblem& problem);

  struct Entry {
    uint32_t row;
    float value;
  };
  const LayoutProblem& problem() const { return problem_; }
  /// Shares of what cover rows ask for.
  const std::vector<Entry>& covers(size_t option) const { return covers_[option]; }
  /// Light at points that failures and spreads ask for [lx].
  const std::vector<Entry>& points(size_t option) const { return points_[option]; }

 private:
  const LayoutProblem& problem_;
  std::vector<std::vector<Entry>> covers_, points_;
};

/// What all rows get from a layout. Keeps a reference. One thread.
class LayoutSums {
 public:
  explicit LayoutSums(const LayoutIndex& index);

  void set(const Layout& layout);
  void add(uint32_t option) { change(option, 1); }
  void remove(uint32_t option) { change(option, -1); }

  const Layout& layout() const { return layout_; }
  /// Of a cover row, as a share of what it asks for.
  double cover(size_t row) const { return cover_[row]; }
  double at_point(size_t point) const { return light_[point]; }
  bool covers_hold() const;
  /// Of a pool, how many more it has to have in the layout; below 0 where it has too many.
  int64_t lack_of(size_t pool) const;
  /// Of each group, the least share of what it asks for that is there; infinite without rows.
  std::vector<double> tightest() const;
  /// All sums that do not hold; or of which less than `below` of what is asked for is there.
  std::vector<Violation> violations(double below = 1 - sum_tolerance) const;
  /// All sums, and as many of each pool as it has.
  bool holds() const;

 private:
  void change(uint32_t option, int sign);
  /// The largest light at each point of one luminaire that may fail, and the place that it comes
  /// from.
  void find_largest(std::vector<float>& largest, std::vector<uint32_t>& whose) const;

  const LayoutIndex& index_;
  const LayoutProblem& problem_;
  std::vector<double> cover_, light_;
  std::vector<int64_t> in_pool_;
  Layout layout_;
};

}  // namespace luxodus

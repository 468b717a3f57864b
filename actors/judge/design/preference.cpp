// Random neighbourhoods rarely produce a layout that is symmetric or of one type. So such layouts
// are derived from the current one, and taken if all demands hold.
#include "actors/judge/design/preference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace luxodus {

namespace {

/// Luminaires in rows closer than this are in one row, and places closer than this are one [m].
constexpr double one_row_m = 0.05, one_place_m = 0.1;
/// Places brighter than this times the requirement are bright enough.
constexpr double bright_enough = 2;
/// Weights of one row less, one type less and full symmetry, relative to the brightness of a place
/// as a share of its requirement.
constexpr double worth_of_row = 0.02, worth_of_type = 0.1, worth_of_symmetry = 0.2;
/// Number of passes; each starts from the result of the one before.
constexpr int tidy_passes = 4;
constexpr double same_weight = 1e-9;

/// Bounding box of the places of one region.
struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void take(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  glm::dvec2 mirrored(glm::dvec2 p, int axis) const {
    p[axis] = low[axis] + high[axis] - p[axis];
    return p;
  }
  double middle(int axis) const { return (low[axis] + high[axis]) / 2; }
};

std::map<uint32_t, Extent> extents_of(const LayoutProblem& problem) {
  std::map<uint32_t, Extent> out;
  for (const LayoutOption& option : problem.options) out[option.region].take(option.position);
  return out;
}

std::vector<uint32_t> chosen_in(const Layout& layout) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0) out.push_back(i);
  return out;
}

size_t rows_along(const LayoutProblem& problem, const std::vector<uint32_t>& chosen, int axis) {
  std::set<int64_t> rows;
  for (const uint32_t i : chosen)
    rows.insert(std::llround(problem.options[i].position[axis] / one_row_m));
  return rows.size();
}

size_t types_in(const LayoutProblem& problem, const std::vector<uint32_t>& chosen) {
  std::set<uint32_t> kinds;
  for (const uint32_t i : chosen)
    if (problem.options[i].kind != no_kind) kinds.insert(problem.options[i].kind);
  return kinds.size();
}

/// Derives layouts from a given one.
class LayoutTidier {
 public:
  explicit LayoutTidier(const LayoutProblem& problem)
      : problem_(problem), extents_(extents_of(problem)) {
    for (uint32_t i = 0; i < problem.options.size(); ++i)
      of_region_[problem.options[i].region].push_back(i);
  }

  std::vector<Layout> made_of(const Layout& layout) const {
    std::vector<Layout> out;
    const auto offer = [&](const std::optional<Layout>& one) {
      if (one && *one != layout) out.push_back(*one);
    };
    for (const auto& [region, extent] : extents_)
      for (const int axis : {0, 1}) {
        for (const bool from_low : {true, false})
          offer(with_mirrored(layout, region, extent, axis, from_low));
        offer(in_one_row(layout, region, axis));
      }
    std::set<uint32_t> kinds;
    for (const uint32_t i : chosen_in(layout))
      if (stands_free(i)) kinds.insert(problem_.options[i].kind);
    for (const uint32_t from : kinds)
      for (const uint32_t to : kinds)
        if (from != to) offer(with_other_type(layout, from, to));
    return out;
  }

 private:
  /// Whether a luminaire is new, so that its place and type may change.
  bool stands_free(uint32_t i) const {
    const LayoutOption& option = problem_.options[i];
    return option.kind != no_kind && !option.fixed && option.pool == no_pool;
  }

  /// The option of a type nearest to a place of a region, within a small distance.
  std::optional<uint32_t> at(uint32_t region, const glm::dvec2& place, uint32_t kind) const {
    std::optional<uint32_t> out;
    double nearest = one_place_m;
    for (const uint32_t i : of_region_.at(region)) {
      const LayoutOption& option = problem_.options[i];
      const double away = glm::length(option.position - place);
      if (option.kind != kind || option.barred || away >= nearest) continue;
      nearest = away;
      out = i;
    }
    return out;
  }

  /// The luminaires of one half of a region with their mirror images in the other half.
  std::optional<Layout> with_mirrored(const Layout& layout, uint32_t region, const Extent& extent,
                                      int axis, bool from_low) const {
    Layout out = layout;
    std::vector<uint32_t> kept;
    for (const uint32_t i : of_region_.at(region)) {
      if (layout[i] == 0 || !stands_free(i)) continue;
      const double off = problem_.options[i].position[axis] - extent.middle(axis);
      if (std::abs(off) < one_row_m) continue;
      if ((off < 0) == from_low)
        kept.push_back(i);
      else
        out[i] = 0;
    }
    for (const uint32_t i : kept) {
      const auto image =
          at(region, extent.mirrored(problem_.options[i].position, axis), problem_.options[i].kind);
      if (!image) return std::nullopt;
      out[*image] = 1;
    }
    return one_each(std::move(out));
  }

  /// Moves all luminaires of a region to the row that has most of them.
  std::optional<Layout> in_one_row(const Layout& layout, uint32_t region, int axis) const {
    std::map<int64_t, std::vector<uint32_t>> rows;
    for (const uint32_t i : of_region_.at(region))
      if (layout[i] != 0 && stands_free(i))
        rows[std::llround(problem_.options[i].position[axis] / one_row_m)].push_back(i);
    const auto most = std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
      return a.second.size() < b.second.size();
    });
    if (rows.size() < 2) return std::nullopt;
    const double line = problem_.options[most->second.front()].position[axis];
    Layout out = layout;
    for (const auto& [row, options] : rows)
      for (const uint32_t i : options) {
        glm::dvec2 place = problem_.options[i].position;
        place[axis] = line;
        const auto moved = at(region, place, problem_.options[i].kind);
        if (!moved) return std::nullopt;
        out[i] = 0;
        out[*moved] = 1;
      }
    return one_each(std::move(out));
  }

  std::optional<Layout> with_other_type(const Layout& layout, uint32_t from, uint32_t to) const {
    Layout out = layout;
    for (const uint32_t i : chosen_in(layout)) {
      const LayoutOption& option = problem_.options[i];
      if (option.kind != from || !stands_free(i)) continue;
      const auto other = at(option.region, option.position, to);
      if (!other) return std::nullopt;
      out[i] = 0;
      out[*other] = 1;
    }
    return one_each(std::move(out));
  }

  /// None if two options of one place are chosen.
  std::optional<Layout> one_each(Layout layout) const {
    std::set<uint32_t> places;
    for (const uint32_t i : chosen_in(layout))
      if (!places.insert(problem_.options[i].place).second) return std::nullopt;
    return layout;
  }

  const LayoutProblem& problem_;
  std::map<uint32_t, Extent> extents_;
  std::map<uint32_t, std::vector<uint32_t>> of_region_;
};

}  // namespace

double symmetry_of(const LayoutProblem& problem, const Layout& layout) {
  const auto extents = extents_of(problem);
  const std::vector<uint32_t> chosen = chosen_in(layout);
  if (chosen.empty()) return 1;
  double paired = 0;
  for (const uint32_t i : chosen)
    for (const int axis : {0, 1}) {
      const LayoutOption& one = problem.options[i];
      const glm::dvec2 image = extents.at(one.region).mirrored(one.position, axis);
      paired += std::any_of(chosen.begin(), chosen.end(), [&](uint32_t k) {
        const LayoutOption& other = problem.options[k];
        return other.region == one.region && other.kind == one.kind &&
               glm::length(other.position - image) < one_place_m;
      });
    }
  return paired / (2 * static_cast<double>(chosen.size()));
}

double preference(const LayoutProblem& problem, const LayoutSums& sums) {
  double light = 0;
  for (const double share : sums.tightest()) light += std::min(share, bright_enough);
  const std::vector<uint32_t> chosen = chosen_in(sums.layout());
  const size_t rows = std::min(rows_along(problem, chosen, 0), rows_along(problem, chosen, 1));
  return light - worth_of_row * static_cast<double>(rows) -
         worth_of_type * static_cast<double>(types_in(problem, chosen)) +
         worth_of_symmetry * symmetry_of(problem, sums.layout());
}

Layout tidied(const LayoutIndex& index, Layout layout) {
  const LayoutProblem& problem = index.problem();
  const LayoutTidier tidier(problem);
  LayoutSums sums(index);
  sums.set(layout);
  double weight = objective_of(problem, layout), liked = preference(problem, sums);
  for (int pass = 0; pass < tidy_passes; ++pass) {
    bool better = false;
    for (const Layout& next : tidier.made_of(layout)) {
      const double next_weight = objective_of(problem, next);
      if (next_weight > weight * (1 + same_weight)) continue;
      sums.set(next);
      if (!sums.holds()) continue;
      const double next_liked = preference(problem, sums);
      if (next_weight > weight * (1 - same_weight) && next_liked <= liked + same_weight) continue;
      layout = next;
      weight = next_weight;
      liked = next_liked;
      better = true;
    }
    if (!better) break;
  }
  return layout;
}

}  // namespace luxodus

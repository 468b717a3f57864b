#include "actors/judge/design/greedy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "actors/judge/design/preference.hpp"

namespace luxodus {

namespace {

/// Smallest divisor of gains: luminaires may have a weight of zero.
constexpr double min_weight = 1e-3;
/// Number of luminaires of a neighbourhood that is emptied.
constexpr size_t min_emptied = 2, max_emptied = 5;
/// Relative difference that counts as rounding.
constexpr double same = 1e-9;

/// For each option, its contribution to violated rows, as a share of their requirements.
class Gains {
 public:
  explicit Gains(const LayoutProblem& problem)
      : problem_(problem), gain_(problem.options.size(), 0) {
    // Options of a pool all count with its largest weight, so that staying at no cost does not win
    // by itself.
    std::vector<double> of_pool(problem.pools.size(), 0);
    for (const LayoutOption& option : problem.options)
      if (option.pool != no_pool)
        of_pool[option.pool] = std::max(of_pool[option.pool], option.weight);
    for (const LayoutOption& option : problem.options)
      weight_.push_back(
          std::max(option.pool == no_pool ? option.weight : of_pool[option.pool], min_weight));
  }

  /// False if no row is violated.
  bool find(const LayoutSums& sums) {
    std::fill(gain_.begin(), gain_.end(), 0);
    bool missing = false;
    for (size_t i = 0; i < problem_.covers.size(); ++i) {
      const double lack = 1 - sums.cover(i);
      if (lack <= sum_tolerance) continue;
      missing = true;
      const CoverRow& row = problem_.covers[i];
      add(*row.terms, 1 / row.least, lack, none);
    }
    if (missing) return true;
    // Failure and spread rows depend on the other luminaires, so they count by the current sums.
    for (const Violation& v : sums.violations()) {
      missing = true;
      if (v.kind == Violation::Kind::failure) {
        const FailureRows& rows = problem_.failures[v.index];
        add(*problem_.points[v.point].light, 1 / rows.least, 1 - v.share, v.place);
      } else {
        const double wanted = sums.at_point(v.brightest) / problem_.spreads[v.index].ratio;
        add(*problem_.points[v.point].light, 1 / wanted, 1 - v.share, none);
      }
    }
    return missing;
  }
  double of(size_t option) const { return gain_[option] / weight_[option]; }

 private:
  static constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

  void add(const std::vector<Term>& terms, double scale, double lack, uint32_t but_place) {
    for (const Term& term : terms)
      if (problem_.options[term.option].place != but_place)
        gain_[term.option] += std::min(scale * static_cast<double>(term.value), lack);
  }

  const LayoutProblem& problem_;
  std::vector<double> gain_, weight_;
};

std::vector<char> taken_places(const LayoutProblem& problem, const Layout& layout) {
  std::vector<char> out(problem.places(), 0);
  for (size_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0) out[problem.options[i].place] = 1;
  return out;
}

/// Chosen options that are not fixed, the heaviest first.
std::vector<uint32_t> removable_in(const LayoutProblem& problem, const Layout& layout) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0 && !problem.options[i].fixed) out.push_back(i);
  std::stable_sort(out.begin(), out.end(), [&](uint32_t a, uint32_t b) {
    return problem.options[a].weight > problem.options[b].weight;
  });
  return out;
}

/// Removes a few luminaires that are close to each other.
Layout emptied(const LayoutProblem& problem, const Layout& layout, Random& random) {
  std::vector<uint32_t> chosen = removable_in(problem, layout);
  if (chosen.empty()) return layout;
  const glm::dvec2 middle = problem.options[chosen[random.bits() % chosen.size()]].position;
  const size_t wanted = min_emptied + random.bits() % (max_emptied - min_emptied + 1);
  std::stable_sort(chosen.begin(), chosen.end(), [&](uint32_t a, uint32_t b) {
    return glm::length(problem.options[a].position - middle) <
           glm::length(problem.options[b].position - middle);
  });
  Layout out = layout;
  for (size_t i = 0; i < std::min(wanted, chosen.size()); ++i) out[chosen[i]] = 0;
  return out;
}

/// Puts movable luminaires that no row needed at the places with the smallest weight: they stay.
/// False if one has no place.
bool fill_pools(const LayoutProblem& problem, LayoutSums& sums, std::vector<char>& taken,
                bool& any) {
  any = false;
  for (uint32_t pool = 0; pool < problem.pools.size(); ++pool)
    while (sums.lack_of(pool) > 0) {
      std::optional<uint32_t> least;
      for (uint32_t i = 0; i < problem.options.size(); ++i) {
        const LayoutOption& option = problem.options[i];
        if (option.pool != pool || option.barred || taken[option.place] != 0) continue;
        if (!least || option.weight < problem.options[*least].weight) least = i;
      }
      if (!least) return false;
      sums.add(*least);
      taken[problem.options[*least].place] = 1;
      any = true;
    }
  return true;
}

/// Moves a luminaire back to its original place if all rows still hold.
void send_home(const LayoutProblem& problem, LayoutSums& sums, uint32_t moved) {
  const std::vector<char> taken = taken_places(problem, sums.layout());
  for (uint32_t i = 0; i < problem.options.size(); ++i) {
    const LayoutOption& option = problem.options[i];
    if (option.pool != problem.options[moved].pool || option.barred || taken[option.place] != 0 ||
        !(option.weight < problem.options[moved].weight))
      continue;
    sums.remove(moved);
    sums.add(i);
    if (sums.holds()) return;
    sums.remove(i);
    sums.add(moved);
  }
}

}  // namespace

std::optional<Layout> completed(const LayoutIndex& index, const Layout& begun, double noise,
                                Random& random) {
  const LayoutProblem& problem = index.problem();
  LayoutSums sums(index);
  Layout start = begun;
  start.resize(problem.options.size(), 0);
  for (size_t i = 0; i < start.size(); ++i)
    if (problem.options[i].fixed) start[i] = 1;
  sums.set(start);
  std::vector<char> taken = taken_places(problem, start);
  Gains gains(problem);
  for (;;) {
    if (!gains.find(sums)) {
      bool any = false;
      if (!fill_pools(problem, sums, taken, any)) return std::nullopt;
      if (!any) break;
      continue;
    }
    double best = 0;
    uint32_t choice = 0;
    for (uint32_t i = 0; i < problem.options.size(); ++i) {
      const LayoutOption& option = problem.options[i];
      if (option.barred || taken[option.place] != 0 || !(gains.of(i) > 0)) continue;
      if (option.pool != no_pool && sums.lack_of(option.pool) <= 0) continue;
      const double score = gains.of(i) * (noise > 0 ? 1 + noise * random.uniform_double() : 1);
      // In symmetric rooms scores differ by rounding only: the first option is taken.
      if (score <= best * (1 + same)) continue;
      best = score;
      choice = i;
    }
    if (!(best > 0)) return std::nullopt;
    sums.add(choice);
    taken[problem.options[choice].place] = 1;
  }
  return sums.layout();
}

Layout pruned(const LayoutIndex& index, const Layout& layout) {
  const LayoutProblem& problem = index.problem();
  LayoutSums sums(index);
  sums.set(layout);
  for (const uint32_t option : removable_in(problem, layout)) {
    if (!(problem.options[option].weight > 0)) continue;
    if (problem.options[option].pool != no_pool) {
      send_home(problem, sums, option);
      continue;
    }
    sums.remove(option);
    if (!sums.holds()) sums.add(option);
  }
  return sums.layout();
}

Layout improved(const LayoutIndex& index, Layout layout, int rounds, uint64_t seed,
                const std::atomic<bool>& interrupt, const std::function<bool()>& out_of_time) {
  const LayoutProblem& problem = index.problem();
  Random random(seed, RandomStream::layout, 1);
  LayoutSums sums(index);
  sums.set(layout);
  double weight = objective_of(problem, layout), liked = preference(problem, sums);
  for (int round = 0; round < rounds && !interrupt && !out_of_time(); ++round) {
    random.start(static_cast<uint64_t>(round));
    const auto filled = completed(index, emptied(problem, layout, random), 1, random);
    if (!filled) continue;
    // A layout that weighs more before pruning may weigh less after it.
    const Layout next = pruned(index, *filled);
    const double next_weight = objective_of(problem, next);
    if (next_weight > weight * (1 + same)) continue;
    sums.set(next);
    const double next_liked = preference(problem, sums);
    if (next_weight > weight * (1 - same) && next_liked <= liked + same) continue;
    layout = next;
    weight = next_weight;
    liked = next_liked;
  }
  return layout;
}

}  // namespace luxodus

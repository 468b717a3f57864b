#include "actors/judge/design/region_bounds.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// Share of the time for joint bounds that one pair may take, so that a hard pair leaves time for
/// others.
constexpr double time_for_pair = 0.5;
/// Rounding of weights.
constexpr double weight_rounding = 1e-6;

class TimeLeft {
 public:
  explicit TimeLeft(double seconds)
      : until_(clock_.now() + static_cast<Nanoseconds>(1e9 * seconds)) {}
  double seconds() const { return seconds_in(until_ - clock_.now()); }

 private:
  SystemClock clock_;
  Nanoseconds until_;
};

}  // namespace

std::map<std::pair<uint32_t, uint32_t>, double> light_between_regions(
    const LayoutProblem& problem) {
  std::map<std::pair<uint32_t, uint32_t>, double> out;
  const auto add = [&](uint32_t group, const std::vector<Term>& terms, double least) {
    const uint32_t of = problem.groups[group].region;
    if (of == no_region) return;
    for (const Term& term : terms) {
      const uint32_t from = problem.options[term.option].region;
      if (from == of || from == no_region) continue;
      out[std::minmax(of, from)] += std::min(static_cast<double>(term.value) / least, 1.0);
    }
  };
  for (const CoverRow& row : problem.covers) add(row.group, *row.terms, row.least);
  for (const FailureRows& rows : problem.failures)
    for (const uint32_t p : rows.points) add(rows.group, *problem.points[p].light, rows.least);
  return out;
}

RegionBounds::RegionBounds(const LayoutProblem& problem, const LayoutIndex& index,
                           const AttainableSums& sums, const std::vector<RegionBound>& known,
                           GrowingProgram& growing, const std::atomic<bool>& interrupt)
    : problem_(problem),
      index_(index),
      sums_(sums),
      growing_(growing),
      interrupt_(interrupt),
      light_(light_between_regions(problem)) {
  std::set<uint32_t> regions;
  for (const LayoutOption& option : problem.options)
    if (option.region != no_region && !option.fixed) regions.insert(option.region);
  for (const RegionBound& one : known) {
    if (!std::includes(regions.begin(), regions.end(), one.regions.begin(), one.regions.end()))
      continue;
    for (const uint32_t region : one.regions) regions.erase(region);
    growing_.add_region_bound(one.regions, one.least);
    bounds_.push_back(one);
  }
  for (const uint32_t region : regions) bounds_.push_back({{region}, 0});
}

void RegionBounds::bound_each(const Layout& layout, double seconds, const Raised& raised) {
  const TimeLeft time(seconds);
  if (!raised(sum())) return;
  std::vector<size_t> asked = smallest_first();
  std::erase_if(asked, [&](size_t i) { return !layout.empty() && !is_loose(layout, bounds_[i]); });
  while (!asked.empty() && time.seconds() > 0 && !interrupt_) {
    // Regions that exceeded their share of the time continue in the time that others left over.
    std::vector<size_t> unfinished;
    size_t left = asked.size();
    for (const size_t i : asked) {
      RegionBound& bound = bounds_[i];
      const Found found =
          bound_of(bound.regions, layout, time.seconds() / static_cast<double>(left--));
      if (!found.finished) unfinished.push_back(i);
      if (interrupt_) return;
      if (found.least <= bound.least) continue;
      bound.least = found.least;
      growing_.add_region_bound(bound.regions, bound.least);
      if (!raised(sum())) return;
    }
    asked = std::move(unfinished);
  }
}

bool RegionBounds::join(const Layout& layout, double seconds, const Raised& raised) {
  const TimeLeft time(seconds);
  for (const auto& [a, b] : pairs_to_try(layout)) {
    if (interrupt_ || time.seconds() <= 0) return false;
    RegionBound both = bounds_[a];
    both.regions.insert(bounds_[b].regions.begin(), bounds_[b].regions.end());
    const double apart = bounds_[a].least + bounds_[b].least;
    both.least = bound_of(both.regions, layout, time_for_pair * time.seconds()).least;
    if (both.least <= apart + weight_rounding) {
      tried_.insert(both.regions);
      continue;
    }
    growing_.add_region_bound(both.regions, both.least);
    bounds_[a] = std::move(both);
    bounds_.erase(bounds_.begin() + static_cast<std::ptrdiff_t>(b));
    raised(sum());
    return true;
  }
  return false;
}

double RegionBounds::weight_of(const Layout& layout, const RegionBound& bound) const {
  double sum = 0;
  for (size_t i = 0; i < layout.size(); ++i) {
    const LayoutOption& option = problem_.options[i];
    if (layout[i] != 0 && !option.fixed && bound.regions.contains(option.region))
      sum += option.weight;
  }
  return sum;
}

bool RegionBounds::is_loose(const Layout& layout, const RegionBound& bound) const {
  return weight_of(layout, bound) > bound.least + weight_rounding;
}

double RegionBounds::sum() const {
  double out = 0;
  for (const RegionBound& bound : bounds_) out += bound.least;
  return out;
}

std::vector<size_t> RegionBounds::smallest_first() const {
  std::vector<size_t> options(bounds_.size(), 0), out(bounds_.size());
  for (size_t i = 0; i < bounds_.size(); ++i)
    options[i] = static_cast<size_t>(std::count_if(
        problem_.options.begin(), problem_.options.end(),
        [&](const LayoutOption& one) { return bounds_[i].regions.contains(one.region); }));
  std::iota(out.begin(), out.end(), size_t{0});
  std::stable_sort(out.begin(), out.end(),
                   [&](size_t a, size_t b) { return options[a] < options[b]; });
  return out;
}

double RegionBounds::light_between(const RegionBound& a, const RegionBound& b) const {
  double out = 0;
  for (const uint32_t i : a.regions)
    for (const uint32_t k : b.regions)
      if (const auto at = light_.find(std::minmax(i, k)); at != light_.end()) out += at->second;
  return out;
}

std::vector<std::pair<size_t, size_t>> RegionBounds::pairs_to_try(const Layout& layout) const {
  std::vector<std::pair<double, std::pair<size_t, size_t>>> found;
  for (size_t a = 0; a < bounds_.size(); ++a)
    for (size_t b = a + 1; b < bounds_.size(); ++b) {
      if (!is_loose(layout, bounds_[a]) && !is_loose(layout, bounds_[b])) continue;
      std::set<uint32_t> both = bounds_[a].regions;
      both.insert(bounds_[b].regions.begin(), bounds_[b].regions.end());
      const double light = light_between(bounds_[a], bounds_[b]);
      if (light > 0 && !tried_.contains(both)) found.push_back({light, {a, b}});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<std::pair<size_t, size_t>> out;
  for (const auto& [light, pair] : found) out.push_back(pair);
  return out;
}

/// Only asks whether these regions can weigh less than in the layout, since nothing else can
/// improve it.
RegionBounds::Found RegionBounds::bound_of(const std::set<uint32_t>& regions, const Layout& layout,
                                           double seconds) {
  const TimeLeft time(seconds);
  std::optional<double> cutoff;
  if (!layout.empty()) cutoff = sums_.just_below(weight_of(layout, {regions, 0}));
  LayoutSums sums(index_);
  Found out;
  for (int round = 0; round < limits::row_rounds && !interrupt_; ++round) {
    const ProgramLimits asked{.seconds = time.seconds(), .cutoff = cutoff};
    const ProgramAnswer found = solve_program(growing_.of_regions(regions), asked, interrupt_, {});
    if (found.end == ProgramEnd::infeasible) {
      // Without a cutoff, the whole program finds the infeasibility itself.
      if (cutoff) out.least = std::max(out.least, sums_.from(*cutoff));
      out.finished = true;
      break;
    }
    // The bound is on layouts below the cutoff; all others weigh more than the cutoff.
    const double bound = cutoff ? std::min(found.bound, *cutoff) : found.bound;
    out.least = std::max(out.least, sums_.from(bound));
    if (found.end == ProgramEnd::stopped || found.values.empty()) break;
    sums.set(growing_.layout_of(found.values));
    auto broken = sums.violations();
    std::erase_if(broken, [&](const Violation& v) {
      const uint32_t of = problem_.groups[group_of(problem_, v)].region;
      return of != no_region && !regions.contains(of);
    });
    out.finished = broken.empty();
    if (out.finished || time.seconds() <= 0) break;
    for (const Violation& v : spread_out(problem_, broken, limits::rows_per_round)) growing_.add(v);
  }
  return out;
}

}  // namespace luxodus

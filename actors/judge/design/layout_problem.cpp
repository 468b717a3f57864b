#include "actors/judge/design/layout_problem.hpp"

#include <algorithm>
#include <limits>

namespace luxodus {

size_t LayoutProblem::places() const {
  uint32_t most = 0;
  for (const LayoutOption& option : options) most = std::max(most, option.place + 1);
  return most;
}

double objective_of(const LayoutProblem& problem, const Layout& layout) {
  double sum = 0;
  for (size_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0) sum += problem.options[i].weight;
  return sum;
}

LayoutIndex::LayoutIndex(const LayoutProblem& problem)
    : problem_(problem), covers_(problem.options.size()), points_(problem.options.size()) {
  for (uint32_t i = 0; i < problem.covers.size(); ++i)
    for (const Term& term : *problem.covers[i].terms)
      covers_[term.option].push_back({i, static_cast<float>(term.value / problem.covers[i].least)});
  std::vector<char> wanted(problem.points.size(), 0);
  for (const FailureRows& rows : problem.failures)
    for (const uint32_t p : rows.points) wanted[p] = 1;
  for (const SpreadRows& rows : problem.spreads)
    for (const auto* list : {&rows.low, &rows.high})
      for (const uint32_t p : *list) wanted[p] = 1;
  for (uint32_t i = 0; i < problem.points.size(); ++i)
    if (wanted[i] != 0)
      for (const Term& term : *problem.points[i].light)
        points_[term.option].push_back({i, term.value});
}

LayoutSums::LayoutSums(const LayoutIndex& index)
    : index_(index),
      problem_(index.problem()),
      cover_(problem_.covers.size(), 0),
      light_(problem_.points.size(), 0),
      in_pool_(problem_.pools.size(), 0),
      layout_(problem_.options.size(), 0) {}

void LayoutSums::set(const Layout& layout) {
  std::fill(cover_.begin(), cover_.end(), 0);
  std::fill(light_.begin(), light_.end(), 0);
  std::fill(in_pool_.begin(), in_pool_.end(), 0);
  std::fill(layout_.begin(), layout_.end(), 0);
  for (uint32_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0) add(i);
}

void LayoutSums::change(uint32_t option, int sign) {
  layout_[option] = sign > 0 ? 1 : 0;
  if (const uint32_t pool = problem_.options[option].pool; pool != no_pool) in_pool_[pool] += sign;
  for (const auto& e : index_.covers(option)) cover_[e.row] += sign * static_cast<double>(e.value);
  for (const auto& e : index_.points(option)) light_[e.row] += sign * static_cast<double>(e.value);
}

bool LayoutSums::covers_hold() const {
  return std::all_of(cover_.begin(), cover_.end(),
                     [](double share) { return share >= 1 - sum_tolerance; });
}

void LayoutSums::find_largest(std::vector<float>& largest, std::vector<uint32_t>& whose) const {
  largest.assign(light_.size(), 0);
  whose.assign(light_.size(), no_place);
  for (uint32_t i = 0; i < layout_.size(); ++i) {
    if (layout_[i] == 0 || problem_.options[i].never_fails) continue;
    for (const auto& e : index_.points(i))
      if (e.value > largest[e.row]) {
        largest[e.row] = e.value;
        whose[e.row] = problem_.options[i].place;
      }
  }
}

std::vector<Violation> LayoutSums::violations(double below) const {
  std::vector<Violation> out;
  using Kind = Violation::Kind;
  for (uint32_t i = 0; i < cover_.size(); ++i)
    if (cover_[i] < below) out.push_back({Kind::cover, i, 0, 0, 0, cover_[i]});
  std::vector<float> largest;
  std::vector<uint32_t> whose;
  if (!problem_.failures.empty()) find_largest(largest, whose);
  for (uint32_t i = 0; i < problem_.failures.size(); ++i) {
    const FailureRows& rows = problem_.failures[i];
    for (const uint32_t p : rows.points) {
      const double share = (light_[p] - static_cast<double>(largest[p])) / rows.least;
      if (share < below) out.push_back({Kind::failure, i, p, whose[p], 0, share});
    }
  }
  for (uint32_t i = 0; i < problem_.spreads.size(); ++i) {
    const SpreadRows& rows = problem_.spreads[i];
    if (rows.low.empty() || rows.high.empty()) continue;
    const auto darker = [&](uint32_t a, uint32_t b) { return light_[a] < light_[b]; };
    const uint32_t low = *std::min_element(rows.low.begin(), rows.low.end(), darker);
    const uint32_t high = *std::max_element(rows.high.begin(), rows.high.end(), darker);
    if (!(light_[high] > 0)) continue;
    const double share = rows.ratio * light_[low] / light_[high];
    if (share < below) out.push_back({Kind::spread, i, low, 0, high, share});
  }
  return out;
}

std::vector<double> LayoutSums::tightest() const {
  std::vector<double> out(problem_.groups.size(), std::numeric_limits<double>::infinity());
  const auto offer = [&](uint32_t group, double share) {
    out[group] = std::min(out[group], share);
  };
  for (size_t i = 0; i < cover_.size(); ++i) offer(problem_.covers[i].group, cover_[i]);
  std::vector<float> largest;
  std::vector<uint32_t> whose;
  if (!problem_.failures.empty()) find_largest(largest, whose);
  for (const FailureRows& rows : problem_.failures)
    for (const uint32_t p : rows.points)
      offer(rows.group, (light_[p] - static_cast<double>(largest[p])) / rows.least);
  for (const SpreadRows& rows : problem_.spreads) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const uint32_t p : rows.low) low = std::min(low, light_[p]);
    for (const uint32_t p : rows.high) high = std::max(high, light_[p]);
    if (high > 0) offer(rows.group, rows.ratio * low / high);
  }
  return out;
}

int64_t LayoutSums::lack_of(size_t pool) const {
  return static_cast<int64_t>(problem_.pools[pool]) - in_pool_[pool];
}

bool LayoutSums::holds() const {
  for (size_t pool = 0; pool < in_pool_.size(); ++pool)
    if (lack_of(pool) != 0) return false;
  return covers_hold() && violations().empty();
}

}  // namespace luxodus

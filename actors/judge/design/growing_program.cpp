#include "actors/judge/design/growing_program.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace luxodus {

namespace {

constexpr double infinite_row = std::numeric_limits<double>::infinity();
/// Smallest distance of rows of one group that are added together [m]: neighbouring rows are nearly
/// equal.
constexpr double apart_m = 1;
/// Relative increase of the requirement of a row that the solver violates by rounding.
constexpr double raised_again = 1e-5;
/// Terms below this share of a row's requirement are left out, and the requirement is reduced by
/// their sum. The row becomes weaker, so the bound stays valid.
constexpr double small_term = 1e-5;
/// A place that gives a smaller share of the requirement gets no row for its failure.
constexpr double large_share = 0.02;
/// An option is chosen if its variable is above this.
constexpr double chosen_above = 0.5;
constexpr double infinite_light = 1e6;

const glm::dvec3& place_of(const LayoutProblem& problem, const Violation& v) {
  return v.kind == Violation::Kind::cover ? problem.covers[v.index].place
                                          : problem.points[v.point].place;
}

}  // namespace

GrowingProgram::GrowingProgram(const LayoutProblem& problem, bool feasible_only)
    : problem_(problem) {
  for (const LayoutOption& option : problem.options)
    program_.add_variable(feasible_only || option.fixed ? 0 : option.weight, option.fixed ? 1 : 0,
                          option.barred ? 0 : 1, true);
  add_places();
  add_pools();
  for (size_t i = 0; i < problem.spreads.size(); ++i)
    darkest_.push_back(program_.add_variable(0, 0, infinite_light, false));
}

GrowingProgram::RowKey GrowingProgram::key_of(const Violation& v) {
  return {static_cast<int>(v.kind), v.index, v.point,
          v.kind == Violation::Kind::spread ? v.brightest : v.place};
}

IntegerProgram GrowingProgram::of_regions(const std::set<uint32_t>& regions) const {
  IntegerProgram out = program_;
  for (size_t i = 0; i < problem_.options.size(); ++i)
    if (!regions.contains(problem_.options[i].region)) out.cost[i] = 0;
  out.rows.clear();
  for (size_t i = 0; i < program_.rows.size(); ++i) {
    const int group = groups_[i];
    if (group >= 0) {
      const uint32_t of = problem_.groups[static_cast<size_t>(group)].region;
      if (of != no_region && !regions.contains(of)) continue;
    }
    out.rows.push_back(program_.rows[i]);
  }
  return out;
}

IntegerProgram GrowingProgram::around(const Layout& layout,
                                      const std::set<uint32_t>& regions) const {
  IntegerProgram out = program_;
  for (size_t i = 0; i < problem_.options.size(); ++i)
    if (!regions.contains(problem_.options[i].region))
      out.low[i] = out.high[i] = layout[i] != 0 ? 1 : 0;
  return out;
}

void GrowingProgram::add_region_bound(const std::set<uint32_t>& regions, double least) {
  if (!(least > 0)) return;
  LinearRow row;
  for (size_t i = 0; i < problem_.options.size(); ++i) {
    if (!regions.contains(problem_.options[i].region) || !(program_.cost[i] > 0)) continue;
    row.column.push_back(static_cast<int>(i));
    row.value.push_back(program_.cost[i]);
  }
  row.low = least;
  row.high = infinite_row;
  add_row(std::move(row), of_bound);
}

bool GrowingProgram::has(const Violation& v) const {
  return known_.contains(v.kind == Violation::Kind::failure ? whole_key(v) : key_of(v));
}

bool GrowingProgram::add(const Violation& v) {
  const bool fresh = known_.insert(key_of(v)).second;
  const double more = fresh ? 1 : 1 + raised_again;
  switch (v.kind) {
    case Violation::Kind::cover: {
      const CoverRow& row = problem_.covers[v.index];
      add_cover(*row.terms, row.least * more, no_place, row.group);
      break;
    }
    case Violation::Kind::failure: {
      const FailureRows& rows = problem_.failures[v.index];
      const std::vector<Term>& light = *problem_.points[v.point].light;
      if (known_.insert(whole_key(v)).second)
        add_failure(light, rows.least, rows.group);
      else
        add_cover(light, rows.least * more, v.place, rows.group);
      break;
    }
    case Violation::Kind::spread:
      add_spread(v, more);
      break;
  }
  return fresh;
}

Layout GrowingProgram::layout_of(const std::vector<double>& values) const {
  Layout out(problem_.options.size(), 0);
  for (size_t i = 0; i < out.size(); ++i) out[i] = values[i] > chosen_above ? 1 : 0;
  return out;
}

void GrowingProgram::add_row(LinearRow row, int group) {
  program_.rows.push_back(std::move(row));
  groups_.push_back(group);
}

void GrowingProgram::add_places() {
  std::vector<LinearRow> at(problem_.places());
  for (size_t i = 0; i < problem_.options.size(); ++i) {
    LinearRow& row = at[problem_.options[i].place];
    row.column.push_back(static_cast<int>(i));
    row.value.push_back(1);
  }
  for (LinearRow& row : at) {
    if (row.column.size() < 2) continue;
    row.low = -infinite_row;
    row.high = 1;
    add_row(std::move(row), of_place);
  }
}

/// A movable luminaire is at one of its places.
void GrowingProgram::add_pools() {
  std::vector<LinearRow> of(problem_.pools.size());
  for (size_t i = 0; i < problem_.options.size(); ++i) {
    if (problem_.options[i].pool == no_pool) continue;
    LinearRow& row = of[problem_.options[i].pool];
    row.column.push_back(static_cast<int>(i));
    row.value.push_back(1);
  }
  for (size_t pool = 0; pool < of.size(); ++pool) {
    if (of[pool].column.empty()) continue;  // it is in another part
    of[pool].low = of[pool].high = static_cast<double>(problem_.pools[pool]);
    add_row(std::move(of[pool]), of_place);
  }
}

/// Terms are clipped at the requirement. That keeps every layout feasible and cuts off fractional
/// solutions.
void GrowingProgram::add_cover(const std::vector<Term>& terms, double least, uint32_t but_place,
                               uint32_t group) {
  LinearRow row;
  double left_out = 0;
  for (const Term& term : terms) {
    if (problem_.options[term.option].place == but_place) continue;
    const double share = std::min(static_cast<double>(term.value) / least, 1.0);
    if (share < small_term) {
      left_out += share;
      continue;
    }
    row.column.push_back(static_cast<int>(term.option));
    row.value.push_back(share);
  }
  row.low = 1 - left_out;
  row.high = infinite_row;
  add_row(std::move(row), static_cast<int>(group));
}

/// Sum without the luminaire of any one place: the sum of all places is at least the requirement
/// plus the largest share of one place, which is a variable. A row for each place would be
/// equivalent, but would be added one after another, as neighbours take over.
void GrowingProgram::add_failure(const std::vector<Term>& light, double least, uint32_t group) {
  const int largest = program_.add_variable(0, 0, 1, false);
  std::map<uint32_t, LinearRow> of_place_out;
  for (const Term& term : light) {
    const double share = std::min(static_cast<double>(term.value) / least, 1.0);
    if (share < large_share || problem_.options[term.option].never_fails) continue;
    LinearRow& row = of_place_out[problem_.options[term.option].place];
    row.column.push_back(static_cast<int>(term.option));
    row.value.push_back(share);
  }
  for (auto& [place, row] : of_place_out) {
    row.column.push_back(largest);
    row.value.push_back(-1);
    row.low = -infinite_row;
    row.high = 0;
    add_row(std::move(row), of_place);
  }
  add_cover(light, least, no_place, group);
  program_.rows.back().column.push_back(largest);
  program_.rows.back().value.push_back(-1);
}

/// Darkest light <= light of this point; light of the brightest point <= `ratio` times the darkest
/// light.
void GrowingProgram::add_spread(const Violation& v, double more) {
  const SpreadRows& rows = problem_.spreads[v.index];
  const int darkest = darkest_[v.index];
  LinearRow low, high;
  for (const Term& term : *problem_.points[v.point].light) {
    low.column.push_back(static_cast<int>(term.option));
    low.value.push_back(static_cast<double>(term.value));
  }
  low.column.push_back(darkest);
  low.value.push_back(-1);
  low.low = 0;
  low.high = infinite_row;
  for (const Term& term : *problem_.points[v.brightest].light) {
    high.column.push_back(static_cast<int>(term.option));
    high.value.push_back(static_cast<double>(term.value) / rows.ratio);
  }
  high.column.push_back(darkest);
  high.value.push_back(-1 / more);
  high.low = -infinite_row;
  high.high = 0;
  add_row(std::move(low), static_cast<int>(rows.group));
  add_row(std::move(high), static_cast<int>(rows.group));
}

uint32_t group_of(const LayoutProblem& problem, const Violation& v) {
  switch (v.kind) {
    case Violation::Kind::cover:
      return problem.covers[v.index].group;
    case Violation::Kind::failure:
      return problem.failures[v.index].group;
    case Violation::Kind::spread:
      return problem.spreads[v.index].group;
  }
  return 0;
}

std::vector<Violation> spread_out(const LayoutProblem& problem, std::vector<Violation> all,
                                  size_t most) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Violation& a, const Violation& b) { return a.share < b.share; });
  std::vector<Violation> out;
  std::map<uint32_t, std::vector<glm::dvec3>> taken;
  for (const Violation& v : all) {
    if (out.size() >= most) break;
    auto& near = taken[group_of(problem, v)];
    const glm::dvec3& place = place_of(problem, v);
    if (std::any_of(near.begin(), near.end(),
                    [&](const glm::dvec3& other) { return glm::length(place - other) < apart_m; }))
      continue;
    near.push_back(place);
    out.push_back(v);
  }
  return out;
}

std::vector<Violation> first_rows(const LayoutProblem& problem) {
  std::vector<Violation> all;
  for (uint32_t i = 0; i < problem.covers.size(); ++i) {
    const CoverRow& row = problem.covers[i];
    double sum = 0;
    for (const Term& term : *row.terms)
      sum += std::min(static_cast<double>(term.value) / row.least, 1.0);
    all.push_back({Violation::Kind::cover, i, 0, 0, 0, sum});
  }
  return spread_out(problem, std::move(all), all.size());
}

}  // namespace luxodus

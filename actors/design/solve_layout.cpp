#include "actors/design/solve_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "actors/design/greedy.hpp"
#include "actors/design/mixed_integer_program.hpp"
#include "actors/design/split_problem.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Rows of a kind are taken so far apart at first, and in each round after it [m]: neighbours say
/// nearly the same.
constexpr double apart_m = 1;
/// Rows that one round adds.
constexpr size_t rows_per_round = 80;
/// Early rounds need no proof: their rows are not all there yet.
constexpr double loose_gap = 0.04;
/// Of the time of the search, what may go into the bounds of regions.
constexpr double time_for_regions = 0.4;
/// And how much after it into what binds.
constexpr double time_for_prices = 0.05;
/// A variable is chosen above this.
constexpr double chosen_above = 0.5;
/// A row that the solver's rounding breaks, though it has it, is asked for by so much more.
constexpr double raised = 1e-5;
/// Terms below this share of what a row asks for are left out of the program, which makes its row
/// weaker by all of them together: the bound stays a bound.
constexpr double small_term = 1e-5;
/// A place that gives less than this share of what is asked for may fail without a row of its own.
constexpr double large_share = 0.02;
/// Rounding of an objective.
constexpr double rounding = 1e-6;

/// The greatest step that every objective is a multiple of; 0 where there is none.
double step_of(const LayoutProblem& problem) {
  int64_t step = 0;
  for (const LayoutOption& option : problem.options) {
    const double weight = option.fixed ? 0 : option.weight;
    if (weight != std::floor(weight) || weight > 1e9) return 0;
    step = std::gcd(step, static_cast<int64_t>(weight));
  }
  return static_cast<double>(step);
}

/// What tells rows apart: kind, index, point, and the place or the brightest point.
using RowKey = std::tuple<int, uint32_t, uint32_t, uint32_t>;

RowKey key_of(const Violation& v) {
  return {static_cast<int>(v.kind), v.index, v.point,
          v.kind == Violation::Kind::spread ? v.brightest : v.place};
}

/// Of all failures at a point.
RowKey whole_key(const Violation& v) {
  return {-1, v.index, v.point, 0};
}

/// The integer program of those rows that have been asked for so far.
class GrowingProgram {
 public:
  /// `feasible_only`: any layout will do.
  GrowingProgram(const LayoutProblem& problem, bool feasible_only) : problem_(problem) {
    for (const LayoutOption& option : problem.options)
      program_.add_variable(feasible_only || option.fixed ? 0 : option.weight, option.fixed ? 1 : 0,
                            1, true);
    add_places();
    for (size_t i = 0; i < problem.spreads.size(); ++i)
      darkest_.push_back(program_.add_variable(0, 0, infinite_light, false));
  }

  const IntegerProgram& program() const { return program_; }
  /// The same rows, where only the options of one region cost anything.
  IntegerProgram of_region(uint32_t region) const {
    IntegerProgram out = program_;
    for (size_t i = 0; i < problem_.options.size(); ++i)
      if (problem_.options[i].region != region) out.cost[i] = 0;
    return out;
  }
  /// No layout's options of the region weigh less than this together.
  void add_region_bound(uint32_t region, double least) {
    LinearRow row;
    for (size_t i = 0; i < problem_.options.size(); ++i) {
      if (problem_.options[i].region != region || !(program_.cost[i] > 0)) continue;
      row.column.push_back(static_cast<int>(i));
      row.value.push_back(program_.cost[i]);
    }
    row.low = least;
    row.high = infinite;
    add_row(std::move(row), of_bound);
  }
  /// Rows that follow from the others; and those of places.
  static constexpr int of_bound = -2, of_place = -1;

  size_t rows() const { return program_.rows.size(); }
  /// Groups of the rows, as numbers of the problem; below 0: of none.
  const std::vector<int>& groups() const { return groups_; }

  /// False where the row is there already: then it is asked for by a little more.
  bool add(const Violation& v) {
    const bool fresh = known_.insert(key_of(v)).second;
    const double more = fresh ? 1 : 1 + raised;
    switch (v.kind) {
      case Violation::Kind::cover: {
        const CoverRow& row = problem_.covers[v.index];
        add_cover(*row.terms, row.least * more, none, row.group);
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

  Layout layout_of(const std::vector<double>& values) const {
    Layout out(problem_.options.size(), 0);
    for (size_t i = 0; i < out.size(); ++i) out[i] = values[i] > chosen_above ? 1 : 0;
    return out;
  }

 private:
  static constexpr uint32_t none = std::numeric_limits<uint32_t>::max();
  static constexpr double infinite_light = 1e6;

  void add_row(LinearRow row, int group) {
    program_.rows.push_back(std::move(row));
    groups_.push_back(group);
  }

  void add_places() {
    std::vector<LinearRow> at(problem_.places());
    for (size_t i = 0; i < problem_.options.size(); ++i) {
      LinearRow& row = at[problem_.options[i].place];
      row.column.push_back(static_cast<int>(i));
      row.value.push_back(1);
    }
    for (LinearRow& row : at) {
      if (row.column.size() < 2) continue;
      row.low = -infinite;
      row.high = 1;
      add_row(std::move(row), of_place);
    }
  }

  /// More than all that a row asks for helps it no more: clipped terms keep every layout and cut
  /// off fractions of luminaires.
  void add_cover(const std::vector<Term>& terms, double least, uint32_t but_place, uint32_t group) {
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
    row.high = infinite;
    add_row(std::move(row), static_cast<int>(group));
  }

  /// With the luminaire of any one place out, enough is left: all that is there is not below what
  /// is asked for and the largest share of one place, which is a variable. A row for each place
  /// that may be out says the same, and is asked for one after another, as neighbours take over.
  void add_failure(const std::vector<Term>& light, double least, uint32_t group) {
    const int largest = program_.add_variable(0, 0, 1, false);
    std::map<uint32_t, LinearRow> of_place_out;
    for (const Term& term : light) {
      const double share = std::min(static_cast<double>(term.value) / least, 1.0);
      if (share < large_share) continue;
      LinearRow& row = of_place_out[problem_.options[term.option].place];
      row.column.push_back(static_cast<int>(term.option));
      row.value.push_back(share);
    }
    for (auto& [place, row] : of_place_out) {
      row.column.push_back(largest);
      row.value.push_back(-1);
      row.low = -infinite;
      row.high = 0;
      add_row(std::move(row), of_place);
    }
    add_cover(light, least, none, group);
    program_.rows.back().column.push_back(largest);
    program_.rows.back().value.push_back(-1);
  }

  /// The darkest is at most this point's light; the brightest at most `ratio` times the darkest.
  void add_spread(const Violation& v, double more) {
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
    low.high = infinite;
    for (const Term& term : *problem_.points[v.brightest].light) {
      high.column.push_back(static_cast<int>(term.option));
      high.value.push_back(static_cast<double>(term.value) / rows.ratio);
    }
    high.column.push_back(darkest);
    high.value.push_back(-1 / more);
    high.low = -infinite;
    high.high = 0;
    add_row(std::move(low), static_cast<int>(rows.group));
    add_row(std::move(high), static_cast<int>(rows.group));
  }

  const LayoutProblem& problem_;
  IntegerProgram program_;
  std::vector<int> groups_, darkest_;
  std::set<RowKey> known_;
};

const glm::dvec3& place_of(const LayoutProblem& problem, const Violation& v) {
  return v.kind == Violation::Kind::cover ? problem.covers[v.index].place
                                          : problem.points[v.point].place;
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

/// The worst of them, none near to another of its group.
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

/// Rows to begin with: of each group those that are hardest to satisfy, apart from each other.
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

class Solving {
 public:
  Solving(const LayoutProblem& problem, const SolveSettings& settings,
          const std::atomic<bool>& interrupt, const SolveProgress& progress)
      : problem_(problem),
        settings_(settings),
        interrupt_(interrupt),
        progress_(progress),
        index_(problem),
        step_(step_of(problem)),
        began_(clock_.now()) {}

  LayoutAnswer run() {
    greedy();
    integer_program();
    choose_among_equals();
    answer_.seconds = seconds();
    return std::move(answer_);
  }

 private:
  double seconds() const { return 1e-9 * static_cast<double>(clock_.now() - began_); }
  bool out_of_time() const { return seconds() > settings_.seconds; }
  void tell(const char* what, double bound) const {
    progress_(what, answer_.layout.empty() ? infinite : answer_.objective,
              std::max(bound, answer_.bound));
  }

  /// Requires: it holds.
  void offer(const Layout& layout) {
    const double objective = objective_of(problem_, layout);
    if (!answer_.layout.empty() && objective >= answer_.objective - rounding) return;
    if (answer_.layout.empty()) answer_.first_seconds = seconds();
    answer_.layout = layout;
    answer_.objective = objective;
  }

  void greedy() {
    tell("greedy", 0);
    Random random(settings_.seed, RandomStream::layout);
    random.start(0);
    const auto first = completed(index_, {}, 0, random);
    if (!first) return;
    const Layout layout = pruned(index_, *first);
    offer(layout);
    answer_.greedy = true;
    answer_.greedy_objective = answer_.objective;
    offer(better(layout));
    tell("greedy", 0);
  }

  Layout better(const Layout& layout) {
    return improved(index_, layout, settings_.greedy_rounds, settings_.seed, interrupt_,
                    [this] { return out_of_time(); });
  }

  void raise_bound(double bound) {
    bound = rounded_up(bound) + fixed_weight();
    answer_.bound = std::max(answer_.bound, bound);
    if (!answer_.layout.empty()) answer_.bound = std::min(answer_.bound, answer_.objective);
  }

  /// The program counts nothing for what is fixed.
  double fixed_weight() const {
    double sum = 0;
    for (const LayoutOption& option : problem_.options) sum += option.fixed ? option.weight : 0;
    return sum;
  }

  /// A layout that breaks rows, made whole.
  void offer_repaired(const Layout& layout) {
    Random random(settings_.seed, RandomStream::layout, 2);
    random.start(static_cast<uint64_t>(answer_.rounds));
    if (const auto whole = completed(index_, layout, 0, random)) offer(pruned(index_, *whole));
  }

  /// The greatest objective that is still wanted; none where there is no layout yet.
  std::optional<double> cutoff() const {
    if (answer_.layout.empty()) return std::nullopt;
    const double of_program = answer_.objective - fixed_weight();
    const double less = step_ > 0 ? step_ * (1 - 1e-3) : std::max(of_program * rounding, 1e-9);
    return of_program - less;
  }

  ProgramAnswer solve(const GrowingProgram& growing, double gap) {
    const ProgramLimits asked{
        .seconds = settings_.seconds - seconds(), .gap = gap, .cutoff = cutoff()};
    return solve_program(growing.program(), asked, interrupt_, [&](double, double bound) {
      tell("integer program", bound + fixed_weight());
    });
  }

  void integer_program() {
    GrowingProgram growing(problem_, false);
    for (const Violation& v : first_rows(problem_)) growing.add(v);
    bound_regions(growing);
    double gap = std::max(loose_gap, settings_.gap);
    LayoutSums sums(index_);
    for (answer_.rounds = 1; answer_.rounds <= limits::row_rounds; ++answer_.rounds) {
      const ProgramAnswer found = solve(growing, gap);
      answer_.rows = growing.rows();
      if (found.end == ProgramEnd::infeasible) {
        // No layout is better than the one that is there, or none exists.
        if (!answer_.layout.empty()) answer_.bound = answer_.objective;
        answer_.end = answer_.layout.empty() ? LayoutEnd::infeasible : LayoutEnd::optimal;
        break;
      }
      raise_bound(found.bound);
      if (!found.values.empty()) {
        sums.set(growing.layout_of(found.values));
        const auto broken = sums.violations();
        if (broken.empty())
          offer(sums.layout());
        else
          offer_repaired(sums.layout());
        raise_bound(found.bound);
        tell(("integer program, round " + std::to_string(answer_.rounds)).c_str(), 0);
        for (const Violation& v : spread_out(problem_, broken, rows_per_round)) growing.add(v);
        if (broken.empty() && gap > settings_.gap) gap = settings_.gap;
      }
      if (ended(found)) break;
    }
    fill_shares(growing);
  }

  double rounded_up(double bound) const {
    // Objectives are multiples of a step: the next one is the bound.
    return step_ > 0 ? std::ceil((bound - rounding) / step_) * step_ : bound;
  }

  /// Each region by itself, the others' luminaires free: whole numbers of each region add up to
  /// more than the whole number of all of them, and each is found sooner.
  void bound_regions(GrowingProgram& growing) {
    std::set<uint32_t> regions;
    for (const LayoutOption& option : problem_.options)
      if (option.region != no_region && !option.fixed) regions.insert(option.region);
    if (regions.size() < 2) return;
    const double until = seconds() + time_for_regions * (settings_.seconds - seconds());
    size_t left = regions.size();
    double sum = 0;
    for (const uint32_t region : regions) {
      const double share = (until - seconds()) / static_cast<double>(left--);
      const double least = rounded_up(bound_of_region(growing, region, share));
      if (least > 0) growing.add_region_bound(region, least);
      sum += least;
      raise_bound(sum);
      tell("regions", 0);
    }
  }

  double bound_of_region(GrowingProgram& growing, uint32_t region, double seconds_left) {
    const double until = seconds() + seconds_left;
    LayoutSums sums(index_);
    double bound = 0;
    for (int round = 0; round < limits::row_rounds && !interrupt_; ++round) {
      const ProgramAnswer found =
          solve_program(growing.of_region(region), {.seconds = until - seconds()}, interrupt_, {});
      // Without any layout the whole program says so.
      if (found.end == ProgramEnd::infeasible) return bound;
      bound = std::max(bound, found.bound);
      if (found.end == ProgramEnd::stopped || found.values.empty()) return bound;
      sums.set(growing.layout_of(found.values));
      auto broken = sums.violations();
      std::erase_if(broken, [&](const Violation& v) {
        const uint32_t of = problem_.groups[group_of(problem_, v)].region;
        return of != region && of != no_region;
      });
      if (broken.empty() || seconds() > until) return bound;
      for (const Violation& v : spread_out(problem_, broken, rows_per_round)) growing.add(v);
    }
    return bound;
  }

  bool ended(const ProgramAnswer& found) {
    const bool stopped = found.end == ProgramEnd::stopped || interrupt_;
    const bool proven = !answer_.layout.empty() && answer_.bound >= answer_.objective - rounding;
    const bool near = !answer_.layout.empty() && answer_.gap() <= settings_.gap;
    if (proven)
      answer_.end = LayoutEnd::optimal;
    else if (near)
      answer_.end = LayoutEnd::within_gap;
    else if (found.interrupted || interrupt_)
      answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::interrupted;
    else if (stopped || out_of_time())
      answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::out_of_time;
    else
      return false;
    return true;
  }

  /// Of the program without whole numbers: what each group's rows add to its objective.
  void fill_shares(const GrowingProgram& growing) {
    answer_.share_of_group.assign(problem_.groups.size(), 0);
    IntegerProgram program = growing.program();
    for (size_t i = 0; i < program.rows.size(); ++i)
      if (growing.groups()[i] == GrowingProgram::of_bound) program.rows[i].low = 0;
    // What binds is worth knowing after the time is out, too, but not for long.
    const double left =
        std::max(settings_.seconds - seconds(), time_for_prices * settings_.seconds);
    const auto prices = row_prices(program, left, interrupt_);
    for (size_t i = 0; i < prices.size(); ++i) {
      const LinearRow& row = program.rows[i];
      if (growing.groups()[i] >= 0 && std::isfinite(row.low))
        answer_.share_of_group[static_cast<size_t>(growing.groups()[i])] += prices[i] * row.low;
    }
  }

  void choose_among_equals() {
    if (answer_.layout.empty() || answer_.end == LayoutEnd::interrupted) return;
    tell("choosing among equals", 0);
    const Layout liked = better(answer_.layout);
    const double objective = objective_of(problem_, liked);
    if (objective <= answer_.objective + rounding) {
      answer_.layout = liked;
      answer_.objective = objective;
    }
  }

  const LayoutProblem& problem_;
  const SolveSettings& settings_;
  const std::atomic<bool>& interrupt_;
  const SolveProgress& progress_;
  LayoutIndex index_;
  double step_;
  SystemClock clock_;
  Nanoseconds began_;
  LayoutAnswer answer_;
};

/// Those of a problem's groups alone.
LayoutProblem only(const LayoutProblem& problem, const std::set<uint32_t>& groups) {
  LayoutProblem out = problem;
  const auto other = [&](const auto& rows) { return !groups.contains(rows.group); };
  std::erase_if(out.covers, other);
  std::erase_if(out.failures, other);
  std::erase_if(out.spreads, other);
  return out;
}

enum class Exists { yes, no, not_known };

Exists layout_exists(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt) {
  const LayoutIndex index(problem);
  Random random(1, RandomStream::layout);
  random.start(0);
  if (completed(index, {}, 0, random)) return Exists::yes;
  GrowingProgram growing(problem, true);
  for (const Violation& v : first_rows(problem)) growing.add(v);
  LayoutSums sums(index);
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  for (int round = 0; round < limits::row_rounds; ++round) {
    const double left = seconds - 1e-9 * static_cast<double>(clock.now() - began);
    if (left <= 0 || interrupt) return Exists::not_known;
    const ProgramAnswer found =
        solve_program(growing.program(), {.seconds = left, .any_solution = true}, interrupt, {});
    if (found.end == ProgramEnd::infeasible) return Exists::no;
    if (found.values.empty()) return Exists::not_known;
    sums.set(growing.layout_of(found.values));
    const auto broken = sums.violations();
    if (broken.empty()) return Exists::yes;
    for (const Violation& v : spread_out(problem, broken, rows_per_round)) growing.add(v);
  }
  return Exists::not_known;
}

/// What the best option of each place adds up to.
double most_of(const LayoutProblem& problem, const std::vector<Term>& terms,
               std::vector<double>& of_place) {
  std::fill(of_place.begin(), of_place.end(), 0);
  for (const Term& term : terms) {
    double& best = of_place[problem.options[term.option].place];
    best = std::max(best, static_cast<double>(term.value));
  }
  return std::accumulate(of_place.begin(), of_place.end(), 0.0);
}

std::vector<Shortage> shortages_of(const LayoutProblem& problem) {
  std::map<uint32_t, Shortage> worst;
  const auto offer = [&](uint32_t group, const glm::dvec3& place, double share) {
    if (share >= 1 - sum_tolerance) return;
    const auto [at, fresh] = worst.try_emplace(group, Shortage{group, place, share});
    if (!fresh && share < at->second.share) at->second = {group, place, share};
  };
  std::vector<double> of_place(problem.places(), 0);
  for (const CoverRow& row : problem.covers)
    offer(row.group, row.place, most_of(problem, *row.terms, of_place) / row.least);
  for (const FailureRows& rows : problem.failures)
    for (const uint32_t p : rows.points) {
      const double all = most_of(problem, *problem.points[p].light, of_place);
      const double one = of_place.empty() ? 0 : *std::max_element(of_place.begin(), of_place.end());
      offer(rows.group, problem.points[p].place, (all - one) / rows.least);
    }
  std::vector<Shortage> out;
  for (const auto& [group, shortage] : worst) out.push_back(shortage);
  return out;
}

}  // namespace

double LayoutAnswer::gap() const {
  if (layout.empty()) return infinite;
  return objective > 0 ? std::max(0.0, (objective - bound) / objective) : 0;
}

namespace {

/// The end of all parts: as the worst of them. Parts that have no layout leave none.
LayoutEnd worse(LayoutEnd a, LayoutEnd b) {
  constexpr std::array order{LayoutEnd::optimal,     LayoutEnd::within_gap, LayoutEnd::out_of_time,
                             LayoutEnd::interrupted, LayoutEnd::unknown,    LayoutEnd::infeasible};
  const auto place = [&](LayoutEnd end) { return std::find(order.begin(), order.end(), end); };
  return place(a) < place(b) ? b : a;
}

/// Parts that have nothing to do with each other, one after another: their answers add up.
LayoutAnswer solve_parts(const LayoutProblem& problem, const std::vector<ProblemPart>& parts,
                         const SolveSettings& settings, const std::atomic<bool>& interrupt,
                         const SolveProgress& progress) {
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  const auto seconds = [&] { return 1e-9 * static_cast<double>(clock.now() - began); };
  LayoutAnswer out;
  out.end = LayoutEnd::optimal;
  out.greedy = true;
  out.layout.assign(problem.options.size(), 0);
  out.share_of_group.assign(problem.groups.size(), 0);
  bool all = true;
  for (size_t i = 0; i < parts.size(); ++i) {
    SolveSettings its = settings;
    its.seconds =
        std::max(0.0, settings.seconds - seconds()) / static_cast<double>(parts.size() - i);
    const LayoutAnswer answer =
        Solving(parts[i].problem, its, interrupt, [&](const std::string&, double, double) {
          progress("part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()),
                   infinite, 0);
        }).run();
    out.end = worse(out.end, answer.end);
    all = all && !answer.layout.empty();
    for (size_t k = 0; k < answer.layout.size(); ++k)
      out.layout[parts[i].options[k]] = answer.layout[k];
    out.objective += answer.objective;
    out.bound += answer.bound;
    out.greedy = out.greedy && answer.greedy;
    out.greedy_objective += answer.greedy_objective;
    out.first_seconds = seconds();
    out.rows += answer.rows;
    out.rounds = std::max(out.rounds, answer.rounds);
    for (size_t g = 0; g < answer.share_of_group.size(); ++g)
      out.share_of_group[g] += answer.share_of_group[g];
    if (out.end == LayoutEnd::infeasible) break;  // nothing is left to find
  }
  if (!all) {
    out.layout.clear();
    out.objective = out.greedy_objective = 0;
  }
  out.seconds = seconds();
  return out;
}

}  // namespace

LayoutAnswer solve_layout(const LayoutProblem& problem, const SolveSettings& settings,
                          const std::atomic<bool>& interrupt, const SolveProgress& progress) {
  const auto parts = parts_of(problem);
  if (parts.size() > 1) return solve_parts(problem, parts, settings, interrupt, progress);
  return Solving(problem, settings, interrupt, progress).run();
}

Conflict conflict_of(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt) {
  Conflict out;
  out.shortages = shortages_of(problem);
  if (!out.shortages.empty()) return out;
  std::set<uint32_t> left;
  for (const auto& rows : problem.covers) left.insert(rows.group);
  for (const auto& rows : problem.failures) left.insert(rows.group);
  for (const auto& rows : problem.spreads) left.insert(rows.group);
  // A group without which there is still no layout is not needed to have none (deletion filter:
  // Chinneck and Dravnieks, ORSA Journal on Computing 3, 1991).
  const double each = seconds / static_cast<double>(std::max<size_t>(left.size(), 1));
  for (const uint32_t group : std::set<uint32_t>(left)) {
    std::set<uint32_t> without = left;
    without.erase(group);
    const Exists exists = layout_exists(only(problem, without), each, interrupt);
    if (exists == Exists::no) left = without;
    if (exists == Exists::not_known) out.proven = false;
  }
  out.groups.assign(left.begin(), left.end());
  return out;
}

}  // namespace luxodus

#include "actors/judge/design/solve_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>

#include "actors/judge/design/greedy.hpp"
#include "actors/judge/design/growing_program.hpp"
#include "actors/judge/design/mixed_integer_program.hpp"
#include "actors/judge/design/preference.hpp"
#include "actors/judge/design/region_bounds.hpp"
#include "actors/judge/design/split_problem.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Gap of early rounds, which need no proof: rows are still missing.
constexpr double loose_gap = 0.04;
/// Share of the time for bounds of regions.
constexpr double time_for_regions = 0.6;
/// Share of the remaining time for improving regions around the best layout, each time.
constexpr double time_for_improving = 0.1;
/// Share of the time for joint bounds of regions.
constexpr double time_for_joining = 0.5;
/// Share of the time, after the search, for dual values.
constexpr double time_for_prices = 0.05;
/// A row binds if the layout gives less than this factor of its requirement; at most this many
/// rows.
constexpr double little_to_spare = 1.5;
constexpr size_t tight_rows = 600;
/// Rounding of an objective.
constexpr double rounding = 1e-6;

class LayoutSolver {
 public:
  LayoutSolver(const LayoutProblem& problem, const SolveSettings& settings,
               const std::atomic<bool>& interrupt, const SolveProgress& progress)
      : problem_(problem),
        settings_(settings),
        interrupt_(interrupt),
        progress_(progress),
        index_(problem),
        sums_(problem),
        began_(clock_.now()) {}

  LayoutAnswer run() {
    find_first();
    return finish(settings_.seconds);
  }

  /// Finds a first layout by the greedy heuristic, which is fast.
  bool find_first() {
    tell("greedy", 0);
    Random random(settings_.seed, RandomStream::layout);
    random.start(0);
    if (!settings_.start.empty())
      if (const auto whole = completed(index_, settings_.start, 0, random))
        offer(pruned(index_, *whole));
    if (const auto first = completed(index_, {}, 0, random)) {
      const Layout layout = pruned(index_, *first);
      offer(layout);
      answer_.greedy = true;
      answer_.greedy_objective = objective_of(problem_, layout);
    }
    return !answer_.layout.empty();
  }

  /// Adds the results of parts solved before: the gap that ends the search is that of all parts.
  void goes_on_from(const LayoutAnswer& solved) {
    solved_objective_ = solved.objective;
    solved_bound_ = solved.bound;
  }

  /// Runs the search for this time.
  LayoutAnswer finish(double seconds_left) {
    settings_.seconds = seconds() + seconds_left;
    if (!answer_.layout.empty()) offer(better(answer_.layout));
    tell("greedy", 0);
    integer_program();
    choose_among_equals();
    answer_.seconds = seconds();
    return std::move(answer_);
  }

  /// Ends without a search, after an interrupt.
  LayoutAnswer leave() {
    raise_bound(0);
    answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::interrupted;
    answer_.seconds = seconds();
    return std::move(answer_);
  }

 private:
  double seconds() const { return 1e-9 * static_cast<double>(clock_.now() - began_); }
  double seconds_left() const { return settings_.seconds - seconds(); }
  bool out_of_time() const { return seconds() > settings_.seconds; }
  void tell(const char* what, double bound) const {
    progress_(what, answer_.layout.empty() ? infinite : answer_.objective,
              std::max(bound, answer_.bound));
  }

  /// Requires: all demands hold.
  void offer(const Layout& layout) {
    const double objective = objective_of(problem_, layout);
    if (!answer_.layout.empty() && objective >= answer_.objective - rounding) return;
    if (answer_.layout.empty()) answer_.first_seconds = seconds();
    answer_.layout = layout;
    answer_.objective = objective;
  }

  Layout better(const Layout& layout) {
    return improved(index_, layout, settings_.greedy_rounds, settings_.seed, interrupt_,
                    [this] { return out_of_time(); });
  }

  void raise_bound(double bound) {
    bound = sums_.from(bound) + fixed_weight();
    answer_.bound = std::max(answer_.bound, bound);
    if (!answer_.layout.empty()) answer_.bound = std::min(answer_.bound, answer_.objective);
  }

  /// The integer program does not count fixed options.
  double fixed_weight() const {
    double sum = 0;
    for (const LayoutOption& option : problem_.options) sum += option.fixed ? option.weight : 0;
    return sum;
  }

  /// Completes and prunes a layout that violates rows, and offers it.
  void offer_repaired(const Layout& layout) {
    Random random(settings_.seed, RandomStream::layout, 2);
    random.start(static_cast<uint64_t>(answer_.rounds));
    if (const auto whole = completed(index_, layout, 0, random)) offer(pruned(index_, *whole));
  }

  /// Largest objective that is still wanted; none without a layout.
  std::optional<double> cutoff() const {
    if (answer_.layout.empty()) return std::nullopt;
    return sums_.just_below(answer_.objective - fixed_weight());
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
    if (ended()) return fill_shares(growing);
    if (interrupt_) {
      answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::interrupted;
      return fill_shares(growing);
    }
    double gap = std::max(loose_gap, settings_.gap);
    LayoutSums sums(index_);
    for (answer_.rounds = 1; answer_.rounds <= limits::row_rounds; ++answer_.rounds) {
      const ProgramAnswer found = solve(growing, gap);
      answer_.rows = growing.rows();
      if (found.end == ProgramEnd::infeasible) {
        // Either no layout is better than the current one, or none exists.
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
        for (const Violation& v : spread_out(problem_, broken, limits::rows_per_round))
          growing.add(v);
        if (broken.empty() && gap > settings_.gap) gap = settings_.gap;
      }
      if (ended(found)) break;
    }
    fill_shares(growing);
  }

  /// Bounds regions separately, and then jointly if the gap is still too large.
  void bound_regions(GrowingProgram& growing) {
    RegionBounds regions(problem_, index_, sums_, settings_.known_regions, growing, interrupt_);
    if (regions.bounds().size() < 2 && settings_.known_regions.empty()) return;
    const auto raised = [&](double sum) {
      raise_bound(sum);
      tell("regions", 0);
      return !ended();
    };
    regions.bound_each(answer_.layout, time_for_regions * seconds_left(), raised);
    improve_regions(growing, regions);
    const double until = seconds() + time_for_joining * seconds_left();
    while (!answer_.layout.empty() && !ended() && !interrupt_ && seconds() < until &&
           regions.join(answer_.layout, until - seconds(), raised))
      improve_regions(growing, regions);
    answer_.regions = regions.bounds();
  }

  /// Solves regions that weigh more than their bound again, with all other regions fixed, until
  /// none improves: regions hardly affect each other.
  void improve_regions(GrowingProgram& growing, const RegionBounds& regions) {
    const double until = seconds() + time_for_improving * seconds_left();
    for (bool better = !answer_.layout.empty(); better && !ended();) {
      better = false;
      for (const RegionBound& one : regions.bounds()) {
        if (interrupt_ || seconds() > until) return;
        if (!regions.is_loose(answer_.layout, one)) continue;
        better = improve_region(growing, one.regions, until) || better;
        tell("regions", 0);
      }
    }
  }

  bool improve_region(GrowingProgram& growing, const std::set<uint32_t>& regions, double until) {
    LayoutSums sums(index_);
    const double before = answer_.objective;
    for (int round = 0; round < limits::row_rounds && !interrupt_; ++round) {
      const ProgramLimits asked{.seconds = until - seconds(), .cutoff = cutoff()};
      const ProgramAnswer found =
          solve_program(growing.around(answer_.layout, regions), asked, interrupt_, {});
      if (found.values.empty()) break;
      sums.set(growing.layout_of(found.values));
      const auto broken = sums.violations();
      if (broken.empty()) offer(sums.layout());
      if (broken.empty() || found.end == ProgramEnd::stopped || seconds() > until) break;
      for (const Violation& v : spread_out(problem_, broken, limits::rows_per_round))
        growing.add(v);
    }
    return answer_.objective < before - rounding;
  }

  /// Gap of this part together with those solved before.
  double gap_of_all() const {
    const double all = solved_objective_ + answer_.objective;
    return all > 0 ? (all - solved_bound_ - answer_.bound) / all : 0;
  }

  /// Whether the layout is proven to be good enough.
  bool ended() {
    if (answer_.layout.empty()) return false;
    if (answer_.bound >= answer_.objective - rounding)
      answer_.end = LayoutEnd::optimal;
    else if (gap_of_all() <= settings_.gap)
      answer_.end = LayoutEnd::within_gap;
    else
      return false;
    return true;
  }

  bool ended(const ProgramAnswer& found) {
    const bool stopped = found.end == ProgramEnd::stopped;
    if (ended()) return true;
    if (interrupt_)
      answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::interrupted;
    else if (stopped || out_of_time())
      answer_.end = answer_.layout.empty() ? LayoutEnd::unknown : LayoutEnd::out_of_time;
    else
      return false;
    return true;
  }

  /// A search that ends early has added few rows. Rows with little to spare may bind as well, so
  /// they are added.
  void add_tight_rows(GrowingProgram& growing) const {
    if (answer_.layout.empty()) return;
    LayoutSums sums(index_);
    sums.set(answer_.layout);
    for (const Violation& v : spread_out(problem_, sums.violations(little_to_spare), tight_rows))
      if (!growing.has(v)) growing.add(v);
  }

  /// From the linear relaxation: the contribution of each group's rows to its objective.
  void fill_shares(GrowingProgram& growing) {
    add_tight_rows(growing);
    answer_.share_of_group.assign(problem_.groups.size(), 0);
    IntegerProgram program = growing.program();
    for (size_t i = 0; i < program.rows.size(); ++i)
      if (growing.groups()[i] == GrowingProgram::of_bound) program.rows[i].low = 0;
    // Computed even when the time is up, but only briefly.
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
    if (answer_.layout.empty() || interrupt_) return;
    tell("choosing among equals", 0);
    const Layout liked = tidied(index_, better(answer_.layout));
    const double objective = objective_of(problem_, liked);
    if (objective <= answer_.objective + rounding) {
      answer_.layout = liked;
      answer_.objective = objective;
    }
  }

  const LayoutProblem& problem_;
  SolveSettings settings_;
  const std::atomic<bool>& interrupt_;
  const SolveProgress progress_;
  LayoutIndex index_;
  const AttainableSums sums_;
  SystemClock clock_;
  Nanoseconds began_;
  double solved_objective_ = 0, solved_bound_ = 0;
  LayoutAnswer answer_;
};

}  // namespace

double LayoutAnswer::gap() const {
  if (layout.empty()) return infinite;
  return objective > 0 ? std::max(0.0, (objective - bound) / objective) : 0;
}

namespace {

/// The worst end of several parts. If a part has no layout, the whole has none.
LayoutEnd worse(LayoutEnd a, LayoutEnd b) {
  constexpr std::array order{LayoutEnd::optimal,     LayoutEnd::within_gap, LayoutEnd::out_of_time,
                             LayoutEnd::interrupted, LayoutEnd::unknown,    LayoutEnd::infeasible};
  const auto place = [&](LayoutEnd end) { return std::find(order.begin(), order.end(), end); };
  return place(a) < place(b) ? b : a;
}

/// Indices by size: time that small parts leave over goes to large ones.
std::vector<size_t> smallest_first(const std::vector<ProblemPart>& parts) {
  std::vector<size_t> out(parts.size());
  std::iota(out.begin(), out.end(), size_t{0});
  std::stable_sort(out.begin(), out.end(), [&](size_t a, size_t b) {
    return parts[a].options.size() < parts[b].options.size();
  });
  return out;
}

/// Regions with options in more than one part: a bound on such a region in the whole problem may
/// exceed its weight in a part.
std::set<uint32_t> regions_of_several(const std::vector<ProblemPart>& parts) {
  std::set<uint32_t> met, out;
  for (const ProblemPart& part : parts) {
    std::set<uint32_t> its;
    for (const LayoutOption& option : part.problem.options)
      if (!option.fixed) its.insert(option.region);
    for (const uint32_t region : its)
      if (!met.insert(region).second) out.insert(region);
  }
  return out;
}

bool reaches(const RegionBound& bound, const std::set<uint32_t>& regions) {
  return std::any_of(bound.regions.begin(), bound.regions.end(),
                     [&](uint32_t region) { return regions.contains(region); });
}

/// Solves independent parts one after another and adds up their results.
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
  // First a layout of all parts, so that an interrupt or a time limit leaves one.
  bool all = true, known = true;
  const std::set<uint32_t> shared = regions_of_several(parts);
  std::vector<std::unique_ptr<LayoutSolver>> solving;
  for (size_t i = 0; i < parts.size(); ++i) {
    SolveSettings its = settings;
    std::erase_if(its.known_regions, [&](const RegionBound& one) { return reaches(one, shared); });
    if (!settings.start.empty()) {
      its.start.clear();
      for (const uint32_t option : parts[i].options) its.start.push_back(settings.start[option]);
    }
    solving.push_back(std::make_unique<LayoutSolver>(
        parts[i].problem, its, interrupt, [&, i](const std::string&, double, double) {
          progress("part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()),
                   infinite, 0);
        }));
    known = solving.back()->find_first() && known;
  }
  if (known) out.first_seconds = seconds();
  size_t left = parts.size();
  for (const size_t i : smallest_first(parts)) {
    solving[i]->goes_on_from(out);
    const double its_seconds =
        std::max(0.0, settings.seconds - seconds()) / static_cast<double>(left--);
    const LayoutAnswer answer = interrupt ? solving[i]->leave() : solving[i]->finish(its_seconds);
    solving[i].reset();
    out.end = worse(out.end, answer.end);
    all = all && !answer.layout.empty();
    for (size_t k = 0; k < answer.layout.size(); ++k)
      out.layout[parts[i].options[k]] = answer.layout[k];
    out.objective += answer.objective;
    out.bound += answer.bound;
    out.greedy = out.greedy && answer.greedy;
    out.greedy_objective += answer.greedy_objective;
    if (!known) out.first_seconds = seconds();
    out.rows += answer.rows;
    out.rounds = std::max(out.rounds, answer.rounds);
    out.regions.insert(out.regions.end(), answer.regions.begin(), answer.regions.end());
    for (size_t g = 0; g < answer.share_of_group.size(); ++g)
      out.share_of_group[g] += answer.share_of_group[g];
    if (out.end == LayoutEnd::infeasible) break;  // the whole problem is infeasible
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
  return LayoutSolver(problem, settings, interrupt, progress).run();
}

}  // namespace luxodus

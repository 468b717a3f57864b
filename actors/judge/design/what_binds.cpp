#include "actors/judge/design/what_binds.hpp"

#include <algorithm>
#include <map>

#include "actors/judge/design/split_problem.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// Demands with a smaller share of the bound are not tried.
constexpr double min_share_of_bound = 0.02;
/// A point is tight if its light after a failure is within this factor of its requirement.
constexpr double tight_after_failure = 1.02;
/// Neighbourhoods refilled in the search for each demand.
constexpr int rounds_of_each = 60;
constexpr double same_objective = 1e-6;

LayoutProblem without(const LayoutProblem& problem, const Relaxation& what) {
  LayoutProblem out = problem;
  const auto is_failure = [&](uint32_t group) {
    const DemandKind kind = problem.groups[group].kind;
    return kind == DemandKind::failed || kind == DemandKind::two;
  };
  const auto goes = [&](const auto& rows) {
    return (what.group && rows.group == *what.group) ||
           (what.all_failures && is_failure(rows.group));
  };
  std::erase_if(out.covers, goes);
  std::erase_if(out.failures, goes);
  std::erase_if(out.spreads, goes);
  if (what.never_fails)
    for (LayoutOption& option : out.options)
      option.never_fails =
          option.never_fails || option.place == problem.options[*what.never_fails].place;
  return out;
}

class RelaxationSolver {
 public:
  RelaxationSolver(const LayoutProblem& problem, const LayoutAnswer& answer,
                   const WhatBindsSettings& settings, const std::atomic<bool>& interrupt)
      : problem_(problem),
        answer_(answer),
        settings_(settings),
        interrupt_(interrupt),
        parts_(parts_of(problem)),
        began_(clock_.now()) {}

  std::vector<Relaxed> run() {
    std::vector<Relaxed> out;
    if (!holds()) return out;
    const std::vector<Relaxation> tried = worth_trying();
    for (size_t i = 0; i < tried.size() && !interrupt_; ++i) {
      const double left = settings_.seconds - seconds();
      if (!(left > 0)) break;
      const Relaxed one = relaxed(tried[i], left / static_cast<double>(tried.size() - i));
      if (one.saved > same_objective) out.push_back(one);
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Relaxed& a, const Relaxed& b) { return a.saved > b.saved; });
    return out;
  }

  /// Solves the parts that contain a demand again; other parts keep their layout. The parts share
  /// the time.
  Relaxed relaxed(const Relaxation& what, double seconds_left) const {
    const double until = seconds() + seconds_left;
    Relaxed out{what, answer_.objective, 0, 0, answer_.end == LayoutEnd::optimal};
    const std::vector<Easier> touched = touched_by(what);
    for (size_t i = 0; i < touched.size(); ++i) {
      const double left = until - seconds();
      if (interrupt_ || !(left > 0)) {
        out.exact = false;
        break;
      }
      solve_again(touched[i], left / static_cast<double>(touched.size() - i), out);
    }
    out.objective = answer_.objective - out.saved;
    return out;
  }

 private:
  bool holds() const {
    const LayoutIndex index(problem_);
    LayoutSums sums(index);
    sums.set(answer_.layout);
    return sums.holds();
  }

  double seconds() const { return 1e-9 * static_cast<double>(clock_.now() - began_); }

  std::vector<Relaxation> worth_trying() const {
    std::vector<Relaxation> out;
    const bool any_failure = std::any_of(
        problem_.groups.begin(), problem_.groups.end(), [](const ConstraintGroup& group) {
          return group.kind == DemandKind::failed || group.kind == DemandKind::two;
        });
    if (any_failure) out.push_back({{}, {}, true});
    const auto& shares = answer_.share_of_group;
    std::vector<uint32_t> groups;
    for (uint32_t g = 0; g < shares.size(); ++g)
      if (shares[g] > min_share_of_bound * answer_.objective) groups.push_back(g);
    std::stable_sort(groups.begin(), groups.end(),
                     [&](uint32_t a, uint32_t b) { return shares[a] > shares[b]; });
    if (groups.size() > settings_.demands) groups.resize(settings_.demands);
    for (const uint32_t g : groups) out.push_back({g, {}, false});
    for (const uint32_t option : tight_failures()) out.push_back({{}, option, false});
    return out;
  }

  /// The luminaires whose failure leaves a tight illuminance at most points.
  std::vector<uint32_t> tight_failures() const {
    std::map<uint32_t, size_t> tight;
    for (const FailureRows& rows : problem_.failures)
      for (const uint32_t p : rows.points) {
        double sum = 0, largest = 0;
        uint32_t whose = 0;
        for (const Term& term : *problem_.points[p].light) {
          if (answer_.layout[term.option] == 0) continue;
          const auto value = static_cast<double>(term.value);
          sum += value;
          if (value > largest) largest = value, whose = term.option;
        }
        if (largest > 0 && sum - largest <= tight_after_failure * rows.least) ++tight[whose];
      }
    std::vector<uint32_t> out;
    for (const auto& [option, points] : tight) out.push_back(option);
    std::stable_sort(out.begin(), out.end(),
                     [&](uint32_t a, uint32_t b) { return tight.at(a) > tight.at(b); });
    if (out.size() > settings_.luminaires) out.resize(settings_.luminaires);
    return out;
  }

  /// A part that contains a demand, with that demand removed.
  struct Easier {
    const ProblemPart* part;
    LayoutProblem problem;
  };

  std::vector<Easier> touched_by(const Relaxation& what) const {
    std::vector<Easier> out;
    for (const ProblemPart& part : parts_) {
      Relaxation its = what;
      if (what.never_fails) {
        const auto at = std::find(part.options.begin(), part.options.end(), *what.never_fails);
        if (at == part.options.end()) continue;
        its.never_fails = static_cast<uint32_t>(at - part.options.begin());
      }
      LayoutProblem easier = without(part.problem, its);
      if (what.never_fails || easier.covers.size() < part.problem.covers.size() ||
          easier.failures.size() < part.problem.failures.size() ||
          easier.spreads.size() < part.problem.spreads.size())
        out.push_back({&part, std::move(easier)});
    }
    return out;
  }

  void solve_again(const Easier& easier, double seconds_for_it, Relaxed& out) const {
    SolveSettings asked;
    asked.seconds = seconds_for_it;
    asked.seed = settings_.seed;
    asked.greedy_rounds = rounds_of_each;
    for (const uint32_t option : easier.part->options)
      asked.start.push_back(answer_.layout[option]);
    const LayoutAnswer found =
        solve_layout(easier.problem, asked, interrupt_, [](const std::string&, double, double) {});
    const double before = objective_of(easier.problem, asked.start);
    out.exact = out.exact && found.end == LayoutEnd::optimal;
    if (found.layout.empty() || found.objective > before - same_objective) return;
    out.saved += before - found.objective;
    out.fewer += std::count(asked.start.begin(), asked.start.end(), 1) -
                 std::count(found.layout.begin(), found.layout.end(), 1);
  }

  const LayoutProblem& problem_;
  const LayoutAnswer& answer_;
  const WhatBindsSettings& settings_;
  const std::atomic<bool>& interrupt_;
  std::vector<ProblemPart> parts_;
  SystemClock clock_;
  Nanoseconds began_;
};

}  // namespace

std::vector<Relaxed> what_binds(const LayoutProblem& problem, const LayoutAnswer& answer,
                                const WhatBindsSettings& settings,
                                const std::atomic<bool>& interrupt) {
  return RelaxationSolver(problem, answer, settings, interrupt).run();
}

Relaxed solved_without(const LayoutProblem& problem, const LayoutAnswer& answer,
                       const Relaxation& demand, const WhatBindsSettings& settings,
                       const std::atomic<bool>& interrupt) {
  return RelaxationSolver(problem, answer, settings, interrupt).relaxed(demand, settings.seconds);
}

}  // namespace luxodus

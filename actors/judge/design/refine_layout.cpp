// The objective is a smooth minimum, -ln(sum exp(-k s)) / k over the shares s of all minima: it is
// dominated by the darkest places, and others contribute a little. A position that violates a
// demand or is not allowed counts as worse than all others.
#include "actors/judge/design/refine_layout.hpp"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// k of the smooth minimum: at 20, a share that is 0.1 larger has a seventh of the weight.
constexpr double sharpness = 20;
/// Positions tried for one luminaire; BOBYQA starts with five.
constexpr int tried_positions = 24;
/// BOBYQA ends at steps below this [m].
constexpr double smallest_step_m = 0.02;
/// Smallest gain for which a luminaire is moved: installers prefer rows.
constexpr double min_gain = 5e-3;
/// Objective of a layout that violates demands.
constexpr double when_broken = -10;

struct Judged {
  bool good = false;
  double smooth = when_broken;  // smooth minimum
  double least = 0;             // least share of a planned minimum
};

class LayoutRefinement {
 public:
  LayoutRefinement(const SceneDescription& scene, const DesignSettings& design,
                   const std::vector<LuminaireCandidate>& chosen, const Demands& all,
                   const RefineOptions& options, const std::atomic<bool>& interrupt,
                   const std::function<void(double)>& progress)
      : scene_(scene),
        design_(design),
        all_(all),
        options_(options),
        interrupt_(interrupt),
        progress_(progress),
        began_(clock_.now()) {
    out_.luminaires = chosen;
    for (uint32_t i = 0; i < out_.luminaires.size(); ++i) out_.luminaires[i].place = i;
  }

  Result<Refinement> run() {
    auto check = PlaceCheck::make(scene_, design_, options_.doors, options_.threads);
    if (!check) return check.problem();
    check_ = std::move(check).value();
    best_ = judge(out_.luminaires);
    if (problem_) return *problem_;
    out_.before = out_.after = best_.least;
    // Without a valid layout there is nothing to improve.
    if (best_.good)
      for (const size_t i : by_weight()) {
        if (over()) break;
        move(i);
        if (problem_) return *problem_;
        progress_(out_.after);
      }
    auto demands = lit(out_.luminaires);
    if (!demands) return demands.problem();
    out_.demands = std::move(demands).value();
    return std::move(out_);
  }

 private:
  bool over() const {
    return interrupt_ || 1e-9 * static_cast<double>(clock_.now() - began_) > options_.seconds;
  }

  Result<std::unique_ptr<Demands>> lit(const std::vector<LuminaireCandidate>& luminaires) const {
    return Demands::make(scene_, design_, luminaires, options_.codes, options_.doors,
                         options_.threads);
  }

  Judged judge(const std::vector<LuminaireCandidate>& luminaires) {
    ++out_.evaluations;
    const auto demands = lit(luminaires);
    Judged out;
    if (!demands) {
      problem_ = demands.problem();
      return out;
    }
    for (const auto& [what, points] : demands.value()->hidden()) {
      const auto at = all_.hidden().find(what);
      if (at == all_.hidden().end() || points > at->second) return out;
    }
    const LayoutProblem& problem = demands.value()->problem();
    const LayoutIndex index(problem);
    LayoutSums sums(index);
    sums.set(Layout(problem.options.size(), 1));
    const auto violations = sums.violations();
    if (!violations.empty()) {
      // Smaller violations count as better, so that the search finds its way back.
      out.smooth = when_broken;
      for (const Violation& v : violations) out.smooth -= 1 - v.share;
      return out;
    }
    out.good = true;
    out.least = std::numeric_limits<double>::infinity();
    for (size_t row = 0; row < problem.covers.size(); ++row)
      if (is_minimum(problem.groups[problem.covers[row].group].kind))
        out.least = std::min(out.least, sums.cover(row));
    double sum = 0;
    for (size_t row = 0; row < problem.covers.size(); ++row)
      if (is_minimum(problem.groups[problem.covers[row].group].kind))
        sum += std::exp(-sharpness * (sums.cover(row) - out.least));
    if (!(sum > 0)) return {};  // no minimum is required
    out.smooth = out.least - std::log(sum) / sharpness;
    if (out_.evaluations == 1)
      weigh(problem, sums, out.least);
    else if (out.smooth >= best_.smooth + min_gain && has_gap(*demands.value()))
      return {};
    return out;
  }

  /// Whether a minimum does not hold between points of the grid. Tested only for positions that
  /// would be taken.
  bool has_gap(Demands& demands) const {
    return demands.look_between(Layout(demands.problem().options.size(), 1), &all_).added > 0;
  }

  /// Weight of each luminaire: its contribution to the tightest minima.
  void weigh(const LayoutProblem& problem, const LayoutSums& sums, double least) {
    weight_.assign(problem.options.size(), 0);
    for (size_t row = 0; row < problem.covers.size(); ++row) {
      const CoverRow& cover = problem.covers[row];
      if (!is_minimum(problem.groups[cover.group].kind)) continue;
      const double tight = std::exp(-sharpness * (sums.cover(row) - least));
      for (const Term& term : *cover.terms)
        weight_[term.option] += tight * static_cast<double>(term.value) / cover.least;
    }
  }

  /// New and moved luminaires under ceilings; first those that contribute most to the tightest
  /// minima.
  std::vector<size_t> by_weight() const {
    std::vector<size_t> out;
    for (size_t i = 0; i < out_.luminaires.size(); ++i)
      if (const LuminaireCandidate& one = out_.luminaires[i];
          (one.type != LuminaireCandidate::existing || one.moved) && !one.aim)
        out.push_back(i);
    std::stable_sort(out.begin(), out.end(),
                     [&](size_t a, size_t b) { return weight_[a] > weight_[b]; });
    return out;
  }

  void move(size_t i) {
    const glm::dvec3 from = out_.luminaires[i].position;
    const double reach = design_.spacing_m / 2;
    trying_ = i;
    found_.reset();
    const std::array low{from.x - reach, from.y - reach}, high{from.x + reach, from.y + reach};
    std::array at{from.x, from.y};
    double value = 0;
    nlopt_opt search = nlopt_create(NLOPT_LN_BOBYQA, 2);
    if (search == nullptr) return;
    nlopt_set_lower_bounds(search, low.data());
    nlopt_set_upper_bounds(search, high.data());
    nlopt_set_max_objective(search, &LayoutRefinement::value_at, this);
    nlopt_set_initial_step1(search, reach / 2);
    nlopt_set_xtol_abs1(search, smallest_step_m);
    nlopt_set_maxeval(search, tried_positions);
    search_ = search;
    // The return code is not needed: the best position tried is kept here.
    nlopt_optimize(search, at.data(), &value);
    search_ = nullptr;
    nlopt_destroy(search);
    if (!found_ || found_->judged.smooth < best_.smooth + min_gain) return;
    best_ = found_->judged;
    out_.after = best_.least;
    out_.luminaires[i].position = found_->place.position;
    out_.luminaires[i].floor = found_->place.floor;
    ++out_.moved;
  }

  static double value_at(unsigned, const double* at, double*, void* self) noexcept {
    return static_cast<LayoutRefinement*>(self)->value_at({at[0], at[1]});
  }

  double value_at(const glm::dvec2& plan) {
    if (problem_ || over()) {
      nlopt_force_stop(search_);
      return when_broken;
    }
    const LuminaireCandidate& one = out_.luminaires[trying_];
    const auto place = check_->place_over(plan, one.position);
    constexpr double may_not_be = 3 * when_broken;
    if (!place) return may_not_be;
    std::vector<LuminaireCandidate> luminaires = out_.luminaires;
    luminaires[trying_].position = place->position;
    luminaires[trying_].floor = place->floor;
    const Judged judged = judge(luminaires);
    if (judged.good && (!found_ || judged.smooth > found_->judged.smooth))
      found_ = Found{*place, judged};
    return judged.smooth;
  }

  struct Found {
    PlaceCheck::Place place;
    Judged judged;
  };

  const SceneDescription& scene_;
  const DesignSettings& design_;
  const Demands& all_;
  const RefineOptions& options_;
  const std::atomic<bool>& interrupt_;
  const std::function<void(double)>& progress_;
  SystemClock clock_;
  Nanoseconds began_;
  std::unique_ptr<PlaceCheck> check_;
  std::vector<double> weight_;  // of each luminaire
  Judged best_;
  size_t trying_ = 0;
  std::optional<Found> found_;
  nlopt_opt search_ = nullptr;
  std::optional<Problem> problem_;
  Refinement out_;
};

}  // namespace

Result<Refinement> refine_layout(const SceneDescription& scene, const DesignSettings& design,
                                 const std::vector<LuminaireCandidate>& chosen, const Demands& all,
                                 const RefineOptions& options, const std::atomic<bool>& interrupt,
                                 const std::function<void(double)>& progress) {
  return LayoutRefinement(scene, design, chosen, all, options, interrupt, progress).run();
}

}  // namespace luxodus

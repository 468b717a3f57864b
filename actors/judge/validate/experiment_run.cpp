// A threshold is found with the same random numbers at each of its steps, so that levels change
// smoothly between them.
#include "actors/judge/validate/experiment_run.hpp"

#include <cmath>
#include <map>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/validate/experiment_scene.hpp"
#include "actors/judge/validate/traced.hpp"

namespace luxodus::light {

namespace {

/// Batches, their particles, and the factor of eye paths with which lamps are measured: 2^15 paths,
/// for an error of about half a percent.
constexpr int64_t lamp_batches = 64, lamp_batch_particles = 256;
constexpr double lamp_path_factor = 40;
/// Distance from a threshold, in what it is stated in, at which the search ends: far below what
/// people differ by.
constexpr double threshold_tolerance = 5e-3, contrast_tolerance = 1e-5;
/// A target so large that only the luminance counts.
constexpr double endless_arcmin = 1e9;

const AssessProgress no_report = [](const std::string&, double) {};

uint64_t seed_of_repeat(uint64_t seed, int repeat) {
  return seed + 1000 * static_cast<uint64_t>(repeat);
}
uint64_t seed_of_others(uint64_t seed, int number) {
  return seed + 1'000'000 * static_cast<uint64_t>(number);
}

double factor_saved_by_size(const TargetSeen& seen, double age_years) {
  if (!(seen.detail_arcmin > 0)) return 1;
  const double under = seen.ground.value + seen.veil_cd_m2;
  const bool darker = seen.difference.value < 0;
  const Eye eye{age_years};
  return luminance_threshold(under, seen.detail_arcmin, darker, eye) /
         luminance_threshold(under, endless_arcmin, darker, eye);
}

/// The mean of independent samples of what an eye gets.
class MeanSeen {
 public:
  void add(const SightRow& row) {
    ++count_;
    add(level_, row.sight.reading_level);
    add(ground_, row.look.ground);
    add(difference_, row.look.difference);
  }
  int count() const { return count_; }
  Uncertain level() const { return mean(level_); }
  Uncertain ground() const { return mean(ground_); }
  Uncertain difference() const { return mean(difference_); }
  bool precise(double relative_error) const {
    const Uncertain at = level();
    const bool asked =
        at.value >= limits::least_precise_level && at.value <= limits::most_precise_level;
    return !asked || at.error <= relative_error * at.value;
  }

 private:
  static void add(Uncertain& sum, const Uncertain& one) { sum = plus(sum, one); }
  Uncertain mean(const Uncertain& sum) const { return times(1.0 / count_, sum); }

  int count_ = 0;
  Uncertain level_, ground_, difference_;  // sums
};

/// Illuminance per lumen of the lamps where it is stated [lx/lm].
double lux_per_lumen(const ExperimentScene& scene, const ExperimentOptions& options,
                     const std::atomic<bool>& interrupt) {
  SceneDescription lamps = lamps_alone(scene);
  lamps.run.batch_particles = lamp_batch_particles;
  lamps.run.eye_path_factor = lamp_path_factor;
  const ProbeMeasure probe = lamps.probes.front();
  Traced run(compile(std::move(lamps)), options.seed, options.threads);
  StopRule stop;
  stop.particles = lamp_batches * lamp_batch_particles;
  run.local().run(stop, interrupt, [](const Progress&) {});
  const double lux =
      run.value(run.blocks().probes, 0).value + run.direct_lx(probe.position, probe.normal);
  return lux / experiment_lamps_lm;
}

/// The levels of a trial's scene.
class TrialLevels {
 public:
  TrialLevels(const Trial& trial, const ExperimentOptions& options,
              const std::atomic<bool>& interrupt)
      : trial_(trial), options_(options), interrupt_(interrupt) {}

  Result<TargetSeen> at(double varied) {
    const ExperimentScene scene = set_to(trial_.scene, trial_.varied, varied);
    return look(scene, lumens_of(scene));
  }

  /// `lamps_lm`: flux of the lamps.
  Result<TargetSeen> look(const ExperimentScene& scene, double lamps_lm) const {
    const SceneDescription description = description_of(scene, lamps_lm);
    TargetSeen out;
    MeanSeen mean;
    while (mean.count() < options_.max_repeats) {
      AssessOptions assess;
      assess.seed = seed_of_repeat(options_.seed, mean.count());
      assess.threads = options_.threads;
      assess.rounds = options_.rounds;
      Assessment found;
      if (auto ok = assess_sights(description, scenario_of(scene.before), {}, assess, interrupt_,
                                  no_report, found);
          !ok)
        return ok.problem();
      if (found.sights.empty()) return problem("the target is not turned to the eye");
      const SightRow& row = found.sights.front();
      if (mean.count() == 0) {
        out.verdict = name_of(row.sight.verdict);
        out.veil_cd_m2 = row.look.veil_cd_m2;
        out.detail_arcmin = row.view.detail_arcmin;
      }
      mean.add(row);
      if (mean.precise(options_.level_error)) break;
    }
    out.level = mean.level();
    out.ground = mean.ground();
    out.difference = mean.difference();
    out.size_saves = factor_saved_by_size(out, scene.age_years);
    return out;
  }

  double lumens_of(const ExperimentScene& scene) {
    if (scene.lamps.lux <= 0) return 0;
    if (scene.lamps.in_smoke || !lux_per_lumen_)
      lux_per_lumen_ = lux_per_lumen(scene, options_, interrupt_);
    return scene.lamps.lux / *lux_per_lumen_;
  }

 private:
  const Trial& trial_;
  const ExperimentOptions& options_;
  const std::atomic<bool>& interrupt_;
  std::optional<double> lux_per_lumen_;  // in clear air it is the same at every threshold
};

/// The crossing with levels of other seeds. Errors: as look_at_target.
Result<Crossing> refined_by_others(const Trial& trial, const Crossing& crossing, double limit,
                                   const ExperimentOptions& options,
                                   const std::atomic<bool>& interrupt) {
  std::vector<Uncertain> others;
  for (int k = 1; k <= options.other_levels; ++k) {
    ExperimentOptions other = options;
    other.seed = seed_of_others(options.seed, k);
    const auto seen = TrialLevels(trial, other, interrupt).at(crossing.at->value);
    if (!seen) return seen.problem();
    others.push_back(seen->level);
  }
  return refined(crossing, limit, others);
}

Result<TrialResult> run_trial(const Trial& trial, const ExperimentOptions& options,
                              const std::atomic<bool>& interrupt) {
  TrialLevels levels(trial, options, interrupt);
  TrialResult out;
  if (trial.varied == Varied::nothing) {
    const auto seen = levels.at(0);
    if (!seen) return seen.problem();
    out.level = seen->level;
    out.seen = {seen.value(), seen.value()};
    out.levels_computed = 1;
    return out;
  }
  std::map<double, TargetSeen> known;
  const LevelAt level_at = [&](double varied) -> Result<Uncertain> {
    auto seen = levels.at(varied);
    if (!seen) return seen.problem();
    const Uncertain level = seen->level;
    known[varied] = std::move(seen).value();
    return level;
  };
  const double tolerance =
      trial.varied == Varied::contrast ? contrast_tolerance : threshold_tolerance;
  ThresholdFinder finder(level_at, trial.searched, tolerance);
  for (size_t i = 0; i < threshold_levels.size(); ++i) {
    const auto crossing = finder.crossing(threshold_levels[i]);
    if (!crossing) return crossing.problem();
    out.crossings[i] = crossing.value();
    if (!crossing->at) continue;
    out.seen[i] = known[crossing->at->value];
    if (trial.scene.smoke.extinction == 0 && trial.varied != Varied::extinction) continue;
    const auto better =
        refined_by_others(trial, crossing.value(), threshold_levels[i], options, interrupt);
    if (!better) return better.problem();
    out.crossings[i] = better.value();
  }
  out.levels_computed = finder.computed();
  if (trial.observed) {
    ExperimentOptions thorough = options;
    thorough.rounds = options.verdict_rounds;
    const auto there = TrialLevels(trial, thorough, interrupt).at(trial.observed->low);
    if (!there) return there.problem();
    out.at_observed = there.value();
  }
  return out;
}

// ---- the rules ---------------------------------------------------------------------------------

constexpr const char* not_crossed = "no threshold was found in the searched interval";

/// The thresholds of the claim's trials at its level; fewer, if any was not found.
std::vector<Uncertain> thresholds(const Claim& claim, const std::vector<Trial>& trials,
                                  const std::vector<TrialResult>& results) {
  std::vector<Uncertain> out;
  for (const size_t i : claim.trials) {
    if (trials[i].varied == Varied::nothing) out.push_back(results[i].level);
    const Crossing& crossing = results[i].at_level(claim.level);
    if (trials[i].varied != Varied::nothing && crossing.at) out.push_back(*crossing.at);
  }
  return out;
}

RuleResult judge_trial(const Claim& claim, const Trial& trial, const TrialResult& result) {
  if (claim.rule == Rule::acuity) return acuity_agrees(result.level);
  const Crossing& at_level = result.at_level(claim.level);
  if (!at_level.at) return {Agreement::not_answered, not_crossed};
  if (claim.rule == Rule::value) return within(*at_level.at, claim.allowed);
  if (!trial.observed) return {Agreement::not_answered, "nothing was observed"};
  if (claim.rule == Rule::seen) return seen_agrees(*at_level.at, *trial.observed);
  const auto& read = result.at_level(level_read).at;
  if (!read) return {Agreement::not_answered, not_crossed};
  return read_agrees(*read, *result.at_level(level_seen).at, *trial.observed);
}

/// Each trial by itself; a claim on several names those that decide it.
RuleResult judge_each(const Claim& claim, const std::vector<Trial>& trials,
                      const std::vector<TrialResult>& results) {
  std::vector<RuleResult> parts;
  for (const size_t i : claim.trials) {
    parts.push_back(judge_trial(claim, trials[i], results[i]));
    if (claim.trials.size() > 1) parts.back().reason = trials[i].name + ": " + parts.back().reason;
  }
  return all_of(parts);
}

RuleResult judge_slope(const Claim& claim, const std::vector<Trial>& trials,
                       const std::vector<Uncertain>& found) {
  std::vector<double> x;
  for (const size_t i : claim.trials) x.push_back(std::log(trials[i].scene.target.luminance_cd_m2));
  return within(slope_of(x, found), claim.allowed);
}

}  // namespace

RuleResult judge_claim(const Claim& claim, const std::vector<Trial>& trials,
                       const std::vector<TrialResult>& results) {
  switch (claim.rule) {
    case Rule::seen:
    case Rule::read:
    case Rule::acuity:
    case Rule::value:
      return judge_each(claim, trials, results);
    default:
      break;
  }
  const std::vector<Uncertain> found = thresholds(claim, trials, results);
  if (found.size() < claim.trials.size()) return {Agreement::not_answered, not_crossed};
  switch (claim.rule) {
    case Rule::slope:
      return judge_slope(claim, trials, found);
    case Rule::quotient:
      return within(quotient(found[0], found[1]), claim.allowed);
    case Rule::difference:
      return within(minus(found[0], found[1]), claim.allowed);
    case Rule::beyond:
      return is_beyond(found[0], found[1]);
    case Rule::much_beyond:
      return is_much_beyond(found[0], found[1]);
    default:
      return is_about_equal(found[0], found[1]);
  }
}

Result<TargetSeen> look_at_target(const ExperimentScene& scene, const ExperimentOptions& options,
                                  const std::atomic<bool>& interrupt) {
  const Trial trial{"", scene, Varied::nothing};
  return TrialLevels(trial, options, interrupt).at(0);
}

Result<std::vector<ExperimentResult>> run_experiments(const Experiments& experiments,
                                                      const ExperimentOptions& options,
                                                      const std::atomic<bool>& interrupt,
                                                      const ExperimentProgress& progress) {
  size_t all = 0, done = 0;
  for (const Experiment& experiment : experiments) all += experiment.trials.size();
  std::vector<ExperimentResult> out;
  for (const Experiment& experiment : experiments) {
    ExperimentResult result{experiment, {}, {}};
    for (const Trial& trial : experiment.trials) {
      progress(experiment.id + ", " + trial.name,
               static_cast<double>(done++) / static_cast<double>(all));
      auto found = run_trial(trial, options, interrupt);
      if (interrupt.load()) return out;
      if (!found) return problem(experiment.id + ": " + found.problem().what);
      result.trials.push_back(std::move(found).value());
    }
    for (const Claim& claim : experiment.claims)
      result.claims.push_back(judge_claim(claim, experiment.trials, result.trials));
    out.push_back(std::move(result));
  }
  return out;
}

}  // namespace luxodus::light

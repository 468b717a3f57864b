// Runs experiments: finds each threshold by the reality mode of an assessment (eye paths in smoke,
// visibility levels, the same code as `luxodus assess`), and applies the rules. Equal seeds give
// equal results for any number of threads. Thread rule: one caller.
#pragma once

#include <array>
#include <atomic>
#include <functional>

#include "actors/judge/validate/experiment.hpp"
#include "actors/judge/validate/threshold.hpp"
#include "scenes/emergency/legibility.hpp"

namespace luxodus::light {

namespace limits {
/// Levels that are computed with the asked precision; others lie far from any threshold.
inline constexpr double least_precise_level = 0.7, most_precise_level = 10;
}  // namespace limits

struct ExperimentOptions {
  uint64_t seed = 1;
  int threads = 1;
  /// Rounds of eye paths of an assessment, for levels and for the verdict at the observed
  /// threshold.
  int rounds = 1;
  int verdict_rounds = 3;
  /// A level is the mean of assessments with seeds of their own: as many as bring its relative
  /// standard error, within limits::least_precise_level and limits::most_precise_level.
  int max_repeats = 12;
  double level_error = 0.03;
  /// Levels with other random numbers at a found threshold, whose scatter is its error.
  int other_levels = 3;
};

/// What an eye gets of a target, as the mean of all repeats.
struct TargetSeen {
  Uncertain level;
  Uncertain ground;      // luminance of the ground at the eye, which the eye is adapted to [cd/m2]
  Uncertain difference;  // of target and ground at the eye [cd/m2]
  double veil_cd_m2 = 0;
  double detail_arcmin = 0;
  /// Factor of the threshold that an endless target would save before the same ground: above it,
  /// size cannot help.
  double size_saves = 1;
  std::string verdict;  // of the program, by the first of the repeats
};

struct TrialResult {
  /// Thresholds of the smallest detail at the levels of threshold_levels; of a trial in which
  /// nothing is varied, its level instead.
  std::array<Crossing, 2> crossings;
  std::array<std::optional<TargetSeen>, 2> seen;  // there
  Uncertain level;
  /// At the observed threshold; the lower end of an interval.
  std::optional<TargetSeen> at_observed;
  size_t levels_computed = 0;

  /// Requires: level 1 or 7.
  const Crossing& at_level(double limit) const { return crossings[limit == level_seen ? 0 : 1]; }
};

struct ExperimentResult {
  Experiment experiment;
  std::vector<TrialResult> trials;
  std::vector<RuleResult> claims;
};

/// Reports the experiment and trial in progress, and the share of all trials that is done.
using ExperimentProgress = std::function<void(const std::string& what, double share)>;

/// The levels whose thresholds are found: seen and read.
inline constexpr std::array<double, 2> threshold_levels{level_seen, level_read};

/// One claim on the results of an experiment's trials. Pure.
RuleResult judge_claim(const Claim& claim, const std::vector<Trial>& trials,
                       const std::vector<TrialResult>& results);

/// What the target shows the eye in a scene. Errors: as assess_sights.
Result<TargetSeen> look_at_target(const ExperimentScene& scene, const ExperimentOptions& options,
                                  const std::atomic<bool>& interrupt);

/// Runs experiments one after another; those that were complete when `interrupt` was set.
/// Errors: as look_at_target.
Result<std::vector<ExperimentResult>> run_experiments(const Experiments& experiments,
                                                      const ExperimentOptions& options,
                                                      const std::atomic<bool>& interrupt,
                                                      const ExperimentProgress& progress);

}  // namespace luxodus::light

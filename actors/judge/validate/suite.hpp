// Runs cases: each with growing numbers of particles, reading every quantity at the end of each.
// Equal seeds and options give equal estimates, but other times. Thread rule: one caller.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "actors/judge/validate/case.hpp"
#include "actors/results/run/run_executor.hpp"

namespace luxodus::light {

namespace limits {
/// Limit on particles of a case, whatever its target error: some hours of two cores in clear air.
inline constexpr int64_t case_particles = int64_t{1} << 34;
}  // namespace limits

namespace defaults {
/// Relative error that `--full` aims at.
inline constexpr double suite_error = 1e-4;
}  // namespace defaults

struct SuiteOptions {
  uint64_t seed = 1;
  int threads = 1;
  RunExecutor* executor = nullptr;  // traces; null: the threads
  /// Relative standard error that every quantity should reach; 0: a quick number of particles.
  double error = 0;
  /// Time limit of a case on its way to the error [s]; errors not reached by then are reported. Its
  /// quick run is always complete.
  double case_seconds = std::numeric_limits<double>::infinity();
  /// Replaces the program's own loop, in tests.
  LocalRun::MakeTracer make_tracer;
  DirectLightAt direct_light = direct_light_at;
};

/// Progress of a suite.
struct SuiteProgress {
  size_t done = 0;
  size_t cases = 0;
  std::string name;  // of the case that runs
  double seconds = 0;
  double seconds_left = 0;  // NaN if unknown
};
using ReportSuite = std::function<void(const SuiteProgress&)>;

/// A quantity and its result.
struct QuantityResult {
  std::string quantity;
  double reference = 0;
  Estimate estimate;
  double bias = 0;  // declared; for computed ones, the tolerance. In the reference's unit
  double unit = 0;  // see Quantity; 0 for computed ones
  bool statistical = false;
};

/// Error of a case after a number of particles: root mean squares over its quantities, relative.
struct CoursePoint {
  int64_t particles = 0;
  double seconds = 0;
  double standard_error = 0;
  double deviation = 0;  // deviation of the estimates from the references
};

struct CaseResult {
  std::string group, name, source;
  int64_t particles = 0;
  int64_t batches = 0;
  double seconds = 0;
  /// Factor on the particles that would reach the requested error; at most 1: reached, or none was
  /// requested.
  double short_of = 0;
  std::vector<QuantityResult> findings;
  std::vector<CoursePoint> course;
  double slope_particles = 0, slope_seconds = 0;  // of the standard error; NaN if unknown
  double slope_deviation = 0;                     // over particles, of the deviation
};

/// Cases that ended before all of their quantities had reached the requested error.
size_t cases_short_of_error(const std::vector<CaseResult>& results);

/// How many estimates are known to a relative error, and why the others are not.
struct Precision {
  double error = 0;
  size_t known = 0;         // standard error is at most that
  size_t by_reference = 0;  // a quarter of the declared bias is larger, so no smaller error is
                            // useful
  size_t small = 0;         // below a hundredth of the possible value, and known to the error
                            // relative to that hundredth
  size_t by_particles = 0;  // more particles would reach it
  size_t all() const { return known + by_reference + small + by_particles; }
};
Precision precision_of(const std::vector<CaseResult>& results, double error);

/// How errors of all cases fall with particles: slopes over the checkpoints that all have, of root
/// mean squares over the cases, each in units of its last standard error. For correct Monte Carlo
/// both are -0.5, the deviation's with some scatter. NaN if no case has two checkpoints.
struct Slopes {
  double standard_error = 0;
  double deviation = 0;
};
Slopes slopes_of(const std::vector<CaseResult>& results);

/// 1 / (relative error^2 x seconds) [1/s]; 0 if nothing is estimated.
double figure_of_merit(const QuantityResult& finding, double seconds);

/// Runs the cases one after another. A suite with a target error first runs all of them quickly, to
/// predict its time. If `interrupt` is set, results so far are returned.
/// Errors (exception): those of the executor.
std::vector<CaseResult> run_suite(const Cases& cases, const SuiteOptions& options,
                                  const std::atomic<bool>& interrupt, const ReportSuite& report);

}  // namespace luxodus::light

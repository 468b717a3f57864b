// Cases run: each at growing numbers of particles, every quantity read at the end of each. The same
// seed and options give the same estimates; seconds are as they are. Thread rule: one caller.
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
/// Of one case, whatever error it is to reach: some hours of two cores in clear air.
inline constexpr int64_t case_particles = int64_t{1} << 34;
}  // namespace limits

namespace defaults {
/// Relative: what `--full` is for.
inline constexpr double suite_error = 1e-4;
}  // namespace defaults

struct SuiteOptions {
  uint64_t seed = 1;
  int threads = 1;
  RunExecutor* executor = nullptr;  // who traces; null: the threads
  /// Relative standard error that every quantity is to reach; 0: as many particles as are quick.
  double error = 0;
  /// Of one case on its way to the error [s]; what it has not reached by then is told. Its quick
  /// run is whole in any case.
  double case_seconds = std::numeric_limits<double>::infinity();
  /// Instead of the program's own loop: for tests.
  LocalRun::MakeTracer make_tracer;
  DirectLightAt direct_light = direct_light_at;
};

/// How far a suite is.
struct SuiteProgress {
  size_t done = 0;
  size_t cases = 0;
  std::string name;  // of the case that runs
  double seconds = 0;
  double seconds_left = 0;  // NaN where nothing is known
};
using ReportSuite = std::function<void(const SuiteProgress&)>;

/// A quantity and what was found.
struct QuantityResult {
  std::string quantity;
  double reference = 0;
  Estimate estimate;
  double bias = 0;  // declared; of what is computed, the tolerance. In the reference's unit
  double unit = 0;  // see Quantity; 0 for what is computed
  bool statistical = false;
};

/// Error of a case after so many particles: root mean squares over its quantities, relative.
struct CoursePoint {
  int64_t particles = 0;
  double seconds = 0;
  double standard_error = 0;
  double deviation = 0;  // of the estimates from the references
};

struct CaseResult {
  std::string group, name, source;
  int64_t particles = 0;
  int64_t batches = 0;
  double seconds = 0;
  /// How many times as many particles would bring the error that was asked for; at most 1: it is
  /// reached, or none was asked for.
  double short_of = 0;
  std::vector<QuantityResult> findings;
  std::vector<CoursePoint> course;
  double slope_particles = 0, slope_seconds = 0;  // of the standard error; NaN where none is known
  double slope_deviation = 0;                     // over particles, of the deviation
};

/// Cases that ended before all of their quantities had the error asked for.
size_t cases_short_of_error(const std::vector<CaseResult>& results);

/// How many estimates are known to a relative error, and what keeps the others from it.
struct Precision {
  double error = 0;
  size_t known = 0;         // standard error at most that
  size_t by_reference = 0;  // a quarter of the declared bias is larger: none is wanted to that
  size_t small = 0;         // less than a hundredth of what could be, known to a hundredth of that
  size_t by_particles = 0;  // more would bring it
  size_t all() const { return known + by_reference + small + by_particles; }
};
Precision precision_of(const std::vector<CaseResult>& results, double error);

/// How errors of all cases together fall with particles: slopes over the checkpoints that all have,
/// of root mean squares over the cases, each in units of its last standard error. Of honest Monte
/// Carlo both are -0.5, the deviation's with some scatter. NaN where no case has two checkpoints.
struct Slopes {
  double standard_error = 0;
  double deviation = 0;
};
Slopes slopes_of(const std::vector<CaseResult>& results);

/// 1 / (relative error^2 x seconds) [1/s]; 0 where nothing is estimated.
double figure_of_merit(const QuantityResult& finding, double seconds);

/// Runs the cases one after another. A suite that is to reach an error first runs all of them
/// quickly, to know how long it will take. What was done is returned when `interrupt` is set.
/// Errors (exception): those of the executor.
std::vector<CaseResult> run_suite(const Cases& cases, const SuiteOptions& options,
                                  const std::atomic<bool>& interrupt, const ReportSuite& report);

}  // namespace luxodus::light

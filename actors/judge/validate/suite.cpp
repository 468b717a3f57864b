#include "actors/judge/validate/suite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "actors/judge/validate/statistics.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus::light {

namespace {

/// Cases share no random number, so that their results are independent.
uint64_t seed_of(const Case& c, uint64_t seed) {
  Hasher hasher;
  hasher.add(seed);
  hasher.add(std::string_view(c.name));
  return hasher.value();
}

/// Enough batches to know the error of a quick run to 3 %.
constexpr int64_t quick_batches = 512;
constexpr int64_t first_share = 16;  // a course begins with a 16th of a quick run, and doubles:
constexpr size_t quick_checkpoints = 5;

/// Quantities below a hundredth of their possible value need the error only relative to that
/// hundredth.
constexpr double min_share = 0.01;
/// More particles are useless if the error bar is below this share of the declared bias.
constexpr double useful_share = 0.25;

/// Factor on the particles by which the worst quantity would reach the error.
double need(const CaseResult& result, double error) {
  double most = 0;
  for (const QuantityResult& f : result.findings) {
    if (!f.statistical || !(f.estimate.standard_error > 0)) continue;
    const double wanted = std::max(error * std::max(std::abs(f.reference), min_share * f.unit),
                                   useful_share * f.bias);
    most = std::max(most, std::pow(f.estimate.standard_error / wanted, 2));
  }
  return most;
}

/// The energy balance as quantities: it closes in integers, and no history exceeded the cap on its
/// events.
void add_ledger(const EnergyBalance& balance, std::vector<QuantityResult>& findings) {
  const Int128 missing = balance.emitted + balance.roulette_gain - balance.absorbed_surfaces -
                         balance.absorbed_media - balance.escaped - balance.roulette_loss -
                         balance.lost();
  findings.push_back({"weight missing in the ledger", 0, {static_cast<double>(missing), 0}});
  findings.push_back({"weight of endless histories", 0, {static_cast<double>(balance.lost()), 0}});
}

/// Single-precision reflectances and integer weights limit the accuracy to a millionth.
constexpr double rounding = 1e-6;

std::vector<QuantityResult> read_quantities(const PreparedCase& plan, const Traced& run) {
  std::vector<QuantityResult> findings;
  for (const Quantity& q : plan.quantities) {
    const double unit = q.unit > 0 ? q.unit : run.emitted_w();
    findings.push_back({q.name, q.reference, q.read(run), q.bias + rounding * std::abs(q.reference),
                        unit, !q.certain});
  }
  return findings;
}

CoursePoint course_point(const CaseResult& result) {
  CoursePoint point{result.particles, result.seconds};
  double n = 0;
  for (const QuantityResult& f : result.findings) {
    if (!f.statistical || !(std::abs(f.reference) >= min_share * f.unit) ||
        !(f.estimate.standard_error > 0))
      continue;
    n += 1;
    point.standard_error += std::pow(f.estimate.standard_error / f.reference, 2);
    point.deviation += std::pow(f.estimate.value / f.reference - 1, 2);
  }
  point.standard_error = std::sqrt(point.standard_error / n);  // NaN without any
  point.deviation = std::sqrt(point.deviation / n);
  return point;
}

void fit_slopes(CaseResult& result) {
  std::vector<double> particles, seconds, error, deviation;
  for (const CoursePoint& p : result.course) {
    particles.push_back(static_cast<double>(p.particles));
    seconds.push_back(p.seconds);
    error.push_back(p.standard_error);
    deviation.push_back(p.deviation);
  }
  // A standard error from more batches is better known, so it gets more weight.
  result.slope_particles = log_slope(particles, error, particles);
  result.slope_seconds = log_slope(seconds, error, particles);
  // A deviation is as random after many particles as after few.
  const std::vector<double> alike(particles.size(), 1.0);
  result.slope_deviation = log_slope(particles, deviation, alike);
}

class Suite {
 public:
  Suite(const Cases& cases, const SuiteOptions& options, const std::atomic<bool>& interrupt,
        const ReportSuite& report)
      : cases_(cases),
        options_(options),
        executor_(options.executor == nullptr ? threads_ : *options.executor),
        interrupt_(interrupt),
        report_(report) {}

  std::vector<CaseResult> run() {
    began_ = clock_.now();
    if (options_.error > 0) predict();
    std::vector<CaseResult> results;
    for (const Case& c : cases_) {
      if (interrupt_.load()) break;
      show(results.size(), c.name, 0);
      results.push_back(run_case(c, options_.error));
    }
    return results;
  }

 private:
  CaseResult run_case(const Case& c, double error);
  void trace(const Case& c, const PreparedCase& plan, double error, CaseResult& result);
  void predict();
  void show(size_t done, const std::string& name, double of_this);

  const Cases& cases_;
  const SuiteOptions& options_;
  RunThreads threads_;
  RunExecutor& executor_;
  const std::atomic<bool>& interrupt_;
  const ReportSuite& report_;
  const SystemClock clock_;
  Nanoseconds began_ = 0;
  std::vector<double> expected_s_;  // by case; empty until predicted
  size_t done_ = 0;
  std::string name_;
};

void Suite::show(size_t done, const std::string& name, double of_this) {
  done_ = done;
  name_ = name;
  SuiteProgress p{done, cases_.size(), name, static_cast<double>(clock_.now() - began_) * 1e-9,
                  std::numeric_limits<double>::quiet_NaN()};
  if (!expected_s_.empty()) {
    p.seconds_left = -std::min(of_this, expected_s_[done]);
    for (size_t i = done; i < expected_s_.size(); ++i) p.seconds_left += expected_s_[i];
  } else if (done > 0) {
    p.seconds_left =
        p.seconds / static_cast<double>(done) * static_cast<double>(cases_.size() - done);
  }
  report_(p);
}

/// A quick run of each case predicts its time to the error.
void Suite::predict() {
  std::vector<double> expected;
  for (const Case& c : cases_) {
    if (interrupt_.load()) return;
    show(expected.size(), c.name + " (quickly)", 0);
    const CaseResult quick = run_case(c, 0);
    const double most = static_cast<double>(limits::case_particles) /
                        static_cast<double>(std::max<int64_t>(1, quick.particles));
    const double to_error = quick.seconds * std::clamp(need(quick, options_.error), 1.0, most);
    expected.push_back(std::min(to_error, std::max(quick.seconds, options_.case_seconds)));
  }
  expected_s_ = std::move(expected);
}

CaseResult Suite::run_case(const Case& c, double error) {
  CaseResult result;
  result.group = c.group;
  result.name = c.name;
  result.source = c.source;
  const Nanoseconds began = clock_.now();
  const PreparedCase plan = c.plan();
  if (!plan.quantities.empty()) trace(c, plan, error, result);
  for (const Computed& q : plan.computed)
    result.findings.push_back({q.name,
                               q.reference,
                               {q.value(options_.direct_light), 0},
                               q.tolerance * std::abs(q.reference)});
  if (plan.quantities.empty()) result.seconds = static_cast<double>(clock_.now() - began) * 1e-9;
  fit_slopes(result);
  return result;
}

void Suite::trace(const Case& c, const PreparedCase& plan, double error, CaseResult& result) {
  SceneDescription scene = plan.scene;
  scene.run.batch_particles =
      std::clamp(plan.quick_particles / quick_batches, int64_t{16}, plan.batch_particles);
  Traced run(compile(std::move(scene)), seed_of(c, options_.seed), options_.threads, plan.sums,
             plan.weighted);
  if (options_.make_tracer) run.trace_with(options_.make_tracer);
  for (int64_t n = plan.quick_particles / first_share;;) {
    StopRule stop;
    stop.particles = n;
    const auto reason = executor_.run(run.local(), stop, interrupt_, [&](const Progress&) {
      show(done_, name_, run.local().seconds());
    });
    if (!reason) throw std::runtime_error(reason.problem().text());
    result.particles = run.local().particles();
    result.batches = run.local().batches();
    result.seconds = run.local().seconds();
    result.findings = read_quantities(plan, run);
    result.course.push_back(course_point(result));
    if (interrupt_.load()) break;
    if (n < plan.quick_particles) {
      n = std::min(2 * n, plan.quick_particles);
      continue;
    }
    result.short_of = error > 0 ? need(result, error) : 0;
    if (result.short_of <= 1 || n >= limits::case_particles) break;
    // Slightly more than the error requires, since it is itself an estimate.
    const double growth = std::min(std::clamp(1.02 * result.short_of, 1.1, 2.0),
                                   options_.case_seconds / result.seconds);
    if (growth < 1.1) break;  // little more time than has passed
    n = std::min(static_cast<int64_t>(static_cast<double>(n) * growth), limits::case_particles);
  }
  add_ledger(run.balance(), result.findings);
}

}  // namespace

size_t cases_short_of_error(const std::vector<CaseResult>& results) {
  return static_cast<size_t>(std::count_if(results.begin(), results.end(),
                                           [](const CaseResult& r) { return r.short_of > 1; }));
}

Precision precision_of(const std::vector<CaseResult>& results, double error) {
  Precision out;
  out.error = error;
  for (const CaseResult& r : results) {
    for (const QuantityResult& f : r.findings) {
      if (!f.statistical || !(f.estimate.standard_error > 0)) continue;
      const double wanted = error * std::abs(f.reference), floor = error * min_share * f.unit;
      const bool reached = f.estimate.standard_error <= std::max(wanted, floor);
      if (useful_share * f.bias > std::max(wanted, floor))
        ++out.by_reference;
      else if (f.estimate.standard_error <= wanted)
        ++out.known;
      else
        ++(reached ? out.small : out.by_particles);
    }
  }
  return out;
}

Slopes slopes_of(const std::vector<CaseResult>& results) {
  std::vector<double> particles, error, deviation, alike;
  for (size_t k = 0; k < quick_checkpoints; ++k) {
    double n = 0, error2 = 0, deviation2 = 0;
    for (const CaseResult& r : results) {
      if (r.course.size() < quick_checkpoints) continue;
      const double scale = r.course[quick_checkpoints - 1].standard_error;
      const CoursePoint& p = r.course[k];
      if (!(scale > 0 && p.standard_error > 0)) continue;
      n += 1;
      error2 += std::pow(p.standard_error / scale, 2);
      deviation2 += std::pow(p.deviation / scale, 2);
    }
    particles.push_back(std::exp2(k));
    error.push_back(std::sqrt(error2 / n));  // NaN for none
    deviation.push_back(std::sqrt(deviation2 / n));
    alike.push_back(1);
  }
  return {log_slope(particles, error, alike), log_slope(particles, deviation, alike)};
}

double figure_of_merit(const QuantityResult& f, double seconds) {
  const double error = f.estimate.standard_error / std::abs(f.reference);
  return error > 0 && std::isfinite(error) && seconds > 0 ? 1 / (error * error * seconds) : 0;
}

std::vector<CaseResult> run_suite(const Cases& cases, const SuiteOptions& options,
                                  const std::atomic<bool>& interrupt, const ReportSuite& report) {
  return Suite(cases, options, interrupt, report).run();
}

}  // namespace luxodus::light

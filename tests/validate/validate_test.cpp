// `luxodus validate` itself: it passes, its rule detects errors, and it detects every flaw that the
// tracer can be given.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/validation_report.hpp"
#include "runtime/core/random.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/kit/test_length.hpp"
#include "tests/validate/flawed_eyes.hpp"
#include "tests/validate/flawed_tracer.hpp"

namespace luxodus::light {
namespace {

const std::atomic<bool> no_interrupt{false};

std::vector<CaseResult> run(const Cases& cases, const SuiteOptions& options) {
  return run_suite(cases, options, no_interrupt, [](const SuiteProgress&) {});
}

Cases named(const std::vector<std::string>& names) {
  Cases chosen;
  const Cases all = all_cases();
  for (const std::string& name : names) {
    for (const Case& c : all) {
      if (c.name == name) chosen.push_back(c);
    }
  }
  REQUIRE(chosen.size() == names.size());
  return chosen;
}

/// Cases with fewer particles, in as many batches.
Cases with_share_of_particles(Cases cases, int64_t divisor) {
  for (Case& c : cases) {
    c.plan = [plan = c.plan, divisor] {
      PreparedCase less = plan();
      less.quick_particles /= divisor;
      less.batch_particles = std::max<int64_t>(less.batch_particles / divisor, 1);
      return less;
    };
  }
  return cases;
}

/// The failures, one line each.
std::vector<std::string> failures(const std::vector<CaseResult>& results, const Verdict& verdict) {
  std::vector<std::string> out;
  for (size_t i = 0; i < results.size(); ++i) {
    for (size_t k = 0; k < results[i].findings.size(); ++k) {
      const QuantityResult& f = results[i].findings[k];
      if (verdict.judged[i][k].judgement != Judgement::failed) continue;
      out.push_back(results[i].name + ": " + f.quantity + ": " + std::to_string(f.estimate.value) +
                    " +- " + std::to_string(f.estimate.standard_error) + " instead of " +
                    std::to_string(f.reference));
    }
  }
  for (const OverallTest& c : verdict.checks)
    if (!c.passed) out.push_back(c.name + ": " + c.found + ", allowed: " + c.allowed);
  return out;
}

}  // namespace

TEST_CASE("every case with a reference passes quickly, and z has the right distribution") {
  SuiteOptions options;
  options.threads = 2;
  const Cases cases = with_share_of_particles(all_cases(), test::in_full() ? 1 : 4);
  const std::vector<CaseResult> results = run(cases, options);
  REQUIRE(results.size() == cases.size());
  const Verdict verdict = judge(results);
  for (const std::string& line : failures(results, verdict)) UNSCOPED_INFO(line);
  CHECK(verdict.passed);
  CHECK(verdict.lead_count >= 200);
  // With standard errors stated a third too small or too large, this run does not pass.
  for (const double wrong : {0.75, 1.33}) {
    std::vector<CaseResult> dishonest = results;
    for (CaseResult& r : dishonest) {
      for (QuantityResult& f : r.findings) f.estimate.standard_error *= wrong;
    }
    const Verdict other = judge(dishonest);
    INFO("variance of z with standard errors of " << wrong << ": " << other.leads.variance);
    CHECK_FALSE(other.passed);
    const auto variance =
        std::find_if(other.checks.begin(), other.checks.end(),
                     [](const OverallTest& c) { return c.name == "variance of z"; });
    REQUIRE(variance != other.checks.end());
    CHECK_FALSE(variance->passed);
  }
  // The file of a run can be read back, with every case in it.
  const test::TemporaryFolder folder;
  SuiteRecord record;
  record.threads = 2;
  REQUIRE(write_suite(folder.path(), results, record, verdict).ok());
  std::ifstream in(folder / "validate.json");
  const Json json = Json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
  CHECK(json["passed"] == true);
  CHECK(json["cases"].size() == cases.size());
  CHECK(std::filesystem::file_size(folder / "validate.html") > 100000);
}

TEST_CASE("names of cases are unique") {
  std::set<std::string> names;
  for (const Case& c : all_cases()) {
    INFO(c.name);
    CHECK(names.insert(c.name).second);
    CHECK_FALSE(c.source.empty());
  }
}

TEST_CASE("every value of the tables of closed forms and of glowing cells is part of a case") {
  std::vector<double> compared;
  for (const Case& c : all_cases()) {
    const PreparedCase plan = c.plan();
    for (const Quantity& q : plan.quantities) compared.push_back(q.reference);
    for (const Computed& q : plan.computed) compared.push_back(q.reference);
  }
  std::sort(compared.begin(), compared.end());
  const auto stands = [&](double value) {
    const double digits = 2e-9 * std::abs(value);
    const auto at = std::lower_bound(compared.begin(), compared.end(), value - digits);
    return at != compared.end() && *at <= value + digits;
  };
  CHECK_FALSE(stands(0.123456789));
  for (const Row& row : reference_table("misc_exact.csv")) {
    INFO(row.text("id") << " " << row.text("parameters"));
    CHECK(stands(row.number("value")));
  }
  for (const Row& row : reference_table("burns_christon.csv")) {
    INFO(row.text("x"));
    const bool point = !row.text("kappa").empty();
    if (point) CHECK(stands(row.number("G_incident_radiation")));
    if (row.text("x") == "1.000" || row.text("x").starts_with("total emitted")) continue;
    CHECK(stands(row.number("divQ")));
  }
  for (const Row& row : reference_table("layered_slab.csv")) {
    INFO(row.text("case") << " " << row.text("incidence") << " " << row.text("from"));
    for (const char* column : {"R", "T", "T_direct"}) CHECK(stands(row.number(column)));
  }
}

TEST_CASE("a suite gives equal estimates for any number of threads, and others for other seeds") {
  const Cases cases = named({"cube c03_office"});
  SuiteOptions one, two, other;
  two.threads = 2;
  other.seed = 2;
  const auto a = run(cases, one), b = run(cases, two), c = run(cases, other);
  for (size_t i = 0; i < a[0].findings.size(); ++i) {
    CHECK(a[0].findings[i].estimate.value == b[0].findings[i].estimate.value);
    CHECK(a[0].findings[i].estimate.standard_error == b[0].findings[i].estimate.standard_error);
  }
  CHECK(a[0].findings[0].estimate.value != c[0].findings[0].estimate.value);
}

TEST_CASE("a suite run to a target error reaches it, with the error falling as 1 over root n") {
  SuiteOptions options;
  options.error = test::in_full() ? 1e-4 : 2e-4;
  const auto results = run(named({"plates r1=0.8;r2=0.3", "integrating sphere rho=0.5"}), options);
  for (const CaseResult& r : results) {
    INFO(r.name);
    for (const QuantityResult& f : r.findings) {
      if (f.statistical) CHECK(f.estimate.standard_error <= options.error * f.reference);
    }
    CHECK(r.slope_particles == Approx(-0.5).margin(0.1));
    CHECK(r.course.size() >= 5);
  }
  CHECK(judge(results).passed);
}

TEST_CASE("a suite given less time than its error needs reports how much is missing") {
  SuiteOptions options;
  options.error = 1e-9;
  options.case_seconds = 1e-3;
  const auto results = run(named({"plates r1=0.8;r2=0.3"}), options);
  CHECK(cases_short_of_error(results) == 1);
  CHECK(results[0].short_of > 1000);
  CHECK(results[0].findings[0].estimate.standard_error > 0);  // for a whole quick run
  CHECK(cases_short_of_error(run(named({"plates r1=0.8;r2=0.3"}), {})) == 0);
}

// ---- the rule ----------------------------------------------------------------------------------

namespace {

/// Results of as many cases, with the given values of z.
std::vector<CaseResult> results_with(const std::vector<double>& z) {
  std::vector<CaseResult> results;
  for (const double d : z) {
    CaseResult r;
    r.name = "case " + std::to_string(results.size());
    r.particles = 1 << 20;
    r.batches = 1 << 20;  // so that Student's t is the normal distribution
    r.findings.push_back({"q", 1, {1 + 0.001 * d, 0.001}, 0, 1, true});
    results.push_back(r);
  }
  return results;
}

/// Standard normal numbers (Box and Muller), scaled and shifted.
std::vector<double> normal_numbers(int n, double deviation, double mean) {
  Random random(7, RandomStream::test);
  std::vector<double> out;
  for (int i = 0; i < n; ++i) {
    random.start(static_cast<uint64_t>(i));
    const double u = random.uniform_double();
    const double v = random.uniform_double();
    out.push_back(mean +
                  deviation * std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v));
  }
  return out;
}

}  // namespace

TEST_CASE("normal z pass, and those too wide, too narrow or shifted do not") {
  CHECK(judge(results_with(normal_numbers(250, 1, 0))).passed);
  CHECK_FALSE(judge(results_with(normal_numbers(250, 1.3, 0))).passed);
  CHECK_FALSE(judge(results_with(normal_numbers(250, 0.75, 0))).passed);
  CHECK_FALSE(judge(results_with(normal_numbers(250, 1, 0.4))).passed);
}

TEST_CASE("one quantity out of a thousand that is six standard errors off fails") {
  std::vector<double> z = normal_numbers(1000, 1, 0);
  z[500] = 6;
  const Verdict verdict = judge(results_with(z));
  CHECK_FALSE(verdict.passed);
  CHECK(verdict.failed == 1);
  CHECK(verdict.z_largest == Approx(6).epsilon(1e-3));
}

TEST_CASE("a declared bias is allowed, but no more than that") {
  auto results = results_with({0});
  QuantityResult& f = results[0].findings[0];
  f.estimate.value = 1.02;
  f.bias = 0.02;
  CHECK(judge(results).passed);
  f.bias = 0.01;
  CHECK_FALSE(judge(results).passed);
}

TEST_CASE("computed values are held to their tolerance, and NaN fails") {
  auto results = results_with({0});
  results[0].findings.push_back({"computed", 2, {2.001, 0}, 0.002});
  CHECK(judge(results).passed);
  results[0].findings.back().bias = 0.0005;
  CHECK_FALSE(judge(results).passed);
  results[0].findings.back() = {"computed", 2, {std::nan(""), 0}, 0.002};
  CHECK_FALSE(judge(results).passed);
  results[0].findings.back() = {"estimated", 2, {std::nan(""), 0.1}, 0, 1, true};
  CHECK_FALSE(judge(results).passed);
}

TEST_CASE(
    "quantities that are too rare are reported without verdict, and a case of only noise fails") {
  auto results = results_with({0});
  results[0].findings.push_back({"rare", 1e-6, {2e-6, 1e-7}, 0, 1, true});
  const Verdict verdict = judge(results);
  CHECK(verdict.passed);
  CHECK(verdict.rare == 1);
  results[0].findings[0].estimate.standard_error = 0.2;
  CHECK_FALSE(judge(results).passed);
}

TEST_CASE("quantiles are those of the tables") {
  CHECK(normal_exceeded(0.025) == Approx(1.959964).epsilon(1e-6));
  CHECK(normal_exceeded(1e-7) == Approx(5.199338).epsilon(1e-6));
  // Student's t of 20 degrees exceeds 2.845340 with probability 0.005, a normal number 2.575829.
  CHECK(normal_of_student(2.845340, 20) == Approx(2.575829).epsilon(5e-4));
  CHECK(normal_of_student(-2.845340, 20) == Approx(-2.575829).epsilon(5e-4));
  // Chi-square of 100 degrees exceeds 140.169 with probability 0.005.
  CHECK(chi_square_exceeded(0.005, 100) == Approx(1.40169).epsilon(1e-3));
  CHECK(log_slope({1, 10, 100}, {1, 0.1, 0.01}, {1, 2, 3}) == Approx(-1));
}

// ---- broken samplers ---------------------------------------------------------------------------

namespace {

/// A few cases that together use every step of the loop, the quickest first.
Cases cases_of_every_step() {
  return named({"beams of 1, 2 and 5 W", "glass pane theta=60", "cube of gas, optical depth 1",
                "diffuse wall under a beam", "plates r1=0.8;r2=0.3",
                "beam on a glossy plate, 65 deg, alpha 0.1",
                "flame between layers of depth 0.1|1|2", "luminaire of an LDT file",
                "furnace, white smoke: homogeneous", "half space, albedo 0.9, R(mu0=1)",
                "stack 41 mixA of depth 3, normal from top", "cube c05_one_wall_emits_unequal",
                "stack 41 mixA of depth 3, lambert from top",
                "stack 36 L6 of depth 5, lambert from top", "cube p03_point_centre_rho.5",
                "area lamp L5_large_4x4_h1, traced", "furnace, white smoke: all over one another",
                "beam in fog, c=0.9;g=0.5"});
}

SuiteOptions flawed_options() {
  SuiteOptions options;
  options.threads = 2;
  options.make_tracer = make_flawed_tracer;
  return options;
}

/// Whether a suite with a flaw passes. One case that detects it is enough; in full runs, all run
/// and are judged together.
bool passes(const Cases& cases, const SuiteOptions& options) {
  if (test::in_full()) return judge(run(cases, options)).passed;
  return std::all_of(cases.begin(), cases.end(),
                     [&](const Case& c) { return judge(run({c}, options)).passed; });
}

}  // namespace

TEST_CASE("the loop that flaws are injected into passes without a flaw") {
  set_flaw(Flaw::none);
  const auto results = run(cases_of_every_step(), flawed_options());
  const Verdict verdict = judge(results);
  for (const std::string& line : failures(results, verdict)) UNSCOPED_INFO(line);
  CHECK(verdict.passed);
}

TEST_CASE("every flaw of the tracer makes validation fail") {
  const Cases cases = cases_of_every_step();
  for (int i = 1; i < flaws; ++i) {
    const auto flaw = static_cast<Flaw>(i);
    set_flaw(flaw);
    const bool passed = passes(cases, flawed_options());
    set_flaw(Flaw::none);
    INFO(name_of(flaw));
    CHECK_FALSE(passed);
  }
}

// ---- broken eyes -------------------------------------------------------------------------------

namespace {

Cases cases_of_eyes() {
  return named({"probe over a glossy plate, alpha 0.3", "sign seen through glowing gas, depth 1",
                "veil of a lamp, even scattering",
                "veil of a lamp, even scattering, half of it behind a sheet",
                "veil of a lamp, g 0.7", "veil of a luminaire, LDT file",
                "Koschmieder, optical depth 0.5, g 0"});
}

Cases cases_of_direct_light() {
  return named({"area lamp L5_large_4x4_h1, direct light",
                "area lamp L5_large_4x4_h1, direct light in gas of 0.5 /m",
                "area lamp half hidden by a sheet", "glass pane theta=60",
                "luminaire of an IES file"});
}

/// Runs with or without a flaw, and reports the first failure.
void check_found(const Cases& cases, const SuiteOptions& options, const char* flaw, bool flawed) {
  const auto results = run(cases, options);
  const Verdict verdict = judge(results);
  const std::vector<std::string> found = failures(results, verdict);
  INFO(flaw << ": " << found.size() << " failures, first "
            << (found.empty() ? "none" : found.front()));
  CHECK(verdict.passed == !flawed);
}

}  // namespace

TEST_CASE("every flaw of eyes and probes makes validation fail, and without one it passes") {
  const Cases cases = cases_of_eyes();
  SuiteOptions options;
  options.threads = 2;
  options.make_tracer = eyes_with(EyeFlaw::none);
  check_found(cases, options, name_of(EyeFlaw::none), false);
  for (int i = 1; i < eye_flaws; ++i) {
    const auto flaw = static_cast<EyeFlaw>(i);
    options.make_tracer = eyes_with(flaw);
    // Without walls light in white smoke never ends.
    const bool ends = flaw != EyeFlaw::through_sheets;
    INFO(name_of(flaw));
    CHECK_FALSE(
        passes(ends ? cases : named({"veil of a lamp, even scattering, half of it behind a sheet"}),
               options));
  }
}

TEST_CASE("every flaw of computed direct light makes validation fail, and without one it passes") {
  const Cases cases = cases_of_direct_light();
  for (int i = 0; i < direct_flaws; ++i) {
    const auto flaw = static_cast<DirectFlaw>(i);
    SuiteOptions options;
    options.threads = 2;
    options.direct_light = direct_light_with(flaw);
    check_found(cases, options, name_of(flaw), flaw != DirectFlaw::none);
  }
}

TEST_CASE("repeated batches make standard errors too small, which the spread of z reveals") {
  Cases cases = cases_named("layer of gas");
  for (const char* more : {"glowing layer", "cubic room", "glossy plate", "glass pane"}) {
    for (const Case& c : cases_named(more)) cases.push_back(c);
  }
  SuiteOptions options;
  options.threads = 2;
  CHECK(judge(run(cases, options)).passed);
  options.make_tracer = repeated_batches();
  const Verdict verdict = judge(run(cases, options));
  CHECK_FALSE(verdict.passed);
  CHECK(verdict.lead_count >= 20);
  CHECK(verdict.leads.variance > 2);  // four, if errors are half of what they ought to be
}

}  // namespace luxodus::light

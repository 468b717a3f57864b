#include "actors/judge/validate/validation_report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace luxodus::light {

namespace {

const char* word(Judgement judgement) {
  switch (judgement) {
    case Judgement::passed:
      return "passed";
    case Judgement::failed:
      return "failed";
    case Judgement::rare:
      break;
  }
  return "too rare to be judged";
}

Json finding_json(const QuantityResult& f, const QuantityVerdict& j, double seconds) {
  Json out = {{"quantity", f.quantity},
              {"reference", number_json(f.reference)},
              {"result", number_json(f.estimate.value)}};
  if (f.statistical) {
    out["standard_error"] = number_json(f.estimate.standard_error);
    out["z"] = number_json(j.z);
    out["declared_bias"] = number_json(f.bias);
    out["figure_of_merit"] = number_json(figure_of_merit(f, seconds));
  } else {
    out["tolerance"] = number_json(f.bias);
  }
  out["relative_error"] = number_json(f.estimate.value / f.reference - 1);
  out["judgement"] = word(j.judgement);
  out["stands_for_its_case"] = j.lead;
  return out;
}

Json case_json(const CaseResult& result, const std::vector<QuantityVerdict>& judged) {
  Json course = Json::array(), quantities = Json::array();
  for (const CoursePoint& p : result.course)
    course.push_back({{"particles", p.particles},
                      {"seconds", p.seconds},
                      {"relative_standard_error", number_json(p.standard_error)},
                      {"relative_deviation", number_json(p.deviation)}});
  for (size_t i = 0; i < result.findings.size(); ++i)
    quantities.push_back(finding_json(result.findings[i], judged[i], result.seconds));
  return {{"case", result.name},
          {"source", result.source},
          {"particles", result.particles},
          {"batches", result.batches},
          {"seconds", result.seconds},
          {"times_more_particles_to_the_error",
           result.short_of > 1 ? Json(result.short_of) : Json(nullptr)},
          {"slope_particles", number_json(result.slope_particles)},
          {"slope_seconds", number_json(result.slope_seconds)},
          {"slope_deviation", number_json(result.slope_deviation)},
          {"course", course},
          {"quantities", quantities}};
}

Json precision_json(const Precision& p) {
  return {{"relative_error", p.error},
          {"known", p.known},
          {"limited_by_reference", p.by_reference},
          {"small_and_known_absolutely", p.small},
          {"limited_by_particles", p.by_particles},
          {"of", p.all()}};
}

Json sample_json(const Sample& sample, size_t count) {
  return {{"count", count},
          {"mean", number_json(sample.mean)},
          {"variance", number_json(sample.variance)},
          {"kolmogorov_smirnov_distance", number_json(sample.distance)},
          {"kolmogorov_smirnov_p", number_json(sample.probability)}};
}

}  // namespace

std::string precision_text(const Precision& p) {
  return fmt::format(
      "{} of {} quantities are known to {:g} %; {} are limited by their references, {} are small "
      "and known to as much of a hundredth of what could be, {} are limited by particles",
      p.known, p.all(), 100 * p.error, p.by_reference, p.small, p.by_particles);
}

Json suite_json(const std::vector<CaseResult>& results, const Verdict& verdict,
                const SuiteRecord& record) {
  Json checks = Json::array(), cases = Json::array();
  for (const OverallTest& c : verdict.checks)
    checks.push_back(
        {{"check", c.name}, {"found", c.found}, {"allowed", c.allowed}, {"passed", c.passed}});
  for (size_t i = 0; i < results.size(); ++i)
    cases.push_back(case_json(results[i], verdict.judged[i]));
  return {{"passed", verdict.passed},
          {"interrupted", record.interrupted},
          {"seed", record.seed},
          {"threads", record.threads},
          {"error_asked_for", record.error > 0 ? Json(record.error) : Json(nullptr)},
          {"seconds_of_a_case_at_most", number_json(record.case_seconds)},
          {"cases_short_of_the_error", cases_short_of_error(results)},
          {"known_to", precision_json(precision_of(results, record.wanted_error()))},
          {"slope_of_standard_errors", number_json(slopes_of(results).standard_error)},
          {"slope_of_deviations", number_json(slopes_of(results).deviation)},
          {"only", record.only},
          {"rule", rule_text()},
          {"checks", checks},
          {"statistical_quantities", verdict.statistical},
          {"computed_quantities", verdict.computed},
          {"too_rare_to_be_judged", verdict.rare},
          {"largest_z", {{"z", number_json(verdict.z_largest)}, {"of", verdict.z_largest_of}}},
          {"z_of_all", sample_json(verdict.all, verdict.z.size())},
          {"z_of_cases", sample_json(verdict.leads, verdict.lead_count)},
          {"cases", cases}};
}

Result<void> write_suite(const std::filesystem::path& folder,
                         const std::vector<CaseResult>& results, const SuiteRecord& record,
                         const Verdict& verdict) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return system_problem(folder, "cannot make this folder", error.value());
  if (auto ok = write_json(folder / "validate.json", suite_json(results, verdict, record)); !ok)
    return ok.problem();
  const auto page = suite_page(results, verdict, record);
  if (!page) return page.problem();
  return write_file_atomically(folder / "validate.html", std::string_view(page.value()));
}

}  // namespace luxodus::light

// Rules for the illuminance on routes, in open areas and on task planes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  double mean = 0;
  glm::dvec3 darkest{0};

  /// Largest over smallest; infinite if a place has no light at all.
  double diversity() const {
    return least > 0 ? most / least : std::numeric_limits<double>::infinity();
  }
};

/// Illuminance from all luminaires, the light of each times its factor.
Spread spread_of(const std::vector<LitPoint>& points, const std::vector<double>& factors) {
  Spread spread;
  for (const LitPoint& point : points) {
    const double lux = std::inner_product(point.lux.begin(), point.lux.end(), factors.begin(), 0.0);
    spread.mean += lux / static_cast<double>(points.size());
    spread.most = std::max(spread.most, lux);
    if (lux < spread.least) {
      spread.least = lux;
      spread.darkest = point.place;
    }
  }
  return spread;
}

/// Factors of the light at the judged time: 0 for a luminaire whose supply is exhausted.
std::vector<double> lit_now(const std::vector<LitPoint>& points, const FedLuminaires& fed) {
  std::vector<double> out(points.empty() ? 0 : points.front().lux.size(), 1.0);
  for (size_t i = 0; i < std::min(out.size(), fed.size()); ++i) out[i] = fed[i] ? 1 : 0;
  return out;
}

/// Factors from the flux at the end of the rated duration to that of a new luminaire.
std::vector<double> as_new(const SceneDescription& scene) {
  std::vector<double> factors;
  for (const uint32_t number : emergency_luminaires(scene))
    factors.push_back(1 / scene.emitters[number].emergency_ageing);
  return factors;
}

Check darkest_of(const Rule& rule, const Subject& subject, const Spread& spread) {
  return judged(rule, subject, spread.least, spread.darkest);
}

Check even(const Rule& rule, const Subject& subject, const Spread& spread) {
  return judged(rule, subject, spread.diversity(), spread.darkest);
}

/// The failure of one luminaire that leaves the smallest illuminance.
struct LampFailure {
  Spread spread;
  std::string luminaire;
};

std::optional<LampFailure> worst_failure(const SceneDescription& scene,
                                         const std::vector<LitPoint>& points,
                                         const FedLuminaires& fed) {
  const auto luminaires = emergency_luminaires(scene);
  std::optional<LampFailure> worst;
  for (size_t i = 0; i < luminaires.size(); ++i) {
    std::vector<double> factors = lit_now(points, fed);
    if (i < factors.size()) factors[i] = 0;
    const Spread spread = spread_of(points, factors);
    if (!worst || spread.least < worst->spread.least)
      worst = LampFailure{spread, scene.emitters[luminaires[i]].name};
  }
  return worst;
}

/// Hospitals (N4, IBC group I-2): illuminance with one luminaire failed.
Check enough_with_one_failed(const Rule& rule, const SceneDescription& scene,
                             const Subject& subject, const std::vector<LitPoint>& points,
                             const FedLuminaires& fed) {
  const auto worst = worst_failure(scene, points, fed);
  if (!worst) {
    Check check = judged(rule, subject, 0);
    check.reasons = {remark(RemarkId::no_emergency_luminaire)};
    return check;
  }
  Check check = darkest_of(rule, subject, worst->spread);
  check.conditions = {remark(RemarkId::luminaire_failed, worst->luminaire)};
  return check;
}

std::vector<Check> american_checks(const SceneDescription& scene, const Subject& subject,
                                   const Spread& centre, const std::vector<LitPoint>& points,
                                   const CodeChoice& codes, const FedLuminaires& fed) {
  const bool ibc = codes.has(Deviation::us_ibc);
  const auto rule = [&](RuleId nfpa, RuleId other) { return rule_of(ibc ? other : nfpa, codes); };
  const Spread first = spread_of(points, as_new(scene));
  std::vector<Check> out{judged(rule(RuleId::N1, RuleId::I1), subject, first.mean),
                         darkest_of(rule(RuleId::N1m, RuleId::I1m), subject, first),
                         judged(rule(RuleId::N2, RuleId::I2), subject, centre.mean),
                         darkest_of(rule(RuleId::N2m, RuleId::I2m), subject, centre),
                         even(rule_of(RuleId::N3, codes), subject, centre)};
  if (codes.has(Deviation::us_ibc_i2))
    out.push_back(enough_with_one_failed(rule_of(RuleId::N4, codes), scene, subject, points, fed));
  return out;
}

}  // namespace

std::vector<uint32_t> emergency_luminaires(const SceneDescription& scene) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i)
    if (scene.emitters[i].emergency_flux > 0) out.push_back(i);
  return out;
}

Check check_of_failure(const SceneDescription& scene, const Subject& subject,
                       const std::vector<LitPoint>& points, const FedLuminaires& fed) {
  Check check;
  check.rule = own_rule(RuleId::F1);
  check.subject = subject;
  check.unit = "lx";
  check.verdict = CheckVerdict::information;
  const auto worst = worst_failure(scene, points, fed);
  if (!worst || points.empty()) {
    check.reasons = {
        remark(worst ? RemarkId::nowhere_to_assess : RemarkId::no_emergency_luminaire)};
    return check;
  }
  check.value = worst->spread.least;
  check.worst = worst->spread.darkest;
  check.conditions = {remark(RemarkId::luminaire_failed, worst->luminaire)};
  check.reasons = {remark(RemarkId::worst_of_failures, emergency_luminaires(scene).size())};
  return check;
}

RoutePoints points_of(const EscapeRoute& route) {
  RoutePoints points;
  const int strips = std::max(1, static_cast<int>(std::ceil(route.width_m / strip_m * (1 - 1e-9))));
  const double strip = route.width_m / strips;
  const auto add = [](std::vector<glm::dvec3>& to, const std::vector<glm::dvec3>& line) {
    to.insert(to.end(), line.begin(), line.end());
  };
  for (int i = 0; i < strips; ++i) {
    const double middle = (i + 0.5) * strip - route.width_m / 2;
    add(points.centre, along(route, middle, route_grid_m));
    for (const double aside : {-0.25, -0.125, 0.0, 0.125, 0.25})
      add(points.band, along(route, middle + aside * strip, route_grid_m));
  }
  const double edge = route.width_m > strip_m ? wide_edge_m : route.width_m / 4;
  points.inner = within(route, route.width_m / 2 - edge, route_grid_m);
  return points;
}

std::vector<Check> checks_of_route(const SceneDescription& scene, const EscapeRoute& route,
                                   const RouteLight& light, const CodeChoice& codes,
                                   const FedLuminaires& fed) {
  const Subject subject = subject_of(route);
  const Spread centre = spread_of(light.centre, lit_now(light.centre, fed));
  std::vector<Check> out;
  const auto rule = [&](RuleId id) { return rule_of(id, codes); };
  if (codes.set == RuleSet::en1838_2013) {
    out.push_back(darkest_of(rule(RuleId::E1), subject, centre));
    out.push_back(
        darkest_of(rule(RuleId::E2), subject, spread_of(light.band, lit_now(light.band, fed))));
  }
  if (codes.set == RuleSet::en1838_2024)
    out.push_back(
        darkest_of(rule(RuleId::E5), subject, spread_of(light.inner, lit_now(light.inner, fed))));
  if (codes.european())
    out.push_back(even(rule(RuleId::E4), subject, centre));
  else
    out = american_checks(scene, subject, centre, light.centre, codes, fed);
  for (Check& check : checks_of_onset(scene, subject, light.centre, limit_of(RuleId::E1), codes))
    out.push_back(std::move(check));
  return out;
}

std::vector<Check> checks_of_open_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& core, const CodeChoice& codes,
                                       const FedLuminaires& fed) {
  const Subject subject{SubjectKind::open_area, area.name};
  if (!codes.european())
    return {
        not_assessed(rule_of(RuleId::N1, codes), subject, remark(RemarkId::routes_alone_judged))};
  const auto rule = [&](RuleId id) { return rule_of(id, codes); };
  if (core.empty()) return {not_assessed(rule(RuleId::E6), subject, remark(RemarkId::no_core))};
  const Spread spread = spread_of(core, lit_now(core, fed));
  std::vector<Check> out{darkest_of(rule(RuleId::E6), subject, spread),
                         even(rule(RuleId::E6d), subject, spread)};
  if (codes.has(Deviation::uk_bs_5266))
    out.push_back(darkest_of(rule(RuleId::E6k), subject, spread));
  for (Check& check : checks_of_onset(scene, subject, core, limit_of(RuleId::E6), codes))
    out.push_back(std::move(check));
  return out;
}

std::vector<Check> checks_of_task_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& plane, const CodeChoice& codes,
                                       const FedLuminaires& fed) {
  const Subject subject{SubjectKind::task_area, area.name};
  if (!codes.european())
    return {
        not_assessed(rule_of(RuleId::N1, codes), subject, remark(RemarkId::routes_alone_judged))};
  const Spread spread = spread_of(plane, lit_now(plane, fed));
  const double limit = std::max(limit_of(RuleId::E7), task_share * area.mains_lx);
  std::vector<Check> out{
      judged(rule_of(RuleId::E7, codes), subject, spread.least, Limit{limit}, spread.darkest),
      judged(rule_of(RuleId::E7u, codes), subject, spread.most > 0 ? spread.least / spread.most : 0,
             spread.darkest)};
  for (Check& check : checks_of_task_onset(scene, subject, plane, limit, codes))
    out.push_back(std::move(check));
  return out;
}

}  // namespace luxodus

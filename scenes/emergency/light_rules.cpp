// Rules for the illuminance on routes, in open areas and on task planes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "scenes/emergency/extremes.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

/// Factors of the light at the judged time: 0 for a luminaire whose supply is exhausted.
LuminaireFactors lit_now(const std::vector<LitPoint>& points, const FedLuminaires& fed) {
  LuminaireFactors out(points.empty() ? 0 : points.front().lux.size(), 1.0);
  for (size_t i = 0; i < std::min(out.size(), fed.size()); ++i) out[i] = fed[i] ? 1 : 0;
  return out;
}

/// Factors from the flux at the end of the rated duration to that of a new luminaire.
LuminaireFactors as_new(const SceneDescription& scene) {
  LuminaireFactors factors;
  for (const uint32_t number : emergency_luminaires(scene))
    factors.push_back(1 / scene.emitters[number].emergency_ageing);
  return factors;
}

SpreadInterval now(const JudgedPoints& points, const FedLuminaires& fed) {
  return spread_of(points, lit_now(points.grid, fed));
}

Check darkest_of(const Rule& rule, const Subject& subject, const SpreadInterval& spread) {
  return judged_between(rule, subject, spread, least_of);
}

Check even(const Rule& rule, const Subject& subject, const SpreadInterval& spread) {
  return judged_between(rule, subject, spread, diversity_of);
}

/// The failure of one luminaire that leaves the smallest illuminance.
struct LampFailure {
  SpreadInterval spread;
  std::string luminaire;
};

std::optional<LampFailure> worst_failure(const SceneDescription& scene, const JudgedPoints& points,
                                         const FedLuminaires& fed) {
  const auto luminaires = emergency_luminaires(scene);
  std::optional<LampFailure> worst;
  for (size_t i = 0; i < luminaires.size(); ++i) {
    LuminaireFactors factors = lit_now(points.grid, fed);
    if (i < factors.size()) factors[i] = 0;
    const SpreadInterval spread = spread_of(points, factors);
    if (!worst || spread.all.least < worst->spread.all.least)
      worst = LampFailure{spread, scene.emitters[luminaires[i]].name};
  }
  return worst;
}

/// Hospitals (N4, IBC group I-2): illuminance with one luminaire failed.
Check enough_with_one_failed(const Rule& rule, const SceneDescription& scene,
                             const Subject& subject, const JudgedPoints& points,
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
                                   const JudgedPoints& points, const CodeChoice& codes,
                                   const FedLuminaires& fed) {
  const bool ibc = codes.has(Deviation::us_ibc);
  const auto rule = [&](RuleId nfpa, RuleId other) { return rule_of(ibc ? other : nfpa, codes); };
  const SpreadInterval centre = now(points, fed), first = spread_of(points, as_new(scene));
  std::vector<Check> out{judged(rule(RuleId::N1, RuleId::I1), subject, first.grid.mean),
                         darkest_of(rule(RuleId::N1m, RuleId::I1m), subject, first),
                         judged(rule(RuleId::N2, RuleId::I2), subject, centre.grid.mean),
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
                       const JudgedPoints& points, const FedLuminaires& fed) {
  Check check;
  check.rule = own_rule(RuleId::F1);
  check.subject = subject;
  check.unit = "lx";
  check.verdict = CheckVerdict::information;
  const auto worst = worst_failure(scene, points, fed);
  if (!worst || points.grid.empty()) {
    check.reasons = {
        remark(worst ? RemarkId::nowhere_to_assess : RemarkId::no_emergency_luminaire)};
    return check;
  }
  const SpreadInterval& spread = worst->spread;
  const bool as_on_grid = is_one_value(spread.grid.least, spread.all.least);
  check.value = (as_on_grid ? spread.grid : spread.all).least;
  check.worst = (as_on_grid ? spread.grid : spread.all).darkest;
  check.conditions = {remark(RemarkId::luminaire_failed, worst->luminaire)};
  check.reasons = {remark(RemarkId::worst_of_failures, emergency_luminaires(scene).size())};
  if (!as_on_grid) check.reasons.push_back(remark(RemarkId::value_on_grid, spread.grid.least));
  return check;
}

RoutePoints points_of(const EscapeRoute& route, const LineOfRoute& line) {
  RoutePoints points;
  const int strips = std::max(1, static_cast<int>(std::ceil(route.width_m / strip_m * (1 - 1e-9))));
  const double strip = route.width_m / strips;
  for (int i = 0; i < strips; ++i) {
    const double middle = (i + 0.5) * strip - route.width_m / 2;
    points.centre.append(grid_of({line(middle)}, false));
    std::vector<GridLine> band;
    for (const double aside : {-0.25, -0.125, 0.0, 0.125, 0.25})
      band.push_back(line(middle + aside * strip));
    points.band.append(grid_of(band, true));
  }
  const double edge = route.width_m > strip_m ? wide_edge_m : route.width_m / 4;
  points.inner = grid_within(route.width_m / 2 - edge, route_grid_m, line);
  return points;
}

namespace {

/// Adds checks on points of a route, and how many of these were left out.
class RouteChecks {
 public:
  void add(Check check, const JudgedPoints& points) {
    if (points.in_bodies > 0)
      check.conditions.push_back(remark(RemarkId::points_in_bodies, points.in_bodies,
                                        points.in_bodies + points.grid.size()));
    checks.push_back(std::move(check));
  }
  /// Not assessed where no points are left.
  void add(const Rule& rule, const Subject& subject, const JudgedPoints& points,
           const std::function<Check(const Rule&)>& judge) {
    add(points.grid.empty() ? not_assessed(rule, subject, remark(RemarkId::nowhere_to_assess))
                            : judge(rule),
        points);
  }
  std::vector<Check> checks;
};

}  // namespace

std::vector<Check> checks_of_route(const SceneDescription& scene, const EscapeRoute& route,
                                   const RouteLight& light, const CodeChoice& codes,
                                   const FedLuminaires& fed) {
  const Subject subject = subject_of(route);
  RouteChecks out;
  const auto add_darkest = [&](RuleId id, const JudgedPoints& points) {
    out.add(rule_of(id, codes), subject, points,
            [&](const Rule& rule) { return darkest_of(rule, subject, now(points, fed)); });
  };
  if (codes.set == RuleSet::en1838_2013) {
    add_darkest(RuleId::E1, light.centre);
    add_darkest(RuleId::E2, light.band);
  }
  if (codes.set == RuleSet::en1838_2024) add_darkest(RuleId::E5, light.inner);
  if (codes.european()) {
    out.add(rule_of(RuleId::E4, codes), subject, light.centre,
            [&](const Rule& rule) { return even(rule, subject, now(light.centre, fed)); });
  } else if (light.centre.grid.empty()) {
    out.add(not_assessed(rule_of(RuleId::N1, codes), subject, remark(RemarkId::nowhere_to_assess)),
            light.centre);
  } else {
    for (Check& check : american_checks(scene, subject, light.centre, codes, fed))
      out.add(std::move(check), light.centre);
  }
  for (Check& check : checks_of_onset(scene, subject, light.centre, limit_of(RuleId::E1), codes))
    out.add(std::move(check), light.centre);
  return std::move(out.checks);
}

std::vector<Check> checks_of_flight(const std::string& flight, const std::vector<LitPoint>& treads,
                                    const CodeChoice& codes, const FedLuminaires& fed) {
  if (!codes.european()) return {};
  double least = std::numeric_limits<double>::infinity();
  glm::dvec3 darkest(0);
  for (const LitPoint& tread : treads) {
    double most = 0;
    for (size_t i = 0; i < tread.lux.size(); ++i)
      if (fed.empty() || fed[i]) most = std::max(most, tread.lux[i]);
    if (most >= least) continue;
    least = most;
    darkest = tread.place;
  }
  Check check = judged(rule_of(RuleId::E12s, codes), {SubjectKind::stairs, flight}, least, darkest);
  check.conditions = {remark(RemarkId::light_of_one_on_treads, treads.size())};
  return {std::move(check)};
}

std::vector<Check> checks_of_open_area(const SceneDescription& scene, const AssessedArea& area,
                                       const JudgedPoints& core, const CodeChoice& codes,
                                       const FedLuminaires& fed) {
  const Subject subject{SubjectKind::open_area, area.name};
  if (!codes.european())
    return {
        not_assessed(rule_of(RuleId::N1, codes), subject, remark(RemarkId::routes_alone_judged))};
  const auto rule = [&](RuleId id) { return rule_of(id, codes); };
  if (core.grid.empty())
    return {not_assessed(rule(RuleId::E6), subject, remark(RemarkId::no_core))};
  const SpreadInterval spread = now(core, fed);
  std::vector<Check> out{darkest_of(rule(RuleId::E6), subject, spread),
                         even(rule(RuleId::E6d), subject, spread)};
  if (codes.has(Deviation::uk_bs_5266))
    out.push_back(darkest_of(rule(RuleId::E6k), subject, spread));
  for (Check& check : checks_of_onset(scene, subject, core, limit_of(RuleId::E6), codes))
    out.push_back(std::move(check));
  return out;
}

std::vector<Check> checks_of_task_area(const SceneDescription& scene, const AssessedArea& area,
                                       const JudgedPoints& plane, const CodeChoice& codes,
                                       const FedLuminaires& fed) {
  const Subject subject{SubjectKind::task_area, area.name};
  if (!codes.european())
    return {
        not_assessed(rule_of(RuleId::N1, codes), subject, remark(RemarkId::routes_alone_judged))};
  const SpreadInterval spread = now(plane, fed);
  const double limit = std::max(limit_of(RuleId::E7), task_share * area.mains_lx);
  std::vector<Check> out{
      judged_between(rule_of(RuleId::E7, codes), subject, spread, least_of, Limit{limit}),
      judged_between(rule_of(RuleId::E7u, codes), subject, spread, uniformity_of)};
  for (Check& check : checks_of_task_onset(scene, subject, plane, limit, codes))
    out.push_back(std::move(check));
  return out;
}

}  // namespace luxodus

// Illuminance on routes, in open areas and on task planes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

namespace {

constexpr double route_lx = 1.0, band_lx = 0.5, open_lx = 0.5;           // E1, E2, E6
constexpr double diversity_most = 40;                                    // E4, E6, N3
constexpr double strip_m = 2;                                            // E3
constexpr double task_lx = 15, task_share = 0.1, task_uniformity = 0.1;  // E7
constexpr double wide_edge_m = 0.5, open_border_m = 0.5;                 // E5, E6
constexpr double first_mean_lx = 10.8, first_least_lx = 1.1;             // N1
constexpr double last_mean_lx = 6.5, last_least_lx = 0.65;               // N2
constexpr double failed_least_lx = 2.2;                                  // N4

struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  double mean = 0;
  glm::dvec3 darkest{0};

  /// Infinite where some place has no light at all.
  double diversity() const {
    return least > 0 ? most / least : std::numeric_limits<double>::infinity();
  }
};

/// Of all luminaires, each with its factor.
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

std::vector<double> all_lit(const std::vector<LitPoint>& points) {
  return std::vector<double>(points.empty() ? 0 : points.front().lux.size(), 1.0);
}

/// From the end of the rated duration back to a new luminaire.
std::vector<double> as_new(const SceneDescription& scene) {
  std::vector<double> factors;
  for (const uint32_t number : emergency_luminaires(scene))
    factors.push_back(1 / scene.emitters[number].emergency_ageing);
  return factors;
}

Check at_least(const char* id, const std::string& subject, const Spread& spread, double limit) {
  return judged(rule_of(id), subject, spread.least, limit, true, "lx", spread.darkest);
}

Check even(const char* id, const std::string& subject, const Spread& spread) {
  return judged(rule_of(id), subject, spread.diversity(), diversity_most, false, "1",
                spread.darkest);
}

/// The least of the illuminance when one luminaire fails, whichever is worst.
Check with_one_failed(const SceneDescription& scene, const std::string& subject,
                      const std::vector<LitPoint>& points) {
  const auto luminaires = emergency_luminaires(scene);
  Check worst;
  worst.rule = rule_of("N4");
  worst.subject = subject;
  worst.unit = "lx";
  worst.verdict = CheckVerdict::information;
  worst.reason = "there is no emergency luminaire";
  for (size_t i = 0; i < luminaires.size(); ++i) {
    std::vector<double> factors = all_lit(points);
    factors[i] = 0;
    const Spread spread = spread_of(points, factors);
    if (worst.value && *worst.value <= spread.least) continue;
    worst.value = spread.least;
    worst.limit = failed_least_lx;
    worst.worst = spread.darkest;
    worst.condition = "\"" + scene.emitters[luminaires[i]].name + "\" has failed";
    worst.reason = "the worst of " + std::to_string(luminaires.size()) +
                   " single failures; the limit is that of group I-2 alone";
  }
  return worst;
}

}  // namespace

std::vector<uint32_t> emergency_luminaires(const SceneDescription& scene) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i)
    if (scene.emitters[i].emergency_flux > 0) out.push_back(i);
  return out;
}

RoutePoints points_of(const EscapeRoute& route, const CodeChoice& codes) {
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
  if (codes.en_2024) {
    const double edge = route.width_m > strip_m ? wide_edge_m : route.width_m / 4;
    points.inner = within(route, route.width_m / 2 - edge, route_grid_m);
  }
  return points;
}

std::vector<Check> checks_of_route(const SceneDescription& scene, const EscapeRoute& route,
                                   const RouteLight& light, const CodeChoice& codes) {
  const std::string subject = "route \"" + route.name + "\"";
  const Spread centre = spread_of(light.centre, all_lit(light.centre));
  std::vector<Check> out;
  if (codes.en_2013) {
    out.push_back(at_least("E1", subject, centre, route_lx));
    out.push_back(at_least("E2", subject, spread_of(light.band, all_lit(light.band)), band_lx));
  }
  if (codes.en_2024)
    out.push_back(at_least("E5", subject, spread_of(light.inner, all_lit(light.inner)), route_lx));
  if (codes.en_2013 || codes.en_2024) out.push_back(even("E4", subject, centre));
  if (codes.nfpa) {
    const Spread first = spread_of(light.centre, as_new(scene));
    out.push_back(judged(rule_of("N1"), subject, first.mean, first_mean_lx, true, "lx"));
    out.push_back(at_least("N1m", subject, first, first_least_lx));
    out.push_back(judged(rule_of("N2"), subject, centre.mean, last_mean_lx, true, "lx"));
    out.push_back(at_least("N2m", subject, centre, last_least_lx));
    out.push_back(even("N3", subject, centre));
  }
  for (Check& check : checks_of_onset(scene, subject, light.centre, route_lx, codes))
    out.push_back(std::move(check));
  out.push_back(with_one_failed(scene, subject, light.centre));
  return out;
}

std::vector<Check> checks_of_open_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& core, const CodeChoice& codes) {
  const std::string subject = "open area \"" + area.name + "\"";
  if (!codes.en_2013 && !codes.en_2024) return {};
  if (core.empty())
    return {not_assessed(rule_of("E6"), subject,
                         "it is narrower than its two borders of 0.5 m: it has no core")};
  const Spread spread = spread_of(core, all_lit(core));
  std::vector<Check> out{at_least("E6", subject, spread, open_lx), even("E6d", subject, spread),
                         with_one_failed(scene, subject, core)};
  for (Check& check : checks_of_onset(scene, subject, core, open_lx, {true, false, false}))
    out.push_back(std::move(check));
  return out;
}

std::vector<Check> checks_of_task_area(const SceneDescription& scene, const AssessedArea& area,
                                       const std::vector<LitPoint>& plane,
                                       const CodeChoice& codes) {
  const std::string subject = "task area \"" + area.name + "\"";
  if (!codes.en_2013 && !codes.en_2024) return {};
  const Spread spread = spread_of(plane, all_lit(plane));
  const double limit = std::max(task_lx, task_share * area.mains_lx);
  std::vector<Check> out{
      at_least("E7", subject, spread, limit),
      judged(rule_of("E7u"), subject, spread.most > 0 ? spread.least / spread.most : 0,
             task_uniformity, true, "1", spread.darkest)};
  for (Check& check : checks_of_task_onset(scene, subject, plane, limit, codes))
    out.push_back(std::move(check));
  return out;
}

}  // namespace luxodus

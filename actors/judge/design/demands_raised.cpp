// Additional rows: larger requirements where an assessment found too little, and points between
// those of the grid where a minimum does not hold.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "actors/judge/design/demands_lit.hpp"

namespace luxodus {

namespace {

/// Points closer than this are one [m].
constexpr double one_point_m = 1e-6;
/// Neighbours are tested of points whose light is within this factor of the least of their demand.
constexpr double near_min = 1.25;
/// Largest number of such points of each demand.
constexpr size_t looked_around = 40;
/// Neighbours of a point are up to this many times as far away as the nearest one.
constexpr double next_to = 1.5;
/// A demand is violated if it misses the planned value by more than this share.
constexpr double between_tolerance = 0.01;
/// Points closer than this are not subdivided [m].
constexpr double finest_m = 0.02;

/// Raises a row among those that `is_it` selects: the nearest one to a place, to `missing` more
/// than the layout gives there, or than is required now. False if there is none.
bool raise_nearest(LayoutProblem& problem, const std::function<bool(const CoverRow&)>& is_it,
                   const glm::dvec3& place, double missing, const Layout& layout) {
  const auto nearest = std::min_element(
      problem.covers.begin(), problem.covers.end(), [&](const CoverRow& a, const CoverRow& b) {
        if (is_it(a) != is_it(b)) return is_it(a);
        return glm::length(a.place - place) < glm::length(b.place - place);
      });
  if (nearest == problem.covers.end() || !is_it(*nearest)) return false;
  double counted = 0;
  for (const Term& term : *nearest->terms)
    if (layout[term.option] != 0) counted += static_cast<double>(term.value);
  CoverRow more = *nearest;
  more.least = std::max(nearest->least, counted) + missing * (1 + 1e-3);
  problem.covers.push_back(std::move(more));
  return true;
}

/// Midpoints between the darkest points of a demand and their neighbours.
std::vector<glm::dvec3> between_darkest(std::vector<std::pair<double, glm::dvec3>> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::set<PlaceKey> seen;
  for (const auto& [share, place] : points) seen.insert(key_of_place(place));
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < std::min(points.size(), looked_around); ++i) {
    if (points[i].first > near_min * points.front().first) break;
    double nearest = std::numeric_limits<double>::infinity();
    const auto away = [&](size_t k) { return glm::length(points[k].second - points[i].second); };
    for (size_t k = 0; k < points.size(); ++k)
      if (const double d = away(k); d > finest_m) nearest = std::min(nearest, d);
    for (size_t k = 0; k < points.size(); ++k) {
      if (away(k) <= finest_m || away(k) > next_to * nearest) continue;
      const glm::dvec3 middle = (points[i].second + points[k].second) / 2.0;
      if (seen.insert(key_of_place(middle)).second) out.push_back(middle);
    }
  }
  return out;
}

double sum_over(const std::vector<Term>& terms, const Layout& layout) {
  double out = 0;
  for (const Term& term : terms)
    if (layout[term.option] != 0) out += static_cast<double>(term.value);
  return out;
}

}  // namespace

PlaceKey key_of_place(const glm::dvec3& place) {
  PlaceKey out;
  for (int i = 0; i < 3; ++i) out[static_cast<size_t>(i)] = std::llround(place[i] / one_point_m);
  return out;
}

Terms terms_of(const std::vector<double>& values, double smallest) {
  auto out = std::make_shared<std::vector<Term>>();
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i] > smallest)
      out->push_back({static_cast<uint32_t>(i), static_cast<float>(values[i])});
  out->shrink_to_fit();
  return out;
}

Terms times(const Terms& terms, const std::vector<double>& factors) {
  auto out = std::make_shared<std::vector<Term>>();
  for (const Term& term : *terms) {
    const double value = static_cast<double>(term.value) * factors[term.option];
    if (value > no_light_lx) out->push_back({term.option, static_cast<float>(value)});
  }
  return out;
}

double max_from(const std::vector<Term>& light, const std::vector<LayoutOption>& options) {
  double sum = 0, best = 0;
  uint32_t place = no_place;
  for (const Term& term : light) {
    if (options[term.option].barred) continue;
    if (options[term.option].place != place) {
      sum += best;
      best = 0;
      place = options[term.option].place;
    }
    best = std::max(best, static_cast<double>(term.value));
  }
  return sum + best;
}

bool Demands::ask_for_more(const Check& check, const Layout& layout) {
  const auto is_it = [&](const auto& rows) {
    const ConstraintGroup& group = problem_.groups[rows.group];
    return group.rule == check.rule.id && group.subject == check.subject;
  };
  if (!check.value || !check.limit || std::isinf(*check.value)) return false;
  bool any = false;
  if (!check.at_least) {
    // Largest over smallest: the required ratio is reduced by the factor by which the value exceeds
    // its limit.
    for (SpreadRows& rows : problem_.spreads)
      if (is_it(rows)) {
        rows.ratio *= *check.limit / *check.value * (1 - 1e-3);
        any = true;
      }
    return any;
  }
  if (!check.worst || !(*check.limit > 0)) return false;
  return raise_nearest(problem_, is_it, *check.worst, *check.limit - *check.value, layout);
}

bool Demands::ask_for_more(DemandKind kind, RuleId rule, const Subject& subject,
                           const glm::dvec3& place, double missing, const Layout& layout) {
  const auto is_it = [&](const auto& rows) {
    const ConstraintGroup& group = problem_.groups[rows.group];
    return group.kind == kind && group.rule == rule && group.subject == subject;
  };
  if (kind != DemandKind::failed) return raise_nearest(problem_, is_it, place, missing, layout);
  bool any = false;
  for (FailureRows& rows : problem_.failures)
    if (is_it(rows)) {
      rows.least += missing * (1 + 1e-3);
      any = true;
    }
  return any;
}

BetweenPoints Demands::look_between(const Layout& layout, const Demands* all) {
  std::vector<std::vector<std::pair<double, glm::dvec3>>> of_group(problem_.groups.size());
  for (const CoverRow& row : problem_.covers) {
    const DemandKind kind = problem_.groups[row.group].kind;
    if (kind != DemandKind::minimum && kind != DemandKind::early) continue;
    of_group[row.group].emplace_back(sum_over(*row.terms, layout) / row.least, row.place);
  }
  BetweenPoints out;
  for (uint32_t group = 0; group < of_group.size(); ++group) {
    if (of_group[group].empty()) continue;
    const auto places = between_darkest(std::move(of_group[group]));
    if (!places.empty()) look_at(group, places, layout, all == nullptr ? *this : *all, out);
  }
  return out;
}

double Demands::max_at(const glm::dvec3& place, bool furnished) const {
  const Lit& in = furnished && furnished_ ? *furnished_ : *bare_;
  const auto lux = in.light.lit({place}, floor_normal, lifted_already).front().lux;
  return max_from(*terms_of(lux, no_light_lx), problem_.options);
}

void Demands::look_at(uint32_t group, const std::vector<glm::dvec3>& places, const Layout& layout,
                      const Demands& all, BetweenPoints& out) {
  const double asked = problem_.groups[group].asked;
  const auto factors = factors_.find(group);
  const auto lit = [&](const Lit& in, const std::vector<glm::dvec3>& at) {
    std::vector<Terms> light;
    for (const LitPoint& p : in.light.lit(at, floor_normal, lifted_already)) {
      Terms terms = terms_of(p.lux, no_light_lx);
      light.push_back(factors == factors_.end() ? terms : times(terms, factors->second));
    }
    return light;
  };
  // As at points of the grid: a point that furniture hides from all candidates is taken without
  // furniture.
  const ConstraintGroup& of = problem_.groups[group];
  const bool past_furniture = furnished_ && !hidden_.contains({name_of(of.rule), of.subject});
  std::vector<Terms> light = lit(past_furniture ? *furnished_ : *bare_, places);
  for (size_t i = 0; i < places.size(); ++i) {
    const auto reached = [&](bool furnished) {
      return max_from(*light[i], problem_.options) >= asked ||
             (&all != this && all.max_at(places[i], furnished) >= asked);
    };
    const bool past = past_furniture && reached(true);
    if (past_furniture && !past) light[i] = lit(*bare_, {places[i]}).front();
    if (!past && !reached(false)) continue;  // in a body
    const double share = sum_over(*light[i], layout) / asked;
    out.least = std::min(out.least, share);
    if (share >= 1 - between_tolerance) continue;
    problem_.points.push_back({light[i], places[i]});
    problem_.covers.push_back({group, light[i], asked, places[i]});
    ++out.added;
  }
}

}  // namespace luxodus

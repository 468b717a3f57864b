// Furniture only takes light away. So minima are required with furniture, and without it only at
// points that lie in furniture; ratios of illuminance are required both ways. If furniture hides a
// point from all candidates, no layout passes with furniture, and the rule is required without
// furniture only.
#include "actors/judge/design/demands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "actors/judge/assess/storey_floor.hpp"
#include "actors/judge/design/demands_lit.hpp"
#include "actors/judge/design/stair_flights.hpp"
#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/signs/onset.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

/// Luminaires over each route and open area.
constexpr double so_many = 2;
bool all_one(const std::vector<double>& factors) {
  return std::all_of(factors.begin(), factors.end(), [](double f) { return f >= 1; });
}

/// An index for each candidate, equal for types and rotations that hang at the same position, since
/// what hides one of them hides all. Candidates of one place of the problem may differ in position.
std::vector<uint32_t> hanging_places(const std::vector<LuminaireCandidate>& candidates) {
  std::vector<uint32_t> out;
  uint32_t number = 0;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0 && (candidates[i].place != candidates[i - 1].place ||
                  candidates[i].position != candidates[i - 1].position))
      ++number;
    out.push_back(number);
  }
  return out;
}

}  // namespace

Demands::Demands() = default;
Demands::~Demands() = default;

class Demands::Builder {
 public:
  Builder(Demands& out, const DesignSettings& design,
          const std::vector<LuminaireCandidate>& candidates, const std::vector<CodeChoice>& codes)
      : out_(out),
        problem_(out.problem_),
        scene_(out.scene_),
        design_(design),
        candidates_(candidates),
        codes_(codes) {}

  void build() {
    add_options();
    std::vector<glm::dvec3> positions;
    for (const LuminaireCandidate& one : candidates_) positions.push_back(one.position);
    floors_ = storey_floors(scene_, *out_.bare_->building, positions);
    find_regions();
    for (const EscapeRoute& route : scene_.routes) add_route(route);
    for (const AssessedArea& area : scene_.open_areas) add_open_area(area);
    for (const AssessedArea& area : scene_.task_areas) add_task_area(area);
    for (const EmphasisPoint& point : emphasis_of(scene_)) add_emphasis(point);
    for (const EscapeRoute& route : scene_.routes)
      for (const FlightOfRoute& flight : out_.bare_->light.flights_of(route))
        add_stair_flight(flight.name, flight.treads);
    for (const StairFlight& stairs : flights_beside_routes(scene_, design_))
      add_stair_flight(stairs.name, treads_of(stairs));
    for (const Sign& sign : scene_.signs) add_sign(sign);
  }

 private:
  using Points = std::vector<uint32_t>;

  /// Points of a subject without furniture and, if there is any, with it.
  struct Both {
    Points bare, furnished;
    Points with_both;  // points with furniture, and points without it that lie in furniture
  };

  void add_options() {
    const double of_move = weight_of_move();
    for (const LuminaireCandidate& one : candidates_) {
      LayoutOption option;
      option.place = one.place;
      option.fixed = one.fixed;
      option.position = one.position;
      option.weight = one.fixed ? 0 : weight_of(one, of_move);
      option.barred = one.barred;
      if (one.type != LuminaireCandidate::existing) option.kind = static_cast<uint32_t>(one.type);
      if (one.pool) {
        option.pool = one.pool->number;
        problem_.pools.resize(std::max<size_t>(problem_.pools.size(), option.pool + 1), 0);
        problem_.pools[option.pool] = one.pool->size;
      }
      problem_.options.push_back(option);
    }
  }

  /// Assigns routes and areas that share candidates to one region, such as a corridor with its side
  /// corridors.
  void find_regions() {
    const auto join = [&](const Subject& subject, const std::vector<size_t>& above) {
      const auto fresh = static_cast<uint32_t>(regions_.size());
      regions_[subject] = fresh;
      std::set<uint32_t> met;
      for (const size_t i : above) {
        uint32_t& region = problem_.options[i].region;
        if (region != no_region) met.insert(region);
        region = fresh;
      }
      for (LayoutOption& option : problem_.options)
        if (met.contains(option.region)) option.region = fresh;
      for (auto& [other, region] : regions_)
        if (met.contains(region)) region = fresh;
    };
    for (const EscapeRoute& route : scene_.routes)
      join(subject_of(route), over(route, route.path.front().z));
    for (const AssessedArea& area : scene_.open_areas)
      join({SubjectKind::open_area, area.name}, over(area, area.z_m));
    for (const AssessedArea& area : scene_.task_areas)
      join({SubjectKind::task_area, area.name}, over(area, area.z_m));
  }

  /// Existing luminaires are already paid for, and a luminaire that stays in any case has no
  /// weight.
  double weight_of(const LuminaireCandidate& one, double of_move) const {
    if (one.moved) return of_move;
    if (one.pool) return 0;
    const bool there = one.type == LuminaireCandidate::existing;
    return there ? design_.weight_of(0, 0)
                 : design_.weight_of(design_.types[one.type].cost, design_.types[one.type].watts);
  }

  /// By default a share of the smallest weight of a luminaire that may be placed.
  double weight_of_move() const {
    if (design_.move_cost) return *design_.move_cost;
    double least = 0;
    for (const LuminaireCandidate& one : candidates_) {
      if (one.type == LuminaireCandidate::existing) continue;
      const DesignType& type = design_.types[one.type];
      const double weight = design_.weight_of(type.cost, type.watts);
      if (weight > 0 && (least == 0 || weight < least)) least = weight;
    }
    // If new luminaires weigh nothing, a move still has a weight, so that none is moved without
    // need.
    return default_move_share * (least > 0 ? least : 1);
  }

  /// For each candidate, the share of its light that is left, or that is on.
  std::vector<double> factors(const std::function<double(const Emitter&)>& of) const {
    std::vector<double> out;
    for (const Emitter& e : scene_.emitters) out.push_back(of(e));
    return out;
  }
  std::vector<double> as_new() const {
    return factors([](const Emitter& e) { return 1 / e.emergency_ageing; });
  }
  /// Luminaires without a stated onset count as fully on here, since their check is not made.
  std::vector<double> after(double seconds) const {
    return factors([seconds](const Emitter& e) {
      return e.onset.empty() ? 1 : onset_share(e.onset, seconds);
    });
  }

  /// Computes points that several rules use only once.
  Points light_at(Lit& lit, const std::vector<glm::dvec3>& places) {
    std::vector<glm::dvec3> fresh;
    Points out;
    for (const glm::dvec3& place : places) {
      const auto next = static_cast<uint32_t>(problem_.points.size() + fresh.size());
      const auto [at, is_new] = lit.points.try_emplace(key_of_place(place), next);
      if (is_new) fresh.push_back(place);
      out.push_back(at->second);
    }
    for (const LitPoint& p : lit.light.lit(fresh, floor_normal, floor_plane_m))
      problem_.points.push_back({terms_of(p.lux, no_light_lx), p.place});
    return out;
  }

  Both both_at(const std::vector<glm::dvec3>& bare, const std::vector<glm::dvec3>& furnished) {
    Both out;
    out.bare = light_at(*out_.bare_, bare);
    if (!out_.furnished_) return out;
    out.furnished = light_at(*out_.furnished_, furnished);
    out.with_both = out.furnished;
    std::set<PlaceKey> seen;
    for (const uint32_t p : out.furnished) seen.insert(key_of_place(problem_.points[p].place));
    for (const uint32_t p : out.bare)
      if (!seen.contains(key_of_place(problem_.points[p].place))) out.with_both.push_back(p);
    return out;
  }
  /// The points at which an illuminance is required: those with furniture, unless some of them get
  /// less from all candidates together. Then no layout passes with furniture, and the points
  /// without it are used.
  const Points& reachable(RuleId rule, const Subject& subject, const Both& both, double asked_lx) {
    if (both.furnished.empty()) return both.bare;
    const auto hidden =
        std::count_if(both.furnished.begin(), both.furnished.end(), [&](uint32_t p) {
          return max_from(*problem_.points[p].light, problem_.options) < asked_lx;
        });
    if (hidden == 0) return both.with_both;
    out_.hidden_[{name_of(rule), subject}] = static_cast<size_t>(hidden);
    return both.bare;
  }

  Both both_of(const AssessedArea& area, double border_m) {
    const auto bare = out_.bare_->light.points_of(area, border_m).places;
    return both_at(
        bare, out_.furnished_ ? out_.furnished_->light.points_of(area, border_m).places : bare);
  }

  uint32_t add_group(DemandKind kind, RuleId rule, const Subject& subject, double asked) {
    const auto region = regions_.find(subject);
    problem_.groups.push_back(
        {kind, rule, subject, asked, region == regions_.end() ? no_region : region->second});
    return static_cast<uint32_t>(problem_.groups.size() - 1);
  }

  void add_cover(uint32_t group, Terms terms, double least, const glm::dvec3& place) {
    problem_.covers.push_back({group, std::move(terms), least, place});
  }

  void add_minima(DemandKind kind, RuleId rule, const Subject& subject, const Both& both,
                  double limit_lx, const std::vector<double>& factors = {}) {
    if (both.bare.empty()) return;
    const double asked = limit_lx * design_.margin;
    const uint32_t group = add_group(kind, rule, subject, asked);
    if (!factors.empty()) out_.factors_[group] = factors;
    for (const uint32_t p : reachable(rule, subject, both, asked)) {
      const ReceiverPoint& point = problem_.points[p];
      add_cover(group, factors.empty() ? point.light : times(point.light, factors), asked,
                point.place);
    }
  }

  /// The mean is required with furniture, which only takes light away.
  void add_mean(RuleId rule, const Subject& subject, const Both& both, double limit_lx,
                const std::vector<double>& factors = {}) {
    const Points& points = both.furnished.empty() ? both.bare : both.furnished;
    if (points.empty()) return;
    std::vector<double> mean(candidates_.size(), 0);
    for (const uint32_t p : points)
      for (const Term& term : *problem_.points[p].light)
        mean[term.option] += static_cast<double>(term.value) / static_cast<double>(points.size()) *
                             (factors.empty() ? 1 : factors[term.option]);
    const double asked = limit_lx * design_.margin;
    add_cover(add_group(DemandKind::mean, rule, subject, asked), terms_of(mean, no_light_lx), asked,
              problem_.points[points.front()].place);
  }

  /// Required illuminance `seconds` after the failure of the mains. No rows if all luminaires are
  /// fully on by then, since the minima require as much.
  void add_early(RuleId rule, const Subject& subject, const Both& both, double seconds,
                 double limit_lx) {
    const auto shares = after(seconds);
    if (all_one(shares)) {
      // Only counts the points that furniture hides.
      reachable(rule, subject, both, limit_lx * design_.margin);
      return;
    }
    add_minima(DemandKind::early, rule, subject, both, limit_lx, shares);
  }

  /// The brightest places are also searched straight below luminaires, since a peak may lie between
  /// points of the grid. `limit_lx`: required at every point in any case.
  void add_spread(RuleId rule, const Subject& subject, const Both& both,
                  const std::vector<glm::dvec3>& peaks, double ratio, double limit_lx) {
    if (both.bare.empty()) return;
    const uint32_t group = add_group(DemandKind::spread, rule, subject, ratio);
    const Points below = light_at(*out_.bare_, peaks);
    const auto add = [&](const Points& points) {
      SpreadRows rows{group, ratio, points, points};
      rows.high.insert(rows.high.end(), below.begin(), below.end());
      problem_.spreads.push_back(std::move(rows));
    };
    add(both.bare);
    const bool all = &reachable(rule, subject, both, limit_lx * design_.margin) == &both.with_both;
    if (all && !both.furnished.empty()) add(both.furnished);
  }

  void add_failures(RuleId rule, const Subject& subject, const Points& points, double min_lx) {
    if (points.empty()) return;
    const uint32_t group = add_group(DemandKind::failed, rule, subject, min_lx);
    problem_.failures.push_back({group, min_lx, points});
  }

  /// Indices of the candidates over a route or an area.
  template <class Subject>
  std::vector<size_t> over(const Subject& subject, double floor_z) const {
    std::vector<size_t> out;
    for (size_t i = 0; i < candidates_.size(); ++i)
      if (floors_[i] && std::abs(*floors_[i] - floor_z) < storey_m &&
          in_plan_of(subject, glm::dvec2(candidates_[i].floor)))
        out.push_back(i);
    return out;
  }

  /// Demands with any one luminaire failed. `limit_lx`: of the rules at the same points.
  void add_single_failures(const Subject& subject, const std::vector<size_t>& above,
                           const Both& both, double limit_lx) {
    if (design_.failure == FailureDemand::none || both.bare.empty()) return;
    const Points& points = reachable(RuleId::none, subject, both, limit_lx * design_.margin);
    if (design_.failure == FailureDemand::full)
      return add_failures(RuleId::none, subject, points, limit_lx);
    std::vector<double> count(candidates_.size(), 0);
    for (const size_t i : above) count[i] = 1;
    add_cover(add_group(DemandKind::two, RuleId::none, subject, so_many), terms_of(count, 0),
              so_many, problem_.points[points.front()].place);
    add_failures(RuleId::none, subject, points, never_dark_lx);
  }

  /// Brightest points of a route's centre line: those nearest to each luminaire over it.
  static std::vector<glm::dvec3> peaks_of(const EscapeRoute& route,
                                          const std::vector<glm::dvec3>& lamps) {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& lamp : lamps) {
      glm::dvec3 nearest = route.path.front();
      for (size_t i = 1; i < route.path.size(); ++i) {
        const glm::dvec3 a = route.path[i - 1], way = route.path[i] - a;
        const double t = std::clamp(glm::dot(glm::dvec2(lamp - a), glm::dvec2(way)) /
                                        glm::dot(glm::dvec2(way), glm::dvec2(way)),
                                    0.0, 1.0);
        const glm::dvec3 at = a + way * t;
        if (glm::length(glm::dvec2(at - lamp)) < glm::length(glm::dvec2(nearest - lamp)))
          nearest = at;
      }
      out.push_back(nearest);
    }
    return out;
  }

  std::vector<glm::dvec3> places_of(const std::vector<size_t>& above) const {
    std::vector<glm::dvec3> out;
    std::set<uint32_t> seen;
    for (const size_t i : above)
      if (seen.insert(candidates_[i].place).second) out.push_back(candidates_[i].position);
    return out;
  }

  void add_route(const EscapeRoute& route) {
    const Subject subject = subject_of(route);
    const RoutePoints bare = out_.bare_->light.points_of(route);
    const RoutePoints furnished = out_.furnished_ ? out_.furnished_->light.points_of(route) : bare;
    const auto both_of = [&](CalculationGrid RoutePoints::*part) {
      return both_at((bare.*part).places, (furnished.*part).places);
    };
    const Both centre = both_of(&RoutePoints::centre);
    const auto above = over(route, route.path.front().z);
    const auto peaks = peaks_of(route, places_of(above));
    Both walked = centre;
    double walked_lx = limit_of(RuleId::E1);
    for (const CodeChoice& codes : codes_) {
      switch (codes.set) {
        case RuleSet::en1838_2013:
          add_minima(DemandKind::minimum, RuleId::E1, subject, centre, limit_of(RuleId::E1));
          add_minima(DemandKind::minimum, RuleId::E2, subject, both_of(&RoutePoints::band),
                     limit_of(RuleId::E2));
          break;
        case RuleSet::en1838_2024:
          walked = both_of(&RoutePoints::inner);
          add_minima(DemandKind::minimum, RuleId::E5, subject, walked, limit_of(RuleId::E1));
          break;
        case RuleSet::nfpa101:
          walked_lx = codes_.size() > 1 ? limit_of(RuleId::E1) : limit_of(RuleId::N2m);
          add_american(subject, centre, peaks, codes);
          break;
      }
      if (codes.european())
        add_spread(RuleId::E4, subject, centre, peaks, limit_of(RuleId::E4), limit_of(RuleId::E1));
      add_onset(subject, centre, limit_of(RuleId::E1), codes);
    }
    add_single_failures(subject, above, walked, walked_lx);
  }

  void add_american(const Subject& subject, const Both& centre,
                    const std::vector<glm::dvec3>& peaks, const CodeChoice& codes) {
    const bool ibc = codes.has(Deviation::us_ibc);
    const auto fresh = as_new();
    add_mean(ibc ? RuleId::I1 : RuleId::N1, subject, centre,
             limit_of(ibc ? RuleId::I1 : RuleId::N1), fresh);
    add_minima(DemandKind::minimum, ibc ? RuleId::I1m : RuleId::N1m, subject, centre,
               limit_of(ibc ? RuleId::I1m : RuleId::N1m), fresh);
    add_mean(ibc ? RuleId::I2 : RuleId::N2, subject, centre,
             limit_of(ibc ? RuleId::I2 : RuleId::N2));
    add_minima(DemandKind::minimum, ibc ? RuleId::I2m : RuleId::N2m, subject, centre,
               limit_of(ibc ? RuleId::I2m : RuleId::N2m));
    add_spread(RuleId::N3, subject, centre, peaks, limit_of(RuleId::N3), limit_of(RuleId::N2m));
    if (codes.has(Deviation::us_ibc_i2))
      add_failures(RuleId::N4, subject,
                   reachable(RuleId::N4, subject, centre, limit_of(RuleId::N4) * design_.margin),
                   limit_of(RuleId::N4) * design_.margin);
  }

  void add_onset(const Subject& subject, const Both& points, double limit_lx,
                 const CodeChoice& codes) {
    if (codes.european()) {
      add_early(RuleId::E10h, subject, points, half_s, limit_lx / 2);
      add_early(RuleId::E10f, subject, points, full_s, limit_lx);
    } else {
      add_early(RuleId::N5, subject, points, nfpa_s, limit_of(RuleId::N5));
    }
    if (codes.has(Deviation::de_asr)) add_early(RuleId::E10g, subject, points, german_s, limit_lx);
  }

  void add_open_area(const AssessedArea& area) {
    const Subject subject{SubjectKind::open_area, area.name};
    const Both core = both_of(area, open_border_m);
    const auto above = over(area, area.z_m);
    auto peaks = places_of(above);
    for (glm::dvec3& p : peaks) p.z = area.z_m;
    bool judged = false;
    double limit_lx = limit_of(RuleId::E6);
    for (const CodeChoice& codes : codes_) {
      if (!codes.european()) continue;
      judged = true;
      add_minima(DemandKind::minimum, RuleId::E6, subject, core, limit_of(RuleId::E6));
      add_spread(RuleId::E6d, subject, core, peaks, limit_of(RuleId::E6d), limit_of(RuleId::E6));
      if (codes.has(Deviation::uk_bs_5266)) {
        add_minima(DemandKind::minimum, RuleId::E6k, subject, core, limit_of(RuleId::E6k));
        limit_lx = limit_of(RuleId::E6k);
      }
      add_onset(subject, core, limit_of(RuleId::E6), codes);
    }
    if (judged) add_single_failures(subject, above, core, limit_lx);
  }

  void add_task_area(const AssessedArea& area) {
    const Subject subject{SubjectKind::task_area, area.name};
    const Both plane = both_of(area, 0);
    auto peaks = places_of(over(area, area.z_m));
    for (glm::dvec3& p : peaks) p.z = area.z_m;
    const double limit_lx = std::max(limit_of(RuleId::E7), task_share * area.mains_lx);
    for (const CodeChoice& codes : codes_) {
      if (!codes.european()) continue;
      add_minima(DemandKind::minimum, RuleId::E7, subject, plane, limit_lx);
      add_spread(RuleId::E7u, subject, plane, peaks, 1 / limit_of(RuleId::E7u), limit_lx);
      add_early(RuleId::E10t, subject, plane, task_s, limit_lx);
    }
  }

  /// A luminaire near a place, as in luminaire_near.
  void add_near(RuleId rule, const Subject& subject, const glm::dvec3& place, bool above,
                const LinesOfSight& seen, const std::optional<double>& floor) {
    std::vector<double> near(candidates_.size(), 0);
    for (size_t i = 0; i < candidates_.size(); ++i) {
      const glm::dvec3& p = candidates_[i].position;
      const bool here = !floor || !floors_[i] || std::abs(*floor - *floors_[i]) < storey_m;
      if (here && seen[i] && (!above || p.z >= place.z) &&
          glm::length(glm::dvec2(p - place)) <= limit_of(rule))
        near[i] = 1;
    }
    add_cover(add_group(DemandKind::near, rule, subject, limit_of(rule)), terms_of(near, 0), 1,
              place);
  }

  void add_emphasis(const EmphasisPoint& point) {
    if (std::none_of(codes_.begin(), codes_.end(),
                     [](const CodeChoice& codes) { return codes.european(); }))
      return;
    const Subject subject = subject_of(point);
    LinesOfSight seen = out_.bare_->light.seen_from(beside(point));
    if (out_.furnished_) {
      const LinesOfSight past = out_.furnished_->light.seen_from(beside(point));
      for (size_t i = 0; i < seen.size(); ++i) seen[i] = seen[i] && past[i];
    }
    add_near(RuleId::E12, subject, point.position, true, seen,
             storey_floor_around(scene_, *out_.bare_->building, point.position, beside(point)));
    constexpr std::array equipment{EmphasisKind::first_aid, EmphasisKind::fire_equipment,
                                   EmphasisKind::call_point, EmphasisKind::alarm_panel};
    if (std::find(equipment.begin(), equipment.end(), point.kind) == equipment.end()) return;
    const Lit& darker = out_.furnished_ ? *out_.furnished_ : *out_.bare_;
    const auto lux = darker.light.vertical_lux(point);
    if (!lux) return;
    const double asked = limit_of(RuleId::E13) * design_.margin;
    add_cover(add_group(DemandKind::vertical, RuleId::E13, subject, asked),
              terms_of(*lux, no_light_lx), asked, point.position);
  }

  /// One luminaire lights the whole flight if any can; else each tread needs a luminaire that
  /// lights it. A flight that no candidate lights is outside the designed part of the building.
  /// Barred candidates do not count.
  void add_stair_flight(const std::string& name, const std::vector<glm::dvec3>& places) {
    if (std::none_of(codes_.begin(), codes_.end(), [](const auto& one) { return one.european(); }))
      return;
    const Lit& darker = out_.furnished_ ? *out_.furnished_ : *out_.bare_;
    const double lit_tread_lx = limit_of(RuleId::E12s);
    const auto treads = darker.light.lit(places, floor_normal, floor_plane_m);
    const auto is_lit = [&](const LitPoint& tread, size_t by) {
      return !candidates_[by].barred && tread.lux[by] >= lit_tread_lx;
    };
    const bool dark = std::any_of(treads.begin(), treads.end(), [&](const LitPoint& tread) {
      for (size_t i = 0; i < candidates_.size(); ++i)
        if (is_lit(tread, i)) return false;
      return true;
    });
    if (dark) return out_.unlit_stair_flights_.push_back(name);
    const uint32_t group =
        add_group(DemandKind::stairs, RuleId::E12s, {SubjectKind::stairs, name}, lit_tread_lx);
    std::vector<double> all(candidates_.size(), 1);
    for (const LitPoint& tread : treads)
      for (size_t i = 0; i < all.size(); ++i)
        if (!is_lit(tread, i)) all[i] = 0;
    const Terms whole = terms_of(all, 0);
    if (!whole->empty()) return add_cover(group, whole, 1, treads[treads.size() / 2].place);
    for (const LitPoint& tread : treads) {
      std::vector<double> one(candidates_.size(), 0);
      for (size_t i = 0; i < one.size(); ++i) one[i] = is_lit(tread, i) ? 1 : 0;
      add_cover(group, terms_of(one, 0), 1, tread.place);
    }
  }

  void add_sign(const Sign& sign) {
    if (sign.lighting != SignLighting::external) return;
    const Subject subject = subject_of(sign);
    for (const CodeChoice& codes : codes_) {
      if (codes.european()) {
        const std::vector<glm::dvec3> front{before_face(sign)};
        add_near(RuleId::S6l, subject, sign.frame.origin, false, out_.bare_->light.seen_from(front),
                 storey_floors(scene_, *out_.bare_->building, front).front());
      } else {
        const double asked = limit_of(RuleId::N6) * design_.margin;
        add_cover(add_group(DemandKind::face, RuleId::N6, subject, asked),
                  terms_of(out_.bare_->light.lux_on_face(sign), no_light_lx), asked,
                  sign.frame.origin);
      }
    }
  }

  Demands& out_;
  LayoutProblem& problem_;
  const SceneDescription& scene_;
  const DesignSettings& design_;
  const std::vector<LuminaireCandidate>& candidates_;
  const std::vector<CodeChoice>& codes_;
  std::vector<std::optional<double>> floors_;  // below each candidate
  std::map<Subject, uint32_t> regions_;
};

Result<std::unique_ptr<Demands>> Demands::make(const SceneDescription& scene,
                                               const DesignSettings& design,
                                               const std::vector<LuminaireCandidate>& candidates,
                                               const std::vector<CodeChoice>& codes,
                                               const Scenario& doors, int threads) {
  std::unique_ptr<Demands> out(new Demands);
  out->scene_ = scene_of(scene, design, candidates);
  const std::vector<uint32_t> places = hanging_places(candidates);
  const bool has_furniture = std::any_of(scene.objects.begin(), scene.objects.end(), is_furniture);
  for (const bool furnished : {false, true}) {
    if (furnished && !has_furniture) break;
    auto building = Building::make(code_scene(out->scene_, furnished),
                                   code_scenario(out->scene_, doors), threads);
    if (!building) return building.problem();
    (furnished ? out->furnished_ : out->bare_) =
        std::make_unique<Lit>(out->scene_, std::move(building).value(), places);
  }
  Builder(*out, design, candidates, codes).build();
  return out;
}

bool Demands::is_hidden(const Check& check) const {
  if (check.rule.id == RuleId::E12s &&
      std::find(unlit_stair_flights_.begin(), unlit_stair_flights_.end(), check.subject.name) !=
          unlit_stair_flights_.end())
    return true;
  return std::count(check.conditions.begin(), check.conditions.end(),
                    remark(RemarkId::with_furniture)) > 0 &&
         hidden_.contains({name_of(check.rule.id), check.subject});
}

}  // namespace luxodus

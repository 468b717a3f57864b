// A sign of a type at a place has one arrow for each route that it serves: the one closest to the
// direction of the route behind the point where the sign is passed. Routes with equal arrows share
// the sign. Which sign guides at which place is a matrix of ones, and the plan is the set of
// columns of least weight that covers all rows. Signs of a plan may hide each other. So the plan is
// tested with all its signs in the building, and the row of a place that lost its guidance requires
// one more sign. Places that no plan guides are reported.
#include "actors/judge/design/sign_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "actors/judge/assess/clear_signs.hpp"
#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/design/candidates.hpp"
#include "actors/judge/inspect/site.hpp"
#include "runtime/core/clock.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/emergency/rule_table.hpp"

namespace luxodus {

namespace {

constexpr std::array all_arrows{SignArrow::left, SignArrow::right, SignArrow::ahead};
/// Among plans of equal weight, signs over doors are preferred: signs beside doors weigh more by
/// this share, and signs under ceilings by twice this share.
constexpr double share_of_mount = 1e-3;
/// Places closer than this hold only one sign [m].
constexpr double one_place_of_signs_m = 0.3;
/// Largest number of plans that are made because signs hide each other.
constexpr int max_plans = 6;
/// A sign found along another route also serves a route whose edge is within this distance [m].
constexpr double near_way_m = 3;
/// Length of route, behind the point where a sign is passed, that decides its arrow [m].
constexpr double way_behind_m = 1;

/// Smallest time for a search [s]; no other time may be left.
constexpr double min_seconds = 1;

/// A place on a route that needs guidance.
struct Asked {
  size_t route = 0;
  Walker walker;
  glm::dvec3 eye{0};
  bool bare = false;  // furniture hides all signs from it, so it is guided without furniture
};

/// A sign at a place before its arrow is chosen, or a sign of the scene.
struct Hung {
  size_t type = PlacedSign::existing;
  SignSpot spot;
  Sign sign;
  /// Indices of places from which it is visible and near enough, with the guiding arrows as bits;
  /// for a sign of the scene any bit means that it guides.
  std::vector<std::pair<uint32_t, uint8_t>> furnished, bare;
};

/// A column of the integer program.
struct SignOption {
  size_t hung = 0;
  std::vector<LeadsTo> leads_to;
  std::vector<uint32_t> furnished, bare;  // indices of the places that it guides
};

uint8_t bit_of(SignArrow arrow) {
  return static_cast<uint8_t>(1U << static_cast<unsigned>(arrow));
}

/// Whether a check on the sign itself fails; light on externally lit signs is planned later.
bool forbids_sign(const Check& check, const Sign& sign) {
  if (check.verdict != CheckVerdict::fail) return false;
  const DecidedBy by = row_of(check.rule.id).decided_by;
  return by == DecidedBy::sign ||
         (by == DecidedBy::lit_sign && sign.lighting == SignLighting::internal);
}

std::string sign_prefix(const SceneDescription& scene) {
  for (const char* prefix : {"S", "Sign ", "design sign "}) {
    const bool taken = std::any_of(scene.signs.begin(), scene.signs.end(), [&](const Sign& sign) {
      return sign.name.starts_with(prefix) &&
             sign.name.find_first_not_of("0123456789", std::string_view(prefix).size()) ==
                 std::string::npos;
    });
    if (!taken) return prefix;
  }
  return "designed sign ";
}

class SignPlanner {
 public:
  SignPlanner(const SceneDescription& scene, const DesignSettings& design,
              const SignPlanOptions& options, const std::atomic<bool>& interrupt,
              const SolveProgress& progress)
      : scene_(scene),
        design_(design),
        options_(options),
        interrupt_(interrupt),
        progress_(progress) {}

  Result<SignPlan> run() {
    take_out_removed();
    // A scene compiles only with light, so a scene without any gets that of a type.
    if (scene_.emitters.empty()) scene_.emitters.push_back(some_light(design_));
    has_furniture_ = std::any_of(scene_.objects.begin(), scene_.objects.end(), is_furniture);
    if (auto ok = build(false, bare_); !ok) return ok.problem();
    if (has_furniture_)
      if (auto ok = build(true, furnished_); !ok) return ok.problem();
    find_places();
    if (auto ok = hang_all(); !ok) return ok.problem();
    leave_out_forbidden_signs();
    look();
    make_options();
    make_rows();
    if (auto ok = plan(); !ok) return ok.problem();
    return std::move(out_);
  }

 private:
  /// Makes plans until their signs do not hide each other. Places that no plan guides are reported.
  Result<void> plan() {
    std::vector<size_t> lost;
    for (int plans = 1;; ++plans) {
      const LayoutAnswer answer = solve(problem_, time_left());
      if (is_none(answer)) {
        if (plans == 1) return no_plan(answer.end);
        for (const size_t place : lost) give_up(place);  // keep the plan before
        break;
      }
      if (plans == 1) bound_ = answer.bound;
      take(answer);
      auto found = lost_places(rows_of_);
      if (!found) return found.problem();
      lost = std::move(found).value();
      if (lost.empty()) break;
      const bool last = plans == max_plans || interrupt_ || !(time_left() > 0);
      std::erase_if(lost, [&](size_t place) {
        if (!last && (ask_for_another(place) || leave_out_hiding(place))) return false;
        give_up(place);
        return true;
      });
      if (last) break;
    }
    tell_bound();
    return tell_given_up();
  }

  double time_left() const {
    return options_.seconds - 1e-9 * static_cast<double>(clock_.now() - began_);
  }

  const Building& furnished() const { return furnished_ ? *furnished_ : *bare_; }

  void take_out_removed() {
    if (design_.existing_signs != ExistingTreatment::removed) return;
    for (const Sign& sign : scene_.signs) out_.removed.push_back(sign.name);
    scene_.signs.clear();
  }

  Result<void> build(bool with_furniture, std::unique_ptr<Building>& to) const {
    auto made = Building::make(code_scene(scene_, with_furniture),
                               code_scenario(scene_, options_.doors), options_.threads);
    if (!made) return made.problem();
    to = std::move(made).value();
    return {};
  }

  void find_places() {
    for (size_t r = 0; r < scene_.routes.size(); ++r)
      for (const Walker& walker : walkers(scene_.routes[r], scene_.assessment.spacing_m))
        asked_.push_back({r, walker, walker.foot + glm::dvec3(0, 0, standing_eye_m), false});
  }

  Result<void> hang_all() {
    progress_("finding places for signs", 0, 0);
    for (const Sign& sign : scene_.signs) {
      Hung one;
      one.sign = sign;
      one.spot = {sign.frame.origin, sign.frame.axes[2], SignMount::above, {}};
      hung_.push_back(std::move(one));
    }
    for (size_t t = 0; t < design_.sign_types.size(); ++t) {
      const Sign& type = design_.sign_types[t].sign;
      const auto spots = sign_spots(scene_, design_, type, *bare_, furnished(), out_.left_out);
      for (const SignSpot& spot : spots) {
        Hung one;
        one.type = t;
        one.spot = spot;
        one.sign = sign_at(type, spot);
        one.sign.name = "new";
        hung_.push_back(std::move(one));
      }
    }
    if (hung_.size() > limits::sign_candidates)
      return problem_in(design_.place,
                        fmt::format("there are {} signs of all types at all places, and at most {} "
                                    "are taken: make 'sign_spacing_m' larger",
                                    hung_.size(), limits::sign_candidates));
    return {};
  }

  void leave_out_forbidden_signs() {
    const CodeLight light(scene_, *bare_);
    const FloorUnder floor = [&](const glm::dvec3& p) { return light.floor_under(p); };
    std::erase_if(hung_, [&](const Hung& one) {
      if (one.type == PlacedSign::existing) return false;
      for (const CodeChoice& codes : options_.codes)
        for (const Check& check : checks_of_sign(scene_, one.sign, 0, {}, codes, floor))
          if (forbids_sign(check, one.sign)) {
            ++out_.left_out.forbidden;
            return true;
          }
      return false;
    });
  }

  bool near_enough(const Sign& sign, const SignView& view) const {
    return std::all_of(options_.codes.begin(), options_.codes.end(), [&](const CodeChoice& codes) {
      return view.distance_m <= (codes.european() ? viewing_distance(sign, view).allowed_oblique_m
                                                  : limit_of(RuleId::N8));
    });
  }

  /// Whether a sign serves a route: it may be visible from a route that it is not meant for.
  bool belongs_to(const SignSpot& spot, size_t route) const {
    const auto& found_on = spot.of_routes;
    if (std::find(found_on.begin(), found_on.end(), route) != found_on.end()) return true;
    const EscapeRoute& way = scene_.routes[route];
    const glm::dvec3 nearest = place_along(way, passed_at_m(way, spot.position));
    return glm::length(glm::dvec2(nearest - spot.position)) <= way.width_m / 2 + near_way_m;
  }

  /// The arrows that guide at a place from which the sign is visible.
  uint8_t guiding_arrows(const Hung& one, const Asked& place, const SignView& view) const {
    const EscapeRoute& route = scene_.routes[place.route];
    if (one.type == PlacedSign::existing)
      return can_guide(route, place.walker, one.sign, view) ? 1 : 0;
    uint8_t out = 0;
    if (!belongs_to(one.spot, place.route)) return out;
    Sign sign = one.sign;
    for (const SignArrow arrow : all_arrows) {
      const auto& drawn = design_.sign_types[one.type].arrow;
      if (drawn && *drawn != arrow) continue;
      sign.leads_to = {{route.name, arrow}};
      if (can_guide(route, place.walker, sign, view)) out |= bit_of(arrow);
    }
    return out;
  }

  void look() {
    progress_("finding who sees signs there", 0, 0);
    look_in(*bare_, &Hung::bare);
    if (furnished_) look_in(*furnished_, &Hung::furnished);
    if (!furnished_)
      for (Hung& one : hung_) one.furnished = one.bare;
  }

  void look_in(const Building& building, std::vector<std::pair<uint32_t, uint8_t>> Hung::*seen) {
    building.each(hung_.size(), [&](const GeometryAccess& access, size_t h) {
      for (uint32_t p = 0; p < asked_.size(); ++p) {
        const SignView view = view_of_sign(hung_[h].sign, asked_[p].eye);
        if (view.behind || !near_enough(hung_[h].sign, view)) continue;
        const uint8_t arrows = guiding_arrows(hung_[h], asked_[p], view);
        if (arrows != 0 && clear_sign(building, access, hung_[h].sign, 0, view, asked_[p].eye))
          (hung_[h].*seen).emplace_back(p, arrows);
      }
    });
  }

  /// Among the arrows that guide on a route, the one closest to its direction behind the sign.
  std::optional<SignArrow> arrow_for(const Hung& one, size_t route) const {
    uint8_t guiding = 0;
    for (const auto& [place, arrows] : one.bare)
      if (asked_[place].route == route) guiding |= arrows;
    const EscapeRoute& way = scene_.routes[route];
    const double passed = passed_at_m(way, one.spot.position);
    const glm::dvec3 on = place_along(way, passed + way_behind_m) - place_along(way, passed);
    std::optional<SignArrow> best;
    double nearest = -2;
    for (const SignArrow arrow : all_arrows) {
      if ((guiding & bit_of(arrow)) == 0) continue;
      const double along =
          glm::dot(glm::dvec2(arrow_direction(one.sign, arrow, false)), glm::dvec2(on));
      if (!best || along > nearest) best = arrow, nearest = along;
    }
    return best;
  }

  void make_options() {
    for (size_t h = 0; h < hung_.size(); ++h) {
      const Hung& one = hung_[h];
      if (one.type == PlacedSign::existing) {
        SignOption option{h, one.sign.leads_to, {}, {}};
        add_guided(one, option, [](size_t, uint8_t) { return true; });
        sign_options_.push_back(std::move(option));
        continue;
      }
      std::vector<std::optional<SignArrow>> arrows;
      for (size_t r = 0; r < scene_.routes.size(); ++r) arrows.push_back(arrow_for(one, r));
      bool any = false;
      for (const SignArrow arrow : all_arrows) {
        SignOption option{h, {}, {}, {}};
        for (size_t r = 0; r < arrows.size(); ++r)
          if (arrows[r] == arrow) option.leads_to.push_back({scene_.routes[r].name, arrow});
        if (option.leads_to.empty()) continue;
        add_guided(one, option, [&](size_t route, uint8_t guiding) {
          return arrows[route] == arrow && (guiding & bit_of(arrow)) != 0;
        });
        any = true;
        sign_options_.push_back(std::move(option));
      }
      if (!any) ++out_.left_out.unseen;
    }
    out_.candidates = static_cast<size_t>(std::count_if(
        sign_options_.begin(), sign_options_.end(),
        [&](const SignOption& option) { return hung_[option.hung].type != PlacedSign::existing; }));
  }

  void add_guided(const Hung& one, SignOption& option,
                  const std::function<bool(size_t route, uint8_t arrows)>& guides) const {
    for (const auto& [place, arrows] : one.bare)
      if (guides(asked_[place].route, arrows)) option.bare.push_back(place);
    for (const auto& [place, arrows] : one.furnished)
      if (guides(asked_[place].route, arrows)) option.furnished.push_back(place);
  }

  double weight_of(const Hung& one) const {
    const bool there = one.type == PlacedSign::existing;
    const double cost = there ? 0 : design_.sign_types[one.type].cost;
    const double watts = there ? 0 : design_.sign_types[one.type].watts;
    return design_.weight_of(cost, watts);
  }

  /// Makes the columns, and a row for each place that any of them guides.
  void make_rows() {
    // Existing signs do not exclude each other, wherever they hang, for instance back to back.
    const auto there = static_cast<uint32_t>(scene_.signs.size());
    std::vector<glm::dvec3> places;
    for (const SignOption& option : sign_options_) {
      const Hung& one = hung_[option.hung];
      LayoutOption column;
      column.place = one.type == PlacedSign::existing
                         ? static_cast<uint32_t>(option.hung)
                         : there + place_number(places, one.spot.position);
      column.fixed =
          one.type == PlacedSign::existing && design_.existing_signs == ExistingTreatment::fixed;
      column.weight = column.fixed ? 0
                                   : weight_of(one) *
                                         (1 + share_of_mount * static_cast<double>(one.spot.mount));
      column.position = one.spot.position;
      problem_.options.push_back(column);
    }
    out_.places = places.size();
    for (const EscapeRoute& route : scene_.routes)
      problem_.groups.push_back({DemandKind::near, RuleId::none, subject_of(route), 1, no_region});
    std::vector<std::vector<Term>> furnished(asked_.size()), bare(asked_.size());
    for (uint32_t i = 0; i < sign_options_.size(); ++i) {
      for (const uint32_t p : sign_options_[i].furnished) furnished[p].push_back({i, 1});
      for (const uint32_t p : sign_options_[i].bare) bare[p].push_back({i, 1});
    }
    terms_of_.resize(asked_.size());
    for (size_t p = 0; p < asked_.size(); ++p) {
      asked_[p].bare = furnished[p].empty() && !bare[p].empty();
      const bool none = furnished[p].empty() && bare[p].empty();
      if (none || asked_[p].bare) tell_unguided(asked_[p], false);
      if (none) continue;
      rows_of_.push_back(p);
      terms_of_[p] = std::make_shared<std::vector<Term>>(asked_[p].bare ? bare[p] : furnished[p]);
      problem_.covers.push_back(
          {static_cast<uint32_t>(asked_[p].route), terms_of_[p], 1, asked_[p].walker.foot});
    }
  }

  static uint32_t place_number(std::vector<glm::dvec3>& places, const glm::dvec3& at) {
    for (size_t i = 0; i < places.size(); ++i)
      if (glm::length(places[i] - at) < one_place_of_signs_m) return static_cast<uint32_t>(i);
    places.push_back(at);
    return static_cast<uint32_t>(places.size() - 1);
  }

  void tell_unguided(const Asked& place, bool behind_signs) {
    const std::string& name = scene_.routes[place.route].name;
    auto at = std::find_if(out_.unguided.begin(), out_.unguided.end(), [&](const auto& one) {
      return one.route == name && one.behind_furniture == place.bare &&
             one.behind_signs == behind_signs;
    });
    if (at == out_.unguided.end()) {
      const auto of =
          static_cast<size_t>(std::count_if(asked_.begin(), asked_.end(), [&](const Asked& other) {
            return other.route == place.route;
          }));
      at = out_.unguided.insert(at, {name, 0, of, place.bare, behind_signs, place.walker.foot});
    }
    ++at->places;
  }

  LayoutAnswer solve(const LayoutProblem& problem, double seconds) {
    if (problem.options.empty()) {
      LayoutAnswer nothing;
      nothing.end = LayoutEnd::optimal;
      return nothing;
    }
    SolveSettings settings;
    settings.seconds = std::max(seconds, min_seconds);
    settings.seed = options_.seed;
    return solve_layout(
        problem, settings, interrupt_,
        [&](const std::string& what, double, double) { progress_("signs: " + what, 0, 0); });
  }

  /// Whether no plan was found; the empty plan of a problem without columns is one.
  bool is_none(const LayoutAnswer& answer) const {
    return answer.layout.empty() && !problem_.options.empty();
  }

  Problem no_plan(LayoutEnd end) const {
    return problem_in(
        design_.place,
        end == LayoutEnd::infeasible
            ? "no plan of signs guides along all routes: some are seen at one place alone and ask "
              "for different arrows there; a smaller 'sign_spacing_m' or smaller signs make more "
              "places, or hang signs yourself and say place_signs = false"
            : fmt::format("the search for signs ended before it found any plan, after {:.3g} s at "
                          "most: give it more time, or make 'sign_spacing_m' larger",
                          options_.seconds));
  }

  void take(const LayoutAnswer& answer) {
    const Layout& layout = answer.layout;
    out_.end = answer.end;
    out_.signs.clear();
    out_.objective = 0;
    chosen_.clear();
    std::vector<PlacedSign> fresh;
    std::set<std::string> staying;
    for (size_t i = 0; i < layout.size(); ++i) {
      if (layout[i] == 0) continue;
      const Hung& one = hung_[sign_options_[i].hung];
      const bool there = one.type == PlacedSign::existing;
      chosen_.push_back(i);
      if (!problem_.options[i].fixed) out_.objective += weight_of(one);
      if (there) staying.insert(one.sign.name);
      (there ? out_.signs : fresh)
          .push_back({there ? one.sign.name : "", one.type, one.spot, sign_options_[i].leads_to});
    }
    if (design_.existing_signs != ExistingTreatment::removed) {
      out_.removed.clear();
      for (const Sign& sign : scene_.signs)
        if (!staying.contains(sign.name)) out_.removed.push_back(sign.name);
    }
    std::stable_sort(fresh.begin(), fresh.end(), [](const PlacedSign& a, const PlacedSign& b) {
      const glm::dvec3 p = a.spot.position, q = b.spot.position;
      if (std::abs(p.z - q.z) > 1) return p.z < q.z;
      return p.x != q.x ? p.x < q.x : p.y < q.y;
    });
    const std::string prefix = sign_prefix(scene_);
    for (size_t i = 0; i < fresh.size(); ++i) {
      fresh[i].name = prefix + std::to_string(i + 1);
      out_.signs.push_back(std::move(fresh[i]));
    }
  }

  /// Raised rows and removed signs may exclude other plans. So the bound is that of the original
  /// rows, without the rows that were given up.
  void tell_bound() {
    if (gave_up_) bound_ = bound_of_what_is_asked();
    // The shares that mounts add to the weights are taken out again.
    const double bound = bound_ / (1 + 2 * share_of_mount);
    constexpr double rounding_of_number = 1e-6;
    out_.bound = std::min(out_.objective, design_.objective == DesignObjective::number
                                              ? std::ceil(bound - rounding_of_number)
                                              : bound);
    if (out_.end == LayoutEnd::optimal && out_.bound < out_.objective * (1 - sum_tolerance))
      out_.end = LayoutEnd::within_gap;
  }

  /// Also computed after an interrupt, since the current plan needs a bound.
  double bound_of_what_is_asked() {
    LayoutProblem plain = problem_;
    for (size_t i = 0; i < plain.covers.size(); ++i) {
      plain.covers[i].least = 1;
      plain.covers[i].terms = terms_of_[rows_of_[i]];
    }
    for (LayoutOption& option : plain.options) option.barred = false;
    if (plain.options.empty()) return 0;
    SolveSettings settings;
    settings.seconds = std::max(time_left(), min_seconds);
    settings.seed = options_.seed;
    static const std::atomic<bool> never{false};
    return solve_layout(plain, settings, never, [](const std::string&, double, double) {}).bound;
  }

  /// Reports places that were given up, unless the final plan guides them.
  Result<void> tell_given_up() {
    auto lost = lost_places(given_up_);
    if (!lost) return lost.problem();
    for (const size_t place : lost.value())
      if (!asked_[place].bare) tell_unguided(asked_[place], true);  // others were reported before
    return {};
  }

  /// Places among `places` that the plan does not guide because its signs hide each other.
  Result<std::vector<size_t>> lost_places(const std::vector<size_t>& places) {
    const auto planned = with_signs(scene_, out_);
    std::vector<size_t> out;
    for (const bool bare : {false, true}) {
      std::vector<size_t> alike;
      for (const size_t place : places)
        if (asked_[place].bare == bare) alike.push_back(place);
      if (alike.empty()) continue;
      auto building = Building::make(code_scene(*planned, !bare),
                                     code_scenario(*planned, options_.doors), options_.threads);
      if (!building) return building.problem();
      std::vector<Walker> people;
      for (const size_t place : alike) people.push_back(asked_[place].walker);
      const auto clear = clear_signs(*planned, *building.value(), people);
      for (size_t i = 0; i < alike.size(); ++i) {
        const EscapeRoute& route = scene_.routes[asked_[alike[i]].route];
        const bool guided =
            std::any_of(clear[i].begin(), clear[i].end(), [&](const ClearSign& seen) {
              const Sign& sign = planned->signs[seen.sign];
              return near_enough(sign, seen.view) && can_guide(route, people[i], sign, seen.view);
            });
        if (!guided) out.push_back(alike[i]);
      }
    }
    return out;
  }

  size_t row_of(size_t place) const {
    return static_cast<size_t>(std::find(rows_of_.begin(), rows_of_.end(), place) -
                               rows_of_.begin());
  }

  /// Raises a row by one sign. False if the plan cannot contain more signs that guide this place.
  bool ask_for_another(size_t place) {
    CoverRow& cover = problem_.covers[row_of(place)];
    std::set<uint32_t> hung_at;
    for (const Term& term : *cover.terms) hung_at.insert(problem_.options[term.option].place);
    if (cover.least + 1 > static_cast<double>(hung_at.size())) return false;
    cover.least += 1;
    return true;
  }

  /// Bars the new sign that hides another one, for places that can get no further sign. False if no
  /// sign hides one, or if other places need it.
  bool leave_out_hiding(size_t place) {
    for (const size_t own : chosen_) {
      const std::vector<uint32_t>& guided =
          asked_[place].bare ? sign_options_[own].bare : sign_options_[own].furnished;
      if (std::find(guided.begin(), guided.end(), place) == guided.end()) continue;
      for (const size_t other : chosen_)
        if (other != own && hung_[sign_options_[other].hung].type != PlacedSign::existing &&
            stands_between(other, own, asked_[place].eye) && leave_out(other))
          return true;
    }
    return false;
  }

  bool stands_between(size_t other, size_t own, const glm::dvec3& eye) const {
    const Sign &hiding = hung_[sign_options_[other].hung].sign,
               &hidden = hung_[sign_options_[own].hung].sign;
    const glm::dvec3 way = hidden.frame.origin - eye, to = hiding.frame.origin - eye;
    const double along = std::clamp(glm::dot(to, way) / glm::dot(way, way), 0.0, 1.0);
    const double reach = (std::hypot(hiding.width_m, hiding.height_m) +
                          std::hypot(hidden.width_m, hidden.height_m) * along) /
                         2;
    return along < 1 && glm::length(to - way * along) < reach;
  }

  bool leave_out(size_t option) {
    const auto is_it = [&](const Term& term) { return term.option == option; };
    const auto has_others = [&](const CoverRow& cover) {
      std::set<uint32_t> left;
      for (const Term& term : *cover.terms)
        if (!is_it(term)) left.insert(problem_.options[term.option].place);
      return static_cast<double>(left.size()) >= cover.least;
    };
    if (!std::all_of(problem_.covers.begin(), problem_.covers.end(), has_others)) return false;
    for (CoverRow& cover : problem_.covers) {
      auto rest = std::make_shared<std::vector<Term>>(*cover.terms);
      std::erase_if(*rest, is_it);
      cover.terms = std::move(rest);
    }
    problem_.options[option].barred = true;  // a cost does not keep it out if it weighs nothing
    return true;
  }

  /// Removes the row of a place. The final test shows whether it is guided anyway.
  void give_up(size_t place) {
    gave_up_ = true;
    given_up_.push_back(place);
    const auto row = static_cast<std::ptrdiff_t>(row_of(place));
    problem_.covers.erase(problem_.covers.begin() + row);
    rows_of_.erase(rows_of_.begin() + row);
  }

  SceneDescription scene_;
  const DesignSettings& design_;
  const SignPlanOptions& options_;
  const std::atomic<bool>& interrupt_;
  const SolveProgress& progress_;
  bool has_furniture_ = false;
  std::unique_ptr<Building> bare_, furnished_;
  std::vector<Asked> asked_;
  std::vector<Hung> hung_;
  std::vector<SignOption> sign_options_;
  LayoutProblem problem_;
  std::vector<size_t> rows_of_;   // the place of each cover row
  std::vector<Terms> terms_of_;   // for each place, all signs that guide there
  std::vector<size_t> chosen_;    // options of the current plan
  std::vector<size_t> given_up_;  // places
  double bound_ = 0;              // lower bound on all plans, before rows were raised
  bool gave_up_ = false;          // whether a place was given up
  SystemClock clock_;
  Nanoseconds began_ = clock_.now();
  SignPlan out_;
};

}  // namespace

bool SignPlan::guides(const std::string& route) const {
  return std::none_of(unguided.begin(), unguided.end(),
                      [&](const UnguidedPlaces& one) { return one.route == route; });
}

Result<SignPlan> plan_signs(const SceneDescription& scene, const DesignSettings& design,
                            const SignPlanOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress) {
  return SignPlanner(scene, design, options, interrupt, progress).run();
}

std::shared_ptr<const SceneDescription> with_signs(const SceneDescription& scene,
                                                   const SignPlan& plan) {
  auto out = std::make_shared<SceneDescription>(scene);
  std::erase_if(out->signs, [&](const Sign& sign) {
    return std::find(plan.removed.begin(), plan.removed.end(), sign.name) != plan.removed.end();
  });
  for (const PlacedSign& one : plan.signs) {
    if (!one.is_new()) continue;
    Sign sign = sign_at(scene.design->sign_types[one.type].sign, one.spot);
    sign.name = one.name;
    sign.leads_to = one.leads_to;
    out->signs.push_back(std::move(sign));
  }
  return out;
}

}  // namespace luxodus

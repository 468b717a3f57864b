#include "actors/judge/design/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "actors/judge/design/alternatives.hpp"
#include "actors/judge/design/demands.hpp"
#include "actors/judge/design/refine_layout.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// Largest number of assessments: a layout that fails one is solved again with larger requirements.
constexpr int max_verifications = 8;
/// Time for binding demands after the search, as a share of the search time.
constexpr double share_for_binding = 0.25;
/// Largest time to find out why no layout exists [s].
constexpr double conflict_seconds = 60;
/// Alternative layouts that are made for each one judged in smoke: most pass the rules, and fewer
/// hold with luminaires off their places.
constexpr size_t tries_of_each = 4;
constexpr double no_objective = std::numeric_limits<double>::infinity();

/// Adds a scenario in emergency operation to a scene without scenarios, so that it can be judged.
std::shared_ptr<const SceneDescription> with_scenario(
    const std::shared_ptr<const SceneDescription>& scene) {
  if (!scene->scenarios.empty()) return scene;
  auto out = std::make_shared<SceneDescription>(*scene);
  Scenario emergency;
  emergency.name = "emergency";
  emergency.operation = emergency.written_operation = Operation::emergency;
  emergency.place = {scene->file, 1};
  out->scenarios.push_back(std::move(emergency));
  return out;
}

Result<void> can_design(const SceneDescription& scene) {
  if (scene.packed || !scene.design)
    return problem_in(
        scene.file, "a pack has its triangles elsewhere: take the scene file that it was made of");
  if (scene.routes.empty() && scene.open_areas.empty() && scene.task_areas.empty())
    return problem_in(scene.file,
                      "there is nothing to light: add [[route]], [[open_area]] or [[task_area]]");
  return {};
}

Result<void> check_scene(const std::shared_ptr<const SceneDescription>& scene,
                         const Scenario& scenario, int threads) {
  const auto found = inspect(scene, {scenario}, threads);
  if (!found) return found.problem();
  if (has_error(found.value())) return found->front().problem;  // errors are sorted first
  return {};
}

/// The first of "L", "N", "P", ... with which, before a number, no luminaire's name begins.
std::string prefix_of_names(const SceneDescription& scene) {
  for (const char* prefix : {"L", "N", "P", "design L"}) {
    const bool taken =
        std::any_of(scene.emitters.begin(), scene.emitters.end(), [&](const Emitter& e) {
          return e.name.starts_with(prefix) &&
                 e.name.find_first_not_of("0123456789", std::string_view(prefix).size()) ==
                     std::string::npos;
        });
    if (!taken) return prefix;
  }
  return "designed luminaire ";
}

/// Order of schedules: by floor, then from west to east, then from south to north.
bool comes_before(const LuminaireCandidate& a, const LuminaireCandidate& b) {
  const glm::dvec3 p = a.position, q = b.position;
  if (std::abs(p.z - q.z) > 1) return p.z < q.z;
  if (std::abs(p.x - q.x) > 1e-6) return p.x < q.x;
  return p.y < q.y;
}

std::shared_ptr<const SceneDescription> variant_of(const SceneDescription& scene,
                                                   const PlacedLayout& layout) {
  auto out = std::make_shared<SceneDescription>(scene);
  std::erase_if(out->emitters, [&](const Emitter& e) {
    return std::find(layout.removed.begin(), layout.removed.end(), e.name) != layout.removed.end();
  });
  for (const PlacedLuminaire& one : layout.luminaires) {
    if (!one.is_placed()) continue;
    Emitter e = emitter_of(scene, *scene.design, one.candidate);
    e.name = one.name;
    const auto there = std::find_if(out->emitters.begin(), out->emitters.end(),
                                    [&](const Emitter& other) { return other.name == one.name; });
    if (there != out->emitters.end())
      *there = std::move(e);
    else
      out->emitters.push_back(std::move(e));
  }
  return out;
}

/// Assigns luminaires of a pool to places: repeatedly the closest pair.
std::vector<PlacedLuminaire> moved_in(std::vector<LuminaireCandidate> leaving,
                                      std::vector<LuminaireCandidate> places) {
  std::vector<PlacedLuminaire> out;
  while (!leaving.empty() && !places.empty()) {
    double nearest = std::numeric_limits<double>::infinity();
    size_t from = 0, to = 0;
    for (size_t i = 0; i < leaving.size(); ++i)
      for (size_t k = 0; k < places.size(); ++k)
        if (const double way = glm::length(leaving[i].position - places[k].position);
            way < nearest) {
          nearest = way;
          from = i;
          to = k;
        }
    LuminaireCandidate one = places[to];
    one.name = leaving[from].name;
    out.push_back({one, one.name, leaving[from].position});
    leaving.erase(leaving.begin() + static_cast<std::ptrdiff_t>(from));
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return out;
}

PlacedLayout placed(const SceneDescription& scene, const Candidates& candidates,
                    const Layout& layout) {
  PlacedLayout out;
  out.removed = candidates.removed;
  std::vector<LuminaireCandidate> fresh;
  std::map<uint32_t, std::vector<LuminaireCandidate>> leaving, arriving;  // by pool
  for (size_t i = 0; i < candidates.all.size(); ++i) {
    const LuminaireCandidate& one = candidates.all[i];
    if (one.pool && one.moved == (layout[i] != 0))
      (one.moved ? arriving : leaving)[one.pool->number].push_back(one);
    else if (one.moved)
      continue;
    else if (one.type == LuminaireCandidate::existing && layout[i] == 0)
      out.removed.push_back(one.name);
    else if (one.type == LuminaireCandidate::existing)
      out.luminaires.push_back({one, one.name});
    else if (layout[i] != 0)
      fresh.push_back(one);
  }
  for (auto& [pool, places] : arriving) {
    const auto moved = moved_in(std::move(leaving[pool]), std::move(places));
    out.luminaires.insert(out.luminaires.end(), moved.begin(), moved.end());
  }
  std::stable_sort(fresh.begin(), fresh.end(), comes_before);
  const std::string prefix = prefix_of_names(scene);
  size_t number = 0;
  for (LuminaireCandidate& one : fresh)
    out.luminaires.push_back({std::move(one), prefix + std::to_string(++number)});
  out.variant = variant_of(scene, out);
  return out;
}

/// For each group, the least share of its requirement in a layout.
std::vector<double> tightest_of(const LayoutProblem& problem, const Layout& layout) {
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  sums.set(layout);
  return sums.tightest();
}

class DesignRun {
 public:
  DesignRun(std::shared_ptr<const SceneDescription> scene, const DesignOptions& options,
            const std::atomic<bool>& interrupt, const SolveProgress& progress)
      : scene_(std::move(scene)),
        options_(options),
        interrupt_(interrupt),
        progress_(progress),
        began_(clock_.now()) {}

  Result<DesignResult> run() {
    if (auto ok = prepare(); !ok) return ok.problem();
    for (out_.verifications = 1;; ++out_.verifications) {
      solve();
      if (out_.answer.layout.empty()) {
        if (!nearest_) return std::move(out_);
        out_ = *std::move(nearest_);
        break;
      }
      keep_bound();
      if (auto ok = judge(); !ok) return ok.problem();
      const auto failing = failing_checks(out_, out_.assessment, &out_.others);
      const bool last = out_.verifications == max_verifications || interrupt_;
      if (!failing.empty()) {
        // A check that fails between points passes with these points.
        if (!last && (look_between() || ask_for_more(failing))) continue;
        if (!nearest_) return rejected(failing.front());
        out_ = *std::move(nearest_);
        break;
      }
      if (auto ok = find_tolerance(); !ok) return ok.problem();
      if (out_.tolerance->holds()) {
        if (!look_between() || last) break;
        nearest_ = out_;
        continue;
      }
      if (!nearest_ || out_.tolerance->least() > nearest_->tolerance->least()) nearest_ = out_;
      if (!last) {
        const auto asked = ask_for_more_off_place();
        if (!asked) return asked.problem();
        if (asked.value()) continue;
      }
      out_ = *std::move(nearest_);
      break;
    }
    out_.tightest = tightest_of(demands_->problem(), out_.answer.layout);
    if (options_.what_binds && !interrupt_) find_what_binds();
    if ((scene_->design->refine || options_.refine) && !interrupt_)
      if (auto ok = refine(); !ok) return ok.problem();
    if (!scenarios_in_smoke().empty() && !interrupt_)
      if (auto ok = judge_alternatives(); !ok) return ok.problem();
    return std::move(out_);
  }

 private:
  double seconds() const { return 1e-9 * static_cast<double>(clock_.now() - began_); }

  Result<void> prepare() {
    progress_("inspecting the scene", no_objective, 0);
    if (!scenarios_in_smoke().empty())
      if (auto ok = check_smoke_stage(scene_, smoke_options()); !ok) return ok.problem();
    auto scenario = judged_scenario(*scene_, options_.scenario);
    if (!scenario) return scenario.problem();
    scenario_ = std::move(scenario).value();
    auto codes = judged_codes(*scene_, options_.rules, options_.deviations);
    if (!codes) return codes.problem();
    codes_ = std::move(codes).value();
    if (auto ok = check_scene(scene_, scenario_, options_.threads); !ok) return ok.problem();
    switched_ = as_switched(*scene_, scenario_);
    if (emergency_luminaires(switched_).empty())
      if (auto ok = gives_any_light(*switched_.design); !ok) return ok.problem();
    if (*scene_->design->place_signs && !scene_->routes.empty())
      if (auto ok = place_signs(); !ok) return ok.problem();
    progress_("finding places", no_objective, 0);
    auto candidates =
        find_candidates(switched_, *switched_.design, codes_, scenario_, options_.threads);
    if (!candidates) return candidates.problem();
    candidates_ = std::move(candidates).value();
    progress_("computing their light", no_objective, 0);
    auto demands = Demands::make(switched_, *switched_.design, candidates_.all, codes_, scenario_,
                                 options_.threads);
    if (!demands) return demands.problem();
    demands_ = std::move(demands).value();
    out_.places = candidates_.places;
    out_.candidates = candidates_.all.size();
    out_.left_out = candidates_.left_out;
    out_.unused = candidates_.unused;
    out_.points = demands_->problem().points.size();
    out_.groups = demands_->problem().groups;
    out_.unlit_stair_flights = demands_->unlit_stair_flights();
    for (const auto& [what, points] : demands_->hidden())
      if (!what.first.empty())
        out_.hidden.push_back({std::string(what.first), what.second, points});
    return {};
  }

  /// Places signs; from here on the scene has them.
  Result<void> place_signs() {
    SignPlanOptions asked;
    asked.codes = codes_;
    asked.doors = scenario_;
    // Signs are few compared with luminaires, so their program gets a small part of the time.
    constexpr double share_of_time = 0.25;
    asked.seconds = share_of_time * options_.seconds;
    asked.seed = options_.seed;
    asked.threads = options_.threads;
    auto plan = plan_signs(
        switched_, *switched_.design, asked, interrupt_,
        [&](const std::string& what, double, double) { progress_(what, no_objective, 0); });
    if (!plan) return plan.problem();
    scene_ = with_signs(*scene_, plan.value());
    switched_ = as_switched(*scene_, scenario_);
    out_.signs = std::move(plan).value();
    return {};
  }

  /// Whether placed signs decide a check, which then has to pass.
  bool is_of_signs(const Check& check) const {
    if (!out_.signs || row_of(check.rule.id).decided_by != DecidedBy::placed_signs) return false;
    return std::any_of(scene_->routes.begin(), scene_->routes.end(), [&](const EscapeRoute& route) {
      return check.subject == subject_of(route) && out_.signs->guides(route.name);
    });
  }

  void find_what_binds() {
    progress_("looking for what binds", out_.answer.objective, out_.answer.bound);
    WhatBindsSettings asked;
    asked.seconds = share_for_binding * options_.seconds;
    asked.seed = options_.seed;
    for (const Relaxed& one : what_binds(demands_->problem(), out_.answer, asked, interrupt_))
      out_.because.push_back({one, name_of(one.without.never_fails)});
  }

  std::string name_of(const std::optional<uint32_t>& option) const {
    if (!option) return "";
    const auto at = std::find_if(
        out_.luminaires.begin(), out_.luminaires.end(),
        [&](const auto& one) { return one.candidate.place == candidates_.all[*option].place; });
    return at == out_.luminaires.end() ? "" : at->name;
  }

  /// Finds how well minima hold with luminaires off their places.
  Result<void> find_tolerance() {
    out_.tolerance.emplace();
    if (!(scene_->design->place_tolerance_m > 0)) return {};
    progress_("looking at luminaires off their places", out_.answer.objective, out_.answer.bound);
    auto found = tolerance_of(switched_, *switched_.design, chosen_candidates(), codes_, scenario_,
                              options_.threads);
    if (!found) return found.problem();
    out_.tolerance = std::move(found).value();
    return {};
  }

  /// Adds points between those of the grid where a minimum does not hold; true if there were any.
  bool look_between() {
    progress_("looking between the points", out_.answer.objective, out_.answer.bound);
    const BetweenPoints found = demands_->look_between(out_.answer.layout);
    out_.between.least = found.least;
    out_.between.added += found.added;
    if (found.added > 0) rows_of_all_ = false;  // passing layouts may miss these by 1 %
    return found.added > 0;
  }

  /// Moves placed luminaires. If a check then fails, or less is left off their places, they stay
  /// where they were.
  Result<void> refine() {
    RefineOptions asked;
    asked.codes = codes_;
    asked.doors = scenario_;
    asked.seconds = options_.seconds;
    asked.threads = options_.threads;
    auto refined = refine_layout(
        switched_, *switched_.design, chosen_candidates(), *demands_, asked, interrupt_,
        [&](double) { progress_("moving luminaires", out_.answer.objective, out_.answer.bound); });
    if (!refined) return refined.problem();
    if (refined->moved == 0) return {};
    Candidates moved = candidates_;
    size_t next = 0;
    for (size_t i = 0; i < moved.all.size(); ++i)
      if (out_.answer.layout[i] != 0) {
        moved.all[i].position = refined->luminaires[next].position;
        moved.all[i].floor = refined->luminaires[next++].floor;
      }
    PlacedLayout layout = placed(*scene_, moved, out_.answer.layout);
    auto assessed = assessed_by_codes(layout.variant);
    if (!assessed) return assessed.problem();
    if (!failing_checks(layout, assessed.value(), nullptr).empty()) return {};
    PlaceTolerance tolerance;
    if (scene_->design->place_tolerance_m > 0) {
      auto found = tolerance_of(switched_, *switched_.design, refined->luminaires, codes_,
                                scenario_, options_.threads);
      if (!found) return found.problem();
      if (!found->holds() && found->least() < out_.tolerance->least()) return {};
      tolerance = std::move(found).value();
    }
    static_cast<PlacedLayout&>(out_) = std::move(layout);
    out_.assessment = std::move(assessed).value();
    out_.tolerance = std::move(tolerance);
    const LayoutProblem& problem = refined->demands->problem();
    out_.between.least =
        refined->demands->look_between(Layout(problem.options.size(), 1), demands_.get()).least;
    if (problem.groups.size() == out_.groups.size())
      out_.tightest = tightest_of(problem, Layout(problem.options.size(), 1));
    out_.refined = Refined{refined->moved, refined->before, refined->after};
    return {};
  }

  /// Rows that were raised for one layout may exclude others that pass. So the bound is the largest
  /// one from searches without such rows.
  void keep_bound() {
    LayoutAnswer& answer = out_.answer;
    if (rows_of_all_) known_bound_ = std::max(known_bound_, answer.bound);
    answer.bound = std::min(known_bound_, answer.objective);
    if (answer.end == LayoutEnd::interrupted) return;
    if (answer.gap() == 0)
      answer.end = LayoutEnd::optimal;
    else if (answer.gap() <= options_.gap || answer.end == LayoutEnd::optimal)
      answer.end = LayoutEnd::within_gap;
  }

  std::vector<LuminaireCandidate> chosen_candidates() const {
    return chosen_candidates(out_.answer.layout);
  }
  std::vector<LuminaireCandidate> chosen_candidates(const Layout& layout) const {
    std::vector<LuminaireCandidate> out;
    for (size_t i = 0; i < candidates_.all.size(); ++i)
      if (layout[i] != 0) out.push_back(candidates_.all[i]);
    return out;
  }

  /// Whether another layout satisfies the minima off its places. True if even the best layout does
  /// not.
  Result<bool> holds_off_place(const Layout& layout) const {
    if (!(scene_->design->place_tolerance_m > 0) || !out_.tolerance || !out_.tolerance->holds())
      return true;
    auto found = tolerance_of(switched_, *switched_.design, chosen_candidates(layout), codes_,
                              scenario_, options_.threads);
    if (!found) return found.problem();
    return found->holds();
  }

  /// Adds rows off the places. False if no row can be added or no layout satisfies them; then the
  /// result reports the shortfall.
  Result<bool> ask_for_more_off_place() {
    const auto broken = demands_->ask_off_place(
        {switched_, *switched_.design, scenario_, options_.threads}, candidates_.all,
        broken_points(*out_.tolerance), out_.answer.layout);
    if (!broken) return broken.problem();
    if (broken.value() > 0) return true;
    bool any = false;
    for (const ShareOffPlace& one : out_.tolerance->demands)
      if (one.missing > 0)
        any = demands_->ask_for_more(one.kind, one.rule, one.subject, one.place, one.missing,
                                     out_.answer.layout) ||
              any;
    if (any) rows_of_all_ = false;
    return any;
  }

  void solve() {
    SolveSettings settings;
    // A rejected layout is solved again in the remaining time, but at least for this long.
    constexpr double moment = 5;
    settings.seconds = out_.verifications == 1
                           ? options_.seconds
                           : std::max(moment, options_.seconds - (seconds() - solving_since_));
    settings.gap = options_.gap;
    settings.seed = options_.seed;
    if (out_.verifications > 1) {
      // The problem has more rows now, so known bounds stay valid.
      settings.start = out_.answer.layout;
      settings.known_regions = out_.answer.regions;
    }
    if (out_.verifications == 1) solving_since_ = out_.prepared_seconds = seconds();
    out_.answer = solve_layout(demands_->problem(), settings, interrupt_, progress_);
    if (out_.answer.end == LayoutEnd::infeasible) {
      progress_("looking for what cannot hold together", no_objective, 0);
      out_.conflict = conflict_of(demands_->problem(), conflict_seconds, interrupt_);
    }
  }

  Result<void> judge() {
    progress_("assessing the layout", out_.answer.objective, out_.answer.bound);
    static_cast<PlacedLayout&>(out_) = placed(*scene_, candidates_, out_.answer.layout);
    auto assessed = assessed_by_codes(out_.variant);
    if (!assessed) return assessed.problem();
    out_.assessment = std::move(assessed).value();
    return {};
  }

  /// Assesses the layout even after an interrupt, since it takes only seconds.
  Result<Assessment> assessed_by_codes(const std::shared_ptr<const SceneDescription>& variant) {
    AssessOptions asked;
    asked.scenario = options_.scenario;
    asked.rules = options_.rules;
    asked.deviations = options_.deviations;
    asked.threads = options_.threads;
    asked.reality = false;
    static const std::atomic<bool> never{false};
    return assess(variant, asked, never, [](const std::string&, double) {});
  }

  /// Failing checks that luminaires of the layout decide; the rest is appended to `others` unless
  /// it is null.
  std::vector<Check> failing_checks(const PlacedLayout& layout, const Assessment& assessment,
                                    std::vector<Check>* others) {
    std::set<Subject> ours;
    for (const PlacedLuminaire& one : layout.luminaires)
      if (one.is_placed()) ours.insert({SubjectKind::luminaire, one.name});
    std::vector<Check> out;
    if (others != nullptr) others->clear();
    for (const Check& check : assessment.checks) {
      if (check.verdict != CheckVerdict::fail) continue;
      const bool of_one = check.subject.kind == SubjectKind::luminaire;
      const bool decided =
          is_of_signs(check) ||
          (row_of(check.rule.id).decided_by == DecidedBy::luminaires &&
           (!of_one || ours.contains(check.subject)) && !demands_->is_hidden(check));
      if (decided)
        out.push_back(check);
      else if (others != nullptr)
        others->push_back(check);
    }
    return out;
  }

  const std::vector<std::string>& scenarios_in_smoke() const {
    return options_.in_smoke.empty() ? scene_->design->in_smoke : options_.in_smoke;
  }

  SmokeStageOptions smoke_options() const {
    SmokeStageOptions out;
    out.scenarios = scenarios_in_smoke();
    out.seed = options_.seed;
    out.threads = options_.threads;
    out.seconds = options_.smoke_seconds;
    out.scene_at = options_.scene_at;
    out.people = options_.people;
    return out;
  }

  JudgedLayout contender(std::string name, PlacedLayout layout, const Layout& chosen) const {
    JudgedLayout out;
    out.name = std::move(name);
    out.objective = objective_of(demands_->problem(), chosen);
    for (const PlacedLuminaire& one : layout.luminaires) {
      if (!one.is_new()) continue;
      const DesignType& type = scene_->design->types[one.candidate.type];
      out.cost += type.cost;
      out.watts += type.watts;
      ++out.placed;
    }
    out.layout = std::move(layout);
    return out;
  }

  /// Judges the best layout by the rules, and alternatives that pass them, in smoke.
  Result<void> judge_alternatives() {
    const auto tell = [&](const std::string& what) {
      progress_(what, out_.answer.objective, out_.answer.bound);
    };
    tell("looking for other layouts");
    AlternativesWish wish;
    wish.count = tries_of_each * scene_->design->alternatives;
    wish.seed = options_.seed;
    std::vector<JudgedLayout> layouts{contender("A", out_, out_.answer.layout)};
    for (const Layout& chosen :
         alternatives_to(demands_->problem(), out_.answer.layout, wish, interrupt_)) {
      if (interrupt_ || layouts.size() > scene_->design->alternatives) break;
      tell("assessing other layouts by the rules");
      if (const auto holds = holds_off_place(chosen); !holds)
        return holds.problem();
      else if (!holds.value())
        continue;
      PlacedLayout layout = placed(*scene_, candidates_, chosen);
      const auto assessed = assessed_by_codes(layout.variant);
      if (!assessed) return assessed.problem();
      if (!failing_checks(layout, assessed.value(), nullptr).empty()) continue;
      const auto letter = static_cast<char>('A' + layouts.size());
      layouts.push_back(contender(std::string(1, letter), std::move(layout), chosen));
    }
    auto stage = judge_in_smoke(std::move(layouts), smoke_options(), interrupt_, tell);
    if (!stage) return stage.problem();
    if (!stage->layouts.empty()) out_.smoke = std::move(stage).value();
    return {};
  }

  bool ask_for_more(const std::vector<Check>& failing) {
    bool any = false;
    for (const Check& check : failing)
      any = demands_->ask_for_more(check, out_.answer.layout) || any;
    if (any) rows_of_all_ = false;
    return any;
  }

  Problem rejected(const Check& check) const {
    return problem_in(
        scene_->file,
        fmt::format("no layout was found that passes its own assessment: {} for {} still fails "
                    "after {} layouts; a larger 'margin' leaves more room",
                    luxodus::name_of(check.rule.id), english().subject(check.subject),
                    out_.verifications));
  }

  std::shared_ptr<const SceneDescription> scene_;
  const DesignOptions& options_;
  const std::atomic<bool>& interrupt_;
  const SolveProgress& progress_;
  SystemClock clock_;
  Nanoseconds began_;
  double solving_since_ = 0;
  Scenario scenario_;
  std::vector<CodeChoice> codes_;
  SceneDescription switched_;  // after the circuits of the scenario, with signs
  Candidates candidates_;
  std::unique_ptr<Demands> demands_;
  DesignResult out_;
  /// While no layout holds off its places: the one that passes the rules and holds best.
  std::optional<DesignResult> nearest_;
  bool rows_of_all_ = true;  // every layout that passes satisfies all added rows
  double known_bound_ = 0;
};

}  // namespace

Result<DesignResult> design(const std::shared_ptr<const SceneDescription>& scene,
                            const DesignOptions& options, const std::atomic<bool>& interrupt,
                            const SolveProgress& progress) {
  if (auto ok = can_design(*scene); !ok) return ok.problem();
  auto result = DesignRun(with_scenario(scene), options, interrupt, progress).run();
  if (!result) return result.problem();
  result->added_scenario = scene->scenarios.empty();
  if (scene->assessment.rules.empty()) result->rules = options.rules;
  if (scene->assessment.deviations.empty()) result->deviations = options.deviations;
  return result;
}

}  // namespace luxodus

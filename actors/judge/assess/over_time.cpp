#include "actors/judge/assess/over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "actors/judge/assess/guiding_views.hpp"
#include "actors/judge/assess/reality_mode.hpp"
#include "scenes/formats/fields/fds_visibility.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Range of albedos of smoke from fires. FDS computes none, so a verdict must hold at both ends.
constexpr double min_albedo = 0.1, max_albedo = 0.5;
/// Share of a state's work for its own albedo; the rest is for the two ends of the range.
constexpr double first_share = 0.6;
/// Each state is traced in smoke of so many albedos.
constexpr size_t albedos = 3;

/// Identifies a view: the place, the eye height and the sign.
struct ViewKey {
  Subject from;
  double along_m, height_m;
  std::string sign;
  auto operator<=>(const ViewKey&) const = default;
};
ViewKey key_of(const SightRow& row) {
  return {row.from, row.along_m, row.height_m, row.sign};
}

/// Mean over wavelength.
double mean_albedo(const SmokeOptics& optics) {
  return optics.albedo.integral() / Spectrum::constant(1).integral();
}

/// FDS's own slices of VISIBILITY at one state of the scene.
class SlicesOfFires {
 public:
  /// Slices that cannot be read are reported in `warnings`; verdicts do not depend on them.
  SlicesOfFires(const SceneDescription& scene, std::vector<std::string>& warnings) {
    for (const Medium& medium : scene.media) {
      if (!medium.simulation || medium.simulation->index.empty()) continue;
      auto slices = read_visibility(medium.simulation->index, medium.simulation->time_s);
      if (!slices)
        tell("FDS's VISIBILITY is not shown: " + slices.problem().text(), warnings);
      else if (slices.value())
        all_.emplace_back(medium.simulation->frame, std::move(*slices.value()));
    }
  }

  std::optional<double> at(const glm::dvec3& place) const {
    std::optional<double> least;
    for (const auto& [frame, visibility] : all_) {
      const glm::dvec3 local = glm::transpose(frame.axes) * (place - frame.origin);
      const auto here = visibility.at(local);
      if (here && (!least || *here < *least)) least = here;
    }
    return least;
  }

 private:
  static void tell(std::string words, std::vector<std::string>& warnings) {
    if (std::find(warnings.begin(), warnings.end(), words) == warnings.end())
      warnings.push_back(std::move(words));
  }

  std::vector<std::pair<Frame, FireVisibility>> all_;
};

/// One state of the scene, traced for its views.
class StateOfTime {
 public:
  StateOfTime(std::shared_ptr<const SceneDescription> scene, Scenario scenario,
              const AssessOptions& options)
      : scene_(std::move(scene)),
        scenario_(std::move(scenario)),
        options_(options),
        views_(*scene_) {
    options_.wanted = [this](const SightRow& row) { return views_.can_guide(row); };
  }
  StateOfTime(const StateOfTime&) = delete;
  StateOfTime& operator=(const StateOfTime&) = delete;

  /// Traces the state as stated, then tests its legible views in other smoke. Errors: as
  /// assess_sights.
  Result<void> trace(const std::atomic<bool>& interrupt, const AssessProgress& progress,
                     OverTime& out);
  TimedState facts() const;
  /// Appends this state to the table of each route.
  void add_to(OverTime& out) const;
  int64_t paths() const { return nominal_.paths; }

 private:
  Result<void> try_albedo(double albedo, const std::atomic<bool>& interrupt,
                          const AssessProgress& progress);

  std::shared_ptr<const SceneDescription> scene_;
  Scenario scenario_;
  AssessOptions options_;
  GuidingViews views_;
  Assessment nominal_;
  std::set<ViewKey> doubted_;  // legible, but not in all smoke that is possible here
};

Result<void> StateOfTime::trace(const std::atomic<bool>& interrupt, const AssessProgress& progress,
                                OverTime& out) {
  const auto first = [&](const std::string& what, double share) {
    progress(what, first_share * share);
  };
  if (auto ok = assess_sights(*scene_, scenario_, {}, options_, interrupt, first, nominal_); !ok)
    return ok;
  if (!has_smoke(*scene_, scenario_)) return {};
  double low = min_albedo, high = max_albedo;
  for_each_smoke(*scene_, [&](const SmokeOptics& optics) {
    low = std::min(low, mean_albedo(optics));
    high = std::max(high, mean_albedo(optics));
  });
  out.holds_for.low_albedo =
      out.holds_for.high_albedo == 0 ? low : std::min(out.holds_for.low_albedo, low);
  out.holds_for.high_albedo = std::max(out.holds_for.high_albedo, high);
  for (const Medium& medium : scene_->media)
    if (medium.simulation)
      out.holds_for.depth_error =
          std::max(out.holds_for.depth_error, medium.simulation->depth_error);
  const double left = (1 - first_share) / 2;
  for (const auto& [albedo, begun] : {std::pair{low, first_share}, {high, first_share + left}})
    if (auto ok = try_albedo(albedo, interrupt,
                             [&](const std::string& what, double share) {
                               progress(fmt::format("albedo {:.2g}, {}", albedo, what),
                                        begun + left * share);
                             });
        !ok)
      return ok;
  return {};
}

Result<void> StateOfTime::try_albedo(double albedo, const std::atomic<bool>& interrupt,
                                     const AssessProgress& progress) {
  std::set<ViewKey> legible;
  for (const SightRow& row : nominal_.sights)
    if (row.sight.verdict == SightVerdict::legible && !doubted_.contains(key_of(row)))
      legible.insert(key_of(row));
  if (legible.empty()) return {};
  AssessOptions options = options_;
  options.wanted = [&](const SightRow& row) { return legible.contains(key_of(row)); };
  Assessment other;
  if (auto ok =
          assess_sights(*scene_, scenario_, {1, albedo, true}, options, interrupt, progress, other);
      !ok)
    return ok;
  nominal_.paths += other.paths;
  for (const SightRow& row : other.sights)
    if (row.sight.verdict != SightVerdict::legible) doubted_.insert(key_of(row));
  return {};
}

TimedState StateOfTime::facts() const {
  TimedState out;
  out.at_s = scene_->at_s.value_or(0);
  out.operation = scenario_.operation;
  if (scenario_.operation != Operation::mains && scenario_.says_seconds)
    out.seconds_after_failure = scenario_.seconds_after_failure;
  for (const ActiveSource& source : active_sources(*scene_, scenario_))
    out.lit += source.emitter != nullptr ? 1 : 0;
  for (const Medium& medium : scene_->media)
    if (medium.simulation) out.frames.push_back({medium.name, medium.simulation->time_s});
  return out;
}

/// The best sign at a place counts.
struct BestSign {
  Guidance guidance = Guidance::not_guided;
  bool jin = false, line = false;
  Guidance fds = Guidance::not_guided;
  std::string name;

  /// `visibility_m`: of FDS at the place, if known.
  void take(const SightRow& row, bool doubted, const std::optional<double>& visibility_m) {
    const SightVerdict verdict = row.sight.verdict;
    const Guidance here = verdict == SightVerdict::legible && !doubted ? Guidance::guided
                          : verdict == SightVerdict::undecided || verdict == SightVerdict::legible
                              ? Guidance::undecided
                              : Guidance::not_guided;
    const bool hidden = verdict == SightVerdict::hidden;
    if (!hidden && (name.empty() || here < guidance)) name = row.sign;
    guidance = std::min(guidance, here);
    jin = jin || (!hidden && row.sight.jin_legible);
    line = line || row.line.seen;
    if (!hidden)
      fds = std::min(fds, !visibility_m                          ? Guidance::undecided
                          : row.view.distance_m <= *visibility_m ? Guidance::guided
                                                                 : Guidance::not_guided);
  }
};

void StateOfTime::add_to(OverTime& out) const {
  std::map<std::tuple<Subject, double, double>, BestSign> best;  // route, eyes, place
  const SlicesOfFires slices(*scene_, out.warnings);
  for (const SightRow& row : nominal_.sights)
    best[{row.from, row.height_m, row.along_m}].take(row, doubted_.contains(key_of(row)),
                                                     slices.at(row.eye));
  const double now_s = scene_->at_s.value_or(0);
  size_t at = 0;
  for (size_t r = 0; r < scene_->routes.size(); ++r)
    for (const double height : scene_->assessment.eye_heights_m) {
      if (at == out.routes.size()) {
        RouteOverTime& made = out.routes.emplace_back();
        made.route = scene_->routes[r].name;
        made.eye_height_m = height;
        made.guided.length_m = length_of(scene_->routes[r]);
        for (const Walker& walker : views_.people(r)) made.guided.along_m.push_back(walker.along_m);
        made.by_jin = made.by_line = made.by_fds = made.guided;
      }
      RouteOverTime& route = out.routes[at++];
      std::vector<Guidance> guided, jin, line, fds;
      std::vector<std::string> signs;
      std::vector<std::optional<double>> visibility;
      for (const Walker& walker : views_.people(r)) {
        const BestSign one = best[{subject_of(scene_->routes[r]), height, walker.along_m}];
        fds.push_back(one.fds);
        visibility.push_back(slices.at(walker.foot + glm::dvec3(0, 0, height)));
        guided.push_back(one.guidance);
        jin.push_back(one.jin ? Guidance::guided : Guidance::not_guided);
        line.push_back(one.line ? Guidance::guided : Guidance::not_guided);
        signs.push_back(one.name);
      }
      for (GuidedRoute* table : {&route.guided, &route.by_jin, &route.by_line, &route.by_fds})
        table->times_s.push_back(now_s);
      route.by_fds.at.push_back(std::move(fds));
      route.visibility_m.push_back(std::move(visibility));
      route.guided.at.push_back(std::move(guided));
      route.by_jin.at.push_back(std::move(jin));
      route.by_line.at.push_back(std::move(line));
      route.signs.push_back(std::move(signs));
    }
}

/// Removes FDS's verdict if the case has no slice of VISIBILITY that reaches the route.
void leave_out_unknown(RouteOverTime& route) {
  for (const auto& state : route.visibility_m)
    for (const auto& visibility : state)
      if (visibility) return;
  route.by_fds = {};
  route.visibility_m.clear();
}

}  // namespace

Result<void> check_guidance(const SceneDescription& scene) {
  if (scene.routes.empty())
    return problem_in(scene.file, "guidance over time is that of routes: add [[route]]");
  if (std::all_of(scene.signs.begin(), scene.signs.end(),
                  [](const Sign& sign) { return sign.leads_to.empty(); }))
    return problem_in(scene.signs.empty() ? SourcePlace{scene.file, 0} : scene.signs.front().place,
                      "no sign says which route it leads to, so that none guides: add "
                      "[[sign.leads_to]] with route = \"" +
                          scene.routes.front().name + "\" and arrow = \"ahead\"");
  return {};
}

Result<OverTime> assess_over_time(const std::vector<double>& times_s, const SceneAtTime& scene_at,
                                  const AssessOptions& options, const std::atomic<bool>& interrupt,
                                  const AssessProgress& progress) {
  OverTime out;
  for (size_t i = 0; i < times_s.size(); ++i) {
    auto scene = scene_at(times_s[i]);
    if (!scene) return scene.problem();
    if (auto ok = check_guidance(*scene.value()); !ok) return ok.problem();
    auto scenario = judged_scenario(*scene.value(), options.scenario);
    if (!scenario) return scenario.problem();
    StateOfTime state(scene.value(), std::move(scenario).value(),
                      options.one_of(albedos * times_s.size()));
    const auto told = [&](const std::string& what, double share) {
      progress(fmt::format("state {} of {} ({:g} s), {}", i + 1, times_s.size(), times_s[i], what),
               (static_cast<double>(i) + share) / static_cast<double>(times_s.size()));
    };
    if (auto ok = state.trace(interrupt, told, out); !ok) return ok.problem();
    out.states.push_back(state.facts());
    state.add_to(out);
    out.paths += state.paths();
    if (scene.value()->time) out.walking_speed_m_s = scene.value()->time->walking_speed_m_s;
  }
  for (RouteOverTime& route : out.routes) leave_out_unknown(route);
  if (out.walking_speed_m_s)
    for (RouteOverTime& route : out.routes)
      for (const double start : times_s)
        route.walks.push_back({walk(route.guided, start, *out.walking_speed_m_s)});
  progress("all states", 1);
  return out;
}

Result<Assessment> assess_states(const StatesToAssess& states, const AssessOptions& options,
                                 const std::atomic<bool>& interrupt, const AssessProgress& progress,
                                 const AssessProgress& over_time) {
  const bool several = options.reality && states.times_s.size() > 1;
  if (several)
    if (auto ok = check_guidance(*states.last); !ok) return ok.problem();
  const AssessOptions each = options.one_of(several ? 2 : 1);  // the last state, and the others
  auto out = assess(states.last, each, interrupt, progress);
  if (!out || !several) return out;
  AssessOptions asked = each;
  asked.scenario = out->state.scenario;
  auto followed = assess_over_time(states.times_s, states.reader, asked, interrupt, over_time);
  if (!followed) return followed.problem();
  out->over_time = std::move(followed).value();
  for (const std::string& warning : out->over_time->warnings)
    out->warnings.push_back({{}, std::nullopt, warning});
  return out;
}

}  // namespace luxodus

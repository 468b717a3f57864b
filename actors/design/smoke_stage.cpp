#include "actors/design/smoke_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "actors/assess/code_light.hpp"
#include "actors/assess/reality_mode.hpp"
#include "runtime/core/clock.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// What is read from a place on a route.
enum class Read { nothing, undecided, a_sign };

/// A place: route, metres along it, height of the eye [m].
using Place = std::tuple<std::string, double, double>;

struct Seen {
  double stands_for = 0;  // metres of the route
  Read read = Read::nothing;
};
using SeenPlaces = std::map<Place, Seen>;

/// Of all places on routes: where all signs turn their backs there is no row.
SeenPlaces places_of(const SceneDescription& scene, const Assessment& a) {
  SeenPlaces out;
  for (const EscapeRoute& route : scene.routes) {
    const auto people = walkers(route, scene.assessment.spacing_m);
    for (const Walker& walker : people)
      for (const double height : scene.assessment.eye_heights_m)
        out[{"route \"" + route.name + "\"", walker.along_m, height}].stands_for =
            length_of(route) / static_cast<double>(people.size());
  }
  for (const SightRow& row : a.sights) {
    const auto at = out.find({row.from, row.along_m, row.height_m});
    if (at == out.end() || !(row.gaze_deg <= ahead_deg)) continue;
    Seen& seen = at->second;
    if (row.sight.verdict == SightVerdict::legible) seen.read = Read::a_sign;
    if (row.sight.verdict == SightVerdict::undecided)
      seen.read = std::max(seen.read, Read::undecided);
  }
  return out;
}

/// Of the places that `counts` names.
LegibleShare share_of(const SeenPlaces& places, const std::function<bool(const Place&)>& counts) {
  double all = 0, read = 0, perhaps = 0;
  for (const auto& [place, seen] : places) {
    if (!counts(place)) continue;
    all += seen.stands_for;
    if (seen.read == Read::a_sign) read += seen.stands_for;
    if (seen.read == Read::undecided) perhaps += seen.stands_for;
  }
  if (!(all > 0)) return {};
  return {read / all, (read + perhaps) / all};
}

std::shared_ptr<const SceneDescription> with_bright_signs(const SceneDescription& scene) {
  auto out = std::make_shared<SceneDescription>(scene);
  for (Sign& sign : out->signs)
    for (SignState* state : {&sign.mains, &sign.emergency}) {
      state->white_cd_m2 *= brighter_signs;
      state->green_cd_m2 *= brighter_signs;
    }
  return out;
}

bool costs_no_more(const JudgedLayout& a, const JudgedLayout& b) {
  return a.objective <= b.objective * (1 + 1e-9);
}

/// Whether `a` is read at least as well for no more, whatever the undecided views are.
bool beats(const JudgedLayout& a, const JudgedLayout& b) {
  if (!costs_no_more(a, b) || a.worst().least < b.worst().most) return false;
  return a.objective < b.objective * (1 - 1e-9) || a.worst().least > b.worst().least;
}

/// Layouts are beside each other with the same signs.
bool like_signs(const JudgedLayout& a, const JudgedLayout& b) {
  return a.sign_factor == b.sign_factor && a.low_signs.size() == b.low_signs.size();
}

/// Signs near the floor, where smoke is often thinner. Nothing where no wall has room for any.
Result<std::optional<JudgedLayout>> with_signs_below(const JudgedLayout& best,
                                                     const SmokeStageOptions& options) {
  const SceneDescription& scene = *best.layout.variant;
  const auto scenario = find_scenario(scene, options.scenarios.front());
  if (!scenario) return scenario.problem();
  const auto building = Building::make(code_scene(scene, false),
                                       code_scenario(scene, scenario.value()), options.threads);
  if (!building) return building.problem();
  JudgedLayout out = best;
  out.name += " low";
  out.low_signs = low_signs_of(scene, *building.value());
  if (out.low_signs.empty()) return std::optional<JudgedLayout>();
  out.layout.variant =
      std::make_shared<const SceneDescription>(with_low_signs(scene, out.low_signs));
  return std::optional(std::move(out));
}

class Race {
 public:
  Race(SmokeStage& stage, const SmokeStageOptions& options, const std::atomic<bool>& interrupt,
       const std::function<void(const std::string&)>& progress)
      : stage_(stage),
        options_(options),
        interrupt_(interrupt),
        progress_(progress),
        places_(stage.layouts.size()) {}

  Result<void> run() {
    for (int rounds = 1; rounds <= options_.rounds && !interrupt_; ++rounds)
      for (size_t i = 0; i < stage_.layouts.size() && !interrupt_; ++i) {
        if (rounds > 1 && !is_open(stage_.layouts[i])) continue;
        if (auto ok = judge(i, rounds); !ok && !interrupt_) return ok.problem();
      }
    stage_.interrupted = interrupt_;
    for (size_t i = 0; i < stage_.layouts.size(); ++i) compare(i);
    std::erase_if(stage_.layouts, [](const JudgedLayout& one) { return one.rounds == 0; });
    return {};
  }

 private:
  /// Whether more paths could change its place among the others.
  bool is_open(const JudgedLayout& one) const {
    const LegibleShare share = one.worst();
    return share.least < share.most && std::none_of(stage_.layouts.begin(), stage_.layouts.end(),
                                                    [&](const JudgedLayout& other) {
                                                      return like_signs(other, one) &&
                                                             beats(other, one);
                                                    });
  }

  Result<void> judge(size_t i, int rounds) {
    JudgedLayout& one = stage_.layouts[i];
    std::vector<SmokeVerdict> smoke;
    std::vector<SeenPlaces> seen;
    for (const std::string& name : stage_.scenarios) {
      progress_(fmt::format("judging layout {} of {} in \"{}\", {} round{} of paths", one.name,
                            stage_.layouts.size(), name, rounds, rounds == 1 ? "" : "s"));
      const auto scenario = find_scenario(*one.layout.variant, name);
      if (!scenario) return scenario.problem();
      AssessOptions asked;
      asked.seed = options_.seed;
      asked.threads = options_.threads;
      asked.rounds = rounds;
      Assessment found;
      const auto ok = assess_sights(
          *one.layout.variant, scenario.value(), {}, asked, interrupt_,
          [](const std::string&, double) {}, found);
      if (!ok) return ok.problem();
      seen.push_back(places_of(*one.layout.variant, found));
      smoke.push_back(verdict_of(name, seen.back()));
    }
    one.smoke = std::move(smoke);
    one.rounds = rounds;
    places_[i] = std::move(seen);
    return {};
  }

  SmokeVerdict verdict_of(const std::string& scenario, const SeenPlaces& places) const {
    SmokeVerdict out{scenario, {}, share_of(places, [](const Place&) { return true; })};
    for (const double height : stage_.heights_m)
      out.by_height.push_back(
          share_of(places, [&](const Place& place) { return std::get<2>(place) == height; }));
    return out;
  }

  /// With the first layout, place by place.
  void compare(size_t i) {
    JudgedLayout& one = stage_.layouts[i];
    one.lost = one.won = 0;
    for (size_t s = 0; s < places_[i].size(); ++s)
      for (const auto& [place, seen] : places_[i][s]) {
        const auto first = places_[0][s].find(place);
        if (first == places_[0][s].end()) continue;
        one.lost += first->second.read == Read::a_sign && seen.read == Read::nothing;
        one.won += first->second.read == Read::nothing && seen.read == Read::a_sign;
      }
  }

  SmokeStage& stage_;
  const SmokeStageOptions& options_;
  const std::atomic<bool>& interrupt_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<std::vector<SeenPlaces>> places_;  // of each layout, by scenario
};

/// Which layouts with signs as they are none of the others beats.
void mark_front(SmokeStage& stage) {
  for (JudgedLayout& one : stage.layouts)
    one.on_front =
        one.has_usual_signs() &&
        std::none_of(stage.layouts.begin(), stage.layouts.end(), [&](const JudgedLayout& other) {
          return other.has_usual_signs() && beats(other, one);
        });
}

}  // namespace

LegibleShare JudgedLayout::worst() const {
  LegibleShare out{1, 1};
  for (const SmokeVerdict& verdict : smoke) {
    out.least = std::min(out.least, verdict.all.least);
    out.most = std::min(out.most, verdict.all.most);
  }
  return out;
}

const JudgedLayout& SmokeStage::recommended() const {
  const JudgedLayout* best = &layouts.front();
  for (const JudgedLayout& one : layouts) {
    if (!one.has_usual_signs()) continue;
    const bool surely_better = one.worst().least > best->worst().most;
    const bool as_good_and_cheaper =
        one.worst().least >= best->worst().most && one.objective < best->objective;
    if (surely_better || as_good_and_cheaper) best = &one;
  }
  return *best;
}

const JudgedLayout* SmokeStage::with_brighter_signs() const {
  for (const JudgedLayout& one : layouts)
    if (one.sign_factor != 1) return &one;
  return nullptr;
}

const JudgedLayout* SmokeStage::with_low_signs() const {
  for (const JudgedLayout& one : layouts)
    if (!one.low_signs.empty()) return &one;
  return nullptr;
}

Result<void> check_smoke_stage(const SceneDescription& scene,
                               const std::vector<std::string>& scenarios) {
  for (const std::string& name : scenarios) {
    const auto scenario = find_scenario(scene, name);
    if (!scenario) return scenario.problem();
    if (!has_smoke(scene, scenario.value()))
      return problem_in(scene.file, "scenario \"" + name +
                                        "\" has no smoke: name one that has, or leave out what "
                                        "is to be judged in smoke");
    if (auto ok = irritation_is_said(scene, scenario.value()); !ok) return ok.problem();
  }
  if (scene.routes.empty() || scene.signs.empty())
    return problem_in(scene.file,
                      "to judge layouts in smoke the scene needs routes that people walk and signs "
                      "that they read: add [[route]] and [[sign]]");
  return {};
}

Result<SmokeStage> judge_in_smoke(std::vector<JudgedLayout> layouts,
                                  const SmokeStageOptions& options,
                                  const std::atomic<bool>& interrupt,
                                  const std::function<void(const std::string&)>& progress) {
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  SmokeStage stage;
  stage.scenarios = options.scenarios;
  stage.heights_m = layouts.front().layout.variant->assessment.eye_heights_m;
  JudgedLayout bright = layouts.front();
  bright.name += "+";
  bright.sign_factor = brighter_signs;
  bright.layout.variant = with_bright_signs(*bright.layout.variant);
  auto low = with_signs_below(layouts.front(), options);
  if (!low) return low.problem();
  stage.layouts = std::move(layouts);
  stage.layouts.push_back(std::move(bright));
  if (low.value()) stage.layouts.push_back(*std::move(low).value());
  if (auto ok = Race(stage, options, interrupt, progress).run(); !ok) return ok.problem();
  mark_front(stage);
  stage.seconds = 1e-9 * static_cast<double>(clock.now() - began);
  return stage;
}

}  // namespace luxodus

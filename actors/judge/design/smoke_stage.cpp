#include "actors/judge/design/smoke_stage.hpp"

#include <algorithm>

#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/design/smoke_race.hpp"
#include "runtime/core/clock.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace {

std::shared_ptr<const SceneDescription> with_bright_signs(const SceneDescription& scene) {
  auto out = std::make_shared<SceneDescription>(scene);
  for (Sign& sign : out->signs) scale_luminances(sign, brighter_signs);
  return out;
}

/// A copy of the best layout with low-level signs, where smoke is often thinner. None if no wall
/// has room for any.
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

PeopleQuestion question_of(const SmokeStageOptions& options) {
  return {options.people, {}, options.scenarios, options.scene_at, options.seed, options.threads};
}

/// Share of the time for the elimination rounds, if more follows them; and until the end of
/// following people, if guidance over time comes after it.
constexpr double share_of_race = 0.6, share_of_people = 0.85;

/// Runs the elimination rounds, follows people, and finds the guidance over time, within a time.
class Stage {
 public:
  Stage(SmokeStage& stage, const SmokeStageOptions& options, const std::atomic<bool>& interrupt,
        const std::function<void(const std::string&)>& progress)
      : stage_(stage), options_(options), interrupt_(interrupt), progress_(progress) {}

  /// Errors: as SmokeRace::run, people_unread and guidance_of, except for the end of the time and
  /// an interrupt.
  Result<void> run() {
    const std::vector<LayoutGroup> groups =
        layout_groups_of(stage_.layouts, stage_.scenarios.size(), options_.together);
    stage_.traces = groups.size();
    if (can_follow(groups)) stage_.times_s = times_of(*groups.front().base->time);
    const bool followed = !stage_.times_s.empty(), people = !options_.people.empty();
    seconds_ = followed || people ? share_of_race * options_.seconds : options_.seconds;
    stops();
    const std::function<void(const std::string&)> tell = [&](const std::string& what) {
      stops();
      progress_(what);
    };
    const auto finished = SmokeRace(stage_, groups, options_, stopped_, tell).run();
    if (!finished) return finished.problem();
    if (!finished.value()) stage_.end = interrupt_ ? RaceEnd::interrupted : RaceEnd::time;
    stage_.seconds = seconds();
    if (people && !interrupt_ && any_judged()) {
      limit(followed ? share_of_people : 1);
      if (auto ok = follow_people(tell); !ok) return ok;
    }
    if (!followed) return {};
    if (interrupt_ || !any_judged()) {
      stage_.times_s.clear();
      return {};
    }
    limit(1);
    return follow(groups, tell);
  }

 private:
  double seconds() const { return 1e-9 * static_cast<double>(clock_.now() - began_); }
  void stops() {
    if (interrupt_ || seconds() > seconds_) stopped_ = true;
  }

  /// Lets what follows go on until this share of the time is over.
  void limit(double share) {
    seconds_ = share * options_.seconds;
    stopped_ = false;
  }

  bool any_judged() const {
    return std::any_of(stage_.layouts.begin(), stage_.layouts.end(),
                       [](const JudgedLayout& one) { return one.rounds > 0; });
  }

  bool can_follow(const std::vector<LayoutGroup>& groups) const {
    const SceneDescription& scene = *groups.front().base;
    return options_.scene_at && scene.time && times_of(*scene.time).size() > 1 &&
           check_guidance(scene).ok();
  }

  /// Sets what people read with every judged layout, or with none if time is up or the user
  /// interrupts.
  Result<void> follow_people(const std::function<void(const std::string&)>& tell) {
    const PeopleQuestion asked = question_of(options_);
    for (JudgedLayout& one : stage_.layouts) {
      if (one.rounds == 0) continue;
      const auto found =
          people_unread(one.layout.variant, asked, stopped_, [&](const std::string& what, double) {
            tell("following people with layout " + one.name + ", " + what);
          });
      if (!found && !stopped_) return found.problem();
      if (!found) {
        for (JudgedLayout& other : stage_.layouts) other.people.reset();
        return {};
      }
      one.people = found.value();
    }
    stage_.seconds = seconds();
    return {};
  }

  /// Sets the guidance of every layout, or of none if time is up or the user interrupts. `end` of
  /// the elimination rounds is kept.
  Result<void> follow(const std::vector<LayoutGroup>& groups,
                      const std::function<void(const std::string&)>& tell) {
    GuidanceOptions asked;
    asked.times_s = stage_.times_s;
    asked.scene_at = options_.scene_at;
    asked.asked.seed = options_.seed;
    asked.asked.threads = options_.threads;
    asked.rounds = options_.rounds;
    asked.scenarios = stage_.scenarios;
    auto found =
        guidance_of(groups, stage_.layouts.size(), asked, stopped_,
                    [&](const std::string& what, double) { tell("following layouts in " + what); });
    if (!found && !stopped_) return found.problem();
    if (!found) {
      stage_.times_s.clear();
      return {};
    }
    for (size_t i = 0; i < stage_.layouts.size(); ++i)
      stage_.layouts[i].guided = std::move(found.value()[i]);
    stage_.seconds = seconds();
    return {};
  }

  SmokeStage& stage_;
  const SmokeStageOptions& options_;
  const std::atomic<bool>& interrupt_;
  const std::function<void(const std::string&)>& progress_;
  const SystemClock clock_;
  const Nanoseconds began_ = clock_.now();
  double seconds_ = 0;  // after which it stops
  std::atomic<bool> stopped_{false};
};

/// Marks layouts with unchanged signs that no other one dominates.
void mark_front(SmokeStage& stage) {
  for (JudgedLayout& one : stage.layouts)
    one.on_front =
        one.has_usual_signs() &&
        std::none_of(stage.layouts.begin(), stage.layouts.end(), [&](const JudgedLayout& other) {
          return other.has_usual_signs() && beats(other, one);
        });
}

}  // namespace

const char* name_of(RaceEnd end) {
  switch (end) {
    case RaceEnd::decided:
      return "decided";
    case RaceEnd::rounds:
      return "rounds";
    case RaceEnd::time:
      return "time";
    case RaceEnd::interrupted:
      return "interrupted";
  }
  return "";
}

LegibleShare JudgedLayout::worst() const {
  LegibleShare out{1, 1};
  for (const SmokeVerdict& verdict : smoke) {
    out.least = std::min(out.least, verdict.all.least);
    out.most = std::min(out.most, verdict.all.most);
  }
  return out;
}

ShareDifference JudgedLayout::beyond_first() const {
  if (smoke.empty()) return {};
  ShareDifference out = smoke.front().beyond_first;
  for (const SmokeVerdict& verdict : smoke) {
    out.least = std::min(out.least, verdict.beyond_first.least);
    out.most = std::max(out.most, verdict.beyond_first.most);
  }
  return out;
}

ShareDifference difference_of(const JudgedLayout& from, const JudgedLayout& to) {
  return both_of(by_ranges(from.worst(), to.worst()),
                 chained(from.beyond_first(), to.beyond_first()));
}

const JudgedLayout& SmokeStage::recommended() const {
  const JudgedLayout* best = &layouts.front();
  for (const JudgedLayout& one : layouts) {
    if (!one.has_usual_signs()) continue;
    if (best->people && one.people) {
      const bool no_longer = one.people->surely_no_more_than(*best->people);
      if (best->people->surely_more_than(*one.people) ||
          (no_longer && one.objective < best->objective))
        best = &one;
      continue;
    }
    const ShareDifference beyond = difference_of(*best, one);
    const bool as_good_and_cheaper = beyond.surely_no_less() && one.objective < best->objective;
    if (beyond.surely_more() || as_good_and_cheaper) best = &one;
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

Result<void> check_smoke_stage(const std::shared_ptr<const SceneDescription>& described,
                               const SmokeStageOptions& options) {
  const SceneDescription& scene = *described;
  for (const std::string& name : options.scenarios) {
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
  return options.people.empty() ? Result<void>()
                                : check_followed_people(described, question_of(options));
}

Result<SmokeStage> judge_in_smoke(std::vector<JudgedLayout> layouts,
                                  const SmokeStageOptions& options,
                                  const std::atomic<bool>& interrupt,
                                  const std::function<void(const std::string&)>& progress) {
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
  if (auto ok = Stage(stage, options, interrupt, progress).run(); !ok) return ok.problem();
  std::erase_if(stage.layouts, [](const JudgedLayout& one) { return one.rounds == 0; });
  mark_front(stage);
  return stage;
}

}  // namespace luxodus

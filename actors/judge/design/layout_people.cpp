#include "actors/judge/design/layout_people.hpp"

#include <algorithm>

#include "actors/judge/walk/walk_scene.hpp"

namespace luxodus {

namespace {

/// The building at another time, with the luminaires and signs of a layout.
SceneAtTime with_layout(const std::shared_ptr<const SceneDescription>& variant,
                        const SceneAtTime& scene_at) {
  return [variant, scene_at](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    const auto then = scene_at(at_s);
    if (!then) return then.problem();
    auto out = std::make_shared<SceneDescription>(*then.value());
    out->emitters = variant->emitters;
    out->signs = variant->signs;
    return std::shared_ptr<const SceneDescription>(std::move(out));
  };
}

StatesToAssess states_with(const std::shared_ptr<const SceneDescription>& variant,
                           const SceneAtTime& scene_at) {
  StatesToAssess out{variant, {}, {}};
  if (!scene_at || !variant->time) return out;
  out.times_s = times_of(*variant->time);
  out.reader = with_layout(variant, scene_at);
  return out;
}

WalkRequest request_of(const std::shared_ptr<const SceneDescription>& variant,
                       const PeopleQuestion& question, const std::string& scenario) {
  WalkRequest out{.states = states_with(variant, question.scene_at),
                  .options = {},
                  .walk = question.walk,
                  .people = question.people};
  out.options.scenario = scenario;
  out.options.seed = question.seed;
  out.options.threads = question.threads;
  return out;
}

PeopleUnread unread_in(const std::vector<WalkedPerson>& walks, double step_s) {
  PeopleUnread out;
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) {
      out.all_s += step_s;
      if (step.reads()) continue;
      out.most_s += step_s;
      if (step.count(SignAnswer::undecided) == 0) out.least_s += step_s;
    }
  return out;
}

}  // namespace

Result<void> check_followed_people(const std::shared_ptr<const SceneDescription>& scene,
                                   const PeopleQuestion& question) {
  for (const std::string& scenario : question.scenarios)
    if (const auto walls = check_walk(request_of(scene, question, scenario)); !walls)
      return walls.problem();
  return {};
}

Result<PeopleUnread> people_unread(const std::shared_ptr<const SceneDescription>& variant,
                                   const PeopleQuestion& question,
                                   const std::atomic<bool>& interrupt,
                                   const AssessProgress& progress) {
  PeopleUnread worst;
  for (const std::string& scenario : question.scenarios) {
    const auto walked = walk_scene(request_of(variant, question, scenario), interrupt, progress);
    if (!walked) return walked.problem();
    const PeopleUnread here = unread_in(walked->walks, question.walk.step_s);
    worst.all_s = here.all_s;
    worst.least_s = std::max(worst.least_s, here.least_s);
    worst.most_s = std::max(worst.most_s, here.most_s);
  }
  return worst;
}

}  // namespace luxodus

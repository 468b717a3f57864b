// People who come from differently lit places have eyes that are adapted differently. So each
// stated luminance before has estimates of its own, from a scene that states it.
#include "actors/judge/walk/walk_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "actors/judge/inspect/building.hpp"
#include "actors/judge/visibility_map/sign_estimates.hpp"
#include "actors/judge/walk/eye_smoke.hpp"

namespace luxodus {

namespace {

/// Share of the work that goes into estimates of signs; the rest is for smoke.
constexpr double signs_share = 0.95;

Result<void> check_times(const WalkRequest& request) {
  const auto& times = request.states.times_s;
  if (times.size() < 2) return {};
  for (const PlacedPerson& one : request.people)
    if (one.times_s.front() < times.front() || one.times_s.back() > times.back())
      return problem_in(
          request.states.last->file,
          fmt::format("person {} of \"{}\" is in the building from {:g} to {:g} s, and the scene "
                      "is from {:g} to {:g} s: state time_shift_s in [[people]], or other times in "
                      "[time]",
                      one.id, one.group, one.times_s.front(), one.times_s.back(), times.front(),
                      times.back()));
  return {};
}

/// The scene of people who come from a view of this luminance.
std::shared_ptr<const SceneDescription> coming_from(
    const std::shared_ptr<const SceneDescription>& scene, double luminance_cd_m2) {
  if (scene->assessment.luminance_before_cd_m2 == luminance_cd_m2) return scene;
  auto out = std::make_shared<SceneDescription>(*scene);
  out->assessment.luminance_before_cd_m2 = luminance_cd_m2;
  return out;
}

StatesToAssess states_from(const StatesToAssess& states, double luminance_cd_m2) {
  StatesToAssess out = states;
  out.last = coming_from(states.last, luminance_cd_m2);
  // One state holds at all times.
  if (out.times_s.size() < 2) out.times_s.clear();
  out.reader = [&states,
                luminance_cd_m2](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    auto scene = states.reader(at_s);
    if (!scene) return scene;
    return coming_from(scene.value(), luminance_cd_m2);
  };
  return out;
}

class SceneWalk {
 public:
  SceneWalk(const WalkRequest& request, const std::atomic<bool>& interrupt,
            const AssessProgress& progress)
      : request_(request), interrupt_(interrupt), progress_(progress) {}

  Result<WalkOfScene> run() {
    const auto walls = check_walk(request_);
    if (!walls) return walls.problem();
    const SceneDescription& scene = *request_.states.last;
    const auto scenario = judged_scenario(scene, request_.options.scenario);
    if (!scenario) return scenario.problem();
    out_.scenario = scenario->name;
    out_.walls = walls.value();
    if (request_.states.times_s.size() > 1) out_.times_s = request_.states.times_s;
    out_.walks = begin_walks(request_.people, request_.walk);
    eyes_ = eyes_of(out_.walks);
    if (auto ok = find_answers(); !ok) return ok.problem();
    if (auto ok = measure_smoke(); !ok) return ok.problem();
    look(scene, request_.people, request_.walk, found_, failure_of(scene, scenario.value()),
         out_.walks);
    progress_("all people", 1);
    return std::move(out_);
  }

 private:
  static MainsFailure failure_of(const SceneDescription& scene, const Scenario& scenario) {
    MainsFailure out;
    if (scene.time) out.at_s = scene.time->mains_fail_at_s;
    if (!out.at_s && scenario.operation != Operation::mains && scenario.says_seconds)
      out.since_s = scenario.seconds_after_failure;
    return out;
  }

  /// Numbers of the eyes of people who come from a view of this luminance.
  std::map<double, std::vector<size_t>> eyes_by_luminance() const {
    std::map<double, std::vector<size_t>> out;
    size_t eye = 0;
    for (const WalkedPerson& walked : out_.walks)
      for (size_t i = 0; i < walked.steps.size(); ++i)
        out[request_.people[walked.person].luminance_before_cd_m2].push_back(eye++);
    return out;
  }

  Result<void> find_answers() {
    const size_t signs = request_.states.last->signs.size();
    found_.answers.resize(eyes_.size() * signs);
    const auto groups = eyes_by_luminance();
    double done = 0;
    for (const auto& [luminance, numbers] : groups) {
      std::vector<TimedEye> eyes;
      EstimateRequest asked{.states = states_from(request_.states, luminance),
                            .options = request_.options.one_of(groups.size()),
                            .signs = {},
                            .eyes = {}};
      asked.options.scenario = out_.scenario;
      for (const size_t eye : numbers) {
        eyes.push_back(eyes_[eye]);
        asked.eyes.push_back(eyes_[eye].eye);
      }
      const double share = static_cast<double>(numbers.size()) / static_cast<double>(eyes_.size());
      const auto made =
          SignEstimates::make(asked, interrupt_, [&](const std::string& what, double part) {
            progress_(what, signs_share * (done + share * part));
          });
      if (!made) return made.problem();
      const SignEstimates& estimates = *made.value();
      const auto given = estimates.at(eyes);
      for (size_t i = 0; i < numbers.size(); ++i)
        for (size_t s = 0; s < signs; ++s)
          found_.answers[numbers[i] * signs + s] = given[i * signs + s].answer;
      out_.sure_errors = std::max(out_.sure_errors, estimates.sure_errors());
      done += share;
    }
    return {};
  }

  /// Extinction at each eye: linear between the two states around its time.
  Result<void> measure_smoke() {
    found_.extinctions.assign(eyes_.size(), 0);
    const std::vector<double> times = out_.times_s.empty() ? std::vector<double>{0} : out_.times_s;
    for (size_t t = 0; t < times.size(); ++t) {
      auto scene = out_.times_s.empty()
                       ? Result<std::shared_ptr<const SceneDescription>>(request_.states.last)
                       : request_.states.reader(times[t]);
      if (!scene) return scene.problem();
      const auto scenario = judged_scenario(*scene.value(), out_.scenario);
      if (!scenario) return scenario.problem();
      if (auto ok = measure_state(*scene.value(), scenario.value(), times, t); !ok) return ok;
      if (interrupt_) return problem("interrupted");
      progress_("smoke at eyes", signs_share + (1 - signs_share) * static_cast<double>(t + 1) /
                                                   static_cast<double>(times.size()));
    }
    return {};
  }

  Result<void> measure_state(const SceneDescription& scene, const Scenario& scenario,
                             const std::vector<double>& times, size_t t) {
    if (!has_smoke(scene, scenario)) return {};
    const auto made =
        Building::make(without_measurements(scene), scenario, request_.options.threads);
    if (!made) return made.problem();
    const Building& building = *made.value();
    building.each(eyes_.size(), [&](const GeometryAccess& access, size_t i) {
      const double weight = weight_of_state(times, t, eyes_[i].time_s);
      if (weight == 0) return;
      found_.extinctions[i] += weight * extinction_at_eye(building, access, eyes_[i].eye);
    });
    return {};
  }

  const WalkRequest& request_;
  const std::atomic<bool>& interrupt_;
  const AssessProgress& progress_;
  WalkOfScene out_;
  std::vector<TimedEye> eyes_;
  FoundAtEyes found_;
};

}  // namespace

Result<WallCheck> check_walk(const WalkRequest& request) {
  const SceneDescription& scene = *request.states.last;
  const auto scenario = judged_scenario(scene, request.options.scenario);
  if (!scenario) return scenario.problem();
  if (scene.signs.empty())
    return problem_in(scene.file, "there is no sign in this scene that people could read");
  if (auto ok = check_times(request); !ok) return ok.problem();
  if (auto ok = check_steps(request.people, request.walk.step_s, scene.file); !ok)
    return ok.problem();
  return check_walls(scene, scenario.value(), request.people, request.options.threads);
}

Result<WalkOfScene> walk_scene(const WalkRequest& request, const std::atomic<bool>& interrupt,
                               const AssessProgress& progress) {
  return SceneWalk(request, interrupt, progress).run();
}

}  // namespace luxodus

#include "actors/judge/walkers/scene_eyes.hpp"

#include <algorithm>

#include "actors/judge/walk/eye_smoke.hpp"

namespace luxodus {

SceneEyes::SceneEyes(const EyesRequest& request) : request_(request) {
  times_s_ = request.states.times_s.size() > 1 ? request.states.times_s : std::vector<double>{0};
}

Result<std::unique_ptr<SceneEyes>> SceneEyes::make(const EyesRequest& request,
                                                   const std::atomic<bool>& interrupt,
                                                   const AssessProgress& progress) {
  std::unique_ptr<SceneEyes> out(new SceneEyes(request));
  if (request.signs.empty()) return out;
  EstimateRequest asked{.states = request.states,
                        .options = request.options,
                        .signs = request.signs,
                        .eyes = request.eyes};
  // One state holds at all times.
  if (asked.states.times_s.size() < 2) asked.states.times_s.clear();
  auto made = SignEstimates::make(asked, interrupt, progress);
  if (!made) return made.problem();
  out->estimates_ = std::move(made).value();
  return out;
}

Result<FoundByEyes> SceneEyes::find(double time_s, const std::vector<glm::dvec3>& eyes) {
  FoundByEyes out;
  if (estimates_) {
    std::vector<TimedEye> timed;
    for (const glm::dvec3& eye : eyes) timed.push_back({time_s, eye});
    for (const SignEstimate& estimate : estimates_->at(timed))
      out.answers.push_back(estimate.answer);
  }
  auto smoke = extinctions(time_s, eyes);
  if (!smoke) return smoke.problem();
  out.extinctions = std::move(smoke).value();
  return out;
}

/// Linear between the two states around the time.
Result<std::vector<double>> SceneEyes::extinctions(double time_s,
                                                   const std::vector<glm::dvec3>& eyes) {
  std::vector<double> out(eyes.size(), 0);
  for (size_t state = 0; state < times_s_.size(); ++state) {
    const double weight = weight_of_state(times_s_, state, time_s);
    if (weight == 0) continue;
    const auto building = smoke_of(state);
    if (!building) return building.problem();
    const Building* smoky = building.value();
    if (smoky == nullptr) continue;
    smoky->each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
      out[i] += weight * extinction_at_eye(*smoky, access, eyes[i]);
    });
  }
  return out;
}

/// At most two states are kept: the earliest goes, since times do not descend.
Result<const Building*> SceneEyes::smoke_of(size_t state) {
  const auto kept = std::find_if(smoke_.begin(), smoke_.end(),
                                 [&](const Smoke& one) { return one.state == state; });
  if (kept != smoke_.end()) return kept->building.get();
  auto scene = times_s_.size() == 1
                   ? Result<std::shared_ptr<const SceneDescription>>(request_.states.last)
                   : request_.states.reader(times_s_[state]);
  if (!scene) return scene.problem();
  const auto scenario = judged_scenario(*scene.value(), request_.options.scenario);
  if (!scenario) return scenario.problem();
  Smoke made{state, nullptr};
  if (has_smoke(*scene.value(), scenario.value())) {
    auto building = Building::make(without_measurements(*scene.value()), scenario.value(),
                                   request_.options.threads);
    if (!building) return building.problem();
    made.building = std::move(building).value();
  }
  if (smoke_.size() == 2) smoke_.erase(smoke_.begin());
  smoke_.push_back(std::move(made));
  return smoke_.back().building.get();
}

}  // namespace luxodus

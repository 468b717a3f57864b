#include "actors/assess/round_state.hpp"

#include "actors/assess/assessment.hpp"
#include "actors/inspect/building.hpp"
#include "actors/output/json_out.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus {

namespace {

// What is not there or of another type is thrown by Json, and caught below.

glm::dvec3 vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Observer observer_of(const Json& one) {
  Observer out;
  out.name = one.at("name").get<std::string>();
  out.eye = vector_of(one.at("eye"));
  out.gaze = vector_of(one.at("gaze"));
  out.signs.emplace();
  for (const Json& sign : one.at("signs")) out.signs->push_back(sign.get<uint32_t>());
  return out;
}

}  // namespace

std::string round_text(const RoundState& round) {
  Json observers = Json::array();
  for (const Observer& observer : round.observers) {
    Json signs = Json::array();
    for (const uint32_t sign : *observer.signs) signs.push_back(sign);
    observers.push_back({{"name", observer.name},
                         {"eye", vector_json(observer.eye)},
                         {"gaze", vector_json(observer.gaze)},
                         {"signs", std::move(signs)}});
  }
  const Json object = {{"scenario", round.scenario},
                       {"smoke_factor", round.smoke_factor},
                       {"eye_path_factor", round.eye_path_factor},
                       {"observers", std::move(observers)}};
  return object.dump();
}

Result<RoundState> parse_round(const std::string& text) try {
  const Json object = Json::parse(text);
  RoundState out;
  out.scenario = object.at("scenario").get<std::string>();
  out.smoke_factor = object.at("smoke_factor").get<double>();
  out.eye_path_factor = object.at("eye_path_factor").get<double>();
  if (object.at("observers").size() > limits::sights)
    return problem("a round of an assessment has too many observers");
  for (const Json& one : object.at("observers")) out.observers.push_back(observer_of(one));
  return out;
} catch (const Json::exception& e) {
  return problem(std::string("this is no round of an assessment: ") + e.what());
}

Scenario thickened(Scenario scenario, double factor) {
  scenario.smoke_factor *= factor;
  for (Scenario::Factor& medium : scenario.media) medium.factor *= factor;
  return scenario;
}

Result<JudgedScene> judged_scene(const SceneDescription& scene, const Scenario& scenario) {
  JudgedScene out{scenario, without_measurements(scene), {}};
  auto ageing = group_by_ageing(out.scene, scenario.operation);
  if (!ageing) return ageing.problem();
  out.ageing = std::move(ageing).value();
  return out;
}

Result<std::shared_ptr<const CompiledScene>> compile_round(const JudgedScene& judged,
                                                           const RoundState& round) {
  auto scene = std::make_shared<SceneDescription>(judged.scene);
  scene->observers = round.observers;
  for (Observer& observer : scene->observers)
    for (const uint32_t sign : *observer.signs)
      if (sign >= scene->signs.size())
        return problem("a round of an assessment asks about a sign that the scene has not");
  scene->run.batch_particles = limits::round_batch_particles;
  scene->run.eye_path_factor = round.eye_path_factor;
  return compile_scene(std::move(scene), judged.scenario, {});
}

Result<std::shared_ptr<const TracedState>> RoundStates::make(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (state_ && text == text_) return state_;
  const auto round = parse_round(text);
  if (!round) return round.problem();
  const auto scenario = find_scenario(*scene_, round->scenario);
  if (!scenario) return scenario.problem();
  const auto judged = judged_scene(*scene_, thickened(scenario.value(), round->smoke_factor));
  if (!judged) return judged.problem();
  auto scene = compile_round(judged.value(), round.value());
  if (!scene) return scene.problem();
  auto state = std::make_shared<TracedState>(std::move(scene).value());
  state->is_run = true;
  state_ = std::move(state);
  text_ = text;
  return state_;
}

}  // namespace luxodus

#include "actors/judge/assess/round_state.hpp"

#include <algorithm>
#include <map>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/inspect/building.hpp"
#include "actors/results/formats/json_out.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Raises the extinction of simulated smoke by its largest error. All grids of a simulation have
/// one name.
void thicken_by_errors(const SceneDescription& scene, Scenario& scenario) {
  std::map<std::string, double> denser;
  for (const Medium& medium : scene.media) {
    if (!medium.simulation || medium.simulation->depth_error == 0) continue;
    double& most = denser[medium.name];
    most =
        std::max(most, factor_of_medium(scenario, medium) * (1 + medium.simulation->depth_error));
  }
  std::erase_if(scenario.media, [&](const auto& one) { return denser.contains(one.name); });
  for (const auto& [name, factor] : denser) scenario.media.push_back({name, factor});
}

/// Sets the albedo of all smoke; flames keep theirs.
void set_albedo(SceneDescription& scene, double albedo) {
  for_each_smoke(scene, [&](SmokeOptics& optics) { optics.albedo = Spectrum::constant(albedo); });
  for (Medium& medium : scene.media)
    if (!is_flame(medium)) medium.data.albedo.clear();
}

/// Name of a group that ageing does not give.
constexpr const char* signs_group = "signs";

/// Difference of two mixtures of the same groups.
GroupMixture minus(const GroupMixture& light, const GroupMixture& other) {
  GroupMixture out;
  for (const GroupMixture* one : {&light, &other})
    for (const auto& [group, factor] : one->factors)
      out.factors[group] = light.factor_of(group) - other.factor_of(group);
  out.of_others = light.of_others - other.of_others;
  return out;
}

// Json throws if a value is missing or of another type; parse_round catches it.

glm::dvec3 vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

std::optional<double> maybe_number(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
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
  const OtherSmoke& smoke = round.smoke;
  const Json object = {{"scenario", round.scenario},
                       {"at_s", round.at_s ? Json(*round.at_s) : Json()},
                       {"smoke_factor", smoke.factor},
                       {"albedo", smoke.albedo ? Json(*smoke.albedo) : Json()},
                       {"by_errors", smoke.by_errors},
                       {"signs_apart", round.signs_apart},
                       {"eye_path_factor", round.eye_path_factor},
                       {"observers", std::move(observers)}};
  return object.dump();
}

Result<RoundState> parse_round(const std::string& text) try {
  const Json object = Json::parse(text);
  RoundState out;
  out.scenario = object.at("scenario").get<std::string>();
  out.at_s = maybe_number(object.at("at_s"));
  out.smoke.factor = object.at("smoke_factor").get<double>();
  out.smoke.albedo = maybe_number(object.at("albedo"));
  out.smoke.by_errors = object.at("by_errors").get<bool>();
  out.signs_apart = object.at("signs_apart").get<bool>();
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

Result<JudgedScene> judged_scene(const SceneDescription& scene, const Scenario& scenario,
                                 const OtherSmoke& smoke) {
  JudgedScene out{thickened(scenario, smoke.factor), without_measurements(scene), {}, {}};
  if (smoke.by_errors) thicken_by_errors(scene, out.scenario);
  if (smoke.albedo) set_albedo(out.scene, *smoke.albedo);
  auto ageing = group_by_ageing(out.scene, scenario.operation);
  if (!ageing) return ageing.problem();
  out.ageing = std::move(ageing).value();
  out.lights = {{{}, out.ageing.renewal()}};
  return out;
}

Result<JudgedScene> judged_with_signs_apart(const SceneDescription& scene, const Scenario& scenario,
                                            const OtherSmoke& smoke) {
  auto out = judged_scene(scene, scenario, smoke);
  if (!out) return out;
  out->lights.push_back(out->lights.front());
  scale_signs(out.value(), {1, 0});
  out->signs_apart = true;
  return out;
}

void scale_signs(JudgedScene& judged, const std::vector<double>& factors) {
  for (Sign& sign : judged.scene.signs) sign.group = signs_group;
  for (size_t light = 0; light < judged.lights.size(); ++light)
    for (GroupMixture* mixture : {&judged.lights[light].aged, &judged.lights[light].as_new})
      mixture->factors[signs_group] = factors[light];
}

std::vector<GroupMixture> JudgedScene::mixtures() const {
  std::vector<GroupMixture> out;
  for (const JudgedLight& light : lights) {
    out.push_back(light.aged);
    if (ageing.any()) out.push_back(light.as_new);
  }
  const JudgedLight& first = lights.front();
  for (size_t light = 1; light < lights.size(); ++light) {
    out.push_back(minus(lights[light].aged, first.aged));
    if (ageing.any()) out.push_back(minus(lights[light].as_new, first.as_new));
  }
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
  CompileOptions options;
  const bool as_it_is = judged.lights.size() == 1 && !judged.ageing.any();
  if (!as_it_is) options.mixtures = judged.mixtures();
  return compile_scene(std::move(scene), judged.scenario, options);
}

Result<std::shared_ptr<const TracedState>> RoundStates::make(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (state_ && text == text_) return state_;
  const auto round = parse_round(text);
  if (!round) return round.problem();
  const auto described = scenes_.at(round->at_s);
  if (!described) return described.problem();
  const auto scenario = find_scenario(*described.value(), round->scenario);
  if (!scenario) return scenario.problem();
  const auto make = round->signs_apart ? judged_with_signs_apart : judged_scene;
  const auto judged = make(*described.value(), scenario.value(), round->smoke);
  if (!judged) return judged.problem();
  auto scene = compile_round(judged.value(), round.value());
  if (!scene) return scene.problem();
  state_ = std::make_shared<ParticleState>(std::move(scene).value(), BatchNumbers::of_run);
  text_ = text;
  return state_;
}

}  // namespace luxodus

#include "actors/results/files/run_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

Json lit_json(size_t lit, size_t all) {
  return {{"lit", lit}, {"all", all}};
}

std::string lit_text(const Json& lit, const char* what) {
  const auto all = lit["all"].get<size_t>();
  return fmt::format("{} of {} {}{} lit", lit["lit"].get<size_t>(), all, what, all == 1 ? "" : "s");
}

}  // namespace

Json run_state_json(const CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  const Scenario& scenario = scene.scenario;
  std::set<std::string> luminaires;
  std::set<uint32_t> signs;
  for (const CompiledEmitter& e : scene.emitters) {
    if (std::none_of(e.power_w.begin(), e.power_w.end(), [](double w) { return w > 0; })) continue;
    if (e.sign != none_index)
      signs.insert(scene.signs[e.sign].sign);
    else if (e.medium == none_index)
      luminaires.insert(e.name);
  }
  Json smoke = Json::array(), flames = Json::array();
  std::set<std::string> told;  // the grids of one fire simulation share a name
  for (const Medium& medium : d.media) {
    if (medium.emission && scenario.emission_factor > 0 &&
        std::find(flames.begin(), flames.end(), medium.name) == flames.end())
      flames.push_back(medium.name);
    // A flame is not smoke; a data set of a fire holds both.
    if (medium.emission && medium.kind != MediumKind::data_set) continue;
    const double factor = extinction_factor(scenario, medium.name);
    if (!(factor > 0) || !told.insert(medium.name).second) continue;
    smoke.push_back({{"name", medium.name}, {"extinction_factor", factor}});
    if (medium.simulation) smoke.back()["time_s"] = medium.simulation->time_s;
  }
  const bool failed = scenario.operation != Operation::mains && scenario.says_seconds;
  return {{"scenario", scenario.name},
          {"operation", name_of(scenario.operation)},
          {"after_failure", failed ? exact_json(scenario.seconds_after_failure, "s") : Json()},
          {"luminaires", lit_json(luminaires.size(), d.emitters.size())},
          {"signs", lit_json(signs.size(), d.signs.size())},
          {"smoke", smoke},
          {"flames", flames}};
}

std::string run_state_text(const Json& state) {
  const auto scenario = state["scenario"].get<std::string>();
  const auto operation = state["operation"].get<std::string>();
  std::string text = scenario.empty() ? "" : "scenario \"" + scenario + "\": ";
  text += operation == "dark" ? "all electric light off" : operation + " operation";
  if (state["after_failure"].is_object())
    text += fmt::format(" {:g} s after the failure", state["after_failure"]["value"].get<double>());
  text += "; " + lit_text(state["luminaires"], "luminaire");
  if (state["signs"]["all"].get<size_t>() > 0) text += "; " + lit_text(state["signs"], "sign");
  std::string smoke;
  for (const Json& medium : state["smoke"]) {
    smoke += (smoke.empty() ? "" : ", ") + medium["name"].get<std::string>();
    const auto factor = medium["extinction_factor"].get<double>();
    if (medium.contains("time_s"))
      smoke += fmt::format(" at {:.6g} s", medium["time_s"].get<double>());
    if (factor != 1) smoke += fmt::format(" (times {:g})", factor);
  }
  text += smoke.empty() ? "; no smoke" : "; smoke: " + smoke;
  const size_t flames = state["flames"].size();
  return text + (flames == 0 ? "" : fmt::format("; {} flame{}", flames, flames == 1 ? "" : "s"));
}

}  // namespace luxodus

#include "actors/apps/view/sign_verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

namespace {

constexpr int rounds(VerdictCare care) {
  return care == VerdictCare::provisional ? 1 : 3;
}

/// The building with all changes of viewers, including dimming.
Result<SceneDescription> as_it_stands(const SceneDescription& scene, const SceneEdits& edits,
                                      const std::map<std::string, double>& factors) {
  auto out = dimmed_description(scene, edits, factors);
  if (!out) return out;
  out->observers = scene.observers;
  out->run = scene.run;
  return out;
}

/// The reason, and the light if that decides.
std::string reason_of(const SightRow& row) {
  std::string out = row.sight.reason ? english().remark(*row.sight.reason) : "";
  if (row.other && row.other->sight.verdict != row.sight.verdict)
    out += std::string(out.empty() ? "" : "; ") + "in " + (row.in_new_light ? "new" : "aged") +
           " light; in " + (row.in_new_light ? "aged" : "new") + " light it is " +
           name_of(row.other->sight.verdict);
  return out;
}

/// " Smoke "fire" as at 60.03 s." for each simulation: the time of a frame, while the view may show
/// a state between two.
std::string frames_note(const SceneDescription& scene) {
  std::string out;
  for (const Medium& medium : scene.media)
    if (medium.simulation)
      out += fmt::format(" Smoke \"{}\" as at {:.5g} s.", medium.name, medium.simulation->time_s);
  return out;
}

/// The state that verdicts apply to, and their limits. Its time is that of the view.
std::string state_note(const SceneDescription& scene, const Scenario& scenario) {
  const AssessedState state = state_of(scene, scenario, {});
  if (state.operation == Operation::mains)
    return english()("remark.mains_operation") + std::string(".") + frames_note(scene);
  return fmt::format(
             "{} operation. Light: {}. Eyes are taken as adapted to it: within {:g} s of a failure "
             "of the mains people see less.",
             name_of(state.operation), english().remark(state.light), adapted_after_s) +
         frames_note(scene);
}

}  // namespace

Json sign_verdicts(const SceneDescription& scene, const SceneEdits& edits,
                   const std::map<std::string, double>& factors, const std::string& sign,
                   VerdictCare care, const LiveOptions& options,
                   const std::atomic<bool>& interrupt) {
  const auto refused = [](const std::string& why) -> Json {
    return {{"type", "refused"}, {"why", why}};
  };
  const auto now = as_it_stands(scene, edits, factors);
  if (!now) return refused(now.problem().what);
  if (std::none_of(now->signs.begin(), now->signs.end(),
                   [&](const Sign& s) { return s.name == sign; }))
    return refused("there is no sign \"" + sign + "\"");
  auto scenario = find_scenario(scene, edits.scenario);
  if (!scenario) return refused(scenario.problem().what);
  scenario->seconds_after_failure = 0;  // the factors include the effect of time
  scenario->says_seconds = false;
  AssessOptions asked;
  asked.seed = options.seed;
  asked.threads = options.threads;
  asked.rounds = rounds(care);
  asked.sign = sign;
  Assessment found;
  const auto done = assess_sights(
      now.value(), scenario.value(), {edits.smoke, {}, false}, asked, interrupt,
      [](const std::string&, double) {}, found);
  if (!done) return refused(done.problem().what);
  Json rows = Json::array();
  for (const SightRow& row : found.sights)
    rows.push_back({{"from", english().subject(row.from)},
                    {"along", row.along_m},
                    {"eye_height", row.height_m},
                    {"distance", row.view.distance_m},
                    {"verdict", name_of(row.sight.verdict)},
                    {"reason", reason_of(row)}});
  return {{"type", "sign"},
          {"name", sign},
          {"rows", rows},
          {"provisional", care == VerdictCare::provisional},
          {"note", state_note(now.value(), thickened(scenario.value(), edits.smoke))}};
}

}  // namespace luxodus

// Inspects scenarios and settings of the assessment as written: factors that are percentages,
// emergency states without light, times that exceed batteries and glows or are not stated, smoke
// that is scaled to clear air, people with better than normal sight.
#include <algorithm>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/signs/onset.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

constexpr double hour_s = 3600;
/// The longest rated duration that codes require.
constexpr double max_hours = 3;
constexpr double young_years = 40;
/// Eyes of a walking adult are never lower, and hardly ever higher [m].
constexpr double min_standing_m = 1.4, max_standing_m = 1.9;
constexpr double far_apart_m = 5;
/// High-risk tasks are done in 100 lx and more.
constexpr double min_task_lx = 50;
/// In this extinction, lit signs are visible for 160 m (Jin, 8/K): it hides no sign of a building
/// [1/m].
constexpr double hides_nothing = 0.05;
/// A smaller factor is probably a share written as a percentage.
constexpr double small_factor = 0.1;

void tell_state(const Scenario& s, Severity severity, const std::string& what, Findings& out) {
  out.push_back({severity, "scenario", {s.place, "scenario \"" + s.name + "\" " + what}});
}

void tell_circuit_factors(const Scenario& s, Findings& out) {
  for (const Scenario::Factor& f : s.circuits)
    if (f.factor > 1)
      tell_state(s, Severity::warning,
                 fmt::format("gives the circuit \"{}\" {:g} times its flux: a factor of a circuit "
                             "is a share, 0.8 for 80 %",
                             f.name, f.factor),
                 out);
}

/// Reports emergency luminaires, and signs, that are off in an emergency state.
void tell_switched_off(const SceneDescription& scene, const Scenario& s, Findings& out) {
  if (s.operation != Operation::emergency) return;
  std::string first;
  size_t off = 0, all = 0;
  const auto count = [&](const std::string& name, const std::string& circuit) {
    ++all;
    if (factor_of(s.circuits, circuit, 1) > 0) return;
    if (off++ == 0) first = name;
  };
  for (const Emitter& e : scene.emitters)
    if (e.emergency_flux > 0) count("luminaire \"" + e.name + "\"", e.circuit);
  const size_t luminaires = all;
  for (const Sign& sign : scene.signs)
    if (sign.lighting == SignLighting::internal && max_emergency_cd_m2(sign) > 0)
      count("sign \"" + sign.name + "\"", sign.circuit);
  if (luminaires == 0 && !scene.emitters.empty())
    tell_state(s, Severity::warning,
               "is in emergency operation, and no luminaire of the scene is lit when the mains "
               "fail: say emergency = \"maintained\" or \"non-maintained\" of those that are",
               out);
  if (off > 0)
    tell_state(s, off == all ? Severity::warning : Severity::note,
               fmt::format("has switched off {}{} by its circuits: {} dark in this state", first,
                           off > 1 ? fmt::format(" and {} more", off - 1) : "",
                           off > 1 ? "they are" : "it is"),
               out);
}

/// Reports luminaires and signs whose supply is exhausted at the time of an emergency state.
void tell_exhausted(const SceneDescription& scene, const Scenario& s, Findings& out) {
  const Emitter* luminaire = nullptr;
  const Sign* sign = nullptr;
  size_t luminaires = 0, signs = 0;
  for (const Emitter& e : scene.emitters)
    if (e.emergency_flux > 0 && is_exhausted(e.duration_s, s.seconds_after_failure) &&
        luminaires++ == 0)
      luminaire = &e;
  for (const Sign& one : scene.signs)
    if (one.lighting == SignLighting::internal && max_emergency_cd_m2(one) > 0 &&
        is_exhausted(one.duration_s, s.seconds_after_failure) && signs++ == 0)
      sign = &one;
  const auto tell = [&](const char* kind, const std::string& name, size_t number,
                        double duration_s) {
    tell_state(s, Severity::warning,
               fmt::format("is {:g} s after the failure of the mains, and the supply of {} "
                           "\"{}\"{} lasts {:g} s (duration_h): {} dark in this state",
                           s.seconds_after_failure, kind, name,
                           number > 1 ? fmt::format(" (and of {} more)", number - 1) : "",
                           duration_s, number > 1 ? "they are" : "it is"),
               out);
  };
  if (luminaire != nullptr) tell("luminaire", luminaire->name, luminaires, *luminaire->duration_s);
  if (sign != nullptr) tell("sign", sign->name, signs, *sign->duration_s);
}

/// Whether some emergency luminaire does not say how long its supply lasts.
bool some_last_unsaid(const SceneDescription& scene) {
  return std::any_of(scene.emitters.begin(), scene.emitters.end(),
                     [](const Emitter& e) { return e.emergency_flux > 0 && !e.duration_s; });
}

/// Glows are brightest at the failure, and people see them minutes later.
void tell_fresh_glow(const SceneDescription& scene, const Scenario& s, Findings& out) {
  if (!judges_people(scene)) return;
  for (const Sign& sign : scene.signs) {
    if (sign.lighting != SignLighting::photoluminescent || !(max_emergency_cd_m2(sign) > 0))
      continue;
    return tell_state(s, Severity::warning,
                      "does not say how long after the failure of the mains it is: the "
                      "photoluminescent sign \"" +
                          sign.name +
                          "\" is judged as bright as at the failure, which it is for seconds; say "
                          "seconds_after_failure = 600, or how long people are on their way",
                      out);
  }
}

double largest_extinction(const Medium& m) {
  double most = m.kind == MediumKind::homogeneous || m.kind == MediumKind::bounded
                    ? m.optics.extinction.sigma_t
                    : 0;
  for (const Layer& layer : m.layers) most = std::max(most, layer.optics.extinction.sigma_t);
  for (const float cell : m.data.extinction) most = std::max(most, static_cast<double>(cell));
  return most;
}

/// The change of a variant that has scaled a medium in a state; line 0 if there is none.
SourcePlace change_of(const Scenario& s, const Medium& medium) {
  for (const Scenario::Factor& factor : s.media)
    if (factor.name == medium.name) return factor.change;
  return {};
}

/// A medium that only emits light; a data set of a fire also holds smoke.
bool only_shines(const Medium& m) {
  return m.emission && m.kind != MediumKind::data_set;
}

/// Reports a change of a variant, or a state, that thins smoke.
void tell_of_smoke(const Scenario& s, const Medium& m, const std::string& what, Findings& out) {
  const SourcePlace change = change_of(s, m);
  if (change.line == 0) return tell_state(s, Severity::warning, what, out);
  out.push_back({Severity::warning,
                 "scenario",
                 {change, "this [[change]] of \"" + m.name + "\" thins it: scenario \"" + s.name +
                              "\" " + what}});
}

/// Reports smoke that has an extinction as written, and almost none in this state, without being
/// removed; and smoke that a change removes.
void tell_thinned(const SceneDescription& scene, const Scenario& s, Findings& out) {
  if (!judges_people(scene)) return;
  for (const Medium& m : scene.media) {
    const double factor = factor_of_medium(s, m), written = largest_extinction(m);
    if (only_shines(m) || written < hides_nothing) continue;
    if (factor == 0 && change_of(s, m).line > 0)
      return tell_of_smoke(s, m, "has none of it, and signs are judged without it", out);
    if (!(factor > 0) || factor > small_factor || written * factor >= hides_nothing) continue;
    return tell_of_smoke(
        s, m,
        fmt::format("leaves {:g} of the smoke \"{}\", at most {:.2g} /m, through which "
                    "a lit sign is seen for {:.3g} m (Jin, 8/K): smoke_factor and the "
                    "factors in 'media' are shares, 1 for all of the smoke and 0 for "
                    "none",
                    factor, m.name, written * factor, 8 / (written * factor)),
        out);
  }
}

/// Reports flames whose light a state takes away while it leaves their smoke.
void tell_dimmed_flames(const SceneDescription& scene, const Scenario& s, Findings& out) {
  if (!judges_people(scene)) return;
  const bool smoky = std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& m) {
    return (!m.emission || m.kind == MediumKind::data_set) && factor_of_medium(s, m) > 0;
  });
  for (const Medium& m : scene.media) {
    if (!smoky || !m.emission || !(factor_of_medium(s, m) > 0)) continue;
    const double share = flame_share(s, m);
    if (share >= 1) continue;
    return tell_state(s, Severity::warning,
                      fmt::format("leaves {:g} of the light of the flames \"{}\" in smoke: their "
                                  "glare is missing; emission_factor and the factors of circuits "
                                  "are shares, 1 for all of the light",
                                  share, m.name),
                      out);
  }
}

void tell_time(const SceneDescription& scene, const Scenario& s, Findings& out) {
  if (s.operation != Operation::mains && !s.says_seconds) tell_fresh_glow(scene, s, out);
  if (s.operation == Operation::mains || !s.says_seconds) return;
  const double seconds = s.seconds_after_failure;
  if (s.operation == Operation::emergency) tell_exhausted(scene, s, out);
  if (seconds > max_hours * hour_s)
    tell_state(
        s, Severity::warning,
        fmt::format("is {:.3g} h after the failure of the mains: the rated duration of "
                    "emergency luminaires is 1 to 3 h{}; seconds_after_failure is in seconds",
                    seconds / hour_s, some_last_unsaid(scene) ? ", and they are taken as lit" : ""),
        out);
  else if (seconds > hour_s && s.operation == Operation::emergency && some_last_unsaid(scene))
    tell_state(
        s, Severity::note,
        fmt::format("is {:.3g} h after the failure of the mains: batteries rated for 1 h are "
                    "empty, and luminaires are taken as lit",
                    seconds / hour_s),
        out);
  for (const Sign& sign : scene.signs) {
    if (sign.decay.empty() || seconds <= sign.decay.back().x) continue;
    return tell_state(
        s, Severity::warning,
        fmt::format("is {:g} s after the failure of the mains, and the 'decay' of sign \"{}\" is "
                    "known up to {:g} s: its glow is extrapolated",
                    seconds, sign.name, sign.decay.back().x),
        out);
  }
}

bool any_smoke(const SceneDescription& scene, const std::vector<Scenario>& scenarios) {
  return std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& m) {
    return !only_shines(m) &&
           std::any_of(scenarios.begin(), scenarios.end(),
                       [&](const Scenario& s) { return factor_of_medium(s, m) > 0; });
  });
}

void tell_people(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                 Findings& out) {
  const AssessmentSettings& said = scene.assessment;
  if (said.place.line == 0 || !judges_people(scene)) return;
  const auto tell = [&](Severity severity, std::string what) {
    out.push_back({severity, "assessment", {said.place, std::move(what)}});
  };
  if (said.age_years < young_years)
    tell(Severity::note, fmt::format("age_years = {:g}: signs are judged by young eyes; older "
                                     "people need more contrast and are glared more (65 unless "
                                     "said)",
                                     said.age_years));
  const auto [low, high] =
      std::minmax_element(said.eye_heights_m.begin(), said.eye_heights_m.end());
  if (*high < min_standing_m)
    tell(any_smoke(scene, scenarios) ? Severity::warning : Severity::note,
         fmt::format("eye_heights_m goes up to {:g} m: nobody who walks upright is "
                     "judged, whose eyes are in denser smoke",
                     *high));
  if (*high > max_standing_m)
    tell(Severity::warning, fmt::format("eye_heights_m goes up to {:g} m: eyes of people are 1.4 "
                                        "to 1.8 m above the floor",
                                        *high));
  if (said.spacing_m > far_apart_m)
    tell(Severity::note, fmt::format("spacing_m = {:g}: people on routes stand so far apart, and "
                                     "what is read between them is not judged",
                                     said.spacing_m));
  const auto names = [&](const char* id) {
    return std::count(said.rules.begin(), said.rules.end(), id) > 0;
  };
  if (names("en1838-2013") && names("en1838-2024"))
    tell(Severity::note,
         "rules names two editions of EN 1838: checks of both stand beside each other, and the one "
         "that is in force decides");
}

/// Reports smoke that is described, but absent in every state.
void tell_unused_smoke(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                       Findings& out) {
  if (!judges_people(scene) || scenarios.size() < scene.scenarios.size()) return;
  for (const Medium& m : scene.media) {
    if (only_shines(m) || std::any_of(scenarios.begin(), scenarios.end(), [&](const Scenario& s) {
          return factor_of_medium(s, m) > 0;
        }))
      continue;
    const bool others = any_smoke(scene, scenarios);
    out.push_back({Severity::warning,
                   "scenario",
                   {m.place, fmt::format("no scenario has the smoke \"{}\"{}", m.name,
                                         others ? ": signs are judged without it"
                                                : ", nor any other: signs are judged in clear "
                                                  "air")}});
    if (!others) return;
  }
}

}  // namespace

void inspect_states(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                    Findings& out) {
  for (const Scenario& s : scenarios) {
    tell_circuit_factors(s, out);
    tell_switched_off(scene, s, out);
    tell_time(scene, s, out);
    tell_thinned(scene, s, out);
    tell_dimmed_flames(scene, s, out);
  }
  tell_people(scene, scenarios, out);
  tell_unused_smoke(scene, scenarios, out);
  for (const AssessedArea& area : scene.task_areas)
    if (area.mains_lx < min_task_lx)
      out.push_back({Severity::warning,
                     "assessment",
                     {area.place, fmt::format("task area \"{}\" asks for {:g} lx in mains "
                                              "operation, less than a corridor: mains_lx is what "
                                              "the task needs, in lx",
                                              area.name, area.mains_lx)}});
}

}  // namespace luxodus

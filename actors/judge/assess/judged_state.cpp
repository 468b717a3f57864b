#include "actors/judge/assess/judged_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "actors/judge/assess/aged_light.hpp"
#include "scenes/emergency/adaptation.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Limits for remarks: eyes younger than this, and eye heights below this [m], are not typical.
constexpr double young_years = 40, upright_m = 1.4;
/// Places farther apart than this leave much of a route unassessed [m].
constexpr double far_apart_m = 5;

constexpr std::array medium_words{"homogeneous", "layered", "bounded", "data set"};

double stated(const SmokeOptics& optics) {
  return optics.extinction.spectrum().at(stated_nm);
}

/// Where people look: the building between the lowest eye and the highest sign or eye; the whole
/// building without eyes; nothing without a building.
Bounds seen_part(const SceneDescription& scene) {
  Bounds out;
  for (const Object& object : scene.objects)
    for (const glm::dvec3& p : object.mesh.positions) out.extend(p);
  if (out.empty()) return out;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](double z) {
    low = std::min(low, z);
    high = std::max(high, z);
  };
  const auto stand = [&](double floor_m) {
    for (const double height : scene.assessment.eye_heights_m) take(floor_m + height);
  };
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : route.path) stand(p.z);
  for (const AssessedArea& area : scene.open_areas) stand(area.z_m);
  for (const Observer& observer : scene.observers) take(observer.eye.z);
  if (low > high) return out;
  for (const Sign& sign : scene.signs) take(sign.frame.origin.z);
  const Bounds building = out;
  out.low.z = std::clamp(low, building.low.z, building.high.z);
  out.high.z = std::clamp(high, building.low.z, building.high.z);
  return out;
}

/// The cells of a data set that a part of the building touches, low to below high on each axis.
std::pair<glm::ivec3, glm::ivec3> cells_in(const Medium& medium, const Bounds& part) {
  const glm::ivec3 n(medium.data.nx, medium.data.ny, medium.data.nz);
  if (part.empty()) return {glm::ivec3(0), n};
  Bounds local;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? part.high.x : part.low.x,
                       (corner & 2) != 0 ? part.high.y : part.low.y,
                       (corner & 4) != 0 ? part.high.z : part.low.z);
    local.extend((p - medium.frame.origin) * medium.frame.axes);
  }
  const glm::dvec3 cell = medium.data.extent / glm::dvec3(n), most(n);
  return {glm::ivec3(glm::clamp(glm::floor(local.low / cell), glm::dvec3(0), most)),
          glm::ivec3(glm::clamp(glm::ceil(local.high / cell), glm::dvec3(0), most))};
}

/// Smallest and largest extinction of cells; 0 where there are none.
std::pair<double, double> range_in(const DataSet& data,
                                   const std::pair<glm::ivec3, glm::ivec3>& cells) {
  const auto& [from, to] = cells;
  float low = std::numeric_limits<float>::infinity(), high = 0;
  for (int z = from.z; z < to.z; ++z)
    for (int y = from.y; y < to.y; ++y) {
      const size_t row =
          (static_cast<size_t>(z) * static_cast<size_t>(data.ny) + static_cast<size_t>(y)) *
          static_cast<size_t>(data.nx);
      for (int x = from.x; x < to.x; ++x) {
        const float v = data.extinction[row + static_cast<size_t>(x)];
        low = std::min(low, v);
        high = std::max(high, v);
      }
    }
  return {low <= high ? static_cast<double>(low) : 0, static_cast<double>(high)};
}

/// Smallest and largest extinction of a medium, as the scene states it; of a data set those of the
/// cells that `part` touches, all where it is empty.
std::pair<double, double> range_of(const Medium& medium, const Bounds& part = {}) {
  if (medium.kind == MediumKind::layered && !medium.layers.empty()) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const Layer& layer : medium.layers) {
      low = std::min(low, stated(layer.optics));
      high = std::max(high, stated(layer.optics));
    }
    return {low, high};
  }
  const double constant = stated(medium.optics);
  const std::vector<float>& cells = medium.data.extinction;
  if (medium.kind != MediumKind::data_set || cells.empty()) return {constant, constant};
  // Cells of a data set are stated at the wavelength of its extinction law.
  const Extinction& law = medium.optics.extinction;
  const double there = law.spectrum().at(law.wavelength_nm);
  const double shift = there > 0 ? constant / there : 1;
  const auto [low, high] = range_in(medium.data, cells_in(medium, part));
  return {shift * low, shift * high};
}

std::string place_of(const Medium& medium) {
  return medium.place.line > 0 ? fmt::format("{}:{}", medium.place.file, medium.place.line)
                               : medium.place.file;
}

Remarks notes_on(const Medium& medium, double factor) {
  Remarks out;
  if (medium.kind == MediumKind::layered)
    out.push_back(remark(medium.layers.size() == 1 ? RemarkId::one_layer : RemarkId::layers,
                         medium.layers.size()));
  if (medium.kind == MediumKind::data_set)
    out.push_back(remark(RemarkId::grid_cells, medium.data.nx, medium.data.ny, medium.data.nz));
  if (medium.simulation)
    out.push_back(
        remark(RemarkId::fire_simulation, medium.simulation->time_s, medium.simulation->source));
  if (factor != 1) out.push_back(remark(RemarkId::scenario_factor, factor));
  return out;
}

/// The operation after the failure of the mains, even if a clock has not reached it.
Operation operation_then(const Scenario& scenario) {
  return scenario.operation == Operation::mains ? scenario.written_operation : scenario.operation;
}

bool same_factors(std::vector<Scenario::Factor> a, std::vector<Scenario::Factor> b) {
  const auto by_name = [](const Scenario::Factor& x, const Scenario::Factor& y) {
    return x.name < y.name;
  };
  std::sort(a.begin(), a.end(), by_name);
  std::sort(b.begin(), b.end(), by_name);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Scenario::Factor& x, const Scenario::Factor& y) {
                      return x.name == y.name && x.factor == y.factor;
                    });
}

/// Whether two scenarios differ in nothing but their operation. Then a forgotten `operation` does
/// no harm: the other scenario is the state that was meant.
bool differ_in_operation_alone(const Scenario& mains, const Scenario& other) {
  return same_factors(mains.circuits, other.circuits) && same_factors(mains.media, other.media) &&
         mains.smoke_factor == other.smoke_factor &&
         mains.emission_factor == other.emission_factor && mains.doors_open == other.doors_open &&
         mains.doors_closed == other.doors_closed;
}

/// "\"night\" (emergency operation, with smoke), ..."
std::string candidates(const SceneDescription& scene) {
  std::string out;
  for (const Scenario& s : scene.scenarios)
    out += fmt::format("{}\"{}\" ({} operation, {})", out.empty() ? "" : ", ", s.name,
                       name_of(operation_then(s)),
                       has_smoke(scene, s) ? "with smoke" : "without smoke");
  return out;
}

Problem unclear(const SceneDescription& scene, const SourcePlace& place, const std::string& why) {
  return problem_in(place,
                    "which state is to be judged is not clear: " + why +
                        ". Name it by --scenario, or write operation = \"emergency\" where it "
                        "is missing; there are: " +
                        candidates(scene));
}

/// The light by which views are judged; requires the lit luminaires in `state`.
Remark light_of(const SceneDescription& scene, const AssessedState& state) {
  double least = 1;
  for (const Emitter& e : scene.emitters) {
    if (!std::count(state.lit.begin(), state.lit.end(), e.name)) continue;
    least = std::min(least, aged_share(e, state.operation));
  }
  if (state.lit.empty()) return remark(RemarkId::no_luminaire_lit);
  if (least == 1) return remark(RemarkId::light_as_stated);
  return remark(state.operation == Operation::mains ? RemarkId::light_aged_mains
                                                    : RemarkId::light_aged_emergency,
                least);
}

bool is_aged(const Remark& light) {
  return light.id == RemarkId::light_aged_mains || light.id == RemarkId::light_aged_emergency;
}

/// Remarks on emergency luminaires and signs whose circuits this state dims or switches off.
void add_switched(const SceneDescription& scene, const Scenario& scenario, Remarks& remarks) {
  if (scenario.operation == Operation::mains) return;
  size_t off = 0, dimmed = 0, raised = 0, signs = 0;
  for (const Emitter& e : scene.emitters) {
    if (!(e.emergency_flux > 0)) continue;
    const double factor = factor_of(scenario.circuits, e.circuit, 1);
    off += factor == 0 ? 1 : 0;
    dimmed += factor > 0 && factor < 1 ? 1 : 0;
    raised += factor > 1 ? 1 : 0;
  }
  for (const Sign& sign : scene.signs)
    signs += sign.lighting == SignLighting::internal && max_emergency_cd_m2(sign) > 0 &&
                     factor_of(scenario.circuits, sign.circuit, 1) == 0
                 ? 1
                 : 0;
  if (off + dimmed > 0) remarks.push_back(remark(RemarkId::circuits_switch_off, off, dimmed));
  if (raised > 0) remarks.push_back(remark(RemarkId::circuits_raise, raised));
  if (signs > 0) remarks.push_back(remark(RemarkId::circuits_switch_off_signs, signs));
}

bool shines(const Sign& sign, const Scenario& scenario) {
  for (size_t c = 0; c < sign.colours.size(); ++c)
    if (scenario_luminance(sign, static_cast<ColourIndex>(c), scenario) > 0) return true;
  return false;
}

/// A warning that signs which are lit from within are dark in this state; none if none is.
std::optional<Remark> dark_signs(const SceneDescription& scene, const Scenario& scenario) {
  std::string first;
  int more = -1;
  for (const Sign& sign : scene.signs) {
    if (sign.lighting != SignLighting::internal || !(max_emergency_cd_m2(sign) > 0) ||
        shines(sign, scenario))
      continue;
    if (++more == 0) first = sign.name;
  }
  if (more < 0) return std::nullopt;
  return more == 0 ? remark(RemarkId::sign_unlit, first)
                   : remark(RemarkId::signs_unlit, first, more);
}

/// Remarks on smoke that this state thins or lacks, and on luminaires without a measured web.
void add_thinned(const SceneDescription& scene, const Scenario& scenario, Remarks& remarks) {
  for (const Medium& m : scene.media) {
    const double factor = extinction_factor(scenario, m.name);
    if (is_flame(m) || !(factor < 1)) continue;
    if (factor > 0)
      remarks.push_back(remark(RemarkId::thinned_smoke, factor, m.name));
    else if (has_smoke(scene, scenario))  // else the state says that it is in clear air
      remarks.push_back(remark(RemarkId::absent_smoke, m.name));
  }
  const auto ideal = std::count_if(
      scene.emitters.begin(), scene.emitters.end(),
      [](const Emitter& e) { return e.emergency_flux > 0 && e.distribution != Distribution::web; });
  if (ideal > 0) remarks.push_back(remark(RemarkId::unmeasured_luminaires, ideal));
}

/// The shortest rated duration that the chosen codes require [h].
double rated_hours(const std::vector<CodeChoice>& codes) {
  double least = std::numeric_limits<double>::infinity();
  for (const CodeChoice& c : codes) least = std::min(least, rated_duration_h(c));
  return least;
}

/// Remarks on light and afterglow that at this time after the failure is only assumed.
void add_time(const SceneDescription& scene, const AssessedState& state, Remarks& remarks) {
  if (!state.seconds_after_failure) return;
  const double seconds = *state.seconds_after_failure, rated = rated_hours(state.codes);
  const bool unknown =
      std::any_of(scene.emitters.begin(), scene.emitters.end(),
                  [](const Emitter& e) { return e.emergency_flux > 0 && !e.duration_s; });
  if (state.operation == Operation::emergency && seconds > 3600 * rated && unknown)
    remarks.push_back(remark(RemarkId::later_than_rated, seconds, rated));
  const auto silent =
      std::count_if(scene.emitters.begin(), scene.emitters.end(),
                    [](const Emitter& e) { return e.emergency_flux > 0 && e.onset.empty(); });
  if (state.operation == Operation::emergency && seconds < adapted_after_s && silent > 0)
    remarks.push_back(remark(RemarkId::onset_assumed, silent, seconds));
  for (const Sign& sign : scene.signs)
    if (!sign.decay.empty() && seconds > sign.decay.back().x)
      return remarks.push_back(remark(RemarkId::glow_extrapolated, sign.name, sign.decay.back().x));
}

/// Remarks on unusual eyes, and on places at which nobody looks.
void add_people(const SceneDescription& scene, const AssessedState& state, Remarks& remarks) {
  const AssessmentSettings& said = scene.assessment;
  if (said.age_years < young_years) remarks.push_back(remark(RemarkId::young_eyes, said.age_years));
  const double highest = *std::max_element(said.eye_heights_m.begin(), said.eye_heights_m.end());
  if (highest < upright_m && !scene.routes.empty())
    remarks.push_back(remark(RemarkId::low_eyes, highest));
  if (said.spacing_m > far_apart_m && !scene.routes.empty())
    remarks.push_back(remark(RemarkId::far_apart, said.spacing_m));
  if (scene.signs.empty()) remarks.push_back(remark(RemarkId::no_sign));
  const auto has_set = [&](RuleSet set) {
    return std::any_of(state.codes.begin(), state.codes.end(),
                       [&](const CodeChoice& c) { return c.set == set; });
  };
  if (has_set(RuleSet::en1838_2013) && has_set(RuleSet::en1838_2024))
    remarks.push_back(remark(RemarkId::two_editions));
  if (has_set(RuleSet::nfpa101) && state.codes.size() > 1)
    remarks.push_back(remark(RemarkId::two_continents));
}

void add_remarks(const SceneDescription& scene, const Scenario& scenario, AssessedState& state) {
  auto& remarks = state.remarks;
  const auto warn = [&state](const Remark& one) {
    state.remarks.push_back(one);
    state.warnings.push_back(one);
  };
  if (state.operation == Operation::mains) remarks.push_back(remark(RemarkId::mains_operation));
  if (state.operation == Operation::dark) remarks.push_back(remark(RemarkId::dark_operation));
  if (state.operation != Operation::mains && !state.seconds_after_failure)
    remarks.push_back(remark(RemarkId::time_unsaid));
  if (state.operation != Operation::mains && state.seconds_after_failure &&
      *state.seconds_after_failure < adapted_after_s)
    remarks.push_back(
        remark(RemarkId::eyes_unadapted, *state.seconds_after_failure, adapted_after_s));
  if (!state.smoke && !state.media.empty())
    remarks.push_back(remark(RemarkId::flames_without_smoke));
  if (!state.smoke && std::any_of(scene.media.begin(), scene.media.end(),
                                  [](const Medium& m) { return !is_flame(m); }))
    warn(remark(RemarkId::clear_air));
  const size_t dark = static_cast<size_t>(
      std::count_if(scene.emitters.begin(), scene.emitters.end(), [&](const Emitter& e) {
        return e.emergency_flux > 0 && !std::count(state.lit.begin(), state.lit.end(), e.name);
      }));
  if (state.operation == Operation::emergency && dark > 0)
    warn(remark(dark == 1 ? RemarkId::luminaire_unlit : RemarkId::luminaires_unlit, dark));
  if (state.operation == Operation::emergency)
    if (const auto signs = dark_signs(scene, scenario)) warn(*signs);
  for (const Medium& m : scene.media)
    if (m.simulation && !m.simulation->glows && extinction_factor(scenario, m.name) > 0)
      warn(remark(RemarkId::flame_glare_missing, m.name));
  // A fire burns with the light that was stated of it, unless it is in clear air.
  for (const Medium& m : scene.media)
    if (const double share = flame_share(scenario, m); state.smoke && m.emission && share < 1)
      warn(remark(RemarkId::flame_dimmed, share, m.name));
  add_switched(scene, scenario, remarks);
  add_time(scene, state, remarks);
  add_thinned(scene, scenario, remarks);
  add_people(scene, state, remarks);
  for (const CodeChoice& codes : state.codes)
    if (const NamedRules& set = named(codes.set); set.status)
      remarks.push_back(remark(*set.status == RemarkId::superseded ? RemarkId::edition_superseded
                                                                   : RemarkId::edition_not_verified,
                               set.edition));
  if (!scene.signs.empty() && is_aged(state.light))
    remarks.push_back(remark(RemarkId::sign_luminance_stated));
}

}  // namespace

// Such a medium only emits light; a data set of a fire also holds smoke.
bool is_flame(const Medium& medium) {
  return medium.emission && medium.kind != MediumKind::data_set;
}

Eye adapted_eye(const AssessmentSettings& people, const Scenario& scenario, double age_years) {
  Eye eye{age_years};
  eye.bleached_cd_m2 = equivalent_background_of(
      people, scenario.operation,
      scenario.says_seconds ? std::optional(scenario.seconds_after_failure) : std::nullopt);
  return eye;
}

bool has_smoke(const SceneDescription& scene, const Scenario& scenario) {
  return std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& medium) {
    return !is_flame(medium) && extinction_factor(scenario, medium.name) > 0 &&
           range_of(medium).second > 0;
  });
}

Result<Scenario> judged_scenario(const SceneDescription& scene, const std::string& named) {
  if (!named.empty()) return find_scenario(scene, named);
  if (scene.scenarios.empty())
    return problem_in(scene.file,
                      "there is no [[scenario]], so the state to be judged is not known: "
                      "write [[scenario]] with name = \"emergency\" and operation = \"emergency\"");
  const bool smoky = std::any_of(scene.scenarios.begin(), scene.scenarios.end(),
                                 [&](const Scenario& s) { return has_smoke(scene, s); });
  const char* const with = smoky ? " with smoke" : "";
  const Scenario* one = nullptr;
  for (const Scenario& s : scene.scenarios) {
    if (operation_then(s) != Operation::emergency || has_smoke(scene, s) != smoky) continue;
    if (one != nullptr)
      return unclear(scene, s.place,
                     fmt::format("\"{}\" and \"{}\" are both in emergency operation{}", one->name,
                                 s.name, with));
    one = &s;
  }
  if (one == nullptr)
    return unclear(scene, scene.scenarios.front().place,
                   fmt::format("no scenario{} is in emergency operation", with));
  for (const Scenario& s : scene.scenarios)
    if (operation_then(s) == Operation::mains && has_smoke(scene, s) == smoky &&
        !differ_in_operation_alone(s, *one))
      return unclear(scene, s.place,
                     fmt::format("\"{}\"{} is in mains operation and differs from \"{}\" in more "
                                 "than that: its operation may have been forgotten",
                                 s.name, with, one->name));
  return *one;
}

Result<std::vector<CodeChoice>> judged_codes(const SceneDescription& scene,
                                             const std::vector<std::string>& rules,
                                             const std::vector<std::string>& deviations) {
  const AssessmentSettings& said = scene.assessment;
  auto codes = chosen_codes(rules.empty() ? said.rules : rules,
                            deviations.empty() ? said.deviations : deviations);
  if (codes) return codes;
  const bool by_scene = rules.empty() && deviations.empty() && said.place.line > 0;
  return problem_in(by_scene ? said.place : SourcePlace{scene.file, 0}, codes.problem());
}

Result<void> irritation_is_said(const SceneDescription& scene, const Scenario& scenario) {
  if (scene.assessment.irritant_smoke || !has_smoke(scene, scenario)) return {};
  const auto smoke = std::find_if(scene.media.begin(), scene.media.end(), [&](const Medium& m) {
    return !is_flame(m) && extinction_factor(scenario, m.name) > 0;
  });
  return problem_in(
      scene.assessment.place.line > 0 ? scene.assessment.place : smoke->place,
      fmt::format(
          "the scene does not state whether the smoke \"{}\" of scenario \"{}\" is "
          "irritant, and verdicts on signs depend on it: write irritant_smoke = true (wood, "
          "plastics and most fires) or irritant_smoke = false (theatre smoke) "
          "in [assessment]",
          smoke->name, scenario.name));
}

Remarks overruled(const SceneDescription& scene, const std::vector<std::string>& rules,
                  const std::vector<std::string>& deviations) {
  Remarks out;
  const auto compare = [&](RemarkId id, std::vector<std::string> said,
                           std::vector<std::string> asked) {
    std::sort(said.begin(), said.end());
    std::sort(asked.begin(), asked.end());
    if (said.empty() || asked.empty() || said == asked) return;
    out.push_back(remark(id, fmt::format("{}", fmt::join(said, ", "))));
  };
  compare(RemarkId::other_rules, scene.assessment.rules, rules);
  compare(RemarkId::other_deviations, scene.assessment.deviations, deviations);
  return out;
}

double equivalent_background_of(const AssessmentSettings& people, Operation operation,
                                std::optional<double> seconds_after_failure) {
  if (operation == Operation::mains || !seconds_after_failure) return 0;
  return equivalent_background(people.luminance_before_cd_m2, *seconds_after_failure);
}

AssessedState state_of(const SceneDescription& scene, const Scenario& scenario,
                       std::vector<CodeChoice> codes) {
  AssessedState state;
  state.scenario = scenario.name;
  state.operation = scenario.operation;
  if (scenario.operation != Operation::mains && scenario.says_seconds)
    state.seconds_after_failure = scenario.seconds_after_failure;
  state.luminaires = scene.emitters.size();
  for (const ActiveSource& source : active_sources(scene, scenario))
    if (source.emitter != nullptr) state.lit.push_back(source.emitter->name);
  state.smoke = has_smoke(scene, scenario);
  const Bounds part = seen_part(scene);
  for (const Medium& medium : scene.media) {
    const double factor = extinction_factor(scenario, medium.name);
    if (!(factor > 0)) continue;
    const auto [low, high] = range_of(medium, part);
    const bool flame = is_flame(medium);
    state.media.push_back(
        {medium.name, flame ? "flame" : medium_words.at(static_cast<size_t>(medium.kind)),
         place_of(medium), notes_on(medium, factor), factor * low, factor * high});
  }
  state.codes = std::move(codes);
  state.light = light_of(scene, state);
  add_remarks(scene, scenario, state);
  return state;
}

}  // namespace luxodus

// The order of inspecting: the scene as written; each state of the doors, with all lights on; each
// state of smoke; each state of light. Scenarios share states, and a finding common to several is
// reported once, with its scenarios unless it holds in all.
#include "actors/judge/inspect/inspect.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"

namespace luxodus {

namespace {

using Names = std::vector<std::string>;

/// Collects findings, each with its scenarios.
class Collected {
 public:
  void add(Findings found, const Names& scenarios) {
    for (Finding& finding : found) {
      const auto [at, fresh] = known_.try_emplace({finding.severity, finding.text()}, list_.size());
      Entry& entry = fresh ? list_.emplace_back(Entry{std::move(finding), {}}) : list_[at->second];
      entry.scenarios.insert(entry.scenarios.end(), scenarios.begin(), scenarios.end());
    }
  }

  /// Errors first; for each kind at most limits::findings_of_a_kind separately.
  Findings told(size_t all_scenarios) && {
    std::stable_sort(list_.begin(), list_.end(), [](const Entry& a, const Entry& b) {
      return a.finding.severity > b.finding.severity;
    });
    std::map<std::pair<Severity, std::string>, size_t> count;
    for (const Entry& e : list_) ++count[{e.finding.severity, e.finding.kind}];
    std::map<std::pair<Severity, std::string>, size_t> so_far;
    Findings out;
    for (Entry& e : list_) {
      const std::pair<Severity, std::string> key{e.finding.severity, e.finding.kind};
      const size_t place = ++so_far[key];
      if (place > limits::findings_of_a_kind) continue;
      if (e.scenarios.size() < all_scenarios) e.finding.problem.what += in_words(e.scenarios);
      const size_t more = count[key] - place;
      if (place == limits::findings_of_a_kind && more > 0)
        e.finding.problem.what += fmt::format(" (and {} more like this)", more);
      out.push_back(std::move(e.finding));
    }
    return out;
  }

 private:
  struct Entry {
    Finding finding;
    Names scenarios;
  };

  static std::string in_words(const Names& scenarios) {
    std::string names;
    for (const std::string& name : scenarios)
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
    return (scenarios.size() == 1 ? " (in scenario " : " (in scenarios ") + names + ")";
  }

  std::vector<Entry> list_;
  std::map<std::pair<Severity, std::string>, size_t> known_;  // places in the list
};

Names names_of(const std::vector<const Scenario*>& scenarios) {
  Names out;
  for (const Scenario* s : scenarios) out.push_back(s->name);
  return out;
}

/// Groups scenarios with equal keys, in order of their first.
template <class Key>
std::vector<std::vector<const Scenario*>> alike(const std::vector<const Scenario*>& scenarios,
                                                Key key) {
  std::vector<std::vector<const Scenario*>> out;
  for (const Scenario* s : scenarios) {
    const auto at = std::find_if(out.begin(), out.end(),
                                 [&](const auto& group) { return key(*group.front()) == key(*s); });
    if (at != out.end())
      at->push_back(s);
    else
      out.push_back({s});
  }
  return out;
}

using DoorState = std::pair<Names, Names>;
DoorState doors_of(const Scenario& s) {
  return {s.doors_open, s.doors_closed};
}

using FactorList = std::vector<std::pair<std::string, double>>;
FactorList listed(const std::vector<Scenario::Factor>& factors) {
  FactorList out;
  for (const Scenario::Factor& f : factors) out.emplace_back(f.name, f.factor);
  return out;
}

/// All luminaires lit, so that each is compiled, in order; nothing to tally.
SceneDescription all_lit(const SceneDescription& scene) {
  SceneDescription out = scene;
  out.surface_groups.clear();
  out.volume_groups.clear();
  out.counting_planes.clear();
  out.run.error_of.clear();
  out.run.voxels = false;
  out.run.max_bands = 1;
  out.run.band_edges_nm.clear();
  for (Object& object : out.objects) object.one_patch = true;
  for (Emitter& e : out.emitters) e.mains_flux = std::max({e.mains_flux, e.emergency_flux, 1e-3});
  // Without luminaires the geometry must still be compiled, which needs a light: adds one after all
  // others, at existing geometry, so that bounds do not change.
  if (out.emitters.empty()) {
    Emitter any;
    any.mains_flux = 1;
    any.distribution = Distribution::isotropic;
    for (const Object& object : out.objects)
      if (!object.mesh.positions.empty()) any.frame.origin = object.mesh.positions.front();
    out.emitters.push_back(any);
  }
  return out;
}

Scenario lit_scenario(const Scenario& scenario) {
  Scenario out = scenario;
  out.operation = Operation::mains;
  out.circuits.clear();
  return out;
}

/// `state`: scenarios with the same doors. Returns the problem that prevents compiling, if any.
Result<void> inspect_doors_state(const SceneDescription& scene,
                                 const std::vector<const Scenario*>& state, int threads,
                                 Collected& out, Misplaced& misplaced) {
  SceneDescription clear = all_lit(scene);
  clear.media.clear();
  Scenario lit = lit_scenario(*state.front());
  lit.media.clear();
  auto building = Building::make(std::move(clear), lit, threads);
  if (!building) return building.problem();
  const Site site{scene, *building.value(), Remoteness(scene)};
  Findings found;
  inspect_turned_rooms(site, found);
  inspect_luminaires(site, found, misplaced.emitters);
  inspect_signs(site, found, misplaced.signs);
  inspect_postures(site, misplaced.signs, found);
  inspect_sign_sight(site, misplaced.signs, found);
  inspect_eyes(site, found);
  inspect_routes(site, found);
  inspect_route_plan(site, found);
  inspect_areas(site, found);
  inspect_area_parts(site, found);
  inspect_leaves(site, found);
  inspect_emphasis(site, found);
  inspect_furniture(site, found);
  inspect_planes(site, misplaced.emitters, found);
  inspect_plane_shapes(site, found);
  inspect_judged_places(site, found);
  out.add(std::move(found), names_of(state));
  const auto light_of = [](const Scenario& s) {
    return std::pair(s.operation, listed(s.circuits));
  };
  for (const auto& light : alike(state, light_of)) {
    Findings near;
    inspect_near_field(site, *light.front(), near);
    out.add(std::move(near), names_of(light));
  }
  return {};
}

/// Returns the problem that prevents compiling, if any.
Result<void> inspect_media_of(const SceneDescription& scene, const Scenario& scenario, int threads,
                              Findings& out, Misplaced& misplaced) {
  SceneDescription smoky = all_lit(scene);
  smoky.planes.clear();
  auto building = Building::make(std::move(smoky), lit_scenario(scenario), threads);
  if (!building) return building.problem();
  inspect_media(building.value()->scene(), out);
  inspect_smoke_places(*building.value(), out);
  inspect_flames(*building.value(), out, misplaced.media);
  inspect_smoke(scene, *building.value(), out);
  inspect_columns(scene, *building.value(), out);
  inspect_fire_meshes(scene, *building.value(), out);
  return {};
}

/// Only the worst scenario: the numbers differ slightly, but the hole is the same.
void inspect_enclosure(const SceneDescription& scene, const std::vector<const Scenario*>& scenarios,
                       const Misplaced& misplaced, int threads, Collected& out) {
  const auto states =
      alike(scenarios, [](const Scenario& s) { return std::pair(s.operation, doors_of(s)); });
  std::optional<Finding> worst;
  double most = 0;
  Names where;
  for (const auto& state : states) {
    const auto shares = escape_shares(scene, *state.front(), misplaced, threads);
    if (!shares) continue;
    if (const auto white = white_rooms(scene, *state.front(), *shares))
      out.add({*white}, names_of(state));
    const double all = std::accumulate(shares->by_side.begin(), shares->by_side.end(), 0.0);
    auto finding = open_rooms(scene, *shares);
    if (!finding || all <= most) continue;
    most = all;
    worst = std::move(finding);
    where = names_of(state);
  }
  if (worst) out.add({*worst}, where);
}

}  // namespace

const char* word_of(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

std::string Finding::text() const {
  return problem_in(problem.where, std::string(word_of(severity)) + ": " + problem.what).text();
}

bool has_error(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::error; });
}

Result<std::vector<Finding>> inspect(const std::shared_ptr<const SceneDescription>& scene,
                                     const std::vector<Scenario>& scenarios, int threads) {
  if (scene->packed || scenarios.empty()) return Findings{};
  Collected out;
  std::vector<const Scenario*> all;
  for (const Scenario& s : scenarios) all.push_back(&s);
  Findings of_scene;
  for (const Problem& warning : scene->warnings)
    of_scene.push_back({Severity::warning, "file", warning});
  for (const Problem& note : scene->notes) of_scene.push_back({Severity::note, "file", note});
  inspect_sizes(*scene, of_scene);
  inspect_imports(*scene, of_scene);
  inspect_feet(*scene, of_scene);
  inspect_open_solids(*scene, of_scene);
  inspect_doubled_objects(*scene, of_scene);
  inspect_doors(*scene, of_scene);
  inspect_reach(*scene, of_scene);
  inspect_fluxes(*scene, of_scene);
  inspect_odd_ones(*scene, of_scene);
  inspect_materials(*scene, of_scene);
  inspect_sign_light(*scene, of_scene);
  inspect_smoke_numbers(*scene, of_scene);
  inspect_smoke_settings(*scene, scenarios, of_scene);
  inspect_states(*scene, scenarios, of_scene);
  inspect_way_sizes(*scene, of_scene);
  out.add(std::move(of_scene), names_of(all));
  Misplaced misplaced;
  for (const auto& state : alike(all, doors_of)) {
    if (auto ok = inspect_doors_state(*scene, state, threads, out, misplaced); !ok)
      return ok.problem();
  }
  const auto media_of = [](const Scenario& s) {
    return std::tuple(listed(s.media), s.smoke_factor, doors_of(s));
  };
  if (!scene->media.empty())
    for (const auto& state : alike(all, media_of)) {
      Findings found;
      if (auto ok = inspect_media_of(*scene, *state.front(), threads, found, misplaced); !ok)
        return ok.problem();
      out.add(std::move(found), names_of(state));
    }
  inspect_enclosure(*scene, all, misplaced, threads, out);
  return std::move(out).told(scenarios.size());
}

}  // namespace luxodus

// luxodus check: reads everything that a scene names, compiles it, and reports what was found.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/floors.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/judge/assess/judged_state.hpp"
#include "actors/results/formats/json_out.hpp"
#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/scene_features.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus::cli {

namespace {

struct CheckOptions {
  std::string scene;
  std::string scenario = "all";
  std::string at;
  int cells = 1;
  bool json = false;
};

Json memory_json(const CompiledScene& scene) {
  const auto triangles = static_cast<double>(scene.triangles);
  const double scores = static_cast<double>(scene.layout.scores()) * sizeof(int64_t);
  const double totals = static_cast<double>(scene.layout.totals()) * sizeof(Total) *
                        static_cast<double>(scene.groups.size());
  // Records, Embree's vertices and indices, and its tree (measured by tests/bench).
  const double geometry = triangles * (sizeof(TriangleRecord) + 48 + 100);
  double webs = 0;
  for (const auto& web : scene.webs) webs += static_cast<double>(web->bytes());
  return {{"geometry", exact_json(geometry, "B")},
          {"scores_per_thread", exact_json(scores, "B")},
          {"totals", exact_json(totals, "B")},
          {"webs", exact_json(webs, "B")}};
}

Json features_json(const CompiledScene& scene) {
  Json features = Json::array();
  for (const SceneFeature& f : features_of(scene))
    features.push_back({{"name", f.name}, {"on", f.on}, {"why", f.why}});
  return features;
}

Json describe(const CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  Json emitters = Json::array();
  double lumens = 0;
  for (const CompiledEmitter& e : scene.emitters) {
    emitters.push_back({{"name", e.name}, {"luminous_flux", exact_json(e.luminous_flux_lm, "lm")}});
    lumens += e.luminous_flux_lm;
  }
  Json bands = Json::array();
  for (int b = 0; b < scene.bands.count(); ++b)
    bands.push_back({scene.bands[b].low_nm, scene.bands[b].high_nm});
  return {{"scenario", scene.scenario.name},
          {"surfaces", scene.surfaces.size()},
          {"triangles", scene.triangles},
          {"degenerate_triangles_dropped", d.degenerate_triangles},
          {"area", exact_json(scene.total_area_m2, "m2")},
          {"patches", scene.patch_count},
          {"voxels", scene.voxels.edge > 0 ? scene.voxels.count() : 0},
          {"bounds",
           {{"low", vector_json(scene.bounds.low)}, {"high", vector_json(scene.bounds.high)}}},
          {"floor_heights_m", floor_heights(scene)},
          {"luminous_flux", exact_json(lumens, "lm")},
          {"emitters", emitters},
          {"media", scene.media_names},
          {"bands_nm", bands},
          {"kernel", describe_kernel(scene)},
          {"features", features_json(scene)},
          {"cells", scene.cell_boxes.size()},
          {"batch_particles", scene.batch_particles},
          {"eye_paths_per_batch", scene.eye_paths_per_batch},
          {"memory", memory_json(scene)}};
}

void print(const Json& s) {
  const auto bytes = [&](const char* key) {
    return short_number(s["memory"][key]["value"].get<double>()) + "B";
  };
  std::printf("scenario %s\n", s["scenario"].get<std::string>().c_str());
  std::printf("  geometry   %zu surfaces, %s triangles, %.4g m2, %zu flux patches, %zu voxels\n",
              s["surfaces"].get<size_t>(), short_number(s["triangles"].get<double>()).c_str(),
              s["area"]["value"].get<double>(), s["patches"].get<size_t>(),
              s["voxels"].get<size_t>());
  if (const auto dropped = s["degenerate_triangles_dropped"].get<int64_t>(); dropped > 0)
    std::printf("             %lld degenerate triangles dropped\n",
                static_cast<long long>(dropped));
  const auto& low = s["bounds"]["low"];
  const auto& high = s["bounds"]["high"];
  std::printf("  bounds     x %.4g .. %.4g, y %.4g .. %.4g, z %.4g .. %.4g m; ",
              low[0].get<double>(), high[0].get<double>(), low[1].get<double>(),
              high[1].get<double>(), low[2].get<double>(), high[2].get<double>());
  std::string floors;
  for (const Json& z : s["floor_heights_m"])
    floors += (floors.empty() ? "floors at z = " : ", ") + fmt::format("{:.4g}", z.get<double>());
  std::printf("%s\n", floors.empty() ? "no floor found" : (floors + " m").c_str());
  std::printf("  light      %zu emitters, %.6g lm\n", s["emitters"].size(),
              s["luminous_flux"]["value"].get<double>());
  for (const Json& e : s["emitters"]) {
    std::printf("    %-32s %10.4g lm\n", e["name"].get<std::string>().c_str(),
                e["luminous_flux"]["value"].get<double>());
  }
  std::string media;
  for (const Json& m : s["media"]) media += (media.empty() ? "" : ", ") + m.get<std::string>();
  std::printf("  media      %s\n  bands      ", media.empty() ? "none" : media.c_str());
  for (const Json& b : s["bands_nm"])
    std::printf("%.0f-%.0f ", b[0].get<double>(), b[1].get<double>());
  std::printf("nm\n  kernel     %s\n", s["kernel"].get<std::string>().c_str());
  for (const Json& f : s["features"]) {
    std::printf("    %-3s %-32s %s\n", f["on"].get<bool>() ? "on" : "off",
                f["name"].get<std::string>().c_str(), f["why"].get<std::string>().c_str());
  }
  std::printf("  memory     geometry %s, totals %s, scores %s a thread, webs %s\n",
              bytes("geometry").c_str(), bytes("totals").c_str(),
              bytes("scores_per_thread").c_str(), bytes("webs").c_str());
  std::printf("  batch      %lld particles\n", s["batch_particles"].get<long long>());
}

/// Adds warnings of compiling, each once, to the findings of the inspection.
void add_warnings(const CompiledScene& scene, std::vector<Finding>& out) {
  for (const Problem& w : scene.warnings) {
    const Finding finding{Severity::warning, "geometry", w};
    if (std::none_of(out.begin(), out.end(),
                     [&](const Finding& f) { return f.text() == finding.text(); }))
      out.push_back(finding);
  }
}

/// Adds what assess would require, if there is something to assess. Its options may state it as
/// well, so these are notes.
void add_refusals(const SceneDescription& scene, std::vector<Finding>& out) {
  if (scene.packed ||
      (scene.routes.empty() && scene.open_areas.empty() && scene.task_areas.empty()))
    return;
  const auto add = [&](const Problem& why) {
    out.push_back({Severity::note, "assess", {why.where, "luxodus assess: " + why.what}});
  };
  if (const auto codes = judged_codes(scene, {}, {}); !codes) add(codes.problem());
  const auto scenario = judged_scenario(scene, "");
  if (!scenario) return add(scenario.problem());
  if (auto said = irritation_is_said(scene, scenario.value()); !said) add(said.problem());
}

/// Adds what is wrong with the last state of a scene that changes in time: tables that end before
/// it, supplies that are exhausted by then. `first`: its first state, whose findings stand already.
void add_last_state(const CheckOptions& options, const SceneDescription& first,
                    std::vector<Finding>& out) {
  if (!first.time || !options.at.empty() || first.packed || first.at_s == first.time->to_s) return;
  const double last_s = first.time->to_s;
  const auto add = [&](Finding finding) {
    for (const Finding& known : out)
      if (known.text() == finding.text()) return;
    finding.problem.what += fmt::format(" (at {:g} s, the last state of [time])", last_s);
    out.push_back(std::move(finding));
  };
  const OpenedScene last = open_scene(options.scene, last_s);
  for (const Problem& problem : last.problems.list()) add({Severity::error, "file", problem});
  if (!last.scene) return;
  const auto scenarios = chosen_scenarios(*last.scene, options.scenario);
  if (!scenarios) return add({Severity::error, "scenario", scenarios.problem()});
  const auto found = inspect(last.scene, scenarios.value(), default_threads());
  if (!found) return add({Severity::error, "scene", found.problem()});
  for (const Finding& finding : found.value())
    if (finding.severity == Severity::error || finding.kind == "scenario") add(finding);
}

Result<ExitCode> check(const CheckOptions& options) {
  const auto [description, told] =
      load_scene(options.scene, ReadingWarnings::left_to_inspection, time_asked(options.at));
  if (!description) return exit_code_of(told);
  auto scenarios = chosen_scenarios(*description, options.scenario);
  if (!scenarios) return scenarios.problem();
  std::vector<Finding> findings;
  Json all = Json::array();
  std::optional<WaitingLine> waiting("inspecting " + options.scene);
  for (const Scenario& scenario : scenarios.value()) {
    auto scene = compile_scene(description, scenario, {options.cells});
    if (!scene) {
      findings.push_back({Severity::error, "scenario", scene.problem()});
      continue;
    }
    add_warnings(*scene.value(), findings);
    all.push_back(describe(*scene.value()));
  }
  if (!has_error(findings)) {
    auto found = inspect(description, scenarios.value(), default_threads());
    if (!found) found = std::vector<Finding>{{Severity::error, "scene", found.problem()}};
    findings.insert(findings.begin(), found->begin(), found->end());
    add_last_state(options, *description, findings);
    std::stable_sort(findings.begin(), findings.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  }
  waiting.reset();
  add_refusals(*description, findings);
  tell_findings(findings);
  if (options.json) {
    std::fputs(json_text({{"scene", description->name},
                          {"scenarios", all},
                          {"findings", findings_json(findings)}})
                   .c_str(),
               stdout);
  } else {
    std::printf("%s: %s\n", description->name.c_str(), description->title.c_str());
    for (const Json& s : all) print(s);
    std::printf("%s\n", count_text(findings).c_str());
  }
  return has_error(findings) ? ExitCode::bad_input : ExitCode::success;
}

}  // namespace

Command check_command() {
  const auto o = std::make_shared<CheckOptions>();
  return {
      .name = "check",
      .summary = "Read everything that a scene names, inspect it, say what was found",
      .heading = "Scenes",
      .options =
          {{"scene", &o->scene, "Scene file, or a pack", {.form = Form::scene, .required = true}},
           {"--scenario", &o->scenario, "Name of a scenario, or 'all'", {.form = Form::name}},
           at_option(o->at),
           {"--cells", &o->cells, "Number of geometry cells", {.range = Range{1, 1'000'000}}},
           {"--json", &o->json, "Output as JSON"}},
      .notes =
          "Findings are errors, warnings or notes, each with its file and line; exit code "
          "2 if there is an error. All that run, assess, render, pack and view refuse is "
          "found here.",
      .run = [o] { return exit_code_of(check(*o)); }};
}

}  // namespace luxodus::cli

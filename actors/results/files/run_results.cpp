#include "actors/results/files/run_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "actors/results/files/maps.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/files/run_state.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/light/signs/sign_face.hpp"
#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace {

constexpr int result_schema = 1;

Json measured(const Estimate& e, const char* unit) {
  return measured_json(e.value, e.standard_error, unit);
}

Json ledger_json(const EnergyBalance& l) {
  const auto units = [](Int128 v) { return to_string(v); };
  return {{"unit", "2^-32 of a particle's birth weight"},
          {"emitted", units(l.emitted)},
          {"roulette_gain", units(l.roulette_gain)},
          {"absorbed_surfaces", units(l.absorbed_surfaces)},
          {"absorbed_media", units(l.absorbed_media)},
          {"escaped", units(l.escaped)},
          {"roulette_loss", units(l.roulette_loss)},
          {"lost", units(l.lost())},
          {"closes", l.closes()},
          {"rays", l.rays},
          {"hits", l.hits},
          {"collisions", l.collisions}};
}

Json surfaces_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  const uint32_t block = scene.blocks.surfaces;
  for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const CompiledSurface& surface = scene.surfaces[s];
    const Estimate in = readout.lumens(block, s, 0);
    Json item = {{"name", surface.name},
                 {"area", exact_json(surface.area_m2, "m2")},
                 {"incident", measured(in, "lm")},
                 {"outgoing", measured(readout.lumens(block, s, 1), "lm")},
                 {"absorbed", measured(readout.lumens(block, s, 2), "lm")},
                 {"mean_illuminance_of_both_sides",
                  measured(in * (surface.area_m2 > 0 ? 1 / surface.area_m2 : 0), "lx")}};
    Json watts = Json::array();
    for (int b = 0; b < scene.bands.count(); ++b)
      watts.push_back(measured(readout.watts(block, s, b, 0), "W"));
    item["incident_by_band"] = std::move(watts);
    out.push_back(std::move(item));
  }
  return out;
}

Json surface_groups_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  const uint32_t block = scene.blocks.surface_groups;
  for (uint32_t g = 0; g < scene.surface_groups.size(); ++g) {
    double watts_in = 0;
    for (int b = 0; b < scene.bands.count(); ++b) watts_in += readout.watts(block, g, b, 0).value;
    out.push_back({{"name", scene.description->surface_groups[g].name},
                   {"incident", measured(readout.lumens(block, g, 0), "lm")},
                   {"outgoing", measured(readout.lumens(block, g, 1), "lm")},
                   {"absorbed", measured(readout.lumens(block, g, 2), "lm")},
                   {"incident_power", exact_json(watts_in, "W")}});
  }
  return out;
}

Json volumes_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  for (uint32_t i = 0; i < scene.volume_groups.size(); ++i) {
    out.push_back(
        {{"name", scene.description->volume_groups[i].name},
         {"track_length", measured(readout.lumens(scene.blocks.volume_length, i, 0), "lm m")},
         {"absorbed", measured(readout.lumens(scene.blocks.volume_power, i, 0), "lm")},
         {"scattered", measured(readout.lumens(scene.blocks.volume_power, i, 1), "lm")}});
  }
  return out;
}

Json media_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  for (uint32_t i = 0; i < scene.media_names.size(); ++i) {
    out.push_back({{"name", scene.media_names[i]},
                   {"absorbed", measured(readout.lumens(scene.blocks.media_power, i, 0), "lm")},
                   {"scattered", measured(readout.lumens(scene.blocks.media_power, i, 1), "lm")}});
  }
  return out;
}

Json counting_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  const auto at = [&](uint32_t i, uint32_t q) {
    return measured(readout.lumens(scene.blocks.counting, i, q), "lm");
  };
  for (uint32_t i = 0; i < scene.counting_planes.size(); ++i) {
    out.push_back({{"name", scene.description->counting_planes[i].name},
                   {"along_normal", {{"uncollided", at(i, 0)}, {"collided", at(i, 1)}}},
                   {"against_normal", {{"uncollided", at(i, 2)}, {"collided", at(i, 3)}}}});
  }
  return out;
}

Json escape_json(const CompiledScene& scene, const Readout& readout) {
  const char* sides[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
  Json out;
  for (uint32_t i = 0; i < 6; ++i)
    out[sides[i]] = measured(readout.lumens(scene.blocks.escape, i, 0), "lm");
  return out;
}

/// A probe's indirect value from one source group; with a single group it is the whole.
Estimate probe_of_group(const CompiledScene& scene, const Readout& readout, uint32_t probe,
                        uint32_t group, uint32_t quantity) {
  const auto groups = static_cast<uint32_t>(scene.groups.size());
  if (groups == 1) return readout.value(scene.blocks.probes, probe, quantity);
  return readout.value(scene.blocks.probes_by_group, probe * groups + group, quantity);
}

/// Direct light at a probe by source group, and of luminaires only as if there were no media.
struct ProbeLight {
  DirectLight groups;
  double luminaires_clear_lx = 0;
};

std::vector<ProbeLight> direct_at_probes(const LocalRun& run) {
  const CompiledScene& scene = run.scene();
  std::vector<ProbeLight> out(scene.description->probes.size());
  run.rows().run(static_cast<int64_t>(out.size()), [&](const GeometryAccess& access) {
    return [&, access](int64_t i) {
      const ProbeMeasure& probe = scene.description->probes[static_cast<size_t>(i)];
      ProbeLight& light = out[static_cast<size_t>(i)];
      light.groups.illuminance_lx.assign(scene.groups.size(), 0);
      light.groups.fluence_lm_m2.assign(scene.groups.size(), 0);
      const auto lights =
          direct_lights(scene, access, glm::vec3(probe.position - scene.local_origin),
                        glm::vec3(probe.normal), {});
      for (size_t e = 0; e < lights.size(); ++e) {
        const auto g = static_cast<size_t>(scene.emitters[e].group);
        light.groups.illuminance_lx[g] += lights[e].illuminance_lx;
        light.groups.fluence_lm_m2[g] += lights[e].fluence_lm_m2;
        if (is_luminaire(scene.emitters[e])) light.luminaires_clear_lx += lights[e].clear_air_lx;
      }
    };
  });
  return out;
}

Json probes_json(const LocalRun& run, const Readout& readout) {
  const CompiledScene& scene = run.scene();
  const std::vector<ProbeLight> direct_light = direct_at_probes(run);
  Json out = Json::array();
  for (uint32_t p = 0; p < scene.description->probes.size(); ++p) {
    const ProbeMeasure& probe = scene.description->probes[p];
    const DirectLight& direct = direct_light[p].groups;
    const Estimate indirect = readout.value(scene.blocks.probes, p, 0);
    const Estimate fluence = readout.value(scene.blocks.probes, p, 1);
    Json groups;
    for (uint32_t g = 0; g < scene.groups.size(); ++g) {
      groups[scene.groups[g].name] = {
          {"direct_illuminance", exact_json(direct.illuminance_lx[g], "lx")},
          {"indirect_illuminance", measured(probe_of_group(scene, readout, p, g, 0), "lx")},
          {"direct_fluence", exact_json(direct.fluence_lm_m2[g], "lx")},
          {"indirect_fluence", measured(probe_of_group(scene, readout, p, g, 1), "lx")}};
    }
    out.push_back(
        {{"name", probe.name},
         {"position", vector_json(probe.position)},
         {"normal", vector_json(probe.normal)},
         {"direct_illuminance", exact_json(direct.total_lx(), "lx")},
         {"luminaires_direct_in_clear_air", exact_json(direct_light[p].luminaires_clear_lx, "lx")},
         {"indirect_illuminance", measured(indirect, "lx")},
         {"illuminance",
          measured({direct.total_lx() + indirect.value, indirect.standard_error}, "lx")},
         {"by_source_group", groups},
         {"fluence",
          measured({direct.total_fluence() + fluence.value, fluence.standard_error}, "lx")}});
  }
  return out;
}

using NamedQuantities = std::initializer_list<std::pair<const char*, GroupEyeQuantity>>;

/// The contribution of each source group to a part of a sign, if there are several groups.
void add_groups_of_sign_part(Json& part, const CompiledScene& scene, const Readout& readout,
                             uint32_t bin, NamedQuantities quantities) {
  const auto groups = static_cast<uint32_t>(scene.groups.size());
  if (groups == 1) return;
  for (uint32_t g = 0; g < groups; ++g) {
    Json& of_group = part["by_source_group"][scene.groups[g].name];
    for (const auto& [name, quantity] : quantities) {
      of_group[name] = measured(readout.value(scene.blocks.views_by_group, bin * groups + g,
                                              static_cast<uint32_t>(quantity)),
                                "cd/m2");
    }
  }
}

Json sign_part_json(const CompiledScene& scene, const Readout& readout, uint32_t bin) {
  const auto of = [&](EyeQuantity q) {
    return readout.value(scene.blocks.views, bin, static_cast<uint32_t>(q));
  };
  Json part = {{"luminance_at_face", measured(of(EyeQuantity::own), "cd/m2")},
               {"reflected_at_face", measured(of(EyeQuantity::reflected), "cd/m2")},
               {"luminance_at_eye", measured(of(EyeQuantity::at_eye), "cd/m2")},
               {"veil", measured(of(EyeQuantity::path), "cd/m2")},
               {"transmission", measured(of(EyeQuantity::transmission), "1")},
               {"visible_share", measured(of(EyeQuantity::visible), "1")}};
  add_groups_of_sign_part(part, scene, readout, bin,
                          {{"reflected_at_face", GroupEyeQuantity::reflected},
                           {"luminance_at_eye", GroupEyeQuantity::at_eye},
                           {"veil", GroupEyeQuantity::path}});
  return part;
}

Json surround_json(const CompiledScene& scene, const Readout& readout, uint32_t bin) {
  const auto at_eye = static_cast<uint32_t>(EyeQuantity::at_eye);
  Json part = {
      {"luminance_at_eye", measured(readout.value(scene.blocks.views, bin, at_eye), "cd/m2")}};
  add_groups_of_sign_part(part, scene, readout, bin,
                          {{"luminance_at_eye", GroupEyeQuantity::at_eye}});
  return part;
}

/// (a - b) / b with first-order error propagation; the two are independent samples.
Json contrast_json(const Estimate& a, const Estimate& b) {
  if (b.value <= 0) return measured_json(std::nan(""), std::nan(""), "1");
  const double ratio = a.value / b.value;
  const double error = std::hypot(a.standard_error, ratio * b.standard_error) / b.value;
  return measured_json(ratio - 1, error, "1");
}

Json views_json(const CompiledScene& scene, const Readout& readout) {
  Json out = Json::array();
  for (const EyeTarget& t : scene.eye_targets) {
    const CompiledSign& face = scene.signs[t.sign];
    const Sign& sign = scene.description->signs[face.sign];
    const Observer& observer = scene.description->observers[t.observer];
    const auto at_eye = [&](uint32_t part) {
      return readout.value(scene.blocks.views, t.first_bin + part,
                           static_cast<uint32_t>(EyeQuantity::at_eye));
    };
    const std::array<Estimate, 3> part{at_eye(0), at_eye(1), at_eye(2)};
    const std::array<double, 2> share = part_shares(sign.face);
    const double whole = std::max(share[0] + share[1], 1e-12);
    const Estimate mean{
        (share[0] * part[0].value + share[1] * part[1].value) / whole,
        std::hypot(share[0] * part[0].standard_error, share[1] * part[1].standard_error) / whole};
    const size_t legend = sign.face.legend_part();
    const SignView view = view_of_sign(sign, observer.eye);
    const double gaze = glm::degrees(std::acos(std::clamp(
        glm::dot(glm::normalize(face.frame.origin - observer.eye), glm::normalize(observer.gaze)),
        -1.0, 1.0)));
    Json json = {{"sign", sign.name},
                 {"back_face", face.back},
                 {"observer", observer.name},
                 {"distance", exact_json(view.distance_m, "m")},
                 {"angle_from_normal", exact_json(view.angle_deg, "deg")},
                 {"angle_from_gaze", exact_json(gaze, "deg")},
                 {"angular_height", exact_json(view.height_arcmin, "arcmin")},
                 {"angular_width", exact_json(view.width_arcmin, "arcmin")},
                 {"angular_detail", exact_json(view.detail_arcmin, "arcmin")}};
    for (uint32_t p = 0; p < 2; ++p) {
      if (face.parts[p] == other_colour) continue;
      const std::string& name = sign.colours[face.parts[p]].name;
      json[p == legend ? "legend" : "ground"] = name;
      json[name] = sign_part_json(scene, readout, t.first_bin + p);
    }
    json["surround"] = surround_json(scene, readout, t.first_bin + 2);
    json["contrast_legend_background"] = contrast_json(part[legend], part[1 - legend]);
    json["contrast_sign_surround"] = contrast_json(mean, part[2]);
    out.push_back(std::move(json));
  }
  return out;
}

/// A relative standard error and the value that it belongs to.
struct NamedError {
  double error;
  Json of;
};

/// Median and largest of the relative standard errors of one kind of values that are above 0, by
/// which a run is judged. Null where there is none, or where a value has no error yet.
Json spread_json(std::vector<NamedError> errors) {
  if (errors.empty())
    return {{"median", exact_json(std::nan(""), "1")},
            {"worst", exact_json(std::nan(""), "1")},
            {"worst_of", nullptr}};
  std::stable_sort(errors.begin(), errors.end(),
                   [](const NamedError& a, const NamedError& b) { return a.error < b.error; });
  const size_t n = errors.size();
  return {{"median", exact_json((errors[(n - 1) / 2].error + errors[n / 2].error) / 2, "1")},
          {"worst", exact_json(errors.back().error, "1")},
          {"worst_of", errors.back().of}};
}

/// Which value it is: a name, or a sign and its observer.
Json subject_of(const Json& item) {
  if (!item.contains("sign")) return {{"name", item["name"]}};
  return {{"sign", item["sign"]}, {"observer", item["observer"]}};
}

/// The parts of worst_relative_error: poorly known distant signs in smoke must not hide well known
/// planes.
Json relative_errors_json(const Json& result) {
  const auto of = [&](const char* list, const auto& judged) {
    std::vector<NamedError> errors;
    for (const Json& item : result[list]) {
      const Json& value = judged(item);
      if (!value["value"].is_number() || value["value"].get<double>() <= 0) continue;
      const Json& error = value["standard_error"];
      errors.push_back({error.is_number() ? error.get<double>() / value["value"].get<double>()
                                          : std::numeric_limits<double>::infinity(),
                        subject_of(item)});
    }
    return spread_json(std::move(errors));
  };
  return {
      {"planes", of("planes", [](const Json& p) -> const Json& { return p["mean_illuminance"]; })},
      {"probes",
       of("probes", [](const Json& p) -> const Json& { return p["indirect_illuminance"]; })},
      {"signs",
       of("signs", [](const Json& s) -> const Json& { return s["white"]["luminance_at_eye"]; })}};
}

Json optional_json(const auto& value) {
  return value ? Json(*value) : Json();
}

Json stop_json(const StopRule& stop) {
  return {{"particles", optional_json(stop.particles)},
          {"relative_error", optional_json(stop.relative_error)},
          {"seconds", optional_json(stop.seconds)}};
}

std::string hash_text(const CompiledScene& scene) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(scene.scene_hash));
  return hash;
}

Json source_groups_json(const CompiledScene& scene) {
  Json groups = Json::array();
  for (size_t g = 0; g < scene.groups.size(); ++g) {
    const Group& group = scene.groups[g];
    groups.push_back(
        {{"name", group.name}, {"luminous_flux", exact_json(group.luminous_flux_lm, "lm")}});
    if (!scene.batch_shares.empty()) groups.back()["batch_share"] = scene.batch_shares[g];
  }
  return groups;
}

Json cameras_json(const SceneDescription& scene) {
  Json cameras = Json::array();
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    cameras.push_back({{"name", scene.cameras[i].name}, {"files", files_of_view(scene, i)}});
  return cameras;
}

/// Why standard errors are null; "" where they are known.
std::string why_no_errors(const LocalRun& run) {
  int64_t least = run.traced();
  for (int g = 0; g < run.totals().groups(); ++g) least = std::min(least, run.totals().batches(g));
  if (least >= 2) return "";
  return "an error needs two batches of every source group, and one of them has " +
         std::to_string(least) + ": trace more particles";
}

/// The head of every result.json.
Json head_json(const CompiledScene& scene, const RunRecord& record) {
  Json head = {{"schema", result_schema},
               {"program", "luxodus"},
               {"scene", scene.description->name},
               {"title", scene.description->title},
               {"scene_file", record.scene_file},
               {"scene_hash", hash_text(scene)},
               {"scenario", scene.scenario.name},
               {"state", run_state_json(scene)},
               {"cells", record.cells}};
  if (record.at_s) head["at_s"] = *record.at_s;
  return head;
}

}  // namespace

Json result_json(const LocalRun& run, const RunRecord& record, const PlaneMaps& maps) {
  const CompiledScene& scene = run.scene();
  const Readout readout(scene, run.totals());
  const double error = readout.worst_relative_error();
  const double seconds = run.seconds();
  const auto rays = static_cast<double>(run.timed_rays());
  // From statistical errors and the whole run's time.
  const bool all_timed = run.timed_particles() == run.particles();
  const double fom =
      error > 0 && seconds > 0 && all_timed ? 1 / (error * error * seconds) : std::nan("");
  Json out = head_json(scene, record);
  out.update(Json{{"kernel", describe_kernel(scene)},
                  {"seed", run.seed()},
                  {"particles", run.particles()},
                  {"batches", run.traced()},
                  {"batch_particles", scene.batch_particles},
                  {"finished", true},
                  {"stopped_by", record.stopped_by},
                  {"stop_rule", stop_json(record.stop)},
                  {"threads", run.threads()},
                  {"seconds", exact_json(seconds, "s")},
                  {"timed_particles", run.timed_particles()},
                  {"particles_per_second",
                   exact_json(static_cast<double>(run.timed_particles()) / seconds, "1/s")},
                  {"rays_per_second", exact_json(rays / seconds, "1/s")},
                  {"worst_relative_error", exact_json(error, "1")},
                  {"error_of", scene.error_target.words},
                  {"unlit", readout.unlit()},
                  {"figure_of_merit", exact_json(fom, "1/s")},
                  {"ledger", ledger_json(run.totals().balance())}});
  if (!all_timed)
    out["timing"] =
        "seconds and rates are of the particles traced since the run was resumed; nobody wrote "
        "down how long the others took, so there is no figure of merit";
  if (const std::string why = why_no_errors(run); !why.empty())
    out["standard_errors_unknown"] = why;
  out["source_groups"] = source_groups_json(scene);
  out["planes"] = planes_json(run, readout, maps);
  out["probes"] = probes_json(run, readout);
  out["signs"] = views_json(scene, readout);
  out["surfaces"] = surfaces_json(scene, readout);
  out["surface_groups"] = surface_groups_json(scene, readout);
  out["volume_groups"] = volumes_json(scene, readout);
  out["media"] = media_json(scene, readout);
  out["counting_planes"] = counting_json(scene, readout);
  out["escape"] = escape_json(scene, readout);
  out["relative_errors"] = relative_errors_json(out);
  out["cameras"] = cameras_json(*scene.description);
  return out;
}

Json result_json(const LocalRun& run, const RunRecord& record) {
  return result_json(run, record, make_plane_maps(run));
}

Json begun_json(const LocalRun& run, const RunRecord& record, double seconds) {
  const CompiledScene& scene = run.scene();
  Json planes = Json::array();
  for (size_t i = 0; i < scene.description->planes.size(); ++i)
    planes.push_back({{"name", scene.description->planes[i].name},
                      {"files", files_of_plane(*scene.description, i)}});
  Json out = head_json(scene, record);
  out.update(Json{{"seed", run.seed()},
                  {"particles", run.particles()},
                  {"timed_particles", run.timed_particles()},
                  {"batches", run.traced()},
                  {"finished", false},
                  {"stop_rule", stop_json(record.stop)},
                  {"seconds", exact_json(seconds, "s")},
                  {"error_of", scene.error_target.words},
                  {"source_groups", source_groups_json(scene)},
                  {"planes", std::move(planes)},
                  {"cameras", cameras_json(*scene.description)}});
  return out;
}

Result<void> begin_results(const std::filesystem::path& folder, const LocalRun& run,
                           const RunRecord& record) {
  if (auto ok = remove_old_maps(folder); !ok) return ok.problem();
  std::error_code error;
  std::filesystem::create_directories(folder / "planes", error);
  if (error) return system_problem(folder, "cannot make this folder", error.value());
  // Written first, so that the files to come are recognised as a run's even if this process is
  // killed.
  return write_json(folder / "result.json", begun_json(run, record, run.seconds()));
}

Result<Json> finish_results(const std::filesystem::path& folder, const LocalRun& run,
                            const RunRecord& record, const ShareDone& progress) {
  const PlaneMaps maps = make_plane_maps(run, progress);
  if (auto ok = write_plane_maps(folder / "planes", run, maps); !ok) return ok.problem();
  if (auto ok = write_flux_maps(folder, run); !ok) return ok.problem();
  Json result = result_json(run, record, maps);
  if (auto ok = write_json(folder / "result.json", result); !ok) return ok.problem();
  // What is in range stays written.
  if (auto ok = Readout(run.scene(), run.totals()).check_range(); !ok) return ok.problem();
  return result;
}

}  // namespace luxodus

#include "actors/apps/cli/run_folder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/apps/cli/finished_run.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/formats/flux_file.hpp"
#include "actors/results/formats/json_out.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

/// Most room reserved for a flux file [bytes]: large ones are mostly zeros, which compress to
/// little.
constexpr uint64_t max_room = uint64_t{256} << 20;
/// Two runs of the same time limit differ by a batch on every thread and by the machine's load.
constexpr double time_slack = 1.1, time_slack_s = 2;

/// The run whose flux is in a folder; particles 0 if there is none of the same scene.
struct EarlierRun {
  int64_t particles = 0;
  Json result;  // result.json; null without one
};

int64_t whole_or_zero(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number_integer() ? at->get<int64_t>() : 0;
}

EarlierRun earlier_run(const fs::path& folder, const CompiledScene& scene) {
  const auto flux = read_flux_file(folder / "flux.lux");
  if (!flux) return {};
  const Json head = Json::parse(flux->header_json);
  if (!head.is_object()) return {};
  const bool same = head.value("scene_hash", Json()) == fmt::format("{:016x}", scene.scene_hash) &&
                    head.value("scenario", Json()) == scene.scenario.name;
  if (!same) return {};
  const auto missing = static_cast<int64_t>(head.value("missing", Json::array()).size());
  EarlierRun run;
  run.particles =
      (whole_or_zero(head, "batches") - missing) * whole_or_zero(head, "batch_particles");
  if (const auto read = read_json_file(folder / "result.json"); read) run.result = read.value();
  return run;
}

double number_at(const Json& json, const char* key, const char* inner) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_object()) return std::nan("");
  const Json& value = json[key].value(inner, Json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// Whether a run with this stopping rule has at least the particles of the earlier one, however it
/// stops.
bool is_surely_as_long(const StopRule& stop, const EarlierRun& earlier, int64_t batch_particles) {
  if (stop.particles) {
    const int64_t batches = (*stop.particles + batch_particles - 1) / batch_particles;
    if (batches * batch_particles < earlier.particles) return false;
  }
  if (stop.relative_error) {
    const double asked = number_at(earlier.result, "stop_rule", "relative_error");
    const double reached = number_at(earlier.result, "worst_relative_error", "value");
    if (!(*stop.relative_error <= asked) && !(*stop.relative_error <= reached)) return false;
  }
  if (stop.seconds) {
    const double took = number_at(earlier.result, "seconds", "value");
    const double asked = number_at(earlier.result, "stop_rule", "seconds");
    // An equal rule of an earlier run that was not resumed, or that had less time.
    const bool again = asked <= *stop.seconds && took <= *stop.seconds * time_slack + time_slack_s;
    if (!again && !(took <= *stop.seconds)) return false;
  }
  return true;
}

Problem nothing_to_resume(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "assessment.json", ignored))
    return problem_in(
        folder,
        "this is the folder of an assessment, and there is no run in it to go on from: give "
        "the folder of luxodus run, or leave out --resume");
  return problem_in(
      folder,
      "there is no flux.lux here to go on from: give the folder of a run, or leave out "
      "--resume");
}

uint64_t flux_bytes(const CompiledScene& scene) {
  const auto totals = static_cast<uint64_t>(scene.layout.totals());
  return std::min(max_room, totals * sizeof(Total) * scene.groups.size()) + (uint64_t{4} << 20);
}

}  // namespace

Result<RunFolder> claim_run_folder(const fs::path& folder, const CompiledScene& scene,
                                   const RunFolderOptions& options) {
  std::error_code ignored;
  if (options.resume && !fs::exists(folder / "flux.lux", ignored)) return nothing_to_resume(folder);
  const OutputPlan plan = run_output(*scene.description, options.views);
  auto output = OutputFolder::claim(folder, plan);
  if (!output) return output.problem();
  RunFolder claimed{std::move(output).value()};
  claimed.goes_on = options.resume;
  if (!options.overwrite) {
    if (auto ok = refuse_foreign_files(claimed.path(), plan); !ok) return ok.problem();
  }
  if (!options.overwrite && !options.resume) {
    const EarlierRun earlier = earlier_run(claimed.path(), scene);
    if (earlier.particles > 0 && !is_surely_as_long(options.stop, earlier, scene.batch_particles))
      return problem_in(
          folder, fmt::format("this folder holds a run of the same scene with {} particles, and "
                              "this one may end with fewer: add --resume to go on from it, "
                              "--overwrite to replace it, or give another --out",
                              short_number(static_cast<double>(earlier.particles))));
    claimed.keep_particles = earlier.particles;
  }
  if (auto kept = claimed.room->take(claimed.path(), flux_bytes(scene)); !kept)
    log_warning("{}", kept.problem().text());
  return claimed;
}

}  // namespace luxodus::cli

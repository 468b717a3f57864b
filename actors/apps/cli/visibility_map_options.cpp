#include "actors/apps/cli/visibility_map_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/judge/visibility_map/map_files.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

constexpr const char* map_group = "Visibility map";
constexpr const char* map_flag = "--visibility-map";

Result<MapRequest> map_request_of(const StatesToAssess& states, const AssessOptions& options,
                                  const MapWords& words) {
  MapRequest out;
  out.estimates.states = states;
  out.estimates.options = options;
  out.estimates.options.rounds = words.rounds;
  out.estimates.signs = words.signs;
  out.spacing_m = words.spacing_m;
  out.heights_m = words.heights_m;
  out.facings_deg = words.facings_deg;
  if (!std::isnan(words.floor_m)) out.floor_m = words.floor_m;
  if (words.facings_deg.size() > limits::map_facings)
    return problem(fmt::format("--map-facing takes at most {} directions", limits::map_facings));
  if (!words.box.empty() && words.box.size() != 4)
    return problem("--map-box takes two corners: X0,Y0,X1,Y1");
  if (words.box.size() == 4)
    out.box = {glm::dvec2(words.box[0], words.box[1]), glm::dvec2(words.box[2], words.box[3])};
  return out;
}

/// The signs of the map, in its order. Errors: an unknown name.
Result<std::vector<const Sign*>> map_signs_of(const SceneDescription& scene,
                                              const MapWords& words) {
  const auto numbers = signs_named(scene, words.signs);
  if (!numbers) return numbers.problem();
  std::vector<const Sign*> out;
  for (const uint32_t number : numbers.value()) out.push_back(&scene.signs[number]);
  return out;
}

/// Errors: the folder holds a file of a map and not all that a map writes: others have written it.
Result<void> refuse_files_of_others(const std::filesystem::path& folder) {
  std::error_code error;
  size_t there = 0;
  std::filesystem::path last;
  for (const char* file : {evac_map_file, whole_map_file, map_table_file, map_states_folder})
    if (std::filesystem::exists(std::filesystem::symlink_status(folder / file, error))) {
      ++there;
      last = folder / file;
    }
  constexpr size_t of_a_map = 4;
  if (there == 0 || there == of_a_map) return {};
  return problem_in(last,
                    "this is there and no map has written it: move it away, give another folder, "
                    "or add --overwrite to replace it");
}

void print_map(const VisibilityMap& map) {
  std::array<size_t, sign_answers> counts{};
  for (const SignAnswer answer : map.answers) ++counts[static_cast<size_t>(answer)];
  std::string words;
  for (size_t a = 0; a < counts.size(); ++a)
    words +=
        fmt::format("{}{} {}", a == 0 ? "" : ", ", counts[a], name_of(static_cast<SignAnswer>(a)));
  std::printf("%zu places, %zu eye heights, %zu times, %zu signs: %s\n", map.grid.places(),
              map.heights_m.size(), map.states(), map.signs.size(), words.c_str());
  std::printf("traced from %zu supports, %lld paths; an answer holds at %.1f standard errors\n",
              map.supports, static_cast<long long>(map.paths), map.sure_errors);
  if (map.lost_supports > 0)
    std::printf(
        "%zu supports found more light than is counted, as places beside a lamp do: little is "
        "decided near them\n",
        map.lost_supports);
}

}  // namespace

void add_map_options(Command& command, MapWords& words) {
  const std::vector<Option> options{
      {map_flag,
       &words.wanted,
       "Map of what is read and seen from a grid of places, instead of the assessment",
       {.group = map_group}},
      {"--map-spacing",
       &words.spacing_m,
       "Distance between places [m]",
       {.range = Range{0.02, 100}, .group = map_group, .needs = map_flag}},
      {"--map-heights",
       &words.heights_m,
       "Heights of eyes above the floor [m]; the first is that of visibility.npz",
       {.otherwise = "those of the scene",
        .range = Range{0.01, 100},
        .group = map_group,
        .needs = map_flag,
        .comma_separated = true}},
      {"--map-floor",
       &words.floor_m,
       "Height of the floor [m]",
       {.otherwise = "the lowest of the routes and open areas",
        .range = Range{-1e5, 1e5},
        .group = map_group,
        .needs = map_flag}},
      {"--map-box",
       &words.box,
       "Corners of the map, seen from above: X0,Y0,X1,Y1 [m]",
       {.otherwise = "the box around the building",
        .range = Range{-1e6, 1e6},
        .group = map_group,
        .needs = map_flag,
        .comma_separated = true}},
      {"--map-facing",
       &words.facings_deg,
       "Directions in which people look, from +y clockwise [degrees]",
       {.otherwise = "none",
        .range = Range{-360, 360},
        .group = map_group,
        .needs = map_flag,
        .comma_separated = true}},
      {"--map-signs",
       &words.signs,
       "Names of signs",
       {.form = Form::name,
        .otherwise = "all",
        .group = map_group,
        .needs = map_flag,
        .comma_separated = true}},
      {"--map-rounds",
       &words.rounds,
       "Largest number of rounds of paths for what is undecided",
       {.range = Range{1, limits::sight_rounds}, .group = map_group, .needs = map_flag}},
      {"--evac-config",
       &words.evac.config,
       "Signs for visibility.npz: a config.json of pyFDS-Evac",
       {.form = Form::file, .group = map_group, .needs = map_flag}},
      {"--evac-fds-dir",
       &words.evac.fds_folder,
       "Folder that pyFDS-Evac is given as --fds-dir",
       {.form = Form::folder,
        .otherwise = "that of the scene's fire simulation",
        .group = map_group,
        .needs = map_flag}},
      {"--evac-interval",
       &words.evac.reroute_interval_s,
       "Seconds that pyFDS-Evac is given as --reroute-interval",
       {.range = Range{1e-3, 1e6}, .group = map_group, .needs = map_flag}},
      {"--evac-slice-height",
       &words.evac.slice_height_m,
       "Height that pyFDS-Evac is given as --smoke-slice-height [m]",
       {.range = Range{-1e5, 1e5}, .group = map_group, .needs = map_flag}}};
  command.options.insert(command.options.end(), options.begin(), options.end());
}

Result<ExitCode> map_into(const std::filesystem::path& folder, const StatesToAssess& states,
                          const AssessOptions& options, const MapWords& words) {
  auto request = map_request_of(states, options, words);
  if (!request) return request.problem();
  const auto signs = map_signs_of(*states.last, words);
  if (!signs) return signs.problem();
  auto evac = words.evac.config.empty() ? Result(evac_signs_of(signs.value()))
                                        : read_evac_signs(words.evac.config, signs.value());
  if (!evac) return evac.problem();
  request->evac_signs = evac->size();
  const auto scenario = judged_scenario(*states.last, options.scenario);
  if (!scenario) return scenario.problem();
  if (const auto told = refused_by_inspection(states.last, {scenario.value()}, options.threads))
    return exit_code_of(*told);
  const auto out = OutputFolder::claim(
      folder, {{evac_map_file, whole_map_file, map_table_file}, {map_states_folder}});
  if (!out) return out.problem();
  if (!words.overwrite)
    if (auto ok = refuse_files_of_others(out->path()); !ok) return ok.problem();
  ProgressLine line("map");
  const auto map =
      make_map(request.value(), interrupt_flag(), [&](const std::string& what, double share) {
        line.put(fmt::format("{}: {:.0f} %", what, 100 * share), share >= 1, share);
      });
  if (!map) {
    if (!interrupt_flag()) return map.problem();
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  const auto fds_folder = fds_folder_of(words.evac, *states.last);
  const Json meta = evac_meta(words.evac, fds_folder.value_or(""), evac.value());
  if (auto ok = write_map(out->path(), map.value(), evac.value(), meta); !ok) return ok.problem();
  print_map(map.value());
  const auto file = out->named() / evac_map_file;
  std::printf("%s\n", evac_words(words.evac, fds_folder, file.string()).c_str());
  return ExitCode::success;
}

}  // namespace luxodus::cli

// luxodus import: turns buildings of other programs into scenes that the user goes on with.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/import/write_fire.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/formats/fds_input/input_building.hpp"
#include "scenes/formats/fields/fds.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::string file;
  std::string out;
  std::string at;  // usual_time_s where empty, or what the run reaches
  bool snap = false;
  std::vector<std::string> without;
};

/// The time that is taken unless another is asked for [s].
constexpr double usual_time_s = 60;

/// The imported building and its source.
struct FireImport {
  FireBuilding building;
  FireOrigin source;
};

/// The time that is asked for, else the usual one, or the last that the run reaches. `end_s`: that
/// of an input file without results.
double time_of(const ImportOptions& options, const std::optional<std::string>& index,
               std::optional<double> end_s = {}) {
  if (const auto asked = time_asked(options.at)) return *asked;
  if (index) return fire_time_near(*index, usual_time_s).value_or(usual_time_s);
  return std::clamp(end_s.value_or(usual_time_s), 0.0, usual_time_s);
}

FireOrigin source_of(const ImportOptions& options, const char* how, double at_s) {
  FireOrigin out;
  const fs::path file(options.file);
  out.title = file.stem().string() + " from FDS";
  out.made_of = fmt::format("The building of {} {}", file.filename().string(), how);
  out.at_text = options.at.empty() ? fmt::format("{:g}s", at_s) : options.at;
  out.at_s = at_s;
  return out;
}

Result<FireImport> of_results(const ImportOptions& options) {
  if (!options.without.empty() || options.snap)
    return problem_in(options.file,
                      "--without and --snap are for input files (.fds): results say by themselves "
                      "what is there at a time, and are snapped");
  FireImport out;
  out.source =
      source_of(options, "as FDS computed it, snapped to its grid", time_of(options, options.file));
  out.source.index = options.file;
  auto building = read_fire_building(options.file, out.source.at_s);
  if (!building) return building.problem();
  out.building = std::move(building).value();
  return out;
}

/// The index of the results beside an input file, if any. Input of several files (&CATF) has a name
/// of its own for them.
std::optional<std::string> index_beside(const std::string& file, const std::string& case_name) {
  for (const char* ending : {".smv", "_cat.smv"}) {
    const fs::path index = fs::path(file).parent_path() / (case_name + ending);
    std::error_code failed;
    if (fs::is_regular_file(index, failed)) return index.string();
  }
  return std::nullopt;
}

bool is_input_file(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".fds";
}

Result<FireImport> of_input(const ImportOptions& options, ReadingShare& reading) {
  const auto input = read_fds_input(options.file);
  if (!input) return input.problem();
  FireImport out;
  const auto index = index_beside(options.file, input->case_name);
  out.source =
      source_of(options, options.snap ? "snapped to the cells of its meshes" : "as written",
                time_of(options, index, input->end_s));
  out.source.index = index;
  FdsInputOptions wanted;
  wanted.at_s = out.source.at_s;
  wanted.without = {options.without.begin(), options.without.end()};
  wanted.reading = &reading;
  auto building = options.snap ? snapped_building(input.value(), wanted)
                               : exact_building(input.value(), wanted);
  if (!building) return building.problem();
  out.building = std::move(building).value();
  return out;
}

Result<ExitCode> import_fds(const ImportOptions& options) {
  const bool is_input = is_input_file(options.file);
  const auto made = [&] {
    ReadingShare reading;
    const WaitingLine waiting("reading " + options.file, &reading);
    return is_input ? of_input(options, reading) : of_results(options);
  }();
  if (!made) return made.problem();
  const FireBuilding& building = made->building;
  const auto kept = write_fire(building, made->source, options.out);
  if (!kept) return kept.problem();
  std::printf(
      "boxes %zu, plates %zu, bodies %zu, rectangles of walls, floors and ceilings %zu; "
      "obstructions that are not there at %s: %zu\n",
      building.solids, building.plates, building.bodies.size(), building.faces,
      made->source.at_text.c_str(), building.absent.size());
  for (const std::string& note : building.notes) std::printf("note: %s\n", printable(note).c_str());
  if (is_input && !made->source.index)
    std::printf("note: there are no results of this case beside it, so the scene has no smoke\n");
  std::printf("%s%s\n", (fs::path(options.out) / "geometry.toml").c_str(),
              kept.value() ? ", and scene.toml as it was" : " and scene.toml");
  return ExitCode::success;
}

}  // namespace

Command import_command() {
  const auto o = std::make_shared<ImportOptions>();
  Command fds{
      .name = "fds",
      .summary = "Make a scene of an FDS case: its building, and its smoke by reference",
      .options =
          {{"case",
            &o->file,
            "Input file of the case (.fds), or index of its results (.smv)",
            {.form = Form::file, .required = true}},
           {"-o,--out", &o->out, "Folder of the scene", {.form = Form::folder, .required = true}},
           {"--at", &o->at,
            "Time at which obstructions count, and of the smoke (60s, or the end of a shorter run)",
            at_option(o->at).traits},
           {"--snap", &o->snap,
            "Geometry of an input file on the cells of its meshes, as FDS computes it"},
           {"--without",
            &o->without,
            "IDs of obstructions, holes and openings of an input file that are not there; \"line "
            "12\" "
            "names one without an ID",
            {.form = Form::name}}},
      .notes =
          "Of results (.smv), obstructions become boxes as FDS has snapped them to its grid. Of an "
          "input file (.fds), they are as written, cut by holes, or with --snap as FDS would snap "
          "them; the smoke is that of the results beside it. The closed faces of meshes become "
          "rectangles. geometry.toml is written anew by every import; scene.toml and "
          "materials.toml are yours.\n"
          "  luxodus import fds results/corridor.smv --out corridor\n"
          "  luxodus import fds corridor.fds --snap --out corridor\n"
          "  luxodus check corridor/scene.toml",
      .run = [o] { return exit_code_of(import_fds(*o)); }};
  return {.name = "import",
          .summary = "Make a scene of what other programs know",
          .heading = "Scenes",
          .commands = {std::move(fds), import_gldf_command(), import_ifc_command(),
                       import_dxf_command(), import_vdb_command()}};
}

}  // namespace luxodus::cli

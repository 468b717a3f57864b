// The order of reading: every file is parsed, includes first, then the tables of all files kind by
// kind, so that names are known before they are used, in whichever file they stand. A syntax error
// ends its file.
#include "scenes/formats/scene_file/scene_file.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/document.hpp"
#include "runtime/toml/text_scan.hpp"
#include "scenes/formats/scene_file/read_luminaires.hpp"
#include "scenes/formats/scene_file/scene_people.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/import.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// One parsed file. Its top-level reader refers to the document, so a SceneText does not move.
struct SceneText {
  SceneText(toml::Document parsed, SceneReading& reading)
      : document(std::move(parsed)), keys(document.top, {"scene"}, reading) {}
  SceneText(const SceneText&) = delete;
  SceneText& operator=(const SceneText&) = delete;

  toml::Document document;
  KeyReader keys;
};

class Loader {
 public:
  explicit Loader(SceneReading& reading) : reading_(reading) {}

  /// Parses a file after those it includes. `said_at`: the include that names it.
  void load(const fs::path& path, const SourcePlace& said_at) {
    std::error_code error;
    fs::path canonical = fs::weakly_canonical(path, error);
    if (error) canonical = path;
    const std::string id = canonical.string();
    if (std::find(open_.begin(), open_.end(), id) != open_.end()) {
      reading_.problem(said_at, "'" + path.filename().string() +
                                    "' is included by a file that it includes itself, in a circle");
      return;
    }
    if (std::find(done_.begin(), done_.end(), id) != done_.end()) return;
    if (done_.size() + open_.size() >= scene_limits::included_files) {
      reading_.problem(
          said_at, "a scene may have " + std::to_string(scene_limits::included_files) + " files");
      return;
    }
    const auto text = bytes_of(path);
    auto document = text ? parse(*text, path) : nullptr;
    if (!document) {
      reading_.incomplete = true;
      return;
    }
    open_.push_back(id);
    for (const auto& [included, place] : document->keys.files("include")) load(included, place);
    if (document->keys.has("include") && !document->keys.clean()) reading_.incomplete = true;
    open_.pop_back();
    done_.push_back(id);
    documents.push_back(std::move(document));
  }

  /// Parses a text that is added to all that was loaded. `name`: in messages.
  void add(std::string_view text, const std::string& name) {
    if (auto document = parse_as(text, name, toml::QuotePolicy::allowed))
      documents.push_back(std::move(document));
    else
      reading_.incomplete = true;
  }

  std::vector<std::unique_ptr<SceneText>> documents;  // a file comes after those it includes

 private:
  std::optional<std::string> bytes_of(const fs::path& path) {
    const auto size = size_of_regular_file(path);
    if (!size) {
      if (size.problem().kind == ProblemKind::not_found)
        reading_.problem({path.string(), 0}, "there is no such scene file");
      else
        reading_.problem(size.problem());
      return std::nullopt;
    }
    if (size.value() > scene_limits::file_bytes) {
      reading_.problem({path.string(), 0},
                       "this scene file has " + std::to_string(size.value()) + " bytes; at most " +
                           std::to_string(scene_limits::file_bytes) +
                           " are read; put large geometry into an OBJ or glTF file");
      return std::nullopt;
    }
    auto text = read_regular_file(path, scene_limits::file_bytes);
    if (text) {
      reading_.files.add(path.string(), XXH3_64bits(text->data(), text->size()));
      return std::move(text).value();
    }
    reading_.problem(text.problem());
    return std::nullopt;
  }

  std::unique_ptr<SceneText> parse(const std::string& text, const fs::path& path) {
    // The text of an included file is not quoted: it may be any file on the machine.
    const bool own = open_.empty() && done_.empty() && documents.empty();
    return parse_as(text, path.string(),
                    own ? toml::QuotePolicy::allowed : toml::QuotePolicy::withheld);
  }

  std::unique_ptr<SceneText> parse_as(std::string_view text, const std::string& name,
                                      toml::QuotePolicy quoting) {
    reading_.hash_bytes(toml::with_earlier_names(text, scene_schema()));
    auto document = toml::parse(text, name, scene_limits::file_bytes, quoting);
    if (document) return std::make_unique<SceneText>(std::move(document).value(), reading_);
    const Problem& problem = document.problem();
    reading_.problem(problem.where, quoting == toml::QuotePolicy::allowed
                                        ? problem.what
                                        : problem.what + ": an included file must be a scene file");
    return nullptr;
  }

  SceneReading& reading_;
  std::vector<std::string> open_, done_;
};

using Documents = std::vector<std::unique_ptr<SceneText>>;
using Reader = void (*)(const toml::Table&, SceneReading&);

/// A side is named once, and by one of its names. A file's own list replaces that of its includes.
void read_open_sides(KeyReader& keys, SceneReading& reading) {
  if (!keys.has("open_sides")) return;
  reading.scene.open_sides.clear();
  for (const std::string& word : keys.texts("open_sides")) {
    const auto at = std::find(side_words.begin(), side_words.end(), word);
    if (at == side_words.end()) {
      keys.problem("open_sides", "'open_sides' knows no side '" + word +
                                     "'; write west, east, south, north, bottom or top");
      continue;
    }
    const auto side = static_cast<Side>(at - side_words.begin());
    auto& sides = reading.scene.open_sides;
    if (std::find(sides.begin(), sides.end(), side) == sides.end()) sides.push_back(side);
  }
}

void read_head(const Documents& documents, const fs::path& path, SceneReading& reading) {
  reading.scene.name = path.stem().string();
  reading.scene.file = path.string();
  for (const auto& d : documents) {
    KeyReader& keys = d->keys;
    if (keys.has("title")) reading.scene.title = keys.text("title");
    if (keys.has("patch_edge_m")) reading.patch_edge_m = keys.number("patch_edge_m");
    read_open_sides(keys, reading);
    const auto name = keys.maybe_text("name");
    if (name) reading.scene.name = *name;
    if (const toml::Table* run = keys.table("run")) read_run(*run, reading);
    if (const toml::Table* assessment = keys.table("assessment"))
      read_assessment(*assessment, reading);
    if (const toml::Table* time = keys.table("time")) read_time(*time, reading);
    if (const toml::Table* project = keys.table("project")) read_project(*project, reading);
  }
}

void read_all(const Documents& documents, std::string_view key, Reader reader,
              SceneReading& reading) {
  size_t count = 0;
  for (const auto& d : documents) {
    const auto tables = d->keys.tables(key);
    count += tables.size();
    if (count > scene_limits::tables_per_kind) {
      reading.problem(d->keys.place(key), "the files of this scene have more than " +
                                              std::to_string(scene_limits::tables_per_kind) +
                                              " tables '" + std::string(key) + "' together");
      return;
    }
    for (const toml::Table* t : tables) reader(*t, reading);
  }
}

/// Announces a large file that a table names to the progress, as its reader will. Faults are
/// reported when it is read.
void foresee(const toml::Table& table, ReadingShare& share) {
  const toml::Value* kind = table.find("kind");
  if (kind != nullptr && kind->as_text() != nullptr && *kind->as_text() == "fds")
    return share.foresee_unknown();
  const toml::Value* file = table.find("file");
  if (file == nullptr || file->as_text() == nullptr) return;
  const fs::path path = fs::path(file->place().file).parent_path() / *file->as_text();
  const std::string ending = mesh_ending(path.string());
  constexpr std::array large{".obj", ".gltf", ".glb", ".dxf"};
  std::error_code unknown;
  if (std::find(large.begin(), large.end(), ending) == large.end() ||
      !fs::is_regular_file(path, unknown))
    return;
  const uint64_t bytes = fs::file_size(path, unknown);
  if (!unknown) share.foresee(bytes);
}

void foresee_files(const Documents& documents, ReadingShare* share) {
  if (share == nullptr) return;
  for (const auto& d : documents)
    for (const char* key : {"import", "emitter", "medium", "backdrop"})
      if (const toml::Value* tables = d->document.top.find(key); tables && tables->as_list())
        for (const toml::Value& value : *tables->as_list())
          if (const toml::Table* table = value.as_table()) foresee(*table, *share);
}

void read_designs(const Documents& documents, SceneReading& reading) {
  DesignSettings design;
  design.place = {reading.scene.file, 1};
  for (const auto& d : documents)
    if (const toml::Table* table = d->keys.table("design")) read_design(*table, reading, design);
  complete_design(reading, std::move(design));
}

/// Adds people as objects where the scene has them stand as bodies. A file's own word replaces that
/// of its includes.
void read_bodies_of_people(Loader& loader, SceneReading& reading) {
  const KeyReader* said = nullptr;
  for (const auto& d : loader.documents)
    if (d->keys.has("people_as_bodies")) {
      reading.scene.people_are_bodies = d->keys.flag("people_as_bodies");
      said = &d->keys;
    }
  if (!reading.scene.people_are_bodies) return;
  reading.changes_in_time = reading.goes_by_clock = true;
  const SourcePlace place = said->place("people_as_bodies");
  if (reading.people.empty())
    return reading.problem(place, "'people_as_bodies' needs [[people]], which this scene has not");
  const auto time_s = reading.time_s();
  if (!time_s)
    return reading.problem(place,
                           "'people_as_bodies' needs a time at which they stand: state [time], or "
                           "give --at");
  const std::string text = people_as_objects(reading, *time_s);
  if (text.empty()) return;
  const size_t first = loader.documents.size();
  loader.add(text, "people as bodies");
  for (size_t i = first; i < loader.documents.size(); ++i)
    for (const toml::Table* object : loader.documents[i]->keys.tables("object"))
      read_object(*object, reading);
}

/// Checks that need the whole scene.
void check_whole(SceneReading& reading) {
  const SceneDescription& s = reading.scene;
  const bool flames = std::any_of(s.media.begin(), s.media.end(),
                                  [](const Medium& m) { return m.emission.has_value(); });
  if (s.emitters.empty() && s.signs.empty() && !flames) {
    reading.warning({s.file, 1},
                    "nothing in this scene gives light (luxodus design places luminaires)");
  }
  if (s.objects.empty()) reading.warning({s.file, 1}, "this scene has no surfaces");
  const bool fails = std::any_of(s.scenarios.begin(), s.scenarios.end(), [](const Scenario& one) {
    return one.written_operation != Operation::mains;
  });
  if (s.time && s.time->mains_fail_at_s && !fails)
    reading.problem(s.time->place,
                    "the mains fail, and no scenario says what is lit then: add [[scenario]] with "
                    "operation = \"emergency\"");
}

}  // namespace

ReadScene read_scene(const std::filesystem::path& path, std::optional<double> at_s,
                     std::string_view changes, FireFrames frames, ReadingShare* share) {
  SceneReading reading;
  reading.share = share;
  reading.at_s = at_s;
  reading.frames = frames;
  Loader loader(reading);
  loader.load(path, {path.string(), 1});
  if (!changes.empty()) loader.add(changes, named_changes);
  const Documents& documents = loader.documents;
  foresee_files(documents, share);
  read_head(documents, path, reading);
  read_all(documents, "material", read_material, reading);
  reading.resolve_backs();
  const std::pair<std::string_view, Reader> order[] = {
      {"object", read_object},
      {"import", read_import},
      {"luminaire_type", read_luminaire_type},
      {"sign_type", read_sign_type},
      {"luminaire", read_luminaire},
      {"emitter", read_emitter},
      {"sign", read_sign},
      {"medium", read_medium},
      {"plane", read_plane},
      {"probe", read_probe},
      {"surface_group", read_surface_group},
      {"volume_group", read_volume_group},
      {"counting_plane", read_counting_plane},
      {"observer", read_observer},
      {"camera", read_camera},
      {"backdrop", read_backdrop},
      {"route", read_route},
      {"open_area", read_open_area},
      {"task_area", read_task_area},
      {"emphasis", read_emphasis},
      {"room", read_room},
      {"people", read_people},
  };
  for (const auto& [key, reader] : order) read_all(documents, key, reader, reading);
  read_bodies_of_people(loader, reading);
  check_rooms(reading);
  check_project(reading);
  for (const auto& route : reading.routes_named) reading.require("route", route.name, route.place);
  resolve_bodies(reading);
  // Types of a design may use circuits of their own, which scenarios name.
  read_designs(documents, reading);
  read_all(documents, "scenario", read_scenario, reading);
  read_all(documents, "change", read_change, reading);
  check_whole(reading);
  reading.scene.at_s = reading.time_s();
  if (const auto now = reading.scene.at_s; now && reading.goes_by_clock)
    reading.hash_bytes({reinterpret_cast<const char*>(&*now), sizeof *now});
  if (at_s && !reading.changes_in_time && !reading.scene.time && !reading.incomplete)
    reading.problem({path.string(), 0},
                    "a time is asked for, and nothing in this scene changes in time: media of "
                    "kind = \"fds\" do, values written as rows [seconds, value], and scenes with "
                    "[time]");
  ReadScene out;
  for (Problem& renamed : reading.findings.take_warnings())
    reading.scene.warnings.push_back(std::move(renamed));
  reading.scene.files = std::make_shared<const FilesAsRead>(std::move(reading.files));
  if (!reading.findings.any_problem()) out.scene = std::move(reading.scene);
  out.problems = reading.findings.take_problems();
  return out;
}

ReadPeople read_people_of_scene(const std::filesystem::path& path) {
  SceneReading reading;
  Loader loader(reading);
  loader.load(path, {path.string(), 1});
  read_all(loader.documents, "people", read_people, reading);
  return {std::move(reading.people), reading.findings.take_problems()};
}

}  // namespace luxodus

// The shared state while one scene is read: the growing scene, every problem found, the declared
// names, and the hash of every byte read. Single-threaded; lives for one read_scene call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "runtime/toml/findings.hpp"
#include "runtime/toml/value.hpp"
#include "scenes/light/world/description.hpp"
#include "scenes/light/world/design.hpp"
#include "scenes/light/world/files_as_read.hpp"
#include "scenes/light/world/fire_frames.hpp"
#include "scenes/light/world/people.hpp"

namespace luxodus {

class ReadingShare;

namespace scene_limits {
/// Size of a scene file. People or small scripts write it: 16 MiB of TOML are 200 000 tables.
inline constexpr uint64_t file_bytes = uint64_t{16} << 20;
/// Files that a scene may include, all levels together.
inline constexpr size_t included_files = 256;
/// [[...]] tables of one kind, in all files together.
inline constexpr size_t tables_per_kind = 100'000;
/// Copies of one object or luminaire.
inline constexpr size_t copies = 100'000;
/// Characters of a name or a title.
inline constexpr size_t name_chars = 200;
/// Triangles of all objects together (72 bytes each in double precision: 3.6 GB).
inline constexpr size_t triangles = 50'000'000;
}  // namespace scene_limits

class SceneReading {
 public:
  SceneDescription scene;
  /// Set when all or part of a file could not be read: its names are then not reported as missing.
  bool incomplete = false;

  /// Receives the progress of reading large files; null for none.
  ReadingShare* share = nullptr;
  /// The requested time, replacing the one that the scene states [s].
  std::optional<double> at_s;
  /// State of simulations between two frames.
  FireFrames frames = FireFrames::between;
  /// Whether anything in the scene changes in time, and whether it does so by the clock rather than
  /// by frames of a simulation, which are hashed themselves.
  bool changes_in_time = false, goes_by_clock = false;
  /// Time of the state: the requested one, else the start of [time] [s].
  std::optional<double> time_s() const {
    if (at_s || !scene.time) return at_s;
    return scene.time->from_s;
  }

  /// Routes that signs name, before routes are read.
  struct NamedRoute {
    std::string name;
    SourcePlace place;
  };
  std::vector<NamedRoute> routes_named;

  /// An emitter and its copies, which are the next ones in the scene.
  struct EmitterCopies {
    size_t first = 0, count = 1;
  };
  std::vector<EmitterCopies> emitter_copies;

  /// Flights of stairs of objects, before a design is read.
  std::vector<StairFlight> stair_flights;

  /// Read by scene_people.hpp alone: they are no part of the scene.
  std::vector<PeopleSettings> people;

  toml::Findings findings;

  void problem(SourcePlace where, std::string what) {
    findings.problem(std::move(where), std::move(what));
  }
  void problem(Problem p) { findings.problem(std::move(p)); }
  void warning(SourcePlace where, std::string what);
  void note_for_reader(SourcePlace where, std::string what);

  /// Records a unique name of a kind ("material", "object"...); a problem where it is taken.
  void declare(std::string_view kind, const std::string& name, const SourcePlace& place);
  /// Records a name that may occur many times: a circuit, a tag.
  void note(std::string_view kind, const std::string& name, const SourcePlace& place);
  bool declared(std::string_view kind, const std::string& name) const;
  /// A problem where nothing of this kind has this name, once per name; `what` names the kind in
  /// the message.
  bool require(std::string_view kind, const std::string& name, const SourcePlace& place);

  /// Index of a material. The named greys and "open" are made on first use; 0 and a problem if
  /// unknown.
  int material_index(const std::string& name, const SourcePlace& place);
  /// The material seen from behind a surface of this material: its own `back`, or itself.
  int back_of(int material) const;
  void set_back(int material, std::string name, SourcePlace place);
  /// Turns the names given to set_back into indices. Call it when all materials are read.
  void resolve_backs();
  /// Triangles of all objects so far.
  size_t triangles = 0;
  /// Bytes of all drawings under plans so far, as pages embed them.
  uint64_t backdrop_bytes = 0;
  /// Default of an object's patch edge [m].
  double patch_edge_m = 0.5;

  /// Adds the file's bytes to the content hash, and lists a settled file among those read (once per
  /// file). Called before the file is read, so that a write in between is detected as a change.
  /// Errors: a file that cannot be read.
  Result<void> hash_file(const std::filesystem::path& path, FileLife life = FileLife::settled);
  void hash_bytes(std::string_view bytes);
  FilesAsRead files;

  /// Tables that several luminaires or signs share, by kind and name; views into the documents,
  /// which outlive the reading.
  std::map<std::string, const toml::Table*> types;

  /// Caches what was read from a file, so that a file named twice is read once.
  std::map<std::string, std::shared_ptr<const void>> cache;

 private:
  struct Back {
    std::string name;
    SourcePlace place;
    int index = -1;
  };
  std::map<std::string, std::map<std::string, SourcePlace>, std::less<>> names_;
  std::set<std::string> missed_;  // kind and name already reported as missing
  std::map<int, Back> backs_;
  std::map<std::string, int> material_at_;  // the first materials_indexed_ materials
  size_t materials_indexed_ = 0;
  std::set<std::string> hashed_;
};

/// The value of a named grey: "grey50" and "gray50" 0.50, "white80" 0.80, "black5" 0.05.
std::optional<double> named_grey(std::string_view name);

}  // namespace luxodus

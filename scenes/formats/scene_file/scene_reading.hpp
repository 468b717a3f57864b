// What is shared while one scene is read: the scene as it grows, every problem found, the names
// said so far, and the hash of every byte read. Single-threaded; lives for one read_scene call.
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

namespace luxodus {

class ReadingShare;

namespace scene_limits {
/// A scene file is written by people or small scripts; 16 MiB of TOML is already 200 000 tables.
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
  /// Set when a whole file or part of one could not be read: names it may have said are then not
  /// missed.
  bool incomplete = false;

  /// Hears how far the reading of large files is; null where nobody asks.
  ReadingShare* share = nullptr;
  /// Time that was asked for, instead of the one that the scene states [s].
  std::optional<double> at_s;
  /// What simulations have between two frames.
  FireFrames frames = FireFrames::between;
  /// Something in the scene is another thing at another time; it is so by the clock, not by frames
  /// of a simulation, which are hashed themselves.
  bool changes_in_time = false, goes_by_clock = false;
  /// Of the state: what was asked for, else where [time] begins [s].
  std::optional<double> time_s() const {
    if (at_s || !scene.time) return at_s;
    return scene.time->from_s;
  }

  /// By signs, before routes are read.
  struct NamedRoute {
    std::string name;
    SourcePlace place;
  };
  std::vector<NamedRoute> routes_named;

  /// Of objects, before a design is read.
  std::vector<StairFlight> flights;

  toml::Findings findings;

  void problem(SourcePlace where, std::string what) {
    findings.problem(std::move(where), std::move(what));
  }
  void problem(Problem p) { findings.problem(std::move(p)); }
  void warning(SourcePlace where, std::string what);
  void note_for_reader(SourcePlace where, std::string what);

  /// Remembers a name of a kind ("material", "object"...); a problem where it is taken already.
  void declare(std::string_view kind, const std::string& name, const SourcePlace& place);
  /// Remembers a name that may be said many times: a circuit, a tag.
  void note(std::string_view kind, const std::string& name, const SourcePlace& place);
  bool declared(std::string_view kind, const std::string& name) const;
  /// A problem where nothing of this kind has this name, once per name; `what` names the kind to
  /// people.
  bool require(std::string_view kind, const std::string& name, const SourcePlace& place);

  /// Index of a material, making the named greys and "open" on first use; 0 and a problem where
  /// unknown.
  int material_index(const std::string& name, const SourcePlace& place);
  /// What is seen from behind a surface of this material: its own `back`, or itself.
  int back_of(int material) const;
  void set_back(int material, std::string name, SourcePlace place);
  /// Turns the names given to set_back into indices. Call when all materials are read.
  void resolve_backs();
  /// Triangles of all objects so far.
  size_t triangles = 0;
  /// Of all drawings under plans so far, as pages get them.
  uint64_t backdrop_bytes = 0;
  /// Default of an object's patch edge [m].
  double patch_edge_m = 0.5;

  /// Takes the file's bytes into the content hash, and a settled file among those that were read
  /// (once per file). Called before the file is read: what is written to it in between is then a
  /// change.
  /// Errors: a file that cannot be read.
  Result<void> hash_file(const std::filesystem::path& path, FileLife life = FileLife::settled);
  void hash_bytes(std::string_view bytes);
  FilesAsRead files;

  /// What several luminaires or signs have in common, by kind and name; of the documents, which
  /// outlive the reading.
  std::map<std::string, const toml::Table*> types;

  /// Keeps what was read from a file, so that a file named twice is read once.
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
  std::map<std::string, int> material_at_;  // of the first materials_indexed_ materials
  size_t materials_indexed_ = 0;
  std::set<std::string> hashed_;
};

/// The value of a named grey: "grey50" and "gray50" 0.50, "white80" 0.80, "black5" 0.05.
std::optional<double> named_grey(std::string_view name);

}  // namespace luxodus

// What pyFDS-Evac calls its signs, and the description by which it knows its cache of visibility
// maps: a file whose description differs in anything is computed anew, by Jin's law, and
// overwritten. Layouts: that program's public source (core/visibility.py of April 2026). Files are
// untrusted. Pure functions but for reading; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Of a config.json, and signs in it.
inline constexpr uint64_t evac_config_bytes = uint64_t{64} << 20;
inline constexpr size_t evac_signs = 10'000;
}  // namespace limits

/// Distance in plan within which a sign of the other program is a sign of the scene [m].
inline constexpr double same_sign_m = 0.5;

/// A sign as that program knows it.
struct EvacSign {
  std::string node;      // id of the exit, checkpoint or waypoint
  glm::dvec2 place{0};   // [m]
  double alpha_deg = 0;  // from where it is read: from +y clockwise
  Json description;      // [node, x, y, alpha, c], as that program compares it
  size_t sign = 0;       // of the map
};

/// The signs of a config.json, in that program's order, each with the sign of the scene that has
/// its node's name, or else hangs within same_sign_m of its place and faces the same way.
/// `signs`: of the map. Errors: no such file, or too large; no JSON object; a sign without numbers;
/// no sign at all; one that is not in the scene.
Result<std::vector<EvacSign>> read_evac_signs(const std::filesystem::path& config,
                                              const std::vector<const Sign*>& signs);

/// The signs of the scene as a config.json would have them.
std::vector<EvacSign> evac_signs_of(const std::vector<const Sign*>& signs);

/// How that program is run.
struct EvacRun {
  std::string config;              // path of its config.json; "": none
  std::string fds_folder;          // "": that of the scene's fire simulation
  double reroute_interval_s = 10;  // --reroute-interval
  double slice_height_m = 2;       // --smoke-slice-height
};

/// The folder of FDS results as that program resolves it; none if no simulation is known.
std::optional<std::string> fds_folder_of(const EvacRun& run, const SceneDescription& scene);

/// The description of its cache.
Json evac_meta(const EvacRun& run, const std::string& fds_folder,
               const std::vector<EvacSign>& signs);

/// Whether that program takes the file, in words for people.
std::string evac_words(const EvacRun& run, const std::optional<std::string>& fds_folder,
                       const std::string& file);

}  // namespace luxodus

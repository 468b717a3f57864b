// Reads the settings of a run.
#include <algorithm>

#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

void read_run(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"run"}, reading);
  RunSettings& run = reading.scene.run;
  // An absent key keeps the value of included files.
  if (keys.has("seed")) run.seed = static_cast<uint64_t>(keys.integer("seed"));
  if (keys.has("max_bands")) run.max_bands = static_cast<int>(keys.integer("max_bands"));
  if (keys.has("band_tolerance")) run.band_tolerance = keys.number("band_tolerance");
  if (keys.has("batch_particles")) run.batch_particles = keys.integer("batch_particles");
  if (keys.has("voxel_edge_m")) run.voxel_edge_m = keys.number("voxel_edge_m");
  if (keys.has("voxels")) run.voxels = keys.flag("voxels");
  if (keys.has("analogue")) run.analogue = keys.flag("analogue");
  if (keys.has("stratified")) run.stratified = keys.flag("stratified");
  if (keys.has("eye_path_factor")) run.eye_path_factor = keys.number("eye_path_factor");
  if (keys.has("error_of")) {
    run.error_of = keys.texts("error_of");
    run.error_of_place = keys.place("error_of");
  }
  if (keys.has("groups")) {
    const std::string groups = keys.choice("groups");
    run.groups = groups == "circuit"   ? GroupRule::by_circuit
                 : groups == "emitter" ? GroupRule::by_emitter
                                       : GroupRule::one;
  }
  if (!keys.has("band_edges_nm")) return;
  const bool good = keys.clean();
  run.band_edges_nm = keys.numbers("band_edges_nm");
  if (good && !keys.clean()) return;
  const auto& edges = run.band_edges_nm;
  const bool ascending = std::adjacent_find(edges.begin(), edges.end(), [](double a, double b) {
                           return a >= b;
                         }) == edges.end();
  if (edges.size() < 2 || edges.size() > 65 || !ascending || edges.front() != spectrum_first_nm ||
      edges.back() != spectrum_last_nm) {
    keys.problem(
        "band_edges_nm",
        "'band_edges_nm' must be 2 to 65 ascending wavelengths, the first 380 and the last 780");
  }
}

}  // namespace luxodus

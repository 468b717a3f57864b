// Reads smoke and flames of fire simulations: one medium in the scene file, a data set for each of
// its grids in the scene. All have the medium's name, so that scenarios scale them together.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_media.hpp"
#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/light/optics/flame_spectrum.hpp"

namespace luxodus {

namespace {

/// Usual values of flames in buildings: radiant fractions of fuels, temperatures of their soot.
constexpr double low_fraction = 0.1, high_fraction = 0.6;
constexpr double low_soot_k = 1100, high_soot_k = 1900;
/// A frame this far from the requested time shows another state of the fire; two frames twice as
/// far apart are too far for interpolation [s].
constexpr double far_from_asked_s = 5;

struct Flames {
  double radiant_fraction = 0;
  double soot_temperature_k = 0;
  std::string circuit, group;
};

std::vector<FireSource> sources_named(const std::string& word) {
  if (word == "cells") return {FireSource::cell_extinction, FireSource::cell_soot};
  if (word == "nodes") return {FireSource::node_extinction, FireSource::node_soot};
  if (word == "plot3d") return {FireSource::plot3d};
  if (word == "smoke3d") return {FireSource::smoke3d};
  return {};
}

std::optional<Flames> read_flames(KeyReader& keys) {
  const toml::Table* table = keys.table("flames");
  if (table == nullptr) return std::nullopt;
  KeyReader flames(*table, {"medium.flames"}, keys.reading());
  Flames out;
  out.radiant_fraction = flames.number("radiant_fraction");
  out.soot_temperature_k = flames.number("soot_temperature_k");
  out.group = flames.text("group");
  if (const auto circuit = flames.maybe_text("circuit")) {
    out.circuit = *circuit;
    keys.reading().note("circuit", out.circuit, flames.place("circuit"));
  }
  if (!flames.clean()) return out;
  if (out.radiant_fraction < low_fraction || out.radiant_fraction > high_fraction)
    keys.reading().warning(flames.place("radiant_fraction"),
                           fmt::format("'radiant_fraction' is {:g}: flames radiate 0.2 to 0.45 of "
                                       "their heat",
                                       out.radiant_fraction));
  if (out.soot_temperature_k < low_soot_k || out.soot_temperature_k > high_soot_k)
    keys.reading().warning(flames.place("soot_temperature_k"),
                           fmt::format("'soot_temperature_k' is {:g}: the glowing soot of flames "
                                       "has 1100 to 1700 K, and its light rises steeply with it; "
                                       "temperatures of cells are means of flame and air",
                                       out.soot_temperature_k));
  return out;
}

MediumEmission emission_of(const Flames& flames, double heat_kw) {
  const FlameSpectrum spectrum = flame_spectrum(flames.soot_temperature_k, true);
  MediumEmission out;
  out.power_w = 1000 * heat_kw * flames.radiant_fraction;
  out.spectrum = spectrum.shape;
  out.visible_fraction = spectrum.visible_fraction;
  out.circuit = flames.circuit;
  out.group = flames.group;
  return out;
}

std::string extent_words(const LoadedFire& fire) {
  Bounds all;
  for (const Bounds& mesh : fire.meshes) all.extend(mesh);
  uint64_t bytes = 0;
  for (const FireGrid& grid : fire.grids)
    bytes += sizeof(float) * (grid.data.extinction.size() + grid.data.emission.size());
  std::string out = fmt::format(
      "{} mesh{} of {} cells together, x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} "
      "m, in {} grid{} of {:.3g} MB",
      fire.meshes.size(), fire.meshes.size() == 1 ? "" : "es", fire.cells, all.low.x, all.high.x,
      all.low.y, all.high.y, all.low.z, all.high.z, fire.grids.size(),
      fire.grids.size() == 1 ? "" : "s", static_cast<double>(bytes) / 1e6);
  if (fire.resampled_meshes > 0)
    out += fmt::format(
        "; {} stretched mesh{} resampled to even cells: integrals are kept, faces between cells "
        "lie up to half of the smallest cell off",
        fire.resampled_meshes, fire.resampled_meshes == 1 ? " is" : "es are");
  return out;
}

/// Describes how the state was obtained.
std::string frame_words(const LoadedFire& fire, double asked_s) {
  if (!fire.between_frames) return fmt::format("{:g} s asked for, the nearest frame", asked_s);
  return fmt::format("linear between the frames at {:.6g} and {:.6g} s", *fire.previous_s,
                     *fire.next_s);
}

/// "SOOT from Smoke3D, -ln(1 - byte/254) / ...; FOG from ...".
std::string smoke_words(const LoadedFire& fire) {
  std::string out;
  for (const FireSmoke& smoke : fire.smokes)
    out += fmt::format("{}{} from {} ({})", out.empty() ? "" : "; ", smoke.species,
                       source_words(smoke.source), smoke.formula);
  return out;
}

/// Warns of what makes a state doubtful: frames that are far away, missing or written twice.
void warn_of_frames(KeyReader& keys, const LoadedFire& fire, double asked_s) {
  SceneReading& reading = keys.reading();
  const SourcePlace at = keys.place(keys.has("at_s") ? "at_s" : "file");
  for (const std::string& note : fire.notes) reading.warning(keys.place("file"), note);
  if (fire.partial_frames > 0)
    reading.warning(keys.place("file"),
                    fmt::format("{} frames between {:.6g} and {:.6g} s are not in the files of all "
                                "meshes and are passed over",
                                fire.partial_frames, fire.first_s, fire.last_s));
  if (fire.between_frames && *fire.next_s - *fire.previous_s > 2 * far_from_asked_s)
    reading.warning(at, fmt::format("{:.6g} s lies between two frames that are {:.3g} s apart: "
                                    "their mean is no state that the simulation had",
                                    fire.time_s, *fire.next_s - *fire.previous_s));
  if (std::abs(fire.time_s - asked_s) > far_from_asked_s)
    reading.warning(at,
                    fmt::format("the nearest frame lies {:.3g} s from the time that is asked for",
                                std::abs(fire.time_s - asked_s)));
}

/// Notes what was read, for readers of the results.
void tell_fire(KeyReader& keys, const std::string& name, const LoadedFire& fire,
               const std::optional<Flames>& flames, double asked_s) {
  SceneReading& reading = keys.reading();
  reading.note_for_reader(
      keys.place("file"),
      fmt::format("the smoke \"{}\" is the state at {:.6g} s ({}; {} frames from {:.6g} to "
                  "{:.6g} s), computed by {}: {}. Accuracy: {}. {}",
                  name, fire.time_s, frame_words(fire, asked_s), fire.frames, fire.first_s,
                  fire.last_s, fire.version.empty() ? "FDS" : fire.version, smoke_words(fire),
                  accuracy_words(fire), extent_words(fire)));
  warn_of_frames(keys, fire, asked_s);
  if (fire.overlapping)
    reading.warning(keys.place("file"),
                    "meshes of the simulation overlap: the first in the index is taken");
  if (!flames) {
    reading.note_for_reader(
        keys.place(),
        fmt::format("FLAME GLARE IS MISSING: \"{}\" has the smoke of a fire without the light of "
                    "its flames; {}",
                    name,
                    fire.has_heat_release
                        ? "say [medium.flames] with a radiant fraction and a soot temperature"
                        : "the case has no HRRPUV, which says where they are"));
    return;
  }
  const double heat_kw = fire.heat_release_kw;
  if (std::none_of(fire.grids.begin(), fire.grids.end(),
                   [](const FireGrid& grid) { return grid.heat_kw > 0; }))
    return reading.note_for_reader(
        keys.place("flames"),
        fmt::format("\"{}\" has no flames at {:.6g} s: the fire releases {:.4g} kW, and no cell "
                    "burns with as much as HRRPUV can tell from nothing",
                    name, fire.time_s, heat_kw));
  reading.note_for_reader(
      keys.place("flames"),
      fmt::format("the flames of \"{}\" release {:.4g} kW at {:.6g} s and radiate {:.4g} kW; the "
                  "smoke in burning cells is taken out ({:.2g} % of all), because this power has "
                  "passed the flame's own soot",
                  name, heat_kw, fire.time_s, heat_kw * flames->radiant_fraction,
                  100 * fire.flame_extinction_share));
}

/// A scene has one clock: that of [time], or the medium's own.
double time_of_state(KeyReader& keys) {
  const SceneReading& reading = keys.reading();
  const auto own = keys.maybe_number("at_s");
  if (own && reading.scene.time)
    keys.problem("at_s", "'at_s' and [time] both say when; leave 'at_s' out");
  if (!own && !reading.time_s() && keys.clean())
    keys.problem("the key 'at_s' is missing: at which time? Or add [time], or give --at 60s");
  return reading.at_s.value_or(own.value_or(reading.time_s().value_or(0)));
}

void hash_fire(SceneReading& reading, const LoadedFire& fire) {
  // Hashes values instead of files: a scene holds one of gigabytes of frames.
  const auto take = [&](const void* data, size_t bytes) {
    reading.hash_bytes({static_cast<const char*>(data), bytes});
  };
  take(&fire.time_s, sizeof fire.time_s);
  for (const FireGrid& grid : fire.grids) {
    take(&grid.origin, sizeof grid.origin);
    take(&grid.heat_kw, sizeof grid.heat_kw);
    take(grid.data.extinction.data(), grid.data.extinction.size() * sizeof(float));
    take(grid.data.emission.data(), grid.data.emission.size() * sizeof(float));
  }
}

}  // namespace

void read_fire_medium(KeyReader& keys, Medium m) {
  SceneReading& reading = keys.reading();
  reading.changes_in_time = true;
  m.kind = MediumKind::data_set;
  m.frame.origin = keys.point("position");
  m.frame.axes = turn_about_axes(keys.point("rotate_deg"));
  m.optics.extinction.wavelength_nm = keys.number("wavelength_nm");
  m.optics.extinction.angstrom = keys.number("angstrom");
  m.optics.albedo = property(keys, "albedo");
  m.optics.phase.kind = PhaseKind::henyey_greenstein;
  m.optics.phase.g = keys.number("g");
  FireOptions options;
  options.at_s = time_of_state(keys);
  options.between_frames = reading.frames == FireFrames::between;
  options.sources = sources_named(keys.choice("source"));
  options.mass_extinction_m2_per_kg = keys.maybe_number("mass_extinction");
  const auto flames = read_flames(keys);
  options.flames = flames.has_value();
  options.reading = reading.share;
  const auto path = keys.file("file");
  if (!path || !keys.clean()) return;
  warn_of_mass_extinction(keys);
  if (!take_hash(*path, keys.place("file"), reading, FileLife::grows)) return;
  auto fire = read_fire(*path, options);
  if (!fire) return take_problem(fire.problem(), keys.place("file"), reading);
  hash_fire(reading, fire.value());
  tell_fire(keys, m.name, fire.value(), flames, options.at_s);
  FireSimulation simulation{path->filename().string(),
                            fire->time_s,
                            sources_words(fire.value()),
                            false,
                            m.frame,
                            fire->meshes,
                            largest_depth_error(fire.value()),
                            path->string()};
  for (const FireGrid& grid : fire->grids) simulation.glows |= flames && grid.heat_kw > 0;
  for (size_t i = 0; i < fire->grids.size(); ++i) {
    FireGrid& grid = fire->grids[i];
    Medium one = m;
    one.frame.origin += one.frame.axes * grid.origin;
    one.data = std::move(grid.data);
    if (flames && grid.heat_kw > 0) one.emission = emission_of(*flames, grid.heat_kw);
    if (i == 0) one.simulation = simulation;
    reading.scene.media.push_back(std::move(one));
  }
}

}  // namespace luxodus

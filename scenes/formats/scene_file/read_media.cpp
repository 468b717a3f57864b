// Reads smoke and flames, except bodies and data sets (read_bodies.cpp).
#include "scenes/formats/scene_file/read_media.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/core/output_text.hpp"
#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/polygon.hpp"
#include "scenes/light/optics/flame_spectrum.hpp"

namespace luxodus {

namespace {

constexpr double ln10 = std::numbers::ln10;
constexpr double metres_per_foot = 0.3048;
/// Specific extinction of flaming fires' soot at 633 nm [m2/kg], mean of 29 fuels (Mulholland and
/// Croarkin).
constexpr double flaming_mass_extinction = 8700;
/// Smouldering smoke has about 4000; values far from both are in another unit [m2/kg].
constexpr double min_mass_extinction = 500, max_mass_extinction = 5e4;
/// Near a fire there are some grams in a cubic metre.
constexpr double max_soot_kg_m3 = 0.01;
/// Radiation temperatures of flames in buildings.
constexpr double coldest_flame_k = 1000, hottest_flame_k = 2500;
constexpr double weakest_flame_w = 300, max_flame_w = 3e8;
/// Smouldering smoke consists of droplets, which hardly absorb.
constexpr double min_smouldering_albedo = 0.4;

/// Warns if a number is not plausible for smoke in its unit, and says which key was probably meant.
void warn_of_units(KeyReader& keys, const std::string& given) {
  const auto warn = [&](const char* key, const std::string& what) {
    keys.reading().warning(keys.place(key), "'" + std::string(key) + "' is " + what);
  };
  const double value = keys.course(given);
  const bool percent = given == "percent_per_m" || given == "percent_per_ft";
  if (percent && value > 0 && value < 1)
    warn(given.c_str(), shortest_number(value) + " %, next to nothing: half of the light is 50");
  if (given == "soot_density" && value > max_soot_kg_m3)
    warn("soot_density", shortest_number(value) +
                             " kg/m3, more than any fire makes: 1 g/m3 is 1e-3 and 1 mg/m3 1e-6");
  warn_of_mass_extinction(keys);
}

/// Extinction [1/m] of the key that was used, by the definitions T = exp(-K d) = 10^(-OD d).
double extinction_of(KeyReader& keys, const std::string& given, const std::string& smoke) {
  const double value = keys.course(given);
  if (given == "extinction") return value;
  if (given == "od_per_m") return value * ln10;
  if (given == "db_per_m") return value * ln10 / 10;
  if (given == "percent_per_m") return -std::log1p(-value / 100);
  if (given == "percent_per_ft") return -std::log1p(-value / 100) / metres_per_foot;
  const auto own = keys.maybe_number("mass_extinction");
  if (!own && !keys.has("mass_extinction") && smoke != "flaming") {
    keys.problem(
        "'mass_extinction' [m2/kg] is needed with 'soot_density'; only smoke = \"flaming\" has "
        "a default (8700)");
  }
  return value * own.value_or(flaming_mass_extinction);
}

Extinction read_extinction(KeyReader& keys) {
  Extinction e;
  const std::string smoke = keys.maybe_choice("smoke").value_or("");
  const std::string given = keys.exactly_one({"extinction", "od_per_m", "db_per_m", "percent_per_m",
                                              "percent_per_ft", "soot_density", "extinction_table"},
                                             true);
  e.wavelength_nm = keys.number("wavelength_nm");
  e.angstrom = keys.maybe_number("angstrom").value_or(smoke == "flaming" ? 1 : 0);
  if (given != "soot_density" && keys.has("mass_extinction")) {
    keys.problem("mass_extinction", "'mass_extinction' belongs to 'soot_density'");
  }
  if (given == "extinction_table") {
    e.table = maybe_property(keys, "extinction_table");
    for (const char* key : {"angstrom", "wavelength_nm"}) {
      if (keys.has(key)) {
        keys.problem(key, "'" + std::string(key) + "' has no meaning beside 'extinction_table'");
      }
    }
    if (e.table) e.sigma_t = e.table->at(e.wavelength_nm);
  } else if (!given.empty()) {
    e.sigma_t = extinction_of(keys, given, smoke);
    if (keys.clean()) warn_of_units(keys, given);
  }
  return e;
}

Phase read_phase(KeyReader& keys) {
  Phase phase;
  const std::string word = keys.choice("phase");
  const auto g = keys.maybe_number("g");
  const auto rows = keys.pairs("phase_table");
  if (keys.has("g") && word != "hg") keys.problem("g", "'g' belongs to phase = \"hg\"");
  if (keys.has("phase_table") && word != "table") {
    keys.problem("phase_table", "'phase_table' belongs to phase = \"table\"");
  }
  if (word == "rayleigh") phase.kind = PhaseKind::rayleigh;
  if (word == "hg") {
    phase.kind = PhaseKind::henyey_greenstein;
    phase.g = g.value_or(0);
    if (!keys.has("g"))
      keys.problem("the key 'g' is missing: phase = \"hg\" needs its mean cosine");
  }
  if (word != "table") return phase;
  phase.kind = PhaseKind::tabulated;
  if (!keys.has("phase_table")) {
    keys.problem("the key 'phase_table' is missing: rows [cosine, relative density]");
    return phase;
  }
  double sum = 0;
  bool ascending = true;
  for (size_t i = 0; i < rows.size(); ++i) {
    phase.table_cos.push_back(rows[i].x);
    phase.table_value.push_back(rows[i].y);
    sum += rows[i].y;
    if (i > 0) ascending = ascending && rows[i].x > rows[i - 1].x;
  }
  if (!keys.clean()) return phase;
  if (rows.size() < 2 || !ascending || rows.front().x != -1 || rows.back().x != 1) {
    keys.problem("phase_table",
                 "'phase_table' needs ascending cosines, the first -1 and the last 1");
  } else if (!(sum > 0)) {
    keys.problem("phase_table", "'phase_table' scatters nothing anywhere");
  }
  return phase;
}

SmokeOptics read_optics(KeyReader& keys) {
  SmokeOptics optics;
  optics.extinction = read_extinction(keys);
  optics.albedo = property(keys, "albedo");
  optics.phase = read_phase(keys);
  const double albedo = optics.albedo.integral() / Spectrum::constant(1).integral();
  if (keys.clean() && keys.maybe_choice("smoke").value_or("") == "smouldering" &&
      albedo < min_smouldering_albedo)
    keys.reading().warning(keys.place("albedo"),
                           "'albedo' is " + shortest_number(std::round(1000 * albedo) / 1000) +
                               " of smouldering smoke, whose droplets hardly absorb: it has 0.7 to "
                               "0.99, and veils more than soot");
  return optics;
}

void read_footprint(KeyReader& keys, Footprint& footprint) {
  const std::string given = keys.exactly_one({"polygon", "box"}, false);
  if (given.empty()) return;
  const auto points = keys.corners(given);
  if (!keys.clean()) return;
  if (given == "polygon") {
    if (points.size() < 3) keys.problem("polygon", "'polygon' needs three corners or more");
    if (points.size() >= 3) {
      if (const auto outline = checked_outline(points); !outline) {
        keys.problem("polygon", "'polygon': " + outline.problem().what);
      }
    }
    footprint.polygon = points;
    return;
  }
  if (points.size() != 2 || points[0].x == points[1].x || points[0].y == points[1].y) {
    keys.problem("box", "'box' needs two opposite corners [x, y] that enclose an area");
    return;
  }
  const glm::dvec2 low = glm::min(points[0], points[1]), high = glm::max(points[0], points[1]);
  footprint.polygon = {low, {high.x, low.y}, high, {low.x, high.y}};
}

void read_homogeneous(KeyReader& keys, Medium& m) {
  m.optics = read_optics(keys);
  read_footprint(keys, m.footprint);
  m.footprint.z_low = keys.maybe_number("z_low").value_or(m.footprint.z_low);
  m.footprint.z_high = keys.maybe_number("z_high").value_or(m.footprint.z_high);
  if (keys.clean() && !(m.footprint.z_low < m.footprint.z_high)) {
    keys.problem("z_high", "'z_high' must lie above 'z_low'");
  }
}

/// Words for a value that changes in time.
std::string at_words(KeyReader& keys, bool moves) {
  return moves ? " at " + shortest_number(keys.reading().time_s().value_or(0)) + " s" : "";
}

void read_layers(KeyReader& keys, Medium& m) {
  m.kind = MediumKind::layered;
  read_footprint(keys, m.footprint);
  struct Placed {
    Layer layer;
    SourcePlace place;
  };
  std::vector<Placed> layers;
  bool good = true, any = false;
  for (const toml::Table* t : keys.tables("layer")) {
    KeyReader layer(*t, {"medium.layer", "medium.optics"}, keys.reading());
    Layer l;
    l.z_low = layer.course("z_low");
    l.z_high = layer.course("z_high");
    const bool moves = layer.changes_in_time("z_low") || layer.changes_in_time("z_high");
    // A growing layer has no thickness before it begins.
    const bool absent = moves && l.z_low == l.z_high;
    if (layer.clean() && !absent && !(l.z_low < l.z_high)) {
      layer.problem("z_high", "'z_high' must lie above 'z_low'" + at_words(layer, moves));
    }
    l.optics = read_optics(layer);
    good = good && layer.clean();
    any = true;
    if (absent) continue;
    layers.push_back({std::move(l), layer.place()});
  }
  if (keys.clean() && !any) keys.problem("a layered medium needs a [[medium.layer]]");
  std::stable_sort(layers.begin(), layers.end(),
                   [](const Placed& a, const Placed& b) { return a.layer.z_low < b.layer.z_low; });
  for (size_t i = 1; good && i < layers.size(); ++i) {
    if (layers[i].layer.z_low >= layers[i - 1].layer.z_high) continue;
    keys.reading().problem(layers[i].place, "this layer overlaps the one at line " +
                                                std::to_string(layers[i - 1].place.line) +
                                                "; layers of one medium must not, media may");
    break;
  }
  for (Placed& p : layers) m.layers.push_back(std::move(p.layer));
}

}  // namespace

void warn_of_mass_extinction(KeyReader& keys) {
  const auto own = keys.maybe_number("mass_extinction");
  if (!own || (*own >= min_mass_extinction && *own <= max_mass_extinction)) return;
  keys.reading().warning(keys.place("mass_extinction"),
                         "'mass_extinction' is " + shortest_number(*own) + " m2/kg: soot has 8700" +
                             (*own < min_mass_extinction ? "; 8.7 m2/g is 8700 m2/kg" : ""));
}

void read_placed(KeyReader& keys, Medium& m) {
  m.frame.origin = keys.point("position");
  m.frame.axes = turn_about_axes(keys.point("rotate_deg"));
  const toml::Table* table = keys.table("emission");
  if (!table) return;
  KeyReader emission(*table, {"medium.emission"}, keys.reading());
  MediumEmission e;
  e.power_w = emission.course("power_w");
  const double kelvin = emission.number("temperature_k");
  if (emission.clean() && (kelvin < coldest_flame_k || kelvin > hottest_flame_k))
    keys.reading().warning(
        emission.place("temperature_k"),
        "'temperature_k' is " + shortest_number(kelvin) +
            " K: flames of buildings have 1100 to 1700 K (900 degrees Celsius are "
            "1173 K), and their light rises steeply with it");
  if (emission.clean() && e.power_w > 0 && (e.power_w < weakest_flame_w || e.power_w > max_flame_w))
    keys.reading().warning(emission.place("power_w"),
                           "'power_w' is " + shortest_number(e.power_w) +
                               " W: burning things radiate a third of their heat release, a waste "
                               "basket 2e4 W, a room 1e6 W. Is it in kW?");
  const FlameSpectrum flame = flame_spectrum(kelvin, emission.choice("emissivity") == "soot");
  e.spectrum = flame.shape;
  e.visible_fraction = flame.visible_fraction;
  if (const auto circuit = emission.maybe_text("circuit")) {
    e.circuit = *circuit;
    keys.reading().note("circuit", e.circuit, emission.place("circuit"));
  }
  e.group = emission.text("group");
  // The fire has not begun.
  if (e.power_w == 0 && emission.changes_in_time("power_w")) return;
  m.emission = std::move(e);
}

void read_medium(const toml::Table& table, SceneReading& reading) {
  const std::string kind = toml::chosen_kind(table, scene_schema(), "medium", "kind");
  const std::string body = toml::chosen_kind(table, scene_schema(), "medium.bounded", "body");
  KeyReader keys(table, medium_specs(kind, body), reading);
  Medium m;
  m.place = keys.place();
  m.name = read_name(keys, "medium");
  keys.maybe_choice("kind");
  if (kind == "homogeneous") read_homogeneous(keys, m);
  if (kind == "layered") {
    read_layers(keys, m);
    if (m.layers.empty()) return;  // a design fire that has not begun
  }
  if (kind == "bounded") {
    m.kind = MediumKind::bounded;
    m.optics = read_optics(keys);
    read_placed(keys, m);
    keys.maybe_choice("body");
    if (!body.empty()) read_body(keys, body, m);
    if (keys.has("emission") && !m.emission) return;  // the flame does not burn yet
  }
  if (kind == "fds") return read_fire_medium(keys, std::move(m));
  if (kind == "data_set") {
    m.kind = MediumKind::data_set;
    read_placed(keys, m);
    m.optics.phase = read_phase(keys);
    read_data_set(keys, m);
  }
  reading.scene.media.push_back(std::move(m));
}

std::vector<std::string> medium_specs(const std::string& kind, const std::string& body) {
  std::vector<std::string> specs = {"medium"};
  const bool all = kind.empty();
  if (all || kind == "homogeneous" || kind == "bounded") specs.push_back("medium.optics");
  for (const char* k : {"homogeneous", "layered", "bounded", "data_set", "fds"}) {
    if (all || kind == k) specs.push_back(std::string("medium.") + k);
  }
  if (!all && kind != "bounded") return specs;
  for (const auto word : toml::words_of("ellipsoid, cylinder, cone, paraboloid, quadric")) {
    if (body.empty() || body == word) specs.push_back("medium." + std::string(word));
  }
  return specs;
}

}  // namespace luxodus

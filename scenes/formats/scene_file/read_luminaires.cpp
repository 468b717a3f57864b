// Reads luminaires of photometric files, and emitters of simple shape.
#include "scenes/formats/scene_file/read_luminaires.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "runtime/core/output_text.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/formats/scene_file/read_types.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

constexpr double pi = std::numbers::pi;

void read_onset(KeyReader& keys, Emitter& e) {
  e.onset = keys.pairs("onset");
  if (!keys.has("onset") || !keys.clean()) return;
  bool good = !e.onset.empty() && e.onset.front().x == 0 && e.onset.back().y == 1;
  for (size_t i = 1; i < e.onset.size(); ++i)
    good &= e.onset[i].x > e.onset[i - 1].x && e.onset[i].y >= e.onset[i - 1].y;
  if (!good)
    keys.problem("onset",
                 "'onset' needs rows [s, share], times ascending from 0, shares never "
                 "falling and 1 at the end");
}

/// The emergency flux that counts, and its share of new light, from the flux that is stated and
/// what that states.
void read_ageing(KeyReader& keys, Emitter& e, double stated) {
  const std::string is = keys.maybe_choice("emergency_flux_is").value_or("");
  const auto left = keys.maybe_number("end_of_duration_factor");
  const auto initial = keys.maybe_number("initial_flux");
  e.emergency_flux_is = is == "rated"     ? EmergencyFluxIs::rated
                        : is == "initial" ? EmergencyFluxIs::initial
                                          : EmergencyFluxIs::unstated;
  if (e.emergency_flux_is != EmergencyFluxIs::rated) {
    if (initial)
      keys.problem("initial_flux", "'initial_flux' belongs to emergency_flux_is = \"rated\"");
    if (!keys.has("end_of_duration_factor"))
      keys.problem(
          "'end_of_duration_factor' is needed where 'emergency' is set and the flux is "
          "not emergency_flux_is = \"rated\": no standard value is assumed");
    e.end_of_duration_factor = left.value_or(1);
    e.emergency_ageing = e.maintenance_factor * e.end_of_duration_factor;
    e.emergency_flux = stated * e.emergency_ageing;
    return;
  }
  if (left)
    keys.problem("end_of_duration_factor",
                 "'end_of_duration_factor' and emergency_flux_is = \"rated\" exclude each other: "
                 "the rated flux is the least until the end of the duration");
  if (initial && *initial < stated)
    keys.problem("initial_flux", "'initial_flux' is below the rated flux of " +
                                     shortest_number(stated) +
                                     ", which is the least until the end of the duration");
  e.emergency_flux = stated * e.maintenance_factor;
  e.initial_flux_known = initial.has_value();
  e.emergency_ageing = initial && *initial > 0 ? e.emergency_flux / *initial : e.maintenance_factor;
}

/// Fluxes of both operating states from the rated flux: E = rated x factors, each stated in the
/// file, none guessed. `container`: the luminaire in a container, which may state the emergency
/// flux; `flux_needed`: it does not.
void read_operation(KeyReader& keys, Emitter& e, double rated, bool flux_needed = true,
                    const GldfLuminaire* container = nullptr) {
  if (const auto circuit = keys.maybe_text("circuit")) {
    e.circuit = *circuit;
    keys.reading().note("circuit", e.circuit, keys.place("circuit"));
  }
  e.group = keys.text("group");
  e.spectrum = emission_shape(keys, "spectrum");
  const std::string emergency = keys.choice("emergency");
  const double dimming = keys.number("mains_factor");
  const auto maintenance = keys.maybe_number("maintenance_factor");
  const auto flux = keys.maybe_number("emergency_flux");
  const auto factor = keys.maybe_number("emergency_factor");
  const bool mains = emergency != "non-maintained";
  e.maintenance_factor = maintenance.value_or(1);
  e.mains_flux = mains ? rated * dimming * maintenance.value_or(1) : 0;
  if (emergency == "false") {
    for (const char* key : {"emergency_flux", "emergency_factor", "emergency_flux_is",
                            "initial_flux", "end_of_duration_factor", "onset", "duration_h"}) {
      if (keys.has(key)) {
        keys.problem(key, "'" + std::string(key) +
                              "' is given, but 'emergency' is not; say "
                              "\"maintained\" or \"non-maintained\"");
        break;
      }
    }
    return;
  }
  const std::string why = " is needed where 'emergency' is set: no standard value is assumed";
  keys.exactly_one({"emergency_flux", "emergency_factor"}, flux_needed);
  if (container != nullptr && container->emergency_only && mains)
    keys.problem("emergency",
                 "this emitter is for emergency operation only: say \"non-maintained\"");
  const bool contained = container != nullptr && !flux && !factor;
  if (container != nullptr && container->normal_only && !contained)
    keys.reading().warning(keys.place("emergency"),
                           "the container says that this emitter is for normal lighting only; "
                           "its emergency flux is that of the scene");
  if (contained && !container->emergency_lm)
    take_problem(container->emergency_lm.problem(), keys.place("file"), keys.reading());
  const double stated = contained && container->emergency_lm ? container->emergency_lm.value() : 0;
  if (factor.value_or(0) > 1)
    keys.reading().warning(
        keys.place("emergency_factor"),
        "'emergency_factor' is " + shortest_number(*factor) +
            ": on emergency supply a luminaire gives no more than its rated flux; it is a share, "
            "0.15 for 15 %");
  if (!keys.has("maintenance_factor")) keys.problem("'maintenance_factor'" + why);
  e.maintained = mains;
  read_ageing(keys, e, contained ? stated : flux.value_or(rated * factor.value_or(0)));
  read_onset(keys, e);
  e.duration_s = duration_s(keys);
}

void read_body(KeyReader& keys, Emitter& e) {
  if (const auto body = keys.maybe_text("body_material")) {
    e.body_material = *body;
    keys.reading().material_index(*body, keys.place("body_material"));
  }
}

/// What the scene says of the product, before what its file says.
void read_product(KeyReader& keys, ProductFacts& facts) {
  for (const auto& [key, fact] :
       {std::pair{"maker", &facts.maker}, std::pair{"article", &facts.article},
        std::pair{"battery", &facts.battery}})
    if (auto said = keys.maybe_text(key)) *fact = std::move(*said);
}

/// The emitting shape of a file's luminous opening: its lower face. Horizontal tubes and boxes
/// become their rectangle, vertical cylinders their disc; a line is 1 mm wide.
void take_opening(const LuminousOpening& opening, Emitter& e) {
  using OpeningShape = LuminousOpening::Shape;
  constexpr double line_m = 1e-3;
  const glm::dvec3 size = opening.size_m;
  const double largest = std::max({size.x, size.y, size.z});
  if (opening.shape == OpeningShape::point || largest < line_m) return;
  if (opening.shape == OpeningShape::sphere) {
    e.shape = EmitterShape::sphere;
    e.size.x =
        std::cbrt(std::max(size.x, line_m) * std::max(size.y, line_m) * std::max(size.z, line_m));
    return;
  }
  const double x = std::max(size.x, line_m), y = std::max(size.y, line_m);
  const bool round = opening.shape == OpeningShape::disc || opening.shape == OpeningShape::cylinder;
  if (round && x < 2 * y && y < 2 * x) {
    e.shape = EmitterShape::disc;
    e.size.x = std::sqrt(x * y);  // same area if it is an ellipse
    return;
  }
  e.shape = EmitterShape::rectangle;
  e.size = {x, y, 0};
}

void read_distribution(KeyReader& keys, Emitter& e) {
  const std::string word = keys.choice("distribution");
  e.distribution = word == "isotropic"      ? Distribution::isotropic
                   : word == "cosine_power" ? Distribution::cosine_power
                   : word == "spot"         ? Distribution::spot
                   : word == "collimated"   ? Distribution::collimated
                                            : Distribution::lambertian;
  e.cosine_power = keys.number("cosine_power");
  e.spot_inner_deg = keys.number("spot_inner_deg");
  e.spot_outer_deg = keys.number("spot_outer_deg");
  const auto only_for = [&](const char* key, const char* distribution) {
    if (keys.has(key) && word != distribution) {
      keys.problem(key, "'" + std::string(key) + "' belongs to distribution = \"" + distribution +
                            "\", not to \"" + word + "\"");
    }
  };
  only_for("cosine_power", "cosine_power");
  only_for("spot_inner_deg", "spot");
  only_for("spot_outer_deg", "spot");
  if (!keys.clean()) return;
  if (word == "spot" && e.spot_inner_deg > e.spot_outer_deg) {
    keys.problem("spot_inner_deg", "'spot_inner_deg' must not exceed 'spot_outer_deg'");
  }
  const bool directed =
      e.distribution == Distribution::spot || e.distribution == Distribution::collimated;
  const bool flat = e.shape == EmitterShape::point || e.shape == EmitterShape::rectangle ||
                    e.shape == EmitterShape::disc;
  if (directed && !flat) {
    keys.problem("distribution", "\"" + word + "\" needs a point, a rectangle or a disc");
  }
}

void read_mesh_shape(KeyReader& keys, Emitter& e) {
  const auto path = keys.file("file");
  const auto scale = metres_per_unit(keys.choice("units"));
  const auto up = up_axis_named(keys.choice("up"));
  const Transform transform = read_transform(keys);
  if (!path || !keys.clean()) return;
  const auto read = read_mesh(*path, scale.value(), up.value(), keys.place("file"), keys.reading());
  if (!read) return;
  if (read->parts.empty())
    return keys.problem("file", "this file holds lamps and no triangles that could emit");
  for (const ImportedPart& part : read->parts) {
    keys.reading().scene.degenerate_triangles += part.degenerate_triangles;
    append(e.mesh, part.mesh);
  }
  apply(transform, e.mesh);
}

void read_shape(KeyReader& keys, Emitter& e, const std::string& kind) {
  if (kind == "mesh") {
    e.shape = EmitterShape::mesh;
    return read_mesh_shape(keys, e);
  }
  e.frame = read_aim(keys);
  if (kind == "rectangle") {
    e.shape = EmitterShape::rectangle;
    const glm::dvec2 size = keys.pair("size");
    e.size = {size.x, size.y, 0};
  } else if (kind == "disc" || kind == "sphere") {
    e.shape = kind == "disc" ? EmitterShape::disc : EmitterShape::sphere;
    e.size.x = keys.number("diameter");
  } else if (kind == "tube") {
    e.shape = EmitterShape::tube;
    e.size = {keys.number("length"), keys.number("diameter"), 0};
  }
}

/// Luminous area [m2]; for a tube its lateral surface only.
double area_of(const Emitter& e) {
  switch (e.shape) {
    case EmitterShape::point:
      return 0;
    case EmitterShape::rectangle:
      return e.size.x * e.size.y;
    case EmitterShape::disc:
      return pi * e.size.x * e.size.x / 4;
    case EmitterShape::sphere:
      return pi * e.size.x * e.size.x;
    case EmitterShape::tube:
      return pi * e.size.x * e.size.y;
    case EmitterShape::mesh:
      return area_of(e.mesh);
  }
  return 0;
}

/// Flux of the mains state before factors [lm], or [W] where e.radiometric gets set.
double read_flux(KeyReader& keys, Emitter& e) {
  const std::string given = keys.exactly_one({"flux_lm", "flux_w", "luminance_cd_m2"}, true);
  if (given.empty()) return 1;
  const double value = keys.number(given);
  e.radiometric = given == "flux_w";
  if (given != "luminance_cd_m2") return value;
  if (e.shape == EmitterShape::point) {
    keys.problem(given, "a point has no luminance; give 'flux_lm' or 'flux_w'");
  } else if (e.distribution != Distribution::lambertian) {
    keys.problem(given, "'luminance_cd_m2' is for Lambertian surfaces; give 'flux_lm' or 'flux_w'");
  }
  return pi * value * area_of(e);  // Lambert's law
}

/// Adds the emitter, and its copies as NAME.2, NAME.3 and so on.
void add_emitter(KeyReader& keys, const Emitter& e, std::span<const glm::dvec3> copies) {
  SceneReading& reading = keys.reading();
  reading.emitter_copies.push_back({reading.scene.emitters.size(), copies.size()});
  for (size_t i = 0; i < copies.size(); ++i) {
    Emitter copy = e;
    copy.frame.origin += copies[i];
    for (glm::dvec3& p : copy.mesh.positions) p += copies[i];
    if (i > 0) {
      copy.name += "." + std::to_string(i + 1);
      reading.declare("luminaire or emitter", copy.name, e.place);
    }
    reading.scene.emitters.push_back(std::move(copy));
  }
}

bool ending_is_gldf(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending.size() == 5 &&
         std::equal(ending.begin(), ending.end(), ".gldf", [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

/// Selects a luminaire of a container. `other_file`: the luminaire's file is none, so that its keys
/// have no meaning.
GldfChoice read_choice(KeyReader& keys, bool other_file) {
  for (const char* key : {"variant", "emitter"})
    if (other_file && keys.has(key))
      keys.problem(key, "'" + std::string(key) + "' belongs to a GLDF container (.gldf)");
  GldfChoice choice{keys.maybe_text("variant").value_or(""),
                    keys.maybe_text("emitter").value_or(""),
                    keys.maybe_number("duration_h"),
                    {}};
  if (const auto set = keys.maybe_integer("lamp_set")) choice.lamp_set = static_cast<int>(*set);
  return choice;
}

std::optional<GldfLuminaire> contained_luminaire(KeyReader& keys, const std::filesystem::path& path,
                                                 const GldfChoice& choice) {
  const auto product = read_container(path, keys.place("file"), keys.reading());
  if (!product) return std::nullopt;
  auto chosen = luminaire_of(*product, choice);
  if (!chosen) {
    take_problem(chosen.problem(), keys.place("file"), keys.reading());
    return std::nullopt;
  }
  for (const Problem& w : chosen->photometry.warnings) keys.reading().warning(w.where, w.what);
  return std::move(chosen).value();
}

}  // namespace

void read_photometric_light(KeyReader& keys, Emitter& e) {
  e.distribution = Distribution::web;
  const bool point = keys.flag("point_source");
  const auto path = keys.file("file");
  const bool container = path && ending_is_gldf(*path);
  const GldfChoice choice = read_choice(keys, path && !container);
  std::optional<GldfLuminaire> contained;
  double rated = 0;
  const auto take = [&](const PhotometricFile& file) {
    if (keys.has("lamp_set") && file.format != "EULUMDAT")
      keys.problem("lamp_set",
                   std::string("'lamp_set' belongs to an EULUMDAT file (.ldt); this is ") +
                       (container ? "a container with " : "") + file.format);
    e.web = file.web;
    e.file = *keys.value("file")->as_text();
    e.product = file.luminaire;
    e.facts = {file.manufacturer, file.article,   "",
               file.input_watts,  file.housing_m, file.housing_round};
    e.opening_m = file.opening.size_m;
    rated = file.web->flux_lm();
    if (!point) take_opening(file.opening, e);
  };
  if (container) {
    contained = contained_luminaire(keys, *path, choice);
    if (contained) {
      take(contained->photometry);
      rated = contained->rated_lm;
      e.frame.axes = e.frame.axes * contained->turn;
      e.turned_in_file = contained->turn != glm::dmat3(1);
    }
  } else if (path) {
    const auto file = read_photometry(*path, choice.lamp_set, keys.place("file"), keys.reading());
    if (file) take(*file);
  }
  read_operation(keys, e, rated, !container, contained ? &*contained : nullptr);
  read_body(keys, e);
}

void resolve_bodies(SceneReading& reading) {
  auto& emitters = reading.scene.emitters;
  using Copies = SceneReading::EmitterCopies;
  std::map<std::string_view, Copies> copies_of;
  for (const Copies& copies : reading.emitter_copies)
    for (size_t i = copies.first; i < copies.first + copies.count; ++i)
      copies_of.try_emplace(emitters[i].name, copies);
  std::map<std::set<size_t>, int> numbers;
  for (Object& object : reading.scene.objects) {
    std::set<size_t> lit;
    for (const std::string& name : object.body_of) {
      if (!reading.require("luminaire or emitter", name, object.place)) continue;
      const auto at = copies_of.find(name);
      if (at == copies_of.end()) continue;
      for (size_t i = 0; i < at->second.count; ++i) lit.insert(at->second.first + i);
    }
    if (lit.empty()) continue;
    const auto [it, fresh] = numbers.try_emplace(lit, static_cast<int>(numbers.size()) + 1);
    object.body = it->second;
    if (!fresh) continue;
    for (const size_t i : lit) {
      if (emitters[i].body != 0)
        return reading.problem(object.place,
                               "another body of '" + emitters[i].name + "' than '" + object.name +
                                   "' names other luminaires: name the same in 'body_of' of both");
      emitters[i].body = it->second;
    }
  }
}

void read_luminaire(const toml::Table& stated, SceneReading& reading) {
  const auto typed = with_type(stated, "luminaire_type", reading);
  const toml::Table table = typed.value_or(stated);
  KeyReader keys(table, {"luminaire"}, reading);
  Emitter e;
  e.name = read_name(keys, "luminaire or emitter");
  if (!typed) return;
  e.ifc_guid = keys.text("ifc_guid");
  e.place = keys.place();
  e.frame = read_aim(keys);
  read_photometric_light(keys, e);
  read_product(keys, e.facts);
  add_emitter(keys, e, read_repeat(keys));
}

void read_emitter(const toml::Table& table, SceneReading& reading) {
  std::string kind;
  KeyReader keys = kind_reader(table, "emitter", "shape", reading, kind);
  Emitter e;
  e.place = keys.place();
  e.name = read_name(keys, "luminaire or emitter");
  if (!kind.empty()) {
    const size_t before = reading.findings.problem_count();
    read_shape(keys, e, kind);
    const bool shaped = reading.findings.problem_count() == before;
    read_distribution(keys, e);
    const double flux = read_flux(keys, e);
    if (shaped && keys.clean() && e.shape != EmitterShape::point && !(area_of(e) > 1e-12)) {
      keys.problem("'" + e.name + "' has no area to emit from; use shape = \"point\"");
    }
    read_operation(keys, e, flux);
  }
  read_body(keys, e);
  add_emitter(keys, e, read_repeat(keys));
}

}  // namespace luxodus

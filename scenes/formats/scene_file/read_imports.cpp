// Reads OBJ and glTF files: their parts become objects, their materials those of the scene.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <span>

#include "runtime/core/printable.hpp"
#include "runtime/toml/words.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

namespace {

/// Whether `pattern`, in which * matches any characters, matches all of `text`.
bool matches(std::string_view pattern, std::string_view text) {
  size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

/// An [[import.part]] table, whose keys override the import's.
struct PartRule {
  std::string match;
  SourcePlace place;
  bool omit = false;
  Object object;  // patch edge, tags, group, door
  bool own_patch_edge = false;
  bool own_one_patch = false;
  SurfaceWords words;
  bool used = false;
};

PartRule read_rule(const toml::Table& table, KeyReader& of) {
  KeyReader keys(table, {"import.part"}, of.reading());
  PartRule rule;
  rule.match = keys.text("match");
  rule.place = keys.place("match");
  rule.omit = keys.flag("omit");
  if (const auto material = keys.maybe_text("material")) {
    rule.words.material = *material;
    rule.words.material_place = keys.place("material");
  }
  read_surface(keys, rule.object, rule.words);
  rule.own_patch_edge = keys.has("patch_edge_m");
  rule.own_one_patch = keys.has("one_patch");
  read_door(keys, rule.object);
  rule.used = !keys.clean();  // a broken rule is not also reported as matching nothing
  return rule;
}

/// Chooses the material of parts: the part's rule, the table, the default, the file's colour.
class Materials {
 public:
  explicit Materials(KeyReader& keys, std::string import)
      : keys_(keys), import_(std::move(import)), colours_(keys.flag("file_colours")) {
    for (auto& w : keys.words("materials")) table_.emplace(w.name, w);
    if (const auto m = keys.maybe_text("material")) {
      fallback_ = *m;
      fallback_place_ = keys.place("material");
    }
  }

  SurfaceWords of(const ImportedPart& part, SurfaceWords words) {
    seen_.insert(part.material_name);
    if (const auto it = table_.find(part.material_name); it != table_.end()) {
      words.material = it->second.text;
      words.material_place = it->second.place;
    } else if (!fallback_.empty()) {
      words.material = fallback_;
      words.material_place = fallback_place_;
    } else if (colours_ && part.base_colour) {
      words.material = from_colour(part);
      words.material_place = keys_.place();
    } else {
      words.material.clear();
    }
    return words;
  }

  void missing(const ImportedPart& part) {
    if (!reported_.insert(part.material_name).second) return;
    if (colours_ && part.no_colour) {
      Problem why = *part.no_colour;
      why.what += "; or have 'materials' or 'material' map it to one of the scene";
      return take_problem(why, keys_.place("file_colours"), keys_.reading());
    }
    const std::string name = part.material_name.empty()
                                 ? "no material"
                                 : "the material '" + excerpt(part.material_name) + "'";
    keys_.problem("the part '" + excerpt(part.name) + "' has " + name +
                  ", which neither 'materials' nor 'material' maps to one of the scene");
  }

  /// Reports rows of the table that no part of the file uses.
  void report_unused() {
    const std::vector<std::string_view> known(seen_.begin(), seen_.end());
    for (const auto& [name, word] : table_) {
      if (seen_.count(name) > 0) continue;
      std::string what = "no part of this file has the material '" + name + "'";
      if (const auto near = toml::nearest_word(name, known))
        what += "; did you mean '" + std::string(*near) + "'?";
      keys_.reading().problem(word.place, what);
    }
  }

 private:
  std::string from_colour(const ImportedPart& part) {
    const std::string name = import_ + "." + part.material_name;
    SceneReading& reading = keys_.reading();
    if (!reading.declared("material", name)) {
      Material m;
      m.name = name;
      m.place = keys_.place();
      const glm::dvec3 c = *part.base_colour;
      m.reflectance = reflectance_from_linear_srgb(c.r, c.g, c.b);
      reading.declare("material", name, m.place);
      reading.scene.materials.push_back(std::move(m));
    }
    return name;
  }

  KeyReader& keys_;
  std::string import_;
  bool colours_;
  std::map<std::string, KeyReader::Word> table_;
  std::string fallback_;
  SourcePlace fallback_place_;
  std::set<std::string> seen_, reported_;
};

/// Adds the object of one part, unless a rule omits it.
void add_part(ImportedPart& part, Object object, SurfaceWords words, std::vector<PartRule>& rules,
              Materials& materials, SceneReading& reading) {
  words = materials.of(part, words);
  for (PartRule& rule : rules) {
    if (!matches(rule.match, part.name)) continue;
    rule.used = true;
    if (rule.omit) return;
    if (!rule.words.material.empty()) {
      words.material = rule.words.material;
      words.material_place = rule.words.material_place;
    }
    if (!rule.words.back_material.empty()) {
      words.back_material = rule.words.back_material;
      words.back_place = rule.words.back_place;
    }
    if (rule.own_patch_edge) object.patch_edge_m = rule.object.patch_edge_m;
    if (rule.own_one_patch) object.one_patch = rule.object.one_patch;
    if (!rule.object.group.empty()) object.group = rule.object.group;
    for (const auto& tag : rule.object.tags) object.tags.push_back(tag);
    if (rule.object.door) object.door = rule.object.door;
    if (!rule.object.body_of.empty()) object.body_of = rule.object.body_of;
  }
  if (words.material.empty()) return materials.missing(part);
  object.tags.push_back(object.name);
  object.name += "." + part.name;
  object.mesh = std::move(part.mesh);
  reading.scene.degenerate_triangles += part.degenerate_triangles;
  reading.declare("object", object.name, object.place);
  add_object(std::move(object), words, reading);
}

/// Places the lamps of a file that holds nothing else, as emitters NAME.LAMP lit by the mains.
void place_lamps(KeyReader& keys, const std::vector<ImportedLamp>& lamps, const std::string& import,
                 const Transform& transform, std::span<const glm::dvec3> copies) {
  SceneReading& reading = keys.reading();
  std::map<std::string, int> times_used;
  for (const ImportedLamp& lamp : lamps) {
    const double peak = std::max({lamp.colour.x, lamp.colour.y, lamp.colour.z});
    if (!(lamp.candela * peak > 0)) continue;
    Emitter e;
    e.place = keys.place("file");
    e.distribution = lamp.is_spot ? Distribution::spot : Distribution::isotropic;
    e.spot_inner_deg = lamp.is_spot ? lamp.inner_deg : 0;
    e.spot_outer_deg = lamp.is_spot ? lamp.outer_deg : 0;
    e.spectrum = emission_shape_from_linear_srgb(lamp.colour.x, lamp.colour.y, lamp.colour.z);
    // Luminance of linear sRGB (IEC 61966-2-1); the solid angle of the whole sphere or of the cone.
    const double luminance = glm::dot(lamp.colour, glm::dvec3(0.2126, 0.7152, 0.0722));
    constexpr double sphere_sr = 4 * std::numbers::pi;
    const double solid_angle =
        lamp.is_spot ? static_cast<double>(SpotLobe::from_half_angles(glm::radians(lamp.inner_deg),
                                                                      glm::radians(lamp.outer_deg))
                                               .solid_angle())
                     : sphere_sr;
    e.mains_flux = lamp.candela * luminance * solid_angle;
    const auto frame = frame_aiming(transform.point(lamp.at), transform.vector(lamp.direction));
    if (!frame) return keys.problem("file", frame.problem().what);
    reading.emitter_copies.push_back({reading.scene.emitters.size(), copies.size()});
    for (const glm::dvec3& offset : copies) {
      const std::string wish = import + "." + lamp.name;
      const int times = ++times_used[wish];
      e.name = times == 1 ? wish : fmt::format("{}#{}", wish, times);
      e.frame = frame.value();
      e.frame.origin += offset;
      reading.declare("luminaire or emitter", e.name, e.place);
      reading.scene.emitters.push_back(e);
    }
  }
}

}  // namespace

void read_import(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"import"}, reading);
  Object common;
  common.place = keys.place();
  common.patch_edge_m = reading.patch_edge_m;
  common.name = read_name(keys, "import");
  SurfaceWords words;
  read_surface(keys, common, words);
  Materials materials(keys, common.name);
  const Transform transform = read_transform(keys);
  const auto copies = read_repeat(keys);
  const auto scale = metres_per_unit(keys.choice("units"));
  const auto up = up_axis_named(keys.choice("up"));
  std::vector<PartRule> rules;
  for (const toml::Table* t : keys.tables("part")) rules.push_back(read_rule(*t, keys));
  const auto path = keys.file("file");
  // Without the file its part names are unknown, so no rule can be called wrong.
  if (!path || !keys.clean()) {
    reading.incomplete = true;
    return;
  }
  auto read = read_mesh(*path, scale.value(), up.value(), keys.place("file"), reading);
  if (!read) {
    reading.incomplete = true;
    return;
  }
  if (read->parts.empty()) {
    place_lamps(keys, read->extras.lamps, common.name, transform, copies);
  } else if (const size_t lamps = read->extras.lamps.size(); lamps > 0) {
    reading.warning(keys.place("file"),
                    fmt::format("{} of this file {} not placed, because it holds surfaces, too: "
                                "state luminaires, or import a file of the lamps alone",
                                lamps == 1 ? "1 lamp" : fmt::format("{} lamps", lamps),
                                lamps == 1 ? "is" : "are"));
  }
  reading.note("object or tag", common.name, common.place);
  for (ImportedPart& part : read->parts) {
    apply(transform, part.mesh);
    repeat_mesh(keys, copies, part.mesh);
    add_part(part, common, words, rules, materials, reading);
  }
  materials.report_unused();
  for (const PartRule& rule : rules) {
    if (rule.used) continue;
    reading.problem(rule.place, "no part of this file is called '" + rule.match + "'");
  }
}

}  // namespace luxodus

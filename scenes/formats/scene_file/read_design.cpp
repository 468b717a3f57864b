// Reads what `luxodus design` may place. Called after luminaires, routes and areas, and before the
// changes of a variant, so that a variant has the same types as the scene that it includes.
#include <algorithm>
#include <filesystem>
#include <set>

#include "scenes/formats/scene_file/read_luminaires.hpp"
#include "scenes/formats/scene_file/read_signs.hpp"
#include "scenes/formats/scene_file/read_types.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace {

/// Cosine of half a degree: an aim this close to the vertical looks down.
constexpr double down_cosine = 0.99996;

/// The generic type: a white disc, as bright as common emergency downlights, with the factors that
/// projects usually state (maintenance 0.8, 0.7 left at the end of the rated duration).
constexpr double generic_lm = 200, generic_diameter_m = 0.1;
constexpr double generic_maintenance = 0.8, generic_end = 0.7;

/// Moves to the origin, looking down, without rotation.
void put_to_origin(Emitter& e) {
  // A frame exists for the downward direction.
  e.frame = frame_aiming(glm::dvec3(0), {0, 0, -1}).value();
  e.ifc_guid.clear();  // it belongs to the luminaire that was copied, as its body does
  e.body = 0;
}

DesignType generic_type(const SourcePlace& place) {
  DesignType type;
  type.name = "generic downlight";
  type.place = place;
  Emitter& e = type.emitter;
  e.name = type.name;
  e.place = place;
  e.shape = EmitterShape::disc;
  e.size = {generic_diameter_m, 0, 0};
  e.distribution = Distribution::lambertian;
  e.maintenance_factor = generic_maintenance;
  e.emergency_flux_is = EmergencyFluxIs::initial;
  e.end_of_duration_factor = generic_end;
  e.emergency_ageing = generic_maintenance * generic_end;
  e.emergency_flux = generic_lm * e.emergency_ageing;
  e.onset = {{0, 0}, {0.3, 1}};
  put_to_origin(e);
  return type;
}

/// The emergency luminaires of the scene that look down, one of each kind, named by their files.
std::vector<DesignType> types_of_scene(const SceneDescription& scene) {
  std::vector<DesignType> out;
  std::set<std::string> taken;
  for (const Emitter& e : scene.emitters) {
    if (!(e.emergency_flux > 0) || e.shape == EmitterShape::mesh || e.turned_in_file) continue;
    if (e.frame.axes[2].z < down_cosine) continue;
    if (std::any_of(out.begin(), out.end(),
                    [&](const DesignType& type) { return same_light(type.emitter, e); }))
      continue;
    DesignType type;
    const std::string file = std::filesystem::path(e.file).stem().string();
    type.name = file.empty() || taken.contains(file) ? e.name : file;
    taken.insert(type.name);
    type.place = e.place;
    type.emitter = e;
    type.like = e.name;
    type.emitter.name = type.name;
    put_to_origin(type.emitter);
    out.push_back(std::move(type));
  }
  return out;
}

/// Takes the light of a luminaire in the scene. Other keys of light beside it would contradict it.
void take_light_of(KeyReader& keys, const std::string& like, Emitter& e) {
  for (const char* key :
       {"file", "variant", "emitter", "duration_h", "point_source", "circuit", "group",
        "mains_factor", "maintenance_factor", "emergency", "emergency_flux", "emergency_factor",
        "emergency_flux_is", "initial_flux", "end_of_duration_factor", "lamp_set", "onset",
        "spectrum", "body_material"})
    if (keys.has(key))
      return keys.problem(
          key, "'" + std::string(key) + "' and 'like' exclude each other: '" + like + "' says it");
  const auto& emitters = keys.reading().scene.emitters;
  const auto at = std::find_if(emitters.begin(), emitters.end(),
                               [&](const Emitter& one) { return one.name == like; });
  if (at == emitters.end())
    return keys.problem("like", "there is no luminaire or emitter \"" + like + "\" to be like");
  if (at->shape == EmitterShape::mesh)
    return keys.problem("like",
                        "an emitter of shape mesh stays where its file says: it is no "
                        "type that can be placed");
  e = *at;
}

template <class Word, size_t N>
Word word_of(KeyReader& keys, const char* key, const std::array<std::string_view, N>& words) {
  const auto at = std::find(words.begin(), words.end(), keys.choice(key));
  return static_cast<Word>(at == words.end() ? 0 : at - words.begin());
}

void read_design_type(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design.type"}, reading);
  DesignType type;
  type.name = read_name(keys, "type of a design");
  type.place = keys.place();
  type.stated = true;
  type.emitter.place = type.place;
  const std::string from = keys.exactly_one({"like", "file"}, true);
  if (from == "like")
    take_light_of(keys, type.like = keys.text("like"), type.emitter);
  else if (from == "file")
    read_photometric_light(keys, type.emitter);
  if (type.emitter.turned_in_file)
    keys.problem(from,
                 "the container turns this emitter within its luminaire, and a design places "
                 "luminaires that are not turned: place it in the scene instead");
  type.emitter.name = type.name;
  put_to_origin(type.emitter);
  type.cost = keys.number("cost");
  type.watts = keys.number("watts");
  type.turns_deg = keys.numbers("turns_deg");
  type.mount = word_of<LuminaireMount>(keys, "mount", luminaire_mount_words);
  if (keys.has("battery")) type.battery = word_of<Battery>(keys, "battery", battery_words);
  type.aim_deg = keys.number("aim_deg");
  if (keys.clean() && !(type.emitter.emergency_flux > 0))
    keys.problem("the type '" + type.name +
                 "' gives no light in an emergency: set 'emergency', and 'emergency_flux' or "
                 "'emergency_factor'");
  design.types.push_back(std::move(type));
}

/// Moves to the origin, facing +x, without routes.
void put_to_origin(Sign& sign) {
  sign.leads_to.clear();
  sign.frame = frame_facing(glm::dvec3(0), {1, 0, 0}, {0, 0, 1}).value();
  sign.ifc_guid.clear();
}

DesignSignType generic_sign(const SourcePlace& place) {
  DesignSignType type;
  type.name = "generic exit sign";
  type.place = place;
  type.sign.name = type.name;
  type.sign.place = place;
  make_generic_sign(type.sign);
  put_to_origin(type.sign);
  return type;
}

bool alike(const Sign& a, const Sign& b) {
  const auto same = [](const FaceColour& p, const FaceColour& q) {
    return p.name == q.name && p.mains_cd_m2 == q.mains_cd_m2 &&
           p.emergency_cd_m2 == q.emergency_cd_m2;
  };
  return a.width_m == b.width_m && a.height_m == b.height_m && a.file == b.file &&
         a.text == b.text && a.lighting == b.lighting && a.double_sided == b.double_sided &&
         std::equal(a.colours.begin(), a.colours.end(), b.colours.begin(), b.colours.end(), same) &&
         a.face.legend == b.face.legend && a.decay == b.decay && a.duration_s == b.duration_s &&
         a.angular_exponent == b.angular_exponent;
}

/// The arrow shared by all its routes; none where it has none or several.
std::optional<SignArrow> only_arrow(const Sign& sign) {
  if (sign.leads_to.empty()) return std::nullopt;
  const SignArrow first = sign.leads_to.front().arrow;
  for (const LeadsTo& one : sign.leads_to)
    if (one.arrow != first) return std::nullopt;
  return first;
}

/// The upright signs of the scene, one of each kind, named by their drawings.
std::vector<DesignSignType> signs_of_scene(const SceneDescription& scene) {
  constexpr double upright = 0.99;  // cosine
  std::vector<DesignSignType> out;
  std::set<std::string> taken;
  for (const Sign& sign : scene.signs) {
    if (sign.frame.axes[1].z < upright) continue;
    const auto arrow = only_arrow(sign);
    if (std::any_of(out.begin(), out.end(), [&](const DesignSignType& type) {
          return type.arrow == arrow && alike(type.sign, sign);
        }))
      continue;
    DesignSignType type;
    const std::string file = std::filesystem::path(sign.file).stem().string();
    type.name = file.empty() || taken.contains(file) ? sign.name : file;
    taken.insert(type.name);
    type.place = sign.place;
    type.sign = sign;
    type.sign.name = type.name;
    type.arrow = arrow;
    put_to_origin(type.sign);
    out.push_back(std::move(type));
  }
  return out;
}

/// Takes a sign of the scene. Other keys of the sign beside it would contradict it.
void take_sign_like(KeyReader& keys, const std::string& like, Sign& sign) {
  for (const KeySpec& key : sign_body_keys())
    if (keys.has(key.name))
      return keys.problem(key.name, "'" + std::string(key.name) +
                                        "' and 'like' exclude each other: '" + like + "' says it");
  const auto& signs = keys.reading().scene.signs;
  const auto at =
      std::find_if(signs.begin(), signs.end(), [&](const Sign& one) { return one.name == like; });
  if (at == signs.end())
    return keys.problem("like", "there is no sign \"" + like + "\" to be like");
  sign = *at;
}

void read_design_sign(const toml::Table& stated, SceneReading& reading, DesignSettings& design) {
  const auto typed = with_type(stated, "sign_type", reading);
  const toml::Table table = typed.value_or(stated);
  KeyReader keys(table, {"design.sign"}, reading);
  DesignSignType type;
  type.name = read_name(keys, "sign of a design");
  if (!typed) return;
  type.place = keys.place();
  type.stated = true;
  type.sign.place = type.place;
  if (keys.has("like")) {
    take_sign_like(keys, keys.text("like"), type.sign);
  } else {
    for (const char* key : {"width", "height"})
      if (!keys.has(key))
        keys.problem("the key '" + std::string(key) +
                     "' is missing: the size of the face, or 'like' a sign of the scene");
    if (keys.clean()) read_sign_itself(keys, type.sign);
  }
  type.sign.name = type.name;
  put_to_origin(type.sign);
  type.cost = keys.number("cost");
  type.watts = keys.number("watts");
  if (keys.has("arrow")) type.arrow = arrow_named(keys.choice("arrow"));
  design.sign_types.push_back(std::move(type));
}

void read_keep_out(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design.keep_out"}, reading);
  KeepOut one;
  one.name = read_name(keys, "keep-out zone");
  one.place = keys.place();
  one.position = keys.point("position");
  one.radius_m = keys.number("radius");
  design.keep_outs.push_back(std::move(one));
}

/// Names of luminaires, each in one list.
void read_named(KeyReader& keys, DesignSettings& design) {
  std::set<std::string> seen;
  for (const auto& [key, list] :
       {std::pair{"fixed", &design.fixed}, std::pair{"movable", &design.movable},
        std::pair{"removable", &design.removable}, std::pair{"removed", &design.removed}}) {
    if (keys.has(key)) *list = keys.texts(key);
    for (const std::string& name : *list) {
      const auto& emitters = keys.reading().scene.emitters;
      const auto at = std::find_if(emitters.begin(), emitters.end(),
                                   [&](const Emitter& e) { return e.name == name; });
      if (at == emitters.end())
        keys.problem(key, "'" + std::string(key) + "' names \"" + name +
                              "\", and there is no such luminaire");
      else if (!(at->emergency_flux > 0))
        keys.problem(key, "'" + std::string(key) + "' names \"" + name +
                              "\", which gives no light in an emergency");
      else if (list == &design.movable && at->shape == EmitterShape::mesh)
        keys.problem(key, "'movable' names \"" + name +
                              "\", an emitter of shape mesh, which stays where its file says");
      if (!seen.insert(name).second)
        keys.problem(key, "\"" + name +
                              "\" is named twice in 'fixed', 'movable', 'removable' and "
                              "'removed': a luminaire either stays, may be moved, may go, or goes");
    }
  }
}

void check_over(KeyReader& keys, const DesignSettings& design) {
  const SceneDescription& scene = keys.reading().scene;
  const auto is_one = [](const auto& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& o) { return o.name == name; });
  };
  for (const std::string& name : design.over)
    if (!is_one(scene.routes, name) && !is_one(scene.open_areas, name) &&
        !is_one(scene.task_areas, name))
      keys.problem("over", "'over' names \"" + name +
                               "\", and there is no such route, open area or task area");
}

}  // namespace

void read_design(const toml::Table& table, SceneReading& reading, DesignSettings& design) {
  KeyReader keys(table, {"design"}, reading);
  // Each of several files of a scene may state some keys: the others keep their values.
  const auto says = [&](const char* key) { return keys.has(key); };
  design.place = keys.place();
  for (const toml::Table* type : keys.tables("type")) read_design_type(*type, reading, design);
  for (const toml::Table* sign : keys.tables("sign")) read_design_sign(*sign, reading, design);
  for (const toml::Table* zone : keys.tables("keep_out")) read_keep_out(*zone, reading, design);
  if (says("over")) design.over = keys.texts("over");
  check_over(keys, design);
  for (const auto& [key, value] :
       {std::pair{"spacing_m", &design.spacing_m},
        std::pair{"wall_clearance_m", &design.wall_clearance_m},
        std::pair{"sign_clearance_m", &design.sign_clearance_m},
        std::pair{"drop_m", &design.drop_m}, std::pair{"margin", &design.margin},
        std::pair{"place_tolerance_m", &design.place_tolerance_m},
        std::pair{"wall_height_m", &design.wall_height_m},
        std::pair{"sign_height_m", &design.sign_height_m},
        std::pair{"sign_spacing_m", &design.sign_spacing_m},
        std::pair{"weight_number", &design.weight_number},
        std::pair{"weight_cost", &design.weight_cost},
        std::pair{"weight_watts", &design.weight_watts}})
    if (says(key)) *value = keys.number(key);
  if (says("mounting_height_m")) design.mounting_height_m = keys.maybe_number("mounting_height_m");
  if (says("mounting_height_m") && says("drop_m"))
    keys.problem("drop_m", "'drop_m' and 'mounting_height_m' exclude each other");
  if (says("move_cost")) design.move_cost = keys.maybe_number("move_cost");
  if (says("places")) design.places = keys.points("places");
  if (says("existing"))
    design.existing = word_of<ExistingTreatment>(keys, "existing", existing_words);
  if (says("place_signs")) design.place_signs = keys.flag("place_signs");
  if (says("refine")) design.refine = keys.flag("refine");
  if (says("existing_signs"))
    design.existing_signs = word_of<ExistingTreatment>(keys, "existing_signs", existing_words);
  if (says("failure")) design.failure = word_of<FailureDemand>(keys, "failure", failure_words);
  if (says("objective"))
    design.objective = word_of<DesignObjective>(keys, "objective", objective_words);
  if (says("in_smoke")) design.in_smoke = keys.texts("in_smoke");
  if (says("alternatives")) design.alternatives = static_cast<size_t>(keys.integer("alternatives"));
  read_named(keys, design);
  if (design.objective == DesignObjective::weighted && design.weight_number == 0 &&
      design.weight_cost == 0 && design.weight_watts == 0)
    keys.problem("objective", "all three weights are 0: nothing is sought");
}

void complete_design(SceneReading& reading, DesignSettings design) {
  SceneDescription& scene = reading.scene;
  design.stair_flights = reading.stair_flights;
  if (design.types.empty()) design.types = types_of_scene(scene);
  if (design.types.empty()) design.types.push_back(generic_type(design.place));
  if (!design.place_signs) design.place_signs = scene.signs.empty() || !design.sign_types.empty();
  if (design.sign_types.empty()) design.sign_types = signs_of_scene(scene);
  if (design.sign_types.empty()) design.sign_types.push_back(generic_sign(design.place));
  scene.design = std::make_shared<const DesignSettings>(std::move(design));
}

}  // namespace luxodus

// Reads variants: a file's changes to the files that it includes. Read last, when everything
// exists.
#include <algorithm>

#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/read_signs.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace {

/// The element with this name; a problem where there is none.
template <class List>
auto* named(List& list, KeyReader& keys, const std::string& kind) {
  const std::string name = keys.text("of");
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  if (at == list.end() && keys.clean())
    keys.problem("of", "there is no " + kind + " \"" + name + "\" to change");
  return at == list.end() ? nullptr : &*at;
}

using Aim = Result<Frame> (*)(const glm::dvec3& origin, const glm::dvec3& direction,
                              const glm::dvec3& up);

void move(KeyReader& keys, Frame& frame, Aim aim) {
  if (keys.has("facing") && !keys.has("position"))
    keys.problem("facing", "'facing' needs 'position' beside it");
  if (const auto position = keys.maybe_point("position")) frame.origin = *position;
  const auto facing = keys.maybe_direction("facing");
  if (!facing || !keys.clean()) return;
  const auto turned = aim(frame.origin, *facing, {0, 0, 1});
  if (turned)
    frame = turned.value();
  else
    keys.problem("facing", turned.problem().what);
}

void brighten(Sign& sign, double factor) {
  scale_luminances(sign, factor);
}
void brighten(Emitter& emitter, double factor) {
  emitter.mains_flux *= factor;
  emitter.emergency_flux *= factor;
}

bool stays(const Sign&) {
  return false;
}
/// Meshes keep their corners: their file and placement define them.
bool stays(const Emitter& emitter) {
  return emitter.shape == EmitterShape::mesh;
}

/// The element to change: the one in `of`, or a copy of it if the change gives it a new name.
/// Null after a problem.
template <class List>
typename List::value_type* chosen(List& list, KeyReader& keys, const std::string& kind,
                                  std::string_view declared_as) {
  auto* const original = named(list, keys, kind);
  const auto copy = keys.maybe_text("copy");
  if (original == nullptr || !copy) return original;
  keys.reading().declare(declared_as, *copy, keys.place("copy"));
  if (!keys.has("position"))
    keys.problem("copy", "'copy' needs 'position' beside it: two things are not in one place");
  if (stays(*original))
    keys.problem("copy", "an emitter of shape mesh is not copied: it does not move");
  if (!keys.clean()) return nullptr;
  auto added = *original;
  added.name = *copy;
  added.place = keys.place();
  list.push_back(std::move(added));
  return &list.back();
}

/// A luminaire of a type of the design, not placed yet. Null after a problem.
Emitter* placed_type(KeyReader& keys) {
  SceneDescription& scene = keys.reading().scene;
  const std::string of = keys.text("of");
  const auto& types = scene.design->types;
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const DesignType& one) { return one.name == of; });
  if (type == types.end()) keys.problem("of", "there is no design_type \"" + of + "\" to copy");
  const auto copy = keys.maybe_text("copy");
  if (!copy)
    keys.problem("a 'design_type' is no luminaire yet: give the name of one in 'copy'");
  else
    keys.reading().declare("luminaire or emitter", *copy, keys.place("copy"));
  if (!keys.has("position")) keys.problem("'position' says where the luminaire is: it is missing");
  if (!keys.clean()) return nullptr;
  Emitter added = type->emitter;
  added.name = *copy;
  added.place = keys.place();
  scene.emitters.push_back(std::move(added));
  return &scene.emitters.back();
}

/// A sign of the design, not placed yet, with its routes. Null after a problem.
Sign* placed_sign(KeyReader& keys) {
  SceneDescription& scene = keys.reading().scene;
  const std::string of = keys.text("of");
  const auto& types = scene.design->sign_types;
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const DesignSignType& one) { return one.name == of; });
  if (type == types.end()) keys.problem("of", "there is no design_sign \"" + of + "\" to copy");
  const auto copy = keys.maybe_text("copy");
  if (!copy)
    keys.problem("a 'design_sign' is no sign yet: give the name of one in 'copy'");
  else
    keys.reading().declare("sign", *copy, keys.place("copy"));
  if (!keys.has("position") || !keys.has("facing"))
    keys.problem("'position' and 'facing' say where the sign hangs: both are needed");
  if (!keys.clean()) return nullptr;
  Sign added = type->sign;
  added.name = *copy;
  added.place = keys.place();
  const size_t named = keys.reading().routes_named.size();
  read_leads_to(keys, added);
  for (size_t i = named; i < keys.reading().routes_named.size(); ++i) {
    const auto& route = keys.reading().routes_named[i];
    keys.reading().require("route", route.name, route.place);
  }
  scene.signs.push_back(std::move(added));
  return &scene.signs.back();
}

void turn(KeyReader& keys, Frame& frame) {
  frame.axes = frame.axes * turn_about_axes({0, 0, keys.number("rotation_deg")});
}

/// Whether the change removes its luminaire or sign, and has done so: no other key may follow.
template <class List>
bool removed(List& list, KeyReader& keys, const std::string& kind) {
  if (!keys.flag("remove")) return false;
  for (const char* key : {"copy", "position", "facing", "rotation_deg", "factor"})
    if (keys.has(key))
      keys.problem(key, "'" + std::string(key) + "' says something of a " + kind + " that goes");
  if (const auto* const gone = named(list, keys, kind))
    list.erase(list.begin() + (gone - list.data()));
  return true;
}

/// Whether the changed medium is absent at this time.
bool is_absent(KeyReader& keys) {
  const auto& media = keys.reading().scene.media;
  const std::string of = keys.text("of");
  return keys.reading().declared("medium", of) &&
         std::none_of(media.begin(), media.end(), [&](const Medium& m) { return m.name == of; });
}

/// Applies to every scenario, whether it names the medium or not.
void thicken(SceneDescription& scene, const std::string& medium, double factor,
             const SourcePlace& place) {
  if (scene.scenarios.empty()) {
    scene.scenarios.emplace_back();
    scene.scenarios.back().name = "mains";
  }
  for (Scenario& scenario : scene.scenarios) {
    const auto named = std::find_if(scenario.media.begin(), scenario.media.end(),
                                    [&](const auto& m) { return m.name == medium; });
    if (named == scenario.media.end()) {
      scenario.media.push_back({medium, scenario.smoke_factor * factor, place});
      continue;
    }
    named->factor *= factor;
    named->change = place;
  }
}

}  // namespace

void read_change(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"change"}, reading);
  const std::string kind = keys.choice("kind");
  const double factor = keys.number("factor");
  SceneDescription& scene = reading.scene;
  if (kind != "luminaire" && kind != "sign" && keys.has("remove"))
    keys.problem("remove", "'remove' is for luminaires and signs alone");
  if (kind != "design_sign" && keys.has("leads_to"))
    keys.problem("leads_to", "'leads_to' is for a 'design_sign' alone");
  if (kind != "luminaire" && kind != "design_type" && keys.has("rotation_deg"))
    keys.problem("rotation_deg", "'rotation_deg' is for luminaires alone");
  if (kind == "sign" && removed(scene.signs, keys, kind)) return;
  if (kind == "luminaire" && removed(scene.emitters, keys, kind)) return;
  if (kind == "sign") {
    Sign* const sign = chosen(scene.signs, keys, kind, "sign");
    if (sign == nullptr) return;
    move(keys, sign->frame, frame_facing);
    brighten(*sign, factor);
  } else if (kind == "design_sign") {
    Sign* const sign = placed_sign(keys);
    if (sign == nullptr) return;
    move(keys, sign->frame, frame_facing);
    brighten(*sign, factor);
  } else if (kind == "design_type") {
    Emitter* const emitter = placed_type(keys);
    if (emitter == nullptr) return;
    move(keys, emitter->frame, frame_aiming);
    turn(keys, emitter->frame);
    brighten(*emitter, factor);
  } else if (kind == "luminaire") {
    Emitter* const emitter = chosen(scene.emitters, keys, kind, "luminaire or emitter");
    if (emitter == nullptr) return;
    move(keys, emitter->frame, frame_aiming);
    turn(keys, emitter->frame);
    brighten(*emitter, factor);
  } else if (is_absent(keys)) {
    return;
  } else if (const Medium* const medium = named(scene.media, keys, kind)) {
    if (keys.has("copy"))
      keys.problem("copy", "a medium is not copied: it takes a 'factor' alone");
    else if (keys.has("position") || keys.has("facing"))
      keys.problem("kind", "a medium is not moved: it takes a 'factor' alone");
    thicken(scene, medium->name, factor, keys.place());
  }
}

}  // namespace luxodus

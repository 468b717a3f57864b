#include "scenes/formats/scene_file/read_placement.hpp"

#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

glm::dmat3 turn_about_axes(const glm::dvec3& degrees) {
  glm::dmat3 turn(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 about(0);
    about[axis] = 1;
    // The axes are unit vectors and the angles finite, so that a rotation always exists.
    turn = rotation(about, degrees[axis]).value().linear * turn;
  }
  return turn;
}

Transform read_transform(KeyReader& keys) {
  Transform t;
  const glm::dvec3 scale = keys.scale("scale");
  t.linear = turn_about_axes(keys.point("rotate_deg")) * scaling(scale).linear;
  t.offset = keys.point("translate");
  return t;
}

std::vector<glm::dvec3> read_repeat(KeyReader& keys) {
  std::vector<glm::dvec3> offsets{glm::dvec3(0)};
  for (const toml::Table* table : keys.tables("repeat")) {
    KeyReader row(*table, {"repeat"}, keys.reading());
    const int64_t count = row.integer("count");
    const glm::dvec3 step = row.point("step");
    if (!row.clean()) return {glm::dvec3(0)};
    if (offsets.size() * static_cast<size_t>(count) > scene_limits::copies) {
      row.problem("count", "with this row there are more than " +
                               std::to_string(scene_limits::copies) + " copies");
      return {glm::dvec3(0)};
    }
    const std::vector<glm::dvec3> so_far = offsets;
    for (int64_t i = 1; i < count; ++i) {
      for (const glm::dvec3& offset : so_far)
        offsets.push_back(offset + static_cast<double>(i) * step);
    }
  }
  return offsets;
}

void repeat_mesh(KeyReader& keys, std::span<const glm::dvec3> offsets, Mesh& mesh) {
  if (offsets.size() < 2) return;
  if (mesh.triangles.size() > scene_limits::triangles / offsets.size()) {
    keys.problem("repeat", std::to_string(offsets.size()) + " copies of " +
                               std::to_string(mesh.triangles.size()) +
                               " triangles are more than a scene may have (" +
                               std::to_string(scene_limits::triangles) + ")");
    return;
  }
  mesh = copies_of(mesh, offsets);
}

Frame read_aim(KeyReader& keys) {
  const glm::dvec3 position = keys.point("position");
  glm::dvec3 direction(0, 0, -1);
  const std::string given = keys.exactly_one({"direction", "target"}, false);
  if (given == "direction") direction = keys.maybe_direction("direction").value_or(direction);
  if (given == "target") {
    const glm::dvec3 way = keys.maybe_point("target").value_or(position + direction) - position;
    if (glm::length(way) < 1e-6) {
      keys.problem("target", "'target' must not be the position itself");
    } else {
      direction = glm::normalize(way);
    }
  }
  const double turn = keys.number("rotation_deg");
  auto frame = frame_aiming(position, direction);
  if (!frame) {
    adopt_problem(keys, frame.problem());
    return {};
  }
  frame->axes = frame->axes * turn_about_axes({0, 0, turn});
  return std::move(frame).value();
}

void adopt_problem(KeyReader& keys, const Problem& problem) {
  if (problem.where.file.empty()) {
    keys.problem(problem.what);
  } else {
    keys.problem(problem.text());
  }
}

void read_surface(KeyReader& keys, Object& object, SurfaceWords& words) {
  if (const auto back = keys.maybe_text("back_material")) {
    words.back_material = *back;
    words.back_place = keys.place("back_material");
  }
  if (const auto edge = keys.maybe_number("patch_edge_m")) object.patch_edge_m = *edge;
  if (keys.has("one_patch")) object.one_patch = keys.flag("one_patch");
  if (object.one_patch && keys.has("patch_edge_m"))
    keys.problem("patch_edge_m", "'patch_edge_m' and 'one_patch = true' exclude each other");
  for (auto& tag : keys.texts("tags")) object.tags.push_back(std::move(tag));
  if (const auto group = keys.maybe_text("group")) object.group = *group;
  object.body_of = keys.texts("body_of");
}

void read_door(KeyReader& keys, Object& object) {
  const toml::Table* table = keys.table("door");
  if (!table) return;
  KeyReader door(*table, {"object.door"}, keys.reading());
  Door d;
  d.hinge = door.point("hinge");
  d.axis = door.direction("axis");
  d.open_angle_deg = door.number("open_angle_deg");
  d.open = door.flag("open");
  object.door = d;
}

void add_object(Object object, const SurfaceWords& words, SceneReading& reading) {
  object.material = reading.material_index(words.material, words.material_place);
  object.back_material = words.back_material.empty()
                             ? reading.back_of(object.material)
                             : reading.material_index(words.back_material, words.back_place);
  if (!reading.scene.materials.empty() && object.mesh.texture_uv.empty()) {
    for (const int side : {object.material, object.back_material}) {
      const Material& m = reading.scene.materials[static_cast<size_t>(side)];
      if (!m.reflectance_image) continue;
      reading.problem(words.material_place, "the material '" + m.name + "' has an image, but '" +
                                                object.name + "' has no texture coordinates");
      break;
    }
  }
  const size_t before = reading.triangles;
  reading.triangles += object.mesh.triangles.size();
  if (before <= scene_limits::triangles && reading.triangles > scene_limits::triangles) {
    reading.problem(object.place, "with '" + object.name + "' the scene has more than " +
                                      std::to_string(scene_limits::triangles) + " triangles");
  }
  if (object.door) {
    reading.note("door", object.name, object.place);
    object.tags.push_back("door");
  }
  reading.note("object or tag", object.name, object.place);
  for (const auto& tag : object.tags) reading.note("object or tag", tag, object.place);
  reading.scene.objects.push_back(std::move(object));
}

}  // namespace luxodus

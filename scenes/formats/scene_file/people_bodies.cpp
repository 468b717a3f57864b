// People as bodies. A body is a cylinder as wide as those that hide signs, up to the chin; the head
// is a ball about the eyes. Both are written as [[object]], so that they are read as any object is.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/formats/trajectories/placed_people.hpp"

namespace luxodus {

namespace {

constexpr double head_radius_m = 0.13, shoulders_below_eyes_m = 0.12;
/// Silhouettes look round; a person has 252 triangles.
constexpr double mesh_tolerance_m = 0.004;
/// Clothes.
constexpr const char* material = "grey20";

/// They have the tags "people" and "furniture": routes pass them, and the codes, which judge light
/// without what stands around, ignore them.
std::string object_text(const std::string& name, const char* shape, double radius_m,
                        const glm::dvec3& at, const std::string& more) {
  return fmt::format(
      "\n[[object]]\nname = \"{}\"\nshape = \"{}\"\nradius = {}\n{}mesh_tolerance_m = {}\n"
      "material = \"{}\"\none_patch = true\ntags = [\"people\", \"furniture\"]\n"
      "translate = [{:.4f}, {:.4f}, {:.4f}]\n",
      name, shape, radius_m, more, mesh_tolerance_m, material, at.x, at.y, at.z);
}

std::string body_of(const PlacedPerson& one, const glm::dvec3& foot) {
  const std::string name = fmt::format("{} {}", one.group, one.id);
  const double shoulders_m = std::max(one.eye_height_m - shoulders_below_eyes_m, head_radius_m);
  return object_text(name + " body", "cylinder", body_radius_m, foot,
                     fmt::format("height = {}\n", shoulders_m)) +
         object_text(name + " head", "sphere", head_radius_m,
                     foot + glm::dvec3(0, 0, one.eye_height_m), "");
}

}  // namespace

std::string people_as_objects(SceneReading& reading, double time_s) {
  std::string out;
  for (const PeopleSettings& group : reading.people) {
    if (const auto hashed = reading.hash_file(group.file); !hashed) {
      reading.problem(hashed.problem());
      continue;
    }
    const auto file = read_trajectories(group.file);
    const auto placed = file ? place_people(group, file.value(), reading.scene.assessment)
                             : Result<std::vector<PlacedPerson>>(file.problem());
    if (!placed) {
      reading.problem(placed.problem());
      continue;
    }
    for (const PlacedPerson& one : placed.value())
      if (is_present(one, time_s)) out += body_of(one, foot_at(one, time_s));
  }
  return out;
}

}  // namespace luxodus

#include "actors/judge/walk/wall_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace {

constexpr double step_s = 0.5;
/// Height of the lines above the floor [m].
constexpr double waist_m = 1;
/// Feet may be this far outside the box of all surfaces [m]: floors are drawn without thickness.
constexpr double beside_m = 0.3;
/// A shorter step crosses nothing [m].
constexpr double stands_m = 1e-3;

struct Step {
  size_t person = 0;
  double from_s = 0, to_s = 0;
};

std::vector<Step> steps_of(const std::vector<PlacedPerson>& people) {
  std::vector<Step> out;
  double seconds = 0;
  for (const PlacedPerson& one : people) seconds += one.times_s.back() - one.times_s.front();
  const double apart_s = std::max(step_s, seconds / static_cast<double>(limits::wall_steps));
  for (size_t p = 0; p < people.size(); ++p) {
    const auto& t = people[p].times_s;
    if (t.size() == 1) out.push_back({p, t.front(), t.front()});
    for (double at = t.front(); at < t.back(); at += apart_s)
      out.push_back({p, at, std::min(at + step_s, t.back())});
  }
  return out;
}

Result<void> check_inside(const SceneDescription& scene, const std::vector<PlacedPerson>& people) {
  Bounds box;
  for (const Object& object : scene.objects)
    for (const glm::dvec3& place : object.mesh.positions) box.extend(place);
  if (box.empty())
    return problem_in(scene.file, "this scene has no surfaces, so that nobody can walk in it");
  for (const PlacedPerson& one : people)
    for (size_t i = 0; i < one.feet.size(); ++i) {
      const glm::dvec3& foot = one.feet[i];
      for (int axis = 0; axis < 3; ++axis)
        if (foot[axis] < box.low[axis] - beside_m || foot[axis] > box.high[axis] + beside_m)
          return problem_in(
              scene.file,
              fmt::format("person {} of \"{}\" is outside of the building at {:g} s, at ({:.5g}, "
                          "{:.5g}, {:.5g}) m: it spans x {:.5g} to {:.5g}, y {:.5g} to {:.5g}, z "
                          "{:.5g} to {:.5g} m. State shift, turn_deg and floors in [[people]]",
                          one.id, one.group, one.times_s[i], foot.x, foot.y, foot.z, box.low.x,
                          box.high.x, box.low.y, box.high.y, box.low.z, box.high.z));
    }
  return {};
}

bool goes_wrong(const Building& building, const GeometryAccess& access, const glm::dvec3& from,
                const glm::dvec3& to) {
  const glm::dvec3 up(0, 0, waist_m), way = to - from;
  if (building.in_solid(access, from + up)) return true;
  const double length = glm::length(way);
  if (length < stands_m) return false;
  return next_surface(building.scene(), access, building.local(from + up), glm::vec3(way / length),
                      static_cast<Real>(length))
      .has_value();
}

}  // namespace

Result<void> check_walkable(const SceneDescription& scene) {
  if (scene.packed)
    return problem_in(scene.file, "people walk in scene files: a pack does not hold all of them");
  if (scene.people_are_bodies)
    return problem_in(scene.file,
                      "people who stand as bodies would look through their own heads: take the "
                      "scene without 'people_as_bodies' (luxodus walk --crowd-hides hides signs "
                      "behind people)");
  return {};
}

Result<std::unique_ptr<Building>> walls_alone(const SceneDescription& scene,
                                              const Scenario& scenario, int threads) {
  SceneDescription walls = without_measurements(scene);
  std::erase_if(walls.objects, [&](const Object& object) {
    return object.door.has_value() ||
           scene.materials[static_cast<size_t>(object.material)].kind == MaterialKind::open;
  });
  Scenario open = scenario;
  open.doors_open.clear();
  open.doors_closed.clear();
  return Building::make(std::move(walls), open, threads);
}

Result<WallCheck> check_walls(const SceneDescription& scene, const Scenario& scenario,
                              const std::vector<PlacedPerson>& people, int threads) {
  if (auto ok = check_inside(scene, people); !ok) return ok.problem();
  const auto made = walls_alone(scene, scenario, threads);
  if (!made) return made.problem();
  const Building& building = *made.value();
  const std::vector<Step> steps = steps_of(people);
  std::vector<char> wrong(steps.size());
  building.each(steps.size(), [&](const GeometryAccess& access, size_t i) {
    const PlacedPerson& one = people[steps[i].person];
    wrong[i] =
        goes_wrong(building, access, foot_at(one, steps[i].from_s), foot_at(one, steps[i].to_s))
            ? 1
            : 0;
  });
  WallCheck out{steps.size(), static_cast<size_t>(std::count(wrong.begin(), wrong.end(), 1))};
  if (out.share() <= limits::steps_in_walls) return out;
  const auto first = static_cast<size_t>(std::find(wrong.begin(), wrong.end(), 1) - wrong.begin());
  const PlacedPerson& one = people[steps[first].person];
  const glm::dvec3 at = foot_at(one, steps[first].from_s);
  return problem_in(
      scene.file,
      fmt::format("{:.3g} % of {} steps of the people cross walls or begin in solids, first person "
                  "{} of \"{}\" at {:g} s, at ({:.5g}, {:.5g}, {:.5g}) m; at most {:g} % may. Are "
                  "shift, turn_deg and floors in [[people]] right?",
                  100 * out.share(), out.steps, one.id, one.group, steps[first].from_s, at.x, at.y,
                  at.z, 100 * limits::steps_in_walls));
}

}  // namespace luxodus

#include "tests/random/random_scene.hpp"

#include <algorithm>

#include "tests/random/draw.hpp"

namespace luxodus::test {

namespace {

/// Separates the dice of scenes from those of texts.
constexpr uint64_t of_scenes = 0x5ce7e5;

/// Size of the scene and distance from the origin.
void draw_world(Draw& draw) {
  Dice& dice = draw.dice;
  draw.extreme = dice.chance(0.35);
  draw.bare = dice.chance(0.02);
  const bool odd_size = draw.extreme && dice.chance(0.5);
  draw.size_m = odd_size ? dice.magnitude(1e-3, 1e4) : dice.magnitude(1, 30);
  glm::dvec3 size(draw.size_m);
  size.x *= dice.between(1, 3);
  size.y *= dice.chance(0.1) ? 20 : dice.between(1, 2);
  if (dice.chance(0.3)) draw.low = 10.0 * draw.size_m * dice.direction();
  if (draw.extreme && dice.chance(0.3)) draw.low = dice.magnitude(1, 1e6) * dice.direction();
  draw.high = draw.low + size;
}

void draw_run(Draw& draw) {
  Dice& dice = draw.dice;
  RunSettings& run = draw.scene.run;
  run.seed = dice.bits64() >> 1;
  run.batch_particles = dice.whole(8, 128);
  run.max_bands = dice.chance(0.3) ? 1 : dice.one_of({2, 8, 64});
  if (dice.chance(0.1)) run.band_edges_nm = {380, 381, 555, 779.5, 780};
  run.band_tolerance = dice.one_of({0.02, 1e-6, 1.0});
  if (dice.chance(0.2)) run.voxel_edge_m = draw.size_m * dice.between(0.1, 1);
  run.voxels = dice.chance(0.6);
  if (run.voxels && run.voxel_edge_m == 0 && dice.chance(0.97)) run.voxel_edge_m = draw.size_m / 5;
  run.analogue = dice.chance(0.2);
  run.stratified = dice.chance(0.8);
  run.groups = dice.one_of({GroupRule::one, GroupRule::by_circuit, GroupRule::by_emitter});
  run.eye_path_factor = dice.one_of({0.0, 1.0, 1.0, 3.0});
}

Scenario draw_scenario(Draw& draw) {
  Dice& dice = draw.dice;
  Scenario s;
  s.name = "as drawn";
  if (dice.chance(0.5)) return s;
  s.operation = dice.one_of({Operation::mains, Operation::mains, Operation::emergency,
                             Operation::emergency, Operation::dark});
  s.seconds_after_failure = dice.one_of({0.0, 30.0, 1e6});
  if (dice.chance(0.3)) s.circuits.push_back({"circuit b", dice.one_of({0.0, 1e-6, 1000.0})});
  if (!draw.scene.media.empty() && dice.chance(0.3))
    s.media.push_back({dice.any(draw.scene.media).name, dice.one_of({0.0, 1e-3, 10.0})});
  s.smoke_factor = dice.one_of({1.0, 1.0, 0.0, 0.1});
  s.emission_factor = dice.one_of({1.0, 1e-6, 1e3});
  for (const Object& o : draw.scene.objects) {
    if (!o.door) continue;
    (dice.chance(0.5) ? s.doors_open : s.doors_closed).push_back(o.name);
  }
  return s;
}

/// Flames may extend through a wall; so may a sign, which is at least a centimetre wide, in a room
/// of less than a hand's width.
bool walls_hold(const Draw& draw) {
  const bool flames = std::any_of(draw.scene.media.begin(), draw.scene.media.end(),
                                  [](const Medium& m) { return m.emission.has_value(); });
  const bool room_for_signs = draw.scene.signs.empty() || draw.size_m >= 0.1;
  return draw.enclosed && !flames && room_for_signs;
}

}  // namespace

RandomScene random_scene(uint64_t number) {
  RandomScene out;
  Draw draw{Dice(number, of_scenes), out.description};
  out.description.name = out.description.title = "random scene " + std::to_string(number);
  out.description.file = "scene " + std::to_string(number);
  draw_world(draw);
  draw_run(draw);
  draw_materials(draw);
  draw_room(draw);
  draw_objects(draw);
  draw_emitters(draw);
  draw_signs(draw);
  draw_media(draw);
  draw_measures(draw);
  out.scenario = draw_scenario(draw);
  out.cells = draw.dice.chance(0.6) ? 1 : draw.dice.whole(2, 9);
  out.closed = walls_hold(draw);
  return out;
}

}  // namespace luxodus::test

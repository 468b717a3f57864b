// Shared by the parts of the generator: the dice, the scene so far, and the box that most of it
// lies in. Internal to random_scene.*. One thread.
#pragma once

#include <string>

#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/world/description.hpp"
#include "tests/random/dice.hpp"

namespace luxodus::test {

struct Draw {
  Dice dice;
  SceneDescription& scene;
  glm::dvec3 low{0}, high{1};  // of the room, or of the space it would take
  double size_m = 1;           // its shortest side
  bool extreme = false;        // this scene draws from the ends of ranges
  bool enclosed = false;       // by six opaque walls
  bool bare = false;           // it has no objects, at most flames

  glm::dvec3 size() const { return high - low; }
  /// A point well inside, or also nearby outside.
  glm::dvec3 inside() { return dice.point(low + 0.3 * size(), high - 0.3 * size()); }
  glm::dvec3 near_by() { return dice.point(low - 0.2 * size(), high + 0.2 * size()); }
  glm::dvec3 place() { return enclosed || dice.chance(0.7) ? inside() : near_by(); }
};

/// A share in [0, 1]: either end, close to it, or between. Exactly 1 is rare, since lossless scenes
/// take long to trace.
inline double draw_share(Draw& draw) {
  Dice& dice = draw.dice;
  if (dice.chance(draw.extreme ? 0.5 : 0.9)) return dice.between(0, 0.95);
  const int which = dice.below(32);
  if (which == 0) return 1;
  if (which == 1) return 1 - 1e-6;
  if (which < 4) return 0.999;
  if (which < 12) return 0;
  if (which < 17) return 1e-6;
  return dice.between(0.9, 0.99);
}

/// Grey, or coloured, between 0 and `most`.
Spectrum draw_property(Draw& draw, double most = 1);
/// An emission spectrum with integral 1 over the visible range.
Spectrum draw_emission(Draw& draw);

void draw_materials(Draw& draw);
void draw_room(Draw& draw);
void draw_objects(Draw& draw);
void draw_emitters(Draw& draw);
void draw_signs(Draw& draw);
void draw_media(Draw& draw);
void draw_measures(Draw& draw);

}  // namespace luxodus::test

// Measurements: planes, probes, groups, counting planes, observers, cameras.
#include "tests/random/draw.hpp"

namespace luxodus::test {

namespace {

struct Parallelogram {
  glm::dvec3 corner, u, v;
};

Parallelogram draw_parallelogram(Draw& draw) {
  Dice& dice = draw.dice;
  Parallelogram p;
  p.corner = draw.near_by();
  p.u = draw.size_m * dice.magnitude(1e-3, 1.5) * dice.direction();
  p.v = draw.size_m * dice.magnitude(1e-3, 1.5) * dice.direction();
  const double area = glm::length(glm::cross(p.u, p.v));
  const bool spans = area > 1e-9 * glm::length(p.u) * glm::length(p.v) && area >= 1e-12;
  if (spans) return p;
  p.u = {std::max(draw.size_m, 1e-5), 0, 0};  // a scene file would not accept less
  p.v = {0, std::max(draw.size_m, 1e-5), 0};
  return p;
}

void draw_planes(Draw& draw) {
  Dice& dice = draw.dice;
  const int planes = dice.below(3);
  for (int i = 0; i < planes; ++i) {
    const Parallelogram at = draw_parallelogram(draw);
    PlaneMeasure p{"plane " + std::to_string(i), {}, at.corner, at.u, at.v, 1, 1};
    p.cells_u = dice.whole(1, 7);
    p.cells_v = dice.chance(0.05) ? 300 : dice.whole(1, 7);
    draw.scene.planes.push_back(std::move(p));
  }
  const int counting = dice.chance(0.7) ? 0 : dice.whole(1, 2);
  for (int i = 0; i < counting; ++i) {
    const Parallelogram at = draw_parallelogram(draw);
    draw.scene.counting_planes.push_back(
        {"counting " + std::to_string(i), {}, at.corner, at.u, at.v});
  }
}

void draw_groups(Draw& draw) {
  using enum VolumeGroupMeasure::Shape;
  Dice& dice = draw.dice;
  const int volumes = dice.chance(0.5) ? 0 : dice.whole(1, 3);
  for (int i = 0; i < volumes; ++i) {
    VolumeGroupMeasure g;
    g.name = "volume " + std::to_string(i);
    g.shape = dice.one_of({box, sphere, shell, layer});
    g.low = draw.near_by();
    g.high = g.low + draw.size_m * dice.magnitude(1e-3, 1.5);
    g.centre = draw.near_by();
    g.radius = std::max(1e-6, draw.size_m * dice.magnitude(1e-3, 1.5));
    g.inner_radius = g.radius * dice.one_of({0.0, 0.5, 1 - 1e-6});
    draw.scene.volume_groups.push_back(std::move(g));
  }
  if (!draw.scene.objects.empty() && dice.chance(0.3))
    draw.scene.surface_groups.push_back(
        {"surfaces", {}, {dice.any(draw.scene.objects).name, "tagged"}});
}

/// Observers: one that looks at a sign's front from close by is the one that can see it.
glm::dvec3 draw_eye(Draw& draw) {
  Dice& dice = draw.dice;
  if (draw.scene.signs.empty() || dice.chance(0.3)) return draw.place();
  const Frame& face = dice.any(draw.scene.signs).frame;
  const double near = dice.magnitude(draw.extreme ? 1e-3 : 0.05, 0.6);
  return face.origin + draw.size_m * near * face.axes[2];
}

void draw_eyes(Draw& draw) {
  Dice& dice = draw.dice;
  const int probes = dice.below(3);
  for (int i = 0; i < probes; ++i) {
    const glm::dvec3 at = draw.place();
    draw.scene.probes.push_back({"probe " + std::to_string(i), {}, at, dice.direction()});
  }
  const int observers = dice.chance(0.4) ? 0 : dice.whole(1, 2);
  for (int i = 0; i < observers; ++i) {
    Observer o;
    o.name = "observer " + std::to_string(i);
    o.eye = draw_eye(draw);
    o.gaze = dice.direction();
    if (dice.chance(0.2)) o.signs = std::vector<uint32_t>{0};
    draw.scene.observers.push_back(std::move(o));
  }
  if (dice.chance(0.5)) return;
  Camera c;
  c.name = "camera";
  c.eye = draw_eye(draw);
  c.target = draw.place();
  draw.scene.cameras.push_back(std::move(c));
}

}  // namespace

void draw_measures(Draw& draw) {
  draw_planes(draw);
  draw_groups(draw);
  draw_eyes(draw);
}

}  // namespace luxodus::test

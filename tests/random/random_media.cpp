// Smoke and flames of every kind, overlapping.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/optics/quadric_shapes.hpp"
#include "tests/random/draw.hpp"

namespace luxodus::test {

namespace {

Phase draw_phase(Draw& draw) {
  using enum PhaseKind;
  Dice& dice = draw.dice;
  Phase phase;
  phase.kind = dice.one_of({isotropic, henyey_greenstein, henyey_greenstein, rayleigh, tabulated});
  if (phase.kind == henyey_greenstein) {
    phase.g = draw.extreme ? dice.one_of({0.0, 1e-7, -1e-7, 0.999, -0.999, 0.9999, -0.9999})
                           : dice.between(-0.95, 0.95);
  }
  if (phase.kind != tabulated) return phase;
  const int inner = dice.below(5);
  phase.table_cos = {-1};
  for (int i = 1; i <= inner; ++i) phase.table_cos.push_back(-1 + 2.0 * i / (inner + 1));
  if (draw.extreme) phase.table_cos.push_back(1 - 1e-6);
  phase.table_cos.push_back(1);
  for (size_t i = 0; i < phase.table_cos.size(); ++i)
    phase.table_value.push_back(dice.chance(0.3) ? 0 : dice.magnitude(1e-4, 1e3));
  phase.table_value.back() = 1;
  return phase;
}

/// [1/m]: an optical depth of the room between clear and dark, or the largest that a scene file
/// accepts.
double draw_extinction(Draw& draw) {
  Dice& dice = draw.dice;
  if (dice.chance(0.05)) return 0;
  const double depth = draw.extreme ? dice.magnitude(1e-6, 1e4) : dice.magnitude(0.01, 20);
  if (draw.extreme && dice.chance(0.1)) return 1e5;
  return std::min(depth / draw.size_m, 1e6);
}

SmokeOptics draw_optics(Draw& draw) {
  Dice& dice = draw.dice;
  SmokeOptics optics;
  optics.extinction.sigma_t = draw_extinction(draw);
  if (dice.chance(0.3)) optics.extinction.angstrom = dice.one_of({-2.0, 1.0, 6.0});
  if (dice.chance(0.1)) optics.extinction.table = draw_property(draw) * optics.extinction.sigma_t;
  if (dice.chance(0.1)) optics.extinction.wavelength_nm = dice.between(200, 5000);
  optics.albedo = draw_property(draw);
  // Endless random walks in dark fog without absorption are traced up to the limit: a few are
  // enough.
  const double most = *std::max_element(optics.albedo.value.begin(), optics.albedo.value.end());
  if (most > 0.999 && dice.chance(0.5)) optics.albedo = optics.albedo * 0.9;
  optics.phase = draw_phase(draw);
  return optics;
}

void draw_footprint(Draw& draw, Footprint& footprint) {
  Dice& dice = draw.dice;
  if (dice.chance(0.4)) {
    const int corners = dice.whole(3, 9);
    const glm::dvec3 centre = draw.near_by();
    const double start = dice.between(0, 6);
    for (int i = 0; i < corners; ++i) {  // a star
      const double r = draw.size_m * dice.between(0.1, 0.8);
      const double turn = start + 2 * std::numbers::pi * i / corners;
      footprint.polygon.emplace_back(centre.x + r * std::cos(turn), centre.y + r * std::sin(turn));
    }
    if (dice.chance(0.5)) std::reverse(footprint.polygon.begin(), footprint.polygon.end());
  }
  if (dice.chance(0.4)) footprint.z_low = draw.low.z + draw.size().z * dice.between(-0.2, 0.4);
  if (dice.chance(0.4)) footprint.z_high = draw.low.z + draw.size().z * dice.between(0.5, 1.2);
}

void draw_layers(Draw& draw, Medium& m) {
  Dice& dice = draw.dice;
  const int count = dice.chance(0.1) ? 24 : dice.whole(1, 6);
  double z = draw.low.z + draw.size().z * dice.between(-0.3, 0.5);
  for (int i = 0; i < count; ++i) {
    const double slim = draw.extreme ? dice.magnitude(1e-6, 1) : dice.magnitude(0.05, 1);
    const double high = z + std::max(draw.size().z * slim, 1e-9 * std::max(1.0, std::abs(z)));
    m.layers.push_back({z, high, draw_optics(draw)});
    z = high + (dice.chance(0.5) ? 0 : draw.size().z * dice.between(0, 0.2));
  }
  if (dice.chance(0.3)) {
    draw_footprint(draw, m.footprint);
    m.footprint.z_low = -1e30;
    m.footprint.z_high = 1e30;
  }
}

QuadricShape draw_quadric(Draw& draw, double size) {
  Dice& dice = draw.dice;
  QuadricShape out;
  const double e = dice.between(0.3, 1.5) * size;
  out.bounds = {glm::dvec3(-e), glm::dvec3(e)};
  for (int k = 0; k < 3; ++k) {
    out.quadric.a[k][k] = dice.between(-1, 2) / (size * size);
    out.quadric.b[k] = dice.between(-1, 1) / size;
    const int next = (k + 1) % 3;
    out.quadric.a[k][next] = out.quadric.a[next][k] = dice.between(-0.5, 0.5) / (size * size);
  }
  out.quadric.c = dice.between(-1, 0.1);
  return out;
}

void draw_body(Draw& draw, Medium& m) {
  Dice& dice = draw.dice;
  const double a = std::clamp(draw.size_m * dice.magnitude(0.02, 1), 1e-4, 1e6);
  const double b = std::clamp(draw.size_m * dice.magnitude(0.02, 1), 1e-4, 1e6);
  QuadricShape shape;
  // Volumes without a closed form take tens of milliseconds to compile.
  const int kind = dice.chance(0.1) ? 4 : dice.below(4);
  if (kind == 0) shape = ellipsoid({a, b, 0.5 * (a + b)});
  if (kind == 1) shape = cylinder(a, b);
  if (kind == 2) shape = cone(a, b);
  if (kind == 3) shape = paraboloid(a, b);
  if (kind == 4) shape = draw_quadric(draw, a);
  m.quadric = std::move(shape.quadric);
  m.local_bounds = shape.bounds;
  if (dice.chance(0.1)) {
    const glm::dvec3 normal = dice.direction();
    m.quadric.clips.push_back({normal, 0.5 * a * dice.between(-0.5, 1)});
  }
}

std::vector<float> draw_array(Draw& draw, size_t cells, double most) {
  std::vector<float> out(cells);
  const double empty = draw.dice.one_of({0.0, 0.5, 0.95});
  for (float& v : out)
    v = static_cast<float>(draw.dice.chance(empty) ? 0 : most * draw.dice.between(0, 1));
  return out;
}

void draw_data(Draw& draw, Medium& m) {
  Dice& dice = draw.dice;
  DataSet& d = m.data;
  d.nx = dice.chance(0.15) ? 18 : dice.whole(1, 6);  // 18: two bricks
  d.ny = dice.whole(1, 6);
  d.nz = dice.whole(1, 5);
  const glm::dvec3 low = 0.05 * draw.size();
  d.extent = dice.point(low, 1.2 * draw.size());
  const auto cells = static_cast<size_t>(d.nx * d.ny * d.nz);
  if (dice.chance(0.8)) d.extinction = draw_array(draw, cells, draw_extinction(draw));
  if (dice.chance(0.4)) d.albedo = draw_array(draw, cells, 0.99);
  if (dice.chance(0.4)) d.emission = draw_array(draw, cells, dice.one_of({1e-6, 1.0, 1e6}));
  d.interpolate_emission = dice.chance(0.4);
}

void draw_glow(Draw& draw, Medium& m) {
  Dice& dice = draw.dice;
  MediumEmission e;
  e.power_w = draw.extreme ? dice.one_of({1e-3, 1e3, 1e9}) : dice.magnitude(10, 1e6);
  e.visible_fraction = dice.magnitude(1e-5, 1);
  e.spectrum = draw_emission(draw);
  if (dice.chance(0.3)) e.circuit = "circuit b";
  if (dice.chance(0.3)) e.group = "source group";
  m.emission = std::move(e);
}

}  // namespace

void draw_media(Draw& draw) {
  using enum MediumKind;
  Dice& dice = draw.dice;
  const int count = !draw.bare && dice.chance(0.3) ? 0 : dice.whole(1, 4);
  const MediumKind mostly = dice.one_of({homogeneous, layered, layered, data_set});
  for (int i = 0; i < count; ++i) {
    Medium m;
    m.name = "medium " + std::to_string(i);
    m.kind = dice.chance(0.6) ? mostly : dice.one_of({homogeneous, layered, bounded, data_set});
    m.optics = draw_optics(draw);
    if (m.kind == homogeneous && dice.chance(0.5)) draw_footprint(draw, m.footprint);
    if (m.kind == layered) draw_layers(draw, m);
    if (m.kind == bounded) draw_body(draw, m);
    if (m.kind == data_set) draw_data(draw, m);
    if (m.kind == bounded || m.kind == data_set) {
      m.frame.origin = draw.place();
      if (dice.chance(0.4)) {
        const glm::dvec3 axis = dice.direction();
        m.frame.axes = rotation(axis, dice.between(-360, 360)).value().linear;
      }
      if (dice.chance(draw.bare ? 0.9 : 0.35)) draw_glow(draw, m);
    }
    draw.scene.media.push_back(std::move(m));
  }
}

}  // namespace luxodus::test

// Scattering layers between perfect mirrors, which make them infinite, against discrete ordinates
// with many streams: reflected, transmitted and unscattered light, and in every layer absorbed
// light and path length. And a half space against Chandrasekhar's H function.
#include <algorithm>
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

constexpr double slab_edge = 20;    // [m], wide: few reflections on the mirrors
constexpr double stack_height = 3;  // of every stack
constexpr double gap = 1e-3;        // clear air between stack and receiving face

/// Albedos are in single precision with an error of 6e-8 at each of many collisions; the table has
/// nine digits.
constexpr double slab_rounding = 1e-6;

/// Particles for a quick run whose histories have about `depth` collisions.
int64_t affordable(double depth) {
  return static_cast<int64_t>((1 << 19) / std::max(2.0, depth));
}

/// Light of power 1 enters the stack at its illuminated face and may leave there; beyond the other
/// face it reaches "far".
SceneDescription stack_of(const Row& row) {
  SceneDescription scene;
  scene.run.voxels = false;
  const bool from_top = row.text("from") == "top";
  const double low = from_top ? -gap : 0, high = from_top ? stack_height : stack_height + gap;
  add_mirror_walls(scene, {0, 0, low}, {slab_edge, slab_edge, high});
  const BoxFace far = faces_of_box({0, 0, low}, {slab_edge, slab_edge, high})[from_top ? 4 : 5];
  add_quad(scene, "far", far.corner, far.u, far.v, add_grey(scene, row.number("floor_rho")));
  const glm::dvec3 way(0, 0, from_top ? -1 : 1);
  Emitter& e = add_rectangle(scene, {slab_edge / 2, slab_edge / 2, from_top ? stack_height : 0},
                             way, slab_edge, slab_edge, 1);
  if (row.text("incidence") == "normal") e.distribution = Distribution::collimated;

  const std::vector<double> sigma = row.numbers("sigma_t"), thickness = row.numbers("thickness"),
                            albedo = row.numbers("albedo"), g = row.numbers("g");
  std::vector<SmokeOptics> optics;
  double z = 0;
  for (size_t i = 0; i < sigma.size(); ++i) {
    optics.push_back(smoke(sigma[i], albedo[i], g[i]));
    add_layer_group(scene, z, z + thickness[i]);
    z += thickness[i];
  }
  add_layers(scene, 0, thickness, optics);

  CountingPlaneMeasure plane;  // forward is the direction of the light
  plane.name = "before far";
  plane.corner = {0, 0, from_top ? -gap / 2 : stack_height + gap / 2};
  plane.edge_u = from_top ? glm::dvec3(0, slab_edge, 0) : glm::dvec3(slab_edge, 0, 0);
  plane.edge_v = from_top ? glm::dvec3(slab_edge, 0, 0) : glm::dvec3(0, slab_edge, 0);
  scene.counting_planes.push_back(plane);
  return scene;
}

PreparedCase stack_plan(const Row& row) {
  PreparedCase plan;
  plan.scene = stack_of(row);
  const double tau = row.number("tau_total");
  plan.quick_particles = affordable(tau);
  const uint32_t back = row.text("from") == "top" ? 5 : 4;
  const auto add = [&](const std::string& name, double reference,
                       std::function<Estimate(const Traced&)> read) -> Quantity& {
    Quantity& q = plan.add(name, reference, std::move(read));
    q.bias = slab_rounding;
    return q;
  };
  add("reflected", row.number("R"), [back](const Traced& run) { return run.escaped(back); });
  add("on the far side", row.number("T"), [](const Traced& run) { return run.into("far"); });
  add("unscattered", row.number("T_direct"),
      [](const Traced& run) { return run.watts(run.blocks().counting, 0, 0); });
  if (row.number("floor_rho") > 0)
    add("absorbed by the floor", row.number("floor_absorbed"),
        [](const Traced& run) { return run.absorbed_by("far"); });
  const std::vector<double> absorbed = row.numbers("absorbed"), track = row.numbers("track_length");
  for (uint32_t i = 0; i < absorbed.size(); ++i) {
    const std::string layer = " in layer " + std::to_string(i);
    add("absorbed" + layer, absorbed[i], [i](const Traced& run) { return run.absorbed_in(i); });
    Quantity& path =
        add("path" + layer, track[i], [i](const Traced& run) { return run.track_length(i); });
    path.bias = 2 * slab_rounding * track[i];
    // A particle deep in a thick layer stays there for long [m].
    path.unit = std::max(2.0, 0.5 * tau);
  }
  return plan;
}

/// Scattering gas so deep that nothing returns from its end, between mirrors that make it infinite;
/// a beam with this cosine enters, or diffuse light for 0.
PreparedCase half_space_plan(double albedo, double cosine, double reflected) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  const double top = stack_height + 10 * gap;
  add_mirror_walls(scene, {0, 0, 0}, {slab_edge, slab_edge, top});
  add_quad(scene, "end", {0, 0, 0}, {slab_edge, 0, 0}, {0, slab_edge, 0}, add_grey(scene, 0));
  // Fluence falls by a factor e in at least 1 / sqrt(3 (1 - albedo)) free paths; light scattered
  // beyond would also have to return.
  const double depth = 15 + 8 / std::sqrt(3 * (1 - albedo));
  add_layers(scene, 0, {stack_height}, {smoke(depth / stack_height, albedo)});
  const bool beam = cosine > 0;
  const glm::dvec3 way(beam ? std::sqrt(1 - cosine * cosine) : 0, 0, beam ? -cosine : -1);
  Emitter& lamp = add_rectangle(scene, {slab_edge / 2, slab_edge / 2, stack_height + 5 * gap}, way,
                                gap, gap, 1);
  if (beam) lamp.distribution = Distribution::collimated;
  plan.quick_particles = affordable(0.5 / (1 - albedo));
  plan.add("reflected", reflected, [](const Traced& run) { return run.escaped(5); }).bias =
      2 * slab_rounding;
  Quantity& end = plan.add("reached the end", 0, [](const Traced& run) { return run.into("end"); });
  end.bias = 1e-3;
  end.certain = true;
  return plan;
}

}  // namespace

void add_stack_cases(Cases& cases) {
  for (const Row& row : reference_table("layered_slab.csv")) {
    const std::string name = "stack " + row.text("case") + " " + row.text("name") + " of depth " +
                             row.text("tau_total") + ", " + row.text("incidence") + " from " +
                             row.text("from");
    cases.push_back({"stack", name, "layered_slab.csv", [row] { return stack_plan(row); }});
  }
}

void add_half_space_cases(Cases& cases) {
  for (const Row& row : reference_table("halfspace_H.csv")) {
    for (const auto& [column, cosine] : {std::pair("R(mu0=0.1)", 0.1), std::pair("R(mu0=0.5)", 0.5),
                                         std::pair("R(mu0=1)", 1.0), std::pair("R_lambert", 0.0)}) {
      const double albedo = row.number("albedo"), mu = cosine, reflected = row.number(column);
      cases.push_back({"half space", "half space, albedo " + row.text("albedo") + ", " + column,
                       "halfspace_H.csv", [=] { return half_space_plan(albedo, mu, reflected); }});
    }
  }
}

}  // namespace luxodus::light

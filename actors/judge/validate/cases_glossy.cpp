// One reflection by a glossy plate (GGX facets with Smith's height-correlated masking, in the
// textbook's form, double precision): for a beam by quadrature over the walls that it reaches, for
// a lamp by quadrature over the plate that a probe faces.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

constexpr double glossy_diffuse = 0.2, glossy_specular = 0.6;

/// Both directions point away from a surface whose normal is z.
double brdf(const glm::dvec3& wo, const glm::dvec3& wi, double alpha) {
  if (!(wo.z > 0 && wi.z > 0)) return 0;
  const glm::dvec3 h = glm::normalize(wo + wi);
  const double a2 = alpha * alpha;
  const double d = a2 / (pi * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
  const auto lambda = [&](double cosine) {
    const double tan2 = 1 / (cosine * cosine) - 1;
    return 0.5 * (std::sqrt(1 + a2 * tan2) - 1);
  };
  const double masking = 1 / (1 + lambda(wo.z) + lambda(wi.z));
  return glossy_diffuse / pi + glossy_specular * d * masking / (4 * wo.z * wi.z);
}

int add_glossy(SceneDescription& scene, double alpha) {
  const int number = add_grey(scene, glossy_diffuse);
  Material& m = scene.materials[static_cast<size_t>(number)];
  m.kind = MaterialKind::glossy;
  m.specular = Spectrum::constant(glossy_specular);
  m.roughness = alpha;
  return number;
}

/// Midpoint rule over a parallelogram; f takes a place, and is per area.
double over(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
            const std::function<double(const glm::dvec3&)>& f) {
  constexpr int steps = 400;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j)
      sum += f(corner + u * ((i + 0.5) / steps) + v * ((j + 0.5) / steps));
  }
  return sum * glm::length(glm::cross(u, v)) / (steps * steps);
}

constexpr double of_quadrature = 1e-4;

/// A beam hits the centre of the plate, which is the floor of a black box.
PreparedCase beam_plan(double alpha, double degrees) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const double angle = degrees * pi / 180;
  const glm::dvec3 wo(-std::sin(angle), 0, std::cos(angle));
  const std::vector<BoxFace> faces = faces_of_box({-2, -2, 0}, {2, 2, 2});
  const int black = add_grey(scene, 0);
  add_quad(scene, "plate", faces[4].corner, faces[4].u, faces[4].v, add_glossy(scene, alpha));
  add_rectangle(scene, wo, -wo, 1e-3, 1e-3, 1).distribution = Distribution::collimated;
  plan.quick_particles = 1 << 17;
  double reflected = 0;
  for (const size_t f : {0, 1, 2, 3, 5}) {
    const std::string wall = faces[f].name;
    add_quad(scene, wall, faces[f].corner, faces[f].u, faces[f].v, black);
    const double share = over(faces[f].corner, faces[f].u, faces[f].v, [&](const glm::dvec3& p) {
      const double d = glm::length(p);
      const glm::dvec3 wi = p / d;
      return brdf(wo, wi, alpha) * wi.z * -glm::dot(wi, faces[f].inward) / (d * d);
    });
    reflected += share;
    plan.add(
        "flux into " + wall, share, [wall](const Traced& run) { return run.into(wall); },
        of_quadrature);
  }
  plan.add("absorbed by the plate", 1 - reflected,
           [](const Traced& run) { return run.absorbed_by("plate"); })
      .bias = of_quadrature * reflected;
  plan.add_closed();
  return plan;
}

/// A lamp above the plate, and a probe that faces the plate.
PreparedCase probe_plan(double alpha) {
  constexpr double lamp_lm = 1000;
  const glm::dvec3 lamp(-0.8, 0, 1), eye(0.9, 0.1, 1.2);
  const glm::dvec3 gaze = glm::normalize(glm::dvec3(-0.3, 0, -1));
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.max_bands = 1;
  Emitter& e = add_point(scene, lamp, 0);
  e.radiometric = false;
  e.mains_flux = lamp_lm;
  const glm::dvec3 corner(-1, -1, 0), u(2, 0, 0), v(0, 2, 0);
  add_quad(scene, "plate", corner, u, v, add_glossy(scene, alpha));
  ProbeMeasure probe;
  probe.name = "probe";
  probe.position = eye;
  probe.normal = gaze;
  scene.probes.push_back(probe);
  const double lux = over(corner, u, v, [&](const glm::dvec3& p) {
    const glm::dvec3 to_lamp = lamp - p, to_eye = eye - p;
    const double d1 = glm::length(to_lamp), d2 = glm::length(to_eye);
    const glm::dvec3 wi = to_lamp / d1, wo = to_eye / d2;
    return lamp_lm / (4 * pi) / (d1 * d1) * wi.z * brdf(wo, wi, alpha) * wo.z *
           std::max(0.0, -glm::dot(gaze, wo)) / (d2 * d2);
  });
  plan.quick_particles = 1 << 14;
  scene.run.eye_path_factor = 60;
  plan.add(
          "indirect illuminance [lx]", lux,
          [](const Traced& run) { return run.value(run.blocks().probes, 0); }, of_quadrature)
      .unit = lux;
  return plan;
}

}  // namespace

void add_glossy_cases(Cases& cases) {
  for (const double alpha : {0.1, 0.3, 0.6}) {
    for (const double degrees : {20.0, 65.0})
      cases.push_back(
          {"glossy", fmt::format("beam on a glossy plate, {} deg, alpha {}", degrees, alpha),
           "integral of the lobe over walls", [=] { return beam_plan(alpha, degrees); }});
    cases.push_back({"glossy", fmt::format("probe over a glossy plate, alpha {}", alpha),
                     "integral of the lobe over the plate", [=] { return probe_plan(alpha); }});
  }
}

}  // namespace luxodus::light

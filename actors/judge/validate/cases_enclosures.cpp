// Spheres and infinite plates against closed forms.
#include <cmath>
#include <numbers>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "runtime/core/check.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/primitives.hpp"

namespace luxodus::light {

namespace {

Mesh sphere_mesh(double radius, double sagitta) {
  auto shape = shapes::sphere(radius, sagitta);
  LUX_CHECK(shape.ok(), "no sphere");
  return std::move(shape.value().mesh);
}

/// In a closed surface of uniform reflectance the flux does not depend on the shape.
PreparedCase sphere_plan(double reflectance, double irradiance) {
  PreparedCase plan;
  add_mesh(plan.scene, "sphere", sphere_mesh(1, 1e-3), add_grey(plan.scene, reflectance));
  add_point(plan.scene, {0.3, 0.2, -0.4}, 1);
  plan.quick_particles = reflectance > 0.9 ? 1 << 14 : 1 << 16;
  plan.add("mean irradiance", irradiance,
           [](const Traced& run) { return run.into("sphere") * (1 / (4 * pi)); });
  plan.quantities.back().unit = 1 / (4 * pi);
  plan.add_closed();
  return plan;
}

/// Each reflection adds one and the same irradiance everywhere: seen by probes in three places.
PreparedCase indirect_plan(double reflectance, double irradiance) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const Mesh mesh = sphere_mesh(1, 2.5e-4);
  add_mesh(scene, "sphere", mesh, add_grey(scene, reflectance));
  add_point(scene, {0.3, 0.2, -0.4}, 1);
  for (size_t t = 0; t < mesh.triangles.size(); t += mesh.triangles.size() / 3) {
    const glm::uvec3 c = mesh.triangles[t];
    const auto& p = mesh.positions;
    ProbeMeasure probe;
    probe.name = "probe " + std::to_string(t);
    probe.position = (p[c[0]] + p[c[1]] + p[c[2]]) / 3.0;
    probe.normal = -glm::normalize(glm::cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]));
    scene.probes.push_back(probe);
  }
  const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
  scene.run.eye_path_factor = 10;
  plan.quick_particles = reflectance > 0.9 ? 1 << 11 : 1 << 13;
  // Facets deviate from the sphere by up to 0.025 %, and points of a facet do not see each other.
  constexpr double of_facets = 1.5e-3;
  for (uint32_t p = 0; p < scene.probes.size(); ++p) {
    plan.add(
        "indirect irradiance at probe " + std::to_string(p), irradiance,
        [p, lm_per_w](const Traced& run) {
          return run.value(run.blocks().probes, p) * (1 / lm_per_w);
        },
        of_facets);
    plan.quantities.back().unit = irradiance;
  }
  return plan;
}

PreparedCase port_plan(double reflectance, double share, double exact_share) {
  PreparedCase plan;
  const Mesh closed = sphere_mesh(1, 5e-4);
  Mesh open = closed;
  std::erase_if(open.triangles, [&](const glm::uvec3& t) {
    return (open.positions[t[0]].z + open.positions[t[1]].z + open.positions[t[2]].z) / 3 >
           1 - 2 * share;
  });
  // Whole facets are cut out, so the port's share is that of this mesh, for which the law holds.
  const double cut = 1 - area_of(open) / area_of(closed);
  add_mesh(plan.scene, "sphere", open, add_grey(plan.scene, reflectance));
  add_point(plan.scene, {0, 0, 0}, 1);
  plan.sums.push_back(every_side());
  const double through = cut / (1 - reflectance * (1 - cut));
  plan.compute("through the port, of the mesh", exact_share, through, 2e-2);
  constexpr double of_facets = 2e-3;  // bias from solid angle and area of the cut
  plan.add(
      "through the port", through, [](const Traced& run) { return run.sum(0); }, of_facets);
  return plan;
}

PreparedCase concentric_plan(const std::string& p, double inside, double outside) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const double r1 = parameter(p, "r1"), r2 = parameter(p, "r2");
  // Meshed alike, so that the ratio of their areas is exact.
  add_mesh(scene, "outer", sphere_mesh(r2, 1e-3 * r2), add_grey(scene, parameter(p, "rho2")));
  const int material = add_grey(scene, parameter(p, "rho1"));
  Emitter& e = add_emitter(scene, EmitterShape::mesh, {0, 0, 0}, {0, 0, -1}, 1);
  e.mesh = sphere_mesh(r1, 1e-3 * r1);
  e.body_material = scene.materials[static_cast<size_t>(material)].name;
  const std::string body = e.name + " body";
  constexpr double of_facets = 2e-4;
  plan.add(
      "absorbed outside", outside, [](const Traced& run) { return run.absorbed_by("outer"); },
      of_facets * inside);
  plan.add(
      "absorbed inside", inside, [body](const Traced& run) { return run.absorbed_by(body); },
      of_facets);
  return plan;
}

/// Two unit squares that face each other between perfect mirrors, which makes them infinite plates.
/// The lower one emits 1.
PreparedCase plates_plan(const std::string& p) {
  constexpr double distance = 0.5;
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  add_mirror_walls(scene, {0, 0, 0}, {1, 1, distance});
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, distance});
  add_quad(scene, "plate 1", faces[4].corner, faces[4].u, faces[4].v,
           add_grey(scene, parameter(p, "r1")));
  add_quad(scene, "plate 2", faces[5].corner, faces[5].u, faces[5].v,
           add_grey(scene, parameter(p, "r2")));
  add_face_emitter(scene, faces[4], 1);
  plan.quick_particles = 1 << 16;
  return plan;
}

/// Combines rows of two names in the same order.
template <class Make>
void for_each_pair(const std::string& first, const std::string& second, const Make& make) {
  const std::vector<Row> a = rows_where(exact_table, "id", first),
                         b = rows_where(exact_table, "id", second);
  LUX_CHECK(a.size() == b.size(), "rows of one parameter each");
  for (size_t i = 0; i < a.size(); ++i)
    make(a[i].text("parameters"), a[i].number("value"), b[i].number("value"));
}

void add_plates(Cases& cases) {
  constexpr double off_the_plate = 3e-5;  // the source stands 0.01 mm above it
  for_each_pair("parallel_plates_E2", "parallel_plates_E1",
                [&](const std::string& p, double second, double first) {
                  cases.push_back(
                      {"plates", "plates " + p, exact_table, [=] {
                         PreparedCase plan = plates_plan(p);
                         plan.add(
                             "flux into plate 2", second,
                             [](const Traced& run) { return run.into("plate 2"); }, off_the_plate);
                         plan.add(
                             "flux into plate 1", first,
                             [](const Traced& run) { return run.into("plate 1"); }, off_the_plate);
                         return plan;
                       }});
                });
  for_each_pair(
      "parallel_plates_gas_E2", "parallel_plates_gas_abs",
      [&](const std::string& p, double second, double absorbed) {
        cases.push_back(
            {"plates", "plates and gas " + p, exact_table, [=] {
               PreparedCase plan = plates_plan(p);
               add_homogeneous(plan.scene, smoke(parameter(p, "tau") / 0.5, 0));
               plan.add(
                   "absorbed by the gas", absorbed,
                   [](const Traced& run) { return run.absorbed_by_medium(0); }, 2 * off_the_plate);
               plan.add(
                   "flux into plate 2", second,
                   [](const Traced& run) { return run.into("plate 2"); }, 2 * off_the_plate);
               return plan;
             }});
      });
}

}  // namespace

void add_enclosure_cases(Cases& cases) {
  const auto add = [&](const std::string& id, const std::string& name, const auto& plan) {
    for (const Row& row : rows_where(exact_table, "id", id)) {
      const std::string p = row.text("parameters");
      const double value = row.number("value");
      cases.push_back({"sphere", name + " " + p, exact_table, [=] { return plan(p, value); }});
    }
  };
  add("sphere_integrating", "integrating sphere",
      [](const std::string& p, double value) { return sphere_plan(parameter(p, "rho"), value); });
  add("sphere_integrating_indirect", "probes in a sphere",
      [](const std::string& p, double value) { return indirect_plan(parameter(p, "rho"), value); });
  add("sphere_port_exit", "sphere with a port", [](const std::string& p, double value) {
    return port_plan(parameter(p, "rho"), parameter(p, "f"), value);
  });
  for_each_pair("concentric_absorbed_inner", "concentric_absorbed_outer",
                [&](const std::string& p, double inside, double outside) {
                  cases.push_back({"sphere", "concentric spheres " + p, exact_table,
                                   [=] { return concentric_plan(p, inside, outside); }});
                });
  add_plates(cases);
}

}  // namespace luxodus::light

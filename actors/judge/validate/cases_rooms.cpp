// Room lighting by closed forms, in the manner of CIE 171:2006: flux of a point source on a
// rectangle (5.2), conservation through an opening (5.4), reflection by a diffuse surface (5.6) and
// with an obstruction (5.7), the mean of all reflections (5.8), and a mirror.
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

/// Configuration factors between unit squares of a cube, opposite and adjacent.
constexpr double to_opposite = 0.199824895698387, to_adjacent = 0.200043776075403;

/// Solid angle of the rectangle [0, a] x [0, b] from a distance h above its corner.
double corner_angle(double a, double b, double h) {
  return std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
}

/// Solid angle of [x0, x1] x [y0, y1] from a distance h above the origin.
double solid_angle(double x0, double x1, double y0, double y1, double h) {
  return corner_angle(x1, y1, h) - corner_angle(x0, y1, h) - corner_angle(x1, y0, h) +
         corner_angle(x0, y0, h);
}

void add_floor(SceneDescription& scene, const std::string& name, double x0, double x1, double y0,
               double y1, double z, double reflectance = 0) {
  add_quad(scene, name, {x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0},
           add_grey(scene, reflectance));
}

Estimate into_floor(const Traced& run) {
  return run.into("floor");
}

PreparedCase point_over_rectangle() {
  PreparedCase plan;
  add_point(plan.scene, {0, 0, 3}, 1);
  add_floor(plan.scene, "floor", -1, 4, -2, 1.5, 0);
  plan.add("flux", solid_angle(-1, 4, -2, 1.5, 3) / (4 * pi), into_floor);
  return plan;
}

/// A square sheet hides the middle of the floor from a point source.
PreparedCase point_behind_sheet() {
  PreparedCase plan;
  add_point(plan.scene, {0, 0, 3}, 1);
  add_floor(plan.scene, "floor", -2, 2, -2, 2, 0);
  add_floor(plan.scene, "sheet", -0.5, 0.4, -0.3, 0.6, 2);
  const double hidden = solid_angle(-0.5, 0.4, -0.3, 0.6, 1) / (4 * pi);
  plan.add("flux on the floor", solid_angle(-2, 2, -2, 2, 3) / (4 * pi) - hidden, into_floor);
  plan.add("flux on the sheet", hidden, [](const Traced& run) { return run.into("sheet"); });
  return plan;
}

/// A sheet hides one half of an area lamp from a point on its plane of symmetry.
PreparedCase half_hidden_lamp() {
  const auto lamp = [](bool sheet) {
    SceneDescription scene;
    Emitter& e = add_rectangle(scene, {0, 0, 2}, {0, 0, -1}, 1, 1, 0);
    e.radiometric = false;
    e.mains_flux = 1000;
    add_floor(scene, "floor", -3, 3, -3, 3, 0);
    if (sheet) add_floor(scene, "sheet", 0, 2, -2, 2, 1);
    return lit(std::move(scene));
  };
  PreparedCase plan;
  const double whole_lux = lamp(false)->direct_lx({0, 0, 0}, {0, 0, 1});
  plan.compute_direct("E behind the sheet", 0.5 * whole_lux, lamp(true), {0, 0, 0}, {0, 0, 1},
                      1e-6);
  return plan;
}

/// A lamp as large as the opening of a black box, one edge above it: the walls receive what passes
/// the opening.
PreparedCase opening() {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const int black = add_grey(scene, 0);
  const std::vector<BoxFace> faces = faces_of_box({0, 0, -1}, {1, 1, 0});
  SurfaceGroupMeasure inside;
  inside.name = "inside";
  for (size_t f = 0; f < 5; ++f) {
    add_quad(scene, faces[f].name, faces[f].corner, faces[f].u, faces[f].v, black);
    inside.objects.push_back(faces[f].name);
  }
  scene.surface_groups.push_back(inside);
  // Outside, the walls are black as well: they receive nothing from a lamp directly above.
  add_rectangle(scene, {0.5, 0.5, 1}, {0, 0, -1}, 1, 1, 1);
  CountingPlaneMeasure plane;
  plane.name = "opening";
  plane.corner = {0, 0, 0.0};
  plane.edge_u = {0, 1, 0};
  plane.edge_v = {1, 0, 0};
  scene.counting_planes.push_back(plane);
  constexpr double of_the_rim = 2e-5;  // light on the walls' upper edges from outside
  plan.add("through the opening", to_opposite,
           [](const Traced& run) { return run.watts(run.blocks().counting, 0, 0); });
  plan.add(
      "into the box", to_opposite, [](const Traced& run) { return run.into_group(0); }, of_the_rim);
  return plan;
}

/// A beam covers one wall of a black cube; the wall reflects it diffusely.
PreparedCase diffuse_wall() {
  constexpr double reflectance = 0.6;
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const int black = add_grey(scene, 0), grey = add_grey(scene, reflectance);
  const std::vector<BoxFace> faces = faces_of_box({0, 0, 0}, {1, 1, 1});
  for (const BoxFace& f : faces)
    add_quad(scene, f.name, f.corner, f.u, f.v, f.name == "x0" ? grey : black);
  add_face_emitter(scene, faces[1], 1).distribution = Distribution::collimated;
  constexpr double off_the_wall = 2e-5;
  plan.add(
      "on the opposite wall", reflectance * to_opposite,
      [](const Traced& run) { return run.into("x1"); }, off_the_wall);
  for (const std::string side : {"y0", "y1", "z0", "z1"})
    plan.add(
        "on wall " + side, reflectance * to_adjacent,
        [side](const Traced& run) { return run.into(side); }, off_the_wall);
  plan.add_closed();
  return plan;
}

/// CIE 171, 5.8: 10 klm in the middle of a room of 4 m; the mean is exact for any closed room.
PreparedCase mean_of_reflections(double reflectance) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const int wall = add_grey(scene, reflectance);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {4, 4, 4}))
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
  Emitter& lamp = add_point(scene, {2, 2, 2}, 0);
  lamp.radiometric = false;
  lamp.mains_flux = 10000;
  const double lm_per_w = efficacy_lm_per_w(lamp.spectrum);
  plan.sums.push_back({&TallyBlocks::surfaces, {0, 1, 2, 3, 4, 5}});
  plan.quick_particles = 1 << 16;
  constexpr double area = 96;
  if (reflectance > 0) {
    plan.add("mean E", 10000 / (area * (1 - reflectance)),
             [lm_per_w](const Traced& run) { return run.sum(0) * (lm_per_w / area); })
        .unit = 10000 / area;
  }
  plan.add("E on the floor", 10000 / (area * (1 - reflectance)),
           [lm_per_w](const Traced& run) { return run.into("z0") * (lm_per_w / 16); })
      .unit = 10000 / area;
  plan.add_closed();
  return plan;
}

/// Each emitter sends its own share.
PreparedCase unequal_beams() {
  PreparedCase plan;
  plan.quick_particles = 1 << 16;
  constexpr double watts[] = {1, 2, 5};
  for (int i = 0; i < 3; ++i) {
    const std::string name = "floor " + std::to_string(i);
    add_floor(plan.scene, name, 3 * i - 1, 3 * i + 1, -1, 1, 0);
    add_rectangle(plan.scene, {3 * i, 0, 1}, {0, 0, -1}, 1, 1, watts[i]).distribution =
        Distribution::collimated;
    plan.add("flux on " + name, watts[i], [name](const Traced& run) { return run.into(name); });
  }
  plan.add_closed();
  return plan;
}

/// A mirror wall shows the source a second time: E = direct + rho_s x that of the image.
PreparedCase mirror_wall() {
  constexpr double specular = 0.85;
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  add_point(scene, {1, 0, 2}, 1);
  add_floor(scene, "floor", 0, 3, -2, 2, 0);
  // High and wide enough for every ray from the image to the floor.
  add_quad(scene, "mirror", {0, -9, 0}, {0, 18, 0}, {0, 0, 9}, add_mirror(scene, specular));
  const double direct = solid_angle(-1, 2, -2, 2, 2), image = solid_angle(1, 4, -2, 2, 2);
  plan.add("flux", (direct + specular * image) / (4 * pi), into_floor);
  return plan;
}

}  // namespace

void add_room_lighting_cases(Cases& cases) {
  const auto add = [&](const std::string& name, const std::string& law, const auto& plan) {
    cases.push_back({"room", name, law, plan});
  };
  add("point source over a rectangle", "solid angle (CIE 171, 5.2)", point_over_rectangle);
  add("point source over a sheet and a floor", "solid angle (CIE 171, 5.7)", point_behind_sheet);
  add("area lamp half hidden by a sheet", "symmetry (CIE 171, 5.7)", half_hidden_lamp);
  add("lamp over an opening", "configuration factor (CIE 171, 5.4)", opening);
  add("diffuse wall under a beam", "configuration factors (CIE 171, 5.6)", diffuse_wall);
  for (const std::string reflectance : {"0", "0.3", "0.5", "0.8", "0.95"}) {
    add("cubic room, reflectance " + reflectance, "flux / (area (1 - rho)) (CIE 171, 5.8)",
        [reflectance] { return mean_of_reflections(std::stod(reflectance)); });
  }
  add("beams of 1, 2 and 5 W", "conservation", unequal_beams);
  add("mirror wall", "image source", mirror_wall);
}

}  // namespace luxodus::light

// Visibility in smoke: Smokeview's greys, Koschmieder's law, and the C of Jin's law V = C / K, for
// signs in uniformly lit smoke. Medium and sign are traced from the eye; the laws are used nowhere.
#include <fmt/format.h>

#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

// ---- Smokeview ---------------------------------------------------------------------------------

/// Verification Guide, "Verifying Smoke Transparency": soot of 7.922e-5 kg/m3 at 8700 m2/kg reduces
/// 255 to 128 in a metre.
constexpr double soot_extinction = 7.922e-5 * 8700;  // [1/m]
struct Grey {
  double distance_m;
  double published;
};
constexpr Grey greys[] = {{0.5, 181}, {1, 128}, {2, 64}, {3, 32}, {4, 16}, {5, 8}};

/// A beam through soot in cells with this edge, 6 m long.
PreparedCase grey_plan(double cell_m) {
  constexpr double length = 6;
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  add_speck(scene, {0, -1, -1});
  add_quad(scene, "end", {length, -3, -3}, {0, 6, 0}, {0, 0, 6}, add_grey(scene, 0));
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, 0.1, 0.1, 1).distribution = Distribution::collimated;
  add_cells(
      scene, {0, -3, -3}, glm::dvec3(length), static_cast<int>(length / cell_m),
      [](const glm::dvec3&) { return soot_extinction; }, 0.3, 0.6);
  for (uint32_t i = 0; i < std::size(greys); ++i) {
    CountingPlaneMeasure plane;
    plane.name = std::to_string(i);
    plane.corner = {greys[i].distance_m, -3, -3};
    plane.edge_u = {0, 6, 0};
    plane.edge_v = {0, 0, 6};
    scene.counting_planes.push_back(plane);
    const std::string where = fmt::format("grey at {} m", greys[i].distance_m);
    const double grey = 255 * std::pow(128.0 / 255, greys[i].distance_m);
    constexpr double of_the_density = 1e-4;  // from its four digits, over 5 m
    plan.add(
            where, grey,
            [i](const Traced& run) { return run.watts(run.blocks().counting, i, 0) * 255; },
            of_the_density)
        .unit = 255;
    // Published greys are integers.
    plan.compute(where + ", rounded", greys[i].published, grey, 0.5 / greys[i].published);
  }
  return plan;
}

// ---- evenly lit smoke --------------------------------------------------------------------------

constexpr double sight_extinction = 3;  // [1/m]
constexpr double far_sign_x = 4.8;

/// A sign of `luminance` that reflects nothing and is too small to light or shade the smoke in
/// front of it; smoke without absorption, between walls that all glow: everything receives `lux`,
/// from all sides, and the smoke's own luminance is J = lux / pi.
SceneDescription lit_smoke(double lux, double luminance, double distance, double g) {
  SceneDescription scene;
  scene.run.max_bands = 1;
  scene.run.voxels = false;
  constexpr double reflectance = 0.5;
  const int wall = add_grey(scene, reflectance);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {5, 1, 1})) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    const double flux = lux * (1 - reflectance) * glm::length(f.u) * glm::length(f.v);
    add_face_emitter(scene, f, flux).radiometric = false;
  }
  add_homogeneous(scene, smoke(sight_extinction, 1, g));
  add_tiny_sign(scene, {far_sign_x, 0.5, 0.5}, luminance);
  add_eye(scene, {far_sign_x - distance, 0.5, 0.5});
  return scene;
}

/// The sign's own light brightens the smoke directly in front of it, over a length of about its
/// edge: a share of the sign's light at the eye. Measured with an edge of 2 mm: 0.72 of this bound
/// with g = 0.6, 0.2 with g = 0.
constexpr double of_the_sign = sight_extinction * tiny_sign_m;

PreparedCase koschmieder_plan(double depth, double g) {
  constexpr double lux = 100, luminance = 100, horizon = lux / pi;
  PreparedCase plan;
  plan.scene = lit_smoke(lux, luminance, depth / sight_extinction, g);
  plan.look_rather(4);
  const double passed = std::exp(-depth);
  const auto add = [&](const std::string& name, double reference, EyeQuantity quantity) {
    plan.add(
            name, reference, [quantity](const Traced& run) { return first_view(run, quantity); },
            of_the_sign * luminance * passed / reference)
        .unit = reference;
  };
  add("luminance at the eye [cd/m2]", luminance * passed + horizon * (1 - passed),
      EyeQuantity::at_eye);
  add("luminance of the path [cd/m2]", horizon * (1 - passed), EyeQuantity::path);
  add("transmission", passed, EyeQuantity::transmission);
  // Deterministic; places are in single precision.
  plan.quantities.back().certain = true;
  plan.quantities.back().bias = 1e-5 * passed;
  return plan;
}

// ---- Jin ---------------------------------------------------------------------------------------

constexpr double threshold = 0.01;  // smallest visible contrast
constexpr double jin_cd_m2[] = {2, 10, 86, 100, 500, 2000};
/// C by illuminance in the smoke [lx] and luminance of the sign; signs darker than the smoke appear
/// dark on bright.
struct JinRow {
  double lux;
  double c[std::size(jin_cd_m2)];
};
constexpr JinRow jin_table[] = {{1, {6.27, 8.02, 10.20, 10.35, 11.96, 13.35}},
                                {10, {3.62, 5.37, 7.86, 8.02, 9.66, 11.05}},
                                {40, {4.43, 3.07, 6.36, 6.53, 8.25, 9.66}},
                                {80, {4.52, 4.11, 5.47, 5.68, 7.53, 8.96}},
                                {180, {4.57, 4.41, 3.91, 4.31, 6.65, 8.13}}};

/// The sign is viewed from the distance at which, by the table, its contrast is just visible; C
/// follows from the contrast at the eye.
PreparedCase jin_plan(double lux, double luminance, double c) {
  PreparedCase plan;
  plan.scene = lit_smoke(lux, luminance, c / sight_extinction, 0);
  plan.look_rather(8);
  const double smoke_cd_m2 = lux / pi;
  const double sign = luminance > smoke_cd_m2 ? 1 : -1;
  constexpr double digits = 0.005;  // digits of the table, in C
  plan.add(
          "luminance at the eye [cd/m2]", smoke_cd_m2 * (1 + sign * threshold),
          [](const Traced& run) { return first_view(run, EyeQuantity::at_eye); },
          threshold * (digits + of_the_sign))
      .unit = smoke_cd_m2;
  // dC = d ln(contrast): linear about the threshold, so that z stays normal.
  Quantity& measured = plan.add("C", c, [=](const Traced& run) {
    const Estimate eye = first_view(run, EyeQuantity::at_eye);
    const double contrast = sign * (eye.value / smoke_cd_m2 - 1);
    return Estimate{c + contrast / threshold - 1, eye.standard_error / (smoke_cd_m2 * threshold)};
  });
  measured.bias = digits + of_the_sign;
  measured.unit = c;
  // The only statistical error is in the veil, but the luminance of smoke in a uniform field is
  // known: the transmitted contrast of the sign gives C to the digits of the table.
  Quantity& passed = plan.add("C, of the contrast that is passed", c, [=](const Traced& run) {
    const double own = first_view(run, EyeQuantity::own).value;
    const double contrast =
        sign * (own / smoke_cd_m2 - 1) * first_view(run, EyeQuantity::transmission).value;
    return Estimate{c + std::log(contrast / threshold), 0};
  });
  passed.bias = digits;
  passed.certain = true;
  return plan;
}

}  // namespace

void add_sight_cases(Cases& cases) {
  for (const double cell_m : {0.125, 0.25, 0.5})
    cases.push_back({"sight", fmt::format("Smokeview's greys, cells of {} m", cell_m),
                     "Smokeview Verification Guide", [cell_m] { return grey_plan(cell_m); }});
  for (const double g : {0.0, 0.6}) {
    for (const double depth : {0.5, 1.0, 2.0, 5.0})
      cases.push_back({"sight", fmt::format("Koschmieder, optical depth {}, g {}", depth, g),
                       "B exp(-K V) + J (1 - exp(-K V))",
                       [=] { return koschmieder_plan(depth, g); }});
  }
  for (const JinRow& row : jin_table) {
    for (size_t i = 0; i < std::size(jin_cd_m2); ++i)
      cases.push_back({"sight", fmt::format("Jin's C, {} lx, {} cd/m2", row.lux, jin_cd_m2[i]),
                       "C = ln(|B - J| / (0.01 J)), J = E / pi",
                       [=] { return jin_plan(row.lux, jin_cd_m2[i], row.c[i]); }});
  }
}

}  // namespace luxodus::light

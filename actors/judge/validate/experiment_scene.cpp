// The eye is in the origin and looks along x. The target hangs just before the far wall.
#include "actors/judge/validate/experiment_scene.hpp"

#include <algorithm>
#include <cmath>

#include "actors/judge/validate/scene_kit.hpp"
#include "runtime/core/check.hpp"
#include "scenes/light/signs/sign_face.hpp"

namespace luxodus::light {

namespace {

/// From the eye to the near wall, and from the target to the far one [m].
constexpr double behind_eye_m = 0.03, behind_target_m = 0.005;
/// Edge of a face, in extents of the target: so much ground is around it.
constexpr double face_per_target = 2;
/// Texels along the edge of a drawn face.
constexpr int drawn_texels = 100;
/// Half width of light of one colour where it has fallen to 1/e [nm].
constexpr double line_width_nm = 6;
/// Landolt's ring in units of its gap.
constexpr double ring_outer = 2.5, ring_inner = 1.5, ring_half_gap = 0.5, ring_gaps = 5;
/// Lamps in two strips along the room, which shine on the ceiling: their width [m], and their
/// distance from it in heights of the room.
constexpr double strip_width_m = 0.1, strip_below_ceiling = 0.15;

double height_of(const ExperimentTarget& target) {
  return target.height_m > 0 ? target.height_m : target.width_m;
}

/// The colours of a target's face, and their places in it.
constexpr ColourIndex target_colour = 0, ground_colour = 1;

bool in_target(TargetShape shape, double x, double y, double half_width, double half_height) {
  if (std::abs(x) > half_width || std::abs(y) > half_height) return false;
  if (shape == TargetShape::rectangle) return true;
  if (shape == TargetShape::disc) return std::hypot(x, y) <= half_width;
  const double unit = half_width / ring_outer;
  const double r = std::hypot(x, y) / unit;
  const bool in_gap = x > 0 && std::abs(y) < ring_half_gap * unit;
  return r <= ring_outer && r >= ring_inner && !in_gap;
}

/// A face of drawn_texels along each edge, whose edges are face_per_target times the target's.
SignFace drawn_face(const ExperimentTarget& target) {
  SignFace face;
  face.width = face.height = drawn_texels;
  const double width = target.width_m, height = height_of(target);
  for (int row = 0; row < face.height; ++row) {
    const double y = ((row + 0.5) / face.height - 0.5) * face_per_target * height;
    for (int column = 0; column < face.width; ++column) {
      const double x = ((column + 0.5) / face.width - 0.5) * face_per_target * width;
      face.colour.push_back(in_target(target.shape, x, y, width / 2, height / 2) ? target_colour
                                                                                 : ground_colour);
    }
  }
  return face;
}

double detail_of(const ExperimentTarget& target) {
  if (target.detail_m > 0) return target.detail_m;
  switch (target.shape) {
    case TargetShape::disc:
      return target.width_m;
    case TargetShape::rectangle:
      return std::sqrt(target.width_m * height_of(target));
    case TargetShape::landolt_ring:
      return target.width_m / ring_gaps;
    case TargetShape::text:
      return target.stroke_m;
  }
  return 0;
}

/// A line of text with half a letter's height of ground around it.
void write_text(const ExperimentTarget& target, Sign& sign) {
  const double spacing = target.stroke_m;
  const auto lettering = lay_out_text(target.text, {target.width_m, target.stroke_m, spacing});
  LUX_CHECK(lettering.ok(), "the text of an experiment cannot be written");
  sign.width_m = lettering->width_m + target.width_m;
  sign.height_m = 2 * target.width_m;
  auto face =
      face_from_text(target.text, sign.width_m, sign.height_m, target.width_m, target.stroke_m,
                     spacing, target_colour, ground_colour, 4 * drawn_texels);
  LUX_CHECK(face.ok(), "the text of an experiment cannot be drawn");
  sign.face = std::move(face).value();
}

/// Light of nearly one wavelength [nm], as behind an interference filter; integral 1.
Spectrum line_shape(double wavelength_nm) {
  Spectrum out;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double away = (Spectrum::wavelength_nm(i) - wavelength_nm) / line_width_nm;
    out.value[static_cast<size_t>(i)] = std::exp(-away * away);
  }
  return out * (1 / out.integral());
}

Sign sign_of(const ExperimentTarget& target, double distance_m) {
  Sign sign;
  sign.name = "target";
  sign.frame.origin = {distance_m, 0, 0};
  sign.frame.axes = glm::dmat3(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0));
  if (target.shape == TargetShape::text) {
    write_text(target, sign);
  } else {
    sign.width_m = face_per_target * target.width_m;
    sign.height_m = face_per_target * height_of(target);
    sign.face = drawn_face(target);
  }
  sign.face.legend = target_colour;
  sign.face.ground = ground_colour;
  const glm::dvec2 luminances{target.luminance_cd_m2, target.ground_cd_m2};
  sign.colours = white_and_green(luminances, luminances);
  if (target.light_nm > 0)
    for (FaceColour& colour : sign.colours) colour.shape = line_shape(target.light_nm);
  sign.colours[target_colour].reflectance = Spectrum::constant(target.reflectance);
  sign.colours[ground_colour].reflectance = Spectrum::constant(target.ground_reflectance);
  sign.smallest_detail_m = detail_of(target);
  return sign;
}

/// The corners of the room.
struct Extent {
  glm::dvec3 low, high;
};
Extent extent_of(const ExperimentScene& scene) {
  const ExperimentRoom& room = scene.room;
  const double end = scene.distance_m + behind_target_m;
  const double before = std::max(0.0, room.length_m - scene.distance_m);
  return {{-before - behind_eye_m, -room.width_m / 2, -room.height_m / 2},
          {end, room.width_m / 2, room.height_m / 2}};
}

void add_room(SceneDescription& out, const ExperimentScene& scene) {
  const Extent extent = extent_of(scene);
  const int walls = add_grey(out, scene.room.walls), far_wall = add_grey(out, scene.room.far_wall);
  for (const BoxFace& face : faces_of_box(extent.low, extent.high))
    add_quad(out, face.name, face.corner, face.u, face.v, face.name == "x1" ? far_wall : walls);
}

void add_lamps(SceneDescription& out, const ExperimentScene& scene, double lumens) {
  const Extent extent = extent_of(scene);
  const glm::dvec3 middle = (extent.low + extent.high) / 2.0, size = extent.high - extent.low;
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec3 at(middle.x, side * (size.y / 2 - strip_width_m),
                        extent.high.z - strip_below_ceiling * size.z);
    add_rectangle(out, at, {0, 0, 1}, size.x - 2 * strip_width_m, strip_width_m, lumens / 2)
        .radiometric = false;
  }
}

void add_surroundings(SceneDescription& out, const ExperimentScene& scene) {
  if (scene.smoke.angstrom == 0) out.run.max_bands = 1;  // all is grey
  out.run.voxels = false;
  if (scene.room.width_m > 0)
    add_room(out, scene);
  else
    add_speck(out, {-1, 0, 0});
}

void add_smoke(SceneDescription& out, const ExperimentSmoke& medium) {
  if (!(medium.extinction > 0)) return;
  SmokeOptics optics = smoke(medium.extinction, medium.albedo, medium.g);
  optics.extinction.angstrom = medium.angstrom;
  add_homogeneous(out, optics);
}

}  // namespace

ExperimentScene set_to(const ExperimentScene& scene, Varied varied, double value) {
  ExperimentScene out = scene;
  switch (varied) {
    case Varied::extinction:
      out.smoke.extinction = value / scene.distance_m;
      break;
    case Varied::distance:
      out.distance_m = scene.smoke.extinction > 0 ? value / scene.smoke.extinction : value;
      break;
    case Varied::contrast:
      out.target.luminance_cd_m2 = scene.target.ground_cd_m2 * (1 + value);
      break;
    case Varied::nothing:
      break;
  }
  return out;
}

const char* quantity_of(const Trial& trial) {
  switch (trial.varied) {
    case Varied::extinction:
      return "optical depth";
    case Varied::distance:
      return trial.scene.smoke.extinction > 0 ? "optical depth" : "distance [m]";
    case Varied::contrast:
      return "contrast";
    case Varied::nothing:
      break;
  }
  return "visibility level";
}

SceneDescription description_of(const ExperimentScene& scene, double lamps_lm) {
  SceneDescription out;
  add_surroundings(out, scene);
  if (lamps_lm > 0) add_lamps(out, scene, lamps_lm);
  for (Emitter& lamp : out.emitters) lamp.emergency_flux = lamp.mains_flux;
  add_smoke(out, scene.smoke);
  out.signs.push_back(sign_of(scene.target, scene.distance_m));
  add_eye(out, {0, 0, 0});
  out.assessment.age_years = scene.age_years;
  out.assessment.luminance_before_cd_m2 = scene.before.luminance_cd_m2;
  out.assessment.irritant_smoke = false;
  return out;
}

Scenario scenario_of(const LightBefore& before) {
  Scenario out;
  if (!before.seconds_ago) return out;
  out.operation = Operation::emergency;
  out.says_seconds = true;
  out.seconds_after_failure = *before.seconds_ago;
  return out;
}

SceneDescription lamps_alone(const ExperimentScene& scene) {
  SceneDescription out;
  add_surroundings(out, scene);
  add_lamps(out, scene, experiment_lamps_lm);
  if (scene.lamps.in_smoke) add_smoke(out, scene.smoke);
  const Extent extent = extent_of(scene);
  ProbeMeasure probe;
  probe.name = "illuminance";
  probe.position = (extent.low + extent.high) / 2.0;
  if (scene.lamps.on_floor) probe.position.z = extent.low.z + behind_target_m;
  out.probes.push_back(probe);
  return out;
}

}  // namespace luxodus::light

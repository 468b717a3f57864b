// Builds scenes in a few lines, for comparisons of the tracer with independent numbers: in tests
// and in `luxodus validate`. They are grey and radiometric (one band, watts) unless said otherwise,
// so results are plain fluxes. A scene that cannot be built is a programmer's mistake and ends the
// program. Pure; any thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus::light {

/// A Lambertian grey; its index.
int add_grey(SceneDescription& scene, double reflectance);
int add_mirror(SceneDescription& scene, double specular);
int add_glass(SceneDescription& scene, double ior);

Object& add_mesh(SceneDescription& scene, const std::string& name, Mesh mesh, int material);
/// Front towards cross(u, v).
Object& add_quad(SceneDescription& scene, const std::string& name, const glm::dvec3& corner,
                 const glm::dvec3& u, const glm::dvec3& v, int material);
/// A black square of 1 mm at a place without relevant light, because a scene needs geometry.
void add_speck(SceneDescription& scene, const glm::dvec3& at);

/// An emitter of `flux_w` that aims along `direction`; local x is along +x if it aims up or down.
Emitter& add_emitter(SceneDescription& scene, EmitterShape shape, const glm::dvec3& origin,
                     const glm::dvec3& direction, double flux_w);
/// A Lambertian rectangle of extents (along local x, y).
Emitter& add_rectangle(SceneDescription& scene, const glm::dvec3& origin,
                       const glm::dvec3& direction, double size_x, double size_y, double flux_w);
Emitter& add_point(SceneDescription& scene, const glm::dvec3& origin, double flux_w);

SmokeOptics smoke(double sigma_t, double albedo, double g = 0);
Medium& add_homogeneous(SceneDescription& scene, const SmokeOptics& optics);
/// Layers from `z` up, each with its thickness and optics.
Medium& add_layers(SceneDescription& scene, double z, const std::vector<double>& thickness,
                   const std::vector<SmokeOptics>& optics);
Medium& add_ball(SceneDescription& scene, const glm::dvec3& centre, double radius,
                 const SmokeOptics& optics);
/// Cells over a box from `low`; extinction(x, y, z) at their centres, in local coordinates.
Medium& add_cells(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& extent, int n,
                  const std::function<double(const glm::dvec3&)>& extinction, double albedo,
                  double g = 0);

/// A white sign that faces -x and reflects nothing, too small to light or shade the medium in front
/// of it.
inline constexpr double tiny_sign_m = 1e-4;
void add_tiny_sign(SceneDescription& scene, const glm::dvec3& at, double luminance_cd_m2);
void add_eye(SceneDescription& scene, const glm::dvec3& at);

void add_layer_group(SceneDescription& scene, double z_low, double z_high);
void add_box_group(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high);
void add_shell_group(SceneDescription& scene, const glm::dvec3& centre, double inner, double outer);

/// The six faces of a box, in the order x0, x1, y0, y1, z0, z1.
struct BoxFace {
  std::string name;
  glm::dvec3 corner, u, v;  // inside is towards cross(u, v)
  glm::dvec3 inward;
};
std::vector<BoxFace> faces_of_box(const glm::dvec3& low, const glm::dvec3& high);
/// Perfect vertical mirrors around a box: horizontal layers between them become infinite.
void add_mirror_walls(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high);
/// A Lambertian rectangle that covers the face, `inset` [m] in front of it and within its edges, so
/// that it touches no wall.
Emitter& add_face_emitter(SceneDescription& scene, const BoxFace& face, double flux_w,
                          double inset = 1e-5);

}  // namespace luxodus::light

#include "actors/judge/validate/scene_kit.hpp"

#include "runtime/core/check.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus::light {

namespace {

int add_material(SceneDescription& scene, Material material) {
  material.name = "material " + std::to_string(scene.materials.size());
  scene.materials.push_back(std::move(material));
  return static_cast<int>(scene.materials.size()) - 1;
}

Medium& add_medium(SceneDescription& scene, MediumKind kind) {
  Medium m;
  m.name = "medium " + std::to_string(scene.media.size());
  m.kind = kind;
  scene.media.push_back(std::move(m));
  return scene.media.back();
}

void add_volume_group(SceneDescription& scene, VolumeGroupMeasure group) {
  group.name = "volume " + std::to_string(scene.volume_groups.size());
  scene.volume_groups.push_back(std::move(group));
}

}  // namespace

int add_grey(SceneDescription& scene, double reflectance) {
  Material m;
  m.reflectance = Spectrum::constant(reflectance);
  return add_material(scene, m);
}

int add_mirror(SceneDescription& scene, double specular) {
  Material m;
  m.kind = MaterialKind::mirror;
  m.reflectance = Spectrum::constant(0);
  m.specular = Spectrum::constant(specular);
  return add_material(scene, m);
}

int add_glass(SceneDescription& scene, double ior) {
  Material m;
  m.kind = MaterialKind::glass_pane;
  m.reflectance = Spectrum::constant(0);
  m.ior = ior;
  return add_material(scene, m);
}

Object& add_mesh(SceneDescription& scene, const std::string& name, Mesh mesh, int material) {
  Object o;
  o.name = name;
  o.mesh = std::move(mesh);
  o.material = o.back_material = material;
  scene.objects.push_back(std::move(o));
  return scene.objects.back();
}

Object& add_quad(SceneDescription& scene, const std::string& name, const glm::dvec3& corner,
                 const glm::dvec3& u, const glm::dvec3& v, int material) {
  auto shape = shapes::quad(corner, u, v);
  LUX_CHECK(shape.ok(), "this quad is none");
  return add_mesh(scene, name, std::move(shape.value().mesh), material);
}

void add_speck(SceneDescription& scene, const glm::dvec3& at) {
  add_quad(scene, "speck", at, {1e-3, 0, 0}, {0, 1e-3, 0}, add_grey(scene, 0));
}

Emitter& add_emitter(SceneDescription& scene, EmitterShape shape, const glm::dvec3& origin,
                     const glm::dvec3& direction, double flux_w) {
  Emitter e;
  e.name = "emitter " + std::to_string(scene.emitters.size());
  e.shape = shape;
  const auto frame = frame_aiming(origin, direction);
  LUX_CHECK(frame.ok(), "an emitter aims nowhere");
  e.frame = frame.value();
  e.radiometric = true;
  e.mains_flux = flux_w;
  scene.emitters.push_back(std::move(e));
  return scene.emitters.back();
}

Emitter& add_rectangle(SceneDescription& scene, const glm::dvec3& origin,
                       const glm::dvec3& direction, double size_x, double size_y, double flux_w) {
  Emitter& e = add_emitter(scene, EmitterShape::rectangle, origin, direction, flux_w);
  e.size = {size_x, size_y, 0};
  return e;
}

Emitter& add_point(SceneDescription& scene, const glm::dvec3& origin, double flux_w) {
  Emitter& e = add_emitter(scene, EmitterShape::point, origin, {0, 0, -1}, flux_w);
  e.distribution = Distribution::isotropic;
  return e;
}

SmokeOptics smoke(double sigma_t, double albedo, double g) {
  SmokeOptics o;
  o.extinction.sigma_t = sigma_t;
  o.albedo = Spectrum::constant(albedo);
  if (g != 0) {
    o.phase.kind = PhaseKind::henyey_greenstein;
    o.phase.g = g;
  }
  return o;
}

Medium& add_homogeneous(SceneDescription& scene, const SmokeOptics& optics) {
  Medium& m = add_medium(scene, MediumKind::homogeneous);
  m.optics = optics;
  return m;
}

Medium& add_layers(SceneDescription& scene, double z, const std::vector<double>& thickness,
                   const std::vector<SmokeOptics>& optics) {
  Medium& m = add_medium(scene, MediumKind::layered);
  for (size_t i = 0; i < thickness.size(); ++i) {
    m.layers.push_back({z, z + thickness[i], optics[i]});
    z += thickness[i];
  }
  return m;
}

Medium& add_ball(SceneDescription& scene, const glm::dvec3& centre, double radius,
                 const SmokeOptics& optics) {
  Medium& m = add_medium(scene, MediumKind::bounded);
  m.optics = optics;
  m.frame.origin = centre;
  m.quadric.a = glm::dmat3(1 / (radius * radius));
  m.quadric.c = -1;
  m.local_bounds = {glm::dvec3(-radius), glm::dvec3(radius)};
  return m;
}

Medium& add_cells(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& extent, int n,
                  const std::function<double(const glm::dvec3&)>& extinction, double albedo,
                  double g) {
  Medium& m = add_medium(scene, MediumKind::data_set);
  m.optics = smoke(1, albedo, g);
  m.frame.origin = low;
  m.data.nx = m.data.ny = m.data.nz = n;
  m.data.extent = extent;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const glm::dvec3 centre = (glm::dvec3(x, y, z) + 0.5) / static_cast<double>(n) * extent;
        m.data.extinction.push_back(static_cast<float>(extinction(centre)));
      }
    }
  }
  return m;
}

void add_tiny_sign(SceneDescription& scene, const glm::dvec3& at, double luminance_cd_m2) {
  Sign sign;
  sign.name = "sign";
  sign.frame.origin = at;
  sign.frame.axes = glm::dmat3(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0));
  sign.width_m = sign.height_m = sign.smallest_detail_m = tiny_sign_m;
  sign.face = {1, 1, {0}, {}};
  sign.colours = white_and_green({luminance_cd_m2, 0});
  for (FaceColour& colour : sign.colours) colour.reflectance = Spectrum::constant(0);
  scene.signs.push_back(sign);
}

void add_eye(SceneDescription& scene, const glm::dvec3& at) {
  Observer eye;
  eye.name = "eye";
  eye.eye = at;
  scene.observers.push_back(eye);
}

void add_layer_group(SceneDescription& scene, double z_low, double z_high) {
  VolumeGroupMeasure g;
  g.shape = VolumeGroupMeasure::Shape::layer;
  g.low.z = z_low;
  g.high.z = z_high;
  add_volume_group(scene, g);
}

void add_box_group(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high) {
  VolumeGroupMeasure g;
  g.low = low;
  g.high = high;
  add_volume_group(scene, g);
}

void add_shell_group(SceneDescription& scene, const glm::dvec3& centre, double inner,
                     double outer) {
  VolumeGroupMeasure g;
  g.shape = inner > 0 ? VolumeGroupMeasure::Shape::shell : VolumeGroupMeasure::Shape::sphere;
  g.centre = centre;
  g.radius = outer;
  g.inner_radius = inner;
  add_volume_group(scene, g);
}

std::vector<BoxFace> faces_of_box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  return {{"x0", low, y, z, {1, 0, 0}}, {"x1", low + x, z, y, {-1, 0, 0}},
          {"y0", low, z, x, {0, 1, 0}}, {"y1", low + y, x, z, {0, -1, 0}},
          {"z0", low, x, y, {0, 0, 1}}, {"z1", low + z, y, x, {0, 0, -1}}};
}

void add_mirror_walls(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high) {
  const std::vector<BoxFace> faces = faces_of_box(low, high);
  const int mirror = add_mirror(scene, 1);
  for (size_t f = 0; f < 4; ++f)
    add_quad(scene, faces[f].name, faces[f].corner, faces[f].u, faces[f].v, mirror);
}

Emitter& add_face_emitter(SceneDescription& scene, const BoxFace& face, double flux_w,
                          double inset) {
  const glm::dvec3 centre = face.corner + 0.5 * (face.u + face.v) + inset * face.inward;
  Emitter& e = add_rectangle(scene, centre, face.inward, 1, 1, flux_w);
  // The edge along which local x lies depends on the aim.
  const bool x_is_u = std::abs(glm::dot(e.frame.axes[0], face.u)) > 0.5 * glm::length(face.u);
  const double u = glm::length(face.u) - 2 * inset, v = glm::length(face.v) - 2 * inset;
  e.size = {x_is_u ? u : v, x_is_u ? v : u, 0};
  return e;
}

}  // namespace luxodus::light

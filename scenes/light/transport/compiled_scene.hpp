// Everything that the tracer needs: one scenario of a scene, in local coordinates, per band. The
// skeleton (surfaces, materials, emitters, media tables, detectors, tally layout) is small and
// always in memory; geometry cells, bricks and texels are scene parts, which the transport loop
// reads only through its resolver, as it does photometric webs. Immutable once compiled; any
// thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/intersect/embree_scene.hpp"
#include "scenes/light/optics/bands.hpp"
#include "scenes/light/optics/media_set.hpp"
#include "scenes/light/optics/phase_function.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/optics/surface.hpp"
#include "scenes/light/tally/layout.hpp"
#include "scenes/light/transport/sphere_set.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

inline constexpr uint32_t none_index = 0xFFFFFFFF;

/// One object's two sides.
struct CompiledSurface {
  std::string name;
  uint32_t material[2] = {0, 0};       // front, back
  uint32_t sign = none_index;          // the object is a face of this sign
  uint32_t body_emitter = none_index;  // the object is the body of this emitter
  int body = 0;                        // of Object and Emitter: light of that body passes
  uint32_t first_patch = 0;            // first of all its patches, both sides
  uint32_t patches = 0;
  double area_m2 = 0;  // one side
  bool one_patch = false;

  /// Area [m2] of one patch of one of its triangles.
  double patch_area_m2(const TriangleRecord& t) const {
    if (one_patch) return area_m2;
    const glm::dvec3 a(t.corner[0]);
    const glm::dvec3 u = glm::dvec3(t.corner[1]) - a, v = glm::dvec3(t.corner[2]) - a;
    return glm::length(glm::cross(u, v)) / 2 / (double(t.subdivision) * t.subdivision);
  }
};

struct CompiledMaterial {
  std::string name;
  MaterialKind kind = MaterialKind::lambertian;
  std::vector<SurfaceModel> by_band;
  uint32_t image = none_index;  // reflectance texture
};

enum class EmitterKind { point, rectangle, disc, sphere, tube, mesh, sign_face, volume };

struct CompiledEmitter {
  std::string name;
  EmitterKind kind = EmitterKind::point;
  Distribution distribution = Distribution::lambertian;
  Vec3 origin{0};  // local
  Mat3 axes{1.0_r};
  Vec3 size{0};
  Real exponent = 1;  // cosine power of the intensity; sign face: of its luminance
  SpotLobe spot;
  uint32_t web = none_index;
  uint32_t sign = none_index;
  uint32_t medium = none_index;  // volume
  int group = 0;
  int body = 0;  // surfaces of this body do not stop its own light; 0: none
  double area_m2 = 0;
  double luminous_flux_lm = 0;
  double wanted = 1;              // factor on its light when paths choose an emitter
  std::vector<double> power_w;    // per band
  std::vector<double> texel_cdf;  // sign face: by texel; mesh: by triangle; cumulative share
  int texel_columns = 0;          // sign face
  std::vector<Vec3> corners;      // mesh: three per triangle
};

/// A bounding sphere of an emitter.
struct EmitterBound {
  Vec3 centre{0};
  Real radius = 0;
};

/// Emitters with a surface that rays can hit. Their bounding spheres exclude most of them cheaply.
struct EmittersWithFaces {
  std::vector<uint32_t> emitters;
  SphereSet around;
};

/// Parallelogram of cells; flights cross it and are counted without being stopped.
struct CompiledPlane {
  Vec3 corner{0}, normal{0, 0, 1};
  Vec3 dual_u{1, 0, 0}, dual_v{0, 1, 0};  // (p - corner) . dual in [0, 1)
  int cells_u = 1, cells_v = 1;
  double cell_area_m2 = 1;
  uint32_t first_bin = 0;
};

/// A cheap test that most flights stay on one side of a plane.
struct PlaneTest {
  Vec3 normal{0, 0, 1};
  Real height = 0;  // height of the corner along the normal
};

struct CompiledVolumeGroup {
  VolumeGroupMeasure::Shape shape = VolumeGroupMeasure::Shape::box;
  Vec3 low{0}, high{0}, centre{0};
  Real radius = 0, inner_radius = 0;
};

struct VoxelGrid {
  glm::vec3 low{0};
  float edge = 0;  // 0: none
  int nx = 0, ny = 0, nz = 0;
  uint32_t count() const { return static_cast<uint32_t>(nx * ny * nz); }
};

/// The results whose error ends a run; see error_target.hpp.
struct ErrorTarget {
  std::vector<std::string> words;                 // as given by scene file or command line
  std::vector<uint32_t> planes, probes, targets;  // targets: of eyes
  std::vector<uint32_t> cells;  // planes whose cells count: by the 95th percentile
  bool surfaces = false;        // each surface that receives at least 1 % of the flux
  bool patches = false;         // by the 95th percentile

  bool asks_eyes() const { return !probes.empty() || !targets.empty(); }
  bool asks_bins() const { return !planes.empty() || !cells.empty() || surfaces || patches; }
};

/// Quantities of a voxel: fluence and net flux along x, y, z; then the same for light whose last
/// event was a collision, followed by its angular distribution: sums of products of the components
/// of its direction, xx, yy, xy, xz, yz (zz is the fluence less xx and yy).
inline constexpr uint32_t voxel_quantities = 13, first_scattered_quantity = 4;

/// Indices of the tally's blocks, by what they count. none_index if a scene has no such detector.
struct TallyBlocks {
  uint32_t patches = none_index;         // in, out
  uint32_t surfaces = none_index;        // in, out: one bin per object
  uint32_t surface_groups = none_index;  // in, out
  uint32_t voxels = none_index;          // see voxel_quantities (lengths)
  uint32_t voxel_power = none_index;     // absorbed, scattered
  uint32_t volume_length = none_index;   // track length per volume group
  uint32_t volume_power = none_index;    // absorbed, scattered per volume group
  uint32_t media_power = none_index;     // absorbed, scattered per medium
  uint32_t plane_cells = none_index;     // direct, indirect
  uint32_t planes = none_index;          // the whole plane: direct, indirect
  uint32_t counting = none_index;        // along the normal uncollided, collided; then against it
  uint32_t escape = none_index;          // six sides x-, x+, y-, y+, z-, z+
  uint32_t probes = none_index;          // from the probe: indirect illuminance, fluence (values)
  uint32_t probes_by_group =
      none_index;               // as above per (probe, source group), if there are several groups
  uint32_t views = none_index;  // from the eye: see EyeQuantity (values)
  uint32_t views_by_group = none_index;    // see GroupEyeQuantity; per (part, source group)
  uint32_t views_by_mixture = none_index;  // see MixtureEyeQuantity; per (part, mixture)
};

/// Features that the kernels of this scene must contain.
struct Features {
  MediaNeed media = MediaNeed::none;
  bool bands = false;      // more than one
  bool surfaces = false;   // anything other than plain Lambertian reflection
  bool bodies = false;     // an emitter has a body that its light passes
  bool detectors = false;  // planes, volume groups or voxels
};

/// Estimates along the rays to one part (legend and ground in the order of SignFace::parts,
/// surround) of a sign: mean luminances [cd/m2]
/// at the face (own, reflected), at the eye (face and path together), of the path alone, the
/// transmission, and the share of the part that no solid hides. Scored as values, see
/// eye_paths.hpp.
inline constexpr uint32_t eye_quantities = 6;
enum class EyeQuantity : uint32_t { own, reflected, at_eye, path, transmission, visible };

/// Contribution of one source group to these, if there are several.
inline constexpr uint32_t group_eye_quantities = 3;
enum class GroupEyeQuantity : uint32_t { reflected, at_eye, path };

/// Contribution of a mixture of source groups. A batch scores the sum itself, so that its error
/// over batches includes the correlation of the groups.
inline constexpr uint32_t mixture_eye_quantities = 2;
enum class MixtureEyeQuantity : uint32_t { reflected, at_eye };

/// A sign as seen by one observer: the unit of estimates from the eye.
struct EyeTarget {
  uint32_t observer = 0;
  uint32_t sign = 0;       // compiled face
  uint32_t first_bin = 0;  // in the views block: the face's two parts, surround
};

/// One colour of a face.
struct CompiledFaceColour {
  int group = 0;                 // source group of the light it emits
  double luminance_cd_m2 = 0;    // along the normal, in this scenario
  std::vector<double> radiance;  // [W/(m2 sr)] per band
  std::vector<Real> reflectance;
};

/// One face of a sign.
struct CompiledSign {
  uint32_t sign = 0;  // index in the description
  bool back = false;
  uint32_t surface = none_index;
  Frame frame;     // local origin kept in double
  Vec3 origin{0};  // local
  Mat3 axes{1.0_r};
  std::vector<CompiledFaceColour> colours;  // those of the sign
  std::array<ColourIndex, 2> parts{};       // SignFace::parts
};

struct Group {
  std::string name;
  std::vector<double> power_w;                     // cumulative, scaled to 2^64 - 1
  std::vector<double> band_share;                  // per band, the emitters that emit in it
  std::vector<uint64_t> band_cdf;                  // cumulative, of 2^64 - 1
  std::vector<std::vector<uint32_t>> emitters;     // per band, those that emit in it
  std::vector<std::vector<uint64_t>> emitter_cdf;  // per band, cumulative
  double luminous_flux_lm = 0;
};

struct CompiledScene {
  std::shared_ptr<const SceneDescription> description;
  Scenario scenario;
  glm::dvec3 local_origin{0};  // scene coordinates = local + origin
  Bounds bounds;               // scene coordinates
  Vec3 local_low{0}, local_high{0};
  Real diagonal_m = 1;
  Real min_offset_m = 0;        // offset of rays that leave surfaces: see offset_ray
  double length_unit_m = 1;     // one unit weight over this length is a path-length score of 1
  double scores_per_metre = 1;  // its inverse; both are powers of two, hence exact
  Bands bands{{spectrum_first_nm, spectrum_last_nm}, equal_energy_shape()};

  std::vector<CompiledSurface> surfaces;
  std::vector<CompiledMaterial> materials;
  std::vector<uint64_t> lambert_fraction;  // [(surface * 2 + side) * bands + band], units of 2^-32
  std::vector<CompiledEmitter> emitters;
  EmittersWithFaces emitters_with_faces;
  std::vector<Group> groups;
  std::vector<CompiledSign> signs;
  std::vector<std::shared_ptr<const PhotometricWeb>> webs;
  std::vector<std::shared_ptr<const Image>> images;  // of a packed scene: without texels
  std::vector<std::array<Real, 3>> image_basis;      // per band: response to r, g, b texels
  MediaSet media;
  std::vector<PhaseFunction> phases;  // by FreeFlight::phase
  std::vector<std::string> media_names;
  std::map<uint32_t, std::vector<glm::vec3>>
      volume_points;  // points of equal power, by emitting medium

  std::vector<CompiledPlane> planes;
  std::vector<CompiledPlane> counting_planes;
  std::vector<PlaneTest> plane_tests;  // of planes, then of counting planes
  Real plane_reach_m = 0;              // reach beyond a flight's end, see compile_detectors
  std::vector<CompiledVolumeGroup> volume_groups;
  VoxelGrid voxels;
  std::vector<EyeTarget> eye_targets;
  ErrorTarget error_target;
  std::vector<std::vector<uint32_t>> surface_groups;  // surfaces of each measured group

  Features features;
  TallyLayout layout;
  TallyBlocks blocks;
  std::vector<ProxyScene::Box> cell_boxes;  // one if merged
  std::vector<GeometryCell> cells;          // one per box; empty if the triangles are in a pack

  int64_t batch_particles = 0;
  std::vector<double> batch_shares;           // of each group [1]; empty: by BatchPlan's own rule
  std::vector<std::vector<double>> mixtures;  // for each, a factor per source group
  int eye_paths_per_batch = 0;                // per eye target part and per probe
  double light_quantum = 0;  // of a value of light (limits::value_quantum) [cd/m2, lx]
  uint64_t scene_hash = 0;   // of content, scenario, partition, seed
  uint64_t triangles = 0;
  uint32_t patch_count = 0;
  double total_area_m2 = 0;
  std::vector<Problem> warnings;
};

}  // namespace luxodus

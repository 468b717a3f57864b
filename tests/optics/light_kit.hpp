// What the tests of light share: scenes made in a few lines, runs with a fixed seed, reference
// tables, and the one comparison that counts: an estimate lies within its standard errors of a
// reference, and those are small. Scenes are grey and radiometric (one band, watts), so results are
// plain fluxes, and the same bits for any number of threads.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "actors/source/local_run.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::light {

// ---- scenes ------------------------------------------------------------------------------------

/// Reads a scene from the text of a scene file. Requires: no mistake in it.
SceneDescription scene_from_toml(const std::string& text);

/// A Lambertian grey; its index.
int add_grey(SceneDescription& scene, double reflectance);
int add_mirror(SceneDescription& scene, double specular);
int add_glass(SceneDescription& scene, double ior);

Object& add_mesh(SceneDescription& scene, const std::string& name, Mesh mesh, int material);
/// Front towards cross(u, v).
Object& add_quad(SceneDescription& scene, const std::string& name, const glm::dvec3& corner,
                 const glm::dvec3& u, const glm::dvec3& v, int material);
/// A black square of 1 mm at a place where no light matters: a scene has some geometry.
void add_speck(SceneDescription& scene, const glm::dvec3& at);

/// An emitter of `flux_w` that looks along `direction`; local x lies along +x where it looks up or
/// down.
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

void add_layer_group(SceneDescription& scene, double z_low, double z_high);
void add_box_group(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high);
void add_shell_group(SceneDescription& scene, const glm::dvec3& centre, double inner, double outer);

/// The six faces of a box, in the order x0, x1, y0, y1, z0, z1.
struct Face {
  std::string name;
  glm::dvec3 corner, u, v;  // inside is towards cross(u, v)
  glm::dvec3 inward;
};
std::vector<Face> faces_of_box(const glm::dvec3& low, const glm::dvec3& high);
/// Perfect mirrors upright around a box: whatever is level between them is infinite.
void add_mirror_walls(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high);
/// A Lambertian rectangle that covers the face, `inset` [m] in front of it and within its edges: it
/// touches no wall.
Emitter& add_face_emitter(SceneDescription& scene, const Face& face, double flux_w,
                          double inset = 1e-5);

// ---- runs --------------------------------------------------------------------------------------

/// Sanitizers are after memory and arithmetic, and a program under them is some ten times slower:
/// there runs have fewer particles by this factor, and errors may be larger by its root and a
/// quarter, since few batches know their own error less well.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int64_t thrift = 64;
inline constexpr double root_of_thrift = 10;
#else
inline constexpr int64_t thrift = 1;
inline constexpr double root_of_thrift = 1;
#endif

struct RunOptions {
  int64_t particles = 1 << 20;  // divided by `thrift`
  uint64_t seed = 1;
  int threads = 2;
  int cells = 1;
  int64_t batch_particles = 4096;
};

/// Bins of one block that are judged as one: equal by symmetry, or integrated over by the
/// reference. They are added batch by batch, like the tracer's own aggregates, so that the standard
/// error is that of the sum, however its parts are correlated.
struct BinSum {
  uint32_t TallyBlocks::*block;
  std::vector<uint32_t> bins;
};
/// All that leaves the scene.
BinSum every_side();

/// A scene compiled and traced. Checks that the ledger closes and that no history was lost.
class Run {
 public:
  explicit Run(SceneDescription scene, const RunOptions& options = {},
               const std::vector<BinSum>& sums = {});

  const CompiledScene& scene() const { return run_->scene(); }
  const TallyBlocks& blocks() const { return scene().blocks; }
  LocalRun& local() { return *run_; }
  const Ledger& ledger() const { return run_->totals().ledger(); }
  double emitted_w() const;

  Estimate watts(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// A plain value (probes).
  Estimate value(uint32_t block, uint32_t bin, uint32_t quantity = 0) const;
  /// Flux into, and absorbed by, the object of that name.
  Estimate into(const std::string& surface) const;
  Estimate absorbed_by(const std::string& surface) const;
  Estimate into_group(uint32_t surface_group) const;
  /// Escaped through sides of the bounding box: x-, x+, y-, y+, z-, z+.
  Estimate escaped(uint32_t side) const;
  Estimate track_length(uint32_t volume_group) const;
  Estimate absorbed_in(uint32_t volume_group) const;
  Estimate absorbed_by_medium(uint32_t medium) const;
  /// The BinSum of that number, in the unit of its bins.
  Estimate sum(uint32_t number, uint32_t quantity = 0) const;

 private:
  uint32_t surface_index(const std::string& name) const;
  std::unique_ptr<LocalRun> run_;
  std::vector<uint32_t> sum_blocks_;
};

std::shared_ptr<const CompiledScene> compile(SceneDescription scene, int cells = 1);

// ---- comparisons -------------------------------------------------------------------------------

inline constexpr double four_standard_errors = 4;
/// The relative standard error at which a comparison means something: four of them are 2 %.
inline constexpr double half_percent = 5e-3 * root_of_thrift;

/// How many particles make the relative standard error of a share of them half a percent, before
/// they are divided by `thrift`.
int64_t particles_for(double share);

/// The estimate is within `standard_errors` of the reference, plus what is known to be biased
/// (`slack`, in the reference's unit), and its standard error is at most `error_most` (in the
/// reference's unit).
void check_near(const Estimate& estimate, double reference, double error_most, double slack = 0,
                double standard_errors = four_standard_errors);
/// The same with the standard error bounded relative to the reference.
void check_within(const Estimate& estimate, double reference, double relative_error_most,
                  double relative_slack = 0, double standard_errors = four_standard_errors);
/// A mean of something of which each of `particles` brings `most` or less. Its standard error is at
/// most half a percent or, for what is too rare to be counted that well, what chance allows: the
/// variance of one particle is at most most * mean.
void check_share(const Estimate& estimate, double reference, int64_t particles, double most = 1,
                 double slack = 0);
/// Two independent estimates of one thing.
void check_agree(const Estimate& a, const Estimate& b, double relative_error_most,
                 double standard_errors = four_standard_errors);

// ---- reference tables --------------------------------------------------------------------------

/// One row of a table by the names of its columns.
class Row {
 public:
  explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  const std::string& text(const std::string& column) const;
  double number(const std::string& column) const;
  /// Numbers between semicolons.
  std::vector<double> numbers(const std::string& column) const;

 private:
  std::map<std::string, std::string> cells_;
};
std::vector<Row> reference_table(const std::string& file);
/// The value of a row of misc_exact.csv.
double exact(const std::string& id, const std::string& parameters);
/// The number after `key` in a text like "r1=0.5;r2=1".
double parameter(const std::string& text, const std::string& key);

}  // namespace luxodus::light

#include "tests/optics/light_kit.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scenes/format/scene_file.hpp"
#include "scenes/geometry/primitives.hpp"
#include "scenes/geometry/transform.hpp"

namespace luxodus::light {

// ---- scenes ------------------------------------------------------------------------------------

SceneDescription scene_from_toml(const std::string& text) {
  static int made = 0;
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("luxodus_light_" + std::to_string(::getpid()) + "_" + std::to_string(made++));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "scene.toml") << text;
  ReadScene read = read_scene(folder / "scene.toml");
  std::filesystem::remove_all(folder);
  for (const Problem& p : read.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(read.scene);
  return std::move(*read.scene);
}

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
  REQUIRE(shape.ok());
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
  REQUIRE(frame.ok());
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

std::vector<Face> faces_of_box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  return {{"x0", low, y, z, {1, 0, 0}}, {"x1", low + x, z, y, {-1, 0, 0}},
          {"y0", low, z, x, {0, 1, 0}}, {"y1", low + y, x, z, {0, -1, 0}},
          {"z0", low, x, y, {0, 0, 1}}, {"z1", low + z, y, x, {0, 0, -1}}};
}

void add_mirror_walls(SceneDescription& scene, const glm::dvec3& low, const glm::dvec3& high) {
  const std::vector<Face> faces = faces_of_box(low, high);
  const int mirror = add_mirror(scene, 1);
  for (size_t f = 0; f < 4; ++f)
    add_quad(scene, faces[f].name, faces[f].corner, faces[f].u, faces[f].v, mirror);
}

Emitter& add_face_emitter(SceneDescription& scene, const Face& face, double flux_w, double inset) {
  const glm::dvec3 centre = face.corner + 0.5 * (face.u + face.v) + inset * face.inward;
  Emitter& e = add_rectangle(scene, centre, face.inward, 1, 1, flux_w);
  // Along which edge local x lies depends on the aim.
  const bool x_is_u = std::abs(glm::dot(e.frame.axes[0], face.u)) > 0.5 * glm::length(face.u);
  const double u = glm::length(face.u) - 2 * inset, v = glm::length(face.v) - 2 * inset;
  e.size = {x_is_u ? u : v, x_is_u ? v : u, 0};
  return e;
}

// ---- runs --------------------------------------------------------------------------------------

BinSum every_side() {
  return {&TallyBlocks::escape, {0, 1, 2, 3, 4, 5}};
}

std::shared_ptr<const CompiledScene> compile(SceneDescription scene, int cells) {
  const auto description = std::make_shared<const SceneDescription>(std::move(scene));
  const auto scenario = find_scenario(*description, "");
  REQUIRE(scenario.ok());
  auto compiled = compile_scene(description, scenario.value(), {cells});
  if (!compiled.ok()) FAIL(compiled.problem().text());
  return compiled.value();
}

namespace {

/// The scene with one more block for each sum, and the blocks' numbers.
std::shared_ptr<const CompiledScene> with_sums(const CompiledScene& scene,
                                               const std::vector<BinSum>& sums,
                                               std::vector<uint32_t>& numbers) {
  const auto out = std::make_shared<CompiledScene>(scene);
  for (const BinSum& sum : sums) {
    const uint32_t from = scene.blocks.*sum.block;
    TallyBlock block = scene.layout.block(from);
    block.name = "sum";
    block.bins = 1;
    numbers.push_back(out->layout.add_block(std::move(block)));
    for (const uint32_t bin : sum.bins)
      out->layout.add_aggregate({from, bin, 1, numbers.back(), 0});
  }
  return out;
}

}  // namespace

Run::Run(SceneDescription scene, const RunOptions& options, const std::vector<BinSum>& sums) {
  // Fewer batches than 64 would not know their own error.
  const int64_t particles = options.particles / thrift;
  scene.run.batch_particles = std::min(options.batch_particles, particles / 64);
  auto compiled = compile(std::move(scene), options.cells);
  if (!sums.empty()) compiled = with_sums(*compiled, sums, sum_blocks_);
  run_ = std::make_unique<LocalRun>(std::move(compiled), options.seed, options.threads);
  StopRule stop;
  stop.particles = particles;
  const std::atomic<bool> interrupt{false};
  run_->run(stop, interrupt, [](const Progress&) {});
  REQUIRE(ledger().closes());
  REQUIRE(ledger().lost() == 0);
}

double Run::emitted_w() const {
  double sum = 0;
  for (const Group& g : scene().groups) {
    for (const double p : g.power_w) sum += p;
  }
  return sum;
}

Estimate Run::watts(uint32_t block, uint32_t bin, uint32_t quantity) const {
  REQUIRE(scene().bands.count() == 1);
  return Readout(scene(), run_->totals()).watts(block, bin, 0, quantity);
}

Estimate Run::value(uint32_t block, uint32_t bin, uint32_t quantity) const {
  return Readout(scene(), run_->totals()).value(block, bin, quantity);
}

uint32_t Run::surface_index(const std::string& name) const {
  for (uint32_t i = 0; i < scene().surfaces.size(); ++i) {
    if (scene().surfaces[i].name == name) return i;
  }
  FAIL("no surface " << name);
  return 0;
}

Estimate Run::into(const std::string& surface) const {
  return watts(blocks().surfaces, surface_index(surface), 0);
}
Estimate Run::absorbed_by(const std::string& surface) const {
  return watts(blocks().surfaces, surface_index(surface), 2);
}
Estimate Run::into_group(uint32_t group) const {
  return watts(blocks().surface_groups, group, 0);
}
Estimate Run::escaped(uint32_t side) const {
  return watts(blocks().escape, side);
}
Estimate Run::track_length(uint32_t group) const {
  return watts(blocks().volume_length, group);
}
Estimate Run::absorbed_in(uint32_t group) const {
  return watts(blocks().volume_power, group, 0);
}
Estimate Run::absorbed_by_medium(uint32_t medium) const {
  return watts(blocks().media_power, medium, 0);
}

Estimate Run::sum(uint32_t number, uint32_t quantity) const {
  const uint32_t block = sum_blocks_[number];
  return scene().layout.block(block).unit == ScoreUnit::value ? value(block, 0, quantity)
                                                              : watts(block, 0, quantity);
}

// ---- comparisons -------------------------------------------------------------------------------

int64_t particles_for(double share) {
  constexpr double wanted = half_percent / root_of_thrift;
  return static_cast<int64_t>(std::ceil(1 / (wanted * wanted * share)));
}

void check_near(const Estimate& estimate, double reference, double error_most, double slack,
                double standard_errors) {
  INFO("estimate " << estimate.value << " +- " << estimate.standard_error << ", reference "
                   << reference << ", z "
                   << (estimate.value - reference) / estimate.standard_error);
  CHECK(estimate.standard_error <= error_most);
  // Integer weights and single-precision reflectances: nothing is promised below 1e-6.
  const double rounding = 1e-6 * std::abs(reference);
  CHECK(std::abs(estimate.value - reference) <=
        standard_errors * estimate.standard_error + slack + rounding);
}

void check_within(const Estimate& estimate, double reference, double relative_error_most,
                  double relative_slack, double standard_errors) {
  const double size = std::abs(reference);
  check_near(estimate, reference, relative_error_most * size, relative_slack * size,
             standard_errors);
}

void check_share(const Estimate& estimate, double reference, int64_t particles, double most,
                 double slack) {
  const double traced = static_cast<double>(particles / thrift);
  // As if whole hits of `most` were counted. A run may well have four of their own standard
  // deviations more of them, and its standard error with them.
  const double hits = reference * traced / most;
  const double of_counting = most * std::sqrt(hits) / traced;
  const double largest = most * std::sqrt(hits + 4 * std::sqrt(hits)) / traced;
  // Few hits give a small mean and a small error together. There the error is at least that of hits
  // with the weight that roulette leaves, a quarter.
  Estimate judged = estimate;
  if (hits < 100) judged.standard_error = std::max(judged.standard_error, 0.5 * of_counting);
  constexpr double error_of_the_error = 1.2;
  check_near(judged, reference, std::max(half_percent * reference, error_of_the_error * largest),
             slack);
}

void check_agree(const Estimate& a, const Estimate& b, double relative_error_most,
                 double standard_errors) {
  const double error = std::hypot(a.standard_error, b.standard_error);
  INFO(a.value << " +- " << a.standard_error << " and " << b.value << " +- " << b.standard_error);
  CHECK(error <= relative_error_most * std::abs(b.value));
  CHECK(std::abs(a.value - b.value) <= standard_errors * error + 1e-6 * std::abs(b.value));
}

// ---- reference tables --------------------------------------------------------------------------

namespace {

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      out.emplace_back();
    } else if (c != '\r') {
      out.back() += c;
    }
  }
  return out;
}

}  // namespace

const std::string& Row::text(const std::string& column) const {
  const auto at = cells_.find(column);
  if (at == cells_.end()) FAIL("no column " << column);
  return at->second;
}

double Row::number(const std::string& column) const {
  return std::stod(text(column));
}

std::vector<double> Row::numbers(const std::string& column) const {
  std::vector<double> out;
  for (const std::string& word : split(text(column), ';')) out.push_back(std::stod(word));
  return out;
}

std::vector<Row> reference_table(const std::string& file) {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/tests/reference/" + file);
  REQUIRE(in);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = split(line, ',');
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    const std::vector<std::string> words = split(line, ',');
    REQUIRE(words.size() <= columns.size());
    std::map<std::string, std::string> cells;
    for (size_t i = 0; i < words.size(); ++i) cells[columns[i]] = words[i];
    rows.emplace_back(std::move(cells));
  }
  REQUIRE_FALSE(rows.empty());
  return rows;
}

double exact(const std::string& id, const std::string& parameters) {
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") == id && row.text("parameters") == parameters) return row.number("value");
  }
  FAIL("no exact value " << id << " " << parameters);
  return 0;
}

double parameter(const std::string& text, const std::string& key) {
  for (const std::string& word : split(text, ';')) {
    if (word.rfind(key + "=", 0) == 0) return std::stod(word.substr(key.size() + 1));
  }
  FAIL("no " << key << " in " << text);
  return 0;
}

}  // namespace luxodus::light

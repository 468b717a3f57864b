// Equal bits for any number of threads and any arrival of data; and what a partition may change:
// which of two triangles is hit on their common edge, and no result.
#include <cmath>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/transport/eye_paths.hpp"
#include "scenes/light/transport/kernels.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

std::shared_ptr<const PhotometricWeb> some_web() {
  std::vector<double> candela;
  for (int a = 0; a <= 8; ++a) {
    for (int p = 0; p <= 6; ++p) candela.push_back(p > 4 ? 0 : 100 + 30 * (a % 8) + 11 * p * p);
  }
  auto web = PhotometricWeb::make({0, 45, 90, 135, 180, 225, 270, 315, 360},
                                  {0, 30, 60, 90, 120, 150, 180}, candela, glm::dmat3(1.0));
  REQUIRE(web.ok());
  return std::make_shared<const PhotometricWeb>(std::move(web).value());
}

/// A room with something of everything: curved, mirroring, textured and transparent things, smoke
/// in cells that partly glows, a layer, a luminaire with a web, bands.
SceneDescription room_of_everything() {
  SceneDescription scene;
  scene.run.voxel_edge_m = 0.5;
  const int wall = add_grey(scene, 0.6);
  scene.materials.back().reflectance = reflectance_from_linear_srgb(0.7, 0.5, 0.3);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {4, 3, 2.5})) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall).patch_edge_m = 0.7;
  }
  const int picture = add_grey(scene, 0.9);
  auto image = std::make_shared<Image>();
  image->width = image->height = 8;
  image->channels = 3;
  for (int i = 0; i < 8 * 8 * 3; ++i) image->texels.push_back(static_cast<float>(i % 7) / 6.0f);
  scene.materials.back().reflectance_image = image;
  const auto poster = shapes::quad({0.01, 1, 1}, {0, 1, 0}, {0, 0, 1});
  add_mesh(scene, "poster", poster->mesh, picture);
  const auto ball = shapes::sphere(0.4, 0.01);
  Mesh moved = ball->mesh;
  for (glm::dvec3& p : moved.positions) p += glm::dvec3(1.2, 1.1, 0.8);
  add_mesh(scene, "ball", moved, add_grey(scene, 0.4));
  add_quad(scene, "pane", {2.5, 0.2, 0.1}, {0, 2.6, 0}, {0, 0, 2.2}, add_glass(scene, 1.52));
  add_quad(scene, "mirror", {3.9, 1, 0.5}, {0, 0, 1}, {0, 1, 0}, add_mirror(scene, 0.9));
  Emitter& e = add_emitter(scene, EmitterShape::disc, {2, 1.5, 2.45}, {0.1, 0, -1}, 20);
  e.size.x = 0.3;
  e.distribution = Distribution::web;
  e.web = some_web();
  e.spectrum = blackbody_shape(3000);
  add_layers(scene, 1.5, {1.0}, {smoke(0.6, 0.8, 0.7)});
  Medium& fire = add_cells(
      scene, {1.5, 0.5, 0.1}, {1.7, 1.6, 1.8}, 36,
      [](const glm::dvec3& p) { return 2 * std::abs(std::sin(3 * p.x) * std::cos(4 * p.z)); }, 0.5,
      0.3);
  for (size_t i = 0; i < fire.data.extinction.size(); ++i)
    fire.data.emission.push_back(i % 5 == 0 ? fire.data.extinction[i] : 0);
  fire.emission = MediumEmission{};
  fire.emission->power_w = 5;
  fire.emission->spectrum = blackbody_shape(1500);
  PlaneMeasure plane;
  plane.name = "plane";
  plane.corner = {0.5, 0.5, 0.85};
  plane.edge_u = {3, 0, 0};
  plane.edge_v = {0, 2, 0};
  plane.cells_u = 6;
  plane.cells_v = 4;
  scene.planes.push_back(plane);
  ProbeMeasure probe;
  probe.name = "probe";
  probe.position = {2, 1, 1};
  scene.probes.push_back(probe);
  scene.run.batch_particles = 2000;
  scene.run.eye_path_factor = 0.5;
  return scene;
}

void trace(LocalRun& run, int64_t particles) {
  StopRule stop;
  stop.particles = particles;
  const std::atomic<bool> interrupt{false};
  run.run(stop, interrupt, [](const Progress&) {});
  REQUIRE(run.totals().balance().closes());
  REQUIRE(run.totals().balance().lost() == 0);
}

/// Number of totals that differ in any bit.
int64_t differences(const Totals& a, const Totals& b) {
  REQUIRE(a.groups() == b.groups());
  int64_t count = 0;
  for (int g = 0; g < a.groups(); ++g) {
    REQUIRE(a.batches(g) == b.batches(g));
    const auto& x = a.state(g).totals;
    const auto& y = b.state(g).totals;
    REQUIRE(x.size() == y.size());
    for (size_t i = 0; i < x.size(); ++i)
      count += x[i].sum != y[i].sum || x[i].squares != y[i].squares;
  }
  return count;
}

void check_same_ledger(const EnergyBalance& a, const EnergyBalance& b) {
  CHECK(a.emitted == b.emitted);
  CHECK(a.roulette_gain == b.roulette_gain);
  CHECK(a.absorbed_surfaces == b.absorbed_surfaces);
  CHECK(a.absorbed_media == b.absorbed_media);
  CHECK(a.escaped == b.escaped);
  CHECK(a.roulette_loss == b.roulette_loss);
  CHECK(a.rays == b.rays);
  CHECK(a.hits == b.hits);
  CHECK(a.collisions == b.collisions);
}

/// Data that is evicted at random: a cell's search structure is destroyed and rebuilt from a copy
/// of the cell, and a brick, web or picture is copied anew. Earlier references become invalid, as
/// the rule of resolvers allows.
class MissingData {
 public:
  explicit MissingData(const CompiledScene& scene)
      : scene_(&scene), random_(5, RandomStream::test) {
    random_.start(0);
  }

  const Brick& brick(int medium, int index) {
    brick_ = std::make_unique<Brick>(scene_->media.brick(medium, index));
    return *brick_;
  }
  const PhotometricWeb& web(uint32_t i) {
    if (!web_ || missing(0.1f)) web_ = std::make_unique<PhotometricWeb>(*scene_->webs[i]);
    return *web_;
  }
  const float* texel(uint32_t i, int x, int y) {
    if (!image_ || missing(0.1f)) image_ = std::make_unique<Image>(*scene_->images[i]);
    return &image_->texels[static_cast<size_t>((y * image_->width + x) * image_->channels)];
  }

 protected:
  struct Copy {
    GeometryCell cell;
    std::unique_ptr<CellScene> search;
  };

  bool missing(float probability) { return random_.uniform() < probability; }

  const CellScene& cell(uint32_t i) {
    copies_.resize(scene_->cells.size());
    if (!copies_[i] || missing(0.001f)) {
      if (copies_[i]) {
        for (TriangleRecord& t : copies_[i]->cell.triangles) t = TriangleRecord{};
        ++rebuilt_;
      }
      auto copy = std::make_unique<Copy>();
      copy->cell = scene_->cells[i];
      copy->search = std::make_unique<CellScene>(device_, copy->cell);
      copies_[i] = std::move(copy);
    }
    return *copies_[i]->search;
  }

  const CompiledScene* scene_;

 private:
  Random random_;
  EmbreeDevice device_;
  std::vector<std::unique_ptr<Copy>> copies_;
  std::unique_ptr<Brick> brick_;
  std::unique_ptr<PhotometricWeb> web_;
  std::unique_ptr<Image> image_;
  int64_t rebuilt_ = 0;
};

class MissingMergedResolver : public MissingData {
 public:
  MissingMergedResolver(const CompiledScene& scene, const SceneIndex&) : MissingData(scene) {}
  Hit nearest(const Ray& ray) { return cell(0).nearest(ray); }
  bool occluded(const Ray& ray) { return cell(0).occluded(ray); }
};

class MissingPartitionResolver : public MissingData {
 public:
  MissingPartitionResolver(const CompiledScene& scene, const SceneIndex& index)
      : MissingData(scene), index_(&index) {}
  Hit nearest(const Ray& ray) {
    // A ray visits a cell at most once, so the copy that holds its nearest hit stays until the next
    // ray.
    return nearest_in_cells(index_->proxies(), ray, candidates_,
                            [this](const Candidate& c) { return &cell(c.cell); });
  }
  bool occluded(const Ray& ray) {
    return occluded_in_cells(index_->proxies(), ray, candidates_,
                             [this](const Candidate& c) { return &cell(c.cell); });
  }

 private:
  const SceneIndex* index_;
  std::vector<Candidate> candidates_;
};

using Everything = Kernel<MediaNeed::general, true, true, true>;

template <class Resolver>
void check_same_scores(const std::shared_ptr<const CompiledScene>& scene, int64_t batches) {
  REQUIRE(scene->features.media == MediaNeed::general);
  REQUIRE(scene->features.bands);
  REQUIRE(scene->features.surfaces);
  REQUIRE(scene->features.detectors);
  const EmbreeDevice device;
  const SceneIndex index(device, *scene);
  const auto resident = make_batch_tracer(*scene, GeometryAccess::resident(index), 3);
  Resolver forgetful(*scene, index);
  ParticleTracer<Everything, Resolver> particles(*scene, forgetful, 3);
  EyeScores<Resolver> eyes(*scene, forgetful, 3);
  for (int64_t batch = 0; batch < batches; ++batch) {
    BatchScores a, b;
    const uint64_t first = static_cast<uint64_t>(batch) * 2000;
    a.reset(scene->layout);
    resident->trace(0, first, 2000, a);
    for (uint32_t unit = 0; unit < resident->look_units(); ++unit) resident->look(batch, unit, a);
    b.reset(scene->layout);
    particles.trace_batch(0, first, 2000, b);
    for (uint32_t unit = eyes.units(); unit-- > 0;) eyes.score(batch, unit, b);
    CHECK(a.scores == b.scores);
    check_same_ledger(a.balance, b.balance);
  }
}

}  // namespace

TEST_CASE("one, two and three threads give the same bits") {
  for (const int cells : {1, 4, 9}) {
    INFO(cells << " cells");
    const auto scene = compile(room_of_everything(), cells);
    REQUIRE(scene->cells.size() == static_cast<size_t>(cells));
    LocalRun one(scene, 7, 1), two(scene, 7, 2), three(scene, 7, 3), again(scene, 7, 2);
    for (LocalRun* run : {&one, &two, &three, &again}) trace(*run, 20'000);
    for (LocalRun* run : {&two, &three, &again}) {
      CHECK(differences(one.totals(), run->totals()) == 0);
      check_same_ledger(one.totals().balance(), run->totals().balance());
    }
  }
}

TEST_CASE("another seed gives other bits") {
  const auto scene = compile(room_of_everything());
  LocalRun a(scene, 7, 1), b(scene, 8, 1);
  trace(a, 4000);
  trace(b, 4000);
  CHECK(differences(a.totals(), b.totals()) > 100);
}

TEST_CASE("a run that is stopped and resumed gives the bits of one that is not") {
  const auto scene = compile(room_of_everything());
  LocalRun whole(scene, 7, 2), parts(scene, 7, 2);
  trace(whole, 20'000);
  trace(parts, 6'000);
  trace(parts, 20'000);
  CHECK(differences(whole.totals(), parts.totals()) == 0);
}

TEST_CASE("a resolver whose data is evicted at random gives the same bits") {
  check_same_scores<MissingMergedResolver>(compile(room_of_everything()), 5);
}

TEST_CASE("a resolver whose data is evicted at random gives the same bits over many cells") {
  check_same_scores<MissingPartitionResolver>(compile(room_of_everything(), 9), 5);
}

TEST_CASE("a partition changes the triangle only for rays that hit an edge") {
  const auto merged = compile(room_of_everything());
  const EmbreeDevice device;
  const SceneIndex one(device, *merged);
  MergedResolver resident(*merged, one);
  Random random(3, RandomStream::test);
  for (const int cells : {4, 9}) {
    const auto scene = compile(room_of_everything(), cells);
    const SceneIndex many(device, *scene);
    PartitionResolver partition(*scene, many);
    constexpr int rays = 200'000;
    int other_triangle = 0, other_place = 0;
    for (int i = 0; i < rays; ++i) {
      random.start(static_cast<uint64_t>(i));
      Ray ray;
      const float x = random.uniform(), y = random.uniform(), z = random.uniform();
      ray.origin =
          glm::mix(merged->local_low, merged->local_high, glm::vec3(x, y, z) * 0.98f + 0.01f);
      const float u = random.uniform(), v = random.uniform();
      ray.direction = uniform_sphere(u, v);
      const Hit a = resident.nearest(ray), b = partition.nearest(ray);
      REQUIRE(a.found() == b.found());
      if (!a.found()) continue;
      other_triangle += a.triangle->global_triangle != b.triangle->global_triangle;
      other_place += std::abs(a.distance - b.distance) > 1e-5f * (1 + a.distance);
    }
    INFO(cells << " cells: " << other_triangle << " of " << rays << " rays met another triangle");
    CHECK(other_triangle < rays / 10'000);
    CHECK(other_place == 0);
  }
}

TEST_CASE("a partition gives equal light within standard errors") {
  const auto merged = compile(room_of_everything());
  const int64_t particles = 800'000 / thrift;
  LocalRun a(merged, 11, 2);
  trace(a, particles);
  for (const int cells : {4, 9}) {
    const auto scene = compile(room_of_everything(), cells);
    LocalRun b(scene, 12, 2);
    trace(b, particles);
    const Readout x(*merged, a.totals()), y(*scene, b.totals());
    for (uint32_t s = 0; s < merged->surfaces.size(); ++s) {
      INFO(cells << " cells, " << merged->surfaces[s].name);
      check_agree(x.lumens(merged->blocks.surfaces, s, 0), y.lumens(scene->blocks.surfaces, s, 0),
                  2 * half_percent);
    }
    check_agree(x.lumens(merged->blocks.planes, 0, 1), y.lumens(scene->blocks.planes, 0, 1),
                2 * half_percent);
  }
}

}  // namespace luxodus::light

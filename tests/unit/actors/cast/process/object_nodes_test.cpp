// Nodes that fetch all kinds of scene parts (cells, bricks of smoke, tiles of pictures) against the
// plain loop on the same partition: the same bits, also if nodes share what they have built, and if
// an object is lost for a while.
#include <spdlog/spdlog.h>

#include <array>
#include <catch2/catch.hpp>
#include <fstream>

#include "actors/cast/process/in_process.hpp"
#include "actors/cast/process/out_of_core_for.hpp"
#include "runtime/observe/metrics_text.hpp"
#include "scenes/formats/pack/scene_pack.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/scenes/formats/pack/burning_gallery.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<const CompiledScene> compiled(
    const std::shared_ptr<const SceneDescription>& description, int cells) {
  auto scene = compile_scene(description, find_scenario(*description, "smoky").value(), {cells});
  REQUIRE(scene.ok());
  return scene.value();
}

/// The gallery from its files, and from a pack with the same number of cells.
struct Gallery {
  explicit Gallery(int cells) : scene(compiled(gallery_in(folder.path()), cells)) {
    spdlog::set_level(spdlog::level::off);
    REQUIRE(write_pack(file, *scene, cells).ok());
    auto description = read_pack(file);
    REQUIRE(description.ok());
    packed = compiled(description.value(), 1);
  }

  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "gallery.luxpack";
  std::shared_ptr<const CompiledScene> scene, packed;
};

/// Room for two objects, or for one and a build.
size_t tight_budget(const CompiledScene& scene) {
  return 2 * SceneObjects(scene, std::array{NodeId{0}}, 1).largest_build_bytes() + 1;
}

StopRule particles(int64_t count) {
  StopRule stop;
  stop.particles = count;
  return stop;
}

void check_same_light(const LocalRun& a, const LocalRun& b) {
  CHECK(a.batches() == b.batches());
  CHECK(differences(a, b) == 0);
  CHECK(a.totals().balance().collisions == b.totals().balance().collisions);
}

std::unique_ptr<LocalRun> plain_run(const Gallery& gallery, int64_t count) {
  auto plain = std::make_unique<LocalRun>(gallery.scene, 5, 2);
  plain->run(particles(count), nobody, ignore);
  return plain;
}

std::unique_ptr<LocalRun> nowhere_resident(const std::shared_ptr<const CompiledScene>& scene,
                                           size_t object_bytes, bool sharing = true) {
  OutOfCoreConfig rows;
  rows.threads = 2;
  rows.fibers = 16;
  rows.object_bytes = 2 * object_bytes;
  rows.sharing = sharing;
  return std::make_unique<LocalRun>(scene, 5, 2,
                                    std::make_unique<OutOfCoreParallelFor>(scene, rows));
}

NodesOptions object_nodes_of(int nodes, size_t object_bytes) {
  NodesOptions options;
  options.nodes = nodes;
  options.fibers = 200;
  options.portion = 16;
  options.object_bytes = object_bytes;
  return options;
}

double shown(const Observation& seen, const std::string& name) {
  double sum = 0;
  for (const MetricSample& sample : parse_metrics(seen.page()))
    if (sample.name == name) sum += sample.value;
  return sum;
}

/// Inverts one byte of a file.
void flip(const fs::path& file, uint64_t at) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekg(static_cast<std::streamoff>(at));
  const auto byte = static_cast<char>(bytes.get());
  bytes.seekp(static_cast<std::streamoff>(at));
  bytes.put(static_cast<char>(byte ^ 0x20));
}

/// Offset of an object in its pack.
uint64_t offset_of(const Gallery& gallery, uint32_t object) {
  const PackedScene& packed = *gallery.packed->description->packed;
  return static_cast<uint64_t>(packed.file->object(object).data() - packed.file->object(0).data()) +
         128;
}

}  // namespace

TEST_CASE("smoke data and pictures fetched with room for two objects give the same bits",
          "[nodes][objects]") {
  for (const int cells : {1, 4}) {
    const Gallery gallery(cells);
    REQUIRE(gallery.packed->scene_hash == gallery.scene->scene_hash);
    const auto plain = plain_run(gallery, 12'000);
    for (const auto& [scene, sharing, profile] :
         {std::tuple(gallery.packed, true, 0.0), std::tuple(gallery.packed, false, 0.1),
          std::tuple(gallery.scene, true, 0.1)}) {
      INFO(cells << " cells, packed " << (scene == gallery.packed) << ", sharing " << sharing);
      NodesOptions options = object_nodes_of(2, tight_budget(*scene));
      options.sharing = sharing;
      options.profile_share = profile;
      const auto run = nowhere_resident(scene, options.object_bytes);
      NodesReport report;
      const auto ended = run_on_nodes(*run, options, particles(12'000), nobody, ignore, &report);
      INFO((ended.ok() ? "" : ended.problem().text()));
      REQUIRE(ended.ok());
      check_same_light(*plain, *run);
      CHECK(report.workers.evictions > 0);
      CHECK(report.workers.fetches > static_cast<uint64_t>(SceneParts(*scene).count()));
      CHECK(report.workers.largest_resident_bytes <= options.object_bytes);
      if (!sharing) CHECK(report.workers.builds_saved == 0);
    }
  }
}

TEST_CASE("nodes that share built objects build fewer, and give the same bits",
          "[nodes][objects]") {
  const Gallery gallery(4);
  const auto plain = plain_run(gallery, 40'000);
  const size_t plenty = 40 * tight_budget(*gallery.packed);
  NodesReport shared, apart;
  for (NodesReport* report : {&shared, &apart}) {
    NodesOptions options = object_nodes_of(4, plenty);
    options.sharing = report == &shared;
    const auto run = nowhere_resident(gallery.packed, plenty);
    REQUIRE(run_on_nodes(*run, options, particles(40'000), nobody, ignore, report).ok());
    check_same_light(*plain, *run);
    CHECK(report->workers.evictions == 0);
  }
  CHECK(apart.workers.builds_saved == 0);
  CHECK(shared.workers.builds_saved > 0);
  CHECK(shared.workers.builds < apart.workers.builds);
}

TEST_CASE("every built part serialises to the bytes from which it was built", "[nodes][objects]") {
  const Gallery gallery(4);
  const SceneObjects objects(*gallery.scene, std::array{NodeId{0}}, 1);
  PartBuilder builder(*gallery.scene, objects.parts());
  for (uint32_t i = 0; i < objects.places().size(); ++i) {
    INFO("object " << i);
    const auto built = builder.built(i, objects.bytes(i).bytes);
    REQUIRE(built.ok());
    CHECK(object_id_of(built.value()->wire_bytes().bytes) == objects.places()[i].id);
  }
}

TEST_CASE("a temporarily lost object spoils batches, which are traced again", "[nodes][objects]") {
  const Gallery gallery(4);
  const auto plain = plain_run(gallery, 12'000);
  const SceneParts parts(*gallery.packed);
  // A brick with flames, and a tile of the picture.
  for (const uint32_t object : {parts.of_brick(1, 0), parts.of_tile(0, 1)}) {
    INFO("object " << object);
    const uint64_t at = offset_of(gallery, object) + 2000;
    const auto seen = Observation::start({std::string("127.0.0.1"), uint16_t{0}, 0});
    REQUIRE(seen.ok());
    NodesOptions options = object_nodes_of(2, tight_budget(*gallery.packed));
    options.profile_share = 0;  // it would be rejected
    options.observation = seen.value().get();
    // Nodes begin with an intact pack; then it is damaged until a node has noticed.
    std::atomic<bool> begun{false}, lost{true};
    options.stop = [&] {  // on the workers' threads, between their turns
      if (!begun.exchange(true)) {
        flip(gallery.file, at);
        return false;
      }
      if (lost && shown(*seen.value(), "luxodus_batches_failed_total") > 0 && lost.exchange(false))
        flip(gallery.file, at);
      return false;
    };
    const auto run = nowhere_resident(gallery.packed, options.object_bytes);
    NodesReport report;
    REQUIRE(run_on_nodes(*run, options, particles(12'000), nobody, ignore, &report).ok());
    CHECK_FALSE(lost);
    CHECK(shown(*seen.value(), "luxodus_fetch_unobtainable_total") > 0);
    check_same_light(*plain, *run);
  }
}

TEST_CASE("direct light and pictures read bricks and tiles through a cache", "[nodes][objects]") {
  const Gallery gallery(4);
  const LocalRun resident(gallery.scene, 5, 2);
  constexpr int64_t rows = 24;
  const auto light = [](const LocalRun& run) {
    std::vector<double> out(2 * rows);
    run.rows().run(
        rows,
        [&](const GeometryAccess& access) -> ParallelFor::Worker {
          const std::shared_ptr<PictureTracer> eye =
              make_picture_tracer(run.scene(), access, 5, make_emitter_sight(run.scene()));
          return [&run, &out, access, eye](int64_t row) {
            const auto i = static_cast<size_t>(row);
            const auto at = static_cast<float>(row) / rows;
            out[i] =
                direct_light_at(run.scene(), access, {5 * at - 2.5f, 0.3f, -0.6f}, {0, 0, 1}, {})
                    .total_lx();
            const glm::vec3 towards = glm::normalize(glm::vec3(2 * at - 1, 2, 0.3f * at - 0.2f));
            for (uint32_t path = 0; path < 40; ++path) {
              eye->start(i * 40, 40, path);
              const Ray ray{{0, -1.5f, 0.1f}, towards};
              out[rows + i] += eye->radiance(ray, 0, nullptr, nullptr).front();
            }
          };
        },
        {});
    return out;
  };
  const std::vector<double> expected = light(resident);
  CHECK(expected[3] > 0);
  CHECK(expected[rows + 3] > 0);
  for (const bool sharing : {true, false})
    CHECK(light(*nowhere_resident(gallery.packed, tight_budget(*gallery.packed), sharing)) ==
          expected);
}

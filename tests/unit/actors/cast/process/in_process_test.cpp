// Runs on nodes of this process against the plain loop: the same bits on any nodes.
#include "actors/cast/process/in_process.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/parts/scene_objects.hpp"
#include "actors/cast/process/out_of_core_for.hpp"
#include "scenes/formats/pack/scene_pack.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/visibility.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

NodesOptions nodes_of(int nodes, size_t fibers) {
  NodesOptions options;
  options.nodes = nodes;
  options.fibers = fibers;
  return options;
}

void check_same_bits(const std::shared_ptr<const CompiledScene>& scene, const StopRule& stop,
                     const std::vector<NodesOptions>& cases) {
  spdlog::set_level(spdlog::level::err);
  LocalRun plain(scene, 1, 2);
  const StopReason reason = plain.run(stop, nobody, ignore);
  for (const NodesOptions& nodes : cases) {
    INFO(nodes.nodes << " nodes of " << nodes.fibers << " fibers");
    LocalRun run(scene, 1, 1);
    NodesReport report;
    const auto ended = run_on_nodes(run, nodes, stop, nobody, ignore, &report);
    REQUIRE(ended.ok());
    CHECK(ended.value() == reason);
    CHECK(run.batches() == plain.batches());
    CHECK(differences(plain, run) == 0);
    CHECK(report.flushes > 0);
  }
}

}  // namespace

TEST_CASE("1, 2, 8 and 32 nodes give the bits of the plain loop", "[nodes]") {
  StopRule stop;
  stop.particles = 200'000;
  check_same_bits(scene_of("smoke_tank", "", 1), stop,
                  {nodes_of(1, 1), nodes_of(2, 5), nodes_of(8, 1), nodes_of(32, 3)});
}

TEST_CASE("histories of thousands of rays in a near-white room give the bits of the plain loop",
          "[nodes]") {
  const auto grey = scene_of("empty_room", "", 1);
  auto white = std::make_shared<SceneDescription>(*grey->description);
  for (Material& material : white->materials) material.reflectance = Spectrum::constant(0.999);
  white->run.batch_particles = 64;
  const auto scene = compile_scene(white, grey->scenario, {1}).value();
  StopRule stop;
  stop.particles = 256;
  check_same_bits(scene, stop, {nodes_of(2, 1), nodes_of(2, 3)});
}

TEST_CASE("coordinators below the controller change no bit", "[nodes][levels]") {
  StopRule stop;
  stop.particles = 200'000;
  // with the default fan-out, and with 3 levels
  std::vector<NodesOptions> cases{nodes_of(64, 1), nodes_of(13, 3)};
  cases[1].fan_out = 3;
  check_same_bits(scene_of("smoke_tank", "", 1), stop, cases);
  stop.particles = 24'000;
  cases = {nodes_of(9, 2)};
  cases[0].fan_out = 3;
  cases[0].object_bytes = 4 << 20;  // coordinators hold parts, too
  check_same_bits(scene_of("office_floor", "smoke_emergency", 6), stop, cases);
}

TEST_CASE("by error, runs of two levels have the same rounds as runs of one", "[nodes][levels]") {
  StopRule stop;
  stop.relative_error = 0.02;
  std::vector<NodesOptions> cases{nodes_of(7, 1)};
  cases[0].fan_out = 3;
  check_same_bits(scene_of("smoke_tank", "", 1), stop, cases);
}

TEST_CASE("levels of coordinators together with shards of the totals are rejected",
          "[nodes][levels][shards]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  NodesOptions options = nodes_of(8, 1);
  options.fan_out = 3;
  options.tally_shards = 2;
  LocalRun run(scene, 1, 1);
  StopRule stop;
  stop.particles = 1000;
  const auto refused = run_on_nodes(run, options, stop, nobody, ignore);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("need one coordinator") != std::string::npos);
  options.tally_shards = 1;
  options.fan_out = 1;
  const auto alone = run_on_nodes(run, options, stop, nobody, ignore);
  REQUIRE_FALSE(alone.ok());
  CHECK(alone.problem().what.find("at least 2 nodes") != std::string::npos);
}

TEST_CASE("a partitioned scene with signs, probes and bands gives the same bits on nodes",
          "[nodes]") {
  StopRule stop;
  stop.particles = 24'000;
  check_same_bits(scene_of("office_floor", "smoke_emergency", 6), stop, {nodes_of(3, 7)});
}

TEST_CASE("sharded totals equal those of the plain loop", "[nodes][shards]") {
  StopRule stop;
  stop.particles = 100'000;
  std::vector<NodesOptions> cases{nodes_of(2, 3), nodes_of(3, 1), nodes_of(3, 1)};
  cases[0].tally_shards = 2;
  cases[1].tally_shards = 3;
  cases[2].tally_shards = 4;  // one for every worker
  cases[2].link_delay = milliseconds(5);
  check_same_bits(scene_of("smoke_tank", "", 1), stop, cases);
  stop.particles = 16'000;
  check_same_bits(scene_of("office_floor", "smoke_emergency", 6), stop, {cases[1]});
}

TEST_CASE("with shards a run by error has the same rounds, and continues where another ended",
          "[nodes][shards]") {
  NodesOptions shards = nodes_of(2, 2);
  shards.tally_shards = 3;
  StopRule stop;
  stop.relative_error = 0.02;
  const auto scene = scene_of("smoke_tank", "", 1);
  check_same_bits(scene, stop, {shards});
  StopRule half, all;
  half.particles = 50'000;
  all.particles = 100'000;
  LocalRun plain(scene, 1, 1);
  plain.run(all, nobody, ignore);
  LocalRun run(scene, 1, 1);
  REQUIRE(run_on_nodes(run, nodes_of(2, 1), half, nobody, ignore).ok());
  NodesReport report;
  REQUIRE(run_on_nodes(run, shards, all, nobody, ignore, &report).ok());
  CHECK(differences(plain, run) == 0);
  CHECK(report.shards.gathers == 1);
  CHECK(report.shards.decisions >= 2 * report.flushes);
}

TEST_CASE("a reader of sharded totals during a run sees whole flushes", "[nodes][shards]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("smoke_tank", "", 1);
  StopRule stop;
  stop.particles = 600'000;
  NodesOptions options = nodes_of(2, 1);
  options.tally_shards = 3;
  LocalRun run(scene, 1, 1);
  int looks = 0;
  bool due = true;  // at once: the whole run may end before its first progress report
  run.add_pause(
      &due, [&] { return due; },
      [&] {
        due = false;
        ++looks;
        CHECK(run.totals().balance().closes());
        // Absorption by patches is in all shards, the balance with the controller.
        Int128 absorbed = 0;
        const TallyBlock& patches = scene->layout.block(scene->blocks.patches);
        for (int64_t i = 0; i < int64_t{patches.bins} * patches.quantities; ++i) {
          for (int g = 0; g < run.totals().groups(); ++g) {
            const auto at = static_cast<size_t>(patches.first_total + i);
            const Int128 sum = run.totals().state(g).totals[at].sum;
            absorbed += i % 2 == 0 ? sum : -sum;
          }
        }
        CHECK(absorbed == run.totals().balance().absorbed_surfaces);
      });
  REQUIRE(run_on_nodes(run, options, stop, nobody, [&](const Progress&) { due = true; }).ok());
  run.remove_pause(&due);
  CHECK(looks > 0);
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  CHECK(differences(plain, run) == 0);
}

TEST_CASE("more shards than nodes are rejected", "[nodes][shards]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  for (const int shards : {0, 4}) {
    NodesOptions options = nodes_of(2, 1);
    options.tally_shards = shards;
    LocalRun run(scene, 1, 1);
    const auto ended = run_on_nodes(run, options, {}, nobody, ignore);
    REQUIRE_FALSE(ended.ok());
    CHECK(ended.problem().what.find("1 to 3 shards") != std::string::npos);
  }
}

TEST_CASE("nodes stop at the same round as the plain loop for an error", "[nodes]") {
  StopRule stop;
  stop.relative_error = 0.02;
  check_same_bits(scene_of("smoke_tank", "", 1), stop, {nodes_of(2, 2)});
}

TEST_CASE("a run on nodes continues where another ended, like a single run", "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("smoke_tank", "", 1);
  StopRule half, all;
  half.particles = 50'000;
  all.particles = 100'000;
  LocalRun plain(scene, 1, 1);
  plain.run(all, nobody, ignore);
  LocalRun run(scene, 1, 1);
  REQUIRE(run_on_nodes(run, nodes_of(2, 1), half, nobody, ignore).ok());
  REQUIRE(run_on_nodes(run, nodes_of(3, 1), all, nobody, ignore).ok());
  CHECK(differences(plain, run) == 0);
}

TEST_CASE("an interrupted run on nodes ends with whole batches and can be continued", "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("smoke_tank", "", 1);
  std::atomic<bool> interrupt{false};
  LocalRun run(scene, 1, 1);
  StopRule endless;
  endless.particles = int64_t{1} << 40;
  const auto ended = run_on_nodes(run, nodes_of(2, 1), endless, interrupt,
                                  [&](const Progress&) { interrupt = true; });
  REQUIRE(ended.ok());
  CHECK(ended.value() == StopReason::interrupted);
  REQUIRE(run.batches() > 0);
  StopRule stop;
  stop.particles = run.batches() * scene->batch_particles;
  LocalRun plain(scene, 1, 1);
  plain.run(stop, nobody, ignore);
  CHECK(differences(plain, run) == 0);
}

TEST_CASE(
    "nodes whose budget holds only a part of the cells fetch the others and give the same bits",
    "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  StopRule stop;
  stop.particles = 12'000;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  const uint64_t bytes = built_bytes_of(*scene);
  for (const auto& [nodes, replicas] : {std::pair(2, 1u), std::pair(5, 2u)}) {
    INFO(nodes << " nodes, " << replicas << " holders of each cell");
    NodesOptions options = nodes_of(nodes, 40);
    options.object_bytes = bytes / 8;
    options.replicas = replicas;
    LocalRun run(scene, 1, 1);
    NodesReport report;
    REQUIRE(run_on_nodes(run, options, stop, nobody, ignore, &report).ok());
    CHECK(differences(plain, run) == 0);
    CHECK(report.workers.evictions > 0);
    CHECK(report.workers.fetches > scene->cells.size());
    CHECK(report.workers.joined > 0);
    CHECK(report.workers.largest_resident_bytes <= options.object_bytes);
  }
}

TEST_CASE("nodes with a twentieth of the scene each, without sharing, give the same bits",
          "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("office_floor", "smoke_emergency", 256);
  StopRule stop;
  stop.particles = 4096;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  NodesOptions options = nodes_of(2, 256);
  options.object_bytes = built_bytes_of(*scene) / 20;
  options.sharing = false;
  options.profile_share = 0;
  LocalRun run(scene, 1, 1);
  NodesReport report;
  const auto ended = run_on_nodes(run, options, stop, nobody, ignore, &report);
  INFO((ended.ok() ? "" : ended.problem().text()));
  REQUIRE(ended.ok());
  CHECK(differences(plain, run) == 0);
  CHECK(report.workers.evictions > scene->cells.size());
  CHECK(report.workers.builds_saved == 0);
  CHECK(report.workers.largest_resident_bytes <= options.object_bytes);
}

TEST_CASE("with a profile and without one, pinned or not, nodes give the same bits", "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  StopRule stop;
  stop.particles = 8192;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  const uint64_t bytes = built_bytes_of(*scene);
  struct Case {
    double profile_share, pinned_share;
    uint32_t replicas;
  };
  for (const Case& c : {Case{0, 0, 1}, Case{0.2, 0, 2}, Case{0.2, 0.5, 1}}) {
    INFO("profile of " << c.profile_share << ", pinned " << c.pinned_share);
    NodesOptions options = nodes_of(3, 16);
    options.object_bytes = bytes / 4;
    options.profile_share = c.profile_share;
    options.pinned_share = c.pinned_share;
    options.replicas = c.replicas;
    LocalRun run(scene, 1, 1);
    NodesReport report;
    REQUIRE(run_on_nodes(run, options, stop, nobody, ignore, &report).ok());
    CHECK(differences(plain, run) == 0);
    CHECK(report.residency.has_value() == (c.profile_share > 0));
    CHECK(report.by_node.size() == 3);
    CHECK((report.workers.pinned_bytes > 0) == (c.pinned_share > 0));
    CHECK(report.workers.largest_resident_bytes <= options.object_bytes);
    if (!report.residency) continue;
    CHECK(report.residency->expected_hit_rate > 0.5);
    CHECK(residency_table(*report.residency, report.by_node).size() == 5);
  }
}

TEST_CASE("a delay on all links changes no bit", "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  StopRule stop;
  stop.particles = 4096;
  LocalRun plain(scene, 1, 1);
  plain.run(stop, nobody, ignore);
  NodesOptions options = nodes_of(2, 300);
  options.object_bytes = built_bytes_of(*scene) / 4;
  options.link_delay = microseconds(300);
  LocalRun run(scene, 1, 1);
  NodesReport report;
  REQUIRE(run_on_nodes(run, options, stop, nobody, ignore, &report).ok());
  CHECK(differences(plain, run) == 0);
  CHECK(report.workers.fetches > 0);
}

TEST_CASE("a budget without a partition, or more holders than nodes, is rejected", "[nodes]") {
  StopRule stop;
  stop.particles = 1;
  NodesOptions options = nodes_of(2, 1);
  options.object_bytes = 1 << 20;
  LocalRun merged(scene_of("smoke_tank", "", 1), 1, 1);
  CHECK_FALSE(run_on_nodes(merged, options, stop, nobody, ignore).ok());
  options.replicas = 3;
  LocalRun cells(scene_of("smoke_tank", "", 4), 1, 1);
  CHECK_FALSE(run_on_nodes(cells, options, stop, nobody, ignore).ok());
}

TEST_CASE("nodes of a packed scene that no node holds whole give the bits of the plain loop",
          "[nodes]") {
  const auto scene = scene_of("office_floor", "smoke_emergency", 64);
  const test::TemporaryFolder folder;
  const auto file = folder / "floor.luxpack";
  REQUIRE(write_pack(file, *scene, 64).ok());
  const auto description = read_pack(file).value();
  const auto packed = compile_scene(description, scene->scenario, {}).value();
  StopRule stop;
  stop.particles = 16'000;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  OutOfCoreConfig rows;
  rows.object_bytes = 400'000;
  rows.threads = 2;
  LocalRun run(packed, 1, 2, std::make_unique<OutOfCoreParallelFor>(packed, rows));
  CHECK_FALSE(run.resident());
  NodesOptions nodes = nodes_of(3, 64);
  nodes.object_bytes = 400'000;
  NodesReport report;
  REQUIRE(run_on_nodes(run, nodes, stop, nobody, ignore, &report).ok());
  CHECK(differences(plain, run) == 0);
  CHECK(report.workers.fetches > 0);
  CHECK(report.workers.evictions > 0);
  // Computations on the result use the same geometry, on fibers.
  const auto direct = [](const LocalRun& of) {
    std::vector<double> out(40);
    of.rows().run(40, [&](const GeometryAccess& access) {
      return [&, access](int64_t i) {
        const glm::vec3 at(0.7 * static_cast<double>(i - 20), 1, -0.6);
        out[static_cast<size_t>(i)] =
            direct_light_at(of.scene(), access, at, {0, 0, 1}, {}).total_lx();
      };
    });
    return out;
  };
  CHECK(direct(plain) == direct(run));
}

TEST_CASE("a pack damaged during its use is reported by file and part", "[nodes]") {
  const auto scene = scene_of("office_floor", "clear_emergency", 16);
  const test::TemporaryFolder folder;
  const auto file = folder / "floor.luxpack";
  REQUIRE(write_pack(file, *scene, 16).ok());
  const auto packed = compile_scene(read_pack(file).value(), scene->scenario, {}).value();
  REQUIRE(check_objects(*packed).ok());
  const auto& objects = packed->description->packed->objects;
  REQUIRE(objects.size() >= 16);
  const std::array holders{NodeId{0}};
  CHECK(SceneObjects(*packed, holders, 1).stored_name(3) == "scene part 3 of " + file.string());
  {
    // In place, as by a failing disk: eight parts, after the header of 128 bytes.
    std::fstream pack(file, std::ios::in | std::ios::out | std::ios::binary);
    size_t end = 128;
    for (size_t part = 0; part < 8; ++part) end += objects[part].wire_bytes;
    for (size_t at = 128; at < end; at += 1024) {
      pack.seekp(static_cast<std::streamoff>(at));
      pack.write("damaged", 7);
    }
    REQUIRE(pack.good());
  }
  OutOfCoreConfig rows;
  rows.object_bytes = 4'000'000;
  LocalRun run(packed, 1, 1, std::make_unique<OutOfCoreParallelFor>(packed, rows));
  std::string told;
  try {
    run.rows().run(2000, [&](const GeometryAccess& access) {
      return [&run, access](int64_t i) {
        const double angle = 0.7 * static_cast<double>(i);
        const glm::vec3 way(std::cos(angle), std::sin(angle), 0);
        const glm::vec3 from(0.7 * static_cast<double>(i % 40 - 20), static_cast<double>(i % 7),
                             -0.6);
        next_surface(run.scene(), access, from, way, 100);
      };
    });
  } catch (const std::runtime_error& e) {
    told = e.what();
  }
  INFO(told);
  CHECK(told.find(file.string() + ": scene part ") == 0);
  CHECK(told.find("is damaged: pack the scene again, or copy the pack again") != std::string::npos);
}

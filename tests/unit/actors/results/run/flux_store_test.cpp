// Forged flux files: the checksums are correct, but a count is not.
#include "actors/results/run/flux_store.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/formats/json_out.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;
using json = luxodus::Json;  // in the order of the file

namespace {

void trace(LocalRun& run, int64_t batches) {
  StopRule stop;
  stop.particles = batches * run.scene().batch_particles;
  run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
}

}  // namespace

TEST_CASE("a flux file with a forged header is rejected, and counts no batch twice",
          "[flux][hostile]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  const test::TemporaryFolder folder;
  const auto file = folder / "forged.lux";
  LocalRun first(scene, 1, 1);
  trace(first, 4);
  REQUIRE(save_flux(file, first).ok());
  const FluxFile whole = read_flux_file(file).value();
  const auto refused = [&](const std::function<void(json&)>& change) {
    FluxFile forged = whole;
    json header = json::parse(whole.header_json);
    change(header);
    forged.header_json = header.dump();
    REQUIRE(write_flux_file(file, forged).ok());
    LocalRun second(scene, 1, 1);
    const auto loaded = load_flux(file, second);
    if (loaded.ok()) return std::string();
    CHECK(loaded.problem().where.file == file.string());
    CHECK(second.traced() == 0);
    return loaded.problem().what;
  };
  CHECK(refused([](json&) {}).empty());
  for (const json& count : {json("4"), json(-1), json(1.5), json(nullptr), json::array(),
                            json(uint64_t{1} << 63), json(int64_t{1} << 60)}) {
    INFO(count.dump());
    CHECK(refused([&](json& h) { h["batches"] = count; }).find("how many batches") !=
          std::string::npos);
    CHECK(refused([&](json& h) { h["groups"][0]["batches"] = count; }).find("source group 0") !=
          std::string::npos);
  }
  // The batches from the third on would be traced and counted twice.
  CHECK(refused([](json& h) { h["batches"] = 2; }).find("source group") != std::string::npos);
  CHECK(refused([](json& h) {
          h["batches"] = 2;
          h["groups"][0]["batches"] = 2;
        }).find("particles") != std::string::npos);
  CHECK(refused([](json& h) { h["missing"] = json{1}; }).find("source group") != std::string::npos);
  CHECK(refused([](json& h) { h["missing"] = 7; }).find("no list") != std::string::npos);
  CHECK(refused([](json& h) { h["missing"] = json{"x"}; }).find("ascending") != std::string::npos);
  CHECK(refused([](json& h) { h["groups"] = 7; }).find("source groups") != std::string::npos);
  CHECK(refused([](json& h) { h.erase("groups"); }).find("source groups") != std::string::npos);
  CHECK(refused([](json& h) { h["layout"] = "x"; }).find("another layout") != std::string::npos);
}

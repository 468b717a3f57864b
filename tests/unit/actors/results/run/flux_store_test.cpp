// Forged flux files: the checksums are correct, but a count is not.
#include "actors/results/run/flux_store.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/formats/json_out.hpp"
#include "scenes/light/transport/value_scores.hpp"
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

TEST_CASE("flux counted in other quanta of light is rejected, and that of older files goes on",
          "[flux]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  auto description = std::make_shared<SceneDescription>(*scene->description);
  for (Emitter& e : description->emitters) e.mains_flux *= 1e9;
  const auto bright = compile_scene(description, scene->scenario, {1}).value();
  REQUIRE(scene->light_quantum == limits::value_quantum);
  REQUIRE(bright->light_quantum > limits::value_quantum);
  const auto problem_with = [](FluxFile file, const auto& of,
                               const std::function<void(json&)>& change) {
    json header = json::parse(file.header_json);
    change(header);
    file.header_json = header.dump();
    LocalRun run(of, 1, 1);
    const auto taken = take_flux(file, {"flux", 0}, run);
    return taken.ok() ? std::string() : taken.problem().what;
  };
  const auto traced = [](const auto& of) {
    LocalRun run(of, 1, 1);
    trace(run, 2);
    return flux_of(run);
  };
  const FluxFile usual = traced(scene), large = traced(bright);
  // Older files do not state the quantum.
  CHECK_FALSE(json::parse(usual.header_json).contains("light_quantum"));
  CHECK(problem_with(usual, scene, [](json&) {}).empty());
  CHECK(problem_with(large, bright, [](json&) {}).empty());
  const std::string other = "another quantum";
  CHECK(problem_with(large, bright, [](json& h) { h.erase("light_quantum"); }).find(other) !=
        std::string::npos);
  for (const json& quantum : {json(0x1p-30), json("x"), json(nullptr)}) {
    INFO(quantum.dump());
    CHECK(problem_with(usual, scene, [&](json& h) { h["light_quantum"] = quantum; }).find(other) !=
          std::string::npos);
  }
}

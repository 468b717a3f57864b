// The trace of a run: valid JSON, spans that end and nest, waits of sampled particles only, and
// unchanged results.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "actors/cast/process/in_process.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

constexpr uint64_t every = 500;

std::shared_ptr<const CompiledScene> office() {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/office_floor.toml");
  REQUIRE(read.scene);
  auto description = std::make_shared<SceneDescription>(*read.scene);
  description->run.batch_particles = 4096;
  auto compiled =
      compile_scene(description, find_scenario(*description, "smoke_emergency").value(), {64});
  REQUIRE(compiled.ok());
  return compiled.value();
}

struct Span {
  std::string name;
  double begin = 0;
};

/// The open spans of one id on one node; the innermost must end first.
using Open = std::map<std::pair<int, std::string>, std::vector<Span>>;

/// Checks nesting, and counts the spans of each name.
std::map<std::string, int> check_spans(const nlohmann::json& events) {
  Open open;
  std::map<std::string, int> ended;
  for (const auto& event : events) {
    const std::string phase = event.at("ph");
    if (phase == "M") continue;
    const std::string id = event.at("id2").at("global");
    const std::string name = event.at("name");
    auto& spans = open[{event.at("pid").get<int>(), id}];
    if (phase == "b") {
      const uint64_t number = std::stoull(id, nullptr, 16);
      if (name == "particle") CHECK(number % every == 0);
      if (name == "wait") {
        CHECK(number % every == 0);
        REQUIRE(!spans.empty());  // its particle is being traced
        CHECK(spans.back().name == "particle");
      }
      spans.push_back({name, event.at("ts")});
      continue;
    }
    REQUIRE(phase == "e");
    REQUIRE(!spans.empty());
    CHECK(spans.back().name == name);
    CHECK(spans.back().begin <= event.at("ts").get<double>());
    spans.pop_back();
    ++ended[name];
  }
  return ended;
}

}  // namespace

TEST_CASE("a run's trace nests, and has waits of sampled particles only", "[nodes][trace]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = office();
  const test::TemporaryFolder folder;
  ObserveOptions observe;
  observe.trace_every = every;
  const auto seen = Observation::start(observe);
  REQUIRE(seen.ok());
  NodesOptions options;
  options.nodes = 2;
  options.fibers = 20;
  options.object_bytes = built_bytes_of(*scene) / 8;
  options.observation = seen.value().get();
  StopRule stop;
  stop.particles = 12'000;
  const std::atomic<bool> nobody{false};
  const auto ignore = [](const Progress&) {};
  LocalRun run(scene, 1, 1);
  REQUIRE(run_on_nodes(run, options, stop, nobody, ignore).ok());
  REQUIRE(seen.value()->write_trace(folder / "trace.json").ok());

  const auto bytes = read_whole_file(folder / "trace.json", 1 << 26);
  REQUIRE(bytes.ok());
  const auto* text = reinterpret_cast<const char*>(bytes.value().data());
  const auto trace = nlohmann::json::parse(text, text + bytes.value().size());
  auto ended = check_spans(trace.at("traceEvents"));
  CHECK(ended["particle"] >= 3 * 4096 / static_cast<int>(every));
  CHECK(ended["wait"] > 0);
  CHECK(ended["fetch"] > 0);
  CHECK(ended["build"] > 0);
  CHECK(ended["batch"] == 3);
  CHECK(ended["flush"] > 0);

  LocalRun plain(scene, 1, 1);
  plain.run(stop, nobody, ignore);
  const auto same = [](const Total& x, const Total& y) {
    return x.sum == y.sum && x.squares == y.squares;
  };
  for (int group = 0; group < run.totals().groups(); ++group) {
    const auto& a = plain.totals().state(group).totals;
    const auto& b = run.totals().state(group).totals;
    CHECK(std::equal(a.data(), a.data() + a.size(), b.data(), b.data() + b.size(), same));
  }
}

TEST_CASE("without sampling there is no trace and no file", "[nodes][trace]") {
  const test::TemporaryFolder folder;
  const auto seen = Observation::start({});
  REQUIRE(seen.ok());
  CHECK_FALSE(seen.value()->watches());
  CHECK(seen.value()->trace_of({0}) == nullptr);
  REQUIRE(seen.value()->write_trace(folder / "trace.json").ok());
  CHECK_FALSE(std::filesystem::exists(folder / "trace.json"));
}

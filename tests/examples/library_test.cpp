// The scenes that ship give the numbers beside them. scenes/library/NAME.expected.toml states the
// numbers of NAME.toml and their reasons; scenes/library/README.md describes its format. Every
// number of a run must be within four combined standard errors of the stated one.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "actors/results/files/run_results.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/document.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"

namespace fs = std::filesystem;

namespace luxodus {

namespace {

constexpr double standard_errors = 4;
constexpr int64_t batches = 16;  // enough for an honest standard error, few enough to be quick

const fs::path library = fs::path(LUX_SOURCE_DIR) / "scenes/library";

bool is_expectation(const fs::path& file) {
  return file.string().ends_with(".expected.toml");
}

std::set<std::string> shipped() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(library)) {
    const fs::path& file = entry.path();
    if (file.extension() == ".toml" && !is_expectation(file)) names.insert(file.stem().string());
  }
  return names;
}

SceneDescription described(const std::string& name) {
  ReadScene read = read_scene(library / (name + ".toml"));
  for (const Problem& p : read.problems.list()) FAIL_CHECK(p.text());
  REQUIRE(read.scene);
  return std::move(*read.scene);
}

std::shared_ptr<const CompiledScene> compiled(SceneDescription description,
                                              const std::string& scenario) {
  const auto shared = std::make_shared<const SceneDescription>(std::move(description));
  const auto chosen = find_scenario(*shared, scenario);
  REQUIRE(chosen.ok());
  auto scene = compile_scene(shared, chosen.value(), {});
  if (!scene.ok()) FAIL(scenario << ": " << scene.problem().what);
  return scene.value();
}

// ---- one run and its numbers ------------------------------------------------------------------

struct Number {
  double value = 0;
  double error = 0;  // standard error
};

/// "planes/floor/mean_illuminance": list items are found by name, those of signs by "SIGN from
/// OBSERVER".
const Json* member(const Json& in, const std::string& key) {
  if (in.is_object()) return in.contains(key) ? &in.at(key) : nullptr;
  for (const Json& item : in) {
    const std::string name =
        item.contains("observer")
            ? item["sign"].get<std::string>() + " from " + item["observer"].get<std::string>()
            : item["name"].get<std::string>();
    if (name == key) return &item;
  }
  return nullptr;
}

Number number_at(const Json& result, const std::string& path) {
  const Json* at = &result;
  std::istringstream words_of(path);
  for (std::string word; std::getline(words_of, word, '/');) {
    at = member(*at, word);
    if (!at) FAIL("a result has no '" << word << "' of '" << path << "'");
  }
  REQUIRE(at->contains("value"));
  REQUIRE(at->at("value").is_number());
  const bool measured = at->contains("standard_error") && at->at("standard_error").is_number();
  return {at->at("value").get<double>(), measured ? at->at("standard_error").get<double>() : 0};
}

/// Values with a unit that are not numbers, except contrasts and uniformities: ratios do not exist
/// in the dark.
void list_unknown(const Json& in, const std::string& path, std::vector<std::string>& out) {
  if (in.is_object() && in.contains("value") && in.contains("unit")) {
    if (!in["value"].is_number()) out.push_back(path);
    return;
  }
  if (in.is_array())
    for (size_t i = 0; i < in.size(); ++i) list_unknown(in[i], path + "/" + std::to_string(i), out);
  if (!in.is_object()) return;
  for (const auto& [key, item] : in.items()) {
    if (key.starts_with("contrast") || key == "uniformity") continue;
    list_unknown(item, path + "/" + key, out);
  }
}

Json traced(SceneDescription description, const std::string& scenario, int64_t particles) {
  description.run.batch_particles = particles / batches;
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const uint64_t seed = description.run.seed;
  const std::atomic<bool> interrupt{false};
  LocalRun run(compiled(std::move(description), scenario), seed, threads);
  run.run({particles, std::nullopt, std::nullopt}, interrupt, [](const Progress&) {});
  CHECK(run.totals().balance().closes());
  Json result = result_json(run, {});
  std::vector<std::string> unknown;
  for (const char* part :
       {"planes", "probes", "signs", "surfaces", "surface_groups", "media", "escape"}) {
    list_unknown(result[part], part, unknown);
  }
  CHECK(unknown == std::vector<std::string>{});
  return result;
}

// ---- what is stated ---------------------------------------------------------------------------

std::optional<double> number_in(const toml::Table& table, const char* key) {
  const toml::Value* value = table.find(key);
  return value ? value->as_number() : std::nullopt;
}

double stated(const toml::Table& table, const char* key) {
  return number_in(table, key).value_or(0);
}

std::string words(const toml::Table& table, const char* key) {
  const toml::Value* value = table.find(key);
  return value && value->as_text() ? *value->as_text() : "";
}

/// The tables of a list; none if there is no such key.
std::vector<const toml::Table*> tables(const toml::Table& table, const char* key) {
  std::vector<const toml::Table*> out;
  const toml::Value* value = table.find(key);
  if (!value) return out;
  REQUIRE(value->as_list());
  for (const toml::Value& entry : *value->as_list()) {
    REQUIRE(entry.as_table());
    out.push_back(entry.as_table());
  }
  return out;
}

void check_value(const toml::Table& value, const Json& result) {
  const std::string path = words(value, "at");
  INFO(path << ": " << words(value, "why"));
  const double is = number_in(value, "is").value();
  const Number got = number_at(result, path);
  const double allowed = standard_errors * std::hypot(got.error, stated(value, "error")) +
                         stated(value, "relative") * std::abs(is);
  INFO("allowed distance " << allowed);
  CHECK(got.value == Approx(is).epsilon(1e-9).margin(allowed));
}

/// { scenario, at } of a number that an order refers to.
Number named(const toml::Table& order, const char* key,
             const std::map<std::string, Json>& results) {
  REQUIRE(order.find(key));
  const toml::List* pair = order.find(key)->as_list();
  REQUIRE(pair);
  REQUIRE(pair->size() == 2);
  const auto result = results.find(*(*pair)[0].as_text());
  REQUIRE(result != results.end());
  return number_at(result->second, *(*pair)[1].as_text());
}

void check_exact(const toml::Table& exact, const SceneDescription& scene) {
  const auto count = [&](const char* key, size_t have) {
    if (const auto want = number_in(exact, key)) {
      INFO(key);
      CHECK(static_cast<double>(have) == *want);
    }
  };
  count("emitters", scene.emitters.size());
  count("signs", scene.signs.size());
  count("observers", scene.observers.size());
  count("cameras", scene.cameras.size());
  count("scenarios", scene.scenarios.size());
  count("doors",
        static_cast<size_t>(std::count_if(scene.objects.begin(), scene.objects.end(),
                                          [](const Object& o) { return o.door.has_value(); })));
  if (const toml::Value* tops = exact.find("tops")) {
    REQUIRE(tops->as_table());
    for (const toml::Entry& entry : tops->as_table()->entries()) {
      INFO("top of " << entry.key);
      const auto object = std::find_if(scene.objects.begin(), scene.objects.end(),
                                       [&](const Object& o) { return o.name == entry.key; });
      REQUIRE(object != scene.objects.end());
      double top = -1e300;
      for (const glm::dvec3& v : object->mesh.positions) top = std::max(top, v.z);
      CHECK(top == Approx(entry.value.as_number().value()).margin(1e-12));
    }
  }
  // 1e-4: a photometric file keeps four to five digits of its intensities.
  double mains = 0, emergency = 0;
  for (const Emitter& e : scene.emitters) {
    mains += e.mains_flux;
    emergency += e.emergency_flux;
  }
  if (const auto lm = number_in(exact, "lumens_mains")) CHECK(mains == Approx(*lm).epsilon(1e-4));
  if (const auto lm = number_in(exact, "lumens_emergency"))
    CHECK(emergency == Approx(*lm).epsilon(1e-4));
}

void check_library_scene(const std::string& name) {
  const fs::path expected = library / (name + ".expected.toml");
  constexpr size_t max_bytes = 1 << 20;
  const auto text = read_regular_file(expected, max_bytes);
  REQUIRE(text.ok());
  const auto document = toml::parse(text.value(), expected.string(), max_bytes);
  REQUIRE(document.ok());
  const toml::Table& top = document->top;
  const SceneDescription scene = described(name);
  if (const toml::Value* exact = top.find("exact")) check_exact(*exact->as_table(), scene);
  std::map<std::string, Json> results;
  REQUIRE(top.find("run"));
  for (const toml::Table* run : tables(top, "run")) {
    const std::string scenario = words(*run, "scenario");
    INFO("scenario " << scenario);
    const auto particles = static_cast<int64_t>(stated(*run, "particles"));
    REQUIRE(particles >= batches);
    const Json& result =
        results.emplace(scenario, traced(scene, scenario, particles)).first->second;
    for (const toml::Table* value : tables(*run, "value")) check_value(*value, result);
  }
  for (const toml::Table* order : tables(top, "order")) {
    INFO(words(*order, "why"));
    const Number less = named(*order, "less", results), more = named(*order, "more", results);
    CHECK(less.value + standard_errors * std::hypot(less.error, more.error) < more.value);
  }
}

}  // namespace

TEST_CASE("every scene that ships is read and compiled without a problem, in all its scenarios",
          "[library]") {
  for (const std::string& name : shipped()) {
    INFO(name);
    const SceneDescription scene = described(name);
    CHECK(!scene.cameras.empty());
    std::vector<std::string> scenarios = {""};
    for (const Scenario& s : scene.scenarios) scenarios.push_back(s.name);
    for (const std::string& scenario : scenarios) {
      const auto compiled_scene = compiled(scene, scenario);
      CHECK(compiled_scene->triangles < 20'000);
      CHECK(compiled_scene->patch_count < 60'000);
      CHECK(compiled_scene->bands.count() <= 6);
    }
  }
}

TEST_CASE("every scene that ships has its expected numbers beside it", "[library]") {
  std::set<std::string> expected;
  for (const auto& entry : fs::directory_iterator(library)) {
    const std::string file = entry.path().filename().string();
    if (is_expectation(file))
      expected.insert(file.substr(0, file.size() - std::string(".expected.toml").size()));
  }
  CHECK(expected == shipped());
}

TEST_CASE("the empty room receives twice the light of its lamp", "[library]") {
  check_library_scene("empty_room");
}

TEST_CASE("the integrating sphere is equally bright everywhere inside", "[library]") {
  check_library_scene("integrating_sphere");
}

TEST_CASE("the smoke tank follows Beer and Lambert to Smokeview's greys", "[library]") {
  check_library_scene("smoke_tank");
}

TEST_CASE("the soot of a ball of flame absorbs the share of the closed form", "[library]") {
  check_library_scene("fire_in_a_box");
}

TEST_CASE("the red EXIT shines red, and its housing shows the light of the room", "[library]") {
  check_library_scene("red_exit");
}

TEST_CASE("the auditorium gives the numbers of its long runs", "[library]") {
  check_library_scene("auditorium");
}

TEST_CASE("the office floor in clear air gives the numbers of its long runs", "[library]") {
  check_library_scene("office_floor_clear");
}

TEST_CASE("the office floor gives the numbers of its long runs, and smoke dims high signs most",
          "[library]") {
  check_library_scene("office_floor");
}

}  // namespace luxodus

#include "actors/display/report.hpp"

#include "actors/display/result_files.hpp"
#include "tests/unit/actors/display/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string long_name(120, 'n');

/// A room that asks for one value of every kind the summary tells, all but signs.
const std::string asking_room = R"(
[[material]]
name = "white"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 4, 3]
material = "white"
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [2, 2, 2.9]
size = [0.5, 0.5]
flux_lm = 1000
[[plane]]
name = ")" + long_name + R"("
corner = [0, 0, 0.02]
edge_u = [4, 0, 0]
edge_v = [0, 4, 0]
cells = [4, 4]
[[probe]]
name = "desk"
position = [1, 1, 0.8]
[[surface_group]]
name = "walls"
objects = ["room"]
[[counting_plane]]
name = "half way"
corner = [0, 0, 1.5]
edge_u = [4, 0, 0]
edge_v = [0, 4, 0]
[[camera]]
name = "door"
eye = [0.5, 0.5, 1.6]
target = [2, 2, 1]
width = 8
height = 8
)";

void put(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

}  // namespace

TEST_CASE("the summary tells every value that was asked for, however long its name", "[display]") {
  const auto run = traced(asking_room, 1 << 15);
  const Json result = result_json(*run, {});
  const std::string text = summary_text(result);
  INFO(text);
  for (const std::string& name : {"plane " + long_name + " min ", std::string("probe desk"),
                                  std::string("surfaces walls"), std::string("through half way")})
    CHECK(text.find(name) != std::string::npos);
  const size_t plane = text.find(long_name);
  CHECK(text.substr(plane, text.find('\n', plane) - plane).ends_with(" lx"));
  CHECK(text.find("ledger closes exactly") != std::string::npos);
}

TEST_CASE("the worst relative error is the worst of those of planes, probes and signs",
          "[display]") {
  const auto run = traced(asking_room, 1 << 15);
  const Json result = result_json(*run, {});
  const Json& of = result["relative_errors"];
  const auto worst = [&](const char* kind) { return of[kind]["worst"]["value"].get<double>(); };
  const Json& plane = result["planes"][0]["mean_illuminance"];
  CHECK(worst("planes") ==
        Approx(plane["standard_error"].get<double>() / plane["value"].get<double>()));
  CHECK(result["worst_relative_error"]["value"].get<double>() ==
        Approx(std::max(worst("planes"), worst("probes"))));
  CHECK(of["signs"]["median"]["value"].is_null());
}

TEST_CASE("old maps are cleared only where a result of ours names them", "[display]") {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch / "run";
  put(folder / "planes" / "floor.csv");
  put(folder / "patches.vtp");
  put(scratch / "outside.csv");
  REQUIRE(remove_old_maps(folder).ok());
  CHECK(std::filesystem::exists(folder / "planes" / "floor.csv"));

  std::ofstream(folder / "result.json")
      << R"({"program": "another", "planes": [{"name": "floor"}]})";
  REQUIRE(remove_old_maps(folder).ok());
  CHECK(std::filesystem::exists(folder / "planes" / "floor.csv"));
  CHECK(std::filesystem::exists(folder / "patches.vtp"));

  std::ofstream(folder / "result.json") << R"({"program": "luxodus", "cameras": 7,
    "planes": [{"name": "floor"}, {"name": "../../outside"}, {"name": 3}, "floor"]})";
  REQUIRE(remove_old_maps(folder).ok());
  CHECK_FALSE(std::filesystem::exists(folder / "planes"));
  CHECK_FALSE(std::filesystem::exists(folder / "patches.vtp"));
  CHECK(std::filesystem::exists(folder / "result.json"));
  CHECK(std::filesystem::exists(scratch / "outside.csv"));
}

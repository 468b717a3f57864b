// Results about smoke and flames from a fire simulation.
#include "actors/results/files/run_results.hpp"
#include "actors/results/files/run_state.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("a result lists a simulated fire as smoke and flame, once, with its time",
          "[display][fds]") {
  const TemporaryFolder folder;
  const SmallMesh coarse = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const SmallMesh fine = even_mesh({1, 0, 0}, {0.2, 0.2, 0.2}, {5, 5, 5});
  std::string index = index_of_meshes({coarse, fine});
  for (const auto& [m, mesh] : {std::pair<size_t, const SmallMesh&>{1, coarse}, {2, fine}}) {
    const std::string n = std::to_string(m);
    folder.write(n + ".sf",
                 slice_file(mesh, "SOOT EXTINCTION COEFFICIENT",
                            {{60, cell_values(mesh, [](int, int, int) { return 0.5F; })}}));
    folder.write(n + ".s3d", smoke3d_file(mesh, {{60, node_values(mesh, [](int i, int, int) {
                                                    return i < 1 ? 200.0F : 0.0F;
                                                  })}}));
    index += slice_entry(m, true, mesh, n + ".sf", "SOOT EXTINCTION COEFFICIENT") +
             smoke_entry(m, n + ".s3d", "HRRPUV", "0.000");
  }
  folder.write("small_hrr.csv", "s,kW\nTime,HRR\n 0,0\n 100,100\n");
  folder.write("fire.smv", index);
  const auto description = described(folder.write(
      "scene.toml",
      "[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [2, 1, 1]\nmaterial "
      "= "
      "\"grey50\"\n[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\nat_s = 60\n"
      "albedo = 0.2\ng = 0.6\nangstrom = 1\n[medium.flames]\nradiant_fraction = 0.3\n"
      "soot_temperature_k = 1400\n"));
  const auto scene = compile_scene(description, find_scenario(*description, "").value(), {});
  REQUIRE(scene.ok());
  REQUIRE(description->media.size() == 2);
  CHECK(scene.value()->media_names == std::vector<std::string>{"fire", "fire (2)"});
  const Json state = run_state_json(*scene.value());
  REQUIRE(state["smoke"].size() == 1);
  CHECK(state["smoke"][0]["time_s"] == 60);
  CHECK(state["flames"].size() == 1);
  CHECK(run_state_text(state).find("smoke: fire at 60 s; 1 flame") != std::string::npos);
  // The heat of both grids is that of the whole fire.
  double watts = 0;
  for (const Medium& m : description->media) watts += m.emission ? m.emission->power_w : 0;
  CHECK(watts == Approx(0.3 * 60e3));
}

TEST_CASE("a result keeps the requested time, for its pictures", "[display][fds]") {
  const auto run = traced(
      "[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [2, 1, 1]\nmaterial "
      "= "
      "\"grey50\"\n[[emitter]]\nname = \"e\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
      "position = [1, 0.5, 0.5]\nflux_lm = 100\n",
      8192);
  RunRecord record{"test.toml", "particles", 1};
  CHECK_FALSE(result_json(*run, record).contains("at_s"));
  record.at_s = 45;
  CHECK(result_json(*run, record)["at_s"] == 45.0);
}

// Fire simulations in scene files: the keys, the notes in a scene, and rejected simulations.
#include <catch2/catch.hpp>

#include "scenes/light/optics/flame_spectrum.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

/// A folder with a fire in two meshes with different cells, 1 /m and 2 /m at 10 s, clear at 0 s;
/// 200 kW burn in the first.
struct FireFolder : SceneFolder {
  FireFolder() {
    using namespace test;
    const SmallMesh a = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {4, 4, 4});
    const SmallMesh b = even_mesh({2, 0, 0}, {0.4, 0.4, 0.4}, {5, 5, 5});
    const auto slice = [&](const SmallMesh& mesh, float value) {
      const auto all = [&](float v) { return cell_values(mesh, [v](int, int, int) { return v; }); };
      return slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", {{0, all(0)}, {10, all(value)}});
    };
    const auto heat = [](const SmallMesh& mesh, float value) {
      const auto all = [&](float v) {
        return node_values(mesh, [v](int i, int, int) { return i < 2 ? v : 0; });
      };
      return smoke3d_file(mesh, {{0, all(0)}, {10, all(value)}});
    };
    put("a.sf", slice(a, 1));
    put("b.sf", slice(b, 2));
    put("a.s3d", heat(a, 100));
    put("b.s3d", heat(b, 0));
    put("small_hrr.csv", "s,kW\nTime,HRR\n 0.0,0.0\n 20.0,400\n");
    put("fire.smv", index_of_meshes({a, b}) +
                        slice_entry(1, true, a, "a.sf", "SOOT EXTINCTION COEFFICIENT") +
                        slice_entry(2, true, b, "b.sf", "SOOT EXTINCTION COEFFICIENT") +
                        smoke_entry(1, "a.s3d", "HRRPUV", "0.000") +
                        smoke_entry(2, "b.s3d", "HRRPUV", "0.000"));
  }
};

const std::string fire_table =
    "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\nat_s = 10\nalbedo = 0.2\n"
    "g = 0.6\nangstrom = 1\n";
const std::string flames_table =
    "[medium.flames]\nradiant_fraction = 0.35\nsoot_temperature_k = 1400\n";

bool notes_say(const SceneDescription& scene, const std::string& words) {
  for (const Problem& note : scene.notes)
    if (note.what.find(words) != std::string::npos) return true;
  return false;
}

/// The first problem, in one line.
std::string refused(SceneFolder& folder, const std::string& text) {
  const ReadScene read = folder.read(text);
  REQUIRE_FALSE(read.scene.has_value());
  return all_problems(read);
}

}  // namespace

TEST_CASE("a fire simulation becomes a data set for each of its grids, with the name of the medium",
          "[format][scene][fds]") {
  FireFolder folder;
  const auto scene = good(folder, fire_table + "position = [10, 0, 0]\nrotate_deg = [0, 0, 90]\n");
  REQUIRE(scene.media.size() == 2);
  for (const Medium& m : scene.media) {
    CHECK(m.name == "fire");
    CHECK(m.kind == MediumKind::data_set);
    CHECK(m.optics.phase.kind == PhaseKind::henyey_greenstein);
    CHECK(m.optics.phase.g == 0.6);
    CHECK(m.optics.extinction.wavelength_nm == 633);
    CHECK(m.optics.extinction.angstrom == 1);
    CHECK(m.optics.albedo.at(550) == Approx(0.2));
    CHECK_FALSE(m.emission);
  }
  CHECK(scene.media[0].data.extinction[0] == 1);
  CHECK(scene.media[1].data.extinction[0] == 2);
  // x of the simulation is y of the scene.
  CHECK(glm::length(scene.media[0].frame.origin - glm::dvec3(10, 0, 0)) < 1e-9);
  CHECK(glm::length(scene.media[1].frame.origin - glm::dvec3(10, 2, 0)) < 1e-9);
  REQUIRE(scene.media[0].simulation);
  CHECK_FALSE(scene.media[1].simulation);
  CHECK(scene.media[0].simulation->meshes.size() == 2);
  CHECK(scene.media[0].simulation->time_s == 10);
  CHECK_FALSE(scene.media[0].simulation->glows);
  CHECK(notes_say(scene, "cell-centred 3-D slice of extinction"));
  CHECK(notes_say(scene, "2 meshes of 189 cells"));
  CHECK(notes_say(scene, "FLAME GLARE IS MISSING"));
}

TEST_CASE("flames of a simulation radiate their share of the heat at the time",
          "[format][scene][fds]") {
  FireFolder folder;
  const auto scene = good(folder, fire_table + flames_table);
  REQUIRE(scene.media.size() == 2);
  REQUIRE(scene.media[0].emission);
  CHECK_FALSE(scene.media[1].emission);
  CHECK(scene.media[0].emission->power_w == Approx(0.35 * 200e3));
  CHECK(scene.media[0].emission->visible_fraction ==
        Approx(flame_spectrum(1400, true).visible_fraction));
  CHECK(scene.media[0].simulation->glows);
  CHECK(notes_say(scene, "release 200 kW at 10 s and radiate 70 kW"));
  CHECK_FALSE(notes_say(scene, "FLAME GLARE"));
}

TEST_CASE("a requested time replaces the one that a simulation states", "[format][scene][fds]") {
  FireFolder folder;
  const auto path = folder.put("scene.toml", fire_table);
  const ReadScene at_10 = read_scene(path), at_0 = read_scene(path, 0.04);
  REQUIRE(at_10.scene);
  REQUIRE(at_0.scene);
  CHECK(at_0.scene->media[0].data.extinction[0] == 0);
  CHECK(at_0.scene->media[0].simulation->time_s == 0);
  CHECK(at_0.scene->content_hash != at_10.scene->content_hash);
  const ReadScene none = read_scene(folder.put("b.toml", "title = \"no fire\"\n"), 5);
  CHECK(all_problems(none).find("nothing in this scene changes in time") != std::string::npos);
}

TEST_CASE("the hash of a scene covers the smoke that is used and nothing else of the results",
          "[format][scene][fds]") {
  FireFolder folder;
  const auto before = good(folder, fire_table).content_hash;
  CHECK(good(folder, fire_table).content_hash == before);
  // Without flames HRRPUV is not used.
  folder.put("b.s3d", "");
  CHECK(good(folder, fire_table).content_hash == before);
  const auto mesh = test::even_mesh({2, 0, 0}, {0.4, 0.4, 0.4}, {5, 5, 5});
  folder.put("b.sf",
             test::slice_file(mesh, "SOOT EXTINCTION COEFFICIENT",
                              {{10, test::cell_values(mesh, [](int, int, int) { return 2.5F; })}}));
  CHECK(good(folder, fire_table).content_hash != before);
}

TEST_CASE("properties that FDS does not know must be stated", "[format][scene][fds]") {
  FireFolder folder;
  for (const std::string key : {"albedo = 0.2\n", "g = 0.6\n", "angstrom = 1\n", "at_s = 10\n"}) {
    const std::string name = key.substr(0, key.find(' '));
    CHECK(refused(folder, test::replaced(fire_table, key, ""))
              .find("the key '" + name + "' is missing") != std::string::npos);
  }
  CHECK(refused(folder, fire_table + "[medium.flames]\nradiant_fraction = 0.3\n")
            .find("'soot_temperature_k' is missing") != std::string::npos);
}

TEST_CASE("faults of a simulation are reported where the scene names it", "[format][scene][fds]") {
  FireFolder folder;
  const std::string no_file = refused(folder, test::replaced(fire_table, "fire.smv", "none.smv"));
  CHECK(no_file.find("scene.toml:4") != std::string::npos);
  const std::string late = refused(folder, test::replaced(fire_table, "at_s = 10", "at_s = 60"));
  CHECK(late.find("fire.smv: there is no frame near 60 s") != std::string::npos);
  CHECK(late.find("scene.toml:4") != std::string::npos);
  const std::string source = refused(folder, fire_table + "source = \"smoke3d\"\n");
  CHECK(source.find("no Smoke3D") != std::string::npos);
  CHECK(refused(folder, fire_table + "emission = { power_w = 1, temperature_k = 1400 }\n")
            .find("'emission'") != std::string::npos);
}

TEST_CASE("flames of an unusual temperature or fraction give a warning", "[format][scene][fds]") {
  FireFolder folder;
  const auto scene =
      good(folder,
           fire_table + test::replaced(test::replaced(flames_table, "1400", "900"), "0.35", "0.9"));
  std::string all;
  for (const Problem& w : scene.warnings) all += w.what + "\n";
  CHECK(all.find("'soot_temperature_k' is 900") != std::string::npos);
  CHECK(all.find("'radiant_fraction' is 0.9") != std::string::npos);
}

TEST_CASE("light uses smoke between two frames, verdicts use the nearer frame",
          "[format][scene][fds]") {
  FireFolder folder;
  const auto path = folder.put("scene.toml", fire_table);
  const auto at = [&](double at_s, FireFrames frames) {
    const ReadScene read = read_scene(path, at_s, {}, frames);
    INFO(all_problems(read));
    REQUIRE(read.scene);
    return *read.scene;
  };
  const auto whole = at(10, FireFrames::between), half = at(5, FireFrames::between);
  CHECK(half.media[0].simulation->time_s == Approx(5));
  CHECK(notes_say(half, "linear between the frames at 0 and 10 s"));
  CHECK(half.media[0].data.extinction[0] == Approx(0.5F * whole.media[0].data.extinction[0]));
  CHECK(half.content_hash != whole.content_hash);
  CHECK(at(6, FireFrames::nearest).media[0].simulation->time_s == 10);
  CHECK(at(6, FireFrames::nearest).content_hash == whole.content_hash);
  CHECK(at(4.9, FireFrames::nearest).media[0].simulation->time_s == 0);
}

TEST_CASE("a variant scales all grids of a simulation by one factor", "[format][scene][fds]") {
  FireFolder folder;
  folder.put("base.toml", fire_table);
  const auto scene = good(folder,
                          "include = [\"base.toml\"]\n[[change]]\nkind = \"medium\"\nof = "
                          "\"fire\"\nfactor = 3\n");
  REQUIRE(scene.scenarios.size() == 1);
  REQUIRE(scene.scenarios[0].media.size() == 1);
  CHECK(scene.scenarios[0].media[0].name == "fire");
  CHECK(scene.scenarios[0].media[0].factor == 3);
}

}  // namespace luxodus

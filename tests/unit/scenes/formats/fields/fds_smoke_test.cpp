// Smoke of fire simulations: Smoke3D by its formats, walls, several species, restarted runs, and
// how smoke is told. Cases are written by the tests; values follow from closed boxes of even smoke.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_building.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const char* const soot_extinction = "SOOT EXTINCTION COEFFICIENT";
const char* const fog_extinction = "THEATRE FOG EXTINCTION COEFFICIENT";

/// A folder with the index of a case, read at a time.
struct SmokeCase {
  TemporaryFolder folder;
  std::vector<SmallMesh> meshes{even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {4, 4, 3})};
  FireOptions options;

  void index(const std::string& entries, const std::string& version = "6.9.1") const {
    folder.write("case.smv", replaced(index_of_meshes(meshes), "6.9.1", version) + entries);
  }
  Result<LoadedFire> read(double at_s) {
    options.at_s = at_s;
    return read_fire(folder / "case.smv", options);
  }
};

LoadedFire smoke_of(const Result<LoadedFire>& fire) {
  INFO((fire.ok() ? std::string() : fire.problem().text()));
  REQUIRE(fire.ok());
  return fire.value();
}

std::string refused_fire(const Result<LoadedFire>& fire) {
  REQUIRE_FALSE(fire.ok());
  return fire.problem().text();
}

bool tells(const std::string& text, const std::string& words) {
  INFO(text);
  return text.find(words) != std::string::npos;
}

bool any_tells(const std::vector<std::string>& texts, const std::string& words) {
  for (const std::string& text : texts)
    if (text.find(words) != std::string::npos) return true;
  return false;
}

ValueAt even(double value) {
  return [value](int, int, int) { return static_cast<float>(value); };
}

/// Largest relative difference of the smoke in all cells from an extinction.
double largest_difference(const LoadedFire& fire, double extinction) {
  double most = 0;
  for (const FireGrid& grid : fire.grids)
    for (const float v : grid.data.extinction)
      most = std::max(most, std::abs(static_cast<double>(v) / extinction - 1));
  return most;
}

/// The share of a node's eight cells that have the smoke of a closed box of even smoke: those
/// within it, and in the format of FDS 6.11 those behind one of its faces alone.
double filled_share(const SmallMesh& mesh, int i, int j, int k, bool behind_faces) {
  const int at[] = {i, j, k};
  int filled = 0;
  for (int corner = 0; corner < 8; ++corner) {
    int outside = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int cell = at[axis] - (corner >> axis & 1);
      outside += cell < 0 || cell >= mesh.cells(axis) ? 1 : 0;
    }
    filled += outside == 0 || (behind_faces && outside == 1) ? 1 : 0;
  }
  return filled / 8.0;
}

float opacity_byte(double extinction, double cell_m) {
  return static_cast<float>(std::round(254 * (1 - std::exp(-extinction * cell_m))));
}

}  // namespace

TEST_CASE("Smoke3D of FDS 6.11 has shares of the highest density, which its file of sizes states",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  const double density = 7.64e-5;
  const auto of = [&](double highest) {
    return node_values(mesh, [&](int i, int j, int k) {
      return static_cast<float>(highest * filled_share(mesh, i, j, k, true));
    });
  };
  const DensityFiles files =
      density_files(mesh, {{0, of(0)}, {5, of(density)}, {10, of(2 * density)}});
  c.folder.write("a.s3d", files.smoke);
  c.folder.write("a.s3d.sz", files.sizes);
  c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY"), "6.11.1");
  const LoadedFire fire = smoke_of(c.read(5));
  CHECK(fire.smokes.front().bytes == SmokeBytes::density);
  CHECK(tells(fire.smokes.front().formula, "format 1"));
  CHECK(tells(fire.version, "6.11.1"));
  CHECK(largest_difference(fire, 8700 * density) < 0.01);
  CHECK(largest_difference(smoke_of(c.read(10)), 2 * 8700 * density) < 0.01);
  c.options.mass_extinction_m2_per_kg = 4350;
  CHECK(largest_difference(smoke_of(c.read(5)), 4350 * density) < 0.01);

  SECTION("smoke that is there from the start is in the walls, too") {
    c.options.mass_extinction_m2_per_kg.reset();
    const auto all = node_values(mesh, even(density));
    const DensityFiles full = density_files(mesh, {{0, all}, {5, all}});
    c.folder.write("a.s3d", full.smoke);
    c.folder.write("a.s3d.sz", full.sizes);
    CHECK(largest_difference(smoke_of(c.read(5)), 8700 * density) < 1e-5);
  }
  SECTION("without its file of sizes, or with that of another run, it is refused") {
    std::filesystem::remove(c.folder / "a.s3d.sz");
    CHECK(tells(refused_fire(c.read(5)), "a.s3d.sz"));
    c.folder.write("a.s3d.sz", replaced(files.sizes, " 5 100", " 5.5 100"));
    CHECK(tells(refused_fire(c.read(5)), "different runs"));
    c.folder.write("a.s3d.sz", "           1\n 0 100 3\n");
    CHECK(tells(refused_fire(c.read(5)), "a.s3d.sz:2"));
    c.folder.write("a.s3d.sz", "           1\n 0 100 3 nan\n");
    CHECK(tells(refused_fire(c.read(5)), "a.s3d.sz:2"));
  }
  SECTION("frames that the file of sizes does not have yet belong to a run in progress") {
    c.folder.write("a.s3d.sz", files.sizes.substr(0, files.sizes.rfind(" 10 100")));
    CHECK(smoke_of(c.read(5)).frames == 2);
  }
  SECTION("a highest value that does not go with the bytes is refused") {
    const size_t last = files.smoke.size() - 5;
    std::string other = files.smoke;
    for (char& byte : other)
      if (static_cast<uint8_t>(byte) == 254) byte = static_cast<char>(200);
    other[last] = files.smoke[last];
    c.folder.write("a.s3d", other);
    CHECK(tells(refused_fire(c.read(5)), "different runs"));
  }
}

TEST_CASE("Smoke3D of an unknown format is refused, not guessed", "[format][fds]") {
  SmokeCase c;
  const auto all = node_values(c.meshes[0], even(100));
  c.folder.write("a.s3d", smoke3d_file(c.meshes[0], {{0, all}, {5, all}}, 2));
  c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY"), "6.12.0");
  CHECK(tells(refused_fire(c.read(5)), "format 2"));
}

TEST_CASE("Smoke3D up to FDS 6.10 is corrected at walls whatever its first frame holds",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  const auto of = [&](double extinction) {
    return node_values(mesh, [&](int i, int j, int k) {
      return opacity_byte(extinction * filled_share(mesh, i, j, k, false), 0.5);
    });
  };
  c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY"));
  // A restarted run begins with the smoke of the moment, of which walls hold nothing.
  c.folder.write("a.s3d", smoke3d_file(mesh, {{7, of(0.8)}, {10, of(1.6)}}));
  CHECK(largest_difference(smoke_of(c.read(10)), 1.6) < 0.05);
  CHECK(largest_difference(smoke_of(c.read(7)), 0.8) < 0.05);
  // Smoke that &INIT puts everywhere is in the walls, too, and stays there as it was.
  const auto full = node_values(mesh, even(opacity_byte(0.8, 0.5)));
  const auto later = node_values(mesh, [&](int i, int j, int k) {
    const double share = filled_share(mesh, i, j, k, false);
    return opacity_byte(1.6 * share + 0.8 * (1 - share), 0.5);
  });
  c.folder.write("a.s3d", smoke3d_file(mesh, {{0, full}, {10, later}}));
  CHECK(largest_difference(smoke_of(c.read(0)), 0.8) < 0.02);
  CHECK(largest_difference(smoke_of(c.read(10)), 1.6) < 0.05);
}

TEST_CASE("faces of obstructions are half gas in both formats", "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {4, 4, 4});
  mesh.obstructions = {{0, 4, 0, 4, 0, 1}};
  mesh.openings = {{0, 0, 0, 2, 0.5, 2},
                   {2, 2, 0, 2, 0.5, 2},
                   {0, 2, 0, 0, 0.5, 2},
                   {0, 2, 2, 2, 0.5, 2},
                   {0, 2, 0, 2, 2, 2}};
  c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY"));
  // Cells behind two open faces at once are never filled.
  const auto share = [&](int i, int j, int k) {
    const int at[] = {i, j, k};
    int filled = 0;
    for (int corner = 0; corner < 8; ++corner) {
      int outside = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const int cell = at[axis] - (corner >> axis & 1);
        outside += cell < 0 || cell >= 4 ? 1 : 0;
      }
      filled += outside <= 1 && k - (corner >> 2 & 1) >= 1 ? 1 : 0;
    }
    return filled / 8.0;
  };
  const auto clear = node_values(mesh, even(0));
  const auto densities = node_values(
      mesh, [&](int i, int j, int k) { return static_cast<float>(1e-4 * share(i, j, k)); });
  const DensityFiles files = density_files(mesh, {{0, clear}, {5, densities}});
  c.folder.write("a.s3d", files.smoke);
  c.folder.write("a.s3d.sz", files.sizes);
  const LoadedFire fire = smoke_of(c.read(5));
  for (int k = 1; k < 4; ++k)
    for (int i = 0; i < 16; ++i)
      CHECK(fire.grids[0].data.extinction[static_cast<size_t>(16 * k + i)] ==
            Approx(0.87).epsilon(0.02));
}

TEST_CASE("the extinction of all species that absorb light is summed, and they are named",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  const auto slice = [&](const char* label, double value, bool cells = true) {
    const auto all = cells ? cell_values(mesh, even(value)) : node_values(mesh, even(value));
    return slice_file(mesh, label, {{5, all}});
  };
  const auto two_slices = [&](bool cells) {
    c.folder.write("fog.sf", slice(fog_extinction, 0.1075, cells));
    c.folder.write("soot.sf", slice(soot_extinction, 0.665, cells));
    return slice_entry(1, cells, mesh, "fog.sf", fog_extinction) +
           slice_entry(1, cells, mesh, "soot.sf", soot_extinction);
  };
  SECTION("of slices") {
    for (const bool cells : {true, false}) {
      c.index(two_slices(cells));
      const LoadedFire fire = smoke_of(c.read(5));
      CHECK(largest_difference(fire, 0.7725) < 1e-5);
      REQUIRE(fire.smokes.size() == 2);
      CHECK(fire.smokes[0].species == "SOOT");
      CHECK(fire.smokes[1].species == "THEATRE FOG");
    }
  }
  SECTION("of Smoke3D, each with its own mass extinction") {
    for (const auto& [name, density] : {std::pair{"a", 1e-4}, {"b", 3e-4}}) {
      const auto all = node_values(mesh, even(density));
      const DensityFiles files = density_files(mesh, {{0, all}, {5, all}});
      c.folder.write(std::string(name) + ".s3d", files.smoke);
      c.folder.write(std::string(name) + ".s3d.sz", files.sizes);
    }
    c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY") +
            smoke_entry(1, "b.s3d", "THEATRE FOG DENSITY", "900.000"));
    CHECK(largest_difference(smoke_of(c.read(5)), 0.87 + 0.27) < 1e-4);
  }
  SECTION("of PLOT3D") {
    const auto zero = node_values(mesh, even(0));
    c.folder.write("p_1_5p00.q", plot3d_file(mesh, {zero, zero, node_values(mesh, even(0.2)),
                                                    node_values(mesh, even(0.3)), zero}));
    std::string entry = "PL3D 5.0 1\n p_1_5p00.q\n";
    for (const char* label : {"TEMPERATURE", "U", fog_extinction, soot_extinction, "HRRPUV"})
      entry += label_lines(label);
    c.index(entry);
    CHECK(largest_difference(smoke_of(c.read(5)), 0.5) < 1e-5);
  }
  SECTION("of different forms, where no form has all") {
    c.folder.write("soot.sf", slice(soot_extinction, 0.665));
    const auto all = node_values(mesh, even(3e-4));
    const DensityFiles files = density_files(mesh, {{0, all}, {5, all}});
    c.folder.write("b.s3d", files.smoke);
    c.folder.write("b.s3d.sz", files.sizes);
    c.index(slice_entry(1, true, mesh, "soot.sf", soot_extinction) +
            smoke_entry(1, "b.s3d", "THEATRE FOG DENSITY", "900.000"));
    const LoadedFire fire = smoke_of(c.read(5));
    CHECK(largest_difference(fire, 0.665 + 0.27) < 1e-4);
    CHECK(tells(sources_words(fire), "slice of extinction and Smoke3D"));
    CHECK(largest_depth_error(fire) > 0);
  }
  SECTION("a species that is missing is an error that names it, not less smoke") {
    const auto all = node_values(mesh, even(100));
    c.folder.write("a.s3d", smoke3d_file(mesh, {{0, all}, {5, all}}));
    c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY") +
            part_slice_entry(1, false, {0, 4, 0, 4, 1, 1}, "flat.sf", fog_extinction));
    CHECK(tells(refused_fire(c.read(5)), "THEATRE FOG is in no"));
    c.index(two_slices(true) + smoke_entry(1, "a.s3d", "SOOT DENSITY"));
    c.options.sources = {FireSource::smoke3d};
    CHECK(tells(refused_fire(c.read(5)), "THEATRE FOG is in no Smoke3D"));
  }
  SECTION("one stated mass extinction for several species is refused") {
    c.index(two_slices(true));
    c.options.mass_extinction_m2_per_kg = 8000;
    CHECK(tells(refused_fire(c.read(5)), "SOOT and THEATRE FOG"));
  }
}

TEST_CASE("smoke that is not named SOOT is read with the mass extinction of its own",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  c.folder.write("a.sf",
                 slice_file(mesh, "MY SMOKE DENSITY", {{5, cell_values(mesh, even(1e-4))}}));
  const std::string slice = slice_entry(1, true, mesh, "a.sf", "MY SMOKE DENSITY");
  c.index(slice + smoke_entry(1, "none.s3d", "MY SMOKE DENSITY", "5000.000"));
  c.options.sources = {FireSource::cell_soot};
  const LoadedFire fire = smoke_of(c.read(5));
  CHECK(fire.smokes.front().species == "MY SMOKE");
  CHECK(largest_difference(fire, 0.5) < 1e-5);
  // Without it, the species is named, and the user may state it.
  c.index(slice);
  c.options.sources.clear();
  CHECK(tells(refused_fire(c.read(5)), "density of MY SMOKE"));
  c.options.mass_extinction_m2_per_kg = 7000;
  CHECK(largest_difference(smoke_of(c.read(5)), 0.7) < 1e-5);
}

TEST_CASE("after a restart the later records hold in every file, and it is said", "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  const auto frames = [&](const auto& values) {
    std::vector<SmallFrame> out;
    const float times[] = {0, 6, 8.012F, 10, 13, 8.014F, 10.003F, 12.039F};
    const double k[] = {0, 1, 2, 3, 4, 1.5, 2.5, 3.5};
    for (size_t i = 0; i < std::size(times); ++i) out.push_back({times[i], values(k[i])});
    return out;
  };
  c.folder.write("a.sf", slice_file(mesh, soot_extinction,
                                    frames([&](double k) { return cell_values(mesh, even(k)); })));
  const DensityFiles smoke =
      density_files(mesh, frames([&](double k) { return node_values(mesh, even(k / 8700)); }));
  c.folder.write("a.s3d", smoke.smoke);
  c.folder.write("a.s3d.sz", smoke.sizes);
  c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction) +
          smoke_entry(1, "a.s3d", "SOOT DENSITY"));
  for (const FireSource source : {FireSource::cell_extinction, FireSource::smoke3d}) {
    c.options.sources = {source};
    const LoadedFire fire = smoke_of(c.read(12.039));
    CHECK(fire.frames == 5);
    const auto at = [&](double time_s) {
      const LoadedFire one = smoke_of(c.read(time_s));
      // A cell in the middle, away from walls.
      return static_cast<double>(one.grids[0].data.extinction[16 + 5]);
    };
    CHECK(at(6) == Approx(1).epsilon(0.02));
    CHECK(at(8.012) == Approx(1.5).epsilon(0.02));  // the tick of the abandoned part is gone
    CHECK(at(10) == Approx(2.5).epsilon(0.02));
    CHECK(at(12.039) == Approx(3.5).epsilon(0.02));
    CHECK(any_tells(fire.notes, "go back from 13 to 8.014 s"));
    CHECK(tells(refused_fire(c.read(13.3)), "reach from 0 to 12.039 s"));
  }
  // A time that is written twice is one frame, the later one.
  c.options.sources.clear();
  const auto cells = [&](double k) { return cell_values(mesh, even(k)); };
  c.folder.write(
      "a.sf", slice_file(mesh, soot_extinction, {{0, cells(0)}, {60, cells(1)}, {60, cells(2)}}));
  c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction));
  const LoadedFire twice = smoke_of(c.read(60));
  CHECK(largest_difference(twice, 2) < 1e-6);
  CHECK(any_tells(twice.notes, "from 60 to 60 s"));
}

TEST_CASE("events and heat of a part that a restart made void do not count", "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  mesh.obstructions = {{1, 2, 0, 4, 0, 3}, {3, 4, 0, 4, 0, 3}};
  const auto cells = cell_values(mesh, even(1));
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{0, cells}, {9, cells}, {12, cells}}));
  const std::string slice = slice_entry(1, true, mesh, "a.sf", soot_extinction);
  const auto building = [&](const std::string& events) {
    c.index(slice + events);
    const auto made = read_fire_building(c.folder / "case.smv", 0);
    REQUIRE(made.ok());
    return made.value();
  };
  // The same obstruction vanishes in both parts of the run.
  const FireBuilding twice = building("HIDE_OBST 1\n 1 8.12\nHIDE_OBST 1\n 1 11.12\n");
  CHECK(tells(twice.tables.text(), "vanishes_at = [11.12]"));
  CHECK(any_tells(twice.notes, "vanishes at 8.12 s"));
  CHECK(smoke_of(c.read(9)).grids[0].data.extinction[1] == 0);
  CHECK(smoke_of(c.read(12)).grids[0].data.extinction[1] == 1);
  // Times that go back, here told by a device, make the events of a later time void.
  const FireBuilding back = building(
      "HIDE_OBST 1\n 1 8.12\nHIDE_OBST 1\n 2 12.00\nDEVICE_ACT d\n 1 9.00 1\nHIDE_OBST 1\n 1 "
      "9.5\n");
  CHECK(tells(back.tables.text(), "vanishes_at = [9.5]"));
  CHECK(back.tables.text().find("12") == std::string::npos);
  CHECK(any_tells(back.notes, "events go back from 12 to 9 s"));
  // Later lines of the table of heat hold.
  c.folder.write("h.sf", slice_file(mesh, "HRRPUV", {{12, cell_values(mesh, even(100))}}));
  c.index(slice + slice_entry(1, true, mesh, "h.sf", "HRRPUV"));
  c.folder.write("small_hrr.csv",
                 "s,kW\nTime,HRR\n 0.0,0.0\n 13.0,999\n 14.0,999\n 7.0,70\n 12.0,120\n");
  c.options.flames = true;
  const LoadedFire fire = smoke_of(c.read(12));
  CHECK(fire.heat_release_kw == Approx(120));
  CHECK(any_tells(fire.notes, "times in small_hrr.csv go back from 14 to 7 s"));
  // A time that is written twice is one line, the later one.
  c.folder.write("small_hrr.csv", "s,kW\nTime,HRR\n 0.0,0.0\n 12.0,999\n 12.0,120\n");
  const LoadedFire again = smoke_of(c.read(12));
  CHECK(again.heat_release_kw == Approx(120));
  CHECK(any_tells(again.notes, "times in small_hrr.csv go back from 12 to 12 s"));
  c.folder.write("small_hrr.csv", "s,kW\nTime,HRR\n 0.0,0.0\n 12.0,120\n");
  CHECK(smoke_of(c.read(12)).notes.empty());
}

TEST_CASE("the later record of an obstruction holds, even if it is of a slightly earlier time",
          "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  mesh.obstructions = {{1, 2, 0, 4, 0, 3}};
  const auto cells = cell_values(mesh, even(1));
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{0, cells}}));
  const auto vanishes = [&](const std::string& events) {
    c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction) + events);
    const auto made = read_fire_building(c.folder / "case.smv", 0);
    REQUIRE(made.ok());
    return made->tables.text();
  };
  CHECK(tells(vanishes("HIDE_OBST 1\n 1 8.3\nHIDE_OBST 1\n 1 8.0\n"), "vanishes_at = [8]"));
  CHECK(tells(vanishes("HIDE_OBST 1\n 1 8.0\nHIDE_OBST 1\n 1 8.3\n"), "vanishes_at = [8.3]"));
  CHECK(tells(vanishes("HIDE_OBST 1\n 1 8.0\nSHOW_OBST 1\n 1 8.3\nHIDE_OBST 1\n 1 8.1\n"),
              "vanishes_at = [8.1]"));
}

TEST_CASE("files of one species with different mass extinctions are refused", "[format][fds]") {
  SmokeCase c;
  const auto refused = [&](const char* first, const char* second) {
    c.index(smoke_entry(1, "a.s3d", "SOOT DENSITY", first) +
            smoke_entry(1, "b.s3d", "SOOT DENSITY", second));
    return refused_fire(c.read(0));
  };
  CHECK(tells(refused("8700.0", "4350.0"), "the mass extinction of SOOT is 4350 m2/kg here"));
  CHECK(tells(refused("4350.0", "8700.0"), "the mass extinction of SOOT is 8700 m2/kg here"));
  CHECK_FALSE(refused("8700.0", "8700.0").find("the mass extinction") != std::string::npos);
}

TEST_CASE("a colour or an opacity of the index that is no number from 0 to 1 is an error",
          "[format][fds]") {
  SmokeCase c;
  c.meshes[0].obstructions = {{1, 2, 0, 4, 0, 3}};
  const std::string index = index_of_meshes(c.meshes);
  const std::string own = " 1 2 0 4 0 3 -3 0 0.5 0.5 0.5 ";
  const auto read = [&](const std::string& text) {
    c.folder.write("case.smv", text);
    return read_fire_building(c.folder / "case.smv", 0);
  };
  const auto with_own = [&](const std::string& opacity) {
    return read(replaced(index, " 1 2 0 4 0 3 -1 -1", own + opacity));
  };
  CHECK(with_own("0.25").ok());
  CHECK(with_own("").ok());
  for (const char* bad : {"none", "1.5", "-0.1", "nan"}) {
    const auto refused = with_own(bad);
    REQUIRE_FALSE(refused.ok());
    CHECK(tells(refused.problem().text(), "the opacity of an obstruction"));
    CHECK(refused.problem().where.line > 20);
    CHECK(tells(refused.problem().where.file, "case.smv"));
    const auto surface = read(replaced(index, "0.8 0.4 1\n", "0.8 0.4 " + std::string(bad) + "\n"));
    REQUIRE_FALSE(surface.ok());
    CHECK(tells(surface.problem().text(), "the opacity of a surface"));
  }
}

TEST_CASE("a time between frames is in reach where one mesh has fewer frames than another",
          "[format][fds]") {
  SmokeCase c;
  c.meshes = {even_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}),
              even_mesh({1, 0, 0}, {1, 1, 1}, {1, 1, 1})};
  const auto cells = cell_values(c.meshes[0], even(1));
  std::vector<SmallFrame> often, seldom;
  for (int t = 0; t <= 20; ++t) often.push_back({static_cast<float>(t), cells});
  for (int t = 0; t <= 20; t += 10) seldom.push_back({static_cast<float>(t), cells});
  c.folder.write("a.sf", slice_file(c.meshes[0], soot_extinction, often));
  c.folder.write("b.sf", slice_file(c.meshes[1], soot_extinction, seldom));
  c.index(slice_entry(1, true, c.meshes[0], "a.sf", soot_extinction) +
          slice_entry(2, true, c.meshes[1], "b.sf", soot_extinction));
  CHECK(smoke_of(c.read(4)).time_s == 0);
  CHECK(smoke_of(c.read(6)).time_s == 10);
}

TEST_CASE("a mesh that is stretched too much is refused with the limit", "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{0, cell_values(mesh, even(1))}}));
  const auto refused = [&](double thin_m) {
    for (auto& nodes : mesh.nodes) nodes[1] = thin_m;
    c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction));
    return refused_fire(c.read(0));
  };
  CHECK(tells(refused(0.0001), "it would have more than 8192 there"));
  CHECK(tells(refused(0.00131), "and at most 1073741824 are read"));
}

TEST_CASE("optical density counts with 2.3 up to FDS 6.10, and with ln 10 from 6.11 on",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  const char* const label = "SOOT OPTICAL DENSITY";
  c.folder.write("a.sf", slice_file(mesh, label, {{5, cell_values(mesh, even(1))}}));
  for (const auto& [version, factor] : {std::pair{"6.7.6-1538-g1488ab9", 2.3},
                                        {"6.10.1", 2.3},
                                        {"6.11.0", std::log(10)},
                                        {"7.0", std::log(10)},
                                        {"of my own", std::log(10)}}) {
    INFO(version);
    c.index(slice_entry(1, true, mesh, "a.sf", label), version);
    CHECK(largest_difference(smoke_of(c.read(5)), factor) < 1e-6);
  }
}

TEST_CASE("a quantity in another unit than FDS's is refused", "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{5, cell_values(mesh, even(1))}}));
  c.index(replaced(slice_entry(1, true, mesh, "a.sf", soot_extinction), " 1/m", " 1/km"));
  CHECK(tells(refused_fire(c.read(5)), "1/km"));
}

TEST_CASE("a time farther from all frames than these are from each other is refused",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  std::vector<SmallFrame> frames;
  for (const float t : {0.0F, 10.0F, 20.0F, 30.0F, 40.0F, 90.0F, 100.0F})
    frames.push_back({t, cell_values(mesh, even(1))});
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, frames));
  c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction));
  CHECK(smoke_of(c.read(49)).time_s == 40);
  CHECK(tells(refused_fire(c.read(65)), "usually follow each other after 10 s"));
  c.options.between_frames = true;
  CHECK(tells(refused_fire(c.read(65)), "usually follow each other after 10 s"));
}

TEST_CASE("frames that not all meshes have are counted", "[format][fds]") {
  SmokeCase c;
  c.meshes.push_back(even_mesh({2, 0, 0}, {0.5, 0.5, 0.5}, {2, 4, 3}));
  std::string entries;
  for (const size_t m : {0U, 1U}) {
    const SmallMesh& mesh = c.meshes[m];
    std::vector<SmallFrame> frames;
    for (const float t : {0.0F, 10.0F, 20.0F, 30.0F})
      if (m == 0 || t != 10.0F) frames.push_back({t, cell_values(mesh, even(1))});
    const std::string file = std::to_string(m) + ".sf";
    c.folder.write(file, slice_file(mesh, soot_extinction, frames));
    entries += slice_entry(m + 1, true, mesh, file, soot_extinction);
  }
  c.index(entries);
  const LoadedFire fire = smoke_of(c.read(20));
  CHECK(fire.frames == 3);
  CHECK(fire.partial_frames == 1);
}

TEST_CASE("a stretched mesh whose cells are wholes of even cells is read exactly, others are not",
          "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  const auto fire_of = [&](std::vector<double> z) {
    mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 3});
    mesh.nodes[2] = std::move(z);
    const auto at = [](int, int, int k) { return static_cast<float>(k + 1); };
    c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{5, cell_values(mesh, at)}}));
    c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction));
    return smoke_of(c.read(5));
  };
  // 0.4, 0.5 and 0.6 m are wholes of 0.1 m.
  const LoadedFire nested = fire_of({0, 0.4, 0.9, 1.5});
  CHECK(nested.resampled_meshes == 0);
  CHECK(tells(accuracy_words(nested), "exactly"));
  REQUIRE(nested.grids[0].data.nz == 15);
  for (int k = 0; k < 15; ++k)
    CHECK(nested.grids[0].data.extinction[static_cast<size_t>(4 * k)] == Approx(k < 4   ? 1
                                                                                : k < 9 ? 2
                                                                                        : 3)
                                                                             .epsilon(1e-5));
  const LoadedFire blurred = fire_of({0, 0.17, 0.6, 2});
  CHECK(blurred.resampled_meshes == 1);
  CHECK(accuracy_words(blurred).find("exactly") == std::string::npos);
}

TEST_CASE("heat is read from tables with commas in their numbers", "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{5, cell_values(mesh, even(1))}}));
  c.folder.write("h.sf", slice_file(mesh, "HRRPUV", {{5, cell_values(mesh, even(100))}}));
  c.index(slice_entry(1, true, mesh, "a.sf", soot_extinction) +
          slice_entry(1, true, mesh, "h.sf", "HRRPUV"));
  c.folder.write("small_hrr.csv",
                 "s;kW\nTime;HRR\n 0,0000000E+000; 0,0000000E+000\n 1,0E+001; 2,5E+002\n");
  c.options.flames = true;
  CHECK(smoke_of(c.read(5)).heat_release_kw == Approx(125));
}

TEST_CASE("HRRPUV of Smoke3D counts in shares of the range of the index or of the frame",
          "[format][fds]") {
  SmokeCase c;
  const SmallMesh& mesh = c.meshes[0];
  c.folder.write("a.sf", slice_file(mesh, soot_extinction, {{5, cell_values(mesh, even(1))}}));
  c.folder.write("small_hrr.csv", "s,kW\nTime,HRR\n 0.0,0.0\n 10.0,200\n");
  const std::string entries = "HRRPUV_MINMAX\n 0.0 600.0\n" +
                              slice_entry(1, true, mesh, "a.sf", soot_extinction) +
                              smoke_entry(1, "h.s3d", "HRRPUV", "0.000");
  c.index(entries);
  c.options.flames = true;
  const auto burning = node_values(mesh, even(127));
  c.folder.write("h.s3d", smoke3d_file(mesh, {{5, burning}}));
  CHECK(smoke_of(c.read(5)).grids[0].data.emission[0] == Approx(300).epsilon(0.01));
  // Format 1: byte 127 of the range of 600 goes with a highest value of 300.
  c.folder.write("h.s3d", smoke3d_file(mesh, {{5, burning}}, 1));
  const std::string packed = std::to_string(run_lengths(std::vector<uint8_t>(100, 127)).size());
  c.folder.write("h.s3d.sz", " 1\n 5.0 100 " + packed + " 300.0\n");
  CHECK(smoke_of(c.read(5)).grids[0].data.emission[0] == Approx(300).epsilon(0.01));
  c.folder.write("h.s3d", smoke3d_file(mesh, {{5, node_values(mesh, even(254))}}, 1));
  CHECK(smoke_of(c.read(5)).grids[0].data.emission[0] == Approx(300).epsilon(0.01));
  c.folder.write("h.s3d", smoke3d_file(mesh, {{5, node_values(mesh, even(50))}}, 1));
  CHECK(tells(refused_fire(c.read(5)), "different runs"));
}

TEST_CASE("bodies and planes of symmetry that results do not give are named", "[format][fds]") {
  SmokeCase c;
  SmallMesh& mesh = c.meshes[0];
  mesh.openings = {{0, 0, 0, 2, 0, 1.5}};
  c.folder.write("case.smv", "INPF\n my case.fds\n" +
                                 replaced(index_of_meshes(c.meshes), " OPEN\n", " MIRROR\n") +
                                 "GEOM 2\n a.ge\n");
  const auto building = read_fire_building(c.folder / "case.smv", 0);
  REQUIRE(building.ok());
  CHECK(any_tells(building->notes, "2 bodies of triangles (GEOM) are left out"));
  CHECK(any_tells(building->notes, "my case.fds"));
  CHECK(any_tells(building->notes, "MIRROR or PERIODIC"));
  CHECK(building->open_sides.empty());
}

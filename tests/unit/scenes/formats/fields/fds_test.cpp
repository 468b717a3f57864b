// Reading of fire simulations, from cases that the tests write: each kind of file, walls and seams,
// time, and rejected cases.
#include "scenes/formats/fields/fds.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// 4 x 3 x 2 cells of 0.5 m, from (1, 2, 0).
SmallMesh one_mesh() {
  return even_mesh({1, 2, 0}, {0.5, 0.5, 0.5}, {4, 3, 2});
}

/// An extinction that identifies its cell: 1 + i + 10 j + 100 k.
float numbered(int i, int j, int k) {
  return static_cast<float>(1 + i + 10 * j + 100 * k);
}

const char* const extinction_label = "SOOT EXTINCTION COEFFICIENT";

/// A folder with a case of one mesh and one cell-centred slice of extinction at 0 and 10 s.
struct SmallCase {
  TemporaryFolder folder;
  SmallMesh mesh = one_mesh();

  explicit SmallCase(const ValueAt& at = numbered) {
    folder.write("a.sf", slice_file(mesh, extinction_label,
                                    {{0, cell_values(mesh, [](int, int, int) { return 0.0F; })},
                                     {10, cell_values(mesh, at)}}));
    write_index();
  }
  void write_index(const std::string& more = "") const {
    folder.write("case.smv", index_of_meshes({mesh}) +
                                 slice_entry(1, true, mesh, "a.sf", extinction_label) + more);
  }
  Result<LoadedFire> read(double at_s = 10, std::vector<FireSource> sources = {}) const {
    FireOptions options;
    options.at_s = at_s;
    options.sources = std::move(sources);
    return read_fire(folder / "case.smv", options);
  }
};

LoadedFire good_fire(const Result<LoadedFire>& fire) {
  INFO((fire.ok() ? std::string() : fire.problem().text()));
  REQUIRE(fire.ok());
  return fire.value();
}

/// The message for a rejected case.
std::string refusal(const Result<LoadedFire>& fire) {
  REQUIRE_FALSE(fire.ok());
  return fire.problem().text();
}

bool says(const std::string& text, const std::string& words) {
  INFO(text);
  return text.find(words) != std::string::npos;
}

double extinction_at_cell(const LoadedFire& fire, size_t grid, int i, int j, int k) {
  const DataSet& d = fire.grids[grid].data;
  return static_cast<double>(d.extinction[static_cast<size_t>((k * d.ny + j) * d.nx + i)]);
}

}  // namespace

TEST_CASE("a cell-centred slice is read without its ghosts, x fastest, in absolute coordinates",
          "[format][fds]") {
  const LoadedFire fire = good_fire(SmallCase().read());
  REQUIRE(fire.grids.size() == 1);
  const DataSet& d = fire.grids[0].data;
  CHECK(glm::ivec3(d.nx, d.ny, d.nz) == glm::ivec3(4, 3, 2));
  CHECK(glm::length(fire.grids[0].origin - glm::dvec3(1, 2, 0)) < 1e-9);
  CHECK(glm::length(d.extent - glm::dvec3(2, 1.5, 1)) < 1e-9);
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i)
        CHECK(extinction_at_cell(fire, 0, i, j, k) == static_cast<double>(numbered(i, j, k)));
  CHECK(fire.smokes.front().source == FireSource::cell_extinction);
  CHECK(fire.time_s == 10);
  CHECK(fire.first_s == 0);
  CHECK(fire.frames == 2);
  CHECK(fire.cells == 24);
}

TEST_CASE("cells in obstructions have no smoke, whatever a file states there", "[format][fds]") {
  SmallCase small;
  small.mesh.obstructions = {{1, 2, 0, 3, 0, 1}, {3, 3, 0, 3, 0, 2}};  // the second is a plate
  small.write_index();
  const LoadedFire fire = good_fire(small.read());
  for (int j = 0; j < 3; ++j) {
    CHECK(extinction_at_cell(fire, 0, 1, j, 0) == 0);
    CHECK(extinction_at_cell(fire, 0, 0, j, 0) > 0);
    CHECK(extinction_at_cell(fire, 0, 2, j, 0) > 0);
    CHECK(extinction_at_cell(fire, 0, 1, j, 1) > 0);
  }
}

TEST_CASE("obstructions vanish and appear at their times", "[format][fds]") {
  SmallCase small;
  small.mesh.obstructions = {{1, 2, 0, 3, 0, 1}, {2, 3, 0, 3, 0, 1}, {3, 4, 0, 3, 0, 1}};
  small.write_index("HIDE_OBST 1\n 1 9.99\nHIDE_OBST 1\n 2 10.01\nSHOW_OBST 1\n 3 50\n");
  const LoadedFire fire = good_fire(small.read());
  CHECK(extinction_at_cell(fire, 0, 1, 0, 0) > 0);   // has vanished
  CHECK(extinction_at_cell(fire, 0, 2, 0, 0) == 0);  // is still there
  CHECK(extinction_at_cell(fire, 0, 3, 0, 0) > 0);   // will appear
}

TEST_CASE("values at nodes in solids do not affect cells of gas", "[format][fds]") {
  SmallCase small;
  small.mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {4, 1, 1});
  small.mesh.obstructions = {{2, 4, 0, 1, 0, 1}};
  // FDS writes the density of air, 1.195 kg/m3, at nodes wholly inside: an extinction of 10^4.
  small.folder.write("b.sf", slice_file(small.mesh, "SOOT DENSITY",
                                        {{10, node_values(small.mesh, [](int i, int, int) {
                                            return i > 2 ? 1.195F : 1e-4F;
                                          })}}));
  small.folder.write("case.smv", index_of_meshes({small.mesh}) +
                                     slice_entry(1, false, small.mesh, "b.sf", "SOOT DENSITY"));
  const LoadedFire fire = good_fire(small.read());
  CHECK(fire.smokes.front().source == FireSource::node_soot);
  CHECK(extinction_at_cell(fire, 0, 0, 0, 0) == Approx(0.87).epsilon(1e-5));
  CHECK(extinction_at_cell(fire, 0, 1, 0, 0) == Approx(0.87).epsilon(1e-5));
  CHECK(extinction_at_cell(fire, 0, 2, 0, 0) == 0);
  CHECK(extinction_at_cell(fire, 0, 3, 0, 0) == 0);
}

TEST_CASE("the mass extinction is that of FDS unless stated", "[format][fds]") {
  SmallCase small;
  small.write_index(smoke_entry(1, "none.s3d", "SOOT DENSITY", "4350.0"));
  FireOptions options;
  options.at_s = 10;
  options.sources = {FireSource::cell_extinction};
  const auto extinction = [&] {
    const LoadedFire fire = good_fire(read_fire(small.folder / "case.smv", options));
    return extinction_at_cell(fire, 0, 0, 0, 0);
  };
  CHECK(extinction() == 1);
  options.mass_extinction_m2_per_kg = 8700;
  CHECK(extinction() == Approx(2));
}

TEST_CASE("Smoke3D is corrected at walls if the run began without smoke, and not otherwise",
          "[format][fds]") {
  // A closed box of uniform smoke: 0.4 /m in cells of 0.5 x 0.25 x 1 m, a byte of 254 (1 -
  // exp(-0.2)).
  TemporaryFolder folder;
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.25, 1}, {4, 4, 3});
  mesh.openings = {{2, 2, 0, 1, 0, 3}};  // the face x = 2
  const auto byte_of = [](double k) {
    return static_cast<float>(std::round(254 * (1 - std::exp(-k * 0.5))));
  };
  const auto wall_share = [&](int i, int j, int k) {
    double share = 1;
    if (i == 0) share /= 2;
    if (j == 0 || j == 4) share /= 2;
    if (k == 0 || k == 3) share /= 2;
    return share;
  };
  const auto clear = node_values(mesh, [](int, int, int) { return 0.0F; });
  const auto at_walls = node_values(mesh, [&](int i, int j, int k) {
    return std::round(254 * (1 - std::exp(-0.4F * 0.5F * static_cast<float>(wall_share(i, j, k)))));
  });
  folder.write("case.smv", index_of_meshes({mesh}) + smoke_entry(1, "a.s3d", "SOOT DENSITY"));
  FireOptions options;
  options.at_s = 5;
  folder.write("a.s3d", smoke3d_file(mesh, {{0, clear}, {5, at_walls}}));
  const LoadedFire corrected = good_fire(read_fire(folder / "case.smv", options));
  CHECK(corrected.smokes.front().source == FireSource::smoke3d);
  for (const float v : corrected.grids[0].data.extinction) CHECK(v == Approx(0.4).epsilon(0.07));
  // It began with smoke: nodes at walls already have the full value.
  const auto even = node_values(mesh, [&](int, int, int) { return byte_of(0.4); });
  folder.write("a.s3d", smoke3d_file(mesh, {{0, even}, {5, even}}));
  const LoadedFire raw = good_fire(read_fire(folder / "case.smv", options));
  for (const float v : raw.grids[0].data.extinction) CHECK(v == Approx(0.4).epsilon(0.02));
}

TEST_CASE("meshes on one lattice become one grid, and each point has its own mesh's smoke",
          "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh left = even_mesh({-1, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const SmallMesh right = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const SmallMesh fine = even_mesh({1, 0, 0}, {0.25, 0.25, 0.25}, {4, 4, 4});
  const std::vector<SmallMesh> meshes{left, right, fine};
  std::string entries;
  for (size_t m = 0; m < 3; ++m) {
    const std::string name = std::to_string(m) + ".sf";
    folder.write(name, slice_file(meshes[m], extinction_label,
                                  {{1, cell_values(meshes[m], [&](int, int, int) {
                                      return static_cast<float>(m + 1);
                                    })}}));
    entries += slice_entry(m + 1, true, meshes[m], name, extinction_label);
  }
  folder.write("case.smv", index_of_meshes(meshes) + entries);
  FireOptions options;
  options.at_s = 1;
  const LoadedFire fire = good_fire(read_fire(folder / "case.smv", options));
  REQUIRE(fire.grids.size() == 2);
  CHECK(fire.grids[0].data.nx == 4);
  for (int i = 0; i < 4; ++i) CHECK(extinction_at_cell(fire, 0, i, 1, 1) == (i < 2 ? 1 : 2));
  CHECK(fire.grids[1].data.nx == 4);
  CHECK(fire.grids[1].origin.x == 1);
  CHECK(extinction_at_cell(fire, 1, 0, 0, 0) == 3);
  CHECK(fire.meshes.size() == 3);
}

TEST_CASE("where meshes overlap the first is used, and no smoke counts twice", "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh first = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const SmallMesh second = even_mesh({0.5, 0, 0}, {0.5, 0.5, 0.5}, {3, 2, 2});
  std::string entries;
  for (const auto& [m, mesh] : {std::pair{1, first}, {2, second}}) {
    const std::string name = std::to_string(m) + ".sf";
    folder.write(name,
                 slice_file(mesh, extinction_label, {{1, cell_values(mesh, [m = m](int, int, int) {
                                                        return static_cast<float>(m);
                                                      })}}));
    entries += slice_entry(static_cast<size_t>(m), true, mesh, name, extinction_label);
  }
  folder.write("case.smv", index_of_meshes({first, second}) + entries);
  FireOptions options;
  options.at_s = 1;
  const LoadedFire fire = good_fire(read_fire(folder / "case.smv", options));
  REQUIRE(fire.grids.size() == 1);
  CHECK(fire.overlapping);
  for (int i = 0; i < 4; ++i) CHECK(extinction_at_cell(fire, 0, i, 0, 0) == (i < 2 ? 1 : 2));
}

TEST_CASE("a stretched mesh keeps its integral and its optical depths across cells",
          "[format][fds]") {
  TemporaryFolder folder;
  SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 3});
  mesh.nodes[2] = {0, 0.17, 0.6, 2};
  const auto at = [](int, int, int k) { return static_cast<float>(k + 1); };
  folder.write("a.sf", slice_file(mesh, extinction_label, {{1, cell_values(mesh, at)}}));
  folder.write("case.smv",
               index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", extinction_label));
  FireOptions options;
  options.at_s = 1;
  const LoadedFire fire = good_fire(read_fire(folder / "case.smv", options));
  CHECK(fire.resampled_meshes == 1);
  const DataSet& d = fire.grids[0].data;
  double along_z = 0;
  for (int k = 0; k < d.nz; ++k) along_z += extinction_at_cell(fire, 0, 0, 0, k) * 2 / d.nz;
  CHECK(along_z == Approx(1 * 0.17 + 2 * 0.43 + 3 * 1.4).epsilon(1e-6));
  CHECK(d.nz >= 20);
}

TEST_CASE("the frame nearest to the time is used, and a time beyond the results is rejected",
          "[format][fds]") {
  const SmallCase small;
  CHECK(good_fire(small.read(4)).time_s == 0);
  CHECK(good_fire(small.read(6)).time_s == 10);
  CHECK(good_fire(small.read(10.9)).time_s == 10);
  CHECK(says(refusal(small.read(12)), "there is no frame near 12 s"));
  CHECK(says(refusal(small.read(-2)), "there is no frame near -2 s"));
}

TEST_CASE("between two frames smoke is interpolated on request, and a frame's time gives the frame",
          "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 1, 1});
  const auto of = [&](float a, float b) {
    return cell_values(mesh, [=](int i, int, int) { return i == 0 ? a : b; });
  };
  folder.write("a.sf", slice_file(mesh, extinction_label,
                                  {{0, of(0, 0)}, {10.02F, of(1, 0)}, {20, of(2, 4)}}));
  folder.write("case.smv",
               index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", extinction_label));
  const auto at = [&](double at_s, bool between = true) {
    FireOptions options;
    options.at_s = at_s;
    options.between_frames = between;
    return good_fire(read_fire(folder / "case.smv", options));
  };
  const LoadedFire fire = at(15.01);
  CHECK(fire.between_frames);
  CHECK(fire.time_s == Approx(15.01));
  CHECK(fire.previous_s.value_or(0) == Approx(10.02));
  CHECK(fire.next_s == 20);
  CHECK(fire.grids[0].data.extinction[0] == Approx(1.5));
  CHECK(fire.grids[0].data.extinction[1] == Approx(2));
  // The nearer frame may be the later one.
  CHECK(at(18.004).grids[0].data.extinction[1] == Approx(3.2));
  // FDS writes the tick of 10 s at its next step.
  CHECK_FALSE(at(10).between_frames);
  CHECK(at(10).grids[0].data.extinction[0] == 1);
  CHECK_FALSE(at(15.01, false).between_frames);
  CHECK_FALSE(at(20.5).between_frames);
  CHECK(at(20.5).time_s == 20);
  CHECK_FALSE(at(-0.5).between_frames);
}

TEST_CASE("between frames, the source whose two frames are nearest to the time is used",
          "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 1, 1});
  const auto even = [](float value) { return [value](int, int, int) { return value; }; };
  const auto cells = cell_values(mesh, even(1));
  folder.write("a.sf",
               slice_file(mesh, extinction_label, {{0, cells}, {10.02F, cells}, {100, cells}}));
  folder.write("s.s3d", smoke3d_file(mesh, {{9, node_values(mesh, even(100))},
                                            {14, node_values(mesh, even(100))}}));
  folder.write("case.smv", index_of_meshes({mesh}) +
                               slice_entry(1, true, mesh, "a.sf", extinction_label) +
                               smoke_entry(1, "s.s3d", "SOOT DENSITY"));
  const auto source_at = [&](double at_s, bool between) {
    FireOptions options;
    options.at_s = at_s;
    options.between_frames = between;
    return good_fire(read_fire(folder / "case.smv", options)).smokes.front().source;
  };
  CHECK(source_at(11.5, false) == FireSource::cell_extinction);
  CHECK(source_at(11.5, true) == FireSource::smoke3d);
  // A frame within a second is not enough if the other one is far; one at the time is.
  CHECK(source_at(10.5, false) == FireSource::cell_extinction);
  CHECK(source_at(10.5, true) == FireSource::smoke3d);
  CHECK(source_at(10, true) == FireSource::cell_extinction);
}

TEST_CASE("a tick written twice, after a restart, is one frame for interpolation",
          "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const auto of = [&](float value) {
    return cell_values(mesh, [=](int, int, int) { return value; });
  };
  folder.write("a.sf", slice_file(mesh, extinction_label,
                                  {{0, of(0)}, {10, of(1)}, {10.004F, of(1)}, {20, of(2)}}));
  folder.write("case.smv",
               index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", extinction_label));
  for (const double at_s : {6.0, 14.0, 16.0}) {
    FireOptions options;
    options.at_s = at_s;
    options.between_frames = true;
    const LoadedFire fire = good_fire(read_fire(folder / "case.smv", options));
    CHECK(fire.between_frames);
    CHECK(fire.grids[0].data.extinction[0] == Approx(at_s / 10).epsilon(1e-3));
  }
}

TEST_CASE("a file of a run in progress is read up to its last whole frame", "[format][fds]") {
  const SmallCase small;
  const std::string whole =
      slice_file(small.mesh, extinction_label,
                 {{0, cell_values(small.mesh, numbered)}, {10, cell_values(small.mesh, numbered)}});
  for (const size_t cut : {size_t{1}, size_t{4}, size_t{100}, size_t{240}}) {
    small.folder.write("a.sf", whole.substr(0, whole.size() - cut));
    const LoadedFire fire = good_fire(small.read(0));
    CHECK(fire.frames == 1);
    CHECK(says(refusal(small.read(10)), "reach from 0 to 0 s"));
  }
}

TEST_CASE("only frames that all meshes have are counted", "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh a = even_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const SmallMesh b = even_mesh({1, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const auto one = cell_values(a, [](int, int, int) { return 1.0F; });
  folder.write("a.sf", slice_file(a, extinction_label, {{0, one}, {5, one}, {10, one}}));
  folder.write("b.sf", slice_file(b, extinction_label, {{0, one}, {5, one}}));
  folder.write("case.smv", index_of_meshes({a, b}) +
                               slice_entry(1, true, a, "a.sf", extinction_label) +
                               slice_entry(2, true, b, "b.sf", extinction_label));
  FireOptions options;
  options.at_s = 5;
  const LoadedFire fire = good_fire(read_fire(folder / "case.smv", options));
  CHECK(fire.frames == 2);
  CHECK(fire.last_s == 5);
}

TEST_CASE("a fire without soot in any frame is an error, one before its smoke is not",
          "[format][fds]") {
  CHECK(good_fire(SmallCase().read(0)).time_s == 0);
  const SmallCase none([](int, int, int) { return 0.0F; });
  CHECK(says(refusal(none.read()), "SOOT_YIELD is not set"));
}

TEST_CASE("flames have their share of the heat, and their own soot is removed", "[format][fds]") {
  SmallCase small;
  small.folder.write("h.s3d",
                     smoke3d_file(small.mesh, {{10, node_values(small.mesh, [](int i, int, int) {
                                                  return i < 2 ? 254.0F : 0.0F;
                                                })}}));
  small.folder.write("small_hrr.csv", "s,kW\nTime,HRR\n 0.0,0.0\n 20.0,3.0E+002\n");
  small.write_index(smoke_entry(1, "h.s3d", "HRRPUV", "0.000"));
  FireOptions options;
  options.at_s = 10;
  options.flames = true;
  const LoadedFire fire = good_fire(read_fire(small.folder / "case.smv", options));
  CHECK(fire.grids[0].heat_kw == Approx(150));
  CHECK(extinction_at_cell(fire, 0, 0, 0, 0) == 0);
  CHECK(extinction_at_cell(fire, 0, 3, 0, 0) == 4);
  CHECK(fire.grids[0].data.emission[0] > 1200);  // the blur of nodes is undone
  CHECK(fire.grids[0].data.emission[3] == 0);
  CHECK(fire.flame_extinction_share > 0.1);
  // Without flames the smoke stays.
  options.flames = false;
  const LoadedFire smoke = good_fire(read_fire(small.folder / "case.smv", options));
  CHECK(smoke.has_heat_release);
  CHECK(smoke.grids[0].data.emission.empty());
  CHECK(extinction_at_cell(smoke, 0, 0, 0, 0) == 1);
}

TEST_CASE("flames without HRRPUV, or at a time without heat release, are rejected",
          "[format][fds]") {
  SmallCase small;
  FireOptions options;
  options.at_s = 10;
  options.flames = true;
  CHECK(says(refusal(read_fire(small.folder / "case.smv", options)), "HRRPUV"));
  const auto burning = node_values(small.mesh, [](int, int, int) { return 200.0F; });
  small.folder.write("h.s3d", smoke3d_file(small.mesh, {{10, burning}}));
  small.write_index(smoke_entry(1, "h.s3d", "HRRPUV", "0.000"));
  struct Row {
    const char* table;
    const char* says;
  };
  for (const Row& row :
       {Row{"s,kW\nTime,HRR\n 0.0,0.0\n 5.0,1\n", "ends at 5 s"},
        Row{"s,kW\nTime,Q\n 0.0,0.0\n", "no columns Time and HRR"},
        Row{"s,kW\nTime,HRR\n 0.0,0.0\n 20.0,abc\n", "small_hrr.csv:4"}, Row{"", "ends at 0 s"}}) {
    small.folder.write("small_hrr.csv", row.table);
    CHECK(says(refusal(read_fire(small.folder / "case.smv", options)), row.says));
  }
}

TEST_CASE("mistakes in an index are reported with their line", "[format][fds]") {
  const SmallCase small;
  const std::string whole =
      index_of_meshes({small.mesh}) + slice_entry(1, true, small.mesh, "a.sf", extinction_label);
  struct Row {
    const char* about;
    std::string index;
    const char* says;
  };
  const Row rows[] = {
      {"no index", "hello\n", "no mesh (GRID)"},
      {"an empty file", "", "no mesh (GRID)"},
      {"a file that leaves the folder", replaced(whole, " a.sf", " ../a.sf"), "folder"},
      {"an absolute path", replaced(whole, " a.sf", " /etc/passwd"), "folder"},
      {"a path that goes up later", replaced(whole, " a.sf", " x/../../a.sf"), "folder"},
      {"no such mesh", replaced(whole, "SLCC 1", "SLCC 2"), "mesh 2"},
      {"mesh 0", replaced(whole, "SLCC 1", "SLCC 0"), "mesh 0"},
      {"no number", replaced(whole, "SLCC 1", "SLCC x"), "no number"},
      {"cells without end", replaced(whole, " 4 3 2 0", " 4 3 99999 0"), "99999 cells"},
      {"no cells", replaced(whole, " 4 3 2 0", " 4 0 2 0"), "0 cells"},
      {"too many cells", replaced(whole, " 4 3 2 0", " 8192 8192 8192 0"), "at most"},
      {"nodes that fall", replaced(whole, "1.50000", "0.50000"), "do not ascend"},
      {"nodes that are none", replaced(whole, "1.50000", "nan"), "not finite"},
      {"other results", replaced(whole, " 0 4 0 3", " 0 3 0 3"), "whole frame"},
      {"more obstructions than lines", replaced(whole, "OBST\n 0", "OBST\n 1000000"), "announced"},
      {"fewer than none", replaced(whole, "OBST\n 0", "OBST\n -1"), "announced"},
      {"cut off in its nodes", whole.substr(0, whole.find("TRNZ") + 20), "ends in the middle"},
  };
  for (const Row& row : rows) {
    INFO(row.about);
    small.folder.write("case.smv", row.index);
    const auto fire = small.read();
    CHECK(says(refusal(fire), row.says));
    CHECK(fire.problem().where.file == (small.folder / "case.smv").string());
  }
}

TEST_CASE("results that are damaged, of another mesh or in another folder are rejected",
          "[format][fds]") {
  const SmallCase small;
  const std::string whole =
      slice_file(small.mesh, extinction_label, {{10, cell_values(small.mesh, numbered)}});
  const auto harmed = [&](size_t at, char byte) {
    std::string bytes = whole;
    bytes[at] = byte;
    return bytes;
  };
  const size_t head = 3 * 38 + 32;
  struct Row {
    const char* about;
    std::string bytes;
    const char* says;
  };
  std::string negative = whole, no_number = whole;
  const float minus = -1, nan = std::nanf("");
  std::memcpy(negative.data() + whole.size() - 8, &minus, 4);
  std::memcpy(no_number.data() + whole.size() - 8, &nan, 4);
  const Row rows[] = {
      {"an empty file", "", "ends too early"},
      {"another length of a label", harmed(0, 31), "30 bytes was expected"},
      {"another end of a label", harmed(34, 31), "30 bytes was expected"},
      {"another range", harmed(3 * 38 + 8, 9), "not the one"},
      {"another length of a time", harmed(head, 5), "4 bytes was expected"},
      {"another length of a frame", harmed(head + 12, 1), "bytes was expected"},
      {"a value below zero", negative, "negative"},
      {"a value that is none", no_number, "no number"},
  };
  for (const Row& row : rows) {
    INFO(row.about);
    small.folder.write("a.sf", row.bytes);
    const auto fire = small.read();
    CHECK(says(refusal(fire), row.says));
    CHECK(fire.problem().where.file == (small.folder / "a.sf").string());
  }
  const TemporaryFolder elsewhere;
  elsewhere.write("b.sf", whole);
  std::filesystem::remove(small.folder / "a.sf");
  CHECK(says(refusal(small.read()), "cannot be read"));
  std::filesystem::create_symlink(elsewhere / "b.sf", small.folder / "a.sf");
  CHECK(says(refusal(small.read()), "not in the folder"));
}

TEST_CASE("Smoke3D that does not unpack to its mesh is rejected", "[format][fds]") {
  TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  folder.write("case.smv", index_of_meshes({mesh}) + smoke_entry(1, "a.s3d", "SOOT DENSITY"));
  const std::string head = fortran_record(bytes_of_values<int32_t>({1, 0, 0, 3, 0, 3, 0, 3}));
  const auto frame = [](int32_t nodes, const std::string& packed,
                        std::optional<int32_t> said = {}) {
    return fortran_record(bytes_of_values<float>({1})) +
           fortran_record(bytes_of_values<int32_t>(
               {nodes, said.value_or(static_cast<int32_t>(packed.size()))})) +
           fortran_record(packed);
  };
  struct Row {
    const char* about;
    std::string bytes;
    const char* says;
  };
  const Row rows[] = {
      {"too few", head + frame(64, {'\xff', '\x05', '\x3f'}), "does not unpack"},
      {"too many", head + frame(64, {'\xff', '\x05', '\x41'}), "does not unpack"},
      {"a run that is cut off", head + frame(64, {'\xff', '\x05'}), "does not unpack"},
      {"another count of nodes", head + frame(65, {'\xff', '\x05', '\x40'}), "64 nodes"},
      {"less than none", head + frame(64, "", -5), "-5 bytes"},
      {"more bytes than a frame can have", head + frame(64, "x", 1000), "64 nodes"},
      {"bytes beyond the end", head + frame(64, "x", 190), "whole frame"},
      {"of another mesh", fortran_record(bytes_of_values<int32_t>({1, 0, 0, 4, 0, 3, 0, 3})),
       "3 x 3 x 3"},
  };
  FireOptions options;
  options.at_s = 1;
  for (const Row& row : rows) {
    INFO(row.about);
    folder.write("a.s3d", row.bytes);
    CHECK(says(refusal(read_fire(folder / "case.smv", options)), row.says));
  }
  folder.write("a.s3d", head + frame(64, {'\xff', '\x05', '\x40'}));
  CHECK(good_fire(read_fire(folder / "case.smv", options)).frames == 1);
}

TEST_CASE("the unread content of a case is named if there is nothing else", "[format][fds]") {
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  folder.write("fire.smv",
               index_of_meshes({mesh}) +
                   "SLCT 1 # TERRAIN 2.0 & 0 2 0 2 1 1 ! 1\n t.sf\n SOOT DENSITY\n s\n kg/m3\n" +
                   smoke_entry(1, "s.s16", "SOOT DENSITY"));
  const auto read = read_fire(folder / "fire.smv", {});
  REQUIRE_FALSE(read.ok());
  CHECK_THAT(read.problem().text(),
             Catch::Contains("(SLCT) and Smoke3D of 16 bits (.s16) are not read") &&
                 Catch::Contains("add &SLCF XB=..., QUANTITY='EXTINCTION COEFFICIENT'"));
}

TEST_CASE("a slice of part of a mesh is not a source", "[format][fds]") {
  SmallCase small;
  small.folder.write(
      "case.smv",
      index_of_meshes({small.mesh}) +
          replaced(slice_entry(1, true, small.mesh, "a.sf", extinction_label), "& 0 4", "& 1 4"));
  CHECK(says(refusal(small.read()), "no cell-centred 3-D slice of extinction"));
}

// Grids of OpenVDB files, written here with OpenVDB, as even cells.
#include "scenes/formats/vdb/vdb.hpp"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <vector>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/vdb/vdb_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;
using openvdb::Coord;

namespace {

const VdbProgram vdb_program{LUX_VDB_PROGRAM};

std::string vdb_refusal(const openvdb::GridPtrVec& grids, const std::string& name = "density") {
  const TemporaryFolder folder;
  const auto smoke = read_vdb(written_grids(folder, grids), name, UpAxis::z, vdb_program);
  return smoke ? "read" : smoke.problem().what;
}

void check_near(const glm::dvec3& is, const glm::dvec3& wanted) {
  INFO(is.x << " " << is.y << " " << is.z);
  CHECK(glm::length(is - wanted) < 1e-9);
}

}  // namespace

TEST_CASE("a grid becomes cells at their places in the file, and an index is the centre of a cell",
          "[vdb]") {
  const TemporaryFolder folder;
  const auto smoke = read_vdb(written_grids(folder, {fog()}), "density", UpAxis::z, vdb_program);
  if (!smoke) FAIL(smoke.problem().text());
  CHECK((smoke->nx == 3 && smoke->ny == 3 && smoke->nz == 3));
  check_near(smoke->spacing, {0.5, 0.25, 0.125});
  check_near(smoke->origin, {10 + 0.5 * 1.5, 20 + 0.25 * -1.5, 30 + 0.125 * 3.5});
  const auto at = [&](size_t x, size_t y, size_t z) { return smoke->values[x + 3 * (y + 3 * z)]; };
  CHECK((at(0, 0, 0) == 1 && at(2, 1, 0) == 2 && at(1, 2, 2) == 3));
  CHECK(std::count(smoke->values.begin(), smoke->values.end(), 0.0F) == 24);
}

TEST_CASE("a grid whose y is up is rotated to the z axis of the scene", "[vdb]") {
  const TemporaryFolder folder;
  const auto path = written_grids(folder, {fog()});
  const auto lying = read_vdb(path, "density", UpAxis::z, vdb_program);
  const auto stood = read_vdb(path, "density", UpAxis::y, vdb_program);
  REQUIRE((lying.ok() && stood.ok()));
  const auto middle = [](const VdbSmoke& s, float value) {
    const auto i = static_cast<uint64_t>(std::find(s.values.begin(), s.values.end(), value) -
                                         s.values.begin());
    const glm::dvec3 index(i % s.nx, i / s.nx % s.ny, i / s.nx / s.ny);
    return s.origin + s.spacing * (index + 0.5);
  };
  for (const float value : {1.0F, 2.0F, 3.0F}) {
    const glm::dvec3 in_file = middle(lying.value(), value);
    check_near(middle(stood.value(), value), {in_file.x, -in_file.z, in_file.y});
  }
}

TEST_CASE("blocks stored as one value become cells", "[vdb]") {
  auto grid = fog();
  grid->clear();
  grid->fill(openvdb::CoordBBox(Coord(0), Coord(15)), 0.5F);
  const TemporaryFolder folder;
  const auto smoke = read_vdb(written_grids(folder, {grid}), "density", UpAxis::z, vdb_program);
  REQUIRE(smoke.ok());
  CHECK(smoke->values == std::vector<float>(4096, 0.5F));
}

TEST_CASE("reading a grid reports its progress, up to the end", "[vdb]") {
  auto grid = fog();
  grid->fill(openvdb::CoordBBox(Coord(0), Coord(7, 7, 200)), 0.5F);
  const TemporaryFolder folder;
  std::vector<double> heard;
  const VdbProgram telling{vdb_program.path, [&](double share) { heard.push_back(share); }};
  REQUIRE(read_vdb(written_grids(folder, {grid}), "density", UpAxis::z, telling).ok());
  REQUIRE_FALSE(heard.empty());
  CHECK(std::is_sorted(heard.begin(), heard.end()));
  CHECK(heard.back() == 1);
}

TEST_CASE("the grids of a file are listed, with those that cannot be read and why", "[vdb]") {
  auto surface = fog("surface");
  surface->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto wind = openvdb::Vec3SGrid::create();
  wind->setName("wind");
  const TemporaryFolder folder;
  const auto grids = list_vdb(written_grids(folder, {fog(), surface, wind}), vdb_program);
  if (!grids) FAIL(grids.problem().text());
  REQUIRE(grids->size() == 3);
  for (const VdbGrid& grid : grids.value()) {
    if (grid.name == "density") {
      CHECK((grid.type == "float" && grid.kind == "fog volume" && grid.cells == 3));
      CHECK(grid.fault.empty());
    } else {
      CHECK_THAT(grid.fault, Contains(grid.name == "wind" ? "\"vec3s\"" : "level set"));
    }
  }
}

TEST_CASE("a grid that is not smoke in even cells is rejected with a remedy", "[vdb]") {
  CHECK_THAT(vdb_refusal({fog()}, "smoke"),
             Contains("no grid \"smoke\" in it; there are \"density\""));
  auto grid = fog();
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  CHECK_THAT(vdb_refusal({grid}), Contains("level set"));
  const auto whole = openvdb::Int32Grid::create();
  whole->setName("density");
  CHECK_THAT(vdb_refusal({whole}), Contains("\"int32\"; floats are read"));
  CHECK_THAT(vdb_refusal({fog("density", 0.1F)}), Contains("background"));
  grid = fog();
  grid->clear();
  CHECK_THAT(vdb_refusal({grid}), Contains("no values"));
  grid = fog();
  grid->transform().preRotate(0.3, openvdb::math::Z_AXIS);
  CHECK_THAT(vdb_refusal({grid}), Contains("turned, mirrored or bent"));
  grid = fog();
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 2.0));
  CHECK_THAT(vdb_refusal({grid}), Contains("turned, mirrored or bent"));
  grid = fog();
  grid->getAccessor().setValue(Coord(1'000'000, 0, 0), 1.0F);
  grid->getAccessor().setValue(Coord(0, 1000, 0), 1.0F);
  CHECK_THAT(vdb_refusal({grid}), Contains("crop the grid"));
  grid = fog();
  grid->getAccessor().setValue(Coord(-2'000'000'000, 0, 5), 1.0F);
  grid->getAccessor().setValue(Coord(2'000'000'000, 0, 5), 1.0F);
  CHECK_THAT(vdb_refusal({grid}), Contains("has 4000000001 x 3 x 3 cells"));
  for (const float wrong : {-1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    grid = fog();
    grid->getAccessor().setValue(Coord(3, 0, 5), wrong);
    CHECK_THAT(vdb_refusal({grid}), Contains("index (3, 0, 5) is negative or no number"));
  }
}

TEST_CASE("a missing file, another file and a missing program are errors that name the file",
          "[vdb]") {
  const TemporaryFolder folder;
  const auto other = list_vdb(folder.write("a.vdb", "hello, this is no such file"), vdb_program);
  REQUIRE_FALSE(other.ok());
  CHECK(other.problem().where.file == (folder / "a.vdb").string());
  CHECK_THAT(list_vdb(folder / "b.vdb", vdb_program).problem().what, Contains("no such file"));
  const auto none = list_vdb(folder / "a.vdb", {folder / "luxodus_vdb"});
  REQUIRE_FALSE(none.ok());
  CHECK_THAT(none.problem().what, Contains("apt-get install libopenvdb-dev"));
}

TEST_CASE("a file of another program is read", "[vdb]") {
  const std::filesystem::path file =
      std::filesystem::path(LUX_SHARED_DATA) / "vdb/smoke_layer_own.vdb";
  if (!std::filesystem::is_regular_file(file)) {
    WARN("skipped: the measured file is not there (" << file.string() << ")");
    return;
  }
  const auto smoke = read_vdb(file, "density", UpAxis::z, vdb_program);
  if (!smoke) FAIL(smoke.problem().text());
  CHECK((smoke->nx == 64 && smoke->ny == 42 && smoke->nz == 9));
  check_near(smoke->spacing, glm::dvec3(0.1875));
  check_near(smoke->origin, {0, 0, 7 * 0.1875});
  CHECK(std::count_if(smoke->values.begin(), smoke->values.end(), [](float v) { return v > 0; }) ==
        20'076);
}

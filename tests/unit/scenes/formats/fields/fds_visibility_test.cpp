// Slices of VISIBILITY, flat and solid, of nodes and of cells.
#include "scenes/formats/fields/fds_visibility.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr const char* label = "SOOT VISIBILITY";

FireVisibility at_time(const TemporaryFolder& folder, double time_s) {
  auto read = read_visibility(folder / "fire.smv", time_s);
  if (!read) FAIL(read.problem().text());
  REQUIRE(read.value());
  return std::move(*read.value());
}

}  // namespace

TEST_CASE("a flat slice of visibility has values near its plane, at times with frames",
          "[fds][visibility]") {
  const TemporaryFolder folder;
  // 4 x 2 x 3 m; a slice at 2 m that rises by 1 m a metre along x, and by 10 m along y.
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 0.5}, {4, 2, 6});
  std::vector<float> values;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 4; ++i) values.push_back(static_cast<float>(i + 10 * j));
  const std::array<int32_t, 6> nodes{0, 4, 0, 2, 4, 4};
  const std::vector<float> clear(values.size(), 30);
  folder.write("v.sf", part_slice_file(nodes, label, {{0, clear}, {30.02F, values}}));
  folder.write("fire.smv",
               index_of_meshes({mesh}) + part_slice_entry(1, false, nodes, "v.sf", label));
  const FireVisibility v = at_time(folder, 30);
  CHECK(v.at({2.5, 0, 2}) == Approx(2.5));
  CHECK(v.at({1, 1.25, 2.4}) == Approx(13.5));
  CHECK(v.at({4, 2, 1.6}) == Approx(24));
  CHECK_FALSE(v.at({1, 1, 1}));    // 1 m below the slice
  CHECK_FALSE(v.at({4.1, 1, 2}));  // outside of the mesh
  CHECK(at_time(folder, 0).at({1, 1, 2}) == Approx(30));
  const auto between = read_visibility(folder / "fire.smv", 15);
  REQUIRE(between.ok());
  CHECK_FALSE(between.value());
}

TEST_CASE("in slices of cells a place has the value of its cell, of the nearest slice",
          "[fds][visibility]") {
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {3, 2, 2});
  const auto cells = cell_values(
      mesh, [](int i, int j, int k) { return static_cast<float>(1 + i + 4 * j + 8 * k); });
  // Flat, in the upper layer of cells, which lies at 1.5 m.
  const std::array<int32_t, 6> upper{0, 3, 0, 2, 2, 2};
  std::vector<float> flat;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 3; ++i) flat.push_back(i == 0 || j == 0 ? 99.0F : 20.0F);
  folder.write("c.sf", slice_file(mesh, label, {{0, cells}}));
  folder.write("f.sf", part_slice_file(upper, label, {{0, flat}}));
  folder.write("solid.smv", index_of_meshes({mesh}) + slice_entry(1, true, mesh, "c.sf", label));
  const auto solid = read_visibility(folder / "solid.smv", 0);
  REQUIRE(solid.ok());
  REQUIRE(solid.value());
  CHECK(solid.value()->at({0.1, 0.9, 0.5}) == Approx(1));
  CHECK(solid.value()->at({2.5, 1.5, 1.5}) == Approx(15));
  folder.write("fire.smv",
               index_of_meshes({mesh}) + part_slice_entry(1, true, upper, "f.sf", label));
  const FireVisibility v = at_time(folder, 0);
  CHECK(v.at({0.1, 0.1, 1.5}) == Approx(20));
  CHECK(v.at({2.9, 1.9, 1.1}) == Approx(20));
  CHECK_FALSE(v.at({1, 1, 0.5}));
}

TEST_CASE("a case without slices of visibility has none, and damaged ones are rejected",
          "[fds][visibility]") {
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  folder.write("fire.smv", index_of_meshes({mesh}));
  const auto none = read_visibility(folder / "fire.smv", 0);
  REQUIRE(none.ok());
  CHECK_FALSE(none.value());
  const auto refused = [&](const std::array<int32_t, 6>& nodes, const std::string& bytes) {
    folder.write("v.sf", bytes);
    folder.write("fire.smv",
                 index_of_meshes({mesh}) + part_slice_entry(1, false, nodes, "v.sf", label));
    const auto read = read_visibility(folder / "fire.smv", 0);
    return read ? std::string() : read.problem().text();
  };
  const std::array<int32_t, 6> level{0, 2, 0, 2, 1, 1}, beyond{0, 2, 0, 2, 7, 7};
  const std::vector<float> nine(9, 5), bad(9, -1);
  CHECK(refused(level, part_slice_file(level, label, {{0, nine}})).empty());
  CHECK(refused(beyond, part_slice_file(beyond, label, {{0, nine}})).find("mesh") !=
        std::string::npos);
  CHECK(refused(level, part_slice_file(level, label, {{0, bad}})).find("negative") !=
        std::string::npos);
  CHECK_FALSE(refused(level, "short").empty());
}

TEST_CASE("FDS's slices of visibility are those of its extinction", "[fds][visibility]") {
  const std::filesystem::path index =
      std::filesystem::path(LUX_SHARED_DATA) / "fds_results/corridor/corridor.smv";
  if (!std::filesystem::exists(index)) {
    WARN("skipped: the results of FDS are not there (" << index.string() << ")");
    return;
  }
  const auto fire = fds::read_case(index);
  REQUIRE(fire.ok());
  REQUIRE_FALSE(fire->visibility.empty());
  const auto extinction =
      std::find_if(fire->slices.begin(), fire->slices.end(), [](const fds::Slice& s) {
        return s.mesh == 0 && !s.of_cells && s.output.quantity == fds::Quantity::extinction;
      });
  REQUIRE(extinction != fire->slices.end());
  const auto files = fds::open_slice(fire.value(), *extinction);
  REQUIRE(files.ok());
  const fds::Frame& frame = files->frames.at(2);
  const auto k = fds::read_values(files.value(), frame);
  REQUIRE(k.ok());
  const auto v = read_visibility(index, frame.time_s);
  REQUIRE(v.ok());
  REQUIRE(v.value());
  // Node values are means over cells; 3 / K of a mean is at most the mean of 3 / K, where the cap
  // of 30 m is not reached.
  const fds::Mesh& mesh = fire->meshes[0];
  const glm::ivec3 n = mesh.node_counts();
  std::vector<double> ratios;
  for (int z = 1; z + 1 < n.z; ++z)
    for (int x = 1; x + 1 < n.x; ++x) {
      const int y = 6;  // at 1.2 m
      const double extinct =
          static_cast<double>(k.value()[static_cast<size_t>((z * n.y + y) * n.x + x)]);
      const auto metres = v.value()->at({mesh.nodes[0][static_cast<size_t>(x)],
                                         mesh.nodes[1][static_cast<size_t>(y)],
                                         mesh.nodes[2][static_cast<size_t>(z)]});
      REQUIRE(metres);
      CHECK((*metres >= 0 && *metres <= 30.001));
      if (*metres < 10 && extinct > 0) ratios.push_back(*metres * extinct / 3);
    }
  REQUIRE(ratios.size() > 50);
  std::sort(ratios.begin(), ratios.end());
  CHECK(ratios.front() > 0.99);
  CHECK(ratios[ratios.size() / 2] == Approx(1).epsilon(0.1));
}

#include "scenes/light/transport/cell_object.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr CellLimits limits_of_scene{4, 1000};

GeometryCell some_cell() {
  Random random(9, RandomStream::test);
  random.start(0);
  GeometryCell cell;
  for (uint32_t i = 0; i < 40; ++i) {
    TriangleRecord t{};
    for (glm::vec3& c : t.corner) c = {random.uniform(), random.uniform(), random.uniform()};
    t.normal = {0, 0, 1};
    t.subdivision = static_cast<uint16_t>(1 + i % 3);
    t.first_patch = i * 18;
    t.surface = i % 4;
    t.global_triangle = 100 + i;
    cell.triangles.push_back(t);
    if (i % 5 == 0) cell.texture_uv.push_back({i, {{0, 0}, {1, 0}, {0, 1}}});
  }
  cell.high = {1, 1, 1};
  return cell;
}

}  // namespace

TEST_CASE("a geometry cell is restored from its bytes, to the bit", "[transport][cell]") {
  const auto bytes = encode_cell(some_cell());
  const auto back = decode_cell(bytes, limits_of_scene);
  REQUIRE(back.ok());
  CHECK(encode_cell(back.value()) == bytes);
  const auto empty = decode_cell(encode_cell({}), limits_of_scene);
  REQUIRE(empty.ok());
  CHECK(empty.value().triangles.empty());
}

TEST_CASE("a geometry cell that is truncated or of another scene is refused", "[transport][cell]") {
  const auto bytes = encode_cell(some_cell());
  for (size_t n = 0; n < bytes.size(); n += 13)
    CHECK_FALSE(decode_cell(std::span(bytes).first(n), limits_of_scene).ok());
  CHECK_FALSE(decode_cell(bytes, {3, 1000}).ok());
  CHECK_FALSE(decode_cell(bytes, {4, 700}).ok());
  auto cell = some_cell();
  cell.triangles[7].corner[2].y = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(decode_cell(encode_cell(cell), limits_of_scene).ok());
  cell = some_cell();
  std::swap(cell.texture_uv[0], cell.texture_uv[1]);
  CHECK_FALSE(decode_cell(encode_cell(cell), limits_of_scene).ok());
}

TEST_CASE("damaged bytes of a geometry cell never refer beyond the scene", "[transport][cell]") {
  const auto bytes = encode_cell(some_cell());
  Random random(10, RandomStream::test);
  random.start(0);
  for (int i = 0; i < 20'000; ++i) {
    auto harmed = bytes;
    harmed[random.bits() % harmed.size()] ^= static_cast<std::byte>(1u << (random.bits() % 8));
    const auto read = decode_cell(harmed, limits_of_scene);
    if (!read.ok()) continue;
    for (const TriangleRecord& t : read.value().triangles) {
      REQUIRE(t.surface < 4);
      REQUIRE(t.first_patch + 2 * t.subdivision * t.subdivision <= 1000);
    }
  }
}

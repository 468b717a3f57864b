#include "scenes/light/transport/brick_object.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

/// 20 x 17 x 3 cells with every quantity: bricks at its ends are partly zeros.
DataSet some_data() {
  DataSet d;
  d.nx = 20;
  d.ny = 17;
  d.nz = 3;
  d.extent = {2, 1.7, 0.3};
  Random random(4, RandomStream::test);
  random.start(0);
  for (int i = 0; i < d.nx * d.ny * d.nz; ++i) {
    d.extinction.push_back(3 * random.uniform());
    d.albedo.push_back(random.uniform());
    d.emission.push_back(100 * random.uniform());
  }
  return d;
}

void set(std::vector<std::byte>& bytes, size_t at, float value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

TEST_CASE("a brick is restored from its bytes, to the bit", "[transport][brick]") {
  DataSet data = some_data();
  const auto check_all = [&] {
    const BrickTable table = brick_table(data);
    REQUIRE(table.bricks.size() == 4);
    for (size_t i = 0; i < table.bricks.size(); ++i) {
      const Brick brick = cut_brick(data, i);
      const auto bytes = encode_brick(brick);
      const auto back = decode_brick(bytes, table, i);
      REQUIRE(back.ok());
      CHECK(encode_brick(back.value()) == bytes);
      CHECK(back.value().emission_cumulative == brick.emission_cumulative);
      CHECK(back.value().content == brick.content);
    }
  };
  check_all();
  data.albedo.clear();
  check_all();
  data.emission.clear();
  check_all();
}

TEST_CASE("a brick of other quantities, length or place is refused", "[transport][brick]") {
  const DataSet data = some_data();
  const BrickTable table = brick_table(data);
  const auto bytes = encode_brick(cut_brick(data, 0));
  REQUIRE(decode_brick(bytes, table, 0).ok());
  for (size_t n = 0; n < bytes.size(); n += 101)
    CHECK_FALSE(decode_brick(std::span(bytes).first(n), table, 0).ok());
  auto longer = bytes;
  longer.resize(longer.size() + 4);
  CHECK_FALSE(decode_brick(longer, table, 0).ok());
  CHECK_FALSE(decode_brick(bytes, table, 1).ok());  // the table has another sum for this brick
  BrickTable other = table;
  other.has_albedo = false;
  CHECK_FALSE(decode_brick(bytes, other, 0).ok());
  auto foreign = bytes;
  foreign[0] ^= std::byte{1};
  CHECK_FALSE(decode_brick(foreign, table, 0).ok());
}

TEST_CASE("impossible values of smoke are refused in a brick", "[transport][brick]") {
  const DataSet data = some_data();
  const BrickTable table = brick_table(data);
  const auto bytes = encode_brick(cut_brick(data, 0));
  constexpr size_t head = 16, array = limits::brick_cells * sizeof(float);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  struct Case {
    size_t at;
    float value;
  };
  for (const Case& c : {Case{head, -1.0f}, Case{head, nan}, Case{head + 4, infinite},
                        Case{head + array, 1.5f}, Case{head + array + 8, nan},
                        Case{head + 2 * array, -0.5f}, Case{head + 2 * array, infinite}}) {
    INFO(c.at << " " << c.value);
    auto harmed = bytes;
    set(harmed, c.at, c.value);
    CHECK_FALSE(decode_brick(harmed, table, 0).ok());
  }
}

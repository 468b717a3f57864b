#include "scenes/light/transport/brick_object.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace luxodus {

namespace {

constexpr uint64_t brick_magic = 0x316b6972'6278756c;  // "luxbrik1"
constexpr size_t array_bytes = limits::brick_cells * sizeof(float);

struct BrickHeader {
  uint64_t magic;
  uint32_t quantities;  // 1: extinction, 2: albedo, 4: emission
  uint32_t unused;
};
static_assert(sizeof(BrickHeader) == 16);

uint32_t quantities_of(bool extinction, bool albedo, bool emission) {
  return (extinction ? 1u : 0u) | (albedo ? 2u : 0u) | (emission ? 4u : 0u);
}

bool sound(const std::vector<float>& values, float most) {
  return std::all_of(values.begin(), values.end(), [most](float v) { return v >= 0 && v <= most; });
}

}  // namespace

std::vector<std::byte> encode_brick(const Brick& brick) {
  const BrickHeader header{
      brick_magic,
      quantities_of(!brick.extinction.empty(), !brick.albedo.empty(), !brick.emission.empty()), 0};
  std::vector<std::byte> out(sizeof header);
  std::memcpy(out.data(), &header, sizeof header);
  for (const auto* values : {&brick.extinction, &brick.albedo, &brick.emission}) {
    const auto bytes = std::as_bytes(std::span(*values));
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
  return out;
}

Result<Brick> decode_brick(std::span<const std::byte> bytes, const BrickTable& table,
                           size_t brick) {
  BrickHeader header{};
  if (bytes.size() < sizeof header) return problem("a brick of smoke data is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header.magic != brick_magic) return problem("these bytes are no brick of smoke data");
  if (header.unused != 0 ||
      header.quantities !=
          quantities_of(table.has_extinction, table.has_albedo, table.has_emission))
    return problem("a brick of smoke data has other quantities than its data set");
  Brick out;
  for (auto [has, values] :
       {std::pair(table.has_extinction, &out.extinction), std::pair(table.has_albedo, &out.albedo),
        std::pair(table.has_emission, &out.emission)}) {
    if (!has) continue;
    if (bytes.size() < array_bytes) return problem("a brick of smoke data is cut short");
    values->resize(limits::brick_cells);
    std::memcpy(values->data(), bytes.data(), array_bytes);
    bytes = bytes.subspan(array_bytes);
  }
  if (!bytes.empty()) return problem("a brick of smoke data is longer than it says");
  constexpr float any = std::numeric_limits<float>::max();
  if (!sound(out.extinction, any) || !sound(out.albedo, 1) || !sound(out.emission, any))
    return problem("a brick of smoke data has values that cannot be");
  complete(out);
  if (summary_of(out) != table.bricks[brick])
    return problem("a brick of smoke data does not belong to this scene");
  return out;
}

}  // namespace luxodus

#include "scenes/light/transport/cell_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace luxodus {

namespace {

constexpr uint64_t cell_magic = 0x326c6c6563'78756c;  // "luxcell2"

struct CellHeader {
  uint64_t magic;
  uint32_t triangles;
  uint32_t texture_uvs;
  glm::vec3 low, high;
};
static_assert(sizeof(CellHeader) == 40);
static_assert(sizeof(GeometryCell::TriangleUv) == 28);

/// Farther than any scene extends; its square is far from a float's limit.
constexpr float farthest_m = 1e9f;

bool near(const glm::vec3& v) {
  const float most = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  return most <= farthest_m && !std::isnan(v.x + v.y + v.z);
}

bool is_direction(const glm::vec3& v) {
  return near(v) && std::fabs(glm::dot(v, v) - 1) < 1e-3f;
}

bool finite(const GeometryCell::TriangleUv& t) {
  return std::all_of(std::begin(t.corner), std::end(t.corner), [](const glm::vec2& uv) {
    return std::isfinite(uv.x) && std::isfinite(uv.y);
  });
}

bool fits(const TriangleRecord& t, const CellLimits& limits) {
  const uint64_t bins = 2 * uint64_t{t.subdivision} * t.subdivision;
  return t.surface < limits.surfaces && t.subdivision > 0 &&
         t.edge_margin <= TriangleRecord::max_edge_margin &&
         uint64_t{t.first_patch} + bins <= limits.patches && near(t.corner[0]) &&
         near(t.corner[1]) && near(t.corner[2]) && is_direction(t.normal);
}

}  // namespace

std::vector<std::byte> encode_cell(const GeometryCell& cell) {
  const CellHeader header{cell_magic, static_cast<uint32_t>(cell.triangles.size()),
                          static_cast<uint32_t>(cell.texture_uv.size()), cell.low, cell.high};
  const size_t triangle_bytes = cell.triangles.size() * sizeof(TriangleRecord);
  const size_t uv_bytes = cell.texture_uv.size() * sizeof(GeometryCell::TriangleUv);
  std::vector<std::byte> out(sizeof header + triangle_bytes + uv_bytes);
  std::memcpy(out.data(), &header, sizeof header);
  if (triangle_bytes > 0)
    std::memcpy(out.data() + sizeof header, cell.triangles.data(), triangle_bytes);
  if (uv_bytes > 0)
    std::memcpy(out.data() + sizeof header + triangle_bytes, cell.texture_uv.data(), uv_bytes);
  return out;
}

Result<GeometryCell> decode_cell(std::span<const std::byte> bytes, const CellLimits& limits) {
  CellHeader header{};
  if (bytes.size() < sizeof header) return problem("a geometry cell is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header.magic != cell_magic) return problem("these bytes are no geometry cell");
  const size_t triangle_bytes = size_t{header.triangles} * sizeof(TriangleRecord);
  const size_t uv_bytes = size_t{header.texture_uvs} * sizeof(GeometryCell::TriangleUv);
  if (bytes.size() != triangle_bytes + uv_bytes)
    return problem("a geometry cell has not the length that it says");
  if (!near(header.low) || !near(header.high)) return problem("a geometry cell has no size");
  GeometryCell cell;
  cell.low = header.low;
  cell.high = header.high;
  cell.triangles.resize(header.triangles);
  cell.texture_uv.resize(header.texture_uvs);
  if (triangle_bytes > 0) std::memcpy(cell.triangles.data(), bytes.data(), triangle_bytes);
  if (uv_bytes > 0) std::memcpy(cell.texture_uv.data(), bytes.data() + triangle_bytes, uv_bytes);
  for (const TriangleRecord& t : cell.triangles) {
    if (!fits(t, limits)) return problem("a geometry cell does not belong to this scene");
  }
  uint32_t next = 0;
  for (const GeometryCell::TriangleUv& uv : cell.texture_uv) {
    if (uv.triangle < next || uv.triangle >= header.triangles || !finite(uv))
      return problem("texture coordinates of a geometry cell are out of order");
    next = uv.triangle + 1;
  }
  return cell;
}

}  // namespace luxodus

// Positions alone, single precision about an origin of their own: Assimp reads no more, and the
// scene moves the whole by numbers of double precision.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "actors/import/write_building.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/geometry/mesh_tools.hpp"

namespace luxodus {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

template <class T>
void put_bytes(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (code < 0x20)
      out += fmt::format("\\u{:04x}", code);
    else
      out += c;
  }
  return out + "\"";
}

/// Of the scene's axes to glTF's: y up.
glm::vec3 in_gltf(const glm::dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y)};
}

struct GlbLists {
  std::string nodes, meshes, accessors, views, children;
  std::string bytes;
};

void add_part(const BuildingPart& part, size_t index, size_t material, const glm::dvec3& origin,
              GlbLists& to) {
  const auto comma = [](std::string& list) -> std::string& {
    return list += list.empty() ? "" : ",";
  };
  const size_t positions_at = to.bytes.size();
  glm::vec3 low(1e30f), high(-1e30f);
  for (const glm::dvec3& p : part.mesh.positions) {
    const glm::vec3 q = in_gltf(p - origin);
    low = glm::min(low, q);
    high = glm::max(high, q);
    for (glm::length_t i = 0; i < 3; ++i) put_bytes(to.bytes, q[i]);
  }
  const size_t indices_at = to.bytes.size();
  for (const glm::uvec3& t : part.mesh.triangles)
    for (glm::length_t i = 0; i < 3; ++i) put_bytes(to.bytes, t[i]);
  comma(to.views) += fmt::format(
      "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}},"
      "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}",
      positions_at, indices_at - positions_at, indices_at, to.bytes.size() - indices_at);
  comma(to.accessors) += fmt::format(
      "{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\","
      "\"min\":[{},{},{}],\"max\":[{},{},{}]}},"
      "{{\"bufferView\":{},\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}",
      2 * index, part.mesh.positions.size(), low.x, low.y, low.z, high.x, high.y, high.z,
      2 * index + 1, 3 * part.mesh.triangles.size());
  comma(to.meshes) += fmt::format(
      "{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{}}},\"indices\":{},\"material\":{}}}]}}",
      2 * index, 2 * index + 1, material);
  comma(to.nodes) += fmt::format("{{\"name\":{},\"mesh\":{}}}", json_text(part.name), index);
  comma(to.children) += fmt::format("{}", index);
}

}  // namespace

std::string glb_of(const std::vector<BuildingPart>& parts, const glm::dvec3& origin) {
  std::map<std::string, size_t> number;
  std::vector<std::string> names;
  GlbLists lists;
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto [it, fresh] = number.try_emplace(parts[i].material, names.size());
    if (fresh) names.push_back(parts[i].material);
    add_part(parts[i], i, it->second, origin, lists);
  }
  std::string materials;
  for (const std::string& name : names)
    materials += fmt::format("{}{{\"name\":{}}}", materials.empty() ? "" : ",", json_text(name));
  std::string json = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Luxodus\"}},\"scene\":0,"
      "\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}],\"meshes\":[{}],\"materials\":[{}],"
      "\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]}}",
      lists.children, lists.nodes, lists.meshes, materials, lists.accessors, lists.views,
      lists.bytes.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  put_bytes(out, uint32_t{2});
  put_bytes(out, static_cast<uint32_t>(12 + 8 + json.size() + 8 + lists.bytes.size()));
  put_bytes(out, static_cast<uint32_t>(json.size()));
  out += "JSON" + json;
  put_bytes(out, static_cast<uint32_t>(lists.bytes.size()));
  out.append("BIN\0", 4);
  return out + lists.bytes;
}

}  // namespace luxodus

// Small meshes for tests of the import. Any thread.
#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "runtime/core/base64.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus::test {

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string out(values.size() * sizeof(T), '\0');
  std::memcpy(out.data(), values.begin(), out.size());
  return out;
}

inline std::string triangle_buffer() {
  return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}) + bytes_of<uint16_t>({0, 1, 2});
}

/// Triangle (0,0,0) (1,0,0) (0,2,0), y up, under nodes given by the caller; with an embedded
/// buffer.
inline std::string gltf(
    const std::string& nodes, const std::string& roots,
    const std::string& material =
        R"({"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1]}})") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots +
         R"(]}],"nodes":[)" + nodes + R"(],"materials":[)" + material +
         R"(],"meshes":[{"name":"tri","primitives":[)"
         R"({"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,2,0]},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},)"
         R"({"buffer":0,"byteOffset":36,"byteLength":6}],)"
         R"("buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)" +
         base64(triangle_buffer()) + R"("}]})";
}

inline std::vector<ImportedPart> import_ok(const std::string& path, double unit = 1,
                                           UpAxis up = UpAxis::z) {
  auto parts = import_mesh(path, unit, up);
  INFO((parts.ok() ? std::string() : parts.problem().text()));
  REQUIRE(parts.ok());
  return std::move(parts.value());
}

/// Checks that the import fails, naming the file at fault with a message that contains these words.
inline void refuses(const std::string& path, const std::string& at_fault, int line,
                    const std::string& says) {
  const auto result = import_mesh(path, 1, UpAxis::z);
  REQUIRE_FALSE(result.ok());
  INFO(result.problem().text());
  CHECK(result.problem().where.file == at_fault);
  CHECK(result.problem().where.line == line);
  CHECK(result.problem().what.find(says) != std::string::npos);
}

}  // namespace luxodus::test

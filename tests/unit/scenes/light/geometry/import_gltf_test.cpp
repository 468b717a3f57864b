// What the import of meshes reads of glTF 2.0, refuses, and tells.
#include <catch2/catch.hpp>
#include <filesystem>

#include "scenes/light/geometry/import.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/light/geometry/import_kit.hpp"
#include "tests/unit/scenes/light/geometry/mesh_checks.hpp"

using namespace luxodus;
using namespace luxodus::test;
namespace fs = std::filesystem;

namespace {

/// A triangle of 1 m2 under these nodes, with more lists and keys of the file, and another type of
/// positions.
std::string gltf_with(const std::string& nodes, const std::string& roots, const std::string& more) {
  std::string text = gltf(nodes, roots);
  text.pop_back();
  return text + "," + more + "}";
}

std::vector<std::string> notes_of(const std::string& path) {
  MeshExtras extras;
  const auto parts = import_mesh(path, 1, UpAxis::y, &extras);
  INFO((parts.ok() ? std::string() : parts.problem().text()));
  REQUIRE(parts.ok());
  return extras.notes;
}

double area_of(const std::vector<ImportedPart>& parts) {
  double sum = 0;
  for (const ImportedPart& part : parts) sum += area_of(part.mesh);
  return sum;
}

std::string embedded(const std::string& bytes) {
  return R"("buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + R"("}])";
}

}  // namespace

TEST_CASE("a glTF that requires what is not read is refused by the name of the extension",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const auto file = [&](const char* extension) {
    return folder.write("a.gltf",
                        gltf_with(R"({"name":"n","mesh":0})", "0",
                                  std::string(R"("extensionsUsed":[")") + extension +
                                      R"("],"extensionsRequired":[")" + extension + R"("])"));
  };
  for (const char* extension :
       {"ACME_wonder", "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_physics"})
    refuses(file(extension), (folder / "a.gltf").string(), 0, extension);
  for (const char* extension :
       {"KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization"})
    CHECK(area_of(import_ok(file(extension))) == Approx(1));
}

TEST_CASE("quantised positions of every type are read", "[geometry][import]") {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& bytes, int type, int stride, bool normalized,
                        const std::string& scale) {
    return folder.write(
        "q.gltf",
        R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],)"
        R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[)" +
            scale + "," + scale + "," + scale +
            R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" +
            R"("accessors":[{"bufferView":0,"componentType":)" + std::to_string(type) +
            R"(,"count":3,"type":"VEC3","normalized":)" + (normalized ? "true" : "false") +
            R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(bytes.size()) +
            R"(,"byteStride":)" + std::to_string(stride) + "}]," + embedded(bytes) + "}");
  };
  const auto area = [&](const std::string& path) { return area_of(import_ok(path)); };
  // Triangles with two sides of 100, along x and y.
  CHECK(area(file(bytes_of<int16_t>({0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0}), 5122, 8, false,
                  "0.01")) == Approx(0.5));
  CHECK(area(file(bytes_of<uint16_t>({0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0, 0}), 5123, 8, true,
                  "2")) == Approx(2));
  CHECK(area(file(bytes_of<int8_t>({0, 0, 0, 0, -127, 0, 0, 0, 0, 127, 0, 0}), 5120, 4, true,
                  "2")) == Approx(2));
  CHECK(area(file(bytes_of<uint8_t>({0, 0, 0, 0, 200, 0, 0, 0, 0, 200, 0, 0}), 5121, 4, false,
                  "0.01")) == Approx(2));
}

TEST_CASE("numbers of a buffer view that no buffer could satisfy are refused",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string bytes = triangle_buffer();
  const auto refused = [&](const std::string& of_accessor, const std::string& of_view,
                           const std::string& why) {
    const std::string path = folder.write(
        "a.gltf",
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
        R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
        R"("type":"VEC3",)" +
            of_accessor + R"(}],"bufferViews":[{"buffer":0,)" + of_view + "}]," + embedded(bytes) +
            "}");
    INFO(of_accessor << " " << of_view);
    refuses(path, path, 0, why);
  };
  const std::string beyond = "beyond its buffer", whole = R"("byteLength":42)";
  refused(R"("count":3)", whole + R"(,"byteStride":253)", "4 to 252");
  // 2^24 steps of 2^40 bytes are 0 in 64 bits.
  refused(R"("count":16777217)", whole + R"(,"byteStride":1099511627776)", "4 to 252");
  refused(R"("count":16777217)", whole, beyond);
  refused(R"("count":3,"byteOffset":18446744073709551604)", whole, beyond);
  refused(R"("count":3,"byteOffset":43)", whole, beyond);
  refused(R"("count":3)", whole + R"(,"byteOffset":18446744073709551615)", beyond);
  refused(R"("count":3)", R"("byteLength":18446744073709551615,"byteOffset":1)", beyond);
}

TEST_CASE("hidden nodes and what is below them are left out, and told", "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "a.gltf", gltf_with(R"({"mesh":0},{"mesh":0,"children":[2],)"
                          R"("extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0})",
                          "0,1", R"("extensionsUsed":["KHR_node_visibility"])"));
  CHECK(area_of(import_ok(path)) == Approx(1));
  CHECK(notes_of(path) ==
        std::vector<std::string>{"left out, because the file hides them: 2 nodes"});
}

TEST_CASE("instances of a glTF are placed", "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string bytes =
      triangle_buffer() + std::string(2, '\0') + bytes_of<float>({0, 0, 0, 5, 0, 0, 9, 0, 0});
  std::string text = gltf(R"({"name":"chair","mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                          R"({"attributes":{"TRANSLATION":2}}}})",
                          "0");
  const size_t accessors = text.find("],\"bufferViews\"");
  text.insert(accessors, R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"})");
  const size_t buffers = text.find("],\"buffers\"");
  text = text.substr(0, buffers) + R"(,{"buffer":0,"byteOffset":44,"byteLength":36}],)" +
         embedded(bytes) + "}";
  const auto parts = import_ok(folder.write("a.gltf", text), 1, UpAxis::y);
  REQUIRE(parts.size() == 3);
  CHECK(parts[1].name == "chair#2");
  CHECK(bounds_of(parts[2].mesh).low.x == 9);
}

TEST_CASE("names of buffers are percent-encoded, or as they are", "[geometry][import]") {
  const TemporaryFolder folder;
  std::string text = gltf(R"({"name":"n","mesh":0})", "0");
  const size_t uri = text.find("data:");
  const auto named = [&](const std::string& name) {
    std::string out = text;
    return out.replace(uri, out.find('"', uri) - uri, name);
  };
  folder.write("my data ü.bin", triangle_buffer());
  folder.write("100%.bin", triangle_buffer());
  MeshExtras extras;
  REQUIRE(
      import_mesh(folder.write("a.gltf", named("my%20data%20%C3%BC.bin")), 1, UpAxis::y, &extras)
          .ok());
  REQUIRE(extras.files.size() == 2);
  CHECK(fs::path(extras.files[1]).filename() == "my data ü.bin");
  CHECK(area_of(import_ok(folder.write("b.gltf", named("100%.bin")))) == Approx(1));
  const std::string lost = folder.write("c.gltf", named("lost.bin"));
  refuses(lost, (folder / "lost.bin").string(), 0, "");
  const std::string far = folder.write("d.gltf", named("https://example.org/a.bin"));
  refuses(far, far, 0, "nothing is fetched");
  folder.write("short.bin", triangle_buffer().substr(1));
  const std::string cut = folder.write("e.gltf", named("short.bin"));
  refuses(cut, cut, 0, "has 41 bytes and not 42");
}

TEST_CASE("morph targets are applied by their default weights", "[geometry][import]") {
  const TemporaryFolder folder;
  // The triangle itself as its displacement: at weight 1 everything is twice as large.
  std::string text = gltf(R"({"name":"n","mesh":0})", "0");
  const std::string before = R"("material":0}])";
  text.replace(text.find(before), before.size(),
               R"("material":0,"targets":[{"POSITION":0}]}],"weights":[1])");
  const std::string path = folder.write("a.gltf", text);
  CHECK(area_of(import_ok(path)) == Approx(4));
  CHECK(notes_of(path).at(0) == "1 morph target applied by their default weights");
}

TEST_CASE("strips, fans and sparse accessors are read", "[geometry][import]") {
  const TemporaryFolder folder;
  // A unit square; the sparse part moves its third corner from (0, 1) to (0, 3).
  const std::string bytes = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                            bytes_of<uint16_t>({2, 0}) + bytes_of<float>({0, 3, 0});
  const auto file = [&](int mode, const char* sparse) {
    return folder.write(
        "a.gltf",
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
        R"({"attributes":{"POSITION":0},"mode":)" +
            std::to_string(mode) +
            R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3")" +
            sparse + R"(}],"bufferViews":[{"buffer":0,"byteLength":48},)" +
            R"({"buffer":0,"byteOffset":48,"byteLength":4},)"
            R"({"buffer":0,"byteOffset":52,"byteLength":12}],)" +
            embedded(bytes) + "}");
  };
  const auto strip = import_ok(file(5, ""));
  CHECK(area_of(strip) == Approx(1));
  CHECK(all_face(strip[0].mesh, {0, 0, 1}));
  CHECK(import_ok(file(6, ""))[0].mesh.triangles.size() == 2);
  CHECK(area_of(import_ok(file(5, R"(,"sparse":{"count":1,"indices":{"bufferView":1,)"
                                  R"("componentType":5123},"values":{"bufferView":2}})"))) ==
        Approx(1.5 + 0.5));
}

TEST_CASE("lamps, glow and glass of a glTF are told, and lamps alone are given",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string lights =
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100},)"
      R"({"type":"spot","intensity":50,"color":[1,0.5,0],)"
      R"("spot":{"innerConeAngle":0.5,"outerConeAngle":1}},{"type":"directional"}]}})";
  const std::string lamp = R"("extensions":{"KHR_lights_punctual":{"light":)";
  MeshExtras extras;
  const std::string nodes = R"({"name":"a","translation":[1,2,3],)" + lamp + R"(0}}},)" +
                            R"({"name":"b",)" + lamp + R"(1}}},{"name":"sun",)" + lamp + "2}}}";
  const std::string alone = folder.write(
      "lamps.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1,2]}],"nodes":[)" + nodes +
                        "]," + lights + "}");
  const auto parts = import_mesh(alone, 1, UpAxis::y, &extras);
  REQUIRE(parts.ok());
  CHECK(parts->empty());
  REQUIRE(extras.lamps.size() == 2);
  CHECK(extras.lamps[0].at == glm::dvec3(1, -3, 2));
  CHECK_FALSE(extras.lamps[0].is_spot);
  CHECK(extras.lamps[0].candela == 100);
  CHECK(extras.lamps[1].is_spot);
  CHECK(extras.lamps[1].outer_deg == Approx(57.29577951));
  CHECK(extras.lamps[1].direction == glm::dvec3(0, 1, 0));
  CHECK(extras.notes.at(0).find("1 directional lamp not read") == 0);
  CHECK_FALSE(import_mesh(alone, 1, UpAxis::y).ok());

  const std::string glowing = folder.write(
      "glow.gltf",
      gltf(R"({"name":"n","mesh":0})", "0",
           R"({"name":"tube","emissiveFactor":[1,1,1],)"
           R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.9}}})"));
  const auto notes = notes_of(glowing);
  REQUIRE(notes.size() == 2);
  CHECK(notes[0].find("emit is not read: \"tube\"") != std::string::npos);
  CHECK(notes[1].find("read as opaque: \"tube\"") != std::string::npos);
}

#include "scenes/light/geometry/import.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "runtime/core/isolated_job.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/light/geometry/import_kit.hpp"
#include "tests/unit/scenes/light/geometry/mesh_checks.hpp"

using namespace luxodus;
using namespace luxodus::test;
namespace fs = std::filesystem;

TEST_CASE("an OBJ gives its objects with names, materials and colours, in order",
          "[geometry][import]") {
  const TemporaryFolder folder;
  folder.write("house.mtl", "newmtl plaster\nKd 0.7 0.6 0.5\nnewmtl wood\nKd 0.2 0.1 0.05\n");
  const std::string path = folder.write("house.obj",
                                        "mtllib house.mtl\n"
                                        "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 1\nv 2 0 1\n"
                                        "o floor\nusemtl plaster\nf 1 2 3 4\n"
                                        "o door\nusemtl wood\nf 1 2 6\n");
  MeshExtras extras;
  auto result = import_mesh(path, 1, UpAxis::z, &extras);
  REQUIRE(result.ok());
  const std::vector<std::string>& files = extras.files;
  const auto& parts = result.value();
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "floor");
  CHECK(parts[0].material_name == "plaster");
  REQUIRE(parts[0].base_colour);
  CHECK(glm::length(*parts[0].base_colour - glm::dvec3(0.7, 0.6, 0.5)) < 1e-6);
  CHECK(parts[0].mesh.triangles.size() == 2);
  CHECK(area_of(parts[0].mesh) == Approx(6));
  CHECK(all_face(parts[0].mesh, {0, 0, 1}));
  CHECK(parts[1].name == "door");
  CHECK(parts[1].material_name == "wood");
  CHECK(area_of(parts[1].mesh) == Approx(1));
  REQUIRE(files.size() == 2);
  CHECK(fs::path(files[0]).filename() == "house.obj");
  CHECK(fs::path(files[1]).filename() == "house.mtl");
}

TEST_CASE("a material that no library describes has no colour, and the message says why and where",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string shape = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const std::string wood = "usemtl dark wood \nf 1 2 3\n";
  const auto part = [&](const std::string& obj, const std::string& mtl) {
    fs::remove(folder / "a.mtl");
    if (!mtl.empty()) folder.write("a.mtl", mtl);
    auto parts = import_ok(folder.write("house.obj", obj));
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].material_name == "dark wood");
    return std::move(parts[0]);
  };
  const ImportedPart good = part("mtllib a.mtl\n" + shape + wood, "newmtl dark wood\nKd .2 .1 0\n");
  REQUIRE(good.base_colour);
  CHECK_FALSE(good.no_colour);
  CHECK(
      part("mtllib  a.mtl b.mtl \n" + shape + wood, "newmtl dark wood\nKd .2 .1 0\n").base_colour);
  for (const char* mtl :
       {"newmtl dark wood\nKd .2 .1 0\nmap_Kd \n", "newmtl dark wood\rKd .2 .1 0\r"}) {
    INFO(mtl);
    CHECK_FALSE(part("mtllib a.mtl\n" + shape + wood, mtl).no_colour);
  }
  struct Row {
    std::string obj, mtl, file;
    int line;
    const char* says;
  };
  const std::vector<Row> rows = {
      {"mtllib a.mtl\n" + shape + wood, "", "house.obj", 5, "the material library 'a.mtl' is not"},
      {shape + wood, "", "house.obj", 4, "names no material library"},
      {"mtllib a.mtl\n" + shape + wood, "newmtl wood\nKd 0.2 0.1 0\n", "house.obj", 5,
       "no \"newmtl dark wood\" is in"},
      {"mtllib a.mtl\n" + shape + wood, "\nnewmtl dark wood\nKs 1 1 1\n", "a.mtl", 2,
       "give it \"Kd\""},
      {"mtllib a.mtl\n" + shape + wood, "newmtl dark wood\nKd 1 1 1\nmap_Kd oak.png\n", "a.mtl", 1,
       "is in a picture (\"map_Kd\")"},
      {"mtllib a.mtl\n" + shape + wood, "newmtl dark wood\nKd 1 1 1\nmap_kd oak.png\n", "a.mtl", 1,
       "is in a picture"},
  };
  for (const Row& row : rows) {
    INFO(row.says);
    const ImportedPart bare = part(row.obj, row.mtl);
    CHECK_FALSE(bare.base_colour);
    REQUIRE(bare.no_colour);
    INFO(bare.no_colour->text());
    CHECK(bare.no_colour->where.file == (folder / row.file).string());
    CHECK(bare.no_colour->where.line == row.line);
    CHECK(bare.no_colour->what.find(row.says) != std::string::npos);
    CHECK(bare.no_colour->what.find("'dark wood'") != std::string::npos);
  }
  // White in a glTF may only stand for the texture that it tints.
  const std::string tiled =
      R"({"name":"tiles","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"tiles.png"})";
  const auto parts =
      import_ok(folder.write("tiled.gltf", gltf(R"({"name":"n","mesh":0})", "0", tiled)));
  CHECK_FALSE(parts.at(0).base_colour);
  REQUIRE(parts[0].no_colour);
  CHECK(parts[0].no_colour->what.find("'tiles' is in a picture") != std::string::npos);
}

TEST_CASE("an OBJ without materials has none, and normals do not keep vertices apart",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj",
                                        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 1\nf "
                                        "1//1 2//1 3//1\nf 1//2 3//2 4//2\n");
  const auto parts = import_ok(path);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].material_name.empty());
  CHECK_FALSE(parts[0].base_colour);
  CHECK(parts[0].mesh.positions.size() == 4);
  CHECK(parts[0].mesh.texture_uv.empty());
}

TEST_CASE("an OBJ keeps its texture coordinates, v upwards", "[geometry][import]") {
  const TemporaryFolder folder;
  const auto parts = import_ok(
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"));
  const Mesh& mesh = parts[0].mesh;
  REQUIRE(mesh.texture_uv.size() == 3);
  for (size_t i = 0; i < 3; ++i) {
    CHECK(mesh.texture_uv[i].x == Approx(mesh.positions[i].x));
    CHECK(mesh.texture_uv[i].y == Approx(mesh.positions[i].y));
  }
}

TEST_CASE("units scale an import and the up axis turns it", "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj", "v 0 0 0\nv 1000 0 0\nv 0 2000 0\nf 1 2 3\n");
  const auto z_up = import_ok(path, 0.001, UpAxis::z);
  CHECK(bounds_of(z_up[0].mesh).high == glm::dvec3(1, 2, 0));
  const auto y_up = import_ok(path, 0.001, UpAxis::y);
  CHECK(bounds_of(y_up[0].mesh).high == glm::dvec3(1, 0, 2));
  CHECK(all_face(y_up[0].mesh, {0, -1, 0}));
}

TEST_CASE("degenerate faces of a file are dropped and counted", "[geometry][import]") {
  const TemporaryFolder folder;
  const auto parts = import_ok(folder.write("a.obj",
                                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 1 0 0\n"
                                            "o good\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"
                                            "o flat\nf 1 2 4\n"));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].mesh.triangles.size() == 1);
  CHECK(parts[0].degenerate_triangles == 3);
}

TEST_CASE("a glTF gives nodes with transforms applied and its linear base colour",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.gltf", gltf(R"({"name":"group","translation":[10,0,0],"children":[1]},)"
                                  R"({"name":"leaf","mesh":0,"scale":[2,2,2]})",
                                  "0"));
  const auto parts = import_ok(path, 1, UpAxis::y);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].name == "leaf");
  CHECK(parts[0].material_name == "paint");
  REQUIRE(parts[0].base_colour);
  CHECK(*parts[0].base_colour == glm::dvec3(0.25, 0.5, 0.75));
  const Bounds bounds = bounds_of(parts[0].mesh);
  CHECK(glm::length(bounds.low - glm::dvec3(10, 0, 0)) < 1e-12);
  CHECK(glm::length(bounds.high - glm::dvec3(12, 0, 4)) < 1e-12);
  CHECK(all_face(parts[0].mesh, {0, -1, 0}));
}

TEST_CASE("a mirrored glTF node keeps its front, and a mesh placed twice gives two parts",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.gltf", gltf(R"({"name":"twin","mesh":0,"scale":[1,1,-1]},)"
                                  R"({"name":"twin","mesh":0,"scale":[-1,1,1]})",
                                  "0,1"));
  const auto parts = import_ok(path, 1, UpAxis::z);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name != parts[1].name);
  // The triangle faced +z; mirrored in z it faces -z, mirrored in x it still faces +z.
  CHECK(all_face(parts[0].mesh, {0, 0, -1}));
  CHECK(all_face(parts[1].mesh, {0, 0, 1}));
  CHECK(bounds_of(parts[1].mesh).low.x == -1);
}

TEST_CASE("a binary glTF is read like its text", "[geometry][import]") {
  const TemporaryFolder folder;
  std::string json = gltf(R"({"name":"n","mesh":0})", "0");
  // The buffer goes into a chunk of its own.
  const size_t uri = json.find(",\"uri\"");
  json.erase(uri, json.find("}]", uri) - uri);
  while (json.size() % 4 != 0) json += ' ';
  std::string buffer = triangle_buffer();
  while (buffer.size() % 4 != 0) buffer += '\0';
  const auto json_size = static_cast<uint32_t>(json.size());
  const auto buffer_size = static_cast<uint32_t>(buffer.size());
  const std::string glb =
      "glTF" + bytes_of<uint32_t>({2, 28 + json_size + buffer_size, json_size}) + "JSON" + json +
      bytes_of<uint32_t>({buffer_size}) + std::string("BIN\0", 4) + buffer;
  const auto parts = import_ok(folder.write("a.glb", glb), 1, UpAxis::y);
  REQUIRE(parts.size() == 1);
  CHECK(area_of(parts[0].mesh) == Approx(1));
}

TEST_CASE("files that hold no usable mesh are refused with a sentence that names them",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  struct Row {
    const char* name;
    std::string content;
    const char* says;
  };
  const std::string good_gltf = gltf(R"({"name":"n","mesh":0})", "0");
  // That file with other coordinates of the second vertex.
  const auto gltf_at = [&](float x, float y) {
    const std::string good = base64(triangle_buffer());
    const std::string other =
        base64(bytes_of<float>({0, 0, 0, x, y, 0, 0, 2, 0}) + bytes_of<uint16_t>({0, 1, 2}));
    std::string text = good_gltf;
    return text.replace(text.find(good), good.size(), other);
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Row rows[] = {
      {"empty.obj", "", "read"},
      {"points.obj", triangle + "p 1 2 3\n", "no triangles"},
      {"lines.obj", triangle + "l 1 2 3\n", "no triangles"},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n",
       "all 2 triangles are degenerate"},
      {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "not a finite number"},
      {"inf.obj", "v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n", "not a finite number"},
      {"beyond.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n", "a coordinate of 1e+39 m"},
      {"nan.gltf", gltf_at(nan, 0), "the position of vertex 2 is not a finite number"},
      {"inf.gltf", gltf_at(1, -infinity), "the position of vertex 2 is not a finite number"},
      {"node.gltf", gltf(R"({"name":"n","mesh":0,"translation":[1e39,0,0]})", "0"),
       "a coordinate of 1e+39 m"},
      {"nan.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\n", "unknown kind"},
      {"words.obj", "v 1 x 2\n" + triangle + "f 2 3 4\n", "is no number: give 3 numbers"},
      {"comma.obj", "v 1,5 0 0\n" + triangle + "f 2 3 4\n", "is no number: give 3 numbers"},
      {"two.obj", "v 1 2\n" + triangle + "f 2 3 4\n", "has 2 coordinates: give 3 numbers"},
      {"index.obj", triangle + "f 1 2 9\n", "names a vertex that there is not"},
      {"zero.obj", triangle + "f 0 1 2\n", "a corner of this face is none"},
      {"back.obj", triangle + "f -1 -2 -4\n", "a corner of this face is none"},
      {"utf16.obj",
       std::string("\xff\xfe"
                   "v\0",
                   4),
       "UTF-16"},
      {"far.gltf", gltf_at(1e6f, 0), "known to"},
      {"binary.obj", std::string("\x00\x01\xff\xfe", 4), ""},
      {"text.gltf", "this is no glTF", ""},
      {"cut.gltf", good_gltf.substr(0, good_gltf.size() / 2), ""},
      {"zero.gltf", gltf(R"({"name":"n","mesh":0,"scale":[1,0,1]})", "0"), "scaled by 0"},
      {"mesh.gltf", gltf(R"({"name":"n","mesh":7})", "0"), ""},
      {"colour.gltf",
       gltf(R"({"name":"n","mesh":0})", "0",
            R"({"name":"glow","pbrMetallicRoughness":{"baseColorFactor":[3,0,0,1]}})"),
       "glow"},
      {"short.glb", "glTF", ""},
      {"house.ifc", "ISO-10303-21;", "unknown kind"},
  };
  for (const Row& row : rows) {
    INFO(row.name);
    const auto result = import_mesh(folder.write(row.name, row.content), 1, UpAxis::z);
    REQUIRE_FALSE(result.ok());
    INFO(result.problem().text());
    CHECK(result.problem().where.file == folder / row.name);
    CHECK(result.problem().what.find(row.says) != std::string::npos);
  }
}

TEST_CASE("a missing file, a folder and a unit of size 0 are refused", "[geometry][import]") {
  const TemporaryFolder folder;
  CHECK_FALSE(import_mesh(folder / "absent.obj", 1, UpAxis::z).ok());
  fs::create_directories(folder / "folder.obj");
  CHECK_FALSE(import_mesh(folder / "folder.obj", 1, UpAxis::z).ok());
  const std::string path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(import_mesh(path, 1, UpAxis::z).ok());
  for (const double unit : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    CHECK_FALSE(import_mesh(path, unit, UpAxis::z).ok());
  }
}

TEST_CASE("a glTF that nests or chains too deep, or references nodes twice, is refused",
          "[geometry][import][hostile]") {
  const TemporaryFolder folder;
  const auto repeat = [](const std::string& text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
  };
  const std::string deep = folder.write(
      "deep.gltf",
      gltf(R"({"name":"n","mesh":0,"extras":)" + repeat("[", 70) + repeat("]", 70) + "}", "0"));
  refuses(deep, deep, 0, "nested deeper than 64");

  std::string chain;
  for (int i = 1; i <= 1000; ++i) chain += R"({"children":[)" + std::to_string(i) + "]},";
  const std::string chained =
      folder.write("chain.gltf", gltf(chain + R"({"name":"end","mesh":0})", "0"));
  refuses(chained, chained, 0, "more than 1000 deep");

  const std::string twice =
      folder.write("twice.gltf", gltf(R"({"children":[1,1]},{"name":"end","mesh":0})", "0"));
  refuses(twice, twice, 0, "is a child of node 0 and again of node 0");

  const std::string round = folder.write(
      "round.gltf", gltf(R"({"children":[1]},{"children":[0]},{"name":"n","mesh":0})", "2"));
  refuses(round, round, 0, "its own ancestor");
  const std::string odd = folder.write("odd.gltf", gltf(R"({"mesh":0,"children":[-1]})", "0"));
  refuses(odd, odd, 0, "a child that there is not");
}

TEST_CASE("an OBJ with texture coordinates that are no numbers is refused",
          "[geometry][import][hostile]") {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* word : {"nan", "-inf", "1e99", "NaN(7)"}) {
    const std::string path =
        folder.write("uv.obj", triangle + "vt 0 0\nvt 1 " + word + "\nvt 0 1\nf 1/1 2/2 3/3\n");
    refuses(path, path, 5, "not a finite number");
  }
  const std::string tiny =
      folder.write("tiny.obj", triangle + "vt 0 1e-999\nvt 0.5 1\nvt -1E2 1\nf 1/1 2/2 3/3\n");
  CHECK(import_ok(tiny)[0].mesh.texture_uv.size() == 3);
}

TEST_CASE("the importer's messages do not quote the file", "[geometry][import][hostile]") {
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.gltf", "a.glb"}) {
    const auto result = import_mesh(folder.write(name, "v root:secret:0:0 1 2\n"), 1, UpAxis::z);
    REQUIRE_FALSE(result.ok());
    CHECK(result.problem().what.find("secret") == std::string::npos);
  }
}

TEST_CASE("coordinates far from the origin are read where their step is small enough",
          "[geometry][import]") {
  const TemporaryFolder folder;
  // An OBJ has decimals, which are read in double precision.
  const std::string path =
      folder.write("a.obj", "v 3500000.001 0 0\nv 3500001.001 0 0\nv 3500000.001 1 0\nf 1 2 3\n");
  CHECK(area_of(import_ok(path)[0].mesh) == Approx(0.5).epsilon(1e-8));
}

TEST_CASE("numbers of an OBJ may begin with a point or a plus, and a byte order mark is skipped",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const auto parts = import_ok(folder.write(
      "a.obj", "\xef\xbb\xbfv 0 0 0\nv +1. 0 0\nv 1 .5 0 # a corner\nv -.0 5.e-1 0\nf 1 2 3 4\n"));
  CHECK(area_of(parts.at(0).mesh) == Approx(0.5));
  CHECK(bounds_of(parts[0].mesh).high == glm::dvec3(1, 0.5, 0));
}

TEST_CASE("lines of an OBJ end in three ways, go on after a backslash, and may name later vertices",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const std::string text = "f 1 2 \\\n3\nv 0 0 0\nv 2 0 0\nv 0 \\\n1 0\nf -3 -2 -1\n";
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? std::string(end) : std::string(1, c);
    CHECK(area_of(import_ok(folder.write("a.obj", other)).at(0).mesh) == Approx(2));
  }
}

TEST_CASE("faces of an OBJ keep their area and side, convex or not", "[geometry][import]") {
  const TemporaryFolder folder;
  // An L of 3 m2, an arrow of 0.5 m2, and a quad whose corners are out of one plane.
  const auto parts = import_ok(
      folder.write("a.obj",
                   "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\no L\nf 1 2 3 4 5 6\n"
                   "v 5 0 0\nv 6 1 0\nv 5 0.5 0\nv 4 1 0\no arrow\nf 7 8 9 10\n"));
  REQUIRE(parts.size() == 2);
  CHECK(area_of(parts[0].mesh) == Approx(3));
  CHECK(all_face(parts[0].mesh, {0, 0, 1}));
  CHECK(area_of(parts[1].mesh) == Approx(0.5));
  CHECK(all_face(parts[1].mesh, {0, 0, 1}));
}

TEST_CASE("an OBJ is cut into parts where the object or the material changes",
          "[geometry][import]") {
  const TemporaryFolder folder;
  const auto parts = import_ok(folder.write("a.obj",
                                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                                            "g hall north\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n"
                                            "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"
                                            "g hall north\nf 1 2 3\no hall north\nf 1 2 3\n"));
  std::vector<std::string> names;
  for (const ImportedPart& part : parts) names.push_back(part.name);
  CHECK(names == std::vector<std::string>{"defaultobject", "hall north", "hall north/b",
                                          "hall north/a", "hall north#2"});
  CHECK(parts.at(2).mesh.triangles.size() == 2);
  CHECK(parts.at(3).material_name == "a");
}

TEST_CASE("what an OBJ says and is not read is told", "[geometry][import]") {
  const TemporaryFolder folder;
  folder.write("a.mtl",
               "newmtl lamp\nKd 1 1 1\nKe 5 5 5\nnewmtl pane\nKd 1 1 1\nd 0.3\n"
               "newmtl wall\nKd 1 1 1\nKe 0 0 0\nd 1\n");
  MeshExtras extras;
  // The last face crosses itself.
  REQUIRE(import_mesh(folder.write("a.obj",
                                   "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 -.5 0\nv 0 1 0\n"
                                   "vn 0 0 1\nusemtl lamp\nf 1 2 3\nusemtl pane\nf 1 2 3\n"
                                   "usemtl wall\nf 1 2 3 4 5\ncurv 0 1 1 2\nvv 1 2 3\n"),
                      1, UpAxis::z, &extras)
              .ok());
  REQUIRE(extras.notes.size() == 5);
  CHECK(extras.notes[0].find("free-form curves and surfaces are not read: 1") == 0);
  CHECK(extras.notes[1].find("faces that touch or cross themselves") == 0);
  CHECK(extras.notes[2].find("not read: 1, the first is line 15") != std::string::npos);
  CHECK(extras.notes[3].find("\"lamp\"") != std::string::npos);
  CHECK(extras.notes[4].find("\"pane\"") != std::string::npos);
}

TEST_CASE("mutated meshes are read or rejected with one sentence", "[geometry][import]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const uint64_t tries = count_text != nullptr ? std::strtoull(count_text, nullptr, 0) : 1000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const auto as_bytes = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes obj = as_bytes(
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 .5 0\nv 0 1 0\nvt 0 1\nvt 1 0\n"
      "o a\nusemtl a\nf 1/1 2/2 3/1 4/2\ng b\nf -1 -2 -3 \\\n-4\n");
  const Bytes mtl = as_bytes("newmtl a\nKd 0.5 0.5 0.5\nKe 1 1 1\nd 0.5\nnewmtl b\nmap_Kd a.png\n");
  const Bytes json = as_bytes(gltf(
      R"({"name":"n","mesh":0,"scale":[1,2,3],"children":[1]},{"mesh":0,"rotation":[0,0,1,0]})",
      "0"));
  const TemporaryFolder folder;
  const ForkedJobs forked;
  uint64_t read = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    const bool is_obj = i % 2 == 0;
    const Bytes harmed = mutated(is_obj ? obj : json, is_obj ? mtl : obj, random);
    const Bytes library = mutated(mtl, obj, random);
    const auto text_of = [](const Bytes& bytes) {
      return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    folder.write("a.mtl", text_of(library));
    MeshExtras extras;
    const auto parts = import_mesh(folder.write(is_obj ? "a.obj" : "a.gltf", text_of(harmed)), 1,
                                   UpAxis::z, &extras);
    if (!parts) {
      // A crash of the process, or one that takes too long, would be a mistake of ours.
      INFO(parts.problem().text());
      REQUIRE_FALSE(parts.problem().what.empty());
      REQUIRE(parts.problem().what.find("crash") == std::string::npos);
      REQUIRE(parts.problem().what.find("takes longer") == std::string::npos);
      REQUIRE(parts.problem().what.find("without a reason") == std::string::npos);
      continue;
    }
    ++read;
    for (const ImportedPart& part : parts.value())
      for (const glm::dvec3& p : part.mesh.positions) REQUIRE(is_finite(p));
  }
  CHECK(read > tries / 20);
  CHECK(read < tries);
}

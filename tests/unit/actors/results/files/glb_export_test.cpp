// A run as glTF: reading it back gives the scene's surfaces, with the light of their patches.
#include "actors/results/files/glb_export.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "scenes/light/geometry/import.hpp"
#include "scenes/light/transport/readout.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string lit_room = R"(
patch_edge_m = 0.5
[[object]]
name = "room"
shape = "room"
low = [10, 20, 0]
high = [14, 23, 2.5]
material = "white80"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [12, 21.5, 2]
flux_lm = 1000
[[emitter]]
name = "spot"
shape = "disc"
diameter = 0.1
distribution = "lambertian"
position = [11, 21, 2.4]
flux_lm = 314.15926
[[camera]]
name = "door"
eye = [10.5, 20.5, 1.6]
target = [13, 22, 1.2]
)";

GlbScene exported(const LocalRun& run, double white_cd_m2) {
  auto scene = glb_scene_of(run, {"luxodus test", white_cd_m2});
  if (!scene.ok()) FAIL(scene.problem().text());
  return std::move(scene).value();
}

double area_of(const GlbMesh& mesh, size_t triangle) {
  const auto corner = [&](size_t i) {
    return glm::dvec3(mesh.points[mesh.triangles[3 * triangle + i]]);
  };
  return glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
}

/// Lumens reflected by surfaces with this luminance.
double lumens_of(const GlbScene& scene, double white_cd_m2) {
  double sum = 0;
  for (const GlbMesh& mesh : scene.meshes)
    for (size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
      double luminance = 0;
      for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 c(mesh.colours[mesh.triangles[3 * t + i]]);
        luminance += (0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z) / 3;
      }
      sum += std::numbers::pi * luminance * white_cd_m2 * area_of(mesh, t);
    }
  return sum;
}

}  // namespace

TEST_CASE("an exported run reflects the light of its patches", "[display][glb]") {
  const auto run = traced(lit_room, 60'000);
  constexpr double white = 1e4;  // brighter than everything
  const GlbScene scene = exported(*run, white);
  const Readout readout(run->scene(), run->totals());
  double lumens = 0, area = 0;
  for (uint32_t patch = 0; patch < run->scene().patch_count; ++patch)
    lumens += readout.lumens(run->scene().blocks.patches, patch, 1).value;
  CHECK(lumens > 1000);
  CHECK(lumens_of(scene, white) == Approx(lumens).epsilon(0.03));  // corners are means
  for (const GlbMesh& mesh : scene.meshes)
    for (size_t t = 0; t < mesh.triangles.size() / 3; ++t) area += area_of(mesh, t);
  CHECK(area == Approx(2 * (4 * 3 + 4 * 2.5 + 3 * 2.5)).epsilon(1e-4));  // only its inner side
}

TEST_CASE("white is the luminance that nearly all of the lit area stays below", "[display][glb]") {
  const auto run = traced(lit_room, 60'000);
  const GlbScene scene = exported(*run, 0);
  CHECK(scene.extras["white_cd_m2"].get<double>() > 10);
  size_t bright = 0, all = 0;
  for (const GlbMesh& mesh : scene.meshes)
    for (const glm::vec3& colour : mesh.colours) {
      CHECK(std::min({colour.x, colour.y, colour.z}) >= 0);
      CHECK(std::max({colour.x, colour.y, colour.z}) <= 1);
      bright += colour.y > 0.999f ? 1 : 0;
      ++all;
    }
  CHECK(bright < all / 10);
}

TEST_CASE("luminaires of an exported run have their flux, place and direction", "[display][glb]") {
  const auto run = traced(lit_room, 1'000);
  const GlbScene scene = exported(*run, 100);
  REQUIRE(scene.lights.size() == 2);
  for (const GlbLight& light : scene.lights) {
    const glm::dvec3 place = light.position + scene.origin;
    if (light.name == "lamp") {
      CHECK(light.intensity_cd == Approx(1000 / (4 * std::numbers::pi)));
      CHECK(glm::length(place - glm::dvec3(12, 21.5, 2)) < 1e-4);
      CHECK(light.outer_rad == 0);
    } else {
      // By the falloff of KHR_lights_punctual, over the directions of its cone.
      double lumens = 0;
      constexpr int steps = 2000;
      for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) * light.outer_rad / steps;
        const double share = (std::cos(angle) - std::cos(light.outer_rad)) /
                             (std::cos(light.inner_rad) - std::cos(light.outer_rad));
        lumens += light.intensity_cd * share * share * 2 * std::numbers::pi * std::sin(angle) *
                  light.outer_rad / steps;
      }
      CHECK(lumens == Approx(314.15926).epsilon(1e-4));
      CHECK(glm::length(place - glm::dvec3(11, 21, 2.4)) < 1e-4);
      CHECK(glm::length(light.direction - glm::dvec3(0, 0, -1)) < 1e-6);
    }
  }
  REQUIRE(scene.cameras.size() == 1);
  CHECK(glm::length(scene.cameras[0].eye + scene.origin - glm::dvec3(10.5, 20.5, 1.6)) < 1e-9);
}

TEST_CASE("an exported run is read back as its surfaces", "[display][glb]") {
  const auto run = traced(lit_room, 20'000);
  const TemporaryFolder folder;
  const auto path = folder.path() / "room.glb";
  const auto written = write_glb(path, exported(*run, 0));
  REQUIRE(written.ok());
  const auto read = import_mesh(path.string(), 1, UpAxis::y);
  if (!read.ok()) FAIL(read.problem().text());
  glm::dvec3 low(1e9), high(-1e9);
  for (const auto& part : read.value())
    for (const auto& point : part.mesh.positions) {
      low = glm::min(low, glm::dvec3(point));
      high = glm::max(high, glm::dvec3(point));
    }
  CHECK(glm::length(low - glm::dvec3(10, 20, 0)) < 1e-3);
  CHECK(glm::length(high - glm::dvec3(14, 23, 2.5)) < 1e-3);
}

TEST_CASE("a GLB file has the layout that its head states", "[display][glb]") {
  const auto run = traced(lit_room, 1'000);
  const auto bytes = glb_bytes_of(exported(*run, 100));
  REQUIRE(bytes.ok());
  const auto word = [&](size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes->data() + at, sizeof value);
    return value;
  };
  CHECK(bytes->substr(0, 4) == "glTF");
  CHECK(word(4) == 2);
  CHECK(word(8) == bytes->size());
  const uint32_t json_bytes = word(12);
  CHECK(json_bytes % 4 == 0);
  const Json head = Json::parse(bytes->substr(20, json_bytes));
  CHECK(head["asset"]["version"] == "2.0");
  CHECK(head["extensionsUsed"].size() == 2);
  CHECK(head["buffers"][0]["byteLength"].get<uint32_t>() == word(20 + json_bytes));
  CHECK(28 + json_bytes + word(20 + json_bytes) == bytes->size());
}

TEST_CASE("malformed meshes are rejected with a message", "[display][glb]") {
  const auto refused = [](const GlbMesh& mesh, const std::string& words) {
    GlbScene scene;
    scene.meshes.push_back(mesh);
    const auto bytes = glb_bytes_of(scene);
    REQUIRE_FALSE(bytes.ok());
    INFO(bytes.problem().what);
    CHECK(bytes.problem().what.find(words) != std::string::npos);
  };
  const std::vector<glm::vec3> three(3, glm::vec3(0));
  refused({"m", three, {three[0]}, {0, 1, 2}}, "differ in number");
  refused({"m", three, three, {}}, "no whole triangles");
  refused({"m", three, three, {0, 1, 3}}, "a corner that there is not");
  refused({"m", {glm::vec3(NAN), three[0], three[0]}, three, {0, 1, 2}}, "not finite");
  CHECK_FALSE(glb_bytes_of({}).ok());
  const auto dark = traced(
      "[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\n"
      "high = [2, 2, 2]\nmaterial = \"black5\"\n[[emitter]]\nname = \"lamp\"\n"
      "shape = \"point\"\nposition = [1, 1, 1]\nflux_lm = 1\n",
      0);
  const auto nothing = glb_scene_of(*dark, {"test", 0});
  REQUIRE_FALSE(nothing.ok());
  CHECK(nothing.problem().what.find("no surface of the run") != std::string::npos);
}

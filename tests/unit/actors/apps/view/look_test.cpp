// What the page gets about faces of lamps and about gloss.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "actors/apps/view/gloss.hpp"
#include "actors/apps/view/lamps.hpp"
#include "scenes/light/transport/emission.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr double pi = std::numbers::pi;

double luminance(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Luminance of a lamp at this many degrees from the axis of its table, at one azimuth [cd/m2].
double luminance_at(const LiveLamps& lamps, size_t lamp, double polar_deg, size_t azimuth = 0) {
  const LampTable& table = lamps.tables.at(lamps.lamps.at(lamp).table);
  const auto row = static_cast<size_t>(polar_deg * limits::lamp_polar / 180);
  const size_t at = 2 * (row * limits::lamp_azimuth + azimuth);
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(table.values.at(i)); };
  return luminance(lamps.lamps[lamp].colour) * table.peak * (byte(at) + 256 * byte(at + 1)) / 65535;
}

std::string lamp(const std::string& name, const std::string& shape,
                 const std::string& distribution) {
  return "\n[[emitter]]\nname = \"" + name + "\"\nposition = [1, 1, 2.5]\nflux_lm = 600\n" + shape +
         "\ndistribution = \"" + distribution + "\"\n";
}

const std::string square = "shape = \"rectangle\"\nsize = [0.5, 0.4]";

/// 100 cd downwards, falling linearly to 20 cd sideways and nothing above.
std::shared_ptr<const PhotometricWeb> downlight() {
  const glm::dmat3 down(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
  auto web = PhotometricWeb::make({0, 360}, {0, 89, 91, 180}, {100, 20, 0, 0, 100, 20, 0, 0}, down);
  REQUIRE(web.ok());
  return std::make_shared<const PhotometricWeb>(std::move(web).value());
}

struct WebsOfScene {
  const CompiledScene* scene;
  const PhotometricWeb& web(uint32_t i) const { return *scene->webs[i]; }
};

/// The tracer's luminance, where a distant ray hits the middle of the emitter's side [cd/m2].
double traced_luminance(const CompiledScene& scene, const EmissionPoint& point,
                        const Vec3& to_eye) {
  const WebsOfScene webs{&scene};
  double out = 0;
  for (int b = 0; b < scene.bands.count(); ++b)
    out +=
        scene.bands[b].lm_per_w * emitted_radiance(scene.emitters.back(), point, to_eye, b, webs);
  return out;
}

/// The room with only one emitter.
CompiledScene only_panel(const std::string& shape) {
  CompiledScene scene = *LiveRoom(lamp("panel", shape, "lambertian")).compiled({});
  std::erase_if(scene.emitters, [](const CompiledEmitter& e) { return !has_own_face(e); });
  REQUIRE(scene.emitters.size() == 1);
  return scene;
}

/// One emitter with the photometric web of a file.
CompiledScene with_web(const std::string& shape) {
  CompiledScene scene = only_panel(shape);
  scene.webs.push_back(downlight());
  CompiledEmitter& e = scene.emitters.back();
  e.distribution = Distribution::web;
  e.web = static_cast<uint32_t>(scene.webs.size() - 1);
  return scene;
}

/// Rotated about the vertical.
void turn(CompiledEmitter& e, double angle) {
  const auto c = static_cast<Real>(std::cos(angle));
  const auto s = static_cast<Real>(std::sin(angle));
  e.axes = Mat3(Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1));
}

/// Adds copies of the last emitter, up to this total.
void fill(CompiledScene& scene, size_t count) {
  const CompiledEmitter last = scene.emitters.back();
  while (scene.emitters.size() < count) scene.emitters.push_back(last);
}

}  // namespace

TEST_CASE("a lamp with a face is sent, a point and a sign are not", "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian"));
  const auto scene = room.compiled({});
  const LiveLamps lamps = lamps_of(*scene);
  REQUIRE(lamps.lamps.size() == 1);
  const LiveLamp& panel = lamps.lamps.front();
  CHECK(panel.kind == EmitterKind::rectangle);
  CHECK(glm::length(panel.origin - glm::dvec3(1, 1, 2.5)) < 1e-6);
  CHECK(glm::length(panel.axes[2] - glm::dvec3(0, 0, 1)) < 1e-6);
  CHECK(scene->groups.size() == 4);
  CHECK(panel.group != scene->groups[0].name);
}

TEST_CASE("a Lambertian face has exitance divided by pi from below, and nothing from above",
          "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian"));
  const LiveLamps lamps = lamps_of(*room.compiled({}));
  const double expected = 600 / (0.5 * 0.4) / pi;
  for (const double polar : {1.0, 30.0, 60.0, 80.0})
    CHECK(luminance_at(lamps, 0, polar) == Approx(expected).epsilon(1e-3));
  for (const double polar : {100.0, 150.0}) CHECK(luminance_at(lamps, 0, polar) == 0);
}

TEST_CASE("lamps of one distribution share a table", "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian") + lamp("second", square, "lambertian") +
                      lamp("glow", square, "isotropic"));
  const LiveLamps lamps = lamps_of(*room.compiled({}));
  REQUIRE(lamps.lamps.size() == 3);
  CHECK(lamps.tables.size() == 2);
  CHECK(lamps.lamps[0].table == lamps.lamps[1].table);
  // Both sides shine: 600 lm over the sphere, divided by the visible area.
  const double at = 43.75 / 180 * pi;  // the middle of a cell
  const double expected = 600 / (4 * pi) / (0.5 * 0.4 * std::cos(at));
  CHECK(luminance_at(lamps, 2, 43.75) == Approx(expected).epsilon(1e-3));
  CHECK(luminance_at(lamps, 2, 180 - 43.75) == Approx(expected).epsilon(1e-3));
}

TEST_CASE("a flat luminaire of a file has the tracer's luminance", "[view]") {
  const CompiledScene scene = with_web(square);
  const LiveLamps lamps = lamps_of(scene);
  REQUIRE(lamps.lamps.size() == 1);
  CHECK(lamps.lamps[0].of_luminaire);
  const CompiledEmitter& e = scene.emitters.back();
  for (const double polar : {1.25, 31.25, 61.25, 86.25}) {
    const double angle = polar / 180 * pi;
    const Vec3 to_eye(glm::dvec3(std::sin(angle), 0, -std::cos(angle)));
    const double expected = traced_luminance(scene, {e.origin, Vec3(0, 0, -1)}, to_eye);
    CHECK(expected > 0);
    CHECK(luminance_at(lamps, 0, polar) == Approx(expected).epsilon(2e-3));
  }
  CHECK(luminance_at(lamps, 0, 120) == 0);
}

TEST_CASE("a round luminaire of a file is brighter where its points are inclined", "[view]") {
  const std::string shape = GENERATE("shape = \"sphere\"\ndiameter = 0.3",
                                     "shape = \"tube\"\nlength = 1.2\ndiameter = 0.1");
  const CompiledScene scene = with_web(shape);
  const LiveLamps lamps = lamps_of(scene);
  REQUIRE(lamps.lamps.size() == 1);
  const CompiledEmitter& e = scene.emitters.back();
  for (const double polar : {1.25, 61.25, 88.75}) {
    const double angle = polar / 180 * pi;
    const Vec3 to_eye(glm::dvec3(0, std::sin(angle), -std::cos(angle)));
    for (const double cosine : {1.0, 0.5}) {
      // A normal of either shape, inclined to the eye by that cosine.
      const double of_normal = angle + std::acos(cosine);
      const Vec3 normal(glm::dvec3(0, std::sin(of_normal), -std::cos(of_normal)));
      const double expected = traced_luminance(scene, {e.origin, normal}, to_eye);
      CHECK(expected > 0);
      CHECK(luminance_at(lamps, 0, polar) / cosine == Approx(expected).epsilon(2e-3));
    }
  }
}

TEST_CASE("luminaires of one file share a table whatever their orientation", "[view]") {
  CompiledScene scene = with_web(square);
  fill(scene, scene.emitters.size() + 2);
  turn(scene.emitters.back(), 0.3);
  turn(scene.emitters[scene.emitters.size() - 2], 2.1);
  const LiveLamps lamps = lamps_of(scene);
  CHECK(lamps.lamps.size() == 3);
  CHECK(lamps.tables.size() == 1);
  CHECK(lamps.lamps[1].axes != lamps.lamps[2].axes);
  // A sphere of the same file needs another table.
  scene.emitters.back().kind = EmitterKind::sphere;
  CHECK(lamps_of(scene).tables.size() == 2);
}

TEST_CASE("lamps are sent up to the limits of the page", "[view]") {
  CompiledScene scene = only_panel(square);
  CompiledEmitter& e = scene.emitters.back();
  SECTION("of their number") {
    fill(scene, limits::view_lamps + 1);
    CHECK(lamps_of(scene).lamps.size() == limits::view_lamps);
  }
  SECTION("of their width") {
    e.size.x = static_cast<Real>(limits::view_lamp_m);
    CHECK(lamps_of(scene).lamps.size() == 1);
    e.size.x = static_cast<Real>(1.01 * limits::view_lamp_m);
    CHECK(lamps_of(scene).lamps.empty());
  }
  SECTION("of their brightness, with the same hue") {
    const auto before = lamps_of(scene).lamps.at(0).colour;
    e.area_m2 *= 1e-9;
    const auto colour = lamps_of(scene).lamps.at(0).colour;
    CHECK(*std::max_element(colour.begin(), colour.end()) == Approx(limits::view_lamp_colour));
    CHECK(colour[2] / colour[0] == Approx(before[2] / before[0]));
  }
  SECTION("of their corners in all") {
    e.kind = EmitterKind::mesh;
    e.corners.assign(3 * limits::view_lamp_triangles, Vec3(1));
    const size_t most = limits::view_lamp_corners / e.corners.size();
    fill(scene, most + 2);
    scene.emitters.back().corners.resize(3);
    const LiveLamps lamps = lamps_of(scene);
    size_t corners = 0;
    for (const LiveLamp& one : lamps.lamps) corners += one.corners.size();
    CHECK(corners <= limits::view_lamp_corners);
    CHECK(lamps.lamps.size() == most + 1);  // a small one still has room
    CHECK(lamps.lamps.back().corners.size() == 3);
  }
  SECTION("of the number of tables") {
    e.distribution = Distribution::cosine_power;
    fill(scene, limits::view_lamp_tables + 1);
    for (size_t i = 0; i < scene.emitters.size(); ++i)
      scene.emitters[i].exponent = static_cast<Real>(1 + 0.125 * static_cast<double>(i));
    const LiveLamps lamps = lamps_of(scene);
    CHECK(lamps.tables.size() == limits::view_lamp_tables);
    CHECK(lamps.lamps.size() == limits::view_lamp_tables);
  }
}

TEST_CASE("gloss is sent for glossy sides and mirrors, with the share outside the lobe", "[view]") {
  const LiveRoom room(R"(
[[material]]
name = "lacquer"
kind = "glossy"
reflectance = 0.3
specular = 0.1
roughness = 0.15

[[material]]
name = "silver"
kind = "mirror"
specular = 0.9

[[object]]
name = "table"
shape = "quad"
corner = [1, 1, 0.7]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "lacquer"
back_material = "grey50"

[[object]]
name = "glass"
shape = "quad"
corner = [4, 1, 0.7]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "grey50"
back_material = "silver"
)");
  const auto scene = room.compiled({});
  const auto gloss = gloss_of(*scene);
  REQUIRE(gloss.size() == 2);
  CHECK(scene->surfaces[gloss[0].surface].name == "table");
  CHECK_FALSE(gloss[0].back);
  for (const double share : gloss[0].mirrored) CHECK(share == Approx(0.1).epsilon(1e-3));
  CHECK(gloss[0].spread == Approx(0.75).epsilon(1e-3));
  CHECK(gloss[0].roughness == Approx(0.15));
  CHECK(scene->surfaces[gloss[1].surface].name == "glass");
  CHECK(gloss[1].back);
  CHECK(gloss[1].spread == 0);
  CHECK(gloss[1].roughness == 0);
  // Sides beyond the limit of pages are left out.
  CompiledScene many = *scene;
  many.surfaces.insert(many.surfaces.end(), limits::view_gloss, scene->surfaces[gloss[0].surface]);
  CHECK(gloss_of(many).size() == limits::view_gloss);
}

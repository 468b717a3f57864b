// Floor slabs hide places from each other: never if a ray passes, always if the geometry is simple.
// The light of the codes is the same with and without them.
#include "actors/judge/assess/level_screens.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "actors/judge/assess/code_light.hpp"
#include "runtime/core/random.hpp"
#include "tests/kit/described.hpp"

namespace luxodus {
namespace {

/// Three slabs of 12 m by 8 m, 3 m apart, each made of four boxes around an open stair of 2 m by 2
/// m. A pane lies in the roof, and luminaires hang under each slab.
std::string storeys(const char* slab_material) {
  std::string out =
      "[[material]]\nname = \"glass\"\nkind = \"glass\"\n[assessment]\nrules = "
      "[\"en1838-2013\"]\n[[scenario]]\nname = \"failed\"\noperation = \"emergency\"\n";
  const char* const parts[] = {"0, 0 | 5, 8", "7, 0 | 12, 8", "5, 0 | 7, 3", "5, 5 | 7, 8"};
  for (int storey = 0; storey < 3; ++storey) {
    const double top = 3.0 * storey;
    int part = 0;
    for (const std::string text : parts) {
      const size_t bar = text.find(" | ");
      out += fmt::format(
          "[[object]]\nname = \"slab {} {}\"\nshape = \"box\"\nlow = [{}, {}]\nhigh = [{}, {}]\n"
          "material = \"{}\"\n",
          storey, part++, text.substr(0, bar), top - 0.2, text.substr(bar + 3), top, slab_material);
    }
    for (const double x : {2.0, 6.5, 10.0})
      out += fmt::format(
          "[[emitter]]\nname = \"lamp {} {}\"\nshape = \"disc\"\ndiameter = 0.2\nposition = [{}, "
          "4.2, {}]\nflux_lm = 400\nemergency = \"non-maintained\"\nemergency_flux = "
          "200\nmaintenance_factor = "
          "1\nend_of_duration_factor = 1\n",
          storey, x, x, top + 2.7);
    out += fmt::format(
        "[[route]]\nname = \"way {0}\"\npath = [[1, 1.5, {1}], [11, 1.5, {1}]]\nwidth = 1\n",
        storey, top);
  }
  return out;
}

std::unique_ptr<Building> building_of(const SceneDescription& scene) {
  auto made =
      Building::make(code_scene(scene, true), code_scenario(scene, scene.scenarios.front()), 1);
  REQUIRE(made);
  return std::move(made).value();
}

Bounds box_at(const glm::dvec3& place, double half) {
  return {place - half, place + half};
}

/// The scene of storeys(), with these triangles instead of the largest part of its second slab.
std::shared_ptr<const SceneDescription> with_level(
    const SceneDescription& scene, const std::vector<std::array<glm::dvec2, 3>>& triangles) {
  auto out = std::make_shared<SceneDescription>(scene);
  const auto slab = std::find_if(out->objects.begin(), out->objects.end(),
                                 [](const Object& one) { return one.name == "slab 1 0"; });
  REQUIRE(slab != out->objects.end());
  Mesh mesh;
  for (const auto& corners : triangles) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec2& corner : corners) mesh.positions.emplace_back(corner, 3.0);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  slab->mesh = std::move(mesh);
  return out;
}

/// Checks that the light at places on all storeys is the sum over all luminaires by rays.
void check_light(const SceneDescription& scene) {
  const auto building = building_of(scene);
  std::vector<glm::dvec3> places;
  for (int storey = 0; storey < 3; ++storey)
    for (double x = 0.75; x < 12; x += 1.3)
      for (double y = 0.6; y < 8; y += 1.1) places.emplace_back(x, y, 3.0 * storey);
  const CodeLight light(scene, *building);
  const auto lit = light.lit(places, {0, 0, 1}, 0.02);
  DirectOptions clear_air;
  clear_air.media = false;
  building->each(1, [&](const GeometryAccess& access, size_t) {
    for (const LitPoint& point : lit) {
      const auto all = direct_by_emitter(building->scene(), access, building->local(point.place),
                                         {0, 0, 1}, clear_air);
      REQUIRE(point.lux.size() == all.size());
      for (size_t i = 0; i < all.size(); ++i)
        CHECK(point.lux[i] == Approx(all[i]).epsilon(1e-9).margin(1e-12));
    }
  });
}

}  // namespace

TEST_CASE("a slab hides one storey from the next, except through the stair in it",
          "[assess][screens]") {
  const auto scene = test::described_text(storeys("white50"));
  const LevelScreens screens(building_of(*scene)->scene());
  const glm::dvec3 below(2, 2, 0.02), above(2.5, 2.5, 5.7);
  CHECK(screens.hide(below, box_at(above, 0.1)));
  CHECK(screens.hide(above, box_at(below, 0.01)));
  // Two storeys away.
  CHECK(screens.hide(below, box_at({3, 2.5, 8.7}, 0.1)));
  // Nothing is between places on one storey.
  CHECK_FALSE(screens.hide(below, box_at({10, 4, 2.7}, 0.1)));
  CHECK_FALSE(screens.hide({2, 2, 3.02}, box_at({10, 4, 5.7}, 0.1)));
  // Through the stair one storey is visible from the next.
  CHECK_FALSE(screens.hide({6, 4, 0.02}, box_at({6, 4, 5.7}, 0.1)));
  // At equal heights, and outside all slabs.
  CHECK_FALSE(screens.hide(below, box_at({6, 2, 0.02}, 0)));
  CHECK_FALSE(screens.hide({-2, 2, 0}, box_at({-2, 2, 5.7}, 0.1)));
}

TEST_CASE("glass and open surfaces hide nothing", "[assess][screens]") {
  for (const char* material : {"glass", "open"}) {
    const auto scene = test::described_text(storeys(material));
    const LevelScreens screens(building_of(*scene)->scene());
    CHECK_FALSE(screens.hide({2, 2, 0.02}, box_at({2.5, 2.5, 5.7}, 0.1)));
  }
}

TEST_CASE("a place that a ray reaches is never reported as hidden", "[assess][screens]") {
  const auto scene = test::described_text(storeys("white50"));
  const auto building = building_of(*scene);
  const LevelScreens screens(building->scene());
  Random random(4, RandomStream::test, 11);
  random.start(0);
  const auto anywhere = [&] {
    const double x = random.uniform_double(), y = random.uniform_double(),
                 z = random.uniform_double();
    return glm::dvec3(14 * x - 1, 10 * y - 1, 9.5 * z - 0.5);
  };
  size_t hidden = 0, wrong = 0;
  building->each(1, [&](const GeometryAccess& access, size_t) {
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 place = anywhere(), other = anywhere();
      const double half = 0.2 * random.uniform_double();
      if (!screens.hide(place, box_at(other, half))) continue;
      ++hidden;
      for (int line = 0; line < 4; ++line) {
        const double x = random.uniform_double(), y = random.uniform_double(),
                     z = random.uniform_double();
        const glm::dvec3 end = other + (2.0 * glm::dvec3(x, y, z) - 1.0) * half;
        wrong += clear_share(building->scene(), access, building->local(place),
                             building->local(end)) > 0;
      }
    }
  });
  CHECK(hidden > 1000);
  CHECK(wrong == 0);
}

TEST_CASE("a triangle that does not meet a cell leaves the cell unchanged", "[assess][screens]") {
  // The shortest edges of narrow triangles lie on lines through a cell that the triangles do not
  // meet; then eight triangles that meet in the cell cover the slab. If the cell were cut along all
  // these lines, it would have more pieces than are kept, and would stay open.
  const glm::dvec2 middle(2.55, 4.05);
  std::vector<std::array<glm::dvec2, 3>> triangles;
  for (int i = 0; i < 60; ++i) {
    const double angle = glm::radians(60 + 0.4 * i);
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), aside(-along.y, along.x);
    const glm::dvec2 beside = middle + 0.01 * ((7 * i) % 11 - 5) * aside;
    triangles.push_back({beside + 2.9 * along, beside + 3.0 * along, beside - along + 1.5 * aside});
  }
  const std::array<glm::dvec2, 8> rim{
      {{0, 0}, {2.6, 0}, {5, 0}, {5, 4.2}, {5, 8}, {2.3, 8}, {0, 8}, {0, 3.8}}};
  for (size_t i = 0; i < rim.size(); ++i)
    triangles.push_back({middle, rim[i], rim[(i + 1) % rim.size()]});
  const auto scene = with_level(*test::described_text(storeys("white50")), triangles);
  const LevelScreens screens(building_of(*scene)->scene());
  CHECK(screens.hide({middle, 0.02}, box_at({middle, 5.7}, 0.02)));
}

TEST_CASE("a narrow triangle closes no cell that it does not cover", "[assess][screens]") {
  const std::vector<std::array<glm::dvec2, 3>> narrow{{{{0, 0}, {5, 7}, {5, 8}}}};
  const auto scene = with_level(*test::described_text(storeys("white50")), narrow);
  const LevelScreens screens(building_of(*scene)->scene());
  const auto hidden_at = [&](double x, double y) {
    return screens.hide({x, y, 0.02}, box_at({x, y, 5.7}, 0.02));
  };
  CHECK(hidden_at(4.9, 7.35));         // in the triangle
  CHECK_FALSE(hidden_at(4.6, 7.85));   // beside the triangle
  CHECK_FALSE(hidden_at(4.6, 5.6));    // beside the triangle
  CHECK_FALSE(hidden_at(0.5, 0.75));   // the triangle is narrower than a cell here
  CHECK_FALSE(hidden_at(0.15, 7.85));  // at a corner of its bounding box
}

TEST_CASE("the light of the codes is that of all luminaires, with or without screens",
          "[assess][screens]") {
  check_light(*test::described_text(storeys("white50")));
}

TEST_CASE("a level that takes too long to divide into cells is left out, and the light is the same",
          "[assess][screens]") {
  constexpr double wide_m = 130;
  std::vector<std::array<glm::dvec2, 3>> triangles{{{{0, 0}, {wide_m, 0}, {wide_m, wide_m}}},
                                                   {{{0, 0}, {wide_m, wide_m}, {0, wide_m}}}};
  const auto whole = with_level(*test::described_text(storeys("white50")), triangles);
  const auto hides = [](const SceneDescription& scene) {
    const LevelScreens screens(building_of(scene)->scene());
    // The slab above this one is unchanged.
    CHECK(screens.hide({2, 2, 5.02}, box_at({2, 2, 8.7}, 0.1)));
    return screens.hide({2, 2, 0.02}, box_at({2, 2, 5.7}, 0.1));
  };
  CHECK(hides(*whole));
  for (size_t cells = 0; cells <= limits::screen_visits; cells += limits::screen_cells / 2)
    triangles.push_back({{{0, 0}, {wide_m, wide_m - 1}, {wide_m, wide_m}}});
  const auto above_limit = with_level(*test::described_text(storeys("white50")), triangles);
  CHECK_FALSE(hides(*above_limit));
  check_light(*above_limit);
}

}  // namespace luxodus

// Pictures of a building from above, without what lies above a cut.
#include <catch2/catch.hpp>

#include "actors/results/pictures/film.hpp"
#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/pictures/pixel_tracer.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A closed room, seen from 6 m above its ceiling.
const std::string room_from_above = R"([[material]]
name = "wall"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.5]
material = "wall"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [2, 1.5, 2.4]
flux_lm = 1000
[[camera]]
name = "above"
eye = [2, 1.5, 8.5]
target = [2, 1.5, 0]
up = [0, 1, 0]
vertical_fov_deg = 15
width = 16
height = 12
)";

double mean_luminance(const LocalRun& run, const Camera& camera) {
  PictureOptions options;
  options.raw = true;
  const PictureFlux flux = picture_flux(run, options);
  ViewPasses passes(run, camera, 0, flux.radiance.get(), flux.sight, {});
  REQUIRE(passes.add(8, options));
  const ShownView view(passes.picture(), 8, options, 1);
  double sum = 0;
  for (size_t i = 0; i < view.shown().pixels(); ++i)
    sum += static_cast<double>(view.shown().xyz[3 * i + 1]);
  return sum / static_cast<double>(view.shown().pixels());
}

}  // namespace

TEST_CASE("a camera that cuts sees into a closed room from above, in its own light", "[display]") {
  const auto run = traced(room_from_above, 1 << 14);
  Camera camera = run->scene().description->cameras[0];
  CHECK(mean_luminance(*run, camera) == 0);  // the ceiling's upper side is dark
  camera.cut_m = 2.1;
  const double from_above = mean_luminance(*run, camera);
  // An eye below the ceiling that sees the same part of the floor.
  Camera below = run->scene().description->cameras[0];
  below.eye.z = 2.05;
  below.vertical_fov_deg =
      2 * 180 / 3.14159265358979 * std::atan(8.5 * std::tan(7.5 * 3.14159265358979 / 180) / 2.05);
  CHECK(from_above > 0);
  CHECK(from_above == Approx(mean_luminance(*run, below)).epsilon(0.05));
}

TEST_CASE("rays begin at the cut, and those that do not meet it meet nothing", "[display]") {
  Camera camera;
  camera.eye = {0, 0, 10};
  camera.target = {10, 0, 9};
  camera.cut_m = 2;
  const glm::dvec3 origin(1, 2, 0.5);
  const Pinhole pinhole(camera, origin);
  const Ray down = pinhole.ray(camera.width / 2.0, camera.height - 1.0);
  CHECK(down.origin.z == Approx(1.5));  // 2 m, in local coordinates
  CHECK(down.direction.z < 0);
  const Ray up = pinhole.ray(camera.width / 2.0, 0.5);
  CHECK(up.origin.z > 1e5);
  CHECK(up.direction.z == 1);
  camera.cut_m.reset();
  const Ray whole = Pinhole(camera, origin).ray(camera.width / 2.0, camera.height - 1.0);
  CHECK(whole.origin.z == Approx(9.5));
  CHECK(whole.direction == down.direction);
}

TEST_CASE("films pass no camera that cuts, and take no cut from their lens", "[display][film]") {
  Camera whole;
  whole.name = "whole";
  whole.eye = {0, 0, 10};
  Camera cut = whole;
  cut.name = "storey";
  cut.eye = {1, 0, 10};
  cut.cut_m = 2;
  const auto refused = cameras_through({{0, whole}, {1, cut}}, 2, whole);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("\"storey\" cuts the building") != std::string::npos);
  Camera last = whole;
  last.eye = {1, 0, 10};
  const auto film = cameras_through({{0, whole}, {1, last}}, 2, cut);
  REQUIRE(film.ok());
  for (const Camera& camera : film.value()) CHECK_FALSE(camera.cut_m);
}

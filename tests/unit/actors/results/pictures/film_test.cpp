// Films along a route: the position of each frame, and that a frame is an ordinary picture.
#include "actors/results/pictures/film.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "actors/results/pictures/shared_exposure.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/formats/images/image_file.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Two legs of 3 and 4 m with a corner, then a flight of stairs of 5 m.
EscapeRoute bent_route() {
  EscapeRoute route;
  route.name = "out";
  route.path = {{1, 1, 0}, {4, 1, 0}, {4, 5, 0}, {4, 9, 3}};
  route.width_m = 1.2;
  return route;
}

Camera lens() {
  Camera camera;
  camera.width = 12;
  camera.height = 8;
  camera.vertical_fov_deg = 50;
  return camera;
}

std::vector<Camera> walked(const EscapeRoute& route, const FilmedWalk& walk) {
  auto cameras = cameras_of(route, walk, lens());
  if (!cameras.ok()) FAIL(cameras.problem().text());
  return std::move(cameras).value();
}

/// A hall with a camera at `eye`, and a route along its middle.
std::string hall() {
  return R"(
[[material]]
name = "grey"
reflectance = 0.5
[[object]]
name = "hall"
shape = "room"
low = [0, 0, 0]
high = [6, 3, 3]
material = "grey"
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [4, 1.5, 2.9]
flux_lm = 1000
[[route]]
name = "along the hall"
path = [[1, 1.5, 0], [5, 1.5, 0]]
width = 1.2
[[camera]]
name = "at two metres"
eye = [2, 1.5, 1.6]
target = [3.5, 1.5, 1.6]
vertical_fov_deg = 50
width = 12
height = 8
)";
}

std::vector<float> pixels_of(const std::filesystem::path& file) {
  const auto image = read_png(file.string());
  if (!image.ok()) FAIL(image.problem().text());
  return image->texels;
}

}  // namespace

TEST_CASE("a film has a frame for every step of a walk, at its speed along the route",
          "[display]") {
  const EscapeRoute route = bent_route();
  REQUIRE(length_of(route) == Approx(12));
  const std::vector<Camera> cameras = walked(route, {1.5, 12, 1.6});
  // 12 m at 1.5 m/s take 8 s, and both ends are included.
  REQUIRE(cameras.size() == 8 * 12 + 1);
  for (size_t k = 0; k < cameras.size(); ++k) {
    const glm::dvec3 foot = place_along(route, 0.125 * static_cast<double>(k));
    CHECK(glm::length(cameras[k].eye - foot - glm::dvec3(0, 0, 1.6)) < 1e-9);
    if (k == 0) continue;
    // Frames are spaced by the speed; across a corner they are closer.
    const double apart = glm::length(cameras[k].eye - cameras[k - 1].eye);
    CHECK(apart < 0.125 + 1e-9);
    if (k != 24 && k != 25 && k != 56 && k != 57) CHECK(apart == Approx(0.125));
  }
  CHECK(glm::length(cameras.back().eye - glm::dvec3(4, 9, 4.6)) < 1e-9);
  CHECK(walked(route, {3, 12, 1.6}).size() == 49);
  CHECK(walked(route, {1.5, 1, 1.6}).size() == 9);
  CHECK(walked(route, {7, 1, 1.6}).size() == 2);  // the end lies between two frames
  CHECK(cameras[0].width == 12);
  CHECK(cameras[0].vertical_fov_deg == 50);
}

TEST_CASE("a walker looks along the route, and turns before a corner", "[display]") {
  const std::vector<Camera> cameras = walked(bent_route(), {1, 10, 1.2});
  const auto gaze = [&](size_t k) { return glm::normalize(cameras[k].target - cameras[k].eye); };
  CHECK(glm::length(gaze(0) - glm::dvec3(1, 0, 0)) < 1e-9);
  CHECK(gaze(25).y > 0.5);  // half a metre before the corner
  CHECK(glm::length(gaze(30) - glm::dvec3(0, 1, 0)) < 1e-9);
  CHECK(glm::length(gaze(120) - glm::dvec3(0, 0.8, 0.6)) < 1e-9);  // at the end, up the stairs
  // The gaze never turns by more than a few degrees between frames.
  for (size_t k = 1; k < cameras.size(); ++k) CHECK(glm::dot(gaze(k), gaze(k - 1)) > 0.98);
}

TEST_CASE("a walk with too many frames is rejected with its route", "[display]") {
  const auto refused = cameras_of(bent_route(), {0.01, 240, 1.6}, lens());
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("\"out\"") != std::string::npos);
  CHECK(refused.problem().what.find("50000 frames") != std::string::npos);
}

TEST_CASE("a frame is the picture of a camera at its place, bit for bit", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(hall(), 1 << 14);
  const SceneDescription& scene = *run->scene().description;
  PictureOptions options;
  options.paths_per_pixel = 8;
  REQUIRE(render_views(folder.path(), *run, "", options, {}).ok());
  auto cameras = cameras_of(scene.routes[0], {1, 1, 1.6}, scene.cameras[0]);
  REQUIRE(cameras.ok());
  REQUIRE(cameras->size() == 5);
  CHECK(cameras.value()[1].eye == scene.cameras[0].eye);
  double last = 0;
  const auto made =
      render_film(folder / "film", *run, {cameras.value()}, options, [&](double frames) {
        CHECK(frames >= last);
        last = frames;
      });
  REQUIRE(made.ok());
  CHECK(made.value() == 5);
  CHECK(last == Approx(5));
  for (const char* frame : {"000000.png", "000004.png"})
    CHECK(std::filesystem::exists(folder / "film" / frame));
  CHECK(name_of_frame(4) == "000004.png");
  const auto still = pixels_of(folder / "views/at_two_metres.png");
  CHECK(pixels_of(folder / "film/000001.png") == still);
  CHECK(pixels_of(folder / "film/000002.png") != still);
  REQUIRE(render_film(folder / "human", *run, {cameras.value(), true}, options, {}).ok());
  CHECK(pixels_of(folder / "human/000001.png") ==
        pixels_of(folder / "views/at_two_metres_human.png"));
}

TEST_CASE("the frames of a film share one exposure, also across states", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(hall(), 1 << 14);
  const SceneDescription& scene = *run->scene().description;
  const auto cameras = cameras_of(scene.routes[0], {1, 1, 1.6}, scene.cameras[0]);
  REQUIRE(cameras.ok());
  PictureOptions options;
  options.paths_per_pixel = 8;
  SharedExposure shared(folder.path());
  options.exposed_with = &shared;
  REQUIRE(render_film(folder / "film", *run, {cameras.value()}, options, {}).value() == 5);
  CHECK(shared.pictures() == 5);
  CHECK_FALSE(std::filesystem::exists(folder / "film/000000.png"));
  const auto exposure = shared.write(2);
  REQUIRE(exposure.ok());
  options.exposed_with = nullptr;
  options.exposure = exposure.value();
  REQUIRE(render_views(folder.path(), *run, "", options, {}).ok());
  CHECK(pixels_of(folder / "film/000001.png") == pixels_of(folder / "views/at_two_metres.png"));
  // Two states of the same light are the same film.
  options.exposure.reset();
  SharedExposure of_states(folder.path());
  options.exposed_with = &of_states;
  const FilmedStates states{3, [&](size_t) -> Result<std::shared_ptr<const LocalRun>> {
                              return std::shared_ptr<const LocalRun>(
                                  std::shared_ptr<const LocalRun>(), run.get());
                            }};
  REQUIRE(render_film(folder / "states", states, {cameras.value()}, options, {}).value() == 5);
  REQUIRE(of_states.write(2).ok());
  for (size_t k = 0; k < 5; ++k)
    CHECK(pixels_of(folder / "states" / name_of_frame(k)) ==
          pixels_of(folder / "film" / name_of_frame(k)));
}

TEST_CASE("an interrupted film keeps whole frames, and none of an earlier one", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(hall(), 1 << 13);
  const SceneDescription& scene = *run->scene().description;
  const auto cameras = cameras_of(scene.routes[0], {1, 1, 1.6}, scene.cameras[0]);
  REQUIRE(cameras.ok());
  std::atomic<bool> interrupt{false};
  PictureOptions options;
  options.paths_per_pixel = 4;
  options.interrupt = &interrupt;
  REQUIRE(render_film(folder.path(), *run, {cameras.value()}, options, {}).value() == 5);
  std::ofstream(folder / "notes.txt") << "not a frame";
  SharedExposure shared(folder.path());
  const bool shares = GENERATE(false, true);
  if (shares) options.exposed_with = &shared;
  const auto made = render_film(folder.path(), *run, {cameras.value()}, options,
                                [&](double frames) { interrupt = frames > 2.1; });
  REQUIRE(made.ok());
  CHECK(made.value() == 2);
  if (shares) REQUIRE(shared.write(2).ok());
  CHECK(std::filesystem::exists(folder / "000001.png"));
  for (const char* gone : {"000002.png", "000003.png", "000004.png"})
    CHECK_FALSE(std::filesystem::exists(folder / gone));
  CHECK(std::filesystem::exists(folder / "notes.txt"));
}

namespace {

Keyframe key(double time_s, const std::string& name, const glm::dvec3& eye,
             const glm::dvec3& target, double fov_deg = 50) {
  Keyframe out{time_s, lens()};
  out.camera.name = name;
  out.camera.eye = eye;
  out.camera.target = target;
  out.camera.vertical_fov_deg = fov_deg;
  return out;
}

}  // namespace

TEST_CASE("a film through cameras reaches each of them at its time, without a corner",
          "[display]") {
  const std::vector<Keyframe> keys{key(2, "a", {0, 0, 1.6}, {10, 0, 1.6}, 40),
                                   key(4, "b", {2, 0, 1.6}, {4, 2, 1.6}, 60),
                                   key(8, "c", {2, 6, 1}, {2, 7, 1})};
  const auto found = cameras_through(keys, 10, lens());
  REQUIRE(found.ok());
  const std::vector<Camera>& cameras = found.value();
  REQUIRE(cameras.size() == 61);
  for (const Keyframe& k : keys) {
    const Camera& at = cameras[static_cast<size_t>(std::lround((k.time_s - 2) * 10))];
    CHECK(glm::length(at.eye - k.camera.eye) < 1e-9);
    const glm::dvec3 gaze = glm::normalize(k.camera.target - k.camera.eye);
    CHECK(glm::length(glm::normalize(at.target - at.eye) - gaze) < 1e-9);
    CHECK(at.vertical_fov_deg == Approx(k.camera.vertical_fov_deg));
  }
  CHECK(cameras[10].vertical_fov_deg == Approx(50));
  CHECK(cameras[0].width == 12);
  // Steps change little from one to the next, also at the camera in the middle.
  for (size_t k = 2; k < cameras.size(); ++k) {
    const glm::dvec3 step = cameras[k].eye - cameras[k - 1].eye;
    const glm::dvec3 before = cameras[k - 1].eye - cameras[k - 2].eye;
    CHECK(glm::length(step - before) < 0.015);
  }
  // Between two cameras it is straight and uniform.
  const auto straight = cameras_through({keys[0], keys[1]}, 10, lens());
  REQUIRE(straight.ok());
  for (size_t k = 0; k < straight->size(); ++k)
    CHECK(straight.value()[k].eye.x == Approx(0.1 * static_cast<double>(k)).margin(1e-9));
}

TEST_CASE("cameras that make no film are rejected with a remedy", "[display]") {
  const auto refused = [](const std::vector<Keyframe>& keys, double fps = 10) {
    const auto cameras = cameras_through(keys, fps, lens());
    REQUIRE_FALSE(cameras.ok());
    return cameras.problem().what;
  };
  const Keyframe a = key(0, "a", {0, 0, 1}, {1, 0, 1}), b = key(2, "b", {1, 0, 1}, {2, 0, 1});
  CHECK(refused({a}).find("two cameras") != std::string::npos);
  CHECK(refused({b, a}).find("\"a\" comes at 0 s") != std::string::npos);
  CHECK(refused({a, key(0, "b", {1, 0, 1}, {2, 0, 1})}).find("order") != std::string::npos);
  CHECK(refused({a, key(1e6, "b", {1, 0, 1}, {2, 0, 1})}).find("50000 frames") !=
        std::string::npos);
  CHECK(refused({a, key(2, "back", {1, 0, 1}, {0, 0, 1})}).find("turns around") !=
        std::string::npos);
}

TEST_CASE("films of things whose file names would be equal have files of their own", "[display]") {
  SceneDescription scene;
  for (const char* name : {"to the door", "to_the door", "To The Door"}) {
    scene.routes.emplace_back();
    scene.routes.back().name = name;
  }
  CHECK(film_names(scene) ==
        std::vector<std::string>{"to_the_door", "to_the_door-2", "To_The_Door-3"});
  CHECK(film_names(scene, "to the door").back() == "to_the_door-4");
}

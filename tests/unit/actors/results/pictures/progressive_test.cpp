// Pictures in passes: the same bits as at once, and where they end.
#include <catch2/catch.hpp>
#include <cmath>

#include "actors/results/pictures/pictures.hpp"
#include "tests/kit/read_exr.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"
#include "tests/unit/actors/results/pictures/smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// X, Y and Z of the first camera in a file.
void check_file(const std::filesystem::path& file, const TracedPicture& wanted) {
  const ExrImage image = read_exr(file);
  const ExrChannel* y = image.find("XYZ.Y");
  REQUIRE(y != nullptr);
  for (size_t i = 0; i < wanted.light.pixels(); ++i)
    CHECK(y->values[i] == wanted.light.xyz[3 * i + 1]);
}

TracedPicture at_once(const LocalRun& run, int paths, bool raw = true) {
  PictureOptions options;
  options.paths_per_pixel = paths;
  options.raw = raw;
  const auto flux = flux_radiance(run);
  return trace_picture(run, 0, options, flux.get());
}

}  // namespace

TEST_CASE(
    "a picture in passes equals the picture with as many paths at once, for any number of threads",
    "[display]") {
  const auto one = traced(smoky_room("17"), 1 << 14, 1);
  const auto three = traced(smoky_room("17"), 1 << 14, 3);
  const auto flux = flux_radiance(*three);
  ViewPasses view(*three, three->scene().description->cameras[0], 0, flux.get(),
                  make_emitter_sight(three->scene()));
  REQUIRE(view.add_first(4, {}));
  CHECK(view.first_picture().light.pixels() == 9 * 6);
  for (const int paths : {4, 4, 1, 59, 28}) REQUIRE(view.add(paths, {}));
  CHECK(view.paths() == 96);
  check_same(view.picture(), at_once(*one, 96));
}

TEST_CASE("pictures in passes with allocated paths equal those at once", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("17"), 1 << 14, 1);
  PictureOptions options;
  options.paths_per_pixel = 32;
  options.max_seconds = GENERATE(0.0, 1e4);  // no limit, and more than needed
  const auto rendered = render_views(folder.path(), *run, "", options, {});
  REQUIRE(rendered.ok());
  CHECK(rendered->paths == 32);
  const auto three = traced(smoky_room("17"), 1 << 14, 3);
  const TracedPicture allocated = at_once(*three, 32, false);
  check_file(folder / "views/view.exr", allocated);
  CHECK(allocated.light.xyz != at_once(*three, 32, true).light.xyz);
}

TEST_CASE("a first picture has the first paths of one pixel of four", "[display]") {
  const auto run = traced(smoky_room("17"), 1 << 14);
  const auto flux = flux_radiance(*run);
  ViewPasses view(*run, run->scene().description->cameras[0], 0, flux.get(),
                  make_emitter_sight(run->scene()));
  REQUIRE(view.add_first(4, {}));
  const TracedPicture first = view.first_picture();
  const TracedPicture whole = at_once(*run, 4);
  for (size_t y = 0; y < 6; ++y)
    for (size_t x = 0; x < 9; ++x)
      CHECK(first.light.xyz[3 * (9 * y + x) + 1] == whole.light.xyz[3 * (17 * 2 * y + 2 * x) + 1]);
}

TEST_CASE("pictures at their time limit end with whole passes of all views", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("17"), 1 << 14);
  PictureOptions options;
  options.paths_per_pixel = limits::max_paths_per_pixel;
  options.max_seconds = 1e-6;  // exceeded after the first pass
  options.progressive = true;
  const auto rendered = render_views(folder.path(), *run, "", options, {});
  REQUIRE(rendered.ok());
  CHECK_FALSE(rendered->interrupted);
  REQUIRE(rendered->paths == 4);
  check_file(folder / "views/view.exr", at_once(*run, 4));
  CHECK(read_exr(folder / "views/other.exr").find("filtered.XYZ.Y") != nullptr);
}

TEST_CASE("pictures end when the worst has the requested error", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("17"), 1 << 16);
  PictureOptions options;
  options.paths_per_pixel = 4096;
  options.target_error = 0.1;
  options.raw = true;
  int paths_seen = 0;
  const auto rendered =
      render_views(folder.path(), *run, "", options, [&](const PictureProgress& progress) {
        CHECK(progress.paths >= paths_seen);
        CHECK(progress.share <= 1);
        paths_seen = progress.paths;
      });
  REQUIRE(rendered.ok());
  CHECK(rendered->relative_error <= 0.1);
  REQUIRE(rendered->paths > 4);
  REQUIRE(rendered->paths < 4096);
  CHECK(paths_seen == rendered->paths);
  const TracedPicture same = at_once(*run, rendered->paths);
  check_file(folder / "views/view.exr", same);
  CHECK(relative_error(same.light, same.standard_error_y) <= 0.1);
}

/// Renders, interrupted when `when` says so, and checks the number of paths kept.
template <class When>
void check_interrupted(int paths, int kept, const When& when) {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("17"), 1 << 14);
  std::atomic<bool> interrupt{false};
  PictureOptions options;
  options.paths_per_pixel = paths;
  options.interrupt = &interrupt;
  const auto rendered =
      render_views(folder.path(), *run, "", options, [&](const PictureProgress& progress) {
        if (when(progress)) interrupt = true;
      });
  REQUIRE(rendered.ok());
  CHECK(rendered->interrupted);
  CHECK(rendered->paths == kept);
  check_file(folder / "views/view.exr", at_once(*run, kept));
}

TEST_CASE("interrupted pictures keep the last whole pass", "[display]") {
  check_interrupted(4096, 8, [](const PictureProgress& progress) { return progress.paths == 8; });
}

TEST_CASE("pictures interrupted during allocated paths keep those of all pixels", "[display]") {
  check_interrupted(32, 24, [](const PictureProgress& progress) { return progress.share > 0.76; });
}

TEST_CASE("the action after first pictures runs once, before any picture is complete",
          "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("1000"), 1 << 14);
  PictureOptions options;
  options.paths_per_pixel = 8;
  options.progressive = true;
  int calls = 0;
  const auto rendered =
      render_views(folder.path(), *run, "view", options, {}, [&]() -> Result<void> {
        ++calls;
        CHECK(std::filesystem::exists(folder / "views/view.png"));
        CHECK_FALSE(std::filesystem::exists(folder / "views/view.exr"));
        return {};
      });
  REQUIRE(rendered.ok());
  CHECK(calls == 1);
  check_file(folder / "views/view.exr", at_once(*run, 8));
}

TEST_CASE("a failure of the action after first pictures ends them", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(smoky_room("17"), 1 << 14);
  const auto rendered = render_views(folder.path(), *run, "", {}, {},
                                     [] { return Result<void>(problem("no space")); });
  REQUIRE_FALSE(rendered.ok());
  CHECK(rendered.problem().what == "no space");
  CHECK_FALSE(std::filesystem::exists(folder / "views/view.exr"));
}

TEST_CASE("a picture that exceeds the memory limit is rejected with its camera", "[display]") {
  const auto described = described_text(smoky_room("16384"));
  SceneDescription scene = *described;
  CHECK(check_views(scene, "", {}).ok());
  scene.cameras[0].height = 16384;
  const auto refused = check_views(scene, "", {});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("camera \"view\"") != std::string::npos);
  CHECK(refused.problem().what.find("16384 x 16384") != std::string::npos);
  CHECK(refused.problem().where.line == scene.cameras[0].place.line);
  CHECK(check_views(scene, "other", {}).ok());
}

TEST_CASE("the error of a picture is the root mean square of relative errors", "[display]") {
  XyzPicture light{4, 1, {0, 1, 0, 0, 2, 0, 0, 4, 0, 0, 0, 0}, {}};
  const std::vector<float> errors{0.1f, 0.4f, 0.4f, 0.0f};
  CHECK(relative_error(light, errors) == Approx(std::sqrt((0.01 + 0.04 + 0.01) / 4)));
  // The last pixel counts as a hundredth of the mean.
  CHECK(relative_error(light, {0, 0, 0, 0.0175f}) == Approx(0.5));
  CHECK(std::isnan(relative_error(light, {0, 0, 0, NAN})));
  // The worst two of two hundred pixels are left out.
  XyzPicture even{200, 1, std::vector<float>(600, 1.0f), {}};
  std::vector<float> with_two(200, 0.1f);
  with_two[7] = with_two[150] = 100;
  CHECK(relative_error(even, with_two) == Approx(0.1));
  with_two[9] = 1;
  CHECK(relative_error(even, with_two) > 0.12);
}

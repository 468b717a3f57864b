// Pictures as work for an executor: the same bits as pictures traced directly, whether threads or
// real nodes of this process trace the tiles.
#include "actors/results/pictures/picture_tiles.hpp"

#include <atomic>
#include <catch2/catch.hpp>

#include "actors/cast/process/process_executor.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"
#include "tests/unit/actors/results/pictures/smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr int asked_paths = 10;  // not a multiple of a tile's

/// Pictures of both cameras of the smoky room, traced on the threads of the run.
TracedPicture traced_here(const LocalRun& run, size_t camera, const PictureFlux& flux) {
  PictureOptions options;
  options.paths_per_pixel = asked_paths;
  return trace_picture(run, camera, options, flux.radiance.get());
}

/// With a first picture of the first camera, then in two passes.
void check_tiles(const LocalRun& run, Executor& executor) {
  PictureOptions options;
  options.paths_per_pixel = asked_paths;
  options.executor = &executor;
  const PictureFlux flux = picture_flux(run, options);
  REQUIRE(flux.sight);
  const auto& cameras = run.scene().description->cameras;
  PictureExecutor elsewhere(run, {{cameras[0], 0, true}, {cameras[1], 1, false}}, asked_paths,
                            options, flux);
  for (const size_t view : {size_t{0}, size_t{1}}) {
    ViewPasses passes(run, cameras[view], view, nullptr, nullptr);
    if (view == 0) {
      REQUIRE(elsewhere.add_first(view, passes));
      ViewPasses here(run, cameras[0], 0, flux.radiance.get(), flux.sight);
      REQUIRE(here.add_first(PictureExecutor::paths_of_tile, {}));
      check_same(passes.first_picture(), here.first_picture());
    }
    double share = 0;
    REQUIRE(elsewhere.add(view, passes, 4, [&](double done) { share = done; }));
    CHECK(share == 1);
    REQUIRE(elsewhere.add(view, passes, asked_paths - 4));
    check_same(passes.picture(), traced_here(run, view, flux));
  }
}

/// Nodes of this process that trace pictures of a run.
struct PictureNodes {
  explicit PictureNodes(const LocalRun& run) : states(run) {
    auto started = ProcessExecutor::start(run.shared_scene(), states, {});
    REQUIRE(started.ok());
    nodes = std::move(started).value();
  }
  PictureStates states;
  std::unique_ptr<ProcessExecutor> nodes;
};

}  // namespace

TEST_CASE("tiles traced by threads give the same pictures, bit for bit", "[display][tiles]") {
  const auto run = traced(smoky_room("70"), 1 << 14);
  ThreadExecutor threads(3);
  check_tiles(*run, threads);
}

TEST_CASE("tiles traced by nodes give the same pictures, bit for bit", "[display][tiles][nodes]") {
  const auto run = traced(smoky_room("70"), 1 << 14);
  PictureNodes nodes(*run);
  check_tiles(*run, *nodes.nodes->executor());
}

TEST_CASE("files of pictures that nodes trace are those of threads", "[display][tiles][nodes]") {
  const TemporaryFolder here, there;
  const auto run = traced(smoky_room("120"), 1 << 14);
  PictureOptions options;
  options.paths_per_pixel = 16;  // four of them allocated
  options.progressive = true;
  REQUIRE(render_views(here.path(), *run, "", options, {}).ok());
  PictureNodes nodes(*run);
  options.executor = nodes.nodes->executor().get();
  const auto rendered = render_views(there.path(), *run, "", options, {});
  REQUIRE(rendered.ok());
  CHECK(rendered->paths == 16);
  for (const std::string file : {"views/view.exr", "views/other.exr", "views/view_human.png"})
    CHECK(file_text(here / file) == file_text(there / file));
}

TEST_CASE("an interrupted picture on nodes is unchanged", "[display][tiles]") {
  const auto run = traced(smoky_room("70"), 1 << 14);
  ThreadExecutor threads(2);
  std::atomic<bool> interrupt{false};
  PictureOptions options;
  options.paths_per_pixel = asked_paths;
  options.executor = &threads;
  options.interrupt = &interrupt;
  const PictureFlux flux = picture_flux(*run, options);
  const Camera& camera = run->scene().description->cameras[0];
  PictureExecutor elsewhere(*run, {{camera}}, asked_paths, options, flux);
  ViewPasses passes(*run, camera, 0, nullptr, nullptr);
  REQUIRE(elsewhere.add(0, passes, 4));
  const TracedPicture before = passes.picture();
  CHECK_FALSE(elsewhere.add(0, passes, 4, [&](double) { interrupt = true; }));
  CHECK(passes.paths() == 4);
  check_same(passes.picture(), before);
  interrupt = false;
  REQUIRE(elsewhere.add(0, passes, 6));
  check_same(passes.picture(), traced_here(*run, 0, flux));
}

TEST_CASE("the text of pictures is read back", "[display][tiles]") {
  TiledPictures pictures;
  pictures.paths_per_pixel = 48;
  pictures.flux = std::string("any\nbytes\0 at all", 17);
  TiledView view;
  view.camera.eye = {0.1, 1 / 3.0, 2};
  view.camera.width = 17;
  view.number = 3;
  view.first = true;
  view.camera.height = 2;
  pictures.views = {view, view};
  pictures.views[1].flames_at_s = 1 / 3.0;
  for (int end = 48; end < 48 + 34 * 4; end += 4)
    pictures.views[1].ends.push_back({end, limits::max_paths_per_pixel});
  const auto read = parse_tiles(tiles_text(pictures));
  REQUIRE(read.ok());
  CHECK(read->paths_per_pixel == 48);
  CHECK(read->flux == pictures.flux);
  REQUIRE(read->views.size() == 2);
  CHECK(read->views[1].camera.eye == view.camera.eye);
  CHECK(read->views[1].camera.width == 17);
  CHECK(read->views[1].number == 3);
  CHECK_FALSE(read->views[0].flames_at_s);
  CHECK(read->views[1].flames_at_s == 1 / 3.0);
  CHECK(read->views[1].first);
  CHECK(read->views[0].ends.empty());
  CHECK(read->views[1].ends == pictures.views[1].ends);
}

TEST_CASE("malformed text of pictures is rejected", "[display][tiles]") {
  TiledPictures pictures;
  pictures.paths_per_pixel = 48;
  pictures.views.emplace_back();
  const std::string good = tiles_text(pictures);
  REQUIRE(parse_tiles(good).ok());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& text :
       {std::string(), std::string("{}\n"), std::string("[1, 2"), good.substr(0, good.size() - 1),
        with("\"width\":640", "\"width\":0"), with("\"width\":640", "\"width\":1000000000"),
        with("\"width\":640", "\"width\":\"wide\""),
        with("\"paths_per_pixel\":48", "\"paths_per_pixel\":0"),
        with("\"number\":0", "\"number\":70000"), with("\"ends\":false", "\"ends\":true"),
        with("\"ends\":false", "\"ends\":4"), with("\"views\":[", "\"views\":[7,")}) {
    CAPTURE(text);
    CHECK_FALSE(parse_tiles(text).ok());
  }
}

TEST_CASE("paths that end before they begin are rejected", "[display][tiles]") {
  TiledPictures pictures;
  pictures.paths_per_pixel = 48;
  pictures.views.emplace_back();
  pictures.views[0].camera.width = pictures.views[0].camera.height = 1;
  pictures.views[0].ends = {{48, 52}};
  CHECK(parse_tiles(tiles_text(pictures)).ok());
  pictures.views[0].ends = {{48, 44}};
  CHECK_FALSE(parse_tiles(tiles_text(pictures)).ok());
}

TEST_CASE("a flux with another seed is rejected by makers of pictures", "[display][tiles]") {
  const auto run = traced(smoky_room("12"), 1 << 12);
  PictureOptions options;
  ThreadExecutor threads(1);
  options.executor = &threads;
  TiledPictures pictures;
  pictures.paths_per_pixel = 4;
  pictures.views.emplace_back();
  pictures.flux = picture_flux(*run, options).bytes;
  const LocalRun same(run->shared_scene(), run->seed(), 1);
  CHECK(PictureStates(same).make(tiles_text(pictures)).ok());
  const LocalRun other(run->shared_scene(), run->seed() + 1, 1);
  PictureStates states(other);
  const auto made = states.make(tiles_text(pictures));
  REQUIRE_FALSE(made.ok());
  CHECK(made.problem().what.find("seed") != std::string::npos);
}

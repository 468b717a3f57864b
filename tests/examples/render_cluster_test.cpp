// Pictures of a finished run traced by nodes: the files of threads, byte for byte.
#include "tests/examples/cluster_kit.hpp"

using namespace luxodus::program;

namespace {

/// A room in smoke seen by two cameras.
std::string filmed_room(const TemporaryFolder& folder) {
  const fs::path path = folder / "room.toml";
  std::ofstream(path) << R"(title = "Room"
[run]
voxel_edge_m = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [6, 2, 3]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [3, 0, 2.9]
flux_lm = 1000
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.3
albedo = 0.6
[[camera]]
name = "along"
eye = [0.5, 0, 1.6]
target = [6, 0, 1.5]
width = 120
height = 90
[[camera]]
name = "across"
eye = [3, -1.8, 1.6]
target = [3, 2, 1.5]
width = 40
height = 30
)";
  return path.string();
}

/// The scene, traced into `name` of the folder without pictures.
void trace_run(const TemporaryFolder& folder, const std::string& scene, const std::string& name) {
  const Outcome run = run_luxodus(
      folder, "run " + scene + " --particles 40k --no-views --out " + (folder / name).string());
  INFO(run.err);
  REQUIRE(run.code == 0);
}

/// `keys`: of the table [render].
ClusterText rendered(const std::string& scene, const std::string& keys) {
  ClusterText text;
  text.workers = 2;
  text.scene = scene;
  text.run = "";
  text.more = "[render]\n" + keys + "[timeouts]\nstart_s = 20\nlost_s = 20\n";
  return text;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file.good());
  return {std::istreambuf_iterator<char>(file), {}};
}

void check_same_views(const fs::path& a, const fs::path& b) {
  for (const char* file : {"along.exr", "along.png", "along_human.png", "along_luminance.png",
                           "across.exr", "across.png"})
    CHECK(bytes_of(a / "views" / file) == bytes_of(b / "views" / file));
}

}  // namespace

TEST_CASE("pictures by nodes of a process or of a cluster are those of threads",
          "[cluster][render]") {
  const TemporaryFolder folder;
  const std::string scene = filmed_room(folder);
  for (const char* name : {"here", "nodes", "out"}) trace_run(folder, scene, name);
  const auto render = [&](const std::string& rest) {
    const Outcome outcome = run_luxodus(folder, "render " + rest + " --paths 12");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
  };
  render((folder / "here").string());
  render((folder / "nodes").string() + " --nodes 3");
  check_same_views(folder / "here", folder / "nodes");
  Process up(LUX_PROGRAM,
             {"cluster", "up", write_cluster(folder, rendered(scene, "paths = 12\n"))});
  const int code = up.wait();
  INFO(up.text());
  REQUIRE(code == 0);
  CHECK(up.said("n1 is there"));
  check_same_views(folder / "here", folder / "out");
}

TEST_CASE("pictures continue when a worker is killed, with the same bits", "[cluster][render]") {
  const TemporaryFolder folder;
  const std::string scene = filmed_room(folder);
  for (const char* name : {"here", "out"}) trace_run(folder, scene, name);
  const Outcome here = run_luxodus(folder, "render " + (folder / "here").string() + " --paths 96");
  INFO(here.err);
  REQUIRE(here.code == 0);
  const std::string cluster = write_cluster(folder, rendered(scene, "paths = 96\n"));
  const auto first = node(cluster, "n0"), controller = node(cluster, "controller");
  REQUIRE(controller->says("n0 is there"));
  first->kill(SIGKILL);
  const auto second = node(cluster, "n1");
  const int code = controller->wait();
  INFO(controller->text());
  REQUIRE(code == 0);
  CHECK(second->wait() == 0);
  check_same_views(folder / "here", folder / "out");
}

TEST_CASE("a cluster that should render a missing run says so", "[cluster][render][failure]") {
  const TemporaryFolder folder;
  const std::string scene = filmed_room(folder);
  const std::string file = write_cluster(folder, rendered(scene, "paths = 4\n"));
  Process up(LUX_PROGRAM, {"cluster", "up", file});
  const int code = up.wait();
  INFO(up.text());
  CHECK(code == 2);
  CHECK(up.said("flux.lux"));
}

// Assessments traced by the processes of a cluster.
#include "tests/examples/cluster_kit.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;

namespace {

/// A corridor in smoke with a lamp and a sign.
std::string smoky_corridor(const TemporaryFolder& folder) {
  const fs::path path = folder / "corridor.toml";
  std::ofstream(path) << std::string(R"(title = "Corridor"
[[object]]
name = "corridor"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "grey50"
)") + luxodus::test::middle_lamp +
                             luxodus::test::exit_sign_at("[11.95, 0, 2.2]") +
                             R"(lighting = "internal"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.5
albedo = 0.6
[assessment]
irritant_smoke = false
spacing_m = 2
rules = ["en1838-2013"]
[[route]]
name = "way"
path = [[1, 0, 0], [11, 0, 0]]
width = 1.6
[[scenario]]
name = "failed"
operation = "emergency"
)";
  return path.string();
}

/// `keys`: of the table [assess].
ClusterText assessed(const std::string& scene, const std::string& keys = "rounds = 3\n") {
  ClusterText text;
  text.workers = 2;
  text.scene = scene;
  text.run = "";
  text.more = "[assess]\n" + keys + "[timeouts]\nstart_s = 20\nlost_s = 20\n";
  return text;
}

std::string contents(const fs::path& path) {
  std::ifstream file(path);
  REQUIRE(file.good());
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a cluster gives an assessment the verdicts of threads", "[cluster][assess]") {
  const TemporaryFolder folder;
  const std::string scene = smoky_corridor(folder);
  const Outcome here =
      run_luxodus(folder, "assess " + scene + " --rounds 3 --out " + (folder / "here").string());
  INFO(here.err);
  REQUIRE(here.code == 0);
  Process up(LUX_PROGRAM, {"cluster", "up", write_cluster(folder, assessed(scene))});
  const int code = up.wait();
  INFO(up.text());
  REQUIRE(code == 0);
  // A process that comes late may find that the other has traced everything.
  CHECK((up.said("n0 is there") || up.said("n1 is there")));
  for (const char* file : {"sights.csv", "checks.csv"})
    CHECK(contents(folder / "out" / file) == contents(folder / "here" / file));
  CHECK(fs::exists(folder / "out" / "report.html"));
}

TEST_CASE("an assessment continues when a worker is killed, with the same verdicts",
          "[cluster][assess]") {
  const TemporaryFolder folder;
  const std::string scene = smoky_corridor(folder);
  const Outcome here =
      run_luxodus(folder, "assess " + scene + " --rounds 3 --out " + (folder / "here").string());
  REQUIRE(here.code == 0);
  const std::string cluster = write_cluster(folder, assessed(scene));
  const auto first = node(cluster, "n0"), controller = node(cluster, "controller");
  REQUIRE(controller->says("n0 is there"));
  first->kill(SIGKILL);
  const auto second = node(cluster, "n1");
  const int code = controller->wait();
  INFO(controller->text());
  REQUIRE(code == 0);
  CHECK(second->wait() == 0);
  CHECK(contents(folder / "out" / "sights.csv") == contents(folder / "here" / "sights.csv"));
}

TEST_CASE("a cluster follows routes over time as threads do", "[cluster][assess]") {
  const TemporaryFolder folder;
  const std::string scene = smoky_corridor(folder);
  std::string text = contents(scene);
  const size_t medium = text.find("[[medium]]"), next = text.find("[assessment]");
  text.replace(medium, next - medium, R"([[sign.leads_to]]
route = "way"
arrow = "ahead"
[[medium]]
name = "smoke"
kind = "layered"
[[medium.layer]]
z_low = [[0, 3], [100, 1]]
z_high = 3
albedo = 0.3
extinction = 2
[time]
to = 60
step = 30
)");
  std::ofstream(scene) << text;
  const Outcome here =
      run_luxodus(folder, "assess " + scene + " --rounds 2 --out " + (folder / "here").string());
  INFO(here.err);
  REQUIRE(here.code == 0);
  Process up(LUX_PROGRAM,
             {"cluster", "up", write_cluster(folder, assessed(scene, "rounds = 2\n"))});
  const int code = up.wait();
  INFO(up.text());
  REQUIRE(code == 0);
  const std::string guided = contents(folder / "out" / "guided.csv");
  CHECK(guided == contents(folder / "here" / "guided.csv"));
  CHECK(guided.find("not guided") != std::string::npos);  // in the end
  CHECK(guided.find(",guided") != std::string::npos);     // at first
}

TEST_CASE("an assessment without any worker ends, and says what to do",
          "[cluster][assess][failure]") {
  const TemporaryFolder folder;
  ClusterText text = assessed(smoky_corridor(folder));
  text.more = "[assess]\n[timeouts]\nstart_s = 1\nlost_s = 1\n";
  const auto controller = node(write_cluster(folder, text), "controller");
  CHECK(controller->wait() == 1);
  INFO(controller->text());
  CHECK(controller->said("no worker has come within 'start_s'"));
  CHECK_FALSE(fs::exists(folder / "out" / "report.html"));
}

TEST_CASE("a cluster's file that contradicts its table assess is rejected",
          "[cluster][assess][failure]") {
  const TemporaryFolder folder;
  const std::string scene = smoky_corridor(folder);
  const auto refused = [&](const ClusterText& text, const std::string& words) {
    const auto controller = node(write_cluster(folder, text), "controller");
    CHECK(controller->wait() == 2);
    INFO(controller->text());
    CHECK(controller->said(words));
  };
  ClusterText limited = assessed(scene);
  limited.run = "particles = 1000\n";
  refused(limited, "traces what its verdicts need");
  ClusterText viewed = assessed(scene);
  viewed.more += "[view]\nport = 0\n";
  refused(viewed, "leave out [view] or [assess]");
  ClusterText shown = assessed(scene);
  shown.more += "[display]\npictures = true\n";
  refused(shown, "leave out [display] or [assess]");
  refused(assessed(scene, "rounds = 9\n"), "rounds");
  refused(assessed(scene, "rules = [\"en1838-1066\"]\n"), "en1838-1066");
}

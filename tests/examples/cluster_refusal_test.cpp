// Processes that must not work together: both ends report the reason, and the run ends in bounded
// time with the names of missing nodes.
#include "tests/examples/cluster_kit.hpp"

using namespace luxodus::program;

namespace {

/// A controller with one file and a worker with another: both end, and both say why.
void check_refused(const std::string& of_controller, const std::string& of_worker,
                   const std::string& reason) {
  const auto controller = node(of_controller, "controller");
  const auto worker = node(of_worker, "n0");
  const int controller_code = controller->wait();
  const int worker_code = worker->wait();
  INFO(reason << "\n" << controller->text() << "\n" << worker->text());
  CHECK(controller_code == 1);
  CHECK(worker_code == 1);
  CHECK(controller->said("reason=" + reason));
  CHECK(worker->said("reason=" + reason));
  CHECK(controller->said("controller: the run did not begin"));
  CHECK(controller->said("n0 has not come (node "));
  CHECK(worker->said("n0: the controller has not been heard of for 2 s (start_s); node "));
}

std::string other_scene(const TemporaryFolder& folder) {
  const fs::path path = folder / "another_scene.toml";
  std::string text = slurp(smoke_tank());
  const size_t at = text.find("albedo = 0.3");
  REQUIRE(at != std::string::npos);
  std::ofstream(path) << text.replace(at, 12, "albedo = 0.4");
  return path.string();
}

}  // namespace

TEST_CASE("another scene is refused at both ends, with the reason", "[cluster]") {
  const TemporaryFolder folder;
  const std::string one = write_cluster(folder, {}, "one");
  ClusterText text;
  text.scene = other_scene(folder);
  check_refused(one, write_cluster(folder, text, "other"), "scene");
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("another level is refused at both ends, with the reason", "[cluster]") {
  const TemporaryFolder folder;
  const std::string one = write_cluster(folder, {}, "one");
  ClusterText text;
  text.run += "level = \"statistical\"\n";
  check_refused(one, write_cluster(folder, text, "other"), "level");
}

TEST_CASE("another topology is refused at both ends, with the reason", "[cluster]") {
  const TemporaryFolder folder;
  const auto linked = [&](const std::string& pairs, const std::string& file) {
    ClusterText text;
    text.workers = 3;
    text.more += "[topology]\nkind = \"links\"\npairs = [" + pairs + "]\n";
    return write_cluster(folder, text, file);
  };
  const std::string star = R"(["n0", "controller"], ["n0", "n1"], ["n0", "n2"])";
  const std::string chain = R"(["n0", "controller"], ["n0", "n1"], ["n1", "n2"])";
  check_refused(linked(star, "star"), linked(chain, "chain"), "topology");
}

TEST_CASE("another protocol, instruction set, build or fingerprint is refused at both ends",
          "[cluster]") {
  for (const std::string what : {"protocol", "isa", "build", "fingerprint"}) {
    const TemporaryFolder folder;
    const std::string cluster = write_cluster(folder, {});
    const auto controller = node(cluster, "controller");
    Process odd(LUX_ODD_NODE, {cluster, "n0", what});
    const int controller_code = controller->wait();
    const int odd_code = odd.wait();
    INFO(what << "\n" << controller->text() << "\n" << odd.text());
    CHECK(controller_code == 1);
    CHECK(odd_code == 1);
    CHECK(controller->said("reason=" + what));
    CHECK(odd.said("reason=" + what));
    CHECK(controller->said("n0 has not come (node "));
  }
}

TEST_CASE("a node whose key the other end does not list is turned away, and both ends say so",
          "[cluster]") {
  const TemporaryFolder folder;
  const auto keyed = [&](const std::string& keys) {
    ClusterText text;
    text.more += "[links]\nsame_host = \"tcp\"\n[[host]]\n[keys]\nfolder = \"" + keys + "\"\n";
    text.more.erase(text.more.find("[[host]]\n"), 9);
    return write_cluster(folder, text, keys);
  };
  const std::string ours = keyed("ours");
  const std::string theirs = keyed("theirs");
  REQUIRE(run_luxodus(folder, "keygen --cluster " + ours).code == 0);
  REQUIRE(run_luxodus(folder, "keygen --cluster " + theirs).code == 0);
  SECTION("the controller's key is not listed at the worker") {
    // Everything else about the controller matches: it knows the worker.
    for (const std::string name : {"n0.key", "n0.key.pub"})
      fs::copy_file(folder / "ours" / name, folder / "theirs" / name,
                    fs::copy_options::overwrite_existing);
    const auto controller = node(theirs, "controller");
    const auto worker = node(ours, "n0");
    const int controller_code = controller->wait();
    const int worker_code = worker->wait();
    INFO(controller->text() << "\n" << worker->text());
    CHECK(controller_code == 1);
    CHECK(worker_code == 1);
    CHECK(worker->said("zmq=turned_away"));
    CHECK(worker->said("connections were turned away"));
    CHECK(controller->said("zmq=refused_us"));
    CHECK(controller->said("does not list this node's key"));
  }
  SECTION("the worker has another key than the controller lists") {
    const auto controller = node(ours, "controller");
    const auto worker = node(theirs, "n0");
    const int controller_code = controller->wait();
    const int worker_code = worker->wait();
    INFO(controller->text() << "\n" << worker->text());
    CHECK(controller_code == 1);
    CHECK(worker_code == 1);
    CHECK(controller->said("n0 has not come"));
    CHECK(controller->said("zmq=handshake_failed"));
    CHECK(worker->said("zmq=handshake_failed"));
  }
}

TEST_CASE("a second cluster of one file with other results is refused, and the first continues",
          "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text;
  text.workers = 3;
  text.run = "particles = 1_200_000\n";
  text.more = "[timeouts]\nlost_s = 20\n" + slow_workers(text.workers);
  const std::string first = write_cluster(folder, text, "first");
  text.out = "elsewhere";
  const std::string second = write_cluster(folder, text, "second");
  SECTION("only its controller") {
    const RunningCluster nodes = start(first, 3);
    const auto intruder = node(second, "controller");
    CHECK(intruder->wait() == 1);
    INFO(intruder->text() << nodes.controller->text());
    CHECK(intruder->said("its workers are not free"));
    CHECK(intruder->said("works for the run whose results go to " + (folder / "out").string()));
    CHECK_FALSE(fs::exists(folder / "elsewhere"));
    CHECK(nodes.controller->wait() == 0);
    for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
    CHECK_FALSE(nodes.controller->said("lease=fenced"));
  }
  SECTION("all of it") {
    const RunningCluster nodes = start(first, 3);
    Process up(LUX_PROGRAM, {"cluster", "up", second});
    CHECK(up.wait() == 1);
    INFO(up.text());
    CHECK(up.said("its workers are not free"));
    CHECK(nodes.controller->wait() == 0);
  }
  SECTION("while the first is killed and begins anew") {
    RunningCluster nodes = start(first, 3);
    nodes.controller->kill(SIGKILL);
    CHECK(nodes.controller->wait() == 128 + SIGKILL);
    const auto intruder = node(second, "controller");
    CHECK(intruder->wait() == 1);
    CHECK(intruder->said("its workers are not free"));
    nodes.controller = node(first, "controller");
    CHECK(nodes.controller->wait() == 0);
    INFO(nodes.controller->text());
    for (const auto& worker : nodes.workers) CHECK(worker->wait() == 0);
  }
  check_plain_flux(folder, "1200k");
}

TEST_CASE("a run without one of its workers does not begin, and names it", "[cluster]") {
  const TemporaryFolder folder;
  ClusterText text;
  text.workers = 2;
  const std::string cluster = write_cluster(folder, text);
  const auto controller = node(cluster, "controller");
  const auto worker = node(cluster, "n0");
  const int controller_code = controller->wait();
  const int worker_code = worker->wait();
  INFO(controller->text() << "\n" << worker->text());
  CHECK(controller_code == 1);
  CHECK(controller->said("after 2 s (start_s) n1 has not come"));
  CHECK_FALSE(controller->said("n0 has not come"));
  CHECK(worker_code == 1);
  CHECK(worker->said("n0: the controller says: the run did not begin"));
  CHECK(worker->said("n1 has not come"));
  CHECK_FALSE(fs::exists(folder / "out"));
}

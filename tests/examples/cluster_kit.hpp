// Shared by tests of clusters: small clusters, and files for them.
#pragma once

#include <signal.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/process.hpp"

namespace luxodus::program {

using test::Process;

inline std::string smoke_tank() {
  return (fs::path(LUX_SOURCE_DIR) / "scenes/library/smoke_tank.toml").string();
}

/// The parts of a small cluster's file that tests change.
struct ClusterText {
  int workers = 1;
  std::string scene = smoke_tank();
  std::string run = "particles = 400_000\n";  // additional keys of [run]
  std::string out = "out";                    // in the folder
  std::string more = "[timeouts]\nstart_s = 2\nlost_s = 1\n";
  std::string links;                           // keys of [links]
  std::map<std::string, std::string> of_node;  // by name: additional keys of its [[node]]
  /// Ports on which nodes listen, by number, the controller last: then they connect over TCP. Each
  /// uses the following port, too. Empty: they use local sockets.
  std::vector<uint16_t> ports;
};

/// Events by which workers compute at a quarter of their speed, so that a run lasts as long with a
/// quarter of the particles, which the plain loop traces as well.
inline std::string slow_workers(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += "[[faults.event]]\nkind = \"slow\"\nnode = \"n" + std::to_string(i) +
            "\"\nat_s = 0\nlasts_s = 1000\nfactor = 4\n";
  return text;
}

/// A hall of 900 boxes, twice as large as a budget of 1 MiB, with short batches.
inline std::string boxes(const TemporaryFolder& folder) {
  const fs::path path = folder / "boxes.toml";
  std::ofstream(path) << R"(title = "Boxes in rows"
patch_edge_m = 5
[run]
batch_particles = 200
[[material]]
name = "white"
reflectance = "white80"
[[object]]
name = "hall"
shape = "room"
low = [0, 0, 0]
high = [31, 31, 4]
material = "white"
[[object]]
name = "box"
shape = "box"
low = [0.3, 0.3, 0]
high = [0.7, 0.7, 1]
material = "white"
one_patch = true
repeat = [{ count = 30, step = [1, 0, 0] }, { count = 30, step = [0, 1, 0] }]
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [15.5, 15.5, 3.9]
size = [0.6, 0.6]
distribution = "lambertian"
flux_lm = 3000
)";
  return path.string();
}

/// Writes FOLDER/FILE.toml: workers n0, n1, ... and a controller, each a process, on this machine.
/// All of a folder are the same run, whatever their names.
inline std::string write_cluster(const TemporaryFolder& folder, const ClusterText& text,
                                 const std::string& file = "cluster") {
  const fs::path path = folder / (file + ".toml");
  std::ofstream out(path);
  out << "[run]\nname = \"" << folder.path().filename().string().substr(8) << "\"\nscene = \""
      << text.scene << "\"\nout = \"" << (folder / text.out).string() << "\"\n"
      << text.run << "[[host]]\nname = \"here\"\n";
  for (int i = 0; i <= text.workers; ++i) {
    const std::string name = i < text.workers ? "n" + std::to_string(i) : "controller";
    out << "[[node]]\nname = \"" << name << "\"\n";
    if (i == text.workers) out << "role = \"controller\"\n";
    if (!text.ports.empty()) out << "port = " << text.ports.at(static_cast<size_t>(i)) << "\n";
    if (text.of_node.count(name) > 0) out << text.of_node.at(name);
  }
  out << text.more;
  const std::string links = (text.ports.empty() ? "" : "same_host = \"tcp\"\n") + text.links;
  if (!links.empty()) out << "[links]\n" << links;
  return path.string();
}

/// A node of a cluster, as `luxodus node` starts it.
inline std::unique_ptr<Process> node(const std::string& cluster, const std::string& name) {
  return std::make_unique<Process>(
      LUX_PROGRAM, std::vector<std::string>{"node", "--config", cluster, "--name", name});
}

struct RunningCluster {
  std::vector<std::unique_ptr<Process>> workers;
  std::unique_ptr<Process> controller;

  void await_begin() const {
    const bool begun = controller->says("run=begun");
    INFO(controller->text());
    REQUIRE(begun);
  }
  /// Tells all to end, and waits for that.
  void end() const {
    for (const auto& worker : workers) worker->kill(SIGTERM);
    controller->kill(SIGTERM);
    const int code = controller->wait();
    INFO(controller->text());
    CHECK(code == 130);
  }
};

/// All nodes of a cluster, once the run has begun.
inline RunningCluster start(const std::string& cluster, int workers) {
  RunningCluster nodes;
  nodes.controller = node(cluster, "controller");
  for (int i = 0; i < workers; ++i) nodes.workers.push_back(node(cluster, "n" + std::to_string(i)));
  nodes.await_begin();
  return nodes;
}

constexpr const char* endless = "particles = 1_000_000_000_000\n";

/// Checks that OUT holds the flux of this many particles of the plain loop. `how`: additional
/// options.
inline void check_plain_flux(const TemporaryFolder& folder, const std::string& particles,
                             const std::string& scene = smoke_tank(), const std::string& how = "") {
  REQUIRE(run_luxodus(folder, "run " + scene + " --no-views --particles " + particles + how +
                                  " --out " + (folder / "plain").string())
              .code == 0);
  const std::string flux = slurp(folder / "out" / "flux.lux");
  CHECK_FALSE(flux.empty());
  CHECK((flux == slurp(folder / "plain" / "flux.lux")));  // bytes that are no text
}

/// An integer in the result in OUT.
inline int64_t number_in(const TemporaryFolder& folder, const std::string& key) {
  const std::string result = slurp(folder / "out" / "result.json");
  const size_t at = result.find("\"" + key + "\": ");
  REQUIRE(at != std::string::npos);
  return std::stoll(result.substr(at + key.size() + 4));
}

inline int64_t particles_in(const TemporaryFolder& folder) {
  return number_in(folder, "particles");
}

/// Continues from OUT for somewhat more particles, and compares. Lost leases are made up for first,
/// which may extend it further.
inline void check_goes_on(const TemporaryFolder& folder, int64_t more = 100'000,
                          const std::string& scene = smoke_tank(), const std::string& how = "") {
  const int64_t farther = particles_in(folder) + more;
  REQUIRE(run_luxodus(folder, "run " + scene + " --resume --no-views --particles " +
                                  std::to_string(farther) + how + " --out " +
                                  (folder / "out").string())
              .code == 0);
  CHECK(particles_in(folder) >= farther);
  check_plain_flux(folder, std::to_string(particles_in(folder)), scene, how);
}

}  // namespace luxodus::program

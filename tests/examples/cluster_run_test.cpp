// Whole clusters as a user starts them: processes that connect over sockets, and give the results
// of the plain program, bit for bit.
#include "tests/examples/cluster_kit.hpp"
#include "tests/kit/test_length.hpp"

using namespace luxodus::program;

namespace {

/// A controller and three workers, each a process; `more` is added to the file.
fs::path cluster_file(const TemporaryFolder& folder, const std::string& more) {
  const fs::path file = folder / "cluster.toml";
  // A unique name, which distinguishes sockets of tests that run in parallel.
  std::ofstream(file) << "[run]\nname = \"" << folder.path().filename().string().substr(8)
                      << "\"\nscene = \"" << smoke_tank() << "\"\nparticles = 100_000\nout = \""
                      << (folder / "out").string()
                      << "\"\n[[host]]\nname = \"here\"\n[[node]]\nname = \"n\"\ncount = 3\n"
                         "[[node]]\nname = \"controller\"\nrole = \"controller\"\n"
                      << more;
  return file;
}

void check_same_flux(const TemporaryFolder& folder, const fs::path& cluster) {
  const Outcome up = run_luxodus(folder, "cluster up " + cluster.string());
  INFO(up.err);
  REQUIRE(up.code == 0);
  REQUIRE(run_luxodus(folder, "run " + smoke_tank() + " --particles 100k --no-views --out " +
                                  (folder / "plain").string())
              .code == 0);
  const std::string flux = slurp(folder / "out" / "flux.lux");
  CHECK(!flux.empty());
  CHECK(flux == slurp(folder / "plain" / "flux.lux"));
  CHECK(fs::exists(folder / "out" / "result.json"));
}

}  // namespace

TEST_CASE("four processes over local sockets leave the flux file of the plain loop", "[cluster]") {
  const TemporaryFolder folder;
  check_same_flux(folder, cluster_file(folder, ""));
}

TEST_CASE("processes that plan by a profile leave the flux file of the plain loop", "[cluster]") {
  const TemporaryFolder folder;
  const bool full = luxodus::test::in_full();
  const std::string particles = full ? "60000" : "4000";
  const fs::path cluster = folder / "cluster.toml";
  const std::string scene =
      full ? (fs::path(LUX_SOURCE_DIR) / "scenes/library/office_floor.toml").string()
           : boxes(folder);
  std::ofstream(cluster) << "[run]\nname = \"planned\"\nscene = \"" << scene
                         << "\"\nparticles = " << particles
                         << "\nprofile = \"its.profile\"\nout = \"" << (folder / "out").string()
                         << "\"\n[[host]]\nname = \"here\"\n[[node]]\nname = \"n\"\ncount = 2\n"
                            "[[node]]\nname = \"controller\"\nrole = \"controller\"\n"
                            "[budget]\nobject_bytes = \"1 MiB\"\nfibers = 256\n";
  const Outcome without = run_luxodus(folder, "cluster up " + cluster.string());
  CHECK(without.code != 0);
  CHECK((without.out + without.err).find("its.profile") != std::string::npos);
  const Outcome profiled = run_luxodus(folder, "profile " + cluster.string());
  INFO(profiled.err);
  REQUIRE(profiled.code == 0);
  CHECK(fs::exists(folder / "its.profile"));
  const Outcome up = run_luxodus(folder, "cluster up " + cluster.string());
  INFO(up.err);
  REQUIRE(up.code == 0);
  const std::string cells = profiled.out.substr(
      0, profiled.out.find(' '));  // "N objects, ...": this scene has cells only
  REQUIRE(run_luxodus(folder, "run " + scene + " --particles " + particles +
                                  " --no-views --cells " + cells + " --out " +
                                  (folder / "plain").string())
              .code == 0);
  const std::string flux = slurp(folder / "out" / "flux.lux");
  CHECK(!flux.empty());
  CHECK(flux == slurp(folder / "plain" / "flux.lux"));
}

TEST_CASE("a controller that traces alone in one process leaves the flux of the plain loop",
          "[cluster]") {
  const TemporaryFolder folder;
  const fs::path file = folder / "cluster.toml";
  std::ofstream(file) << "[run]\nname = \"alone\"\nscene = \"" << smoke_tank()
                      << "\"\nparticles = 100_000\nout = \"" << (folder / "out").string()
                      << "\"\n[[host]]\nname = \"here\"\n[[node]]\nname = \"controller\"\n"
                         "role = \"controller\"\ntraces = true\n";
  const Outcome run = run_luxodus(folder, "node --config " + file.string() + " --name controller");
  INFO(run.err);
  REQUIRE(run.code == 0);
  check_same_flux(folder, file);
}

TEST_CASE("a rehearsal of faults from the cluster's file leaves the flux of the plain loop",
          "[cluster]") {
  const TemporaryFolder folder;
  check_same_flux(folder, cluster_file(folder,
                                       "[faults]\ndelay_ms = 1\njitter_ms = 0.5\ntail_ms = 20\n"
                                       "tail_share = 0.02\nloss = 0.02\nduplication = 0.02\n"
                                       "reordering = 0.02\ncorruption = 0.01\n"
                                       "[[faults.event]]\nkind = \"pause\"\nnode = \"n1\"\n"
                                       "at_s = 0.5\nlasts_s = 0.5\n"
                                       "[[faults.event]]\nkind = \"cut\"\nnode = \"n0\"\n"
                                       "peer = \"controller\"\nat_s = 0.3\nlasts_s = 1\n"));
}

TEST_CASE("four processes over TCP with keys leave the flux file of the plain loop", "[cluster]") {
  const TemporaryFolder folder;
  const fs::path cluster =
      cluster_file(folder, "[links]\nsame_host = \"tcp\"\n[keys]\nfolder = \"keys\"\n");
  REQUIRE(run_luxodus(folder, "keygen --cluster " + cluster.string()).code == 0);
  check_same_flux(folder, cluster);
}

TEST_CASE("four hosts with addresses of their own leave the flux file of the plain loop",
          "[cluster]") {
  const TemporaryFolder folder;
  const std::string script = std::string(LUX_SOURCE_DIR) + "/tests/tools/four_hosts.sh";
  const int status =
      std::system((script + " " + LUX_PROGRAM + " " + smoke_tank() + " " + folder.path().string() +
                   " >" + (folder / "hosts").string() + " 2>&1")
                      .c_str());
  constexpr int not_here = 77;
  if (WEXITSTATUS(status) == not_here) {
    WARN("skipped: network namespaces need root and iproute2");
    return;
  }
  INFO(slurp(folder / "hosts"));
  REQUIRE(WEXITSTATUS(status) == 0);
  REQUIRE(run_luxodus(folder, "run " + smoke_tank() + " --particles 100k --no-views --out " +
                                  (folder / "plain").string())
              .code == 0);
  CHECK(slurp(folder / "out" / "flux.lux") == slurp(folder / "plain" / "flux.lux"));
}

TEST_CASE("a cluster with missing keys or scene says which, and starts nothing", "[cluster]") {
  const TemporaryFolder folder;
  const std::string node =
      "node --config " + cluster_file(folder, "[keys]\nfolder = \"keys\"\n").string() + " --name ";
  const Outcome keyless = run_luxodus(folder, node + "n0");
  CHECK(keyless.code == 2);
  CHECK(keyless.err.find("n0") != std::string::npos);
  const Outcome unknown = run_luxodus(folder, node + "nobody");
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("nobody") != std::string::npos);
  CHECK(run_luxodus(folder, node + "n0 --name n1").code == 2);
  CHECK_FALSE(fs::exists(folder / "out"));
}

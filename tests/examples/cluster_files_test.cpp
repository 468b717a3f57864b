// Keys and deployments as a user makes them: the files of `luxodus keygen` and `luxodus deploy`,
// and that their readers accept them.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

std::string example(const std::string& name) {
  return (fs::path(LUX_SOURCE_DIR) / "actors/apps/cli/examples" / name).string();
}
constexpr const char* examples[] = {"one_host.toml", "three_hosts.toml", "eight_hosts.toml"};

bool is_there(const std::string& tool) {
  return std::system(("command -v " + tool + " >/dev/null 2>&1").c_str()) == 0;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

/// Two workers and a controller on this machine.
std::string small_cluster(const TemporaryFolder& folder) {
  const fs::path file = folder / "it's 100% small.toml";
  std::ofstream(file) << "[run]\nname = \"small\"\nscene = \"s.toml\"\n[[host]]\nname = \"here\"\n"
                         "[[node]]\nname = \"n\"\ncount = 2\n"
                         "[[node]]\nname = \"c\"\nrole = \"controller\"\n";
  return "\"" + file.string() + "\"";
}

/// A program that replaces luxodus: `body` in a shell, with a node's command line.
std::string stand_in(const TemporaryFolder& folder, const std::string& body) {
  const fs::path file = folder / "stand in";
  std::ofstream(file) << "#!/bin/bash\n" << body;
  fs::permissions(file, fs::perms::owner_all);
  return "\"" + file.string() + "\"";
}

size_t lines_with(const std::string& text, const std::string& words) {
  size_t count = 0;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) count += line.find(words) != line.npos ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("keygen makes a pair for each node of a cluster, secret to its owner", "[program]") {
  const TemporaryFolder folder;
  const fs::path keys = folder / "keys";
  const Outcome made = run_luxodus(
      folder, "keygen --cluster " + example("three_hosts.toml") + " --out " + keys.string());
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK(lines_with(made.out, "") == 7);
  CHECK(files_in(keys).size() == 14);
  const auto mode = [](const fs::path& file) { return fs::status(file).permissions(); };
  CHECK(mode(keys / "a0.key") == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(mode(keys) == fs::perms::owner_all);
  const std::string open = slurp(keys / "controller.key.pub");
  CHECK(made.out.find(open.substr(0, 40) + "  controller\n") != std::string::npos);
  CHECK(made.out.find(slurp(keys / "controller.key").substr(0, 40)) == std::string::npos);
}

TEST_CASE("keygen replaces no key unless told to", "[program]") {
  const TemporaryFolder folder;
  const fs::path keys = folder / "keys";
  const std::string arguments = "keygen n0 n1 --out " + keys.string();
  REQUIRE(run_luxodus(folder, arguments).code == 0);
  const std::string before = slurp(keys / "n0.key");
  const Outcome refused = run_luxodus(folder, arguments + " n2");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("n0.key") != std::string::npos);
  CHECK_FALSE(fs::exists(keys / "n2.key"));
  CHECK(slurp(keys / "n0.key") == before);
  REQUIRE(run_luxodus(folder, arguments + " --force").code == 0);
  CHECK(slurp(keys / "n0.key") != before);
}

TEST_CASE("keygen says why it makes no keys", "[program]") {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "keys").string();
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = run_luxodus(folder, "keygen " + arguments);
    INFO(arguments << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "keys"));
  };
  refused("n0", "say where keys go");
  refused(out, "name nodes, or a cluster");
  refused("../n0" + out, "is no node's name");
  refused("x9 --cluster " + example("three_hosts.toml") + out, "there is no node \"x9\"");
  refused("--cluster /nowhere.toml" + out, "cannot be read");
  refused("--cluster " + example("one_host.toml"), "say where keys go");
  fs::permissions(folder.path(), fs::perms::all);
  const Outcome open = run_luxodus(folder, "keygen n0 --out " + folder.path().string());
  CHECK(open.code == 2);
  CHECK(open.err.find("others may write here") != std::string::npos);
}

TEST_CASE("a deployment of each example starts each node once, on its host", "[program]") {
  const TemporaryFolder folder;
  for (const std::string file : examples) {
    for (const std::string means : {"systemd", "slurm", "ssh"}) {
      const fs::path out = folder / (file + means);
      const Outcome made = run_luxodus(
          folder, "deploy " + example(file) + " --for " + means + " --out " + out.string());
      INFO(file << " " << means << "\n" << made.err);
      REQUIRE(made.code == 0);
      std::string text;
      for (const fs::path& path : files_in(out)) {
        CHECK(made.out.find(path.string()) != std::string::npos);
        text += slurp(path);
      }
      const std::string quote = means == "systemd" ? "\"" : "";
      CHECK(lines_with(text, " --name " + quote + "controller" + quote) == 1);
    }
  }
  const fs::path birch = folder / "three_hosts.tomlsystemd" / "birch";
  CHECK(fs::exists(birch / "luxodus-theatre-b0.service"));
  CHECK_FALSE(fs::exists(birch / "luxodus-theatre-a0.service"));
}

TEST_CASE("units pass systemd's own check", "[program]") {
  if (!is_there("systemd-analyze")) {
    WARN("skipped: there is no systemd-analyze here");
    return;
  }
  const TemporaryFolder folder;
  for (const std::string& cluster :
       {example(examples[0]), example(examples[1]), example(examples[2]), small_cluster(folder)}) {
    const fs::path out = folder / "units";
    fs::remove_all(out);
    REQUIRE(
        run_luxodus(folder, "deploy " + cluster + " --for systemd --out " + out.string()).code ==
        0);
    for (const auto& host : fs::directory_iterator(out)) {
      const Outcome checked =
          shell(folder, "systemd-analyze verify '" + host.path().string() + "'/*");
      INFO(cluster << "\n" << checked.err);
      CHECK(checked.code == 0);
      CHECK(checked.err.find("luxodus-") == std::string::npos);  // warnings name the unit
    }
  }
}

TEST_CASE("scripts parse, and shellcheck has no findings", "[program]") {
  const TemporaryFolder folder;
  const bool checks = is_there("shellcheck");
  if (!checks) WARN("there is no shellcheck here: only bash looks at the scripts");
  for (const std::string& cluster : {example(examples[1]), small_cluster(folder)}) {
    for (const std::string means : {"slurm", "ssh"}) {
      const fs::path out = folder / means;
      REQUIRE(
          run_luxodus(folder, "deploy " + cluster + " --for " + means + " --out " + out.string())
              .code == 0);
      for (const fs::path& script : files_in(out)) {
        CHECK(shell(folder, "bash -n " + script.string()).code == 0);
        if (!checks) continue;
        const Outcome checked = shell(folder, "shellcheck --severity=warning " + script.string());
        INFO(checked.out);
        CHECK(checked.code == 0);
      }
    }
  }
}

TEST_CASE("the ssh script starts every process, and succeeds when all do", "[program]") {
  const TemporaryFolder folder;
  const std::string program = stand_in(folder, "echo \"started: $*\"\n");
  REQUIRE(run_luxodus(folder, "deploy " + small_cluster(folder) + " --for ssh --program " +
                                  program + " --out " + folder.path().string())
              .code == 0);
  const std::string home = "export HOME=" + folder.path().string() + "; ";
  const Outcome run = shell(folder, home + (folder / "small.sh").string());
  INFO(run.out << run.err);
  CHECK(run.code == 0);
  const std::string config = "it's 100% small.toml";
  for (const std::string name : {"n0", "n1", "c"}) {
    CHECK(lines_with(run.out, name + ": started: node --config ") == 1);
    CHECK(lines_with(run.out, config + " --name " + name) == 1);
  }
  CHECK(files_in(folder / ".luxodus").empty());
}

TEST_CASE("the ssh script stops all when one fails, and says which", "[program]") {
  const TemporaryFolder folder;
  // The controller fails once the others wait, which they do until stopped.
  const std::string program = stand_in(folder, R"(
case $* in
  *"--name c") for n in n0 n1; do read -r _ <"$HOME/$n"; done; exit 3 ;;
esac
trap 'echo stopped; exit 0' TERM
echo ready >"$HOME/${*: -1}"
while :; do read -r _ <>"$HOME/never"; done
)");
  REQUIRE(run_luxodus(folder, "deploy " + small_cluster(folder) + " --for ssh --program " +
                                  program + " --out " + folder.path().string())
              .code == 0);
  const std::string home = "export HOME=" + folder.path().string() + "; cd; mkfifo n0 n1 never; ";
  const Outcome run = shell(folder, home + (folder / "small.sh").string());
  INFO(run.out << run.err);
  CHECK(run.code == 3);
  CHECK(run.err.find("c: ended with 3") != std::string::npos);
  CHECK(lines_with(run.out, "n0: stopped") == 1);
  CHECK(lines_with(run.out, "n1: stopped") == 1);
}

TEST_CASE("the batch job gives each task its nodes and its host", "[program]") {
  const TemporaryFolder folder;
  // Replaces Slurm: every task runs here, after the name of its host.
  std::ofstream(folder / "srun") << R"sh(#!/bin/bash
while [ "$1" != bash ]; do shift; done
rank=0
while read -r host; do
  echo "$host: $(SLURM_PROCID=$rank "$@")"
  rank=$((rank + 1))
done <"$SLURM_HOSTFILE"
)sh";
  fs::permissions(folder / "srun", fs::perms::owner_all);
  const std::string program = stand_in(folder, "echo \"$@\"\n");
  REQUIRE(run_luxodus(folder, "deploy " + example("eight_hosts.toml") + " --for slurm --program " +
                                  program + " --out " + folder.path().string())
              .code == 0);
  const Outcome run = shell(
      folder, "PATH=" + folder.path().string() + ":$PATH " + (folder / "tower.sbatch").string());
  INFO(run.out << run.err);
  CHECK(run.code == 0);
  CHECK(lines_with(run.out, "") == 9);
  CHECK(lines_with(run.out, "lux3: node --config") == 1);
  CHECK(lines_with(run.out, "--name c0 --name c1 --name c2 --name c3") == 1);
  CHECK(lines_with(run.out, "lux1: node --config") == 2);
}

TEST_CASE("manifests have a pod for each process, with only its nodes, its address and its keys",
          "[program]") {
  const TemporaryFolder folder;
  const fs::path cluster = folder / "pods.toml";
  const auto write = [&](const std::string& first_address) {
    std::ofstream(cluster)
        << "[run]\nname = \"hall\"\nscene = \"s.toml\"\nout = \"results\"\n"
        << "[keys]\nfolder = \"keys\"\n"
        << "[[host]]\nname = \"a\"\naddress = \"" << first_address << "\"\n"
        << "[[host]]\nname = \"b\"\naddress = \"luxodus-hall-two-0.luxodus-hall\"\n"
        << "[[node]]\nname = \"n\"\ncount = 2\nhost = \"a\"\nprocess = \"one\"\n"
        << "[[node]]\nname = \"m\"\nhost = \"b\"\nprocess = \"two\"\n"
        << "[[node]]\nname = \"c\"\nrole = \"controller\"\nhost = \"a\"\n"
        << "process = \"one\"\n";
  };
  const std::string deploy = "deploy " + cluster.string() + " --for kubernetes --out " +
                             (folder / "out").string() + " --program /opt/luxodus";
  write("luxodus-hall-one-0.luxodus-hall");
  REQUIRE(run_luxodus(folder, "keygen --cluster " + cluster.string()).code == 0);
  const Outcome made = run_luxodus(folder, deploy + " --image registry/luxodus:1");
  INFO(made.err);
  REQUIRE(made.code == 0);
  const fs::path keys = folder / "out" / "hall-keys.yaml";
  CHECK((fs::status(keys).permissions() & (fs::perms::group_all | fs::perms::others_all)) ==
        fs::perms::none);

  // Parsed by a YAML reader.
  std::ofstream(folder / "read.py") << R"py(
import sys, yaml
things = [t for f in sys.argv[1:3] for t in yaml.safe_load_all(open(f)) if t]
kind = lambda k: {t["metadata"]["name"]: t for t in things if t["kind"] == k}
service = kind("Service")["luxodus-hall"]["spec"]
assert service["clusterIP"] == "None" and service["publishNotReadyAddresses"] is True
text = kind("ConfigMap")["luxodus-hall"]["data"]["cluster.toml"]
assert text == open(sys.argv[3]).read()
sets, secrets = kind("StatefulSet"), kind("Secret")
assert set(sets) == set(secrets) == {"luxodus-hall-one", "luxodus-hall-two"}
for name, one in sets.items():
    spec = one["spec"]
    pod = spec["template"]
    assert spec["serviceName"] == "luxodus-hall" and spec["replicas"] == 1
    assert spec["selector"]["matchLabels"] == pod["metadata"]["labels"]
    assert service["selector"].items() <= pod["metadata"]["labels"].items()
    node = pod["spec"]["containers"][0]
    volumes = {v["name"] for v in pod["spec"]["volumes"]}
    volumes |= {c["metadata"]["name"] for c in spec.get("volumeClaimTemplates", [])}
    for box in [node] + pod["spec"]["initContainers"]:
        assert {m["name"] for m in box["volumeMounts"]} <= volumes
        assert box["securityContext"]["capabilities"]["drop"] == ["ALL"]
        assert box["image"] == "registry/luxodus:1"
    assert pod["spec"]["securityContext"]["runAsNonRoot"] is True
    assert node["args"][:3] == ["/opt/luxodus", "node", "--config"]
    names = [node["args"][i + 1] for i, a in enumerate(node["args"]) if a == "--name"]
    ports = [p["containerPort"] for p in node["ports"]]
    assert len(set(ports)) == len(ports) == 2 * len(names)
    secret = [k for k in secrets[name]["data"] if k.endswith(".key")]
    assert sorted(secret) == sorted(n + ".key" for n in names)
    assert sum(k.endswith(".key.pub") for k in secrets[name]["data"]) == 4
    open(sys.argv[4], "w").write(node["command"][2])
    print(name, *names, "keeps" if "volumeClaimTemplates" in spec else "")
)py";
  const Outcome read =
      shell(folder, "python3 " + (folder / "read.py").string() + " " +
                        (folder / "out" / "hall.yaml").string() + " " + keys.string() + " " +
                        cluster.string() + " " + (folder / "pod.sh").string());
  INFO(read.out << read.err);
  REQUIRE(read.code == 0);
  CHECK(lines_with(read.out, "luxodus-hall-one n0 n1 c keeps") == 1);
  CHECK(lines_with(read.out, "luxodus-hall-two m") == 1);

  // The command of a container: it forwards signals, returns a failure's exit code, and sleeps
  // after success.
  const std::string pod = "sh -c \"$(cat " + (folder / "pod.sh").string() + ")\" ";
  CHECK(shell(folder, pod + stand_in(folder, "exit 3\n")).code == 3);
  const std::string node =
      stand_in(folder, "trap 'echo told; exit 0' TERM; echo up; sleep 60 & wait\n");
  const Outcome told = shell(folder, pod + node + " & sleep 1; kill -TERM $!; wait $!");
  CHECK(told.code == 0);
  CHECK(lines_with(told.out, "told") == 1);
  const Outcome rests = shell(folder, pod + stand_in(folder, "echo done\n") +
                                          " & sleep 1; slept=$(cat /proc/$!/task/$!/children); "
                                          "kill -0 $slept && kill -TERM $! && wait $! && "
                                          "! kill -0 $slept");
  CHECK(rests.code == 0);
  CHECK(lines_with(rests.out, "done") == 1);

  fs::remove_all(folder / "out");
  write("192.168.10.11");
  const Outcome elsewhere = run_luxodus(folder, deploy + " --image i");
  CHECK(elsewhere.code == 2);
  CHECK(elsewhere.err.find("\"luxodus-hall-one-0.luxodus-hall\" for host \"a\"") !=
        std::string::npos);
  const Outcome without = run_luxodus(folder, deploy);
  CHECK(without.code == 2);
  CHECK(without.err.find("--image") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("deploy reports every problem of a cluster and then writes nothing", "[program]") {
  const TemporaryFolder folder;
  const fs::path file = folder / "bad.toml";
  std::ofstream(file) << "[run]\nname = \"bad\"\nscene = \"s\"\n[[host]]\nnam = \"h\"\n"
                         "[[node]]\nname = \"n\"\n";
  const fs::path out = folder / "out";
  const Outcome bad =
      run_luxodus(folder, "deploy " + file.string() + " --for ssh --out " + out.string());
  CHECK(bad.code == 2);
  CHECK(bad.err.find(file.string() + ":5: ") != std::string::npos);
  CHECK(bad.err.find("no controller") != std::string::npos);
  CHECK_FALSE(fs::exists(out));
  const std::string good = "deploy " + example("one_host.toml") + " --out " + out.string();
  CHECK(run_luxodus(folder, good + " --for cron").code == 2);
  CHECK(run_luxodus(folder, good + " --for systemd --user 'a b'").code == 2);
  CHECK_FALSE(fs::exists(out));
}

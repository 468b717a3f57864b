// Protection of a user's work: hours of tracing to an unwritable folder, a kill, a full disk, a
// repeated command. Signals are sent by `timeout`.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;
using Catch::Matchers::Contains;

namespace {

const std::string lost_room =
    "title = \"A room\"\npatch_edge_m = 1\n" + luxodus::test::white_room("[5, 4, 3]") + R"(
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [2.5, 2, 2.9]
size = [0.6, 0.6]
flux_lm = 3000
[[plane]]
name = "the floor"
corner = [0, 0, 0.02]
edge_u = [5, 0, 0]
edge_v = [0, 4, 0]
cells = [5, 4]
[[camera]]
name = "before the sign"
eye = [0.3, 0.3, 1.6]
target = [3, 2.4, 1.6]
width = 40
height = 30
)";

/// More particles than can be traced while the user waits.
const std::string endless = " --particles 1000G ";

struct LostRoom : ScenePlace {
  explicit LostRoom(const std::string& text = lost_room) : ScenePlace("room.toml", text) {}
};

/// Each at most 20 s, so that a program that does not end fails the test and does not block the
/// machine.
const std::string in_time = "timeout --signal=KILL 20 ";

size_t lines(const std::string& text) {
  return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("a run detects before it traces that its results cannot be written", "[program][keep]") {
  const LostRoom place;
  const fs::path elsewhere = place.folder / "elsewhere";
  fs::create_directory(elsewhere);
  std::string said;
  SECTION("a folder in the place of flux.lux") {
    fs::create_directories(place.out / "flux.lux");
    said = "is a folder";
  }
  SECTION("a device behind a link") {
    fs::create_directories(place.out);
    fs::create_symlink("/dev/null", place.out / "flux.lux");
    said = "symbolic link";
  }
  SECTION("a subfolder that leads elsewhere") {
    fs::create_directories(place.out);
    fs::create_directory_symlink(elsewhere, place.out / "planes");
    said = "symbolic link";
  }
  SECTION("a file in the place of the folder") {
    std::ofstream(place.out) << "x";
    said = "cannot make this folder";
  }
  const Outcome run = place.run(endless, in_time);
  INFO(run.err);
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains(said));
  CHECK(lines(run.err) == 1);
  CHECK(fs::is_empty(elsewhere));
}

TEST_CASE("every long command first checks where it will write", "[program][keep]") {
  const LostRoom place;
  const std::string file = (place.folder / "file").string();
  std::ofstream(file) << "mine";
  for (const std::string& command :
       {"converge " + place.scene + endless + "--out " + file,
        "assess " + place.scene + " --out " + file + "/below",
        "pack " + place.scene + " --out " + place.folder.path().string(),
        "validate --full --out " + file}) {
    const Outcome refused = place.luxodus(command, in_time);
    INFO(command << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK(slurp(file) == "mine");
  }
}

TEST_CASE("a disk without room or without the right to write is a failure, not wrong input",
          "[program][keep]") {
  const LostRoom place;
  fs::create_directories(place.out);
  const auto on_disk = [&](const std::string& how) {
    const std::string mount = "mount -t tmpfs -o " + how + " none " + place.out.string();
    return shell(place.folder, "unshare -rm sh -c '" + mount + " && " + LUX_PROGRAM + " run " +
                                   place.scene + " --particles 20k --no-views --out " +
                                   place.out.string() + "'");
  };
  const std::string trial = "mount -t tmpfs -o size=64k none " + place.out.string();
  if (std::system(("unshare -rm " + trial + " 2>/dev/null").c_str()) != 0) {
    WARN("skipped: no file system of a few KiB can be mounted here");
    return;
  }
  const Outcome full = on_disk("size=8k");
  INFO(full.err);
  CHECK(full.code == 1);
  CHECK_THAT(full.err, Contains("less room") || Contains("No space left"));
  const Outcome closed = on_disk("ro");
  INFO(closed.err);
  CHECK(closed.code == 1);
  CHECK_THAT(closed.err, Contains("Read-only file system"));
}

TEST_CASE("pictures never leave the folder of their run through a link", "[program][keep]") {
  const LostRoom place;
  REQUIRE(place.run("--particles 20k --no-views").code == 0);
  const fs::path elsewhere = place.folder / "elsewhere";
  fs::create_directory(elsewhere);
  fs::create_directory_symlink(elsewhere, place.out / "views");
  const Outcome drawn = place.luxodus("render " + place.out.string() + " --paths 1");
  CHECK(drawn.code == 2);
  CHECK_THAT(drawn.err, Contains("symbolic link"));
  CHECK(fs::is_empty(elsewhere));
}

TEST_CASE("a killed run continues from its last checkpoint with the same bits", "[program][keep]") {
  const LostRoom place;
  const std::string nodes = GENERATE(" --threads 1", " --nodes 2");
  const Outcome killed =
      shell(place.folder,
            std::string(LUX_PROGRAM) + " run " + place.scene + " --out " + place.out.string() +
                " --no-views --checkpoint 1s" + nodes + endless + "& run=$!; until [ -e " +
                (place.out / "flux.lux").string() +
                " ]; do kill -0 $run || exit 9; sleep 0.05; done; kill -KILL $run; wait $run");
  INFO(killed.err);
  REQUIRE(killed.code == 128 + 9);
  const auto begun = nlohmann::json::parse(slurp(place.out / "result.json"));
  CHECK(begun["finished"] == false);
  const auto particles = begun["particles"].get<int64_t>();
  REQUIRE(particles > 0);
  const Outcome resumed =
      place.run("--no-views --resume --particles " + std::to_string(2 * particles));
  INFO(resumed.err);
  REQUIRE(resumed.code == 0);
  // Nodes may have counted later batches: all before them are traced, too.
  const auto ended = nlohmann::json::parse(slurp(place.out / "result.json"));
  CHECK(ended["finished"] == true);
  CHECK(ended["particles"].get<int64_t>() >= 2 * particles);
  const fs::path whole = place.folder / "whole";
  REQUIRE(place
              .luxodus("run " + place.scene + " --no-views --out " + whole.string() +
                       " --particles " + ended["particles"].dump())
              .code == 0);
  const bool same = slurp(place.out / "flux.lux") == slurp(whole / "flux.lux");
  CHECK(same);
}

TEST_CASE("a longer run of the same scene is not replaced by a shorter one without --overwrite",
          "[program][keep]") {
  const LostRoom place;
  REQUIRE(place.run("--no-views --particles 100k").code == 0);
  const std::string long_run = slurp(place.out / "flux.lux");
  for (const char* shorter : {"--particles 20k", "--particles 100k --time 1ms", "--error 50%",
                              "--particles 20k --seed 9"}) {
    const Outcome refused = place.run(std::string("--no-views ") + shorter);
    INFO(shorter << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains("--resume") && Contains("--overwrite"));
    CHECK(slurp(place.out / "flux.lux") == long_run);
  }
  // Repeats the command, as in ./run.sh, then runs a longer one.
  CHECK(place.run("--no-views --particles 100k").code == 0);
  CHECK(slurp(place.out / "flux.lux") == long_run);
  CHECK(place.run("--no-views --particles 100k --seed 9").code == 0);
  CHECK(place.run("--no-views --particles 20k --overwrite").code == 0);
  CHECK(slurp(place.out / "flux.lux").size() > 0);
  CHECK(slurp(place.out / "flux.lux") != long_run);
  CHECK(place.run("--no-views --particles 100k --resume").code == 0);
  CHECK(slurp(place.out / "flux.lux") == long_run);
}

TEST_CASE("a command that stops by time or error may be repeated", "[program][keep]") {
  const LostRoom place;
  for (const char* stop : {"--error 5%", "--time 1s"}) {
    CHECK(place.run(std::string("--no-views --overwrite ") + stop).code == 0);
    const Outcome again = place.run(std::string("--no-views ") + stop);
    INFO(again.err);
    CHECK(again.code == 0);
  }
}

TEST_CASE("an interrupted repetition of a run leaves the longer one unchanged", "[program][keep]") {
  const LostRoom place;
  REQUIRE(place.run("--no-views --threads 1 --time 4s").code == 0);
  const std::string long_run = slurp(place.out / "flux.lux");
  const Outcome stopped = place.run("--no-views --threads 1 --checkpoint 1s" + endless,
                                    "timeout --preserve-status --signal=INT 2 ");
  INFO(stopped.err);
  CHECK(stopped.code == 130);
  CHECK_THAT(stopped.err, Contains("keeps the run"));
  CHECK(slurp(place.out / "flux.lux") == long_run);
  CHECK(fs::exists(place.out / "planes" / "the_floor.csv"));
}

TEST_CASE("files that no run has written are not replaced without --overwrite", "[program][keep]") {
  const LostRoom place;
  fs::create_directories(place.out / "planes");
  for (const char* name : {"result.json", "planes/the_floor.csv", "flux.lux"}) {
    std::ofstream(place.out / name) << "mine";
    const Outcome refused = place.run(endless, in_time);
    INFO(name << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains(name) && Contains("--overwrite"));
    CHECK(slurp(place.out / name) == "mine");
    fs::remove(place.out / name);
  }
  std::ofstream(place.out / "planes" / "the_floor.csv") << "mine";
  CHECK(place.run("--no-views --particles 20k --overwrite").code == 0);
  CHECK(slurp(place.out / "planes" / "the_floor.csv") != "mine");
}

TEST_CASE("two runs do not write into one folder", "[program][keep]") {
  const LostRoom place;
  const std::string run = std::string(LUX_PROGRAM) + " run " + place.scene + " --out " +
                          place.out.string() + " --no-views --threads 1" + endless;
  // The lock exists before the first particle; the second command waits for it, then is refused.
  const Outcome both =
      shell(place.folder,
            run + " & first=$!; until [ -s " + (place.out / ".luxodus.lock").string() +
                " ]; do kill -0 $first || exit 9; sleep 0.05; done; timeout --signal=KILL 20 " +
                run + "; code=$?; kill -KILL $first; wait $first; exit $code");
  INFO(both.err);
  CHECK(both.code == 2);
  CHECK_THAT(both.err, Contains("process ") && Contains("writes into this folder"));
  // A killed process holds no lock.
  CHECK(place.run("--no-views --particles 20k").code == 0);
  CHECK_FALSE(fs::exists(place.out / ".luxodus.lock"));
}

TEST_CASE("Ctrl-C and SIGTERM end the making of pictures, and keep finished ones",
          "[program][keep]") {
  const LostRoom place;
  REQUIRE(place.run("--particles 20k --no-views").code == 0);
  for (const std::string signal : {"INT", "TERM"}) {
    // 1200 pixels with a hundred thousand paths take minutes.
    const std::string under =
        "timeout --kill-after=15 --preserve-status --signal=" + signal + " 2 ";
    const Outcome drawn =
        place.luxodus("render " + place.out.string() + " --paths 60000 --threads 1", under);
    INFO(signal << "\n" << drawn.err);
    CHECK(drawn.code == 130);
    CHECK_THAT(drawn.err, Contains("interrupted"));
    CHECK(fs::exists(place.out / "flux.lux"));
    const Outcome run = place.run("--particles 20k --picture-paths 60000 --threads 1", under);
    INFO(run.err);
    CHECK(run.code == 130);
    CHECK(nlohmann::json::parse(slurp(place.out / "result.json"))["finished"] == true);
  }
}

TEST_CASE("an interrupted pack leaves nothing, and removes what a killed one left",
          "[program][keep]") {
  const LostRoom place;
  const fs::path stale = place.folder / ".luxodus-999999-0.tmp";
  std::ofstream(stale) << "half a pack";
  const std::string pack = (place.folder / "room.luxpack").string();
  REQUIRE(place.luxodus("pack " + place.scene + " --out " + pack).code == 0);
  CHECK_FALSE(fs::exists(stale));
  const std::string many = R"([[object]]
name = "blocks"
shape = "box"
low = [1, 1, 0]
high = [1.01, 1.01, 0.01]
material = "white"
repeat = [{ count = 100, step = [0.02, 0, 0] }, { count = 100, step = [0, 0.02, 0] }]
)";
  const LostRoom large(lost_room + many);
  for (const char* after : {"0.2", "0.4", "0.8"})
    for (const char* signal : {"INT", "TERM", "KILL"}) {
      run_luxodus(large.folder,
                  "pack " + large.scene + " --cell-kib 1 --out " +
                      (large.folder / "large.luxpack").string(),
                  std::string("timeout --signal=") + signal + " " + after + " ");
      for (const auto& entry : fs::directory_iterator(large.folder.path()))
        CHECK(entry.path().extension() != ".tmp");
    }
}

TEST_CASE("a standard output that cannot be written is an error in one line", "[program][keep]") {
  const LostRoom place;
  for (const std::string& command :
       {std::string("info"), std::string("info --json"), std::string("--help"),
        std::string("--version"), "check " + place.scene, "check --json " + place.scene}) {
    const Outcome full = shell(place.folder, LUX_PROGRAM + (" " + command) + " >/dev/full");
    INFO(command << "\n" << full.err);
    CHECK(full.code == 1);
    CHECK_THAT(full.err, Contains("standard output could not be written"));
    CHECK(lines(full.err) == 1);
    const Outcome closed = shell(place.folder, LUX_PROGRAM + (" " + command) + " >&-");
    INFO(closed.err);
    CHECK(closed.code == 1);
  }
  CHECK(place.luxodus("info").code == 0);
}

TEST_CASE("a reader that has gone is an error, and results are written first", "[program][keep]") {
  const LostRoom place;
  const std::string run = std::string(LUX_PROGRAM) + " run " + place.scene + " --out " +
                          place.out.string() + " --no-views --particles 50k";
  const Outcome gone =
      shell(place.folder, "bash -c 'set -o pipefail; " + run + " --json | sleep 0'");
  INFO(gone.err);
  CHECK(gone.code == 1);
  CHECK_THAT(gone.err, Contains("standard output could not be written"));
  CHECK(nlohmann::json::parse(slurp(place.out / "result.json"))["finished"] == true);
}

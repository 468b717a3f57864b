// Hostile files, and the program's own defences: each ends with exit code 2 and one clear sentence,
// in time, without content of other files.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "tests/examples/program_kit.hpp"
#include "tests/unit/scenes/formats/pack/burning_gallery.hpp"

using namespace luxodus::program;

namespace {

constexpr const char* hostile_room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 3]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
position = [2, 2, 2]
flux_lm = 100
)";

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const fs::path file = folder / name;
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

/// No control characters, except line ends.
bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (c >= 0 && c < 0x20 && c != '\n') || c == 0x7F; });
}

}  // namespace

TEST_CASE("control characters in names and titles do not reach the terminal",
          "[program][hostile]") {
  const TemporaryFolder folder;
  const std::string scene =
      write(folder, "evil.toml",
            "title = \"a\\u001B]0;owned\\u0007b\\u009Bc\"\n" + std::string(hostile_room));
  for (const char* verb : {"check ", "run --particles 1k --out "}) {
    const std::string arguments = verb == std::string("check ")
                                      ? verb + scene
                                      : verb + (folder / "out").string() + " " + scene;
    const Outcome told = run_luxodus(folder, arguments);
    INFO(told.out << told.err);
    CHECK(printable(told.out));
    CHECK(printable(told.err));
  }
  CHECK(run_luxodus(folder, "check " + scene).out.find("a\\x1B]0;owned") != std::string::npos);
}

TEST_CASE("a pipe in the place of a file is rejected without waiting for it",
          "[program][hostile]") {
  const TemporaryFolder folder;
  const std::string pipe = (folder / "pipe.toml").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string image = (folder / "pipe.png").string();
  REQUIRE(::mkfifo(image.c_str(), 0600) == 0);
  const std::string painted = write(folder, "painted.toml",
                                    std::string(hostile_room) +
                                        "[[material]]\nname = \"painted\"\nkind = \"lambertian\"\n"
                                        "reflectance = 0.9\nimage = \"pipe.png\"\n");
  const std::string including = write(folder, "including.toml", "include = [\"pipe.toml\"]\n");
  for (const std::string& arguments :
       {"check " + pipe, "run " + pipe, "check " + painted, "check " + including, "cluster " + pipe,
        "topology " + pipe}) {
    INFO(arguments);
    const Outcome told = run_luxodus(folder, arguments, "timeout 60 ");
    INFO(told.err);
    CHECK(told.code != 0);
    CHECK(told.code != 124);  // of timeout(1)
  }
}

TEST_CASE("errors do not show the content of a file that a scene includes", "[program][hostile]") {
  const TemporaryFolder folder;
  write(folder, "shadow", "root:$6$secret$hash:19000:0:99999:7:::\n");
  const std::string scene = write(folder, "s.toml", "include = [\"shadow\"]\n");
  const Outcome told = run_luxodus(folder, "check " + scene);
  CHECK(told.code == 2);
  CHECK(told.err.find("an included file must be a scene file") != std::string::npos);
  for (const char* words : {"root", "secret", "19000"})
    CHECK((told.out + told.err).find(words) == std::string::npos);
}

TEST_CASE("a damaged mesh is one error with its file and line", "[program][hostile]") {
  const TemporaryFolder folder;
  write(folder, "tex.mtl", "newmtl red\nKd 1 0 zero\n");
  write(folder, "tex.obj", "mtllib tex.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\n");
  const std::string scene =
      write(folder, "s.toml",
            std::string(hostile_room) +
                "[[import]]\nname = \"m\"\nfile = \"tex.obj\"\nunits = \"m\"\n"
                "up = \"y\"\nmaterial = \"grey50\"\n");
  const Outcome told = run_luxodus(folder, "check " + scene);
  INFO(told.err);
  CHECK(told.code == 2);
  CHECK(told.err.find("tex.mtl:2: a component of this colour is no number") != std::string::npos);
}

TEST_CASE("a damaged object of a pack is reported with its file before nodes begin",
          "[program][hostile]") {
  const TemporaryFolder folder;
  const std::string scene = luxodus::write_gallery(folder.path()).string();
  const std::string pack = (folder / "x.luxpack").string();
  REQUIRE(run_luxodus(folder, "pack " + scene + " --scenario smoky --out " + pack).code == 0);
  std::string bytes = slurp(pack);
  bytes[300] = static_cast<char>(bytes[300] ^ 4);  // after the head: the first object
  std::ofstream(pack, std::ios::binary) << bytes;
  const Outcome told = run_luxodus(folder,
                                   "run " + pack +
                                       " --scenario smoky --nodes 2 --part-cache-mib 1 "
                                       "--particles 10k --out " +
                                       (folder / "out").string(),
                                   "timeout 60 ");
  INFO(told.err);
  CHECK(told.code != 0);
  CHECK(told.code != 124);
  CHECK(told.err.find("x.luxpack: scene part 0 of this pack is damaged") != std::string::npos);
}

TEST_CASE("a node that stores a damaged pack ends at once and names its file",
          "[program][hostile]") {
  const TemporaryFolder folder;
  const std::string scene = luxodus::write_gallery(folder.path()).string();
  const std::string pack = (folder / "x.luxpack").string();
  REQUIRE(run_luxodus(folder, "pack " + scene + " --scenario smoky --out " + pack).code == 0);
  std::string bytes = slurp(pack);
  bytes[300] = static_cast<char>(bytes[300] ^ 4);  // after the head: the first object
  std::ofstream(pack, std::ios::binary) << bytes;
  const std::string cluster = write(folder, "c.toml",
                                    "[run]\nname = \"damaged\"\nscene = \"" + pack +
                                        "\"\nscenario = \"smoky\"\nparticles = 10_000\nout = \"" +
                                        (folder / "out").string() +
                                        "\"\n[[host]]\nname = \"here\"\n[[node]]\nname = \"n\"\n"
                                        "count = 2\n[[node]]\nname = \"controller\"\n"
                                        "role = \"controller\"\n[budget]\n"
                                        "object_bytes = \"1 MiB\"\nfibers = 64\n");
  for (const std::string& command :
       {"node --config " + cluster + " --name n0",
        "node --config " + cluster + " --name controller", "cluster up " + cluster}) {
    const Outcome told = run_luxodus(folder, command, "timeout 60 ");
    INFO(command << "\n" << told.out << told.err);
    CHECK(told.code != 0);
    CHECK(told.code != 124);
    CHECK((told.out + told.err).find("x.luxpack: scene part 0 of this pack is damaged") !=
          std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out"));
  }
}

TEST_CASE("pipes in place of keys, profiles, graphs and results are rejected without waiting",
          "[program][hostile]") {
  const TemporaryFolder folder;
  const auto pipe = [&](const std::string& name) {
    const fs::path path = folder / name;
    fs::create_directories(path.parent_path());
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    return path.string();
  };
  const auto cluster = [&](const std::string& name, const std::string& run,
                           const std::string& more) {
    return write(folder, name,
                 "[run]\nname = \"" + name + "\"\nscene = \"" +
                     (fs::path(LUX_SOURCE_DIR) / "scenes/library/office_floor.toml").string() +
                     "\"\nparticles = 10_000\nout = \"" + (folder / "out").string() + "\"\n" + run +
                     "[[host]]\nname = \"here\"\n[[node]]\nname = \"n\"\ncount = 2\n[[node]]\n"
                     "name = \"controller\"\nrole = \"controller\"\n" +
                     more);
  };
  const auto refused = [&](const std::string& arguments, const std::string& file) {
    const Outcome told = run_luxodus(folder, arguments, "timeout 60 ");
    INFO(arguments << "\n" << told.err);
    CHECK(told.code == 2);
    CHECK(told.err.find(file) != std::string::npos);
    CHECK(told.err.find("pipe") != std::string::npos);
  };
  const std::string budget = "[budget]\nobject_bytes = \"1 MiB\"\nfibers = 64\n";

  const std::string profiled = cluster("profiled.toml", "profile = \"its.profile\"\n", budget);
  pipe("its.profile");
  const Outcome told =
      run_luxodus(folder, "node --config " + profiled + " --name n0", "timeout 60 ");
  INFO(told.err);
  CHECK(told.code == 2);
  CHECK(told.err.find("its.profile: this is no file but a pipe") != std::string::npos);

  const std::string keyed = cluster("keyed.toml", "", "[keys]\nfolder = \"keys\"\n");
  REQUIRE(run_luxodus(folder, "keygen --cluster " + keyed).code == 0);
  fs::remove(folder / "keys/n0.key");
  pipe("keys/n0.key");
  refused("node --config " + keyed + " --name n0", "keys/n0.key");
  fs::remove(folder / "keys/n1.key.pub");
  pipe("keys/n1.key.pub");
  refused("node --config " + keyed + " --name n1", "keys/n1.key.pub");

  refused("node --config " +
              cluster("drawn.toml", "",
                      "[topology]\nkind = \"file\"\nfile = \"" + pipe("graph.toml") + "\"\n") +
              " --name n0",
          "graph.toml");
  pipe("results/assessment.json");
  refused("report " + (folder / "results").string(), "assessment.json");
}

TEST_CASE("the program is linked so that an overwritten pointer cannot change its tables",
          "[program][hostile]") {
#if defined(LUX_HARDENED)
  const TemporaryFolder folder;
  const Outcome elf = shell(folder, std::string("readelf -hldW ") + LUX_PROGRAM);
  if (elf.code != 0) {
    WARN("skipped: there is no readelf here");
    return;
  }
  CHECK(elf.out.find("DYN (") != std::string::npos);      // at another address each time
  CHECK(elf.out.find("GNU_RELRO") != std::string::npos);  // tables are read-only,
  CHECK(elf.out.find("BIND_NOW") != std::string::npos);   // all of them,
  CHECK(elf.out.find("Flags: NOW PIE") != std::string::npos);
  const size_t stack = elf.out.find("GNU_STACK");
  REQUIRE(stack != std::string::npos);
  const std::string line = elf.out.substr(stack, elf.out.find('\n', stack) - stack);
  CHECK(line.find("RWE") == std::string::npos);  // and the stack is not executable
  const Outcome symbols = shell(folder, std::string("readelf -sW --dyn-syms ") + LUX_PROGRAM);
  CHECK(symbols.out.find("__stack_chk_fail") != std::string::npos);
  CHECK(symbols.out.find("_chk@GLIBC") != std::string::npos);
#else
  WARN("skipped: only release builds are hardened");
#endif
}

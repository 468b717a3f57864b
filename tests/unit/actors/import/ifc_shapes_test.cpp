// Messages of the process that computes shapes, and the folder of its answer. Tests that run a
// script need Node.js, and warn if it is absent.
#include "actors/import/ifc_shapes.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "actors/import/answer_folder.hpp"
#include "runtime/core/reading_share.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

namespace fs = std::filesystem;

/// Puts temporary files of this process there.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const fs::path& folder) {
    if (const char* now = std::getenv("TMPDIR")) before_ = now;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn() {
    if (before_.empty())
      ::unsetenv("TMPDIR");
    else
      ::setenv("TMPDIR", before_.c_str(), 1);
  }

 private:
  std::string before_;
};

void make_old(const fs::path& folder) {
  fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::hours(1));
}

size_t folders_in(const fs::path& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& one : fs::directory_iterator(folder)) ++count;
  return count;
}

/// A triangle as the script writes it (binary glTF), with `said` as its output.
std::string script_that_says(const std::string& said) {
  return "import { writeFileSync } from 'node:fs';\n"
         "const bin = Buffer.alloc(36);\n"
         "[0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, i) => bin.writeFloatLE(x, 4 * i));\n"
         "const text = JSON.stringify({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] "
         "}],\n  nodes: [{ name: 'part#3', mesh: 0 }],\n"
         "  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],\n"
         "  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3',\n"
         "    min: [0, 0, 0], max: [1, 1, 0] }],\n"
         "  bufferViews: [{ buffer: 0, byteLength: 36 }], buffers: [{ byteLength: 36 }] });\n"
         "const json = Buffer.from(text + ' '.repeat((4 - text.length % 4) % 4));\n"
         "const head = Buffer.alloc(20), middle = Buffer.alloc(8);\n"
         "head.write('glTF'); head.writeUInt32LE(2, 4);\n"
         "head.writeUInt32LE(28 + json.length + bin.length, 8);\n"
         "head.writeUInt32LE(json.length, 12); head.write('JSON', 16);\n"
         "middle.writeUInt32LE(bin.length, 0); middle.write('BIN\\0', 4);\n"
         "writeFileSync(process.argv[3], Buffer.concat([head, json, middle, bin]));\n" +
         said;
}

bool node_is_there() {
  if (std::system("node --version > /dev/null 2>&1") == 0) return true;
  WARN("skipped: Node.js is not there (./setup.sh)");
  return false;
}

}  // namespace

TEST_CASE("a folder left by a killed process is removed by the next one", "[import]") {
  const TemporaryFolder folder;
  const TemporaryFilesIn there(folder.path());
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const AnswerFolder left;
    (void)::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(folders_in(folder.path()) == 1);
  const fs::path left = fs::directory_iterator(folder.path())->path();
  folder.write(left.filename() / "shapes.glb", "much");
  make_old(left);
  {
    const AnswerFolder next;
    CHECK_FALSE(fs::exists(left));
    CHECK(fs::is_directory(next.path()));
  }
  CHECK(folders_in(folder.path()) == 0);
}

TEST_CASE("a folder in use is kept, and so are unknown files", "[import]") {
  const TemporaryFolder folder;
  const TemporaryFilesIn there(folder.path());
  const AnswerFolder used;
  make_old(used.path());
  fs::create_directory(folder / "of-others");
  make_old(folder / "of-others");
  fs::create_directory(folder / "target");
  fs::create_directory_symlink(folder / "target", folder / "luxodus-ifc-link");
  const AnswerFolder next;
  CHECK(fs::is_directory(used.path()));
  CHECK(fs::is_directory(folder / "of-others"));
  CHECK(fs::is_directory(folder / "target"));
}

TEST_CASE("shapes without their position are rejected, and nothing is moved silently", "[import]") {
  if (!node_is_there()) return;
  const TemporaryFolder folder;
  const auto model = folder.write("small.ifc", "");
  const auto shapes_of = [&](const std::string& said) {
    return ifc_shapes(model, folder.write("shapes.mjs", script_that_says(said)), 60);
  };
  const auto whole = shapes_of("console.log('at 3 10 20 -30');\n");
  if (!whole) FAIL(whole.problem().text());
  REQUIRE(whole->parts.size() == 1);
  CHECK(glm::length(whole->parts[0].mesh.positions.at(0) - glm::dvec3(10, 30, 20)) < 1e-9);
  for (const char* said : {"", "console.log('at 3 1 2');\n", "console.log('at 3 1 2 nan');\n",
                           "console.log('at 3 1 2 3 4');\n", "console.log('at 2 1 2 3');\n",
                           "console.log('offset 1 2 3');\n"}) {
    INFO(said);
    const auto lost = shapes_of(said);
    REQUIRE_FALSE(lost.ok());
    CHECK(lost.problem().what.find("without their place") != std::string::npos);
  }
}

TEST_CASE("notes beyond the limit are counted", "[import]") {
  if (!node_is_there()) return;
  const TemporaryFolder folder;
  const auto model = folder.write("small.ifc", "");
  const auto shapes = ifc_shapes(
      model,
      folder.write("shapes.mjs",
                   script_that_says("console.log('at 3 0 0 0');\n"
                                    "for (let i = 0; i < 207; ++i) console.log(`note ${i}`);\n")),
      60);
  if (!shapes) FAIL(shapes.problem().text());
  REQUIRE(shapes->notes.size() == 201);
  CHECK(shapes->notes.back().find("7 more") == 0);
}

TEST_CASE("progress of computing shapes is reported", "[import]") {
  if (!node_is_there()) return;
  const TemporaryFolder folder;
  const auto model = folder.write("small.ifc", std::string(1000, ' '));
  // Each share is written, the last one as an incomplete line, once the previous one was received.
  const auto slow = folder.write(
      "slow.mjs",
      "import { existsSync, writeSync } from 'node:fs';\n"
      "const heard = (what) => {\n"
      "  while (!existsSync('" +
          folder.path().string() +
          "/' + what)) Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 10);\n"
          "};\n"
          "writeSync(1, 'done 0.25\\nnote a wall\\n'); heard('a quarter');\n"
          "writeSync(1, 'done 0.5\\ndone 0.75'); heard('half');\n"
          "process.exit(4);\n");
  ReadingShare share;
  std::atomic<bool> over = false;
  std::vector<double> heard;
  std::thread listener([&] {
    for (const auto& [wanted, what] : {std::pair(0.25, "a quarter"), std::pair(0.5, "half")}) {
      while (!over && share.share().value_or(0) < wanted) std::this_thread::yield();
      heard.push_back(share.share().value_or(0));
      folder.write(what, "");
    }
  });
  const auto none = ifc_shapes(model, slow, 60, &share);
  over = true;
  listener.join();
  REQUIRE(none.ok());
  CHECK(none->parts.empty());
  CHECK(none->notes == std::vector<std::string>{"a wall"});
  CHECK(heard == std::vector<double>{0.25, 0.5});
  CHECK(share.share() == std::optional(1.0));
}

TEST_CASE("the script computes products in batches, and reports the share done", "[import]") {
  const fs::path script = fs::path(LUX_SOURCE_DIR) / "actors/import/shapes/ifc_shapes.mjs";
  if (!node_is_there()) return;
  if (!fs::is_directory(script.parent_path() / "node_modules/@ifc-lite/wasm")) {
    WARN("skipped: the package @ifc-lite/wasm is not there (./setup.sh)");
    return;
  }
  const TemporaryFolder folder;
  const auto model = folder.write("small.ifc", SmallIfc{}.text());
  const auto said = folder / "said";
  REQUIRE(std::system(("node '" + script.string() + "' '" + model.string() + "' '" +
                       (folder / "out.glb").string() + "' > '" + said.string() + "'")
                          .c_str()) == 0);
  std::vector<double> shares;
  std::ifstream in(said);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("done ")) shares.push_back(std::stod(line.substr(5)));
  // With fewer products than batches, each is a batch.
  REQUIRE(shares.size() > 5);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() == Approx(1 / static_cast<double>(shares.size())));
  CHECK(shares.back() == 1);
}

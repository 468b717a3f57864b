// The installed library as a stranger has it: an own program, found by CMake and by pkg-config.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/kit/temporary_folder.hpp"

using luxodus::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Runs a command in the folder and returns what it printed; fails the test if the command fails.
std::string run(const TemporaryFolder& folder, const std::string& command) {
  const fs::path log = folder / "log";
  const int status = std::system(
      ("cd '" + folder.path().string() + "' && { " + command + "; } >log 2>&1").c_str());
  const std::string said = text_of(log);
  INFO(command);
  INFO(said);
  REQUIRE(status == 0);
  return said;
}

std::string install(const TemporaryFolder& folder) {
  run(folder, "cmake --install " LUX_BINARY_DIR " --component runtime --prefix installed");
  return (folder / "installed").string();
}

const std::string outside = LUX_SOURCE_DIR "/tests/library/outside";
const std::string flags =
    std::string(LUX_SANITIZE).empty() ? "" : "-fsanitize=" + std::string(LUX_SANITIZE);

}  // namespace

TEST_CASE("a program outside of this tree is built with the CMake package and runs",
          "[library][install]") {
  const TemporaryFolder folder;
  const std::string prefix = install(folder);
  run(folder, "cmake -S " + outside + " -B built -DCMAKE_PREFIX_PATH=" + prefix +
                  " -DCMAKE_CXX_FLAGS='" + flags + "' && cmake --build built");
  CHECK(run(folder, "built/outside") == "outside: hello, hello\n");
}

TEST_CASE("a program outside of this tree is built with pkg-config and runs",
          "[library][install]") {
  const TemporaryFolder folder;
  const std::string prefix = install(folder);
  run(folder, "export PKG_CONFIG_PATH=$(dirname $(find " + prefix +
                  " -name luxodus-runtime.pc)); c++ -std=c++20 " + flags + " " + outside +
                  "/main.cpp -o outside $(pkg-config --cflags --libs luxodus-runtime)");
  CHECK(run(folder, "./outside") == "outside: hello, hello\n");
}

TEST_CASE("configuring the runtime alone asks for no library of the light", "[library][install]") {
  const TemporaryFolder folder;
  run(folder, "cmake -S " LUX_SOURCE_DIR
              " -B built -DLUX_RUNTIME_ONLY=ON -DLUX_TESTS=OFF -DCMAKE_BUILD_TYPE=Release");
  const std::string cache = text_of(folder / "built/CMakeCache.txt");
  for (const char* needed : {"spdlog_DIR", "cppzmq_DIR", "capnp_VERSION", "xxhash_VERSION"}) {
    INFO(needed);
    CHECK(cache.find(needed) != std::string::npos);
  }
  for (const char* not_needed :
       {"embree", "glm_DIR", "openexr", "cairo", "cbc", "nlopt", "CLI11", "PNG", "pybind11"}) {
    INFO(not_needed);
    CHECK(cache.find(not_needed) == std::string::npos);
  }
}

// It compiles the whole runtime, which takes minutes.
TEST_CASE("the runtime alone is built, installed and used", "[.long][library][install]") {
  const TemporaryFolder folder;
  run(folder, "cmake -S " LUX_SOURCE_DIR
              " -B runtime -DLUX_RUNTIME_ONLY=ON -DLUX_TESTS=OFF -DCMAKE_BUILD_TYPE=Release"
              " && cmake --build runtime --parallel 2"
              " && cmake --install runtime --prefix installed");
  run(folder, "cmake -S " + outside + " -B built -DCMAKE_PREFIX_PATH=$PWD/installed" +
                  " && cmake --build built");
  CHECK(run(folder, "built/outside") == "outside: hello, hello\n");
}

TEST_CASE("what is installed names nothing of this tree", "[library][install]") {
  const TemporaryFolder folder;
  const fs::path prefix = install(folder);
  size_t headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
    const std::string name = entry.path().extension().string();
    if (name == ".hpp") ++headers;
    if (name == ".cmake" || name == ".pc") {
      INFO(entry.path());
      CHECK(text_of(entry.path()).find(LUX_SOURCE_DIR) == std::string::npos);
    }
  }
  CHECK(headers > 80);
  CHECK_FALSE(fs::exists(prefix / "include/luxodus/runtime/toml"));
  CHECK_FALSE(fs::exists(prefix / "include/luxodus/scenes"));
}

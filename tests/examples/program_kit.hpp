// Shared by tests that run the program: a command's output and files.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/kit/temporary_folder.hpp"

namespace luxodus::program {

namespace fs = std::filesystem;

using test::TemporaryFolder;

inline std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

struct Outcome {
  int code;
  std::string out;
  std::string err;
};

/// Runs a shell command line.
inline Outcome shell(const TemporaryFolder& folder, const std::string& command) {
  const int status = std::system(("{ " + command + "; } >" + (folder / "stdout").string() + " 2>" +
                                  (folder / "stderr").string())
                                     .c_str());
  return {WEXITSTATUS(status), slurp(folder / "stdout"), slurp(folder / "stderr")};
}

/// Runs the program. `under`: a program that starts it.
inline Outcome run_luxodus(const TemporaryFolder& folder, const std::string& arguments,
                           const std::string& under = "") {
  return shell(folder, under + LUX_PROGRAM + " " + arguments);
}

/// A scene in a folder of its own, and the folder of its results.
struct ScenePlace {
  TemporaryFolder folder;
  std::string scene;
  fs::path out = folder / "out";

  ScenePlace(const std::string& name, const std::string& text) : scene((folder / name).string()) {
    std::ofstream(scene) << text;
  }
  Outcome luxodus(const std::string& command, const std::string& under = "") const {
    return run_luxodus(folder, command, under);
  }
  Outcome run(const std::string& options, const std::string& under = "") const {
    return luxodus("run " + scene + " --out " + out.string() + " " + options, under);
  }
};

}  // namespace luxodus::program

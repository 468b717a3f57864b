// What tests that run the program share: a folder of their own, what a command said and left.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace luxodus::program {

namespace fs = std::filesystem;

/// A folder of its own for one test, gone afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "luxodus_test_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

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

/// Runs a line of shell.
inline Outcome shell(const Folder& folder, const std::string& command) {
  const int status = std::system(("{ " + command + "; } >" + (folder.path / "stdout").string() +
                                  " 2>" + (folder.path / "stderr").string())
                                     .c_str());
  return {WEXITSTATUS(status), slurp(folder.path / "stdout"), slurp(folder.path / "stderr")};
}

/// Runs the program. `under`: a program that starts it.
inline Outcome run_luxodus(const Folder& folder, const std::string& arguments,
                           const std::string& under = "") {
  return shell(folder, under + LUX_PROGRAM + " " + arguments);
}

}  // namespace luxodus::program

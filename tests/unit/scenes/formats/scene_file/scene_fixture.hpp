// A temporary folder for scene files of tests, and short functions to write and read them.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus {

class SceneFolder {
 public:
  SceneFolder() {
    put("lamp.ies", lamp);
    put("cube.obj", cube);
    put("cube.mtl", "newmtl paint\nKd 0.5 0.5 0.5\nnewmtl steel\nKd 0.2 0.2 0.2\n");
  }

  std::filesystem::path put(const std::string& name, const std::string& text) {
    return folder_.write(name, text);
  }
  ReadScene read(const std::string& text) { return read_scene(put("scene.toml", text)); }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  /// 300, 200 and 0 cd at 0, 45 and 90 degrees; a round opening of 0.2 m.
  static constexpr const char* lamp =
      "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
      "300 200 0\n";
  /// Two separate triangles: parts "leaf" of paint and "frame" of steel; in whatever units the
  /// import states.
  static constexpr const char* cube =
      "mtllib cube.mtl\no leaf\nv 0 0 0\nv 100 0 0\nv 0 200 0\nusemtl paint\nf 1 2 3\no frame\n"
      "v 0 0 50\nv 100 0 50\nv 0 200 50\nusemtl steel\nf 4 5 6\n";
  test::TemporaryFolder folder_;
};

/// All problems, one a line: for messages of failed checks.
inline std::string all_problems(const ReadScene& read) {
  std::string out;
  for (const Problem& p : read.problems.list()) out += p.text() + "\n";
  return out;
}

inline constexpr double pi = std::numbers::pi;

inline SceneDescription good(SceneFolder& folder, const std::string& text) {
  ReadScene read = folder.read(text);
  INFO(all_problems(read));
  REQUIRE(read.scene.has_value());
  REQUIRE(read.problems.empty());
  return *read.scene;
}

inline Approx near(double v) {
  return Approx(v).epsilon(1e-12).margin(1e-12);
}

inline bool same(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b) < 1e-12;
}

template <class T>
const T& named(const std::vector<T>& list, const std::string& name) {
  for (const T& t : list) {
    if (t.name == name) return t;
  }
  FAIL("nothing is called " << name);
  return list.front();
}

/// The optics of a homogeneous medium with these keys.
inline SmokeOptics smoke_optics(SceneFolder& folder, const std::string& keys) {
  return good(folder, "[[medium]]\nname = \"s\"\nkind = \"homogeneous\"\nalbedo = 0\n" + keys)
      .media.at(0)
      .optics;
}

}  // namespace luxodus

// [project]: data for reports, and the logo.
#include <catch2/catch.hpp>

#include "scenes/formats/images/logo.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

std::string bytes_of_png(int width, int height) {
  PngImage image;
  image.width = width;
  image.height = height;
  image.rgb.assign(static_cast<size_t>(3 * width * height), 200);
  image.text = {{"Comment", "<script>alert(1)</script>"}};
  const auto png = encode_png(image, {});
  REQUIRE(png.ok());
  return std::string(reinterpret_cast<const char*>(png->data()), png->size());
}

std::string problems_of(const ReadScene& read) {
  std::string out;
  for (const Problem& problem : read.problems.list()) out += problem.text() + "\n";
  return out;
}

}  // namespace

TEST_CASE("a project's table is read, and keys of the including file win", "[format][project]") {
  const test::TemporaryFolder folder;
  folder.write("logo.png", bytes_of_png(20, 10));
  folder.write("base.toml",
               "[project]\nname = \"Base\"\nclient = \"Somebody\"\nlogo = \"logo.png\"\n");
  const auto read = read_scene(folder.write("scene.toml",
                                            "include = [\"base.toml\"]\n[project]\nname = "
                                            "\"Tower\"\ndate = 2026-11-23\nnorth_deg = 30\n"));
  INFO(problems_of(read));
  REQUIRE(read.scene);
  const ProjectSettings& p = read.scene->project;
  CHECK(p.name == "Tower");
  CHECK(p.client == "Somebody");
  CHECK(p.date == "2026-11-23");
  CHECK(p.north_deg == 30);
  CHECK(p.logo == folder / "logo.png");
}

TEST_CASE("a logo keeps only its pixels, and must not be a drawing", "[format][project]") {
  const test::TemporaryFolder folder;
  const auto logo = read_logo(folder.write("logo.png", bytes_of_png(20, 10)));
  REQUIRE(logo.ok());
  CHECK(logo->find("script") == std::string::npos);
  CHECK(logo->substr(1, 3) == "PNG");
  const std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\"><script>1</script></svg>";
  folder.write("logo.svg", svg);
  folder.write("fake.png", svg);
  folder.write("cut.png", bytes_of_png(20, 10).substr(0, 60));
  folder.write("wide.png", bytes_of_png(limits::logo_side + 1, 1));
  for (const std::string name : {"logo.svg", "fake.png", "cut.png", "wide.png", "none.png"}) {
    const auto read = read_scene(
        folder.write("scene.toml", "[project]\nname = \"x\"\nlogo = \"" + name + "\"\n"));
    INFO(name);
    CHECK_FALSE(read.scene);
    CHECK(problems_of(read).find("scene.toml:3") != std::string::npos);
  }
}

TEST_CASE("texts of a project have a length limit", "[format][project]") {
  const test::TemporaryFolder folder;
  const auto read = read_scene(
      folder.write("scene.toml", "[project]\nclient = \"" + std::string(500, 'x') + "\"\n"));
  CHECK_FALSE(read.scene);
  CHECK(problems_of(read).find("scene.toml:2") != std::string::npos);
}

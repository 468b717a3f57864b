// [[backdrop]]: drawings under plans.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/formats/images/page_picture.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/small_dxf.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Contains;

namespace {

std::string plan_png(int width, int height) {
  PngImage image;
  image.width = width;
  image.height = height;
  image.rgb.assign(static_cast<size_t>(3 * width * height), 180);
  const auto png = encode_png(image, {});
  REQUIRE(png.ok());
  return std::string(reinterpret_cast<const char*>(png->data()), png->size());
}

/// A floor of 5 m x 4 m, and a backdrop with `keys`.
struct BackdropScene {
  test::TemporaryFolder folder;

  ReadScene read(const std::string& keys) {
    return read_scene(folder.write("scene.toml",
                                   "[[object]]\nname = \"floor\"\nshape = \"quad\"\n"
                                   "corner = [0, 0, 0]\nedge_u = [5, 0, 0]\nedge_v = [0, 4, 0]\n"
                                   "material = \"grey50\"\n[[backdrop]]\n" +
                                       keys));
  }
  Backdrop one(const std::string& keys) {
    const ReadScene scene = read(keys);
    for (const Problem& p : scene.problems.list()) UNSCOPED_INFO(p.text());
    REQUIRE(scene.scene);
    REQUIRE(scene.scene->backdrops.size() == 1);
    return scene.scene->backdrops.front();
  }
  std::string fault(const std::string& keys) {
    const ReadScene refused = read(keys);
    std::string out;
    for (const Problem& p : refused.problems.list()) out += p.text() + "\n";
    return out;
  }
};

}  // namespace

TEST_CASE("a picture under plans has its corner, its edges and its floors", "[format][backdrop]") {
  BackdropScene scene;
  scene.folder.write("plan.png", plan_png(100, 50));
  const Backdrop picture = scene.one(
      "file = \"plan.png\"\nmetres_per_pixel = 0.05\norigin = [1, 2]\nrotation_deg = 90\n"
      "floors = [3, -1]\n");
  CHECK(picture.picture);
  CHECK(picture.corner == glm::dvec2(1, 2));
  CHECK(glm::length(picture.across - glm::dvec2(0, 5)) < 1e-12);
  CHECK(glm::length(picture.up - glm::dvec2(-2.5, 0)) < 1e-12);
  CHECK(picture.lies_under(0));
  CHECK_FALSE(picture.lies_under(3.5));
}

TEST_CASE("a drawing under plans has its lines in metres", "[format][backdrop]") {
  BackdropScene scene;
  scene.folder.write("plan.dxf", test::dxf_drawing());
  const Backdrop drawing = scene.one("file = \"plan.dxf\"\n");
  CHECK_FALSE(drawing.picture);
  REQUIRE(drawing.lines.size() == 5);  // four sides, and the line in a block of 1 mm by 1 mm
  double length = 0;
  for (const auto& [a, b] : drawing.lines) length += glm::length(b - a);
  CHECK(length == Approx(18 + std::sqrt(2) / 1000).epsilon(1e-9));
  // In inches the same numbers are 25.4 times as long, and a far origin gives a warning.
  const ReadScene far = scene.read("file = \"plan.dxf\"\nunits = \"in\"\norigin = [1000, 0]\n");
  REQUIRE(far.scene);
  CHECK(far.scene->backdrops.front().lines.front().second.x == Approx(1127));
  REQUIRE_FALSE(far.scene->warnings.empty());
  CHECK_THAT(far.scene->warnings.front().text(), Contains("beside the building"));
}

TEST_CASE("all backdrops of a scene have a common limit, reported where it is exceeded",
          "[format][backdrop]") {
  BackdropScene scene;
  // Noise does not compress: three bytes a pixel.
  PngImage noise;
  noise.width = noise.height = 1000;
  uint32_t state = 1;
  for (int i = 0; i < 3 * noise.width * noise.height; ++i)
    noise.rgb.push_back(static_cast<uint8_t>((state = state * 1664525 + 1013904223) >> 24));
  const auto png = encode_png(noise, {});
  REQUIRE(png.ok());
  REQUIRE(png->size() < limits::backdrop_bytes);
  scene.folder.write("noise.png",
                     std::string(reinterpret_cast<const char*>(png->data()), png->size()));
  const std::string one = "file = \"noise.png\"\nmetres_per_pixel = 0.01\n";
  const auto times = [&](size_t n) {
    std::string out = one;
    for (size_t i = 1; i < n; ++i) out += "[[backdrop]]\n" + one;
    return out;
  };
  const size_t fit = limits::backdrops_bytes / png->size();
  CHECK(scene.read(times(fit)).scene);
  const std::string refused = scene.fault(times(fit + 2));
  CHECK_THAT(refused, Contains("MB that all of a scene may"));
  CHECK(std::count(refused.begin(), refused.end(), '\n') == 1);  // once, not of each that follows
}

TEST_CASE("a backdrop without a scale, of another kind or too large is rejected",
          "[format][backdrop]") {
  BackdropScene scene;
  scene.folder.write("plan.png", plan_png(10, 10));
  scene.folder.write("wide.png", plan_png(limits::backdrop_side + 1, 1));
  scene.folder.write("plan.dxf", test::dxf_drawing("", "0"));
  scene.folder.write("plan.svg", "<svg/>");
  scene.folder.write("fake.png", "<svg/>");
  scene.folder.write("fake.dxf", "AC1027");
  CHECK_THAT(scene.fault("file = \"plan.png\"\n"), Contains("metres_per_pixel"));
  CHECK_THAT(scene.fault("file = \"plan.png\"\nmetres_per_pixel = 1\nunits = \"m\"\n"),
             Contains("scene.toml:11:") && Contains("'units' is of drawings"));
  CHECK_THAT(scene.fault("file = \"plan.dxf\"\n"), Contains("'units'"));
  CHECK_THAT(scene.fault("file = \"plan.dxf\"\nunits = \"m\"\nmetres_per_pixel = 1\n"),
             Contains("'metres_per_pixel' is of pictures"));
  CHECK_THAT(scene.fault("file = \"plan.svg\"\n"), Contains(".png or .dxf"));
  CHECK_THAT(scene.fault("file = \"wide.png\"\nmetres_per_pixel = 1\n"), Contains("3000 pixels"));
  CHECK_THAT(scene.fault("file = \"fake.png\"\nmetres_per_pixel = 1\n"), Contains("PNG"));
  CHECK_THAT(scene.fault("file = \"fake.dxf\"\nunits = \"m\"\n"), Contains("DXF in text"));
  CHECK_THAT(scene.fault("file = \"none.png\"\nmetres_per_pixel = 1\n"), Contains("none.png"));
}

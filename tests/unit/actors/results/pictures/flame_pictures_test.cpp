// Pictures of steady flames: how they are exposed, and a moment on request, which they say.
#include <algorithm>
#include <catch2/catch.hpp>

#include "actors/results/pictures/flames_in_view.hpp"
#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string room_with_flame = R"([run]
max_bands = 3
[[material]]
name = "wall"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [3, 3, 2.5]
material = "wall"
[[medium]]
name = "flame"
kind = "bounded"
body = "cone"
position = [1.5, 1.5, 0]
radius = 0.4
height = 1.5
extinction = 1.5
albedo = 0
smoke = "flaming"
emission = { power_w = 2000, temperature_k = 1400 }
[[camera]]
name = "view"
eye = [0.2, 1.5, 1]
target = [1.5, 1.5, 0.7]
width = 48
height = 48
)";

std::string text_named(const PngImage& image, const std::string& key) {
  for (const auto& [name, text] : image.text)
    if (name == key) return text;
  return "";
}

}  // namespace

TEST_CASE("a flame is exposed like a sign, so that it is not white", "[display][flames]") {
  const auto run = traced(room_with_flame, 1 << 14);
  const Camera& camera = run->scene().description->cameras[0];
  PictureOptions options;
  options.raw = true;
  options.flames_at_s = 0.5;
  const PictureFlux flux = picture_flux(*run, options);
  ViewPasses passes(*run, camera, 0, flux.radiance.get(), flux.sight, options.flames_at_s);
  REQUIRE(passes.add(4, options));
  const ShownView view(passes.picture(), 4, options, 1);
  const double flame_cd_m2 = brightest_flame(run->scene(), camera, view.traced.noisy, view.shown());
  double most = 0;
  for (size_t i = 0; i < view.shown().pixels(); ++i)
    most = std::max(most, static_cast<double>(view.shown().xyz[3 * i + 1]));
  CHECK(flame_cd_m2 > 0.3 * most);
  CHECK(flame_cd_m2 <= most);
  const Exposure exposure = shown_exposure(*run, camera, view);
  CHECK(exposure.sign_cd_m2 == flame_cd_m2);
  CHECK(exposure.curve().shown(flame_cd_m2) <= sign_level + 1e-9);
  // Behind the camera there is none.
  Camera away = camera;
  away.target = {-1, 1.5, 1};
  CHECK(brightest_flame(run->scene(), away, view.traced.noisy, view.shown()) == 0);
}

TEST_CASE("a picture of a steady flame shows its mean or a moment, and says which",
          "[display][flames]") {
  const auto run = traced(room_with_flame, 1 << 14);
  const Camera& camera = run->scene().description->cameras[0];
  const auto view_at = [&](std::optional<double> moment_s) {
    PictureOptions options;
    options.raw = true;
    options.flames_at_s = moment_s;
    const PictureFlux flux = picture_flux(*run, options);
    ViewPasses passes(*run, camera, 0, flux.radiance.get(), flux.sight, moment_s);
    REQUIRE(passes.add(4, options));
    return ShownView(passes.picture(), 4, options, 1);
  };
  const ShownView mean = view_at({}), first = view_at(0.5), again = view_at(0.5),
                  later = view_at(0.6);
  CHECK(first.traced.emitted == again.traced.emitted);
  CHECK(first.traced.emitted != later.traced.emitted);
  CHECK(first.traced.emitted != mean.traced.emitted);
  // Only pixels with the flame differ.
  size_t flame = 0, changed_elsewhere = 0;
  for (size_t i = 0; i < mean.traced.light.pixels(); ++i) {
    const bool there = mean.traced.emitted[4 * i + 1] > 0;
    flame += there;
    for (size_t c = 0; c < 3 && !there; ++c)
      changed_elsewhere += first.traced.light.xyz[3 * i + c] != mean.traced.light.xyz[3 * i + c];
  }
  CHECK(flame > 100);
  CHECK(changed_elsewhere == 0);
  const auto said = [&](const ShownView& view) {
    return text_named(shown_image(false, *run, camera, view), "Flames");
  };
  CHECK(said(mean) == "their mean");
  CHECK(said(first).find("a moment, at 0.5 s") == 0);
}

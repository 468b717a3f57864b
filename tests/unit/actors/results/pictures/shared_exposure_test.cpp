// Pictures that share an exposure: clear air, smoke and the dark.
#include "actors/results/pictures/shared_exposure.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/formats/images/image_file.hpp"
#include "scenes/light/vision/tone.hpp"
#include "tests/unit/actors/results/pictures/room_with_sign.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A room with signs, lit, in smoke, and in the dark.
struct ThreeStates {
  ThreeStates() {
    for (const auto& [lamp_lm, air] :
         {std::pair{800.0, std::string()}, std::pair{100.0, room_smoke},
          std::pair{0.01, std::string()}})
      runs.push_back(traced(room_with_sign("exit_left.svg", lamp_lm, 200, air), 1 << 15));
    for (const auto& run : runs) views.push_back(view_of(*run, 16));
  }
  const Camera& camera() const { return runs[0]->scene().description->cameras[0]; }

  std::vector<std::unique_ptr<LocalRun>> runs;
  std::vector<ShownView> views;
};

/// The pixels of a PNG file as tone_plain gives them.
std::vector<double> texels_of(const SrgbPicture& picture) {
  std::vector<double> out;
  for (const uint8_t byte : picture.rgb)
    out.push_back(static_cast<double>(static_cast<float>(linear_from_srgb(byte / 255.0))));
  return out;
}

}  // namespace

TEST_CASE("clear air, smoke and the dark share an exposure, bit for bit", "[display][signs]") {
  const ThreeStates states;
  const TemporaryFolder folder;
  SharedExposure shared(folder.path());
  const auto file = [&](size_t i) { return folder / (std::to_string(i) + ".png"); };
  for (size_t i = 0; i < 3; ++i)
    REQUIRE(shared.keep(file(i), *states.runs[i], states.camera(), states.views[i]).ok());
  // The same picture again, with more paths, say: it is kept once.
  REQUIRE(shared.keep(file(1), *states.runs[1], states.camera(), states.views[1]).ok());
  REQUIRE(shared.pictures() == 3);
  const auto exposure = shared.write(2);
  REQUIRE(exposure.ok());
  // Nothing is left of the light that was kept.
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 3);

  LightMeter all;
  double sign_cd_m2 = 0, white_cd_m2 = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Exposure own = shown_exposure(*states.runs[i], states.camera(), states.views[i]);
    sign_cd_m2 = std::max(sign_cd_m2, own.sign_cd_m2);
    white_cd_m2 = std::max(white_cd_m2, own.white_cd_m2);
    CHECK(own.grey_cd_m2 != exposure->grey_cd_m2);
  }
  CHECK(exposure->sign_cd_m2 == sign_cd_m2);
  CHECK(exposure->white_cd_m2 == white_cd_m2);
  for (size_t i = 0; i < 3; ++i) {
    const XyzPicture light =
        white_balance_of(*states.runs[i], states.views[i]).balanced(states.views[i].shown());
    const auto texels = read_png(file(i).string());
    REQUIRE(texels.ok());
    const std::vector<double> wanted = texels_of(tone_plain(light, exposure->curve()));
    REQUIRE(texels->texels.size() == wanted.size());
    size_t differ = 0;
    for (size_t k = 0; k < wanted.size(); ++k)
      differ += std::abs(static_cast<double>(texels->texels[k]) - wanted[k]) > 1e-6;
    CHECK(differ == 0);
  }
}

TEST_CASE("legends stay apart from their grounds in every picture of a shared exposure",
          "[display][signs]") {
  ThreeStates states;
  const TemporaryFolder folder;
  SharedExposure shared(folder.path());
  for (size_t i = 0; i < 3; ++i)
    REQUIRE(shared
                .keep(folder / (std::to_string(i) + ".png"), *states.runs[i], states.camera(),
                      states.views[i])
                .ok());
  const auto exposure = shared.write(1);
  REQUIRE(exposure.ok());
  CHECK(exposure->curve().shown(exposure->sign_cd_m2) <= sign_level + 1e-9);
  for (size_t i = 0; i < 3; ++i) {
    ShownView& view = states.views[i];
    view.exposure = exposure.value();
    const PngImage plain = shown_image(false, *states.runs[i], states.camera(), view);
    for (const SignInView& sign :
         signs_in_view(states.runs[i]->scene(), states.camera(), view.traced.noisy)) {
      if (sign.colours[0].empty() || sign.colours[1].empty()) continue;
      const double ratio = mean_luminance(view.shown(), sign.colours[0]) /
                           mean_luminance(view.shown(), sign.colours[1]);
      INFO("picture " << i << ", ratio " << ratio);
      REQUIRE(ratio > 1.2);
      const double white = shown_luminance(plain, sign.colours[0]);
      CHECK(white / shown_luminance(plain, sign.colours[1]) >= std::pow(ratio, 0.4));
      CHECK(white < sign_level + 0.05);
    }
  }
}

TEST_CASE("pictures that share an exposure share the white that eyes adapt to", "[display]") {
  const std::vector<std::optional<Xyz>> lights{Xyz{110, 100, 40}, std::nullopt, Xyz{0.9, 1, 1}};
  const auto mean = mean_light(lights);
  REQUIRE(mean);
  CHECK((*mean)[1] == Approx(10));
  CHECK((*mean)[0] == Approx(10 * (1.1 + 0.9) / 2));
  CHECK((*mean)[2] == Approx(10 * (0.4 + 1) / 2));
  CHECK_FALSE(mean_light({std::nullopt}));
}

TEST_CASE("views of a call share an exposure if that is wanted", "[display]") {
  const std::string other = R"([[camera]]
name = "at the lamp"
eye = [0.8, 1.5, 1.6]
target = [1, 1.5, 2.4]
width = 40
height = 30
)";
  const auto run = traced(room_with_sign("exit_left.svg", 500, 200, other), 1 << 13);
  const TemporaryFolder folder;
  PictureOptions options;
  options.paths_per_pixel = 8;
  options.share_exposure = true;
  const auto together = render_views(folder.path(), *run, "", options, {});
  REQUIRE(together.ok());
  REQUIRE(together->exposures.size() == 2);
  const auto& [first, exposure] = together->exposures[0];
  CHECK(text_of(exposure) == text_of(together->exposures[1].second));
  for (const auto& [name, of_view] : together->exposures)
    CHECK(file_text(folder / "views" / (name == "view" ? "view.png" : "at_the_lamp.png"))
              .find("Exposure") != std::string::npos);
  options.share_exposure = false;
  const TemporaryFolder apart;
  const auto each = render_views(apart.path(), *run, "", options, {});
  REQUIRE(each.ok());
  CHECK(text_of(each->exposures[0].second) != text_of(each->exposures[1].second));
  // The stated exposure gives the same picture.
  options.exposure = exposure;
  const TemporaryFolder stated;
  REQUIRE(render_views(stated.path(), *run, "view", options, {}).ok());
  CHECK(read_png((stated / "views/view.png").string())->texels ==
        read_png((folder / "views/view.png").string())->texels);
}

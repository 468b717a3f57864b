// Which pixels show a sign, and whether its legend stays apart from its ground on the screen.
#include "actors/results/pictures/signs_in_view.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/actors/results/pictures/room_with_sign.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("pixels of a sign are found where it is seen, and not where it is hidden",
          "[display][signs]") {
  const auto run = traced(room_with_sign("exit_left.svg", 500, 200), 1 << 14);
  const ShownView view = view_of(*run, 16);
  const auto signs =
      signs_in_view(run->scene(), run->scene().description->cameras[0], view.traced.noisy);
  REQUIRE(signs.size() == 2);
  CHECK(run->scene().description->signs[signs[0].sign].name == "seen");
  const auto count = [](const SignInView& sign) {
    return sign.colours[0].size() + sign.colours[1].size();
  };
  // 0.4 m by 0.2 m with 35 pixels a metre: 14 by 7, less pixels of both colours.
  CHECK(count(signs[0]) > 45);
  CHECK(count(signs[0]) < 14 * 7);
  CHECK(count(signs[1]) > 10);
  CHECK(10 * count(signs[1]) < 7 * count(signs[0]));
  // Their own light and what they reflect.
  CHECK(mean_luminance(view.shown(), signs[0].colours[0]) == Approx(200).epsilon(0.3));
  CHECK(brightest_face(view.shown(), signs) >= mean_luminance(view.shown(), signs[0].colours[0]));
}

TEST_CASE("a sign's white is shown brighter than its green in clear air, smoke and the dark",
          "[display][signs]") {
  for (const char* drawing : {"exit_left.svg", "exit_right.svg", "exit_straight.svg"})
    for (const auto& [lamp, white, air] :
         {std::tuple{800.0, 500.0, std::string()}, std::tuple{0.5, 75.0, std::string()},
          std::tuple{0.001, 2.0, std::string()}, std::tuple{200.0, 75.0, room_smoke},
          std::tuple{0.01, 40.0, room_smoke}}) {
      const auto run = traced(room_with_sign(drawing, lamp, white, air), 1 << 15);
      const ShownView view = view_of(*run, 16);
      const Camera& camera = run->scene().description->cameras[0];
      const auto signs = signs_in_view(run->scene(), camera, view.traced.noisy);
      REQUIRE(!signs.empty());
      for (const SignInView& sign : signs) {
        if (sign.colours[0].empty() || sign.colours[1].empty()) continue;
        const double ratio = mean_luminance(view.shown(), sign.colours[0]) /
                             mean_luminance(view.shown(), sign.colours[1]);
        INFO(drawing << ", lamp of " << lamp << " lm, white of " << white << " cd/m2, ratio "
                     << ratio);
        REQUIRE(ratio > 1.2);
        const PngImage plain = shown_image(false, *run, camera, view);
        CHECK(shown_luminance(plain, sign.colours[0]) / shown_luminance(plain, sign.colours[1]) >=
              std::pow(ratio, 0.4));
        const PngImage human = shown_image(true, *run, camera, view);
        CHECK(shown_luminance(human, sign.colours[0]) > shown_luminance(human, sign.colours[1]));
      }
      const PngImage plain = shown_image(false, *run, camera, view);
      CHECK(shown_luminance(plain, signs[0].colours[0]) < 0.85);
    }
}

TEST_CASE("pictures of equal exposure show equal luminances alike", "[display][signs]") {
  const auto bright = traced(room_with_sign("exit_left.svg", 800, 500), 1 << 14);
  const auto dark = traced(room_with_sign("exit_left.svg", 0.001, 500), 1 << 14);
  const Camera& camera = bright->scene().description->cameras[0];
  ShownView in_light = view_of(*bright, 8), in_dark = view_of(*dark, 8);
  const auto signs = signs_in_view(bright->scene(), camera, in_light.traced.noisy);
  const auto shown = [&](const LocalRun& run, const ShownView& view) {
    return shown_luminance(shown_image(false, run, camera, view), signs.front().colours[0]);
  };
  const Exposure own = shown_exposure(*bright, camera, in_light);
  CHECK(own.sign_cd_m2 == Approx(500).epsilon(0.4));
  const double lit = shown(*bright, in_light);
  in_light.exposure = in_dark.exposure = own;
  CHECK(shown(*bright, in_light) == lit);
  // The lamp adds a part of the sign's light in the bright room alone.
  CHECK(shown(*dark, in_dark) < lit);
  CHECK(shown(*dark, in_dark) > 0.8 * lit);
}

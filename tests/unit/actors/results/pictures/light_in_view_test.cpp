#include "actors/results/pictures/light_in_view.hpp"

#include <catch2/catch.hpp>

#include "actors/results/pictures/pixel_sums.hpp"

using namespace luxodus;

namespace {

/// What one pixel shows.
struct Shown {
  Xyz light{};
  Xyz albedo{1, 1, 1};
  float transmittance = 1;
  Xyz emitted{0, 0, 0};  // of `light`
};

TracedPicture picture_of(const std::vector<Shown>& pixels) {
  TracedPicture out;
  out.light.width = out.noisy.width = static_cast<int>(pixels.size());
  out.light.height = out.noisy.height = 1;
  for (const Shown& one : pixels) {
    for (const double v : one.light) out.light.xyz.push_back(static_cast<float>(v));
    for (const double v : one.emitted) out.emitted.push_back(static_cast<float>(v));
    out.emitted.push_back(0);  // scotopic
    for (const float v : {0.f, 0.f, 1.f, 0.2f, one.transmittance}) out.noisy.features.push_back(v);
    for (const double v : one.albedo) out.noisy.features.push_back(static_cast<float>(v));
  }
  return out;
}

}  // namespace

TEST_CASE("the light on surfaces is what they show over their albedo", "[pictures]") {
  const Xyz warm{11, 10, 4};
  const auto lit = [&](const Xyz& albedo) {
    return Shown{{warm[0] * albedo[0], warm[1] * albedo[1], warm[2] * albedo[2]}, albedo};
  };
  const auto light = light_on_surfaces(
      picture_of({lit({0.8, 0.8, 0.8}), lit({0.5, 0.2, 0.1}), lit({0.1, 0.3, 0.6})}));
  REQUIRE(light);
  for (size_t c = 0; c < 3; ++c) CHECK((*light)[c] == Approx(warm[c]).epsilon(1e-5));
}

TEST_CASE("lamps, flames and smoke in view do not count as surfaces", "[pictures]") {
  const Shown wall{{5, 5, 5}, {0.5, 0.5, 0.5}};
  const Shown flame{{900, 500, 20}, {0.5, 0.5, 0.5}, 1, {895, 495, 15}};
  const Shown smoke{{90, 50, 2}, {0.5, 0.5, 0.5}, 0.1f};
  const Shown soot{{90, 50, 2}, {0.01, 0.01, 0.01}};
  const auto light = light_on_surfaces(picture_of({wall, flame, smoke, smoke, soot, soot, flame}));
  REQUIRE(light);
  for (const double v : *light) CHECK(v == Approx(10).epsilon(1e-4));
  CHECK_FALSE(light_on_surfaces(picture_of({smoke, soot})));
  CHECK_FALSE(light_on_surfaces(picture_of({{{0, 0, 0}}})));
}

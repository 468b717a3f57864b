// Widths of the parts of faces that are drawn texel by texel.
#include "scenes/light/signs/legend_size.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "scenes/light/signs/sign_face.hpp"

using namespace luxodus;

namespace {

constexpr ColourIndex white_at = 0, green_at = 1;

/// A green face of 80 by 40 texels of 1 cm.
Sign green_sign() {
  Sign sign;
  sign.width_m = 0.8;
  sign.height_m = 0.4;
  sign.face.width = 80;
  sign.face.height = 40;
  sign.face.colour.assign(80 * 40, green_at);
  return sign;
}

void fill(Sign& sign, int left, int top, int across, int down, ColourIndex colour = white_at) {
  for (int y = top; y < top + down; ++y)
    for (int x = left; x < left + across; ++x)
      sign.face.colour[static_cast<size_t>(y * sign.face.width + x)] = colour;
}

LegendSize size_of(const Sign& sign, double width_m) {
  const auto out = legend_size(sign, width_m);
  REQUIRE(out);
  return *out;
}

}  // namespace

TEST_CASE("the widest part of a drawing is measured to a texel", "[signs][legend]") {
  for (const int width : {1, 2, 3, 8, 15}) {
    Sign sign = green_sign();
    fill(sign, 10, 5, width, 30);
    const double widest = size_of(sign, 0.05).widest_m;
    INFO("a bar of " << width << " texels");
    CHECK(widest >= 0.01 * width - 1e-9);
    CHECK(widest <= 0.01 * (width + 1) + 1e-9);
  }
}

TEST_CASE("a part ends where the face does", "[signs][legend]") {
  Sign sign = green_sign();
  fill(sign, 0, 5, 3, 20);
  CHECK(size_of(sign, 0.05).widest_m <= 0.04 + 1e-9);
}

TEST_CASE("the share of a drawing that is finer than a width is that of its areas",
          "[signs][legend]") {
  Sign sign = green_sign();
  fill(sign, 5, 10, 20, 20);   // 400 texels, 20 wide
  fill(sign, 40, 10, 5, 20);   // 100 texels, 5 wide
  fill(sign, 60, 10, 10, 20);  // 200 texels, 10 wide
  CHECK(size_of(sign, 0.03).finer_share == 0);
  CHECK(size_of(sign, 0.08).finer_share == Approx(100.0 / 700).margin(0.03));
  CHECK(size_of(sign, 0.15).finer_share == Approx(300.0 / 700).margin(0.1));
  CHECK(size_of(sign, 0.3).finer_share == 1);
}

TEST_CASE("gaps that a legend encloses are parts, too, and the ground is none", "[signs][legend]") {
  Sign sign = green_sign();
  CHECK_FALSE(legend_size(sign, 0.05));
  fill(sign, 10, 10, 30, 20);
  fill(sign, 24, 12, 2, 16, green_at);
  const double enclosed = size_of(sign, 0.05).finer_share;
  CHECK(enclosed > 0);
  fill(sign, 24, 5, 2, 30, green_at);  // now it is connected with the ground
  CHECK(size_of(sign, 0.05).finer_share < enclosed);
  CHECK_FALSE(legend_size(
      [] {
        Sign plain = green_sign();
        plain.face = uniform_face(white_at, 0.8, 0.4, 80).value();
        return plain;
      }(),
      0.05));
}

#include "scenes/light/transport/image_tile.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

using namespace luxodus;

namespace {

Image some_image(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i)
    image.texels.push_back(static_cast<float>(i * 31 % 1009) / 1009.0f);
  return image;
}

Image outline_of(const Image& image) {
  return {image.width, image.height, image.channels, {}};
}

}  // namespace

TEST_CASE("tiles hold every texel of a picture once and are restored from their bytes",
          "[transport][tile]") {
  for (const auto& [width, height, channels] :
       {std::array{1, 1, 1}, std::array{64, 64, 3}, std::array{65, 63, 3}, std::array{200, 130, 4},
        std::array{3, 129, 2}}) {
    INFO(width << " x " << height << " x " << channels);
    const Image image = some_image(width, height, channels);
    Image back = outline_of(image);
    back.texels.resize(image.texels.size(), -1.0f);
    for (uint32_t tile = 0; tile < tile_columns(image) * tile_rows(image); ++tile) {
      const auto bytes = encode_tile(cut_tile(image, tile));
      CHECK(bytes.size() <= 24 + 64 * 64 * 4 * sizeof(float));
      const auto decoded = decode_tile(bytes, outline_of(image), tile);
      REQUIRE(decoded.ok());
      place_tile(decoded.value(), tile, back);
    }
    CHECK(back.texels == image.texels);
    for (int y = 0; y < height; y += 7) {
      for (int x = 0; x < width; x += 5) {
        const ImageTile tile = cut_tile(image, tile_of(image, x, y));
        const auto at = static_cast<size_t>((y * width + x) * channels);
        CHECK(std::equal(&image.texels[at], &image.texels[at] + channels, tile.texel(x, y)));
      }
    }
  }
}

TEST_CASE("a tile of another picture or length, or with impossible texels, is refused",
          "[transport][tile]") {
  const Image image = some_image(100, 70, 3);
  const auto bytes = encode_tile(cut_tile(image, 0));
  REQUIRE(decode_tile(bytes, image, 0).ok());
  for (size_t n = 0; n < bytes.size(); n += 97)
    CHECK_FALSE(decode_tile(std::span(bytes).first(n), image, 0).ok());
  CHECK_FALSE(decode_tile(bytes, image, 1).ok());
  CHECK_FALSE(decode_tile(bytes, some_image(100, 70, 1), 0).ok());
  CHECK_FALSE(decode_tile(bytes, some_image(60, 70, 3), 0).ok());
  for (const float value : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    auto harmed = bytes;
    std::memcpy(harmed.data() + 24 + 40, &value, sizeof value);
    CHECK_FALSE(decode_tile(harmed, image, 0).ok());
  }
  auto foreign = bytes;
  foreign[2] ^= std::byte{8};
  CHECK_FALSE(decode_tile(foreign, image, 0).ok());
}

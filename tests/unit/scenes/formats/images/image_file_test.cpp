#include "scenes/formats/images/image_file.hpp"

#include <png.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

struct Picture {
  uint32_t width = 0, height = 0;
  int depth = 8;
  int colour = PNG_COLOR_TYPE_GRAY;
  std::vector<unsigned char> rows;  // as PNG lays them out
  bool interlaced = false;
  double gamma = 0;
  bool srgb = false;
  std::vector<png_color> palette = {};
  std::vector<unsigned char> palette_alpha = {};
};

void append_bytes(png_structp png, png_bytep data, size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), count);
}

std::string encode(Picture picture) {
  std::string out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &out, append_bytes, nullptr);
  png_set_IHDR(png, info, picture.width, picture.height, picture.depth, picture.colour,
               picture.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (picture.gamma > 0) png_set_gAMA(png, info, picture.gamma);
  if (picture.srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!picture.palette.empty()) {
    png_set_PLTE(png, info, picture.palette.data(), static_cast<int>(picture.palette.size()));
  }
  if (!picture.palette_alpha.empty()) {
    png_set_tRNS(png, info, picture.palette_alpha.data(),
                 static_cast<int>(picture.palette_alpha.size()), nullptr);
  }
  png_write_info(png, info);
  std::vector<png_bytep> rows;
  const size_t row_bytes = picture.rows.size() / picture.height;
  for (size_t y = 0; y < picture.height; ++y) rows.push_back(picture.rows.data() + y * row_bytes);
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

Image read_ok(const std::string& path) {
  auto result = read_png(path);
  INFO((result.ok() ? std::string() : result.problem().text()));
  REQUIRE(result.ok());
  return std::move(result.value());
}

}  // namespace

TEST_CASE("the sRGB curve has its known values and no step at its joint", "[format][image]") {
  CHECK(linear_from_srgb(0) == 0);
  CHECK(linear_from_srgb(1) == Approx(1));
  CHECK(linear_from_srgb(0.5) == Approx(0.214041140482));
  CHECK(linear_from_srgb(0.04045) == Approx(linear_from_srgb(0.04046)).epsilon(1e-3));
}

TEST_CASE("a grey PNG of any depth becomes one linear channel, top row first", "[format][image]") {
  const TemporaryFolder folder;
  const Image eight =
      read_ok(folder.write("a.png", encode({2, 2, 8, PNG_COLOR_TYPE_GRAY, {0, 255, 128, 51}})));
  CHECK(eight.width == 2);
  CHECK(eight.height == 2);
  CHECK(eight.channels == 1);
  CHECK(eight.texels[0] == 0);
  CHECK(eight.texels[1] == 1);
  CHECK(eight.texels[2] == Approx(linear_from_srgb(128 / 255.0)));
  CHECK(eight.texels[3] == Approx(linear_from_srgb(0.2)));

  const Image sixteen = read_ok(
      folder.write("b.png", encode({2, 1, 16, PNG_COLOR_TYPE_GRAY, {0x12, 0x34, 0xff, 0xff}})));
  CHECK(sixteen.texels[0] == Approx(linear_from_srgb(0x1234 / 65535.0)));
  CHECK(sixteen.texels[1] == 1);

  const Image one = read_ok(folder.write("c.png", encode({8, 1, 1, PNG_COLOR_TYPE_GRAY, {0xa5}})));
  CHECK(one.texels == std::vector<float>{1, 0, 1, 0, 0, 1, 0, 1});
}

TEST_CASE("RGB and RGBA keep their order, and alpha is linear and not multiplied in",
          "[format][image]") {
  const TemporaryFolder folder;
  const Image rgb = read_ok(
      folder.write("a.png", encode({1, 2, 8, PNG_COLOR_TYPE_RGB, {255, 0, 51, 0, 255, 102}})));
  CHECK(rgb.channels == 3);
  CHECK(rgb.texels[0] == 1);
  CHECK(rgb.texels[1] == 0);
  CHECK(rgb.texels[2] == Approx(linear_from_srgb(0.2)));
  CHECK(rgb.texels[5] == Approx(linear_from_srgb(0.4)));
  const Image rgba =
      read_ok(folder.write("b.png", encode({1, 1, 8, PNG_COLOR_TYPE_RGBA, {255, 0, 102, 51}})));
  CHECK(rgba.channels == 4);
  CHECK(rgba.texels[2] == Approx(linear_from_srgb(0.4)));
  CHECK(rgba.texels[3] == Approx(0.2));
  const Image grey_alpha =
      read_ok(folder.write("c.png", encode({1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {102, 51}})));
  CHECK(grey_alpha.channels == 4);
  CHECK(grey_alpha.texels[0] == Approx(linear_from_srgb(0.4)));
  CHECK(grey_alpha.texels[2] == grey_alpha.texels[0]);
  CHECK(grey_alpha.texels[3] == Approx(0.2));
}

TEST_CASE("a palette is resolved, with its transparency if it has any", "[format][image]") {
  const TemporaryFolder folder;
  Picture picture{4, 1, 2, PNG_COLOR_TYPE_PALETTE, {0b00011011}};
  picture.palette = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
  const Image opaque = read_ok(folder.write("a.png", encode(picture)));
  CHECK(opaque.channels == 3);
  CHECK(opaque.texels == std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  picture.palette_alpha = {255, 0};
  const Image clear = read_ok(folder.write("b.png", encode(picture)));
  CHECK(clear.channels == 4);
  CHECK(clear.texels[3] == 1);
  CHECK(clear.texels[7] == 0);
  CHECK(clear.texels[11] == 1);
}

TEST_CASE("an interlaced PNG reads like a plain one", "[format][image]") {
  const TemporaryFolder folder;
  Picture picture{13, 11, 8, PNG_COLOR_TYPE_GRAY, {}};
  for (int i = 0; i < 13 * 11; ++i) picture.rows.push_back(static_cast<unsigned char>(i));
  const Image plain = read_ok(folder.write("a.png", encode(picture)));
  picture.interlaced = true;
  CHECK(read_ok(folder.write("b.png", encode(picture))).texels == plain.texels);
}

TEST_CASE("a PNG with another gamma is decoded by it, and sRGB and 1/2.2 mean sRGB",
          "[format][image]") {
  const TemporaryFolder folder;
  Picture picture{1, 1, 8, PNG_COLOR_TYPE_GRAY, {51}};
  picture.gamma = 1;
  CHECK(read_ok(folder.write("a.png", encode(picture))).texels[0] == Approx(0.2));
  picture.gamma = 0.5;
  CHECK(read_ok(folder.write("b.png", encode(picture))).texels[0] == Approx(0.04));
  picture.gamma = 1 / 2.2;
  CHECK(read_ok(folder.write("c.png", encode(picture))).texels[0] == Approx(linear_from_srgb(0.2)));
  picture.srgb = true;
  CHECK(read_ok(folder.write("d.png", encode(picture))).texels[0] == Approx(linear_from_srgb(0.2)));
}

TEST_CASE("a damaged PNG is rejected at every length and with every byte of its head changed",
          "[format][image]") {
  const TemporaryFolder folder;
  Picture picture{16, 16, 8, PNG_COLOR_TYPE_RGB, {}};
  for (int i = 0; i < 16 * 16 * 3; ++i) picture.rows.push_back(static_cast<unsigned char>(i * 37));
  const std::string good = encode(picture);
  REQUIRE(read_png(folder.write("good.png", good)).ok());
  for (size_t length = 0; length < good.size(); ++length) {
    REQUIRE_FALSE(read_png(folder.write("cut.png", good.substr(0, length))).ok());
  }
  for (size_t at = 0; at < 33; ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    REQUIRE_FALSE(read_png(folder.write("bad.png", bad)).ok());
  }
}

TEST_CASE(
    "a PNG that declares far more pixels than it can hold is rejected before memory is allocated",
    "[format][image]") {
  const TemporaryFolder folder;
  // Signature and a header with a right checksum, then nothing.
  std::string claims = encode({1, 1, 8, PNG_COLOR_TYPE_GRAY, {0}});
  const auto with_size = [&](uint32_t width, uint32_t height) {
    std::string out = claims;
    for (int i = 0; i < 4; ++i) {
      out[static_cast<size_t>(16 + i)] = static_cast<char>(width >> (24 - 8 * i));
      out[static_cast<size_t>(20 + i)] = static_cast<char>(height >> (24 - 8 * i));
    }
    uint32_t crc = 0xffffffffu;  // CRC-32 of PNG over the chunk's type and content
    for (size_t at = 12; at < 29; ++at) {
      crc ^= static_cast<unsigned char>(out[at]);
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    crc = ~crc;
    for (int i = 0; i < 4; ++i)
      out[static_cast<size_t>(29 + i)] = static_cast<char>(crc >> (24 - 8 * i));
    return out;
  };
  CHECK(read_png(folder.write("same.png", with_size(1, 1))).ok());
  const auto cut = read_png(folder.write("a.png", with_size(8000, 8000)));
  REQUIRE_FALSE(cut.ok());
  CHECK(cut.problem().what.find("cut short") != std::string::npos);
  const auto many = read_png(folder.write("b.png", with_size(16000, 16000)));
  REQUIRE_FALSE(many.ok());
  CHECK(many.problem().what.find("64 megapixels") != std::string::npos);
  CHECK_FALSE(read_png(folder.write("c.png", with_size(1, 2'000'000'000))).ok());
}

TEST_CASE("a file that is not a PNG, or is missing, is rejected by name", "[format][image]") {
  const TemporaryFolder folder;
  const auto absent = read_png(folder / "absent.png");
  REQUIRE_FALSE(absent.ok());
  CHECK(absent.problem().text() == (folder / "absent.png").string() + ": there is no such file");
  CHECK(read_png(folder.write("a.png", "GIF89a.........")).problem().what ==
        "this is not a PNG file");
  CHECK_FALSE(read_png(folder.write("empty.png", "")).ok());
}

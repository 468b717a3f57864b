#include "scenes/formats/images/write_image.hpp"

#include <png.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>

#include "runtime/core/regular_file.hpp"
#include "tests/kit/read_exr.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Matchers::Contains;

namespace {

const SourcePlace place{"picture", 0};

ExrImage exr_example(int width, int height) {
  ExrImage image;
  image.width = width;
  image.height = height;
  std::mt19937 random(5);
  std::lognormal_distribution<float> values(0, 2);
  for (const char* name : {"X", "Y", "Z", "R", "G", "B", "standard_error.Y"}) {
    ExrChannel& channel = image.channels.emplace_back();
    channel.name = name;
    for (int i = 0; i < width * height; ++i) channel.values.push_back(values(random));
  }
  image.chromaticities = Chromaticities{};
  image.white_luminance_cd_m2 = 200.0f;
  image.text = {{"comments", "corridor, grün €"}, {"scenario", ""}};
  image.numbers = {{"particles", 1e6}, {"extinction_1_m", 0.1}};
  return image;
}

struct DecodedPng {
  unsigned width = 0, height = 0;
  std::vector<uint8_t> rgb;
};

DecodedPng decode_png(const std::vector<std::byte>& bytes) {
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()) != 0);
  reader.format = PNG_FORMAT_RGB;
  DecodedPng out{reader.width, reader.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(reader))};
  REQUIRE(png_image_finish_read(&reader, nullptr, out.rgb.data(), 0, nullptr) != 0);
  return out;
}

/// Type and data of every chunk, by hand (PNG specification, 5.3).
std::vector<std::pair<std::string, std::string>> chunks(const std::vector<std::byte>& bytes) {
  std::vector<std::pair<std::string, std::string>> out;
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  for (size_t at = 8; at + 12 <= bytes.size();) {
    size_t size = 0;
    for (size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<size_t>(bytes[at + i]);
    out.emplace_back(std::string(text + at + 4, 4), std::string(text + at + 8, size));
    at += size + 12;
  }
  return out;
}

std::string chunk(const std::vector<std::byte>& bytes, const std::string& type) {
  for (const auto& [name, data] : chunks(bytes)) {
    if (name == type) return data;
  }
  return "(none)";
}

}  // namespace

TEST_CASE("float channels come back from EXR bit by bit, with all attributes", "[format][image]") {
  const test::TemporaryFolder folder;
  ExrImage image = exr_example(37, 23);
  image.channels[1].values[5] = std::nanf("");
  image.channels[1].values[6] = 3e38f;
  image.channels[1].values[7] = 1e-42f;
  REQUIRE(write_exr(folder / "a.exr", image).ok());
  const ExrImage back = test::read_exr(folder / "a.exr");
  CHECK(back.width == 37);
  CHECK(back.height == 23);
  CHECK_FALSE(back.half);
  CHECK(back.unit == "cd/m2");
  CHECK(back.white_luminance_cd_m2 == 200.0f);
  REQUIRE(back.chromaticities);
  CHECK(back.chromaticities->white == Chromaticities{}.white);
  CHECK(back.chromaticities->blue == Chromaticities{}.blue);
  CHECK(back.channels.size() == image.channels.size());
  for (const ExrChannel& channel : image.channels) {
    const ExrChannel* read = back.find(channel.name);
    REQUIRE(read != nullptr);
    REQUIRE(read->values.size() == channel.values.size());
    CHECK(std::memcmp(read->values.data(), channel.values.data(),
                      channel.values.size() * sizeof(float)) == 0);
  }
  CHECK(back.text == image.text);
  CHECK(back.numbers == decltype(image.numbers){{"extinction_1_m", 0.1}, {"particles", 1e6}});
  CHECK(back.find("A") == nullptr);
}

TEST_CASE("half channels keep three digits and reject values out of range", "[format][image]") {
  const test::TemporaryFolder folder;
  ExrImage image = exr_example(16, 9);
  image.half = true;
  REQUIRE(write_exr(folder / "a.exr", image).ok());
  const ExrImage back = test::read_exr(folder / "a.exr");
  CHECK(back.half);
  for (const ExrChannel& channel : image.channels) {
    const std::vector<float>& read = back.find(channel.name)->values;
    for (size_t i = 0; i < read.size(); ++i) {
      REQUIRE(std::abs(read[i] - channel.values[i]) <= channel.values[i] / 2048 + 1e-7f);
    }
  }
  image.channels[2].values[3] = 70000;
  const Result<void> over = write_exr(folder / "b.exr", image);
  REQUIRE_FALSE(over.ok());
  CHECK_THAT(over.problem().what, Contains("'Z'") && Contains("65504"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("equal pictures give equal bytes", "[format][image]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_exr(folder / "a.exr", exr_example(20, 20)).ok());
  REQUIRE(write_exr(folder / "b.exr", exr_example(20, 20)).ok());
  CHECK(read_whole_file(folder / "a.exr", 1 << 20).value() ==
        read_whole_file(folder / "b.exr", 1 << 20).value());
}

TEST_CASE("an EXR picture with contradictory parts is rejected", "[format][image]") {
  const test::TemporaryFolder folder;
  const auto refusal = [&](auto change) {
    ExrImage image = exr_example(4, 3);
    change(image);
    const Result<void> done = write_exr(folder / "a.exr", image);
    REQUIRE_FALSE(done.ok());
    CHECK(done.problem().where.file == (folder / "a.exr").string());
    return done.problem().what;
  };
  CHECK_THAT(refusal([](ExrImage& i) { i.width = 0; }), Contains("0 x 3"));
  CHECK_THAT(refusal([](ExrImage& i) { i.width = 1 << 20; }), Contains("not possible"));
  CHECK_THAT(refusal([](ExrImage& i) { i.channels.clear(); }), Contains("1 to 128 channels"));
  CHECK_THAT(refusal([](ExrImage& i) { i.channels[0].values.pop_back(); }),
             Contains("'X' has 11 values for 12 pixels"));
  CHECK_THAT(refusal([](ExrImage& i) { i.channels[0].name = "Y"; }), Contains("twice"));
  CHECK_THAT(refusal([](ExrImage& i) { i.channels[0].name = ""; }), Contains("cannot name"));
  CHECK_THAT(refusal([](ExrImage& i) { i.channels[0].name = std::string(300, 'n'); }),
             Contains("cannot name"));
  CHECK_THAT(refusal([](ExrImage& i) { i.text.emplace_back("dataWindow", "x"); }),
             Contains("'dataWindow'"));
  CHECK_THAT(refusal([](ExrImage& i) { i.numbers.emplace_back("comments", 1); }),
             Contains("twice"));
  CHECK(folder.entries() == 0);
  CHECK_THAT(write_exr(folder / "none" / "a.exr", exr_example(4, 3)).problem().text(),
             Contains("none/a.exr") && Contains("No such file"));
}

TEST_CASE("channels and texts may have unusual names", "[format][image]") {
  const test::TemporaryFolder folder;
  ExrImage image = exr_example(2, 2);
  image.channels.resize(2);
  image.channels[0].name = "flux \"Lämpchen\" <3>";
  image.channels[1].name = std::string(255, 'c');
  image.text = {{"ä", "bad \xff byte"}};
  REQUIRE(write_exr(folder / "a.exr", image).ok());
  const ExrImage back = test::read_exr(folder / "a.exr");
  CHECK(back.find(image.channels[0].name) != nullptr);
  CHECK(back.find(image.channels[1].name) != nullptr);
  CHECK(back.text[0].second == "bad \xEF\xBF\xBD byte");
}

TEST_CASE("PNG pixels come back exactly, marked as sRGB", "[format][image]") {
  PngImage image;
  image.width = 31;
  image.height = 17;
  for (int i = 0; i < 31 * 17 * 3; ++i) image.rgb.push_back(static_cast<uint8_t>(i * 37));
  image.text = {{"Title", "Corridor"}, {"Comment", "grün € 😀"}, {"Source", "bad \xff byte"}};
  const Result<std::vector<std::byte>> bytes = encode_png(image, place);
  REQUIRE(bytes.ok());
  const DecodedPng back = decode_png(bytes.value());
  CHECK(back.width == 31);
  CHECK(back.height == 17);
  CHECK(back.rgb == image.rgb);
  CHECK(chunk(bytes.value(), "sRGB") == std::string(1, '\0'));
  CHECK(chunk(bytes.value(), "tEXt") == std::string("Title\0Corridor", 14));
  CHECK(chunk(bytes.value(), "iTXt") == std::string("Comment\0\0\0\0\0", 12) + "grün € 😀");
  CHECK(chunk(bytes.value(), "tIME") == "(none)");

  const test::TemporaryFolder folder;
  REQUIRE(write_png(folder / "a.png", image).ok());
  CHECK(read_whole_file(folder / "a.png", 1 << 20).value() == bytes.value());
  CHECK_THAT(write_png(folder / "none" / "a.png", image).problem().text(),
             Contains("No such file"));
}

TEST_CASE("a PNG picture with contradictory parts is rejected", "[format][image]") {
  PngImage image{2, 2, std::vector<uint8_t>(12), {}};
  CHECK(encode_png(image, place).ok());
  image.rgb.pop_back();
  CHECK_THAT(encode_png(image, place).problem().what, Contains("11 bytes"));
  image = {0, 2, {}, {}};
  CHECK_THAT(encode_png(image, place).problem().what, Contains("0 x 2"));
  image = {40000, 1, std::vector<uint8_t>(120000), {}};
  CHECK_FALSE(encode_png(image, place).ok());
  for (const std::string& key : {std::string(), std::string(80, 'k'), std::string("ä"),
                                 std::string(" a"), std::string("a\n")}) {
    image = {1, 1, std::vector<uint8_t>(3), {{key, "x"}}};
    CHECK_THAT(encode_png(image, place).problem().what, Contains("cannot be the key"));
  }
}

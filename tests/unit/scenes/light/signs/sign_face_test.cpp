#include "scenes/light/signs/sign_face.hpp"

#include <png.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

fs::path write_png(const test::TemporaryFolder& folder, const std::string& name, int width,
                   int height, const std::vector<uint8_t>& rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  REQUIRE(png_image_write_to_file(&image, (folder / name).c_str(), 0, rgb.data(), 0, nullptr));
  return folder / name;
}

std::string svg(const std::string& body, const std::string& size = "viewBox='0 0 200 100'") {
  return "<svg xmlns='http://www.w3.org/2000/svg' " + size + ">" + body + "</svg>";
}
const std::string left_green =
    "<rect width='200' height='100' fill='#ECECE7'/><rect width='50' height='100' fill='#237F52'/>";

ColourIndex face_at(const SignFace& face, double u, double v) {
  return face.colour.at(texel_index(face, u, v));
}
SignFace face_of(Result<SignFace> face) {
  if (!face) FAIL(face.problem().text());
  return std::move(face).value();
}
std::string problem_of(const Result<SignFace>& face) {
  return face ? "" : face.problem().text();
}

/// Counts texels that are white in one and green in the other at mirrored positions.
size_t mirror_differences(const SignFace& a, const SignFace& b) {
  size_t differences = 0;
  const auto width = static_cast<size_t>(a.width);
  for (size_t i = 0; i < a.colour.size(); ++i) {
    const size_t row = i / width, column = i % width;
    if (a.colour[i] != b.colour.at(row * width + (width - 1 - column))) ++differences;
  }
  return differences;
}

constexpr ColourIndex white = 0, green = 1, other = other_colour;
const std::vector<FaceColour> usual = white_and_green();
ColourIndex ground_of(ColourIndex legend) {
  return legend == white ? green : white;
}

}  // namespace

TEST_CASE("CIE Lab of the sRGB primaries and of white is as published", "[emergency][face]") {
  const auto lab_white = lab_from_srgb(255, 255, 255);
  CHECK(lab_white[0] == Approx(100).margin(0.01));
  CHECK(lab_white[1] == Approx(0).margin(0.02));
  CHECK(lab_white[2] == Approx(0).margin(0.02));
  const auto lab_red = lab_from_srgb(255, 0, 0);  // 53.24, 80.09, 67.20
  CHECK(lab_red[0] == Approx(53.24).margin(0.05));
  CHECK(lab_red[1] == Approx(80.09).margin(0.1));
  CHECK(lab_red[2] == Approx(67.20).margin(0.1));
}

TEST_CASE("sign colours are distinguished from others by colour difference", "[emergency][face]") {
  CHECK(classify_colour({0xec, 0xec, 0xe7, 255}, usual) == white);
  CHECK(classify_colour({255, 255, 255, 255}, usual) == white);
  CHECK(classify_colour({0x23, 0x7f, 0x52, 255}, usual) == green);
  CHECK(classify_colour({0x00, 0x9a, 0x49, 255}, usual) == green);
  CHECK(classify_colour({0x9b, 0x24, 0x23, 255}, usual) == other);  // ISO 3864 red
  CHECK(classify_colour({0, 0, 0, 255}, usual) == other);
  CHECK(classify_colour({128, 128, 128, 255}, usual) == other);
  CHECK(classify_colour({255, 220, 0, 255}, usual) == other);
  CHECK(classify_colour({0xec, 0xec, 0xe7, 100}, usual) == other);  // transparent
}

TEST_CASE("a drawing fills the face, and its colours have the drawn places and sizes",
          "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg", svg(left_green));
  const SignFace face = face_of(face_from_svg(file, 0.4, 0.2, 200, usual));
  CHECK(face.width == 200);
  CHECK(face.height == 100);
  CHECK(colour_share(face, green) == Approx(0.25).margin(1e-12));
  CHECK(colour_share(face, white) == Approx(0.75).margin(1e-12));
  CHECK(face_at(face, 0.1, 0.5) == green);
  CHECK(face_at(face, 0.3, 0.5) == white);
  CHECK(face.relative_luminance.empty());
}

TEST_CASE("the top row of a drawing is the face's first", "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg", svg("<rect width='200' height='100' fill='white'/>"
                                               "<rect width='200' height='30' fill='#237F52'/>"));
  const SignFace face = face_of(face_from_svg(file, 0.4, 0.2, 100, usual));
  CHECK(face_at(face, 0.5, 0.1) == green);
  CHECK(face_at(face, 0.5, 0.9) == white);
}

TEST_CASE("a drawing scales by its size as well as by its viewBox", "[emergency][face]") {
  const test::TemporaryFolder scratch;
  for (const char* size : {"width='200' height='100'", "viewBox='0 0 200 100'",
                           "width='20mm' height='10mm' viewBox='0 0 200 100'",
                           "width='100%' height='100%' viewBox='0 0 200 100'"}) {
    INFO(size);
    const auto file = scratch.write("a.svg", svg(left_green, size));
    const SignFace face = face_of(face_from_svg(file, 0.4, 0.2, 64, usual));
    CHECK(colour_share(face, green) == Approx(0.25).margin(1e-12));
  }
}

TEST_CASE(
    "the area of a round shape is exact to one part in a thousand, without a seam at its edge",
    "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg", svg("<rect width='200' height='100' fill='#237F52'/>"
                                               "<circle cx='100' cy='50' r='40' fill='#ECECE7'/>"));
  const SignFace face = face_of(face_from_svg(file, 0.4, 0.2, 400, usual));
  CHECK(colour_share(face, white) == Approx(std::numbers::pi * 1600 / 20000).epsilon(1e-3));
  CHECK(colour_share(face, other) == 0);
}

TEST_CASE("areas that are neither white nor green, or not painted, are other",
          "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg", svg("<rect width='50' height='100' fill='#237F52'/>"
                                               "<rect x='50' width='50' height='100' fill='#fff'/>"
                                               "<rect x='100' width='50' height='100'/>"));
  const SignFace face = face_of(face_from_svg(file, 0.4, 0.2, 80, usual));
  CHECK(face_at(face, 0.6, 0.5) == other);
  CHECK(face_at(face, 0.9, 0.5) == other);
  CHECK(colour_share(face, other) == 0.5);
}

TEST_CASE("a drawing unfit for a sign is refused with its file and the reason",
          "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto refusal = [&](const std::string& bytes) {
    const auto file = scratch.write("bad.svg", bytes);
    const std::string text = problem_of(face_from_svg(file, 0.4, 0.2, 100, usual));
    CHECK(text.rfind(file.string() + ": ", 0) == 0);
    return text;
  };
  CHECK(refusal("").find("empty") != std::string::npos);
  CHECK(refusal("hello").find("not an SVG") != std::string::npos);
  CHECK(refusal(svg(left_green).substr(0, 90)).find("not an SVG") != std::string::npos);
  CHECK(refusal("\x1f\x8b\x08 compressed").find("unpack") != std::string::npos);
  CHECK(refusal(svg("<rect width='200' height='100' fill='red'/>")).find("white") !=
        std::string::npos);
  CHECK(refusal(svg("<rect width='200' height='100' fill='white'/>")).find("green") !=
        std::string::npos);
  CHECK(refusal(svg(left_green, "viewBox='0 0 100 100'")).find("aspect") != std::string::npos);
  CHECK(refusal(svg(left_green, "viewBox='0 0 0 100'")).find("bad.svg") != std::string::npos);
  CHECK(
      refusal(std::string(static_cast<size_t>(limits::max_drawing_bytes) + 1, ' ')).find("4 MiB") !=
      std::string::npos);
  CHECK(
      problem_of(face_from_svg(scratch / "none.svg", 0.4, 0.2, 100, usual)).find("no such file") !=
      std::string::npos);
  CHECK(problem_of(face_from_svg(scratch.path(), 0.4, 0.2, 100, usual)).find("Is a directory") !=
        std::string::npos);
}

TEST_CASE("a drawing loads no other file", "[emergency][face]") {
  const test::TemporaryFolder scratch;
  write_png(scratch, "white.png", 1, 1, {255, 255, 255});
  const auto file = scratch.write("a.svg", svg("<rect width='200' height='100' fill='#237F52'/>"
                                               "<image href='white.png' width='100' height='100' "
                                               "preserveAspectRatio='none'/>"));
  CHECK(problem_of(face_from_svg(file, 0.4, 0.2, 100, usual)).find("white") != std::string::npos);
}

TEST_CASE("sizes outside the limits are refused before anything is read", "[emergency][face]") {
  const auto refusal = [](double width_m, double height_m, int texels) {
    return problem_of(uniform_face(green, width_m, height_m, texels));
  };
  CHECK(refusal(0, 0.2, 100).find("edge") != std::string::npos);
  CHECK(refusal(0.4, -1, 100).find("edge") != std::string::npos);
  CHECK(refusal(NAN, 0.2, 100).find("edge") != std::string::npos);
  CHECK(refusal(0.4, 21, 100).find("edge") != std::string::npos);
  CHECK(refusal(0.4, 0.2, 7).find("texels") != std::string::npos);
  CHECK(refusal(0.4, 0.2, 100000).find("texels") != std::string::npos);
  CHECK(refusal(0.02, 19, 2048).find("fewer texels") != std::string::npos);
}

TEST_CASE("a picture becomes the same face as the drawing of the same sign", "[emergency][face]") {
  const test::TemporaryFolder scratch;
  std::vector<uint8_t> rgb;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x)
      for (uint8_t c : x < 50 ? std::array<uint8_t, 3>{0x23, 0x7f, 0x52}
                              : std::array<uint8_t, 3>{0xec, 0xec, 0xe7})
        rgb.push_back(c);
  const auto png = write_png(scratch, "a.png", 200, 100, rgb);
  const auto drawing = scratch.write("a.svg", svg(left_green));
  for (int texels : {40, 200, 400})
    CHECK(face_of(face_from_png(png, 0.4, 0.2, texels, usual)).colour ==
          face_of(face_from_svg(drawing, 0.4, 0.2, texels, usual)).colour);
}

TEST_CASE("a picture that is missing, damaged or unfit for a sign is refused with its file",
          "[emergency][face]") {
  const test::TemporaryFolder scratch;
  CHECK(
      problem_of(face_from_png(scratch / "none.png", 0.4, 0.2, 100, usual)).find("no such file") !=
      std::string::npos);
  const auto text = scratch.write("text.png", "not a picture");
  CHECK(problem_of(face_from_png(text, 0.4, 0.2, 100, usual)).find("not a PNG") !=
        std::string::npos);
  std::vector<uint8_t> noise(3 * 64 * 32);
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<uint8_t>(i * 2654435761u >> 7);
  const auto whole = write_png(scratch, "whole.png", 64, 32, noise);
  std::ifstream in(whole, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const auto cut = scratch.write("cut.png", bytes.substr(0, bytes.size() / 2));
  CHECK(problem_of(face_from_png(cut, 0.4, 0.2, 100, usual)).find("damaged") != std::string::npos);
  const auto square = write_png(scratch, "square.png", 2, 2, std::vector<uint8_t>(12, 255));
  CHECK(problem_of(face_from_png(square, 0.4, 0.2, 100, usual)).find("aspect") !=
        std::string::npos);
  CHECK(problem_of(face_from_png(square, 0.2, 0.2, 100, usual)).find("green") != std::string::npos);
}

TEST_CASE("an I is a bar of one stroke by the letter height, in the middle of the face",
          "[emergency][face]") {
  for (ColourIndex legend : {white, green}) {
    const SignFace face =
        face_of(face_from_text("I", 0.3, 0.2, 0.15, 0.02, 0.01, legend, ground_of(legend), 300));
    CHECK(face.legend == legend);
    CHECK(colour_share(face, legend) == Approx(0.15 * 0.02 / 0.06).epsilon(0.01));
    CHECK(face_at(face, 0.5, 0.5) == legend);
    CHECK(face_at(face, 0.5 + 0.009 / 0.3, 0.5) == legend);
    CHECK(face_at(face, 0.5 + 0.011 / 0.3, 0.5) != legend);
    CHECK(face_at(face, 0.5, 0.5 + 0.074 / 0.2) == legend);
    CHECK(face_at(face, 0.5, 0.5 + 0.076 / 0.2) != legend);
    CHECK(colour_share(face, other) == 0);
  }
}

TEST_CASE("straight letters cover the area of their strokes", "[emergency][face]") {
  // Closed forms with height h, width w and stroke s: E is a stem and three bars, the middle one
  // extending s/2 beyond 0.85 of the inset width; L is a stem and a bar; T likewise; H is a bar
  // between two stems.
  const double h = 0.15, s = 0.02, wide = 0.4, high = 0.2;
  const auto area = [&](const char* letter) {
    return colour_share(
               face_of(face_from_text(letter, wide, high, h, s, 0, white, ground_of(white), 800)),
               white) *
           wide * high;
  };
  const double e = 0.48 * h, l = 0.46 * h, t = 0.52 * h;
  CHECK(area("E") == Approx(s * h + 2 * s * (e - s) + s * (0.85 * (e - s))).epsilon(0.01));
  CHECK(area("L") == Approx(s * h + s * (l - s)).epsilon(0.01));
  CHECK(area("T") == Approx(s * t + s * (h - s)).epsilon(0.01));
  CHECK(area("H") == Approx(2 * s * h + s * (t - 2 * s)).epsilon(0.01));
}

TEST_CASE("different letters are drawn differently, and dots and bows are drawn",
          "[emergency][face]") {
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+/.:!'<>";
  std::vector<std::vector<ColourIndex>> faces;
  for (char c : all) {
    INFO(c);
    const SignFace face = face_of(face_from_text(std::string(1, c), 0.2, 0.2, 0.15, 0.02, 0.01,
                                                 white, ground_of(white), 200));
    CHECK(colour_share(face, white) * 0.04 >= 0.95 * 0.02 * 0.02);
    for (const auto& earlier : faces) CHECK(earlier != face.colour);
    faces.push_back(face.colour);
  }
}

TEST_CASE("a symmetric word is drawn symmetrically", "[emergency][face]") {
  const SignFace face =
      face_of(face_from_text("OHIHO", 0.6, 0.2, 0.15, 0.02, 0.01, white, ground_of(white), 600));
  // Pixels whose centre lies on an edge may fall either way.
  CHECK(static_cast<double>(mirror_differences(face, face)) <
        0.005 * static_cast<double>(face.colour.size()));
}

TEST_CASE("a legend too large for the face is refused with both sizes", "[emergency][face]") {
  const auto refusal = [](double width_m, double height_m, int texels, ColourIndex legend) {
    return problem_of(face_from_text("EXIT", width_m, height_m, 0.15, 0.02, 0.01, legend,
                                     ground_of(legend), texels));
  };
  CHECK(refusal(0.2, 0.2, 200, white).find("wide, the face 200 mm") != std::string::npos);
  CHECK(refusal(0.6, 0.1, 200, white).find("high, the face 100 mm") != std::string::npos);
  CHECK(refusal(0.6, 0.2, 20, white).find("two texels") != std::string::npos);
  CHECK(refusal(0.6, 0.2, 200, other).find("another one for its ground") != std::string::npos);
  CHECK(refusal(0.6, 0.2, 200, green).empty());
}

TEST_CASE("a uniform face is of one colour throughout", "[emergency][face]") {
  const SignFace face = face_of(uniform_face(green, 1.0, 0.25, 40));
  CHECK(face.width == 40);
  CHECK(face.height == 10);
  CHECK(colour_share(face, green) == 1);
}

TEST_CASE("a luminance map keeps its pattern and has a mean of 1 within each colour",
          "[emergency][face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg", svg(left_green));
  const SignFace plain = face_of(face_from_svg(file, 0.4, 0.2, 40, usual));
  Image map{8, 4, 1, {}};
  for (int i = 0; i < 32; ++i) map.texels.push_back(0.1f + 0.02f * static_cast<float>(i % 8));
  const SignFace face = face_of(with_luminance_map(plain, usual, map));
  for (ColourIndex colour : {white, green}) {
    double sum = 0, count = 0;
    for (size_t i = 0; i < face.colour.size(); ++i)
      if (face.colour[i] == colour) {
        sum += face.relative_luminance[i];
        ++count;
      }
    CHECK(sum / count == Approx(1).epsilon(1e-5));
  }
  // Within white the ratio of two texels is that of the map: columns 7 and 2.
  CHECK(face.relative_luminance[texel_index(face, 0.95, 0.5)] /
            face.relative_luminance[texel_index(face, 0.3, 0.5)] ==
        Approx(0.24 / 0.14).epsilon(1e-5));
}

TEST_CASE("a map finer than the face is averaged over each texel", "[emergency][face]") {
  const SignFace plain = face_of(uniform_face(white, 0.2, 0.2, 8));
  Image map{16, 16, 3, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) map.texels.push_back((x + y) % 2 == 0 ? 1.0f : 0.0f);
  const SignFace face = face_of(with_luminance_map(plain, usual, map));
  for (float value : face.relative_luminance) CHECK(value == Approx(1).epsilon(1e-6));
}

TEST_CASE("a luminance map that is broken or dark is refused", "[emergency][face]") {
  const SignFace plain = face_of(uniform_face(green, 0.2, 0.2, 8));
  CHECK(problem_of(with_luminance_map(plain, usual, {2, 2, 1, {1, 1, 1}})).find("incomplete") !=
        std::string::npos);
  CHECK(problem_of(with_luminance_map(plain, usual, {})).find("empty") != std::string::npos);
  CHECK(problem_of(with_luminance_map(plain, usual, {1, 1, 1, {-1}})).find("negative") !=
        std::string::npos);
  CHECK(problem_of(with_luminance_map(plain, usual, {1, 1, 1, {NAN}})).find("number") !=
        std::string::npos);
  CHECK(problem_of(with_luminance_map(plain, usual, {1, 1, 1, {0}})).find("black") !=
        std::string::npos);
}

TEST_CASE("the shipped signs are entirely green and white, and left mirrors right",
          "[emergency][face]") {
  const fs::path folder = fs::path(LUX_SOURCE_DIR) / "scenes/library/signs";
  const SignFace left = face_of(face_from_svg(folder / "exit_left.svg", 0.4, 0.2, 400, usual));
  const SignFace right = face_of(face_from_svg(folder / "exit_right.svg", 0.4, 0.2, 400, usual));
  const SignFace straight =
      face_of(face_from_svg(folder / "exit_straight.svg", 0.4, 0.2, 400, usual));
  for (const SignFace* face : {&left, &right, &straight}) {
    CHECK(colour_share(*face, other) == 0);
    CHECK(colour_share(*face, green) >= 0.5);  // ISO 3864-1: at least half the area
    CHECK(colour_share(*face, white) > 0.2);
    CHECK(face->legend == white);
  }
  // A texel halved by an edge may get either colour: fewer than one in a thousand.
  CHECK(mirror_differences(left, right) < 80);
  CHECK(face_at(right, 0.87, 0.5) == white);    // the arrow's head
  CHECK(face_at(right, 0.33, 0.225) == green);  // the runner's head, within the white door
  CHECK(face_at(straight, 0.715, 0.16) == white);
  CHECK(right.colour != straight.colour);
}

TEST_CASE("drawings of ISO 7010 signs from other sources become green and white faces",
          "[emergency][face]") {
  const fs::path folder = fs::path(LUX_SHARED_DATA) / "iso7010";
  if (!fs::exists(folder)) {
    WARN("skipped: no ISO 7010 drawings beside the source tree");
    return;
  }
  for (const char* name : {"E001.svg", "E002.svg", "E003.svg", "E007.svg"}) {
    INFO(name);
    const SignFace face = face_of(face_from_svg(folder / name, 0.2, 0.2, 256, usual));
    CHECK(colour_share(face, other) < 0.001);
    CHECK(colour_share(face, green) > 0.4);
    CHECK(colour_share(face, white) > 0.1);
  }
  CHECK(problem_of(face_from_svg(folder / "F001.svg", 0.2, 0.2, 256, usual)).find("green") !=
        std::string::npos);
}

TEST_CASE("a drawing with filters or too many elements is refused before it is drawn",
          "[emergency][sign_face][hostile]") {
  const test::TemporaryFolder scratch;
  const auto refusal = [&](const std::string& body) {
    return problem_of(face_from_svg(scratch.write("bad.svg", svg(body)), 0.4, 0.2, 100, usual));
  };
  const std::string noise =
      "<filter id='n'><feTurbulence baseFrequency='0.9' numOctaves='1'/></filter>";
  CHECK(refusal(noise + "<rect width='200' height='100' filter='url(#n)'/>").find("filters") !=
        std::string::npos);
  CHECK(refusal("<s:filter xmlns:s='http://www.w3.org/2000/svg' id='n'/>").find("filters") !=
        std::string::npos);
  std::string elements;
  for (int i = 0; i < 65'000; ++i) elements += "<g/>";
  CHECK(refusal(elements).find("elements; simplify") != std::string::npos);
}

TEST_CASE("a drawing may mention filters that it does not use", "[emergency][sign_face]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write(
      "a.svg", svg(left_green + std::string("<!-- no filter --><g style='filter:none'/>")));
  CHECK(face_from_svg(file, 0.4, 0.2, 64, usual).ok());
}

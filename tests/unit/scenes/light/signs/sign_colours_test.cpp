#include "scenes/light/signs/sign_colours.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "scenes/light/signs/sign_face.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

FaceColour safety(const std::string& name) {
  return {.name = name, .drawn = drawn_as(name).value()};
}

/// A face of 100 texels in a row: `counts` of each colour, the rest of none.
SignFace striped(const std::vector<int>& counts) {
  SignFace face;
  face.width = 100;
  face.height = 1;
  face.colour.assign(100, other_colour);
  size_t at = 0;
  for (size_t c = 0; c < counts.size(); ++c)
    for (int i = 0; i < counts[c]; ++i) face.colour[at++] = static_cast<ColourIndex>(c);
  return face;
}

std::string refusal(SignFace face, const std::vector<FaceColour>& colours,
                    std::optional<ColourIndex> legend = {},
                    std::optional<ColourIndex> ground = {}) {
  const auto ok = choose_legend(face, colours, legend, ground);
  return ok ? "" : ok.problem().what;
}

}  // namespace

TEST_CASE("each safety colour is named by its own drawn colour and by others like it",
          "[signs][colours]") {
  for (const SafetyColour& colour : safety_colours) {
    CHECK(safety_name_of(colour.drawn) == colour.name);
    CHECK(drawn_as(colour.name) == colour.drawn);
  }
  CHECK(safety_name_of({255, 0, 0}) == "red");
  CHECK(safety_name_of({0, 154, 73}) == "green");
  CHECK(safety_name_of({255, 255, 255}) == "white");
  CHECK_FALSE(drawn_as("pink"));
}

TEST_CASE("the luminance factors of safety colours are those that ISO 3864-4 asks of paints",
          "[signs][colours]") {
  const auto factor = [](const char* name) {
    return paint_of(*drawn_as(name)).integral_with(cie_y()) / cie_y().integral();
  };
  CHECK(factor("white") >= 0.75);
  CHECK(factor("yellow") >= 0.45);
  CHECK(factor("green") >= 0.12);
  CHECK(factor("red") >= 0.07);
  CHECK(factor("blue") >= 0.05);
  CHECK(factor("black") <= 0.03);
}

TEST_CASE("a colour is written as six hexadecimal digits and read again", "[signs][colours]") {
  CHECK(hex_text({0x9B, 0x24, 0x03}) == "#9B2403");
  CHECK(from_hex_text("#9b2403") == Srgb{0x9B, 0x24, 0x03});
  for (const char* wrong : {"", "9B2403", "#9B240", "#9B24033", "#9B24G3", "#-12403", "red"})
    CHECK_FALSE(from_hex_text(wrong));
}

TEST_CASE("a pixel has the nearest colour of the sign, and mixtures of two belong to one of them",
          "[signs][colours]") {
  const std::vector<FaceColour> colours{safety("red"), safety("white"), safety("blue")};
  CHECK(classify_colour({0xC0, 0x20, 0x20, 255}, colours) == 0);
  CHECK(classify_colour({255, 255, 255, 255}, colours) == 1);
  CHECK(classify_colour({0x00, 0x53, 0x87, 255}, colours) == 2);
  CHECK(classify_colour({0x23, 0x7F, 0x52, 255}, colours) == other_colour);
  // Smoothed edges: sRGB mixtures, on either side of the middle.
  CHECK(classify_colour({0xBB, 0x74, 0x70, 255}, colours) == 0);
  CHECK(classify_colour({0xCC, 0x98, 0x94, 255}, colours) == 1);
  CHECK(classify_colour({0xC3, 0x88, 0x85, 100}, colours) == other_colour);  // transparent
}

TEST_CASE("an edge between red and white that a picture smooths has no seam", "[signs][colours]") {
  const test::TemporaryFolder scratch;
  const auto file = scratch.write("a.svg",
                                  "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 200 100'>"
                                  "<rect width='200' height='100' fill='#ECECE7'/>"
                                  "<circle cx='100' cy='50' r='40' fill='#9B2423'/></svg>");
  const auto face = face_from_svg(file, 0.4, 0.2, 100, {safety("red"), safety("white")});
  REQUIRE(face.ok());
  CHECK(colour_share(face.value(), other_colour) == 0);
  CHECK(colour_share(face.value(), 0) == Approx(3.14159 * 1600 / 20000).epsilon(0.01));
}

TEST_CASE("the two colours that cover most are legend and ground, the smaller one the legend",
          "[signs][colours]") {
  const std::vector<FaceColour> colours{safety("yellow"), safety("red"), safety("white")};
  SignFace face = striped({5, 25, 60});
  REQUIRE(choose_legend(face, colours, {}, {}).ok());
  CHECK(face.legend == 1);
  CHECK(face.ground == 2);
  CHECK(face.parts() == std::array<ColourIndex, 2>{1, 2});
  CHECK(face.legend_part() == 0);
  face = striped({5, 60, 25});
  REQUIRE(choose_legend(face, colours, {}, {}).ok());
  CHECK(face.legend == 2);
  CHECK(face.legend_part() == 1);
}

TEST_CASE("white is the legend of a face of white and green, whatever it covers",
          "[signs][colours]") {
  for (const auto& [white, green] : {std::pair{30, 70}, std::pair{70, 30}, std::pair{50, 50}}) {
    SignFace face = striped({white, green});
    REQUIRE(choose_legend(face, white_and_green(), {}, {}).ok());
    CHECK(face.legend == 0);
    CHECK(face.ground == 1);
  }
}

TEST_CASE("a legend that is named keeps its place, and the ground is what covers most besides",
          "[signs][colours]") {
  const std::vector<FaceColour> colours{safety("yellow"), safety("red"), safety("white")};
  SignFace face = striped({5, 25, 60});
  REQUIRE(choose_legend(face, colours, ColourIndex{0}, {}).ok());
  CHECK(face.legend == 0);
  CHECK(face.ground == 2);
  REQUIRE(choose_legend(face, colours, {}, ColourIndex{1}).ok());
  CHECK(face.legend == 2);
  CHECK(face.ground == 1);
}

TEST_CASE("an ambiguous legend is refused with what to write", "[signs][colours]") {
  const std::vector<FaceColour> colours{safety("yellow"), safety("red"), safety("white")};
  CHECK(refusal(striped({0, 50, 49}), colours).find("one of: yellow, red, white") !=
        std::string::npos);
  CHECK(refusal(striped({20, 21, 58}), colours).find("cover about as much") != std::string::npos);
  CHECK(refusal(striped({0, 0, 90}), colours).find("'plain'") != std::string::npos);
  CHECK(refusal(striped({5, 25, 60}), colours, ColourIndex{1}, ColourIndex{1}).find("both red") !=
        std::string::npos);
}

TEST_CASE("a film before a lamp gives the drawn colour beside the lamp's white",
          "[signs][colours]") {
  const Spectrum lamp = white_led_shape(4000);
  const Spectrum red = film_before(lamp, *drawn_as("red"));
  CHECK(red.integral() == Approx(1));
  CHECK(red.at(640) > 5 * red.at(520));
}

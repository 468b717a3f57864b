#include "scenes/light/signs/letters.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace luxodus;

namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr LetterSize nfpa_letters;  // 6 in high, 3/4 in strokes, 3/8 in apart

std::string refusal(std::string_view text, const LetterSize& size = nfpa_letters) {
  const auto lettering = lay_out_text(text, size);
  return lettering ? "" : lettering.problem().what;
}

}  // namespace

TEST_CASE("every letter and digit except I and 1 is at least a third of its height wide",
          "[emergency][letters]") {
  for (char c : alphabet) {
    const auto lettering = lay_out_text(std::string(1, c), nfpa_letters);
    REQUIRE(lettering.ok());
    const LetterShape& letter = lettering->letters.at(0);
    INFO(c);
    CHECK(letter.high.y - letter.low.y == Approx(nfpa_letters.height_m));
    if (c == 'I')
      CHECK(letter.high.x - letter.low.x == Approx(nfpa_letters.stroke_m));
    else  // NFPA 101 7.10.6.1: 2 in of 6 in
      CHECK(letter.high.x - letter.low.x >= 0.0508);
  }
}

TEST_CASE("centre lines stay half a stroke inside the letter's box, or run out of it to be clipped",
          "[emergency][letters]") {
  for (char c : alphabet) {
    const auto lettering = lay_out_text(std::string(1, c), nfpa_letters);
    REQUIRE(lettering.ok());
    const LetterShape& letter = lettering->letters.at(0);
    INFO(c);
    glm::dvec2 low(1e9), high(-1e9);
    for (const auto& stroke : letter.strokes) {
      REQUIRE(stroke.size() >= 2);
      for (size_t i = 1; i < stroke.size(); ++i) CHECK(stroke[i] != stroke[i - 1]);
      for (const auto& point : stroke) {
        low = glm::min(low, point);
        high = glm::max(high, point);
      }
    }
    // Each letter touches all four sides of the inset box: the drawn letter fills its own box.
    const double half = nfpa_letters.stroke_m / 2 + 1e-9;
    CHECK(low.y <= letter.low.y + half);
    CHECK(high.y >= letter.high.y - half);
    CHECK(low.x <= letter.low.x + half + 0.05 * nfpa_letters.height_m);
    CHECK(high.x >= letter.high.x - half - 0.05 * nfpa_letters.height_m);
  }
}

TEST_CASE("letters are separated by the spacing, and the legend is as wide as its letters",
          "[emergency][letters]") {
  const auto lettering = lay_out_text("EXIT", nfpa_letters);
  REQUIRE(lettering.ok());
  REQUIRE(lettering->letters.size() == 4);
  for (size_t i = 1; i < 4; ++i)
    CHECK(lettering->letters[i].low.x - lettering->letters[i - 1].high.x ==
          Approx(nfpa_letters.spacing_m));
  CHECK(lettering->letters.front().low.x == 0);
  CHECK(lettering->width_m == Approx(lettering->letters.back().high.x));
  CHECK(lettering->smallest_detail_m == nfpa_letters.stroke_m);
  CHECK(lettering->narrowest_letter_m == Approx(0.48 * nfpa_letters.height_m));
}

TEST_CASE("a space separates words and is not a letter", "[emergency][letters]") {
  const auto joined = lay_out_text("NOEXIT", nfpa_letters);
  const auto parted = lay_out_text("NO EXIT", nfpa_letters);
  REQUIRE(joined.ok());
  REQUIRE(parted.ok());
  CHECK(parted->letters.size() == 6);
  CHECK(parted->width_m > joined->width_m + 0.3 * nfpa_letters.height_m);
}

TEST_CASE("every mark that the message names is drawn", "[emergency][letters]") {
  CHECK(refusal("-+/.:!'<>").empty());
}

TEST_CASE("text that cannot be drawn is refused by name", "[emergency][letters]") {
  CHECK(refusal("EXiT").find("'i'") != std::string::npos);
  CHECK(refusal("SALIDA \xc3\x91").find("byte 195") != std::string::npos);
  CHECK(refusal("").find("empty") != std::string::npos);
  CHECK(refusal("   ").find("blank") != std::string::npos);
  CHECK(refusal(std::string(65, 'A')).find("at most 64") != std::string::npos);
  CHECK(refusal("EXIT", {0.15, 0.04, 0.01}).find("stroke") != std::string::npos);
  CHECK(refusal("EXIT", {0, 0.02, 0.01}).find("positive") != std::string::npos);
  CHECK(refusal("EXIT", {0.15, -1, 0.01}).find("positive") != std::string::npos);
  CHECK(refusal("EXIT", {0.15, 0.02, NAN}).find("positive") != std::string::npos);
}

TEST_CASE("a stroke of exactly a fifth of the height is allowed", "[emergency][letters]") {
  CHECK(refusal("E8B", {0.1524, 0.1524 / 5, 0.01}).empty());
}

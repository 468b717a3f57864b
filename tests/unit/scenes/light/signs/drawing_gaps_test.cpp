// What drawings name and a rasteriser leaves out.
#include "scenes/light/signs/drawing_gaps.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace luxodus;

namespace {

std::vector<std::string> gaps(const std::string& body) {
  return drawing_gaps("<svg xmlns='http://www.w3.org/2000/svg'>" + body + "</svg>");
}

}  // namespace

TEST_CASE("a drawing that names nothing outside has no gaps", "[signs][legend]") {
  CHECK(gaps("").empty());
  CHECK(
      gaps("<use xlink:href='#door'/><rect fill='url(#paint)' clip-path=\"url('#c')\"/>").empty());
  CHECK(gaps("<a xlink:href='https://example.org'><path d='M 0 0'/></a>").empty());
  CHECK(gaps("<image href='data:image/png;base64,AAAA'/>").empty());
  CHECK(gaps("<!-- <image href='a.png'/> <text> --><title>text</title>").empty());
  CHECK(gaps("<![CDATA[<image href='a.png'/>]]>").empty());
}

TEST_CASE("images, uses and styles of other files are named", "[signs][legend]") {
  const auto named = [](const std::string& body, const std::string& what) {
    const auto found = gaps(body);
    REQUIRE(found.size() == 1);
    INFO(found.front());
    CHECK(found.front().find(what) != std::string::npos);
  };
  named("<image xlink:href=\"logo.png\" width='1'/>", "its image \"logo.png\" is left out");
  named("<svg:image\n  href = ' file:///logo.png '/>", "\"file:///logo.png\"");
  named("<use href='other.svg#arrow'/>", "its use \"other.svg#arrow\"");
  named("<rect fill='url(paints.svg#a)'/>", "its url \"paints.svg#a\"");
  named("<style>.a { fill: url(\"paints.svg#a\") }</style>", "its url \"paints.svg#a\"");
  named("<style>@import 'b.css';</style>", "its style sheet is left out");
  named("<image href='data:image/webp;base64,AAAA'/>", "format \"image/webp\"");
  named("<text x='1'>EXIT</text>", "its text is drawn in a font of this machine");
  CHECK(drawing_gaps("<?xml-stylesheet href='a.css'?><svg/>").size() == 1);
}

TEST_CASE("a drawing with many gaps names some and counts the others", "[signs][legend]") {
  std::string body;
  for (int i = 0; i < 40; ++i) body += "<image href='a" + std::to_string(i) + ".png'/>";
  const auto found = gaps(body + body);
  REQUIRE(found.size() == limits::max_drawing_gaps + 1);
  CHECK(found.back() == "it names 35 more that are left out");
}

TEST_CASE("drawings that break off give no gap that they do not name", "[signs][legend]") {
  const std::string whole = "<svg><image href='logo.png'/><style>a{fill:url(b#c)}</style></svg>";
  for (size_t length = 0; length <= whole.size(); ++length)
    CHECK(drawing_gaps(whole.substr(0, length)).size() <= 2);
  for (const char* broken : {"<", "<!--", "<image href", "<image href=", "<image href='",
                             "<image =", "<style", "<style>url(", "<?xml-stylesheet", "< href='a'"})
    CHECK(drawing_gaps(broken).size() <= 1);
}

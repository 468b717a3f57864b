// Pictures in a report: from the eye, and on its cover.
#include <catch2/catch.hpp>
#include <fstream>

#include "actors/judge/report/report.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;
namespace fs = std::filesystem;

namespace {

/// One round of paths, so that it takes a second.
const AssessmentRecord& room_record() {
  static const AssessmentRecord record = [] {
    AssessOptions options;
    options.rounds = 1;
    return recorded(room, options);
  }();
  return record;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a report includes only pictures of its own scene and scenario", "[report]") {
  const AssessmentRecord& a = room_record();
  const auto picture = [&](const std::string& scenario) {
    const PngImage image{
        1,
        1,
        {1, 2, 3},
        {{"Scene", a.scene.name}, {"Scenario", scenario}, {"View", "Blick zum Ausgang, Süd"}}};
    const auto bytes = encode_png(image, {});
    REQUIRE(bytes.ok());
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  };
  const TemporaryFolder folder;
  fs::create_directories(folder / "run/views");
  folder.write("run/views/south.png", picture("failed"));
  folder.write("run/views/south_human.png", picture("failed"));
  folder.write("run/views/south_luminance.png", picture("failed"));
  const std::string page = report_html(a, {pictures_in(folder / ""), {}}, {});
  const Texts en(Language::en);
  const auto images = [](const std::string& text) {
    size_t count = 0;
    for (size_t at = 0; (at = text.find("src=\"data:image/png", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  CHECK(images(page) == 2);
  CHECK(page.find("Blick zum Ausgang, Süd: " + std::string(en("view.human"))) <
        page.find("Blick zum Ausgang, Süd: " + std::string(en("view.luminance"))));
  CHECK_FALSE(has(page, en("view.plain")));
  folder.write("run/views/south_human.png", picture("mains"));
  const std::string mixed = report_html(a, {pictures_in(folder / ""), {}}, {});
  CHECK(images(mixed) == 1);
  CHECK(has(mixed, en.say("sights.other_pictures", 1)));
}

TEST_CASE("texts in pictures are read, and damaged pictures give none", "[report]") {
  const PngImage image{1, 1, {1, 2, 3}, {{"Scenario", "Rauch, größer"}, {"View", "plain"}}};
  const auto bytes = encode_png(image, {});
  REQUIRE(bytes.ok());
  const std::string png(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  CHECK(png_text(png, "Scenario") == "Rauch, größer");
  CHECK(png_text(png, "View") == "plain");
  CHECK_FALSE(png_text(png, "Scene"));
  CHECK_FALSE(png_text("no PNG", "View"));
  for (size_t cut = 0; cut < png.size(); ++cut) png_text(png.substr(0, cut), "View");
  std::string forged = png;
  forged[8] = '\x7f';  // length of its first chunk
  CHECK_FALSE(png_text(forged, "View"));
}

TEST_CASE("the picture of the camera \"cover\" is on the first page, and the drawing after it",
          "[report]") {
  const AssessmentRecord& a = room_record();
  const PngImage image{1, 1, {1, 2, 3}, {{"Scene", a.scene.name}, {"View", cover_camera}}};
  const auto bytes = encode_png(image, {});
  REQUIRE(bytes.ok());
  const TemporaryFolder folder;
  fs::create_directories(folder / "views");
  folder.write("views/cover.png",
               std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  const Texts en(Language::en);
  const std::string plain = report_html(a, {}, {});
  CHECK_FALSE(has(plain, en("cover.rendering")));
  CHECK(plain.find("<svg class=\"overview\"") < plain.find("<nav>"));
  const std::string page = report_html(a, {pictures_in(folder / ""), {}}, {});
  const size_t contents = page.find("<nav>");
  CHECK(page.find("src=\"data:image/png") < contents);
  CHECK(page.find(en("cover.rendering")) < contents);
  const size_t drawing = page.find("<svg class=\"overview\"");
  CHECK(drawing != std::string::npos);
  CHECK(drawing > contents);
  CHECK(has(page, en("sights.no_pictures")));  // it is no picture from the eye
}

TEST_CASE("a report without pictures says so, and asks its reader to type nothing", "[report]") {
  const std::string page = report_html(room_record(), {}, {});
  CHECK(has(page, Texts(Language::en)("sights.no_pictures")));
  CHECK_FALSE(has(page, "luxodus run"));
  CHECK_FALSE(has(page, "[[camera]]"));
}

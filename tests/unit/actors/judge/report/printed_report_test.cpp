// Reads printed reports back: of the office floor, of a building of two storeys and of a stair, in
// three languages. Every page has its number, no page is empty, heads of tables are whole words, no
// number covers another, and no pixel of a route's line lies behind a number.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "actors/judge/assess/record_assessment.hpp"
#include "actors/judge/report/report.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {

using namespace test;
namespace fs = std::filesystem;

namespace {

/// Pages of the office floor's report, at most.
constexpr size_t office_pages = 25;

bool runs_quietly(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

bool can_print() {
  const bool all = runs_quietly("chromium --version") && runs_quietly("pdftotext -v") &&
                   runs_quietly("pdftoppm -v");
  if (!all) WARN("skipped: Chromium or poppler-utils are not installed");
  return all;
}

std::string text_of(const fs::path& path) {
  const auto bytes = read_whole_file(path, uint64_t{256} << 20);
  INFO(path);
  REQUIRE(bytes.ok());
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

struct Word {
  double left, top, right, bottom;  // [pt]
  std::string text;
};
/// A page as it is seen: red, green and blue of each pixel.
struct Pixels {
  size_t width = 0, height = 0;
  std::string rgb;
};
struct PrintedPage {
  double width = 0, height = 0;  // [pt]
  std::vector<Word> words;
  Pixels pixels;
  std::string text() const {
    std::string out;
    for (const Word& word : words) out += (out.empty() ? "" : " ") + word.text;
    return out;
  }
};

/// The words of each page with their boxes, as pdftotext finds them.
std::vector<PrintedPage> pages_of(const std::string& boxes) {
  const std::regex tag(
      "<page width=\"([0-9.]+)\" height=\"([0-9.]+)\">|<word xMin=\"([-0-9.]+)\" "
      "yMin=\"([-0-9.]+)\" xMax=\"([-0-9.]+)\" yMax=\"([-0-9.]+)\">([^<]*)<");
  std::vector<PrintedPage> out;
  for (std::sregex_iterator at(boxes.begin(), boxes.end(), tag), end; at != end; ++at) {
    const std::smatch& m = *at;
    if (m[1].matched)
      out.push_back({std::stod(m[1]), std::stod(m[2]), {}, {}});
    else
      out.back().words.push_back(
          {std::stod(m[3]), std::stod(m[4]), std::stod(m[5]), std::stod(m[6]), m[7]});
  }
  return out;
}

/// A picture in binary PPM with 255 as its largest value, as pdftoppm writes it.
Pixels pixels_of(const std::string& ppm) {
  std::istringstream head(ppm.substr(0, 64));
  std::string kind;
  size_t width = 0, height = 0, most = 0;
  head >> kind >> width >> height >> most;
  REQUIRE(kind == "P6");
  REQUIRE(most == 255);
  const size_t bytes = 3 * width * height;
  REQUIRE(ppm.size() > bytes);
  return {width, height, ppm.substr(ppm.size() - bytes)};
}

/// Draws all pages. Their files are numbered with as many digits as the last page needs.
void draw_pages(const std::string& root, std::vector<PrintedPage>& pages) {
  REQUIRE(runs_quietly("pdftoppm -r 100 '" + root + "report.pdf' '" + root + "page'"));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".ppm") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  REQUIRE(files.size() == pages.size());
  for (size_t i = 0; i < files.size(); ++i) {
    pages[i].pixels = pixels_of(text_of(files[i]));
    fs::remove(files[i]);
  }
}

/// Prints into a folder that may hold the report in another language.
std::vector<PrintedPage> printed(const AssessmentRecord& record, Language language,
                                 const TemporaryFolder& folder) {
  const std::string root = folder / "";
  ReportOptions options;
  options.language = language;
  options.pdf = true;
  const auto done = write_report(root, record, options);
  INFO((done.ok() ? "" : done.problem().text()));
  REQUIRE(done.ok());
  REQUIRE(runs_quietly("pdftotext -bbox '" + root + "report.pdf' '" + root + "boxes.html'"));
  std::vector<PrintedPage> pages = pages_of(text_of(root + "boxes.html"));
  draw_pages(root, pages);
  return pages;
}

/// Whether a pixel has the colour of a route's line, but for its soft edges.
bool is_of_route(const Pixels& pixels, size_t x, size_t y) {
  constexpr std::array route{0x1f, 0x5f, 0xa8};
  constexpr int soft = 24;
  for (size_t c = 0; c < 3; ++c) {
    const auto value = static_cast<unsigned char>(pixels.rgb[3 * (y * pixels.width + x) + c]);
    if (std::abs(int{value} - route[c]) > soft) return false;
  }
  return true;
}

/// Number of pixels of routes in a part of a page, in shares of its width and height.
size_t route_pixels(const Pixels& pixels, double left, double top, double right, double bottom) {
  const auto at = [](double share, size_t size) {
    return std::min(size, static_cast<size_t>(std::max(0.0, share) * static_cast<double>(size)));
  };
  size_t count = 0;
  for (size_t y = at(top, pixels.height); y < at(bottom, pixels.height); ++y)
    for (size_t x = at(left, pixels.width); x < at(right, pixels.width); ++x)
      count += is_of_route(pixels, x, y) ? 1 : 0;
  return count;
}

/// Numbers that stand in each other: the boxes of lines reach above and below their digits.
/// The outline and the letters of one word are two words in one place.
bool cover_each_other(const Word& a, const Word& b) {
  if (a.text == b.text && std::abs(a.left - b.left) < 0.3 && std::abs(a.bottom - b.bottom) < 0.7)
    return false;
  const double across = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double up = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  const double height = std::min(a.bottom - a.top, b.bottom - b.top);
  return across > 0.5 && up > 0.45 * height;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.,") == std::string::npos;
}

/// The boxes of words reach above and below their digits. A line that crosses one covers many more
/// pixels than soft edges of digits do on a coloured ground.
void check_numbers_beside_routes(const PrintedPage& page) {
  constexpr size_t soft_edges = 3;
  for (const Word& word : page.words) {
    if (!is_number(word.text)) continue;
    const double over = 0.2 * (word.bottom - word.top);
    if (route_pixels(page.pixels, word.left / page.width, (word.top + over) / page.height,
                     word.right / page.width, (word.bottom - over) / page.height) > soft_edges)
      FAIL_CHECK("the line of a route lies behind " << word.text);
  }
}

void check_pages(const std::vector<PrintedPage>& pages, const Texts& t) {
  REQUIRE(pages.size() > 5);
  size_t routes = 0;
  for (size_t i = 0; i < pages.size(); ++i) {
    const PrintedPage& page = pages[i];
    const std::string text = page.text();
    INFO(t.code() << ", page " << i + 1);
    CHECK(text.find(t.say("page.of", i + 1, pages.size())) != std::string::npos);
    // Margins alone have some forty words.
    CHECK(page.words.size() > 70);
    for (size_t a = 0; a < page.words.size(); ++a)
      for (size_t b = 0; b < a; ++b)
        if (is_number(page.words[a].text) && is_number(page.words[b].text) &&
            cover_each_other(page.words[a], page.words[b]))
          FAIL_CHECK(page.words[a].text << " covers " << page.words[b].text);
    check_numbers_beside_routes(page);
    routes += route_pixels(page.pixels, 0, 0, 1, 1);
  }
  CHECK(routes > 1000);  // the lines are drawn, and in the colour that is looked for
}

/// All that the first pages and the sheets must say.
void check_contents(const std::vector<PrintedPage>& pages, const AssessmentRecord& a,
                    const Texts& t) {
  std::string all;
  for (const PrintedPage& page : pages) all += page.text() + " ";
  const auto says = [&](const std::string& words) {
    INFO(t.code() << ": " << words);
    CHECK(all.find(words) != std::string::npos);
  };
  for (const char* key :
       {"heading.verdict", "heading.plans", "heading.rooms", "heading.luminaires",
        "heading.surfaces", "heading.places", "heading.state", "heading.method",
        "heading.appendix_clauses", "sheet.article", "sheet.battery", "spacing.height"})
    says(t(key));
  for (const char* key : {"column.emergency_flux", "column.mains_flux", "column.operation"}) {
    // Soft hyphens may break a word between syllables; a word without one is whole.
    const std::string head = t(key);
    if (head.find("\u00ad") == std::string::npos) says(head.substr(0, head.find(' ')));
  }
  for (const SurfaceRecord& surface : a.surfaces) {
    const SurfaceGridRecord& grid = surface.grids.front();
    says(t.number(grid.least) + " lx");  // pdftotext parts words at every blank
    says(t.number(grid.most) + " lx");
  }
}

AssessmentRecord office() {
  static const AssessmentRecord record = [] {
    ReadScene read = read_scene(fs::path(LUX_SOURCE_DIR) / "scenes/library/office_floor.toml");
    REQUIRE(read.scene.has_value());
    const auto scene = std::make_shared<const SceneDescription>(std::move(*read.scene));
    static const std::atomic<bool> nobody{false};
    auto assessed = assess(scene, codes_alone(), nobody, [](const std::string&, double) {});
    INFO((assessed.ok() ? "" : assessed.problem().text()));
    REQUIRE(assessed.ok());
    return record_of(*scene, assessed.value(), "1.2.3");
  }();
  return record;
}

AssessmentRecord two_storeys() {
  const std::string text = R"(
[project]
name = "Two storeys"
[[object]]
name = "ground floor"
shape = "room"
low = [0, -3, 0]
high = [14, 3, 2.9]
material = "black5"
[[object]]
name = "upper floor"
shape = "room"
low = [0, -3, 3.2]
high = [14, 3, 6.1]
material = "black5"
[[route]]
name = "below"
path = [[1, 0, 0], [13, 0, 0]]
width = 2
[[route]]
name = "above"
path = [[1, 0, 3.2], [13, 0, 3.2]]
width = 2
[[room]]
name = "lobby"
outline = [[0, -3], [14, -3], [14, 3], [0, 3]]
[[room]]
name = "gallery"
outline = [[0, -3], [14, -3], [14, 3], [0, 3]]
z = 3.2
[[scenario]]
name = "failed"
operation = "emergency"
)" + rated_lamp("lower", "[5, 0, 2.8]") +
                           rated_lamp("upper", "[9, 0, 6]");
  return recorded(text, codes_alone());
}

AssessmentRecord stair() {
  return recorded(stair_room("solid") + R"(
[project]
name = "Stair"
[[route]]
name = "way"
path = [[1, 0, 0], [4, 0, 0], [6.8, 0, 1.7], [11, 0, 1.7]]
width = 1.2
)" + rated_lamp("foot", "[3, 0, 4.5]") +
                      rated_lamp("head", "[8, 0, 4.5]"),
                  codes_alone());
}

}  // namespace

TEST_CASE("the printed report of the office floor is whole in each language", "[report][printed]") {
  if (!can_print()) return;
  const AssessmentRecord record = office();
  const TemporaryFolder folder;
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    const auto pages = printed(record, language, folder);
    CHECK(pages.size() <= office_pages);
    check_pages(pages, Texts(language));
    check_contents(pages, record, Texts(language));
  }
}

TEST_CASE("the printed report of a building of two storeys is whole in each language",
          "[report][printed]") {
  if (!can_print()) return;
  const AssessmentRecord record = two_storeys();
  REQUIRE(record.plan.levels.size() == 2);
  const TemporaryFolder folder;
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    const auto pages = printed(record, language, folder);
    check_pages(pages, Texts(language));
    check_contents(pages, record, Texts(language));
  }
}

TEST_CASE("the printed report of a stair is whole in each language", "[report][printed]") {
  if (!can_print()) return;
  const AssessmentRecord record = stair();
  // Points of the flight stand on its treads, so that none is dark.
  CHECK(record.surfaces.at(0).grids.at(0).least > 0);
  const TemporaryFolder folder;
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    const auto pages = printed(record, language, folder);
    check_pages(pages, Texts(language));
    check_contents(pages, record, Texts(language));
  }
}

}  // namespace luxodus

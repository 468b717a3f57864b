// Reports an assessed room with one luminaire and one sign: page, drawings and tables show what the
// assessment contains.
#include "actors/judge/report/report.hpp"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <librsvg/rsvg.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "actors/judge/assess/assessment_files.hpp"
#include "actors/judge/report/hand_over.hpp"
#include "actors/judge/report/isolux.hpp"
#include "actors/judge/report/pdf.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/judge/report/svg_sheet.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;
namespace fs = std::filesystem;

namespace {

const std::string project = R"(
[project]
name = "Hall <of> tests"
client = "A & B"
document = "T-17"
revision = "C"
date = 2026-11-23
)";

/// One round of paths, so that it takes a second.
const AssessmentRecord& room_record() {
  static const AssessmentRecord record = [] {
    AssessOptions options;
    options.rounds = 1;
    return recorded(project + room, options);
  }();
  return record;
}

const Json& assessed_json() {
  static const Json json = assessment_json(room_record());
  return json;
}

std::string page_in(Language language) {
  ReportOptions options;
  options.language = language;
  return report_html(room_record(), {}, options);
}

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

std::string content(const fs::path& path) {
  const auto bytes = read_whole_file(path, uint64_t{64} << 20);
  INFO(path);
  REQUIRE(bytes.ok());
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

bool runs(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

/// Counts what dxflib reads from a drawing.
class Read : public DL_CreationAdapter {
 public:
  std::map<std::string, int> on_layer;
  std::vector<DL_InsertData> inserts;
  std::map<std::string, std::string> attributes;
  std::vector<std::string> texts;
  std::map<std::string, int> variables;
  std::string release;

  void addLayer(const DL_LayerData& data) override { on_layer.try_emplace(data.name, 0); }
  void addLine(const DL_LineData&) override { ++on_layer[attributes_layer()]; }
  void addPolyline(const DL_PolylineData&) override { ++on_layer[attributes_layer()]; }
  void addInsert(const DL_InsertData& data) override { inserts.push_back(data); }
  void addAttribute(const DL_AttributeData& data) override { attributes[data.tag] += data.text; }
  void addText(const DL_TextData& data) override { texts.push_back(data.text); }
  void setVariableInt(const std::string& key, int value, int) override { variables[key] = value; }
  void setVariableString(const std::string& key, const std::string& value, int) override {
    if (key == "$ACADVER") release = value;
  }

 private:
  std::string attributes_layer() { return getAttributes().getLayer(); }
};

/// Joins lines, since text on a page may break anywhere.
std::string in_one_line(const std::string& page) {
  std::istringstream words(page);
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

}  // namespace

TEST_CASE(
    "a backdrop is drawn faintly on plans of its floors, and none of its metadata enters the plan",
    "[report][backdrop]") {
  AssessOptions options;
  options.rounds = 1;
  const TemporaryFolder folder;
  PngImage image;
  image.width = 20;
  image.height = 10;
  image.rgb.assign(600, 100);
  image.text = {{"Comment", "<script>alert(1)</script>"}};
  const auto png = encode_png(image, {});
  REQUIRE(png.ok());
  folder.write("plan.png", std::string(reinterpret_cast<const char*>(png->data()), png->size()));
  SceneDescription scene = *described_text(room);
  Backdrop lines, picture, above;
  lines.lines = {{{0, -2}, {12, 2}}, {{-50, 0}, {50, 0}}};
  picture.picture = true;
  picture.file = folder / "plan.png";
  picture.corner = {0, -2};
  picture.across = {12, 0};
  picture.up = {0, 4};
  above = lines;
  above.low_m = 3;
  const auto plan_of = [&](std::vector<Backdrop> backdrops) {
    scene.backdrops = std::move(backdrops);
    const auto read =
        assessment_of(assessment_json(record_of(scene, assessed(room, options), "1.2.3")));
    INFO((read ? "" : read.problem().what));
    REQUIRE(read);
    const AssessmentRecord& a = read.value();
    const Schedule schedule(a);
    const Texts texts(Language::en);
    return Plans(a, schedule, texts, {}).installation(0);
  };
  const Plan bare = plan_of({}), drawn = plan_of({lines}), pictured = plan_of({picture});
  CHECK_FALSE(has(bare.svg, "backdrop"));
  CHECK(plan_of({above}).svg == bare.svg);
  // It does not enlarge the plan, and is drawn before the walls.
  CHECK(drawn.width_mm == bare.width_mm);
  CHECK(drawn.svg.find("class=\"backdrop\"") < drawn.svg.find("class=\"walls\""));
  CHECK(has(pictured.svg, "data:image/png;base64,"));
  // Pictures do not hide lines, whatever their order in the scene.
  const std::string both = plan_of({lines, picture}).svg;
  CHECK(both.find("<image") < both.find("stroke=\"#555\""));
  CHECK_FALSE(has(pictured.svg, "script"));
  for (const Plan* plan : {&drawn, &pictured}) {
    RsvgHandle* handle = rsvg_handle_new_from_data(
        reinterpret_cast<const guint8*>(plan->svg.data()), plan->svg.size(), nullptr);
    CHECK(handle != nullptr);
    if (handle != nullptr) g_object_unref(handle);
  }
  // A damaged picture and one without a place are refused.
  scene.backdrops = {picture};
  Json a = assessment_json(record_of(scene, assessed(room, options), "1.2.3"));
  a["plan"]["backdrops"][0]["png"] = "\"><script>";
  CHECK_FALSE(assessment_of(a));
  a["plan"]["backdrops"][0].erase("png");
  CHECK_FALSE(assessment_of(a));
}

TEST_CASE("signs are listed with their words, and paths break after folders", "[report]") {
  CHECK(has(page_in(Language::fr), "“EXIT”"));
  AssessmentRecord drawn = room_record();
  drawn.signs[0].text = "";
  drawn.signs[0].file = "../zeichen/Ausgänge & mehr.svg";
  CHECK(has(report_html(drawn, {}, {}), "../<wbr>zeichen/<wbr>Ausgänge &amp; mehr.svg"));
}

TEST_CASE("verdicts have words in each language", "[report]") {
  const auto said = [](Language language, const CountsRecord& one) {
    return verdict_words(Texts(language), one);
  };
  const CountsRecord none{.pass = 9, .fail = 0, .not_assessed = 6, .not_verified = 1},
      one{.pass = 9, .fail = 1, .not_assessed = 1, .not_verified = 0},
      many{.pass = 9, .fail = 3, .not_assessed = 0, .not_verified = 0},
      unmade{.pass = 0, .fail = 0, .not_assessed = 4, .not_verified = 0};
  CHECK(said(Language::en, none) == "no check made fails, 6 not assessed, 1 not verified");
  CHECK(said(Language::de, none) ==
        "keine der durchgeführten Prüfungen schlägt fehl, 6 nicht bewertet, 1 nicht belegt");
  CHECK(said(Language::fr, none) ==
        "aucun contrôle effectué n’échoue, 6 non évalués, 1 non vérifié");
  CHECK(said(Language::en, one) == "1 check fails, 1 not assessed");
  CHECK(said(Language::de, one) == "1 Prüfung nicht bestanden, 1 nicht bewertet");
  CHECK(said(Language::fr, many) == "3 contrôles non satisfaits, 0 non évalué");
  CHECK(said(Language::de, unmade) == "keine Prüfung war möglich, 4 nicht bewertet");
}

TEST_CASE("the headline of a report says in each language what a terminal says first", "[report]") {
  const AssessmentRecord& a = room_record();
  CHECK(headline(Texts(Language::en), a) == a.verdict.first);
  AssessmentRecord smoky = a;
  smoky.state.scenario = "Brand";
  smoky.state.seconds_after_failure = 600;
  smoky.state.smoke = StateSmokeRecord{{0.05, 2, 633}, {}, {}};
  smoky.verdict.counts = {.pass = 7, .fail = 2, .not_assessed = 1, .not_verified = 0};
  smoky.sight_counts = {{"legible", 3}, {"invisible", 5}};
  CHECK(headline(Texts(Language::de), smoky) ==
        "„Brand“, Notbetrieb, 600 s nach dem Netzausfall, in Rauch von 0,05/m bis 2/m, nach " +
            a.state.rules[0].edition +
            ": 2 Prüfungen nicht bestanden, 1 nicht bewertet; 3 von 8 Sichten auf Zeichen sind "
            "lesbar");
  smoky.state.smoke->on_lines = SmokeOnLinesRecord{0.25, 0.5, 8};
  CHECK(has(headline(Texts(Language::de), smoky),
            "in Rauch von 0,05/m bis 2/m (0,25/m bis 0,5/m auf Sichtlinien), nach"));
  smoky.state.smoke->on_lines = SmokeOnLinesRecord{0, 0, 8};
  CHECK(has(headline(Texts(Language::de), smoky), "aber ohne Rauch auf einer Sichtlinie"));
  for (const Language language : {Language::en, Language::de, Language::fr})
    CHECK(page_in(language).find(escaped(headline(Texts(language), a))) <
          page_in(language).find("<h2 "));
}

TEST_CASE(
    "a report says what it does not certify, on its first page and in its footer, in each language",
    "[report]") {
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    const Texts texts(language);
    const std::string page = page_in(language);
    INFO(texts.code());
    CHECK(has(page, "<html lang=\"" + std::string(texts.code()) + "\">"));
    const size_t first_section = page.find("<h2 ");
    for (const char* notice : {"notice.calculation", "notice.secondary", "notice.legibility",
                               "notice.authority", "notice.measure"})
      CHECK(page.find(escaped(texts(notice))) < first_section);
    CHECK(page.find("@bottom-left") < page.find("@bottom-right"));
    CHECK(has(page, "counter(pages)"));
    CHECK_FALSE(has(page, "complies with EN"));
    CHECK_FALSE(has(page, "http-equiv"));
    CHECK_FALSE(has(page, "src=\"http"));
    CHECK_FALSE(has(page, "<script"));
    CHECK(has(page, "</html>"));
  }
  CHECK(has(page_in(Language::en), "1.65"));
  CHECK(has(page_in(Language::de), "1,65"));
  CHECK(has(page_in(Language::fr), "1,65"));
  CHECK_FALSE(has(page_in(Language::de), ">1.65"));
}

TEST_CASE("the sections of a report run from the verdict to the method", "[report]") {
  const std::string page = page_in(Language::en);
  size_t before = 0;
  for (const char* id :
       {"verdict", "plans", "rooms", "luminaires", "schedules", "surfaces", "places", "sights",
        "thumb", "state", "inputs", "not-assessed", "method", "appendix-clauses"}) {
    const size_t at = page.find("<h2 id=\"" + std::string(id) + "\"");
    INFO(id);
    REQUIRE(at != std::string::npos);
    CHECK(at > before);
    before = at;
  }
  // Numbers and letters have no holes, whatever is left out: here the guidance over time.
  CHECK_FALSE(has(page, "<h2 id=\"over-time\""));
  const std::regex number("<h2[^>]*><span class=\"n\">([0-9]+)</span>");
  int expected = 1;
  for (std::sregex_iterator at(page.begin(), page.end(), number), end; at != end; ++at)
    CHECK((*at)[1] == std::to_string(expected++));
  CHECK(expected == 14);
  for (const char* letter : {"Appendix A", "Appendix B", "Appendix C"})
    CHECK(has(page, "<span class=\"a\">" + std::string(letter) + "</span>"));
  const AssessmentRecord& a = room_record();
  CHECK(page.find(a.verdict.words) < page.find("<h2 "));
  CHECK(has(page, "Hall &lt;of&gt; tests"));
  CHECK(has(page, "A &amp; B"));
  CHECK(has(page, a.scene.content_hash));
  CHECK(has(page, "Luxodus 1.2.3"));
  for (const Check& check : a.checks) CHECK(has(page, escaped(check.rule.edition)));
}

TEST_CASE("verdicts have a shape and a word besides their colour", "[report]") {
  const Texts texts(Language::en);
  std::set<std::string> shapes;
  for (const char* verdict : {"pass", "fail", "not assessed", "not verified", "information"}) {
    const std::string mark = verdict_mark(texts, "verdict", verdict);
    CHECK(has(mark, texts.word("verdict", verdict)));
    const std::string shape = std::regex_replace(mark, std::regex("#[0-9a-f]{6}"), "");
    shapes.insert(shape.substr(shape.find("<svg"), shape.find("</svg>") - shape.find("<svg")));
  }
  CHECK(shapes.size() == 5);
}

namespace {

/// Adds the paths of all values that are neither lists nor objects.
void add_paths(const Json& value, const std::string& path, std::vector<std::string>& out) {
  if (!value.is_structured() || value.empty()) return out.push_back(path);
  if (value.is_object())
    for (const auto& [key, one] : value.items()) add_paths(one, path + "/" + key, out);
  if (value.is_array())
    for (size_t i = 0; i < value.size(); ++i)
      add_paths(value[i], path + "/" + std::to_string(i), out);
}

}  // namespace

TEST_CASE("a missing key is reported by name, and no report crashes without it", "[report]") {
  REQUIRE(assessment_of(assessed_json()));
  std::vector<std::string> paths;
  for (const auto& [key, value] : assessed_json().items()) add_paths(value, key, paths);
  std::set<std::string> tried;
  size_t faults = 0;
  for (const std::string& path : paths) {
    // One of each kind: the first entry of each list.
    const std::string kind = std::regex_replace(path, std::regex("/[0-9]+"), "/0");
    if (kind != path || !tried.insert(kind).second) continue;
    Json cut = assessed_json();
    const size_t slash = path.rfind('/');
    const std::string key = path.substr(slash == std::string::npos ? 0 : slash + 1);
    if (!key.empty() && key[0] >= '0' && key[0] <= '9') continue;
    Json& above = slash == std::string::npos ? cut : *cut.at_path(path.substr(0, slash));
    CHECK(above.erase(key) == 1);
    INFO(path);
    if (const auto read = assessment_of(cut); !read) {
      ++faults;
      CHECK(has(read.problem().what, key));
    } else {
      CHECK(has(report_html(read.value(), {}, {}), "</html>"));
    }
  }
  CHECK(faults > 60);
  Json wrong = assessed_json();
  wrong["checks"][0]["verdict"] = 3;
  CHECK(assessment_of(wrong).problem().what == "checks[0].verdict is not a text");
  wrong = assessed_json();
  wrong["signs"][0]["position"][0] = 1e300;
  CHECK_FALSE(assessment_of(wrong));
  wrong = assessed_json();
  wrong["project"]["logo_png"] = "\"><script>";
  CHECK(assessment_of(wrong).problem().what == "project.logo_png is no picture");
  wrong = assessed_json();
  wrong["plan"]["levels"][0]["map"]["columns"] = 1e6;
  CHECK_FALSE(assessment_of(wrong));
}

TEST_CASE("a damaged assessment is refused with its file and the missing key", "[report]") {
  const TemporaryFolder folder;
  Json cut = assessed_json();
  cut.erase("signs");
  folder.write("assessment.json", json_text(cut));
  const auto read = read_assessment(fs::path(folder / ""));
  REQUIRE_FALSE(read.ok());
  CHECK(has(read.problem().text(), "assessment.json"));
  CHECK(has(read.problem().text(), "has no \"signs\""));
  const fs::path hostile = fs::path(LUX_SHARED_DATA) / "traps" / "hostile" / "assessment_739.json";
  if (!fs::exists(hostile)) {
    WARN("skipped: " << hostile << " is not there");
    return;
  }
  folder.write("assessment.json", content(hostile));
  CHECK_FALSE(read_assessment(fs::path(folder / "")).ok());
}

TEST_CASE("lines of equal illuminance match the closed form and end at walls", "[report]") {
  // I h / (h^2 + r^2)^1.5 for 300 lm in all directions, 2.48 m above the plane.
  const double intensity = 300 / (4 * std::numbers::pi), h = 2.5 - 0.02;
  const auto lux = [&](double r) { return intensity * h / std::pow(h * h + r * r, 1.5); };
  size_t points = 0;
  for (const IsoluxLine& one : isolux_lines(room_record().plan.levels[0]))
    for (const glm::dvec2& p : one.line.points) {
      ++points;
      CHECK(lux(glm::length(p - glm::dvec2(6, 0))) == Approx(one.lux).epsilon(0.03));
    }
  CHECK(points > 10);
  // A wall along the room: lines reach it from both sides, and do not cross it.
  PlanLevel walled = room_record().plan.levels[0];
  walled.walls.push_back({{0, 0}, {12, 0}});
  int from_south = 0, from_north = 0;
  for (const IsoluxLine& one : isolux_lines(walled)) {
    const auto [south, north] =
        std::minmax_element(one.line.points.begin(), one.line.points.end(),
                            [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
    CHECK((north->y <= 1e-9 || south->y >= -1e-9));
    from_south += std::abs(north->y) < 1e-9;
    from_north += std::abs(south->y) < 1e-9;
  }
  CHECK(from_south > 0);
  CHECK(from_north > 0);
}

TEST_CASE("no line of equal illuminance follows dark grid points within a wall", "[report]") {
  // Two rows of grid points in a wall below a pane, where the plan shows the pane; the room is
  // evenly lit.
  PlanLevel level = room_record().plan.levels[0];
  LightMap& map = level.map;
  const auto columns = static_cast<size_t>(map.columns);
  for (size_t i = 0; i < map.lux.size(); ++i) map.lux[i] = {i < 2 * columns ? 0.0 : 3.0};
  level.walls.clear();
  CHECK_FALSE(isolux_lines(level).empty());
  const glm::dvec2 between = map.corner + glm::dvec2(0, map.spacing_m / 2);
  level.walls.push_back({between - glm::dvec2(1, 0), between + glm::dvec2(30, 0)});
  CHECK(isolux_lines(level).empty());
}

TEST_CASE("a plan in DXF is read back with its layers, luminaires and lines", "[report]") {
  const TemporaryFolder folder;
  const AssessmentRecord& a = room_record();
  const Schedule schedule(a);
  const fs::path path = folder / "plan.dxf";
  REQUIRE(write_plan_dxf(path, a, schedule, 0).ok());
  Read read;
  DL_Dxf dxf;
  REQUIRE(dxf.in(path.string(), &read));
  CHECK(read.release == "AC1015");  // release 2000, the first that has units
  CHECK(read.variables["$INSUNITS"] == 6);
  for (const char* layer : {"WALLS", "LUMINAIRES", "SIGNS", "ROUTES", "AREAS", "ISOLUX_0_5",
                            "ISOLUX_1", "ISOLUX_5", "ISOLUX_10", "TEXT", "SCALE"}) {
    INFO(layer);
    CHECK(read.on_layer.contains(layer));
  }
  CHECK(read.on_layer["WALLS"] == static_cast<int>(a.plan.levels[0].walls.size()));
  const auto lines = isolux_lines(a.plan.levels[0]);
  const auto count = [&](double lux) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const IsoluxLine& one) { return one.lux == lux; });
  };
  CHECK(count(1) > 0);
  CHECK(read.on_layer["ISOLUX_1"] == count(1));
  CHECK(read.on_layer["ISOLUX_0_5"] == count(0.5));
  REQUIRE(read.inserts.size() == a.luminaires.size() + a.signs.size());
  CHECK(read.inserts[0].name == "LUMINAIRE_A");
  CHECK(read.inserts[0].ipx == Approx(6));
  CHECK(read.inserts[0].ipz == Approx(2.5));
  CHECK(read.inserts[1].angle == Approx(180));
  CHECK(read.attributes["NAME"] == "lampexit");
  CHECK(has(read.attributes["TYPE"], "A"));
  CHECK(std::count(read.texts.begin(), read.texts.end(), "A 2.50") == 1);
}

TEST_CASE("every record of a plan in DXF has a handle of its own and an owner that is there",
          "[report]") {
  const TemporaryFolder folder;
  const AssessmentRecord& a = room_record();
  REQUIRE(write_plan_dxf(folder / "plan.dxf", a, Schedule(a), 0).ok());
  const auto text = read_regular_file(folder / "plan.dxf", 1 << 24);
  REQUIRE(text.ok());
  std::istringstream lines(text.value());
  std::set<std::string> handles{"0"}, owners;
  std::string code, value, kind, section;
  for (; std::getline(lines, code) && std::getline(lines, value);) {
    const int number = std::stoi(code);
    if (number == 0) kind = value;
    if (number == 2 && kind == "SECTION") section = value;
    if (section == "HEADER") continue;
    if (number == 330) owners.insert(value);
    if ((number == 5 || (number == 105 && kind == "DIMSTYLE"))) CHECK(handles.insert(value).second);
  }
  CHECK(kind == "EOF");
  CHECK(handles.size() > 40);
  for (const std::string& owner : owners) {
    INFO(owner);
    CHECK(handles.contains(owner));
  }
}

TEST_CASE("plans are valid SVG drawings with a scale and a north arrow", "[report]") {
  const TemporaryFolder folder;
  ReportOptions options;
  options.grid_values = true;
  REQUIRE(write_report(fs::path(folder / ""), room_record(), options).ok());
  for (const char* name : {"installation.svg", "isolux.svg", "legibility_1.65m.svg"}) {
    const std::string svg = content(fs::path(folder / "plans") / name);
    INFO(name);
    GError* error = nullptr;
    RsvgHandle* handle =
        rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error);
    CHECK(handle != nullptr);
    if (handle != nullptr) g_object_unref(handle);
    CHECK(has(svg, "class=\"scale\""));
    CHECK(has(svg, "class=\"north\""));
    CHECK(has(svg, "1:"));
  }
  const std::string isolux = content(fs::path(folder / "plans") / "isolux.svg");
  CHECK(has(isolux, "data-lux=\"1\""));
  CHECK(has(isolux, "class=\"values\""));
  CHECK(has(content(fs::path(folder / "plans") / "installation.svg"), ">A 2.50<"));
}

TEST_CASE("the plan of the installation explains each of its symbols in each language",
          "[report]") {
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    const Texts texts(language);
    const Schedule schedule(room_record());
    // At the width of a small figure entries that do not fit continue in another row, within the
    // drawing.
    for (const double width : {120.0, 267.0}) {
      const std::string svg =
          Plans(room_record(), schedule, texts, {width, 150}).installation(0).svg;
      const size_t legend = svg.find("class=\"legend\"");
      REQUIRE(legend != std::string::npos);
      for (const char* symbol :
           {"legend.emergency", "legend.letters", "legend.sign", "legend.route", "legend.walls"}) {
        INFO(texts.code() << " " << symbol);
        CHECK(svg.find(">" + std::string(texts(symbol)) + "</text>", legend) != std::string::npos);
      }
      // Symbols that the plan does not show are not explained.
      for (const char* absent : {"legend.mains", "legend.double_sided", "legend.furniture"}) {
        INFO(texts.code() << " " << absent);  // furniture is below the section
        CHECK_FALSE(has(svg, ">" + std::string(texts(absent)) + "</text>"));
      }
      std::smatch size;
      REQUIRE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
      static const std::regex text(
          "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" font-size=\"2.50\" >([^<]*)<");
      for (std::sregex_iterator
               at(svg.begin() + static_cast<std::ptrdiff_t>(legend), svg.end(), text),
           end;
           at != end; ++at) {
        CHECK(std::stod((*at)[2]) < std::stod(size[2]));
        CHECK(std::stod((*at)[1]) + text_width_mm((*at)[3], 2.5) < std::stod(size[1]));
      }
    }
  }
}

TEST_CASE("labels of luminaires in one place do not overlap", "[report]") {
  AssessmentRecord two = room_record();
  two.luminaires.push_back(two.luminaires[0]);
  two.luminaires.back().name = "its twin";
  const TemporaryFolder folder;
  REQUIRE(write_report(fs::path(folder / ""), two, {}).ok());
  const std::string plan = content(fs::path(folder / "plans") / "installation.svg");
  const std::string svg = plan.substr(0, plan.find("class=\"legend\""));
  static const std::regex label("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>A 2.50<");
  std::set<std::string> places;
  for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at)
    places.insert((*at)[1].str() + " " + (*at)[2].str());
  CHECK(places.size() == 2);
}

TEST_CASE("no two verdicts on a sign have the same shape", "[report]") {
  std::set<std::string> shapes;
  for (const char* verdict : {"legible", "undecided", "visible but not legible", "invisible",
                              "not assessed", "hidden by the building"})
    shapes.insert(verdict_shape(verdict, 0, 0, 1));
  CHECK(shapes.size() == 6);
}

TEST_CASE("the legend of what people read names every verdict in every language", "[report]") {
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    ReportOptions options;
    options.language = language;
    const TemporaryFolder folder;
    REQUIRE(write_report(fs::path(folder / ""), room_record(), options).ok());
    const std::string svg = content(fs::path(folder / "plans") / "legibility_1.65m.svg");
    const Texts texts(language);
    for (const char* verdict : {"legible", "undecided", "visible but not legible", "invisible",
                                "not assessed", "hidden by the building"}) {
      INFO(verdict);
      CHECK(has(svg, ">" + texts.word("sight", verdict) + "</text>"));
    }
  }
}

TEST_CASE("schedules have units in their headers and a place in every row", "[report]") {
  const AssessmentRecord& a = room_record();
  const Schedule schedule(a);
  const std::string lamps = luminaires_csv(a, schedule).text();
  CHECK(has(lamps, "x [m],y [m],z [m],height above floor [m]"));
  CHECK(has(lamps, "lamp,A,"));
  CHECK(has(lamps, ",6,0,2.5,2.5,"));
  CHECK(has(lamps, ",lm,0.8,0.75"));
  CHECK(a.luminaires[0].emergency_flux.value == Approx(300));
  CHECK(has(signs_csv(a, schedule).text(), "1,exit,"));
  CHECK(has(signs_csv(a, schedule).text(), ",11.95,0,2.2,2.2,-1,0,0,0.4,0.2,"));
  const std::string points = points_csv(a, schedule).text();
  size_t of_charts = 0;
  for (const SurfaceGridRecord& grid : a.surfaces.at(0).grids) of_charts += grid.points.size();
  CHECK(std::count(points.begin(), points.end(), '\n') ==
        static_cast<std::ptrdiff_t>(of_charts) + 1);
  CHECK(has(points, "illuminance [lx]"));
  CHECK(has(materials_csv(a, schedule).text(), "6.000 0.000 2.500"));
  CHECK(has(places_csv(a).text(), "worst x [m],worst y [m],worst z [m]"));
}

TEST_CASE("the page numbers of a PDF's destinations are found through its page tree", "[report]") {
  const std::string pdf =
      "%PDF-1.4\n1 0 obj\n<</Type /Catalog\n/Pages 2 0 R\n/Dests 7 0 R>>\nendobj\n"
      "2 0 obj\n<</Type /Pages\n/Kids [3 0 R 4 0 R]>>\nendobj\n"
      "4 0 obj\n<</Type /Page>>\nendobj\n3 0 obj\n<</Type /Pages\n/Kids [5 0 R 6 0 R]>>\nendobj\n"
      "5 0 obj\n<</Type /Page>>\nendobj\n6 0 obj\n<</Type /Page>>\nendobj\n"
      "7 0 obj\n<</state [6 0 R /XYZ 1 2 0]\n/method [4 0 R /XYZ 1 2 0]>>\nendobj\n";
  CHECK(pages_of_destinations(pdf) == std::map<std::string, int>{{"state", 2}, {"method", 3}});
  for (size_t cut = 0; cut < pdf.size(); ++cut) pages_of_destinations(pdf.substr(0, cut));
}

TEST_CASE("a printed report contains its verdict, its footers and the page numbers of its contents",
          "[report]") {
  if (!runs("chromium --version") || !runs("pdftotext -v") || !runs("pdftoppm -v")) {
    WARN("skipped: Chromium or poppler-utils are not installed");
    return;
  }
  const TemporaryFolder folder;
  const std::string root = folder / "";
  for (const bool letter : {false, true}) {
    ReportOptions options;
    options.pdf = true;
    options.letter = letter;
    const auto done = write_report(root, room_record(), options);
    INFO((done.ok() ? "" : done.problem().text()));
    REQUIRE(done.ok());
    REQUIRE(runs("pdfinfo -f 1 -l 1 '" + root + "report.pdf' > /dev/null"));
    REQUIRE(std::system(("pdfinfo '" + root + "report.pdf' > '" + root + "info.txt'").c_str()) ==
            0);
    CHECK(has(content(root + "info.txt"), letter ? "(letter)" : "(A4)"));
  }
  REQUIRE(runs("pdftotext -layout '" + root + "report.pdf' '" + root + "text.txt'"));
  const std::string text = content(root + "text.txt");
  std::vector<std::string> pages;
  for (size_t from = 0; from < text.size();) {
    const size_t to = std::min(text.find('\f', from), text.size());
    pages.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  REQUIRE(pages.size() > 5);
  CHECK(has(in_one_line(pages[0]), room_record().verdict.first));
  for (size_t i = 0; i < pages.size(); ++i) {
    CHECK(has(pages[i], fmt::format("Page {} of {}", i + 1, pages.size())));
    CHECK(has(pages[i], "certifies compliance with no law or code"));
    CHECK(has(pages[i], "T-17"));
  }
  std::smatch found;
  std::string front = pages[0] + pages[1];
  REQUIRE(std::regex_search(front, found, std::regex("Signs and bill of materials +([0-9]+)")));
  CHECK(has(pages.at(static_cast<size_t>(std::stoi(found[1])) - 1), "Bill of materials"));
  REQUIRE(runs("pdftoppm -r 30 -png '" + root + "report.pdf' '" + root + "page'"));
  size_t drawn = 0;
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".png" && entry.file_size() > 500) ++drawn;
  CHECK(drawn == pages.size());
}

// EULUMDAT: real files and our own, the variations one by one, and a table of rejected files.
#include "scenes/formats/photometry/ldt.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>

#include "tests/unit/scenes/formats/photometry/photometric_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// The parts of an EULUMDAT file that the tests vary; uniform light of 100 cd/klm by default.
struct Ldt {
  std::string end = "\r\n";
  std::string manufacturer = "Maker";
  std::string name = "Lamp";
  std::string type = "1";
  int symmetry = 1;
  std::vector<std::string> c = {"0"};
  std::string c_step = "0";
  std::vector<std::string> gamma = {"0", "90", "180"};
  std::string gamma_step = "90";
  std::vector<std::string> sizes = {"200", "100", "50", "180", "90", "0", "0", "0", "0"};
  std::string down = "50";
  std::string lorl = "125.66";
  std::string factor = "1";
  std::string tilt = "0";
  std::vector<std::vector<std::string>> lamps = {{"1", "LED", "1000", "4000 K", "80", "10"}};
  std::vector<std::string> candela = {"100", "100", "100"};
  std::string tail;

  std::string text() const {
    std::string out;
    const auto line = [&](const std::string& field) { out += field + end; };
    const auto all = [&](const std::vector<std::string>& list) {
      for (const auto& field : list) line(field);
    };
    all({manufacturer, type, std::to_string(symmetry), std::to_string(c.size()), c_step,
         std::to_string(gamma.size()), gamma_step, "report", name, "number", "file", "date"});
    all(sizes);
    all({down, lorl, factor, tilt, std::to_string(lamps.size())});
    for (const auto& lamp : lamps) all(lamp);
    all(std::vector<std::string>(10, "0.5"));
    all(c);
    all(gamma);
    all(candela);
    return out + tail;
  }
};

PhotometricFile read_ldt_text(const Ldt& ldt, std::optional<int> lamp_set = {}) {
  auto file = read_ldt(ldt.text(), "test.ldt", lamp_set);
  if (!file) FAIL(file.problem().text());
  return std::move(file).value();
}

std::string ldt_refusal(const std::string& text, std::optional<int> lamp_set = {}) {
  const auto file = read_ldt(text, "test.ldt", lamp_set);
  return file ? "was read" : file.problem().text();
}

}  // namespace

TEST_CASE("measured EULUMDAT files add up to their stated flux", "[format][ldt]") {
  if (!data_is_there("ldt")) return;
  struct Expected {
    const char* file;
    double lumens;
    double percent;
    std::optional<int> lamp_set;
  };
  for (const Expected& e : {Expected{"sample1.ldt", 1983, 100.014, 1},
                            {"sample1.ldt", 2643, 100.014, 2},
                            {"sample3.ldt", 12800, 100.002, {}},
                            {"sample4.ldt", 5540, 100.070, {}},
                            {"sample5.ldt", 611.9, 100.005, {}},
                            {"sample10.ldt", 7000, 100.048, {}}}) {
    INFO(e.file);
    const auto file = read_photometric_file(shared_data / "ldt" / e.file, e.lamp_set);
    REQUIRE(file.ok());
    CHECK(file->lamp_flux_lm == Approx(e.lumens));
    CHECK(file->header_flux_lm.value() == Approx(e.lumens));
    CHECK(100 * file->flux_lm / e.lumens == Approx(e.percent).margin(0.001));
    CHECK(file->absolute == (std::string(e.file) == "sample5.ldt"));
    CHECK(std::abs(file->down_share - file->header_down_share.value()) < 0.005);
  }
}

TEST_CASE("a measured file's head gives the luminaire and its size", "[format][ldt]") {
  if (!data_is_there("ldt")) return;
  const auto file = read_photometric_file(shared_data / "ldt/sample5.ldt");
  REQUIRE(file.ok());
  CHECK(file->manufacturer == "ERCO GmbH");  // after a byte order mark
  CHECK(file->luminaire == "Iku Surface-mounted downlight");
  CHECK(file->cct_k.value() == 4000);
  CHECK(file->cri.value() == 82);
  CHECK(file->input_watts == Approx(6.9));
  CHECK(file->opening.shape == LuminousOpening::Shape::disc);
  CHECK(file->opening.size_m == glm::dvec3(0.076, 0.076, 0));
}

TEST_CASE("every unusual EULUMDAT file of the collection is read", "[format][ldt]") {
  if (!data_is_there("edge/ldt")) return;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data / "edge/ldt")) {
    const auto file = read_photometric_file(entry.path());
    INFO((file ? entry.path().string() : file.problem().text()));
    CHECK(file.ok());
    ++files;
  }
  CHECK(files == 11);
}

TEST_CASE("our own luminaires keep the flux their header states", "[format][ldt]") {
  struct Expected {
    const char* file;
    double lumens;
    double cct;
    bool absolute;
  };
  for (const Expected& e : {Expected{"emergency_downlight.ldt", 200, 5000, true},
                            {"emergency_corridor.ldt", 180, 5000, false},
                            {"office_panel.ldt", 4000, 4000, true},
                            {"corridor_downlight.ldt", 1500, 4000, false},
                            {"bulkhead.ldt", 250, 4000, false},
                            {"stage_spot.ldt", 6000, 3200, false}}) {
    const auto file = read_photometric_file(luminaires / e.file);
    INFO((file ? e.file : file.problem().text()));
    REQUIRE(file.ok());
    CHECK(file->header_flux_lm.value() == Approx(e.lumens).epsilon(1e-4));
    CHECK(file->flux_lm == Approx(file->header_flux_lm.value()).epsilon(1e-4));
    CHECK(file->cct_k.value() == e.cct);
    CHECK(file->absolute == e.absolute);
    CHECK(file->warnings.empty());
  }
}

TEST_CASE("the emergency corridor light is directed along C0 and stays below the glare limit",
          "[format][ldt]") {
  const auto file = read_photometric_file(luminaires / "emergency_corridor.ldt");
  REQUIRE(file.ok());
  CHECK(file->web->intensity(toward(0, 65)) > 20 * file->web->intensity(toward(90, 65)));
  CHECK(file->web->intensity(toward(180, 65)) == Approx(file->web->intensity(toward(0, 65))));
  CHECK(file->web->peak_cd() < 500);  // EN 1838, mounted below 2.5 m
}

TEST_CASE("cd/klm become candela by the lamps' flux and the conversion factor", "[format][ldt]") {
  Ldt ldt;
  ldt.lamps[0][2] = "2500";
  ldt.factor = "0.8";
  ldt.lorl = "100.53";
  const PhotometricFile file = read_ldt_text(ldt);
  CHECK(file.web->peak_cd() == Approx(100 * 2.5 * 0.8));
  CHECK(file.flux_lm == Approx(4 * pi * 200));
  CHECK(file.header_flux_lm.value() == Approx(2513.25));
  CHECK_FALSE(file.absolute);
  CHECK(file.warnings.empty());
}

TEST_CASE("each symmetry gives the correct planes", "[format][ldt]") {
  // Eight planes; the value of a listed plane is its own C.
  Ldt ldt;
  ldt.c = {"0", "45", "90", "135", "180", "225", "270", "315"};
  ldt.c_step = "45";
  ldt.gamma = {"0", "180"};
  ldt.gamma_step = "180";
  ldt.lamps[0][2] = "1000";
  struct Case {
    int symmetry;
    std::vector<std::string> listed;
    std::vector<double> at;  // every 45 degrees from C0
  };
  const std::vector<Case> cases = {
      {0, {"1", "2", "3", "4", "5", "6", "7", "8"}, {1, 2, 3, 4, 5, 6, 7, 8}},
      {1, {"5"}, {5, 5, 5, 5, 5, 5, 5, 5}},
      {2, {"1", "2", "3", "4", "5"}, {1, 2, 3, 4, 5, 4, 3, 2}},
      {3, {"1", "2", "3", "4", "5"}, {3, 4, 5, 4, 3, 2, 1, 2}},  // C270, C315, C0, C45, C90
      {4, {"1", "2", "3"}, {1, 2, 3, 2, 1, 2, 3, 2}},
  };
  for (const Case& c : cases) {
    INFO("Isym " << c.symmetry);
    ldt.symmetry = c.symmetry;
    ldt.candela.clear();
    for (const auto& value : c.listed) ldt.candela.insert(ldt.candela.end(), {value, value});
    const PhotometricFile file = read_ldt_text(ldt);
    for (size_t i = 0; i < c.at.size(); ++i) {
      CHECK(file.web->intensity(toward(45.0 * double(i), 70)) == Approx(c.at[i]));
    }
  }
}

TEST_CASE("unequal C and gamma angles are taken from their lists", "[format][ldt]") {
  Ldt ldt;
  ldt.symmetry = 4;
  ldt.c = {"0", "10", "90", "170", "180", "190", "270", "350"};
  ldt.gamma = {"0", "5", "80", "180"};
  ldt.gamma_step = "0";
  ldt.candela = {"8", "8", "8", "8", "4", "4", "4", "4", "2", "2", "6", "2"};
  const PhotometricFile file = read_ldt_text(ldt);
  CHECK(file.web->intensity(toward(10, 30)) == Approx(4));
  CHECK(file.web->intensity(toward(-5, 30)) == Approx(6));
  CHECK(file.web->intensity(toward(270, 80)) == Approx(6));
  CHECK(file.web->intensity(toward(90, 42.5)) == Approx(4));
}

TEST_CASE("a file that stops at the horizon is dark above it", "[format][ldt]") {
  Ldt ldt;
  ldt.gamma = {"0", "90"};
  ldt.candela = {"100", "100"};
  ldt.lorl = "62.83";
  const PhotometricFile file = read_ldt_text(ldt);
  CHECK(file.flux_lm == Approx(2 * pi * 100).epsilon(1e-6));
  CHECK(file.web->intensity(toward(0, 89.9)) == Approx(100));
  CHECK(file.web->intensity(toward(0, 90.01)) == 0);
}

TEST_CASE("of several lamp sets one burns, and the scene says which", "[format][ldt]") {
  Ldt ldt;
  ldt.lamps = {{"1", "LED 350 mA", "1500", "3000", "90", "12"},
               {"-2", "LED 500 mA", "2000", "840", "80", "16"}};
  const std::string said = ldt_refusal(ldt.text());
  INFO(said);
  CHECK(said.starts_with("test.ldt:26: 2 lamp sets are alternatives"));
  CHECK(said.find("lamp_set = 1 to 2: 1: LED 350 mA, 1500 lm; 2: LED 500 mA, 2000 lm") !=
        std::string::npos);
  CHECK(ldt_refusal(ldt.text(), 3).find("no lamp set 3 in the file; there are: 1: LED") !=
        std::string::npos);
  const PhotometricFile first = read_ldt_text(ldt, 1), second = read_ldt_text(ldt, 2);
  CHECK(first.lamp_flux_lm == 1500);
  CHECK(first.web->peak_cd() == Approx(150));
  CHECK(first.input_watts == 12);
  CHECK(first.cct_k.value() == 3000);
  CHECK_FALSE(first.absolute);
  CHECK(second.lamp_flux_lm == 2000);
  CHECK(second.web->peak_cd() == Approx(200));
  CHECK(second.input_watts == 16);
  CHECK(second.cri.value() == 80);
  CHECK(second.absolute);
  CHECK(second.lamp_sets.size() == 2);
  // A file with a single set needs no choice, and takes the one that there is.
  CHECK(read_ldt_text(Ldt{}, 1).lamp_flux_lm == 1000);
  CHECK(ldt_refusal(Ldt{}.text(), 2).find("no lamp set 2") != std::string::npos);
}

TEST_CASE("planes that disagree straight down or up are told beyond 2 percent", "[format][ldt]") {
  Ldt ldt;
  ldt.symmetry = 0;
  ldt.c = {"0", "90", "180", "270"};
  ldt.gamma = {"0", "90", "180"};
  const auto with = [&](const std::string& down, const std::string& up) {
    ldt.candela = {"100", "100", "100", "100", "100", "100", "100", "100", "100", down, "100", up};
    return read_ldt_text(ldt);
  };
  CHECK_FALSE(warns(with("101.9", "98.1"), "planes state"));
  CHECK(warns(with("103", "100"), "straight down (nadir) the planes state 100 to 103 cd"));
  CHECK(warns(with("100", "90"), "straight up (zenith) the planes state 90 to 100 cd"));
  // Noise in the dark is no light.
  ldt.candela = {"1000", "1000", "0.1", "1000", "1000", "0.3",
                 "1000", "1000", "0.2", "1000", "1000", "0.1"};
  ldt.lorl = "";
  CHECK_FALSE(warns(read_ldt_text(ldt), "planes state"));
}

TEST_CASE("a circle of planes with a quarter missing is rejected", "[format][ldt]") {
  Ldt ldt;
  ldt.symmetry = 0;
  ldt.gamma = {"0", "180"};
  ldt.gamma_step = "180";
  const auto listed = [&](std::vector<std::string> c) {
    ldt.c = std::move(c);
    ldt.candela.assign(2 * ldt.c.size(), "100");
    return ldt_refusal(ldt.text());
  };
  CHECK(listed({"0", "90", "180", "270"}) == "was read");
  CHECK(listed({"0", "45", "180", "270"}) == "was read");
  CHECK(listed({"0"}) == "was read");
  CHECK(listed({"0", "45", "90", "135", "180", "225", "270"})
            .find("between C270 and C0 a gap of 90 degrees is wider than any step") !=
        std::string::npos);
}

TEST_CASE("fluxes of one lamp of several, openings in another unit and odd colours give warnings",
          "[photometry]") {
  const auto warned = [](const Ldt& ldt, const std::string& words) {
    size_t count = 0;
    for (const Problem& w : read_ldt_text(ldt).warnings)
      count += w.what.find(words) != std::string::npos && w.where.line > 0 ? 1 : 0;
    return count == 1;
  };
  const Ldt plain;
  for (const char* words :
       {"is it that of one", "longer than the luminaire", "in kelvin", "more than any lamp gives"})
    CHECK_FALSE(warned(plain, words));
  Ldt lamps;
  lamps.lamps = {{"4", "T8", "1000", "4000 K", "80", "72"}};
  CHECK(warned(lamps, "4 lamps give 1000 lm with 72 W"));
  Ldt metres;
  metres.sizes = {"0.2", "0.1", "0.05", "180", "90", "0", "0", "0", "0"};
  CHECK(warned(metres, "longer than the luminaire of 0.2 mm"));
  for (const char* colour : {"40", "65000"}) {
    Ldt kelvin;
    kelvin.lamps = {{"1", "LED", "1000", colour, "80", "10"}};
    CHECK(warned(kelvin, "is no colour temperature in kelvin"));
  }
  Ldt bright;
  bright.lamps = {{"1", "LED", "10000", "840", "80", "10"}};
  CHECK(warned(bright, "more than any lamp gives"));
}

TEST_CASE("a negative lamp count marks absolute photometry", "[format][ldt]") {
  Ldt ldt;
  ldt.lamps[0][0] = "-1";
  const PhotometricFile file = read_ldt_text(ldt);
  CHECK(file.absolute);
  CHECK(file.lamp_sets[0].lamps == 1);
  CHECK(file.flux_lm == Approx(4 * pi * 100));
}

TEST_CASE("commas, quotes, encodings, line ends and padding do not change the luminaire",
          "[format][ldt]") {
  Ldt ldt;
  ldt.lorl = "125,66";
  ldt.candela = {"100,0", "1e2", "\"100\""};
  ldt.manufacturer =
      "\"B\xFC"
      "ro\"";  // Latin-1
  for (const char* end : {"\n", "\r\n", "\r", "\r\r\n"}) {
    ldt.end = end;
    ldt.tail = std::string("0") + end + end + "0.0" + end + "\x1A";
    const PhotometricFile file = read_ldt_text(ldt);
    CHECK(file.manufacturer ==
          "B\xC3\xBC"
          "ro");
    CHECK(file.flux_lm == Approx(4 * pi * 100));
    CHECK(file.warnings.empty());
  }
  ldt.manufacturer =
      "\xEF\xBB\xBF"
      "B\xC3\xBC"
      "ro";  // UTF-8 with a byte order mark
  CHECK(read_ldt_text(ldt).manufacturer ==
        "B\xC3\xBC"
        "ro");
}

TEST_CASE("the opening lies with its length along C90 and its width along C0", "[format][ldt]") {
  using Shape = LuminousOpening::Shape;
  Ldt ldt;
  CHECK(read_ldt_text(ldt).opening.shape == Shape::rectangle);
  CHECK(read_ldt_text(ldt).opening.size_m == glm::dvec3(0.09, 0.18, 0));
  CHECK(read_ldt_text(ldt).housing_m == glm::dvec3(0.1, 0.2, 0.05));
  ldt.sizes = {"200", "100", "50", "180", "90", "20", "0", "30", "0"};
  CHECK(read_ldt_text(ldt).opening.shape == Shape::box);
  CHECK(read_ldt_text(ldt).opening.size_m.z == Approx(0.03));
  ldt.sizes = {"200", "0", "50", "180", "0", "0", "0", "0", "0"};
  CHECK(read_ldt_text(ldt).opening.shape == Shape::disc);
  CHECK(read_ldt_text(ldt).opening.size_m == glm::dvec3(0.18, 0.18, 0));
  ldt.sizes[5] = "25";
  CHECK(read_ldt_text(ldt).opening.shape == Shape::cylinder);
  ldt.sizes = std::vector<std::string>(9, "0");
  CHECK(read_ldt_text(ldt).opening.shape == Shape::point);
}

TEST_CASE("odd values are read with a warning and their line", "[format][ldt]") {
  Ldt ldt;
  ldt.lorl = "80";
  PhotometricFile file = read_ldt_text(ldt);
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0].where.line == 23);
  CHECK(file.warnings[0].where.file == "test.ldt");
  CHECK(warns(file, "light output ratio says 80 %"));
  ldt.lorl = "";
  CHECK(warns(read_ldt_text(ldt), "0 or missing"));
  ldt.lorl = "125.66";
  ldt.tilt = "15";
  file = read_ldt_text(ldt);
  CHECK(file.measured_tilt_deg == 15);
  CHECK(warns(file, "tilted by 15"));
  ldt.tilt = "0";
  ldt.gamma_step = "45";
  CHECK(warns(read_ldt_text(ldt), "stated step of 45"));
  ldt.gamma_step = "90";
  for (const char* type : {"4", "-1", "1.5", "point", ""}) {
    ldt.type = type;
    INFO(type);
    CHECK(warns(read_ldt_text(ldt), "Ityp"));
  }
  ldt.type = "\x1b[2J" + std::string(500, 'x');
  const std::string hostile = read_ldt_text(ldt).warnings.at(0).what;
  CHECK(hostile.find("not \"\\x1B[2Jxxx") != std::string::npos);
  CHECK(hostile.size() < 200);
  ldt.type = "3";
  CHECK(read_ldt_text(ldt).warnings.empty());
  // Watts and the downward share do not change the light.
  ldt.lamps[0][5] = "2x36";
  CHECK(warns(read_ldt_text(ldt),
              "wattage of the lamps should lie between 0 and 1e+06, and is "
              "\"2x36\"; it is not used"));
  ldt.lamps[0][5] = "10";
  ldt.down = "101";
  file = read_ldt_text(ldt);
  CHECK(warns(file, "(DFF) should lie between 0 and 100.5, and is \"101\""));
  CHECK(file.warnings.at(0).where.line == 22);
  CHECK_FALSE(file.header_down_share.has_value());
  ldt.down = "50";
  ldt.tail = "more\r\n";
  CHECK(warns(read_ldt_text(ldt), "not used"));
}

TEST_CASE("a broken EULUMDAT file is one problem that names the line", "[format][ldt]") {
  // 26 lines of the luminaire, 6 of the lamps, 10 ratios: C angles from 43, gamma 44-46,
  // intensities 47-49.
  struct Case {
    int line;
    const char* words;
    std::function<void(Ldt&)> spoil;
  };
  const std::vector<Case> cases = {
      {3, "symmetry indicator (Isym) must lie", [](Ldt& f) { f.symmetry = 7; }},
      {6, "number of intensities", [](Ldt& f) { f.gamma = {"0"}; }},
      {13, "length of the luminaire must be a number", [](Ldt& f) { f.sizes[0] = "long"; }},
      {16, "must lie between 0 and 100000", [](Ldt& f) { f.sizes[3] = "1e9"; }},
      {17, "must lie between", [](Ldt& f) { f.sizes[4] = "-90"; }},
      {23, "light output ratio", [](Ldt& f) { f.lorl = "nan"; }},
      {24, "conversion factor", [](Ldt& f) { f.factor = "-1"; }},
      {26, "number of lamp sets", [](Ldt& f) { f.lamps.clear(); }},
      {27, "whole number", [](Ldt& f) { f.lamps[0][0] = "1.5"; }},
      {29, "flux of the lamps must be a number", [](Ldt& f) { f.lamps[0][2] = ""; }},
      {29, "flux of the lamps must lie", [](Ldt& f) { f.lamps[0][2] = "1e12"; }},
      {32, "the lamp set has no flux", [](Ldt& f) { f.lamps[0][2] = "0"; }},
      {46, "does not ascend",
       [](Ldt& f) {
         f.gamma = {"0", "90", "90"};
       }},
      {46, "must lie between 0 and 180",
       [](Ldt& f) {
         f.gamma = {"0", "90", "181"};
       }},
      {48, "intensity in plane C0 must lie", [](Ldt& f) { f.candela[1] = "-1"; }},
      {48, "must be a number", [](Ldt& f) { f.candela[1] = "inf"; }},
      {48, "must be a number", [](Ldt& f) { f.candela[1] = "1 2"; }},
      {48, "cut off", [](Ldt& f) { f.candela.pop_back(); }},
      {49, "no light",
       [](Ldt& f) {
         f.candela = {"0", "0", "0"};
       }},
      {4, "multiple of 4",
       [](Ldt& f) {
         f.symmetry = 4, f.c = {"0", "120", "240"};
       }},
      {46, "must run from C0 to C180",
       [](Ldt& f) {
         f.symmetry = 2, f.c = {"0", "10", "20", "30"};
       }},
      {45, "C angle 5 does not ascend",
       [](Ldt& f) {
         f.symmetry = 0, f.c = {"0", "10", "5"};
       }},
  };
  for (const Case& c : cases) {
    Ldt ldt;
    c.spoil(ldt);
    const std::string said = ldt_refusal(ldt.text());
    INFO(said << "\nexpected: " << c.line << " " << c.words);
    CHECK(said.starts_with("test.ldt:" + std::to_string(c.line) + ": "));
    CHECK(said.find(c.words) != std::string::npos);
  }
  CHECK(ldt_refusal("").find("cut off") != std::string::npos);
  CHECK(ldt_refusal(std::string("A\n1\n\0", 5)).starts_with("test.ldt:3: a NUL byte"));
  CHECK(ldt_refusal("\xFF\xFE"
                    "A")
            .find("UTF-16") != std::string::npos);
}

TEST_CASE("every truncated EULUMDAT file is rejected", "[format][ldt]") {
  const std::string whole = Ldt{}.text();
  for (size_t size = 0; size + 5 < whole.size(); ++size) {
    const auto file = read_ldt(std::string_view(whole).substr(0, size), "test.ldt");
    INFO("first " << size << " bytes");
    REQUIRE_FALSE(file.ok());
  }
}

TEST_CASE("files of other formats are called by their names", "[format][ldt][ies]") {
  const auto said = [](const std::string& bytes) {
    const auto file = photometric_file_of(bytes, "test", ".");
    return file ? "was read" : file.problem().text();
  };
  for (const char* text :
       {"<?xml version=\"1.0\"?>\n<IESTM33-22><Version>1.1</Version></IESTM33-22>",
        "\xEF\xBB\xBF <LuminaireOpticalData></LuminaireOpticalData>",
        "{\"LuminaireOpticalData\": {}}", "\n{ \"IESTM33-18\": {\"Version\": 1} }"}) {
    INFO(text);
    CHECK(said(text).find("this is ANSI/IES TM-33 (or ATLA S001, UNI 11733), which is not read") !=
          std::string::npos);
  }
  CHECK(said("<svg></svg>").find("this is XML, and neither") != std::string::npos);
  CHECK(said("{\"a\": 1}").find("this is JSON, and neither") != std::string::npos);
  CHECK(said("PK\x03\x04...").find("a GLDF container must have a name") != std::string::npos);
  Ldt ldt;
  ldt.manufacturer = "<Maker>";
  CHECK(said(ldt.text()) == "was read");
}

TEST_CASE("a path to a missing file is a problem with that path", "[format][ldt]") {
  const auto file = read_photometric_file("nowhere/lamp.ldt");
  REQUIRE_FALSE(file.ok());
  CHECK(file.problem().kind == ProblemKind::not_found);
  CHECK(file.problem().where.file == "nowhere/lamp.ldt");
  CHECK(file.problem().what.find("no such") != std::string::npos);
}

// IES LM-63: real files and our own, the editions and their variations, and a table of rejected
// files.
#include "scenes/formats/photometry/ies.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/photometry/photometric_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// The parts of an IES file that the tests vary; uniform light of 100 cd by default.
struct Ies {
  std::string head = "IESNA:LM-63-2002\r\n[TEST] 1\r\n[MANUFAC] Maker\r\n[LUMINAIRE] Lamp\r\n";
  std::string tilt = "TILT=NONE\r\n";
  std::string lamps = "1 1500 1";
  std::string vertical_count = "3";
  std::string horizontal_count = "1";
  std::string type = "1";
  std::string units = "2";
  std::string size = "0.1 0.2 0";
  std::string ballast = "1 1 20";
  std::string verticals = "0 90 180";
  std::string horizontals = "0";
  std::string candela = "100 100 100";

  std::string text() const {
    return head + tilt + lamps + " " + vertical_count + " " + horizontal_count + " " + type + " " +
           units + " " + size + "\r\n" + ballast + "\r\n" + verticals + "\r\n" + horizontals +
           "\r\n" + candela + "\r\n";
  }
};

PhotometricFile read(const Ies& ies, const std::filesystem::path& folder = ".") {
  auto file = read_ies(ies.text(), "test.ies", folder);
  if (!file) FAIL(file.problem().text());
  return std::move(file).value();
}

std::string refusal(const std::string& text) {
  const auto file = read_ies(text, "test.ies", ".");
  return file ? "was read" : file.problem().text();
}

/// Type B direction as the header of the reader states it.
glm::dvec3 lateral(double h_deg, double v_deg) {
  const double h = h_deg * pi / 180;
  const double v = v_deg * pi / 180;
  return {std::cos(h) * std::sin(v), -std::sin(h), -std::cos(h) * std::cos(v)};
}

}  // namespace

TEST_CASE("a measured IES file adds up to its known flux", "[format][ies]") {
  if (!data_is_there("ies")) return;
  const auto file = read_photometric_file(shared_data / "ies/radiance_examp1.ies");
  REQUIRE(file.ok());
  CHECK(file->flux_lm == Approx(5296.65).margin(0.01));
  CHECK(file->lamp_flux_lm == 5800);
  CHECK(file->format == "IES LM-63-1995");  // says IESNA95
  CHECK(file->opening.shape == LuminousOpening::Shape::box);
  // Feet; the length runs along the 0 degree plane.
  CHECK(file->opening.size_m.x == Approx(4.04 * 0.3048));
  CHECK(file->opening.size_m.y == Approx(0.85 * 0.3048));
  CHECK(file->input_watts == Approx(63.7));
  CHECK(file->web->intensity(toward(45, 20)) == Approx(file->web->intensity(toward(225, 20))));
}

TEST_CASE("every unusual IES file of the collection is read with its opening", "[format][ies]") {
  if (!data_is_there("edge/ies95")) return;
  using Shape = LuminousOpening::Shape;
  struct Expected {
    const char* file;
    Shape shape;
    glm::dvec3 size;
  };
  const std::vector<Expected> expected = {
      {"absolute_photometry", Shape::disc, {0.12, 0.12, 0}},
      {"absolute_photometry_with_multiplier", Shape::disc, {0.12, 0.12, 0}},
      {"ellipse_opening_along_length", Shape::cylinder, {0.34, 0.12, 0.56}},
      {"ellipse_opening_along_width", Shape::cylinder, {0.34, 0.12, 0.56}},
      {"ellipsoid_opening_along_length", Shape::sphere, {0.34, 0.12, 0.56}},
      {"ellipsoid_opening_along_width", Shape::sphere, {0.34, 0.12, 0.56}},
      {"horizontal_cylinder_opening_along_length", Shape::tube_along_x, {0.12, 0.34, 0.34}},
      {"metric_units", Shape::box, {0.34, 0.12, 0.56}},
      {"point_opening", Shape::point, {0, 0, 0}},
      {"rectangular_opening", Shape::rectangle, {0.34, 0.12, 0}},
      {"rectangular_opening_with_height", Shape::box, {0.34, 0.12, 0.56}},
      {"relative_photometry", Shape::disc, {0.12, 0.12, 0}},
      {"round_opening", Shape::disc, {0.12, 0.12, 0}},
      {"sphere_opening", Shape::sphere, {0.12, 0.12, 0.12}},
  };
  for (const Expected& e : expected) {
    const auto file =
        read_photometric_file(shared_data / "edge/ies95" / (std::string(e.file) + ".ies"));
    INFO((file ? e.file : file.problem().text()));
    REQUIRE(file.ok());
    CHECK(file->opening.shape == e.shape);
    CHECK(glm::length(file->opening.size_m - e.size) < 1e-12);
    CHECK(file->web->peak_cd() ==
          Approx(std::string(e.file).ends_with("multiplier") ? 3300 : 2200));
    CHECK(file->absolute == (std::string(e.file) != "relative_photometry"));
    CHECK(file->luminaire.starts_with("Dummy IES file. Can be used"));  // [MORE] continues
    CHECK(file->down_share == Approx(1).margin(1e-6));
  }
}

TEST_CASE("our own wall light keeps its flux and is directed to the front", "[format][ies]") {
  const auto file = read_photometric_file(luminaires / "wall_bulkhead.ies");
  REQUIRE(file.ok());
  CHECK(file->flux_lm == Approx(400).epsilon(1e-4));
  CHECK(file->absolute);
  CHECK(file->cct_k.value() == 3000);
  CHECK(file->format == "IES LM-63-2002");
  CHECK(file->warnings.empty());
  CHECK(file->web->intensity(toward(0, 60)) > 20 * file->web->intensity(toward(180, 60)));
  CHECK(file->web->intensity(toward(60, 45)) == Approx(file->web->intensity(toward(-60, 45))));
}

TEST_CASE("candela are scaled by multiplier and ballast, and by the lamp factor until 1991",
          "[format][ies]") {
  Ies ies;
  ies.lamps = "2 1500 1.5";
  ies.ballast = "0.8 0.5 20";
  const PhotometricFile modern = read(ies);
  CHECK(modern.web->peak_cd() == Approx(120));
  CHECK(modern.lamp_flux_lm == 3000);
  CHECK(warns(modern, "after the ballast factor"));
  for (const char* old : {"Some maker\n", "IESNA91\n[TEST] 1\n"}) {
    ies.head = old;
    const PhotometricFile file = read(ies);
    CHECK(file.web->peak_cd() == Approx(60));
    CHECK(warns(file, "multiplied by the ballast-lamp photometric factor of 0.5"));
  }
  // LM-63-1995 keeps the field for future use.
  ies.head = "IESNA:LM-63-1995\n[TEST] 1\n";
  CHECK(read(ies).web->peak_cd() == Approx(120));
  CHECK(warns(read(ies), "IES LM-63-1995 gives it no meaning"));
  ies.head = "IES:LM-63-2019\n[TEST] 1\n";
  ies.ballast = "0.8 1.10001 20";
  const PhotometricFile newest = read(ies);
  CHECK(newest.web->peak_cd() == Approx(120));
  CHECK(newest.warnings.empty());
}

TEST_CASE("each edition is recognised by its first line", "[format][ies]") {
  const std::vector<std::pair<std::string, std::string>> heads = {
      {"Some maker\nSome lamp\n", "IES LM-63-1986"},
      {"", "IES LM-63-1986"},
      {"IESNA91\n[TEST] 1\n", "IES LM-63-1991"},
      {"IESNA95\n", "IES LM-63-1995"},
      {"IESNA:LM-63-1995\n", "IES LM-63-1995"},
      {"\xEF\xBB\xBFIESNA:LM-63-2002\n", "IES LM-63-2002"},
      {"IES:LM-63-2019\n", "IES LM-63-2019"},
  };
  for (const auto& [head, format] : heads) {
    Ies ies;
    ies.head = head;
    const PhotometricFile file = read(ies);
    CHECK(file.format == format);
    CHECK(file.warnings.empty());
  }
  Ies ies;
  ies.head = "Some maker\nSome lamp\n";
  CHECK(read(ies).luminaire == "Some maker");
  ies.head = "IESNA:LM-63-1234\n";
  const PhotometricFile odd = read(ies);
  CHECK(warns(odd, "unknown edition"));
  CHECK(odd.warnings[0].where.line == 1);
  ies.head = "IESNA\x1b[2J\xC2\x9B" + std::string(500, 'x') + "\n";
  const std::string hostile = read(ies).warnings.at(0).what;
  CHECK(hostile.starts_with("unknown edition \"IESNA\\x1B[2J\\xC2\\x9BXXX"));
  CHECK(hostile.size() < 150);
}

TEST_CASE("keywords name maker, luminaire and colour, and Latin-1 becomes UTF-8", "[format][ies]") {
  Ies ies;
  ies.head =
      "IESNA:LM-63-2002\r\n[MANUFAC] B\xFCro\r\n[MORE] GmbH\r\n[LUMCAT] L-1\r\n"
      "[LAMP] LED 24W 3000K module\r\n[_CRI] Ra > 90\r\n";
  const PhotometricFile file = read(ies);
  CHECK(file.manufacturer == "B\xC3\xBCro GmbH");
  CHECK(file.luminaire == "L-1");
  CHECK(file.cct_k.value() == 3000);
  CHECK(file.cri.value() == 90);
}

TEST_CASE("each horizontal range of type C gives the correct planes", "[format][ies]") {
  struct Case {
    const char* horizontals;
    const char* count;
    const char* candela;     // at 0, 90 and 180 degrees vertical, plane by plane
    std::vector<double> at;  // every 45 degrees
  };
  const std::vector<Case> cases = {
      {"0", "1", "5 5 5", {5, 5, 5, 5, 5, 5, 5, 5}},
      {"0 45 90", "3", "1 1 1 2 2 2 3 3 3", {1, 2, 3, 2, 1, 2, 3, 2}},
      {"0 45 90 135 180", "5", "1 1 1 2 2 2 3 3 3 4 4 4 5 5 5", {1, 2, 3, 4, 5, 4, 3, 2}},
      {"90 135 180 225 270", "5", "1 1 1 2 2 2 3 3 3 4 4 4 5 5 5", {3, 2, 1, 2, 3, 4, 5, 4}},
      {"0 90 180 270 360", "5", "1 1 1 3 3 3 5 5 5 7 7 7 1 1 1", {1, 2, 3, 4, 5, 6, 7, 4}},
  };
  for (const Case& c : cases) {
    INFO(c.horizontals);
    Ies ies;
    ies.horizontals = c.horizontals;
    ies.horizontal_count = c.count;
    ies.candela = c.candela;
    const PhotometricFile file = read(ies);
    for (size_t i = 0; i < c.at.size(); ++i) {
      CHECK(file.web->intensity(toward(45.0 * double(i), 70)) == Approx(c.at[i]));
    }
  }
}

TEST_CASE("a missing half of the vertical angles is dark", "[format][ies]") {
  Ies ies;
  ies.vertical_count = "2";
  ies.candela = "100 100";
  ies.verticals = "0 90";
  const PhotometricFile down = read(ies);
  CHECK(down.flux_lm == Approx(2 * pi * 100).epsilon(1e-6));
  CHECK(down.web->intensity({0, 0, 1}) == 0);
  CHECK(down.warnings.empty());
  ies.verticals = "90 180";
  const PhotometricFile up = read(ies);
  CHECK(up.flux_lm == Approx(2 * pi * 100).epsilon(1e-6));
  CHECK(up.web->intensity({0, 0, -1}) == 0);
  CHECK(up.down_share == Approx(0).margin(1e-6));
  ies.verticals = "0 75";
  CHECK(warns(read(ies), "run from 0 to 75"));
}

TEST_CASE("type B turns about the width axis, clockwise seen from above", "[format][ies]") {
  Ies ies;
  ies.type = "2";
  ies.vertical_count = "5";
  ies.horizontal_count = "3";
  ies.verticals = "-90 -45 0 45 90";
  ies.horizontals = "-90 0 90";
  // H = -90 (+Y): 2; H = 0: 10 at V = -90 (-X) up to 50 at +90 (+X); H = 90 (-Y): 4.
  ies.candela = "2 2 2 2 2 10 20 30 40 50 4 4 4 4 4";
  const PhotometricFile file = read(ies);
  CHECK(file.web->intensity({0, 0, -1}) == Approx(30));
  CHECK(file.web->intensity(lateral(0, 89.99)) == Approx(50).epsilon(1e-3));
  CHECK(file.web->intensity({0.6, 0, -0.8}) > 30);
  CHECK(file.web->intensity({-0.6, 0, -0.8}) < 30);
  CHECK(file.web->intensity({0, 1, -1e-9}) == Approx(2));
  CHECK(file.web->intensity({0, -1, -1e-9}) == Approx(4));
  CHECK(file.web->intensity(lateral(45, 22.5)) == Approx(0.5 * (35 + 4)));
  CHECK(file.web->intensity(lateral(-45, 22.5)) == Approx(0.5 * (35 + 2)));
  CHECK(file.web->intensity({0, 0, 1}) == 0);
  CHECK(file.warnings.empty());
}

TEST_CASE("a type B file of one quarter is mirrored into the lower hemisphere", "[format][ies]") {
  Ies ies;
  ies.type = "2";
  ies.vertical_count = "2";
  ies.horizontal_count = "2";
  ies.verticals = "0 90";
  ies.horizontals = "0 90";
  ies.candela = "100 100 100 100";
  const PhotometricFile file = read(ies);
  CHECK(file.flux_lm == Approx(2 * pi * 100).epsilon(1e-6));
  for (double h : {-40.0, 40.0}) {
    for (double v : {-60.0, 60.0}) CHECK(file.web->intensity(lateral(h, v)) == Approx(100));
  }
  CHECK(warns(file, "mirror image"));
}

TEST_CASE("decimal commas are rejected, and commas between numbers are read", "[format][ies]") {
  Ies ies;
  ies.lamps = "1,1500,1";
  ies.size = "0.1,0.2,0";
  ies.verticals = "0,90,180";
  ies.candela = "100.5,100.5,100.5";
  CHECK(read(ies).web->peak_cd() == Approx(100.5));
  ies = {};
  ies.candela = "100,5 100,5 100,5";
  CHECK(refusal(ies.text()).starts_with("test.ies:10: the numbers have decimal commas"));
  // In the head they shift all numbers after them.
  ies = {};
  ies.size = "0,1 0,2 0";
  CHECK(refusal(ies.text()).starts_with("test.ies:6: the numbers have decimal commas"));
  ies = {};
  ies.ballast = "1,0 1,0 20,5";
  CHECK(refusal(ies.text()).starts_with("test.ies:7: the numbers have decimal commas"));
}

TEST_CASE("a missing line of ballast factor and watts is told by its name", "[format][ies]") {
  Ies ies;
  ies.ballast = "";
  ies.vertical_count = "5";
  ies.verticals = "0 30 60 90 120";
  ies.candela = "950 820 540 210 60";
  const std::string said = refusal(ies.text());
  INFO(said);
  CHECK(said.starts_with("test.ies:8: the line of ballast factor, photometric factor and input"));
  // Real files may have angles that look like factors, and factors that ascend.
  ies.ballast = "0.9 1 20";
  CHECK(read(ies).web->peak_cd() == Approx(950 * 0.9));
}

TEST_CASE("planes that disagree at the nadir are told, and a missing quarter is rejected",
          "[format][ies]") {
  Ies ies;
  ies.lamps = "1 -1 1";
  ies.horizontals = "0 90 180 270 360";
  ies.horizontal_count = "5";
  ies.candela = "500 1 1 750 1 1 1000 1 1 1250 1 1 500 1 1";
  CHECK(warns(read(ies), "straight down (nadir) the planes state 500 to 1250 cd"));
  ies.candela = "500 1 1 505 1 1 500 1 1 500 1 1 500 1 1";
  CHECK_FALSE(warns(read(ies), "planes state"));
  ies.horizontals = "0 45 90 135 180 225 270";
  ies.horizontal_count = "7";
  ies.candela = "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1";
  CHECK(refusal(ies.text()).find("the horizontal angles stop at 270, and the gap of 90 degrees") !=
        std::string::npos);
}

TEST_CASE("planes that leave out a part of the circle between them are told", "[format][ies]") {
  Ies ies;
  ies.lamps = "1 -1 1";
  ies.horizontals = "0 15 30 45 60 75 90 180 195 210 225 240 255 270 285 300 315 330 345 360";
  ies.horizontal_count = "20";
  ies.candela.clear();
  for (int i = 0; i < 20; ++i) ies.candela += "1 1 1 ";
  CHECK(warns(read(ies), "between the planes 90 and 180 degrees, a step far wider"));
  ies.horizontals = "0 45 90 180 270 360";
  ies.horizontal_count = "6";
  ies.candela = "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1";
  CHECK_FALSE(warns(read(ies), "far wider"));
}

TEST_CASE("values may wrap over lines and be separated by commas", "[format][ies]") {
  Ies ies;
  ies.verticals = "0,\n90\n180";
  ies.candela = "100\n\n100 ,\n 100";
  ies.lamps = "1\n1500 1";
  CHECK(read(ies).flux_lm == Approx(4 * pi * 100));
}

TEST_CASE("a tilt table is kept, and the level luminaire's factor is applied", "[format][ies]") {
  Ies ies;
  ies.tilt = "TILT=INCLUDE\n1\n3\n-10 10 90\n0.8 1.0 0.6\n";
  const PhotometricFile inside = read(ies);
  CHECK(inside.web->peak_cd() == Approx(90));
  CHECK(inside.lamp_tilt.value().angle_deg.size() == 3);
  CHECK(warns(inside, "tilted"));

  const TemporaryFolder folder;
  folder.write("lamp.tlt", "2\n2\n0 90\n0.9 0.5\n");
  ies.tilt = "TILT=lamp.tlt\n";
  const PhotometricFile beside = read(ies, folder.path());
  CHECK(beside.web->peak_cd() == Approx(90));
  CHECK(beside.lamp_tilt.value().geometry == 2);
  CHECK(beside.files_read.size() == 1);
  folder.write("lamp.tlt", "2\n2\n0 90\n0.9\n");
  const auto broken = read_ies(ies.text(), "test.ies", folder.path());
  REQUIRE_FALSE(broken.ok());
  CHECK(broken.problem().where.file == (folder / "lamp.tlt").string());
}

TEST_CASE("signs of width, length and height give the opening of their edition", "[format][ies]") {
  using Shape = LuminousOpening::Shape;
  struct Case {
    const char* head;
    const char* size;
    Shape shape;
    glm::dvec3 extents;
  };
  const char* y1995 = "IESNA:LM-63-1995\n";
  const char* y2002 = "IESNA:LM-63-2002\n";
  const std::vector<Case> cases = {
      {y1995, "0 0 0", Shape::point, {0, 0, 0}},
      {y1995, "-2 0 3", Shape::cylinder, {2, 2, 3}},
      {y1995, "-2 0 -2", Shape::sphere, {2, 2, 2}},
      {y1995, "0 3 -1", Shape::tube_along_x, {3, 1, 1}},
      {y1995, "3 0 -1", Shape::tube_along_y, {1, 3, 1}},
      {y1995, "-2 4 0", Shape::disc, {4, 2, 0}},
      {y1995, "-2 4 -1", Shape::sphere, {4, 2, 1}},
      {y2002, "2 4 0", Shape::rectangle, {4, 2, 0}},
      {y2002, "2 4 1", Shape::box, {4, 2, 1}},
      {y2002, "-2 -2 0", Shape::disc, {2, 2, 0}},
      {y2002, "-2 -4 0", Shape::disc, {4, 2, 0}},
      {y2002, "-2 -4 1", Shape::cylinder, {4, 2, 1}},
      {y2002, "-2 -2 -2", Shape::sphere, {2, 2, 2}},
      {y2002, "-1 4 -1", Shape::tube_along_x, {4, 1, 1}},
      {y2002, "4 -1 -1", Shape::tube_along_y, {1, 4, 1}},
      {y2002, "-2 0 -2", Shape::disc, {0, 2, 2}},
  };
  for (const Case& c : cases) {
    INFO(c.head << c.size);
    Ies ies;
    ies.head = c.head;
    ies.size = c.size;
    const LuminousOpening opening = read(ies).opening;
    CHECK(opening.shape == c.shape);
    CHECK(opening.size_m == c.extents);
  }
  Ies feet;
  feet.units = "1";
  feet.size = "1 2 0";
  CHECK(read(feet).opening.size_m.x == Approx(0.6096));
}

TEST_CASE("odd values in an IES file are read with a warning", "[format][ies]") {
  Ies ies;
  ies.lamps = "1 1000 1";
  CHECK(warns(read(ies), "more than the lamps'"));
  ies.lamps = "1 -5 1";
  CHECK(warns(read(ies), "taken for -1"));
  CHECK(read(ies).absolute);
  ies.lamps = "1 -1 1";
  CHECK(read(ies).warnings.empty());
  ies.horizontals = "0 90 180 270";
  ies.horizontal_count = "4";
  ies.candela = "1 1 1 2 2 2 3 3 3 4 4 4";
  const PhotometricFile open = read(ies);
  CHECK(warns(open, "instead of 360"));
  CHECK(open.web->intensity(toward(315, 70)) == Approx(2.5));
  ies.horizontals = "0 90 180 270 360";
  ies.horizontal_count = "5";
  ies.candela = "1 1 1 2 2 2 3 3 3 4 4 4 9 9 9";
  CHECK(warns(read(ies), "0 and 360 degrees differ"));
  ies.candela = "1 1 1 2 2 2 3 3 3 4 4 4 1 1 1 8";
  CHECK(warns(read(ies), "not used"));
}

TEST_CASE("a broken IES file is one problem that names the line", "[format][ies]") {
  // Four lines of label, TILT= on 5, the ten numbers on 6, three on 7, angles on 8 and 9, candela
  // on 10.
  struct Case {
    int line;
    const char* words;
    std::function<void(Ies&)> spoil;
  };
  const std::vector<Case> cases = {
      {5, "must be NONE, INCLUDE or the name", [](Ies& f) { f.tilt = "TILT=../lamp.tlt\r\n"; }},
      {5, "cannot be read", [](Ies& f) { f.tilt = "TILT=nowhere.tlt\r\n"; }},
      {5, "must be NONE", [](Ies& f) { f.tilt = "TILT=\r\n"; }},
      {6, "lamp-to-luminaire geometry", [](Ies& f) { f.tilt = "TILT=INCLUDE\r\n9\r\n"; }},
      {6, "number of lamps must be a number", [](Ies& f) { f.lamps = "one 1500 1"; }},
      {6, "lumens per lamp must lie", [](Ies& f) { f.lamps = "1 1e15 1"; }},
      {6, "the candela multiplier", [](Ies& f) { f.lamps = "1 1500 -1"; }},
      {6, "number of vertical angles must lie", [](Ies& f) { f.vertical_count = "1"; }},
      {6, "number of vertical angles must lie", [](Ies& f) { f.vertical_count = "1000000000"; }},
      {6, "whole number", [](Ies& f) { f.horizontal_count = "1.5"; }},
      {6, "type A (3)", [](Ies& f) { f.type = "3"; }},
      {6, "photometric type must lie", [](Ies& f) { f.type = "4"; }},
      {6, "unit type", [](Ies& f) { f.units = "3"; }},
      {6, "width of the opening", [](Ies& f) { f.size = "1000 1 0"; }},
      {7, "ballast factor must be a number", [](Ies& f) { f.ballast = "nan 1 1"; }},
      {8, "vertical angle 90 does not ascend", [](Ies& f) { f.verticals = "0 90 90"; }},
      {8, "vertical angle must lie", [](Ies& f) { f.verticals = "-90 0 90"; }},
      {9, "horizontal angles of type C",
       [](Ies& f) { f.horizontal_count = "2", f.horizontals = "0 45", f.candela = "1 1 1 1 1 1"; }},
      {9, "horizontal angles of type B", [](Ies& f) { f.type = "2"; }},
      {10, "candela at horizontal angle 0 must lie", [](Ies& f) { f.candela = "1 -1 1"; }},
      {10, "must be a number", [](Ies& f) { f.candela = "1 inf 1"; }},
      {10, "cut off", [](Ies& f) { f.candela = "1 1"; }},
      {10, "no light", [](Ies& f) { f.candela = "0 0 0"; }},
      {9, "no line starts with TILT=", [](Ies& f) { f.tilt = ""; }},
  };
  for (const Case& c : cases) {
    Ies ies;
    c.spoil(ies);
    const std::string said = refusal(ies.text());
    INFO(said << "\nexpected: " << c.line << " " << c.words);
    CHECK(said.starts_with("test.ies:" + std::to_string(c.line) + ": "));
    CHECK(said.find(c.words) != std::string::npos);
  }
}

TEST_CASE("every truncated IES file is rejected", "[format][ies]") {
  const std::string whole = Ies{}.text();
  // The last value is "100": a cut that leaves one of its digits is still a number.
  for (size_t size = 0; size + 5 < whole.size(); ++size) {
    const auto file = read_ies(std::string_view(whole).substr(0, size), "test.ies", ".");
    INFO("first " << size << " bytes");
    REQUIRE_FALSE(file.ok());
  }
}

TEST_CASE("a file's contents, not only its name, tell IES from EULUMDAT", "[format][ies]") {
  const TemporaryFolder folder;
  folder.write("lamp.txt", Ies{}.text());
  const auto file = read_photometric_file(folder / "lamp.txt");
  CHECK(file.ok());
  CHECK(file->format == "IES LM-63-2002");
  CHECK(file->files_read.front() == folder / "lamp.txt");
}

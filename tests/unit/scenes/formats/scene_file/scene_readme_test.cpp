// The README of the scene format agrees with the reader: its tables are the schema's, its example
// can be read.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/formats/scene_file/scene_schema.hpp"
#include "scenes/light/optics/flame_spectrum.hpp"
#include "tests/kit/visible_share.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

std::string readme() {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/scenes/formats/scene_file/README.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Lines of the text that begin with `start`.
std::multiset<std::string> lines(const std::string& text, const std::string& start) {
  std::multiset<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(start, 0) == 0) out.insert(line);
  }
  return out;
}

}  // namespace

TEST_CASE("the README lists every key of the reader and no other, with the same default and range",
          "[format][scene]") {
  const std::string text = readme();
  const size_t from = text.find("## Every table and key");
  REQUIRE(from != std::string::npos);
  const std::string tables = text.substr(from);
  const std::string schema = toml::schema_markdown(scene_schema());
  for (const std::string start : {"### ", "| `"}) {
    const auto said = lines(tables, start), meant = lines(schema, start);
    for (const auto& line : meant) {
      INFO("missing from the README: " << line);
      CHECK(said.count(line) == meant.count(line));
    }
    for (const auto& line : said) {
      INFO("unknown to the reader: " << line);
      CHECK(meant.count(line) > 0);
    }
  }
  // The order agrees as well, so that a key stands in its own table.
  CHECK(tables.find(schema.substr(0, schema.size() - 1)) != std::string::npos);
}

TEST_CASE("every type of the schema is explained, every range and default is sound",
          "[format][scene]") {
  const std::string text = readme();
  const size_t from = text.find("### Words of the column");
  const std::string types = text.substr(from, text.find("### Spectra") - from);
  for (const TableSpec& table : scene_schema().tables) {
    for (const KeySpec& key : table.keys) {
      INFO(table.name << "." << key.name);
      CHECK(types.find(std::string(key.type)) != std::string::npos);
      CHECK_FALSE(key.meaning.empty());
      if (key.range.empty() || key.type == "choice") continue;
      if (key.range.front() != '[' && key.range.front() != '(') continue;
      const auto range = toml::interval_of(key.range);
      REQUIRE(range.has_value());
      CHECK(range->low < range->high);
      char* end = nullptr;
      const std::string fallback(key.fallback);
      const double value = std::strtod(fallback.c_str(), &end);
      if (end != fallback.c_str()) CHECK(range->holds(value));
    }
  }
}

TEST_CASE("the example of the README is a good scene", "[format][scene]") {
  const std::string text = readme();
  const size_t from = text.find("```toml\n");
  REQUIRE(from != std::string::npos);
  const size_t begin = from + 8;
  SceneFolder f;
  std::filesystem::copy_file(f.path() / "lamp.ies", f.path() / "corridor.ies");
  const ReadScene read = f.read(text.substr(begin, text.find("```", begin) - begin));
  INFO(all_problems(read));
  REQUIRE(read.scene.has_value());
  CHECK(read.scene->warnings.empty());
  CHECK(read.scene->objects.size() == 7);
  CHECK(read.scene->scenarios.size() == 2);
}

TEST_CASE("a damaged example is either a scene or has problems, never both or neither",
          "[format][scene]") {
  const std::string text = readme();
  const size_t begin = text.find("```toml\n") + 8;
  std::vector<std::string> rows;
  std::istringstream in(text.substr(begin, text.find("```", begin) - begin));
  for (std::string row; std::getline(in, row);) {
    rows.push_back(row == "text = \"EXIT\"" ? row + "\ntexels = 64" : row);  // a quick face
  }
  SceneFolder f;
  std::filesystem::copy_file(f.path() / "lamp.ies", f.path() / "corridor.ies");
  const std::vector<std::string> values = {
      "nan",   "-1", "1e300",       "true", "\"\"",   "\"x\"",      "[]",
      "[[1]]", "{}", "[{ a = 1 }]", "0",    "[1, 2]", "2024-01-01", "[-1, inf, 0]"};
  int refused = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const size_t equals = rows[i].find(" = ");
    std::vector<std::string> damaged = {"", rows[i] + rows[i], rows[i] + "\n" + rows[i]};
    if (equals != std::string::npos) {
      // Five of the values, others on the next line: all pairs would take a minute.
      for (size_t k = 0; k < 5; ++k) {
        damaged.push_back(rows[i].substr(0, equals + 3) + values[(i * 5 + k) % values.size()]);
      }
    }
    for (const std::string& replacement : damaged) {
      std::string scene;
      for (size_t k = 0; k < rows.size(); ++k) scene += (k == i ? replacement : rows[k]) + "\n";
      const ReadScene read = f.read(scene);
      INFO("line " << i + 1 << ": " << replacement << "\n" << all_problems(read));
      REQUIRE(read.scene.has_value() == read.problems.empty());
      for (const Problem& p : read.problems.list()) CHECK(p.where.line > 0);
      refused += read.scene.has_value() ? 0 : 1;
    }
  }
  CHECK(refused > 250);
}

TEST_CASE("a spectrum narrower than the grid keeps its power", "[format][spectrum]") {
  const Spectrum line = emission_through({{550.5, 0}, {551, 2}, {551.5, 0}});
  CHECK(line.integral() == Approx(1));
  CHECK(line.at(550) > 0);
  CHECK(line.at(560) == 0);
  const Spectrum flat = emission_through({{300, 2}, {900, 2}});
  for (const double v : flat.value) CHECK(v == Approx(2));
}

TEST_CASE("a flame's visible share is Planck's, with the emissivity of soot or of a black body",
          "[format][spectrum]") {
  for (const double kelvin : {900.0, 1400.0, 2700.0, 5800.0}) {
    INFO(kelvin << " K");
    CHECK(flame_spectrum(kelvin, false).visible_fraction ==
          Approx(test::visible_share_of_black_body(kelvin)).epsilon(2e-3));
    const Spectrum black = blackbody_shape(kelvin), flame = flame_spectrum(kelvin, false).shape;
    CHECK(flame.at(450) == Approx(black.at(450)).epsilon(1e-3));
    // Soot: midpoint rule over wavelength, dense enough for six digits.
    double visible = 0, all = 0;
    const double step = 0.5e-9;
    for (double w = 100e-9; w < 60e-6; w += step) {
      const double m = w + step / 2;
      const double p = std::pow(m * 1e6, -6) / std::expm1(1.438776877e-2 / (m * kelvin));
      all += p;
      if (m > 380e-9 && m < 780e-9) visible += p;
    }
    CHECK(flame_spectrum(kelvin, true).visible_fraction == Approx(visible / all).epsilon(1e-4));
    CHECK(flame_spectrum(kelvin, true).shape.integral() == Approx(1));
  }
}

TEST_CASE("a grey is named by its reflectance in percent", "[format][scene]") {
  CHECK(named_grey("grey50") == std::optional<double>(0.5));
  CHECK(named_grey("white80") == std::optional<double>(0.8));
  CHECK_FALSE(named_grey("grey").has_value());
  CHECK_FALSE(named_grey("grey101").has_value());
}

}  // namespace luxodus

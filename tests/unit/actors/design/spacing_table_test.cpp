// Corridors against the spacing table that a manufacturer prints for a luminaire: for each mounting
// height the distances from a wall to the first luminaire, and from one luminaire to the next, at
// which a route has its minimum. The table is computed here from the intensities of the photometric
// file by the inverse square and cosine laws alone.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/design/design_scenes.hpp"

namespace luxodus {
namespace {

using std::numbers::pi;

constexpr double emergency_lm = 200, minimum_lx = 1, plane_m = 0.02;
constexpr double gamma_step_deg = 2.5;

/// A lens for corridors: three times as bright at 60 degrees as straight down, nothing at 90.
double shape_of_lens(double gamma) {
  const double aside = std::sin(gamma);
  return gamma < pi / 2 ? (1 + 7 * aside * aside) * std::cos(gamma) : 0;
}

/// Scaled so that 1000 lm come out of it [cd/klm].
double intensity_cd_klm(double gamma) {
  static const double all = [] {
    double sum = 0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
      const double g = (i + 0.5) * pi / 2 / steps;
      sum += 2 * pi * shape_of_lens(g) * std::sin(g) * pi / 2 / steps;
    }
    return sum;
  }();
  return 1000 * shape_of_lens(gamma) / all;
}

/// Symmetric about its axis, 2.5 degrees apart.
std::string lens_ldt() {
  std::string out;
  const auto line = [&](const std::string& text) { out += text + "\r\n"; };
  constexpr int gammas = 73;
  for (const char* text : {"Maker", "1", "1", "1", "0"}) line(text);
  line(std::to_string(gammas));
  for (const char* text : {"2.5", "report", "corridor lens", "number", "file", "date"}) line(text);
  for (const char* text : {"100", "0", "30", "60", "0", "0", "0", "0", "0"}) line(text);
  for (const char* text : {"100", "100", "1", "0", "1"}) line(text);
  for (const char* text : {"1", "LED", "400", "4000 K", "80", "5"}) line(text);
  for (int i = 0; i < 10; ++i) line("0.5");
  line("0");
  for (int i = 0; i < gammas; ++i) line(fmt::format("{}", i * gamma_step_deg));
  for (int i = 0; i < gammas; ++i)
    line(fmt::format("{:.5f}", intensity_cd_klm(i * gamma_step_deg * pi / 180)));
  return out;
}

/// On the plane, `away` from the foot of a luminaire [lx].
double lux_at(double away_m, double height_m) {
  const double h = height_m - plane_m, gamma = std::atan(away_m / h);
  return emergency_lm / 1000 * intensity_cd_klm(gamma) * std::pow(std::cos(gamma), 3) / (h * h);
}

/// The largest distance with the minimum, of what falls beyond its brightest place.
double largest(const std::function<double(double)>& lux) {
  double low = 1, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (lux(middle) >= minimum_lx ? low : high) = middle;
  }
  return low;
}

struct TableRow {
  double height_m, to_wall_m, between_m;
};
TableRow spacing_at(double height_m) {
  return {height_m, largest([&](double d) { return lux_at(d, height_m); }),
          largest([&](double d) { return 2 * lux_at(d / 2, height_m); })};
}

/// The longest corridor that so many luminaires light by the table [m].
double reach(const TableRow& row, int count) {
  return 2 * row.to_wall_m + (count - 1) * row.between_m;
}

DesignResult corridor(const test::TemporaryFolder& folder, double length, double height) {
  folder.write("lens.ldt", lens_ldt());
  const std::string scene = test::box_room(length + 1, 2, 4.5) + test::judged_2013 +
                            test::way_along(0.5, length + 0.5, 1, 0.3) +
                            fmt::format(R"(
[design]
place_signs = false
failure = "none"
margin = 1
place_tolerance_m = 0
spacing_m = 0.1
mounting_height_m = {}
[[design.type]]
name = "corridor lens"
file = "lens.ldt"
emergency = "non-maintained"
emergency_factor = 0.5
maintenance_factor = 1
end_of_duration_factor = 1
)",
                                        height);
  DesignOptions options;
  options.what_binds = false;
  return test::designed(folder.write("scene.toml", scene), options);
}

}  // namespace

TEST_CASE("corridors take as many luminaires as the manufacturer's spacing table says",
          "[design][spacing]") {
  for (const double height : {2.5, 3.0, 3.5}) {
    const TableRow row = spacing_at(height);
    INFO("height " << height << ": " << row.to_wall_m << " m to a wall, " << row.between_m
                   << " m between");
    CHECK(row.between_m > row.to_wall_m);
    // Higher up one alone has less than the minimum straight below: tables end there.
    CHECK(lux_at(0, height) > minimum_lx);
    for (const int count : {2, 3}) {
      INFO("for " << count);
      const test::TemporaryFolder folder;
      // The grid of places takes up to 0.1 m from each distance.
      const DesignResult result = corridor(folder, reach(row, count) - 0.4, height);
      REQUIRE(result.answer.end == LayoutEnd::optimal);
      REQUIRE(result.luminaires.size() == static_cast<size_t>(count));
      // Where a table counts two luminaires, a layout has the little light of the others, too.
      constexpr double of_others = 1.05;
      const double first = result.luminaires.front().candidate.position.x - 0.5;
      CHECK(first <= of_others * row.to_wall_m);
      for (size_t i = 1; i < result.luminaires.size(); ++i) {
        const double between = result.luminaires[i].candidate.position.x -
                               result.luminaires[i - 1].candidate.position.x;
        CHECK(between <= of_others * row.between_m);
        CHECK(between >= row.between_m - 0.5);
      }
      const DesignResult longer = corridor(folder, of_others * reach(row, count) + 0.2, height);
      CHECK(longer.luminaires.size() == static_cast<size_t>(count + 1));
    }
  }
}

}  // namespace luxodus

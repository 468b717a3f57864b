// Compares corridors with a manufacturer's spacing table of a luminaire. For each mounting height,
// along and across its optics, such a table has the distance from a wall to the first luminaire,
// and from one luminaire to the next, at which a route has its minimum. Here it is computed from
// the intensities of the photometric file by the inverse square and cosine laws.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using std::numbers::pi;

constexpr double emergency_lm = 200, minimum_lx = 1, plane_m = 0.02;
constexpr double gamma_step_deg = 2.5;

/// The two planes of a luminaire in the table: C0, and C90 across it.
enum class Optics { along, across };

/// A corridor lens; cos_c is the cosine of the angle from C0. Along C0 it is three times as bright
/// at 60 degrees as straight down, across it half as bright; zero at 90 degrees.
double shape_of_lens(double gamma, double cos_c) {
  const double aside = std::sin(gamma), along = 7 * cos_c * cos_c + 2 * (1 - cos_c * cos_c);
  return gamma < pi / 2 ? (1 + along * aside * aside) * std::cos(gamma) : 0;
}

/// Normalised to a flux of 1000 lm [cd/klm].
double intensity_cd_klm(double gamma, double cos_c) {
  static const double all = [] {
    double sum = 0;
    constexpr int steps = 20'000;
    const double mean_cos = std::sqrt(0.5);  // of its square, around the axis
    for (int i = 0; i < steps; ++i) {
      const double g = (i + 0.5) * pi / 2 / steps;
      sum += 2 * pi * shape_of_lens(g, mean_cos) * std::sin(g) * pi / 2 / steps;
    }
    return sum;
  }();
  return 1000 * shape_of_lens(gamma, cos_c) / all;
}

/// Symmetric about the planes C0-C180 and C90-C270, at steps of 15 and 2.5 degrees.
std::string lens_ldt() {
  std::string out;
  const auto line = [&](const std::string& text) { out += text + "\r\n"; };
  constexpr int gammas = 73, planes = 24, of_a_quarter = planes / 4 + 1;
  constexpr double plane_step_deg = 360.0 / planes;
  for (const char* text : {"Maker", "1", "4", "24", "15"}) line(text);
  line(std::to_string(gammas));
  for (const char* text : {"2.5", "report", "corridor lens", "number", "file", "date"}) line(text);
  for (const char* text : {"100", "0", "30", "60", "0", "0", "0", "0", "0"}) line(text);
  for (const char* text : {"100", "100", "1", "0", "1"}) line(text);
  for (const char* text : {"1", "LED", "400", "4000 K", "80", "5"}) line(text);
  for (int i = 0; i < 10; ++i) line("0.5");
  for (int c = 0; c < planes; ++c) line(fmt::format("{}", c * plane_step_deg));
  for (int i = 0; i < gammas; ++i) line(fmt::format("{}", i * gamma_step_deg));
  for (int c = 0; c < of_a_quarter; ++c)
    for (int i = 0; i < gammas; ++i)
      line(fmt::format("{:.5f}", intensity_cd_klm(i * gamma_step_deg * pi / 180,
                                                  std::cos(c * plane_step_deg * pi / 180))));
  return out;
}

/// Illuminance on the plane at a distance from the foot of a luminaire [lx].
double lux_at(Optics optics, double away_m, double height_m) {
  const double h = height_m - plane_m, gamma = std::atan(away_m / h);
  return emergency_lm / 1000 * intensity_cd_klm(gamma, optics == Optics::along ? 1 : 0) *
         std::pow(std::cos(gamma), 3) / (h * h);
}

/// The largest distance with the minimum, beyond the brightest point.
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
TableRow spacing_at(Optics optics, double height_m) {
  return {height_m, largest([&](double d) { return lux_at(optics, d, height_m); }),
          largest([&](double d) { return 2 * lux_at(optics, d / 2, height_m); })};
}

/// The longest corridor that this many luminaires light by the table [m].
double reach(const TableRow& row, int count) {
  return 2 * row.to_wall_m + (count - 1) * row.between_m;
}

/// `turns`: rotations around the axis that are tried, from C0 along the corridor; "": the default
/// ones.
DesignResult corridor(const test::TemporaryFolder& folder, double length, double height,
                      const std::string& turns) {
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
                                        height) +
                            turns;
  DesignOptions options;
  options.what_binds = false;
  return test::designed(folder.write("scene.toml", scene), options);
}

}  // namespace

TEST_CASE("corridors need as many luminaires as the manufacturer's spacing table says",
          "[design][spacing]") {
  struct Column {
    Optics optics;
    std::string turns;
  };
  // By default a type is tried along and across, and along is better.
  const auto column =
      GENERATE(Column{Optics::along, ""}, Column{Optics::across, "turns_deg = [90]\n"});
  const double height = GENERATE(2.5, 3.0, 3.5);
  const int count = GENERATE(2, 3);
  const TableRow row = spacing_at(column.optics, height);
  INFO("height " << height << ": " << row.to_wall_m << " m to a wall, " << row.between_m
                 << " m between; for " << count);
  CHECK(row.between_m > row.to_wall_m);
  if (column.optics == Optics::along)
    CHECK(row.between_m > spacing_at(Optics::across, height).between_m);
  // At larger heights a single luminaire has less than the minimum straight below: tables end
  // there.
  CHECK(lux_at(column.optics, 0, height) > minimum_lx);
  const test::TemporaryFolder folder;
  // The grid of places costs up to 0.1 m of each distance.
  const double grid = 0.1 * (count + 1);
  const DesignResult result = corridor(folder, reach(row, count) - grid, height, column.turns);
  REQUIRE(result.answer.end == LayoutEnd::optimal);
  REQUIRE(result.luminaires.size() == static_cast<size_t>(count));
  // A table counts two luminaires; a layout also has some light of the others.
  constexpr double of_others = 1.05;
  const double first = result.luminaires.front().candidate.position.x - 0.5;
  CHECK(first <= of_others * row.to_wall_m);
  for (size_t i = 1; i < result.luminaires.size(); ++i) {
    const double between =
        result.luminaires[i].candidate.position.x - result.luminaires[i - 1].candidate.position.x;
    CHECK(between <= of_others * row.between_m);
    CHECK(between >= row.between_m - grid - (of_others - 1) * row.between_m * count);
  }
  const DesignResult longer =
      corridor(folder, of_others * reach(row, count) + 0.2, height, column.turns);
  CHECK(longer.luminaires.size() == static_cast<size_t>(count + 1));
}

}  // namespace luxodus

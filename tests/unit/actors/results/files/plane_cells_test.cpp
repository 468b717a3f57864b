// Cells of planes in bodies are excluded from mean, minimum and map, and are counted.
#include <cmath>
#include <sstream>

#include "actors/results/files/maps.hpp"
#include "actors/results/files/run_results.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A hall of 6 x 4 x 3 m with a pillar that covers 2 x 2 of the 6 x 4 cells of the floor's plane.
const std::string hall = R"(
[[object]]
name = "hall"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
[[object]]
name = "pillar"
shape = "box"
low = [2, 1, -0.1]
high = [4, 3, 2]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [1, 2, 2.8]
flux_lm = 1000
[[plane]]
name = "floor"
corner = [0, 0, 0.02]
edge_u = [6, 0, 0]
edge_v = [0, 4, 0]
cells = [6, 4]
)";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// A column of a row, NaN where it is empty.
double column_of(const std::string& line, int column) {
  std::istringstream in(line);
  std::string cell;
  for (int i = 0; i <= column; ++i) std::getline(in, cell, ',');
  return cell.empty() ? std::nan("") : std::stod(cell);
}

}  // namespace

TEST_CASE("cells in bodies are in no mean and no extreme of a plane, and are counted",
          "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(hall, 1 << 17);
  const auto done = write_report(folder.path(), *run, {"test.toml", "particles", 1});
  if (!done.ok()) FAIL(done.problem().text());
  const Json result = Json::parse(file_text(folder / "result.json"));
  const Json& plane = result["planes"][0];
  CHECK(plane["cells_in_bodies"] == 4);
  const auto rows = lines_of(file_text(folder.path() / "planes" / "floor.csv"));
  REQUIRE(rows.size() == 25);
  double sum = 0, least = 1e300;
  size_t empty = 0;
  for (size_t i = 1; i < rows.size(); ++i) {
    const size_t u = (i - 1) % 6, v = (i - 1) / 6;
    const double total = column_of(rows[i], 6);
    CHECK(std::isnan(total) == ((u == 2 || u == 3) && (v == 1 || v == 2)));
    if (std::isnan(total)) {
      ++empty;
      continue;
    }
    sum += total;
    // Extremes are those of the grid points: direct light at the centre, the cell's indirect light.
    least = std::min(least, column_of(rows[i], 8) + column_of(rows[i], 4));
  }
  CHECK(empty == 4);
  CHECK(plane["mean_illuminance"]["value"].get<double>() == Approx(sum / 20));
  CHECK(plane["minimum"]["value"].get<double>() == Approx(least));
  CHECK(least > 0);
}

TEST_CASE("a plane without cells in bodies counts none", "[display]") {
  std::string text = hall;
  const std::string high = "high = [4, 3, 2]";
  text.replace(text.find(high), high.size(), "high = [4, 3, 0.01]");
  const auto run = traced(text, 1 << 14);
  const Readout readout(run->scene(), run->totals());
  const Json plane = planes_json(*run, readout, make_plane_maps(*run))[0];
  CHECK(plane["cells_in_bodies"] == 0);
}

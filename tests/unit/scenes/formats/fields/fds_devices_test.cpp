// Agreement with FDS's own devices: beams (PATH OBSCURATION) and points (EXTINCTION COEFFICIENT) of
// cases of FDS 6.7, 6.9 and 6.11, for every source. The table in docs/guide/fire-simulation.md is
// made of it. A test warns if its data is absent.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "runtime/core/regular_file.hpp"
#include "tests/unit/scenes/formats/fields/fire_depths.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::filesystem::path shared_data = LUX_SHARED_DATA;

struct FireDevice {
  std::string name;
  bool is_beam = false;
  glm::dvec3 from{0}, to{0};
};

/// Beams and points of an input file, each on one line.
std::vector<FireDevice> devices_of(const std::filesystem::path& input) {
  std::vector<FireDevice> out;
  const std::regex device(R"(&DEVC ID='(\w+)',\s+(XB|XYZ)=([-0-9.,]+), QUANTITY=)"
                          R"('(PATH OBSCURATION|EXTINCTION COEFFICIENT)')");
  std::ifstream in(input);
  for (std::string line; std::getline(in, line);) {
    std::smatch found;
    if (!std::regex_search(line, found, device) || line.find("SPATIAL") != std::string::npos)
      continue;
    std::vector<double> x;
    std::istringstream numbers(found[3]);
    for (std::string one; std::getline(numbers, one, ',');) x.push_back(std::stod(one));
    FireDevice& d = out.emplace_back();
    d.name = found[1];
    d.is_beam = found[4] == "PATH OBSCURATION";
    if (found[2] == "XB") {
      d.from = {x.at(0), x.at(2), x.at(4)};
      d.to = {x.at(1), x.at(3), x.at(5)};
    } else {
      d.from = d.to = {x.at(0), x.at(1), x.at(2)};
    }
  }
  return out;
}

/// Values of all devices at the line nearest to a time.
std::map<std::string, double> measured_at(const std::filesystem::path& table, double at_s) {
  std::ifstream in(table);
  std::string line, field;
  std::getline(in, line);
  std::getline(in, line);
  std::vector<std::string> names;
  for (std::istringstream head(line); std::getline(head, field, ',');) {
    std::erase(field, '"');
    names.push_back(field);
  }
  std::map<std::string, double> best;
  while (std::getline(in, line)) {
    std::map<std::string, double> row;
    size_t column = 0;
    for (std::istringstream fields(line); std::getline(fields, field, ','); ++column)
      row[names.at(column)] = std::stod(field);
    if (best.empty() || std::abs(row["Time"] - at_s) < std::abs(best["Time"] - at_s))
      best = std::move(row);
  }
  REQUIRE_FALSE(best.empty());
  return best;
}

struct DeviceCase {
  const char* release;
  const char* folder;  // in the data
  const char* name;
  std::vector<double> times;
};

const DeviceCase device_cases[] = {
    {"6.7", "fds_results/uniform677", "uniform677", {1}},
    {"6.9", "fds_results/uniform", "uniform", {1}},
    {"6.9", "fds_results/layered", "layered", {10.0082, 15}},
    {"6.9", "fds_results/corridor", "corridor", {60.0264, 90}},
    {"6.11", "reports/fire/smoke3d_version1", "uniform", {0.5}},
    {"6.11", "reports/fire/own_smoke", "own_smoke", {0.5}},
};

struct NamedSource {
  const char* words;
  std::vector<FireSource> sources;
  double bound;  // on relative differences
};

const NamedSource named_sources[] = {
    {"cells", {FireSource::cell_extinction, FireSource::cell_soot}, 1e-3},
    {"nodes", {FireSource::node_extinction, FireSource::node_soot}, 0.15},
    {"PLOT3D", {FireSource::plot3d}, 0.15},
    {"Smoke3D", {FireSource::smoke3d}, 0.15},
};

/// Devices with less smoke say nothing of relative differences.
constexpr double least_depth = 0.05, least_extinction = 0.05;
/// Tables have eight digits of a percentage: they cannot tell more.
constexpr double largest_told_depth = 12;

struct Differences {
  std::vector<double> beams, points;
};

Differences differences_of(const DeviceCase& c, const NamedSource& source) {
  const std::filesystem::path folder = shared_data / c.folder;
  const std::string stem = c.name;
  const auto devices = devices_of(folder / (stem + ".fds"));
  REQUIRE_FALSE(devices.empty());
  Differences out;
  for (const double at_s : c.times) {
    FireOptions options;
    options.at_s = at_s;
    options.sources = source.sources;
    const auto fire = read_fire(folder / (stem + ".smv"), options);
    if (!fire.ok() || std::abs(fire->time_s - at_s) > 0.1) continue;
    const MediaSet set = compiled_smoke(fire.value());
    const auto measured = measured_at(folder / (stem + "_devc.csv"), fire->time_s);
    for (const FireDevice& d : devices) {
      const double value = measured.at(d.name);
      if (d.is_beam) {
        const double depth = -std::log(std::max(1e-12, 1 - value / 100));
        if (depth >= least_depth && depth <= largest_told_depth)
          out.beams.push_back(std::abs(depth_along(set, d.from, d.to) / depth - 1));
      } else if (value >= least_extinction) {
        out.points.push_back(std::abs(extinction_at(fire.value(), d.from) / value - 1));
      }
    }
  }
  std::sort(out.beams.begin(), out.beams.end());
  std::sort(out.points.begin(), out.points.end());
  return out;
}

/// "8: 0.01 %, 0.04 %": number, median, largest.
std::string summary(const std::vector<double>& sorted) {
  if (sorted.empty()) return "-";
  return fmt::format("{}: {:.2f} %, {:.2f} %", sorted.size(), 100 * sorted[sorted.size() / 2],
                     100 * sorted.back());
}

}  // namespace

TEST_CASE("beams and points of FDS agree with its smoke as it is read, as the guide says",
          "[format][fds]") {
  const auto page = read_regular_file(
      std::filesystem::path(LUX_SOURCE_DIR) / "docs/guide/fire-simulation.md", uint64_t{1} << 20);
  REQUIRE(page.ok());
  size_t rows = 0;
  for (const DeviceCase& c : device_cases) {
    if (!std::filesystem::exists(shared_data / c.folder / (std::string(c.name) + "_devc.csv"))) {
      WARN("skipped: the results of FDS are not there (" << c.folder << ")");
      continue;
    }
    for (const NamedSource& source : named_sources) {
      const Differences d = differences_of(c, source);
      if (d.beams.empty() && d.points.empty()) continue;
      ++rows;
      const std::string row = fmt::format("| {} | {} | {} | {} | {} |", c.release, c.name,
                                          source.words, summary(d.beams), summary(d.points));
      INFO("the guide lacks this row of its table: " << row);
      CHECK(page.value().find(row) != std::string::npos);
      if (!d.beams.empty()) CHECK(d.beams.back() <= source.bound);
    }
  }
  if (std::filesystem::exists(shared_data / "fds_results")) CHECK(rows >= 10);
}

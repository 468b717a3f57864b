// Planes, patches and voxels on disk against result.json and closed forms.
#include "actors/display/maps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "actors/display/report.hpp"
#include "scenes/geometry/patches.hpp"
#include "tests/unit/actors/display/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A room with a lamp that is a point, 2 m over the middle of the floor plane, and thin smoke.
const std::string smoky_room = R"(
patch_edge_m = 1.0
[[material]]
name = "grey"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [10, 20, 0]
high = [14, 24, 3]
material = "grey"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [12, 22, 2]
flux_lm = 1256.6370614359173
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.2
albedo = 0.6
[[plane]]
name = "floor"
corner = [10.5, 20.5, 0]
edge_u = [3, 0, 0]
edge_v = [0, 3, 0]
cells = [5, 3]
)";

std::vector<std::vector<double>> table_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  CHECK(line == "x,y,z,direct_lx,indirect_lx,indirect_se_lx,total_lx,direct_clear_air_lx");
  while (std::getline(in, line)) {
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

double mean_of_column(const std::vector<std::vector<double>>& rows, size_t column) {
  double sum = 0;
  for (const auto& row : rows) sum += row[column];
  return sum / static_cast<double>(rows.size());
}

/// Numbers of an attribute of a VTK file's head.
std::string attribute(const std::string& text, const std::string& name) {
  const size_t at = text.find(name + "=\"");
  if (at == std::string::npos) return "";
  const size_t from = at + name.size() + 2;
  return text.substr(from, text.find('"', from) - from);
}

/// The floats of an array of a VTK file: what follows its byte count in the appended section.
std::vector<float> vtk_floats(const std::string& text, const std::string& name) {
  const size_t element = text.find("Name=\"" + name + "\"");
  REQUIRE(element != std::string::npos);
  const size_t offset = std::stoul(attribute(text.substr(element), "offset"));
  const size_t data = text.find('_', text.find("<AppendedData")) + 1 + offset;
  uint64_t bytes = 0;
  std::memcpy(&bytes, text.data() + data, sizeof bytes);
  std::vector<float> out(bytes / sizeof(float));
  std::memcpy(out.data(), text.data() + data + sizeof bytes, bytes);
  return out;
}

}  // namespace

TEST_CASE("a plane's direct light is the inverse square law, with and without smoke", "[display]") {
  const auto run = traced(smoky_room, 1 << 14);
  const PlaneMaps maps = make_plane_maps(*run);
  REQUIRE(maps.planes.size() == 1);
  const PlaneMap& map = maps.planes[0];
  REQUIRE(map.centres.size() == 15);
  for (size_t i = 0; i < map.centres.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(12, 22, 2) - map.centres[i];
    const double distance = glm::length(d);
    const double clear = 100 * d.z / (distance * distance * distance);  // 100 cd
    CHECK(map.direct_in_clear_lx[i] == Approx(clear).epsilon(1e-4));
    CHECK(map.direct_lx[i] == Approx(clear * std::exp(-0.2 * distance)).epsilon(1e-4));
  }
}

TEST_CASE("the means of a plane's table are those of result.json, and extremes are cells of it",
          "[display]") {
  const ScratchFolder folder;
  const auto run = traced(smoky_room, 1 << 17);
  const auto done = write_report(folder.path(), *run, {"test.toml", "particles", 1});
  if (!done.ok()) FAIL(done.problem().text());
  const Json result = Json::parse(file_text(folder / "result.json"));
  const Json& plane = result["planes"][0];
  const auto rows = table_of(file_text(folder.path() / "planes" / "floor.csv"));
  REQUIRE(rows.size() == 15);
  const auto value = [&](const char* key) { return plane[key]["value"].get<double>(); };
  CHECK(mean_of_column(rows, 3) == Approx(value("direct_illuminance")));
  CHECK(mean_of_column(rows, 4) == Approx(value("indirect_illuminance")));
  CHECK(mean_of_column(rows, 6) == Approx(value("mean_illuminance")));
  CHECK(mean_of_column(rows, 7) ==
        Approx(plane["direct_in_clear_air"]["mean"]["value"].get<double>()));
  double least = 1e300, most = 0;
  std::vector<double> place;
  for (const auto& row : rows) {
    CHECK(row[6] == Approx(row[3] + row[4]));
    if (row[6] < least) place = {row[0], row[1], row[2]};
    least = std::min(least, row[6]);
    most = std::max(most, row[6]);
  }
  CHECK(value("minimum") == Approx(least));
  CHECK(value("maximum") == Approx(most));
  CHECK(plane["minimum"]["position"].get<std::vector<double>>() == place);
  CHECK(value("uniformity") == Approx(least / value("mean_illuminance")));
  CHECK(plane["cells"] == Json({5, 3}));
  CHECK(file_text(folder.path() / "planes" / "floor.png").substr(1, 3) == "PNG");
  CHECK(file_text(folder.path() / "planes" / "floor_direct_clear_air.png").substr(1, 3) == "PNG");
}

TEST_CASE("traced direct light confirms the computed one within its error", "[display]") {
  // Cells of 0.1 m, so that their centres stand for them to 0.1 %.
  std::string fine = smoky_room;
  fine.replace(fine.find("cells = [5, 3]"), 14, "cells = [30, 30]");
  const auto run = traced(fine, 1 << 17);
  const Readout readout(run->scene(), run->totals());
  const Json plane = planes_json(*run, readout, make_plane_maps(*run))[0];
  const double direct = plane["direct_illuminance"]["value"];
  const double seen = plane["traced_direct_illuminance"]["value"];
  const double error = plane["traced_direct_illuminance"]["standard_error"];
  CHECK(error < 0.02 * direct);
  CHECK(std::abs(seen - direct) < 4 * error + 1e-3 * direct);
}

TEST_CASE("a plane's light by source group adds up to its light", "[display]") {
  std::string two = smoky_room;
  two = "[run]\ngroups = \"emitter\"\n" + two.substr(two.find("[[material]]"));
  two += R"(
[[emitter]]
name = "panel"
shape = "rectangle"
size = [0.6, 0.3]
position = [13, 21, 2.9]
flux_lm = 500
)";
  const auto run = traced(two, 1 << 15);
  const Readout readout(run->scene(), run->totals());
  const Json plane = planes_json(*run, readout, make_plane_maps(*run))[0];
  const Json& groups = plane["by_source_group"];
  REQUIRE(groups.size() == 2);
  for (const char* key : {"direct_illuminance", "indirect_illuminance", "mean_illuminance"}) {
    const double sum =
        groups[0][key]["value"].get<double>() + groups[1][key]["value"].get<double>();
    CHECK(sum == Approx(plane[key]["value"].get<double>()));
  }
}

TEST_CASE("direct light on a plane is the same bits for one and three threads", "[display]") {
  const auto scene = scene_of(smoky_room);
  const LocalRun one(scene, 1, 1), three(scene, 1, 3);
  const PlaneMaps a = make_plane_maps(one), b = make_plane_maps(three);
  CHECK(a.planes[0].direct_lx == b.planes[0].direct_lx);
  CHECK(a.planes[0].group_direct_lx == b.planes[0].group_direct_lx);
}

TEST_CASE("patches and voxels on disk hold the run's flux, in scene coordinates", "[display]") {
  const ScratchFolder folder;
  const int cells = GENERATE(1, 3);
  const auto run = traced(smoky_room, 1 << 15, 1, cells);
  REQUIRE(write_flux_maps(folder.path(), *run).ok());
  const CompiledScene& scene = run->scene();
  const Readout readout(scene, run->totals());

  const std::string vtp = file_text(folder / "patches.vtp");
  CHECK(attribute(vtp, "NumberOfPolys") == std::to_string(scene.patch_count / 2));
  const auto incident = vtk_floats(vtp, "incident_front [lx]");
  const auto dark = vtk_floats(vtp, "incident_back [lx]");
  REQUIRE(incident.size() == scene.patch_count / 2);
  double lumens = 0, expected = 0;
  size_t at = 0;
  for (const GeometryCell& cell : scene.cells) {
    for (const TriangleRecord& t : cell.triangles) {
      const uint32_t n2 = t.subdivision * t.subdivision;
      const auto area = static_cast<double>(
          glm::length(glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])) / 2);
      for (uint32_t k = 0; k < n2; ++k, ++at) {
        lumens += static_cast<double>(incident[at]) * area / n2;
        CHECK(dark[at] == 0);  // nothing is outside
      }
    }
  }
  for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
    expected += readout.lumens(scene.blocks.surfaces, s, 0).value;
  CHECK(lumens == Approx(expected).epsilon(1e-4));

  const std::string vti = file_text(folder / "volume.vti");
  std::istringstream origin(attribute(vti, "Origin"));
  glm::dvec3 low{0};
  origin >> low.x >> low.y >> low.z;
  CHECK(glm::distance(low, glm::dvec3(10, 20, 0)) < 1e-5);
  const auto absorbed = vtk_floats(vti, "absorbed [lm/m3]");
  REQUIRE(absorbed.size() == scene.voxels.count());
  double sum = 0;
  for (const float a : absorbed) sum += static_cast<double>(a);
  CHECK(sum * std::pow(static_cast<double>(scene.voxels.edge), 3) ==
        Approx(readout.lumens(scene.blocks.media_power, 0, 0).value).epsilon(1e-4));
  CHECK(vtk_floats(vti, "vector flux [lm/m2]").size() == 3 * absorbed.size());
}

TEST_CASE("a patch drawn in patches.vtp lies where its light fell", "[display]") {
  // A beam straight down on one spot: the brightest cell's corners surround it.
  const ScratchFolder folder;
  const auto run = traced(R"(
patch_edge_m = 0.3
[[object]]
name = "floor"
shape = "quad"
corner = [5, 5, 0]
edge_u = [3, 0, 0]
edge_v = [0, 2, 0]
material = "black0"
[[emitter]]
name = "beam"
shape = "disc"
diameter = 0.001
distribution = "collimated"
position = [7.13, 5.41, 1]
flux_lm = 100
)",
                          1 << 14);
  REQUIRE(write_flux_maps(folder.path(), *run).ok());
  const std::string vtp = file_text(folder / "patches.vtp");
  const auto incident = vtk_floats(vtp, "incident_front [lx]");
  const auto brightest =
      static_cast<size_t>(std::max_element(incident.begin(), incident.end()) - incident.begin());
  // Points are doubles, connectivity is 64-bit: read through the same appended section.
  const size_t head = vtp.find("NumberOfComponents=\"3\"");
  const std::string points_element = vtp.substr(vtp.rfind('<', head), 300);
  const size_t data = vtp.find('_', vtp.find("<AppendedData")) + 1;
  const size_t points_at = data + std::stoul(attribute(points_element, "offset")) + 8;
  const std::string links = vtp.substr(vtp.find("Name=\"connectivity\""), 300);
  const size_t links_at = data + std::stoul(attribute(links, "offset")) + 8;
  const bool wide =
      vtp.substr(vtp.rfind('<', vtp.find("Name=\"connectivity\"")), 40).find("Int64") !=
      std::string::npos;
  glm::dvec2 corner[3];
  for (size_t k = 0; k < 3; ++k) {
    int64_t index = 0;
    const size_t width = wide ? 8 : 4;
    std::memcpy(&index, vtp.data() + links_at + (3 * brightest + k) * width, width);
    double p[3];
    std::memcpy(p, vtp.data() + points_at + static_cast<size_t>(index) * 24, 24);
    corner[k] = {p[0], p[1]};
    CHECK(p[2] == Approx(0).margin(1e-6));
  }
  const glm::dvec2 spot(7.13, 5.41);
  for (int k = 0; k < 3; ++k) {
    const glm::dvec2 e = corner[(k + 1) % 3] - corner[k], s = spot - corner[k];
    CHECK(e.x * s.y - e.y * s.x > -1e-3);  // counter-clockwise, so inside is to the left
  }
}

// Planes, patches and voxels in files against result.json and closed forms.
#include "actors/results/files/maps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "actors/results/files/run_results.hpp"
#include "actors/results/run/flux_store.hpp"
#include "scenes/light/geometry/patches.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A room with a point lamp, 2 m above the middle of the floor plane, and thin smoke.
const std::string measured_room = R"(
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
  CHECK(line ==
        "x,y,z,direct_lx,indirect_lx,indirect_standard_error_lx,total_lx,"
        "luminaires_direct_clear_air_lx,point_direct_lx,point_luminaires_direct_clear_air_lx,row,"
        "column");
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
  const auto run = traced(measured_room, 1 << 14);
  const PlaneMaps maps = make_plane_maps(*run);
  REQUIRE(maps.planes.size() == 1);
  const PlaneMap& map = maps.planes[0];
  REQUIRE(map.centres().size() == 15);
  for (size_t i = 0; i < map.centres().size(); ++i) {
    const glm::dvec3 d = glm::dvec3(12, 22, 2) - map.centres()[i];
    const double distance = glm::length(d);
    const double clear = 100 * d.z / (distance * distance * distance);  // 100 cd
    CHECK(map.light.point_clear_lx[i] == Approx(clear).epsilon(1e-4));
    CHECK(map.light.point_lx[i] == Approx(clear * std::exp(-0.2 * distance)).epsilon(1e-4));
  }
}

TEST_CASE("the means in a plane's table are those of result.json, and extremes are in its cells",
          "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(measured_room, 1 << 17);
  const auto done = write_report(folder.path(), *run, {"test.toml", "particles", 1});
  if (!done.ok()) FAIL(done.problem().text());
  const Json result = Json::parse(file_text(folder / "result.json"));
  const Json& plane = result["planes"][0];
  const auto rows = table_of(file_text(folder.path() / "planes" / "floor.csv"));
  REQUIRE(rows.size() == 15);
  for (size_t i = 0; i < rows.size(); ++i) {  // 5 columns along x, 3 rows along y
    CHECK(rows[i][10] == static_cast<double>(i / 5));
    CHECK(rows[i][11] == static_cast<double>(i % 5));
  }
  const auto value = [&](const char* key) { return plane[key]["value"].get<double>(); };
  CHECK(mean_of_column(rows, 3) == Approx(value("direct_illuminance")));
  CHECK(mean_of_column(rows, 4) == Approx(value("indirect_illuminance")));
  CHECK(mean_of_column(rows, 6) == Approx(value("mean_illuminance")));
  CHECK(mean_of_column(rows, 7) ==
        Approx(plane["luminaires_direct_in_clear_air"]["mean"]["value"].get<double>()));
  double mean_at_points = 0, least = 1e300, most = 0;
  std::vector<double> place;
  for (const auto& row : rows) {
    CHECK(row[6] == Approx(row[3] + row[4]));
    const double at_point = row[8] + row[4];
    if (at_point < least) place = {row[0], row[1], row[2]};
    least = std::min(least, at_point);
    most = std::max(most, at_point);
    mean_at_points += at_point / 15;
  }
  CHECK(plane["minimum"]["at"] == "grid points");
  CHECK(value("mean_at_grid_points") == Approx(mean_at_points).epsilon(1e-3));
  CHECK(value("minimum") == Approx(least));
  CHECK(value("maximum") == Approx(most));
  CHECK(plane["minimum"]["position"].get<std::vector<double>>() == place);
  CHECK(value("uniformity") == Approx(least / value("mean_at_grid_points")));
  const Json& mean = plane["mean_illuminance"];
  const double reach =
      2 * mean["standard_error"].get<double>() + mean["quadrature_bound"].get<double>();
  CHECK(mean["interval"][0].get<double>() == Approx(value("mean_illuminance") - reach));
  CHECK(mean["interval"][1].get<double>() == Approx(value("mean_illuminance") + reach));
  CHECK(plane["cells"] == Json({5, 3}));
  CHECK(file_text(folder.path() / "planes" / "floor.png").substr(1, 3) == "PNG");
  CHECK(file_text(folder.path() / "planes" / "floor_direct_clear_air.png").substr(1, 3) == "PNG");
}

TEST_CASE("traced direct light confirms the computed one within its error", "[display]") {
  const auto run = traced(measured_room, 1 << 17);
  const Readout readout(run->scene(), run->totals());
  const Json plane = planes_json(*run, readout, make_plane_maps(*run))[0];
  const double direct = plane["direct_illuminance"]["value"];
  const double seen = plane["traced_direct_illuminance"]["value"];
  const double error = plane["traced_direct_illuminance"]["standard_error"];
  CHECK(error < 0.02 * direct);
  CHECK(std::abs(seen - direct) < 4 * error + 1e-3 * direct);
}

TEST_CASE("a plane's light by source group adds up to its light", "[display]") {
  std::string two = measured_room;
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
  const auto scene = scene_of(measured_room);
  const LocalRun one(scene, 1, 1), three(scene, 1, 3);
  const PlaneMaps a = make_plane_maps(one), b = make_plane_maps(three);
  CHECK(a.planes[0].light.mean_lx == b.planes[0].light.mean_lx);
  CHECK(a.planes[0].light.group_lx == b.planes[0].light.group_lx);
  CHECK(a.planes[0].light.bound_lx == b.planes[0].light.bound_lx);
}

TEST_CASE("a plane's mean is that over its area, within the stated bound", "[display]") {
  // A point 2 m above the middle of a square of 3 m: the flux through it has a closed form.
  std::string clear = measured_room;
  clear = clear.substr(0, clear.find("[[medium]]")) + clear.substr(clear.find("[[plane]]"));
  const int cells = GENERATE(1, 2, 7);
  const auto at = clear.find("cells = [5, 3]");
  clear.replace(at, 14, "cells = [" + std::to_string(cells) + ", 3]");
  const LocalRun run(scene_of(clear), 1, 2);
  const PlaneLight light = make_plane_maps(run).planes[0].light;
  const double a = 1.5, h = 2;
  const double solid_angle = 4 * std::asin(a * a / (a * a + h * h));
  const double expected = 100 * solid_angle / 9;
  double mean = 0;
  for (const double lx : light.mean_lx) mean += lx / static_cast<double>(light.mean_lx.size());
  INFO(cells << " cells: " << mean << " +- " << light.bound_lx << ", expected " << expected);
  CHECK(std::abs(mean - expected) <= light.bound_lx + 1e-5 * expected);
  CHECK(light.bound_lx <= limits::plane_tolerance * expected);
  CHECK(light.group_lx[0] == Approx(mean));
}

TEST_CASE("the mean of a plane in shadows of boxes is correct although cells' centres are not",
          "[display]") {
  // A point 2 m up and a shelf that shades a square of the floor exactly, with shadow edges beside
  // cells' centres.
  std::string shaded = measured_room;
  shaded = shaded.substr(0, shaded.find("[[medium]]")) + shaded.substr(shaded.find("[[plane]]"));
  shaded += R"(
[[object]]
name = "shelf"
shape = "quad"
corner = [12, 22, 1]
edge_u = [0.53, 0, 0]
edge_v = [0, 0.47, 0]
material = "grey"
)";
  const LocalRun run(scene_of(shaded), 1, 2);
  const PlaneLight light = make_plane_maps(run).planes[0].light;
  const auto quarter = [](double a, double b, double h) {
    return std::asin(a * b / std::sqrt((a * a + h * h) * (b * b + h * h)));
  };
  // Seen from the lamp, the shelf covers a quarter of a rectangle of twice its size on the floor.
  const double expected = 100 * (4 * quarter(1.5, 1.5, 2) - quarter(1.06, 0.94, 2)) / 9;
  double mean = 0, at_centres = 0;
  for (const double lx : light.mean_lx) mean += lx / 15;
  for (const double lx : light.point_lx) at_centres += lx / 15;
  INFO(mean << " +- " << light.bound_lx << ", at centres " << at_centres << ", expected "
            << expected);
  CHECK(std::abs(mean - expected) <= light.bound_lx);
  CHECK(light.bound_lx < 3e-3 * expected);
  CHECK(std::abs(at_centres - expected) > 5 * light.bound_lx);  // the mean before quadrature
}

TEST_CASE("light of signs and flames is excluded from that of luminaires in clear air",
          "[display]") {
  std::string with_sign = measured_room;
  with_sign += R"(
[[sign]]
name = "exit"
position = [12, 20.02, 2.2]
facing = [0, 1, 0]
width = 0.4
height = 0.2
plain = "white"
smallest_detail = 0.02
mains_white = 5000
mains_green = 500
emergency_white = 50
emergency_green = 5
[[medium]]
name = "flame"
kind = "bounded"
body = "ellipsoid"
position = [13, 23, 0.8]
radii = [0.2, 0.2, 0.2]
extinction = 0.5
albedo = 0
[medium.emission]
power_w = 50000
temperature_k = 1400
[[probe]]
name = "p"
position = [11, 21, 0]
)";
  const auto plain = traced(measured_room, 1 << 14);
  const auto run = traced(with_sign, 1 << 14);
  const PlaneMap without = make_plane_maps(*plain).planes[0];
  const PlaneMap with = make_plane_maps(*run).planes[0];
  for (size_t i = 0; i < with.centres().size(); ++i) {
    CHECK(with.light.point_clear_lx[i] == Approx(without.light.point_clear_lx[i]).epsilon(1e-6));
    CHECK(with.light.point_lx[i] > 1.05 * without.light.point_lx[i]);
  }
  const Json result = result_json(*run, {"test.toml", "particles", 1});
  const Json& clear = result["planes"][0]["luminaires_direct_in_clear_air"];
  CHECK(clear["operation"] == "mains");
  const glm::dvec3 d(1, 1, 2);
  const double expected = 100 * d.z / std::pow(glm::length(d), 3);
  CHECK(result["probes"][0]["luminaires_direct_in_clear_air"]["value"].get<double>() ==
        Approx(expected).epsilon(1e-4));
  CHECK(result["probes"][0]["direct_illuminance"]["value"].get<double>() > 1.1 * expected);
}

TEST_CASE("a run of one batch says that an error needs two", "[display]") {
  const TemporaryFolder folder;
  const auto run = traced(measured_room, 1);
  REQUIRE(run->traced() == 1);
  const auto result = write_report(folder.path(), *run, {"test.toml", "particles", 1});
  REQUIRE(result.ok());
  const std::string text = summary_text(result.value());
  INFO(text);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("an error needs two batches") != std::string::npos);
  CHECK(result.value()["standard_errors_unknown"].get<std::string>().find("two batches") !=
        std::string::npos);
  CHECK(result.value()["planes"][0]["mean_illuminance"]["standard_error"].is_null());
  const std::string csv = file_text(folder.path() / "planes" / "floor.csv");
  CHECK(csv.find("nan") == std::string::npos);
  CHECK(csv.find("needs two batches") != std::string::npos);
  const auto two = traced(measured_room, 8 * run->scene().batch_particles);
  CHECK_FALSE(result_json(*two, {"test.toml", "particles", 1}).contains("standard_errors_unknown"));
}

TEST_CASE("rates of a resumed run cover all its time, or the part whose time is known",
          "[display]") {
  const auto first = traced(measured_room, 1 << 17);
  const TemporaryFolder folder;
  REQUIRE(save_flux(folder / "flux.lux", *first).ok());
  const auto go_on = [&](std::optional<double> earlier_s) {
    auto run = std::make_unique<LocalRun>(scene_of(measured_room), 11, 1);
    REQUIRE(load_flux(folder / "flux.lux", *run).ok());
    if (earlier_s) run->add_earlier_seconds(*earlier_s);
    StopRule stop;
    stop.particles = 1 << 18;
    run->run(stop, std::atomic<bool>{false}, [](const Progress&) {});
    return result_json(*run, {"test.toml", "particles", 1});
  };
  const Json known = go_on(1000.0), unknown = go_on(std::nullopt);
  const auto rate = [](const Json& r) { return r["particles_per_second"]["value"].get<double>(); };
  const auto seconds = [](const Json& r) { return r["seconds"]["value"].get<double>(); };
  CHECK(seconds(known) > 1000);
  CHECK(rate(known) == Approx((1 << 18) / seconds(known)));
  CHECK_FALSE(known.contains("timing"));
  CHECK(known["figure_of_merit"]["value"].is_number());
  CHECK(rate(unknown) * seconds(unknown) == Approx(1 << 17));
  CHECK(unknown["timed_particles"] == 1 << 17);
  CHECK(unknown["figure_of_merit"]["value"].is_null());
  CHECK(unknown.contains("timing"));
}

TEST_CASE("patches and voxels in files hold the run's flux, in scene coordinates", "[display]") {
  const TemporaryFolder folder;
  const int cells = GENERATE(1, 3);
  const auto run = traced(measured_room, 1 << 15, 1, cells);
  REQUIRE(write_flux_maps(folder.path(), *run).ok());
  const CompiledScene& scene = run->scene();
  const Readout readout(scene, run->totals());

  const std::string vtp = file_text(folder / "patches.vtp");
  CHECK(attribute(vtp, "NumberOfPolys") == std::to_string(scene.patch_count / 2));
  CHECK(attribute(vtp, "NumberOfTuples") == std::to_string(scene.surfaces.size()));
  const auto incident = vtk_floats(vtp, "incident_front_lx");
  const auto dark = vtk_floats(vtp, "incident_back_lx");
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
  const auto absorbed = vtk_floats(vti, "absorbed_lm_m3");
  REQUIRE(absorbed.size() == scene.voxels.count());
  double sum = 0;
  for (const float a : absorbed) sum += static_cast<double>(a);
  CHECK(sum * std::pow(static_cast<double>(scene.voxels.edge), 3) ==
        Approx(readout.lumens(scene.blocks.media_power, 0, 0).value).epsilon(1e-4));
  CHECK(vtk_floats(vti, "vector_flux_lm_m2").size() == 3 * absorbed.size());
}

TEST_CASE("a patch drawn in patches.vtp lies where its light fell", "[display]") {
  // A beam straight down onto one spot: the corners of the brightest cell surround it.
  const TemporaryFolder folder;
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
  const auto incident = vtk_floats(vtp, "incident_front_lx");
  const auto brightest =
      static_cast<size_t>(std::max_element(incident.begin(), incident.end()) - incident.begin());
  // Points are doubles, connectivity is 64-bit: read from the same appended section.
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

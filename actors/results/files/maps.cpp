// Maps of planes. Maps and means are over the area of cells; minimum, maximum and uniformity are
// over grid points, the centres of cells, as the codes require. The indirect light of a grid point
// is its cell's mean.
#include "actors/results/files/maps.hpp"

#include <algorithm>
#include <cmath>

#include "actors/results/files/plane_cells.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/files/run_state.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/false_colour_png.hpp"
#include "actors/results/run/parallel_for.hpp"

namespace luxodus {

namespace {

/// The mean over the cells that are not left out.
double mean_of(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return sum / count;
}

/// The smallest and the largest of the cells that are not left out; the first cell twice if all
/// are.
std::pair<size_t, size_t> extremes_of(const std::vector<double>& values) {
  const auto first =
      std::find_if_not(values.begin(), values.end(), [](double v) { return std::isnan(v); });
  const size_t start = first == values.end() ? 0 : static_cast<size_t>(first - values.begin());
  std::pair<size_t, size_t> out{start, start};
  for (size_t i = start; i < values.size(); ++i) {
    if (values[i] < values[out.first]) out.first = i;
    if (values[i] > values[out.second]) out.second = i;
  }
  return out;
}

double area_of(const CompiledPlane& plane) {
  return plane.cell_area_m2 * plane.cells_u * plane.cells_v;
}

/// The area of the cells that are not left out.
double area_of(const CompiledPlane& plane, const PlaneMap& map) {
  return plane.cell_area_m2 * static_cast<double>(map.centres().size() - map.left_out.size());
}

/// Lumens that the run has traced to the cells of a plane that are not left out [lm]. The error is
/// that of the whole plane: cells in bodies have almost no light, and so add almost no error.
Estimate traced_lumens(const CompiledScene& scene, const Readout& readout, const PlaneMap& map,
                       uint32_t index, uint32_t quantity, int group = -1) {
  Estimate out = readout.lumens(scene.blocks.planes, index, quantity, group);
  for (const uint32_t cell : map.left_out) {
    const uint32_t bin = scene.planes[index].first_bin + cell;
    out.value -= readout.lumens(scene.blocks.plane_cells, bin, quantity, group).value;
  }
  return out;
}

// ---- result.json -------------------------------------------------------------------------------

Json lux(const Estimate& e) {
  return measured_json(e.value, e.standard_error, "lx");
}

Json with_position(Json item, const glm::dvec3& place) {
  item["position"] = vector_json(place);
  return item;
}

Json at_grid_points(Json item) {
  item["at"] = "grid points";
  return item;
}

/// A deterministic value, with the bound of its quadrature error.
Json bounded_json(double value, double bound) {
  Json item = exact_json(value, "lx");
  item["quadrature_bound"] = number_json(bound);
  return item;
}

/// A mean over a plane: standard error of the traced part, bound of the computed part, and its
/// interval: two standard errors plus the bound.
Json mean_json(const Estimate& mean, double bound) {
  Json item = lux(mean);
  item["quadrature_bound"] = number_json(bound);
  const double reach = 2 * mean.standard_error + bound;
  item["interval"] = {number_json(mean.value - reach), number_json(mean.value + reach)};
  return item;
}

/// The quantity of the codes: luminaires only, in clear air; the mean over the area, extremes at
/// the grid points.
Json clear_air_json(const PlaneMap& map, Operation operation) {
  const std::vector<double>& e = map.light.point_clear_lx;
  const auto [low, high] = extremes_of(e);
  const auto at = [&](size_t cell) {
    return at_grid_points(with_position(exact_json(e[cell], "lx"), map.centres()[cell]));
  };
  const double mean = mean_of(e);
  return {{"operation", name_of(operation)},
          {"mean", bounded_json(mean_of(map.light.mean_clear_lx), map.light.bound_clear_lx)},
          {"mean_at_grid_points", exact_json(mean, "lx")},
          {"minimum", at(low)},
          {"maximum", at(high)},
          {"uniformity", at_grid_points(exact_json(mean > 0 ? e[low] / mean : std::nan(""), "1"))}};
}

Estimate plus_exact(double exact, const Estimate& e) {
  return {exact + e.value, e.standard_error};
}

/// Minimum over mean; the error to first order, with both taken as independent.
Json uniformity_json(const Estimate& least, const Estimate& mean) {
  if (!(mean.value > 0)) return measured_json(std::nan(""), std::nan(""), "1");
  const double ratio = least.value / mean.value;
  const double error = std::hypot(least.standard_error, ratio * mean.standard_error) / mean.value;
  return measured_json(ratio, error, "1");
}

Json groups_json(const CompiledScene& scene, const Readout& readout, const PlaneMap& map,
                 uint32_t index) {
  Json out = Json::array();
  const double per_area = 1 / area_of(scene.planes[index], map);
  for (size_t g = 0; g < scene.groups.size(); ++g) {
    const Estimate indirect =
        traced_lumens(scene, readout, map, index, 1, static_cast<int>(g)) * per_area;
    out.push_back(
        {{"name", scene.groups[g].name},
         {"direct_illuminance", exact_json(map.light.group_lx[g], "lx")},
         {"luminaires_direct_in_clear_air", exact_json(map.light.group_clear_lx[g], "lx")},
         {"indirect_illuminance", lux(indirect)},
         {"mean_illuminance", lux(plus_exact(map.light.group_lx[g], indirect))}});
  }
  return out;
}

Json plane_json(const CompiledScene& scene, const Readout& readout, const PlaneMap& map,
                uint32_t index) {
  const PlaneMeasure& plane = scene.description->planes[index];
  const double per_area = 1 / area_of(scene.planes[index], map);
  const double direct = mean_of(map.light.mean_lx);
  const Estimate indirect = traced_lumens(scene, readout, map, index, 1) * per_area;
  const Estimate mean = plus_exact(direct, indirect);
  const Estimate mean_at_points = plus_exact(mean_of(map.light.point_lx), indirect);
  std::vector<double> points;
  for (size_t i = 0; i < map.centres().size(); ++i) points.push_back(map.at_point(i).value);
  const auto [low, high] = extremes_of(points);
  Json out = {
      {"name", plane.name},
      {"cells", {plane.cells_u, plane.cells_v}},
      {"corner", vector_json(plane.corner)},
      {"normal", vector_json(glm::normalize(glm::cross(plane.edge_u, plane.edge_v)))},
      {"area", exact_json(area_of(scene.planes[index]), "m2")},
      {"cells_in_bodies", map.left_out.size()},
      {"mean_illuminance", mean_json(mean, map.light.bound_lx)},
      {"mean_at_grid_points", lux(mean_at_points)},
      {"minimum", at_grid_points(with_position(lux(map.at_point(low)), map.centres()[low]))},
      {"maximum", at_grid_points(with_position(lux(map.at_point(high)), map.centres()[high]))},
      {"uniformity", at_grid_points(uniformity_json(map.at_point(low), mean_at_points))},
      {"direct_illuminance", bounded_json(direct, map.light.bound_lx)},
      {"luminaires_direct_in_clear_air", clear_air_json(map, scene.scenario.operation)},
      {"indirect_illuminance", lux(indirect)},
      {"traced_direct_illuminance", lux(traced_lumens(scene, readout, map, index, 0) * per_area)}};
  if (scene.groups.size() > 1) out["by_source_group"] = groups_json(scene, readout, map, index);
  return out;
}

// ---- files -------------------------------------------------------------------------------------

/// `columns`: cells along the plane's first edge.
Result<void> write_table(const std::filesystem::path& path, const PlaneMap& map, size_t columns) {
  // Means of cells, then the values at their centres, then where the cell is in the grid.
  CsvTable table({"x", "y", "z", "direct_lx", "indirect_lx", "indirect_standard_error_lx",
                  "total_lx", "luminaires_direct_clear_air_lx", "point_direct_lx",
                  "point_luminaires_direct_clear_air_lx", "row", "column"});
  for (size_t i = 0; i < map.centres().size(); ++i) {
    const glm::dvec3& p = map.centres()[i];
    table.cell(p.x).cell(p.y).cell(p.z).cell(map.light.mean_lx[i]);
    table.cell(map.indirect_lx[i].value);
    if (std::isnan(map.indirect_lx[i].standard_error) && !std::isnan(map.indirect_lx[i].value))
      table.cell("needs two batches");
    else
      table.cell(map.indirect_lx[i].standard_error);
    table.cell(map.total(i).value).cell(map.light.mean_clear_lx[i]);
    table.cell(map.light.point_lx[i]).cell(map.light.point_clear_lx[i]);
    table.cell(static_cast<int64_t>(i / columns)).cell(static_cast<int64_t>(i % columns));
    table.end_row();
  }
  return write_csv(path, table);
}

/// Contour levels that lighting designers know, as far as they cut the map: those of the codes
/// first, or 1, 2, 5 per decade where fewer than three of them fit.
std::vector<double> contour_levels(const std::vector<double>& values) {
  const auto [low, high] = extremes_of(values);
  std::vector<double> code, fine;
  for (int decade = -4; decade <= 5; ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double level = digit * std::pow(10.0, decade);
      if (level <= values[low] || level >= values[high]) continue;
      fine.push_back(level);
      if (digit != 2 && level >= 0.5) code.push_back(level);
    }
  }
  return code.size() >= 3 ? code : fine;
}

/// Name and start of a picture's axis: a scene coordinate if the edge runs along one.
struct PictureAxis {
  std::string label;
  double start = 0;
};

PictureAxis picture_axis(const glm::dvec3& corner, const glm::dvec3& edge, const char* otherwise) {
  constexpr const char* names[] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a) {
    if (edge[a] >= glm::length(edge) * (1 - 1e-9)) return {names[a], corner[a]};
  }
  return {otherwise, 0};
}

std::string signs_of(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

FalseColourPicture picture_of(const CompiledScene& scene, const PlaneMeasure& plane) {
  FalseColourPicture p;
  p.subtitle =
      (scene.description->title.empty() ? scene.description->name : scene.description->title) +
      ", scenario \"" + scene.scenario.name + "\"";
  p.quantity = "Illuminance";
  p.unit = "lx";
  const PictureAxis u = picture_axis(plane.corner, plane.edge_u, "along the first edge");
  const PictureAxis v = picture_axis(plane.corner, plane.edge_v, "along the second edge");
  p.label_u = u.label;
  p.label_v = v.label;
  p.origin_u_m = u.start;
  p.origin_v_m = v.start;
  p.cells_u = plane.cells_u;
  p.cells_v = plane.cells_v;
  p.length_u_m = glm::length(plane.edge_u);
  p.length_v_m = glm::length(plane.edge_v);
  return p;
}

/// `stem`: path of its files without their endings.
Result<void> write_pictures(const std::filesystem::path& stem, const LocalRun& run, size_t index,
                            const PlaneMap& map) {
  const CompiledScene& scene = run.scene();
  const PlaneMeasure& plane = scene.description->planes[index];
  FalseColourPicture p = picture_of(scene, plane);
  p.title = "Plane \"" + plane.name + "\"";
  double worst = 0;
  for (size_t i = 0; i < map.centres().size(); ++i) {
    p.values.push_back(map.total(i).value);
    if (std::isnan(map.indirect_lx[i].value)) continue;  // left out
    const double error = map.indirect_lx[i].standard_error;
    worst = std::isnan(error) ? -1 : std::max(worst, error);
  }
  p.contours = contour_levels(p.values);
  p.notes = {"Direct light: means over the cells, computed; indirect light from " +
                 std::to_string(run.particles()) + " particles",
             worst >= 0 ? "Largest standard error of a cell: " + signs_of(worst, 2) + " lx"
                        : std::string("Standard errors need two batches")};
  if (auto ok = write_false_colour_png(std::filesystem::path(stem) += ".png", p); !ok)
    return ok.problem();
  p.title += ", direct light of luminaires in clear air";
  p.values = map.light.mean_clear_lx;
  p.contours = contour_levels(p.values);
  p.notes = {"Luminaires of " + std::string(name_of(scene.scenario.operation)) +
             " operation, without signs, flames, reflected light and smoke, as codes calculate"};
  return write_false_colour_png(std::filesystem::path(stem) += "_direct_clear_air.png", p);
}

}  // namespace

PlaneMaps make_plane_maps(const LocalRun& run, const ShareDone& progress) {
  const CompiledScene& scene = run.scene();
  const Readout readout(scene, run.totals());
  int64_t rows = 0, before = 0;  // rows of all planes, and of finished planes
  for (const PlaneMeasure& plane : scene.description->planes) rows += plane.cells_v;
  PlaneMaps maps;
  for (size_t i = 0; i < scene.planes.size(); ++i) {
    PlaneMap map;
    const std::vector<char> left_out = cells_in_bodies(scene, run.rows(), i);
    const auto finished = [&](int64_t done) {
      if (progress) progress(static_cast<double>(before + done) / static_cast<double>(rows));
    };
    map.light = plane_light(scene, i, run.rows(), finished, left_out);
    before += scene.description->planes[i].cells_v;
    const CompiledPlane& plane = scene.planes[i];
    for (uint32_t cell = 0; cell < map.centres().size(); ++cell) {
      map.indirect_lx.push_back(
          readout.lumens(scene.blocks.plane_cells, plane.first_bin + cell, 1) *
          (1 / plane.cell_area_m2));
      if (left_out[cell] == 0) continue;
      map.left_out.push_back(cell);
      map.indirect_lx.back() = {std::nan(""), std::nan("")};
    }
    maps.planes.push_back(std::move(map));
  }
  return maps;
}

Json planes_json(const LocalRun& run, const Readout& readout, const PlaneMaps& maps) {
  Json out = Json::array();
  for (uint32_t i = 0; i < maps.planes.size(); ++i) {
    out.push_back(plane_json(run.scene(), readout, maps.planes[i], i));
    out.back()["files"] = files_of_plane(*run.scene().description, i);
  }
  return out;
}

Result<void> write_plane_maps(const std::filesystem::path& folder, const LocalRun& run,
                              const PlaneMaps& maps) {
  const std::vector<std::string> names = result_names(*run.scene().description).planes;
  for (size_t i = 0; i < maps.planes.size(); ++i) {
    const std::filesystem::path stem = folder / names[i];
    const PlaneMeasure& plane = run.scene().description->planes[i];
    if (auto ok = write_table(std::filesystem::path(stem) += ".csv", maps.planes[i],
                              static_cast<size_t>(plane.cells_u));
        !ok)
      return ok.problem();
    if (!is_drawn(plane)) continue;
    if (auto ok = write_pictures(stem, run, i, maps.planes[i]); !ok) return ok.problem();
  }
  return {};
}

}  // namespace luxodus

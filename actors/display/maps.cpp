// Planes. A cell's direct light is that of its centre; the mean of cells stands for the plane. The
// indirect light of a cell is a mean over its area.
#include "actors/display/maps.hpp"

#include <algorithm>
#include <cmath>

#include "actors/display/result_files.hpp"
#include "actors/inspect/plane_cells.hpp"
#include "actors/source/rows.hpp"
#include "scenes/format/csv.hpp"
#include "scenes/format/false_colour_png.hpp"

namespace luxodus {

namespace {

glm::dvec3 centre_of_cell(const PlaneMeasure& plane, int u, int v) {
  return plane.corner + plane.edge_u * ((u + 0.5) / plane.cells_u) +
         plane.edge_v * ((v + 0.5) / plane.cells_v);
}

/// Of the cells that are not left out.
double mean_of(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return sum / count;
}

/// Smallest and largest of the cells that are not left out; the first where all are.
std::pair<size_t, size_t> extremes_of(const std::vector<double>& values) {
  const auto first = std::find_if(values.begin(), values.end(), [](double v) { return v == v; });
  const size_t start = first == values.end() ? 0 : static_cast<size_t>(first - values.begin());
  std::pair<size_t, size_t> out{start, start};
  for (size_t i = start; i < values.size(); ++i) {
    if (values[i] < values[out.first]) out.first = i;
    if (values[i] > values[out.second]) out.second = i;
  }
  return out;
}

/// Takes cells out of a map. At their middles, inside of bodies, is no direct light, so the sums
/// over groups hold for the rest, over less area.
void leave_out(const std::vector<char>& cells, PlaneMap& map) {
  const auto nothing = std::nan("");
  for (size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == 0) continue;
    map.left_out.push_back(static_cast<uint32_t>(i));
    map.direct_lx[i] = map.direct_in_clear_lx[i] = nothing;
    map.indirect_lx[i] = {nothing, nothing};
  }
  const auto all = static_cast<double>(cells.size());
  const double more = all / (all - static_cast<double>(map.left_out.size()));
  for (auto* groups : {&map.group_direct_lx, &map.group_in_clear_lx})
    for (double& lux : *groups) lux *= more;
}

/// Direct light of all cells. Sums of groups are kept by row and added in order: the same bits for
/// any number of threads.
void fill_direct(const LocalRun& run, size_t index, PlaneMap& map,
                 const RowRunner::Finished& finished) {
  const CompiledScene& scene = run.scene();
  const PlaneMeasure& plane = scene.description->planes[index];
  const glm::vec3 normal = scene.planes[index].normal;
  const auto columns = static_cast<size_t>(plane.cells_u);
  const auto rows = static_cast<size_t>(plane.cells_v);
  const size_t groups = scene.groups.size();
  const bool has_media = scene.features.media != MediaNeed::none;
  map.centres.resize(rows * columns);
  map.direct_lx.resize(rows * columns);
  map.direct_in_clear_lx.resize(rows * columns);
  std::vector<double> direct_sums(rows * groups, 0), clear_sums(rows * groups, 0);
  const auto do_row = [&](const GeometryAccess& access, int64_t row) {
    const auto v = static_cast<size_t>(row);
    for (size_t u = 0; u < columns; ++u) {
      const size_t cell = v * columns + u;
      map.centres[cell] = centre_of_cell(plane, static_cast<int>(u), static_cast<int>(v));
      const glm::vec3 place(map.centres[cell] - scene.local_origin);
      const DirectLight direct = direct_light_at(scene, access, place, normal, {});
      DirectOptions in_clear_air;
      in_clear_air.media = false;
      const DirectLight clear =
          has_media ? direct_light_at(scene, access, place, normal, in_clear_air) : direct;
      map.direct_lx[cell] = direct.total_lx();
      map.direct_in_clear_lx[cell] = clear.total_lx();
      for (size_t g = 0; g < groups; ++g) {
        direct_sums[v * groups + g] += direct.illuminance_lx[g];
        clear_sums[v * groups + g] += clear.illuminance_lx[g];
      }
    }
  };
  const auto make = [&](const GeometryAccess& access) {
    return [&, access](int64_t row) { do_row(access, row); };
  };
  run.rows().run(plane.cells_v, make, finished);
  map.group_direct_lx.assign(groups, 0);
  map.group_in_clear_lx.assign(groups, 0);
  const double share = 1 / static_cast<double>(rows * columns);
  for (size_t i = 0; i < direct_sums.size(); ++i) {
    map.group_direct_lx[i % groups] += direct_sums[i] * share;
    map.group_in_clear_lx[i % groups] += clear_sums[i] * share;
  }
}

double area_of(const CompiledPlane& plane) {
  return plane.cell_area_m2 * plane.cells_u * plane.cells_v;
}

/// Of the cells that are not left out.
double area_of(const CompiledPlane& plane, const PlaneMap& map) {
  return plane.cell_area_m2 * static_cast<double>(map.centres.size() - map.left_out.size());
}

/// What the run has traced to the cells of a plane that are not left out [lm]. The error is that of
/// the whole plane: those in bodies have next to no light, and so no part in it.
Estimate traced_lumens(const CompiledScene& scene, const Readout& readout, const PlaneMap& map,
                       uint32_t index, uint32_t quantity, int group = -1) {
  Estimate out = readout.lumens(scene.blocks.planes, index, quantity, group);
  for (const uint32_t cell : map.left_out)
    out.value -=
        readout
            .lumens(scene.blocks.plane_cells, scene.planes[index].first_bin + cell, quantity, group)
            .value;
  return out;
}

// ---- result.json -------------------------------------------------------------------------------

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json lux(const Estimate& e) {
  return measured_json(e.value, e.standard_error, "lx");
}

Json with_position(Json item, const glm::dvec3& place) {
  item["position"] = vector_json(place);
  return item;
}

/// Smallest and largest of exact values, and where.
Json clear_air_json(const PlaneMap& map) {
  const auto& e = map.direct_in_clear_lx;
  const auto [low, high] = extremes_of(e);
  const double mean = mean_of(e);
  return {{"mean", exact_json(mean, "lx")},
          {"minimum", with_position(exact_json(e[low], "lx"), map.centres[low])},
          {"maximum", with_position(exact_json(e[high], "lx"), map.centres[high])},
          {"uniformity", exact_json(mean > 0 ? e[low] / mean : std::nan(""), "1")}};
}

Estimate plus_exact(double exact, const Estimate& e) {
  return {exact + e.value, e.standard_error};
}

/// Minimum over mean; the error to first order, the two taken as independent.
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
    out.push_back({{"name", scene.groups[g].name},
                   {"direct_illuminance", exact_json(map.group_direct_lx[g], "lx")},
                   {"direct_in_clear_air", exact_json(map.group_in_clear_lx[g], "lx")},
                   {"indirect_illuminance", lux(indirect)},
                   {"mean_illuminance", lux(plus_exact(map.group_direct_lx[g], indirect))}});
  }
  return out;
}

Json plane_json(const CompiledScene& scene, const Readout& readout, const PlaneMap& map,
                uint32_t index) {
  const PlaneMeasure& plane = scene.description->planes[index];
  const double per_area = 1 / area_of(scene.planes[index], map);
  const double direct = mean_of(map.direct_lx);
  const Estimate indirect = traced_lumens(scene, readout, map, index, 1) * per_area;
  const Estimate mean = plus_exact(direct, indirect);
  std::vector<double> totals;
  for (size_t i = 0; i < map.centres.size(); ++i) totals.push_back(map.total(i).value);
  const auto [low, high] = extremes_of(totals);
  Json out = {
      {"name", plane.name},
      {"cells", {plane.cells_u, plane.cells_v}},
      {"corner", vector_json(plane.corner)},
      {"normal", vector_json(glm::normalize(glm::cross(plane.edge_u, plane.edge_v)))},
      {"area", exact_json(area_of(scene.planes[index]), "m2")},
      {"cells_in_bodies", map.left_out.size()},
      {"mean_illuminance", lux(mean)},
      {"minimum", with_position(lux(map.total(low)), map.centres[low])},
      {"maximum", with_position(lux(map.total(high)), map.centres[high])},
      {"uniformity", uniformity_json(map.total(low), mean)},
      {"direct_illuminance", exact_json(direct, "lx")},
      {"direct_in_clear_air", clear_air_json(map)},
      {"indirect_illuminance", lux(indirect)},
      {"traced_direct_illuminance", lux(traced_lumens(scene, readout, map, index, 0) * per_area)}};
  if (scene.groups.size() > 1) out["by_source_group"] = groups_json(scene, readout, map, index);
  return out;
}

// ---- files -------------------------------------------------------------------------------------

Result<Done> write_table(const std::filesystem::path& path, const PlaneMap& map) {
  CsvTable table({"x", "y", "z", "direct_lx", "indirect_lx", "indirect_se_lx", "total_lx",
                  "direct_clear_air_lx"});
  for (size_t i = 0; i < map.centres.size(); ++i) {
    const glm::dvec3& p = map.centres[i];
    table.cell(p.x).cell(p.y).cell(p.z).cell(map.direct_lx[i]);
    table.cell(map.indirect_lx[i].value).cell(map.indirect_lx[i].standard_error);
    table.cell(map.total(i).value).cell(map.direct_in_clear_lx[i]);
    table.end_row();
  }
  return write_csv(path, table);
}

/// Levels that lighting people know, where they cut the map: those of the codes first, 1, 2, 5 per
/// decade where fewer than three of them fit.
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

/// Name and start of an axis of the picture: a coordinate of the scene where the edge runs along
/// one.
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

/// `stem`: of its files, without their endings.
Result<Done> write_pictures(const std::filesystem::path& stem, const LocalRun& run, size_t index,
                            const PlaneMap& map) {
  const CompiledScene& scene = run.scene();
  const PlaneMeasure& plane = scene.description->planes[index];
  FalseColourPicture p = picture_of(scene, plane);
  p.title = "Plane \"" + plane.name + "\"";
  double worst = 0;
  for (size_t i = 0; i < map.centres.size(); ++i) {
    p.values.push_back(map.total(i).value);
    worst = std::max(worst, map.indirect_lx[i].standard_error);
  }
  p.contours = contour_levels(p.values);
  p.notes = {"Direct light computed at the centres of the cells; indirect light from " +
                 std::to_string(run.particles()) + " particles",
             "Largest standard error of a cell: " + signs_of(worst, 2) + " lx"};
  if (auto ok = write_false_colour_png(std::filesystem::path(stem) += ".png", p); !ok.ok())
    return ok;
  p.title += ", direct light in clear air";
  p.values = map.direct_in_clear_lx;
  p.contours = contour_levels(p.values);
  p.notes = {
      "Without reflected light and without smoke, as codes for emergency lighting calculate"};
  return write_false_colour_png(std::filesystem::path(stem) += "_direct_clear_air.png", p);
}

}  // namespace

PlaneMaps make_plane_maps(const LocalRun& run, const ShareDone& progress) {
  const CompiledScene& scene = run.scene();
  const Readout readout(scene, run.totals());
  int64_t rows = 0, before = 0;  // of all planes, of those done
  for (const PlaneMeasure& plane : scene.description->planes) rows += plane.cells_v;
  PlaneMaps maps;
  for (size_t i = 0; i < scene.planes.size(); ++i) {
    PlaneMap map;
    fill_direct(run, i, map, [&](int64_t done) {
      if (progress) progress(static_cast<double>(before + done) / static_cast<double>(rows));
    });
    before += scene.description->planes[i].cells_v;
    const CompiledPlane& plane = scene.planes[i];
    for (uint32_t cell = 0; cell < map.centres.size(); ++cell) {
      map.indirect_lx.push_back(
          readout.lumens(scene.blocks.plane_cells, plane.first_bin + cell, 1) *
          (1 / plane.cell_area_m2));
    }
    leave_out(cells_in_bodies(scene, run.rows(), i), map);
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

Result<Done> write_plane_maps(const std::filesystem::path& folder, const LocalRun& run,
                              const PlaneMaps& maps) {
  const std::vector<std::string> names = result_names(*run.scene().description).planes;
  for (size_t i = 0; i < maps.planes.size(); ++i) {
    const std::filesystem::path stem = folder / names[i];
    if (auto ok = write_table(std::filesystem::path(stem) += ".csv", maps.planes[i]); !ok.ok())
      return ok;
    if (!is_drawn(run.scene().description->planes[i])) continue;
    if (auto ok = write_pictures(stem, run, i, maps.planes[i]); !ok.ok()) return ok;
  }
  return Done{};
}

}  // namespace luxodus

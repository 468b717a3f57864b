// Direct light: point and area sources, computed deterministically and traced; and its attenuation
// by smoke and glass. (CIE 171:2006, 5.2, 5.3 and 5.5 are of this kind.)
#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

constexpr double bare_lamp_lm = 1000;
constexpr double computed = 1e-3;  // tolerance of computed direct light
constexpr double cell = 0.25;      // edge of the cells that the table averages over [m]
constexpr const char* points_table = "area_light_points.csv";

/// A lamp in a black room, of which only a large floor exists.
SceneDescription lamp_of(const Row& row) {
  SceneDescription scene;
  const std::vector<double> r = row.numbers("rect_x0;x1;y0;y1");
  Emitter& e = add_rectangle(scene, {(r[0] + r[1]) / 2, (r[2] + r[3]) / 2, row.number("height")},
                             {0, 0, -1}, r[1] - r[0], r[3] - r[2], 0);
  e.radiometric = false;
  e.mains_flux = bare_lamp_lm;
  constexpr double floor_edge = 24, h = floor_edge / 2;
  add_quad(scene, "floor", {-h, -h, 0}, {floor_edge, 0, 0}, {0, floor_edge, 0}, add_grey(scene, 0));
  return scene;
}

/// 100 cd in every direction over a large floor.
SceneDescription candle_at(double height) {
  SceneDescription scene;
  Emitter& e = add_point(scene, {0, 0, height}, 0);
  e.radiometric = false;
  e.mains_flux = 100 * 4 * pi;
  add_quad(scene, "floor", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, add_grey(scene, 0));
  return scene;
}

std::string place_of(const Row& row) {
  return "E at " + row.text("x") + ", " + row.text("y");
}

/// Horizontal and upright receivers in clear air.
PreparedCase receivers_plan(const std::vector<Row>& points) {
  PreparedCase plan;
  const auto lamp = lit(lamp_of(points.front()));
  for (const Row& row : points) {
    const double x = row.number("x"), y = row.number("y");
    plan.compute_direct(place_of(row), row.number("E_lx_for_1000lm"), lamp, {x, y, 0}, {0, 0, 1},
                        computed);
    plan.compute_direct(place_of(row) + ", upright", row.number("E_vertical_lx"), lamp,
                        {x, y, 0.85}, {-1, 0, 0}, computed);
  }
  return plan;
}

PreparedCase receivers_in_smoke_plan(const std::vector<Row>& points,
                                     const std::string& sigma_text) {
  PreparedCase plan;
  SceneDescription scene = lamp_of(points.front());
  add_homogeneous(scene, smoke(std::stod(sigma_text), 0));
  const auto lamp = lit(std::move(scene));
  for (const Row& row : points) {
    const double x = row.number("x"), y = row.number("y");
    plan.compute_direct(place_of(row), row.number("E_lx_sigma_a_" + sigma_text), lamp, {x, y, 0},
                        {0, 0, 1}, computed);
  }
  return plan;
}

/// Cells of 0.25 m around the points of a table row and around their mirror images below the lamp.
std::vector<PlaneMeasure> cells_like(const Row& row) {
  const double x = row.number("x"), y = row.number("y");
  std::vector<glm::dvec2> centres = {{x, y}, {-x, y}, {x, -y}, {-x, -y}};
  const std::vector<double> r = row.numbers("rect_x0;x1;y0;y1");
  if (r[1] - r[0] == r[3] - r[2]) {
    for (size_t i = 0; i < 4; ++i) centres.emplace_back(centres[i].y, centres[i].x);
  }
  std::vector<PlaneMeasure> cells;
  for (const glm::dvec2& c : centres) {
    PlaneMeasure p;
    p.name = "cell " + std::to_string(cells.size());
    p.corner = {c.x - cell / 2, c.y - cell / 2, 0};
    p.edge_u = {cell, 0, 0};
    p.edge_v = {0, cell, 0};
    const bool known = std::any_of(cells.begin(), cells.end(),
                                   [&](const PlaneMeasure& k) { return k.corner == p.corner; });
    if (!known) cells.push_back(p);
  }
  return cells;
}

PreparedCase traced_cells_plan(const std::vector<Row>& points) {
  PreparedCase plan;
  plan.scene = lamp_of(points.front());
  plan.quick_particles = 1 << 19;
  const double lm_per_w = efficacy_lm_per_w(plan.scene.emitters[0].spectrum);
  for (uint32_t i = 0; i < points.size(); ++i) {
    BinSum images{&TallyBlocks::planes, {}};
    for (const PlaneMeasure& p : cells_like(points[i])) {
      images.bins.push_back(static_cast<uint32_t>(plan.scene.planes.size()));
      plan.scene.planes.push_back(p);
    }
    const double lumens =
        points[i].number("E_cell_avg_lx") * cell * cell * static_cast<double>(images.bins.size());
    plan.sums.push_back(images);
    plan.add("share of the flux in cells like " + points[i].text("x") + ", " + points[i].text("y"),
             lumens / bare_lamp_lm,
             [i, lm_per_w](const Traced& run) { return run.sum(i) * (lm_per_w / bare_lamp_lm); })
        .unit = 1;
  }
  return plan;
}

PreparedCase pane_plan(double degrees, double transmittance) {
  const double angle = degrees * pi / 180;
  const glm::dvec3 towards(std::sin(angle), 0, -std::cos(angle));
  PreparedCase plan;
  const auto add_room = [](SceneDescription& scene, bool pane) {
    if (pane)
      add_quad(scene, "pane", {-9, -9, 0.5}, {18, 0, 0}, {0, 18, 0}, add_glass(scene, 1.52));
    add_quad(scene, "floor", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, add_grey(scene, 0));
  };
  add_rectangle(plan.scene, {0, 0, 1}, towards, 0.01, 0.01, 1).distribution =
      Distribution::collimated;
  add_room(plan.scene, true);
  plan.quick_particles = 1 << 17;
  plan.add("passed of a beam", transmittance, [](const Traced& run) { return run.into("floor"); });

  SceneDescription lamp, bare;
  add_point(lamp, {0, 0, 1}, 1);
  add_point(bare, {0, 0, 1}, 1);
  add_room(lamp, true);
  add_room(bare, false);
  const glm::dvec3 place = glm::dvec3(0, 0, 1) + towards / std::cos(angle);
  const double bare_lux = lit(std::move(bare))->direct_lx(place, {0, 0, 1});
  plan.compute_direct("lux along a shadow ray", transmittance * bare_lux, lit(std::move(lamp)),
                      place, {0, 0, 1}, 1e-4);
  return plan;
}

PreparedCase point_plan(const std::string& p, double lux) {
  PreparedCase plan;
  plan.compute_direct("E on the floor", lux, lit(candle_at(parameter(p, "h"))),
                      {parameter(p, "r"), 0, 0}, {0, 0, 1}, 1e-4);
  return plan;
}

PreparedCase point_over_layers_plan(const std::string& p, double lux) {
  PreparedCase plan;
  SceneDescription scene = candle_at(2.9);
  add_layers(scene, 0, {1, 1, 1}, {smoke(0.05, 0), smoke(0.3, 0), smoke(1.5, 0)});
  plan.compute_direct("E on the floor", lux, lit(std::move(scene)), {parameter(p, "r"), 0, 0},
                      {0, 0, 1}, 2e-4);
  return plan;
}

void add_area_lamps(Cases& cases) {
  std::string last;
  for (const Row& row : reference_table(points_table)) {
    const std::string lamp = row.text("luminaire");
    if (lamp == last) continue;
    last = lamp;
    const auto points = [lamp] { return rows_where(points_table, "luminaire", lamp); };
    cases.push_back({"lamp", "area lamp " + lamp + ", direct light", points_table,
                     [=] { return receivers_plan(points()); }});
    for (const std::string sigma : {"0.1", "0.5", "2"})
      cases.push_back({"lamp", "area lamp " + lamp + ", direct light in gas of " + sigma + " /m",
                       points_table, [=] { return receivers_in_smoke_plan(points(), sigma); }});
    cases.push_back({"lamp", "area lamp " + lamp + ", traced", points_table,
                     [=] { return traced_cells_plan(points()); }});
  }
}

}  // namespace

void add_lamp_cases(Cases& cases) {
  add_area_lamps(cases);
  const auto add = [&](const std::string& id, const std::string& name, const std::string& law,
                       const auto& plan) {
    for (const Row& row : rows_where("misc_exact.csv", "id", id)) {
      const std::string p = row.text("parameters");
      const double value = row.number("value");
      cases.push_back(
          {"lamp", name + " " + p, "misc_exact.csv, " + law, [=] { return plan(p, value); }});
    }
  };
  add("point_cos3", "point source", "I cos^3 / h^2",
      [](const std::string& p, double lux) { return point_plan(p, lux); });
  add("point_layered_absorb", "point source over gas", "Beer",
      [](const std::string& p, double lux) { return point_over_layers_plan(p, lux); });
  add("glass_T", "glass pane", "Fresnel", [](const std::string& p, double transmittance) {
    return pane_plan(parameter(p, "theta"), transmittance);
  });
}

}  // namespace luxodus::light

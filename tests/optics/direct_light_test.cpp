// Light that has met nothing yet: computed without chance, and by tracing.
#include <algorithm>
#include <cmath>

#include "scenes/geometry/transform.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double floor_edge = 24;
constexpr double cell = 0.25;  // edge of those that the table averages over [m]

/// A lamp in a black room: only a large floor, and a medium or none.
struct Lamp {
  SceneDescription scene;
  double flux_lm = 1000;

  explicit Lamp(const Row& row) {
    const std::vector<double> r = row.numbers("rect_x0;x1;y0;y1");
    Emitter& e = add_rectangle(scene, {(r[0] + r[1]) / 2, (r[2] + r[3]) / 2, row.number("height")},
                               {0, 0, -1}, r[1] - r[0], r[3] - r[2], 0);
    e.radiometric = false;
    e.mains_flux = flux_lm;
    const double h = floor_edge / 2;
    add_quad(scene, "floor", {-h, -h, 0}, {floor_edge, 0, 0}, {0, floor_edge, 0},
             add_grey(scene, 0));
  }
};

double lux_at(const LocalRun& run, const glm::dvec3& point, const glm::dvec3& normal) {
  const glm::vec3 local(point - run.scene().local_origin);
  return direct_light_at(run.scene(), GeometryAccess::resident(run.index()), local,
                         glm::vec3(normal), {})
      .total_lx();
}

void check_relative(double value, double reference, double most) {
  INFO(value << " instead of " << reference << ", off by " << value / reference - 1);
  CHECK(std::abs(value - reference) <= most * reference);
}

}  // namespace

TEST_CASE("deterministic direct light on a floor is the configuration factor within 0.2 %") {
  for (const Row& row : reference_table("area_light_points.csv")) {
    const LocalRun run(compile(Lamp(row).scene), 1, 1);
    INFO(row.text("luminaire") << " at " << row.text("x") << ", " << row.text("y"));
    check_relative(lux_at(run, {row.number("x"), row.number("y"), 0}, {0, 0, 1}),
                   row.number("E_lx_for_1000lm"), 2e-3);
  }
}

TEST_CASE(
    "deterministic direct light at upright receivers is the configuration factor within 0.2 %") {
  // Where the receiver's horizon cuts the lamp, whole parts fall on one side of it: 5 %.
  for (const Row& row : reference_table("area_light_points.csv")) {
    const LocalRun run(compile(Lamp(row).scene), 1, 1);
    INFO(row.text("luminaire") << " at " << row.text("x") << ", " << row.text("y"));
    const bool cut_by_horizon = row.number("x") <= row.numbers("rect_x0;x1;y0;y1")[1];
    check_relative(lux_at(run, {row.number("x"), row.number("y"), 0.85}, {-1, 0, 0}),
                   row.number("E_vertical_lx"), cut_by_horizon ? 5e-2 : 2e-3);
  }
}

TEST_CASE("deterministic direct light is attenuated by absorbing gas along every line") {
  // Parts of a lamp are a sixteenth of their distance wide, whatever their optical width s. Light
  // falls with the fourth power of distance and with exp(-s), so the midpoint rule errs by (4/16 +
  // s)^2 / 24: percents for large lamps in dense smoke, far away, where little is left of their
  // light.
  for (const auto& [column, sigma] :
       {std::pair("E_lx_sigma_a_0.1", 0.1), std::pair("E_lx_sigma_a_0.5", 0.5),
        std::pair("E_lx_sigma_a_2", 2.0)}) {
    for (const Row& row : reference_table("area_light_points.csv")) {
      Lamp lamp(row);
      add_homogeneous(lamp.scene, smoke(sigma, 0));
      const LocalRun run(compile(std::move(lamp.scene)), 1, 1);
      INFO(row.text("luminaire") << " at " << row.text("x") << ", " << row.text("y") << ", "
                                 << sigma);
      const std::vector<double> r = row.numbers("rect_x0;x1;y0;y1");
      const double away = std::hypot(row.number("x"), row.number("y"), row.number("height"));
      const double width = sigma * std::min(away / 16, std::hypot(r[1] - r[0], r[3] - r[2]));
      check_relative(lux_at(run, {row.number("x"), row.number("y"), 0}, {0, 0, 1}),
                     row.number(column), 1e-3 + (0.25 + width) * (0.25 + width) / 24);
    }
  }
}

namespace {

/// Cells of 0.25 m around the points of a table row and around its mirror images under the lamp.
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

}  // namespace

TEST_CASE("traced light over the cells of a plane is the exact average of the cells") {
  for (const std::string name :
       {"L1_600x600_h2.5", "L3_exit_sign_0.3x0.15_h2.2", "L5_large_4x4_h1"}) {
    std::vector<Row> points;
    for (const Row& row : reference_table("area_light_points.csv")) {
      if (row.text("luminaire") == name) points.push_back(row);
    }
    REQUIRE(points.size() == 12);
    Lamp lamp(points.front());
    const double lm_per_w = efficacy_lm_per_w(lamp.scene.emitters[0].spectrum);
    std::vector<BinSum> images;
    for (const Row& row : points) {
      images.push_back({&TallyBlocks::planes, {}});
      for (const PlaneMeasure& p : cells_like(row)) {
        images.back().bins.push_back(static_cast<uint32_t>(lamp.scene.planes.size()));
        lamp.scene.planes.push_back(p);
      }
    }
    RunOptions options;
    options.particles = 1 << 25;
    const Run run(std::move(lamp.scene), options, images);
    for (uint32_t i = 0; i < points.size(); ++i) {
      INFO(name << " at " << points[i].text("x") << ", " << points[i].text("y"));
      const double lumens = points[i].number("E_cell_avg_lx") * cell * cell *
                            static_cast<double>(images[i].bins.size());
      // As shares of the flux of 1000 lm: far from the lamp, one particle in thousands.
      check_share(run.sum(i, 0) * (lm_per_w / lamp.flux_lm), lumens / lamp.flux_lm,
                  options.particles);
      CHECK(run.sum(i, 1).value == 0);
    }
  }
}

TEST_CASE("a point source obeys the cosine cubed law") {
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "point_cos3") continue;
    const std::string& parameters = row.text("parameters");
    SceneDescription scene;
    Emitter& e = add_point(scene, {0, 0, parameter(parameters, "h")}, 0);
    e.radiometric = false;
    e.mains_flux = 100 * 4 * 3.14159265358979323846;  // 100 cd
    add_quad(scene, "floor", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, add_grey(scene, 0));
    const LocalRun run(compile(std::move(scene)), 1, 1);
    check_relative(lux_at(run, {parameter(parameters, "r"), 0, 0}, {0, 0, 1}), row.number("value"),
                   1e-4);
  }
}

TEST_CASE("a point source above absorbing layers obeys Beer's law along every line") {
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "point_layered_absorb") continue;
    SceneDescription scene;
    Emitter& e = add_point(scene, {0, 0, 2.9}, 0);
    e.radiometric = false;
    e.mains_flux = 100 * 4 * 3.14159265358979323846;
    add_quad(scene, "floor", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, add_grey(scene, 0));
    add_layers(scene, 0, {1, 1, 1}, {smoke(0.05, 0), smoke(0.3, 0), smoke(1.5, 0)});
    const LocalRun run(compile(std::move(scene)), 1, 1);
    check_relative(lux_at(run, {parameter(row.text("parameters"), "r"), 0, 0}, {0, 0, 1}),
                   row.number("value"), 2e-4);
  }
}

TEST_CASE("a glass pane transmits what Fresnel says, by tracing and along shadow rays") {
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "glass_T") continue;
    const double angle = parameter(row.text("parameters"), "theta") * 3.14159265358979323846 / 180;
    const glm::dvec3 towards(std::sin(angle), 0, -std::cos(angle));
    const glm::dvec3 below = towards / std::cos(angle);  // one metre under the lamp's height
    SceneDescription beam;
    add_rectangle(beam, {0, 0, 1}, towards, 0.01, 0.01, 1).distribution = Distribution::collimated;
    add_quad(beam, "pane", {-9, -9, 0.5}, {18, 0, 0}, {0, 18, 0}, add_glass(beam, 1.52));
    add_quad(beam, "floor", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, add_grey(beam, 0));
    SceneDescription lamp = beam;
    RunOptions options;
    options.particles = 1 << 18;
    check_within(Run(std::move(beam), options).into("floor"), row.number("value"),
                 half_percent / 2);

    lamp.emitters.clear();
    add_point(lamp, {0, 0, 1}, 1);
    SceneDescription clear = lamp;
    clear.objects.erase(clear.objects.begin());
    const LocalRun through(compile(std::move(lamp)), 1, 1),
        without(compile(std::move(clear)), 1, 1);
    const glm::dvec3 place = glm::dvec3(0, 0, 1) + below;
    check_relative(lux_at(through, place, {0, 0, 1}) / lux_at(without, place, {0, 0, 1}),
                   row.number("value"), 1e-4);
  }
}

}  // namespace luxodus::light

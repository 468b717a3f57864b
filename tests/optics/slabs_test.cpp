// Scattering layers between perfect mirrors, which make them infinite, against discrete ordinates
// of many streams: what is reflected, passed, passed unscattered, and in every layer absorbed and
// travelled.
#include <cmath>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double edge = 20;   // [m], wide: few reflections on the mirrors
constexpr double height = 3;  // of every stack
constexpr double gap = 1e-3;  // clear air between stack and receiving face

/// Light of power 1 enters the stack at its illuminated face and may leave there; it meets "far"
/// beyond the other.
SceneDescription stack_of(const Row& row) {
  SceneDescription scene;
  scene.run.voxels = false;
  const bool from_top = row.text("from") == "top";
  const double low = from_top ? -gap : 0, high = from_top ? height : height + gap;
  const std::vector<Face> faces = faces_of_box({0, 0, low}, {edge, edge, high});
  const int mirror = add_mirror(scene, 1);
  for (size_t f = 0; f < 4; ++f)
    add_quad(scene, faces[f].name, faces[f].corner, faces[f].u, faces[f].v, mirror);
  const Face& far = faces[from_top ? 4 : 5];
  add_quad(scene, "far", far.corner, far.u, far.v, add_grey(scene, row.number("floor_rho")));
  const glm::dvec3 way(0, 0, from_top ? -1 : 1);
  Emitter& e =
      add_rectangle(scene, {edge / 2, edge / 2, from_top ? height : 0}, way, edge, edge, 1);
  if (row.text("incidence") == "normal") e.distribution = Distribution::collimated;

  const std::vector<double> sigma = row.numbers("sigma_t"), thickness = row.numbers("thickness"),
                            albedo = row.numbers("albedo"), g = row.numbers("g");
  std::vector<SmokeOptics> optics;
  double z = 0;
  for (size_t i = 0; i < sigma.size(); ++i) {
    optics.push_back(smoke(sigma[i], albedo[i], g[i]));
    add_layer_group(scene, z, z + thickness[i]);
    z += thickness[i];
  }
  add_layers(scene, 0, thickness, optics);

  CountingPlaneMeasure plane;  // forward is the way of the light
  plane.name = "before far";
  plane.corner = {0, 0, from_top ? -gap / 2 : height + gap / 2};
  plane.edge_u = from_top ? glm::dvec3(0, edge, 0) : glm::dvec3(edge, 0, 0);
  plane.edge_v = from_top ? glm::dvec3(edge, 0, 0) : glm::dvec3(0, edge, 0);
  scene.counting_planes.push_back(plane);
  return scene;
}

/// What fewer than ten particles bring on average has a standard error that is itself unknown: few
/// hits give a small mean and a small error together. There the error is at least the one that the
/// reference predicts: rare hits of the weight that roulette leaves (1/4), in layers of about a
/// metre.
Estimate judged(Estimate estimate, double reference, int64_t particles) {
  const auto n = static_cast<double>(particles);
  if (reference * n < 10) {
    const double predicted = std::sqrt(0.25 * reference / n);
    estimate.standard_error = std::max(estimate.standard_error, predicted);
  }
  return estimate;
}

void check_stack(const Row& row) {
  INFO("case " << row.text("case") << " " << row.text("name") << ", " << row.text("incidence")
               << " from " << row.text("from"));
  RunOptions options;
  const double tau = row.number("tau_total");
  options.particles = tau >= 100 ? 1 << 15 : tau >= 20 ? 1 << 17 : 1 << 18;
  options.batch_particles = 1 << 9;
  const Run run(stack_of(row), options);
  // Of incident power 1: a yes or no of half the particles has 0.1 % at 2^18 of them.
  const double error = 0.8 / std::sqrt(static_cast<double>(options.particles));
  check_near(run.escaped(row.text("from") == "top" ? 5 : 4), row.number("R"), error, 1e-6);
  check_near(run.into("far"), row.number("T"), 2 * error, 1e-6);
  check_near(run.watts(run.blocks().counting, 0, 0), row.number("T_direct"), error, 1e-6);
  if (row.number("floor_rho") > 0)
    check_near(run.absorbed_by("far"), row.number("floor_absorbed"), error, 1e-6);
  const std::vector<double> absorbed = row.numbers("absorbed"), track = row.numbers("track_length");
  for (uint32_t i = 0; i < absorbed.size(); ++i) {
    INFO("layer " << i);
    // Reflectances and albedos are single precision: an albedo of 1 absorbs nothing, others err by
    // 6e-8.
    check_near(judged(run.absorbed_in(i), absorbed[i], options.particles), absorbed[i], error,
               1e-6);
    check_near(judged(run.track_length(i), track[i], options.particles), track[i],
               4e-2 * track[i] + 2 * error, 2e-6 * track[i]);
  }
}

void check_stacks(double least_tau, double most_tau) {
  int cases = 0;
  for (const Row& row : reference_table("layered_slab.csv")) {
    const double tau = row.number("tau_total");
    if (tau < least_tau || tau > most_tau) continue;
    check_stack(row);
    ++cases;
  }
  CHECK(cases >= 6);
}

}  // namespace

TEST_CASE("thin and moderate layers reflect, pass and absorb what the transport equation says") {
  check_stacks(0, 1);
}
TEST_CASE("thick layers reflect, pass and absorb what the transport equation says") {
  check_stacks(2, 10);
}
TEST_CASE("optically deep layers reflect, pass and absorb what the transport equation says") {
  check_stacks(15, 50);
}
TEST_CASE("layers a hundred free paths deep that absorb nothing lose nothing") {
  check_stacks(100, 100);
}

}  // namespace luxodus::light

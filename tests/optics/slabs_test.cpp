// Scattering layers between perfect mirrors, which make them infinite, against discrete ordinates
// of many streams: what is reflected, passed, passed unscattered, and in every layer absorbed and
// travelled.
#include <algorithm>
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
  add_mirror_walls(scene, {0, 0, low}, {edge, edge, high});
  const Face far = faces_of_box({0, 0, low}, {edge, edge, high})[from_top ? 4 : 5];
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

/// Every share of the incident power that is not rarer than `least` is wanted to half a percent, as
/// far as time allows: a history collides some twice as often as the stack is deep.
int64_t particles_for_stack(const Row& row) {
  const double tau = row.number("tau_total");
  const double least = tau <= 1 ? 0.002 : tau <= 10 ? 0.005 : 0.01;
  const int64_t most = tau >= 100 ? 1 << 19 : 1 << 25;
  double rarest = 1;
  const auto want = [&](double share) {
    if (share >= least) rarest = std::min(rarest, share);
  };
  want(row.number("R"));
  want(row.number("T"));
  for (const double absorbed : row.numbers("absorbed")) want(absorbed);
  return std::clamp(particles_for(rarest), int64_t{1} << 18, most);
}

void check_stack(const Row& row) {
  INFO("case " << row.text("case") << " " << row.text("name") << ", " << row.text("incidence")
               << " from " << row.text("from"));
  RunOptions options;
  options.particles = particles_for_stack(row);
  const Run run(stack_of(row), options);
  // Reflectances and albedos are single precision: an albedo of 1 absorbs nothing, others err by
  // 6e-8.
  constexpr double slack = 1e-6;
  const auto check = [&](const std::string& column, const Estimate& estimate, double most) {
    INFO(column);
    check_share(estimate, row.number(column), options.particles, most, slack);
  };
  check("R", run.escaped(row.text("from") == "top" ? 5 : 4), 1);
  check("T", run.into("far"), 2);  // a floor may be met twice
  check("T_direct", run.watts(run.blocks().counting, 0, 0), 1);
  if (row.number("floor_rho") > 0) check("floor_absorbed", run.absorbed_by("far"), 1);
  // A particle that gets deep into a thick layer stays there for long [m].
  const double longest = std::max(2.0, 0.5 * row.number("tau_total"));
  const std::vector<double> absorbed = row.numbers("absorbed"), track = row.numbers("track_length");
  for (uint32_t i = 0; i < absorbed.size(); ++i) {
    INFO("layer " << i);
    check_share(run.absorbed_in(i), absorbed[i], options.particles, 1, slack);
    check_share(run.track_length(i), track[i], options.particles, longest, 2 * slack * track[i]);
  }
}

void check_stacks(double least_tau, double most_tau, const std::string& incidence) {
  int cases = 0;
  for (const Row& row : reference_table("layered_slab.csv")) {
    const double tau = row.number("tau_total");
    if (tau < least_tau || tau > most_tau || row.text("incidence") != incidence) continue;
    check_stack(row);
    ++cases;
  }
  CHECK(cases >= 4);
}

}  // namespace

TEST_CASE("thin layers reflect, pass and absorb of a beam what the transport equation says") {
  check_stacks(0, 1, "normal");
}
TEST_CASE(
    "thin layers reflect, pass and absorb of diffuse light what the transport equation says") {
  check_stacks(0, 1, "lambert");
}
TEST_CASE("thick layers reflect, pass and absorb of a beam what the transport equation says") {
  check_stacks(2, 10, "normal");
}
TEST_CASE(
    "thick layers reflect, pass and absorb of diffuse light what the transport equation says") {
  check_stacks(2, 10, "lambert");
}
TEST_CASE("deep layers reflect, pass and absorb of a beam what the transport equation says") {
  check_stacks(15, 50, "normal");
}
TEST_CASE(
    "deep layers reflect, pass and absorb of diffuse light what the transport equation says") {
  check_stacks(15, 50, "lambert");
}
TEST_CASE("a hundred free paths of layers do with a beam what the transport equation says") {
  check_stacks(100, 100, "normal");
}
TEST_CASE("a hundred free paths of layers do with diffuse light what the transport equation says") {
  check_stacks(100, 100, "lambert");
}

namespace {

/// Scattering gas so deep that nothing comes back from its end, between mirrors that make it
/// infinite.
SceneDescription deep_gas(double albedo) {
  SceneDescription scene;
  scene.run.voxels = false;
  const double top = height + 10 * gap;
  add_mirror_walls(scene, {0, 0, 0}, {edge, edge, top});
  add_quad(scene, "end", {0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, add_grey(scene, 0));
  // Fluence falls by e in at least 1 / sqrt(3 (1 - albedo)) free paths; what is scattered beyond
  // would have to come back as well.
  const double depth = 15 + 8 / std::sqrt(3 * (1 - albedo));
  add_layers(scene, 0, {height}, {smoke(depth / height, albedo)});
  return scene;
}

}  // namespace

TEST_CASE("a half space of gas returns what Chandrasekhar's H function says") {
  for (const Row& row : reference_table("halfspace_H.csv")) {
    for (const auto& [column, cosine] : {std::pair("R(mu0=0.1)", 0.1), std::pair("R(mu0=0.5)", 0.5),
                                         std::pair("R(mu0=1)", 1.0), std::pair("R_lambert", 0.0)}) {
      INFO("albedo " << row.text("albedo") << ", " << column);
      SceneDescription scene = deep_gas(row.number("albedo"));
      const bool beam = cosine > 0;
      const glm::dvec3 way(beam ? std::sqrt(1 - cosine * cosine) : 0, 0, beam ? -cosine : -1);
      Emitter& lamp =
          add_rectangle(scene, {edge / 2, edge / 2, height + 5 * gap}, way, gap, gap, 1);
      if (beam) lamp.distribution = Distribution::collimated;
      const double reflected = row.number(column);
      RunOptions options;
      options.particles = std::max(particles_for(reflected), int64_t{1} << 16);
      const Run run(std::move(scene), options);
      check_within(run.escaped(5), reflected, half_percent, 2e-6);
      CHECK(run.into("end").value < 1e-3);
    }
  }
}

}  // namespace luxodus::light

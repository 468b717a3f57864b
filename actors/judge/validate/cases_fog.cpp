// How far light travels in infinite fog before absorption: moments of the point of absorption under
// Henyey-Greenstein scattering, for extinction 1/m, albedo c and mean cosine g.
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

/// Means over the points of absorption of light that starts along z [m], [m2].
struct Moments {
  double z, z2, r2;
};
Moments moments_of(double albedo, double g) {
  const double turned = 1 - albedo * g;
  return {1 / turned, 2 / (3 * turned) * (1 / (1 - albedo) + 2 / (1 - albedo * g * g)),
          2 / ((1 - albedo) * turned)};
}

// ---- second moments ----------------------------------------------------------------------------

/// Four Gauss points on [-1, 1].
constexpr double gauss_place[] = {0.339981043584856, 0.861136311594053};
constexpr double gauss_weight[] = {0.652145154862546, 0.347854845137454};

/// A node of an integral over heights.
struct Node {
  double height = 0;
  double weight = 0;
};
/// From 0 to `far`, in panels of increasing width: net flows fall like sums of exp(-z / length),
/// with lengths from zero to that of diffusion.
std::vector<Node> nodes_up_to(double far) {
  std::vector<Node> nodes;
  for (double low = 0; low < far;) {
    const double high = std::min(far, 2 * low + 0.4);
    for (int i = 0; i < 2; ++i) {
      for (const double sign : {-1.0, 1.0})
        nodes.push_back({0.5 * (low + high) + 0.5 * (high - low) * sign * gauss_place[i],
                         0.5 * (high - low) * gauss_weight[i]});
    }
    low = high;
  }
  return nodes;
}

/// A plane across an axis (0: x, 2: z), with forward away from the origin.
void add_crossing(SceneDescription& scene, int axis, double there, double edge) {
  CountingPlaneMeasure plane;
  plane.name = "plane " + std::to_string(scene.counting_planes.size());
  glm::dvec3 u(0), v(0);
  u[(axis + 1) % 3] = edge;
  v[(axis + 2) % 3] = edge;
  if (there < 0) std::swap(u, v);
  plane.corner = -0.5 * (u + v);
  plane.corner[axis] = there;
  plane.edge_u = u;
  plane.edge_v = v;
  scene.counting_planes.push_back(plane);
}

/// The net flow through a plane is absorbed beyond it, so the mean square of the place of
/// absorption is the integral of 2 z (net flow through z), and likewise on the other side.
/// Directions across the beam are equivalent. The error of Gauss's rule on the panels is below one
/// ten-thousandth.
void add_second_moments(PreparedCase& plan, double far, double mean_z2, double mean_r2) {
  SceneDescription& scene = plan.scene;
  WeightedSum z2{&TallyBlocks::counting, {}};
  const auto add_plane = [&](int axis, double there, double edge, double weight, WeightedSum& sum) {
    const auto bin = static_cast<uint32_t>(scene.counting_planes.size());
    add_crossing(scene, axis, there, edge);
    for (uint32_t q = 0; q < 4; ++q) sum.terms.push_back({bin, q, q < 2 ? weight : -weight});
  };
  const double edge = 2 * far;  // larger than all geometry
  const std::vector<Node> nodes = nodes_up_to(far);
  for (const Node& n : nodes) {
    for (const double side : {1.0, -1.0})
      add_plane(2, side * n.height, edge, 2 * n.height * n.weight, z2);
  }
  WeightedSum r2 = z2;  // and twice that of x, of which one half is measured
  for (const Node& n : nodes) add_plane(0, n.height, edge, 8 * n.height * n.weight, r2);
  plan.weighted = {std::move(z2), std::move(r2)};
  constexpr double of_panels = 1e-4;
  // Squares of an exponentially distributed quantity: their mean square is about twelve times their
  // squared mean.
  constexpr double spread = 12;
  plan.add(
          "mean z2 of absorption", mean_z2, [](const Traced& run) { return run.weighted_sum(0); },
          of_panels)
      .unit = spread * mean_z2;
  plan.add(
          "mean r2 of absorption", mean_r2, [](const Traced& run) { return run.weighted_sum(1); },
          of_panels)
      .unit = spread * mean_r2;
}

// ---- cases -------------------------------------------------------------------------------------

/// The vector flux of one voxel around everything is the sum of all displacements, so its component
/// along the beam gives the mean place of absorption; the fluence gives the mean path.
PreparedCase moments_plan(const std::string& parameters, const Moments& mean) {
  const double albedo = parameter(parameters, "c"), g = parameter(parameters, "g");
  // Fluence falls by a factor e in at least 1 / sqrt(3 (1 - c) (1 - c g)) metres: beyond 20 of them
  // nothing is left.
  const double far = 10 + 20 / std::sqrt(3 * (1 - albedo) * (1 - albedo * g));
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxel_edge_m = 3 * far;
  add_speck(scene, {far, far, far});
  add_speck(scene, {-far, -far, -far});
  scene.objects.back().name = "other speck";
  add_rectangle(scene, {0, 0, 0}, {0, 0, 1}, 1e-3, 1e-3, 1).distribution = Distribution::collimated;
  add_homogeneous(scene, smoke(1, albedo, g));
  plan.quick_particles = albedo > 0.95 ? 1 << 14 : 1 << 17;
  plan.add("mean path", 1 / (1 - albedo),
           [](const Traced& run) { return run.watts(run.blocks().voxels, 0, 0); })
      .unit = 1 / (1 - albedo);
  plan.add("mean z of absorption", mean.z,
           [](const Traced& run) { return run.watts(run.blocks().voxels, 0, 3); })
      .unit = mean.z2 / mean.z;  // so that unit x mean is the mean square
  add_second_moments(plan, far, mean.z2, mean.r2);
  return plan;
}

}  // namespace

void add_fog_cases(Cases& cases) {
  constexpr const char* table = "misc_exact.csv";
  for (const Row& row : rows_where(table, "id", "hg_mean_z")) {
    const std::string p = row.text("parameters");
    const Moments mean{row.number("value"), exact("hg_mean_z2", p), exact("hg_mean_r2", p)};
    cases.push_back({"moments", "beam in fog, " + p, table, [=] { return moments_plan(p, mean); }});
  }
  // Where inverting the phase function loses digits.
  for (const std::string g : {"-0.999", "-1e-7", "1e-7", "0.999"}) {
    const std::string p = "c=0.9;g=" + g;
    const Moments mean = moments_of(0.9, std::stod(g));
    cases.push_back({"moments", "beam in fog, " + p, "1 / (1 - c g) and its like",
                     [=] { return moments_plan(p, mean); }});
  }
}

}  // namespace luxodus::light

// How far light gets in endless fog before it is absorbed: moments of the point of absorption under
// Henyey-Greenstein scattering, for extinction 1/m, albedo c and mean cosine g.
#include <cmath>

#include "actors/validate/case.hpp"
#include "actors/validate/reference.hpp"
#include "actors/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

/// The vector flux of one voxel around everything is the sum of all displacements, so its component
/// along the beam is the mean place of absorption; the fluence is the mean path.
Plan moments_plan(const std::string& parameters, double mean_z) {
  const double albedo = parameter(parameters, "c"), g = parameter(parameters, "g");
  // Fluence falls by e in at least 1 / sqrt(3 (1 - c) (1 - c g)) metres: nothing is 20 such away.
  const double far = 10 + 20 / std::sqrt(3 * (1 - albedo) * (1 - albedo * g));
  Plan plan;
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
  const double mean_z2 = 2 / (3 * (1 - albedo * g)) * (1 / (1 - albedo) + 2 / (1 - albedo * g * g));
  plan.add("mean z of absorption", mean_z,
           [](const Traced& run) { return run.watts(run.blocks().voxels, 0, 3); })
      .unit = mean_z2 / mean_z;  // so that unit x mean is the mean square
  return plan;
}

}  // namespace

void add_fog_cases(Cases& cases) {
  for (const Row& row : rows_where("misc_exact.csv", "id", "hg_mean_z")) {
    const std::string p = row.text("parameters");
    const double mean_z = row.number("value");
    cases.push_back({"moments", "beam in fog, " + p, "misc_exact.csv, 1 / (1 - c g)",
                     [=] { return moments_plan(p, mean_z); }});
  }
  // Where inversions of the phase function lose their digits.
  for (const std::string g : {"-0.999", "-1e-7", "1e-7", "0.999"}) {
    const std::string p = "c=0.9;g=" + g;
    const double mean_z = 1 / (1 - 0.9 * std::stod(g));
    cases.push_back(
        {"moments", "beam in fog, " + p, "1 / (1 - c g)", [=] { return moments_plan(p, mean_z); }});
  }
}

}  // namespace luxodus::light

// How far light gets in endless fog before it is absorbed: moments of the point of absorption under
// Henyey-Greenstein scattering, for extinction 1/m, albedo c and mean cosine g.
#include <algorithm>
#include <cmath>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// Moments of the point of absorption of light that starts along +z [m], [m2].
struct Moments {
  std::string parameters;
  double albedo, g;
  double mean_z, mean_r2, mean_z2;
};

std::vector<Moments> moments() {
  std::vector<Moments> out;
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "hg_mean_z") continue;
    const std::string& p = row.text("parameters");
    out.push_back({p, parameter(p, "c"), parameter(p, "g"), row.number("value"),
                   exact("hg_mean_r2", p), exact("hg_mean_z2", p)});
  }
  REQUIRE(out.size() == 20);
  return out;
}

}  // namespace

TEST_CASE("light in fog is absorbed on average where the mean cosine of scattering says") {
  // The vector flux of one voxel around everything is the sum of all displacements, so its
  // component along the beam is the mean place of absorption; the fluence is the mean path.
  for (const Moments& m : moments()) {
    INFO(m.parameters);
    // Fluence falls by e in at least 1 / sqrt(3 (1 - c) (1 - c g)) metres: nothing is 20 such away.
    const double far = 10 + 20 / std::sqrt(3 * (1 - m.albedo) * (1 - m.albedo * m.g));
    SceneDescription scene;
    scene.run.voxel_edge_m = 3 * far;
    add_speck(scene, {far, far, far});
    add_speck(scene, {-far, -far, -far});
    scene.objects.back().name = "other speck";
    add_rectangle(scene, {0, 0, 0}, {0, 0, 1}, 1e-3, 1e-3, 1).distribution =
        Distribution::collimated;
    add_homogeneous(scene, smoke(1, m.albedo, m.g));
    const double most = m.mean_z2 / m.mean_z;  // so that most * mean is the mean square
    RunOptions options;
    options.particles = particles_for(m.mean_z / most);
    // A history of albedo 0.99 has a hundred collisions.
    options.particles =
        std::clamp<int64_t>(options.particles, 1 << 18, m.albedo > 0.95 ? 1 << 18 : 1 << 20);
    const Run run(std::move(scene), options);
    REQUIRE(run.scene().voxels.count() == 1);
    const uint32_t voxels = run.blocks().voxels;
    check_share(run.watts(voxels, 0, 3), m.mean_z, options.particles, most);
    check_within(run.watts(voxels, 0, 0), 1 / (1 - m.albedo), half_percent);
  }
}

TEST_CASE("walks by the phase function end as far away as its moments say") {
  constexpr int walks = (1 << 19) / thrift;
  for (const Moments& m : moments()) {
    INFO(m.parameters);
    const auto phase = PhaseFunction::make(smoke(1, m.albedo, m.g).phase, {});
    REQUIRE(phase.ok());
    Random random(1, RandomStream::test);
    double r2 = 0, r4 = 0, z2 = 0, z4 = 0;  // sums
    for (int walk = 0; walk < walks; ++walk) {
      random.start(static_cast<uint64_t>(walk));
      glm::dvec3 place(0);
      glm::vec3 direction(0, 0, 1);
      while (true) {
        place += glm::dvec3(direction) * -std::log1p(-random.uniform_double());
        if (random.uniform_double() >= m.albedo) break;
        const float u = random.uniform();
        const float v = random.uniform();
        direction = sample(phase.value(), direction, u, v);
      }
      const double r = glm::dot(place, place), z = place.z * place.z;
      r2 += r;
      r4 += r * r;
      z2 += z;
      z4 += z * z;
    }
    const auto mean = [](double sum, double squares) {
      const double value = sum / walks;
      return Estimate{value, std::sqrt((squares / walks - value * value) / walks)};
    };
    check_within(mean(r2, r4), m.mean_r2, half_percent);
    check_within(mean(z2, z4), m.mean_z2, half_percent);
  }
}

}  // namespace luxodus::light

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
  double mean_r2, mean_z2;
};

std::vector<Moments> moments() {
  std::vector<Moments> out;
  for (const Row& row : reference_table("misc_exact.csv")) {
    if (row.text("id") != "hg_mean_z") continue;
    const std::string& p = row.text("parameters");
    out.push_back(
        {p, parameter(p, "c"), parameter(p, "g"), exact("hg_mean_r2", p), exact("hg_mean_z2", p)});
  }
  REQUIRE(out.size() == 20);
  return out;
}

}  // namespace

TEST_CASE("light in fog is absorbed on average where the mean cosine of scattering says") {
  for (const Moments& m : moments()) {
    // A history of albedo 0.99 has a hundred collisions.
    for (const Case& c : all_cases()) {
      if (c.name == "beam in fog, " + m.parameters)
        check_case(c, {.most_particles = m.albedo > 0.95 ? 1 << 18 : 1 << 20});
    }
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

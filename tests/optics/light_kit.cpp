#include "tests/optics/light_kit.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/described.hpp"

namespace luxodus::light {

SceneDescription scene_from_toml(const std::string& text) {
  return *test::described_text(text);
}

std::vector<BinSum> add_probes_on_planes(SceneDescription& scene, uint32_t per_side) {
  std::vector<BinSum> out;
  for (const PlaneMeasure& plane : scene.planes) {
    out.push_back({&TallyBlocks::probes, {}});
    for (uint32_t k = 0; k < per_side * per_side; ++k) {
      ProbeMeasure p;
      p.name = plane.name + " " + std::to_string(k);
      p.position = plane.corner + plane.edge_u * ((k % per_side + 0.5) / per_side) +
                   plane.edge_v * ((k / per_side + 0.5) / per_side);
      p.normal = glm::normalize(glm::cross(plane.edge_u, plane.edge_v));
      out.back().bins.push_back(static_cast<uint32_t>(scene.probes.size()));
      scene.probes.push_back(p);
    }
  }
  return out;
}

namespace {

SceneDescription cut_into_batches(SceneDescription scene, const RunOptions& options) {
  // Fewer than 64 batches would not estimate their own error well.
  scene.run.batch_particles = std::min(options.batch_particles, options.particles / thrift / 64);
  return scene;
}

}  // namespace

Run::Run(SceneDescription scene, const RunOptions& options, const std::vector<BinSum>& sums,
         const std::vector<WeightedSum>& weighted)
    : Traced(compile(cut_into_batches(std::move(scene), options), options.cells), options.seed,
             options.threads, sums, weighted) {
  StopRule stop;
  stop.particles = options.particles / thrift;
  const std::atomic<bool> interrupt{false};
  local().run(stop, interrupt, [](const Progress&) {});
  REQUIRE(balance().closes());
  REQUIRE(balance().lost() == 0);
}

// ---- comparisons -------------------------------------------------------------------------------

int64_t particles_for(double share) {
  constexpr double wanted = 5e-3;
  return static_cast<int64_t>(std::ceil(1 / (wanted * wanted * share)));
}

void check_near(const Estimate& estimate, double reference, double max_error, double slack,
                double standard_errors) {
  INFO("estimate " << estimate.value << " +- " << estimate.standard_error << ", reference "
                   << reference << ", z "
                   << (estimate.value - reference) / estimate.standard_error);
  CHECK(estimate.standard_error <= max_error);
  // Integer weights and single-precision reflectances: accuracy is not promised below 1e-6.
  const double rounding = 1e-6 * std::abs(reference);
  CHECK(std::abs(estimate.value - reference) <=
        standard_errors * estimate.standard_error + slack + rounding);
}

void check_within(const Estimate& estimate, double reference, double max_relative_error,
                  double relative_slack, double standard_errors) {
  const double size = std::abs(reference);
  check_near(estimate, reference, max_relative_error * size, relative_slack * size,
             standard_errors);
}

void check_share(const Estimate& estimate, double reference, int64_t particles, double most,
                 double slack) {
  const double traced = static_cast<double>(particles / thrift);
  // The error of counting whole hits of `most`. A run may well have four standard deviations more
  // of them, and its standard error grows with them.
  const double hits = reference * traced / most;
  const double of_counting = most * std::sqrt(hits) / traced;
  const double largest = most * std::sqrt(hits + 4 * std::sqrt(hits)) / traced;
  // Few hits give a small mean together with a small error. Then the error is at least that of hits
  // with a weight of a quarter, as roulette leaves it.
  Estimate judged = estimate;
  if (hits < 100) judged.standard_error = std::max(judged.standard_error, 0.5 * of_counting);
  // Four times the error of a standard error: 6 % of it for 128 batches, 9 % for 64.
  const double error_of_the_error = thrift == 1 ? 1.25 : 1.36;
  check_near(judged, reference, std::max(half_percent * reference, error_of_the_error * largest),
             slack);
}

namespace {

int64_t particles_of(const PreparedCase& plan, double emitted_w, const CaseOptions& options) {
  double rarest = 1;
  for (const Quantity& q : plan.quantities) {
    const double share = std::abs(q.reference) / (q.unit > 0 ? q.unit : emitted_w);
    if (!q.certain && share >= options.min_share) rarest = std::min(rarest, share);
  }
  return std::clamp(particles_for(rarest), options.min_particles, options.max_particles);
}

double power_of(const SceneDescription& scene) {
  const auto compiled = compile(scene);
  double sum = 0;
  for (const Group& g : compiled->groups) {
    for (const double p : g.power_w) sum += p;
  }
  return sum;
}

}  // namespace

void check_case(const Case& one, const CaseOptions& options) {
  INFO(one.name);
  const PreparedCase plan = one.plan();
  for (const Computed& c : plan.computed) {
    const double value = c.value(direct_light_at);
    INFO(c.name << ": " << value << " instead of " << c.reference);
    CHECK(std::abs(value - c.reference) <= c.tolerance * std::abs(c.reference));
  }
  if (plan.quantities.empty()) return;
  const double emitted_w = power_of(plan.scene);
  RunOptions run_options;
  run_options.particles = particles_of(plan, emitted_w, options);
  run_options.batch_particles = plan.batch_particles;
  const Run run(plan.scene, run_options, plan.sums, plan.weighted);
  for (const Quantity& q : plan.quantities) {
    INFO(q.name);
    const Estimate found = q.read(run);
    if (q.certain) {
      CHECK(std::abs(found.value - q.reference) <= q.bias);
    } else {
      const double unit = q.unit > 0 ? q.unit : emitted_w;
      check_share(found * (1 / unit), q.reference / unit, run_options.particles, options.most,
                  q.bias / unit);
    }
  }
}

void check_cases(const std::string& name, size_t count, const CaseOptions& options) {
  size_t checked = 0;
  for (const Case& c : all_cases()) {
    if (!c.name.starts_with(name)) continue;
    check_case(c, options);
    ++checked;
  }
  CHECK(checked == count);
}

void check_agree(const Estimate& a, const Estimate& b, double max_relative_error,
                 double standard_errors) {
  const double error = std::hypot(a.standard_error, b.standard_error);
  INFO(a.value << " +- " << a.standard_error << " and " << b.value << " +- " << b.standard_error);
  CHECK(error <= max_relative_error * std::abs(b.value));
  CHECK(std::abs(a.value - b.value) <= standard_errors * error + 1e-6 * std::abs(b.value));
}

}  // namespace luxodus::light

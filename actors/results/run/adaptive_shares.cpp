#include "actors/results/run/adaptive_shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {

/// Number of fluxes (patches) evaluated, evenly chosen among more.
constexpr size_t max_fluxes = 4096;
/// After a first round, a flux with a larger relative error says nothing about its deviation.
constexpr double known = 0.5;
/// The sum of the relative variances to this power approximates their largest.
constexpr double power_of_worst = 4;
constexpr int steps = 100;
/// Batches of each group in the first round: a variance is then known to a quarter. They are small,
/// since only ratios of variances count.
constexpr int64_t first_batches = 32, first_batch_particles = 512;
constexpr double min_of_usual = 0.1;

/// A flux by which a run is judged: the square of its relative deviation per batch, by group.
struct Need {
  std::vector<double> variance;
  /// 1 if the mean over all counts, as for patches, the worst of which is a matter of chance.
  double power = power_of_worst;
};

std::vector<Readout::TargetFlux> thinned(std::vector<Readout::TargetFlux> fluxes) {
  const size_t step = (fluxes.size() + max_fluxes - 1) / max_fluxes;
  if (step <= 1) return fluxes;
  std::vector<Readout::TargetFlux> some;
  for (size_t i = 0; i < fluxes.size(); i += step) some.push_back(fluxes[i]);
  return some;
}

void add_needs(const CompiledScene& scene, const Totals& totals,
               const std::vector<Readout::TargetFlux>& fluxes, double power,
               std::vector<Need>& needs) {
  const Readout readout(scene, totals);
  for (const Readout::TargetFlux& f : fluxes) {
    const Estimate all = readout.lumens(f.block, f.bin, f.quantity);
    const double value = all.value + f.sure_lm;
    if (!(value > 0) || !(all.standard_error <= known * value)) continue;
    Need need{{}, power};
    for (int g = 0; g < totals.groups(); ++g) {
      const double error = readout.lumens(f.block, f.bin, f.quantity, g).standard_error / value;
      need.variance.push_back(error * error * static_cast<double>(totals.batches(g)));
    }
    needs.push_back(std::move(need));
  }
}

double variance_of(const Need& need, const std::vector<double>& shares) {
  double sum = 0;
  for (size_t g = 0; g < shares.size(); ++g) sum += need.variance[g] / shares[g];
  return sum;
}

void scale_to_one(std::vector<double>& shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
}

/// Neyman's shares for the sum of all variances, each weighted by its size with `shares`.
std::vector<double> better_shares(const std::vector<Need>& needs,
                                  const std::vector<double>& shares) {
  std::vector<double> now;
  for (const Need& need : needs) now.push_back(variance_of(need, shares));
  const double worst = *std::max_element(now.begin(), now.end());
  std::vector<double> better(shares.size(), 0);
  for (size_t i = 0; i < needs.size(); ++i) {
    const double weight = std::pow(now[i] / worst, needs[i].power - 1);
    for (size_t g = 0; g < better.size(); ++g) better[g] += weight * needs[i].variance[g];
  }
  for (double& share : better) share = std::sqrt(share);
  scale_to_one(better);
  return better;
}

}  // namespace

std::vector<double> adaptive_shares(const CompiledScene& scene, const Totals& totals,
                                    const std::vector<double>& usual) {
  const Readout readout(scene, totals);
  std::vector<Need> needs;
  add_needs(scene, totals, readout.target_planes(), power_of_worst, needs);
  add_needs(scene, totals, readout.target_surfaces(), power_of_worst, needs);
  for (const uint32_t plane : scene.error_target.cells)
    add_needs(scene, totals, thinned(readout.target_cells(plane)), 1, needs);
  add_needs(scene, totals, thinned(readout.target_patches()), 1, needs);
  const auto none = [](const Need& n) {
    return std::all_of(n.variance.begin(), n.variance.end(), [](double v) { return v == 0; });
  };
  std::erase_if(needs, none);
  if (needs.empty()) return usual;
  std::vector<double> shares = usual;
  for (int step = 0; step < steps; ++step) {
    const std::vector<double> better = better_shares(needs, shares);
    // Only half the way, because the worst of two needs alternates; a share of 0 would stay 0.
    for (size_t g = 0; g < shares.size(); ++g)
      shares[g] = std::sqrt(shares[g] * std::max(better[g], min_of_usual * usual[g]));
    scale_to_one(shares);
  }
  for (size_t g = 0; g < shares.size(); ++g)
    shares[g] = (1 - min_of_usual) * shares[g] + min_of_usual * usual[g];
  return shares;
}

Result<std::vector<double>> find_adaptive_shares(
    const std::shared_ptr<const CompiledScene>& scene, uint64_t seed, int threads,
    const std::atomic<bool>& interrupt, const std::function<void(const Progress&)>& report) {
  const SourcePlace place{scene->description->file, 0};
  if (scene->groups.size() < 2) {
    return problem_in(
        place,
        "there is one source group, so there is nothing to be dealt by need: say [run] "
        "groups = \"emitter\" or \"circuit\"");
  }
  const ErrorTarget& judged = scene->error_target;
  if (!judged.asks_bins()) {
    return problem_in(
        place,
        "batches are dealt by the need of planes, cells, surfaces or patches, and the error is "
        "wanted of none of them: see --error-of");
  }
  Hasher other_numbers;
  other_numbers.add(seed);
  other_numbers.add(std::string_view("first round"));
  const auto groups = static_cast<double>(scene->groups.size());
  const auto small = std::make_shared<CompiledScene>(*scene);
  small->batch_particles = std::min(scene->batch_particles, first_batch_particles);
  small->eye_paths_per_batch = std::min(scene->eye_paths_per_batch, 1);
  small->batch_shares.assign(scene->groups.size(), 1 / groups);
  LocalRun run(small, other_numbers.value(), threads);
  StopRule round;
  round.particles =
      first_batches * static_cast<int64_t>(scene->groups.size()) * small->batch_particles;
  if (run.run(round, interrupt, report) == StopReason::interrupted)
    return problem_in(place, "interrupted in the first round, before anything was kept");
  return adaptive_shares(*small, run.totals(), BatchPlan(*scene).shares());
}

Result<std::shared_ptr<const CompiledScene>> dealt_adaptively(
    const std::shared_ptr<const CompiledScene>& scene, CompileOptions options, uint64_t seed,
    int threads, const std::atomic<bool>& interrupt,
    const std::function<void(const Progress&)>& report) {
  auto shares = find_adaptive_shares(scene, seed, threads, interrupt, report);
  if (!shares) return shares.problem();
  options.batch_shares = std::move(shares).value();
  return compile_scene(scene->description, scene->scenario, options);
}

}  // namespace luxodus

// Two ways to need fewer particles: adaptive allocation of batches to source groups, and equal
// random numbers for two variants of a scene.
#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "actors/results/run/adaptive_shares.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/eye_paths.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr uint64_t seed = 1;

std::shared_ptr<const CompiledScene> compiled(SceneDescription d, const char* scenario,
                                              const CompileOptions& options = {}) {
  const Scenario found = find_scenario(d, scenario).value();
  auto scene =
      compile_scene(std::make_shared<const SceneDescription>(std::move(d)), found, options);
  if (!scene.ok()) throw std::logic_error(scene.problem().text());
  return scene.value();
}

SceneDescription office() {
  auto read = read_scene(LUX_SOURCE_DIR "/scenes/library/office_floor.toml");
  if (!read.scene) throw std::runtime_error("scenes/library/office_floor.toml cannot be read");
  return *read.scene;
}

// ---- adaptive allocation -----------------------------------------------------------------------

/// Variance of the mean of a result with the present batches of each group, over that with the same
/// total, allocated in proportion to each group's deviation (J. Neyman 1934).
double gain_of_allocation(const std::vector<Estimate>& by_group,
                          const std::vector<double>& shares) {
  double now = 0, deviations = 0;
  for (size_t g = 0; g < by_group.size(); ++g) {
    const double variance = by_group[g].standard_error * by_group[g].standard_error;
    now += variance;
    deviations += std::sqrt(variance * shares[g]);
  }
  return deviations > 0 ? now / (deviations * deviations) : 1;
}

const std::atomic<bool> never{false};
constexpr auto no_report = [](const Progress&) {};

std::unique_ptr<LocalRun> traced(const std::shared_ptr<const CompiledScene>& scene) {
  auto run = std::make_unique<LocalRun>(scene, seed, 2);
  StopRule stop;
  stop.particles = 64 * static_cast<int64_t>(scene->groups.size()) * scene->batch_particles;
  run->run(stop, never, no_report);
  return run;
}

/// Variance of the mean illuminance of a plane with the default allocation, over that with as many
/// batches allocated for this plane by `luxodus run --adaptive`.
double gain_by_need(const LocalRun& usual, const SceneDescription& d, const char* scenario,
                    uint32_t plane) {
  CompileOptions options;
  options.error_of = {"plane " + d.planes[plane].name};
  const auto shares =
      find_adaptive_shares(compiled(d, scenario, options), seed, 2, never, no_report);
  if (!shares.ok()) throw std::runtime_error(shares.problem().text());
  options.batch_shares = shares.value();
  const auto by_need = traced(compiled(d, scenario, options));
  const auto error = [&](const LocalRun& run) {
    const Readout readout(run.scene(), run.totals());
    return readout.lumens(run.scene().blocks.planes, plane, 1).standard_error;
  };
  return std::pow(error(usual) / error(*by_need), 2);
}

void print_allocation(const char* scenario, double share) {
  SceneDescription d = office();
  d.run.groups = GroupRule::by_emitter;
  d.run.batch_particles = static_cast<int64_t>(share * 65536);
  d.run.eye_path_factor = 0;  // no eye paths are needed
  const auto scene = compiled(d, scenario);
  const auto run = traced(scene);
  const Readout readout(*scene, run->totals());
  const std::vector<double> shares = BatchPlan(*scene).shares();
  const auto gain = [&](uint32_t block, uint32_t bin, uint32_t quantity) {
    std::vector<Estimate> by_group;
    for (size_t g = 0; g < shares.size(); ++g)
      by_group.push_back(readout.lumens(block, bin, quantity, static_cast<int>(g)));
    return gain_of_allocation(by_group, shares);
  };
  for (uint32_t p = 0; p < scene->planes.size(); ++p) {
    fmt::print("{:<16} {:<24} {:>9.2f} {:>9.2f}\n", scenario, scene->description->planes[p].name,
               gain(scene->blocks.planes, p, 1), gain_by_need(*run, d, scenario, p));
    std::fflush(stdout);
  }
  double patches = 0;
  int lit = 0;
  for (uint32_t p = 0; p < scene->patch_count; ++p) {
    if (!(readout.lumens(scene->blocks.patches, p, 0).relative_error() < 0.25)) continue;
    patches += std::log(gain(scene->blocks.patches, p, 0));
    ++lit;
  }
  fmt::print("{:<16} {:<24} {:>9.2f}\n", scenario, "patches, each by itself",
             std::exp(patches / std::max(1, lit)));
}

// ---- two variants -------------------------------------------------------------------------------

struct Edit {
  const char* name;
  std::function<void(SceneDescription&)> apply;
};

const std::vector<Edit>& edits() {
  static const std::vector<Edit> all = {
      {"lamp moved by 10 cm", [](SceneDescription& d) { d.emitters[0].frame.origin.x += 0.1; }},
      {"walls 0.50 to 0.55",
       [](SceneDescription& d) { d.materials[0].reflectance = Spectrum::constant(0.55); }},
      {"smoke 10 % denser",
       [](SceneDescription& d) { d.media[0].optics.extinction.sigma_t *= 1.1; }},
      {"one box gone", [](SceneDescription& d) { d.objects.erase(d.objects.begin() + 60); }},
  };
  return all;
}

/// Flux into the six walls, by batch [units of one particle].
std::vector<double> walls_by_batch(const std::shared_ptr<const CompiledScene>& scene,
                                   uint64_t with_seed, int64_t batches) {
  LocalRun run(scene, with_seed, 1);
  const auto tracer = make_batch_tracer(*scene, GeometryAccess::resident(run.index()), with_seed);
  BatchPlan plan(*scene);
  BatchScores scores;
  std::vector<double> out;
  for (int64_t k = 0; k < batches; ++k) {
    const Batch batch = plan.next();
    scores.reset(scene->layout);
    tracer->trace(batch.group, batch.first_particle, scene->batch_particles, scores);
    Totals totals(scene->layout, 1, photopic_weights(*scene));
    totals.merge(scores, 0);
    for (uint32_t wall = 0; wall < 6; ++wall)
      out.push_back(Readout(*scene, totals).lumens(scene->blocks.surfaces, wall, 0).value);
  }
  return out;
}

/// Sum over the walls of the variance of the difference between two lists by batch.
double variance_of_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double total = 0;
  for (size_t wall = 0; wall < 6; ++wall) {
    double n = 0, mean = 0, squares = 0;
    for (size_t i = wall; i < a.size(); i += 6) {
      const double d = a[i] - b[i];
      n += 1;
      mean += d;
      squares += d * d;
    }
    mean /= n;
    total += squares / n - mean * mean;
  }
  return total;
}

void print_edit(const Edit& edit, Air air, bool stratified) {
  constexpr int64_t batches = 200;
  SceneDescription before = furnished(air, {false, false});
  before.run.stratified = stratified;
  SceneDescription after = before;
  edit.apply(after);
  const auto a = walls_by_batch(compiled(std::move(before), ""), 1, batches);
  const auto changed = compiled(std::move(after), "");
  const double same = variance_of_difference(a, walls_by_batch(changed, 1, batches));
  const double other = variance_of_difference(a, walls_by_batch(changed, 2, batches));
  fmt::print("{:<24} {:<14} {:<12} {:>6.2f}\n", edit.name,
             air == Air::clear ? "clear" : "homogeneous", stratified ? "stratified" : "independent",
             other / same);
}

}  // namespace

void print_allocation(double share) {
  fmt::print(
      "\nVariance as dealt usually over that with batches dealt by the deviation of each group,\n"
      "were it known, and as luxodus run --adaptive finds it (particles alike, the first round "
      "aside)\n{:<16} {:<24} {:>9} {:>9}\n",
      "office floor", "result", "known", "found");
  for (const char* scenario : {"clear_emergency", "smoke_emergency"})
    print_allocation(scenario, share);
}

void print_edits() {
  fmt::print(
      "\nVariance of what an edit changes on six walls, with other random numbers over that "
      "with the same\n{:<24} {:<14} {:<12} {:>6}\n",
      "edit", "air", "draws", "gain");
  for (const Edit& edit : edits()) {
    for (const Air air : {Air::clear, Air::homogeneous}) {
      const bool smoke = edit.name == std::string("smoke 10 % denser");
      if (smoke && air == Air::clear) continue;
      for (const bool stratified : {false, true}) print_edit(edit, air, stratified);
    }
  }
}

}  // namespace luxodus::bench

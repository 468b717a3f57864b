// Speed against error: gain of each sampling method over the plain weighted game.
#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "actors/results/run/local_run.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/eye_paths.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr uint64_t seed = 1;
constexpr int64_t batches_per_turn = 16;
/// Results with a larger relative error are ignored, since their variances are unknown.
constexpr double known = 0.25;

struct Way {
  const char* name;
  std::function<void(RunSettings&)> set;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> all = {
      {"stratified", [](RunSettings& run) { run.stratified = true; }},
  };
  return all;
}

SceneDescription from_library(const char* file) {
  auto read = read_scene(fmt::format("{}/scenes/library/{}", LUX_SOURCE_DIR, file));
  if (!read.scene) throw std::runtime_error(fmt::format("{} cannot be read", file));
  return *read.scene;
}

struct MeritScene {
  const char* name;
  std::function<SceneDescription()> make;
  const char* scenario;
};

const std::vector<MeritScene>& scenes() {
  static const std::vector<MeritScene> all = {
      {"room, clear",
       [] {
         return furnished(Air::clear, {true, false});
       },
       ""},
      {"room, homogeneous",
       [] {
         return furnished(Air::homogeneous, {true, true});
       },
       ""},
      {"room, layered",
       [] {
         return furnished(Air::layered, {true, true});
       },
       ""},
      {"office, clear", [] { return from_library("office_floor.toml"); }, "clear_emergency"},
      {"office, smoke", [] { return from_library("office_floor.toml"); }, "smoke_emergency"},
      {"auditorium", [] { return from_library("auditorium.toml"); }, "emergency"},
      {"smoke tank", [] { return from_library("smoke_tank.toml"); }, "smoke"},
      {"flame in a box", [] { return from_library("fire_in_a_box.toml"); }, "flame"},
  };
  return all;
}

/// One method on one scene: whole batches, as in a run, on one thread.
class Course {
 public:
  Course(SceneDescription description, const std::string& scenario) {
    const Scenario found = find_scenario(description, scenario).value();
    auto scene =
        compile_scene(std::make_shared<const SceneDescription>(std::move(description)), found, {});
    if (!scene.ok()) throw std::logic_error(scene.problem().text());
    run_ = std::make_unique<LocalRun>(scene.value(), seed, 1);
  }

  void turn() {
    const std::atomic<bool> never{false};
    StopRule stop;
    const int64_t groups = static_cast<int64_t>(scene().groups.size());
    stop.particles = (run_->batches() + batches_per_turn * groups) * scene().batch_particles;
    const double before = thread_seconds();
    run_->run(stop, never, [](const Progress&) {});
    seconds_ += thread_seconds() - before;
  }

  const CompiledScene& scene() const { return run_->scene(); }
  Readout readout() const { return {run_->scene(), run_->totals()}; }
  double seconds() const { return seconds_; }

 private:
  std::unique_ptr<LocalRun> run_;
  double seconds_ = 0;
};

/// A kind of results; `all` appends each of them.
struct Kind {
  const char* name;
  std::function<void(const CompiledScene&, const Readout&, std::vector<Estimate>&)> all;
};

const std::vector<Kind>& kinds() {
  const auto bins = [](uint32_t TallyBlocks::*block, std::vector<uint32_t> quantities) {
    return [block, quantities](const CompiledScene& scene, const Readout& readout,
                               std::vector<Estimate>& out) {
      const uint32_t b = scene.blocks.*block;
      if (b == none_index) return;
      for (uint32_t bin = 0; bin < scene.layout.block(b).bins; ++bin) {
        for (const uint32_t q : quantities) out.push_back(readout.lumens(b, bin, q));
      }
    };
  };
  static const std::vector<Kind> all = {
      {"surfaces", bins(&TallyBlocks::surfaces, {0})},
      {"patches", bins(&TallyBlocks::patches, {0})},
      {"planes", bins(&TallyBlocks::planes, {1})},
      {"cells", bins(&TallyBlocks::plane_cells, {1})},
      {"voxels", bins(&TallyBlocks::voxels, {0})},
      {"probes",
       [](const CompiledScene& scene, const Readout& readout, std::vector<Estimate>& out) {
         for (uint32_t i = 0; i < scene.description->probes.size(); ++i)
           out.push_back(readout.value(scene.blocks.probes, i, 0));
       }},
      {"signs",
       [](const CompiledScene& scene, const Readout& readout, std::vector<Estimate>& out) {
         const auto at_eye = static_cast<uint32_t>(EyeQuantity::at_eye);
         for (const EyeTarget& t : scene.eye_targets)
           out.push_back(readout.value(scene.blocks.views, t.first_bin, at_eye));
       }},
  };
  return all;
}

/// Geometric mean over the results of a kind: variance of the plain method over that of `way`; 0 if
/// no result is known well enough.
double gain_in_variance(const Kind& kind, const Course& plain, const Course& way) {
  std::vector<Estimate> a, b;
  kind.all(plain.scene(), plain.readout(), a);
  kind.all(way.scene(), way.readout(), b);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const bool useful = a[i].relative_error() > 0 && a[i].relative_error() < known &&
                        b[i].relative_error() > 0 && b[i].relative_error() < known;
    if (!useful) continue;
    sum += 2 * std::log(a[i].standard_error / b[i].standard_error);
    ++count;
  }
  return count == 0 ? 0 : std::exp(sum / count);
}

}  // namespace

void print_merit(int turns, const std::string& wanted) {
  fmt::print(
      "\nFigure of merit over that of the plain weighted game: geometric mean over results known\n"
      "to {:.0f} %; {} turns of {} batches for each group, one thread, processor time\n",
      100 * known, turns, batches_per_turn);
  fmt::print("{:<18} {:<12} {:>6}", "scene", "way", "time");
  for (const Kind& kind : kinds()) fmt::print(" {:>8}", kind.name);
  fmt::print("\n");
  for (const MeritScene& scene : scenes()) {
    if (!std::string(scene.name).starts_with(wanted)) continue;
    for (const Way& way : ways()) {
      SceneDescription plain = scene.make();
      plain.run.stratified = false;
      SceneDescription changed = plain;
      way.set(changed.run);
      Course a(std::move(plain), scene.scenario);
      Course b(std::move(changed), scene.scenario);
      for (int i = 0; i < turns; ++i) {
        a.turn();
        b.turn();
      }
      const double faster = a.seconds() / b.seconds();
      fmt::print("{:<18} {:<12} {:>6.2f}", scene.name, way.name, 1 / faster);
      for (const Kind& kind : kinds()) {
        const double gain = gain_in_variance(kind, a, b);
        fmt::print(" {:>8}", gain > 0 ? fmt::format("{:.2f}", gain * faster) : "-");
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace luxodus::bench

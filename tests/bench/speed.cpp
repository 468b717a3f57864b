#include <fmt/core.h>

#include <atomic>
#include <limits>

#include "actors/results/run/local_run.hpp"
#include "scenes/light/transport/particle.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"
#include "tests/kit/replay_rays.hpp"

namespace luxodus::bench {

namespace {

constexpr uint64_t seed = 1;
constexpr size_t recorded_rays = 1 << 18;
constexpr double seconds_per_turn = 0.15;

struct Row {
  const char* name;
  Air air;
  FurnishedTallies tallies;
};

constexpr Row rows[] = {
    {"clear", Air::clear, {false, false}},
    {"clear, detectors", Air::clear, {true, false}},
    {"homogeneous", Air::homogeneous, {false, false}},
    {"homogeneous, detectors", Air::homogeneous, {true, false}},
    {"homogeneous, det., voxels", Air::homogeneous, {true, true}},
    {"layered", Air::layered, {false, false}},
    {"layered, detectors", Air::layered, {true, false}},
    {"layered, det., voxels", Air::layered, {true, true}},
};

/// A resolver that answers as the merged one and records every ray.
class RecordingResolver : public MergedResolver {
 public:
  RecordingResolver(const CompiledScene& scene, const SceneIndex& index)
      : MergedResolver(scene, index) {}

  Hit nearest(const Ray& ray) {
    rays.push_back(ray);
    return MergedResolver::nearest(ray);
  }

  std::vector<Ray> rays;
};

/// The rays of the scene's first particles. Detectors draw no random numbers, so they are omitted.
template <MediaNeed Media>
std::vector<Ray> record(const CompiledScene& scene, const SceneIndex& index) {
  RecordingResolver resolver(scene, index);
  ParticleTracer<Kernel<Media, false, false, false>, RecordingResolver> tracer(scene, resolver,
                                                                               seed);
  BatchScores scores;
  scores.reset(scene.layout);
  for (uint64_t first = 0; resolver.rays.size() < recorded_rays; first += 1024) {
    tracer.trace_batch(0, first, 1024, scores);
  }
  return std::move(resolver.rays);
}

std::vector<Ray> record_rays(Air air, const CompiledScene& scene, const SceneIndex& index) {
  if (air == Air::clear) return record<MediaNeed::none>(scene, index);
  if (air == Air::homogeneous) return record<MediaNeed::homogeneous>(scene, index);
  return record<MediaNeed::layered>(scene, index);
}

std::vector<Ray> without_ends(std::vector<Ray> rays) {
  for (Ray& ray : rays) ray.length = std::numeric_limits<float>::infinity();
  return rays;
}

/// Whole batches as in a run: trace, then merge with squares.
class Runner {
 public:
  Runner(const CompiledScene& scene, const SceneIndex& index)
      : scene_(scene),
        tracer_(make_batch_tracer(scene, GeometryAccess::resident(index), seed)),
        totals_(scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene)) {}

  void batch() {
    scores_.reset(scene_.layout);
    tracer_->trace(0, next_, scene_.batch_particles, scores_);
    next_ += static_cast<uint64_t>(scene_.batch_particles);
    totals_.merge(scores_, 0);
  }
  const EnergyBalance& balance() const { return totals_.balance(); }

 private:
  const CompiledScene& scene_;
  std::unique_ptr<BatchTracer> tracer_;
  Totals totals_;
  BatchScores scores_;
  uint64_t next_ = 0;
};

/// Repeats `turn`, which returns its number of rays, for a while; returns rays per second of CPU
/// time.
template <class Turn>
double rays_per_second(Turn&& turn) {
  const double start = thread_seconds();
  double rays = 0, seconds = 0;
  do {
    rays += turn();
    seconds = thread_seconds() - start;
  } while (seconds < seconds_per_turn);
  return rays / seconds;
}

}  // namespace

void print_speed(int repeats) {
  fmt::print(
      "\nOne thread, against bare rtcIntersect1 on the same rays, and on these rays if all went\n"
      "on to a surface (in media a run looks no farther than the next collision); {} pairs\n",
      repeats);
  fmt::print("{:<26} {:>9} {:>8} {:>9} {:>9} {:>7} {:>13} {:>11} {:>7}\n", "room of 661 quads",
             "Mparts/s", "rays/p.", "Mrays/s", "bare", "share", "spread", "to surface", "share");
  for (const Row& row : rows) {
    const auto scene = furnished_room(row.air, row.tallies);
    const EmbreeDevice device;
    const SceneIndex index(device, *scene);
    const std::vector<Ray> rays = record_rays(row.air, *scene, index);
    const std::vector<Ray> to_surface = without_ends(rays);
    Runner runner(*scene, index);
    runner.batch();
    uint64_t checksum = test::replay_rays(index.cell(0), rays);
    std::vector<double> run, bare, whole, share, whole_share;
    for (int i = 0; i < repeats; ++i) {
      run.push_back(rays_per_second([&] {
        const uint64_t before = runner.balance().rays;
        runner.batch();
        return static_cast<double>(runner.balance().rays - before);
      }));
      bare.push_back(rays_per_second([&] {
        checksum += test::replay_rays(index.cell(0), rays);
        return static_cast<double>(rays.size());
      }));
      whole.push_back(rays_per_second([&] {
        checksum += test::replay_rays(index.cell(0), to_surface);
        return static_cast<double>(to_surface.size());
      }));
      share.push_back(run.back() / bare.back());
      whole_share.push_back(run.back() / whole.back());
    }
    const EnergyBalance& balance = runner.balance();
    const double per_particle =
        static_cast<double>(balance.rays) / static_cast<double>(balance.particles);
    const Summary s = summarise(share);
    const double rays_s = summarise(run).median;
    fmt::print(
        "{:<26} {:>9.3f} {:>8.2f} {:>9.3f} {:>9.3f} {:>7.3f} {:>7.3f}-{:.3f} {:>11.3f} "
        "{:>7.3f}{}\n",
        row.name, rays_s / per_particle * 1e-6, per_particle, rays_s * 1e-6,
        summarise(bare).median * 1e-6, s.median, s.low, s.high, summarise(whole).median * 1e-6,
        summarise(whole_share).median, checksum == 0 ? " !" : "");
  }
}

void print_threads(int repeats) {
  fmt::print("\nTwo threads against one, wall time ({} pairs)\n", repeats);
  fmt::print("{:<26} {:>10} {:>10} {:>7} {:>13}\n", "room of 661 quads", "1 [Mp/s]", "2 [Mp/s]",
             "ratio", "spread");
  const std::atomic<bool> never{false};
  for (const Row& row : rows) {
    if (!row.tallies.detectors) continue;
    const auto scene = furnished_room(row.air, row.tallies);
    std::vector<double> one, two, ratio;
    for (int i = 0; i < repeats; ++i) {
      for (const int threads : {1, 2}) {
        LocalRun run(scene, seed, threads);
        StopRule stop;
        stop.seconds = 4 * seconds_per_turn;
        run.run(stop, never, [](const Progress&) {});
        const double speed = static_cast<double>(run.particles()) / run.seconds();
        (threads == 1 ? one : two).push_back(speed);
      }
      ratio.push_back(two.back() / one.back());
    }
    const Summary s = summarise(ratio);
    fmt::print("{:<26} {:>10.3f} {:>10.3f} {:>7.2f} {:>6.2f}-{:.2f}\n", row.name,
               summarise(one).median * 1e-6, summarise(two).median * 1e-6, s.median, s.low, s.high);
  }
}

}  // namespace luxodus::bench

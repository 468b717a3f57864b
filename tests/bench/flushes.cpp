#include <fmt/core.h>

#include <stdexcept>

#include "actors/cast/tally/flush_codec.hpp"
#include "scenes/light/transport/readout.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int landscape_side = 707;  // a million triangles, two million patch sides
constexpr double intervals_s[] = {0.5, 2, 5, 20};
constexpr int64_t bins_of_a_step = 16384;  // as a node packs them

Totals totals_of(const CompiledScene& scene) {
  return {scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene)};
}

/// One flush: its content, and its cost at both ends [s].
struct Flushed {
  double particles = 0;
  double traced_s = 0;
  double bins = 0;
  double bytes = 0;
  double packed_s = 0;
  double taken_s = 0;
};

class Worker {
 public:
  Worker(const CompiledScene& scene, const SceneIndex& index)
      : scene_(scene),
        tracer_(make_batch_tracer(scene, GeometryAccess::resident(index), 1)),
        totals_(totals_of(scene)) {}

  /// Traces for this interval, then packs the result.
  std::vector<std::byte> work(double interval_s, Flushed& flushed) {
    const double start = thread_seconds();
    while (thread_seconds() - start < interval_s) {
      scores_.reset(scene_.layout);
      tracer_->trace(0, next_, scene_.batch_particles, scores_);
      next_ += static_cast<uint64_t>(scene_.batch_particles);
      totals_.merge(scores_, 0);
      flushed.particles += static_cast<double>(scene_.batch_particles);
    }
    const double traced = thread_seconds();
    encoder_.begin(totals_);
    while (!encoder_.step(bins_of_a_step)) {
    }
    const std::vector<std::byte> bytes = encoder_.bytes();
    flushed.traced_s = traced - start;
    flushed.packed_s = thread_seconds() - traced;
    flushed.bytes = static_cast<double>(bytes.size());
    return bytes;
  }

 private:
  const CompiledScene& scene_;
  std::unique_ptr<BatchTracer> tracer_;
  Totals totals_;
  FlushEncoder encoder_{totals_.groups(), totals_.layout().totals()};
  BatchScores scores_;
  uint64_t next_ = 0;
};

void take(const std::vector<std::byte>& bytes, Totals& totals, Flushed& flushed) {
  const double start = thread_seconds();
  auto gain = decode_flush(bytes, totals.groups(), totals.layout().totals());
  if (!gain.ok()) throw std::runtime_error(gain.problem().what);
  gain->add_to(totals);
  flushed.taken_s = thread_seconds() - start;
  flushed.bins = static_cast<double>(gain->bins());
}

}  // namespace

void print_flushes(int repeats) {
  const auto scene = landscape(landscape_side);
  const EmbreeDevice device;
  const SceneIndex index(device, *scene);
  fmt::print(
      "\nFlushes of a landscape of {} patch sides, {} bins, one node; processor time; {} of each\n"
      "{:>9} {:>10} {:>9} {:>10} {:>10} {:>8} {:>9} {:>8} {:>11}\n"
      "{:>9} {:>10} {:>9} {:>10} {:>10} {:>8} {:>9} {:>8} {:>11}\n",
      scene->patch_count, scene->layout.totals(), repeats, "every", "particles", "bins", "a flush",
      "bytes", "MB / M", "node", "contr.", "of time", "[s]", "[M]", "touched", "[MB]", "a bin",
      "parts.", "[ms]", "[ms]", "node, c. [%]");
  Worker worker(*scene, index);
  Totals totals = totals_of(*scene);
  for (const double interval : intervals_s) {
    std::vector<double> packed, taken;
    Flushed last;
    for (int i = 0; i < repeats; ++i) {
      last = {};
      take(worker.work(interval, last), totals, last);
      packed.push_back(last.packed_s);
      taken.push_back(last.taken_s);
    }
    const double pack_s = summarise(packed).median, take_s = summarise(taken).median;
    fmt::print(
        "{:>9.1f} {:>10.2f} {:>9.3f} {:>10.2f} {:>10.2f} {:>8.1f} {:>9.1f} {:>8.1f} "
        "{:>6.2f} {:>5.2f}\n",
        interval, 1e-6 * last.particles, last.bins / static_cast<double>(scene->layout.totals()),
        1e-6 * last.bytes, last.bytes / last.bins, last.bytes / last.particles, 1e3 * pack_s,
        1e3 * take_s, 100 * pack_s / last.traced_s, 100 * take_s / last.traced_s);
  }
}

}  // namespace luxodus::bench

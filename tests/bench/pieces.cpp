#include <fmt/core.h>

#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/tally/fixed_point.hpp"
#include "scenes/light/transport/detectors.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int calls_per_turn = 200'000;

/// Nanoseconds per call of `piece`, a function of a call number that returns a float: results are
/// summed, so that no call is optimised away.
template <class Piece>
void print_piece(const char* name, int repeats, Piece&& piece) {
  std::vector<double> ns;
  volatile float sink = 0;
  for (int r = 0; r < repeats; ++r) {
    float sum = 0;
    const double start = thread_seconds();
    for (int i = 0; i < calls_per_turn; ++i) sum += piece(i);
    ns.push_back((thread_seconds() - start) * 1e9 / calls_per_turn);
    sink = sink + sum;
  }
  const Summary s = summarise(ns);
  fmt::print("{:<44} {:>8.1f} {:>8.1f}-{:.1f}\n", name, s.median, s.low, s.high);
}

}  // namespace

void print_pieces(int repeats) {
  fmt::print("\nPieces [ns a call]\n{:<44} {:>8} {:>13}\n", "piece", "median", "spread");
  Random random(1, RandomStream::test);
  random.start(0);
  print_piece("start of a particle: one refill", repeats, [&](int i) {
    random.start(static_cast<uint64_t>(i));
    return random.uniform();
  });
  print_piece("one draw of a long history", repeats, [&](int) { return random.uniform(); });
  print_piece("cosine direction about a normal, two draws", repeats, [&](int) {
    const float u = random.uniform();
    const float v = random.uniform();
    return to_world(glm::vec3(0.6f, 0, 0.8f), cosine_hemisphere(u, v)).x;
  });
  print_piece("offset of a start", repeats, [&](int) {
    const float u = random.uniform();
    return offset_ray({u, 1 + u, 2}, {0.6f, 0, 0.8f}, 1e-5f).x;
  });
  print_piece("optical depth of a flight", repeats, [&](int) {
    const uint32_t r = random.bits();
    return static_cast<float>(-std::log((4294967296.0 - static_cast<double>(r)) * 0x1p-32));
  });
  const auto scene = furnished_room(Air::layered, {true, true});
  ResidentBricks bricks(scene->media);
  print_piece("free flight through six layers", repeats, [&](int) {
    const float z = 3 * random.uniform() - 1.5f;
    const float rise = 2 * random.uniform() - 1;
    const float tau = 3 * random.uniform();
    const glm::vec3 d(std::sqrt(1 - rise * rise), 0, rise);
    return free_flight<MediaNeed::layered>(scene->media, 0, {0, 0, z}, d, 5,
                                           static_cast<double>(tau), 0.5, bricks)
        .t;
  });
  print_piece("split of a weight", repeats, [&](int) {
    const uint32_t r = random.bits();
    return static_cast<float>(split(unit_weight - r, unit_weight / 3, r));
  });
  BatchScores scores;
  scores.reset(scene->layout);
  print_piece("detectors and voxels along 3 m", repeats, [&](int) {
    const float x = 10 * random.uniform() - 7;
    score_flight(*scene,
                 {{x, 0, 0}, {0.6f, 0.64f, 0.48f}, 3, unit_weight, 0, false, false, false, 0.5f},
                 scores);
    return x;
  });
}

}  // namespace luxodus::bench

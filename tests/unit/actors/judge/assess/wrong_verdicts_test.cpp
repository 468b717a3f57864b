// Noise makes few verdicts wrong: the test after each round of paths, on batches that were traced
// in rooms with heavy tails, and resampled.
#include "actors/judge/assess/wrong_verdicts.hpp"

#include <fmt/format.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/assess/view_light.hpp"
#include "scenes/light/intersect/embree_scene.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/trace.hpp"
#include "scenes/light/transport/value_scores.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"
#include "tests/kit/test_length.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr int rounds = 4;
constexpr size_t batches_of_round = 64, paths_of_batch = 8;

constexpr double levels[] = {0.1, 0.5, 0.9, 1.1, 2, 10};

const char* const thin_smoke = R"(
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.3
albedo = 0.9
)";

/// A value of many batches of eight paths.
using Batches = std::vector<double>;

/// What the paths of a view find, batch by batch: by part, as in ViewLight.
struct TracedView {
  SignView view;
  Sign sign;
  std::array<std::array<Batches, 5>, 3> parts;
};

std::string lit_room(const std::string& smoke) {
  return R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "white80"

[[emitter]]
name = "by the sign"
shape = "point"
distribution = "isotropic"
position = [11.4, 0.5, 2.4]
flux_lm = 400

[[emitter]]
name = "middle"
shape = "point"
distribution = "isotropic"
position = [6, 0, 2.9]
flux_lm = 3000
)" + exit_sign_at("[11.95, 0, 2.2]") +
         "white_reflectance = 0.5\n" + smoke + R"(
[assessment]
irritant_smoke = false

[run]
eye_path_factor = 1
batch_particles = 256

[[observer]]
name = "eye"
eye = [4, 0, 1.65]
gaze = [1, 0, 0]
)";
}

TracedView traced(const std::string& text, int64_t batches) {
  const auto described = described_text(text);
  auto compiled = compile_scene(described, Scenario{}, {});
  REQUIRE(compiled.ok());
  const CompiledScene& scene = *compiled.value();
  REQUIRE(scene.eye_targets.size() == 1);
  const EmbreeDevice device;
  const SceneIndex index(device, scene);
  const auto tracer = make_batch_tracer(scene, GeometryAccess::resident(index), 5);
  TracedView out;
  out.sign = described->signs.front();
  out.view = view_of_sign(out.sign, described->observers.front().eye);
  constexpr EyeQuantity quantities[] = {EyeQuantity::own, EyeQuantity::reflected,
                                        EyeQuantity::at_eye, EyeQuantity::transmission,
                                        EyeQuantity::visible};
  BatchScores scores;
  for (int64_t batch = 0; batch < batches; ++batch) {
    scores.reset(scene.layout);
    for (uint32_t part = 0; part < 3; ++part) {
      tracer->look(batch, part, scores);
      for (size_t q = 0; q < out.parts[part].size(); ++q) {
        const auto quantity = static_cast<uint32_t>(quantities[q]);
        const uint32_t bin = scene.eye_targets.front().first_bin + part;
        const size_t at = scene.layout.score_index(scene.blocks.views, bin, 0, quantity);
        out.parts[part][q].push_back(static_cast<double>(scores.scores[at]) *
                                     quantum_of(scene, scene.blocks.views, quantity));
      }
    }
  }
  return out;
}

double mean_of(const Batches& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Means of a round: 64 batches, each the mean of `size` batches drawn from those traced.
Uncertain drawn(const Batches& values, size_t size, std::mt19937_64& random) {
  double sum = 0, squares = 0;
  for (size_t batch = 0; batch < batches_of_round; ++batch) {
    double all = 0;
    for (size_t i = 0; i < size; ++i) all += values[random() % values.size()];
    const double mean = all / static_cast<double>(size);
    sum += mean;
    squares += mean * mean;
  }
  const double n = batches_of_round;
  const double variance = std::max(0.0, squares / n - (sum / n) * (sum / n));
  return {sum / n, std::sqrt(variance / (n - 1))};
}

ViewLight true_light(const TracedView& traced) {
  ViewLight out;
  for (size_t part = 0; part < out.size(); ++part) {
    const auto& values = traced.parts[part];
    out[part] = {{mean_of(values[0]), 0},
                 {mean_of(values[1]), 0},
                 {mean_of(values[2]), 0},
                 {mean_of(values[3]), 0},
                 {mean_of(values[4]), 0}};
  }
  return out;
}

ViewLight drawn_light(const TracedView& traced, int round, std::mt19937_64& random) {
  const size_t size = size_t{1} << (2 * round);
  ViewLight out = true_light(traced);  // own light, transmission and occlusion have no noise here
  for (size_t part = 0; part < out.size(); ++part) {
    out[part].reflected = drawn(traced.parts[part][1], size, random);
    out[part].at_eye = drawn(traced.parts[part][2], size, random);
  }
  return out;
}

/// What the sign adds to the luminance of its parts, so that a level has a chosen value.
struct Added {
  double white = 0, green = 0;
};

ViewLight with(ViewLight light, const Added& added) {
  light[0].own.value += added.white;
  light[1].own.value += added.green;
  return light;
}

Sight judged(const TracedView& traced, const ViewLight& light, double sure_errors) {
  return judge_sight(traced.sign, traced.view, look_of(traced.sign.face, light, 0),
                     {{65}, false, sure_errors});
}

/// The addition to white, or to both colours, for which the face is seen at this level.
Added added_for(const TracedView& traced, double level, bool silhouette) {
  const ViewLight light = true_light(traced);
  const SignLook look = look_of(traced.sign.face, light, 0);
  const double share = light[0].transmission.value;
  // Without this, legend and ground have one luminance, and the face that of its surround.
  Added equal;
  equal.white = -look.difference.value / share;
  const SignLook plain = look_of(traced.sign.face, with(light, equal), 0);
  if (silhouette)
    equal = {equal.white - plain.silhouette.value / share, -plain.silhouette.value / share};
  double low = 0, high = 1e9;
  Added out;
  for (int i = 0; i < 200; ++i) {
    const double middle = i < 60 ? std::sqrt(std::max(low, 1e-12) * high) : (low + high) / 2;
    out = equal;
    out.white += middle;
    if (silhouette) out.green += middle;
    (judged(traced, with(light, out), 0).seeing_level.value < level ? low : high) = middle;
  }
  return out;
}

/// Number of views, of `views` with this light, whose verdict noise makes wrong.
int wrong_of(const TracedView& traced, const Added& added, double sure_errors, int views,
             uint64_t seed) {
  std::mt19937_64 random(seed);
  const ViewLight exact = with(true_light(traced), added);
  const SightVerdict truth = judged(traced, exact, 0).verdict;
  int wrong = 0;
  for (int view = 0; view < views; ++view) {
    PooledLight pooled;
    for (int round = 0; round < rounds; ++round) {
      pooled.add(with(drawn_light(traced, round, random), added),
                 static_cast<double>(batches_of_round * paths_of_batch << (2 * round)));
      const SightVerdict verdict = judged(traced, pooled.mean(), sure_errors).verdict;
      if (verdict == SightVerdict::undecided) continue;
      wrong += verdict == truth ? 0 : 1;
      break;
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("a verdict needs as many standard errors as its share of the wrong ones allows") {
  // Quantiles of Student's t with 63 degrees of freedom.
  CHECK(sure_errors(0.05, {}, 64) == Approx(2.2962).epsilon(1e-4));
  CHECK(sure_errors(0.1, {1, 1, 1}, 64) == Approx(1.6694).epsilon(1e-4));
  CHECK(sure_errors(0.01, {500, 2, 4}, 64) == Approx(sure_errors(0.01 / 4000, {1, 1, 1}, 64)));
  CHECK(sure_errors(0.01, {0, 2, 4}, 64) == sure_errors(0.01, {1, 2, 4}, 64));
  CHECK(sure_errors(0.01, {500, 2, 4}, 64) > 5);
}

TEST_CASE("rounds are pooled by their paths, and rare bright paths may be unseen") {
  ViewLight first, second;
  first[0].reflected = {1, 0.5};
  second[0].reflected = {2, 0.5};
  first[0].own = second[0].own = {3, 0};
  PooledLight pooled;
  pooled.add(first, 100);
  pooled.add(second, 300);
  CHECK(pooled.mean()[0].reflected.value == Approx(1.75));
  CHECK(pooled.mean()[0].reflected.error == Approx(0.5 * std::hypot(0.25, 0.75)));
  CHECK(pooled.mean()[0].own.value == Approx(3));
  CHECK(pooled.mean()[0].own.error == 0);
  PooledLight smooth;
  first[0].reflected.error = 1e-9;
  smooth.add(first, 900);
  CHECK(smooth.mean()[0].reflected.error == Approx(limits::least_spread / 30));
}

TEST_CASE("noise makes few verdicts wrong, beside a lamp that few paths pass closely") {
  const int views = in_full() ? 100'000 : 1'000;
  for (const auto& text : {lit_room(""), lit_room(thin_smoke)}) {
    const TracedView view = traced(text, in_full() ? 8192 : 2048);
    for (const bool silhouette : {false, true})
      for (const double level : levels) {
        INFO("level " << level << (silhouette ? " of the silhouette" : " of the pattern"));
        const Added added = added_for(view, level, silhouette);
        for (const double each : {1e-2, 1e-3}) {
          const double sure = sure_errors(each, {1, 2, rounds}, batches_of_round);
          const int wrong = wrong_of(view, added, sure, views, 7);
          const double expected = each * views;
          CHECK(wrong <= expected + 4 * std::sqrt(expected));
        }
      }
  }
}

TEST_CASE("traced paths of many seeds give few wrong verdicts, on either side of a limit") {
  static const std::atomic<bool> nobody{false};
  const int seeds = in_full() ? 200 : 4;
  int reports = 0, wrong = 0, decided = 0;
  for (const auto& text : {lit_room(""), lit_room(thin_smoke)}) {
    const TracedView view = traced(text, 8192);
    for (const bool silhouette : {false, true})
      for (const double level : levels) {
        const Added added = added_for(view, level, silhouette);
        const double white = 500 + added.white, green = 50 + added.green;  // those of the sign
        REQUIRE(std::min(white, green) >= 0);
        const auto lit = described_text(
            replaced(text, "mains_white = 500\nmains_green = 50",
                     fmt::format("mains_white = {}\nmains_green = {}", white, green)));
        const SightVerdict truth = judged(view, with(true_light(view), added), 0).verdict;
        for (int seed = 1; seed <= seeds; ++seed) {
          AssessOptions options;
          options.seed = static_cast<uint64_t>(1000 * seed);
          options.threads = 2;
          options.rounds = 3;
          Assessment found;
          REQUIRE(
              assess_sights(
                  *lit, Scenario{}, {}, options, nobody, [](const std::string&, double) {}, found)
                  .ok());
          REQUIRE(found.sights.size() == 1);
          const SightVerdict verdict = found.sights.front().sight.verdict;
          ++reports;
          decided += verdict == SightVerdict::undecided ? 0 : 1;
          wrong += verdict == SightVerdict::undecided || verdict == truth ? 0 : 1;
        }
      }
  }
  const double allowed = limits::wrong_verdicts * reports;
  CHECK(wrong <= allowed + 4 * std::sqrt(allowed));
  CHECK(decided > reports / 4);
}

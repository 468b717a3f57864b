// The random scenes that every test run tries. README.md explains how to try more, and how to
// repeat one.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/random/check_scene.hpp"
#include "tests/random/check_scores.hpp"
#include "tests/random/features.hpp"
#include "tests/random/random_text.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Sanitizers take ten times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr uint64_t scenes = 300, texts = 300;
#else
constexpr uint64_t scenes = 2000, texts = 1500;
#endif
/// Features of less than 1 % of all scenes need this many scenes to appear.
constexpr uint64_t scenes_drawn = 3000;

std::string findings_of(const Verdict& verdict, const std::string& again) {
  std::string out;
  for (const std::string& finding : verdict.findings) out += finding + "\n";
  return out.empty() ? out : out + "again: random_scenes " + again + " --count 1 --first ";
}

}  // namespace

TEST_CASE(
    "random scenes are refused in a sentence, or traced to finite results without losing light") {
  const EmbreeDevice device(BuildThreads::calling);
  uint64_t accepted = 0;
  for (uint64_t number = 0; number < scenes; ++number) {
    const Verdict verdict = check_scene(random_scene(number), number, device);
    INFO(findings_of(verdict, "") << number);
    REQUIRE(verdict.findings.empty());
    accepted += verdict.accepted ? 1 : 0;
  }
  CHECK(accepted > scenes * 3 / 4);
  CHECK(accepted < scenes);
}

TEST_CASE("random scenes reach everything that a description can contain") {
  FeatureCounts counts;
  for (uint64_t number = 0; number < scenes_drawn; ++number)
    count_features(random_scene(number), counts);
  for (size_t i = 0; i < counts.size(); ++i) {
    INFO(features()[i].name);
    CHECK(counts[i] > 0);
  }
}

TEST_CASE("a random scene follows from its number alone") {
  const EmbreeDevice device(BuildThreads::calling);
  for (uint64_t number = 0; number < 20; ++number) {
    const Verdict once = check_scene(random_scene(number), number, device);
    const Verdict twice = check_scene(random_scene(number), number, device);
    CHECK(once.rays == twice.rays);
    CHECK(once.refusal == twice.refusal);
  }
}

TEST_CASE("random scene files are accepted, or refused with file and line") {
  const EmbreeDevice device(BuildThreads::calling);
  const test::TemporaryFolder folder;
  uint64_t accepted = 0;
  for (uint64_t number = 0; number < texts; ++number) {
    const Verdict verdict = check_text(number, folder / "scene.toml", device);
    INFO(findings_of(verdict, "--texts") << number);
    REQUIRE(verdict.findings.empty());
    accepted += verdict.accepted ? 1 : 0;
  }
  CHECK(accepted > texts / 10);
  CHECK(accepted < texts * 9 / 10);
}

namespace {

/// The first random scene that light interacts with, and one batch of it.
struct OneBatch {
  std::shared_ptr<const CompiledScene> scene;
  BatchScores scores;
};

OneBatch one_batch() {
  const EmbreeDevice device(BuildThreads::calling);
  for (uint64_t number = 0;; ++number) {
    const RandomScene drawn = random_scene(number);
    if (!drawn.closed) continue;
    const auto compiled = compile_scene(std::make_shared<const SceneDescription>(drawn.description),
                                        drawn.scenario, {1});
    if (!compiled.ok()) continue;
    OneBatch out;
    out.scene = compiled.value();
    const SceneIndex index(device, *out.scene);
    out.scores.reset(out.scene->layout);
    make_batch_tracer(*out.scene, GeometryAccess::resident(index), 1)->trace(0, 0, 50, out.scores);
    return out;
  }
}

/// The findings about the batch after it was modified.
template <class Harm>
Findings findings_after(const OneBatch& from, const Harm& harm) {
  OneBatch batch = from;
  batch.scores.scores.find_touched();
  harm(batch.scores);
  Findings findings;
  check_ledger(*batch.scene, batch.scores.balance, {true, false}, findings);
  check_batch(*batch.scene, batch.scores, findings);
  return findings;
}

}  // namespace

TEST_CASE("a unit of weight too many or too few is detected, wherever it is") {
  OneBatch batch = one_batch();
  batch.scores.scores.find_touched();
  CHECK(findings_after(batch, [](BatchScores&) {}).empty());
  CHECK_FALSE(findings_after(batch, [](BatchScores& s) { ++s.balance.emitted; }).empty());
  CHECK_FALSE(findings_after(batch, [](BatchScores& s) { --s.balance.absorbed_surfaces; }).empty());
  CHECK_FALSE(findings_after(batch, [](BatchScores& s) { ++s.balance.absorbed_media; }).empty());
  CHECK_FALSE(findings_after(batch, [](BatchScores& s) {
                ++s.balance.escaped;
                --s.balance.absorbed_surfaces;
              }).empty());
  const auto& layout = batch.scene->layout;
  for (const uint32_t block : {batch.scene->blocks.patches, batch.scene->blocks.escape}) {
    const int64_t at = layout.score_index(block, 0, 0, 0);
    CHECK_FALSE(findings_after(batch, [&](BatchScores& s) { ++*s.scores.touch(at); }).empty());
    CHECK_FALSE(findings_after(batch, [&](BatchScores& s) { *s.scores.touch(at) = -1; }).empty());
  }
}

// Particles whose numbers need more than 32 bits, like most of a run of 1e10. Their random numbers
// differ from those of the number modulo 2^32, and together they give equal light.
#include "scenes/light/transport/trace.hpp"
#include "tests/optics/posed_room.hpp"

namespace luxodus::light {
namespace {

constexpr int64_t batch_particles = 2048;
constexpr uint64_t two_to_32 = uint64_t{1} << 32;

std::shared_ptr<const CompiledScene> scene_of(bool stratified) {
  SceneDescription scene = posed_room();
  scene.run.stratified = stratified;
  scene.run.batch_particles = batch_particles;
  return compile(std::move(scene));
}

/// Scores of the particles of one batch, or of its eye paths alone.
std::vector<int64_t> scores_of(const BatchScores& batch) {
  std::vector<int64_t> out;
  for (size_t i = 0; i < batch.scores.size(); ++i) out.push_back(batch.scores[i]);
  return out;
}

}  // namespace

TEST_CASE("particles and eye paths whose numbers differ by 2 to the 32 are different") {
  for (const bool stratified : {true, false}) {
    INFO((stratified ? "stratified" : "plain"));
    const auto scene = scene_of(stratified);
    const EmbreeDevice device;
    const SceneIndex index(device, *scene);
    const auto tracer = make_batch_tracer(*scene, GeometryAccess::resident(index), 7);
    const auto traced = [&](uint64_t first) {
      BatchScores batch;
      batch.reset(scene->layout);
      tracer->trace(0, first, batch_particles, batch);
      CHECK(batch.balance.closes());
      return scores_of(batch);
    };
    const auto looked = [&](int64_t number) {
      BatchScores batch;
      batch.reset(scene->layout);
      for (uint32_t unit = 0; unit < tracer->look_units(); ++unit)
        tracer->look(number, unit, batch);
      return scores_of(batch);
    };
    const std::vector<int64_t> first = traced(0), eyes = looked(0);
    CHECK(first == traced(0));
    CHECK(eyes == looked(0));
    for (const uint64_t far : {two_to_32, 2 * two_to_32, uint64_t{1} << 43})
      CHECK(first != traced(far));
    CHECK(traced(two_to_32) != traced(2 * two_to_32));
    // Eye paths are numbered from the batch's number times 2^28.
    for (const int64_t far : {int64_t{16}, int64_t{1} << 32}) CHECK(eyes != looked(far));
    CHECK(looked(16) != looked(32));
  }
}

TEST_CASE("particles beyond 2 to the 33 give the light of the first") {
  const auto scene = scene_of(true);
  constexpr int64_t batches = 64;
  const auto run = [&](int64_t before) {
    auto out = std::make_unique<Traced>(scene, 1, 2);
    StopRule stop;
    out->local().resume(before);
    stop.particles = (before + batches) * batch_particles;
    const std::atomic<bool> interrupt{false};
    out->local().run(stop, interrupt, [](const Progress&) {});
    REQUIRE(out->balance().particles == uint64_t{batches * batch_particles});
    return out;
  };
  const auto near = run(0), far = run(static_cast<int64_t>(2 * two_to_32) / batch_particles);
  CHECK(near->balance().rays != far->balance().rays);
  for (const std::string& thing : room_things) {
    INFO(thing);
    check_agree(near->absorbed_by(thing), far->absorbed_by(thing), 2 * half_percent);
    CHECK(near->absorbed_by(thing).value != far->absorbed_by(thing).value);
  }
}

}  // namespace luxodus::light

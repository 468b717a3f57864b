#include "actors/cast/parts/reference_profile.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <optional>
#include <utility>

#include "actors/cast/parts/parts_source.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace {

/// For a group with hardly any share: enough to see which parts its light visits.
constexpr int64_t min_particles = 256;
/// Added to the seed: the profile's histories differ from the run's.
constexpr uint64_t other_histories = 0x9E3779B97F4A7C15;

/// All parts of a scene for one tracer, built on request; counts the requests.
class CountingParts final : public PartsSource<CountingParts> {
 public:
  CountingParts(const CompiledScene& scene, const SceneObjects& objects, uint64_t budget_bytes)
      : PartsSource(objects.parts()),
        objects_(objects),
        builder_(scene, objects.parts()),
        budget_bytes_(budget_bytes),
        built_(objects.places().size()),
        visited_in_(built_.size(), 0),
        bytes_of_(built_.size(), 0) {}

  /// Counts requests into `counts` from now on.
  void count_into(ReferenceCounts& counts) {
    counts_ = &counts;
    counts.references.assign(built_.size(), 0);
    counts.visits.assign(built_.size(), 0);
  }
  void begin_history() { ++history_; }

  bool spoilt() override { return problem_.has_value(); }
  const std::optional<Problem>& problem() const { return problem_; }
  const std::vector<uint64_t>& bytes_of() const { return bytes_of_; }

 private:
  friend PartsSource;

  struct Built {
    std::shared_ptr<const BuiltObject> object;
    std::list<uint32_t>::iterator place;
  };

  const BuiltObject* part(uint32_t number, std::span<const Candidate>) {
    ++counts_->references[number];
    if (visited_in_[number] != history_) {
      visited_in_[number] = history_;
      ++counts_->visits[number];
    }
    Built& built = built_[number];
    if (built.object == nullptr) return build(number);
    used_.splice(used_.end(), used_, built.place);
    return built.object.get();
  }

  const BuiltObject* build(uint32_t number) {
    auto object = builder_.built(number, objects_.bytes(number).bytes);
    if (!object) {
      problem_ = object.problem();
      return nullptr;
    }
    const size_t bytes = object.value()->bytes();
    bytes_of_[number] = bytes;
    resident_bytes_ += bytes;
    while (resident_bytes_ > budget_bytes_ && !used_.empty()) {
      Built& oldest = built_[used_.front()];
      resident_bytes_ -= oldest.object->bytes();
      oldest.object.reset();
      used_.pop_front();
    }
    built_[number] = {std::move(object).value(), used_.insert(used_.end(), number)};
    return built_[number].object.get();
  }

  const SceneObjects& objects_;
  PartBuilder builder_;
  uint64_t budget_bytes_;
  std::vector<Built> built_;
  std::list<uint32_t> used_;  // the least recently used first
  uint64_t resident_bytes_ = 0;
  std::vector<uint64_t> visited_in_;  // by object: the last history that requested it
  uint64_t history_ = 0;
  ReferenceCounts* counts_ = nullptr;
  std::vector<uint64_t> bytes_of_;
  std::optional<Problem> problem_;
};

}  // namespace

std::vector<int64_t> profile_particles(const std::vector<double>& group_share, int64_t particles) {
  const int64_t all = std::min(particles, limits::profile_particles);
  std::vector<int64_t> by_group;
  for (const double share : group_share)
    by_group.push_back(
        std::max<int64_t>(min_particles, std::llround(share * static_cast<double>(all))));
  return by_group;
}

Result<ReferenceProfile> count_references(const CompiledScene& scene, const SceneObjects& objects,
                                          const ProxyScene& proxies, uint64_t seed,
                                          const std::vector<int64_t>& particles,
                                          uint64_t budget_bytes) {
  CountingParts parts(scene, objects, budget_bytes);
  const auto tracer =
      make_batch_tracer(scene, GeometryAccess::through(proxies, parts), seed + other_histories);
  BatchScores scores;
  scores.reset(scene.layout);
  ReferenceProfile profile;
  profile.scene_hash = scene.scene_hash;
  profile.groups.resize(particles.size());
  for (size_t g = 0; g < particles.size(); ++g) {
    profile.groups[g].units = particles[g];
    parts.count_into(profile.groups[g]);
    for (int64_t particle = 0; particle < particles[g]; ++particle) {
      parts.begin_history();
      tracer->trace(static_cast<int>(g), static_cast<uint64_t>(particle), 1, scores);
      if (parts.problem()) return *parts.problem();
    }
  }
  profile.eyes.units = 1;
  parts.count_into(profile.eyes);
  for (uint32_t unit = 0; unit < tracer->look_units(); ++unit) {
    parts.begin_history();
    tracer->look(0, unit, scores);
    if (parts.problem()) return *parts.problem();
  }
  profile.built_bytes = parts.bytes_of();
  return profile;
}

}  // namespace luxodus

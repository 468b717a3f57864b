// All parts of a scene for one tracer, built on request and kept; it counts and reports the
// requests. For measuring and recording references. Thread rule: one thread.
#pragma once

#include <functional>
#include <optional>

#include "actors/cast/parts/parts_source.hpp"
#include "actors/cast/parts/scene_objects.hpp"

namespace luxodus {

class ResidentParts final : public PartsSource<ResidentParts> {
 public:
  /// Called before an object is returned.
  using EmitterSample = std::function<void(uint32_t object)>;

  /// Requires: both outlive this.
  ResidentParts(const CompiledScene& scene, const SceneObjects& objects, EmitterSample asked = {})
      : PartsSource(objects.parts()),
        objects_(objects),
        builder_(scene, objects.parts()),
        asked_(std::move(asked)),
        built_(objects.places().size()) {}

  bool spoilt() override { return problem_.has_value(); }

  uint64_t references() const { return references_; }
  /// Why a part could not be built.
  const std::optional<Problem>& problem() const { return problem_; }
  /// Memory of a built part; 0 if it was never requested.
  size_t built_bytes(uint32_t object) const {
    return built_[object] == nullptr ? 0 : built_[object]->bytes();
  }

 private:
  friend PartsSource;

  const BuiltObject* part(uint32_t number, std::span<const Candidate>) {
    ++references_;
    if (asked_) asked_(number);
    if (built_[number] == nullptr) build(number);
    return built_[number].get();
  }
  void build(uint32_t number) {
    auto object = builder_.built(number, objects_.bytes(number).bytes);
    if (object)
      built_[number] = std::move(object).value();
    else
      problem_ = object.problem();
  }

  const SceneObjects& objects_;
  PartBuilder builder_;
  const EmitterSample asked_;
  std::vector<std::shared_ptr<const BuiltObject>> built_;
  std::optional<Problem> problem_;
  uint64_t references_ = 0;
};

}  // namespace luxodus

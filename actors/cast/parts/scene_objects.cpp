#include "actors/cast/parts/scene_objects.hpp"

#include <algorithm>
#include <array>

namespace luxodus {

SceneObjects::SceneObjects(const CompiledScene& scene, std::span<const NodeId> holders,
                           uint32_t replicas)
    : parts_(scene),
      packed_(scene.description->packed),
      file_(packed_ != nullptr ? packed_->file->name() : scene.description->file) {
  if (packed_ == nullptr) {
    encode(scene);
  } else {
    for (const PackedScene::Object& object : packed_->objects)
      places_.push_back({object.id, object.wire_bytes, {}});
  }
  for (size_t object = 0; object < places_.size(); ++object) {
    ObjectPlace& place = places_[object];
    for (uint32_t r = 0; r < replicas; ++r)
      place.holders.push_back(holders[(object + r) % holders.size()]);
    wire_bytes_ += place.wire_bytes;
    largest_wire_bytes_ = std::max(largest_wire_bytes_, place.wire_bytes);
    largest_build_bytes_ =
        std::max(largest_build_bytes_, peak_build_bytes_of(parts_[object].kind, place.wire_bytes));
  }
}

void SceneObjects::encode(const CompiledScene& scene) {
  for (size_t i = 0; i < parts_.count(); ++i) {
    auto bytes = std::make_shared<const std::vector<std::byte>>(encode_part(scene, parts_[i]));
    places_.push_back({object_id_of(*bytes), bytes->size(), {}});
    bytes_.push_back(std::move(bytes));
  }
}

void SceneObjects::place(const std::vector<std::vector<NodeId>>& holders) {
  for (size_t object = 0; object < places_.size(); ++object)
    places_[object].holders = holders[object];
}

SharedBytes SceneObjects::bytes(uint32_t object) const {
  if (packed_ != nullptr) return {packed_->file->object(object), packed_};
  return {std::span(*bytes_[object]), bytes_[object]};
}

std::string SceneObjects::stored_name(uint32_t object) const {
  return "scene part " + std::to_string(object) + " of " + file_;
}

uint64_t built_bytes_of(const CompiledScene& scene) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < objects.places().size(); ++i) bytes += objects.built_bytes(i);
  return bytes;
}

HeldObjects::HeldObjects(const SceneObjects& objects, NodeId self) : objects_(objects) {
  for (uint32_t object = 0; object < objects.places().size(); ++object) {
    const auto& holders = objects.places()[object].holders;
    if (std::find(holders.begin(), holders.end(), self) != holders.end())
      held_.emplace_back(objects.places()[object].id, object);
  }
  std::sort(held_.begin(), held_.end());
}

SharedBytes HeldObjects::find(ObjectId object) {
  const auto at = std::lower_bound(held_.begin(), held_.end(), std::pair(object, uint32_t{0}));
  return at != held_.end() && at->first == object ? objects_.bytes(at->second) : SharedBytes{};
}

const BuiltObject* CachedObjects::part(uint32_t object, std::span<const Candidate> next) {
  const BuiltObject* found = cache_.find(object);
  return found != nullptr ? found : wait_for(object, next);
}

const BuiltObject* CachedObjects::wait_for(uint32_t object, std::span<const Candidate> next) {
  // This fiber's particles will be discarded, which it has not noticed yet: no more waiting.
  const FiberId self = fibers_.current()->id();
  if (std::find(refused_.begin(), refused_.end(), self) != refused_.end()) return nullptr;
  ahead_.clear();
  for (const Candidate& c : next.first(std::min(prefetch_, next.size()))) ahead_.push_back(c.cell);
  const uint64_t particle = fibers_.current()->subject();
  const bool traced = trace_ != nullptr && trace_->wants(particle);
  if (traced) trace_->begin(TraceKind::wait, particle, object);
  const Got got = cache_.get(object, traced, ahead_);
  if (traced) trace_->end(TraceKind::wait, particle, object);
  if (got.how == Got::How::resident) return got.object;
  refused_.push_back(self);
  return nullptr;
}

bool CachedObjects::spoilt() {
  return !refused_.empty() && std::erase(refused_, fibers_.current()->id()) > 0;
}

}  // namespace luxodus

#include "actors/objects/scene_objects.hpp"

#include <algorithm>

namespace luxodus {

SceneObjects::SceneObjects(const CompiledScene& scene, std::span<const NodeId> holders,
                           uint32_t replicas)
    : packed_(scene.description->packed) {
  if (packed_ == nullptr) {
    encode(scene);
  } else {
    for (const PackedGeometry::Cell& cell : packed_->cells)
      places_.push_back({cell.object, cell.wire_bytes, {}});
  }
  for (size_t cell = 0; cell < places_.size(); ++cell) {
    ObjectPlace& place = places_[cell];
    for (uint32_t r = 0; r < replicas; ++r)
      place.holders.push_back(holders[(cell + r) % holders.size()]);
    wire_bytes_ += place.wire_bytes;
    largest_wire_bytes_ = std::max(largest_wire_bytes_, place.wire_bytes);
  }
}

void SceneObjects::encode(const CompiledScene& scene) {
  for (const GeometryCell& cell : scene.cells) {
    auto bytes = std::make_shared<const std::vector<std::byte>>(encode_cell(cell));
    places_.push_back({object_id_of(*bytes), bytes->size(), {}});
    bytes_.push_back(std::move(bytes));
  }
}

void SceneObjects::place(const std::vector<std::vector<NodeId>>& holders) {
  for (size_t cell = 0; cell < places_.size(); ++cell) places_[cell].holders = holders[cell];
}

SharedBytes SceneObjects::bytes(uint32_t cell) const {
  if (packed_ != nullptr) return {packed_->file->object(cell), packed_};
  return {std::span(*bytes_[cell]), bytes_[cell]};
}

HeldCells::HeldCells(const SceneObjects& objects, NodeId self) : objects_(objects) {
  for (uint32_t cell = 0; cell < objects.places().size(); ++cell) {
    const auto& holders = objects.places()[cell].holders;
    if (std::find(holders.begin(), holders.end(), self) != holders.end())
      held_.emplace_back(objects.places()[cell].id, cell);
  }
  std::sort(held_.begin(), held_.end());
}

SharedBytes HeldCells::find(ObjectId object) {
  const auto at = std::lower_bound(held_.begin(), held_.end(), std::pair(object, uint32_t{0}));
  return at != held_.end() && at->first == object ? objects_.bytes(at->second) : SharedBytes{};
}

BuiltCell::BuiltCell(const EmbreeDevice& device, GeometryCell cell) : cell_(std::move(cell)) {
  const int64_t before = device.bytes();
  scene_ = std::make_unique<CellScene>(device, cell_);
  bytes_ = sizeof *this + static_cast<size_t>(device.bytes() - before) +
           cell_.triangles.capacity() * sizeof(TriangleRecord) +
           cell_.texture_uv.capacity() * sizeof(GeometryCell::TriangleUv);
}

CellBuilder::CellBuilder(const CompiledScene& scene)
    : limits_{static_cast<uint32_t>(scene.surfaces.size()), scene.patch_count} {}

void CellBuilder::build(uint32_t object, SharedBytes bytes, Client& client) {
  auto cell = decode_cell(bytes.bytes, limits_);
  if (!cell.ok()) return client.built(object, cell.problem());
  client.built(object, std::unique_ptr<BuiltObject>(
                           std::make_unique<BuiltCell>(device_, std::move(cell).value())));
}

const CellScene* CachedCells::cell(uint32_t cell) {
  const BuiltObject* object = cache_.find(cell);
  if (object == nullptr) {
    const uint64_t particle = fibers_.current()->subject();
    const bool traced = trace_ != nullptr && trace_->wants(particle);
    if (traced) trace_->begin(TraceKind::wait, particle, cell);
    const Got got = cache_.get(cell, traced);
    if (traced) trace_->end(TraceKind::wait, particle, cell);
    if (got.how != Got::How::resident) {
      refused_.push_back(fibers_.current()->id());
      return nullptr;
    }
    object = got.object;
  }
  return &static_cast<const BuiltCell*>(object)->scene();
}

bool CachedCells::spoilt() {
  return !refused_.empty() && std::erase(refused_, fibers_.current()->id()) > 0;
}

}  // namespace luxodus

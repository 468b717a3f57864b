// The objects of a run as this room knows them: names, sizes, bytes, and where to ask for them.
// What the bytes mean is the business of whoever packs and builds them. Plain values, any thread; a
// store belongs to one node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/core/hash.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/net/outbox.hpp"

namespace luxodus {

namespace limits {
/// Nodes that hold one object: its owner and replicas. Beyond three losses at once a run has other
/// troubles than a missing object.
inline constexpr size_t holders = 4;
}  // namespace limits

/// An object of the run, the same at every node. Nodes name it by its place in the list of all.
struct ObjectPlace {
  ObjectId id;
  uint64_t wire_bytes = 0;      // of the object as it travels, not 0
  std::vector<NodeId> holders;  // in the order in which to ask; perhaps this node itself
};

/// What this node has of the run's objects, in memory or in a file.
class ObjectStore {
 public:
  virtual ~ObjectStore() = default;
  /// The object's bytes; empty where this node does not hold it. Asked at every fetch that
  /// comes or passes here: it must not take long.
  virtual SharedBytes find(ObjectId object) = 0;
  /// The bytes of the object at this place of the run's list, for this node itself when nobody else
  /// gives them; empty where there is no storage.
  virtual SharedBytes find_in_storage([[maybe_unused]] uint32_t object) { return {}; }
  /// What people know the object at this place by, and where it is stored: "scene part 7 of
  /// tower.luxpack"; empty where there is no storage.
  virtual std::string stored_name([[maybe_unused]] uint32_t object) const { return {}; }
};

}  // namespace luxodus

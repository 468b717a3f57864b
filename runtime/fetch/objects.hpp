// The objects of a run: ids, sizes, bytes, and their holders. Only packers and builders interpret
// the bytes. Plain values, any thread; a store belongs to one node.
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
/// Most nodes that hold one object: its owner and replicas. After three simultaneous losses a run
/// has worse problems than a missing object.
inline constexpr size_t holders = 4;
}  // namespace limits

/// An object of the run, the same at every node. Nodes refer to it by its index in the list of all.
struct ObjectPlace {
  ObjectId id;
  uint64_t wire_bytes = 0;      // serialised size, not 0
  std::vector<NodeId> holders;  // in the order in which to ask; may include this node
};

/// The objects that this node holds, in memory or in a file.
class ObjectStore {
 public:
  virtual ~ObjectStore() = default;
  /// The object's bytes; empty if this node does not hold it. Called for every request that arrives
  /// or passes: it must be fast.
  virtual SharedBytes find(ObjectId object) = 0;
  /// The bytes of the object at this index, for this node itself when no other delivers them; empty
  /// if there is no storage.
  virtual SharedBytes find_in_storage([[maybe_unused]] uint32_t object) { return {}; }
  /// The object's name and storage for people: "part 7 of tower.pack"; empty if there is
  /// no storage.
  virtual std::string stored_name([[maybe_unused]] uint32_t object) const { return {}; }
};

}  // namespace luxodus

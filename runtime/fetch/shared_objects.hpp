// The resident objects of all nodes of one process, so that they share one copy: one node builds an
// object, and the others take it. Nothing is kept here: an object lives as long as some node has it
// resident. Each node that takes it is charged in full, since it alone may keep it alive; so the
// total memory is at most the sum of the charges. Thread rule: any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "runtime/fetch/object_builder.hpp"

namespace luxodus {

class SharedObjects {
 public:
  /// For a run with this many objects.
  explicit SharedObjects(size_t objects) : ready_(objects) {}

  /// The object if a node has it resident; else null.
  std::shared_ptr<const BuiltObject> find(uint32_t object) const {
    const std::lock_guard lock(mutex_);
    return ready_[object].lock();
  }
  /// Announces a built object. Returns the one to use: an equal one that another node announced
  /// before, or the same.
  std::shared_ptr<const BuiltObject> add(uint32_t object,
                                         std::shared_ptr<const BuiltObject> built) {
    const std::lock_guard lock(mutex_);
    if (auto earlier = ready_[object].lock()) return earlier;
    ready_[object] = built;
    return built;
  }

 private:
  mutable std::mutex mutex_;  // held for a few instructions, at a miss or a build
  std::vector<std::weak_ptr<const BuiltObject>> ready_;
};

}  // namespace luxodus

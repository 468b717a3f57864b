// What the nodes of one process have ready for use, so that they share one copy of it: an object is
// built by one of them, and the others take it as it is. Nothing is kept here: an object lives as
// long as some node has it resident. A node that takes it charges it to its own budget in full,
// since it keeps it alive whatever the others do; what all take together is then at most the sum of
// what they are charged. Thread rule: any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "runtime/fetch/object_builder.hpp"

namespace luxodus {

class SharedObjects {
 public:
  /// For a run of so many objects.
  explicit SharedObjects(size_t objects) : ready_(objects) {}

  /// The object, where a node has it ready; else null.
  std::shared_ptr<const BuiltObject> find(uint32_t object) const {
    const std::lock_guard lock(mutex_);
    return ready_[object].lock();
  }
  /// Says that this is ready. Returns what is to be used instead: what another node has said
  /// meanwhile, or the same.
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

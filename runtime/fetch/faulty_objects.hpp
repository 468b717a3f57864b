// A store with injected read failures, as of a broken disk: while a fault of the plan holds, the
// node reports that it does not have its objects, and must ask others for them. Without a plan it
// is not created. Thread rule: one node's thread.
#pragma once

#include "runtime/core/clock.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/fetch/objects.hpp"

namespace luxodus {

class FaultyObjects final : public ObjectStore {
 public:
  /// The plan's times count from construction. Requires: all references outlive this.
  FaultyObjects(ObjectStore& below, NodeId self, const FaultPlan& plan, const Clock& clock)
      : below_(below), self_(self), plan_(plan), clock_(clock), began_(clock.now()) {}

  SharedBytes find(ObjectId object) override {
    return fails() ? SharedBytes{} : below_.find(object);
  }
  SharedBytes find_in_storage(uint32_t object) override {
    return fails() ? SharedBytes{} : below_.find_in_storage(object);
  }

  std::string stored_name(uint32_t object) const override { return below_.stored_name(object); }

 private:
  bool fails() const { return plan_.holds(Fault::Kind::failed_read, self_, clock_.now() - began_); }

  ObjectStore& below_;
  const NodeId self_;
  const FaultPlan& plan_;
  const Clock& clock_;
  const Nanoseconds began_;
};

}  // namespace luxodus

// A store with injected full-disk faults: while a fault of the plan holds, an append writes half of
// its bytes and fails. Without a plan it is not created. Thread rule: one node's thread.
#pragma once

#include <memory>

#include "runtime/core/clock.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/storage/append_store.hpp"

namespace luxodus {

class FaultyStore final : public AppendStore {
 public:
  /// The plan's times count from construction. Requires: `clock` outlives this.
  FaultyStore(std::unique_ptr<AppendStore> below, NodeId self, const FaultPlan& plan,
              const Clock& clock)
      : below_(std::move(below)), self_(self), plan_(plan), clock_(clock), began_(clock.now()) {}

  uint64_t size() const override { return below_->size(); }
  Result<void> read(uint64_t offset, std::span<std::byte> into) override {
    return below_->read(offset, into);
  }
  Result<void> append(std::span<const std::byte> bytes) override {
    if (!full()) return below_->append(bytes);
    (void)below_->append(bytes.first(bytes.size() / 2));
    return problem("no space is left (a fault on purpose)", ProblemKind::no_room);
  }
  Result<void> truncate(uint64_t size) override { return below_->truncate(size); }

 private:
  bool full() const { return plan_.holds(Fault::Kind::full_disk, self_, clock_.now() - began_); }

  const std::unique_ptr<AppendStore> below_;
  const NodeId self_;
  const FaultPlan plan_;
  const Clock& clock_;
  const Nanoseconds began_;
};

}  // namespace luxodus

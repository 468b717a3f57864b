// The coordinator of successive works on changing states of a scene, as in a live view. Towards its
// workers it behaves like a run's coordinator. Batches come from the current work and are counted
// into its totals; nothing is journaled, since the giver of the work is on this node. A lease names
// the state of its batch; a worker that does not know it asks for it. When another state is
// entered, all leases of the previous one have been fenced. Thread rule: its node's thread.
#pragma once

#include <functional>
#include <optional>
#include <set>

#include "actors/cast/coordinator/coordinator.hpp"
#include "actors/results/run/executor.hpp"

namespace luxodus {

class StateCoordinator final : public Coordinator {
 public:
  /// `done` is called after each work. Requires: all references outlive this.
  StateCoordinator(const CoordinatorConfig& config, const CompiledScene& first,
                   std::function<void()> done, Scheduler& scheduler, Network& network,
                   Sender& sender);

  /// Begins to lead workers as they join. Requires: the scheduler has a fiber for it.
  void start();

  /// Sends workers a state that may be entered next.
  void foresee(const StateObject& state);
  /// Requires: no work is in progress.
  void enter(const StateObject& state);
  /// Leases the batches of `work`. Requires: none is in progress; `work` outlives it.
  void begin(Work& work);
  /// Ends the work: leased batches that are not being counted are given back to it.
  void stop();
  bool working() const { return work_ != nullptr; }
  /// Tells all workers that there is no more work.
  void end();

  using Coordinator::on;
  void on(const Letter<AskState>& ask) override;

  /// Number of workers present.
  size_t workers_here() const;
  /// Consecutive looks at which none of them could enter the state.
  uint64_t stuck() const { return stuck_; }
  /// Why none will ever join: they work for another run.
  const std::optional<Problem>& fault() const { return fault_; }

 private:
  void look_at_work(Nanoseconds now) override;
  void look_at_totals() override {}
  void all_are_here() override {}
  ObjectId state() const override { return state_ ? state_->id : ObjectId{}; }
  void lent() override { fill_book(); }
  Totals& totals() override { return work_->totals(); }
  BinRange bins() const override { return {0, work_->totals().layout().totals()}; }
  bool holds_back(size_t) override { return false; }
  void counted(const Letter<Flush>& letter, std::span<const int64_t> batches) override;
  RunEnded end_word() const override { return {round(), ""}; }
  bool hurries() const override { return true; }
  void wait_for_farewells(Nanoseconds now) override;
  void farewell_heard() override { leave_when_told(); }
  void worker_came(NodeId worker) override;

  void fill_book();
  void take_back_lost();
  void give_back(const std::set<int64_t>& batches);
  void end_when_done();
  void leave_when_told();
  void note_refusal();
  /// A state with its id: computing the id hashes its bytes, which may be megabytes.
  struct Named {
    StateObject object;
    ObjectId id;
  };
  const StateObject* known(ObjectId id) const;

  const std::function<void()> done_;
  std::optional<Named> state_, foreseen_;
  Work* work_ = nullptr;
  bool all_given_ = false;  // the work has no more batches
  std::set<int64_t> out_;   // its batches that are here, neither counted nor given back
  uint64_t stuck_ = 0;
  std::optional<Problem> fault_;
};

}  // namespace luxodus

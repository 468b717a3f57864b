// The coordinator of work that comes piece by piece, of states of a scene that change: for a live
// view, say. Downwards it is a coordinator as the one that leads a run. Its batches come from the
// work under way and its totals are that work's; nothing is kept for a crash, since whoever gave
// the work is on this node. A lease names the state that its batch is of; who does not know that
// asks for it. When another state is entered, all leases of the one before have been fenced.
// Thread rule: its node's thread.
#pragma once

#include <functional>
#include <optional>
#include <set>

#include "actors/cast/coordinator/coordinator.hpp"
#include "actors/results/run/executor.hpp"

namespace luxodus {

class StateCoordinator final : public Coordinator {
 public:
  /// `done` is called when a work is. All that is referred to must outlive it.
  StateCoordinator(const CoordinatorConfig& config, const CompiledScene& first,
                   std::function<void()> done, Scheduler& scheduler, Network& network,
                   Sender& sender);

  /// Waits for workers from now on, and does with those that come. Requires: the scheduler has a
  /// fiber for it.
  void start();

  /// Tells workers of a state that may be entered next.
  void foresee(const StateObject& state);
  /// Requires: no work is under way.
  void enter(const StateObject& state);
  /// Lends what `work` gives. Requires: none is under way; `work` outlives it.
  void begin(Work& work);
  /// What is lent, and not being counted, comes too late: it is given back.
  void stop();
  bool working() const { return work_ != nullptr; }
  /// Tells all that there is no more to come.
  void end();

  using Coordinator::on;
  void on(const Letter<AskState>& ask) override;

  /// Workers that are here.
  size_t workers_here() const;
  /// Looks in a row at which none of them could enter the state.
  uint64_t stuck() const { return stuck_; }
  /// Why none will ever come: they work for another.
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
  /// A state, and its name: to make that its bytes are hashed, which may be megabytes.
  struct Named {
    StateObject object;
    ObjectId id;
  };
  const StateObject* known(ObjectId id) const;

  const std::function<void()> done_;
  std::optional<Named> state_, foreseen_;
  Work* work_ = nullptr;
  bool all_given_ = false;  // the work has no more
  std::set<int64_t> out_;   // its batches that are here, and neither counted nor given back
  uint64_t stuck_ = 0;
  std::optional<Problem> fault_;
};

}  // namespace luxodus

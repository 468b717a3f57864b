// A coordinator that leads some of a run's nodes on behalf of another coordinator. Downwards it
// behaves like the run's coordinator. Upwards it behaves like a tracing node: the node's tracer
// asks for batches and flushes what is merged, but here leases are passed on, not traced. Work
// merged since its last flush upwards is nowhere else: if the node is lost, it is traced again. It
// has two sets of totals: one is filled while the other is packed. Thread rule: its node's thread.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "actors/cast/coordinator/coordinator.hpp"
#include "actors/results/run/leased_work.hpp"

namespace luxodus {

class SubCoordinator final : public Coordinator, public LeasedWork {
 public:
  /// Requires: all references outlive this.
  SubCoordinator(const CoordinatorConfig& config, const CompiledScene& scene, LeasePort& port,
                 Scheduler& scheduler, Network& network, Sender& sender);

  /// Begins to wait for its workers. Requires: the scheduler has a fiber for it.
  void start();

  // ---- towards the coordinator above ------------------------------------------------------------

  void enter_round(uint32_t round) override { counters_.round = round; }
  void add(uint64_t lease, int64_t batch) override;
  void drop(std::span<const uint64_t> leases) override;
  void drop_all() override;
  void look_again() override;
  Totals& give_totals() override;
  bool may_give() const override { return !adding(); }
  const Totals& totals() const override { return totals_[0]; }
  size_t at_hand() const override { return lease_of_.size(); }
  /// Totals merged since the last give_totals().
  const Totals& merged() const { return totals_[merging_]; }
  void end(const std::string& why) override;
  void abandon() override;
  bool end_is_known() const override { return all_know_end(); }
  void let_go() override;
  bool gone() const override { return abandoned_ || ended(); }

 private:
  void look_at_work(Nanoseconds now) override;
  void look_at_totals() override {}
  void all_are_here() override { begin("all are here"); }
  void lent() override { want_more(); }
  Totals& totals() override { return totals_[merging_]; }
  bool holds_back(size_t leases) override;
  void counted(const Letter<Flush>& letter, std::span<const int64_t> batches) override;
  RunEnded end_word() const override { return {round(), why_ended_}; }
  /// After a restart, it may not have heard yet of workers that its earlier incarnation led.
  bool tells_all() const override { return true; }
  void wait_for_farewells(Nanoseconds now) override;

  uint32_t tracers_here() const;
  void begin(const std::string& how);
  size_t wish() const;
  void want_more();
  void give_back_lost();
  void remove(std::set<int64_t> batches);
  std::string missing() const;

  LeasePort& port_;
  Totals totals_[2];
  size_t merging_ = 0;
  std::map<int64_t, uint64_t> lease_of_;  // of unmerged batches: the lease from above
  Nanoseconds began_ = 0;
  std::set<int64_t> lost_;  // batches to be given back
  std::string why_ended_;
  bool abandoned_ = false;
};

}  // namespace luxodus

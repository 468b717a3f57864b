#include "actors/cast/coordinator/sub_coordinator.hpp"

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

SubCoordinator::SubCoordinator(const CoordinatorConfig& config, const CompiledScene& scene,
                               LeasePort& port, Scheduler& scheduler, Network& network,
                               Sender& sender)
    : Coordinator(config, scene, LeaseBook(0, {}, config.first_lease), scheduler, network, sender),
      port_(port),
      totals_{{scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene)},
              {scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene)}} {}

void SubCoordinator::start() {
  Coordinator::start();
  began_ = clock().now();
}

// ---- leases ----------------------------------------------------------------------------------

/// Asks for nothing before: the run begins when all its nodes are present. Nodes that are missing
/// by then may have joined another coordinator.
void SubCoordinator::begin(const std::string& how) {
  begun_ = true;
  log_info("coordinator=begun workers={} tracers={} text=\"{}\"", config_.workers.size(),
           tracers_here(), how);
  // Even if no worker is here: the run waits for this node.
  port_.want_leases(std::max<size_t>(wish(), 1));
}

/// A batch that is here already has a lease whose fencing was not heard of.
void SubCoordinator::add(uint64_t lease, int64_t batch) {
  if (lease_of_.insert_or_assign(batch, lease).second) book_.add(batch);
}

void SubCoordinator::drop(std::span<const uint64_t> leases) {
  const std::set<uint64_t> named(leases.begin(), leases.end());
  std::set<int64_t> batches;
  for (const auto& [batch, lease] : lease_of_)
    if (named.count(lease) > 0) batches.insert(batch);
  remove(std::move(batches));
}

void SubCoordinator::drop_all() {
  std::set<int64_t> batches;
  for (const auto& [batch, lease] : lease_of_) batches.insert(batch);
  remove(std::move(batches));
}

/// A batch whose flush is being counted is merged under its lease all the same, and that flush is
/// refused above.
void SubCoordinator::remove(std::set<int64_t> batches) {
  std::set<int64_t> kept = batches;
  tell_fenced(book_.remove(kept));
  for (const int64_t batch : batches)
    if (kept.count(batch) == 0) lease_of_.erase(batch);
}

void SubCoordinator::look_again() {
  offer_batches();
  go_on_counting();
  want_more();
}

uint32_t SubCoordinator::tracers_here() const {
  uint32_t tracers = 0;
  for (const auto& [worker, peer] : peers_)
    if (peer.traces()) tracers += tracers_of(worker);
  return tracers;
}

std::string SubCoordinator::missing() const {
  std::string names;
  for (const auto& [worker, peer] : peers_)
    if (peer.expected && !peer.here) names += (names.empty() ? "" : ", ") + name_of(worker);
  return names;
}

/// As many batches wait here as all workers may ask for at once, so that none waits for an answer
/// from above.
size_t SubCoordinator::wish() const {
  return std::min<size_t>(config_.max_leases * tracers_here(), limits::leases);
}

void SubCoordinator::want_more() {
  if (!begun_ || over_) return;
  const auto waiting = static_cast<size_t>(book_.waiting());
  if (waiting < wish()) port_.want_leases(wish() - waiting);
}

/// Gives back batches that none of the present workers can trace: others may.
void SubCoordinator::give_back_lost() {
  if (!book_.has_given_back() && lost_.empty()) return;
  std::vector<NodeId> here;
  for (const auto& [worker, peer] : peers_)
    if (peer.traces()) here.push_back(worker);
  book_.lose_what_all_gave_back(here);
  lost_.merge(book_.take_lost());
  std::vector<uint64_t> leases;
  for (const int64_t batch : lost_)
    if (leases.size() < limits::leases) leases.push_back(lease_of_.at(batch));
  if (leases.empty() || !port_.give_back(leases)) return;  // again at the next look
  for (size_t i = 0; i < leases.size(); ++i) {
    lease_of_.erase(*lost_.begin());
    lost_.erase(lost_.begin());
  }
}

void SubCoordinator::look_at_work(Nanoseconds now) {
  if (!begun_) {
    if (now - began_ >= config_.start / 2) begin(missing() + " has not come in time");
    return;
  }
  fence(book_.fence_late(now), "late");
  give_back_lost();
  note_book();
  // Even if there are none: the coordinator above would keep batches for workers that have left
  // this node.
  if (tracers_here() == 0) return port_.return_leases();
  want_more();
}

// ---- flushes ---------------------------------------------------------------------------------

/// A flush upwards must be able to name all its leases.
bool SubCoordinator::holds_back(size_t leases) {
  if (over_ || port_.has_room_for(leases)) return false;
  port_.want_room();
  return true;
}

void SubCoordinator::counted(const Letter<Flush>&, std::span<const int64_t> batches) {
  std::vector<uint64_t> leases;
  for (const int64_t batch : batches) {
    const auto at = lease_of_.find(batch);
    LUX_CHECK(at != lease_of_.end(), "a batch was counted that nobody above has lent");
    leases.push_back(at->second);
    lease_of_.erase(at);
  }
  port_.leases_done(leases);
}

Totals& SubCoordinator::give_totals() {
  merging_ = 1 - merging_;
  return totals_[1 - merging_];
}

// ---- the end ---------------------------------------------------------------------------------

void SubCoordinator::end(const std::string& why) {
  why_ended_ = why.substr(0, limits::text_bytes);
  end_work();
  tell_end();
}

/// Its workers find this node lost, and join another.
void SubCoordinator::abandon() {
  abandoned_ = true;
  end_work();
}

void SubCoordinator::wait_for_farewells(Nanoseconds) {
  if (!letting_go_ && !abandoned_) tell_end();
}

void SubCoordinator::let_go() {
  if (!letting_go_ && !abandoned_) Coordinator::let_go();
}

}  // namespace luxodus

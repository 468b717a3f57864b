#include "actors/source/sub_coordinator.hpp"

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"
#include "scenes/transport/readout.hpp"

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

/// Asks for nothing before: the run begins when all its nodes are there. Whoever has not come by
/// then may have joined another coordinator.
void SubCoordinator::begin(const char* how) {
  begun_ = true;
  log_info("coordinator=begun workers={} tracers={} text=\"{}\"", config_.workers.size(),
           tracers_here(), how);
  // Though nobody should be here: the run waits for this node.
  port_.want_leases(std::max<size_t>(wish(), 1));
}

/// What a lost word of fencing left here is now of another lease.
void SubCoordinator::add(uint64_t lease, int64_t batch) {
  if (lease_of_.insert_or_assign(batch, lease).second) book_.add(batch);
}

/// A batch whose flush is being counted is merged under its lease all the same, and that flush
/// upwards refused.
void SubCoordinator::drop(uint64_t lease) {
  const auto at = std::find_if(lease_of_.begin(), lease_of_.end(),
                               [&](const auto& entry) { return entry.second == lease; });
  std::vector<Lease> fenced;
  if (at == lease_of_.end() || !book_.remove(at->first, fenced)) return;
  lease_of_.erase(at);
  tell_fenced(fenced);
}

void SubCoordinator::drop_all() {
  std::vector<Lease> fenced;
  std::erase_if(lease_of_, [&](const auto& entry) { return book_.remove(entry.first, fenced); });
  tell_fenced(fenced);
}

void SubCoordinator::look_again() {
  offer_again();
  go_on_counting();
  want_more();
}

uint32_t SubCoordinator::tracers_here() const {
  uint32_t tracers = 0;
  for (const auto& [worker, peer] : peers_)
    if (peer.here && !peer.left) tracers += tracers_of(worker);
  return tracers;
}

/// As many batches shall wait here as all may ask for at once: nobody waits for an answer from
/// above.
size_t SubCoordinator::wish() const {
  return std::min<size_t>(config_.max_leases * tracers_here(), limits::leases);
}

void SubCoordinator::want_more() {
  if (!begun_ || over_) return;
  const auto waiting = static_cast<size_t>(book_.waiting());
  if (waiting < wish()) port_.want_leases(wish() - waiting);
}

/// Batches that none of those who are here can trace: others may.
void SubCoordinator::give_back_lost() {
  std::vector<NodeId> here;
  for (const auto& [worker, peer] : peers_)
    if (peer.here) here.push_back(worker);
  book_.lose_what_all_gave_back(here);
  for (const int64_t batch : book_.take_lost()) {
    const auto at = lease_of_.find(batch);
    port_.give_back(at->second);
    lease_of_.erase(at);
  }
}

void SubCoordinator::look_at_work(Nanoseconds now) {
  if (!begun_) {
    if (now - began_ >= config_.start / 2) begin("not all have come in time");
    return;
  }
  fence(book_.fence_late(now), "late");
  give_back_lost();
  note_book();
  if (tracers_here() == 0 && !lease_of_.empty()) return port_.return_leases();
  want_more();
}

// ---- flushes ---------------------------------------------------------------------------------

/// A flush upwards names all leases that it holds.
bool SubCoordinator::holds_back(size_t leases) {
  if (over_ || port_.has_room_for(leases)) return false;
  port_.want_room();
  return true;
}

void SubCoordinator::counted(const Letter<Flush>&, const std::vector<int64_t>& batches) {
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

void SubCoordinator::wait_for_farewells(Nanoseconds) {
  if (!letting_go_) tell_end();
}

void SubCoordinator::let_go() {
  if (!letting_go_) Coordinator::let_go();
}

}  // namespace luxodus

#include "actors/cast/coordinator/lease_book.hpp"

#include <algorithm>
#include <set>

#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

LeaseBook::LeaseBook(int64_t next, const std::vector<int64_t>& missing, uint64_t first_lease,
                     int64_t look_ahead)
    : again_(missing.begin(), missing.end(), memory_.get()),
      last_id_(first_lease - 1),
      look_ahead_(look_ahead),
      next_(next),
      end_(next),
      committed_(next - static_cast<int64_t>(missing.size())) {
  batches_.reserve(limits::leases);
  named_.reserve(limits::leases);
}

bool LeaseBook::open(int64_t batch) const {
  return batch >= next_ && batch < end_ && batch < next_ + look_ahead_ && ahead_.count(batch) == 0;
}

/// Whether a batch waits to be leased again, and this node may have it.
bool LeaseBook::may_again(NodeId node, int64_t batch) const {
  const auto given_back = given_back_.find(batch);
  return again_.count(batch) > 0 &&
         (given_back == given_back_.end() || given_back->second.count(node) == 0);
}

int64_t LeaseBook::first_choice(NodeId node, const Rank& rank) const {
  for (const int64_t batch : again_)
    if (may_again(node, batch)) return batch;
  if (!rank) return next_;
  int64_t best = next_;
  for (int64_t batch = next_ + 1; batch < std::min(end_, next_ + look_ahead_); ++batch)
    if (ahead_.count(batch) == 0 && rank(batch) < rank(best)) best = batch;
  return best;
}

void LeaseBook::take(int64_t batch) {
  ahead_.insert(batch);
  while (!ahead_.empty() && *ahead_.begin() == next_) {
    ahead_.erase(ahead_.begin());
    ++next_;
  }
}

Nanoseconds LeaseBook::patience(int64_t batch, Nanoseconds span) const {
  constexpr int max_doublings = 10;
  const auto late = late_.find(batch);
  const int doublings = late == late_.end() ? 0 : std::min(late->second, max_doublings);
  return std::max(span << doublings, slowest_ + slowest_ / 2);
}

LentBatches LeaseBook::lend(NodeId node, int64_t most, Nanoseconds now, Nanoseconds span,
                            const Rank& rank) {
  LentBatches lent{last_id_ + 1, first_choice(node, rank), 0};
  while (lent.count < most) {
    const int64_t batch = lent.first_batch + lent.count;
    const bool again = may_again(node, batch);
    if (again) again_.erase(batch);
    if (!again && !open(batch)) break;
    if (!again && rank && lent.count > 0 && rank(batch) != rank(lent.first_batch)) break;
    if (!again) take(batch);
    const uint64_t id = ++last_id_;
    leases_.emplace(id, Lease{id, node, batch, now, now + patience(batch, span)});
    ++lent.count;
  }
  return lent;
}

std::vector<Lease> LeaseBook::remove(std::set<int64_t>& batches) {
  auto fenced = fence([&](const Lease& lease) { return batches.count(lease.batch) > 0; });
  std::erase_if(batches, [&](int64_t batch) {
    given_back_.erase(batch);
    return again_.erase(batch) > 0;
  });
  return fenced;
}

void LeaseBook::renew(NodeId node, Nanoseconds deadline) {
  for (auto& [id, lease] : leases_)
    if (lease.node == node) lease.deadline = std::max(lease.deadline, deadline);
}

bool LeaseBook::stand(NodeId node, const std::vector<uint64_t>& leases) const {
  named_.assign(leases.begin(), leases.end());
  std::sort(named_.begin(), named_.end());
  const bool twice = std::adjacent_find(named_.begin(), named_.end()) != named_.end();
  return !twice && std::all_of(leases.begin(), leases.end(), [&](uint64_t id) {
    const auto at = leases_.find(id);
    return at != leases_.end() && at->second.node == node;
  });
}

std::span<const int64_t> LeaseBook::batches_of(const std::vector<uint64_t>& leases) {
  batches_.clear();
  for (const uint64_t id : leases) batches_.push_back(leases_.at(id).batch);
  return batches_;
}

void LeaseBook::hold(const std::vector<uint64_t>& leases) {
  for (const uint64_t id : leases) leases_.at(id).held = true;
}

void LeaseBook::commit(const std::vector<uint64_t>& leases, Nanoseconds now) {
  for (const uint64_t id : leases) {
    const auto at = leases_.find(id);
    slowest_ = std::max(slowest_, now - at->second.lent);
    late_.erase(at->second.batch);
    given_back_.erase(at->second.batch);
    leases_.erase(at);
  }
  committed_ += static_cast<int64_t>(leases.size());
}

template <class Which>
std::vector<Lease> LeaseBook::fence(Which&& which) {
  std::vector<Lease> fenced;
  for (auto at = leases_.begin(); at != leases_.end();) {
    if (at->second.held || !which(at->second)) {
      ++at;
      continue;
    }
    fenced.push_back(at->second);
    again_.insert(at->second.batch);
    at = leases_.erase(at);
  }
  return fenced;
}

std::vector<Lease> LeaseBook::fence_late(Nanoseconds now) {
  const auto fenced = fence([&](const Lease& lease) { return lease.deadline <= now; });
  for (const Lease& lease : fenced) ++late_[lease.batch];
  return fenced;
}

std::vector<Lease> LeaseBook::fence_node(NodeId node) {
  return fence([&](const Lease& lease) { return lease.node == node; });
}

std::vector<Lease> LeaseBook::fence_leases(NodeId node, const std::vector<uint64_t>& leases) {
  const std::set<uint64_t> named(leases.begin(), leases.end());
  return fence([&](const Lease& lease) { return lease.node == node && named.count(lease.id) > 0; });
}

std::vector<Lease> LeaseBook::give_back(NodeId node, const std::vector<uint64_t>& leases) {
  const std::vector<Lease> fenced = fence_leases(node, leases);
  for (const Lease& lease : fenced) given_back_[lease.batch].insert(node);
  return fenced;
}

void LeaseBook::forgive(NodeId node) {
  for (auto& [batch, nodes] : given_back_) nodes.erase(node);
}

int64_t LeaseBook::lose_what_all_gave_back(const std::vector<NodeId>& nodes) {
  const int64_t before = lost();
  for (const auto& [batch, gave_back] : given_back_) {
    const auto did = [&gave_back = gave_back](NodeId node) { return gave_back.count(node) > 0; };
    if (nodes.empty() || !std::all_of(nodes.begin(), nodes.end(), did)) continue;
    if (again_.erase(batch) > 0) lost_.insert(batch);
  }
  return lost() - before;
}

std::vector<int64_t> LeaseBook::missing() const {
  std::set<int64_t> batches(again_.begin(), again_.end());
  batches.insert(lost_.begin(), lost_.end());
  for (const auto& [id, lease] : leases_) batches.insert(lease.batch);
  for (int64_t batch = next_; batch < lent_end(); ++batch)
    if (ahead_.count(batch) == 0) batches.insert(batch);
  return {batches.begin(), batches.end()};
}

std::optional<Nanoseconds> LeaseBook::next_deadline() const {
  std::optional<Nanoseconds> first;
  for (const auto& [id, lease] : leases_)
    if (!lease.held && (!first || lease.deadline < *first)) first = lease.deadline;
  return first;
}

}  // namespace luxodus

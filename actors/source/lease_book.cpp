#include "actors/source/lease_book.hpp"

#include <algorithm>
#include <set>

namespace luxodus {

LentBatches LeaseBook::lend(NodeId node, int64_t most, Nanoseconds deadline) {
  LentBatches lent{last_id_ + 1, again_.empty() ? next_ : *again_.begin(), 0};
  while (lent.count < most) {
    const int64_t batch = lent.first_batch + lent.count;
    const bool again = again_.erase(batch) > 0;
    if (!again && (batch != next_ || next_ == end_)) break;
    if (!again) ++next_;
    const uint64_t id = ++last_id_;
    leases_.emplace(id, Lease{id, node, batch, deadline});
    ++lent.count;
  }
  return lent;
}

bool LeaseBook::stand(NodeId node, const std::vector<uint64_t>& leases) const {
  std::set<uint64_t> named;
  return std::all_of(leases.begin(), leases.end(), [&](uint64_t id) {
    const auto at = leases_.find(id);
    return named.insert(id).second && at != leases_.end() && at->second.node == node;
  });
}

void LeaseBook::commit(const std::vector<uint64_t>& leases) {
  for (const uint64_t id : leases) leases_.erase(id);
  committed_ += static_cast<int64_t>(leases.size());
}

template <class Which>
std::vector<Lease> LeaseBook::fence(Which&& which) {
  std::vector<Lease> fenced;
  for (auto at = leases_.begin(); at != leases_.end();) {
    if (!which(at->second)) {
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
  return fence([&](const Lease& lease) { return lease.deadline <= now; });
}

std::vector<Lease> LeaseBook::fence_node(NodeId node) {
  return fence([&](const Lease& lease) { return lease.node == node; });
}

std::vector<Lease> LeaseBook::fence_leases(NodeId node, const std::vector<uint64_t>& leases) {
  const std::set<uint64_t> named(leases.begin(), leases.end());
  return fence([&](const Lease& lease) { return lease.node == node && named.count(lease.id) > 0; });
}

std::vector<int64_t> LeaseBook::missing() const {
  std::set<int64_t> batches = again_;
  for (const auto& [id, lease] : leases_) batches.insert(lease.batch);
  return {batches.begin(), batches.end()};
}

std::optional<Nanoseconds> LeaseBook::next_deadline() const {
  std::optional<Nanoseconds> first;
  for (const auto& [id, lease] : leases_)
    if (!first || lease.deadline < *first) first = lease.deadline;
  return first;
}

}  // namespace luxodus

#include "actors/source/lease_book.hpp"

#include <algorithm>
#include <set>

namespace luxodus {

bool LeaseBook::open(int64_t batch) const {
  return batch >= next_ && batch < end_ && batch < next_ + look_ahead_ && ahead_.count(batch) == 0;
}

int64_t LeaseBook::first_choice(const Rank& rank) const {
  if (!again_.empty()) return *again_.begin();
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
  constexpr int doublings_most = 10;
  const auto late = late_.find(batch);
  return late == late_.end() ? span : span << std::min(late->second, doublings_most);
}

LentBatches LeaseBook::lend(NodeId node, int64_t most, Nanoseconds now, Nanoseconds span,
                            const Rank& rank) {
  LentBatches lent{last_id_ + 1, first_choice(rank), 0};
  while (lent.count < most) {
    const int64_t batch = lent.first_batch + lent.count;
    const bool again = again_.erase(batch) > 0;
    if (!again && !open(batch)) break;
    if (!again && rank && lent.count > 0 && rank(batch) != rank(lent.first_batch)) break;
    if (!again) take(batch);
    const uint64_t id = ++last_id_;
    leases_.emplace(id, Lease{id, node, batch, now + patience(batch, span)});
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

std::vector<int64_t> LeaseBook::batches_of(const std::vector<uint64_t>& leases) const {
  std::vector<int64_t> batches;
  for (const uint64_t id : leases) batches.push_back(leases_.at(id).batch);
  return batches;
}

void LeaseBook::commit(const std::vector<uint64_t>& leases) {
  for (const uint64_t id : leases) {
    const auto at = leases_.find(id);
    late_.erase(at->second.batch);
    leases_.erase(at);
  }
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

std::vector<int64_t> LeaseBook::missing() const {
  std::set<int64_t> batches = again_;
  for (const auto& [id, lease] : leases_) batches.insert(lease.batch);
  for (int64_t batch = next_; batch < lent_end(); ++batch)
    if (ahead_.count(batch) == 0) batches.insert(batch);
  return {batches.begin(), batches.end()};
}

std::optional<Nanoseconds> LeaseBook::next_deadline() const {
  std::optional<Nanoseconds> first;
  for (const auto& [id, lease] : leases_)
    if (!first || lease.deadline < *first) first = lease.deadline;
  return first;
}

}  // namespace luxodus

#include "actors/cast/tally/shard_control.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "actors/cast/names/role.hpp"
#include "actors/cast/tally/flush_codec.hpp"

namespace luxodus {

namespace {
/// Time to a retry: a shard may be adding a part of a million bins, in turns.
constexpr Nanoseconds patience = seconds(1);
}  // namespace

ShardControl::ShardControl(const ShardPlan& plan, Totals& totals, const Clock& clock,
                           Nanoseconds lost, Sender& sender, Address self)
    : plan_(plan), totals_(totals), clock_(clock), sender_(sender), self_(self) {
  for (size_t i = 0; i < plan_.owners.size(); ++i) {
    const BinRange bins = plan_.range(i + 1, totals.layout().totals());
    const RetryTimer timer(patience, lost);
    shards_.push_back({plan_.owners[i], bins, {}, timer, timer, {}, bins.end});
  }
}

// ---- decisions --------------------------------------------------------------------------------

void ShardControl::take(const MessageId& flush, const std::vector<uint64_t>& slice_hashes) {
  for (size_t i = 0; i < shards_.size(); ++i) decide(i, {flush, slice_hashes[i], true});
}

void ShardControl::refuse(const MessageId& flush) {
  for (size_t i = 0; i < shards_.size(); ++i) decide(i, {flush, 0, false});
}

void ShardControl::end_life(NodeId worker, Incarnation life) {
  refuse({worker, life, UINT64_MAX});
}

void ShardControl::decide(size_t index, const FlushDecided& decision) {
  ++counters_.decisions;
  shards_[index].decisions.push_back({decision, std::nullopt});
  ask_decisions(shards_[index]);
}

bool ShardControl::settled() const {
  return std::all_of(shards_.begin(), shards_.end(),
                     [](const Shard& shard) { return shard.decisions.empty(); });
}

/// Sends the next decisions, for each node the oldest.
void ShardControl::ask_decisions(Shard& shard) {
  std::set<NodeId> nodes;
  for (Decision& decision : shard.decisions) {
    if (nodes.size() == max_decisions) return;
    if (!nodes.insert(decision.what.flush.node).second || decision.asked) continue;
    decision.asked = Question{sender_.next_id(), shard.decision_timer};
    put(shard, *decision.asked, decision.what);
  }
}

void ShardControl::on(const Letter<FlushSettled>& settled) {
  Shard* const shard = shard_of(settled.from.node);
  if (shard == nullptr) return;
  const auto at = std::find_if(
      shard->decisions.begin(), shard->decisions.end(),
      [&](const Decision& decision) { return decision.asked && decision.asked->id == settled.id; });
  if (at == shard->decisions.end()) return;
  if (!settled.body.whole)
    fault_ = "a shard of the totals lacks a slice of a flush that was counted";
  shard->decision_timer = at->asked->timer;
  shard->decision_timer.answered(clock_.now());
  shard->decisions.erase(at);
  ask_decisions(*shard);
}

// ---- totals -----------------------------------------------------------------------------------

void ShardControl::gather(std::function<void()> done) {
  ++gather_;
  ++counters_.gathers;
  done_ = std::move(done);
  for (Shard& shard : shards_) {
    shard.next = shard.bins.first;
    ask_totals(shard);
  }
  end_gather();
}

AskTotals ShardControl::next_totals(const Shard& shard) const {
  return {gather_, static_cast<uint64_t>(shard.next)};
}

void ShardControl::ask_totals(Shard& shard) {
  if (shard.next == shard.bins.end) return;
  shard.asked = Question{sender_.next_id(), shard.totals_timer};
  put(shard, *shard.asked, next_totals(shard));
}

void ShardControl::add(Shard& shard, const TotalsTold& told, std::span<const std::byte> payload) {
  const auto next = static_cast<int64_t>(told.next);
  auto gain = next > shard.next && next <= shard.bins.end
                  ? decode_flush(payload, totals_.groups(), {shard.next, next})
                  : Result<FlushGain>(problem("it tells of other bins than were asked for"));
  if (!gain) {
    fault_ = "what a shard tells of its totals cannot be read: " + gain.problem().what;
    return;
  }
  counters_.gathered_bytes += payload.size();
  gain->add_to(totals_);
  shard.next = next;
}

void ShardControl::on(const Letter<TotalsTold>& told) {
  Shard* const shard = shard_of(told.from.node);
  if (shard == nullptr || !shard->asked || shard->asked->id != told.id) return;
  shard->totals_timer = shard->asked->timer;
  shard->totals_timer.answered(clock_.now());
  shard->asked.reset();
  add(*shard, told.body, told.payload.bytes());
  if (fault_) return;
  ask_totals(*shard);
  end_gather();
}

void ShardControl::end_gather() {
  const auto whole = [](const Shard& shard) { return shard.next == shard.bins.end; };
  if (done_ && std::all_of(shards_.begin(), shards_.end(), whole)) std::exchange(done_, {})();
}

// ---- questions and answers --------------------------------------------------------------------

/// If there is no room, look() tries again.
void ShardControl::put(const Shard& shard, Question& question, const Message& message) {
  const SendOutcome outcome =
      sender_.send(self_, {shard.owner, role::tally_shard}, question.id, message);
  if (outcome == SendOutcome::taken) question.timer.asked(clock_.now());
}

void ShardControl::put_again(const Shard& shard, Question& question, const Message& message) {
  if (!question.timer.may_ask(clock_.now())) return;
  ++counters_.asked_again;
  put(shard, question, message);
}

void ShardControl::look() {
  for (Shard& shard : shards_) {
    for (Decision& decision : shard.decisions)
      if (decision.asked) put_again(shard, *decision.asked, decision.what);
    if (shard.asked) put_again(shard, *shard.asked, next_totals(shard));
  }
}

/// Null if the node owns no shard, or no answers are wanted any more.
ShardControl::Shard* ShardControl::shard_of(NodeId owner) {
  const size_t index = plan_.shard_of(owner);
  return index == 0 || fault_ ? nullptr : &shards_[index - 1];
}

}  // namespace luxodus

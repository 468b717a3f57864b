#include "actors/tally/shard_control.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "actors/tally/flush_codec.hpp"

namespace luxodus {

namespace {
/// Until a question is sent again: a shard may be adding a part of a million bins, in turns.
constexpr Nanoseconds patience = seconds(1);
}  // namespace

ShardControl::ShardControl(const ShardPlan& plan, Totals& totals, const Clock& clock,
                           Sender& sender, Address self)
    : plan_(plan), totals_(totals), clock_(clock), sender_(sender), self_(self) {
  for (size_t i = 0; i < plan_.owners.size(); ++i) {
    Shard& shard = shards_.emplace_back();
    shard.owner = plan_.owners[i];
    shard.bins = plan_.range(i + 1, totals.layout().totals());
    shard.next = shard.bins.end;
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
  Shard& shard = shards_[index];
  ++counters_.decisions;
  shard.decisions.push_back(decision);
  if (shard.decisions.size() == 1) ask(shard);
}

bool ShardControl::settled() const {
  return std::all_of(shards_.begin(), shards_.end(),
                     [](const Shard& shard) { return shard.decisions.empty(); });
}

void ShardControl::settle(Shard& shard, const FlushSettled& answer) {
  if (!answer.whole && !fault_)
    fault_ = "a shard of the totals lacks a slice of a flush that was counted";
  shard.decisions.pop_front();
  if (!shard.decisions.empty() || shard.next < shard.bins.end) ask(shard);
}

// ---- totals -----------------------------------------------------------------------------------

void ShardControl::gather(std::function<void()> done) {
  ++gather_;
  ++counters_.gathers;
  done_ = std::move(done);
  for (Shard& shard : shards_) {
    shard.next = shard.bins.first;
    if (waits(shard)) ask(shard);
  }
  end_gather();
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
  if (waits(shard)) ask(shard);
  end_gather();
}

void ShardControl::end_gather() {
  const auto whole = [](const Shard& shard) { return shard.next == shard.bins.end; };
  if (done_ && std::all_of(shards_.begin(), shards_.end(), whole)) std::exchange(done_, {})();
}

// ---- questions and answers --------------------------------------------------------------------

bool ShardControl::waits(const Shard& shard) const {
  return !shard.decisions.empty() || shard.next < shard.bins.end;
}

/// The next question: decisions come first, whatever is gathered.
void ShardControl::ask(Shard& shard) {
  shard.question = sender_.next_id();
  put(shard);
}

void ShardControl::put(Shard& shard) {
  shard.asked = clock_.now();
  const Message message = shard.decisions.empty()
                              ? Message(AskTotals{gather_, static_cast<uint64_t>(shard.next)})
                              : Message(shard.decisions.front());
  sender_.send(self_, {shard.owner, ActorName::tally_shard}, shard.question, message);
}

void ShardControl::look() {
  for (Shard& shard : shards_) {
    if (!waits(shard) || clock_.now() - shard.asked < patience) continue;
    ++counters_.asked_again;
    put(shard);
  }
}

/// The shard that waits for the answer to this question; null where it is old, and was answered.
ShardControl::Shard* ShardControl::asked(NodeId owner, const MessageId& question) {
  const size_t index = plan_.shard_of(owner);
  if (index == 0 || fault_) return nullptr;
  Shard& shard = shards_[index - 1];
  return waits(shard) && question == shard.question ? &shard : nullptr;
}

void ShardControl::on(const Letter<FlushSettled>& settled) {
  Shard* const shard = asked(settled.from.node, settled.id);
  if (shard != nullptr && !shard->decisions.empty()) settle(*shard, settled.body);
}

void ShardControl::on(const Letter<TotalsTold>& told) {
  Shard* const shard = asked(told.from.node, told.id);
  if (shard != nullptr && shard->decisions.empty()) add(*shard, told.body, told.payload.bytes());
}

}  // namespace luxodus

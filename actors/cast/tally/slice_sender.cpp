#include "actors/cast/tally/slice_sender.hpp"

#include <algorithm>

#include "actors/cast/names/role.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

void SliceSender::make_room(int groups, int64_t totals) {
  totals_ = totals;
  slices_.clear();
  for (size_t slice = 0; slice < slices(); ++slice) {
    const BinRange bins = bins_of(slice);
    slices_.push_back({std::make_shared<FlushEncoder>(groups, bins.end - bins.first), 0, true});
  }
}

bool SliceSender::free() const {
  return std::all_of(slices_.begin(), slices_.end(),
                     [](const Slice& slice) { return slice.encoder.use_count() == 1; });
}

size_t SliceSender::memory_bytes() const {
  size_t bytes = 0;
  for (const Slice& slice : slices_) bytes += slice.encoder->memory_bytes();
  return bytes;
}

void SliceSender::send(const MessageId& flush, Nanoseconds now) {
  flush_ = flush;
  refused_ = false;
  timer_.forget();
  for (Slice& slice : slices_) {
    const auto& bytes = slice.encoder->bytes();
    slice.hash = hash_of(bytes);  // as Hasher, but without allocating
    slice.held = false;
  }
  put_missing(now);
}

void SliceSender::put_missing(Nanoseconds now) {
  bool all_left = true;
  for (size_t slice = 0; slice < slices(); ++slice)
    if (!slices_[slice].held) all_left &= put(slice) == SendOutcome::taken;
  if (all_left) timer_.asked(now);
}

SendOutcome SliceSender::put(size_t index) {
  const Slice& slice = slices_[index];
  return sender_.send(self_, {plan_.owners[index], role::tally_shard}, flush_,
                      FlushSlice{slice.hash}, {slice.encoder->bytes(), slice.encoder});
}

bool SliceSender::placed() const {
  return refused_ ||
         std::all_of(slices_.begin(), slices_.end(), [](const Slice& slice) { return slice.held; });
}

std::vector<uint64_t> SliceSender::hashes() const {
  std::vector<uint64_t> hashes;
  for (const Slice& slice : slices_)
    if (!refused_) hashes.push_back(slice.hash);
  return hashes;
}

void SliceSender::ask_again(Nanoseconds now) {
  if (!placed() && timer_.may_ask(now)) put_missing(now);
}

void SliceSender::ask_now(Nanoseconds now) {
  if (!placed()) put_missing(now);
}

/// The slice that this shard should hold; null for answers about an earlier flush.
SliceSender::Slice* SliceSender::asked(NodeId owner, const MessageId& flush) {
  const size_t shard = plan_.shard_of(owner);
  return shard == 0 || flush != flush_ ? nullptr : &slices_[shard - 1];
}

void SliceSender::on(const Letter<SliceHeld>& held, Nanoseconds now) {
  Slice* const slice = asked(held.from.node, held.id);
  if (slice == nullptr) return;
  slice->held = true;
  if (placed()) timer_.answered(now);
}

void SliceSender::on(const Letter<FlushRefused>& refused) {
  if (asked(refused.from.node, refused.id) == nullptr) return;
  log_warning("slice=refused node={} shard={} text=\"{}\"", refused.id.node.value,
              plan_.shard_of(refused.from.node), refused.body.text);
  refused_ = true;
}

}  // namespace luxodus

// What becomes of a flush at the controller: it is counted whole on a fiber of its own, kept for a
// crash, and answered; or refused, and its leases are fenced.
#include <algorithm>
#include <utility>

#include "actors/source/controller.hpp"
#include "actors/tally/flush_codec.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Hashed at once: some 0.1 ms.
constexpr size_t bytes_of_a_step = 1 << 20;
}  // namespace

void Controller::take_flush(const Delivery& delivery, const Flush& flush) {
  const Answered& last = last_flush_[delivery.source];
  if (last.question == delivery.id) return send(delivery.source, delivery.id, last.answer);
  const auto same = [&](const Arrived& arrived) { return arrived.id == delivery.id; };
  if (std::any_of(arrived_.begin(), arrived_.end(), same)) return;  // it is being counted
  // Who asks anew has given up what it asked before.
  if (arrived_.size() >= 2 * peers_.size()) return;
  arrived_.push_back(
      {delivery.source, delivery.id, flush, {delivery.payload.begin(), delivery.payload.end()}});
  start_counting();
}

void Controller::start_counting() {
  if (counting_ || arrived_.empty() || shards_.gathering()) return;
  counting_ = scheduler_.fibers().start("tally", [this] { count_flushes(); }).has_value();
  if (!counting_) arrived_.pop_back();  // it is sent again
}

/// On a fiber of its own. Between two flushes somebody may look at the totals; where these lie in
/// shards, the flushes that have come wait.
void Controller::count_flushes() {
  const auto held_back = [&] { return shards_.others() > 0 && run_.pause_is_due(); };
  while (!arrived_.empty() && !(held_back() && !over_)) {
    answer_flush(arrived_.front(), count_flush(arrived_.front()));
    arrived_.pop_front();
    look_soon();
  }
  counting_ = false;
  look_soon();
}

/// Not on the fiber that asks. One timer does for all flushes of a turn: hundreds may come at once.
void Controller::look_soon() {
  if (std::exchange(looks_soon_, true)) return;
  scheduler_.timers().set(scheduler_.clock().now(), [this] {
    looks_soon_ = false;
    look_at_totals();
  });
}

/// `why` it is refused; "" where it was counted.
void Controller::answer_flush(const Arrived& arrived, const std::string& why) {
  Answered& last = last_flush_[arrived.worker];
  last.question = arrived.id;
  if (why.empty()) {
    ++counters_.flushes_taken;
    last.answer = FlushTaken{};
    log_debug("flush=taken node={} leases={}", arrived.worker.value, arrived.flush.leases.size());
  } else {
    ++counters_.flushes_refused;
    last.answer = FlushRefused{{}, why};
    shards_.refuse(arrived.id);
    log_warning("flush=refused node={} text=\"{}\"", arrived.worker.value, why);
  }
  counters_.flush_bytes += arrived.payload.size();
  send(arrived.worker, arrived.id, last.answer);
  if (!why.empty())
    fence(book_.fence_leases(arrived.worker, arrived.flush.leases), "its flush was refused");
}

/// Lets others have their turn. A node that is to end goes on: what is begun is whole in the end.
bool Controller::take_turns() {
  (void)scheduler_.fibers().yield();
  return true;
}

/// On a disk, before anybody is told: the run survives this node. Where that fails the run goes on
/// without, since its totals are right all the same.
void Controller::keep(const Arrived& arrived) {
  if (config_.keeper == nullptr) return;
  const std::vector<int64_t> batches = book_.batches_of(arrived.flush.leases);
  const auto kept = config_.keeper->keep(batches, arrived.payload);
  if (kept) return;
  ++counters_.flushes_not_kept;
  log_error("journal=failed flushes={} text=\"{}: should this node crash, they are traced again\"",
            counters_.flushes_not_kept, kept.problem().text());
}

/// Between flushes, when the totals hold all that was kept.
void Controller::let_keeper_rest() {
  if (config_.keeper == nullptr || adding_ || counting_ || !config_.keeper->rest_is_due()) return;
  run_.resume(book_.lent_end(), book_.missing());
  config_.keeper->rest();
}

/// Takes a flush whole, or says why not.
std::string Controller::count_flush(const Arrived& arrived) {
  const std::vector<uint64_t>& leases = arrived.flush.leases;
  const char* const fenced = "a lease was fenced";
  if (!book_.stand(arrived.worker, leases)) return fenced;
  if (arrived.flush.slice_hashes.size() != shards_.others())
    return "shards lack their slices of it";
  Hasher hash;
  for (std::span<const std::byte> left = arrived.payload; !left.empty(); take_turns()) {
    const auto piece = left.first(std::min(left.size(), bytes_of_a_step));
    hash.add(piece.data(), piece.size());
    left = left.subspan(piece.size());
  }
  if (hash.value() != arrived.flush.payload_hash) return "the payload is not what its hash says";
  const auto rest = [this] { return take_turns(); };
  const auto gain = decode_flush(arrived.payload, run_.totals().groups(),
                                 config_.shards.range(0, run_.scene().layout.totals()), rest);
  if (!gain) return gain.problem().what;
  if (gain->batches() != static_cast<int64_t>(leases.size()) || !gain->balance().closes())
    return "its batches or its ledger do not add up";
  if (over_) return "the run has ended";
  // Committed before anything is added, so that no lease of it is fenced while others have turns.
  if (!book_.stand(arrived.worker, leases)) return fenced;
  keep(arrived);
  book_.commit(leases);
  gathered_ = false;
  shards_.take(arrived.id, arrived.flush.slice_hashes);
  adding_ = true;
  gain->add_to(run_.totals(), rest);
  note_book();
  adding_ = false;
  return "";
}

}  // namespace luxodus

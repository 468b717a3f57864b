// What becomes of a flush at the controller: it is counted whole on a fiber of its own, kept for a
// crash, and answered; or refused, and its leases are fenced.
#include <algorithm>
#include <utility>

#include "actors/source/coordinator.hpp"
#include "actors/tally/flush_codec.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Hashed at once: some 0.1 ms.
constexpr size_t bytes_of_a_step = 1 << 20;
}  // namespace

void Coordinator::on(Letter<Flush>&& letter) {
  const MessageId flush = letter.id;
  if (!meet(letter.from, flush.incarnation)) return;
  if (const Answered& last = last_flush_[letter.from.node]; last.question == flush) {
    answer(letter, last.answer);
    return;
  }
  if (std::count(uncounted_.begin(), uncounted_.end(), flush) > 0) return;  // it is being counted
  // Who asks anew has given up what it asked before.
  if (uncounted_.size() >= 2 * peers_.size()) return;
  if (offer(CountFlush{std::move(letter)}) == Offered::taken) uncounted_.push_back(flush);
}

/// Between two flushes somebody may look at the totals; where these lie in shards, or become a
/// snapshot, the flushes that have come wait.
bool Coordinator::holds_back() const {
  if (shards_.gathering() || reading_) return true;
  return shards_.others() > 0 && !over_ && (run_.pause_is_due() || shows_.wanted());
}

void Coordinator::go_on_counting() {
  scheduler().fibers().wake_all(held_back_);
}

/// On the actor's fiber.
void Coordinator::on(CountFlush&& count) {
  while (holds_back())
    if (scheduler().fibers().wait(held_back_, "totals are read") == Wake::cancelled) return;
  counting_ = true;
  const std::string why = count_flush(count.letter);
  counting_ = false;
  if (scheduler().fibers().cancelled()) return;  // its worker asks whoever comes after this node
  answer_flush(count.letter, why);
  std::erase(uncounted_, count.letter.id);
  look_soon();
}

/// Not on the fiber that asks. One timer does for all flushes of a turn: hundreds may come at once.
void Coordinator::look_soon() {
  if (std::exchange(looks_soon_, true)) return;
  scheduler().timers().set(clock_.now(), own_task([this] {
                             looks_soon_ = false;
                             look_at_totals();
                           }));
}

/// `why` it is refused; "" where it was counted.
void Coordinator::answer_flush(const Letter<Flush>& letter, const std::string& why) {
  const NodeId worker = letter.from.node;
  Answered& last = last_flush_[worker];
  last.question = letter.id;
  if (why.empty()) {
    ++counters_.flushes_taken;
    last.answer = FlushTaken{};
    log_debug("flush=taken node={} leases={}", worker.value, letter.body.leases.size());
  } else {
    ++counters_.flushes_refused;
    last.answer = FlushRefused{{}, why};
    shards_.refuse(letter.id);
    log_warning("flush=refused node={} text=\"{}\"", worker.value, why);
  }
  counters_.flush_bytes += letter.payload.bytes().size();
  answer(letter, last.answer);
  if (!why.empty()) fence(book_.fence_leases(worker, letter.body.leases), "its flush was refused");
}

/// Lets others have their turn. A node that is to end goes on: what is begun is whole in the end.
bool Coordinator::take_turns() {
  (void)scheduler().fibers().yield();
  return true;
}

/// On a disk, before anybody is told: the run survives this node. Where that fails the run goes on
/// without, since its totals are right all the same. False: this node ends.
bool Coordinator::keep(const Letter<Flush>& letter) {
  if (config_.journal == nullptr) return true;
  const std::vector<int64_t> batches = book_.batches_of(letter.body.leases);
  Kept kept;
  const KeepFlush keep{batches, letter.payload.bytes(), &kept};
  bool goes_on = config_.journal->send(keep) == Offered::taken;
  while (goes_on && !kept.done)
    goes_on = scheduler().fibers().wait(kept.waiting, "journal") != Wake::cancelled;
  if (!goes_on) {
    config_.journal->finish();
    return false;
  }
  if (kept.outcome) return true;
  ++counters_.flushes_not_kept;
  log_error("journal=failed flushes={} text=\"{}: should this node crash, they are traced again\"",
            counters_.flushes_not_kept, kept.outcome.problem().text());
  return true;
}

/// Between flushes, when the totals hold all that was kept. Until it is done no flush is counted.
void Coordinator::tidy_journal() {
  if (config_.journal == nullptr || adding_ || counting_ || reading_) return;
  if (!config_.journal->tidying_is_due()) return;
  run_.resume(book_.lent_end(), book_.missing());
  const TidyJournal tidy{[this] {
    reading_ = false;
    go_on_counting();
    look_soon();
  }};
  reading_ = config_.journal->offer(tidy) == Offered::taken;
}

/// Takes a flush whole, or says why not.
std::string Coordinator::count_flush(const Letter<Flush>& letter) {
  const NodeId worker = letter.from.node;
  const std::vector<uint64_t>& leases = letter.body.leases;
  const char* const fenced = "a lease was fenced";
  if (!book_.stand(worker, leases)) return fenced;
  if (letter.body.slice_hashes.size() != shards_.others()) return "shards lack their slices of it";
  Hasher hash;
  for (std::span<const std::byte> left = letter.payload.bytes(); !left.empty(); take_turns()) {
    const auto piece = left.first(std::min(left.size(), bytes_of_a_step));
    hash.add(piece.data(), piece.size());
    left = left.subspan(piece.size());
  }
  if (hash.value() != letter.body.payload_hash) return "the payload is not what its hash says";
  const auto rest = [this] { return take_turns(); };
  const auto gain = decode_flush(letter.payload.bytes(), run_.totals().groups(),
                                 config_.shards.range(0, run_.scene().layout.totals()), rest);
  if (!gain) return gain.problem().what;
  if (gain->batches() != static_cast<int64_t>(leases.size()) || !gain->balance().closes())
    return "its batches or its ledger do not add up";
  if (over_) return "the run has ended";
  if (!book_.stand(worker, leases)) return fenced;
  // From here on no lease of it can be fenced, though others have turns.
  book_.hold(leases);
  adding_ = true;
  if (!keep(letter)) return "this node ends";
  book_.commit(leases, clock_.now());
  gathered_ = false;
  shards_.take(letter.id, letter.body.slice_hashes);
  gain->add_to(run_.totals(), rest);
  note_book();
  adding_ = false;
  return "";
}

}  // namespace luxodus

// Handling of a flush: it is counted whole on the actor's fiber, in a run after it was journaled,
// and answered; or it is refused, and its leases are fenced.
#include <algorithm>
#include <utility>

#include "actors/cast/coordinator/coordinator.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Bytes hashed at once: about 0.1 ms.
constexpr size_t bytes_of_a_step = 1 << 20;
}  // namespace

void Coordinator::on(Letter<Flush>&& letter) {
  const MessageId flush = letter.id;
  if (!meet(letter.from, flush.incarnation)) return;
  if (const Answered& last = last_flush_[letter.from.node]; last.question == flush) {
    answer(letter, last.answer);
    return;
  } else if (is_older(flush, last.question)) {
    return;
  }
  if (std::count(uncounted_.begin(), uncounted_.end(), flush) > 0) return;  // it is being counted
  // A worker that sends a new flush has given up the previous one.
  if (uncounted_.size() >= 2 * peers_.size()) return;
  if (offer(CountFlush{std::move(letter)}) == Offered::taken) uncounted_.push_back(flush);
}

void Coordinator::go_on_counting() {
  scheduler().fibers().wake_all(held_back_);
}

/// Runs on the actor's fiber.
void Coordinator::on(CountFlush&& count) {
  while (holds_back(count.letter.body.leases.size()))
    if (scheduler().fibers().wait(held_back_, "totals") == Wake::cancelled) return;
  counting_ = true;
  const Result<void> counted = count_flush(count.letter);
  counting_ = false;
  if (scheduler().fibers().cancelled()) return;  // its worker asks this node's successor
  answer_flush(count.letter, counted);
  std::erase(uncounted_, count.letter.id);
  sender().take_back(std::move(count.letter.body.leases));
  look_soon();
}

/// Not on the requesting fiber. One timer serves all flushes of a turn: hundreds may arrive at
/// once.
void Coordinator::look_soon() {
  if (std::exchange(looks_soon_, true)) return;
  scheduler().timers().set(clock_.now(), own_task([this] {
                             looks_soon_ = false;
                             look_at_totals();
                           }));
}

/// `counted`: or why it is refused.
void Coordinator::answer_flush(const Letter<Flush>& letter, const Result<void>& counted) {
  const NodeId worker = letter.from.node;
  Answered& last = last_flush_[worker];
  last.question = letter.id;
  if (counted) {
    ++counters_.flushes_taken;
    last.answer = FlushTaken{};
    log_debug("flush=taken node={} leases={}", worker.value, letter.body.leases.size());
  } else {
    ++counters_.flushes_refused;
    last.answer = FlushRefused{{}, counted.problem().what};
    refused(letter.id);
    log_warning("flush=refused node={} text=\"{}\"", worker.value, counted.problem().what);
  }
  counters_.flush_bytes += letter.payload.bytes().size();
  answer(letter, last.answer);
  if (!counted) fence(book_.fence_leases(worker, letter.body.leases), "its flush was refused");
}

/// Yields. A node that is ending still completes what has begun.
bool Coordinator::take_turns() {
  (void)scheduler().fibers().yield();
  return true;
}

/// Counts a flush whole, or returns why not.
Result<void> Coordinator::count_flush(const Letter<Flush>& letter) {
  const NodeId worker = letter.from.node;
  const std::vector<uint64_t>& leases = letter.body.leases;
  const char* const fenced = "a lease was fenced";
  if (!book_.stand(worker, leases)) return problem(fenced);
  if (auto ok = may_count(letter); !ok) return ok.problem();
  payload_hash_.reset();
  for (std::span<const std::byte> left = letter.payload.bytes(); !left.empty(); take_turns()) {
    const auto piece = left.first(std::min(left.size(), bytes_of_a_step));
    payload_hash_.add(piece.data(), piece.size());
    left = left.subspan(piece.size());
  }
  if (payload_hash_.value() != letter.body.payload_hash)
    return problem("the payload is not what its hash says");
  // Other fibers ran: the leases may have been fenced, and the totals replaced.
  if (!book_.stand(worker, leases)) return problem(fenced);
  const auto rest = [this] { return take_turns(); };
  auto gain = reader_.read(letter.payload.bytes(), totals().groups(), bins(), rest);
  if (!gain) return gain.problem();
  if (gain->batches() != static_cast<int64_t>(leases.size()) || !gain->balance().closes())
    return problem("its batches or its ledger do not add up");
  if (over_) return problem("the run has ended");
  if (!book_.stand(worker, leases)) return problem(fenced);
  // From here on none of its leases can be fenced, though other fibers run.
  const std::span<const int64_t> batches = book_.batches_of(leases);
  book_.hold(leases);
  adding_ = true;
  if (!keep(letter)) return problem("this node ends");
  book_.commit(leases, clock_.now());
  // In the subtree of a node that coordinates others, one batch may be late while others arrive.
  if (levels_below(worker) > 0) book_.renew(worker, clock_.now() + span_of(worker));
  gain->add_to(totals(), rest);
  reader_.take_back(std::move(gain).value());
  note_book();
  adding_ = false;
  counted(letter, batches);
  return {};
}

}  // namespace luxodus

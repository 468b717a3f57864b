#include "actors/cast/journal/journal_actor.hpp"

#include <utility>

namespace luxodus {

/// Returns false if the node is ending; the call has returned all the same. Rethrows the call's
/// exception.
bool JournalActor::make_call(std::function<void()> call) {
  working_ = true;
  returned_ = false;
  const auto caught = [this, call = std::move(call)] {
    try {
      call();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  };
  calls_.begin(caught, [this] {
    returned_ = true;
    scheduler().fibers().wake_all(returning_);
  });
  bool goes_on = true;
  while (goes_on && !returned_)
    goes_on = scheduler().fibers().wait(returning_, "journal") != Wake::cancelled;
  if (!goes_on) calls_.finish();
  whole_ = keeper_.is_whole();
  working_ = false;
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  return goes_on;
}

void JournalActor::on(const KeepFlush& keep) {
  Kept& kept = *keep.kept;
  if (!make_call([&] { kept.outcome = keeper_.keep(keep.batches, keep.flush); })) return;
  kept.done = true;
  scheduler().fibers().wake_all(kept.waiting);
}

void JournalActor::on(const TidyJournal& tidy) {
  if (make_call([this] { keeper_.rest(); })) tidy.done();
}

}  // namespace luxodus

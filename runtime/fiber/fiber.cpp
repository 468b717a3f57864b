#include "runtime/fiber/fiber.hpp"

#include <exception>

#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

// How often a cancelled fiber may try to suspend on its way out: a loop that ignores the
// cancellation would otherwise block its node forever, silently.
constexpr int max_refusals = 1000;

}  // namespace

Fibers::Fibers(const FiberLimits& limits)
    : stacks_(limits.count, limits.stack_bytes, limits.max_maps),
      pool_("fibers", limits.count, WhenEmpty::wait) {
  for (size_t i = 0; i < limits.count; ++i) {
    Fiber& fiber = pool_.at(i);
    fiber.context_.prepare(stacks_.stack(i), run_bodies, &fiber);
  }
}

std::optional<FiberId> Fibers::start(const char* tag, const Task& body) {
  Fiber* fiber = pool_.take();
  if (fiber == nullptr) return std::nullopt;
  const size_t index = pool_.index_of(*fiber);
  fiber->id_ = {pool_.loan_of(*fiber)};
  fiber->body_ = body;
  fiber->tag_ = tag;
  fiber->reason_ = "start";
  fiber->subject_ = 0;
  fiber->cancelled_ = false;
  fiber->refusals_ = 0;
  stacks_.set_owner(index, tag);
  make_ready(*fiber, Wake::woken);
  return fiber->id_;
}

// The entry function of every context: between two bodies a fiber rests as it does within one.
void Fibers::run_bodies(void* argument) {
  Fiber& fiber = *static_cast<Fiber*>(argument);
  for (;;) {
    run_body(fiber);
    fiber.state_ = FiberState::resting;
    fiber.context_.leave();
  }
}

void Fibers::run_body(const Fiber& fiber) noexcept {
  try {
    fiber.body_();
  } catch (const std::exception& e) {
    const std::string line = std::string("an exception left fiber ") + fiber.tag_ + ": " + e.what();
    end_by_mistake(__FILE__, __LINE__, line.c_str());
  }
}

Wake Fibers::suspend(const char* reason) {
  return park(nullptr, FiberState::suspended, reason);
}

Wake Fibers::wait(WaitList& list, const char* reason) {
  return park(&list.waiting_, FiberState::suspended, reason);
}

Wake Fibers::yield() {
  return park(&ready_, FiberState::ready, "yield");
}

Wake Fibers::park(IntrusiveList<Fiber>* list, FiberState state, const char* reason) {
  LUX_CHECK(current_ != nullptr, "suspended outside of any fiber");
  LUX_CHECK(no_suspend_ == 0, "suspended where NoSuspend forbids it");
  LUX_CHECK(!exception_in_flight(), "suspended while an exception is thrown or handled");
  Fiber& fiber = *current_;
  fiber.reason_ = reason;
  if (fiber.cancelled_) {
    LUX_CHECK(++fiber.refusals_ < max_refusals, "a fiber takes no notice of its cancellation");
    return Wake::cancelled;
  }
  fiber.state_ = state;
  fiber.wake_ = Wake::woken;
  if (list != nullptr) list->push_back(fiber);
  if (state == FiberState::suspended) ++suspended_;
  fiber.context_.leave();
  return fiber.wake_;
}

bool Fibers::cancelled() const {
  LUX_CHECK(current_ != nullptr, "asked for cancellation outside of any fiber");
  return current_->cancelled_;
}

void Fibers::set_subject(uint64_t subject) {
  LUX_CHECK(current_ != nullptr, "named a subject outside of any fiber");
  current_->subject_ = subject;
}

void Fibers::make_ready(Fiber& fiber, Wake how) {
  if (fiber.state_ == FiberState::suspended) --suspended_;
  fiber.unlink();
  fiber.wake_ = how;
  fiber.state_ = FiberState::ready;
  ready_.push_back(fiber);
}

bool Fibers::wake(FiberId id) {
  Fiber* fiber = pool_.find(id.value);
  if (fiber == nullptr || fiber->state_ != FiberState::suspended || fiber->linked()) return false;
  make_ready(*fiber, Wake::woken);
  return true;
}

bool Fibers::time_out(FiberId id) {
  Fiber* fiber = pool_.find(id.value);
  if (fiber == nullptr || fiber->state_ != FiberState::suspended) return false;
  make_ready(*fiber, Wake::timed_out);
  return true;
}

bool Fibers::wake_one(WaitList& list) {
  if (list.empty()) return false;
  make_ready(list.waiting_.front(), Wake::woken);
  return true;
}

void Fibers::wake_all(WaitList& list) {
  while (wake_one(list)) {
  }
}

bool Fibers::cancel(FiberId id) {
  Fiber* fiber = pool_.find(id.value);
  if (fiber == nullptr) return false;
  fiber->cancelled_ = true;
  if (fiber->state_ == FiberState::suspended) make_ready(*fiber, Wake::cancelled);
  return true;
}

void Fibers::cancel_all() {
  for (size_t i = 0; i < pool_.capacity(); ++i) cancel(pool_.at(i).id_);
}

std::string Fibers::describe_live() const {
  constexpr size_t max_shown = 5;  // fits a log line
  std::string out = std::to_string(live()) + (live() == 1 ? " fiber" : " fibers");
  size_t shown = 0;
  for (size_t i = 0; i < pool_.capacity() && shown < max_shown; ++i) {
    const Fiber& fiber = pool_.at(i);
    if (fiber.state_ == FiberState::resting) continue;
    out += std::string(shown++ == 0 ? ": " : ", ") + fiber.tag_ + " in " + fiber.reason_;
  }
  return out + (live() > shown ? ", ..." : "");
}

const Fiber& Fibers::run_next() {
  LUX_CHECK(current_ == nullptr, "a fiber may not run another");
  LUX_CHECK(any_ready(), "no fiber is ready");
  Fiber& fiber = *ready_.pop_front();
  fiber.state_ = FiberState::running;
  current_ = &fiber;
  fiber.context_.enter();
  current_ = nullptr;
  const size_t index = pool_.index_of(fiber);
  LUX_CHECK(stacks_.canary_lives(index), "a fiber overflowed its stack; raise stack_kb");
  if (fiber.state_ == FiberState::resting) {
    stacks_.set_owner(index, nullptr);
    pool_.give(fiber);
  }
  return fiber;
}

}  // namespace luxodus

#include "runtime/fiber/context.hpp"

#include "runtime/core/check.hpp"

namespace luxodus {

namespace jump = boost::context::detail;

Context::~Context() {
  sanitizers::end_thread(inside_thread_);
}

void Context::prepare(StackSpan stack, Entry entry, void* argument) {
  LUX_CHECK(inside_ == nullptr, "a context is prepared once");
  entry_ = entry;
  argument_ = argument;
  inside_view_ = {nullptr, stack.low, stack.bytes};
  inside_thread_ = sanitizers::make_thread();
  inside_ = jump::make_fcontext(stack.low + stack.bytes, stack.bytes, [](jump::transfer_t from) {
    auto* self = static_cast<Context*>(from.data);
    self->outside_ = from.fctx;
    self->begin();
  });
}

void Context::begin() noexcept {
  sanitizers::finish_switch(nullptr, &outside_view_.low, &outside_view_.bytes);
  entry_(argument_);
  end_by_mistake(__FILE__, __LINE__, "the entry of a context returned");
}

}  // namespace luxodus

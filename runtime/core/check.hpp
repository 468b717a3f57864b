// Checks that stay on in every build. What they test is true unless the program itself is wrong, so
// a failed one says where and why in one line and ends the process with a core: going on would give
// numbers that nobody should trust. What may be wrong from outside is a Result instead.
// Any thread, any fiber; a passed check costs a comparison.
#pragma once

namespace luxodus {

/// Prints "luxodus: file:line: what" to standard error and aborts.
[[noreturn]] void end_by_mistake(const char* file, int line, const char* what) noexcept;

}  // namespace luxodus

/// `what` is a sentence for whoever reads the last line of the log, made only on failure: a literal
/// or anything else that converts to const char*.
#define LUX_CHECK(condition, what) \
  ((condition) ? static_cast<void>(0) : ::luxodus::end_by_mistake(__FILE__, __LINE__, what))

// Assertions that stay on in every build. Their conditions hold unless the program itself is wrong,
// so a failure prints where and why in one line and aborts with a core dump: continuing would give
// numbers that nobody should trust. For errors in input use Result.
// Any thread, any fiber; a passed check costs a comparison.
#pragma once

namespace luxodus {

/// Prints "luxodus: file:line: what" to standard error and aborts.
[[noreturn]] void end_by_mistake(const char* file, int line, const char* what) noexcept;

}  // namespace luxodus

/// `what` is a sentence for the reader of the log's last line, evaluated only on failure: a literal
/// or anything else that converts to const char*.
#define LUX_CHECK(condition, what) \
  ((condition) ? static_cast<void>(0) : ::luxodus::end_by_mistake(__FILE__, __LINE__, what))

// 128-bit integers, in which the tallies sum. ISO C++ has no name for them; both our compilers do.
// Plain values; pure functions.
#pragma once

#include <cstdint>
#include <string>

namespace luxodus {

__extension__ typedef __int128 Int128;  // NOLINT: a typedef takes __extension__, `using` does not
__extension__ typedef unsigned __int128 UInt128;  // NOLINT

/// Nearest double.
inline double to_double(Int128 v) {
  return static_cast<double>(v);
}
inline double to_double(UInt128 v) {
  return static_cast<double>(v);
}

/// Decimal digits, for messages and JSON.
inline std::string to_string(Int128 v) {
  const bool negative = v < 0;
  UInt128 rest = negative ? -static_cast<UInt128>(v) : static_cast<UInt128>(v);
  std::string digits;
  do {
    digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(rest % 10)));
    rest /= 10;
  } while (rest != 0);
  return negative ? "-" + digits : digits;
}

}  // namespace luxodus

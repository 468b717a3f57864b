// Parses groups of Fortran namelists as FDS does: a line whose first character is '&' opens a
// group, '/' closes it, all else is a comment. Values are split but not interpreted: they are views
// into the text, which must outlive them. Any thread.
//
// Format: ISO/IEC 1539-1 (Fortran), namelist input, and FDS User's Guide (NIST SP 1019), "The basic
// structure of an input file".
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::fds_input {

namespace limits {
/// Values of all groups of a text: 10^6 vertices of a body have 3 million numbers.
inline constexpr size_t values = 8'000'000;
inline constexpr size_t groups = 1'000'000;
}  // namespace limits

/// A number, a word or a text; neither for a value omitted between two commas.
struct Value {
  std::string_view text;  // of a text: between its quotes, doubled quotes unresolved
  bool quoted = false;
  int line = 0;
};

/// "XB(1:6) = 0, 1, 0, 1, 0, 1".
struct Parameter {
  std::string name;  // in capitals
  int first = 1;     // its first subscript
  int line = 0;
  std::vector<Value> values;  // repeated ones ("3*0.5") are written out
};

struct Group {
  std::string name;  // "OBST"
  int line = 0;
  std::vector<Parameter> parameters;  // in file order: later ones win
};

/// The groups with these names, in file order. As in FDS, other groups need not be well formed.
/// Errors, with their line: an unclosed group or text, a value without a name, more than the
/// limits.
Result<std::vector<Group>> read_namelists(std::string_view text, const std::string& file,
                                          const std::set<std::string_view>& wanted);

}  // namespace luxodus::fds_input

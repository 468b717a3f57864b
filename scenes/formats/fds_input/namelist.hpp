// Groups of Fortran namelists, as FDS reads its input files: a line whose first character is '&'
// opens a group, '/' closes it, all else is a comment. Values are taken apart but not judged: they
// are words of the text, which outlives what is read. Any thread.
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
/// Of all groups of a text: 10^6 vertices of a body have 3 million numbers.
inline constexpr size_t values = 8'000'000;
inline constexpr size_t groups = 1'000'000;
}  // namespace limits

/// A number, a word or a text; neither where a value is left out between two commas.
struct Value {
  std::string_view text;  // of a text: between its quotes, doubled quotes as they stand
  bool quoted = false;
  int line = 0;
};

/// "XB(1:6) = 0, 1, 0, 1, 0, 1".
struct Parameter {
  std::string name;  // in capitals
  int first = 1;     // its first subscript
  int line = 0;
  std::vector<Value> values;  // repeated ones ("3*0.5") as often as they say
};

struct Group {
  std::string name;  // "OBST"
  int line = 0;
  std::vector<Parameter> parameters;  // in their order: later ones win
};

/// The groups of these names, in their order. Others need not be well formed, as for FDS.
/// Errors, with their line: a group or a text that is not closed, a value without a name, more than
/// the limits.
Result<std::vector<Group>> read_namelists(std::string_view text, const std::string& file,
                                          const std::set<std::string_view>& wanted);

}  // namespace luxodus::fds_input

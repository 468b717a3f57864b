// Problems that have no place of their own in a file: a text, a size. The reader of the scene knows
// where it was written and adds that. For the sources of this folder only.
#pragma once

#include <string>
#include <utility>

#include "runtime/core/result.hpp"

namespace luxodus {

inline Problem fault(std::string what) {
  Problem problem;
  problem.what = std::move(what);
  return problem;
}

}  // namespace luxodus

#include "runtime/core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace luxodus {

void end_by_mistake(const char* file, int line, const char* what) noexcept {
  std::fprintf(stderr, "luxodus: %s:%d: %s\n", file, line, what);
  std::abort();
}

}  // namespace luxodus

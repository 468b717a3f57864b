// Numbers that the environment states for random tests: seeds, and how many tries. Any thread.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace luxodus::test {

/// The number in a variable, decimal or 0x...; `otherwise` where it is not set.
inline uint64_t environment_number(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : otherwise;
}

}  // namespace luxodus::test

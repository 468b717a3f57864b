// The entry that libFuzzer looks for (target fuzz_codec, with Clang); to other programs a function
// that nobody calls.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  luxodus::test::fuzz_one({reinterpret_cast<const std::byte*>(data), size});
  return 0;
}

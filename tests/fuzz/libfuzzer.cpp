// The entry point of libFuzzer (targets fuzz_codec, fuzz_session and fuzz_flush, with Clang;
// LUX_FUZZ selects one); unused in other programs.
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/fuzz_codec.hpp"
#include "tests/fuzz/fuzz_flush.hpp"
#include "tests/fuzz/fuzz_session.hpp"

#ifndef LUX_FUZZ
#define LUX_FUZZ 0
#endif

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::span input{reinterpret_cast<const std::byte*>(data), size};
#if LUX_FUZZ == 1
  luxodus::test::fuzz_session(input);
#elif LUX_FUZZ == 2
  luxodus::test::fuzz_flush(input, true);
  luxodus::test::fuzz_flush(input, false);
#else
  luxodus::test::fuzz_one(input);
#endif
  return 0;
}

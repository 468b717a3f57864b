#include "runtime/core/zeroed_memory.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <span>

using namespace luxodus;

namespace {

bool all_zero(const ZeroedMemory& memory) {
  const std::span bytes(memory.data(), memory.bytes());
  return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
}

}  // namespace

TEST_CASE("memory is whole pages of zeros, and reads as zeros again after it is returned",
          "[memory]") {
  ZeroedMemory memory(10'000, ZeroedMemory::Pages::small);
  CHECK(memory.bytes() == 3 * ZeroedMemory::page_bytes);
  CHECK(all_zero(memory));
  for (size_t i = 0; i < memory.bytes(); i += 100) memory.data()[i] = std::byte{1};
  memory.give_back(1, 3);
  CHECK(memory.data()[ZeroedMemory::page_bytes] == std::byte{0});
  CHECK(memory.data()[100] == std::byte{1});
  memory.give_back(0, 1);
  CHECK(all_zero(memory));
}

TEST_CASE("address space is far more than memory", "[memory]") {
  constexpr size_t terabyte = size_t{1} << 40;
  ZeroedMemory memory(terabyte, ZeroedMemory::Pages::small);
  memory.data()[terabyte - 1] = std::byte{7};
  CHECK(memory.data()[terabyte - 1] == std::byte{7});
  CHECK(memory.data()[terabyte / 2] == std::byte{0});
}

TEST_CASE("memory that moves keeps its bytes", "[memory]") {
  ZeroedMemory a(1, ZeroedMemory::Pages::large);
  a.data()[0] = std::byte{3};
  ZeroedMemory b(std::move(a));
  CHECK(b.data()[0] == std::byte{3});
  ZeroedMemory c;
  c = std::move(b);
  CHECK(c.data()[0] == std::byte{3});
  CHECK(c.bytes() == ZeroedMemory::page_bytes);
}

// Address space that reads as zeros and becomes memory where it is written, page by page; what was
// written can be given back, and reads as zeros again. It takes nothing from the allocator. Which
// pages are in use the system tells, page tables and swap alike; a page that was only read counts
// as used there. (mincore would not do: it does not know a page that is swapped out.) Thread rule:
// as plain memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace luxodus {

class ZeroedMemory {
 public:
  static constexpr size_t page_bytes = 4096;

  /// How the system may back it.
  enum class Pages {
    large,  // as it likes: fewer misses of the address cache, but a byte may cost 2 MiB
    small   // one page at a time: a count of pages is a count of bytes
  };

  ZeroedMemory() = default;
  /// Errors (exception): no address space is left.
  ZeroedMemory(size_t bytes, Pages pages);
  ~ZeroedMemory();
  ZeroedMemory(ZeroedMemory&& other) noexcept
      : begin_(std::exchange(other.begin_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  ZeroedMemory& operator=(ZeroedMemory&& other) noexcept {
    std::swap(begin_, other.begin_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  std::byte* data() const { return begin_; }
  /// Rounded up to whole pages.
  size_t bytes() const { return bytes_; }

  /// Says of every page whether it is in use. False: the system does not tell. Some 20 ns a page.
  /// Requires: used.size() == bytes() / page_bytes.
  bool find_used(std::span<uint8_t> used) const;
  /// Whether this system tells.
  static bool use_is_told();

  /// Pages [first, end) read as zeros and take no memory. Requires: end * page_bytes <= bytes().
  void give_back(size_t first, size_t end);

 private:
  std::byte* begin_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace luxodus

// Address space that reads as zeros and becomes memory where it is written, page by page. Pages can
// be returned to the system, and then read as zeros again. It does not use the allocator. The
// system tells which pages are in use, by page tables and swap; a page that was only read counts as
// used. (mincore() does not see pages that are swapped out.) Thread rule: as plain memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace luxodus {

class ZeroedMemory {
 public:
  static constexpr size_t page_bytes = 4096;

  /// Page size the system may use.
  enum class Pages {
    large,  // the system's choice: fewer TLB misses, but one byte may cost 2 MiB
    small   // 4 KiB only: a count of pages is a count of bytes
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
  /// Size, rounded up to whole pages.
  size_t bytes() const { return bytes_; }

  /// Sets for every page whether it is in use; about 20 ns a page. Returns false if the system does
  /// not tell. Requires: used.size() == bytes() / page_bytes.
  bool find_used(std::span<uint8_t> used) const;
  /// Whether this system tells which pages are in use.
  static bool use_is_told();

  /// Pages [first, end) read as zeros and take no memory. Requires: end * page_bytes <= bytes().
  void give_back(size_t first, size_t end);

 private:
  std::byte* begin_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace luxodus

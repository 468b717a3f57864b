// An array of numbers most of which stay zero: address space for all, memory for the pages that are
// written, and a mark for each such page, so that merging, clearing and copying visit only these.
// Marks are set in one of two ways. Occasional writers call touch(). The hottest loops (kernels
// score through data()) set no marks, and find_touched() then asks the operating system which pages
// are in use: marking at each store made voxel scoring 40 % slower. Reading needs no marks.
// Thread rule: that of a plain array; threads may touch different elements of one page.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "runtime/core/zeroed_memory.hpp"

namespace luxodus {

/// Treatment of the memory of cleared pages.
enum class Cleared : uint8_t {
  kept,       // kept for reuse: fastest if there is memory for all
  given_back  // released, so that bytes() is what is in use now
};

template <class T>
class SparseArray {
 public:
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(ZeroedMemory::page_bytes % sizeof(T) == 0);
  static constexpr int64_t page_elements = ZeroedMemory::page_bytes / sizeof(T);

  SparseArray() = default;
  explicit SparseArray(int64_t size, Cleared cleared = Cleared::kept)
      : memory_(static_cast<size_t>(size) * sizeof(T),
                cleared == Cleared::kept ? ZeroedMemory::Pages::large : ZeroedMemory::Pages::small),
        marks_(memory_.bytes() / ZeroedMemory::page_bytes),
        size_(size),
        cleared_(cleared) {}
  /// Copies the touched pages only.
  SparseArray(const SparseArray& other) : SparseArray(other.size_, other.cleared_) {
    other.for_each_touched(0, size_, [&](int64_t first, int64_t end) {
      std::copy_n(other.data() + first, end - first, data() + first);
    });
    std::replace_copy(other.marks_.begin(), other.marks_.end(), marks_.begin(), page_cleared,
                      page_unused);
  }
  SparseArray(SparseArray&& other) noexcept { swap(other); }
  SparseArray& operator=(SparseArray other) noexcept {
    swap(other);
    return *this;
  }

  size_t size() const { return static_cast<size_t>(size_); }
  const T* data() const { return reinterpret_cast<const T*>(memory_.data()); }
  const T& operator[](size_t i) const { return data()[i]; }

  /// Write access without marks. Requires: find_touched() before the next walk, copy or clear.
  T* data() { return reinterpret_cast<T*>(memory_.data()); }
  /// Marks exactly the pages in use; all pages if the system cannot tell.
  void find_touched() {
    // find_used() writes 0 or 1, which are the marks of an unused and of a touched page.
    static_assert(page_unused == 0 && page_touched == 1);
    if (!memory_.find_used(marks_)) std::fill(marks_.begin(), marks_.end(), page_touched);
  }

  /// Elements [i, i + count) for writing; marks their pages. Requires: count >= 1.
  T* touch(int64_t i, int64_t count = 1) {
    for (int64_t page = i / page_elements; page <= (i + count - 1) / page_elements; ++page)
      std::atomic_ref(marks_[static_cast<size_t>(page)])
          .store(page_touched, std::memory_order_relaxed);
    return data() + i;
  }

  /// Calls visit(first, end) for the touched parts of [first, end), in ascending order; all other
  /// elements are zero.
  template <class Visit>
  void for_each_touched(int64_t first, int64_t end, Visit&& visit) const {
    while (first < end) {
      const int64_t begin = next_touched(first, end);
      if (begin == end) return;
      int64_t page = begin / page_elements;
      while (page * page_elements < end && marks_[static_cast<size_t>(page)] == page_touched)
        ++page;
      first = std::min(end, page * page_elements);
      visit(begin, first);
    }
  }
  /// The first element of [first, end) that may be non-zero; `end` if all are zero.
  int64_t next_touched(int64_t first, int64_t end) const {
    if (first >= end) return end;
    const auto from = marks_.begin() + first / page_elements;
    const auto to = marks_.begin() + (end - 1) / page_elements + 1;
    const auto at = std::find(from, to, page_touched);
    if (at == to) return end;
    return std::max(first, (at - marks_.begin()) * page_elements);
  }

  /// Sets all to zero.
  void clear() { clear(0, size_); }
  /// Clears the pages that lie entirely in [first, end); if `end` is the array's end, also the last
  /// page.
  void clear(int64_t first, int64_t end) {
    const int64_t pages = static_cast<int64_t>(marks_.size());
    const int64_t end_page = end == size_ ? pages : end / page_elements;
    int64_t page = (first + page_elements - 1) / page_elements;
    while (page < end_page) {
      if (marks_[static_cast<size_t>(page)] != page_touched) {
        ++page;
        continue;
      }
      int64_t behind = page;
      while (behind < end_page && marks_[static_cast<size_t>(behind)] == page_touched) ++behind;
      clear_pages(page, behind);
      page = behind;
    }
  }
  /// Clears all, a megabyte (some 0.1 ms) at a time, and calls `rest()` between steps.
  template <class Rest>
  void clear_in_steps(const Rest& rest) {
    constexpr int64_t step = (int64_t{1} << 20) / static_cast<int64_t>(sizeof(T));
    static_assert(step % page_elements == 0);
    for (int64_t first = 0; first < size_; first += step) {
      if (first > 0) rest();
      clear(first, std::min(size_, first + step));
    }
  }

  /// Memory in use: that of touched pages, and of cleared pages that were kept.
  size_t bytes() const {
    const auto unused = std::count(marks_.begin(), marks_.end(), page_unused);
    return (marks_.size() - static_cast<size_t>(unused)) * ZeroedMemory::page_bytes;
  }
  /// Increase of bytes() if elements [first, end) were touched.
  size_t bytes_to_touch(int64_t first, int64_t end) const {
    if (first >= end) return 0;
    const auto from = marks_.begin() + first / page_elements;
    const auto to = marks_.begin() + (end - 1) / page_elements + 1;
    return static_cast<size_t>(std::count(from, to, page_unused)) * ZeroedMemory::page_bytes;
  }

  friend bool operator==(const SparseArray& a, const SparseArray& b) {
    return std::equal(a.data(), a.data() + a.size_, b.data(), b.data() + b.size_);
  }

 private:
  static constexpr uint8_t page_unused = 0;  // no memory
  static constexpr uint8_t page_touched = 1;
  static constexpr uint8_t page_cleared = 2;  // memory, all zero

  void swap(SparseArray& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(marks_, other.marks_);
    std::swap(size_, other.size_);
    std::swap(cleared_, other.cleared_);
  }
  void clear_pages(int64_t first, int64_t end) {
    const auto a = static_cast<size_t>(first), b = static_cast<size_t>(end);
    const auto from = marks_.begin() + first, to = marks_.begin() + end;
    if (cleared_ == Cleared::given_back) {
      memory_.give_back(a, b);
      std::fill(from, to, page_unused);
    } else {
      std::memset(memory_.data() + a * ZeroedMemory::page_bytes, 0,
                  (b - a) * ZeroedMemory::page_bytes);
      std::fill(from, to, page_cleared);
    }
  }

  ZeroedMemory memory_;
  std::vector<uint8_t> marks_;  // one per page
  int64_t size_ = 0;
  Cleared cleared_ = Cleared::kept;
};

}  // namespace luxodus

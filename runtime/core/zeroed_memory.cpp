#include "runtime/core/zeroed_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <new>

#include "runtime/core/check.hpp"

namespace luxodus {

ZeroedMemory::ZeroedMemory(size_t bytes, Pages pages)
    : bytes_((bytes + page_bytes - 1) / page_bytes * page_bytes) {
  if (bytes_ == 0) return;
  void* const at = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (at == MAP_FAILED) throw std::bad_alloc();
  begin_ = static_cast<std::byte*>(at);
  // Fails if the system has no huge pages: then all pages are small.
  if (pages == Pages::small) (void)::madvise(begin_, bytes_, MADV_NOHUGEPAGE);
}

ZeroedMemory::~ZeroedMemory() {
  if (begin_ != nullptr) ::munmap(begin_, bytes_);
}

bool ZeroedMemory::find_used(std::span<uint8_t> used) const {
  // One word per page; its two highest bits: in memory, in swap (proc_pid_pagemap(5)).
  constexpr uint64_t in_use = uint64_t{3} << 62;
  const int file = ::open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  std::array<uint64_t, 256> words;
  const size_t first = reinterpret_cast<uintptr_t>(begin_) / page_bytes;
  size_t page = 0;
  while (page < used.size()) {
    const size_t count = std::min(words.size(), used.size() - page);
    const auto wanted = static_cast<ssize_t>(count * sizeof words[0]);
    const auto at = static_cast<off_t>((first + page) * sizeof words[0]);
    if (::pread(file, words.data(), static_cast<size_t>(wanted), at) != wanted) break;
    for (size_t i = 0; i < count; ++i) used[page + i] = (words[i] & in_use) != 0;
    page += count;
  }
  ::close(file);
  return page == used.size();
}

bool ZeroedMemory::use_is_told() {
  ZeroedMemory memory(2 * page_bytes, Pages::small);
  *memory.begin_ = std::byte{1};
  std::array<uint8_t, 2> used{};
  return memory.find_used(used) && used[0] == 1 && used[1] == 0;
}

void ZeroedMemory::give_back(size_t first, size_t end) {
  if (first == end) return;
  const int failed =
      ::madvise(begin_ + first * page_bytes, (end - first) * page_bytes, MADV_DONTNEED);
  LUX_CHECK(failed == 0, "pages of a private mapping can be given back");
}

}  // namespace luxodus

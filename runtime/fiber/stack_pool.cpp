#include "runtime/fiber/stack_pool.hpp"

#include <fmt/core.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "runtime/core/check.hpp"
#include "runtime/fiber/overflow_report.hpp"
#include "runtime/fiber/sanitizers.hpp"

namespace luxodus {

namespace {

constexpr size_t page_bytes = 4096;  // x86-64

// Guard below each stack. It is never touched and costs address space only. A frame larger than a
// guard of one page could skip it and land in a neighbour; 64 KB would spread the page tables so
// far that a switch among 10 000 fibers costs a third more.
constexpr size_t guard_bytes = 16 * 1024;

// Stacks a whole number of pages apart would put the frames of all suspended fibers into the same
// few cache sets: a switch among 1000 fibers then costs nearly twice as much. So the tops of
// neighbours are shifted by one cache line each, over 32 of the 64 sets of a first-level cache.
// This takes at most 2 KB from the stack, and the canary of the next one 128 bytes.
constexpr size_t line_bytes = 64;
constexpr size_t colours = 32;

// Canary of a stack without a guard: words that no code writes by chance. It lies at the far end of
// the gap below the stack, right above the top of the neighbour's stack, in a page that the
// neighbour uses: at the stack's own low end it would make a page resident, 400 MB for 100 000
// fibers. An overflow within the gap harms nobody, and one that goes on meets the canary before
// anything else. Two lines wide, since a frame leaves gaps that could skip a single word.
using Canary = std::array<uint64_t, 2 * line_bytes / sizeof(uint64_t)>;
constexpr Canary canary = [] {
  Canary words{};
  for (size_t i = 0; i < words.size(); ++i) words[i] = 0x6c75786f64757321 * (2 * i + 1);
  return words;
}();

size_t to_pages(size_t bytes) {
  return (bytes + page_bytes - 1) / page_bytes * page_bytes;
}

}  // namespace

size_t default_stack_bytes() {
  return sanitizers::stack_factor * 64 * 1024;
}

size_t max_process_maps() {
  constexpr size_t kernel_default = 65530;
  std::ifstream file("/proc/sys/vm/max_map_count");
  size_t count = 0;
  return file >> count ? count : kernel_default;
}

StackPool::StackPool(size_t count, size_t stack_bytes, size_t max_maps)
    : stack_bytes_(to_pages(std::max(stack_bytes, 2 * page_bytes))),
      slot_bytes_(stack_bytes_ + guard_bytes),
      guard_every_(std::max<size_t>(1, (2 * count + max_maps - 1) / std::max<size_t>(max_maps, 1))),
      owners_(count, nullptr) {
  if (count == 0) return;
  void* mapped = mmap(nullptr, mapped_bytes(), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (mapped == MAP_FAILED)
    throw std::runtime_error(fmt::format("cannot map {} fiber stacks of {} bytes: {}", count,
                                         stack_bytes_, std::strerror(errno)));
  base_ = {static_cast<char*>(mapped), Unmap{mapped_bytes()}};
  // A huge page would make resident what small pages leave untouched.
  madvise(mapped, mapped_bytes(), MADV_NOHUGEPAGE);
  for (size_t i = 0; i < count; ++i) {
    if (!guarded(i)) {
      std::memcpy(canary_of(i), canary.data(), sizeof canary);
    } else if (mprotect(base_.get() + i * slot_bytes_, guard_bytes, PROT_NONE) != 0) {
      throw std::runtime_error(
          fmt::format("cannot guard fiber stack {} of {}: {} (vm.max_map_count is {})", i, count,
                      std::strerror(errno), max_process_maps()));
    }
  }
  overflow_watch::add(*this);
}

StackPool::~StackPool() {
  overflow_watch::remove(*this);
}

void StackPool::Unmap::operator()(char* base) const noexcept {
  sanitizers::forget_frames(base, bytes);
  munmap(base, bytes);
}

char* StackPool::low_end(size_t index) const {
  LUX_CHECK(index < count(), "no such stack in the pool");
  return base_.get() + index * slot_bytes_ + guard_bytes;
}

char* StackPool::canary_of(size_t index) const {
  return base_.get() + index * slot_bytes_ - sizeof canary;
}

StackSpan StackPool::stack(size_t index) const {
  return {low_end(index), stack_bytes_ - index % colours * line_bytes - sizeof canary};
}

bool StackPool::canary_lives(size_t index) const {
  return guarded(index) || std::memcmp(canary_of(index), canary.data(), sizeof canary) == 0;
}

StackPool::Place StackPool::place_of(const void* address) const noexcept {
  const auto* byte = static_cast<const char*>(address);
  if (byte < base_.get() || byte >= base_.get() + mapped_bytes()) return {};
  const auto offset = static_cast<size_t>(byte - base_.get());
  const size_t index = offset / slot_bytes_;
  const bool in_guard = guarded(index) && offset % slot_bytes_ < guard_bytes;
  return {in_guard, index, stack_bytes_, owners_[index]};
}

}  // namespace luxodus

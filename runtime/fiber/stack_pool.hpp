// The stacks of a node's fibers: one mapping made at start, cut into equal slots. Below each stack
// lies a guard, so that an overflow faults at a known address (overflow_report.hpp reports it) and
// never corrupts another fiber's data. A guard costs the kernel two maps of the process's
// vm.max_map_count; if those are too few, every k-th stack has one, and the others have a gap that
// absorbs the first part of an overflow, with a canary at its end. Pages become resident only when
// they are touched. Thread rule: belongs to one node.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/fiber/context.hpp"

namespace luxodus {

/// Default size of a fiber's stack: 64 KB. The deepest call of a fiber so far uses 34 KB, and a log
/// line a few; four times that in builds with sanitizers or without an optimiser.
size_t default_stack_bytes();

/// vm.max_map_count of this machine; the kernel's default, 65530, if it cannot be read.
size_t max_process_maps();

class StackPool {
 public:
  /// Maps `count` stacks of at least `stack_bytes`, rounded up to pages, and guards as many as
  /// `max_maps` maps allow; nodes of one process share max_process_maps() between them. Throws
  /// std::runtime_error if the system refuses: no node starts without stacks.
  StackPool(size_t count, size_t stack_bytes, size_t max_maps);
  StackPool(const StackPool&) = delete;
  StackPool& operator=(const StackPool&) = delete;
  ~StackPool();

  size_t count() const { return owners_.size(); }
  /// Bytes of address space, guards included.
  size_t mapped_bytes() const { return count() * slot_bytes_; }
  /// Every k-th stack has a guard page: 1 means all.
  size_t guard_every() const { return guard_every_; }
  bool guarded(size_t index) const { return guard_every_ == 1 || index % guard_every_ == 0; }

  /// Requires: index < count().
  StackSpan stack(size_t index) const;

  /// False once the fiber on a stack without a guard has written further past its end than a guard
  /// would let it.
  bool canary_lives(size_t index) const;

  /// Names the fiber on the stack, for the overflow report; a literal, or null.
  void set_owner(size_t index, const char* owner) { owners_[index] = owner; }

  /// Describes an address in this mapping. Safe in a signal handler.
  struct Place {
    bool in_guard = false;
    size_t index = 0;
    size_t stack_bytes = 0;
    const char* owner = nullptr;
  };
  Place place_of(const void* address) const noexcept;

 private:
  struct Unmap {
    size_t bytes;
    void operator()(char* base) const noexcept;
  };
  char* low_end(size_t index) const;
  char* canary_of(size_t index) const;

  size_t stack_bytes_;
  size_t slot_bytes_;
  size_t guard_every_;
  std::vector<const char*> owners_;
  std::unique_ptr<char, Unmap> base_;
};

}  // namespace luxodus

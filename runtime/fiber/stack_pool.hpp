// The stacks of a node's fibers: one mapping made at start, cut into equal slots. Below each stack
// lies a guard, so that an overflow is a fault with an address (overflow_report.hpp makes it a
// line for people) and never another fiber's data. A guard costs the kernel two maps of the
// process's vm.max_map_count; where that is too few, every k-th stack has one, and the others a
// canary at their low end, above a gap that takes the first of an overflow harmlessly.
// Pages are touched as they are used: what is mapped is not what is resident. Belongs to one node.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/fiber/context.hpp"

namespace luxodus {

/// Bytes of a fiber's stack unless told otherwise: 64 KB. A particle that collects candidates
/// through Embree uses 10.8 KB, a path from the eye that looks for a flame through media 34 KB, and
/// a log line needs a few; four times that in builds with sanitizers or without an optimiser.
size_t default_stack_bytes();

/// vm.max_map_count of this machine; the kernel's default, 65530, where it cannot be read.
size_t max_process_maps();

class StackPool {
 public:
  /// Maps `count` stacks of at least `stack_bytes`, rounded up to pages, and protects as many as
  /// `max_maps` maps allow; nodes of one process share max_process_maps() between them.
  /// Throws std::runtime_error where the system refuses: a start cannot go on without stacks.
  StackPool(size_t count, size_t stack_bytes, size_t max_maps);
  StackPool(const StackPool&) = delete;
  StackPool& operator=(const StackPool&) = delete;
  ~StackPool();

  size_t count() const { return owners_.size(); }
  /// Bytes of address space, guards included.
  size_t mapped_bytes() const { return count() * slot_bytes_; }
  /// One of how many stacks has a guard page: 1 where all have.
  size_t guard_every() const { return guard_every_; }
  bool guarded(size_t index) const { return guard_every_ == 1 || index % guard_every_ == 0; }

  /// Requires: index < count().
  StackSpan stack(size_t index) const;

  /// False once the fiber on a stack without a guard has written past its end.
  bool canary_lives(size_t index) const;

  /// Who runs on the stack, for the line about an overflow; a literal, or null.
  void set_owner(size_t index, const char* owner) { owners_[index] = owner; }

  /// What an address in this mapping is. Safe in a signal handler.
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

  size_t stack_bytes_;
  size_t slot_bytes_;
  size_t guard_every_;
  std::vector<const char*> owners_;
  std::unique_ptr<char, Unmap> base_;
};

}  // namespace luxodus

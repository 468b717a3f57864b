// A queue of fixed capacity, allocated once. First in, first out. It never grows: push() returns
// false when it is full. Thread rule: belongs to one node; no locks.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "runtime/core/check.hpp"

namespace luxodus {

/// T is default constructible and movable; a popped slot keeps a moved-from T.
template <class T>
class Ring {
 public:
  explicit Ring(size_t capacity) : slots_(new T[capacity]), capacity_(capacity) {}

  size_t capacity() const { return capacity_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == capacity_; }

  /// Appends `value`; returns false and changes nothing if the ring is full.
  [[nodiscard]] bool push(T value) {
    if (full()) return false;
    slots_[wrapped(first_ + size_)] = std::move(value);
    ++size_;
    return true;
  }

  /// Removes and returns the oldest. Requires: !empty().
  T pop() {
    LUX_CHECK(size_ > 0, "pop from an empty ring");
    T value = std::move(slots_[first_]);
    first_ = wrapped(first_ + 1);
    --size_;
    return value;
  }

  /// The i-th oldest. Requires: i < size().
  T& operator[](size_t i) {
    LUX_CHECK(i < size_, "ring read past its end");
    return slots_[wrapped(first_ + i)];
  }

 private:
  size_t wrapped(size_t i) const { return i < capacity_ ? i : i - capacity_; }

  std::unique_ptr<T[]> slots_;
  size_t capacity_;
  size_t first_ = 0;
  size_t size_ = 0;
};

}  // namespace luxodus

// Objects that are made once, at start, and lent: taking and giving back touch no allocator. The
// object given back last is taken next, since it is still in the caches and since runs stay
// reproducible. Objects keep their state between loans: the taker sets what it needs. Thread rule:
// belongs to one node; no locks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/core/check.hpp"

namespace luxodus {

/// What to do when the pool is empty.
enum class WhenEmpty {
  mistake,  // the memory plan rules it out: the process aborts and names the pool
  wait,     // load can cause it: take() gives null, and the caller waits or refuses
};

/// Names one loan of one object: the index in the low bits, above it how often that slot has
/// changed hands. A Loan kept longer than its loan finds nothing.
using Loan = uint64_t;

template <class T>
class FixedPool {
 public:
  /// T is default constructible; it need not be movable.
  FixedPool(const std::string& name, size_t capacity, WhenEmpty reaction)
      : empty_line_("pool is empty, against the arithmetic of the memory plan: " + name),
        reaction_(reaction),
        capacity_(capacity),
        objects_(new T[capacity]),
        changes_(capacity, 0) {
    LUX_CHECK(capacity <= place_mask, "a pool of more objects than a loan can name");
    resting_.reserve(capacity);
    for (size_t i = capacity; i > 0; --i) resting_.push_back(i - 1);
  }

  /// An object in the state in which it was last given back; null if none is left and the reaction
  /// is `wait`.
  [[nodiscard]] T* take() {
    if (resting_.empty()) {
      LUX_CHECK(reaction_ == WhenEmpty::wait, empty_line_.c_str());
      return nullptr;
    }
    const size_t i = resting_.back();
    resting_.pop_back();
    ++changes_[i];
    if (in_use() > max_in_use_) max_in_use_ = in_use();
    return &objects_[i];
  }

  /// Requires: `object` was taken from this pool and not yet given back.
  void give(T& object) {
    const size_t i = index_of(object);
    LUX_CHECK(lent(i), "given back to its pool twice");
    ++changes_[i];
    resting_.push_back(i);
  }

  /// Bookkeeping bytes per object, for a memory plan.
  static constexpr size_t bytes_beside = sizeof(size_t) + sizeof(uint64_t);

  size_t capacity() const { return capacity_; }
  size_t in_use() const { return capacity_ - resting_.size(); }
  size_t max_in_use() const { return max_in_use_; }

  /// Requires: `object` is lent.
  Loan loan_of(const T& object) const {
    const size_t i = index_of(object);
    LUX_CHECK(lent(i), "named a loan of an object that rests");
    return changes_[i] << place_bits | i;
  }
  /// The object while that loan lasts; afterwards null.
  T* find(Loan loan) {
    const size_t i = loan & place_mask;
    return i < capacity_ && lent(i) && changes_[i] == loan >> place_bits ? &objects_[i] : nullptr;
  }

  /// Index of an object in the pool, 0 to capacity() - 1.
  size_t index_of(const T& object) const {
    const auto i = static_cast<size_t>(&object - objects_.get());
    LUX_CHECK(i < capacity_, "an object of another pool");
    return i;
  }
  /// Requires: index < capacity().
  T& at(size_t index) {
    LUX_CHECK(index < capacity_, "no such object in the pool");
    return objects_[index];
  }
  const T& at(size_t index) const {
    LUX_CHECK(index < capacity_, "no such object in the pool");
    return objects_[index];
  }

 private:
  // 16 million objects, and 2^39 loans of each before a Loan repeats.
  static constexpr int place_bits = 24;
  static constexpr Loan place_mask = (Loan{1} << place_bits) - 1;

  bool lent(size_t i) const { return changes_[i] % 2 == 1; }

  std::string empty_line_;  // complete, since a failing check must not allocate
  WhenEmpty reaction_;
  size_t capacity_;
  std::unique_ptr<T[]> objects_;
  std::vector<size_t> resting_;
  std::vector<uint64_t> changes_;  // odd while lent
  size_t max_in_use_ = 0;
};

}  // namespace luxodus

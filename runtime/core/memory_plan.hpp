// A node's memory, planned before it is used: one term per consumer, with the sentence that derives
// its size. The sum is compared with the node's budget at start, and the table is printed, so that
// the user sees which setting to change when memory is short. Allocates none of the memory it
// plans. A plain value, made at start; one thread at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class MemoryPlan {
 public:
  struct Term {
    std::string name;
    uint64_t bytes = 0;
    std::string derivation;  // "4096 fibers x 32 KB"
  };

  void add(std::string name, uint64_t bytes, std::string derivation);

  /// Adds all terms of another plan.
  void add(const MemoryPlan& other);

  const std::vector<Term>& terms() const { return terms_; }
  uint64_t total_bytes() const;

  /// Errors: the sum passes the budget; by how much, and the largest term.
  Result<void> fits(uint64_t budget_bytes) const;

  /// One line per term, the largest first, then the sum.
  std::string table() const;
  /// table() with the sum beside the budget.
  std::string table(uint64_t budget_bytes) const;

 private:
  std::string rows() const;

  std::vector<Term> terms_;
};

}  // namespace luxodus

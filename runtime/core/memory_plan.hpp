// Where a node's memory goes, said before it is used: one term per consumer, with the sentence that
// derives its size. The sum is held against the node's budget at start, and the table is printed,
// so that whoever runs out of memory sees which number to change. It allocates nothing itself.
// A plain value, made at start.
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

  /// Adds all terms of another.
  void add(const MemoryPlan& other);

  const std::vector<Term>& terms() const { return terms_; }
  uint64_t total_bytes() const;

  /// Errors: the sum passes the budget; by how much, and the largest term.
  Result<void> fits(uint64_t budget_bytes) const;

  /// One line per term, the largest first, and the sum.
  std::string table() const;
  /// The same, with the sum beside the budget.
  std::string table(uint64_t budget_bytes) const;

 private:
  std::string rows() const;

  std::vector<Term> terms_;
};

}  // namespace luxodus

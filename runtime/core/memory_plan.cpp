#include "runtime/core/memory_plan.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace luxodus {

namespace {

double mebibytes(uint64_t bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

std::vector<MemoryPlan::Term> largest_first(std::vector<MemoryPlan::Term> terms) {
  std::stable_sort(terms.begin(), terms.end(),
                   [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
  return terms;
}

}  // namespace

void MemoryPlan::add(std::string name, uint64_t bytes, std::string derivation) {
  terms_.push_back({std::move(name), bytes, std::move(derivation)});
}

void MemoryPlan::add(const MemoryPlan& other) {
  terms_.insert(terms_.end(), other.terms_.begin(), other.terms_.end());
}

uint64_t MemoryPlan::total_bytes() const {
  uint64_t sum = 0;
  for (const Term& term : terms_) sum += term.bytes;
  return sum;
}

Result<void> MemoryPlan::fits(uint64_t budget_bytes) const {
  const uint64_t total = total_bytes();
  if (total <= budget_bytes) return {};
  const Term largest = largest_first(terms_).front();
  return problem(
      fmt::format("the memory plan needs {:.1f} MiB, {:.1f} more than the budget of {:.1f} MiB; "
                  "the largest part is {}, {:.1f} MiB ({})",
                  mebibytes(total), mebibytes(total - budget_bytes), mebibytes(budget_bytes),
                  largest.name, mebibytes(largest.bytes), largest.derivation),
      ProblemKind::no_room);
}

std::string MemoryPlan::rows() const {
  std::string out = fmt::format("{:<24} {:>10}  {}\n", "memory plan", "MiB", "derived from");
  for (const Term& term : largest_first(terms_))
    out += fmt::format("{:<24} {:>10.2f}  {}\n", term.name, mebibytes(term.bytes), term.derivation);
  return out;
}

std::string MemoryPlan::table() const {
  return rows() + fmt::format("{:<24} {:>10.2f}\n", "sum", mebibytes(total_bytes()));
}

std::string MemoryPlan::table(uint64_t budget_bytes) const {
  return rows() + fmt::format("{:<24} {:>10.2f}  of a budget of {:.2f}\n", "sum",
                              mebibytes(total_bytes()), mebibytes(budget_bytes));
}

}  // namespace luxodus

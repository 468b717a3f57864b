// Problems as numbers alone, for tests of what solves them.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "actors/design/layout_problem.hpp"

namespace luxodus::test {

inline Terms sum_of(std::vector<Term> list) {
  return std::make_shared<const std::vector<Term>>(std::move(list));
}

/// A problem with `options` luminaires of one type, each at a place of its own, of weight 1.
inline LayoutProblem with_options(uint32_t options) {
  LayoutProblem out;
  for (uint32_t i = 0; i < options; ++i)
    out.options.push_back({i, 1, false, no_region, {static_cast<double>(i), 0}});
  return out;
}

/// That a sum is not below `least`, as a demand of its own.
inline void ask(LayoutProblem& problem, std::vector<Term> list, double least, const char* subject) {
  problem.groups.push_back({DemandKind::minimum, "E1", subject, least, no_region});
  problem.covers.push_back(
      {static_cast<uint32_t>(problem.groups.size() - 1), sum_of(std::move(list)), least, {}});
}

}  // namespace luxodus::test

// A design without progress messages or interrupts, for tests.
#pragma once

#include <atomic>

#include "actors/judge/design/solve_layout.hpp"

namespace luxodus::test {

inline const std::atomic<bool> nobody{false};
inline const SolveProgress silent = [](const std::string&, double, double) {};

}  // namespace luxodus::test

// Linear programs some of whose variables are whole numbers, solved by CBC (COIN-OR branch and
// cut). The only source that includes CBC. The same program gives the same answer, unless a limit
// of time or an interrupt ends the search. Thread rule: one call at a time in a process, since CBC
// keeps globals. SIGINT stays with whoever listens to it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace luxodus {

/// low <= sum of value times variable <= high.
struct LinearRow {
  std::vector<int> column;
  std::vector<double> value;  // as many
  double low = 0, high = 0;
};

/// Makes the sum of cost times variable as small as can be.
struct IntegerProgram {
  std::vector<double> cost, low, high;  // of each variable
  std::vector<char> whole;              // of each variable, whether it is a whole number
  std::vector<LinearRow> rows;

  /// A further variable: its number.
  int add_variable(double cost_of_one, double low_bound, double high_bound, bool is_whole);
};

struct ProgramLimits {
  double seconds = 60;
  /// The search ends when the best solution is within this share of the bound.
  double gap = 0;
  /// Only solutions below this are wanted.
  std::optional<double> cutoff = {};
  /// Nodes of the search tree.
  int64_t nodes = 10'000'000;
  /// The first solution is enough.
  bool any_solution = false;
};

enum class ProgramEnd {
  solved,      // within the gap
  stopped,     // by a limit or an interrupt: `values` may be empty
  infeasible,  // no solution, or none below the cutoff
};

struct ProgramAnswer {
  ProgramEnd end = ProgramEnd::stopped;
  std::vector<double> values;  // of the best solution; empty: none was found
  double objective = 0;        // of it
  double bound = 0;            // no solution is below it
};

/// Best solution and bound so far; no solution: infinity.
using ProgramProgress = std::function<void(double best, double bound)>;

ProgramAnswer solve_program(const IntegerProgram& program, const ProgramLimits& limits,
                            const std::atomic<bool>& interrupt, const ProgramProgress& progress);

/// Of each row, by how much the smallest objective of the program without whole numbers grows when
/// its bound grows by one (the dual values). Empty where that program has no solution, or none in
/// time.
std::vector<double> row_prices(const IntegerProgram& program, double seconds,
                               const std::atomic<bool>& interrupt);

}  // namespace luxodus

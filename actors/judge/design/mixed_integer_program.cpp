#include "actors/judge/design/mixed_integer_program.hpp"

#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <CbcSolver.hpp>
#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <limits>
#include <string>

#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// CBC's value for no limit and for no solution.
constexpr double cbc_infinity = 1e30;

/// The deadline of a search, and the bound known before it.
class Deadline {
 public:
  Deadline(const std::atomic<bool>& interrupt, double seconds)
      : interrupt_(interrupt),
        at_(clock_.now() + static_cast<Nanoseconds>(1e9 * std::clamp(seconds, 0.0, longest_s))) {}

  /// Stays true once passed: CBC draws wrong conclusions from linear programs that were stopped.
  bool passed() {
    passed_ = passed_ || interrupt_ || clock_.now() > at_;
    return passed_;
  }
  bool was_passed() const { return passed_; }

  double bound = -cbc_infinity;

 private:
  static constexpr double longest_s = 1e8;

  const std::atomic<bool>& interrupt_;
  SystemClock clock_;
  Nanoseconds at_;
  bool passed_ = false;
};

/// Reports the progress of a search and ends it at its deadline. CBC copies it.
class SearchWatch : public CbcEventHandler {
 public:
  SearchWatch(Deadline& deadline, const ProgramProgress& progress)
      : deadline_(&deadline), progress_(&progress) {}

  CbcAction event(CbcEvent) override {
    const bool over = deadline_->passed();
    // Nested searches (heuristics) have other objectives.
    if (!over && model_ != nullptr && model_->parentModel() == nullptr) {
      const double best = model_->getObjValue(), bound = model_->getBestPossibleObjValue();
      if (bound > -cbc_infinity && bound <= best) deadline_->bound = bound;
      if (*progress_)
        (*progress_)(best < cbc_infinity ? best : std::numeric_limits<double>::infinity(), bound);
    }
    return over ? stop : noAction;
  }
  CbcEventHandler* clone() const override { return new SearchWatch(*this); }

 private:
  Deadline* deadline_;
  const ProgramProgress* progress_;
};

/// Ends linear programs at the deadline: CBC checks its own limit only between them, and one may
/// take many seconds. Clp copies it.
class LinearWatch : public ClpEventHandler {
 public:
  explicit LinearWatch(Deadline& deadline) : deadline_(&deadline) {}

  int event(Event what) override {
    constexpr int go_on = -1, stopped = 3;
    constexpr unsigned looked_at_each = 16;  // iterations
    if (what != endOfIteration || ++iterations_ % looked_at_each != 0) return go_on;
    return deadline_->passed() ? stopped : go_on;
  }
  ClpEventHandler* clone() const override { return new LinearWatch(*this); }

 private:
  Deadline* deadline_;
  unsigned iterations_ = 0;
};

/// Switches off Clp's own handler of Ctrl-C, which would replace the program's during a linear
/// program; the deadline checks the program's.
void leave_signals_alone(OsiClpSolverInterface& solver) {
  constexpr int interrupt_handling = 2, off = 1;
  ClpSolve options;
  options.setSpecialOption(interrupt_handling, off);
  solver.setSolveOptions(options);
}

/// Loads all rows at once: adding them one by one would copy the earlier rows each time.
void load(const IntegerProgram& program, OsiClpSolverInterface& solver) {
  std::vector<int> column;
  std::vector<double> value, low, high;
  std::vector<CoinBigIndex> start{0};
  for (const LinearRow& row : program.rows) {
    column.insert(column.end(), row.column.begin(), row.column.end());
    value.insert(value.end(), row.value.begin(), row.value.end());
    start.push_back(static_cast<CoinBigIndex>(column.size()));
    low.push_back(std::max(row.low, -cbc_infinity));
    high.push_back(std::min(row.high, cbc_infinity));
  }
  const CoinPackedMatrix matrix(false, static_cast<int>(program.cost.size()),
                                static_cast<int>(program.rows.size()), start.back(), value.data(),
                                column.data(), start.data(), nullptr);
  solver.messageHandler()->setLogLevel(0);
  solver.getModelPtr()->setLogLevel(0);  // its own messages, as of a stopped presolve
  solver.loadProblem(matrix, program.low.data(), program.high.data(), program.cost.data(),
                     low.data(), high.data());
  leave_signals_alone(solver);
}

}  // namespace

int IntegerProgram::add_variable(double cost_of_one, double low_bound, double high_bound,
                                 bool is_whole) {
  cost.push_back(cost_of_one);
  low.push_back(low_bound);
  high.push_back(high_bound);
  whole.push_back(is_whole ? 1 : 0);
  return static_cast<int>(cost.size()) - 1;
}

ProgramAnswer solve_program(const IntegerProgram& program, const ProgramLimits& limits,
                            const std::atomic<bool>& interrupt, const ProgramProgress& progress) {
  Deadline deadline(interrupt, limits.seconds);
  OsiClpSolverInterface solver;
  load(program, solver);
  LinearWatch linear(deadline);
  solver.getModelPtr()->passInEventHandler(&linear);
  for (size_t i = 0; i < program.whole.size(); ++i)
    if (program.whole[i] != 0) solver.setInteger(static_cast<int>(i));
  CbcModel model(solver);
  CbcSolverUsefulData data;
  CbcMain0(model, data);
  model.setLogLevel(0);
  SearchWatch watch(deadline, progress);
  model.passInEventHandler(&watch);
  std::vector<std::string> words{"luxodus",
                                 "-log",
                                 "0",
                                 "-timeMode",
                                 "elapsed",
                                 "-seconds",
                                 std::to_string(std::max(limits.seconds, 0.01)),
                                 "-ratioGap",
                                 std::to_string(limits.gap),
                                 "-maxNodes",
                                 std::to_string(std::min<int64_t>(limits.nodes, 2'000'000'000))};
  if (limits.cutoff) words.insert(words.end(), {"-cutoff", std::to_string(*limits.cutoff)});
  if (limits.any_solution) words.insert(words.end(), {"-maxSolutions", "1"});
  words.insert(words.end(), {"-solve", "-quit"});
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  CbcMain1(
      static_cast<int>(arguments.size()), arguments.data(), model, [](CbcModel*, int) { return 0; },
      data);

  // CBC checks its own time limit as well, and may then report unsolved programs as infeasible.
  (void)deadline.passed();
  ProgramAnswer answer;
  const double* best = model.bestSolution();
  if (best != nullptr && model.getObjValue() < cbc_infinity) {
    answer.values.assign(best, best + program.cost.size());
    answer.objective = model.getObjValue();
  }
  answer.bound = model.getBestPossibleObjValue();
  const bool stopped = model.status() != 0 || deadline.was_passed();
  if (!stopped && !answer.values.empty()) {
    answer.end = ProgramEnd::solved;
    answer.bound = std::min(answer.bound, answer.objective);
  } else if (!deadline.was_passed() && (!stopped || model.isProvenInfeasible())) {
    answer.end = ProgramEnd::infeasible;
  }
  if (deadline.was_passed()) answer.bound = std::min(answer.bound, deadline.bound);
  // Without a node CBC has no bound; costs are not negative, so zero is one.
  if (!(answer.bound > -cbc_infinity && answer.bound < cbc_infinity)) answer.bound = 0;
  return answer;
}

std::vector<double> row_prices(const IntegerProgram& program, double seconds,
                               const std::atomic<bool>& interrupt) {
  Deadline deadline(interrupt, seconds);
  OsiClpSolverInterface solver;
  load(program, solver);
  LinearWatch linear(deadline);
  solver.getModelPtr()->passInEventHandler(&linear);
  solver.initialSolve();
  if (!solver.isProvenOptimal()) return {};
  const double* prices = solver.getRowPrice();
  return {prices, prices + program.rows.size()};
}

}  // namespace luxodus

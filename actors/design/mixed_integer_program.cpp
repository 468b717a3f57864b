#include "actors/design/mixed_integer_program.hpp"

#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <CbcSolver.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <csignal>
#include <limits>
#include <string>

namespace luxodus {

namespace {

/// What CBC takes for no limit, and what it reports where it has no solution.
constexpr double cbc_infinity = 1e30;

/// Tells how far the search is, and ends it when somebody asks for that. CBC copies it.
class SearchWatch : public CbcEventHandler {
 public:
  SearchWatch(const std::atomic<bool>& interrupt, const ProgramProgress& progress)
      : interrupt_(&interrupt), progress_(&progress) {}

  CbcAction event(CbcEvent) override {
    // Searches within the search have other objectives.
    if (model_ != nullptr && model_->parentModel() == nullptr && *progress_) {
      const double best = model_->getObjValue();
      (*progress_)(best < cbc_infinity ? best : std::numeric_limits<double>::infinity(),
                   model_->getBestPossibleObjValue());
    }
    return *interrupt_ ? stop : noAction;
  }
  CbcEventHandler* clone() const override { return new SearchWatch(*this); }

 private:
  const std::atomic<bool>* interrupt_;
  const ProgramProgress* progress_;
};

/// Gives SIGINT back to whoever had it.
class SignalKept {
 public:
  SignalKept() { ::sigaction(SIGINT, nullptr, &before_); }
  ~SignalKept() { ::sigaction(SIGINT, &before_, nullptr); }
  SignalKept(const SignalKept&) = delete;
  SignalKept& operator=(const SignalKept&) = delete;

 private:
  struct sigaction before_ {};
};

void load(const IntegerProgram& program, OsiClpSolverInterface& solver) {
  const auto columns = static_cast<int>(program.cost.size());
  CoinPackedMatrix matrix(false, 0, 0);
  matrix.setDimensions(0, columns);
  std::vector<double> low, high;
  for (const LinearRow& row : program.rows) {
    matrix.appendRow(static_cast<int>(row.column.size()), row.column.data(), row.value.data());
    low.push_back(std::max(row.low, -cbc_infinity));
    high.push_back(std::min(row.high, cbc_infinity));
  }
  solver.messageHandler()->setLogLevel(0);
  solver.loadProblem(matrix, program.low.data(), program.high.data(), program.cost.data(),
                     low.data(), high.data());
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
  const SignalKept kept;
  OsiClpSolverInterface solver;
  load(program, solver);
  for (size_t i = 0; i < program.whole.size(); ++i)
    if (program.whole[i] != 0) solver.setInteger(static_cast<int>(i));
  CbcModel model(solver);
  CbcSolverUsefulData data;
  CbcMain0(model, data);
  model.setLogLevel(0);
  SearchWatch watch(interrupt, progress);
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

  ProgramAnswer answer;
  const double* best = model.bestSolution();
  if (best != nullptr && model.getObjValue() < cbc_infinity) {
    answer.values.assign(best, best + program.cost.size());
    answer.objective = model.getObjValue();
  }
  answer.bound = model.getBestPossibleObjValue();
  constexpr int by_event = 5;
  answer.interrupted = model.secondaryStatus() == by_event && !interrupt;
  const bool stopped = model.status() != 0;
  if (!stopped && !answer.values.empty()) {
    answer.end = ProgramEnd::solved;
    answer.bound = std::min(answer.bound, answer.objective);
  } else if (!stopped || model.isProvenInfeasible()) {
    answer.end = ProgramEnd::infeasible;
  }
  // Without a node CBC has no bound: what can be said is that no cost is below zero.
  if (!(answer.bound > -cbc_infinity && answer.bound < cbc_infinity)) answer.bound = 0;
  return answer;
}

std::vector<double> row_prices(const IntegerProgram& program) {
  OsiClpSolverInterface solver;
  load(program, solver);
  solver.initialSolve();
  if (!solver.isProvenOptimal()) return {};
  const double* prices = solver.getRowPrice();
  return {prices, prices + program.rows.size()};
}

}  // namespace luxodus

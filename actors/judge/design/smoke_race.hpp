// Elimination rounds of layouts in smoke (successive halving): each round traces four times as many
// paths as the one before, for layouts that more paths could still rank differently. Layouts of one
// group share their paths. Thread rule: one thread, which has batches traced by others.
#pragma once

#include "actors/judge/design/smoke_stage.hpp"

namespace luxodus {

/// Whether `a` dominates `b`: certainly not read less, at no higher objective, and better in one of
/// them.
bool beats(const JudgedLayout& a, const JudgedLayout& b);

class SmokeRace {
 public:
  /// Requires: all arguments outlive this; `stage` has its layouts, scenarios and heights.
  SmokeRace(SmokeStage& stage, const std::vector<LayoutGroup>& groups,
            const SmokeStageOptions& options, const std::atomic<bool>& stopped,
            const std::function<void(const std::string&)>& progress)
      : stage_(stage),
        groups_(groups),
        options_(options),
        stopped_(stopped),
        progress_(progress),
        places_(stage.layouts.size()) {}

  /// Judges layouts until `stopped`, until all are decided, or until the last round. Layouts that
  /// were not reached have zero rounds. False if it was stopped before it finished. Errors: as
  /// HeatState::make and SightsInLights::trace, except those that `stopped` causes.
  Result<bool> run();

 private:
  /// States of a group, by scenario.
  using States = std::vector<std::unique_ptr<LayoutGroupState>>;

  Result<bool> race(size_t group, int round);
  Result<void> open_group(const LayoutGroup& group);
  Result<void> trace(size_t group, int round, const std::vector<bool>& asked);
  void judge(size_t group, int rounds);
  void compare_with_first(size_t group);
  void count_places(size_t layout);
  bool is_open(const JudgedLayout& one) const;
  bool is_told_apart(const JudgedLayout& one) const;
  bool any_open() const;
  AssessProgress tell(const LayoutGroup& group, size_t scenario, int round) const;

  SmokeStage& stage_;
  const std::vector<LayoutGroup>& groups_;
  const SmokeStageOptions& options_;
  const std::atomic<bool>& stopped_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<States> states_;                   // by group
  std::vector<std::vector<SeenPlaces>> places_;  // by layout and scenario
};

}  // namespace luxodus

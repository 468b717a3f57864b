// The race of layouts in smoke: rounds of paths, each of four times as many, as long as more paths
// could change which layout is read from more of the routes. Layouts of one group share their
// paths. Thread rule: one thread, which has batches traced by others.
#pragma once

#include "actors/judge/design/smoke_stage.hpp"

namespace luxodus {

/// Whether `a` is surely read at least as well for no more.
bool beats(const JudgedLayout& a, const JudgedLayout& b);

class SmokeRace {
 public:
  /// Requires: all outlive this; `stage` has its layouts, scenarios and heights.
  SmokeRace(SmokeStage& stage, const std::vector<LayoutGroup>& groups,
            const SmokeStageOptions& options, const std::atomic<bool>& stopped,
            const std::function<void(const std::string&)>& progress)
      : stage_(stage),
        groups_(groups),
        options_(options),
        stopped_(stopped),
        progress_(progress),
        places_(stage.layouts.size()) {}

  /// Judges layouts until `stopped`, or nothing is to be found out, or there are no more rounds.
  /// Layouts that it did not come to are left at no rounds. False where it was stopped with paths
  /// left to trace. Errors: as LayoutGroupState::make and SightsInLights::trace, but not of who
  /// stopped it.
  Result<bool> run();

 private:
  /// Of a group, by scenario.
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
  std::vector<std::vector<SeenPlaces>> places_;  // of each layout, by scenario
};

}  // namespace luxodus

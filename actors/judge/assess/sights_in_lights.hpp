// The reality mode: what people on the routes read of the signs, with all light and all smoke, from
// paths traced from their eyes; of one building in one light or in several, such as those of
// several layouts of luminaires, which the same paths tell of. Rounds of paths go on where a
// verdict is undecided. Thread rule: one thread, which has batches traced by others.
#pragma once

#include <optional>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "actors/judge/assess/stands.hpp"

namespace luxodus {

class SightsInLights {
 public:
  /// `observers`: those that the scene names. Requires: all outlive this; where nodes trace, the
  /// scenario is one of the scene's file and there is one light.
  SightsInLights(const JudgedScene& judged, const std::vector<Observer>& observers,
                 const OtherSmoke& smoke, const AssessOptions& options);

  /// Who can see what, by straight lines: the same in every light.
  /// Errors: as compile_scene; more pairs of place and sign than a limit.
  Result<void> look_for_lines(const AssessProgress& progress);

  /// One round of paths for the views that are undecided in any of the lights `asked`. Lights that
  /// are not asked for learn from the same paths. Requires: one is open; rounds ascend from 0.
  /// Errors: as compile_round; as the executor; `interrupt`.
  Result<void> trace(int round, const std::vector<bool>& asked, const std::atomic<bool>& interrupt,
                     const AssessProgress& progress);

  size_t lights() const { return rows_.size(); }
  /// Whether a verdict is undecided in a light.
  bool is_open(size_t light) const;
  /// Of all views that the building lets be, in a light.
  const std::vector<SightRow>& rows(size_t light) const { return rows_[light]; }
  /// Of a view that is undecided in the first light and in another one: the standard error of its
  /// level of reading in that light less that in the first, which is smaller than that of either,
  /// as paths show both. None where a verdict is given, and where one counts in aged light and the
  /// other in new. Requires: not the first light.
  std::optional<double> error_beyond_first(size_t light, size_t row) const;
  int64_t paths() const { return paths_; }

 private:
  /// A view whose verdict paths decide.
  struct Faced {
    size_t row, stand;
    uint32_t sign;
    std::vector<double> veils_cd_m2;  // of glare in the eye, by mixture
  };
  RoundState round_state(int round, const std::vector<size_t>& views) const;
  void judge(const CompiledScene& scene, const Totals& totals, const std::vector<size_t>& views);
  void judge_view(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
                  const Faced& faced, size_t light);
  void compare_with_first(const Readout& readout, const CompiledScene& scene,
                          const EyeTarget& target, const Faced& faced, size_t light);

  const JudgedScene& judged_;
  const SceneDescription& scene_ = judged_.scene;
  const std::vector<Observer>& observers_;
  const OtherSmoke smoke_;
  const AssessOptions& options_;
  std::vector<std::vector<SightRow>> rows_;               // by light
  std::vector<std::vector<double>> errors_beyond_first_;  // by light, by row; NaN: not known
  std::vector<Stand> stands_;
  std::vector<Faced> faced_;
  std::vector<std::vector<bool>> open_;  // by light, by faced view
  std::vector<size_t> observing_;        // stands of the round's observers
  int64_t paths_ = 0;
};

}  // namespace luxodus

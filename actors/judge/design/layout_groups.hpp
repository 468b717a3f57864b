// Groups of layouts that are traced together: layouts of one building whose light can be
// added, or a single layout. The views of a group are traced in rounds, and each round gives the
// verdicts for all its layouts. Thread rule: one thread, which has batches traced by others.
#pragma once

#include <memory>
#include <vector>

#include "actors/judge/assess/sights_in_lights.hpp"
#include "actors/judge/design/layout_lights.hpp"

namespace luxodus {

struct JudgedLayout;

namespace limits {
/// Pairs of a view and a layout in one group, over all scenarios. Each takes about 1000 bytes of
/// tallies, half of them for the difference from the first layout, and 500 bytes for its verdict.
inline constexpr size_t layout_group_views = 300'000;
}  // namespace limits

/// One state of the building in the light of each layout of a group.
class LayoutGroupState {
 public:
  /// Errors: as LayoutLights::judged and SightsInLights::look_for_lines.
  static Result<std::unique_ptr<LayoutGroupState>> make(const LayoutLights& lights,
                                                        const SceneDescription& scene,
                                                        const Scenario& scenario,
                                                        const AssessOptions& options,
                                                        const AssessProgress& progress);

  SightsInLights& sights() { return sights_; }
  const SceneDescription& scene() const { return judged_.scene; }

 private:
  LayoutGroupState(JudgedScene judged, const AssessOptions& options)
      : judged_(std::move(judged)), options_(options), sights_(judged_, nobody_, {}, options_) {}

  const std::vector<Observer> nobody_;  // empty: observers of the scene are not on routes
  const JudgedScene judged_;
  const AssessOptions options_;
  SightsInLights sights_;
};

struct LayoutGroup {
  std::vector<size_t> members;                   // indices among all layouts
  std::shared_ptr<const SceneDescription> base;  // the building with the signs of all members
  std::unique_ptr<LayoutLights> lights;          // of the members
};

/// Groups layouts that share paths: those with the same signs, or the same signs made brighter,
/// whose light can be added and does not come from too many luminaires. `scenarios`: number of
/// scenarios in which they are judged. `together`: false gives a group for each layout.
std::vector<LayoutGroup> layout_groups_of(const std::vector<JudgedLayout>& layouts,
                                          size_t scenarios, bool together);

}  // namespace luxodus

// The reality mode: what people on the routes read of the signs with all light and all smoke, from
// paths traced from their eyes. The same paths serve one light or several, such as those of several
// layouts of luminaires. Rounds of paths go on for undecided views. Thread rule: one thread, which
// has batches traced by others.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "actors/judge/assess/sign_chromaticity.hpp"
#include "actors/judge/assess/stands.hpp"
#include "actors/judge/assess/view_light.hpp"

namespace luxodus {

/// A change of all signs at once.
struct SignsChanged {
  double luminance = 1;  // factor on the luminance of their faces
  double size = 1;       // factor on their edges; the centres stay
};

class SightsInLights {
 public:
  /// `observers`: those that the scene names. Requires: all arguments outlive this; if nodes trace,
  /// the scenario is in the scene's file and there is one light.
  SightsInLights(const JudgedScene& judged, const std::vector<Observer>& observers,
                 const OtherSmoke& smoke, const AssessOptions& options);

  /// Finds the possible views by straight lines; they are the same in every light.
  /// Errors: as compile_scene; more pairs of place and sign than limits::sights.
  Result<void> look_for_lines(const AssessProgress& progress);

  /// Traces one round of paths for the views that are undecided in any of the lights `asked`; the
  /// other lights are updated from the same paths. Requires: an open light; rounds ascend from 0.
  /// Errors: as compile_round; as the executor; `interrupt`.
  Result<void> trace(int round, const std::vector<bool>& asked, const std::atomic<bool>& interrupt,
                     const AssessProgress& progress);

  size_t lights() const { return rows_.size(); }
  /// Whether any verdict is undecided in a light.
  bool is_open(size_t light) const;
  /// All views that the building allows, as judged in a light.
  const std::vector<SightRow>& rows(size_t light) const { return rows_[light]; }
  /// Standard error of a view's reading level in another light minus that in the first. It is
  /// smaller than the error of either level, as both come from the same paths. None unless the view
  /// is undecided in both lights, and none if aged light counts in one and new light in the other.
  /// Requires: not the first light.
  std::optional<double> error_beyond_first(size_t light, size_t row) const;
  /// What all eyes, those of the assessment first, would see in a view of the first light if all
  /// signs were changed. Light of signs is linear in their luminance; its part that reaches the eye
  /// by way of surfaces and smoke is taken to grow with their area. The worse of aged and new light
  /// counts. Requires: JudgedScene::signs_apart.
  /// None of a view that no light decides, and of one that was not traced.
  std::vector<Sight> sights_if(size_t row, const SignsChanged& changed) const;
  int64_t paths() const { return paths_; }
  /// Distance of a value from its limit at which a verdict is given, in standard errors.
  double sure_errors() const { return sure_errors_; }

 private:
  /// A view whose verdict depends on traced paths.
  struct Faced {
    size_t row, stand;
    uint32_t sign;
    std::vector<double> veils_cd_m2;  // veiling luminance of glare, by mixture
    std::vector<std::vector<double>> veils_of_other_eyes;
    std::vector<PooledLight> light;  // of all rounds, by mixture; empty before the first
  };
  RoundState round_state(int round, const std::vector<size_t>& views) const;
  /// Adds the light of a round to a view's.
  void pool(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
            double paths, Faced& faced) const;
  void judge(const CompiledScene& scene, const Totals& totals, double paths,
             const std::vector<size_t>& views);
  SignLook look_by(const Faced& faced, const ViewLight& light, double veil_cd_m2) const;
  /// With the veil of some eyes.
  SignLook look_in(const Faced& faced, size_t mixture, double veil_cd_m2) const;
  SignLook look_in(const Faced& faced, size_t mixture) const;
  /// With changed signs, in aged or in new light. `veils`: by mixture.
  SignLook look_if(const Faced& faced, const SignsChanged& changed, bool as_new,
                   const std::vector<double>& veils) const;
  Sight worse_sight(const Sign& sign, const SignView& view, const OtherEyes& eyes,
                    const std::function<SignLook(bool as_new)>& look) const;
  Eye eye_of(double age_years) const;
  SightRules rules_for(double age_years) const;
  void judge_view(const Faced& faced, size_t light);
  void judge_by_other_eyes(const Faced& faced, size_t light);
  static void judge_in_new_light(SightRow& row, const Sign& sign, SignLook look,
                                 const SightRules& rules);
  void compare_with_first(const Faced& faced, size_t light);

  const JudgedScene& judged_;
  const SceneDescription& scene_ = judged_.scene;
  const std::vector<Observer>& observers_;
  const OtherSmoke smoke_;
  const AssessOptions& options_;
  std::vector<std::vector<SightRow>> rows_;               // by light
  std::vector<std::vector<double>> errors_beyond_first_;  // by light and row; NaN: not known
  std::vector<Stand> stands_;
  std::vector<Faced> faced_;                      // rows ascending
  double sure_errors_ = 0;                        // as in SightRules
  std::vector<std::vector<bool>> open_;           // undecided; by light and faced view
  std::vector<size_t> observing_;                 // indices into stands_ of the round's observers
  std::optional<SignChromaticity> chromaticity_;  // of the last round's scene
  int64_t paths_ = 0;
};

}  // namespace luxodus

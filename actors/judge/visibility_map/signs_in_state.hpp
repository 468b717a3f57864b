// Estimates of what people read of signs in one state of a scene: see sign_estimates.hpp, which
// holds one of these for each time. Thread rule: one thread, which has rows and batches traced by
// others.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "actors/judge/assess/arriving_beside.hpp"
#include "actors/judge/visibility_map/face_light.hpp"
#include "actors/judge/visibility_map/glare_bound.hpp"
#include "actors/judge/visibility_map/sight_line.hpp"
#include "actors/judge/visibility_map/sign_answer.hpp"

namespace luxodus {

class SignsInState {
 public:
  /// Traces a state. `signs`: indices into the scene's. `eyes`: where estimates will be asked;
  /// supports are chosen among them. `options`: those of this state alone, see
  /// AssessOptions::one_of. Errors: as judged_scene, irritation_is_said and compile_scene;
  /// `interrupt`.
  static Result<std::unique_ptr<SignsInState>> make(
      const SceneDescription& scene, const Scenario& scenario, const std::vector<uint32_t>& signs,
      std::span<const glm::dvec3> eyes, const AssessOptions& options,
      const std::atomic<bool>& interrupt, const AssessProgress& progress);
  ~SignsInState();
  SignsInState(const SignsInState&) = delete;
  SignsInState& operator=(const SignsInState&) = delete;

  /// Of the eyes that it was made with: element eye * signs + sign.
  const std::vector<SignEstimate>& estimates() const { return estimates_; }
  /// Drops the estimates, and what only they needed. `of` may still be asked.
  void forget_estimates();
  /// Of any eyes, likewise.
  std::vector<SignEstimate> of(std::span<const glm::dvec3> eyes) const;

  double sure_errors() const { return rules_.sure_errors; }
  int64_t paths() const { return traced_.all_paths(); }
  size_t supports() const;
  /// Supports of which nothing is known, since a batch found more light than is counted.
  size_t lost_supports() const;

 private:
  /// What would decide a view: more paths to its supports, or nearer supports.
  struct Needs {
    bool paths = false, supports = false;
  };
  /// A view whose answer depends on light.
  struct View {
    uint32_t eye = 0;
    uint32_t slot = 0;  // of the sign, in `signs`
    uint32_t face = 0;  // in faces_
    SignView geometry;
    double solid = 1;  // share of light that panes before the face let pass
    SightLine line;
    std::vector<double> veils_cd_m2;  // of glare, by mixture; at most, unless they are exact
    bool exact_veils = false;
    std::array<NearSupport, limits::near_supports> near{};
    size_t nears = 0;
    bool open = true;  // undecided
    Needs needs;

    std::span<const NearSupport> near_supports() const { return {near.data(), nears}; }
  };
  /// A view that would be a good support.
  struct Wanted {
    double distance = 0;  // from the nearest support, in units of the spacing there
    size_t view = 0;
  };

  SignsInState(JudgedScene judged, std::vector<uint32_t> signs, const AssessOptions& options);
  Result<void> compile();
  Result<void> trace(std::span<const glm::dvec3> eyes, const std::atomic<bool>& interrupt,
                     const AssessProgress& progress);

  /// What is seen of all signs from an eye without regard to light: estimates of those that are
  /// hidden or partly hidden, and views of the others. `estimates`: one per sign.
  void look(const GeometryAccess& access, uint32_t eye_number, const glm::dvec3& eye,
            std::span<SignEstimate> estimates, std::vector<View>& views) const;
  void find_near(const GeometryAccess& access, const glm::dvec3& eye, View& view) const;
  /// The answer; computes the glare of the view if its bound alone does not decide.
  SignEstimate answer(const GeometryAccess& access, const glm::dvec3& eye, View& view) const;
  static View without_glare(const View& view);
  /// Largest relative error of what its line lets pass.
  static double line_error(const View& view);
  Sight judge(const View& view, const Doubt& doubt = {}) const;
  Sight judge_in(const View& view, size_t mixture, const Doubt& doubt) const;
  /// The look of a view whose glare is known, or lies anywhere below its bound.
  SignLook look_with_glare(const View& view, const ViewLight& light, size_t mixture) const;
  ViewLight light_of(const View& view, size_t mixture, const Uncertain& veil,
                     const Uncertain& beyond) const;
  Needs needs_of(const View& view) const;

  bool is_lost(const Support& support) const;
  /// Both return numbers in traced_.
  std::vector<size_t> add_supports(std::span<const glm::dvec3> eyes, int round);
  std::vector<size_t> noisy_supports() const;
  /// Returns its number in traced_.
  size_t add_support(const View& view, const glm::dvec3& eye);
  Result<void> trace_supports(const std::vector<size_t>& views, int round,
                              const std::atomic<bool>& interrupt, const AssessProgress& progress);
  void test_supports();
  void judge_all(std::span<const glm::dvec3> eyes);

  JudgedScene judged_;
  std::vector<uint32_t> signs_;
  AssessOptions options_;
  std::unique_ptr<Building> building_;
  std::optional<GlareBound> glare_;
  std::vector<FaceOfSign> faces_;
  std::vector<std::array<uint32_t, 2>> face_of_;  // by sign of the scene, front and back
  std::vector<double> shares_;
  GroupFactors factors_;
  SightRules rules_;
  TracedViews traced_;
  std::vector<FaceLight> by_face_;
  std::vector<View> views_;
  std::vector<SignEstimate> estimates_;
};

}  // namespace luxodus

// Estimates of what people read of signs from many places at several times, made from few traced
// ones. What changes quickly from place to place is computed exactly at each: lines, turning of the
// face, transmission, the sign's own light, glare. What changes slowly is traced at a few places,
// the supports, and interpolated between those that see each other. The error of an estimate holds
// noise and interpolation, and an answer is given only if it holds at the worse end of that error.
// Thread rule: one thread, which has rows and batches traced by others; a made object may be asked
// from one thread at a time.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/visibility_map/sign_answer.hpp"

namespace luxodus {

namespace limits {
/// Places of which estimates are asked at one time, and pairs of a place and a sign.
inline constexpr size_t estimated_eyes = 1'000'000, estimated_pairs = 8'000'000;
}  // namespace limits

/// An eye at a time.
struct TimedEye {
  double time_s = 0;
  glm::dvec3 eye{0};
};

struct EstimateRequest {
  /// The states of the scene, one for each time; if there are no times, the last one alone.
  StatesToAssess states;
  /// The scenario, seed, threads, executor, largest number of rounds, wrong verdicts, and whether
  /// the places of signs are known.
  AssessOptions options;
  /// Names of the signs; empty: all signs of the scene.
  std::vector<std::string> signs;
  /// Where estimates will be asked. Supports are chosen among these eyes; an eye that sees no
  /// support gets answers only where bounds decide.
  std::vector<glm::dvec3> eyes;
};

class SignsInState;

/// The indices of signs by name; all if no name is given. Errors: an unknown name; no sign at all.
Result<std::vector<uint32_t>> signs_named(const SceneDescription& scene,
                                          const std::vector<std::string>& names);

/// Makes one state after another and hands it over with its number. Errors: as
/// SignEstimates::make.
using TakeState = std::function<void(size_t number, std::unique_ptr<SignsInState> state)>;
Result<void> for_each_state(const EstimateRequest& request, const std::atomic<bool>& interrupt,
                            const AssessProgress& progress, const TakeState& take);

class SignEstimates {
 public:
  /// Traces all states. Errors: as judged_scenario, irritation_is_said and compile_scene; an
  /// unknown sign; more eyes or pairs than the limits; `interrupt`.
  static Result<std::unique_ptr<SignEstimates>> make(const EstimateRequest& request,
                                                     const std::atomic<bool>& interrupt,
                                                     const AssessProgress& progress);
  ~SignEstimates();

  /// Names, in the order of all results.
  const std::vector<std::string>& signs() const { return signs_; }
  /// Ascending; empty if the scene does not change in time.
  const std::vector<double>& times_s() const { return times_s_; }
  /// Distance of a value from its limit at which an answer is given, in standard errors.
  double sure_errors() const { return sure_errors_; }

  /// Estimates of all signs from these eyes: element eye * signs().size() + sign. Between two times
  /// the worse of both counts; before the first and after the last time all signs are undecided.
  std::vector<SignEstimate> at(std::span<const TimedEye> eyes) const;
  SignEstimate at(double time_s, const glm::dvec3& eye, size_t sign) const;

 private:
  SignEstimates();

  std::vector<std::string> signs_;
  std::vector<double> times_s_;
  std::vector<std::unique_ptr<SignsInState>> states_;  // one per time, or the only one
  double sure_errors_ = 0;
};

}  // namespace luxodus

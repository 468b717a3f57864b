// What the tests of light share: scenes, runs and reference tables of actors/judge/validate, and
// the one comparison that counts: an estimate lies within its standard errors of a reference, and
// those are small. Scenes are grey and radiometric (one band, watts), so results are plain fluxes,
// and the same bits for any number of threads.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "actors/judge/validate/traced.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/test_length.hpp"

namespace luxodus::light {

// ---- scenes ------------------------------------------------------------------------------------

/// Reads a scene from the text of a scene file. Requires: no mistake in it.
SceneDescription scene_from_toml(const std::string& text);

// ---- runs --------------------------------------------------------------------------------------

/// Runs have fewer particles by this factor, and errors may be larger by its root and a quarter,
/// since few batches know their own error less well. Sanitizers are after memory and arithmetic,
/// and a program under them is some ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline const int64_t thrift = 64;
#else
inline const int64_t thrift = test::in_full() ? 1 : 8;
#endif
inline const double root_of_thrift =
    thrift == 1 ? 1 : 1.25 * std::sqrt(static_cast<double>(thrift));

struct RunOptions {
  int64_t particles = 1 << 20;  // divided by `thrift`
  uint64_t seed = 1;
  int threads = 2;
  int cells = 1;
  int64_t batch_particles = 4096;
};

/// A scene compiled and traced. Checks that the balance closes and that no history was lost.
class Run : public Traced {
 public:
  explicit Run(SceneDescription scene, const RunOptions& options = {},
               const std::vector<BinSum>& sums = {}, const std::vector<WeightedSum>& weighted = {});
};

// ---- comparisons -------------------------------------------------------------------------------

inline constexpr double four_standard_errors = 4;
/// The relative standard error at which a comparison means something: four of them are 2 %.
inline const double half_percent = 5e-3 * root_of_thrift;

/// How many particles make the relative standard error of a share of them half a percent, before
/// they are divided by `thrift`.
int64_t particles_for(double share);

/// The estimate is within `standard_errors` of the reference, plus what is known to be biased
/// (`slack`, in the reference's unit), and its standard error is at most `max_error` (in the
/// reference's unit).
void check_near(const Estimate& estimate, double reference, double max_error, double slack = 0,
                double standard_errors = four_standard_errors);
/// The same with the standard error bounded relative to the reference.
void check_within(const Estimate& estimate, double reference, double max_relative_error,
                  double relative_slack = 0, double standard_errors = four_standard_errors);
/// A mean of something of which each of `particles` brings `most` or less. Its standard error is at
/// most half a percent or, for what is too rare to be counted that well, what chance allows: the
/// variance of one particle is at most most * mean.
void check_share(const Estimate& estimate, double reference, int64_t particles, double most = 1,
                 double slack = 0);
/// How well cases are run: every quantity of at least that share of what all particles could bring
/// is wanted to half a percent, within these numbers of particles.
struct CaseOptions {
  double min_share = 0.005;
  int64_t min_particles = 1 << 18;
  int64_t max_particles = 1 << 24;
  double most = 1;  // that a particle brings to a quantity, in its unit
};
/// Runs a case of `luxodus validate` and compares all its quantities, as check_share does.
void check_case(const Case& one, const CaseOptions& options = {});
/// All whose names begin so. Checks that there are as many.
void check_cases(const std::string& name, size_t count, const CaseOptions& options = {});

/// Two independent estimates of one thing.
void check_agree(const Estimate& a, const Estimate& b, double max_relative_error,
                 double standard_errors = four_standard_errors);

}  // namespace luxodus::light

// Shared by the tests of light: scenes, runs, the reference tables of actors/judge/validate, and
// the comparison used throughout: an estimate lies within its standard errors of a reference, and
// these are small. Scenes are grey and radiometric (one band, watts), so results are plain fluxes,
// with equal bits for any number of threads. Test helpers; one thread.
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

/// Reads a scene from the text of a scene file. Requires: the text has no mistake.
SceneDescription scene_from_toml(const std::string& text);

/// Adds a grid of probes of so many a side on each plane, facing as it does. Returns the probes of
/// each plane as a sum.
std::vector<BinSum> add_probes_on_planes(SceneDescription& scene, uint32_t per_side);

// ---- runs --------------------------------------------------------------------------------------

/// Factor by which runs have fewer particles; errors may be larger by its root and a quarter, since
/// few batches estimate their own error less well. Sanitizers look for errors of memory and
/// arithmetic, and programs run some ten times slower under them.
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

/// A scene compiled and traced. Checks that the balance closes and that no history is lost.
class Run : public Traced {
 public:
  explicit Run(SceneDescription scene, const RunOptions& options = {},
               const std::vector<BinSum>& sums = {}, const std::vector<WeightedSum>& weighted = {});
};

// ---- comparisons -------------------------------------------------------------------------------

inline constexpr double four_standard_errors = 4;
/// The largest relative standard error of a meaningful comparison: four of them are 2 %.
inline const double half_percent = 5e-3 * root_of_thrift;

/// Particles for which the relative standard error of a share of them is half a percent, before
/// division by `thrift`.
int64_t particles_for(double share);

/// Checks that the estimate is within `standard_errors` of the reference, plus a known bias
/// (`slack`, in the reference's unit), and that its standard error is at most `max_error` (in that
/// unit).
void check_near(const Estimate& estimate, double reference, double max_error, double slack = 0,
                double standard_errors = four_standard_errors);
/// Variant with the standard error bounded relative to the reference.
void check_within(const Estimate& estimate, double reference, double max_relative_error,
                  double relative_slack = 0, double standard_errors = four_standard_errors);
/// For a mean to which each of `particles` contributes at most `most`. Its standard error must be
/// at most half a percent or, for rare contributions, that of counting them: the variance of one
/// particle is at most most * mean.
void check_share(const Estimate& estimate, double reference, int64_t particles, double most = 1,
                 double slack = 0);
/// Accuracy of a case: every quantity of at least this share of the possible maximum is estimated
/// to half a percent, within these limits of particles.
struct CaseOptions {
  double min_share = 0.005;
  int64_t min_particles = 1 << 18;
  int64_t max_particles = 1 << 24;
  double most = 1;  // largest contribution of a particle to a quantity, in its unit
};
/// Runs a case of `luxodus validate` and compares all its quantities by check_share.
void check_case(const Case& one, const CaseOptions& options = {});
/// Checks all cases whose names begin like this, and their number.
void check_cases(const std::string& name, size_t count, const CaseOptions& options = {});

/// Compares two independent estimates of one quantity.
void check_agree(const Estimate& a, const Estimate& b, double max_relative_error,
                 double standard_errors = four_standard_errors);

}  // namespace luxodus::light

// How far a value must be from its limit before a verdict is given, so that noise makes few
// verdicts of a whole report wrong. Pure functions; any thread. Design:
// docs/decisions/0087-no-verdict-by-noise.md.
#pragma once

#include <cstddef>

namespace luxodus {

namespace limits {
/// Expected number of verdicts of a report that noise makes wrong, at most.
inline constexpr double wrong_verdicts = 0.01;
}  // namespace limits

/// Values that are compared with their limits, each as often as there are looks.
struct Comparisons {
  size_t views = 1;  // of signs, in all states of the report
  /// Of each view: legend minus ground, face minus surround; in each light, for each kind of eyes.
  size_t values = 2;
  int looks = 1;  // rounds of paths, after each of which a verdict may be given
};

/// Distance from a limit in standard errors that few values exceed by chance: with it, at most
/// `wrong` of the comparisons are expected to go wrong. The standard error of each is known from
/// `batches` batches, so it is the quantile of Student's t. Requires: wrong > 0, batches > 1.
double sure_errors(double wrong, const Comparisons& comparisons, double batches);

}  // namespace luxodus

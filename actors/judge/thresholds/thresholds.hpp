// Finds the smoke, the place, the luminance, the size or the mounting height at which each sign of
// an assessment is just read and just seen (`luxodus assess --find`). One thread, which has batches
// traced by others.
#pragma once

#include "actors/judge/thresholds/looks.hpp"

namespace luxodus {

/// Thresholds of all views of the assessment; of distances, of all signs and routes.
/// Errors: extinction is sought where there is no smoke; the assessment has no views; as
/// assess_sights; `interrupt`.
Result<ThresholdRows> find_thresholds(const ThresholdSearch& search,
                                      const std::vector<Sought>& sought);

// Each quantity by itself, with the errors of find_thresholds.

/// Factors on all smoke. Views are traced in smoke whose density rises by a quarter from step to
/// step, at the steps next to each threshold, with the same random numbers.
Result<ThresholdRows> find_extinctions(const ThresholdSearch& search);
/// Factors on the luminance and the edges of all signs at once, as `sought`, from one tracing.
Result<ThresholdRows> find_faces(const ThresholdSearch& search, const std::vector<Sought>& sought);
/// Distances along the routes, between the places of the assessment. Nothing is traced.
ThresholdRows find_distances(const ThresholdSearch& search);
/// Heights of the faces' centres above the floor. All signs are moved together, each between its
/// floor and its ceiling. Nodes take no part.
Result<ThresholdRows> find_heights(const ThresholdSearch& search);

}  // namespace luxodus

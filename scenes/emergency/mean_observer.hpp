// How a view stands to the mean observer of measured experiments with people, and whether any
// experiment is near it at all. The numbers are those of docs/validation/experiments.md, which
// `luxodus validate --experiments` computes. They decide no verdict. Pure functions; any thread.
#pragma once

#include <array>
#include <string_view>

namespace luxodus {

/// What is known of a view that experiments could be compared with.
struct ObservedView {
  double age_years = 0;
  double distance_m = 0;
  double extinction = 0;  // mean of the line [1/m]
  double albedo = 1;      // of the smoke, the least of several; 1 in clear air
  bool irritant = false;
  bool place_unknown = false;
  double reading_level = 0, seeing_level = 0;  // as in Sight; seeing: over its limit
};

/// Why no experiment is known: the first that holds.
enum class Untested { nothing, age, place, smoke, extinction, distance };
inline constexpr std::array<std::string_view, 6> untested_words{"",      "age",        "place",
                                                                "smoke", "extinction", "distance"};
const char* name_of(Untested reason);

/// Whether the mean observer of the experiments would have read, or seen, the sign. `between`: some
/// experiments say yes, others no.
enum class MeanObserver { not_known, yes, between, no };
inline constexpr std::array<std::string_view, 4> mean_observer_words{"not known", "yes", "between",
                                                                     "no"};
const char* name_of(MeanObserver standing);

/// One of reading and seeing.
struct Standing {
  MeanObserver observer = MeanObserver::not_known;
  Untested untested = Untested::nothing;  // the reason, where it is not known
};

/// Reading: one observer, T8. Extinctions of 0.5 to 1.5 /m, 5.5 to 15.5 m, white smoke.
Standing standing_in_reading(const ObservedView& view);
/// Seeing: T1, T6 and T16. Extinctions of 0.8 to 1.8 /m, 5.5 to 13 m, albedos from 0.6 on.
Standing standing_in_seeing(const ObservedView& view);

}  // namespace luxodus

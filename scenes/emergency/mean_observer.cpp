#include "scenes/emergency/mean_observer.hpp"

namespace luxodus {

namespace {

struct Range {
  double low, high;
  bool contains(double value) const { return value >= low && value <= high; }
};

/// What was tested, and the visibility levels at which people just read or saw: at the least of any
/// experiment, and at the most.
struct Tested {
  double least_albedo;
  Range extinction, distance_m, level;
};

/// Observers were young adults; none of the sources has older ones.
constexpr double oldest_observer = 37;
/// People read from level 7 times the factors of luminance 0.16 to 0.73, and saw from 0.8 to 1.7.
constexpr Tested reading{0.95, {0.5, 1.5}, {5.5, 15.5}, {1.1, 5.1}};
constexpr Tested seeing{0.6, {0.8, 1.8}, {5.5, 13}, {0.8, 1.7}};

Untested first_untested(const ObservedView& view, const Tested& tested) {
  if (view.age_years > oldest_observer) return Untested::age;
  if (view.place_unknown) return Untested::place;
  if (view.irritant || view.albedo < tested.least_albedo) return Untested::smoke;
  if (!tested.extinction.contains(view.extinction)) return Untested::extinction;
  if (!tested.distance_m.contains(view.distance_m)) return Untested::distance;
  return Untested::nothing;
}

Standing standing(const ObservedView& view, const Tested& tested, double level) {
  const Untested reason = first_untested(view, tested);
  if (reason != Untested::nothing) return {MeanObserver::not_known, reason};
  if (level >= tested.level.high) return {MeanObserver::yes, reason};
  return {level < tested.level.low ? MeanObserver::no : MeanObserver::between, reason};
}

}  // namespace

const char* name_of(Untested reason) {
  return untested_words[static_cast<size_t>(reason)].data();
}

const char* name_of(MeanObserver standing) {
  return mean_observer_words[static_cast<size_t>(standing)].data();
}

Standing standing_in_reading(const ObservedView& view) {
  return standing(view, reading, view.reading_level);
}

Standing standing_in_seeing(const ObservedView& view) {
  return standing(view, seeing, view.seeing_level);
}

}  // namespace luxodus

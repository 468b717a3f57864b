// Views held against the mean observer of experiments with people.
#include "scenes/emergency/mean_observer.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

/// Within what was tested, for reading and for seeing.
const ObservedView tested{
    .age_years = 23, .distance_m = 8, .extinction = 1, .reading_level = 9, .seeing_level = 30};

ObservedView with(auto member, auto value) {
  ObservedView out = tested;
  out.*member = value;
  return out;
}

}  // namespace

TEST_CASE("within what was tested a view stands on a side of the mean observer, or between") {
  CHECK(standing_in_reading(tested).observer == MeanObserver::yes);
  CHECK(standing_in_reading(with(&ObservedView::reading_level, 2.0)).observer ==
        MeanObserver::between);
  CHECK(standing_in_reading(with(&ObservedView::reading_level, 1.0)).observer == MeanObserver::no);
  CHECK(standing_in_seeing(tested).observer == MeanObserver::yes);
  CHECK(standing_in_seeing(with(&ObservedView::seeing_level, 1.0)).observer ==
        MeanObserver::between);
  CHECK(standing_in_seeing(with(&ObservedView::seeing_level, 0.7)).observer == MeanObserver::no);
}

TEST_CASE("outside of what was tested no experiment is known, and the reason is named") {
  const auto reason = [](const ObservedView& view) {
    const Standing standing = standing_in_reading(view);
    CHECK(standing.observer == MeanObserver::not_known);
    return standing.untested;
  };
  CHECK(reason(with(&ObservedView::age_years, 65.0)) == Untested::age);
  CHECK(reason(with(&ObservedView::place_unknown, true)) == Untested::place);
  CHECK(reason(with(&ObservedView::irritant, true)) == Untested::smoke);
  CHECK(reason(with(&ObservedView::albedo, 0.6)) == Untested::smoke);
  CHECK(reason(with(&ObservedView::extinction, 0.0)) == Untested::extinction);
  CHECK(reason(with(&ObservedView::distance_m, 3.0)) == Untested::distance);
  // Darker smoke was tested for seeing.
  CHECK(standing_in_seeing(with(&ObservedView::albedo, 0.6)).untested == Untested::nothing);
  CHECK(standing_in_seeing(with(&ObservedView::albedo, 0.5)).untested == Untested::smoke);
}

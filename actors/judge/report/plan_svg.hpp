// Plans as SVG from the record of an assessment, one for each level: installation, lines of equal
// illuminance, and what people read. Lines and letters have sizes in millimetres on paper, so all
// plans of a report look alike. Verdicts differ by shape as well as by colour. Immutable once made;
// any thread.
#pragma once

#include <array>
#include <string>

#include "actors/judge/report/schedule.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

struct PlanSize {
  double width_mm = 267;  // largest width of the drawing on paper
  double height_mm = 150;
};

/// Verdicts on a view, from best to worst.
inline constexpr std::array<SightVerdict, 6> sight_ranks{
    SightVerdict::legible,   SightVerdict::undecided,    SightVerdict::visible,
    SightVerdict::invisible, SightVerdict::not_assessed, SightVerdict::hidden};
size_t rank_of(SightVerdict verdict);

/// A drawing with its size and scale.
struct Plan {
  std::string svg;
  double width_mm = 0;  // of the drawing on paper
  double scale = 0;     // metres of the building per metre of paper
};

class Plans {
 public:
  /// Keeps references to all arguments except `size`.
  Plans(const AssessmentRecord& assessment, const Schedule& schedule, const Texts& texts,
        PlanSize size)
      : a_(assessment), schedule_(schedule), texts_(texts), size_(size) {}

  Plan installation(size_t level) const;
  /// `values`: with numbers at points of calculation.
  Plan isolux(size_t level, bool values) const;
  /// The verdict of the best sign at each place, or of one sign, for an eye height above the floor
  /// [m].
  Plan sights(size_t level, double eye_height_m, const std::string& sign) const;

 private:
  const AssessmentRecord& a_;
  const Schedule& schedule_;
  const Texts& texts_;
  PlanSize size_;
};

/// Symbol of the verdict on a check or view, as an SVG element around (x, y).
std::string verdict_shape(const std::string& verdict, double x, double y, double radius);
/// The colour of that symbol.
const char* verdict_colour(const std::string& verdict);

}  // namespace luxodus

// Plans as SVG, one level of a building each, from the JSON of an assessment: what is installed,
// lines of equal illuminance, and what people read. Lines and letters are sized in millimetres on
// paper, so that all plans of one report look alike. Shapes tell verdicts, colour beside them.
// Pure; any thread.
#pragma once

#include <string>

#include "actors/judge/report/schedule.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

struct PlanSize {
  double width_mm = 267;  // of the drawing on paper, at most
  double height_mm = 150;
};

/// A drawing and what it says of itself.
struct Plan {
  std::string svg;
  double width_mm = 0;  // of the drawing on paper
  double scale = 0;     // metres of the building per metre of paper
};

class Plans {
 public:
  /// Keeps references.
  Plans(const Json& assessment, const Schedule& schedule, const Texts& texts, PlanSize size)
      : a_(assessment), schedule_(schedule), texts_(texts), size_(size) {}

  Plan installation(size_t level) const;
  /// `values`: with numbers at points of calculation.
  Plan isolux(size_t level, bool values) const;
  /// The best of all signs, or of one, for eyes at a height above the floor [m].
  Plan sights(size_t level, double eye_height_m, const std::string& sign) const;

 private:
  const Json& a_;
  const Schedule& schedule_;
  const Texts& texts_;
  PlanSize size_;
};

/// The symbol of a verdict of a check or a sight, as an SVG element about (x, y) with a radius.
std::string verdict_shape(const std::string& verdict, double x, double y, double radius);
/// The colour that stands beside the shape.
const char* verdict_colour(const std::string& verdict);

}  // namespace luxodus

// Parts that several drawings of a report share: labels that keep clear of each other, walls,
// symbols of luminaires, scale and north. Sizes are in millimetres on paper. Pure functions; any
// thread; a LabelSpace is for one.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/report/svg_sheet.hpp"

namespace luxodus {

inline constexpr const char* emergency_colour = "#0b6e3c";
inline constexpr const char* wall_style =
    "stroke=\"#222\" stroke-width=\"0.35\" stroke-linecap=\"round\"";
inline constexpr const char* furniture_style = "stroke=\"#b9b9b9\" stroke-width=\"0.15\"";
inline constexpr const char* route_style =
    "fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"0.5\" stroke-dasharray=\"2.4 1.2\"";

/// Boxes that are already drawn, so that labels do not overlap them or each other.
class LabelSpace {
 public:
  void reserve(double x, double y, double width, double height);
  /// Reserves a box around (x, y) [mm] if it is free, and returns whether it was.
  bool take(double x, double y, double width, double height);

 private:
  struct Box {
    double left, top, right, bottom;
  };
  static Box box_of(double x, double y, double width, double height);
  std::vector<Box> boxes_;
};

std::string lines_path(const std::vector<DrawnLine>& lines, const Sheet& sheet, const char* style);
/// Walls of a level, and its furniture.
std::string building(const PlanLevel& level, const Sheet& sheet);
std::string walls(const PlanLevel& level, const Sheet& sheet);

std::string luminaire_symbol(double x, double y, bool emergency);

/// Scale bar in round metres, scale, and north arrow.
std::string foot(const AssessmentRecord& assessment, const Sheet& sheet, const Texts& texts);

/// A box that holds the walls of a level and more places.
class DrawnBox {
 public:
  explicit DrawnBox(const PlanLevel& level);
  void take(const glm::dvec2& place);
  Sheet sheet(const PlanSize& size, const Legend& legend) const;

 private:
  glm::dvec2 low_{1e300}, high_{-1e300};
};

/// A filled square for a legend, 3 mm wide.
std::string legend_square(const char* colour);

/// A drawing on its sheet, with its legend below.
Plan finished(const Sheet& sheet, const Legend& legend, const std::string& body);

std::string legend_line(double width, const std::string& style);
/// A line of equal illuminance.
std::string isolux_style(double lux);
std::string isolux_colour(double lux);

template <class Point>
std::string path_of(const std::vector<Point>& points, const Sheet& sheet, bool closed) {
  std::vector<glm::dvec2> on_paper;
  for (const Point& p : points) on_paper.emplace_back(sheet.x(p.x), sheet.y(p.y));
  return path_of(on_paper, closed);
}

/// Keeps labels off a line.
void reserve_line(const std::vector<glm::dvec3>& path, const Sheet& sheet, LabelSpace& space);

/// An arrow head at the end of a route.
std::string route_end(double x, double y, double turn_deg);

}  // namespace luxodus

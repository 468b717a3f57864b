// The sheet of a plan: conversion from metres to millimetres of paper, text widths, and the legend
// below the drawing. Immutable once made, except for adding entries to a legend; any thread, one at
// a time for a legend.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

/// Numbers of signs on outer walls stand 5 mm outside (plan_svg.cpp); the border keeps them uncut.
inline constexpr double border_mm = 5.2, text_mm = 2.5;

std::string text_at(double x, double y, const std::string& text, const char* more = "",
                    double size = text_mm);
/// Approximate width of a text on paper: letters of these fonts are about half as wide as high.
double text_width_mm(const std::string& text, double size_mm);

/// The data of an SVG path through points on paper [mm].
std::string path_of(const std::vector<glm::dvec2>& points_mm, bool closed);

/// A symbol and its meaning. The symbol is drawn around (0, 0), the middle of its left edge.
struct LegendEntry {
  std::string symbol;
  double width_mm = 0;
  std::string text;
};

/// Entries in rows; the narrower the sheet, the more rows, so no entry is lost in any language.
class Legend {
 public:
  void add(std::string symbol, double width_mm, std::string text) {
    entries_.push_back({std::move(symbol), width_mm, std::move(text)});
  }
  /// Height below a drawing, including the scale bar above the legend.
  double foot_mm(double width_mm) const;
  /// `top_mm`: upper edge of the foot.
  std::string svg(double width_mm, double top_mm) const;

 private:
  std::vector<std::vector<const LegendEntry*>> rows(double width_mm) const;
  std::vector<LegendEntry> entries_;
};

/// Converts metres of a level to millimetres of paper, +y up, in a round scale that leaves room for
/// a legend.
class Sheet {
 public:
  Sheet(const AssessmentRecord& assessment, const Schedule& schedule, size_t level,
        const PlanSize& size, const Legend& legend);
  /// Of a part of a level.
  Sheet(const glm::dvec2& low, const glm::dvec2& high, const PlanSize& size, const Legend& legend);
  double x(double metres) const { return left_ + (metres - low_.x) * unit_; }
  double y(double metres) const { return border_mm + (high_.y - metres) * unit_; }
  /// The place at a point of the paper [m].
  glm::dvec2 place(double x, double y) const {
    return {low_.x + (x - left_) / unit_, high_.y - (y - border_mm) / unit_};
  }
  double mm(double metres) const { return metres * unit_; }
  double width() const { return width_; }
  /// Heights of the drawing and of the foot below it.
  double height() const { return height_; }
  double foot() const { return foot_; }
  double scale() const { return 1000 / unit_; }

 private:
  void take(const glm::dvec2& place);
  void take_level(const AssessmentRecord& assessment, const Schedule& schedule, size_t level);
  void fit(const PlanSize& size);
  void fit(const PlanSize& size, const Legend& legend);

  glm::dvec2 low_{1e300}, high_{-1e300};
  double unit_ = 1, width_ = 0, height_ = 0, left_ = 0, foot_ = 0;
};

}  // namespace luxodus

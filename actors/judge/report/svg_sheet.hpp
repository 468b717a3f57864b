// The paper under a plan: millimetres of paper for metres of a level, letters, and the legend that
// explains a plan's symbols below it. Requires everywhere: a JSON that check_assessment
// (actors/judge/assess) has passed. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

/// Numbers of signs on outer walls stand 5 mm beyond them (plan_svg.cpp), and are not cut.
inline constexpr double border_mm = 5.2, text_mm = 2.5;

std::string text_at(double x, double y, const std::string& text, const char* more = "",
                    double size = text_mm);
/// About how wide a text is on paper: these fonts have letters of about half their height.
double text_width_mm(const std::string& text, double size_mm);

/// A symbol and what it means. The symbol is drawn about (0, 0), the middle of its left edge.
struct LegendEntry {
  std::string symbol;
  double width_mm = 0;
  std::string text;
};

/// Entries in rows, in as many as a sheet is narrow, so that no language loses one.
class Legend {
 public:
  void add(std::string symbol, double width_mm, std::string text) {
    entries_.push_back({std::move(symbol), width_mm, std::move(text)});
  }
  /// What it needs below a drawing, the scale bar above it included.
  double foot_mm(double width_mm) const;
  /// `top`: where the foot begins.
  std::string svg(double width_mm, double top_mm) const;

 private:
  std::vector<std::vector<const LegendEntry*>> rows(double width_mm) const;
  std::vector<LegendEntry> entries_;
};

/// Metres of a level to millimetres of paper, +y up, in a round scale, with room for a legend.
class Sheet {
 public:
  Sheet(const Json& assessment, const Schedule& schedule, size_t level, const PlanSize& size,
        const Legend& legend);
  double x(double metres) const { return left_ + (metres - low_[0]) * unit_; }
  double y(double metres) const { return border_mm + (high_[1] - metres) * unit_; }
  double mm(double metres) const { return metres * unit_; }
  double width() const { return width_; }
  /// Of the drawing, and of the foot below it.
  double height() const { return height_; }
  double foot() const { return foot_; }
  double scale() const { return 1000 / unit_; }

 private:
  void take(double x, double y);
  void take_level(const Json& assessment, const Schedule& schedule, size_t level);
  void fit(const PlanSize& size);

  double low_[2] = {1e300, 1e300}, high_[2] = {-1e300, -1e300};
  double unit_ = 1, width_ = 0, height_ = 0, left_ = 0, foot_ = 0;
};

}  // namespace luxodus

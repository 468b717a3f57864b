#include "actors/judge/report/svg_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Heights of the foot of a sheet [mm]: scale bar, a legend row, margin below.
constexpr double scale_bar_mm = 11.8, row_mm = 3.8, below_mm = 1.2;
/// Gap between entries of a row.
constexpr double gap_mm = 4;

double entry_width(const LegendEntry& entry) {
  return entry.width_mm + 1.4 + text_width_mm(entry.text, text_mm);
}

/// The next of 1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 7.5 times a power of ten.
double round_scale(double scale) {
  const double ten = std::pow(10, std::floor(std::log10(scale)));
  for (const double step : {1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.5})
    if (step * ten >= scale * (1 - 1e-9)) return step * ten;
  return 10 * ten;
}

}  // namespace

std::string path_of(const std::vector<glm::dvec2>& points_mm, bool closed) {
  std::string out;
  for (const glm::dvec2& p : points_mm)
    out += fmt::format("{}{:.2f} {:.2f}", out.empty() ? "M" : "L", p.x, p.y);
  return out + (closed ? "Z" : "");
}

std::string text_at(double x, double y, const std::string& text, const char* more, double size) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" {}>{}</text>\n", x, y,
                     size, more, xml_escape(text));
}

double text_width_mm(const std::string& text, double size_mm) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // not a continuation byte of UTF-8
  });
  return 0.58 * size_mm * static_cast<double>(letters);
}

std::vector<std::vector<const LegendEntry*>> Legend::rows(double width_mm) const {
  std::vector<std::vector<const LegendEntry*>> out;
  double x = 0;
  for (const LegendEntry& entry : entries_) {
    const double width = entry_width(entry);
    if (out.empty() || x + width > width_mm - 2 * border_mm) {
      out.emplace_back();
      x = 0;
    }
    out.back().push_back(&entry);
    x += width + gap_mm;
  }
  return out;
}

double Legend::foot_mm(double width_mm) const {
  return scale_bar_mm + row_mm * static_cast<double>(rows(width_mm).size()) + below_mm;
}

std::string Legend::svg(double width_mm, double top_mm) const {
  std::string out = "<g class=\"legend\">\n";
  double y = top_mm + scale_bar_mm + row_mm / 2;
  for (const auto& row : rows(width_mm)) {
    double x = border_mm;
    for (const LegendEntry* entry : row) {
      out +=
          fmt::format("<g transform=\"translate({:.2f} {:.2f})\">{}</g>\n", x, y, entry->symbol) +
          text_at(x + entry->width_mm + 1.4, y + 0.36 * text_mm, entry->text);
      x += entry_width(*entry) + gap_mm;
    }
    y += row_mm;
  }
  return out + "</g>\n";
}

Sheet::Sheet(const AssessmentRecord& assessment, const Schedule& schedule, size_t level,
             const PlanSize& size, const Legend& legend) {
  take_level(assessment, schedule, level);
  if (low_.x > high_.x) low_ = glm::dvec2(0), high_ = glm::dvec2(1);
  fit(size, legend);
}

Sheet::Sheet(const glm::dvec2& low, const glm::dvec2& high, const PlanSize& size,
             const Legend& legend)
    : low_(low), high_(high) {
  fit(size, legend);
}

void Sheet::fit(const PlanSize& size, const Legend& legend) {
  // A larger legend makes the drawing smaller, and a narrower drawing may need more legend rows.
  foot_ = legend.foot_mm(size.width_mm);
  for (int tries = 0; tries < 8; ++tries) {
    fit(size);
    const double needed = legend.foot_mm(width_);
    if (needed <= foot_) break;
    foot_ = needed;
  }
}

void Sheet::take_level(const AssessmentRecord& a, const Schedule& schedule, size_t number) {
  const PlanLevel& level = a.plan.levels[number];
  for (const auto* lines : {&level.walls, &level.furniture})
    for (const auto& [from, to] : *lines) {
      take(from);
      take(to);
    }
  for (const PlanPoint& p : level.points) take(p.place);
  const auto take_things = [&](const auto& things) {
    for (const auto& thing : things)
      if (schedule.level_of(thing) == number) take(thing.position);
  };
  take_things(a.luminaires);
  take_things(a.signs);
}

void Sheet::fit(const PlanSize& size) {
  const double across = std::max(high_.x - low_.x, 0.5), up = std::max(high_.y - low_.y, 0.5);
  unit_ = std::min((size.width_mm - 2 * border_mm) / across,
                   std::max(size.height_mm - foot_ - 2 * border_mm, 20.0) / up);
  unit_ = 1000 / round_scale(1000 / unit_);
  width_ = std::max(across * unit_ + 2 * border_mm, std::min(120.0, size.width_mm));
  left_ = (width_ - across * unit_) / 2;
  height_ = up * unit_ + 2 * border_mm;
}

void Sheet::take(const glm::dvec2& place) {
  low_ = glm::min(low_, place);
  high_ = glm::max(high_, place);
}

}  // namespace luxodus

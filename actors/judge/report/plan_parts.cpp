#include "actors/judge/report/plan_parts.hpp"

#include <algorithm>

#include "actors/results/formats/light_colours.hpp"

namespace luxodus {

LabelSpace::Box LabelSpace::box_of(double x, double y, double width, double height) {
  return {x - width / 2, y - height / 2, x + width / 2, y + height / 2};
}

void LabelSpace::reserve(double x, double y, double width, double height) {
  boxes_.push_back(box_of(x, y, width, height));
}

bool LabelSpace::take(double x, double y, double width, double height) {
  const Box box = box_of(x, y, width, height);
  const bool is_free = std::none_of(boxes_.begin(), boxes_.end(), [&](const Box& other) {
    return box.left < other.right && other.left < box.right && box.top < other.bottom &&
           other.top < box.bottom;
  });
  if (is_free) boxes_.push_back(box);
  return is_free;
}

std::string lines_path(const std::vector<DrawnLine>& lines, const Sheet& sheet, const char* style) {
  std::string path;
  for (const auto& [from, to] : lines)
    path += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", sheet.x(from.x), sheet.y(from.y),
                        sheet.x(to.x), sheet.y(to.y));
  return path.empty() ? "" : "<path d=\"" + path + "\" fill=\"none\" " + style + "/>\n";
}

std::string walls(const PlanLevel& level, const Sheet& sheet) {
  return "<g class=\"walls\">" + lines_path(level.walls, sheet, wall_style) + "</g>\n";
}

std::string building(const PlanLevel& level, const Sheet& sheet) {
  return "<g class=\"furniture\">" + lines_path(level.furniture, sheet, furniture_style) +
         "</g>\n" + walls(level, sheet);
}

std::string route_end(double x, double y, double turn_deg) {
  return fmt::format(
      "<path d=\"M0 0L-2.6 -1.1V1.1Z\" fill=\"#1f5fa8\" transform=\"translate({:.2f} {:.2f}) "
      "rotate({:.1f})\"/>\n",
      x, y, turn_deg);
}

std::string luminaire_symbol(double x, double y, bool emergency) {
  const double edge = emergency ? 2.2 : 1.8;
  return fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" "
      "stroke-width=\"0.25\"/>",
      x - edge / 2, y - edge / 2, edge, edge, emergency ? emergency_colour : "#fff",
      emergency ? emergency_colour : "#777");
}

std::string foot(const AssessmentRecord& a, const Sheet& sheet, const Texts& texts) {
  const double y = sheet.height() + 5;
  double bar = 1;
  for (const double metres : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1000.0})
    if (sheet.mm(metres) <= 50) bar = metres;
  std::string out = "<g class=\"scale\">\n";
  for (int i = 0; i < 4; ++i)
    out += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.3f}\" height=\"1.4\" fill=\"{}\" "
        "stroke=\"#000\" stroke-width=\"0.2\"/>\n",
        border_mm + sheet.mm(bar) * i / 4, y, sheet.mm(bar) / 4, i % 2 == 0 ? "#000" : "#fff");
  out += text_at(border_mm, y + 4.4, "0") +
         text_at(border_mm + sheet.mm(bar), y + 4.4, texts.number(bar) + " m",
                 "text-anchor=\"middle\"") +
         text_at(border_mm + sheet.mm(bar) + 6, y + 1.5, fmt::format("1:{:g}", sheet.scale()));
  const double turn = a.project.north_deg;
  out += fmt::format(
             "<g class=\"north\" transform=\"translate({:.2f} {:.2f}) rotate({:g})\"><circle "
             "r=\"3.4\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"0.25\"/><path d=\"M0 "
             "-3.4L1.5 2.4L0 1.3L-1.5 2.4Z\"/></g>\n",
             sheet.width() - border_mm - 4, sheet.height() + 6, turn) +
         text_at(sheet.width() - border_mm - 9.6, sheet.height() + 7, texts("plan.north"),
                 "text-anchor=\"middle\" font-weight=\"bold\"", 3);
  return out + "</g>\n";
}

DrawnBox::DrawnBox(const PlanLevel& level) {
  for (const auto* lines : {&level.walls, &level.furniture})
    for (const auto& [from, to] : *lines) {
      take(from);
      take(to);
    }
}

void DrawnBox::take(const glm::dvec2& place) {
  low_ = glm::min(low_, place);
  high_ = glm::max(high_, place);
}

Sheet DrawnBox::sheet(const PlanSize& size, const Legend& legend) const {
  if (low_.x > high_.x) return {glm::dvec2(0), glm::dvec2(1), size, legend};
  return {low_, high_, size, legend};
}

std::string legend_square(const char* colour) {
  return fmt::format("<rect x=\"0\" y=\"-1.5\" width=\"3\" height=\"3\" fill=\"{}\"/>", colour);
}

Plan finished(const Sheet& sheet, const Legend& legend, const std::string& body) {
  Plan plan;
  plan.width_mm = sheet.width();
  plan.scale = sheet.scale();
  plan.svg = fmt::format(
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} {1:.2f}\" "
                 "width=\"{0:.2f}mm\" height=\"{1:.2f}mm\" font-family=\"Liberation Sans, Arial, "
                 "Helvetica, DejaVu Sans, sans-serif\">\n<style>text {{ paint-order: stroke; "
                 "stroke: #fff; stroke-width: 0.5px; stroke-linejoin: round }}</style>\n"
                 "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
                 sheet.width(), sheet.height() + sheet.foot()) +
             body + legend.svg(sheet.width(), sheet.height()) + "</svg>\n";
  return plan;
}

/// Line widths differ as well, for people who cannot distinguish these colours.
std::string isolux_colour(double lux) {
  const LightColour c = colour_of_illuminance(lux);
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string isolux_style(double lux) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}", isolux_colour(lux),
                     lux == 1 ? 0.6 : 0.35, lux < 0.7 ? " stroke-dasharray=\"1.6 0.8\"" : "");
}

std::string legend_line(double width, const std::string& style) {
  return fmt::format("<path d=\"M0 0h{}\" {}/>", width, style);
}

void reserve_line(const std::vector<glm::dvec3>& path, const Sheet& sheet, LabelSpace& space) {
  constexpr double piece_mm = 0.8;
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    const glm::dvec2 a(sheet.x(path[i].x), sheet.y(path[i].y));
    const glm::dvec2 b(sheet.x(path[i + 1].x), sheet.y(path[i + 1].y));
    const auto pieces = std::max(1, static_cast<int>(glm::length(b - a) / piece_mm));
    for (int k = 0; k <= pieces; ++k) {
      const glm::dvec2 p = a + (b - a) * (static_cast<double>(k) / pieces);
      space.reserve(p.x, p.y, piece_mm, piece_mm);
    }
  }
}

}  // namespace luxodus

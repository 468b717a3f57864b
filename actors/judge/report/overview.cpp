// Seen from the south, from above, turned a little: x runs to the right, y away. Storeys are drawn
// from below, each lifted off the one below it; within a storey far walls come first.
#include "actors/judge/report/overview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "actors/judge/report/plan_parts.hpp"
#include "actors/judge/report/surface_chart.hpp"

namespace luxodus {

namespace {

/// Walls are cut at this height, so that rooms can be looked into [m].
constexpr double cut_m = 1.6;
/// Walls of a storey that are drawn, the longest first: more cannot be told apart on a cover.
constexpr size_t max_walls = 3000;
/// Edge of a coloured piece of floor, at least [m].
constexpr double piece_m = 0.5;

/// Oblique projection to paper.
class Projection {
 public:
  Projection(const AssessmentRecord& a, const PlanSize& size) {
    glm::dvec2 plan_low(1e300), plan_high(-1e300);
    for (const PlanLevel& level : a.plan.levels)
      for (const auto& [from, to] : level.walls)
        for (const glm::dvec2& p : {from, to})
          plan_low = glm::min(plan_low, p), plan_high = glm::max(plan_high, p);
    for (const RouteRecord& route : a.places.routes)
      for (const glm::dvec3& p : route.path)
        plan_low = glm::min(plan_low, glm::dvec2(p)),
        plan_high = glm::max(plan_high, glm::dvec2(p));
    empty_ = plan_low.x > plan_high.x;
    if (empty_) return;
    // A storey clears the depth of the one below it.
    const glm::dvec2 extent = plan_high - plan_low;
    storey_m_ = 0.5 * extent.y + 0.13 * extent.x + 2 * cut_m;
    glm::dvec2 low(1e300), high(-1e300);
    for (const double x : {plan_low.x, plan_high.x})
      for (const double y : {plan_low.y, plan_high.y})
        for (size_t level = 0; level < a.plan.levels.size(); ++level)
          for (const double above : {0.0, 3.0}) {
            const glm::dvec2 p = flat({x, y}, level, above);
            low = glm::min(low, p), high = glm::max(high, p);
          }
    scale_ = std::min(size.width_mm / (high.x - low.x), size.height_mm / (high.y - low.y));
    low_ = low;
    width_mm_ = (high.x - low.x) * scale_;
    height_mm_ = (high.y - low.y) * scale_;
  }
  bool empty() const { return empty_; }
  double width_mm() const { return width_mm_; }
  double height_mm() const { return height_mm_; }
  /// `above`: height over the floor of the level [m].
  glm::dvec2 at(const glm::dvec2& p, size_t level, double above) const {
    return (flat(p, level, above) - low_) * scale_;
  }

 private:
  glm::dvec2 flat(const glm::dvec2& p, size_t level, double above) const {
    // The plan is turned by 15 degrees and its depth is halved.
    constexpr double cosine = 0.966, sine = 0.259, depth = 0.5;
    return {cosine * p.x + sine * p.y,
            depth * (sine * p.x - cosine * p.y) - above - static_cast<double>(level) * storey_m_};
  }
  bool empty_ = true;
  double scale_ = 1, storey_m_ = 0, width_mm_ = 0, height_mm_ = 0;
  glm::dvec2 low_{0};
};

std::string outline(const Projection& to, const std::vector<glm::dvec2>& points, size_t level,
                    double above) {
  std::vector<glm::dvec2> on_paper;
  for (const glm::dvec2& p : points) on_paper.push_back(to.at(p, level, above));
  return path_of(on_paper, true);
}

/// Pieces of floor in the colour of their light; those without any are in walls or outside.
std::string floor_of(const Projection& to, const LightMap& map, size_t level) {
  std::array<std::string, lux_colours> paths;
  if (map.columns == 0) return "";
  const int step = std::max(1, static_cast<int>(std::lround(piece_m / map.spacing_m)));
  const double edge = step * map.spacing_m;
  for (int j = 0; j < map.rows; j += step)
    for (int i = 0; i < map.columns; i += step) {
      const double lux = map.lux[static_cast<size_t>(j) * static_cast<size_t>(map.columns) +
                                 static_cast<size_t>(i)]
                             .lux;
      if (!(lux > 0)) continue;
      const glm::dvec2 low = map.corner + glm::dvec2(i, j) * map.spacing_m - map.spacing_m / 2;
      paths[lux_class(lux)] +=
          outline(to, {low, {low.x + edge, low.y}, low + edge, {low.x, low.y + edge}}, level, 0);
    }
  std::string out;
  for (size_t i = 0; i < paths.size(); ++i)
    if (!paths[i].empty())
      out += "<path fill=\"" + std::string(lux_colour(i)) + "\" stroke=\"" + lux_colour(i) +
             "\" stroke-width=\"0.08\" d=\"" + paths[i] + "\"/>\n";
  return out;
}

std::string walls_of(const Projection& to, const PlanLevel& level, size_t number) {
  std::vector<DrawnLine> lines = level.walls;
  const auto length = [](const DrawnLine& line) { return glm::length(line.second - line.first); };
  if (lines.size() > max_walls) {
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const DrawnLine& a, const DrawnLine& b) { return length(a) > length(b); });
    lines.resize(max_walls);
  }
  std::stable_sort(lines.begin(), lines.end(), [](const DrawnLine& a, const DrawnLine& b) {
    return a.first.y + a.second.y > b.first.y + b.second.y;
  });
  std::string path;
  for (const auto& [from, end] : lines) {
    const std::array<glm::dvec2, 4> corners{to.at(from, number, 0), to.at(end, number, 0),
                                            to.at(end, number, cut_m), to.at(from, number, cut_m)};
    for (size_t i = 0; i < corners.size(); ++i)
      path += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", corners[i].x, corners[i].y);
    path += "Z";
  }
  return path.empty() ? ""
                      : "<path d=\"" + path +
                            "\" fill=\"#eef1f4\" fill-opacity=\"0.55\" stroke=\"#3a424a\" "
                            "stroke-width=\"0.14\" stroke-linejoin=\"round\"/>\n";
}

std::string things_of(const Projection& to, const AssessmentRecord& a, const Schedule& schedule,
                      size_t level) {
  std::string out;
  for (const LuminaireRecord& one : a.luminaires) {
    if (schedule.level_of(one) != level || !(one.emergency_flux.value > 0)) continue;
    const glm::dvec2 place(one.position);
    const glm::dvec2 foot = to.at(place, level, 0),
                     top = to.at(place, level, std::max(0.0, schedule.above_floor(one)));
    out += fmt::format(
        "<path d=\"M{:.2f} {:.2f}V{:.2f}\" stroke=\"{}\" stroke-width=\"0.12\" "
        "stroke-dasharray=\"0.5 0.4\"/><circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"0.9\" fill=\"#fff\" "
        "stroke=\"{}\" stroke-width=\"0.4\"/>\n",
        foot.x, foot.y, top.y, emergency_colour, top.x, top.y, emergency_colour);
  }
  for (const SignRecord& sign : a.signs) {
    if (schedule.level_of(sign) != level) continue;
    const glm::dvec2 at =
        to.at(glm::dvec2(sign.position), level, std::max(0.0, schedule.above_floor(sign)));
    out += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"2.4\" height=\"1.2\" fill=\"{}\" stroke=\"#fff\" "
        "stroke-width=\"0.2\"/>\n",
        at.x - 1.2, at.y - 0.6, emergency_colour);
  }
  return out;
}

std::string routes_of(const Projection& to, const AssessmentRecord& a, const Schedule& schedule,
                      size_t level) {
  std::string out;
  for (const RouteRecord& route : a.places.routes) {
    std::string path;
    for (const glm::dvec3& p : route.path) {
      if (schedule.level_of(p.z) != level) continue;
      const glm::dvec2 at = to.at(glm::dvec2(p), level, p.z - schedule.floor(level));
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", at.x, at.y);
    }
    if (path.find('L') != std::string::npos)
      out += "<path d=\"" + path + "\" " + route_style + "/>\n";
  }
  return out;
}

}  // namespace

std::string overview_svg(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                         const PlanSize& size) {
  const Projection to(a, {size.width_mm, size.height_mm - 7});
  if (to.empty()) return "";
  const double height = to.height_mm() + 7, width = std::max(to.width_mm(), 120.0);
  std::string out = fmt::format(
      "<svg class=\"overview\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} "
      "{1:.2f}\" "
      "width=\"{0:.2f}mm\" height=\"{1:.2f}mm\" font-family=\"Liberation Sans, Arial, Helvetica, "
      "DejaVu Sans, sans-serif\">\n",
      width, height);
  for (size_t i = 0; i < a.plan.levels.size(); ++i)
    out += floor_of(to, a.plan.levels[i].map, i) + routes_of(to, a, schedule, i) +
           walls_of(to, a.plan.levels[i], i) + things_of(to, a, schedule, i);
  double x = 0;
  for (size_t i = 0; i < lux_colours; ++i) {
    const std::string text = lux_class_text(i, texts);
    out += fmt::format(
               "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"4\" height=\"2.4\" fill=\"{}\" "
               "stroke=\"#555\" stroke-width=\"0.1\"/>",
               x, height - 3, lux_colour(i)) +
           text_at(x + 4.8, height - 1, text, "", 2.3);
    x += 7.4 + text_width_mm(text, 2.3);
  }
  return out + "</svg>";
}

}  // namespace luxodus

// The light of a map is drawn within the outline of its surface only. Points of the map outside it,
// which may lie in a wall, take the value of the nearest points inside, so that colours and lines
// reach the outline and no line follows a wall. Doors that a route passes cut nothing.
#include "actors/judge/report/surface_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "actors/judge/report/plan_parts.hpp"
#include "actors/results/formats/contour_lines.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

/// Classes of illuminance: a colour from this value on. Lighter is brighter, so that a print in
/// black and white can be read, too.
struct LuxClass {
  double from_lx;
  const char* colour;
};
constexpr std::array<LuxClass, lux_colours> classes{{{0, "#3b3561"},
                                                     {0.2, "#3f5590"},
                                                     {0.5, "#3d82b0"},
                                                     {1, "#4fb0a8"},
                                                     {2, "#83cb86"},
                                                     {5, "#c3dd6b"},
                                                     {10, "#f0e679"},
                                                     {20, "#fff8d6"}}};
/// Lines are at limits of colours; that of 1 lx is bold.
constexpr std::array<double, 6> line_levels{0.5, 1, 2, 5, 10, 20};
/// Edge of a coloured square [mm].
constexpr double square_mm = 0.5;
constexpr double margin_m = 0.6;

using Outlines = std::vector<std::vector<glm::dvec2>>;

/// A rectangle for each leg of a route, and a disc at each of its corners.
Outlines outlines_of(const RouteRecord& route) {
  constexpr int corners = 24;
  Outlines out;
  const double half = route.width_m / 2;
  for (size_t i = 0; i + 1 < route.path.size(); ++i) {
    const glm::dvec2 a(route.path[i]), b(route.path[i + 1]);
    const double length = glm::length(b - a);
    if (!(length > 0)) continue;
    const glm::dvec2 along = (b - a) / length, aside = half * glm::dvec2(-along.y, along.x);
    out.push_back({a - aside, b - aside, b + aside, a + aside});
    if (i == 0) continue;
    std::vector<glm::dvec2> disc;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      disc.push_back(a + half * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    out.push_back(std::move(disc));
  }
  return out;
}

bool is_inside(const Outlines& outlines, const glm::dvec2& p) {
  return std::any_of(outlines.begin(), outlines.end(),
                     [&](const auto& outline) { return is_within(outline, p); });
}

/// A map within outlines, NaN farther outside.
struct MaskedMap {
  glm::dvec2 corner{0};
  double spacing_m = 0;
  int columns = 0, rows = 0;
  std::vector<double> lux;

  double at(int column, int row) const {
    return lux[static_cast<size_t>(row) * static_cast<size_t>(columns) +
               static_cast<size_t>(column)];
  }
  glm::dvec2 place(int column, int row) const {
    return corner + glm::dvec2(column, row) * spacing_m;
  }
  /// Bilinear; NaN beside the map.
  double value(const glm::dvec2& p) const {
    const glm::dvec2 u = (p - corner) / spacing_m;
    const int i = static_cast<int>(std::floor(u.x)), j = static_cast<int>(std::floor(u.y));
    if (i < 0 || j < 0 || i + 1 >= columns || j + 1 >= rows) return std::nan("");
    const double x = u.x - i, y = u.y - j;
    return (1 - y) * ((1 - x) * at(i, j) + x * at(i + 1, j)) +
           y * ((1 - x) * at(i, j + 1) + x * at(i + 1, j + 1));
  }
};

/// Gives points without a value the mean of those beside them that have one, `rings` times.
void grow(MaskedMap& map, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    const MaskedMap before = map;
    for (int j = 0; j < map.rows; ++j)
      for (int i = 0; i < map.columns; ++i) {
        if (std::isfinite(before.at(i, j))) continue;
        double sum = 0;
        int count = 0;
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di) {
            const int x = i + di, y = j + dj;
            if (x < 0 || y < 0 || x >= map.columns || y >= map.rows) continue;
            if (const double lux = before.at(x, y); std::isfinite(lux)) sum += lux, ++count;
          }
        if (count > 0)
          map.lux[static_cast<size_t>(j) * static_cast<size_t>(map.columns) +
                  static_cast<size_t>(i)] = sum / count;
      }
  }
}

/// The part of a map around outlines, with points beyond its edges.
MaskedMap masked(const LightMap& map, const Outlines& outlines, const glm::dvec2& low,
                 const glm::dvec2& high) {
  constexpr int rings = 2;
  MaskedMap out;
  out.spacing_m = map.spacing_m;
  if (map.columns == 0) return out;
  const auto first = [&](double from, double corner) {
    return static_cast<int>(std::floor((from - corner) / map.spacing_m)) - rings;
  };
  const int left = first(low.x, map.corner.x), bottom = first(low.y, map.corner.y);
  out.corner = map.corner + glm::dvec2(left, bottom) * map.spacing_m;
  out.columns = first(high.x, map.corner.x) + 2 * rings + 2 - left;
  out.rows = first(high.y, map.corner.y) + 2 * rings + 2 - bottom;
  for (int j = bottom; j < bottom + out.rows; ++j)
    for (int i = left; i < left + out.columns; ++i) {
      const bool known = i >= 0 && j >= 0 && i < map.columns && j < map.rows &&
                         is_inside(outlines, map.corner + glm::dvec2(i, j) * map.spacing_m);
      out.lux.push_back(known ? map.lux[static_cast<size_t>(j) * static_cast<size_t>(map.columns) +
                                        static_cast<size_t>(i)]
                                    .lux
                              : std::nan(""));
    }
  grow(out, rings);
  return out;
}

/// Whether points of a surface lie off the floor of its level, of which the level's map is: on
/// stairs and landings.
bool is_uneven(const SurfaceRecord& surface, double floor_m) {
  constexpr double step_m = 0.1;
  for (const SurfaceGridRecord& grid : surface.grids)
    for (const PlanPoint& point : grid.points)
      if (std::abs(point.place.z - floor_m) > step_m) return true;
  return false;
}

/// A map between the points of a surface, seen from above: of each place the mean of the nearest
/// four, by the inverse square of their distance.
LightMap map_between(const SurfaceRecord& surface, const glm::dvec2& low, const glm::dvec2& high) {
  constexpr size_t nearest = 4, most_places = 40'000;
  std::vector<const PlanPoint*> points;
  for (const SurfaceGridRecord& grid : surface.grids)
    for (const PlanPoint& point : grid.points) points.push_back(&point);
  LightMap out;
  const glm::dvec2 size = high - low;
  out.spacing_m = std::max(0.125, std::sqrt(size.x * size.y / most_places));
  out.corner = low;
  out.columns = static_cast<int>(size.x / out.spacing_m) + 1;
  out.rows = static_cast<int>(size.y / out.spacing_m) + 1;
  for (int j = 0; j < out.rows; ++j)
    for (int i = 0; i < out.columns; ++i) {
      const glm::dvec2 place = low + glm::dvec2(i, j) * out.spacing_m;
      std::vector<std::pair<double, double>> near;  // squared distance, lux
      for (const PlanPoint* point : points) {
        const glm::dvec2 way = glm::dvec2(point->place) - place;
        near.emplace_back(glm::dot(way, way), point->lux);
      }
      const size_t count = std::min(nearest, near.size());
      std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
                        near.end());
      double sum = 0, weights = 0;
      for (size_t k = 0; k < count; ++k) {
        const double weight = 1 / (near[k].first + 1e-6);
        sum += weight * near[k].second;
        weights += weight;
      }
      out.lux.push_back({sum / weights});
    }
  return out;
}

/// Runs of squares of one colour, row by row.
std::string coloured(const MaskedMap& map, const Sheet& sheet, const glm::dvec2& low,
                     const glm::dvec2& high) {
  std::array<std::string, classes.size()> paths;
  const double edge = square_mm / sheet.mm(1);
  const auto columns = static_cast<int>(std::ceil((high.x - low.x) / edge));
  const auto rows = static_cast<int>(std::ceil((high.y - low.y) / edge));
  for (int j = 0; j < rows; ++j) {
    const double y = low.y + (j + 0.5) * edge;
    int from = 0;
    std::optional<size_t> run;
    for (int i = 0; i <= columns; ++i) {
      const double lux = i < columns ? map.value({low.x + (i + 0.5) * edge, y}) : std::nan("");
      const auto here = std::isfinite(lux) ? std::optional(lux_class(lux)) : std::nullopt;
      if (here == run) continue;
      if (run)
        paths[*run] +=
            fmt::format("M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", sheet.x(low.x + from * edge),
                        sheet.y(y + edge / 2), (i - from) * square_mm, square_mm * 1.04,
                        (i - from) * square_mm);
      run = here;
      from = i;
    }
  }
  std::string out = "<g class=\"colours\" shape-rendering=\"crispEdges\">\n";
  for (size_t i = 0; i < classes.size(); ++i)
    if (!paths[i].empty())
      out += "<path fill=\"" + std::string(classes[i].colour) + "\" d=\"" + paths[i] + "\"/>\n";
  return out + "</g>\n";
}

std::string isolux(const MaskedMap& map, const Sheet& sheet) {
  std::vector<double> xs, ys;
  for (int i = 0; i < map.columns; ++i) xs.push_back(map.place(i, 0).x);
  for (int j = 0; j < map.rows; ++j) ys.push_back(map.place(0, j).y);
  std::string out = "<g class=\"lines\">\n";
  if (map.columns < 2 || map.rows < 2) return out + "</g>\n";
  for (const double lux : line_levels)
    for (const ContourLine& line : contour_lines(xs, ys, map.lux, lux))
      out += fmt::format(
          "<path class=\"isolux\" data-lux=\"{}\" d=\"{}\" fill=\"none\" stroke=\"#111\" "
          "stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
          lux, path_of(line.points, sheet, false), lux == 1 ? 0.5 : 0.3,
          lux < 0.7 ? " stroke-dasharray=\"1.4 0.7\"" : "");
  return out + "</g>\n";
}

/// Two digits, with those behind the decimal sign that a grid of values needs.
std::string value_text(double lux, const Texts& texts) {
  return texts.fixed(lux, lux < 1 ? 2 : lux < 10 ? 1 : 0);
}

/// Writes values where there is room, those of the darkest and the brightest point first.
class ValueLabels {
 public:
  ValueLabels(const Sheet& sheet, const Texts& texts, const Outlines& outlines, LabelSpace& space)
      : sheet_(sheet), texts_(texts), outlines_(outlines), space_(space) {}

  /// A cross marks the point, as its value may stand beside it. `bold`: of an extreme value.
  bool write(const PlanPoint& point, bool bold) {
    const double x = sheet_.x(point.place.x), y = sheet_.y(point.place.y);
    const std::string text = value_text(point.lux, texts_);
    const double width = text_width_mm(text, value_mm) + 0.8, height = value_mm + 0.3;
    const double up = height / 2 + 0.75, across = width / 2 + 0.75;
    const std::array<glm::dvec2, 9> offsets{{{0, 0},
                                             {0, -up},
                                             {0, up},
                                             {across, 0},
                                             {-across, 0},
                                             {across, -up},
                                             {-across, -up},
                                             {across, up},
                                             {-across, up}}};
    for (const glm::dvec2& offset : offsets) {
      const bool here = offset == glm::dvec2(0);
      if (bold && here) continue;
      // Beside the surface only an extreme value is written.
      if (!bold && !is_inside(outlines_, sheet_.place(x + offset.x, y + offset.y))) continue;
      if (!space_.take(x + offset.x, y + offset.y, width, height)) continue;
      if (!here) svg_ += mark(x, y, bold);
      svg_ +=
          text_at(x + offset.x, y + offset.y + 0.36 * value_mm, text,
                  bold ? "text-anchor=\"middle\" font-weight=\"bold\"" : "text-anchor=\"middle\"",
                  value_mm);
      return true;
    }
    return false;
  }
  std::string svg() const { return "<g class=\"values\" fill=\"#000\">\n" + svg_ + "</g>\n"; }

 private:
  static std::string mark(double x, double y, bool bold) {
    const double r = bold ? 0.7 : 0.3;
    return fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"#000\" stroke=\"#fff\" "
        "stroke-width=\"0.15\"/>\n",
        x, y, r);
  }
  const Sheet& sheet_;
  const Texts& texts_;
  const Outlines& outlines_;
  LabelSpace& space_;
  std::string svg_;
};

/// Places by the millimetre, as grids of one surface may share points.
using Places = std::set<std::pair<long, long>>;

bool is_new(Places& known, const glm::dvec3& place) {
  return known.emplace(std::lround(1000 * place.x), std::lround(1000 * place.y)).second;
}

/// Writes each value once. Returns how many are written, and of how many points.
std::pair<size_t, size_t> write_values(const SurfaceRecord& surface, ValueLabels& labels) {
  Places known;
  std::pair<size_t, size_t> out{0, 0};
  const auto write = [&](const PlanPoint& point, bool bold) {
    if (!is_new(known, point.place)) return;
    ++out.second;
    out.first += labels.write(point, bold);
  };
  const SurfaceGridRecord& first = surface.grids.front();
  write({first.darkest, first.least}, true);
  if (first.most > first.least) write({first.brightest, first.most}, true);
  for (const SurfaceGridRecord& grid : surface.grids)
    for (const PlanPoint& point : grid.points) write(point, false);
  return out;
}

Legend chart_legend(const Texts& texts, bool is_route) {
  Legend legend;
  for (size_t i = 0; i < classes.size(); ++i)
    legend.add(fmt::format("<rect y=\"-1.2\" width=\"4\" height=\"2.4\" fill=\"{}\" "
                           "stroke=\"#555\" stroke-width=\"0.1\"/>",
                           classes[i].colour),
               4, lux_class_text(i, texts));
  legend.add(luminaire_symbol(1.1, 0, true), 2.2, texts("legend.emergency"));
  if (is_route)
    legend.add(legend_line(8, route_style) + route_end(9.4, 0, 0), 9.4, texts("legend.route"));
  return legend;
}

std::string clip(const Outlines& outlines, const Sheet& sheet, const std::string& id) {
  std::string out = "<clipPath id=\"" + id + "\">\n";
  for (const auto& outline : outlines)
    out += "<path d=\"" + path_of(outline, sheet, true) + "\"/>\n";
  return out + "</clipPath>\n";
}

/// Where a surface lies in its assessment.
struct Placed {
  Outlines outlines;
  const RouteRecord* route = nullptr;
  size_t level = 0;
};

Placed placed(const AssessmentRecord& a, const Schedule& schedule, const SurfaceRecord& surface) {
  Placed out;
  out.level = schedule.level_of(surface.grids.front().points.front().place.z);
  for (const RouteRecord& route : a.places.routes)
    if (surface.subject.kind == SubjectKind::route && route.name == surface.subject.name) {
      out.route = &route;
      out.outlines = outlines_of(route);
    }
  for (const AreaRecord& area : a.places.areas)
    if (surface.subject.kind == (area.is_task ? SubjectKind::task_area : SubjectKind::open_area) &&
        area.name == surface.subject.name)
      out.outlines = {area.outline};
  return out;
}

std::string luminaires_on(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                          const glm::dvec2& low, const glm::dvec2& high, const Sheet& sheet,
                          LabelSpace& space) {
  std::string out = "<g class=\"luminaires\">\n";
  for (const LuminaireRecord& one : a.luminaires) {
    if (schedule.level_of(one) != level || !(one.emergency_flux.value > 0)) continue;
    const double x = sheet.x(one.position.x), y = sheet.y(one.position.y);
    const glm::dvec2 p(one.position);
    if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y) continue;
    out += luminaire_symbol(x, y, true);
    space.reserve(x, y, 2.6, 2.6);
  }
  return out + "</g>\n";
}

}  // namespace

size_t lux_class(double lux) {
  size_t out = 0;
  while (out + 1 < classes.size() && lux >= classes[out + 1].from_lx) ++out;
  return out;
}

const char* lux_colour(size_t number) {
  return classes[number].colour;
}

std::string lux_class_text(size_t number, const Texts& texts) {
  const bool last = number + 1 == classes.size();
  const std::string from = texts.number(classes[number].from_lx);
  const std::string text = number == 0 ? "< " + texts.number(classes[1].from_lx)
                           : last      ? "≥ " + from
                                       : from + "–" + texts.number(classes[number + 1].from_lx);
  return text + " lx";
}

SurfaceChart surface_chart(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                           const SurfaceRecord& surface, const PlanSize& size) {
  const Placed where = placed(a, schedule, surface);
  glm::dvec2 low(1e300), high(-1e300);
  for (const auto& outline : where.outlines)
    for (const glm::dvec2& p : outline) low = glm::min(low, p), high = glm::max(high, p);
  for (const PlanPoint& p : surface.grids.front().points)
    low = glm::min(low, glm::dvec2(p.place)), high = glm::max(high, glm::dvec2(p.place));
  const Legend legend = chart_legend(texts, where.route != nullptr);
  const Sheet sheet(low - margin_m, high + margin_m, size, legend);
  const PlanLevel& level = a.plan.levels[where.level];
  const LightMap light = surface.map.columns > 0             ? surface.map
                         : is_uneven(surface, level.floor_m) ? map_between(surface, low, high)
                                                             : level.map;
  const MaskedMap map = masked(light, where.outlines, low, high);
  const auto number = static_cast<size_t>(&surface - a.surfaces.data());
  const std::string inner = fmt::format("clip{}", number), outer = fmt::format("sheet{}", number);
  const Outlines whole{{low - margin_m,
                        {high.x + margin_m, low.y - margin_m},
                        high + margin_m,
                        {low.x - margin_m, high.y + margin_m}}};
  LabelSpace space;
  std::string body = clip(where.outlines, sheet, inner) + clip(whole, sheet, outer) +
                     "<g clip-path=\"url(#" + inner + ")\">\n" + coloured(map, sheet, low, high) +
                     isolux(map, sheet) + "</g>\n<g clip-path=\"url(#" + outer + ")\">\n" +
                     walls(a.plan.levels[where.level], sheet) + "</g>\n";
  if (where.route) {
    const auto& path = where.route->path;
    const glm::dvec3 &end = path.back(), &before = path[path.size() - 2];
    body += "<path class=\"route\" d=\"" + path_of(path, sheet, false) + "\" " + route_style +
            "/>\n" +
            route_end(sheet.x(end.x), sheet.y(end.y),
                      std::atan2(before.y - end.y, end.x - before.x) * 180 / std::numbers::pi);
    reserve_line(path, sheet, space);
  }
  body += luminaires_on(a, schedule, where.level, low - margin_m, high + margin_m, sheet, space);
  ValueLabels labels(sheet, texts, where.outlines, space);
  SurfaceChart out;
  std::tie(out.values, out.points) = write_values(surface, labels);
  out.plan = finished(sheet, legend, body + labels.svg() + foot(a, sheet, texts));
  return out;
}

}  // namespace luxodus

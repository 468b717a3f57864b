// The unit of a drawing is 1 mm on paper. Elements are drawn back to front; texts have a white
// outline, so they can be read on lines.
#include "actors/judge/report/plan_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "actors/judge/report/isolux.hpp"
#include "actors/judge/report/plan_parts.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

constexpr const char* backdrop_style = "stroke=\"#555\" stroke-width=\"0.15\"";
constexpr const char* area_style =
    "fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"0.3\" stroke-dasharray=\"0.3 1\" "
    "stroke-linecap=\"round\"";

/// A picture whose pixels span 0 to 1 along its edges, the upper row first.
std::string backdrop_picture(const BackdropRecord& one, const Sheet& sheet) {
  const glm::dvec2 across = one.across.value_or(glm::dvec2(0)), up = one.up.value_or(across),
                   upper = one.corner.value_or(across) + up;
  return fmt::format(
      "<image width=\"1\" height=\"1\" preserveAspectRatio=\"none\" transform=\"matrix({:.5f} "
      "{:.5f} {:.5f} {:.5f} {:.3f} {:.3f})\" href=\"data:image/png;base64,{}\"/>\n",
      sheet.mm(across.x), -sheet.mm(across.y), -sheet.mm(up.x), sheet.mm(up.y), sheet.x(upper.x),
      sheet.y(upper.y), one.png);
}

/// Backdrop drawings of a level, faint, clipped at the edge of the plan.
std::string backdrops(const AssessmentRecord& a, size_t level, const Sheet& sheet) {
  const double floor = a.plan.levels[level].floor_m;
  std::string pictures, lines;  // drawn after pictures, which would hide them
  for (const BackdropRecord& one : a.plan.backdrops) {
    if (floor < one.floors.x || floor > one.floors.y) continue;
    if (one.lines)
      lines += lines_path(*one.lines, sheet, backdrop_style);
    else
      pictures += backdrop_picture(one, sheet);
  }
  if (pictures.empty() && lines.empty()) return "";
  return fmt::format(
             "<svg class=\"backdrop\" width=\"{0:.2f}\" height=\"{1:.2f}\" viewBox=\"0 0 {0:.2f} "
             "{1:.2f}\" overflow=\"hidden\" opacity=\"0.35\">\n",
             sheet.width(), sheet.height()) +
         pictures + lines + "</svg>\n";
}

/// Areas, and routes with an arrow at their ends.
std::string places(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                   const Sheet& sheet) {
  std::string out = "<g class=\"places\">\n";
  for (const AreaRecord& area : a.places.areas) {
    if (schedule.level_of(area.z_m) != level) continue;
    out += "<path d=\"" + path_of(area.outline, sheet, true) + "\" " + area_style + "/>\n";
  }
  for (const RouteRecord& route : a.places.routes) {
    const auto& path = route.path;
    const bool here = std::any_of(path.begin(), path.end(), [&](const glm::dvec3& p) {
      return schedule.level_of(p.z) == level;
    });
    if (!here) continue;
    out += "<path d=\"" + path_of(path, sheet, false) + "\" " + route_style + "/>\n";
    const glm::dvec3 &end = path[path.size() - 1], &before = path[path.size() - 2];
    const double dx = sheet.x(end.x) - sheet.x(before.x);
    const double dy = sheet.y(end.y) - sheet.y(before.y);
    out += route_end(sheet.x(end.x), sheet.y(end.y), std::atan2(dy, dx) * 180 / std::numbers::pi);
  }
  return out + "</g>\n";
}

/// Whether a room, whose name is on the plan, is called so.
bool is_room(const AssessmentRecord& a, const std::string& name) {
  return std::any_of(a.rooms.begin(), a.rooms.end(),
                     [&](const RoomRecord& room) { return room.name == name; });
}

/// Names of areas and routes; a route's name is at a third of its first leg, so that names of
/// opposite routes do not overlap.
std::string place_names(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                        const Sheet& sheet, LabelSpace& space) {
  std::string out = "<g class=\"names\" fill=\"#1f5fa8\" font-style=\"italic\">\n";
  for (const AreaRecord& area : a.places.areas) {
    if (is_room(a, area.name) || schedule.level_of(area.z_m) != level) continue;
    // In the lower left corner of the outline, away from the luminaires in its middle.
    const glm::dvec2 corner =
        *std::min_element(area.outline.begin(), area.outline.end(),
                          [](const auto& p, const auto& q) { return p.x + p.y < q.x + q.y; });
    out += text_at(sheet.x(corner.x) + 1.5, sheet.y(corner.y) - 1.5, area.name);
  }
  for (const RouteRecord& route : a.places.routes) {
    const glm::dvec3 &from = route.path[0], &to = route.path[1];
    if (schedule.level_of(from.z) != level || is_room(a, route.name)) continue;
    const double x0 = sheet.x(from.x), y0 = sheet.y(from.y);
    const double dx = sheet.x(to.x) - x0, dy = sheet.y(to.y) - y0;
    double turn = std::atan2(dy, dx) * 180 / std::numbers::pi;
    if (turn > 90.01 || turn <= -89.99) turn += 180;
    const double radians = turn * std::numbers::pi / 180,
                 side = 4.4;  // of the text's middle from the line
    const double width = text_width_mm(route.name, text_mm);
    const double c = std::abs(std::cos(radians)), s = std::abs(std::sin(radians));
    double along = 0.3;
    for (const double share : {0.3, 0.2, 0.4, 0.25, 0.35, 0.5, 0.6, 0.7, 0.8}) {
      if (!space.take(x0 + share * dx - side * std::sin(radians),
                      y0 + share * dy + side * std::cos(radians), width * c + text_mm * s,
                      width * s + text_mm * c))
        continue;
      along = share;
      break;
    }
    out += text_at(0, 5.2, route.name,
                   fmt::format("text-anchor=\"middle\" transform=\"translate({:.2f} {:.2f}) "
                               "rotate({:.1f})\"",
                               x0 + along * dx, y0 + along * dy, turn)
                       .c_str());
  }
  return out + "</g>\n";
}

/// Places within a room's box where its name may stand, from the middle outwards.
std::vector<glm::dvec2> name_places() {
  constexpr int steps = 12;
  std::vector<glm::dvec2> out;
  for (int i = 2; i <= steps - 2; ++i)
    for (int j = 1; j < steps; ++j) out.push_back(glm::dvec2(i, j) / double{steps});
  std::stable_sort(out.begin(), out.end(), [](const glm::dvec2& p, const glm::dvec2& q) {
    return glm::length(p - 0.5) < glm::length(q - 0.5);
  });
  return out;
}

/// Lines of a room's name, and the height of its letters [mm].
struct RoomName {
  std::vector<std::string> lines;
  double size = 2.8;

  double width() const {
    double out = 0;
    for (const std::string& line : lines) out = std::max(out, text_width_mm(line, size));
    return out;
  }
  double height() const { return static_cast<double>(lines.size()) * (size + 0.4); }
  std::string svg(double x, double y) const {
    std::string out;
    for (size_t i = 0; i < lines.size(); ++i)
      out += text_at(
          x, y - height() / 2 + (static_cast<double>(i) + 0.85) * (size + 0.4), lines[i],
          i == 0 ? "text-anchor=\"middle\" font-weight=\"bold\"" : "text-anchor=\"middle\"", size);
    return out;
  }
};

/// The name of a room with its area where there is room for it, from the middle outwards; else the
/// name alone in the middle, in small letters, since every room has its name on the plan.
std::string room_name(const RoomRecord& room, const Texts& texts, const Sheet& sheet,
                      LabelSpace& space) {
  glm::dvec2 low(1e300), high(-1e300);
  for (const glm::dvec2& p : room.outline) low = glm::min(low, p), high = glm::max(high, p);
  const std::string area = texts.fixed(room.area_m2, 1) + " m²";
  const RoomName forms[] = {
      {{room.name, area}}, {{room.name + ", " + area}, 2.5}, {{room.name}, 2.2}};
  for (const RoomName& name : forms)
    for (const glm::dvec2& share : name_places()) {
      const glm::dvec2 at = low + (high - low) * share;
      const double x = sheet.x(at.x), y = sheet.y(at.y), half = name.width() / 2;
      if (x - half < sheet.x(low.x) || x + half > sheet.x(high.x)) continue;
      if (space.take(x, y, name.width(), name.height())) return name.svg(x, y);
    }
  return std::end(forms)[-1].svg(sheet.x((low.x + high.x) / 2), sheet.y((low.y + high.y) / 2));
}

std::string room_names(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                       size_t level, const Sheet& sheet, LabelSpace& space) {
  for (const RouteRecord& route : a.places.routes)
    if (schedule.level_of(route.path.front().z) == level) reserve_line(route.path, sheet, space);
  std::string out = "<g class=\"rooms\" fill=\"#333\">\n";
  for (const RoomRecord& room : a.rooms)
    if (schedule.level_of(room.z_m) == level) out += room_name(room, texts, sheet, space);
  return out + "</g>\n";
}

std::string luminaire_letters(const std::string& text, double x, double y, bool emergency) {
  const double size = emergency ? text_mm : 1.7;
  return text_at(x, y + 0.36 * size, text,
                 emergency ? "text-anchor=\"middle\" font-weight=\"bold\""
                           : "text-anchor=\"middle\" fill=\"#666\"",
                 size);
}

/// Letter and height beside a luminaire at (x, y), in the first free position; above is tried first
/// for emergency luminaires.
std::string luminaire_label(const std::string& text, double x, double y, bool emergency,
                            LabelSpace& space) {
  const double size = emergency ? text_mm : 1.7, width = text_width_mm(text, size);
  const double up = 1.5 + size / 2, across = 1.8 + width / 2, first = emergency ? -up : up;
  const double far = first + std::copysign(size + 0.6, first);  // one line farther
  const std::array<std::array<double, 2>, 14> offsets{{{0, first},
                                                       {0, -first},
                                                       {across, 0},
                                                       {-across, 0},
                                                       {across, first},
                                                       {-across, first},
                                                       {across, -first},
                                                       {-across, -first},
                                                       {0, far},
                                                       {0, -far},
                                                       {across, far},
                                                       {-across, far},
                                                       {across, -far},
                                                       {-across, -far}}};
  const auto* at = std::find_if(offsets.begin(), offsets.end(), [&](const auto& offset) {
    return space.take(x + offset[0], y + offset[1], width, size);
  });
  if (at == offsets.end()) at = offsets.begin();
  return luminaire_letters(text, x + (*at)[0], y + (*at)[1], emergency);
}

/// Symbols of luminaires; with `labels` also letters and heights, in free positions.
std::string luminaires(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                       size_t level, const Sheet& sheet, LabelSpace* labels) {
  std::string out = "<g class=\"luminaires\">\n";
  struct Label {
    std::string text;
    double x, y;
    bool emergency;
  };
  std::vector<Label> wanted;
  const auto& all = a.luminaires;
  for (size_t i = 0; i < all.size(); ++i) {
    if (schedule.level_of(all[i]) != level) continue;
    const LuminaireType& type = schedule.type_of(i);
    const double x = sheet.x(all[i].position.x);
    const double y = sheet.y(all[i].position.y);
    const bool emergency = type.emergency();
    out += fmt::format("<g><title>{}</title>{}</g>\n", xml_escape(all[i].name),
                       luminaire_symbol(x, y, emergency));
    if (labels == nullptr) continue;
    labels->reserve(x, y, 2.2, 2.2);
    wanted.push_back(
        {type.letter + " " + texts.fixed(schedule.above_floor(all[i])), x, y, emergency});
  }
  // Emergency luminaires are labelled first and drawn last, since the plan is about them.
  std::string emergency_labels;
  for (const bool emergency : {true, false})
    for (const Label& label : wanted)
      if (label.emergency == emergency)
        (emergency ? emergency_labels : out) +=
            luminaire_label(label.text, label.x, label.y, emergency, *labels);
  out += emergency_labels;
  return out + "</g>\n";
}

/// Position of a sign's number [mm]: beside the arrow, away from the direction that the sign faces.
std::array<double, 2> sign_number_place(const SignRecord& sign, const Sheet& sheet) {
  const double fx = sign.facing.x, fy = -sign.facing.y;
  return {sheet.x(sign.position.x) - 2.9 * fx + (std::abs(fx) > 0.7 ? 0 : 2.6),
          sheet.y(sign.position.y) - 2.9 * fy - (std::abs(fx) > 0.7 ? 2.6 : 0)};
}

void reserve_signs(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                   const Sheet& sheet, LabelSpace& space) {
  for (const SignRecord& sign : a.signs) {
    if (schedule.level_of(sign) != level) continue;
    const auto number = sign_number_place(sign, sheet);
    space.reserve(number[0], number[1], 4.2, 4.2);
    space.reserve(sheet.x(sign.position.x) + 2 * sign.facing.x,
                  sheet.y(sign.position.y) - 2 * sign.facing.y, 4, 4);
  }
}

/// A sign as a bar with an arrow in the direction that it faces.
std::string sign_arrow(double x, double y, double turn, bool double_sided) {
  return fmt::format(
      "<g transform=\"translate({:.2f} {:.2f}) rotate({:.1f})\"><path d=\"M0 -1.8V1.8M0 "
      "0H2.2\" stroke=\"#000\" stroke-width=\"0.6\"/><path d=\"M4 0L1.9 -1V1Z\"/>{}</g>\n",
      x, y, turn, double_sided ? "<path d=\"M-4 0L-1.9 -1V1Z\"/>" : "");
}

std::string sign_number(double x, double y, size_t number) {
  return fmt::format(
             "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"1.9\" fill=\"#fff\" stroke=\"#000\" "
             "stroke-width=\"0.3\"/>",
             x, y) +
         text_at(x, y + 0.8, std::to_string(number),
                 "text-anchor=\"middle\" font-weight=\"bold\" stroke=\"none\"", 2.3);
}

/// A circled number for each sign, and an arrow in the direction that it faces.
std::string signs(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                  const Sheet& sheet, const std::string& only = "") {
  std::string out = "<g class=\"signs\">\n";
  const auto& all = a.signs;
  for (size_t i = 0; i < all.size(); ++i) {
    const glm::dvec3& position = all[i].position;
    if (schedule.level_of(all[i]) != level) continue;
    if (!only.empty() && all[i].name != only) continue;
    const double x = sheet.x(position.x), y = sheet.y(position.y);
    const double fx = all[i].facing.x, fy = -all[i].facing.y;
    const double turn = std::atan2(fy, fx) * 180 / std::numbers::pi;
    const auto [cx, cy] = sign_number_place(all[i], sheet);
    out += fmt::format("<g><title>{}</title>", xml_escape(all[i].name)) +
           sign_arrow(x, y, turn, all[i].double_sided) + sign_number(cx, cy, i + 1) + "</g>\n";
  }
  return out + "</g>\n";
}

std::string emphasis_symbol(double x, double y) {
  return fmt::format(
      "<path d=\"M{:.2f} {:.2f}l1.3 1.3l-1.3 1.3l-1.3 -1.3Z\" fill=\"#fff\" "
      "stroke=\"#8a2be2\" stroke-width=\"0.35\"/>",
      x, y - 1.3);
}

std::string emphasis(const AssessmentRecord& a, const Schedule& schedule, size_t level,
                     const Sheet& sheet) {
  std::string out;
  for (const EmphasisRecord& point : a.places.emphasis) {
    const glm::dvec3& p = point.position;
    if (schedule.level_of(p.z) != level) continue;
    out += fmt::format("<g><title>{}</title>{}</g>\n", xml_escape(point.name),
                       emphasis_symbol(sheet.x(p.x), sheet.y(p.y)));
  }
  return out;
}

/// A line with its value about every 36 mm, where space is free.
std::string isolux_line(const IsoluxLine& one, const Sheet& sheet, const Texts& texts,
                        LabelSpace& space) {
  const double label_width = text_width_mm(texts.number(one.lux), 2.4) + 0.6;
  std::string path;
  double length = 0, labelled = -30;
  std::string labels;
  const auto& points = one.line.points;
  for (size_t i = 0; i < points.size(); ++i) {
    const double x = sheet.x(points[i].x), y = sheet.y(points[i].y);
    path += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", x, y);
    if (i == 0) continue;
    length += std::hypot(x - sheet.x(points[i - 1].x), y - sheet.y(points[i - 1].y));
    if (length - labelled < 36 || !space.take(x, y, label_width, 2.6)) continue;
    labelled = length;
    labels += text_at(x, y + 0.8, texts.number(one.lux),
                      fmt::format("text-anchor=\"middle\" font-weight=\"bold\" fill=\"{}\"",
                                  isolux_colour(one.lux))
                          .c_str(),
                      2.4);
  }
  if (length < 3) return "";  // too short to see
  return fmt::format(
             "<path class=\"isolux\" data-lux=\"{}\" d=\"{}\" stroke-linejoin=\"round\" {}/>\n",
             one.lux, path, isolux_style(one.lux)) +
         labels;
}

std::string grid_values(const PlanLevel& level, const Sheet& sheet, const Texts& texts) {
  std::string out = "<g class=\"values\" fill=\"#333\">\n";
  // If numbers would overlap, only the first in each cell is drawn.
  std::map<std::pair<long, long>, bool> taken;
  for (const auto& [p, lux] : level.points) {
    const double x = sheet.x(p.x), y = sheet.y(p.y);
    const std::pair cell{std::lround(x / 4.2), std::lround(y / 2.2)};
    if (!taken.emplace(cell, true).second) continue;
    out += text_at(x, y + 0.6, texts.number(lux, 2), "text-anchor=\"middle\"", 1.6);
  }
  return out + "</g>\n";
}

/// Legend entries for luminaires of a level, with or without letters and heights.
void explain_luminaires(Legend& legend, const AssessmentRecord& a, const Schedule& schedule,
                        const Texts& texts, size_t level, bool with_letters) {
  std::string letters;  // of the first luminaire on the plan
  for (const bool emergency : {true, false}) {
    bool any = false;
    for (size_t i = 0; i < a.luminaires.size(); ++i) {
      const LuminaireRecord& one = a.luminaires[i];
      if (schedule.level_of(one) != level || schedule.type_of(i).emergency() != emergency) continue;
      any = true;
      if (letters.empty())
        letters = schedule.type_of(i).letter + " " + texts.fixed(schedule.above_floor(one));
    }
    if (any)
      legend.add(luminaire_symbol(1.1, 0, emergency), 2.2,
                 texts(emergency ? "legend.emergency" : "legend.mains"));
  }
  if (!with_letters || letters.empty()) return;
  const double width = text_width_mm(letters, text_mm);
  legend.add(luminaire_letters(letters, width / 2, 0, true), width, texts("legend.letters"));
}

void explain_signs(Legend& legend, const AssessmentRecord& a, const Schedule& schedule,
                   const Texts& texts, size_t level) {
  bool any = false, double_sided = false;
  for (const SignRecord& sign : a.signs) {
    if (schedule.level_of(sign) != level) continue;
    any = true;
    double_sided = double_sided || sign.double_sided;
  }
  if (any)
    legend.add(sign_number(1.9, 0, 1) + sign_arrow(4.6, 0, 0, false), 8.6, texts("legend.sign"));
  if (double_sided) legend.add(sign_arrow(4, 0, 0, true), 8, texts("legend.double_sided"));
}

/// Legend entries for routes, areas, walls and furniture.
void explain_building(Legend& legend, const AssessmentRecord& a, const Schedule& schedule,
                      const Texts& texts, size_t level, bool with_furniture) {
  const auto here = [&](double z) { return schedule.level_of(z) == level; };
  const auto& routes = a.places.routes;
  const auto& areas = a.places.areas;
  if (std::any_of(routes.begin(), routes.end(), [&](const RouteRecord& route) {
        return std::any_of(route.path.begin(), route.path.end(),
                           [&](const glm::dvec3& p) { return here(p.z); });
      }))
    legend.add(legend_line(8, route_style) + route_end(9.4, 0, 0), 9.4, texts("legend.route"));
  if (std::any_of(areas.begin(), areas.end(),
                  [&](const AreaRecord& area) { return here(area.z_m); }))
    legend.add(legend_line(8, area_style), 8, texts("legend.area"));
  const PlanLevel& drawn = a.plan.levels[level];
  if (!drawn.walls.empty()) legend.add(legend_line(6, wall_style), 6, texts("legend.walls"));
  if (with_furniture && !drawn.furniture.empty())
    legend.add(legend_line(6, furniture_style), 6, texts("legend.furniture"));
}

Legend installation_legend(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                           size_t level) {
  Legend legend;
  explain_luminaires(legend, a, schedule, texts, level, true);
  explain_signs(legend, a, schedule, texts, level);
  for (const EmphasisRecord& point : a.places.emphasis)
    if (schedule.level_of(point.position.z) == level) {
      legend.add(emphasis_symbol(1.3, 0), 2.6, texts("legend.emphasis"));
      break;
    }
  explain_building(legend, a, schedule, texts, level, true);
  return legend;
}

Legend isolux_legend(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                     size_t level) {
  Legend legend;
  for (const double lux : isolux_levels)
    legend.add(legend_line(8, isolux_style(lux)), 8, texts.number(lux) + " lx");
  explain_luminaires(legend, a, schedule, texts, level, false);
  explain_building(legend, a, schedule, texts, level, false);
  return legend;
}

Legend sight_legend(const AssessmentRecord& a, const Schedule& schedule, const Texts& texts,
                    size_t level, const std::string& sign) {
  Legend legend;
  for (const SightVerdict rank : sight_ranks)
    legend.add(verdict_shape(name_of(rank), 1.3, 0, 1.3), 2.6, texts.word("sight", name_of(rank)));
  // A map of one sign is small and has the sign's name in its caption.
  if (sign.empty()) explain_signs(legend, a, schedule, texts, level);
  return legend;
}

}  // namespace

size_t rank_of(SightVerdict verdict) {
  return static_cast<size_t>(std::find(sight_ranks.begin(), sight_ranks.end(), verdict) -
                             sight_ranks.begin());
}

const char* verdict_colour(const std::string& verdict) {
  if (verdict == "pass" || verdict == "legible") return "#1a7f3c";
  if (verdict == "fail" || verdict == "invisible") return "#b3261e";
  if (verdict == "undecided" || verdict == "not verified") return "#8a6100";
  if (verdict == "visible but not legible") return "#c25700";
  return "#5f6368";
}

std::string verdict_shape(const std::string& verdict, double x, double y, double r) {
  const char* colour = verdict_colour(verdict);
  std::string shape;
  if (verdict == "pass" || verdict == "legible")  // a disc with a check mark
    shape = fmt::format(
        "<circle r=\"1\" fill=\"{}\"/><path d=\"M-.5 0L-.12 .4L.52 -.38\" "
        "fill=\"none\" stroke=\"#fff\" stroke-width=\".24\"/>",
        colour);
  else if (verdict == "fail" || verdict == "invisible")  // a square with a cross
    shape = fmt::format(
        "<path d=\"M-.95 -.95H.95V.95H-.95Z\" fill=\"{}\"/><path d=\"M-.48 "
        "-.48L.48 .48M.48 -.48L-.48 .48\" stroke=\"#fff\" stroke-width=\".26\"/>",
        colour);
  else if (verdict == "visible but not legible")  // a half-filled diamond
    shape = fmt::format(
        "<path d=\"M0 -1.15L1.15 0L0 1.15L-1.15 0Z\" fill=\"#fff\" stroke=\"{0}\" "
        "stroke-width=\".22\"/><path d=\"M0 -1.15L1.15 0L0 1.15Z\" fill=\"{0}\"/>",
        colour);
  else if (verdict == "undecided" || verdict == "not verified")  // a triangle with a "!"
    shape = fmt::format(
        "<path d=\"M0 -1.1L1.15 .9H-1.15Z\" fill=\"{}\"/><path d=\"M0 -.4V.25M0 "
        ".45V.68\" stroke=\"#fff\" stroke-width=\".24\"/>",
        colour);
  else if (verdict == "information")
    shape = fmt::format(
        "<circle r=\".9\" fill=\"#fff\" stroke=\"{0}\" stroke-width=\".22\"/><path "
        "d=\"M0 -.1V.55M0 -.5V-.28\" stroke=\"{0}\" stroke-width=\".24\"/>",
        colour);
  else if (verdict == "hidden by the building")  // a hollow square with a diagonal stroke
    shape = fmt::format(
        "<path d=\"M-.8 -.8H.8V.8H-.8ZM-.8 .8L.8 -.8\" fill=\"#fff\" stroke=\"{}\" "
        "stroke-width=\".22\"/>",
        colour);
  else  // a ring with a bar: no verdict
    shape = fmt::format(
        "<circle r=\".85\" fill=\"#fff\" stroke=\"{0}\" stroke-width=\".25\"/><path "
        "d=\"M-.45 0H.45\" stroke=\"{0}\" stroke-width=\".25\"/>",
        colour);
  return fmt::format("<g transform=\"translate({:.2f} {:.2f}) scale({:.2f})\">{}</g>\n", x, y, r,
                     shape);
}

Plan Plans::installation(size_t number) const {
  const PlanLevel& level = a_.plan.levels[number];
  const Legend legend = installation_legend(a_, schedule_, texts_, number);
  const Sheet sheet(a_, schedule_, number, size_, legend);
  LabelSpace space;
  reserve_signs(a_, schedule_, number, sheet, space);
  // Before route names, which have more free positions.
  const std::string symbols = luminaires(a_, schedule_, texts_, number, sheet, &space);
  const std::string rooms = room_names(a_, schedule_, texts_, number, sheet, space);
  return finished(
      sheet, legend,
      backdrops(a_, number, sheet) + building(level, sheet) + places(a_, schedule_, number, sheet) +
          emphasis(a_, schedule_, number, sheet) + symbols + signs(a_, schedule_, number, sheet) +
          rooms + place_names(a_, schedule_, number, sheet, space) + foot(a_, sheet, texts_));
}

Plan Plans::isolux(size_t number, bool values) const {
  const PlanLevel& level = a_.plan.levels[number];
  const Legend legend = isolux_legend(a_, schedule_, texts_, number);
  const Sheet sheet(a_, schedule_, number, size_, legend);
  std::string lines = "<g class=\"lines\">\n";
  LabelSpace space;
  for (const IsoluxLine& one : isolux_lines(level)) lines += isolux_line(one, sheet, texts_, space);
  return finished(sheet, legend,
                  backdrops(a_, number, sheet) + building(level, sheet) +
                      places(a_, schedule_, number, sheet) +
                      luminaires(a_, schedule_, texts_, number, sheet, nullptr) +
                      (values ? grid_values(level, sheet, texts_) : "") + lines + "</g>\n" +
                      foot(a_, sheet, texts_));
}

Plan Plans::sights(size_t number, double eye_height_m, const std::string& sign) const {
  const PlanLevel& level = a_.plan.levels[number];
  const Legend legend = sight_legend(a_, schedule_, texts_, number, sign);
  const Sheet sheet(a_, schedule_, number, size_, legend);
  std::map<std::pair<double, double>, size_t> best;  // rank by place
  for (const SightRecord& sight : a_.sights) {
    const double eye = sight.eye_height_m;
    if (sight.by_observer() || eye != eye_height_m ||
        schedule_.level_of(sight.eye.z - eye) != number || (!sign.empty() && sight.sign != sign))
      continue;
    const size_t rank = rank_of(sight.verdict);
    const std::pair place{sight.eye.x, sight.eye.y};
    const auto known = best.try_emplace(place, rank).first;
    known->second = std::min(known->second, rank);
  }
  std::string marks = "<g class=\"sights\">\n";
  for (const auto& [place, rank] : best)
    marks +=
        verdict_shape(name_of(sight_ranks[rank]), sheet.x(place.first), sheet.y(place.second), 1.3);
  return finished(sheet, legend,
                  (sign.empty() ? backdrops(a_, number, sheet) : "") + building(level, sheet) +
                      marks + "</g>\n" + signs(a_, schedule_, number, sheet, sign) +
                      foot(a_, sheet, texts_));
}

}  // namespace luxodus

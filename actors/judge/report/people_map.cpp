#include "actors/judge/report/people_map.hpp"

#include <array>

#include "actors/judge/report/plan_parts.hpp"

namespace luxodus {

namespace {

/// Colours of cells by person-seconds without a sign read; they differ in lightness, too.
struct CellClass {
  double below_s;  // belongs to smaller values
  const char* colour;
  const char* text;  // key
};
constexpr std::array<CellClass, 5> cell_classes{{{1e-9, "#cfe3d4", "people.cell.always"},
                                                 {2, "#f6d98b", "people.cell.to_2"},
                                                 {10, "#e59a4c", "people.cell.to_10"},
                                                 {50, "#b04a3a", "people.cell.to_50"},
                                                 {1e300, "#4a1526", "people.cell.more"}}};

const CellClass& class_of(double unread_s) {
  for (const CellClass& one : cell_classes)
    if (unread_s < one.below_s) return one;
  return cell_classes.back();
}

}  // namespace

Plan people_map(const PlanLevel& level, const WalkedFloor& floor, double cell_m, const Texts& texts,
                const PlanSize& size) {
  Legend legend;
  for (const CellClass& one : cell_classes)
    legend.add(legend_square(one.colour), 3, texts(one.text));
  DrawnBox box(level);
  for (const WalkedCell& cell : floor.cells) {
    box.take(cell.corner);
    box.take(cell.corner + glm::dvec2(cell_m));
  }
  const Sheet sheet = box.sheet(size, legend);
  std::string cells;
  for (const WalkedCell& cell : floor.cells)
    cells += fmt::format(
        "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" fill=\"{}\" "
        "shape-rendering=\"crispEdges\"/>\n",
        sheet.x(cell.corner.x), sheet.y(cell.corner.y + cell_m), sheet.mm(cell_m), sheet.mm(cell_m),
        class_of(cell.unread_s).colour);
  return finished(sheet, legend, cells + building(level, sheet));
}

SvgPlot people_curve(const FollowedPeople& people, const Texts& texts) {
  SvgPlot plot;
  plot.title = texts("people.curve");
  plot.subtitle = texts.say("people.curve_of", people.scene, people.scenario, people.people.size());
  plot.height = 420;
  plot.label_x = texts("guided.time");
  plot.label_y = texts("people.share");
  PlotSeries read{.name = texts("people.read"), .x = {}, .y = {}, .error = {}, .markers = false};
  PlotSeries perhaps{
      .name = texts("people.perhaps"), .x = {}, .y = {}, .error = {}, .markers = false};
  for (const PeopleAtTime& point : people.curve) {
    if (point.present == 0) continue;
    const double all = static_cast<double>(point.present);
    read.x.push_back(point.time_s);
    read.y.push_back(100 * *point.reading_share());
    perhaps.x.push_back(point.time_s);
    perhaps.y.push_back(100 * static_cast<double>(point.reading + point.undecided) / all);
  }
  plot.series = {std::move(perhaps), std::move(read)};  // the last one is drawn on top
  return plot;
}

}  // namespace luxodus

// Section with a chart for each route and area, and its smallest, mean and largest illuminance.
#include "actors/judge/report/page.hpp"
#include "actors/judge/report/surface_chart.hpp"

namespace luxodus {

namespace {

/// Height of a chart on paper, so that two stand on a page.
constexpr double chart_mm = 92;

std::string grid_row(const Texts& t, const SurfaceGridRecord& grid) {
  const auto place = [&](const glm::dvec3& p) { return t.place(p.x, p.y, p.z); };
  const bool dark = !(grid.least > 0);
  return "<tr>" + cell(t.word("grid", grid.kind)) + number_cell(t, grid.points.size()) +
         number_cell(t, grid.least, "lx") + html_cell(escaped(place(grid.darkest)), "n") +
         number_cell(t, grid.mean, "lx") + number_cell(t, grid.most, "lx") +
         html_cell(escaped(place(grid.brightest)), "n") +
         (grid.mean > 0 ? fixed_cell(t, grid.least / grid.mean, 2) : no_number_cell()) +
         html_cell(dark ? "–" : "1\u00a0:\u00a0" + escaped(t.number(grid.most / grid.least)), "n") +
         "</tr>\n";
}

std::string surface_html(const PageParts& parts, const SurfaceRecord& surface) {
  const Texts& t = parts.texts;
  const SurfaceChart chart =
      surface_chart(parts.a, parts.schedule, t, surface, {parts.paper_width_mm, chart_mm});
  std::string note = t.say("surface.values", chart.values, chart.points);
  if (surface.in_bodies > 0) note += " " + t.say("surface.in_bodies", surface.in_bodies);
  std::string rows;
  for (const SurfaceGridRecord& grid : surface.grids) rows += grid_row(t, grid);
  return "<section class=\"surface\">\n" + subheading(t.subject(surface.subject)) +
         "<figure class=\"chart\">" + chart.plan.svg + "<figcaption>" + escaped(note) +
         "</figcaption></figure>\n" +
         table(t,
               {"column.grid", "column.points", "column.least", "column.least_at", "column.mean",
                "column.most", "column.most_at", "column.uniformity", "column.diversity"},
               {13, 7, 9, 17, 9, 9, 17, 9, 10}, rows) +
         "</section>\n";
}

}  // namespace

std::string surfaces_section(const PageParts& parts) {
  if (parts.a.surfaces.empty()) return "";
  std::string out = paragraph(parts.texts("surface.lead"));
  for (const SurfaceRecord& surface : parts.a.surfaces) out += surface_html(parts, surface);
  return out;
}

}  // namespace luxodus

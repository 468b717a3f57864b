// Sections with plans, signs and the bill of materials.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "actors/judge/report/page.hpp"
#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

namespace {

/// A plan on its own sheet, portrait or landscape, whichever shows it larger.
std::string plan_sheet(const PageParts& parts, const std::string& title, const std::string& note,
                       const Plan& plan) {
  const double width = parts.paper_width_mm;
  const bool across = plan.width_mm > width;
  return "<section class=\"" + std::string(across ? "wide" : "sheet") + "\">\n" +
         subheading(title) + "<figure class=\"plan\">" + plan.svg + "<figcaption>" + escaped(note) +
         "</figcaption></figure>\n</section>\n";
}

std::string sign_face(const Texts& t, const SignRecord& sign) {
  if (!sign.text.empty()) return "“" + sign.text + "”";
  return sign.file.empty() ? t("sign.plain") : sign.file;
}

/// "white 200 / green 20", or a dash of a sign that is lit from outside.
std::string luminances(const Texts& t, const SignRecord& sign) {
  std::string out;
  for (const FaceColourRecord& colour : sign.colours)
    if (colour.emergency_cd_m2)
      out += (out.empty() ? "" : " / ") + t.word("colour", colour.name) + " " +
             t.number(*colour.emergency_cd_m2);
  return out.empty() ? "–" : out;
}

std::string sign_row(const PageParts& parts, size_t number) {
  const Texts& t = parts.texts;
  const SignRecord& s = parts.a.signs[number];
  const glm::dvec3 &p = s.position, &f = s.facing;
  // Azimuth from +y towards +x, as on a compass, relative to the project's north.
  double bearing = std::atan2(f.x, f.y) * 180 / std::numbers::pi - parts.a.project.north_deg;
  bearing = std::fmod(bearing + 720, 360);
  return "<tr>" + html_cell("<b>" + std::to_string(number + 1) + "</b>", "n") + cell(s.name) +
         html_cell(breaking_at_slashes(sign_face(t, s))) +
         cell(t.word("lighting", s.lighting) + (s.double_sided ? t("sign.double_sided") : "")) +
         cell(t.fixed(s.width_m, 3) + " × " + t.fixed(s.height_m, 3)) +
         number_cell(t, 1000 * s.smallest_detail_m) + html_cell(escaped(luminances(t, s)), "n") +
         html_cell(escaped(t.place(p.x, p.y, p.z)) + "<br>" +
                   escaped(t.say("sign.height", t.fixed(parts.schedule.above_floor(s))))) +
         html_cell(t.fixed(bearing, 0) + "°", "n") + "</tr>\n";
}

std::string sign_schedule(const PageParts& parts) {
  std::string rows;
  for (size_t i = 0; i < parts.a.signs.size(); ++i) rows += sign_row(parts, i);
  if (rows.empty()) return paragraph(parts.texts("schedule.no_signs"));
  return table(parts.texts,
               {"column.number", "column.sign", "column.face", "column.lighting", "column.size",
                "column.detail", "column.sign_luminance", "column.position", "column.bearing"},
               {4, 14, 17, 14, 11, 10, 9, 15, 6}, rows) +
         paragraph(parts.texts("schedule.signs_note"), "note");
}

std::string bill_of_materials(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  const auto add = [&](const std::string& mark, const std::string& what, const std::string& kind,
                       size_t count) {
    rows += "<tr>" + html_cell("<b>" + escaped(mark) + "</b>") + cell(what) + cell(kind) +
            html_cell(std::to_string(count), "n") + "</tr>\n";
  };
  for (const LuminaireType& type : parts.schedule.types()) {
    const std::string product = product_of(*type.one);
    add(type.letter, product.empty() ? t.word("shape", type.one->shape) : product,
        t("subject.luminaire") + (", " + t.word("lamp", type.one->operation)), type.members.size());
  }
  for (const SignType& type : parts.schedule.sign_types()) {
    std::string numbers;
    for (const size_t i : type.members)
      numbers += (numbers.empty() ? "" : ", ") + std::to_string(i + 1);
    const SignRecord& s = *type.one;
    add(numbers,
        sign_face(t, s) + ", " + t.fixed(s.width_m, 3) + " × " + t.fixed(s.height_m, 3) + " m",
        t("subject.sign") + (", " + t.word("lighting", s.lighting)), type.members.size());
  }
  return table(t, {"column.mark", "column.item", "column.kind", "column.count"}, {16, 44, 30, 10},
               rows);
}

}  // namespace

std::string plans_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const auto& levels = parts.a.plan.levels;
  // Sized for a landscape sheet; a drawing that fits a portrait sheet is shown on one.
  const Plans plans(parts.a, parts.schedule, t, {parts.paper_height_mm, parts.paper_width_mm - 34});
  std::string out;
  for (size_t i = 0; i < levels.size(); ++i) {
    const std::string where =
        levels.size() > 1 ? t.say("plan.level", t.fixed(parts.schedule.floor(i))) + ": " : "";
    out += plan_sheet(parts, where + t("plan.installation"), t("plan.installation_note"),
                      plans.installation(i));
    const Plan isolux = plans.isolux(i, parts.grid_values);
    std::string note = isolux.svg.find("class=\"isolux\"") == std::string::npos
                           ? t("plan.isolux_none") + std::string(" ")
                           : std::string();
    note += t.say("plan.isolux_note", t.number(levels[i].map.spacing_m));
    if (parts.grid_values) note += " " + std::string(t("plan.values_note"));
    out += plan_sheet(parts, where + t("plan.isolux"), note, isolux);
  }
  return out;
}

std::string schedules_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  return subheading(t("schedule.signs")) + sign_schedule(parts) +
         subheading(t("schedule.materials")) + bill_of_materials(parts);
}

}  // namespace luxodus

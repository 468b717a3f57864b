// Sections with plans, schedules, and checks of routes and areas.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "actors/judge/report/page.hpp"
#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

namespace {

/// Lets a path in a narrow column break after a folder, but not before a file's extension.
std::string breaking_at_slashes(const std::string& path) {
  std::string out;
  for (const char c : escaped(path)) {
    out += c;
    if (c == '/') out += "<wbr>";
  }
  return out;
}

/// A plan on its own sheet, portrait or landscape, whichever shows it larger.
std::string plan_sheet(const PageParts& parts, const std::string& title, const std::string& note,
                       const Plan& plan) {
  const double width = parts.paper_width_mm;
  const bool across = plan.width_mm > width;
  return "<section class=\"" + std::string(across ? "wide" : "sheet") + "\">\n" +
         subheading(title) + "<figure class=\"plan\">" + plan.svg + "<figcaption>" + escaped(note) +
         "</figcaption></figure>\n</section>\n";
}

/// Coordinates of all members, with their names.
template <class Thing>
std::string coordinates(const PageParts& parts, const std::vector<Thing>& things,
                        const std::vector<size_t>& members) {
  std::string out;
  for (const size_t i : members) {
    const glm::dvec3& p = things[i].position;
    out += (out.empty() ? "" : "; ") + ("<b>" + escaped(things[i].name) + "</b> ") +
           escaped(parts.texts.place(p.x, p.y, p.z));
  }
  return out;
}

std::string opening_text(const Texts& texts, const LuminaireRecord& luminaire) {
  const auto& at = luminaire.opening_m;
  if (!at) return "";
  return texts.fixed((*at)[0], 2) + " × " + texts.fixed((*at)[1], 2) + " m";
}

std::string type_rows(const PageParts& parts, const LuminaireType& type) {
  const Texts& t = parts.texts;
  const LuminaireRecord& one = *type.one;
  const std::string product = product_of(one);
  std::string what =
      product.empty()
          ? escaped(t.word("shape", one.shape) + ", " + t.word("light", one.distribution))
          : escaped(product);
  if (!one.file.empty() && one.file != product)
    what += "<br><code>" + breaking_at_slashes(one.file) + "</code>";
  if (const std::string opening = opening_text(t, one); !opening.empty())
    what += "<br>" + escaped(t.say("lamp.opening", opening));
  const auto flux = [&](const QuantityRecord& q) {
    return q.value > 0 ? number_cell(t, q.value, q.unit, 4) : no_number_cell();
  };
  return "<tr class=\"lead\">" + html_cell("<b>" + type.letter + "</b>") + html_cell(what) +
         cell(t.word("lamp", one.operation)) + flux(one.mains_flux) + flux(one.emergency_flux) +
         number_cell(t, one.maintenance_factor) +
         (type.emergency() ? number_cell(t, one.end_of_duration_factor) : no_number_cell()) +
         html_cell("<b>" + std::to_string(type.members.size()) + "</b>", "n") +
         "</tr>\n<tr class=\"places\"><td></td><td colspan=\"7\">" +
         coordinates(parts, parts.a.luminaires, type.members) + "</td></tr>\n";
}

std::string luminaire_schedule(const PageParts& parts) {
  std::string rows;
  for (const LuminaireType& type : parts.schedule.types()) rows += type_rows(parts, type);
  if (rows.empty()) return paragraph(parts.texts("schedule.no_luminaires"));
  return table(parts.texts,
               {"column.type", "column.luminaire", "column.operation", "column.mains_flux",
                "column.emergency_flux", "column.maintenance", "column.duration", "column.count"},
               {5, 33, 17, 10, 10, 10, 8, 7}, rows, "schedule") +
         paragraph(parts.texts("schedule.luminaires_note"), "note");
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

std::string limit_text(const Texts& t, const Check& check) {
  if (!check.limit) return "–";
  const std::string unit = unit_text(t, check.unit);
  return std::string(check.at_least ? "≥\u00a0" : "≤\u00a0") + t.number(*check.limit) +
         (unit.empty() ? "" : "\u00a0" + unit);
}

std::string place_text(const Texts& t, const Check& check) {
  const auto& at = check.worst;
  return at ? t.place(at->x, at->y, at->z) : "–";
}

std::string check_row(const Texts& t, const Check& check, bool with_subject) {
  const std::string rule(name_of(check.rule.id));
  const std::optional<double> margin = check.margin();
  std::string what = escaped(t.rule_title(rule));
  if (with_subject) what = "<b>" + escaped(t.subject(check.subject)) + "</b><br>" + what;
  std::string notes = escaped(t.remarks(check.conditions));
  if (!check.reasons.empty())
    notes += (notes.empty() ? "" : "<br>") + remark_html(t, check.reasons);
  return "<tr>" + verdict_cell(t, "verdict", name_of(check.verdict)) +
         html_cell(what + " <span class=\"id\">" + escaped(rule) + "</span>") +
         number_cell(t, check.value, check.unit) + html_cell(escaped(limit_text(t, check)), "n") +
         html_cell(margin ? t.percent(*margin) : "–", "n") +
         html_cell(escaped(place_text(t, check)), "n") + html_cell(notes) + "</tr>\n";
}

constexpr const char* check_columns[] = {"column.verdict", "column.check",  "column.value",
                                         "column.limit",   "column.margin", "column.worst_at",
                                         "column.remark"};

std::string check_table(const PageParts& parts, const std::string& rows) {
  return table(parts.texts, {std::begin(check_columns), std::end(check_columns)},
               {13, 22, 11, 10, 8, 15, 21}, rows, "checks");
}

/// A row for each check under a heading for each subject, in the order of their first checks.
/// `places`: routes and areas only, else all other subjects.
std::string rows_by_subject(const PageParts& parts, bool places) {
  std::vector<Subject> subjects;
  for (const CheckRecord& check : parts.a.checks) {
    if (std::find(subjects.begin(), subjects.end(), check.subject) == subjects.end())
      subjects.push_back(check.subject);
  }
  std::string rows;
  for (const Subject& subject : subjects) {
    if (subject.is_place() != places) continue;
    rows += heading_row(escaped(parts.texts.subject(subject)), std::size(check_columns));
    for (const CheckRecord& check : parts.a.checks)
      if (check.subject == subject) rows += check_row(parts.texts, check, false);
  }
  return rows;
}

/// Findings of the inspection are in English in every language.
std::string warning_html(const Texts& t, const WarningRecord& warning) {
  if (!warning.remark)
    return (t.language() == Language::en ? "<i>" : "<i lang=\"en\">") + escaped(warning.text) +
           "</i>";
  const SourcePlace place{warning.file, warning.line};
  return "<i>" + escaped(problem_in(place, t.remark(*warning.remark)).text()) + "</i>";
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
  return subheading(t("schedule.luminaires")) + luminaire_schedule(parts) +
         subheading(t("schedule.signs")) + sign_schedule(parts) +
         subheading(t("schedule.materials")) + bill_of_materials(parts);
}

std::string places_section(const PageParts& parts) {
  const std::string rows = rows_by_subject(parts, true);
  if (rows.empty()) return paragraph(parts.texts("places.none"));
  return paragraph(parts.texts("places.lead")) + check_table(parts, rows);
}

std::string other_checks_appendix(const PageParts& parts) {
  return check_table(parts, rows_by_subject(parts, false));
}

std::string verdict_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string fails, unverified;
  for (const CheckRecord& check : parts.a.checks) {
    if (check.verdict == CheckVerdict::fail) fails += check_row(t, check, true);
    if (check.verdict == CheckVerdict::not_verified) unverified += check_row(t, check, true);
  }
  std::string out = subheading(t("verdict.fails"));
  out += fails.empty() ? paragraph(t("verdict.nothing_fails")) : check_table(parts, fails);
  if (!unverified.empty())
    out += subheading(t("verdict.unverified_checks")) + check_table(parts, unverified);
  if (!parts.a.warnings.empty()) {
    out += subheading(t("verdict.warnings")) + "<ul>\n";
    for (const WarningRecord& warning : parts.a.warnings)
      out += "<li>" + warning_html(t, warning) + "</li>\n";
    out += "</ul>\n";
  }
  return out + paragraph(t("verdict.remarks_english"), "note");
}

}  // namespace luxodus

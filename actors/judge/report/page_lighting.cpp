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
std::string coordinates(const PageParts& parts, const Json& things,
                        const std::vector<size_t>& members) {
  std::string out;
  for (const size_t i : members) {
    const Json& p = things[i]["position"];
    out += (out.empty() ? "" : "; ") + ("<b>" + escaped(text_in(things[i], "name")) + "</b> ") +
           escaped(parts.texts.place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>()));
  }
  return out;
}

std::string opening_text(const Texts& texts, const Json& luminaire) {
  const auto at = luminaire.find("opening_m");
  if (at == luminaire.end()) return "";
  return texts.fixed((*at)[0].get<double>(), 2) + " × " + texts.fixed((*at)[1].get<double>(), 2) +
         " m";
}

std::string type_rows(const PageParts& parts, const LuminaireType& type) {
  const Texts& t = parts.texts;
  const Json& one = *type.one;
  const std::string product = product_of(one);
  std::string what = product.empty() ? escaped(t.word("shape", text_in(one, "shape")) + ", " +
                                               t.word("light", text_in(one, "distribution")))
                                     : escaped(product);
  if (const std::string file = text_in(one, "file"); !file.empty() && file != product)
    what += "<br><code>" + breaking_at_slashes(file) + "</code>";
  if (const std::string opening = opening_text(t, one); !opening.empty())
    what += "<br>" + escaped(t.say("lamp.opening", opening));
  const auto flux = [&](const char* key) {
    const Json& value = one[key]["value"];
    return value.get<double>() > 0 ? number_cell(t, value, text_in(one[key], "unit"), 4)
                                   : html_cell("–", "n");
  };
  const auto factor = [&](const char* key) {
    return type.emergency() || std::string(key) == "maintenance_factor" ? number_cell(t, one[key])
                                                                        : html_cell("–", "n");
  };
  return "<tr class=\"lead\">" + html_cell("<b>" + type.letter + "</b>") + html_cell(what) +
         cell(t.word("lamp", text_in(one, "operation"))) + flux("mains_flux") +
         flux("emergency_flux") + factor("maintenance_factor") + factor("end_of_duration_factor") +
         html_cell("<b>" + std::to_string(type.members.size()) + "</b>", "n") +
         "</tr>\n<tr class=\"places\"><td></td><td colspan=\"7\">" +
         coordinates(parts, parts.a["luminaires"], type.members) + "</td></tr>\n";
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

std::string sign_face(const Texts& t, const Json& sign) {
  if (const std::string text = text_in(sign, "text"); !text.empty()) return "“" + text + "”";
  if (const std::string file = text_in(sign, "file"); !file.empty()) return file;
  return t("sign.plain");
}

std::string sign_row(const PageParts& parts, size_t number) {
  const Texts& t = parts.texts;
  const Json& s = parts.a["signs"][number];
  const auto length = [&](const char* key) { return t.fixed(s[key]["value"].get<double>(), 3); };
  const Json &p = s["position"], &f = s["facing"];
  // Azimuth from +y towards +x, as on a compass, relative to the project's north.
  double bearing = std::atan2(f[0].get<double>(), f[1].get<double>()) * 180 / std::numbers::pi -
                   parts.a["project"]["north_deg"].get<double>();
  bearing = std::fmod(bearing + 720, 360);
  std::string luminance = "–";
  if (s.contains("emergency_white"))
    luminance = t.number(s["emergency_white"]["value"].get<double>()) + " / " +
                t.number(s["emergency_green"]["value"].get<double>());
  return "<tr>" + html_cell("<b>" + std::to_string(number + 1) + "</b>", "n") +
         cell(text_in(s, "name")) + html_cell(breaking_at_slashes(sign_face(t, s))) +
         cell(t.word("lighting", text_in(s, "lighting")) +
              (s["double_sided"].get<bool>() ? t("sign.double_sided") : "")) +
         cell(length("width") + " × " + length("height")) +
         number_cell(t, Json(1000 * s["smallest_detail"]["value"].get<double>())) +
         html_cell(escaped(luminance), "n") +
         html_cell(escaped(t.place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>())) +
                   "<br>" +
                   escaped(t.say("sign.height",
                                 t.fixed(parts.schedule.above_floor(p[2].get<double>()))))) +
         html_cell(t.fixed(bearing, 0) + "°", "n") + "</tr>\n";
}

std::string sign_schedule(const PageParts& parts) {
  std::string rows;
  for (size_t i = 0; i < parts.a["signs"].size(); ++i) rows += sign_row(parts, i);
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
    add(type.letter, product.empty() ? t.word("shape", text_in(*type.one, "shape")) : product,
        t("subject.luminaire") + (", " + t.word("lamp", text_in(*type.one, "operation"))),
        type.members.size());
  }
  for (const SignType& type : parts.schedule.sign_types()) {
    std::string numbers;
    for (const size_t i : type.members)
      numbers += (numbers.empty() ? "" : ", ") + std::to_string(i + 1);
    const Json& s = *type.one;
    add(numbers,
        sign_face(t, s) + ", " + t.fixed(s["width"]["value"].get<double>(), 3) + " × " +
            t.fixed(s["height"]["value"].get<double>(), 3) + " m",
        t("subject.sign") + (", " + t.word("lighting", text_in(s, "lighting"))),
        type.members.size());
  }
  return table(t, {"column.mark", "column.item", "column.kind", "column.count"}, {16, 44, 30, 10},
               rows);
}

std::string limit_text(const Texts& t, const Json& check) {
  if (!check["limit"].is_number()) return "–";
  const std::string unit = unit_text(t, text_in(check, "unit"));
  return std::string(text_in(check, "sense") == "at least" ? "≥\u00a0" : "≤\u00a0") +
         t.number(check["limit"].get<double>()) + (unit.empty() ? "" : "\u00a0" + unit);
}

std::string place_text(const Texts& t, const Json& check) {
  const auto at = check.find("worst_place");
  return at == check.end()
             ? "–"
             : t.place((*at)[0].get<double>(), (*at)[1].get<double>(), (*at)[2].get<double>());
}

std::string check_row(const Texts& t, const Json& check, bool with_subject) {
  std::string what = escaped(t.rule_title(text_in(check, "rule")));
  if (with_subject) what = "<b>" + escaped(subject_text(t, check["subject"])) + "</b><br>" + what;
  std::string notes = escaped(said(t, check["conditions"]));
  if (check.contains("reasons"))
    notes += (notes.empty() ? "" : "<br>") + remark_html(t, check["reasons"]);
  return "<tr>" + verdict_cell(t, "verdict", text_in(check, "verdict")) +
         html_cell(what + " <span class=\"id\">" + escaped(text_in(check, "rule")) + "</span>") +
         number_cell(t, check["value"], text_in(check, "unit")) +
         html_cell(escaped(limit_text(t, check)), "n") +
         html_cell(check["margin"].is_number() ? t.percent(check["margin"].get<double>()) : "–",
                   "n") +
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
  for (const Json& check : parts.a["checks"]) {
    const Subject subject = read_subject(check["subject"]).value();
    if (std::find(subjects.begin(), subjects.end(), subject) == subjects.end())
      subjects.push_back(subject);
  }
  std::string rows;
  for (const Subject& subject : subjects) {
    if (subject.is_place() != places) continue;
    rows += heading_row(escaped(parts.texts.subject(subject)), std::size(check_columns));
    for (const Json& check : parts.a["checks"])
      if (read_subject(check["subject"]).value() == subject)
        rows += check_row(parts.texts, check, false);
  }
  return rows;
}

/// Findings of the inspection are in English in every language.
std::string warning_html(const Texts& t, const Json& warning) {
  if (warning["remark"].is_null())
    return (t.language() == Language::en ? "<i>" : "<i lang=\"en\">") +
           escaped(text_in(warning, "text")) + "</i>";
  const SourcePlace place{text_in(warning, "file"), warning["line"].get<int>()};
  return "<i>" + escaped(problem_in(place, said(t, warning["remark"])).text()) + "</i>";
}

}  // namespace

std::string plans_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json& levels = parts.a["plan"]["levels"];
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
    note += t.say("plan.isolux_note", t.number(levels[i]["map"]["spacing"].get<double>()));
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
  for (const Json& check : parts.a["checks"]) {
    const std::string verdict = text_in(check, "verdict");
    if (verdict == "fail") fails += check_row(t, check, true);
    if (verdict == "not verified") unverified += check_row(t, check, true);
  }
  std::string out = subheading(t("verdict.fails"));
  out += fails.empty() ? paragraph(t("verdict.nothing_fails")) : check_table(parts, fails);
  if (!unverified.empty())
    out += subheading(t("verdict.unverified_checks")) + check_table(parts, unverified);
  if (!parts.a["warnings"].empty()) {
    out += subheading(t("verdict.warnings")) + "<ul>\n";
    for (const Json& warning : parts.a["warnings"])
      out += "<li>" + warning_html(t, warning) + "</li>\n";
    out += "</ul>\n";
  }
  return out + paragraph(t("verdict.remarks_english"), "note");
}

}  // namespace luxodus

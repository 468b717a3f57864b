#include "actors/judge/report/html.hpp"

#include <algorithm>
#include <iterator>

#include "actors/judge/report/plan_svg.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Columns whose cells stand to the right; so do their heads.
bool numeric(std::string_view column) {
  constexpr std::string_view keys[] = {"column.mains_flux",
                                       "column.emergency_flux",
                                       "column.maintenance",
                                       "column.duration",
                                       "column.count",
                                       "column.number",
                                       "column.detail",
                                       "column.sign_luminance",
                                       "column.bearing",
                                       "column.value",
                                       "column.limit",
                                       "column.margin",
                                       "column.worst_at",
                                       "column.eye_height",
                                       "column.distance",
                                       "column.reading_level",
                                       "column.luminances",
                                       "column.transmission",
                                       "column.reflectance",
                                       "column.specular",
                                       "column.internal_transmittance",
                                       "column.ior",
                                       "column.surfaces",
                                       "column.heights",
                                       "column.extinction",
                                       "column.wavelength",
                                       "column.angstrom",
                                       "column.albedo",
                                       "column.asymmetry",
                                       "column.flame",
                                       "design.x",
                                       "design.y",
                                       "design.z",
                                       "design.turn",
                                       "design.cost",
                                       "design.watts",
                                       "design.least"};
  return column.starts_with("sight.") ||
         std::find(std::begin(keys), std::end(keys), column) != std::end(keys);
}

}  // namespace

std::string escaped(const std::string& text) {
  return xml_escape(text);
}

std::string cell(const std::string& text) {
  return "<td>" + escaped(text) + "</td>";
}

std::string html_cell(const std::string& html, const char* css_class) {
  return (*css_class == '\0' ? std::string("<td>")
                             : "<td class=\"" + std::string(css_class) + "\">") +
         html + "</td>";
}

std::string unit_text(const Texts& texts, const std::string& unit) {
  if (unit == "1") return "";
  std::string out = texts.remark(unit).value_or(unit);
  for (const auto& [plain, raised] : {std::pair{"m2", "m²"}, std::pair{"m3", "m³"}})
    if (const size_t at = out.find(plain); at != std::string::npos) out.replace(at, 2, raised);
  if (out == "deg") return "°";
  return out;
}

std::string number_cell(const Texts& texts, const Json& value, const std::string& unit,
                        int digits) {
  if (!value.is_number()) return html_cell("–", "n");
  const std::string shown = unit_text(texts, unit);
  return html_cell(escaped(texts.number(value.get<double>(), digits)) +
                       (shown.empty() ? "" : "\u00a0" + escaped(shown)),
                   "n");
}

std::string fixed_cell(const Texts& texts, double value, int decimals) {
  return html_cell(texts.fixed(value, decimals), "n");
}

std::string verdict_mark(const Texts& texts, const char* list, const std::string& verdict) {
  return "<span class=\"v\" style=\"color:" + std::string(verdict_colour(verdict)) +
         "\"><svg class=\"mark\" viewBox=\"-1.2 -1.2 2.4 2.4\" aria-hidden=\"true\">" +
         verdict_shape(verdict, 0, 0, 1) + "</svg>" + escaped(texts.word(list, verdict)) +
         "</span>";
}

std::string verdict_cell(const Texts& texts, const char* list, const std::string& verdict) {
  return html_cell(verdict_mark(texts, list, verdict));
}

std::string table(const Texts& texts, const std::vector<const char*>& columns,
                  const std::vector<int>& widths, const std::string& rows, const char* css_class) {
  if (rows.empty()) return "";
  std::string out = "<table class=\"" + std::string(css_class) + "\">\n<colgroup>";
  for (const int width : widths) out += fmt::format("<col style=\"width:{}%\">", width);
  out += "</colgroup>\n<thead><tr>";
  for (const char* column : columns)
    out += (numeric(column) ? "<th class=\"n\">" : "<th>") +
           (*column == '\0' ? "" : escaped(texts(column))) + "</th>";
  return out + "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table>\n";
}

std::string heading_row(const std::string& html, size_t columns) {
  return fmt::format("<tr class=\"group\"><th colspan=\"{}\">{}</th></tr>\n", columns, html);
}

std::string paragraph(const std::string& text, const char* css_class) {
  return (*css_class == '\0' ? std::string("<p>")
                             : "<p class=\"" + std::string(css_class) + "\">") +
         escaped(text) + "</p>\n";
}

std::string figure(const std::string& html, const std::string& caption) {
  return "<figure>" + html + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string subheading(const std::string& text) {
  return "<h3>" + escaped(text) + "</h3>\n";
}

std::string remark(const Texts& texts, const std::string& text) {
  if (text.empty()) return "";
  const auto said = texts.remark(text);
  return said ? "<i>" + escaped(*said) + "</i>" : "<i lang=\"en\">" + escaped(text) + "</i>";
}

std::string subject_text(const Texts& texts, const std::string& subject) {
  // A point of emphasis: its name, and its kind in brackets.
  const size_t bracket = subject.rfind(" (");
  if (subject.starts_with('"') && subject.ends_with(')') && bracket != std::string::npos) {
    const std::string kind = subject.substr(bracket + 2, subject.size() - bracket - 3);
    return subject.substr(0, bracket + 2) + texts.word("emphasis", kind) + ")";
  }
  const size_t quote = subject.find(" \"");
  if (quote == std::string::npos) return texts.word("subject", subject);
  return texts.word("subject", subject.substr(0, quote)) + subject.substr(quote);
}

std::string condition_text(const Texts& texts, const std::string& condition) {
  constexpr std::string_view failed = "\" has failed";
  std::string out;
  for (size_t from = 0; from < condition.size();) {
    const size_t to = std::min(condition.find("; ", from), condition.size());
    const std::string piece = condition.substr(from, to - from);
    if (!out.empty()) out += "; ";
    if (piece.size() > failed.size() && piece.front() == '"' && piece.ends_with(failed))
      out += texts.say("condition.failed", piece.substr(1, piece.size() - 1 - failed.size()));
    else
      out += texts.remark(texts.word("condition", piece)).value_or(texts.word("condition", piece));
    from = to + 2;
  }
  return out;
}

std::string rule_title(const Texts& texts, const Json& check) {
  const ReportText* row = find_text("rule." + text_in(check, "rule"));
  return texts.language() == Language::en || row == nullptr
             ? text_in(check, "title")
             : texts(std::string_view("rule." + text_in(check, "rule")));
}

std::string source_status(const Json& check) {
  const std::string source = text_in(check, "quoted_from");
  if (source.empty()) return "none";
  if (source.starts_with("recollection")) return "recollection";
  return source.starts_with("the standard") ? "verified" : "secondary";
}

}  // namespace luxodus

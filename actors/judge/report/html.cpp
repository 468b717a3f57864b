#include "actors/judge/report/html.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "actors/judge/report/plan_svg.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Columns whose cells and heads are right-aligned.
bool numeric(std::string_view column) {
  constexpr std::string_view keys[] = {"column.mains_flux",
                                       "column.emergency_flux",
                                       "column.maintenance",
                                       "column.duration",
                                       "column.count",
                                       "column.without",
                                       "column.with",
                                       "column.area",
                                       "column.emergency",
                                       "column.mains",
                                       "column.signs",
                                       "column.points",
                                       "column.least",
                                       "column.least_at",
                                       "column.mean",
                                       "column.most",
                                       "column.most_at",
                                       "column.uniformity",
                                       "column.diversity",
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

/// The longest piece of a text that no line break divides, in characters.
size_t longest_piece(const std::string& text) {
  size_t longest = 0, here = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool soft_hyphen = text.compare(i, 2, "\u00ad") == 0;
    if (text[i] == ' ' || soft_hyphen) {
      longest = std::max(longest, here + soft_hyphen);  // the hyphen that is then drawn
      here = 0;
      i += soft_hyphen;
      continue;
    }
    here += (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (text[i] == '-') longest = std::max(longest, here), here = 0;
  }
  return std::max(longest, here);
}

/// Widens columns whose head would break within a word, at the cost of the others [%].
std::vector<double> fitting_widths(const Texts& texts, const std::vector<const char*>& columns,
                                   const std::vector<int>& widths) {
  // Heads are bold, 7.2 pt: 1.6 mm a letter and 2.8 mm of padding on a page of 180 mm.
  constexpr double letter_share = 100 * 1.6 / 180, padding_share = 100 * 2.8 / 180;
  std::vector<double> needed, out(widths.begin(), widths.end());
  double sum = 0, slack = 0;
  for (const double width : out) sum += width;
  for (size_t i = 0; i < out.size(); ++i) {
    const std::string head = *columns[i] == '\0' ? "" : texts(columns[i]);
    needed.push_back(letter_share * static_cast<double>(longest_piece(head)) + padding_share);
    out[i] *= 100 / sum;
    slack += std::max(0.0, out[i] - needed[i]);
  }
  double missing = 0;
  for (size_t i = 0; i < out.size(); ++i) missing += std::max(0.0, needed[i] - out[i]);
  if (missing > slack) return out;
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = out[i] < needed[i] ? needed[i]
                                : out[i] - missing / std::max(slack, 1e-9) * (out[i] - needed[i]);
  return out;
}

}  // namespace

std::string escaped(const std::string& text) {
  return xml_escape(text);
}

std::string breaking_at_slashes(const std::string& path) {
  std::string out;
  for (const char c : escaped(path)) {
    out += c;
    if (c == '/') out += "<wbr>";
  }
  return out;
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
  std::string out = texts.word("unit", unit);
  for (const auto& [plain, raised] : {std::pair{"m2", "m²"}, std::pair{"m3", "m³"}})
    if (const size_t at = out.find(plain); at != std::string::npos) out.replace(at, 2, raised);
  if (out == "deg") return "°";
  return out;
}

std::string no_number_cell() {
  return html_cell("–", "n");
}

std::string number_cell(const Texts& texts, double value, const std::string& unit, int digits) {
  if (!std::isfinite(value)) return no_number_cell();
  const std::string shown = unit_text(texts, unit);
  return html_cell(
      escaped(texts.number(value, digits)) + (shown.empty() ? "" : "\u00a0" + escaped(shown)), "n");
}

std::string number_cell(const Texts& texts, const std::optional<double>& value,
                        const std::string& unit, int digits) {
  return value ? number_cell(texts, *value, unit, digits) : no_number_cell();
}

std::string number_cell(const Texts& texts, size_t count, const std::string& unit, int digits) {
  return number_cell(texts, static_cast<double>(count), unit, digits);
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

std::string count_chips(const Texts& texts, const CountsRecord& counts) {
  std::string out;
  for (const auto& [count, verdict] :
       {std::pair(counts.pass, CheckVerdict::pass), std::pair(counts.fail, CheckVerdict::fail),
        std::pair(counts.not_assessed, CheckVerdict::not_assessed),
        std::pair(counts.not_verified, CheckVerdict::not_verified)})
    out += "<span>" + std::to_string(count) + " " +
           verdict_mark(texts, "verdict", name_of(verdict)) + "</span>\n";
  return out;
}

std::string table(const Texts& texts, const std::vector<const char*>& columns,
                  const std::vector<int>& widths, const std::string& rows, const char* css_class) {
  if (rows.empty()) return "";
  std::string out = "<table class=\"" + std::string(css_class) + "\">\n<colgroup>";
  for (const double width : fitting_widths(texts, columns, widths))
    out += fmt::format("<col style=\"width:{:.1f}%\">", width);
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

std::string remark_html(const Texts& texts, const Remark& remark) {
  return remark_html(texts, Remarks{remark});
}

std::string remark_html(const Texts& texts, const Remarks& remarks) {
  const std::string words = texts.remarks(remarks);
  return words.empty() ? "" : "<i>" + escaped(words) + "</i>";
}

std::string source_status(const Rule& rule) {
  if (rule.sources.empty()) return "none";
  return rule.recollected() ? "recollection" : "secondary";
}

}  // namespace luxodus

// Section with luminaires: the schedule by type, and a sheet for each product with its data, body,
// polar curves and spacing table.
#include <algorithm>
#include <set>

#include "actors/judge/report/luminaire_drawing.hpp"
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

std::string opening_text(const Texts& texts, const LuminaireRecord& luminaire) {
  const auto& at = luminaire.opening_m;
  if (!at) return "";
  return texts.fixed((*at)[0], 2) + " × " + texts.fixed((*at)[1], 2) + " m";
}

/// Coordinates of all members, with their names.
std::string coordinates(const PageParts& parts, const std::vector<size_t>& members) {
  std::string out;
  for (const size_t i : members) {
    const LuminaireRecord& one = parts.a.luminaires[i];
    const glm::dvec3& p = one.position;
    out += (out.empty() ? "" : "; ") + ("<b>" + escaped(one.name) + "</b> ") +
           escaped(parts.texts.place(p.x, p.y, p.z));
  }
  return out;
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
         (type.emergency() ? coordinates(parts, type.members)
                           : escaped(t("schedule.places_in_csv"))) +
         "</td></tr>\n";
}

std::string luminaire_schedule(const PageParts& parts) {
  std::string rows;
  for (const LuminaireType& type : parts.schedule.types()) rows += type_rows(parts, type);
  if (rows.empty()) return paragraph(parts.texts("schedule.no_luminaires"));
  return table(parts.texts,
               {"column.type", "column.luminaire", "column.operation", "column.mains_flux",
                "column.emergency_flux", "column.maintenance", "column.duration", "column.count"},
               {6, 27, 15, 11, 12, 10, 11, 8}, rows, "schedule") +
         paragraph(parts.texts("schedule.luminaires_note"), "note");
}

/// Rows of a sheet: name and value; a value that is not stated is said as such.
class SheetFacts {
 public:
  explicit SheetFacts(const Texts& texts) : texts_(texts) {}
  void add(const char* key, const std::string& value) {
    rows_ +=
        "<tr><th scope=\"row\">" + escaped(texts_(key)) + "</th><td>" +
        (value.empty() ? "<i>" + escaped(texts_("sheet.not_stated")) + "</i>" : escaped(value)) +
        "</td></tr>\n";
  }
  std::string table() const {
    return "<table class=\"facts\"><tbody>\n" + rows_ + "</tbody></table>\n";
  }

 private:
  const Texts& texts_;
  std::string rows_;
};

std::string with_unit(const Texts& t, const std::optional<double>& value, const char* unit) {
  return value ? t.number(*value, 4) + "\u00a0" + unit : "";
}

std::string flux_text(const Texts& t, const QuantityRecord& flux) {
  return flux.value > 0 ? t.number(flux.value, 4) + "\u00a0" + flux.unit : t("sheet.off");
}

std::string sheet_facts(const PageParts& parts, const LuminaireType& type,
                        const SheetRecord& sheet) {
  const Texts& t = parts.texts;
  const LuminaireRecord& one = *type.one;
  SheetFacts facts(t);
  facts.add("sheet.maker", sheet.maker);
  facts.add("sheet.article", sheet.article);
  facts.add("column.operation", t.word("lamp", one.operation));
  facts.add("sheet.mains_flux", flux_text(t, one.mains_flux));
  if (type.emergency()) {
    facts.add("sheet.emergency_flux", flux_text(t, one.emergency_flux));
    facts.add("sheet.duration", with_unit(t, sheet.duration_h, "h"));
    facts.add("sheet.battery", sheet.battery);
  } else {
    facts.add("sheet.emergency_flux", t("sheet.off"));
  }
  facts.add("sheet.watts", with_unit(t, sheet.watts, "W"));
  facts.add("sheet.factors",
            t.say("sheet.maintenance", t.number(one.maintenance_factor)) +
                (type.emergency()
                     ? ", " + t.say("sheet.end_of_duration", t.number(one.end_of_duration_factor))
                     : ""));
  facts.add("column.count", std::to_string(type.members.size()));
  return facts.table();
}

std::string spacing_cells(const Texts& t, const std::optional<RowSpacingRecord>& spacing) {
  if (!spacing) return no_number_cell() + no_number_cell();
  return fixed_cell(t, spacing->to_wall_m, 2) + fixed_cell(t, spacing->between_m, 2);
}

/// Rows by height and life; columns by plane, level, and to the wall or between.
std::string spacing_table(const Texts& t, const SheetRecord& sheet) {
  std::vector<double> levels;
  for (const SpacingRowRecord& row : sheet.spacing)
    if (std::find(levels.begin(), levels.end(), row.level_lx) == levels.end())
      levels.push_back(row.level_lx);
  std::string plane_heads, level_heads, ends;
  for (const char* plane : {"spacing.along", "spacing.across"}) {
    plane_heads +=
        fmt::format("<th class=\"c\" colspan=\"{}\">{}</th>", 2 * levels.size(), escaped(t(plane)));
    for (const double level : levels) {
      level_heads += "<th class=\"c\" colspan=\"2\">" + escaped(t.number(level)) + " lx</th>";
      ends += "<th class=\"n\">" + escaped(t("spacing.wall")) + "</th><th class=\"n\">" +
              escaped(t("spacing.between")) + "</th>";
    }
  }
  std::string rows;
  for (size_t from = 0; from < sheet.spacing.size(); from += levels.size()) {
    const SpacingRowRecord& first = sheet.spacing[from];
    rows += "<tr>" + fixed_cell(t, first.height_m, 2) + number_cell(t, first.factor);
    for (const auto plane : {&SpacingRowRecord::along, &SpacingRowRecord::across})
      for (size_t i = from; i < std::min(from + levels.size(), sheet.spacing.size()); ++i)
        rows += spacing_cells(t, sheet.spacing[i].*plane);
    rows += "</tr>\n";
  }
  return "<table class=\"spacing\">\n<thead><tr><th class=\"n\" rowspan=\"3\">" +
         escaped(t("spacing.height")) + "</th><th class=\"n\" rowspan=\"3\">" +
         escaped(t("spacing.factor")) + "</th>" + plane_heads + "</tr><tr>" + level_heads +
         "</tr><tr>" + ends + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string sheet_html(const PageParts& parts, const LuminaireType& type) {
  const Texts& t = parts.texts;
  const SheetRecord& sheet = parts.a.sheets[type.one->sheet];
  const std::string product = product_of(*type.one);
  const std::string body = body_svg(*type.one, sheet, t), polar = polar_svg(sheet, t);
  std::string out = "<section class=\"product\">\n<h4>" + escaped(type.letter) + " · " +
                    escaped(product.empty() ? t.word("shape", type.one->shape) : product) +
                    "</h4>\n<div class=\"product\"><div class=\"drawings\">" +
                    (body.empty() ? paragraph(t("sheet.no_body"), "note") : body) +
                    (polar.empty() ? paragraph(t("sheet.no_curve"), "note") : polar) + "</div>" +
                    sheet_facts(parts, type, sheet) + "</div>\n";
  if (!sheet.spacing.empty())
    out += spacing_table(t, sheet);
  else if (type.emergency())
    out += paragraph(t("sheet.no_spacing"), "note");
  return out + "</section>\n";
}

}  // namespace

std::string luminaires_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string out = subheading(t("schedule.luminaires")) + luminaire_schedule(parts);
  const auto& types = parts.schedule.types();
  if (types.empty()) return out;
  out += subheading(t("sheet.heading")) + paragraph(t("sheet.lead"), "note");
  std::set<size_t> done;  // types may differ in what no sheet shows
  for (const LuminaireType& type : types)
    if (done.insert(type.one->sheet).second) out += sheet_html(parts, type);
  return out;
}

}  // namespace luxodus

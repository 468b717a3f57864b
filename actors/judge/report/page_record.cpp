// The record of an assessment: inputs, clauses, what was not assessed, method and sources.
#include <algorithm>
#include <map>

#include "actors/judge/report/page.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// A table of two columns: name, and value as HTML.
class Facts {
 public:
  explicit Facts(const Texts& texts) : texts_(texts) {}
  void add(const char* key, const std::string& text) { add_html(key, escaped(text)); }
  void add_html(const char* key, const std::string& html) {
    if (!html.empty())
      rows_ +=
          "<tr><th scope=\"row\">" + escaped(texts_(key)) + "</th><td>" + html + "</td></tr>\n";
  }
  std::string table() const {
    return "<table class=\"facts\">\n<colgroup><col style=\"width:26%\"><col "
           "style=\"width:74%\"></colgroup><tbody>\n" +
           rows_ + "</tbody></table>\n";
  }

 private:
  const Texts& texts_;
  std::string rows_;
};

std::string list_text(const Json& list) {
  std::string out;
  for (const Json& one : list)
    out += (out.empty() ? "" : ", ") + (one.is_string() ? one.get<std::string>() : std::string());
  return out;
}

std::string extinction_text(const Texts& t, const Json& low, const Json& high,
                            const std::string& unit) {
  if (!low.is_number() || !high.is_number()) return "";
  const double a = low.get<double>(), b = high.get<double>();
  return (a == b ? t.number(a) : t.number(a) + "–" + t.number(b)) + " " + unit;
}

std::string smoke_html(const Texts& t, const Json& smoke) {
  if (!smoke.is_object() || smoke["media"].empty()) return escaped(t("state.no_smoke"));
  std::string out;
  if (const Json& k = smoke["extinction"]; k.is_object())
    out = "<b>" + escaped(extinction_text(t, k["min"], k["max"], text_in(k, "unit"))) + "</b>" +
          (k.contains("wavelength_nm") && k["wavelength_nm"].is_number()
               ? escaped(t.say("state.at_wavelength", t.number(k["wavelength_nm"].get<double>())))
               : "");
  for (const Json& medium : smoke["media"]) {
    out += "<br>" + escaped(text_in(medium, "name")) + ": " +
           escaped(extinction_text(t, medium["extinction_min"], medium["extinction_max"], "1/m"));
    std::string source = escaped(text_in(medium, "place"));
    for (const Json& note : medium["notes"]) source += ", " + escaped(said(t, note));
    if (!source.empty()) out += " (<i>" + source + "</i>)";
  }
  return out;
}

/// Rule sets or deviations: edition, id, requirement and status.
std::string rules_html(const Texts& t, const Json& rules) {
  std::string out;
  for (const Json& rule : rules) {
    out += (out.empty() ? "<b>" : "<br><b>") + escaped(text_in(rule, "edition")) + "</b> (" +
           escaped(text_in(rule, "id")) + ")";
    for (const char* key : {"what", "status"})
      if (const std::string text = remark_html(t, rule[key]); !text.empty()) out += ": " + text;
  }
  return out;
}

std::string factor_text(const PageParts& parts, const Json& factors) {
  std::string out;
  for (const Json& f : factors)
    out += (out.empty() ? "" : "; ") + text_in(f, "name") + " × " +
           parts.texts.number(f["factor"].get<double>());
  return out;
}

std::string materials_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  const auto share = [&](const Json& m, const char* key) {
    const auto at = m.find(key);
    return at == m.end() ? html_cell("–", "n") : number_cell(t, *at, "", 2);
  };
  for (const Json& m : parts.a["materials"]) {
    rows += "<tr>" + cell(text_in(m, "name")) + cell(t.word("material", text_in(m, "kind")));
    for (const char* key : {"reflectance", "specular", "transmittance", "ior"})
      rows += share(m, key);
    rows += html_cell(std::to_string(m["objects"].get<int64_t>()), "n") + "</tr>\n";
  }
  return table(t,
               {"column.material", "column.kind", "column.reflectance", "column.specular",
                "column.internal_transmittance", "column.ior", "column.surfaces"},
               {26, 16, 12, 12, 14, 10, 10}, rows);
}

std::string media_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const Json& medium : parts.a["media"])
    for (const Json& layer : medium["layers"]) {
      const bool first = &layer == &medium["layers"].front();
      std::string height = "–";
      if (layer.contains("z_low"))
        height =
            t.fixed(layer["z_low"].get<double>()) + "–" + t.fixed(layer["z_high"].get<double>());
      rows += "<tr>" + cell(first ? text_in(medium, "name") : "") +
              cell(first ? t.word("medium", text_in(medium, "kind")) : "") +
              html_cell(escaped(height), "n") +
              number_cell(t, layer["extinction"]["value"], text_in(layer["extinction"], "unit")) +
              number_cell(t, layer["wavelength"]["value"]) + number_cell(t, layer["angstrom"]) +
              number_cell(t, layer["albedo"], "", 2) + number_cell(t, layer["asymmetry"], "", 2) +
              (first && medium.contains("flame_power")
                   ? number_cell(t, medium["flame_power"]["value"], "W")
                   : html_cell("–", "n")) +
              "</tr>\n";
    }
  return table(
      t,
      {"column.medium", "column.kind", "column.heights", "column.extinction", "column.wavelength",
       "column.angstrom", "column.albedo", "column.asymmetry", "column.flame"},
      {20, 12, 12, 12, 10, 9, 8, 8, 9}, rows);
}

/// "S8, ISO 3864-4: Chromaticity of safety colours", "views of signs"
std::string group_text(const Texts& t, const Json& group) {
  const std::string rule = text_in(group, "rule");
  return rule.empty() ? t("views.of_signs")
                      : rule + ", " + text_in(group, "edition") + ": " + t.rule_title(rule);
}

std::string why_html(const Texts& t, const Json& group) {
  const std::string why = said(t, group["why"]);
  return "<i>" + escaped(group["undecided"].get<bool>() ? t.say("views.undecided", why) : why) +
         "</i>";
}

}  // namespace

std::string state_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json &s = parts.a["state"], &scenario = parts.a["scenario"];
  Facts facts(t);
  facts.add("state.scenario",
            text_in(s, "scenario").empty() ? t("state.no_scenario") : text_in(s, "scenario"));
  facts.add("state.operation", t.word("operation", text_in(s, "operation")));
  const Json& seconds = s["seconds_after_failure"];
  facts.add("state.seconds", seconds.is_object()
                                 ? t.number(seconds["value"].get<double>(), 4) + " s"
                                 : t("state.seconds_unsaid"));
  const Json& lit = s["luminaires"];
  facts.add_html(
      "state.luminaires",
      "<b>" + escaped(t.say("state.lit", lit["lit"].get<int64_t>(), lit["of"].get<int64_t>())) +
          "</b>" + (lit["lit_names"].empty() ? "" : "<br>") + escaped(list_text(lit["lit_names"])));
  facts.add_html("state.smoke", smoke_html(t, s["smoke"]));
  facts.add_html("state.rules", rules_html(t, s["rules"]));
  facts.add_html("state.deviations", s["deviations"].empty() ? escaped(t("state.no_deviations"))
                                                             : rules_html(t, s["deviations"]));
  facts.add("state.doors_open", list_text(scenario["doors_open"]));
  facts.add("state.doors_closed", list_text(scenario["doors_closed"]));
  std::string remarks = remark_html(t, s["light"]);
  for (const Json& one : s["remarks"]) remarks += "<br>" + remark_html(t, one);
  facts.add_html("state.remarks", remarks);
  return facts.table();
}

std::string inputs_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json &people = parts.a["people"], &plan = parts.a["plan"], &scenario = parts.a["scenario"];
  Facts facts(t);
  facts.add("inputs.age", t.say("inputs.years", t.number(people["age"]["value"].get<double>())));
  facts.add("inputs.spacing", t.number(people["spacing"]["value"].get<double>()) + " m");
  const Json& irritant = people["irritant_smoke"];
  facts.add("inputs.irritant", t(irritant.is_null()     ? "word.unknown"
                                 : irritant.get<bool>() ? "word.yes"
                                                        : "word.no"));
  facts.add("inputs.grid",
            t.say("inputs.grid_text", t.number(plan["route_grid"]["value"].get<double>()),
                  t.number(plan["area_grid"]["value"].get<double>()),
                  t.number(plan["height"]["value"].get<double>())));
  facts.add("inputs.factors", t("inputs.factors_text"));
  facts.add("inputs.scenario_media", factor_text(parts, scenario["media"]));
  facts.add("inputs.scenario_circuits", factor_text(parts, scenario["circuits"]));
  std::string out = facts.table();
  out += subheading(t("inputs.materials")) + materials_table(parts) +
         paragraph(t("inputs.materials_note"), "note");
  const std::string media = media_table(parts);
  out += subheading(t("inputs.media"));
  out += media.empty() ? paragraph(t("state.no_smoke"))
                       : media + paragraph(t("inputs.media_note"), "note");
  return out;
}

/// A dash for an empty text.
std::string or_dash(const std::string& text) {
  return text.empty() ? "–" : text;
}

std::string clauses_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::map<std::string, const Json*> rules;  // by edition, clause and id
  std::map<std::string, std::map<std::string, int>> verdicts;
  for (const Json& check : parts.a["checks"]) {
    const std::string key =
        text_in(check, "edition") + "\n" + text_in(check, "clause") + "\n" + text_in(check, "rule");
    rules.try_emplace(key, &check);
    ++verdicts[key][text_in(check, "verdict")];
  }
  std::string rows;
  for (const auto& [key, check] : rules) {
    std::string counts;
    for (const auto& [verdict, count] : verdicts[key])
      counts += (counts.empty() ? "" : "<br>") + std::to_string(count) + " " +
                escaped(t.word("verdict", verdict));
    rows += "<tr>" + html_cell("<b>" + escaped(text_in(*check, "rule")) + "</b>") +
            cell(t.word("edition", text_in(*check, "edition"))) +
            cell(or_dash(clause_text(t, *check))) + cell(t.rule_title(text_in(*check, "rule"))) +
            cell(or_dash(said(t, (*check)["quoted_from"]))) +
            cell(t.word("status", source_status(*check))) + html_cell(counts) + "</tr>\n";
  }
  if (rows.empty()) return paragraph(t("clauses.none"));
  return paragraph(t("clauses.lead")) +
         table(t,
               {"column.rule", "column.edition", "column.clause", "column.asks", "column.source",
                "column.status", "column.verdicts"},
               {7, 15, 9, 27, 16, 11, 15}, rows);
}

std::string not_assessed_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const Json& one : parts.a["not_assessed"])
    rows += "<tr>" + cell(group_text(t, one)) + html_cell(why_html(t, one)) +
            number_cell(t, one["count"], "", 9) + "</tr>\n";
  std::string out = paragraph(t("not_assessed.lead"));
  out += rows.empty() ? paragraph(t("not_assessed.nothing"))
                      : table(t, {"column.what", "column.why", "column.count"}, {38, 52, 10}, rows);
  out += paragraph(t("not_assessed.beyond")) + "<ul>\n";
  for (const char* key : {"beyond.egress", "beyond.noticing", "beyond.toxicity",
                          "beyond.installation", "beyond.texts"})
    out += "<li>" + escaped(t(key)) + "</li>\n";
  return out + "</ul>\n";
}

std::string method_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json &m = parts.a["method"], &plan = parts.a["plan"];
  std::string out =
      paragraph(t.say("method.codes", t.number(plan["route_grid"]["value"].get<double>()),
                      t.number(plan["area_grid"]["value"].get<double>()))) +
      paragraph(t("method.signs")) + paragraph(t("method.legible"));
  Facts facts(t);
  facts.add("method.version", "Luxodus " + text_in(parts.a, "version"));
  facts.add("method.scene", text_in(parts.a["scene"], "file"));
  facts.add_html("method.hash",
                 "<code>" + escaped(text_in(parts.a["scene"], "content_hash")) + "</code>");
  facts.add_html("method.seed", "<code>" + std::to_string(m["seed"].get<uint64_t>()) + "</code>");
  facts.add("method.paths", std::to_string(m["eye_paths"].get<int64_t>()));
  facts.add("method.seconds", t.number(m["seconds"]["value"].get<double>()) + " s");
  facts.add("method.files", t("method.files_text"));
  return out + subheading(t("method.trace")) + facts.table();
}

}  // namespace luxodus

// The record of an assessment: inputs, what was not assessed, method, and provenance of limits.
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

std::string list_text(const std::vector<std::string>& list) {
  std::string out;
  for (const std::string& one : list) out += (out.empty() ? "" : ", ") + one;
  return out;
}

std::string extinction_text(const Texts& t, double low, double high) {
  return (low == high ? t.number(low) : t.number(low) + "–" + t.number(high)) + " 1/m";
}

std::string smoke_html(const Texts& t, const std::optional<StateSmokeRecord>& smoke) {
  if (!smoke || smoke->media.empty()) return escaped(t("state.no_smoke"));
  const ExtinctionRecord& k = smoke->extinction;
  std::string out = "<b>" + escaped(extinction_text(t, k.min, k.max)) + "</b>" +
                    escaped(t.say("state.at_wavelength", t.number(k.wavelength_nm)));
  for (const StatedMedium& medium : smoke->media) {
    out += "<br>" + escaped(medium.name) + ": " +
           escaped(extinction_text(t, medium.extinction_min, medium.extinction_max));
    std::string source = escaped(medium.place);
    for (const Remark& note : medium.notes) source += ", " + escaped(t.remark(note));
    if (!source.empty()) out += " (<i>" + source + "</i>)";
  }
  return out;
}

/// Rule sets or deviations: edition, id, requirement and status.
std::string rules_html(const Texts& t, const std::vector<RulesRecord>& rules) {
  std::string out;
  for (const RulesRecord& rule : rules) {
    out += (out.empty() ? "<b>" : "<br><b>") + escaped(rule.edition) + "</b> (" + escaped(rule.id) +
           "): " + remark_html(t, rule.what);
    if (rule.status) out += ": " + remark_html(t, *rule.status);
  }
  return out;
}

std::string factor_text(const PageParts& parts, const std::vector<FactorRecord>& factors) {
  std::string out;
  for (const FactorRecord& f : factors)
    out += (out.empty() ? "" : "; ") + f.name + " × " + parts.texts.number(f.factor);
  return out;
}

std::string materials_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const MaterialRecord& m : parts.a.materials) {
    rows += "<tr>" + cell(m.name) + cell(t.word("material", m.kind));
    for (const auto& share : {m.reflectance, m.specular, m.transmittance, m.ior})
      rows += number_cell(t, share, "", 2);
    rows += html_cell(std::to_string(m.objects), "n") + "</tr>\n";
  }
  return table(t,
               {"column.material", "column.kind", "column.reflectance", "column.specular",
                "column.internal_transmittance", "column.ior", "column.surfaces"},
               {26, 16, 12, 12, 14, 10, 10}, rows);
}

std::string media_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const MediumRecord& medium : parts.a.media)
    for (const LayerRecord& layer : medium.layers) {
      const bool first = &layer == &medium.layers.front();
      std::string height = "–";
      if (layer.z_low_m && layer.z_high_m)
        height = t.fixed(*layer.z_low_m) + "–" + t.fixed(*layer.z_high_m);
      rows += "<tr>" + cell(first ? medium.name : "") +
              cell(first ? t.word("medium", medium.kind) : "") + html_cell(escaped(height), "n") +
              number_cell(t, layer.extinction_per_m, "1/m") + number_cell(t, layer.wavelength_nm) +
              number_cell(t, layer.angstrom) + number_cell(t, layer.albedo, "", 2) +
              number_cell(t, layer.asymmetry, "", 2) +
              (first ? number_cell(t, medium.flame_power_w, "W") : no_number_cell()) + "</tr>\n";
    }
  return table(
      t,
      {"column.medium", "column.kind", "column.heights", "column.extinction", "column.wavelength",
       "column.angstrom", "column.albedo", "column.asymmetry", "column.flame"},
      {20, 12, 12, 12, 10, 9, 8, 8, 9}, rows);
}

std::string why_html(const Texts& t, const NotAssessedRecord& group) {
  const std::string why = t.remarks(group.why);
  return "<i>" + escaped(group.undecided ? t.say("views.undecided", why) : why) + "</i>";
}

}  // namespace

std::string state_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const StateRecord& s = parts.a.state;
  const ScenarioRecord& scenario = parts.a.scenario;
  Facts facts(t);
  facts.add("state.scenario", s.scenario.empty() ? t("state.no_scenario") : s.scenario);
  facts.add("state.operation", t.word("operation", name_of(s.operation)));
  facts.add("state.seconds", s.seconds_after_failure ? t.number(*s.seconds_after_failure, 4) + " s"
                                                     : t("state.seconds_unsaid"));
  if (s.equivalent_background_cd_m2 > 0)
    facts.add("state.bleached", t.number(s.equivalent_background_cd_m2, 2) + " cd/m²");
  const LitRecord& lit = s.luminaires;
  facts.add_html("state.luminaires", "<b>" + escaped(t.say("state.lit", lit.lit, lit.of)) + "</b>" +
                                         (lit.names.empty() ? "" : "<br>") +
                                         escaped(list_text(lit.names)));
  facts.add_html("state.smoke", smoke_html(t, s.smoke));
  facts.add_html("state.rules", rules_html(t, s.rules));
  facts.add_html("state.deviations", s.deviations.empty() ? escaped(t("state.no_deviations"))
                                                          : rules_html(t, s.deviations));
  facts.add("state.doors_open", list_text(scenario.doors_open));
  facts.add("state.doors_closed", list_text(scenario.doors_closed));
  std::string remarks = remark_html(t, s.light);
  for (const Remark& one : s.remarks) remarks += "<br>" + remark_html(t, one);
  facts.add_html("state.remarks", remarks);
  return facts.table();
}

std::string inputs_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const PeopleRecord& people = parts.a.people;
  const PlanRecord& plan = parts.a.plan;
  const ScenarioRecord& scenario = parts.a.scenario;
  Facts facts(t);
  facts.add("inputs.age", t.say("inputs.years", t.number(people.age_years)));
  facts.add("inputs.spacing", t.number(people.spacing_m) + " m");
  facts.add("inputs.before", t.number(people.luminance_before_cd_m2) + " cd/m²");
  facts.add("inputs.irritant", t(!people.irritant_smoke   ? "word.unknown"
                                 : *people.irritant_smoke ? "word.yes"
                                                          : "word.no"));
  facts.add("inputs.grid", t.say("inputs.grid_text", t.number(plan.route_grid_m),
                                 t.number(plan.area_grid_m), t.number(plan.height_m)));
  facts.add("inputs.factors", t("inputs.factors_text"));
  facts.add("inputs.scenario_media", factor_text(parts, scenario.media));
  facts.add("inputs.scenario_circuits", factor_text(parts, scenario.circuits));
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

/// The edition whose clause a rule names: a set of 2024 takes rules over from 2013, and names the
/// clauses of that.
std::string edition_text(const Texts& t, const Rule& rule) {
  return rule.carried_over() && !rule.clause.empty() ? t.say("edition.carried_over", rule.edition)
                                                     : t.word("edition", rule.edition);
}

std::string clauses_appendix(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::map<std::string, const CheckRecord*> rules;  // by edition, clause and id
  std::map<std::string, std::map<std::string, int>> verdicts;
  for (const CheckRecord& check : parts.a.checks) {
    const std::string key = check.rule.edition + "\n" + english().clause(check.rule) + "\n" +
                            std::string(name_of(check.rule.id));
    rules.try_emplace(key, &check);
    ++verdicts[key][name_of(check.verdict)];
  }
  std::string rows;
  for (const auto& [key, check] : rules) {
    std::string counts;
    for (const auto& [verdict, count] : verdicts[key])
      counts += (counts.empty() ? "" : "<br>") + std::to_string(count) + " " +
                escaped(t.word("verdict", verdict));
    const Rule& rule = check->rule;
    const std::string id(name_of(rule.id));
    rows += "<tr>" + html_cell("<b>" + escaped(id) + "</b>") + cell(edition_text(t, rule)) +
            cell(or_dash(rule.clause)) + cell(t.rule_title(id)) +
            cell(or_dash(t.remarks(rule.sources))) + cell(t.word("status", source_status(rule))) +
            html_cell(counts) + "</tr>\n";
  }
  if (rows.empty()) return paragraph(t("clauses.none"));
  return paragraph(t("clauses.lead")) +
         table(t,
               {"column.rule", "column.edition", "column.clause", "column.asks", "column.source",
                "column.status", "column.verdicts"},
               {6, 23, 8, 28, 15, 9, 11}, rows, "dense");
}

Provenance provenance_of(const AssessmentRecord& a) {
  std::map<std::string, const Rule*> rules;
  for (const CheckRecord& check : a.checks)
    if (check.rule.id != RuleId::none)
      rules.try_emplace(
          check.rule.set + "\n" + check.rule.deviation + "\n" + std::string(name_of(check.rule.id)),
          &check.rule);
  Provenance out;
  for (const auto& [key, rule] : rules) {
    ++out.rules;
    const std::string status = source_status(*rule);
    out.secondary += status == "secondary";
    out.recollected += status == "recollection";
  }
  return out;
}

std::string not_assessed_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const NotAssessedRecord& one : parts.a.not_assessed)
    rows += "<tr>" + cell(one.words(t)) + html_cell(why_html(t, one)) +
            number_cell(t, one.count, "", 9) + "</tr>\n";
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
  const MethodRecord& m = parts.a.method;
  const PlanRecord& plan = parts.a.plan;
  std::string out =
      paragraph(t.say("method.codes", t.number(plan.route_grid_m), t.number(plan.area_grid_m)));
  if (m.sure_errors > 0)
    out +=
        paragraph(t.say("method.signs", t.number(m.sure_errors, 2), t.number(m.wrong_verdicts))) +
        paragraph(t("method.legible"));
  if (m.sure_errors > 0 && parts.a.people.place_unknown)
    out += paragraph(t("method.unknown_place"));
  Facts facts(t);
  facts.add("method.version", "Luxodus " + parts.a.version);
  facts.add("method.scene", parts.a.scene.file);
  facts.add_html("method.hash", "<code>" + escaped(parts.a.scene.content_hash) + "</code>");
  facts.add_html("method.seed", "<code>" + std::to_string(m.seed) + "</code>");
  facts.add("method.paths", std::to_string(m.eye_paths));
  facts.add("method.seconds", t.number(m.seconds) + " s");
  facts.add("method.files", t("method.files_text"));
  return out + subheading(t("method.trace")) + facts.table();
}

}  // namespace luxodus

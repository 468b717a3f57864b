#include "actors/judge/assess/guid_results.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "actors/judge/texts/texts.hpp"

namespace luxodus {

namespace {

const std::vector<std::string> guid_columns{"ifc_guid", "kind",   "name",  "rule_set",  "rule",
                                            "edition",  "clause", "title", "condition", "value",
                                            "unit",     "sense",  "limit", "verdict",   "reason"};

/// A thing of a model with what the assessment says of it. Points into the assessment.
struct ModelThing {
  std::string guid, kind, name;
  std::vector<const Check*> checks = {};
  const QuantityRecord* emergency_flux = nullptr;  // of a luminaire
  std::map<std::string, int> views = {};           // of a sign: their number by verdict
};

/// Things with a GlobalId by their subject in checks, ordered by name.
using ModelThings = std::map<std::pair<std::string_view, std::string>, ModelThing>;

ModelThings things_by_subject(const AssessmentRecord& a) {
  ModelThings out;
  const auto add = [&](const auto& row, SubjectKind subject, const char* kind) {
    if (!row.ifc_guid.empty()) out[{name_of(subject), row.name}] = {row.ifc_guid, kind, row.name};
  };
  const auto thing_of = [&](SubjectKind subject, const std::string& name) {
    const auto at = out.find({name_of(subject), name});
    return at == out.end() ? nullptr : &at->second;
  };
  for (const LuminaireRecord& one : a.luminaires) {
    add(one, SubjectKind::luminaire, "luminaire");
    if (ModelThing* thing = thing_of(SubjectKind::luminaire, one.name))
      thing->emergency_flux = &one.emergency_flux;
  }
  for (const SignRecord& one : a.signs) add(one, SubjectKind::sign, "sign");
  for (const AreaRecord& area : a.places.areas)
    add(area, area.is_task ? SubjectKind::task_area : SubjectKind::open_area, "space");
  for (const EmphasisRecord& point : a.places.emphasis)
    add(point, SubjectKind::emphasis, "place of emphasis");
  for (const Check& check : a.checks)
    if (ModelThing* thing = thing_of(check.subject.kind, check.subject.name))
      thing->checks.push_back(&check);
  for (const SightRecord& sight : a.sights)
    if (ModelThing* thing = thing_of(SubjectKind::sign, sight.sign))
      ++thing->views[name_of(sight.verdict)];
  return out;
}

std::optional<std::string> some(const std::string& words) {
  return words.empty() ? std::nullopt : std::optional(words);
}

void put_check(CsvTable& table, const ModelThing& thing, const Check& check) {
  const Texts t = english();
  const Rule& rule = check.rule;
  table.row(thing.guid, thing.kind, thing.name, some(rule.set), name_of(rule.id),
            some(rule.edition), some(t.clause(rule)), t.rule_title(name_of(rule.id)),
            some(t.remarks(check.conditions)), check.value, some(check.unit),
            check.at_least ? "at least" : "at most", check.limit, name_of(check.verdict),
            some(t.remarks(check.reasons)));
}

/// A row of a value that no rule judges.
void put_information(CsvTable& table, const ModelThing& thing, const char* title, double value,
                     const std::string& unit, const std::string& reason) {
  const std::optional<std::string> none;
  table.row(thing.guid, thing.kind, thing.name, none, none, none, none, title, none, value, unit,
            none, none, "information", some(reason));
}

void put_views(CsvTable& table, const ModelThing& thing) {
  if (thing.views.empty()) return;
  int all = 0;
  std::string words;
  for (const auto& [verdict, count] : thing.views) {
    all += count;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, verdict);
  }
  const auto legible = thing.views.find(name_of(SightVerdict::legible));
  put_information(table, thing, "views from which it is legible",
                  legible == thing.views.end() ? 0 : legible->second, fmt::format("of {}", all),
                  words);
}

// ---- property sets

/// The measure of IFC for a unit, where the unit is that of the measure in every model.
const char* measure_of(const std::string& unit) {
  if (unit == "lx") return "IfcIlluminanceMeasure";
  if (unit == "lm") return "IfcLuminousFluxMeasure";
  if (unit == "cd") return "IfcLuminousIntensityMeasure";
  return "IfcReal";
}

/// Properties of one thing; names are unique within a set.
class PropertyRows {
 public:
  PropertyRows(CsvTable& table, const ModelThing& thing) : table_(table), thing_(thing) {}

  void add(const std::string& set, const std::string& property, const QuantityRecord& value) {
    begin(set, property);
    table_.cell(value.value).cell(measure_of(value.unit)).cell(value.unit).end_row();
  }

  void add_check(const Check& check) {
    const Texts t = english();
    const std::string set = "Luxodus_" + (check.rule.set.empty() ? "Information" : check.rule.set);
    const std::string conditions = t.remarks(check.conditions);
    const std::string rule(name_of(check.rule.id));
    const std::string name =
        rule + " " + t.rule_title(rule) + (conditions.empty() ? "" : ", " + conditions);
    if (check.value) add(set, name + ": value", {*check.value, check.unit});
    if (check.limit) add(set, name + ": limit", {*check.limit, check.unit});
    begin(set, name + ": verdict");
    table_.cell(name_of(check.verdict)).cell("IfcLabel").cell("").end_row();
  }

 private:
  void begin(const std::string& set, const std::string& property) {
    std::string name = property;
    for (int i = 2; !taken_.insert(set + "\n" + name).second; ++i)
      name = fmt::format("{} ({})", property, i);
    table_.cell(thing_.guid).cell(set).cell(name);
  }

  CsvTable& table_;
  const ModelThing& thing_;
  std::set<std::string> taken_;
};

}  // namespace

std::optional<CsvTable> results_by_guid(const AssessmentRecord& assessment) {
  const auto things = things_by_subject(assessment);
  if (things.empty()) return std::nullopt;
  CsvTable table(guid_columns);
  for (const auto& [subject, thing] : things) {
    for (const Check* check : thing.checks) put_check(table, thing, *check);
    if (const QuantityRecord* flux = thing.emergency_flux)
      put_information(table, thing, "emergency flux", flux->value, flux->unit, "");
    put_views(table, thing);
  }
  return table;
}

std::optional<CsvTable> property_sets_by_guid(const AssessmentRecord& assessment) {
  const auto things = things_by_subject(assessment);
  if (things.empty()) return std::nullopt;
  CsvTable table({"GlobalId", "PropertySet", "Property", "Value", "ValueType", "Unit"});
  for (const auto& [subject, thing] : things) {
    PropertyRows rows(table, thing);
    for (const Check* check : thing.checks) rows.add_check(*check);
    if (thing.emergency_flux != nullptr)
      rows.add("Luxodus_EmergencyLighting", "EmergencyFlux", *thing.emergency_flux);
  }
  return table;
}

}  // namespace luxodus

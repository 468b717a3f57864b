#include "actors/judge/assess/guid_results.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "actors/judge/texts/remark_json.hpp"
#include "scenes/emergency/legibility.hpp"

namespace luxodus {

namespace {

const std::vector<std::string> guid_columns{"ifc_guid", "kind",   "name",  "rule_set",  "rule",
                                            "edition",  "clause", "title", "condition", "value",
                                            "unit",     "sense",  "limit", "verdict",   "reason"};

struct ModelThing {
  std::string guid, kind, name;
};

std::string guid_of(const Json& row) {
  const Json guid = row.value("ifc_guid", Json());
  return guid.is_string() ? guid.get<std::string>() : std::string();
}

/// Things with a GlobalId by their subject in checks, ordered by name.
std::map<std::pair<std::string, std::string>, ModelThing> things_by_subject(const Json& a) {
  std::map<std::pair<std::string, std::string>, ModelThing> out;
  const auto add = [&](const Json& rows, SubjectKind subject, const char* kind) {
    for (const Json& row : rows) {
      const std::string name = row["name"].get<std::string>();
      if (const std::string guid = guid_of(row); !guid.empty())
        out[{std::string(name_of(subject)), name}] = {guid, kind, name};
    }
  };
  add(a["luminaires"], SubjectKind::luminaire, "luminaire");
  add(a["signs"], SubjectKind::sign, "sign");
  for (const Json& area : a["places"]["areas"])
    add(Json::array({area}),
        area["kind"] == "task" ? SubjectKind::task_area : SubjectKind::open_area, "space");
  return out;
}

void begin_row(CsvTable& table, const ModelThing& thing) {
  table.cell(thing.guid).cell(thing.kind).cell(thing.name);
}

/// A cell of a check; empty if the check has no such value.
void put_value(CsvTable& table, const Json& check, const char* key) {
  const Json value = check.value(key, Json());
  const std::string words = english_in(check, key);
  if (!words.empty())
    table.cell(words);
  else if (value.is_number())
    table.cell(value.get<double>());
  else if (value.is_string() && !value.get<std::string>().empty())
    table.cell(value.get<std::string>());
  else
    table.empty_cell();
}

void put_check(CsvTable& table, const ModelThing& thing, const Json& check) {
  begin_row(table, thing);
  for (const char* key : {"rule_set", "rule", "edition", "clause", "title", "conditions", "value",
                          "unit", "sense", "limit", "verdict", "reasons"})
    put_value(table, check, key);
  table.end_row();
}

/// A row of a value that no rule judges.
void put_information(CsvTable& table, const ModelThing& thing, const std::string& title,
                     double value, const std::string& unit, const std::string& reason) {
  put_check(table, thing,
            {{"title", title},
             {"value", value},
             {"unit", unit},
             {"verdict", "information"},
             {"reasons", reason}});
}

void put_flux(CsvTable& table, const ModelThing& thing, const Json& luminaires) {
  for (const Json& luminaire : luminaires)
    if (guid_of(luminaire) == thing.guid && luminaire["name"] == thing.name)
      put_information(table, thing, "emergency flux",
                      luminaire["emergency_flux"]["value"].get<double>(),
                      luminaire["emergency_flux"]["unit"].get<std::string>(), "");
}

void put_views(CsvTable& table, const ModelThing& thing, const Json& sights) {
  std::map<std::string, int> verdicts;
  int views = 0;
  for (const Json& sight : sights) {
    if (sight["sign"] != thing.name) continue;
    ++views;
    ++verdicts[sight["verdict"].get<std::string>()];
  }
  if (views == 0) return;
  std::string words;
  for (const auto& [verdict, count] : verdicts)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, verdict);
  put_information(table, thing, "views from which it is legible",
                  verdicts[name_of(SightVerdict::legible)], fmt::format("of {}", views), words);
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

  void add(const std::string& set, const std::string& property, const Json& value,
           const std::string& unit) {
    std::string name = property;
    for (int i = 2; !taken_.insert(set + "\n" + name).second; ++i)
      name = fmt::format("{} ({})", property, i);
    table_.cell(thing_.guid).cell(set).cell(name);
    if (value.is_number())
      table_.cell(value.get<double>()).cell(measure_of(unit)).cell(unit);
    else
      table_.cell(value.get<std::string>()).cell("IfcLabel").cell("");
    table_.end_row();
  }

  void add_check(const Json& check) {
    const std::string rules = text_in(check, "rule_set");
    const std::string set = "Luxodus_" + (rules.empty() ? "Information" : rules);
    const std::string conditions = english_in(check, "conditions");
    const std::string name = text_in(check, "rule") + " " + text_in(check, "title") +
                             (conditions.empty() ? "" : ", " + conditions);
    for (const char* key : {"value", "limit"})
      if (const Json number = check.value(key, Json()); number.is_number())
        add(set, name + ": " + key, number, text_in(check, "unit"));
    add(set, name + ": verdict", text_in(check, "verdict"), "");
  }

 private:
  CsvTable& table_;
  const ModelThing& thing_;
  std::set<std::string> taken_;
};

}  // namespace

std::optional<CsvTable> results_by_guid(const Json& assessment) {
  const auto things = things_by_subject(assessment);
  if (things.empty()) return std::nullopt;
  CsvTable table(guid_columns);
  for (const auto& [subject, thing] : things) {
    for (const Json& check : assessment["checks"])
      if (check["subject"]["kind"] == subject.first && check["subject"]["name"] == subject.second)
        put_check(table, thing, check);
    if (thing.kind == "luminaire") put_flux(table, thing, assessment["luminaires"]);
    if (thing.kind == "sign") put_views(table, thing, assessment["sights"]);
  }
  return table;
}

std::optional<CsvTable> property_sets_by_guid(const Json& assessment) {
  const auto things = things_by_subject(assessment);
  if (things.empty()) return std::nullopt;
  CsvTable table({"GlobalId", "PropertySet", "Property", "Value", "ValueType", "Unit"});
  for (const auto& [subject, thing] : things) {
    PropertyRows rows(table, thing);
    for (const Json& check : assessment["checks"])
      if (check["subject"]["kind"] == subject.first && check["subject"]["name"] == subject.second)
        rows.add_check(check);
    if (thing.kind != "luminaire") continue;
    for (const Json& luminaire : assessment["luminaires"])
      if (guid_of(luminaire) == thing.guid && luminaire["name"] == thing.name)
        rows.add("Luxodus_EmergencyLighting", "EmergencyFlux", luminaire["emergency_flux"]["value"],
                 text_in(luminaire["emergency_flux"], "unit"));
  }
  return table;
}

}  // namespace luxodus

#include <fmt/format.h>

#include "actors/judge/report/hand_over.hpp"

namespace luxodus {

namespace {

std::string text(const Json& row, const char* key) {
  const auto at = row.find(key);
  return at != row.end() && at->is_string() ? at->get<std::string>() : std::string();
}

void number(CsvTable& table, const Json& value) {
  if (value.is_number())
    table.cell(value.get<double>());
  else
    table.empty_cell();
}

/// Adds the number of {"value", "unit"} at a key, or an empty cell.
void quantity(CsvTable& table, const Json& row, const char* key) {
  const auto at = row.find(key);
  if (at == row.end())
    table.empty_cell();
  else
    number(table, (*at)["value"]);
}

void place(CsvTable& table, const Json& position) {
  for (size_t i = 0; i < 3; ++i) number(table, position[i]);
}

}  // namespace

CsvTable luminaires_csv(const Json& a, const Schedule& schedule) {
  CsvTable table({"name", "type", "product", "file", "operation", "circuit", "x [m]", "y [m]",
                  "z [m]", "height above floor [m]", "mains flux", "emergency flux", "flux unit",
                  "maintenance factor [1]", "end of duration factor [1]"});
  for (size_t i = 0; i < a["luminaires"].size(); ++i) {
    const Json& one = a["luminaires"][i];
    table.cell(text(one, "name")).cell(schedule.type_of(i).letter);
    for (const char* key : {"product", "file", "operation", "circuit"}) table.cell(text(one, key));
    place(table, one["position"]);
    table.cell(schedule.above_floor(one["position"][2].get<double>()));
    quantity(table, one, "mains_flux");
    quantity(table, one, "emergency_flux");
    table.cell(text(one["mains_flux"], "unit"));
    number(table, one["maintenance_factor"]);
    number(table, one["end_of_duration_factor"]);
    table.end_row();
  }
  return table;
}

CsvTable signs_csv(const Json& a, const Schedule& schedule) {
  CsvTable table({"number",
                  "name",
                  "face file",
                  "face text",
                  "lighting",
                  "double-sided",
                  "circuit",
                  "x [m]",
                  "y [m]",
                  "z [m]",
                  "height above floor [m]",
                  "facing x [1]",
                  "facing y [1]",
                  "facing z [1]",
                  "width [m]",
                  "height [m]",
                  "smallest detail [m]",
                  "mains white [cd/m2]",
                  "mains green [cd/m2]",
                  "emergency white [cd/m2]",
                  "emergency green [cd/m2]"});
  for (size_t i = 0; i < a["signs"].size(); ++i) {
    const Json& one = a["signs"][i];
    table.cell(static_cast<int64_t>(i + 1)).cell(text(one, "name"));
    table.cell(text(one, "file")).cell(text(one, "text")).cell(text(one, "lighting"));
    table.cell(one["double_sided"].get<bool>()).cell(text(one, "circuit"));
    place(table, one["position"]);
    table.cell(schedule.above_floor(one["position"][2].get<double>()));
    place(table, one["facing"]);
    for (const char* key : {"width", "height", "smallest_detail", "mains_white", "mains_green",
                            "emergency_white", "emergency_green"})
      quantity(table, one, key);
    table.end_row();
  }
  return table;
}

CsvTable materials_csv(const Json& a, const Schedule& schedule) {
  CsvTable table({"kind", "type or numbers", "item", "operation or lighting", "count [1]",
                  "places x y z [m]"});
  const auto add = [&](const char* kind, const std::string& mark, const std::string& item,
                       const std::string& how, const Json& things,
                       const std::vector<size_t>& members) {
    std::string places;
    for (const size_t i : members) {
      const Json& p = things[i]["position"];
      places += fmt::format("{}{:.3f} {:.3f} {:.3f}", places.empty() ? "" : "; ",
                            p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    table.cell(kind).cell(mark).cell(item).cell(how);
    table.cell(static_cast<int64_t>(members.size())).cell(places).end_row();
  };
  for (const LuminaireType& type : schedule.types())
    add("luminaire", type.letter, product_of(*type.one), text(*type.one, "operation"),
        a["luminaires"], type.members);
  for (const SignType& type : schedule.sign_types()) {
    std::string numbers;
    for (const size_t i : type.members)
      numbers += (numbers.empty() ? "" : " ") + std::to_string(i + 1);
    const std::string face = text(*type.one, "file");
    add("sign", numbers, face.empty() ? text(*type.one, "text") : face, text(*type.one, "lighting"),
        a["signs"], type.members);
  }
  return table;
}

CsvTable places_csv(const Json& a) {
  CsvTable table({"subject", "rule", "edition", "clause", "title", "condition", "verdict", "value",
                  "limit", "sense", "unit", "margin [1]", "worst x [m]", "worst y [m]",
                  "worst z [m]", "quoted from", "remark"});
  for (const Json& check : a["checks"]) {
    table.cell(english_in(check, "subject"));
    for (const char* key : {"rule", "edition", "clause", "title"}) table.cell(text(check, key));
    table.cell(english_in(check, "conditions")).cell(text(check, "verdict"));
    number(table, check["value"]);
    number(table, check["limit"]);
    table.cell(text(check, "sense")).cell(text(check, "unit"));
    number(table, check["margin"]);
    if (const auto at = check.find("worst_place"); at != check.end())
      place(table, *at);
    else
      table.empty_cell().empty_cell().empty_cell();
    table.cell(english_in(check, "quoted_from")).cell(english_in(check, "reasons")).end_row();
  }
  return table;
}

CsvTable points_csv(const Json& a, const Schedule& schedule) {
  CsvTable table({"level", "floor [m]", "x [m]", "y [m]", "z [m]", "illuminance [lx]"});
  const Json& levels = a["plan"]["levels"];
  for (size_t i = 0; i < levels.size(); ++i)
    for (const Json& p : levels[i]["points"]) {
      table.cell(static_cast<int64_t>(i + 1)).cell(schedule.floor(i));
      place(table, p);
      number(table, p[3]);
      table.end_row();
    }
  return table;
}

}  // namespace luxodus

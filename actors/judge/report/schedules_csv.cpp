#include <fmt/format.h>

#include "actors/judge/report/hand_over.hpp"

namespace luxodus {

namespace {

/// Places of some of these things: "1.000 2.000 3.000; ...".
template <class Thing>
std::string places_of(const std::vector<Thing>& things, const std::vector<size_t>& members) {
  std::string out;
  for (const size_t i : members) {
    const glm::dvec3& p = things[i].position;
    out += fmt::format("{}{:.3f} {:.3f} {:.3f}", out.empty() ? "" : "; ", p.x, p.y, p.z);
  }
  return out;
}

/// The colour that has this name; one without luminances if there is none.
FaceColourRecord colour_of(const SignRecord& sign, const std::string& name) {
  for (const FaceColourRecord& colour : sign.colours)
    if (colour.name == name) return colour;
  return {};
}

}  // namespace

CsvTable luminaires_csv(const AssessmentRecord& a, const Schedule& schedule) {
  CsvTable table({"name", "type", "product", "file", "operation", "circuit", "x [m]", "y [m]",
                  "z [m]", "height above floor [m]", "mains flux", "emergency flux", "flux unit",
                  "maintenance factor [1]", "end of duration factor [1]", "maker", "article",
                  "battery"});
  for (size_t i = 0; i < a.luminaires.size(); ++i) {
    const LuminaireRecord& one = a.luminaires[i];
    const glm::dvec3& p = one.position;
    table.row(one.name, schedule.type_of(i).letter, one.product, one.file, one.operation,
              one.circuit, p.x, p.y, p.z, schedule.above_floor(one), one.mains_flux.value,
              one.emergency_flux.value, one.mains_flux.unit, one.maintenance_factor,
              one.end_of_duration_factor, a.sheets[one.sheet].maker, a.sheets[one.sheet].article,
              a.sheets[one.sheet].battery);
  }
  return table;
}

CsvTable signs_csv(const AssessmentRecord& a, const Schedule& schedule) {
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
                  "legend colour",
                  "ground colour",
                  "mains legend [cd/m2]",
                  "mains ground [cd/m2]",
                  "emergency legend [cd/m2]",
                  "emergency ground [cd/m2]"});
  for (size_t i = 0; i < a.signs.size(); ++i) {
    const SignRecord& one = a.signs[i];
    const glm::dvec3 &p = one.position, &f = one.facing;
    table.cells(static_cast<int64_t>(i + 1), one.name, one.file, one.text, one.lighting,
                one.double_sided, one.circuit, p.x, p.y, p.z, schedule.above_floor(one), f.x, f.y,
                f.z, one.width_m, one.height_m, one.smallest_detail_m, one.legend, one.ground);
    const FaceColourRecord legend = colour_of(one, one.legend), ground = colour_of(one, one.ground);
    table.row(legend.mains_cd_m2, ground.mains_cd_m2, legend.emergency_cd_m2,
              ground.emergency_cd_m2);
  }
  return table;
}

CsvTable materials_csv(const AssessmentRecord& a, const Schedule& schedule) {
  CsvTable table({"kind", "type or numbers", "item", "operation or lighting", "count [1]",
                  "places x y z [m]"});
  for (const LuminaireType& type : schedule.types())
    table.row("luminaire", type.letter, product_of(*type.one), type.one->operation,
              static_cast<int64_t>(type.members.size()), places_of(a.luminaires, type.members));
  for (const SignType& type : schedule.sign_types()) {
    std::string marks;
    for (const size_t i : type.members) marks += (marks.empty() ? "" : " ") + std::to_string(i + 1);
    const SignRecord& one = *type.one;
    table.row("sign", marks, one.file.empty() ? one.text : one.file, one.lighting,
              static_cast<int64_t>(type.members.size()), places_of(a.signs, type.members));
  }
  return table;
}

CsvTable places_csv(const AssessmentRecord& a) {
  CsvTable table({"subject", "rule", "edition", "clause", "title", "condition", "verdict", "value",
                  "limit", "sense", "unit", "margin [1]", "worst x [m]", "worst y [m]",
                  "worst z [m]", "quoted from", "remark"});
  const Texts t = english();
  for (const Check& check : a.checks) {
    const std::string_view rule = name_of(check.rule.id);
    std::optional<double> x, y, z;
    if (check.worst) x = check.worst->x, y = check.worst->y, z = check.worst->z;
    table.row(t.subject(check.subject), rule, check.rule.edition, t.clause(check.rule),
              t.rule_title(rule), t.remarks(check.conditions), name_of(check.verdict), check.value,
              check.limit, check.at_least ? "at least" : "at most", check.unit, check.margin(), x,
              y, z, t.remarks(check.rule.sources), t.remarks(check.reasons));
  }
  return table;
}

CsvTable points_csv(const AssessmentRecord& a, const Schedule& schedule) {
  CsvTable table(
      {"surface", "points", "level", "floor [m]", "x [m]", "y [m]", "z [m]", "illuminance [lx]"});
  const Texts t = english();
  for (const SurfaceRecord& surface : a.surfaces)
    for (const SurfaceGridRecord& grid : surface.grids)
      for (const PlanPoint& p : grid.points) {
        const size_t level = schedule.level_of(p.place.z);
        table.row(t.subject(surface.subject), grid.kind, static_cast<int64_t>(level + 1),
                  schedule.floor(level), p.place.x, p.place.y, p.place.z, p.lux);
      }
  return table;
}

}  // namespace luxodus

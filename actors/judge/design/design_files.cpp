#include "actors/judge/design/design_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "actors/judge/assess/record_assessment.hpp"
#include "actors/judge/design/design_page.hpp"
#include "actors/judge/design/record_design.hpp"
#include "actors/judge/design/sign_files.hpp"
#include "actors/judge/report/hand_over.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

std::string list_of(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + toml_text(word);
  return "[" + out + "]";
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

Result<void> write_plans(const fs::path& folder, const AssessmentRecord& a, Language language) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return system_problem(folder, "cannot make this folder", failed.value());
  const Schedule schedule(a);
  const Texts texts(language);
  const Plans plans(a, schedule, texts, {});
  for (size_t i = 0; i < schedule.levels(); ++i) {
    const std::string level =
        schedule.levels() > 1 ? "level_" + std::to_string(i + 1) + "_" : std::string();
    for (const auto& [name, svg] : {std::pair{"installation.svg", plans.installation(i).svg},
                                    std::pair{"isolux.svg", plans.isolux(i, false).svg}})
      if (auto ok = write_file_atomically(folder / (level + name), svg); !ok) return ok.problem();
    if (auto ok = write_plan_dxf(folder / (level + "plan.dxf"), a, schedule, i); !ok)
      return ok.problem();
  }
  return {};
}

/// Removes layouts of an earlier design; other files are kept.
Result<void> remove_alternatives(const fs::path& folder) {
  const fs::path others = folder / "alternatives";
  std::error_code failed;
  if (!fs::is_directory(fs::symlink_status(others, failed))) return {};
  std::vector<fs::path> layouts;
  for (fs::directory_iterator at(others, failed), end; !failed && at != end; at.increment(failed)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with("layout_") && name.ends_with(".toml")) layouts.push_back(at->path());
  }
  for (const fs::path& layout : layouts)
    if (!failed) fs::remove(layout, failed);
  if (failed)
    return system_problem(others, "cannot remove layouts of an earlier design", failed.value());
  fs::remove(others, failed);  // if nothing else is in it
  return {};
}

/// Removes the PDF of an earlier design; the caller prints a new one afterwards.
Result<void> remove_page_as_pdf(const fs::path& folder) {
  std::error_code failed;
  fs::remove(folder / "design.pdf", failed);
  if (failed)
    return system_problem(folder / "design.pdf", "cannot remove the page of an earlier design",
                          failed.value());
  return {};
}

/// Writes the other layouts as variants.
Result<void> write_alternatives(const fs::path& folder, const SceneDescription& scene,
                                const DesignResult& result) {
  for (const JudgedLayout& one : result.smoke->layouts) {
    const std::string file = file_of(one);
    if (file.empty() || file == "layout.toml") continue;
    const fs::path path = folder / file;
    std::error_code failed;
    fs::create_directories(path.parent_path(), failed);
    if (failed)
      return system_problem(path.parent_path(), "cannot make this folder", failed.value());
    const std::string text =
        variant_text(scene, result, one.layout, path.parent_path()) + changes_of_signs(one);
    if (auto ok = write_file_atomically(path, text); !ok) return ok.problem();
  }
  return {};
}

/// " (E6)"; "" of what is of no rule.
std::string in_brackets(RuleId rule) {
  return rule == RuleId::none ? "" : fmt::format(" ({})", name_of(rule));
}

std::string at_words(const glm::dvec3& place) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", place.x, place.y, place.z);
}

}  // namespace

std::string demand_words(const ConstraintGroup& group) {
  const std::string value = readable_number(group.asked, 3);
  std::string what;
  switch (group.kind) {
    case DemandKind::minimum:
      what = "at least " + value + " lx everywhere";
      break;
    case DemandKind::mean:
      what = "a mean of at least " + value + " lx";
      break;
    case DemandKind::early:
      what = "at least " + value + " lx in time after the failure of the mains";
      break;
    case DemandKind::spread:
      what = "largest over smallest illuminance at most " + value;
      break;
    case DemandKind::two:
      what = "two luminaires over it";
      break;
    case DemandKind::failed:
      what = "at least " + value + " lx with any one luminaire failed";
      break;
    case DemandKind::near:
      what = "a luminaire within " + value + " m";
      break;
    case DemandKind::vertical:
      what = "at least " + value + " lx on its front";
      break;
    case DemandKind::face:
      what = "at least " + value + " lx on its face";
      break;
    case DemandKind::stairs:
      what = "a luminaire whose light falls directly on it, " + value + " lx on each tread";
      break;
  }
  return fmt::format("{}: {}{}", english().subject(group.subject), what, in_brackets(group.rule));
}

std::string tolerance_words(const PlaceTolerance& tolerance) {
  if (tolerance.demands.empty()) return "";
  const ShareOffPlace& least = tolerance.demands.front();
  return fmt::format(
      "mounted up to {} m off their places, all luminaires at once: the least is {} of the minimum "
      "of the rules, {}{} at {}{}",
      readable_number(tolerance.distance_m, 2), percent(least.share),
      english().subject(least.subject), in_brackets(least.rule), at_words(least.place),
      tolerance.holds() ? "" : "; no layout was found whose minima hold");
}

std::string outcome_words(const SceneDescription& scene, const DesignResult& result) {
  const LayoutAnswer& answer = result.answer;
  const auto fresh = std::count_if(result.luminaires.begin(), result.luminaires.end(),
                                   [](const PlacedLuminaire& one) { return one.is_new(); });
  std::string out = fmt::format("{} new luminaire{}", fresh, fresh == 1 ? "" : "s");
  const auto moved = std::count_if(result.luminaires.begin(), result.luminaires.end(),
                                   [](const auto& one) { return one.moved_from.has_value(); });
  if (const size_t kept = result.luminaires.size() - static_cast<size_t>(fresh + moved); kept > 0)
    out += fmt::format(", {} of the scene stay{}", kept, kept == 1 ? "s" : "");
  if (moved > 0) out += fmt::format(", {} of the scene {} moved", moved, moved == 1 ? "is" : "are");
  if (!result.removed.empty()) out += fmt::format(", {} go", result.removed.size());
  const std::string objective(objective_words[static_cast<size_t>(scene.design->objective)]);
  out += fmt::format("; objective ({}) {}", objective, readable_number(answer.objective, 4));
  switch (answer.end) {
    case LayoutEnd::optimal:
      return out + ", the smallest possible with these candidates";
    case LayoutEnd::within_gap:
    case LayoutEnd::out_of_time:
    case LayoutEnd::interrupted:
      out += fmt::format(", no layout has less than {}: {} are left open",
                         readable_number(answer.bound, 4), percent(answer.gap()));
      if (answer.end == LayoutEnd::out_of_time) out += " (the time was out)";
      if (answer.end == LayoutEnd::interrupted) out += " (interrupted)";
      return out;
    case LayoutEnd::infeasible:
      return "no layout exists";
    case LayoutEnd::unknown:
      return "no layout was found in time, and it is not known whether one exists";
  }
  return out;
}

std::vector<HiddenByFurniture> joined_by_subject(const std::vector<HiddenByFurniture>& hidden) {
  std::vector<HiddenByFurniture> out;
  for (const HiddenByFurniture& one : hidden) {
    const auto at = std::find_if(out.begin(), out.end(), [&](const HiddenByFurniture& other) {
      return other.subject == one.subject && other.points == one.points;
    });
    if (at == out.end())
      out.push_back(one);
    else
      at->rule += ", " + one.rule;
  }
  return out;
}

std::vector<std::string> others_words(const std::vector<Check>& others) {
  constexpr size_t told_one_by_one = 3;
  std::vector<std::string> out;
  std::set<RuleId> told;
  for (const Check& check : others) {
    const auto of_rule =
        static_cast<size_t>(std::count_if(others.begin(), others.end(), [&](const Check& one) {
          return one.rule.id == check.rule.id;
        }));
    const bool together = of_rule > told_one_by_one;
    if (together && !told.insert(check.rule.id).second) continue;
    out.push_back(fmt::format("fails, and is not decided here: {}{}: {}",
                              english().subject(check.subject),
                              together ? fmt::format(" and {} others", of_rule - 1) : "",
                              english().rule_title(name_of(check.rule.id))));
  }
  return out;
}

std::vector<std::string> conflict_words(const SceneDescription& scene, const DesignResult& result) {
  std::vector<std::string> out;
  for (const Shortage& s : result.conflict.shortages) {
    const ConstraintGroup& group = result.groups[s.group];
    std::string line = demand_words(group);
    line += group.kind == DemandKind::two || group.kind == DemandKind::near
                ? fmt::format(": no candidates are there, near {}", at_words(s.place))
                : fmt::format(": all candidates together give {} of it at {}", percent(s.share),
                              at_words(s.place));
    line += "; ";
    switch (group.kind) {
      case DemandKind::near:
        line += "a smaller 'spacing_m' or 'wall_clearance_m', or a place in 'places', would help";
        break;
      case DemandKind::two:
        line +=
            "places over it would help ('over', 'spacing_m', 'wall_clearance_m'), or failure = "
            "\"none\"";
        break;
      default:
        line += s.share > 0
                    ? fmt::format("types {:.2g} times as bright would do, or places nearer to it",
                                  1 / s.share)
                    : std::string(
                          "no light reaches it: is it in a body, or in no room that has "
                          "places?");
    }
    out.push_back(std::move(line));
  }
  if (!result.conflict.shortages.empty()) return out;
  for (const uint32_t group : result.conflict.groups)
    out.push_back(demand_words(result.groups[group]));
  if (!out.empty())
    out.push_back(
        fmt::format("these {} cannot hold together{}; without any one of them the others "
                    "can: other types, more places or a smaller 'margin' (now {}) would "
                    "help",
                    out.size(), result.conflict.proven ? "" : ", as far as is known in this time",
                    readable_number(scene.design->margin, 3)));
  return out;
}

std::string variant_text(const SceneDescription& scene, const DesignResult& result,
                         const PlacedLayout& layout, const fs::path& folder) {
  std::error_code failed;
  fs::path file = fs::absolute(scene.file, failed);
  const fs::path near =
      fs::weakly_canonical(file, failed).lexically_relative(fs::weakly_canonical(folder, failed));
  if (!near.empty()) file = near;
  std::string out =
      "# A variant by `luxodus design`: emergency luminaires where it has placed them.\n"
      "# Written anew by every design into this folder.\n";
  out += "name = " + toml_text(scene.name + "-designed") + "\n";
  out += "include = [" + toml_text(file.generic_string()) + "]\n";
  if (!result.rules.empty() || !result.deviations.empty()) {
    out += "\n[assessment]\n";
    if (!result.rules.empty()) out += "rules = " + list_of(result.rules) + "\n";
    if (!result.deviations.empty()) out += "deviations = " + list_of(result.deviations) + "\n";
  }
  if (result.added_scenario)
    out += "\n[[scenario]]\nname = \"emergency\"\noperation = \"emergency\"\n";
  if (result.signs) out += sign_changes(scene, *result.signs);
  for (const std::string& name : layout.removed)
    out += "\n[[change]]\nkind = \"luminaire\"\nof = " + toml_text(name) + "\nremove = true\n";
  for (const PlacedLuminaire& one : layout.luminaires) {
    if (!one.is_placed()) continue;
    const glm::dvec3& p = one.candidate.position;
    out += one.is_new()
               ? "\n[[change]]\nkind = \"design_type\"\nof = " + toml_text(type_of(scene, one)) +
                     "\ncopy = " + toml_text(one.name)
               : "\n[[change]]\nkind = \"luminaire\"\nof = " + toml_text(one.name);
    out += "\nposition = [" + toml_metres(p.x) + ", " + toml_metres(p.y) + ", " + toml_metres(p.z) +
           "]\n";
    // A new type faces down by default; an existing luminaire may have another direction.
    if (one.candidate.aim || !one.is_new()) {
      const glm::dvec3 aim = one.candidate.aim.value_or(glm::dvec3(0, 0, -1));
      out += "facing = [" + shortest_number(aim.x) + ", " + shortest_number(aim.y) + ", " +
             shortest_number(aim.z) + "]\n";
    }
    if (one.candidate.rotation_deg != 0)
      out += "rotation_deg = " + shortest_number(one.candidate.rotation_deg) + "\n";
  }
  return out;
}

CsvTable schedule_csv(const DesignResult& result) {
  CsvTable table({"name", "state", "type", "file", "x [m]", "y [m]", "z [m]",
                  "height above floor [m]", "mount", "turn [deg]", "emergency flux [lm]",
                  "maintenance factor [1]", "end of duration factor [1]", "cost", "power [W]",
                  "battery", "moved from x [m]", "moved from y [m]", "moved from z [m]"});
  const SceneDescription& scene = *result.variant;
  for (const PlacedLuminaire& one : result.luminaires) {
    const auto at = std::find_if(scene.emitters.begin(), scene.emitters.end(),
                                 [&](const Emitter& e) { return e.name == one.name; });
    const glm::dvec3& p = one.candidate.position;
    table.cell(one.name)
        .cell(one.is_new()     ? "new"
              : one.moved_from ? "moved"
                               : "stays")
        .cell(type_of(scene, one));
    table.cell(at->file).cell(p.x).cell(p.y).cell(p.z);
    const auto floor =
        one.is_placed() ? std::optional(one.candidate.floor.z) : floor_below(scene, p);
    if (floor)
      table.cell(p.z - *floor);
    else
      table.empty_cell();
    table.cell(one.candidate.aim ? "wall" : one.is_placed() ? "ceiling" : "");
    table.cell(one.candidate.rotation_deg).cell(at->emergency_flux / at->emergency_ageing);
    table.cell(at->maintenance_factor).cell(at->end_of_duration_factor);
    if (one.is_new()) {
      const DesignType& type = scene.design->types[one.candidate.type];
      table.cell(type.cost).cell(type.watts).cell(battery_class(type));
    } else {
      table.empty_cell().empty_cell().empty_cell();
    }
    for (int axis = 0; axis < 3; ++axis)
      if (one.moved_from)
        table.cell((*one.moved_from)[axis]);
      else
        table.empty_cell();
    table.end_row();
  }
  return table;
}

Result<void> write_design(const fs::path& folder, const SceneDescription& scene,
                          const DesignResult& result, Language language,
                          const std::string& version) {
  const DesignRecord record = record_of(scene, result, version);
  const AssessmentRecord assessed = record_of(*result.variant, result.assessment, version);
  if (auto ok = write_plans(folder / "plans", assessed, language); !ok) return ok.problem();
  if (auto ok = write_csv(folder / "luminaires.csv", schedule_csv(result)); !ok)
    return ok.problem();
  std::optional<CsvTable> signs;
  if (result.signs) signs = signs_csv(scene, *result.signs);
  if (auto ok = write_or_remove(folder / "signs.csv", signs); !ok) return ok.problem();
  if (auto ok = remove_page_as_pdf(folder); !ok) return ok.problem();
  if (auto ok = write_json(folder / "design.json", design_json(record)); !ok) return ok.problem();
  if (auto ok = write_file_atomically(
          folder / "design.html",
          design_page(record, assessed, layout_plans(result, version), language));
      !ok)
    return ok.problem();
  if (auto ok = remove_alternatives(folder); !ok) return ok.problem();
  if (result.smoke)
    if (auto ok = write_alternatives(folder, scene, result); !ok) return ok.problem();
  return write_file_atomically(folder / "layout.toml", variant_text(scene, result, result, folder));
}

}  // namespace luxodus

#include "actors/judge/design/sign_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/design/wall_probe.hpp"
#include "actors/results/formats/json.hpp"
#include "runtime/core/output_text.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

std::string type_name(const SceneDescription& scene, const PlacedSign& one) {
  return one.is_new() ? scene.design->sign_types[one.type].name : "";
}

/// "west: left; east: ahead"
std::string ways_text(const PlacedSign& one) {
  std::string out;
  for (const LeadsTo& way : one.leads_to)
    out += (out.empty() ? "" : "; ") + way.route + ": " + std::string(arrow_word(way.arrow));
  return out;
}

std::string_view mount_word(const PlacedSign& one) {
  return mount_words[static_cast<size_t>(one.spot.mount)];
}

size_t new_signs(const SignPlan& plan) {
  return static_cast<size_t>(std::count_if(plan.signs.begin(), plan.signs.end(),
                                           [](const PlacedSign& one) { return one.is_new(); }));
}

double rounded_mm(double metres) {
  return std::round(metres * 1000) / 1000;
}

std::string counted(size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string toml_text(const std::string& text) {
  return Json(text).dump();  // a JSON string is a valid TOML basic string
}

std::string toml_metres(double value) {
  return shortest_number(std::round(value * 1e4) / 1e4);
}

std::string_view arrow_word(SignArrow arrow) {
  constexpr std::array<std::string_view, 3> words{"left", "right", "ahead"};
  return words[static_cast<size_t>(arrow)];
}

std::string sign_changes(const SceneDescription& scene, const SignPlan& plan) {
  std::string out;
  for (const std::string& name : plan.removed)
    out += "\n[[change]]\nkind = \"sign\"\nof = " + toml_text(name) + "\nremove = true\n";
  for (const PlacedSign& one : plan.signs) {
    if (!one.is_new()) continue;
    const glm::dvec3 &p = one.spot.position, &f = one.spot.facing;
    out += "\n[[change]]\nkind = \"design_sign\"\nof = " + toml_text(type_name(scene, one)) +
           "\ncopy = " + toml_text(one.name) + "\nposition = [" + toml_metres(p.x) + ", " +
           toml_metres(p.y) + ", " + toml_metres(p.z) + "]\nfacing = [" + shortest_number(f.x) +
           ", " + shortest_number(f.y) + ", " + shortest_number(f.z) + "]\n";
    for (const LeadsTo& way : one.leads_to)
      out += "[[change.leads_to]]\nroute = " + toml_text(way.route) + "\narrow = \"" +
             std::string(arrow_word(way.arrow)) + "\"\n";
  }
  return out;
}

std::string changes_of_signs(const JudgedLayout& layout) {
  std::string out;
  if (layout.sign_factor != 1)
    for (const Sign& sign : layout.layout.variant->signs)
      out += "\n[[change]]\nkind = \"sign\"\nof = " + toml_text(sign.name) +
             "\nfactor = " + shortest_number(layout.sign_factor) + "\n";
  for (const LowSign& low : layout.low_signs) {
    const glm::dvec3 &p = low.sign.frame.origin, f = told_direction(low.sign.frame.axes[2]);
    out += "\n[[change]]\nkind = \"sign\"\nof = " + toml_text(low.of) +
           "\ncopy = " + toml_text(low.sign.name) + "\nposition = [" + toml_metres(p.x) + ", " +
           toml_metres(p.y) + ", " + toml_metres(p.z) + "]\nfacing = [" + shortest_number(f.x) +
           ", " + shortest_number(f.y) + ", " + shortest_number(f.z) + "]\n";
  }
  return out;
}

CsvTable signs_csv(const SceneDescription& scene, const SignPlan& plan) {
  CsvTable table({"name", "state", "type", "mount", "x [m]", "y [m]", "z [m]",
                  "lower edge above floor [m]", "facing x", "facing y", "routes and arrows", "cost",
                  "power [W]"});
  for (const PlacedSign& one : plan.signs) {
    const glm::dvec3& p = one.spot.position;
    table.cell(one.name).cell(one.is_new() ? "new" : "stays").cell(type_name(scene, one));
    table.cell(one.is_new() ? std::string(mount_word(one)) : std::string());
    table.cell(p.x).cell(p.y).cell(p.z);
    const auto floor = floor_below(scene, p);
    if (one.is_new() && floor)
      table.cell(rounded_mm(p.z - scene.design->sign_types[one.type].sign.height_m / 2 - *floor));
    else
      table.empty_cell();
    table.cell(one.spot.facing.x).cell(one.spot.facing.y).cell(ways_text(one));
    if (one.is_new())
      table.cell(scene.design->sign_types[one.type].cost)
          .cell(scene.design->sign_types[one.type].watts);
    else
      table.empty_cell().empty_cell();
    table.end_row();
  }
  return table;
}

std::vector<std::string> sign_words(const SignPlan& plan) {
  const size_t fresh = new_signs(plan);
  std::string first = counted(fresh, "new sign");
  if (const size_t kept = plan.signs.size() - fresh; kept > 0)
    first += fmt::format(", {} of the scene stay{}", kept, kept == 1 ? "s" : "");
  if (!plan.removed.empty()) first += fmt::format(", {} go", plan.removed.size());
  if (plan.objective > 0)
    first += plan.bound >= plan.objective * (1 - 1e-6)
                 ? ", the smallest objective possible with these places"
                 : fmt::format("; objective {}, no plan has less than {}",
                               readable_number(plan.objective, 4), readable_number(plan.bound, 4));
  std::vector<std::string> out{std::move(first)};
  for (const UnguidedPlaces& one : plan.unguided)
    out.push_back(fmt::format(
        "  no sign guides from {} of {} places of route \"{}\"{}, first at ({:.2f}, {:.2f}, "
        "{:.2f}): {}",
        one.places, one.of, one.route, one.behind_furniture ? " with furniture" : "", one.first.x,
        one.first.y, one.first.z,
        one.behind_furniture ? "furniture hides all places for signs; without it they are guided"
        : one.behind_signs
            ? "signs hide each other in all plans that were tried"
            : "no place for a sign is seen from there; does the route end before a wall or door?"));
  return out;
}

}  // namespace luxodus

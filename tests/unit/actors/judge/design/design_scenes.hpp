// Scenes for tests of designs, and their designs without progress messages or interrupts.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "actors/judge/design/demands.hpp"
#include "actors/judge/design/design.hpp"
#include "actors/judge/design/design_files.hpp"
#include "actors/judge/texts/texts.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus::test {

/// Whether a layout of luminaires decides a rule.
inline bool is_of_luminaires(RuleId rule) {
  return row_of(rule).decided_by == DecidedBy::luminaires;
}

/// A closed room with a corner at the origin [m].
inline std::string box_room(double x, double y, double z) {
  return fmt::format(R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [{}, {}, {}]
material = "white50"
)",
                     x, y, z);
}

/// A rule set and the state to be judged.
inline const std::string judged_2013 = R"(
[assessment]
rules = ["en1838-2013"]
[[scenario]]
name = "failed"
operation = "emergency"
)";

/// A luminaire 2.97 m above the floor: its cone is lit, everything else is dark.
inline const std::string spot_of_45_deg = R"(
[[emitter]]
name = "spot"
shape = "point"
distribution = "spot"
spot_inner_deg = 45
spot_outer_deg = 45
position = [1, 1, 2.97]
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 300
maintenance_factor = 1
emergency_flux_is = "initial"
end_of_duration_factor = 1
)";

/// `path`: points in the syntax of scene files, without the outer brackets.
inline std::string route(const std::string& name, const std::string& path, double width = 1) {
  return fmt::format("[[route]]\nname = \"{}\"\npath = [{}]\nwidth = {}\n", name, path, width);
}

/// The route "way" along x at this y [m].
inline std::string way_along(double from, double to, double y, double width = 1) {
  return route("way", fmt::format("[{0}, {1}, 0], [{2}, {1}, 0]", from, y, to), width);
}

inline Result<DesignResult> tried(const std::filesystem::path& file, DesignOptions options = {}) {
  options.threads = 2;
  return design(described(file), options, nobody, silent);
}

inline DesignResult designed(const std::filesystem::path& file, const DesignOptions& options = {}) {
  auto result = tried(file, options);
  INFO((result ? "" : result.problem().text()));
  REQUIRE(result);
  return std::move(result).value();
}

/// Failing checks that luminaires decide, in an assessment of the variant on disk.
inline std::vector<std::string> failing_on_disk(const TemporaryFolder& folder,
                                                const std::filesystem::path& file,
                                                const DesignResult& result) {
  const auto scene = described(file);
  const std::filesystem::path layout =
      folder.write("layout.toml", variant_text(*scene, result, result, folder.path()));
  AssessOptions options;
  options.threads = 2;
  options.reality = false;
  const auto assessed =
      assess(described(layout), options, nobody, [](const std::string&, double) {});
  INFO((assessed ? "" : assessed.problem().text()));
  REQUIRE(assessed);
  std::vector<std::string> out;
  for (const Check& check : assessed->checks) {
    if (check.verdict != CheckVerdict::fail || !is_of_luminaires(check.rule.id)) continue;
    // Furniture may hide points from all candidates; the result must list exactly these checks.
    const bool furnished = std::count(check.conditions.begin(), check.conditions.end(),
                                      remark(RemarkId::with_furniture)) > 0;
    const bool told =
        std::any_of(result.hidden.begin(), result.hidden.end(), [&](const HiddenByFurniture& one) {
          return one.rule == name_of(check.rule.id) && one.subject == check.subject;
        });
    if (!(furnished && told))
      out.push_back(std::string(name_of(check.rule.id)) + " of " +
                    english().subject(check.subject));
  }
  return out;
}

}  // namespace luxodus::test

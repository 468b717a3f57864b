// Sheets of luminaires as the record of an assessment holds them: what is known of a product, its
// intensities in two planes, and how far apart it may hang. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json_fields.hpp"

namespace luxodus {

/// Distances along a row of luminaires.
struct RowSpacingRecord {
  double to_wall_m = 0, between_m = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("to_wall_m", m.to_wall_m)("between_m", m.between_m);
  }
  bool operator==(const RowSpacingRecord&) const = default;
};

/// A row of a spacing table; no spacing where the level is not even met below the luminaire.
struct SpacingRowRecord {
  double height_m = 0, level_lx = 0;
  double factor = 1;                              // on the flux of the new luminaire
  std::optional<RowSpacingRecord> along, across;  // C0 along the row, across it
  static constexpr void fields(auto&& field, auto& m) {
    field("height_m", m.height_m)("level_lx", m.level_lx)("factor", m.factor);
    field("c0_along", m.along, {.or_null = true})("c0_across", m.across, {.or_null = true});
  }
  bool operator==(const SpacingRowRecord&) const = default;
};

/// What luminaires of one product have in common. What is not stated is "" or none.
struct SheetRecord {
  std::string maker, article, battery;
  std::optional<double> watts;       // input on mains
  std::optional<double> duration_h;  // of the emergency supply
  std::optional<glm::dvec3> body_m;  // extents along its x, y, z
  bool body_round = false;           // an upright cylinder
  double curve_step_deg = 0;         // between the intensities of a curve
  std::vector<double> c0_c180;       // [cd/klm] from gamma 180 on the side of C180 to 180 on that
  std::vector<double> c90_c270;      // of C0; straight down in the middle. Empty: not known
  std::vector<SpacingRowRecord> spacing;  // of emergency luminaires that hang level
  static constexpr void fields(auto&& field, auto& m) {
    field("maker", m.maker)("article", m.article)("battery", m.battery);
    field("watts", m.watts, {.or_null = true})("duration_h", m.duration_h, {.or_null = true});
    field("body_m", m.body_m, {.or_null = true})("body_round", m.body_round);
    field("curve_step_deg", m.curve_step_deg)("c0_c180", m.c0_c180)("c90_c270", m.c90_c270);
    field("spacing", m.spacing);
  }
  bool operator==(const SheetRecord&) const = default;
};

}  // namespace luxodus

// The `[design]` table of a scene: what `luxodus design` may place, which requirements must hold,
// and the objective. Plain values in SI units; any thread. docs/guide/placement.md explains it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

enum class LuminaireMount { ceiling, wall, both };
inline constexpr std::array<std::string_view, 3> luminaire_mount_words{"ceiling", "wall", "both"};

/// The emergency supply of a luminaire.
enum class Battery { unsaid, self_contained, central };
inline constexpr std::array<std::string_view, 3> battery_words{"", "self-contained", "central"};

/// A luminaire that may be placed; its emitter is at the origin, aims down, unrotated, and has its
/// name.
struct DesignType {
  std::string name;
  SourcePlace place;
  Emitter emitter;
  double cost = 1;                // of one, installed, in any currency
  double watts = 0;               // power that one draws from the mains [W]
  std::vector<double> turns_deg;  // rotations about its aim, against the direction of escape;
                                  // empty: by its symmetry
  std::string like;               // the luminaire of the scene that it equals; "": none
  Battery battery = Battery::unsaid;
  LuminaireMount mount = LuminaireMount::ceiling;
  double aim_deg = 90;  // on a wall: 0 aims straight down, 90 away from the wall
  bool stated = false;  // given in the scene; else derived from it
};

/// The marking of a luminaire by EN 60598-2-22, as far as a scene gives it: "X 0 60" is
/// self-contained (Z: central supply), non-maintained (1: maintained), and lasts 60 min. Empty if
/// the battery is not given.
std::string battery_class(const DesignType& type);

/// A sign that may be placed, at the origin, facing +x. It belongs to no route yet.
struct DesignSignType {
  std::string name;
  SourcePlace place;
  Sign sign;
  double cost = 1;                 // as for a luminaire
  double watts = 0;                // [W]
  std::optional<SignArrow> arrow;  // shown by its drawing; absent: it is made with any arrow
  bool stated = false;
};

/// A vertical cylinder in which nothing may be mounted, e.g. around a smoke detector.
struct KeepOut {
  std::string name;
  SourcePlace place;
  glm::dvec3 position{0};
  double radius_m = 0.5;
};

/// Treatment of existing emergency luminaires and signs. Signs are not moved.
enum class ExistingTreatment { fixed, removable, removed, movable };
inline constexpr std::array<std::string_view, 4> existing_words{"fixed", "removable", "removed",
                                                                "movable"};

/// Stairs between two landings. The straight line from the lowest to the highest tread meets the
/// middle of each tread.
struct StairFlight {
  std::string name;
  glm::dvec3 lowest{0}, highest{0};  // middles of these treads [m]
  int treads = 1;
};

enum class DesignObjective { number, cost, watts, weighted };
inline constexpr std::array<std::string_view, 4> objective_words{"number", "cost", "watts",
                                                                 "weighted"};

/// Requirement that must hold when any single luminaire has failed.
enum class FailureDemand { none, two, full };
inline constexpr std::array<std::string_view, 3> failure_words{"none", "two", "full"};

/// Default cost of moving a luminaire, as a share of what the lightest placeable luminaire adds to
/// the objective.
inline constexpr double default_move_share = 0.25;

/// Whether two luminaires give equal emergency light, with equal duration and run-up, and have
/// equal bodies.
inline bool same_light(const Emitter& a, const Emitter& b) {
  return a.web == b.web && a.shape == b.shape && a.size == b.size &&
         a.distribution == b.distribution && a.cosine_power == b.cosine_power &&
         a.spot_inner_deg == b.spot_inner_deg && a.spot_outer_deg == b.spot_outer_deg &&
         a.spectrum.value == b.spectrum.value && a.radiometric == b.radiometric &&
         a.body_material == b.body_material && a.emergency_flux == b.emergency_flux &&
         a.emergency_ageing == b.emergency_ageing && a.onset == b.onset &&
         a.duration_s == b.duration_s && a.maintained == b.maintained;
}

struct DesignSettings {
  SourcePlace place;
  std::vector<DesignType> types;  // given types, else those of the scene, else a generic one

  // Candidate places
  std::vector<std::string> over;  // routes and areas; empty: all of them
  double spacing_m = 1;
  double wall_clearance_m = 0.3;
  double sign_clearance_m = 0.3;
  double drop_m = 0.03;                     // luminous opening below the ceiling
  std::optional<double> mounting_height_m;  // above the floor; absent: on the ceiling
  double wall_height_m = 2.3;               // luminaires on walls, above the floor
  std::vector<glm::dvec3> places;           // listed, instead of the grid
  std::vector<KeepOut> keep_outs;
  std::vector<StairFlight> stair_flights;  // objects of the scene with shape = "stairs"

  // Existing luminaires
  ExistingTreatment existing = ExistingTreatment::fixed;
  std::vector<std::string> fixed, movable, removable, removed;  // by name, overriding `existing`
  std::optional<double> move_cost;  // in the unit of the objective; absent: a share of a new one

  // Signs
  std::optional<bool> place_signs;         // absent: if the scene has no sign, or types are given
  std::vector<DesignSignType> sign_types;  // as for luminaires
  double sign_height_m = 2.2;              // lower edge above the floor
  double sign_spacing_m = 5;               // between places under ceilings along routes
  ExistingTreatment existing_signs = ExistingTreatment::fixed;

  // Requirements and objective
  FailureDemand failure = FailureDemand::two;
  double margin = 1.25;             // factor on the rules' minimum illuminances
  double place_tolerance_m = 0.25;  // minima must hold with luminaires misplaced by this
  bool refine = false;              // placed luminaires are then moved between grid places
  DesignObjective objective = DesignObjective::number;
  double weight_number = 1, weight_cost = 0, weight_watts = 0;
  /// What one more luminaire or sign adds to the objective.
  double weight_of(double cost, double watts) const;

  // Layouts judged in smoke, beside the best one
  std::vector<std::string> in_smoke;  // scenarios; empty: none
  size_t alternatives = 8;            // other layouts
};

}  // namespace luxodus

// What `luxodus design` may place, what must hold, and what is sought: the `[design]` table of a
// scene. Plain values in SI units; any thread. docs/guide/placement.md explains it.
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

/// What supplies a luminaire when the mains fail.
enum class Battery { unsaid, self_contained, central };
inline constexpr std::array<std::string_view, 3> battery_words{"", "self-contained", "central"};

/// A luminaire that may be placed, at the origin, looking down, unturned. Its emitter has its name.
struct DesignType {
  std::string name;
  SourcePlace place;
  Emitter emitter;
  double cost = 1;                // of one, installed, in any currency
  double watts = 0;               // that one takes from the mains [W]
  std::vector<double> turns_deg;  // about its aim, against the way below; empty: by its symmetry
  std::string like;               // the luminaire of the scene whose light it has; "": none
  Battery battery = Battery::unsaid;
  LuminaireMount mount = LuminaireMount::ceiling;
  double aim_deg = 90;  // of one on a wall: 0 looks straight down, 90 away from the wall
  bool stated = false;  // in the scene; else one that follows from it
};

/// The class as luminaires are marked by EN 60598-2-22, as far as a scene says it: "X 0 60" of a
/// self-contained one (Z: central supply) that is non-maintained (1: maintained) and lasts 60 min.
/// Empty where the battery is not said.
std::string battery_class(const DesignType& type);

/// A sign that may be placed, at the origin, facing +x. It leads nowhere yet.
struct DesignSignType {
  std::string name;
  SourcePlace place;
  Sign sign;
  double cost = 1;                 // as of a luminaire
  double watts = 0;                // [W]
  std::optional<SignArrow> arrow;  // that its drawing shows; none: it is made with any
  bool stated = false;
};

/// A vertical cylinder in which nothing is mounted, around a smoke detector for instance.
struct KeepOut {
  std::string name;
  SourcePlace place;
  glm::dvec3 position{0};
  double radius_m = 0.5;
};

/// What becomes of emergency luminaires and of signs that are there already. Signs are not moved.
enum class Existing { fixed, removable, removed, movable };
inline constexpr std::array<std::string_view, 4> existing_words{"fixed", "removable", "removed",
                                                                "movable"};

/// Stairs between two landings. A straight line from its lowest to its highest tread meets the
/// middle of each.
struct StairFlight {
  std::string name;
  glm::dvec3 lowest{0}, highest{0};  // middles of these treads [m]
  int treads = 1;
};

enum class DesignObjective { number, cost, watts, weighted };
inline constexpr std::array<std::string_view, 4> objective_words{"number", "cost", "watts",
                                                                 "weighted"};

/// What must still hold when any one luminaire has failed.
enum class FailureDemand { none, two, full };
inline constexpr std::array<std::string_view, 3> failure_words{"none", "two", "full"};

/// Of what the lightest luminaire that may be placed adds to the objective: what moving one adds.
inline constexpr double default_move_share = 0.25;

/// Whether two luminaires give the same light in an emergency, for as long and as soon, and have
/// bodies alike.
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
  std::vector<DesignType> types;  // stated ones, else those that the scene has, else a generic one

  // Candidate places
  std::vector<std::string> over;  // routes and areas; empty: all of them
  double spacing_m = 1;
  double wall_clearance_m = 0.3;
  double sign_clearance_m = 0.3;
  double drop_m = 0.03;                     // of a luminous opening below its ceiling
  std::optional<double> mounting_height_m;  // above the floor; else on the ceiling
  double wall_height_m = 2.3;               // of luminaires on walls above the floor
  std::vector<glm::dvec3> places;           // listed, instead of the grid
  std::vector<KeepOut> keep_outs;
  std::vector<StairFlight> flights;  // objects of the scene with shape = "stairs"

  // Luminaires that are there
  Existing existing = Existing::fixed;
  std::vector<std::string> fixed, movable, removable, removed;  // by name, whatever `existing`
  std::optional<double> move_cost;  // in the unit of the objective; not said: a share of a new one

  // Signs
  std::optional<bool> place_signs;  // not said: where the scene has no sign, or types are stated
  std::vector<DesignSignType> sign_types;  // as of luminaires
  double sign_height_m = 2.2;              // of the lower edge above the floor
  double sign_spacing_m = 5;               // between places under ceilings along routes
  Existing existing_signs = Existing::fixed;

  // What must hold, and what is sought
  FailureDemand failure = FailureDemand::two;
  double margin = 1.25;             // of minima of illuminance over the limits of the rules
  double place_tolerance_m = 0.25;  // minima hold with luminaires mounted so far off
  bool refine = false;              // what was placed is moved between the places of the grid
  DesignObjective objective = DesignObjective::number;
  double weight_number = 1, weight_cost = 0, weight_watts = 0;

  // What is judged in smoke, beside the best layout
  std::vector<std::string> in_smoke;  // scenarios; empty: nothing is
  size_t alternatives = 8;            // other layouts
};

}  // namespace luxodus

// Remarks on a check, a view or a state: an id with arguments, never a sentence. Sentences are made
// in the reader's language where they are shown (actors/judge/texts). Plain values and pure
// functions; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

enum class RemarkId {
  // Conditions of checks
  after_mains_failure,
  luminaire_failed,
  points_in_bodies,
  with_furniture,
  without_furniture,
  all_directions,
  glare_zone,
  smoke_may_occur,
  no_smoke_expected,
  contrast_of_means,
  light_of_one_on_treads,
  // Reasons of checks
  beyond_measure,
  no_value,
  value_on_grid,
  keeps_unread_limit,
  breaks_unread_limit,
  no_emergency_luminaire,
  nowhere_to_assess,
  worst_of_failures,
  no_core,
  onset_unsaid,
  onset_unsaid_of_more,
  no_onset,
  some_durations_unsaid,
  no_duration,
  shortest_supply,
  spectrum_rough,
  sign_onset_unsaid,
  colour_boxes_unknown,
  one_luminance,
  green_dark,
  other_colours,
  height_unknown,
  low_sign,
  no_sign_ahead,
  parallel_beam,
  initial_flux_unknown,
  mesh_unhidden,
  nearest_luminaire,
  none_in_sight,
  none_above_in_sight,
  none_there,
  none_above,
  behind_something,
  other_storey,
  supply_exhausted,
  facing_unsaid,
  glow_class_unknown,
  through_glass,
  no_letters,
  routes_alone_judged,
  no_route,
  no_emphasis,
  codes_alone,
  // Reasons of views
  visible_or_invisible,
  legible_or_not,
  legible_or_invisible,
  partly_hidden,
  eye_in_solid,
  seen_edge_on,
  one_colour,
  irritant_smoke,
  // The judged state
  no_luminaire_lit,
  light_as_stated,
  light_aged_emergency,
  light_aged_mains,
  mains_operation,
  dark_operation,
  time_unsaid,
  eyes_unadapted,
  flames_without_smoke,
  clear_air,
  luminaire_unlit,
  luminaires_unlit,
  sign_unlit,
  signs_unlit,
  flame_glare_missing,
  flame_dimmed,
  circuits_switch_off,
  circuits_raise,
  circuits_switch_off_signs,
  thinned_smoke,
  absent_smoke,
  unmeasured_luminaires,
  later_than_rated,
  onset_assumed,
  glow_extrapolated,
  young_eyes,
  low_eyes,
  far_apart,
  no_sign,
  two_editions,
  two_continents,
  edition_not_verified,
  edition_superseded,
  sign_luminance_stated,
  other_rules,
  other_deviations,
  // Sources of media
  one_layer,
  layers,
  grid_cells,
  fire_simulation,
  scenario_factor,
  // Rule sets, deviations and rules
  not_verified,
  superseded,
  one_lux_not_verified,
  carried_over,
  asks_european,
  asks_european_buildings,
  asks_united_states,
  asks_three_hours,
  asks_fifteen_seconds,
  asks_white_500,
  asks_one_lux,
  asks_ibc,
  asks_one_failed,
  source_bsi,
  source_secondary,
  source_makers,
  source_guides,
  source_liteplan,
  source_fernkorn,
  source_named,
  source_recollection,
  count  // number of ids
};

/// How files write an id, and the meaning of its arguments in their order.
struct RemarkKind {
  RemarkId id;
  std::string_view name;       // "points_in_bodies"
  std::string_view arguments;  // "left out, of points"; "" if it has none
};

/// All kinds of remarks, in the order of RemarkId.
std::span<const RemarkKind> remark_kinds();
const RemarkKind& kind_of(RemarkId id);
/// Number of arguments of a remark of this kind.
size_t arity_of(const RemarkKind& kind);

/// A name from the scene, or a number in the unit that the kind states.
using RemarkArgument = std::variant<std::string, double>;

struct Remark {
  RemarkId id = RemarkId::no_value;
  std::vector<RemarkArgument> arguments = {};

  friend auto operator<=>(const Remark&, const Remark&) = default;
};

using Remarks = std::vector<Remark>;

/// Makes a remark, as remark(RemarkId::points_in_bodies, 3, 40) does. Requires: as many arguments
/// as its kind has (else it throws: a programmer's mistake).
Remark remark_of(RemarkId id, std::vector<RemarkArgument> arguments);
template <class T>
RemarkArgument argument_of(const T& value) {
  if constexpr (std::is_arithmetic_v<T>)
    return static_cast<double>(value);
  else
    return std::string(value);
}
template <class... Arguments>
Remark remark(RemarkId id, const Arguments&... arguments) {
  return remark_of(id, {argument_of(arguments)...});
}

/// Subjects of checks, and places from which people look, in the order of lists.
enum class SubjectKind {
  emphasis,
  all_luminaires,
  all_luminaires_and_signs,
  all_signs,
  stairs,
  luminaire,
  observer,
  open_area,
  route,
  sign,
  task_area,
  building,
  count  // number of kinds
};
/// Name in files: "open area".
std::string_view name_of(SubjectKind kind);

struct Subject {
  SubjectKind kind = SubjectKind::building;
  std::string name = {};                            // "" if the kind alone identifies it
  EmphasisKind emphasis = EmphasisKind::exit_door;  // meaningful for points of emphasis only

  /// Whether it is a route or an area, whose illuminance is judged.
  bool is_place() const {
    return kind == SubjectKind::route || kind == SubjectKind::open_area ||
           kind == SubjectKind::task_area;
  }
  friend auto operator<=>(const Subject&, const Subject&) = default;
};

Subject subject_of(const EscapeRoute& route);
Subject subject_of(const EmphasisPoint& point);
Subject subject_of(const Sign& sign);
Subject subject_of(const Emitter& luminaire);

}  // namespace luxodus

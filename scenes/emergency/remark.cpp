#include "scenes/emergency/remark.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace luxodus {

namespace {

constexpr std::array kinds = std::to_array<RemarkKind>({
    {RemarkId::after_mains_failure, "after_mains_failure", "time [s]"},
    {RemarkId::luminaire_failed, "luminaire_failed", "luminaire"},
    {RemarkId::points_in_bodies, "points_in_bodies", "points left out; of points"},
    {RemarkId::with_furniture, "with_furniture", ""},
    {RemarkId::without_furniture, "without_furniture", ""},
    {RemarkId::all_directions, "all_directions", ""},
    {RemarkId::glare_zone, "glare_zone", ""},
    {RemarkId::smoke_may_occur, "smoke_may_occur", ""},
    {RemarkId::no_smoke_expected, "no_smoke_expected", ""},
    {RemarkId::contrast_of_means, "contrast_of_means", ""},
    {RemarkId::light_of_one_on_treads, "light_of_one_on_treads", "treads"},
    {RemarkId::beyond_measure, "beyond_measure", ""},
    {RemarkId::no_value, "no_value", ""},
    {RemarkId::value_on_grid, "value_on_grid", "the check's value at the points of the grid alone"},
    {RemarkId::keeps_unread_limit, "keeps_unread_limit", ""},
    {RemarkId::breaks_unread_limit, "breaks_unread_limit", ""},
    {RemarkId::no_emergency_luminaire, "no_emergency_luminaire", ""},
    {RemarkId::nowhere_to_assess, "nowhere_to_assess", ""},
    {RemarkId::worst_of_failures, "worst_of_failures", "failures"},
    {RemarkId::no_core, "no_core", ""},
    {RemarkId::onset_unsaid, "onset_unsaid", "luminaire"},
    {RemarkId::onset_unsaid_of_more, "onset_unsaid_of_more", "luminaire; others"},
    {RemarkId::no_onset, "no_onset", ""},
    {RemarkId::some_durations_unsaid, "some_durations_unsaid", ""},
    {RemarkId::no_duration, "no_duration", ""},
    {RemarkId::shortest_supply, "shortest_supply", "luminaire or sign"},
    {RemarkId::spectrum_rough, "spectrum_rough", ""},
    {RemarkId::sign_onset_unsaid, "sign_onset_unsaid", ""},
    {RemarkId::colour_boxes_unknown, "colour_boxes_unknown", ""},
    {RemarkId::one_luminance, "one_luminance", ""},
    {RemarkId::green_dark, "green_dark", ""},
    {RemarkId::other_colours, "other_colours", "colours"},
    {RemarkId::height_unknown, "height_unknown", ""},
    {RemarkId::low_sign, "low_sign", ""},
    {RemarkId::no_sign_ahead, "no_sign_ahead", ""},
    {RemarkId::parallel_beam, "parallel_beam", ""},
    {RemarkId::initial_flux_unknown, "initial_flux_unknown", ""},
    {RemarkId::mesh_unhidden, "mesh_unhidden", ""},
    {RemarkId::nearest_luminaire, "nearest_luminaire", "luminaire"},
    {RemarkId::none_in_sight, "none_in_sight", ""},
    {RemarkId::none_above_in_sight, "none_above_in_sight", ""},
    {RemarkId::none_there, "none_there", ""},
    {RemarkId::none_above, "none_above", ""},
    {RemarkId::behind_something, "behind_something", "luminaire; distance [m]"},
    {RemarkId::other_storey, "other_storey", "luminaire; distance [m]"},
    {RemarkId::supply_exhausted, "supply_exhausted", "luminaire; distance [m]"},
    {RemarkId::facing_unsaid, "facing_unsaid", ""},
    {RemarkId::glow_class_unknown, "glow_class_unknown", ""},
    {RemarkId::through_glass, "through_glass", "places; of places"},
    {RemarkId::no_letters, "no_letters", ""},
    {RemarkId::routes_alone_judged, "routes_alone_judged", ""},
    {RemarkId::no_route, "no_route", ""},
    {RemarkId::no_emphasis, "no_emphasis", ""},
    {RemarkId::codes_alone, "codes_alone", ""},
    {RemarkId::visible_or_invisible, "visible_or_invisible", ""},
    {RemarkId::legible_or_not, "legible_or_not", ""},
    {RemarkId::legible_or_invisible, "legible_or_invisible", ""},
    {RemarkId::partly_hidden, "partly_hidden", ""},
    {RemarkId::eye_in_solid, "eye_in_solid", ""},
    {RemarkId::seen_edge_on, "seen_edge_on", ""},
    {RemarkId::one_colour, "one_colour", ""},
    {RemarkId::irritant_smoke, "irritant_smoke", ""},
    {RemarkId::no_luminaire_lit, "no_luminaire_lit", ""},
    {RemarkId::light_as_stated, "light_as_stated", ""},
    {RemarkId::light_aged_emergency, "light_aged_emergency", "smallest share of new light"},
    {RemarkId::light_aged_mains, "light_aged_mains", "smallest share of new light"},
    {RemarkId::mains_operation, "mains_operation", ""},
    {RemarkId::dark_operation, "dark_operation", ""},
    {RemarkId::time_unsaid, "time_unsaid", ""},
    {RemarkId::eyes_unadapted, "eyes_unadapted", "time [s]; eyes are adapted after [s]"},
    {RemarkId::flames_without_smoke, "flames_without_smoke", ""},
    {RemarkId::clear_air, "clear_air", ""},
    {RemarkId::luminaire_unlit, "luminaire_unlit", "1"},
    {RemarkId::luminaires_unlit, "luminaires_unlit", "luminaires"},
    {RemarkId::sign_unlit, "sign_unlit", "sign"},
    {RemarkId::signs_unlit, "signs_unlit", "first sign; others"},
    {RemarkId::flame_glare_missing, "flame_glare_missing", "medium"},
    {RemarkId::flame_dimmed, "flame_dimmed", "share of the stated light; medium"},
    {RemarkId::circuits_switch_off, "circuits_switch_off", "luminaires off; luminaires dimmed"},
    {RemarkId::circuits_raise, "circuits_raise", "luminaires"},
    {RemarkId::circuits_switch_off_signs, "circuits_switch_off_signs", "signs"},
    {RemarkId::thinned_smoke, "thinned_smoke", "share of the stated extinction; medium"},
    {RemarkId::absent_smoke, "absent_smoke", "medium"},
    {RemarkId::unmeasured_luminaires, "unmeasured_luminaires", "luminaires"},
    {RemarkId::later_than_rated, "later_than_rated", "time [s]; rated duration [h]"},
    {RemarkId::onset_assumed, "onset_assumed", "luminaires; time [s]"},
    {RemarkId::glow_extrapolated, "glow_extrapolated", "sign; known up to [s]"},
    {RemarkId::young_eyes, "young_eyes", "age [years]"},
    {RemarkId::low_eyes, "low_eyes", "height [m]"},
    {RemarkId::far_apart, "far_apart", "distance [m]"},
    {RemarkId::no_sign, "no_sign", ""},
    {RemarkId::two_editions, "two_editions", ""},
    {RemarkId::two_continents, "two_continents", ""},
    {RemarkId::edition_not_verified, "edition_not_verified", "edition"},
    {RemarkId::edition_superseded, "edition_superseded", "edition"},
    {RemarkId::sign_luminance_stated, "sign_luminance_stated", ""},
    {RemarkId::other_rules, "other_rules", "names"},
    {RemarkId::other_deviations, "other_deviations", "names"},
    {RemarkId::one_layer, "one_layer", "1"},
    {RemarkId::layers, "layers", "layers"},
    {RemarkId::grid_cells, "grid_cells", "cells along x; along y; along z"},
    {RemarkId::fire_simulation, "fire_simulation", "time [s]; file"},
    {RemarkId::scenario_factor, "scenario_factor", "factor"},
    {RemarkId::not_verified, "not_verified", ""},
    {RemarkId::superseded, "superseded", ""},
    {RemarkId::one_lux_not_verified, "one_lux_not_verified", ""},
    {RemarkId::carried_over, "carried_over", ""},
    {RemarkId::asks_european, "asks_european", ""},
    {RemarkId::asks_european_buildings, "asks_european_buildings", ""},
    {RemarkId::asks_united_states, "asks_united_states", ""},
    {RemarkId::asks_three_hours, "asks_three_hours", ""},
    {RemarkId::asks_fifteen_seconds, "asks_fifteen_seconds", ""},
    {RemarkId::asks_white_500, "asks_white_500", ""},
    {RemarkId::asks_one_lux, "asks_one_lux", ""},
    {RemarkId::asks_ibc, "asks_ibc", ""},
    {RemarkId::asks_one_failed, "asks_one_failed", ""},
    {RemarkId::source_bsi, "source_bsi", ""},
    {RemarkId::source_secondary, "source_secondary", ""},
    {RemarkId::source_makers, "source_makers", "makers"},
    {RemarkId::source_guides, "source_guides", ""},
    {RemarkId::source_liteplan, "source_liteplan", ""},
    {RemarkId::source_fernkorn, "source_fernkorn", ""},
    {RemarkId::source_named, "source_named", "name"},
    {RemarkId::source_recollection, "source_recollection", ""},
});
static_assert(kinds.size() == static_cast<size_t>(RemarkId::count));

constexpr std::array subject_words = std::to_array<std::string_view>(
    {"emphasis", "all luminaires", "all luminaires and signs", "all signs", "flight of stairs",
     "luminaire", "observer", "open area", "route", "sign", "task area", "building"});
static_assert(subject_words.size() == static_cast<size_t>(SubjectKind::count));

}  // namespace

std::span<const RemarkKind> remark_kinds() {
  return kinds;
}

const RemarkKind& kind_of(RemarkId id) {
  return kinds.at(static_cast<size_t>(id));
}

size_t arity_of(const RemarkKind& kind) {
  if (kind.arguments.empty()) return 0;
  return 1 + static_cast<size_t>(std::count(kind.arguments.begin(), kind.arguments.end(), ';'));
}

Remark remark_of(RemarkId id, std::vector<RemarkArgument> arguments) {
  if (arguments.size() != arity_of(kind_of(id)))
    throw std::logic_error("wrong number of arguments of remark " + std::string(kind_of(id).name));
  return {id, std::move(arguments)};
}

std::string_view name_of(SubjectKind kind) {
  return subject_words.at(static_cast<size_t>(kind));
}

Subject subject_of(const EscapeRoute& route) {
  return {SubjectKind::route, route.name};
}

Subject subject_of(const EmphasisPoint& point) {
  return {SubjectKind::emphasis, point.name, point.kind};
}

Subject subject_of(const Sign& sign) {
  return {SubjectKind::sign, sign.name};
}

Subject subject_of(const Emitter& luminaire) {
  return {SubjectKind::luminaire, luminaire.name};
}

}  // namespace luxodus

// Results of an assessment for things from an IFC model, by their GlobalId, so that the program of
// the model can import them as properties. Reads the JSON of the assessment. Pure function; any
// thread.
#pragma once

#include <optional>

#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// Rows for checks of spaces, luminaires and signs that have a GlobalId, for the emergency flux of
/// each such luminaire, and for the views of each such sign. None if nothing has a GlobalId.
std::optional<CsvTable> results_by_guid(const Json& assessment);

/// The same as properties of property sets, one a row: a set for each rule set, in it value, limit
/// and verdict of each check, with the IFC type of the value. None if nothing has a GlobalId.
std::optional<CsvTable> property_sets_by_guid(const Json& assessment);

}  // namespace luxodus

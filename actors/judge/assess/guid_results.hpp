// Results of an assessment for things from an IFC model, by their GlobalId, so that the program of
// the model can import them as properties. Pure functions; any thread.
#pragma once

#include <optional>

#include "actors/judge/record/assessment_record.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// Rows for checks of spaces, luminaires and signs that have a GlobalId, for the emergency flux of
/// each such luminaire, and for the views of each such sign. None if nothing has a GlobalId.
std::optional<CsvTable> results_by_guid(const AssessmentRecord& assessment);

/// The checks and fluxes as properties of property sets, one a row: a set for each rule set, in it
/// value, limit and verdict of each check, and a set of the emergency flux, with the IFC type of
/// the value. None if nothing has a GlobalId.
std::optional<CsvTable> property_sets_by_guid(const AssessmentRecord& assessment);

}  // namespace luxodus

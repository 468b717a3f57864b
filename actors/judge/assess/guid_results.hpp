// What an assessment says of things that came from an IFC model, by their GlobalId, so that the
// model's program can take values as properties. From the JSON of the assessment. Pure; any thread.
#pragma once

#include <optional>

#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// A row for each check of a space, a luminaire or a sign that has a GlobalId, for the emergency
/// flux of each luminaire, and for the views of each sign. Nothing where nothing has one.
std::optional<CsvTable> results_by_guid(const Json& assessment);

}  // namespace luxodus

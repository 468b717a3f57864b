// Guidance over time as JSON, as a table, and as text for a terminal. Pure functions; any thread.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// {"states", "routes", ...}. "guided" and "jin" of a route have a text for each state with a
/// letter for each place: "g" guided, "u" undecided, "n" not guided.
Json over_time_json(const OverTime& over_time);

/// A row for every route, eye height, state and place; from over_time_json.
CsvTable guidance_csv(const Json& over_time);

/// Lines for a terminal: until when each route guides, and how far walkers get.
std::string guidance_text(const Json& over_time);

}  // namespace luxodus

// Guidance over time as JSON, as a table, and in words. Pure; any thread.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// {"states", "routes", ...}. A route's "guided" and "jin" have a text for each state, with a
/// letter for each place: "g" guided, "u" undecided, "n" not guided.
Json over_time_json(const OverTime& over_time);

/// A row of every route, height of eyes, state and place, from over_time_json.
CsvTable guidance_csv(const Json& over_time);

/// Lines for a terminal: up to when each route guides, and how far walkers come.
std::string guidance_text(const Json& over_time);

}  // namespace luxodus

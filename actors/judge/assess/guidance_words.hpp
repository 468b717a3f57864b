// Guidance over time as a table, and as text for a terminal. Pure functions; any thread.
#pragma once

#include "actors/judge/record/guidance_record.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// A row for every route, eye height, state and place.
CsvTable guidance_csv(const OverTime& over_time);

/// Lines for a terminal: until when each route guides, and how far walkers get.
std::string guidance_text(const OverTime& over_time);

}  // namespace luxodus

// Thresholds of an assessment as a table, and in words for the console. Pure functions; any thread.
#pragma once

#include <string>

#include "actors/judge/record/threshold_record.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

CsvTable thresholds_csv(const std::vector<ThresholdRecord>& thresholds);

/// A line for each sign and quantity.
std::string thresholds_text(const std::vector<ThresholdRecord>& thresholds);

}  // namespace luxodus

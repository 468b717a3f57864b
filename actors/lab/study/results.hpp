// What a run of a study found, by column. Plain values; any thread.
#pragma once

#include <string_view>
#include <vector>

#include "actors/cast/node/fetching_objects.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

struct StudyResult {
  double seconds = 0;  // from the first lease to the last count, by the run's own clock
  double particles = 0;
  double nodes = 0;
  WorkerReport workers;  // of all together
  double busy_s = 0;     // of all workers: charged; of real ones their threads' processor time
  double tracing_s = 0;  // of those, by what was charged for; simulated ones alone
  double building_s = 0;
  double frames_s = 0;
  double resting_s = 0;
  double controller_s = 0;  // the same of the controller
  double busiest_s = 0;     // of whoever coordinates, the busiest; simulated ones alone
  double frames = 0;        // on links; those of real nodes are not counted
  double link_bytes = 0;    // likewise
  double leases = 0;
  double fenced = 0;
  double flush_bytes = 0;
  double longest_turn_s = 0;  // of the controller
  double moves = 0;  // of particles between holders of objects, were these to travel; replay alone
  double mean_path = 0;    // links between two workers, on average; replay alone
  uint64_t flux_hash = 0;  // of all totals: equal particles, equal flux, whoever traced them
};

/// For StudyResult::flux_hash.
uint64_t flux_hash_of(const Totals& totals);

/// A number that a plot can show.
struct StudyColumn {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double (*value)(const StudyResult&);
};

/// All of them, as they stand in a CSV.
const std::vector<StudyColumn>& study_columns();
/// Requires: it exists.
const StudyColumn& study_column(std::string_view name);

}  // namespace luxodus

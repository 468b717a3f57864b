// Results of a study's run, by column. Plain values; any thread.
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
  WorkerReport workers;  // over all workers
  double busy_s = 0;     // of all workers: charged time; for real ones CPU time of their threads
  double tracing_s = 0;  // parts of it, by kind of charge; simulated nodes only
  double building_s = 0;
  double frames_s = 0;
  double resting_s = 0;
  double controller_s = 0;  // of the controller
  double busiest_s = 0;     // of the busiest coordinator; simulated nodes only
  double frames = 0;        // on links; not counted for real nodes
  double link_bytes = 0;    // on links; not counted for real nodes
  double leases = 0;
  double fenced = 0;
  double flush_bytes = 0;
  double longest_turn_s = 0;  // of the controller
  double moves = 0;  // of particles between holders of objects if particles migrated; replay only
  double mean_path = 0;    // links between two workers, on average; replay only
  uint64_t flux_hash = 0;  // of all totals: equal particles give equal flux on any nodes
};

/// The hash in StudyResult::flux_hash.
uint64_t flux_hash_of(const Totals& totals);

/// A number that a plot can show.
struct StudyColumn {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double (*value)(const StudyResult&);
};

/// All columns, in the order of the CSV.
const std::vector<StudyColumn>& study_columns();
/// Requires: the column exists.
const StudyColumn& study_column(std::string_view name);

}  // namespace luxodus

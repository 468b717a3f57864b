#include "actors/lab/study/results.hpp"

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {

using R = const StudyResult&;

/// A particle in transit: position, direction, weight, band, path and number of draws are 64 B; a
/// frame's head and check take as many.
constexpr double moved_bytes = 128;

double per(double value, double of) {
  return of > 0 ? value / of : 0;
}
double ms_at(const Histogram& histogram, double quantile) {
  return 1e-6 * static_cast<double>(histogram.at(quantile));
}
double fetched(R r) {
  return static_cast<double>(r.workers.fetch_delay.count());
}

std::vector<StudyColumn> of_runs() {
  return {
      {"seconds", "s", "from the first lease to the last count", [](R r) { return r.seconds; }},
      {"particles_per_s", "1/s", "of all nodes", [](R r) { return per(r.particles, r.seconds); }},
      {"node_particles_per_s", "1/s", "of one node",
       [](R r) { return per(r.particles, r.seconds * r.nodes); }},
      {"busy", "", "share of their time that workers compute; of real ones, processor time",
       [](R r) { return per(r.busy_s, r.seconds * r.nodes); }},
      {"controller_busy", "", "the same of the controller",
       [](R r) { return per(r.controller_s, r.seconds); }},
      {"coordinator_busy", "",
       "the same of the busiest node that coordinates others, simulated ones alone",
       [](R r) { return per(r.busiest_s, r.seconds); }},
      {"busy_us_per_particle", "us", "what a particle costs the workers, all things counted",
       [](R r) { return 1e6 * per(r.busy_s, r.particles); }},
      {"tracing_us_per_particle", "us", "of those, tracing; simulated ones alone",
       [](R r) { return 1e6 * per(r.tracing_s, r.particles); }},
      {"build_us_per_particle", "us", "likewise, building objects",
       [](R r) { return 1e6 * per(r.building_s, r.particles); }},
      {"frame_us_per_particle", "us", "likewise, frames that are sent, received and passed on",
       [](R r) { return 1e6 * per(r.frames_s, r.particles); }},
      {"rest_us_per_particle", "us", "likewise, going to rest and waking",
       [](R r) { return 1e6 * per(r.resting_s, r.particles); }},
      {"longest_turn_ms", "ms", "processor time of the longest turn of any node",
       [](R r) {
         return std::max(1e3 * r.longest_turn_s,
                         1e-6 * static_cast<double>(r.workers.longest_turn));
       }},
      {"leases", "", "batches lent", [](R r) { return r.leases; }},
      {"fenced", "", "leases that were late or lost", [](R r) { return r.fenced; }},
      {"frames_per_particle", "", "on links, simulated ones alone",
       [](R r) { return per(r.frames, r.particles); }},
      {"link_bytes_per_particle", "B", "likewise, counted on every link",
       [](R r) { return per(r.link_bytes, r.particles); }},
      {"moves_per_particle", "", "changes of holder along its way, replayed runs alone",
       [](R r) { return per(r.moves, r.particles); }},
      {"data_byte_hops_per_particle", "B", "bytes of fetched objects times the links they passed",
       [](R r) {
         const double hops = per(static_cast<double>(r.workers.hops), fetched(r));
         return hops * per(static_cast<double>(r.workers.fetched_bytes), r.particles);
       }},
      {"move_byte_hops_per_particle", "B",
       "what particles would send if they travelled to the holders of objects instead, by counted "
       "moves, 128 B each and the mean way between nodes; replayed runs alone",
       [](R r) { return per(r.moves, r.particles) * moved_bytes * r.mean_path; }},
  };
}

std::vector<StudyColumn> of_objects() {
  return {
      {"hit_rate", "", "share of references that find their object resident",
       [](R r) { return r.workers.hit_rate(); }},
      {"fetches_per_particle", "", "objects that came over links",
       [](R r) { return per(fetched(r), r.particles); }},
      {"fetched_bytes_per_particle", "B", "of objects that came over links",
       [](R r) { return per(static_cast<double>(r.workers.fetched_bytes), r.particles); }},
      {"builds_per_particle", "", "objects built",
       [](R r) { return per(static_cast<double>(r.workers.builds), r.particles); }},
      {"hops_per_fetch", "", "links that an answer passed",
       [](R r) { return per(static_cast<double>(r.workers.hops), fetched(r)); }},
      {"fetch_p50_ms", "ms", "from the wish for an object to its bytes",
       [](R r) { return ms_at(r.workers.fetch_delay, 0.5); }},
      {"fetch_p90_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.fetch_delay, 0.9); }},
      {"fetch_p99_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.fetch_delay, 0.99); }},
      {"fetch_p999_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.fetch_delay, 0.999); }},
      {"fetch_p9999_ms", "ms", "likewise",
       [](R r) { return ms_at(r.workers.fetch_delay, 0.9999); }},
      {"wait_p50_ms", "ms", "of a fiber, from asking for an object to going on",
       [](R r) { return ms_at(r.workers.object_wait, 0.5); }},
      {"wait_p90_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.object_wait, 0.9); }},
      {"wait_p99_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.object_wait, 0.99); }},
      {"wait_p999_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.object_wait, 0.999); }},
      {"wait_p9999_ms", "ms", "likewise", [](R r) { return ms_at(r.workers.object_wait, 0.9999); }},
  };
}

}  // namespace

const std::vector<StudyColumn>& study_columns() {
  static const std::vector<StudyColumn> all = [] {
    std::vector<StudyColumn> columns = of_runs();
    for (const StudyColumn& column : of_objects()) columns.push_back(column);
    return columns;
  }();
  return all;
}

uint64_t flux_hash_of(const Totals& totals) {
  Hasher hash;
  for (int g = 0; g < totals.groups(); ++g) {
    const auto& bins = totals.state(g).totals;
    hash.add(bins.data(), bins.size() * sizeof(Total));
  }
  hash.add(&totals.balance(), sizeof(EnergyBalance));
  return hash.value();
}

const StudyColumn& study_column(std::string_view name) {
  const auto& all = study_columns();
  const auto at =
      std::find_if(all.begin(), all.end(), [&](auto& column) { return column.name == name; });
  LUX_CHECK(at != all.end(), "a plot's column was looked up when its file was read");
  return *at;
}

}  // namespace luxodus

#include "actors/lab/study/calibrate.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include "actors/cast/tally/flush_codec.hpp"
#include "actors/lab/simulate/resident_parts.hpp"
#include "actors/results/run/batch_plan.hpp"
#include "runtime/core/processor_time.hpp"
#include "scenes/light/transport/readout.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace {

/// Particles of a timed piece: about 100 us, long against reading the clock; of different sizes, so
/// that the costs of a particle and of its rays can be separated.
constexpr int64_t piece_particles[] = {8, 16, 32, 64};
constexpr int pieces = 4000;
constexpr int warm_pieces = 200;
constexpr int build_rounds = 20;
constexpr int64_t merged_batches = 200;
constexpr int64_t bins_of_a_step = 16384;  // as a node packs them
constexpr int flushes = 20;

/// The model name that the processor reports.
std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "an unnamed processor";
}

/// Measures the build of every part, by its bytes. The parts are built in turn, so that none finds
/// its data in a near cache from the last time: a node builds what has just arrived, after other
/// work.
Result<void> measure_builds(const CompiledScene& scene, const SceneObjects& objects,
                            SimCosts& costs) {
  PartBuilder builder(scene, objects.parts());
  std::vector<std::vector<double>> rows;
  std::vector<double> values;
  for (int round = 0; round < build_rounds; ++round) {
    for (uint32_t i = 0; i < objects.places().size(); ++i) {
      const double start = thread_seconds();
      const auto built = builder.built(i, objects.bytes(i).bytes);
      if (!built) return built.problem();
      values.push_back(thread_nanoseconds_since(start));
      rows.push_back({1, static_cast<double>(objects.places()[i].wire_bytes)});
    }
  }
  const auto fitted = fitted_costs(rows, values, std::numeric_limits<double>::infinity());
  costs.build_ns = fitted[0];
  costs.build_byte_ns = fitted[1];
  return {};
}

/// Rounds over batches in order, one piece of each.
void measure_pieces(const CompiledScene& scene, BatchTracer& tracer, const ResidentParts& parts,
                    SimCosts& costs) {
  BatchPlan plan(scene);
  BatchScores scores;
  scores.reset(scene.layout);
  std::vector<std::vector<double>> rows;
  std::vector<double> values;
  for (int piece = 0; piece < warm_pieces + pieces; ++piece) {
    const Batch batch = plan.next();
    const int64_t count =
        std::min<int64_t>(piece_particles[static_cast<size_t>(piece) % std::size(piece_particles)],
                          scene.batch_particles);
    const EnergyBalance before = scores.balance;
    const uint64_t references = parts.references();
    const double start = thread_seconds();
    tracer.trace(batch.group, batch.first_particle, count, scores);
    const double taken = thread_nanoseconds_since(start);
    if (piece < warm_pieces) continue;
    rows.push_back({static_cast<double>(count),
                    static_cast<double>(scores.balance.rays - before.rays),
                    static_cast<double>(scores.balance.collisions - before.collisions),
                    static_cast<double>(parts.references() - references)});
    values.push_back(taken);
  }
  const auto fitted = fitted_costs(rows, values);
  costs.particle_ns = fitted[0];
  costs.ray_ns = fitted[1];
  costs.collision_ns = fitted[2];
  costs.reference_ns = fitted[3];
}

void measure_looks(const CompiledScene& scene, BatchTracer& tracer, const ResidentParts& parts,
                   SimCosts& costs) {
  costs.look_ns = 0;
  const uint32_t units = tracer.look_units();
  if (units == 0) return;
  BatchScores scores;
  scores.reset(scene.layout);
  const uint64_t references = parts.references();
  const double start = thread_seconds();
  for (uint32_t unit = 0; unit < units; ++unit) tracer.look(0, unit, scores);
  const double taken = thread_nanoseconds_since(start);
  const double asked = static_cast<double>(parts.references() - references);
  costs.look_ns = std::max(0.0, (taken - asked * costs.reference_ns) / units);
}

}  // namespace

Result<void> measure_tracing(const CompiledScene& scene, SimCosts& costs) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  if (auto built = measure_builds(scene, objects, costs); !built) return built.problem();
  const EmbreeDevice device;
  const ProxyScene proxies(device, scene.cell_boxes);
  ResidentParts parts(scene, objects);
  const auto tracer = make_batch_tracer(scene, GeometryAccess::through(proxies, parts), 1);
  measure_pieces(scene, *tracer, parts, costs);
  measure_looks(scene, *tracer, parts, costs);
  if (parts.problem()) return *parts.problem();
  return {};
}

Result<void> measure_counting(const CompiledScene& scene, SimCosts& costs) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  const EmbreeDevice device;
  const ProxyScene proxies(device, scene.cell_boxes);
  ResidentParts parts(scene, objects);
  const auto tracer = make_batch_tracer(scene, GeometryAccess::through(proxies, parts), 1);
  const auto groups = static_cast<int>(scene.groups.size());
  Totals own(scene.layout, groups, photopic_weights(scene));
  Totals all(scene.layout, groups, photopic_weights(scene));
  BatchScores scores;
  scores.reset(scene.layout);
  BatchPlan plan(scene);
  FlushEncoder encoder(groups, scene.layout.totals());
  double leases_ns = 0, pack_ns = 0, count_ns = 0, bytes = 0;
  for (int flush = 0; flush < flushes; ++flush) {
    for (int64_t i = 0; i < merged_batches / flushes; ++i) {
      const Batch batch = plan.next();
      tracer->trace(batch.group, batch.first_particle, scene.batch_particles, scores);
      const double start = thread_seconds();
      own.merge(scores, batch.group);
      scores.reset(scene.layout);
      leases_ns += thread_nanoseconds_since(start);
    }
    double start = thread_seconds();
    encoder.begin(own);
    while (!encoder.step(bins_of_a_step)) {
    }
    pack_ns += thread_nanoseconds_since(start);
    bytes += static_cast<double>(encoder.bytes().size());
    start = thread_seconds();
    auto gain = decode_flush(encoder.bytes(), groups, scene.layout.totals());
    if (!gain) return gain.problem();
    gain->add_to(all);
    count_ns += thread_nanoseconds_since(start);
  }
  if (parts.problem()) return *parts.problem();
  costs.lease_ns = leases_ns / static_cast<double>(merged_batches);
  costs.pack_byte_ns = pack_ns / bytes;
  costs.count_byte_ns = count_ns / bytes;
  return {};
}

Result<MeasuredCosts> calibrate(const CompiledScene& scene,
                                const std::function<void(const std::string&)>& report) {
  MeasuredCosts measured;
  measured.machine = machine_name();
  measured.scene = scene.description->name;
  report("tracing and building");
  if (auto done = measure_tracing(scene, measured.costs); !done) return done.problem();
  report("counting");
  if (auto done = measure_counting(scene, measured.costs); !done) return done.problem();
  report("fibers and links");
  if (auto done = measure_loop(measured.costs); !done) return done.problem();
  return measured;
}

}  // namespace luxodus

#include "actors/results/run/flux_store.hpp"

#include <algorithm>
#include <cstring>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/run/batch_plan.hpp"
#include "scenes/light/transport/value_scores.hpp"

namespace luxodus {

namespace limits {
/// With more, squares of their scores would exceed 128 bits: see Totals::square_shift.
inline constexpr int64_t batches = int64_t{1} << 26;
}  // namespace limits

namespace {

std::string hex(uint64_t v) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(v));
  return text;
}

template <class T>
Block block_of(const std::string& name, const T* values, size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  Block block{name, std::vector<std::byte>(count * sizeof(T))};
  if (count > 0) std::memcpy(block.bytes.data(), values, block.bytes.size());
  return block;
}

std::string group_block_name(int group) {
  return "totals/" + std::to_string(group);
}

Json describe_layout(const TallyLayout& layout) {
  Json blocks = Json::array();
  for (const TallyBlock& b : layout.blocks()) {
    blocks.push_back({{"name", b.name},
                      {"bins", b.bins},
                      {"quantities", b.quantities},
                      {"channels", b.banded ? layout.channels() : 1},
                      {"first_total", b.first_total}});
  }
  return blocks;
}

Json describe_run(const LocalRun& run) {
  const CompiledScene& scene = run.scene();
  Json bands = Json::array();
  for (int b = 0; b < scene.bands.count(); ++b) {
    bands.push_back({scene.bands[b].low_nm, scene.bands[b].high_nm});
  }
  Json groups = Json::array();
  for (int g = 0; g < run.totals().groups(); ++g) {
    groups.push_back({{"name", scene.groups[static_cast<size_t>(g)].name},
                      {"batches", run.totals().batches(g)}});
  }
  Json header = {
      {"schema", limits::flux_schema_version},
      {"scene_hash", hex(scene.scene_hash)},
      {"scenario", scene.scenario.name},
      {"seed", run.seed()},
      {"batches", run.batches()},
      {"batch_particles", scene.batch_particles},
      {"bands_nm", bands},
      {"groups", groups},
      {"total", "128-bit sum, 128-bit sum of squares of (batch score / 2^12), little endian"},
      {"layout", describe_layout(scene.layout)}};
  if (scene.light_quantum != limits::value_quantum) header["light_quantum"] = scene.light_quantum;
  if (!run.missing().empty()) header["missing"] = run.missing();
  return header;
}

/// Batches that the totals lack. Errors: not an ascending list of batch numbers.
Result<std::vector<int64_t>> missing_of(const Json& header, int64_t batches,
                                        const SourcePlace& place) {
  std::vector<int64_t> missing;
  const Json numbers = header.contains("missing") ? header["missing"] : Json::array();
  if (!numbers.is_array()) return problem_in(place, "the flux file's missing batches are no list");
  for (const Json& number : numbers) {
    const int64_t batch = number.is_number_integer() ? number.get<int64_t>() : -1;
    if (batch < 0 || batch >= batches || (!missing.empty() && batch <= missing.back()))
      return problem_in(place,
                        "the flux file's missing batches are no ascending numbers below its "
                        "batches: it is damaged");
    missing.push_back(batch);
  }
  return missing;
}

/// The content of the totals, according to the header.
struct Counted {
  int64_t batches = 0;           // batches given out
  std::vector<int64_t> missing;  // those of them that the totals lack
  std::vector<int64_t> groups;   // batches of each source group in the totals

  int64_t traced() const { return batches - static_cast<int64_t>(missing.size()); }
};

/// Errors: invalid counts, or counts that contradict the plan that all runs of the scene share: too
/// low a count would have batches traced and counted twice.
Result<Counted> counted_of(const Json& header, const LocalRun& run, const SourcePlace& place) {
  const auto count_in = [](const Json& object) -> int64_t {
    if (!object.is_object() || !object.contains("batches")) return -1;
    const Json& number = object["batches"];
    if (!number.is_number_integer()) return -1;
    const bool small = !number.is_number_unsigned() || number.get<uint64_t>() <= limits::batches;
    return small ? std::min<int64_t>(number.get<int64_t>(), limits::batches) : -1;
  };
  Counted out;
  out.batches = count_in(header);
  if (out.batches < 0)
    return problem_in(place, "the flux file does not say how many batches it holds: it is damaged");
  auto missing = missing_of(header, out.batches, place);
  if (!missing) return missing.problem();
  out.missing = std::move(missing).value();
  const CompiledScene& scene = run.scene();
  std::vector<int64_t> planned(scene.groups.size(), 0);
  BatchPlan plan(scene);
  auto lacks = out.missing.begin();
  for (int64_t batch = 0; batch < out.batches; ++batch) {
    const auto group = static_cast<size_t>(plan.next().group);
    const bool is_missing = lacks != out.missing.end() && *lacks == batch;
    if (is_missing) ++lacks;
    planned[group] += is_missing ? 0 : 1;
  }
  const Json groups = header.contains("groups") ? header["groups"] : Json();
  if (!groups.is_array() || groups.size() != planned.size())
    return problem_in(place,
                      "the flux file has not the source groups of this scene: it is damaged");
  for (size_t g = 0; g < planned.size(); ++g) {
    if (count_in(groups[g]) != planned[g])
      return problem_in(place, "the flux file counts batches of source group " + std::to_string(g) +
                                   " that are not those of its run: it is damaged");
  }
  out.groups = std::move(planned);
  return out;
}

Result<void> same(const Json& header, const Json& wanted, const char* key,
                  const SourcePlace& place) {
  const Json found = header.value(key, Json());
  if (found == wanted[key]) return {};
  return problem_in(place, std::string("this flux is of another ") + key + " (" + found.dump() +
                               " here, the run has " + wanted[key].dump() +
                               "): the scene or its options have changed since, so run it again, "
                               "without --resume");
}

/// Scores of light count quanta. Files without this key are of the usual quantum, or older than
/// quanta that follow the scene; those were all of the usual one.
Result<void> same_quantum(const Json& header, const CompiledScene& scene,
                          const SourcePlace& place) {
  const Json quantum = header.value("light_quantum", Json(limits::value_quantum));
  if (quantum.is_number() && quantum.get<double>() == scene.light_quantum) return {};
  return problem_in(place, "this flux counts light in another quantum (" + quantum.dump() +
                               " here, the run has " + Json(scene.light_quantum).dump() +
                               "): another version of luxodus has written it, so run it again, "
                               "without --resume");
}

}  // namespace

FluxFile flux_of(const LocalRun& run) {
  FluxFile file;
  file.header_json = describe_run(run).dump(1);
  const Totals& totals = run.totals();
  file.blocks.push_back(block_of("ledger", &totals.balance(), 1));
  for (int g = 0; g < totals.groups(); ++g) {
    const auto& state = totals.state(g);
    file.blocks.push_back(block_of(group_block_name(g), state.totals.data(), state.totals.size()));
  }
  return file;
}

Result<void> save_flux(const std::filesystem::path& path, const LocalRun& run) {
  return write_flux_file(path, flux_of(run));
}

Result<void> load_flux(const std::filesystem::path& path, LocalRun& run) {
  auto read = read_flux_file(path);
  if (!read) return read.problem();
  return take_flux(read.value(), {path.string(), 0}, run);
}

Result<void> take_flux(const FluxFile& file, const SourcePlace& place, LocalRun& run) {
  const Json header = Json::parse(file.header_json);
  if (!header.is_object()) return problem_in(place, "the flux file's header is no JSON object");
  const Json wanted = describe_run(run);
  for (const char* key :
       {"schema", "scenario", "seed", "scene_hash", "batch_particles", "layout"}) {
    if (auto ok = same(header, wanted, key, place); !ok) return ok.problem();
  }
  if (auto ok = same_quantum(header, run.scene(), place); !ok) return ok.problem();
  Totals& totals = run.totals();
  const Block* ledger_block = file.find("ledger");
  if (ledger_block == nullptr || ledger_block->bytes.size() != sizeof(EnergyBalance))
    return problem_in(place, "the flux file holds no ledger of the expected size");
  EnergyBalance balance;
  std::memcpy(&balance, ledger_block->bytes.data(), sizeof balance);
  auto counted = counted_of(header, run, place);
  if (!counted) return counted.problem();
  const auto particles =
      static_cast<uint64_t>(counted->traced()) * static_cast<uint64_t>(run.scene().batch_particles);
  if (balance.particles != particles)
    return problem_in(place, "the flux file's ledger has " + std::to_string(balance.particles) +
                                 " particles, its batches " + std::to_string(particles) +
                                 ": it is damaged");
  for (int g = 0; g < totals.groups(); ++g) {
    const Block* block = file.find(group_block_name(g));
    const size_t count = static_cast<size_t>(run.scene().layout.totals());
    if (block == nullptr || block->bytes.size() != count * sizeof(Total)) {
      return problem_in(place, "the flux file lacks totals of source group " + std::to_string(g));
    }
    Totals::GroupState state;
    state.totals = SparseArray<Total>(static_cast<int64_t>(count));
    for (size_t i = 0; i < count; ++i) {
      Total total;
      std::memcpy(&total, block->bytes.data() + i * sizeof total, sizeof total);
      if (total.sum != 0 || total.squares != 0)
        *state.totals.touch(static_cast<int64_t>(i)) = total;
    }
    state.batches = counted->groups[static_cast<size_t>(g)];
    totals.restore(g, std::move(state));
  }
  totals.restore_ledger(balance);
  run.resume(counted->batches, std::move(counted->missing));
  run.forget_time();
  return {};
}

}  // namespace luxodus

#include "actors/cast/journal/flux_journal.hpp"

#include <algorithm>
#include <cstring>

#include "actors/cast/tally/flush_codec.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {

/// Hash of everything that two runs must share so that their flushes can be added.
uint64_t identity_of(const LocalRun& run) {
  const CompiledScene& scene = run.scene();
  Hasher hash;
  hash.add(scene.scene_hash);
  hash.add(run.seed());
  hash.add(scene.scenario.name);
  hash.add(static_cast<uint64_t>(scene.layout.totals()));
  return hash.value();
}

/// Counts the records of a journal into a run.
class Recovery {
 public:
  explicit Recovery(LocalRun& run) : run_(run) {
    for (int64_t batch = 0; batch < run.batches(); ++batch) done_.insert(batch);
    for (const int64_t batch : run.missing()) done_.erase(batch);
  }

  /// False: the record is invalid, or a part of it is counted already.
  bool count(std::span<const std::byte> record) {
    uint64_t batches = 0;
    if (record.size() < sizeof batches) return false;
    std::memcpy(&batches, record.data(), sizeof batches);
    record = record.subspan(sizeof batches);
    if (batches == 0 || batches > record.size() / sizeof(int64_t)) return false;
    std::vector<int64_t> numbers(batches);
    std::memcpy(numbers.data(), record.data(), batches * sizeof(int64_t));
    const std::set<int64_t> distinct(numbers.begin(), numbers.end());
    if (distinct.size() != batches || *distinct.begin() < 0) return false;
    const auto known = std::count_if(numbers.begin(), numbers.end(),
                                     [&](int64_t batch) { return done_.count(batch) > 0; });
    if (known == static_cast<int64_t>(batches)) return true;  // the flux file is newer
    return known == 0 && add(distinct, record.subspan(batches * sizeof(int64_t)));
  }

  int64_t recovered() const { return recovered_; }

  void go_on() const {
    if (recovered_ == 0) return;
    // A snapshot may know of batches that were leased beyond the last counted one.
    const int64_t end = std::max(run_.batches(), *done_.rbegin() + 1);
    std::vector<int64_t> missing;
    for (int64_t batch = 0; batch < end; ++batch)
      if (done_.count(batch) == 0) missing.push_back(batch);
    run_.resume(end, std::move(missing));
    run_.forget_time();
  }

 private:
  bool add(const std::set<int64_t>& batches, std::span<const std::byte> flush) {
    Totals& totals = run_.totals();
    const auto gain = decode_flush(flush, totals.groups(), totals.layout().totals());
    if (!gain || gain->batches() != static_cast<int64_t>(batches.size())) return false;
    gain->add_to(totals);
    done_.insert(batches.begin(), batches.end());
    recovered_ += gain->batches();
    return true;
  }

  LocalRun& run_;
  std::set<int64_t> done_;
  int64_t recovered_ = 0;
};

}  // namespace

Result<std::unique_ptr<FluxJournal>> FluxJournal::open(std::unique_ptr<AppendStore> store,
                                                       LocalRun& run) {
  Recovery recovery(run);
  auto journal =
      Journal::open(std::move(store), identity_of(run),
                    [&](std::span<const std::byte> record) { return recovery.count(record); });
  if (!journal) return journal.problem();
  recovery.go_on();
  return std::unique_ptr<FluxJournal>(
      new FluxJournal(std::move(journal).value(), recovery.recovered()));
}

Result<void> FluxJournal::keep(std::span<const int64_t> batches, std::span<const std::byte> flush) {
  const uint64_t count = batches.size();
  const size_t head = sizeof count + batches.size_bytes();
  record_.resize(head + flush.size());
  std::memcpy(record_.data(), &count, sizeof count);
  std::memcpy(record_.data() + sizeof count, batches.data(), batches.size_bytes());
  std::memcpy(record_.data() + head, flush.data(), flush.size());
  return journal_.append(record_);
}

}  // namespace luxodus

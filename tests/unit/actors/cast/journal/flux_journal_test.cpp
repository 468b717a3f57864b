#include "actors/cast/journal/flux_journal.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>

#include "actors/cast/process/run_journal.hpp"
#include "actors/cast/tally/flush_codec.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/storage/memory_store.hpp"
#include "tests/kit/encode_flush.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

namespace {

/// Traces single batches into flushes, as a worker does.
class Worker {
 public:
  explicit Worker(const LocalRun& run)
      : run_(run),
        tracer_(make_batch_tracer(run.scene(), GeometryAccess::resident(run.index()), run.seed())) {
  }

  std::vector<std::byte> flush_of(int64_t number) const {
    const CompiledScene& scene = run_.scene();
    BatchPlan plan(scene);
    plan.skip(number);
    const Batch batch = plan.next();
    BatchScores scores;
    scores.reset(scene.layout);
    tracer_->trace(batch.group, batch.first_particle, scene.batch_particles, scores);
    for (uint32_t unit = 0; unit < tracer_->look_units(); ++unit)
      tracer_->look(batch.number, unit, scores);
    Totals totals(scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene));
    totals.merge(scores, batch.group);
    return test::encode_flush(totals);
  }

 private:
  const LocalRun& run_;
  std::unique_ptr<BatchTracer> tracer_;
};

void trace(LocalRun& run, int64_t batches) {
  StopRule stop;
  stop.particles = batches * run.scene().batch_particles;
  run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
}

bool same(const LocalRun& a, const LocalRun& b) {
  if (std::memcmp(&a.totals().balance(), &b.totals().balance(), sizeof(EnergyBalance)) != 0)
    return false;
  for (int g = 0; g < a.totals().groups(); ++g) {
    const auto &x = a.totals().state(g), &y = b.totals().state(g);
    if (x.batches != y.batches ||
        std::memcmp(x.totals.data(), y.totals.data(), x.totals.size() * sizeof(Total)) != 0)
      return false;
  }
  return true;
}

std::unique_ptr<FluxJournal> opened(std::vector<std::byte>& bytes, LocalRun& run) {
  auto journal = FluxJournal::open(std::make_unique<MemoryStore>(bytes), run);
  REQUIRE(journal.ok());
  return std::move(journal).value();
}

}  // namespace

TEST_CASE("a run restarted from its journal at any point ends like one that never stopped",
          "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun whole(scene, 1, 1);
  trace(whole, 5);
  const Worker worker(whole);
  const std::vector<int64_t> order = {1, 0, 4, 2, 3};  // flushes arrive in any order
  for (size_t stop = 0; stop <= order.size(); ++stop) {
    INFO("stopped after " << stop << " flushes");
    std::vector<std::byte> disk;
    {
      LocalRun first(scene, 1, 1);
      const auto journal = opened(disk, first);
      for (size_t i = 0; i < stop; ++i)
        REQUIRE(journal->keep(std::array{order[i]}, worker.flush_of(order[i])).ok());
    }
    disk.push_back(std::byte{9});  // and a torn end
    LocalRun second(scene, 1, 1);
    const auto journal = opened(disk, second);
    CHECK(journal->recovered() == static_cast<int64_t>(stop));
    CHECK(journal->torn_bytes() == 1);
    CHECK(second.traced() == static_cast<int64_t>(stop));
    trace(second, 5);
    CHECK(same(whole, second));
  }
}

TEST_CASE("a journal that is partly older than the flux file is counted once", "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun whole(scene, 1, 1);
  trace(whole, 3);
  const Worker worker(whole);
  std::vector<std::byte> disk;
  {
    LocalRun first(scene, 1, 1);
    const auto journal = opened(disk, first);
    for (int64_t batch = 0; batch < 3; ++batch)
      REQUIRE(journal->keep(std::array{batch}, worker.flush_of(batch)).ok());
  }
  LocalRun second(scene, 1, 1);
  trace(second, 2);  // as in a flux file
  const auto journal = opened(disk, second);
  CHECK(journal->recovered() == 1);
  CHECK(same(whole, second));
}

TEST_CASE("a journal with a snapshot gives the same bits, whether it was emptied or not",
          "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun whole(scene, 1, 1);
  trace(whole, 4);
  const Worker worker(whole);
  const test::TemporaryFolder folder;
  RunJournalConfig config;
  config.folder = folder.path();
  config.max_bytes = 1;
  const SystemClock clock;
  const bool cut = GENERATE(true, false);  // whether a crash came before the journal was emptied
  {
    LocalRun first(scene, 1, 1);
    const auto journal = RunJournal::open(config, first, clock);
    REQUIRE(journal.ok());
    for (int64_t batch = 0; batch < 2; ++batch)
      REQUIRE(journal.value()->keep(std::array{batch}, worker.flush_of(batch)).ok());
    trace(first, 2);  // the totals hold everything journaled
    REQUIRE(journal.value()->rest_is_due());
    if (cut)
      journal.value()->rest();
    else
      REQUIRE(save_flux(folder / "run.snapshot", first).ok());
    REQUIRE(journal.value()->keep(std::array<int64_t, 1>{3}, worker.flush_of(3)).ok());
  }
  LocalRun second(scene, 1, 1);
  const auto journal = RunJournal::open(config, second, clock);
  REQUIRE(journal.ok());
  CHECK(journal.value()->recovered() == 3);
  CHECK(second.missing() == std::vector<int64_t>{2});
  trace(second, 4);
  CHECK(same(whole, second));
  journal.value()->remove();
  CHECK(folder.entries() == 0);
}

// A recovered run once ended without the last batches, and took itself for complete.
TEST_CASE("batches missing at a snapshot's end are still missing after the journal is counted",
          "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun whole(scene, 1, 1);
  trace(whole, 5);
  const Worker worker(whole);
  const test::TemporaryFolder folder;
  RunJournalConfig config;
  config.folder = folder.path();
  config.max_bytes = 1;
  const SystemClock clock;
  {
    LocalRun first(scene, 1, 1);
    const auto journal = RunJournal::open(config, first, clock);
    REQUIRE(journal.ok());
    trace(first, 1);
    first.resume(5, {1, 2, 3, 4});  // all are leased, and one is counted
    journal.value()->rest();
    REQUIRE(journal.value()->keep(std::array<int64_t, 1>{2}, worker.flush_of(2)).ok());
  }
  LocalRun second(scene, 1, 1);
  const auto journal = RunJournal::open(config, second, clock);
  REQUIRE(journal.ok());
  CHECK(second.traced() == 2);
  CHECK(second.batches() == 5);
  CHECK(second.missing() == std::vector<int64_t>{1, 3, 4});
  trace(second, 5);
  CHECK(same(whole, second));
}

TEST_CASE("a flush that a full disk kept out of the journal is in a snapshot, and nothing is lost",
          "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun whole(scene, 1, 1);
  trace(whole, 4);
  const Worker worker(whole);
  const test::TemporaryFolder folder;
  ManualClock clock;
  RunJournalConfig config;
  config.folder = folder.path();
  config.retry = seconds(10);
  config.faults.faults.push_back({Fault::Kind::full_disk, seconds(5), seconds(60), {}, {}});
  {
    LocalRun first(scene, 1, 1);
    const auto journal = RunJournal::open(config, first, clock);
    REQUIRE(journal.ok());
    const auto keep = [&](int64_t batch) {
      const bool kept = journal.value()->keep(std::array{batch}, worker.flush_of(batch)).ok();
      trace(first, batch + 1);  // counted all the same
      return kept;
    };
    CHECK(keep(0));
    CHECK_FALSE(journal.value()->rest_is_due());
    clock.advance(seconds(6));
    CHECK(journal.value()->is_whole());
    CHECK_FALSE(keep(1));
    CHECK_FALSE(journal.value()->is_whole());  // so the controller keeps its workers
    REQUIRE(journal.value()->rest_is_due());
    journal.value()->rest();
    CHECK(journal.value()->is_whole());
    CHECK_FALSE(journal.value()->rest_is_due());
    CHECK_FALSE(keep(2));
    CHECK_FALSE(journal.value()->rest_is_due());  // not after every flush
    clock.advance(seconds(10));
    REQUIRE(journal.value()->rest_is_due());
    journal.value()->rest();
    clock.advance(seconds(60));
    CHECK(keep(3));  // there is space again
  }
  LocalRun second(scene, 1, 1);
  config.faults = {};
  const auto journal = RunJournal::open(config, second, clock);
  REQUIRE(journal.ok());
  CHECK(journal.value()->recovered() == 4);
  CHECK(same(whole, second));
}

TEST_CASE("a failed snapshot is retried, and the journal stays as it is", "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun run(scene, 1, 1);
  const Worker worker(run);
  const test::TemporaryFolder folder;
  ManualClock clock;
  RunJournalConfig config;
  config.folder = folder.path();
  config.max_bytes = 1;
  const auto journal = RunJournal::open(config, run, clock);
  REQUIRE(journal.ok());
  REQUIRE(journal.value()->keep(std::array<int64_t, 1>{0}, worker.flush_of(0)).ok());
  trace(run, 1);
  const auto journal_bytes = [&] { return std::filesystem::file_size(folder / "run.journal"); };
  const auto before = journal_bytes();
  std::filesystem::create_directory(folder / "run.snapshot");  // a folder in the snapshot's place
  REQUIRE(journal.value()->rest_is_due());
  journal.value()->rest();
  CHECK(journal_bytes() == before);
  CHECK_FALSE(journal.value()->rest_is_due());
  std::filesystem::remove(folder / "run.snapshot");
  clock.advance(config.retry);
  REQUIRE(journal.value()->rest_is_due());
  journal.value()->rest();
  CHECK(std::filesystem::is_regular_file(folder / "run.snapshot"));
  CHECK(journal_bytes() < before);
}

TEST_CASE("a run continued from its flux file after any batch ends like one that never stopped",
          "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  constexpr int64_t batches = 5;
  LocalRun whole(scene, 1, 1);
  trace(whole, batches);
  const test::TemporaryFolder folder;
  const auto file = folder / "boundaries.lux";
  for (int64_t stop = 0; stop <= batches; ++stop) {
    INFO("stopped after " << stop << " batches");
    LocalRun first(scene, 1, 1);
    trace(first, stop);
    REQUIRE(save_flux(file, first).ok());
    LocalRun second(scene, 1, 1);
    REQUIRE(load_flux(file, second).ok());
    CHECK(second.traced() == stop);
    trace(second, batches);
    CHECK(same(whole, second));
  }
}

TEST_CASE("records of another run are rejected", "[journal]") {
  const auto scene = scene_of("smoke_tank", "", 1);
  LocalRun run(scene, 1, 1);
  const Worker worker(run);
  std::vector<std::byte> disk;
  const std::vector<std::byte> flush = worker.flush_of(0);
  const auto refused = [&](LocalRun& other) {
    const auto journal = FluxJournal::open(std::make_unique<MemoryStore>(disk), other);
    return journal.ok() ? std::string() : journal.problem().what;
  };
  SECTION("another seed") {
    opened(disk, run);
    LocalRun other(scene, 2, 1);
    CHECK(refused(other).find("another run") != std::string::npos);
  }
  SECTION("one flush for two batches") {
    REQUIRE(opened(disk, run)->keep(std::array<int64_t, 2>{0, 1}, flush).ok());
    CHECK(refused(run).find("does not belong") != std::string::npos);
  }
  SECTION("a flush that is counted in part") {
    REQUIRE(opened(disk, run)->keep(std::array<int64_t, 2>{0, 1}, flush).ok());
    LocalRun other(scene, 1, 1);
    trace(other, 1);
    CHECK(refused(other).find("does not belong") != std::string::npos);
  }
  SECTION("no flush") {
    REQUIRE(opened(disk, run)->keep(std::array<int64_t, 1>{0}, {}).ok());
    CHECK(refused(run).find("does not belong") != std::string::npos);
  }
}

// The batches of a live run, and who traces them: threads of this process, or nodes of a cluster
// (live_cluster.hpp). What they give is the same to the bit. Thread rule: LiveWork may be called
// from any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "scenes/tally/totals.hpp"
#include "scenes/transport/trace.hpp"

namespace luxodus {

struct SceneEdits;

/// Batches [first, first + count) of a source group.
struct LiveBatches {
  int group = 0;
  int stream = 0;  // what stands for the group in the ids of its particles
  int64_t first = 0;
  int64_t count = 0;
};

/// The id of the first particle of a batch.
uint64_t first_particle_of(const CompiledScene& scene, int stream, int64_t batch);

/// What is to be traced now.
class LiveWork {
 public:
  virtual ~LiveWork() = default;
  virtual const CompiledScene& scene() const = 0;
  virtual GeometryAccess access() const = 0;
  virtual uint64_t seed() const = 0;
  /// Up to `most` batches; none where there are no more, or somebody wants it to stop. Whoever
  /// takes some merges what they give into totals(), or gives them back.
  virtual std::optional<LiveBatches> next(int64_t most) = 0;
  /// Batches that next() has still to give, unless it is stopped.
  virtual int64_t left() = 0;
  virtual void give_back(const LiveBatches& batches) = 0;
  virtual bool stopped() const = 0;
  virtual Totals& totals() = 0;
};

class LiveTracers {
 public:
  virtual ~LiveTracers() = default;
  /// A building that may be entered next: what takes time may begin.
  virtual void foresee(const SceneEdits& edits) = 0;
  /// The building of what is traced from now on.
  virtual void enter(const SceneEdits& edits) = 0;
  /// Returns when next() has given none, and all that it gave is merged or given back.
  virtual void trace(LiveWork& work) = 0;
};

/// Threads of this process.
class LiveThreads final : public LiveTracers {
 public:
  /// Requires: threads >= 1.
  explicit LiveThreads(int threads) : threads_(threads) {}
  void foresee(const SceneEdits&) override {}
  void enter(const SceneEdits&) override {}
  void trace(LiveWork& work) override;

 private:
  int threads_;
};

}  // namespace luxodus

// A parallel_for for scenes that do not fit into memory: every thread is a node without links,
// whose fibers wait for objects from the scene's own storage, a pack or the process's memory. So
// computations on a result (direct light, pictures) access the scene's parts as tracing does.
// Thread rule: run() from one thread at a time.
#pragma once

#include <memory>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct OutOfCoreConfig {
  int threads = 1;
  size_t fibers = 256;      // per thread
  size_t object_bytes = 0;  // for built objects, of all threads together
  bool sharing = true;      // an object used by several threads is built once
};

class OutOfCoreParallelFor final : public ParallelFor {
 public:
  /// Requires: in_parts(scene).
  OutOfCoreParallelFor(std::shared_ptr<const CompiledScene> scene, const OutOfCoreConfig& config);
  ~OutOfCoreParallelFor() override;

  /// Errors (exception): a budget without room for an object and a build; a pack without objects.
  void run(int64_t rows, const MakeWorker& make, const Finished& finished) const override;

 private:
  struct Stored;
  std::shared_ptr<const CompiledScene> scene_;
  OutOfCoreConfig config_;
  std::unique_ptr<Stored> stored_;
};

}  // namespace luxodus

// Rows of work where a scene does not fit into memory: every thread is a node without links, whose
// fibers wait for objects out of the scene's own storage, a pack or the process's memory. So what
// is computed of a result (direct light, pictures) reaches the scene's parts as tracing does.
#pragma once

#include <memory>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct OutOfCoreConfig {
  int threads = 1;
  size_t fibers = 256;      // of a thread
  size_t object_bytes = 0;  // for built objects, of all threads together
  bool sharing = true;      // an object that several threads have is built once
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

// A run for Python: a scenario of a scene, traced on threads or nodes of this process, and its
// results. Called with the interpreter's lock, which is released during computations.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <string>

#include "actors/apps/python/scene.hpp"
#include "actors/results/files/run_results.hpp"
#include "actors/results/run/run_executor.hpp"

namespace luxodus::python {

class TracedRun {
 public:
  /// `executor`: null for the run's threads.
  TracedRun(std::unique_ptr<LocalRun> run, std::unique_ptr<RunExecutor> executor, RunRecord record);

  /// Traces until the rule holds. Errors: as work_apart; Refused: as RunExecutor::run, another
  /// Python thread is tracing.
  void trace(const StopRule& stop, const pybind11::object& progress);

  // Results, made on first access, and again after further tracing.
  const pybind11::dict& result();  // result.json
  const pybind11::dict& planes();
  pybind11::object patches();
  pybind11::object voxels();
  pybind11::dict energy_balance();
  /// Errors (Refused): as check_views.
  pybind11::object render(const std::string& camera, int paths, const pybind11::object& progress);

  const LocalRun& run() const { return *run_; }
  const std::string& stopped_by() const { return record_.stopped_by; }
  /// At the end of the last call that traced.
  int64_t particles() const { return particles_; }

 private:
  class Claim;
  void compute();

  std::unique_ptr<LocalRun> run_;
  std::unique_ptr<RunExecutor> executor_;
  RunRecord record_;
  std::atomic<bool> taken_{false};  // by a Python thread that has released the lock
  bool computed_ = false;
  int64_t particles_ = 0;
  pybind11::dict result_, planes_;
};

/// Adds Run to the module.
void add_run(pybind11::module_& module);
/// Adds run() to Scene.
void add_tracing(pybind11::class_<OpenScene>& scene);

}  // namespace luxodus::python

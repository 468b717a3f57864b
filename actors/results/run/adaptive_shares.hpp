// Allocates batches adaptively: the share of each source group by which the error that a run is
// judged by falls fastest. Pure functions of scene and seed; any thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "actors/results/run/local_run.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// Shares of the groups [1] that minimise the largest error that the scene is judged by, from the
/// deviations of each group's batches so far (J. Neyman, J. R. Stat. Soc. 97, 1934, for one
/// result). No group gets less than a tenth of its `usual` share.
/// Requires: at least two batches of each group in `totals`.
std::vector<double> adaptive_shares(const CompiledScene& scene, const Totals& totals,
                                    const std::vector<double>& usual);

/// Traces a first round of small batches, the same number for each group, with random numbers that
/// the run does not use. So the run stays without bias: only the shares of the round are kept.
/// Errors: a single source group; a scene judged only by probes and signs, which are traced from
/// the eye and not from the sources; interrupted.
Result<std::vector<double>> find_adaptive_shares(
    const std::shared_ptr<const CompiledScene>& scene, uint64_t seed, int threads,
    const std::atomic<bool>& interrupt, const std::function<void(const Progress&)>& report);

/// The scene with these shares. `options`: those that it was compiled with.
/// Errors: as find_adaptive_shares and compile_scene.
Result<std::shared_ptr<const CompiledScene>> dealt_adaptively(
    const std::shared_ptr<const CompiledScene>& scene, CompileOptions options, uint64_t seed,
    int threads, const std::atomic<bool>& interrupt,
    const std::function<void(const Progress&)>& report);

}  // namespace luxodus

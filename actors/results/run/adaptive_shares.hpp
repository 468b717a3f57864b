// Batches dealt by need: how many each source group gets, so that the error by which a run is
// judged falls fastest. Pure functions of scene and seed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "actors/results/run/local_run.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

/// Shares of the groups [1] that make the worst of what the scene is judged by least wrong, by the
/// deviation that the batches of each group had so far (J. Neyman, J. R. Stat. Soc. 97, 1934, for
/// one result). No group gets less than a tenth of its `usual` share.
/// Requires: at least two batches of each group in `totals`.
std::vector<double> adaptive_shares(const CompiledScene& scene, const Totals& totals,
                                    const std::vector<double>& usual);

/// Traces a first round, small batches of all groups alike, with random numbers that the run itself
/// does not use, and so leaves it without bias; nothing of the round is kept but these shares.
/// Errors: a single source group; a scene judged by nothing but probes and signs, which are seen
/// from the eye and not from the sources; interrupted.
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

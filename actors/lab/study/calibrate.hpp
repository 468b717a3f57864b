// Measures the costs of work on this machine, with the production parts of a node and mostly by the
// CPU time of one thread, so that other load disturbs little. Takes about twenty seconds. Thread
// rule: the calling thread, and one more while links are measured.
#pragma once

#include <functional>
#include <string>

#include "actors/lab/study/study_file.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Requires: a scene in parts. `report` receives what is being measured. Errors: parts that cannot
/// be built; links that cannot be opened.
Result<MeasuredCosts> calibrate(const CompiledScene& scene,
                                const std::function<void(const std::string&)>& report);

// The separate measurements.

/// particle, ray, collision, reference, look, build, build_byte.
Result<void> measure_tracing(const CompiledScene& scene, SimCosts& costs);
/// lease, pack_byte, count_byte.
Result<void> measure_counting(const CompiledScene& scene, SimCosts& costs);
/// switch, turn, receive, send, frame_byte, wake.
Result<void> measure_loop(SimCosts& costs);

/// Non-negative x with the least squares of the relative errors of `rows` x = `values`, scaled so
/// that the sums agree. Rows that are more than `disturbed` times the prediction of the others were
/// delayed by other load and are left out. Requires: as many rows as values, rows of one length.
std::vector<double> fitted_costs(const std::vector<std::vector<double>>& rows,
                                 const std::vector<double>& values, double disturbed = 3);

}  // namespace luxodus

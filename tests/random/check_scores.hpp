// Properties of the scores of one batch and of values read from totals, in integers where possible.
// Each fault is a sentence. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::test {

using Findings = std::vector<std::string>;

/// Properties that a scene's balance must have.
struct Expected {
  bool closed = false;   // no light escapes
  bool patient = false;  // light may survive longer than the longest history
};

void check_ledger(const CompiledScene& scene, const EnergyBalance& balance,
                  const Expected& expected, Findings& findings);
void check_batch(const CompiledScene& scene, const BatchScores& batch, Findings& findings);
void check_readout(const CompiledScene& scene, const Totals& totals, Findings& findings);
void check_same(const Totals& totals, const Totals& again, const std::string& way,
                Findings& findings);

}  // namespace luxodus::test

// What two machines must have in common for equal bits: the instruction set that decides how
// numbers are rounded, and, as a proof, the scores of particles traced on a tiny scene. Pure; any
// thread.
#pragma once

#include <cstdint>
#include <string>

namespace luxodus {

/// The instruction set this program was built for and the largest that Embree's kernels take here.
std::string isa_in_use();

/// Hash of the scores of 4096 particles in a room with smoke; the same wherever bits are. Computed
/// once a process.
uint64_t numeric_fingerprint();

}  // namespace luxodus

// What two machines must have in common for equal bits: the instruction set that decides how
// numbers are rounded, and, as a check, the scores of particles traced in a tiny scene. Pure; any
// thread.
#pragma once

#include <cstdint>
#include <string>

namespace luxodus {

/// The instruction set of this build, and the largest that Embree's kernels use here.
std::string isa_in_use();

/// Hash of the scores of 4096 particles in a room with smoke; equal on all machines with equal
/// bits. Computed once per process.
uint64_t numeric_fingerprint();

}  // namespace luxodus

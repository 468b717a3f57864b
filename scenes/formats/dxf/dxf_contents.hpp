// Puts what blocks hold into the plan, in place of the references to them. Pure functions; any
// thread.
#pragma once

#include <functional>
#include <string>

#include "scenes/formats/dxf/dxf_plan.hpp"

namespace luxodus {

namespace limits {
/// Blocks within one another.
inline constexpr size_t dxf_block_depth = 32;
}  // namespace limits

/// Which blocks to open, by name.
using OpensBlock = std::function<bool(const std::string& block)>;

/// The plan in which each reference to a block that `opens` accepts is replaced by the block's
/// contents, moved, turned, scaled and mirrored as the reference says; references in these contents
/// likewise. Notes count what the opened blocks hold that is not read. A block without definition,
/// and an external reference, stay references.
/// Errors: contents that cannot be used, with the line; a block that holds itself, or is deeper
/// than the limit; more segments or references than the limits.
Result<DxfPlan> with_contents_of(const DxfPlan& plan, const OpensBlock& opens);

}  // namespace luxodus

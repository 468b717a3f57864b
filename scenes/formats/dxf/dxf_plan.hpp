// The lines and blocks of a DXF plan, read by dxflib in a process of its own with limits on memory
// and time. Lines, polylines (their arcs as chords) and arcs are segments; blocks are told by name,
// place and turn, their contents are not taken apart. Heights, texts, hatches and dimensions are
// not read. Plain values in the drawing's unit; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ReadingShare;

namespace limits {
/// Of a drawing [bytes].
inline constexpr uint64_t dxf_plan_bytes = uint64_t{256} << 20;
/// Of segments, and of blocks that are placed.
inline constexpr size_t dxf_plan_things = 200'000;
}  // namespace limits

struct DxfSegment {
  std::string layer;
  glm::dvec2 from{0}, to{0};
};

struct DxfInsert {
  std::string block, layer;
  glm::dvec2 at{0};
  double rotation_deg = 0;
};

struct DxfPlan {
  double metres_per_unit = 0;  // as the drawing's header says; 0 where it says none
  std::vector<DxfSegment> segments;
  std::vector<DxfInsert> inserts;
};

/// Names are as the drawing has them, of any bytes. `reading`, where given, hears how far it is.
/// Errors: it cannot be read, holds nothing of these, or more than the limits.
Result<DxfPlan> read_dxf_plan(const std::filesystem::path& file, ReadingShare* reading = nullptr);

/// The same of its text, in this process. `file` names it in messages.
/// Requires: a text that is known to be sound, since dxflib writes beyond its memory for some that
/// are damaged.
Result<DxfPlan> dxf_plan_of(const std::string& text, const std::string& file);

}  // namespace luxodus

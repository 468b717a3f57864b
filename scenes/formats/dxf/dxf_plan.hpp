// The lines and block references of a DXF plan, read by dxflib in a process of its own with limits
// on memory and time. Lines, polylines (arcs as chords) and arcs become segments. A block reference
// gives its name, place and turn; the block's contents are not expanded. Heights, texts, hatches
// and dimensions are not read. Plain values in the drawing's unit; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ReadingShare;

namespace limits {
/// Size of a drawing [bytes].
inline constexpr uint64_t dxf_plan_bytes = uint64_t{256} << 20;
/// Number of segments, and number of block references.
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
  double metres_per_unit = 0;  // from the drawing's header; 0 where it states none
  std::vector<DxfSegment> segments;
  std::vector<DxfInsert> inserts;
};

/// Names keep the bytes of the drawing, whatever their encoding. `reading`, where given, receives
/// the progress.
/// Errors: the file cannot be read, holds no segment and no block, or exceeds the limits.
Result<DxfPlan> read_dxf_plan(const std::filesystem::path& file, ReadingShare* reading = nullptr);

/// Reads the text of a drawing in this process. `file` names it in messages.
/// Requires: a text that is known to be sound, since dxflib writes beyond its memory for some
/// damaged ones.
Result<DxfPlan> dxf_plan_of(const std::string& text, const std::string& file);

}  // namespace luxodus

// The lines and block references of a DXF plan, read from its text. Lines, polylines, arcs,
// circles, ellipses and splines of the model space become segments as seen from above, curves as
// chords. A block reference gives its name, place and turn, an array of them one for each place;
// the block's contents are not expanded. Heights are not read. All else is counted by its kind, and
// told in the notes. Plain values in the drawing's unit; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ReadingPart;
class ReadingShare;

namespace limits {
/// Size of a drawing [bytes].
inline constexpr uint64_t dxf_plan_bytes = uint64_t{256} << 20;
/// Number of segments, and number of block references.
inline constexpr size_t dxf_plan_things = 1'000'000;
}  // namespace limits

struct DxfSegment {
  std::string layer;
  glm::dvec2 from{0}, to{0};
};

struct DxfInsert {
  std::string block, layer;
  glm::dvec2 at{0};
  double rotation_deg = 0;  // of the block's x axis
  bool mirrored = false;    // the block's y axis is to the right of its x axis
};

struct DxfPlan {
  double metres_per_unit = 0;  // from the drawing's header; 0 where it states none
  std::string unit_problem = "the drawing states no unit of length ($INSUNITS)";  // where it is 0
  std::vector<DxfSegment> segments;
  std::vector<DxfInsert> inserts;
  std::vector<std::string> notes;  // what was left out, and what is read though it is hidden
};

/// Names are in UTF-8. `reading`, where given, receives the progress.
/// Errors: the file cannot be read, is no drawing or a binary one, has a value that is no number,
/// holds no segment and no block, or exceeds the limits.
Result<DxfPlan> read_dxf_plan(const std::filesystem::path& file, ReadingShare* reading = nullptr);

/// Reads the text of a drawing. `file` names it in messages.
Result<DxfPlan> dxf_plan_of(const std::string& text, const std::string& file,
                            ReadingPart* part = nullptr);

}  // namespace luxodus

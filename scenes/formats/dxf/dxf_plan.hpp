// The lines and block references of a DXF plan, read from its text. Lines, polylines, arcs,
// circles, ellipses and splines of the model space become segments as seen from above, curves as
// chords. A block reference gives its name, place and turn, an array of them one for each place;
// what the blocks hold stands apart (dxf_contents.hpp puts it into the plan). Heights are not read.
// All else is counted by its kind, and told in the notes. Plain values in the drawing's unit; any
// thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ReadingPart;
class ReadingShare;

namespace limits {
/// Size of a drawing [bytes].
inline constexpr uint64_t dxf_plan_bytes = uint64_t{256} << 20;
/// Number of segments, and number of block references, of the plan and of what its blocks hold.
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
  glm::dmat2 axes{1};       // the block's axes in the plan, with their scale
};

/// What a block holds, in its own coordinates. What lies on the layer "0" takes the layer of the
/// reference.
struct DxfBlock {
  glm::dvec2 base{0};  // the point that lies at the place of a reference
  std::vector<DxfSegment> segments;
  std::vector<DxfInsert> inserts;
  std::map<std::string, size_t> unread;  // numbers by kind
  bool foreign = false;                  // an external reference: another drawing
  std::optional<Problem> problem;        // why its contents cannot be used
};

struct DxfPlan {
  double metres_per_unit = 0;  // from the drawing's header; 0 where it states none
  std::string unit_problem = "the drawing states no unit of length ($INSUNITS)";  // where it is 0
  std::vector<DxfSegment> segments;
  std::vector<DxfInsert> inserts;
  std::map<std::string, DxfBlock> blocks;            // by name; those that no reference names, too
  std::map<std::string, const char*> hidden_layers;  // "off" or "frozen" in the drawing
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

#include "scenes/formats/dxf/dxf_contents.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "runtime/core/printable.hpp"

namespace luxodus {
namespace {

/// From coordinates of a block to those of the plan.
struct Placed {
  glm::dmat2 axes{1};
  glm::dvec2 origin{0};

  glm::dvec2 at(const glm::dvec2& p) const { return origin + axes * p; }
};

/// The reference as seen in the plan.
DxfInsert seen(DxfInsert insert, const Placed& block, const std::string& outer_layer) {
  insert.at = block.at(insert.at);
  insert.axes = block.axes * insert.axes;
  const glm::dvec2 &x = insert.axes[0], &y = insert.axes[1];
  const double degrees = std::atan2(x.y, x.x) * 180 / std::numbers::pi;
  insert.rotation_deg = std::round((degrees < 0 ? degrees + 360 : degrees) * 1e9) / 1e9;
  insert.mirrored = x.x * y.y - x.y * y.x < 0;
  if (insert.layer == "0") insert.layer = outer_layer;
  return insert;
}

class Opening {
 public:
  Opening(const DxfPlan& plan, const OpensBlock& opens) : plan_(plan), opens_(opens) {
    out_.metres_per_unit = plan.metres_per_unit;
    out_.unit_problem = plan.unit_problem;
    out_.segments = plan.segments;
    out_.blocks = plan.blocks;
    out_.hidden_layers = plan.hidden_layers;
    out_.notes = plan.notes;
  }

  Result<DxfPlan> open() {
    for (const DxfInsert& insert : plan_.inserts) take(insert, 0);
    if (fault_) return *fault_;
    tell_notes();
    return std::move(out_);
  }

 private:
  /// Takes a reference, which is stated in the plan's coordinates.
  void take(const DxfInsert& insert, size_t depth) {
    if (fault_) return;
    const auto block = plan_.blocks.find(insert.block);
    if (block == plan_.blocks.end() || block->second.foreign || !opens_(insert.block)) {
      if (out_.inserts.size() >= limits::dxf_plan_things) return too_many(insert.block);
      out_.inserts.push_back(insert);
      return;
    }
    if (block->second.problem) {
      fault_ = block->second.problem;
      fault_->what = fmt::format("in the block \"{}\": {}", excerpt(insert.block), fault_->what);
      return;
    }
    if (depth >= limits::dxf_block_depth) {
      fault_ =
          problem(fmt::format("the block \"{}\" holds itself, or blocks lie within one another "
                              "more than {} deep",
                              excerpt(insert.block), limits::dxf_block_depth));
      return;
    }
    ++opened_[insert.block];
    put(block->second, insert, depth);
  }

  void put(const DxfBlock& block, const DxfInsert& insert, size_t depth) {
    const Placed placed{insert.axes, insert.at - insert.axes * block.base};
    if (out_.segments.size() + block.segments.size() > limits::dxf_plan_things ||
        ++references_ > limits::dxf_plan_things)
      return too_many(insert.block);
    for (const DxfSegment& s : block.segments) {
      const glm::dvec2 from = placed.at(s.from), to = placed.at(s.to);
      const bool finite = std::isfinite(from.x + from.y + to.x + to.y);
      if (!finite || from == to) continue;
      const std::string& layer = s.layer == "0" ? insert.layer : s.layer;
      out_.segments.push_back({layer, from, to});
      if (plan_.hidden_layers.contains(layer)) ++on_hidden_[layer];
    }
    for (const DxfInsert& inner : block.inserts) take(seen(inner, placed, insert.layer), depth + 1);
  }

  void too_many(const std::string& block) {
    fault_ =
        problem(fmt::format("with the contents of the block \"{}\" there are more than {} "
                            "lines or blocks: open fewer",
                            excerpt(block), limits::dxf_plan_things));
  }

  void tell_notes() {
    for (const auto& [layer, count] : on_hidden_)
      out_.notes.push_back(
          fmt::format("the layer \"{}\" is {} in the drawing; {} of it in opened "
                      "blocks are read all the same",
                      excerpt(layer), plan_.hidden_layers.at(layer),
                      count == 1 ? "1 line" : fmt::format("{} lines", count)));
    for (const auto& [name, times] : opened_)
      for (const auto& [kind, count] : plan_.blocks.at(name).unread)
        out_.notes.push_back(fmt::format("not read: {} {} in the block \"{}\"", count,
                                         excerpt(kind), excerpt(name)));
  }

  const DxfPlan& plan_;
  const OpensBlock& opens_;
  DxfPlan out_;
  std::optional<Problem> fault_;
  std::map<std::string, size_t> opened_, on_hidden_;  // numbers by block and by layer
  size_t references_ = 0;  // that were opened; an empty block counts, too
};

}  // namespace

Result<DxfPlan> with_contents_of(const DxfPlan& plan, const OpensBlock& opens) {
  return Opening(plan, opens).open();
}

}  // namespace luxodus

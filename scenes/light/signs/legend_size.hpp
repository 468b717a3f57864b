// How large the parts of a face's drawing are: the widths of its strokes, shapes and enclosed gaps.
// A verdict follows from the smallest detail that a scene states, so the inspection holds that
// length against the drawing. Says nothing of which part must be seen to understand the sign. Pure
// functions; any thread.
#pragma once

#include <optional>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Widths of the parts of a drawing: of all that is not the ground, the colour that reaches the
/// edge. The width of a part at a point is the diameter of the largest circle in it that covers the
/// point; it is rounded up by at most one texel.
struct LegendSize {
  double widest_m = 0;     // the largest width
  double finer_share = 0;  // share of the parts' area whose width is below the asked one
};

/// None if the face has no part: one colour fills it, or reaches its edges everywhere. Requires: a
/// face with texels, and edges and `width_m` (the asked width) above 0.
std::optional<LegendSize> legend_size(const Sign& sign, double width_m);

}  // namespace luxodus

// What an SVG drawing names and the rasteriser leaves out, or draws otherwise on another machine:
// other files, images of formats that it does not know, text. A legend without them may still be
// judged, so they are told. Scans the bytes without drawing them. Pure; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

namespace limits {
/// Gaps of one drawing that are told; the rest is counted.
inline constexpr size_t max_drawing_gaps = 5;
}  // namespace limits

/// A sentence for each gap, such as "its image \"logo.png\" is left out: ...". Drawings in other
/// encodings than UTF-8 are not scanned.
std::vector<std::string> drawing_gaps(std::string_view svg);

}  // namespace luxodus

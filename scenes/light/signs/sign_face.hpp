// Sign faces: each texel is white, green or neither. A face is made from a drawing (SVG), a picture
// (PNG), a line of text, or is of one colour. Colours are classified by CIE Lab distance to the ISO
// 3864 surface colours as public drawings print them (#237F52, #ECECE7). The luminance of a colour
// comes from the sign (sign_light.hpp), never from the drawing. Reads files, keeps no state; any
// thread, one call at a time per file. Untrusted input: every size has a limit, and a drawing
// cannot load other files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/signs/letters.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
inline constexpr int min_face_texels_across = 8;
/// 2048 texels on a 1 m face are 0.5 mm, finer than any eye resolves at 2 m; more only costs
/// memory.
inline constexpr int max_face_texels_across = 2048;
inline constexpr int64_t max_face_texels = int64_t{1} << 22;
inline constexpr double min_face_edge_m = 0.01;
inline constexpr double max_face_edge_m = 20.0;
inline constexpr int64_t max_drawing_bytes = int64_t{4} << 20;
inline constexpr int64_t max_picture_bytes = int64_t{64} << 20;
inline constexpr int64_t max_picture_pixels = int64_t{1} << 24;
/// A drawing whose aspect differs by more would be visibly stretched: a size is wrong.
inline constexpr double face_aspect_tolerance = 0.03;
/// Largest CIE 1976 colour difference to a named colour. White and green are 61 apart: 35 leaves no
/// unclassified seam along their edges, and excludes mid grey, black and red.
inline constexpr double max_sign_colour_distance = 35.0;
}  // namespace limits

/// The class of one sRGB colour (0..255 each); alpha below half is `other`.
SignColour classify_colour(const std::array<uint8_t, 4>& rgba);

/// CIE L*a*b* (D65, 2 degrees) of an sRGB colour. Law: CIE 15:2004, 8.2.1.
std::array<double, 3> lab_from_srgb(uint8_t r, uint8_t g, uint8_t b);

/// Rasterises a drawing. Errors: no such file, not SVG, compressed, too large, no size of its own,
/// another aspect than the face, no white or no green in it.
Result<SignFace> face_from_svg(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across);

/// What the drawing names and is not drawn, or not everywhere alike (drawing_gaps.hpp); nothing if
/// it cannot be read.
std::vector<std::string> gaps_of_svg(const std::filesystem::path& file);

/// Reads an 8 or 16 bit PNG picture of any colour type. Errors: as for a drawing.
Result<SignFace> face_from_png(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across);

/// Draws one line of text, centred, in the legend's colour on the other one. The smallest detail of
/// such a sign is the stroke. Errors: as `lay_out_text`; a legend wider or taller than the face; a
/// stroke under two texels; a legend of colour `other`.
Result<SignFace> face_from_text(std::string_view text, double width_m, double height_m,
                                double letter_height_m, double stroke_m, double spacing_m,
                                SignColour legend, int texels_across);

/// A face of one colour, without a legend (a luminous surface, a way-guidance strip).
Result<SignFace> uniform_face(SignColour colour, double width_m, double height_m,
                              int texels_across);

/// The face with the brightness pattern of a measured luminance map (any size; its edges are the
/// face's edges; linear values), averaged over each texel and scaled to a mean of 1 over the white
/// and over the green texels. Errors: an image that breaks its own rules, values that are
/// negative or not finite, a colour that the map leaves wholly dark.
Result<SignFace> with_luminance_map(SignFace face, const Image& map);

/// Index of the texel at (u, v) in [0, 1]^2, u to a reader's right, v down; clamped to the face.
size_t texel_index(const SignFace& face, double u, double v);

/// Share of the face's area that has this colour.
double colour_share(const SignFace& face, SignColour colour);

}  // namespace luxodus

// Sign faces: each texel has one of the sign's colours, or none. A face is made from a drawing
// (SVG), a picture (PNG), a line of text, or is of one colour. Pixels are classified by CIE Lab
// distance to the colours of the sign as they are drawn (sign_colours.hpp). The luminance of a
// colour comes from the sign (sign_light.hpp), never from the drawing. Reads files, keeps no state;
// any thread, one call at a time per file. Untrusted input: every size has a limit, and a drawing
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
}  // namespace limits

/// The colour of the sign that one sRGB colour (0..255 each) counts as; alpha below half is
/// `other`. Requires: at most limits::max_face_colours.
ColourIndex classify_colour(const std::array<uint8_t, 4>& rgba,
                            const std::vector<FaceColour>& colours);

/// Rasterises a drawing. Its legend and ground are not chosen yet: see choose_legend. Errors: no
/// such file, not SVG, compressed, too large, no size of its own, another aspect than the face, one
/// of the colours nowhere in it.
Result<SignFace> face_from_svg(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across, const std::vector<FaceColour>& colours);

/// What the drawing names and is not drawn, or not everywhere alike (drawing_gaps.hpp); nothing if
/// it cannot be read.
std::vector<std::string> gaps_of_svg(const std::filesystem::path& file);

/// Reads an 8 or 16 bit PNG picture of any colour type. Errors: as for a drawing.
Result<SignFace> face_from_png(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across, const std::vector<FaceColour>& colours);

/// Draws one line of text, centred, in the legend's colour on the ground's. The smallest detail of
/// such a sign is the stroke. Errors: as `lay_out_text`; a legend wider or taller than the face; a
/// stroke under two texels; a legend in the colour of its ground.
Result<SignFace> face_from_text(std::string_view text, double width_m, double height_m,
                                double letter_height_m, double stroke_m, double spacing_m,
                                ColourIndex legend, ColourIndex ground, int texels_across);

/// A face of one colour, without a legend (a luminous surface, a way-guidance strip).
Result<SignFace> uniform_face(ColourIndex colour, double width_m, double height_m,
                              int texels_across);

/// The face with the brightness pattern of a measured luminance map (any size; its edges are the
/// face's edges; linear values), averaged over each texel and scaled to a mean of 1 over the texels
/// of each colour. Errors: an image that breaks its own rules, values that are negative or not
/// finite, a colour that the map leaves wholly dark.
Result<SignFace> with_luminance_map(SignFace face, const std::vector<FaceColour>& colours,
                                    const Image& map);

/// Index of the texel at (u, v) in [0, 1]^2, u to a reader's right, v down; clamped to the face.
size_t texel_index(const SignFace& face, double u, double v);

/// Share of the face's area that has this colour.
double colour_share(const SignFace& face, ColourIndex colour);
/// The shares of its two parts (SignFace::parts); 0 of a part that it lacks.
std::array<double, 2> part_shares(const SignFace& face);

}  // namespace luxodus

// The stroke letters of text signs ("EXIT", "SORTIE", "2.OG"): A-Z, 0-9 and a few marks as centre
// lines for a pen of constant width, so that a sign's stroke is exactly as stated. Letters are at
// least a third of their height wide (NFPA 101 7.10.6.1: 2 in for 6 in), except I. This lays out
// one line of text; sign_face.cpp draws it. Pure functions, plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// More characters than any real legend; a longer text is a mistake in the file.
inline constexpr size_t max_legend_characters = 64;
/// E has three bars and two gaps in its height: a thicker stroke would make the gaps thinner than
/// the stroke, which would no longer be the smallest detail.
inline constexpr double max_stroke_share = 0.2;
}  // namespace limits

/// Sizes as a standard states them: overall, not between centre lines [m].
struct LetterSize {
  double height_m = 0.1524;     // NFPA 101 7.10.6.1: 6 in
  double stroke_m = 0.01905;    // 3/4 in
  double spacing_m = 0.009525;  // clear gap between neighbouring letters, 3/8 in
};

/// A placed letter: the box that it fills exactly, and the centre lines of its strokes. Coordinates
/// [m] from the lower left corner of the legend, x to the right, y up. Strokes have square ends and
/// mitred joints, and are clipped to the box (so a diagonal ends flat on the base line).
struct LetterShape {
  char character = ' ';
  glm::dvec2 low{0};
  glm::dvec2 high{0};
  std::vector<std::vector<glm::dvec2>> strokes;
};

struct Lettering {
  std::vector<LetterShape> letters;  // without the spaces
  double width_m = 0;
  double height_m = 0;
  double stroke_m = 0;
  double smallest_detail_m = 0;   // the stroke
  double narrowest_letter_m = 0;  // of A-Z and 0-9 without I; 0 if there is none
};

/// Lays out one line of text. Errors: a character without a drawing, an empty or too long text,
/// sizes that are not positive, a stroke above `max_stroke_share` of the height.
Result<Lettering> lay_out_text(std::string_view text, const LetterSize& size);

}  // namespace luxodus

// Every glyph's centre lines are given on a unit square (x right, y up). It is stretched to the
// letter's box less half a stroke on every side, so that the drawn letter fills its box exactly for
// any stroke. Bows are elliptic arcs of the unit square, finely sampled.
#include "scenes/light/signs/letters.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>

namespace luxodus {
namespace {

/// A point of a centre line, or an elliptic arc around a centre from one angle to another (counter-
/// clockwise from +x, degrees).
struct Node {
  glm::dvec2 at;
  glm::dvec2 radius{0};
  double from_deg = 0;
  double to_deg = 0;
};

Node p(double x, double y) {
  return {{x, y}};
}
Node bow(double x, double y, double rx, double ry, double from_deg, double to_deg) {
  return {{x, y}, {rx, ry}, from_deg, to_deg};
}

/// Ends of a slanting line that are extended beyond the box, to be clipped flat at its edge.
enum class RunOut { none, start, end, both };

struct Line {
  std::vector<Node> nodes;
  RunOut run_out = RunOut::none;
};

/// Width as a share of the height; 0 means one stroke.
struct Glyph {
  double width_share = 0;
  std::vector<Line> lines;
};

Glyph glyph_a_to_i(char c) {
  switch (c) {
    case 'A':
      return {0.60, {{{p(0, 0), p(.5, 1), p(1, 0)}, RunOut::both}, {{p(.2, .28), p(.8, .28)}}}};
    case 'B':
      return {0.52,
              {{{p(0, 0), p(0, 1), p(.52, 1), bow(.52, .76, .40, .24, 90, -90), p(0, .52)}},
               {{p(0, .52), p(.52, .52), bow(.52, .26, .48, .26, 90, -90), p(0, 0)}}}};
    case 'C':
      return {0.55, {{{bow(.58, .5, .58, .5, 45, 315)}}}};
    case 'D':
      return {0.54, {{{p(0, 0), p(0, 1), p(.35, 1), bow(.35, .5, .65, .5, 90, -90), p(0, 0)}}}};
    case 'E':
      return {0.48, {{{p(1, 1), p(0, 1), p(0, 0), p(1, 0)}}, {{p(0, .5), p(.85, .5)}}}};
    case 'F':
      return {0.46, {{{p(1, 1), p(0, 1), p(0, 0)}}, {{p(0, .5), p(.85, .5)}}}};
    case 'G':
      return {0.57, {{{bow(.5, .5, .5, .5, 45, 355), p(1, .46), p(.6, .46)}}}};
    case 'H':
      return {0.52, {{{p(0, 0), p(0, 1)}}, {{p(1, 0), p(1, 1)}}, {{p(0, .5), p(1, .5)}}}};
    default:  // I
      return {0, {{{p(.5, 0), p(.5, 1)}}}};
  }
}

Glyph glyph_j_to_r(char c) {
  const Line p_shape{{p(0, 0), p(0, 1), p(.5, 1), bow(.5, .74, .5, .26, 90, -90), p(0, .48)}};
  switch (c) {
    case 'J':
      return {0.44, {{{p(1, 1), p(1, .3), bow(.5, .3, .5, .3, 0, -180)}}}};
    case 'K':
      return {0.56,
              {{{p(0, 0), p(0, 1)}},
               {{p(1, 1), p(0, .38)}, RunOut::both},
               {{p(1, 0), p(.42, .55)}, RunOut::start}}};
    case 'L':
      return {0.46, {{{p(0, 1), p(0, 0), p(1, 0)}}}};
    case 'M':
      return {0.66, {{{p(0, 0), p(0, 1), p(.5, .25), p(1, 1), p(1, 0)}}}};
    case 'N':
      return {0.54, {{{p(0, 0), p(0, 1), p(1, 0), p(1, 1)}}}};
    case 'O':
      return {0.58, {{{bow(.5, .5, .5, .5, 0, 360)}}}};
    case 'P':
      return {0.50, {p_shape}};
    case 'Q':
      return {0.58, {{{bow(.5, .5, .5, .5, 0, 360)}}, {{p(.62, .28), p(1, 0)}, RunOut::end}}};
    default:  // R
      return {0.52, {p_shape, {{p(.49, .41), p(1, 0)}, RunOut::end}}};
  }
}

Glyph glyph_s_to_z(char c) {
  switch (c) {
    case 'S':
      return {0.52, {{{bow(.5, .76, .47, .24, 20, 270), bow(.5, .26, .5, .26, 90, -160)}}}};
    case 'T':
      return {0.52, {{{p(0, 1), p(1, 1)}}, {{p(.5, 1), p(.5, 0)}}}};
    case 'U':
      return {0.54, {{{p(0, 1), p(0, .32), bow(.5, .32, .5, .32, 180, 360), p(1, 1)}}}};
    case 'V':
      return {0.58, {{{p(0, 1), p(.5, 0), p(1, 1)}, RunOut::both}}};
    case 'W':
      return {0.82, {{{p(0, 1), p(.25, 0), p(.5, .8), p(.75, 0), p(1, 1)}, RunOut::both}}};
    case 'X':
      return {0.58, {{{p(0, 1), p(1, 0)}, RunOut::both}, {{p(0, 0), p(1, 1)}, RunOut::both}}};
    case 'Y':
      return {0.58, {{{p(0, 1), p(.5, .46), p(1, 1)}, RunOut::both}, {{p(.5, .46), p(.5, 0)}}}};
    default:  // Z
      return {0.52, {{{p(0, 1), p(1, 1), p(0, 0), p(1, 0)}}}};
  }
}

Glyph glyph_digit(char c) {
  switch (c) {
    case '0':
      return {0.50, {{{bow(.5, .5, .5, .5, 0, 360)}}}};
    case '1':
      return {0.34, {{{p(0, .72), p(.85, 1), p(.85, 0)}}}};
    case '2':
      return {0.50, {{{bow(.5, .71, .5, .29, 165, -30), p(0, 0), p(1, 0)}}}};
    case '3':
      return {0.50,
              {{{bow(.48, .76, .46, .24, 155, -90), p(.35, .52)}},
               {{p(.35, .52), p(.48, .52), bow(.48, .26, .52, .26, 90, -155)}}}};
    case '4':
      return {0.56, {{{p(.76, 0), p(.76, 1), p(0, .28), p(1, .28)}}}};
    case '5':
      return {0.50, {{{p(.95, 1), p(.1, 1), p(.05, .54), bow(.48, .33, .52, .33, 135, -155)}}}};
    case '6':
      return {0.50, {{{bow(.5, .3, .5, .3, 0, 360)}}, {{bow(.9, .3, .9, .7, 180, 90)}}}};
    case '7':
      return {0.50, {{{p(0, 1), p(1, 1), p(.3, 0)}, RunOut::end}}};
    case '8':
      return {0.52, {{{bow(.5, .76, .44, .24, 0, 360)}}, {{bow(.5, .26, .5, .26, 0, 360)}}}};
    default:  // 9
      return {0.50, {{{bow(.5, .7, .5, .3, 0, 360)}}, {{bow(.1, .7, .9, .7, 0, -90)}}}};
  }
}

/// Marks; sets `known` to false for any other character.
Glyph glyph_mark(char c, bool& known) {
  // A dot is a line just long enough to have a direction: its square ends make the square.
  constexpr double dot = 1e-3;
  known = true;
  switch (c) {
    case '-':
      return {0.36, {{{p(0, .5), p(1, .5)}}}};
    case '+':
      return {0.46, {{{p(0, .5), p(1, .5)}}, {{p(.5, .22), p(.5, .78)}}}};
    case '/':
      return {0.50, {{{p(0, 0), p(1, 1)}, RunOut::both}}};
    case '.':
      return {0, {{{p(.5, 0), p(.5, dot)}}}};
    case ':':
      return {0, {{{p(.5, .12), p(.5, .12 + dot)}}, {{p(.5, .72), p(.5, .72 + dot)}}}};
    case '!':
      return {0, {{{p(.5, 0), p(.5, dot)}}, {{p(.5, .36), p(.5, 1)}}}};
    case '\'':
      return {0, {{{p(.5, .75), p(.5, 1)}}}};
    case '<':  // chevrons: NFPA 101 7.10.6.2 directional indicators
      return {0.55, {{{p(1, 1), p(0, .5), p(1, 0)}, RunOut::both}}};
    case '>':
      return {0.55, {{{p(0, 1), p(1, .5), p(0, 0)}, RunOut::both}}};
    default:
      known = false;
      return {};
  }
}

Glyph glyph_of(char c, bool& known) {
  known = true;
  if (c >= 'A' && c <= 'I') return glyph_a_to_i(c);
  if (c >= 'J' && c <= 'R') return glyph_j_to_r(c);
  if (c >= 'S' && c <= 'Z') return glyph_s_to_z(c);
  if (c >= '0' && c <= '9') return glyph_digit(c);
  return glyph_mark(c, known);
}

/// The points of a line on the unit square, arcs sampled every 5 degrees: for a bow as large as a
/// letter the chord deviates from the arc by 0.1 % of its radius, far below a texel.
std::vector<glm::dvec2> flatten(const Line& line) {
  std::vector<glm::dvec2> points;
  for (const Node& node : line.nodes) {
    if (node.radius.x <= 0) {
      points.push_back(node.at);
      continue;
    }
    const int steps = static_cast<int>(std::ceil(std::abs(node.to_deg - node.from_deg) / 5.0));
    for (int i = 0; i <= steps; ++i) {
      const double deg = node.from_deg + (node.to_deg - node.from_deg) * i / steps;
      const double rad = deg * std::numbers::pi / 180.0;
      const glm::dvec2 point = node.at + node.radius * glm::dvec2(std::cos(rad), std::sin(rad));
      // An arc may start where the line ends; a duplicate point has no direction to join.
      if (points.empty() || glm::distance(points.back(), point) > 1e-9) points.push_back(point);
    }
  }
  return points;
}

void run_out(std::vector<glm::dvec2>& points, RunOut ends, double by_m) {
  const size_t n = points.size();
  if (ends == RunOut::start || ends == RunOut::both)
    points[0] += by_m * glm::normalize(points[0] - points[1]);
  if (ends == RunOut::end || ends == RunOut::both)
    points[n - 1] += by_m * glm::normalize(points[n - 1] - points[n - 2]);
}

LetterShape place_letter(char c, const Glyph& glyph, double left_m, double width_m,
                         const LetterSize& size) {
  LetterShape letter{c, {left_m, 0}, {left_m + width_m, size.height_m}, {}};
  const glm::dvec2 inset(size.stroke_m / 2);
  const glm::dvec2 extent = letter.high - letter.low - 2.0 * inset;
  for (const Line& line : glyph.lines) {
    std::vector<glm::dvec2> points = flatten(line);
    for (glm::dvec2& point : points) point = letter.low + inset + point * extent;
    run_out(points, line.run_out, size.stroke_m);
    letter.strokes.push_back(std::move(points));
  }
  return letter;
}

std::string quoted(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20 && byte < 0x7f) return std::string("'") + c + "'";
  return "byte " + std::to_string(byte);
}

/// Whether text and sizes are sound.
Result<void> check_letters(std::string_view text, const LetterSize& size) {
  if (text.empty()) return problem("the legend is empty; give the text that the sign shows");
  if (text.size() > limits::max_legend_characters)
    return problem("the legend has " + std::to_string(text.size()) + " characters, at most " +
                   std::to_string(limits::max_legend_characters) + " are drawn");
  const bool sized = std::isfinite(size.height_m) && std::isfinite(size.stroke_m) &&
                     std::isfinite(size.spacing_m) && size.height_m > 0 && size.stroke_m > 0 &&
                     size.spacing_m >= 0;
  if (!sized) return problem("letter height and stroke must be positive, and spacing not negative");
  // The tolerance accepts a stroke of exactly a fifth whatever unit it was converted from.
  if (size.stroke_m > limits::max_stroke_share * size.height_m * (1 + 1e-9))
    return problem(
        "the stroke is " + std::to_string(size.stroke_m / size.height_m) +
        " of the letter height; above 0.2 the gaps within E are thinner than the stroke");
  return {};
}

}  // namespace

Result<Lettering> lay_out_text(std::string_view text, const LetterSize& size) {
  if (auto ok = check_letters(text, size); !ok) return ok.problem();
  // A word space of 0.4 letter heights separates words clearly at any letter spacing.
  constexpr double word_space_share = 0.4;
  Lettering out;
  out.height_m = size.height_m;
  out.stroke_m = size.stroke_m;
  out.smallest_detail_m = size.stroke_m;
  double left_m = 0;
  for (char c : text) {
    if (c == ' ') {
      left_m += word_space_share * size.height_m;
      continue;
    }
    bool known = false;
    const Glyph glyph = glyph_of(c, known);
    if (!known)
      return problem("the legend has " + quoted(c) +
                     ", which is not drawn; use A-Z, 0-9, space and - + / . : ! ' < >");
    const double width_m =
        glyph.width_share > 0 ? glyph.width_share * size.height_m : size.stroke_m;
    out.letters.push_back(place_letter(c, glyph, left_m, width_m, size));
    const bool counts = (c >= 'A' && c <= 'Z' && c != 'I') || (c >= '0' && c <= '9');
    if (counts && (out.narrowest_letter_m == 0 || width_m < out.narrowest_letter_m))
      out.narrowest_letter_m = width_m;
    left_m += width_m + size.spacing_m;
  }
  if (out.letters.empty()) return problem("the legend is blank; give the text of the sign");
  out.width_m = out.letters.back().high.x;
  return out;
}

}  // namespace luxodus

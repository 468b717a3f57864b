// Drawings, pictures and text are all rasterised first; a texel then takes the colour of the
// majority of a grid of pixels within it. Voting on classes instead of averaging colours prevents a
// third colour along an edge between white and green.
// Invariant: a face has at least one texel each way, and colour.size() == width * height.
#include "scenes/light/signs/sign_face.hpp"

#include <cairo.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "runtime/core/regular_file.hpp"
#include "scenes/light/signs/draw_svg.hpp"
#include "scenes/light/signs/drawing_gaps.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/signs/surface_pixels.hpp"

namespace luxodus {
namespace {

std::string in_mm(double metres) {
  return std::to_string(std::lround(metres * 1000)) + " mm";
}

// ---- colours -----------------------------------------------------------------------------------

/// A pixel whose differences to two colours add up to no more than this multiple of the difference
/// between them is a mixture of the two, as a smoothed edge has it: it belongs to the nearer one.
/// Mixtures of safety colours in sRGB exceed the straight line in CIE Lab by up to 7 %.
constexpr double mixture_slack = 1.08;

/// Classifies each run of equal pixels once: a sign's drawing consists of runs.
class Classifier {
 public:
  explicit Classifier(const std::vector<FaceColour>& colours) : colours_(colours) {}

  ColourIndex operator()(const Rgba& rgba) {
    if (!known_ || rgba != last_) {
      known_ = true;
      last_ = rgba;
      colour_ = classify_colour(rgba, colours_);
    }
    return colour_;
  }

 private:
  const std::vector<FaceColour>& colours_;
  bool known_ = false;
  Rgba last_{};
  ColourIndex colour_ = other_colour;
};

// ---- the texel grid ----------------------------------------------------------------------------

/// An empty grid (every texel `other`) for a face of this size.
Result<SignFace> blank_face(double width_m, double height_m, int texels_across) {
  for (double edge_m : {width_m, height_m})
    if (!(edge_m >= limits::min_face_edge_m && edge_m <= limits::max_face_edge_m))
      return problem("a sign's edge is " + std::to_string(edge_m) +
                     " m; width and height must lie between 0.01 m and 20 m");
  if (texels_across < limits::min_face_texels_across ||
      texels_across > limits::max_face_texels_across)
    return problem("a sign has " + std::to_string(texels_across) +
                   " texels across; give a number from " +
                   std::to_string(limits::min_face_texels_across) + " to " +
                   std::to_string(limits::max_face_texels_across));
  const double down = std::max(1.0, std::round(texels_across * height_m / width_m));
  if (down * texels_across > static_cast<double>(limits::max_face_texels))
    return problem("a sign face of " + std::to_string(texels_across) + " by " +
                   std::to_string(std::llround(down)) +
                   " texels is too large; give fewer texels across");
  SignFace face;
  face.width = texels_across;
  face.height = static_cast<int>(down);
  face.colour.assign(static_cast<size_t>(face.width) * static_cast<size_t>(face.height),
                     other_colour);
  return face;
}

/// Pixels per texel edge of faces that we draw: 4, or 2 if 4 would take over 64 MiB.
int samples_per_texel(const SignFace& face) {
  return static_cast<int64_t>(face.colour.size()) * 16 <= limits::max_picture_pixels ? 4 : 2;
}

/// Votes for each colour of the sign, then those for none of them.
using Votes = std::array<int, limits::max_face_colours + 1>;

/// `other` needs the majority, so that neither a blurred edge nor a hairline makes a seam. A tie
/// goes to the middle sample: if it always went to one colour, that colour would grow.
ColourIndex winner(const Votes& votes, ColourIndex middle) {
  const auto last = votes.end() - 1;
  if (*last > std::accumulate(votes.begin(), last, 0)) return other_colour;
  const auto most = std::max_element(votes.begin(), last);
  if (middle != other_colour && votes[middle] == *most) return middle;
  return static_cast<ColourIndex>(most - votes.begin());
}

/// Fills the face from pixels that cover it exactly. `classify` gives the colour of a pixel.
/// Requires: pixels of at least 1 by 1.
template <class Classify>
void vote(SignFace& face, const Pixels& pixels, Classify classify) {
  // At least the 4 by 4 of our own drawings; finer pictures are sampled up to 16 by 16.
  const int across = std::clamp(pixels.width / face.width, 4, 16);
  const int down = std::clamp(pixels.height / face.height, 4, 16);
  const auto pixel_at = [](int texel, int sample, int samples, int texels, int count) {
    const double position = (texel + (sample + 0.5) / samples) / texels;
    return std::min(static_cast<int>(position * count), count - 1);
  };
  for (int row = 0; row < face.height; ++row) {
    for (int column = 0; column < face.width; ++column) {
      Votes votes{};
      ColourIndex middle = other_colour;
      for (int j = 0; j < down; ++j) {
        const int y = pixel_at(row, j, down, face.height, pixels.height);
        const size_t line = static_cast<size_t>(y) * static_cast<size_t>(pixels.width);
        for (int i = 0; i < across; ++i) {
          const int x = pixel_at(column, i, across, face.width, pixels.width);
          const ColourIndex colour = classify(pixels.rgba[line + static_cast<size_t>(x)]);
          ++votes[std::min<size_t>(colour, limits::max_face_colours)];
          if (j == down / 2 && i == across / 2) middle = colour;
        }
      }
      const size_t texel =
          static_cast<size_t>(row) * static_cast<size_t>(face.width) + static_cast<size_t>(column);
      face.colour[texel] = winner(votes, middle);
    }
  }
}

/// A pictogram is read by the contrast between its colours, so it must have all of them.
Result<void> check_colours(const SignFace& face, const std::vector<FaceColour>& colours) {
  for (size_t i = 0; i < colours.size(); ++i)
    if (colour_share(face, static_cast<ColourIndex>(i)) == 0)
      return problem("nothing in it is " + colours[i].name + " (like " +
                     hex_text(colours[i].drawn) +
                     "); its colours are to be: " + colour_names(colours));
  return {};
}

Result<void> check_aspect(double width, double height, double width_m, double height_m) {
  const double drawn = width / height, stated = width_m / height_m;
  if (std::abs(drawn / stated - 1) <= limits::face_aspect_tolerance) return {};
  const auto two_digits = [](double v) {
    std::string text = std::to_string(v);
    return text.substr(0, text.find('.') + 3);
  };
  return problem("it is " + two_digits(drawn) + " times as wide as high, the sign " +
                 two_digits(stated) + " times; give the sign the aspect of its picture");
}

// ---- cairo, librsvg, libpng --------------------------------------------------------------------

Result<std::string> read_drawing(const std::filesystem::path& file) {
  const auto size = size_of_regular_file(file);
  if (!size && size.problem().kind == ProblemKind::not_found)
    return problem_in(file, "there is no such file; give the path of the sign's SVG drawing",
                      ProblemKind::not_found);
  if (!size) return size.problem();
  if (size.value() > static_cast<uint64_t>(limits::max_drawing_bytes))
    return problem_in(file, "the drawing is larger than 4 MiB; simplify it");
  auto bytes = read_regular_file(file, static_cast<uint64_t>(limits::max_drawing_bytes));
  if (bytes && bytes->empty()) return problem_in(file, "the file is empty or cannot be read");
  return bytes;
}

/// Releases libpng's state on every path out of the function.
struct PngReader {
  png_image state{};

  PngReader() { state.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&state); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

Result<Pixels> read_png(const std::filesystem::path& file) {
  const auto size = size_of_regular_file(file);
  if (!size && size.problem().kind == ProblemKind::not_found)
    return problem_in(file, "there is no such file; give the path of the sign's PNG picture",
                      ProblemKind::not_found);
  if (!size) return size.problem();
  if (size.value() > static_cast<uint64_t>(limits::max_picture_bytes))
    return problem_in(file, "the picture is larger than 64 MiB; scale it down");
  PngReader png;
  if (!png_image_begin_read_from_file(&png.state, file.c_str()))
    return problem_in(file, std::string("it is not a PNG picture (") + png.state.message + ")");
  const auto pixels =
      static_cast<int64_t>(png.state.width) * static_cast<int64_t>(png.state.height);
  if (pixels > limits::max_picture_pixels)
    return problem_in(file, "the picture has " + std::to_string(pixels) +
                                " pixels, at most 16777216 are read; scale it down");
  png.state.format = PNG_FORMAT_RGBA;
  Pixels out;
  out.width = static_cast<int>(png.state.width);
  out.height = static_cast<int>(png.state.height);
  out.rgba.resize(static_cast<size_t>(pixels));
  if (!png_image_finish_read(&png.state, nullptr, out.rgba.data(), 0, nullptr))
    return problem_in(file, std::string("the PNG picture is damaged (") + png.state.message + ")");
  return out;
}

void set_grey(cairo_t* pen, double grey) {
  cairo_set_source_rgb(pen, grey, grey, grey);
}

/// Requires: a user space in metres with y up.
void draw_letter(cairo_t* pen, const LetterShape& letter) {
  cairo_save(pen);
  cairo_rectangle(pen, letter.low.x, letter.low.y, letter.high.x - letter.low.x,
                  letter.high.y - letter.low.y);
  cairo_clip(pen);
  for (const auto& stroke : letter.strokes) {
    cairo_move_to(pen, stroke.front().x, stroke.front().y);
    for (size_t i = 1; i < stroke.size(); ++i) cairo_line_to(pen, stroke[i].x, stroke[i].y);
    cairo_stroke(pen);
  }
  cairo_restore(pen);
}

Result<void> check_legend(const Lettering& lettering, double width_m, double height_m,
                          int texels_across) {
  if (lettering.width_m > width_m)
    return problem("the legend is " + in_mm(lettering.width_m) + " wide, the face " +
                   in_mm(width_m) + "; widen the sign or lower the letters");
  if (lettering.height_m > height_m)
    return problem("the letters are " + in_mm(lettering.height_m) + " high, the face " +
                   in_mm(height_m) + "; raise the sign or lower the letters");
  const double texel_m = width_m / texels_across;
  if (lettering.stroke_m < 2 * texel_m)
    return problem(
        "the stroke of " + in_mm(lettering.stroke_m) + " has less than two texels; give " +
        std::to_string(static_cast<int64_t>(std::ceil(2 * width_m / lettering.stroke_m))) +
        " texels across or more");
  return {};
}

}  // namespace

ColourIndex classify_colour(const std::array<uint8_t, 4>& rgba,
                            const std::vector<FaceColour>& colours) {
  if (rgba[3] < 128) return other_colour;
  std::array<double, limits::max_face_colours> away{};
  const size_t count = std::min(colours.size(), limits::max_face_colours);
  for (size_t i = 0; i < count; ++i)
    away[i] = colour_difference({rgba[0], rgba[1], rgba[2]}, colours[i].drawn);
  const auto nearest = static_cast<size_t>(
      std::min_element(away.begin(), away.begin() + static_cast<ptrdiff_t>(count)) - away.begin());
  if (nearest == count) return other_colour;
  if (away[nearest] <= limits::max_sign_colour_distance) return static_cast<ColourIndex>(nearest);
  for (size_t i = 0; i < count; ++i) {
    const double apart = colour_difference(colours[i].drawn, colours[nearest].drawn);
    if (i != nearest && away[i] + away[nearest] <= mixture_slack * apart)
      return static_cast<ColourIndex>(nearest);
  }
  return other_colour;
}

Result<SignFace> face_from_svg(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across, const std::vector<FaceColour>& colours) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (!face) return problem_in(file, face.problem());
  Result<std::string> bytes = read_drawing(file);
  if (!bytes) return bytes.problem();
  const int samples = samples_per_texel(face.value());
  const Result<DrawnSvg> svg =
      draw_svg(bytes.value(), face->width * samples, face->height * samples);
  if (!svg) return problem_in(file, svg.problem());
  if (auto ok = check_aspect(svg->width, svg->height, width_m, height_m); !ok)
    return problem_in(file, ok.problem());
  vote(face.value(), svg->pixels, Classifier(colours));
  if (auto ok = check_colours(face.value(), colours); !ok) return problem_in(file, ok.problem());
  return face;
}

std::vector<std::string> gaps_of_svg(const std::filesystem::path& file) {
  const Result<std::string> bytes = read_drawing(file);
  return bytes ? drawing_gaps(bytes.value()) : std::vector<std::string>();
}

Result<SignFace> face_from_png(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across, const std::vector<FaceColour>& colours) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (!face) return problem_in(file, face.problem());
  Result<Pixels> pixels = read_png(file);
  if (!pixels) return pixels.problem();
  if (auto ok = check_aspect(pixels->width, pixels->height, width_m, height_m); !ok)
    return problem_in(file, ok.problem());
  vote(face.value(), pixels.value(), Classifier(colours));
  if (auto ok = check_colours(face.value(), colours); !ok) return problem_in(file, ok.problem());
  return face;
}

Result<SignFace> face_from_text(std::string_view text, double width_m, double height_m,
                                double letter_height_m, double stroke_m, double spacing_m,
                                ColourIndex legend, ColourIndex ground, int texels_across) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (!face) return face.problem();
  if (legend == ground || std::max(legend, ground) >= limits::max_face_colours)
    return problem("a text needs a colour for its legend and another one for its ground");
  Result<Lettering> lettering = lay_out_text(text, {letter_height_m, stroke_m, spacing_m});
  if (!lettering) return lettering.problem();
  if (auto ok = check_legend(lettering.value(), width_m, height_m, texels_across); !ok)
    return ok.problem();

  const int samples = samples_per_texel(face.value());
  const int across = face->width * samples, down = face->height * samples;
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, across, down));
  Pen pen(cairo_create(surface.get()));
  // A mask of the legend: nothing is smoothed, so a pixel is black or white.
  set_grey(pen.get(), 0);
  cairo_paint(pen.get());
  set_grey(pen.get(), 1);
  cairo_set_antialias(pen.get(), CAIRO_ANTIALIAS_NONE);
  cairo_translate(pen.get(), 0, down);
  cairo_scale(pen.get(), across / width_m, -down / height_m);
  cairo_translate(pen.get(), (width_m - lettering->width_m) / 2,
                  (height_m - lettering->height_m) / 2);
  cairo_set_line_width(pen.get(), lettering->stroke_m);
  cairo_set_line_cap(pen.get(), CAIRO_LINE_CAP_SQUARE);
  cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_MITER);
  for (const LetterShape& letter : lettering->letters) draw_letter(pen.get(), letter);
  if (cairo_status(pen.get()) != CAIRO_STATUS_SUCCESS)
    return problem("the legend cannot be drawn: out of memory", ProblemKind::no_room);
  vote(face.value(), pixels_of(surface.get()),
       [&](const Rgba& rgba) { return rgba[0] > 0 ? legend : ground; });
  face->legend = legend;
  face->ground = ground;
  return face;
}

Result<SignFace> uniform_face(ColourIndex colour, double width_m, double height_m,
                              int texels_across) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (face) std::fill(face->colour.begin(), face->colour.end(), colour);
  return face;
}

size_t texel_index(const SignFace& face, double u, double v) {
  const auto cell = [](double share, int count) {
    return static_cast<size_t>(std::clamp(share * count, 0.0, count - 1.0));
  };
  return cell(v, face.height) * static_cast<size_t>(face.width) + cell(u, face.width);
}

double colour_share(const SignFace& face, ColourIndex colour) {
  if (face.colour.empty()) return 0;
  const auto count = std::count(face.colour.begin(), face.colour.end(), colour);
  return static_cast<double>(count) / static_cast<double>(face.colour.size());
}

std::array<double, 2> part_shares(const SignFace& face) {
  const auto share = [&](ColourIndex part) {
    return part == other_colour ? 0 : colour_share(face, part);
  };
  const auto [first, second] = face.parts();
  return {share(first), share(second)};
}

}  // namespace luxodus

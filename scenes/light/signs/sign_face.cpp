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
#include <string>
#include <utility>

#include "runtime/core/regular_file.hpp"
#include "scenes/light/signs/draw_svg.hpp"
#include "scenes/light/signs/drawing_gaps.hpp"
#include "scenes/light/signs/surface_pixels.hpp"

namespace luxodus {
namespace {

constexpr Rgba iso_green{0x23, 0x7f, 0x52, 0xff};
constexpr Rgba iso_white{0xec, 0xec, 0xe7, 0xff};

std::string in_mm(double metres) {
  return std::to_string(std::lround(metres * 1000)) + " mm";
}

// ---- colours -----------------------------------------------------------------------------------

/// IEC 61966-2-1 decoding.
double linear_from_srgb(uint8_t code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double lab_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Classifies each run of equal pixels once: a sign's drawing consists of runs.
class Classifier {
 public:
  SignColour operator()(const Rgba& rgba) {
    if (!known_ || rgba != last_) {
      known_ = true;
      last_ = rgba;
      colour_ = classify_colour(rgba);
    }
    return colour_;
  }

 private:
  bool known_ = false;
  Rgba last_{};
  SignColour colour_ = SignColour::other;
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
                     SignColour::other);
  return face;
}

/// Pixels per texel edge of faces that we draw: 4, or 2 if 4 would take over 64 MiB.
int samples_per_texel(const SignFace& face) {
  return static_cast<int64_t>(face.colour.size()) * 16 <= limits::max_picture_pixels ? 4 : 2;
}

/// `other` needs the majority, so that neither a blurred edge nor a hairline makes a seam. A tie
/// goes to the middle sample: if it always went to one colour, that colour would grow.
SignColour winner(const std::array<int, 3>& votes, SignColour middle) {
  const int white = votes[0], green = votes[1], other = votes[2];
  if (other > white + green) return SignColour::other;
  if (white == green) return middle == SignColour::green ? middle : SignColour::white;
  return white > green ? SignColour::white : SignColour::green;
}

/// Fills the face from pixels that cover it exactly. Requires: pixels of at least 1 by 1.
void vote(SignFace& face, const Pixels& pixels) {
  // At least the 4 by 4 of our own drawings; finer pictures are sampled up to 16 by 16.
  const int across = std::clamp(pixels.width / face.width, 4, 16);
  const int down = std::clamp(pixels.height / face.height, 4, 16);
  const auto pixel_at = [](int texel, int sample, int samples, int texels, int count) {
    const double position = (texel + (sample + 0.5) / samples) / texels;
    return std::min(static_cast<int>(position * count), count - 1);
  };
  Classifier classify;
  for (int row = 0; row < face.height; ++row) {
    for (int column = 0; column < face.width; ++column) {
      std::array<int, 3> votes{};
      SignColour middle = SignColour::other;
      for (int j = 0; j < down; ++j) {
        const int y = pixel_at(row, j, down, face.height, pixels.height);
        const size_t line = static_cast<size_t>(y) * static_cast<size_t>(pixels.width);
        for (int i = 0; i < across; ++i) {
          const int x = pixel_at(column, i, across, face.width, pixels.width);
          const SignColour colour = classify(pixels.rgba[line + static_cast<size_t>(x)]);
          ++votes[static_cast<size_t>(colour)];
          if (j == down / 2 && i == across / 2) middle = colour;
        }
      }
      const size_t texel =
          static_cast<size_t>(row) * static_cast<size_t>(face.width) + static_cast<size_t>(column);
      face.colour[texel] = winner(votes, middle);
    }
  }
}

/// A pictogram is read by the contrast between its two colours, so it must have both.
Result<void> check_colours(const SignFace& face) {
  for (auto [colour, name] : {std::pair{SignColour::white, "white (like #ECECE7)"},
                              std::pair{SignColour::green, "green (like #237F52)"}})
    if (colour_share(face, colour) == 0)
      return problem(std::string("nothing in it is ") + name +
                     "; an exit sign is drawn in ISO 3864 green and white");
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

void set_colour(cairo_t* pen, const Rgba& rgba) {
  cairo_set_source_rgb(pen, rgba[0] / 255.0, rgba[1] / 255.0, rgba[2] / 255.0);
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

std::array<double, 3> lab_from_srgb(uint8_t r8, uint8_t g8, uint8_t b8) {
  const double r = linear_from_srgb(r8), g = linear_from_srgb(g8), b = linear_from_srgb(b8);
  // sRGB to XYZ (IEC 61966-2-1), divided by its own white so that white is exactly (100, 0, 0).
  const double x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const double z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890;
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
  };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

SignColour classify_colour(const std::array<uint8_t, 4>& rgba) {
  if (rgba[3] < 128) return SignColour::other;
  const auto lab = lab_from_srgb(rgba[0], rgba[1], rgba[2]);
  const double to_white =
      lab_distance(lab, lab_from_srgb(iso_white[0], iso_white[1], iso_white[2]));
  const double to_green =
      lab_distance(lab, lab_from_srgb(iso_green[0], iso_green[1], iso_green[2]));
  if (std::min(to_white, to_green) > limits::max_sign_colour_distance) return SignColour::other;
  return to_white <= to_green ? SignColour::white : SignColour::green;
}

Result<SignFace> face_from_svg(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across) {
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
  vote(face.value(), svg->pixels);
  if (auto ok = check_colours(face.value()); !ok) return problem_in(file, ok.problem());
  return face;
}

std::vector<std::string> gaps_of_svg(const std::filesystem::path& file) {
  const Result<std::string> bytes = read_drawing(file);
  return bytes ? drawing_gaps(bytes.value()) : std::vector<std::string>();
}

Result<SignFace> face_from_png(const std::filesystem::path& file, double width_m, double height_m,
                               int texels_across) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (!face) return problem_in(file, face.problem());
  Result<Pixels> pixels = read_png(file);
  if (!pixels) return pixels.problem();
  if (auto ok = check_aspect(pixels->width, pixels->height, width_m, height_m); !ok)
    return problem_in(file, ok.problem());
  vote(face.value(), pixels.value());
  if (auto ok = check_colours(face.value()); !ok) return problem_in(file, ok.problem());
  return face;
}

Result<SignFace> face_from_text(std::string_view text, double width_m, double height_m,
                                double letter_height_m, double stroke_m, double spacing_m,
                                SignColour legend, int texels_across) {
  Result<SignFace> face = blank_face(width_m, height_m, texels_across);
  if (!face) return face.problem();
  if (legend == SignColour::other)
    return problem("a legend is white or green; the ground takes the other of the two");
  Result<Lettering> lettering = lay_out_text(text, {letter_height_m, stroke_m, spacing_m});
  if (!lettering) return lettering.problem();
  if (auto ok = check_legend(lettering.value(), width_m, height_m, texels_across); !ok)
    return ok.problem();

  const int samples = samples_per_texel(face.value());
  const int across = face->width * samples, down = face->height * samples;
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, across, down));
  Pen pen(cairo_create(surface.get()));
  const bool white_on_green = legend == SignColour::white;
  set_colour(pen.get(), white_on_green ? iso_green : iso_white);
  cairo_paint(pen.get());
  set_colour(pen.get(), white_on_green ? iso_white : iso_green);
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
  vote(face.value(), pixels_of(surface.get()));
  face->legend = legend;
  return face;
}

Result<SignFace> uniform_face(SignColour colour, double width_m, double height_m,
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

double colour_share(const SignFace& face, SignColour colour) {
  if (face.colour.empty()) return 0;
  const auto count = std::count(face.colour.begin(), face.colour.end(), colour);
  return static_cast<double>(count) / static_cast<double>(face.colour.size());
}

}  // namespace luxodus

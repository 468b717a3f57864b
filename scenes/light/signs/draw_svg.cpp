#include "scenes/light/signs/draw_svg.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "runtime/core/isolated_job.hpp"
#include "scenes/light/signs/surface_pixels.hpp"

namespace luxodus {
namespace {

/// Limits for the largest face with its layers of groups, on a slow processor.
constexpr IsolatedLimits for_a_sign{uint64_t{1} << 30, 5};

using Drawing = std::unique_ptr<RsvgHandle, Release<g_object_unref>>;
using SvgFailure = std::unique_ptr<GError, Release<g_error_free>>;

// ---- in the other process ----------------------------------------------------------------------

/// The size that the drawing itself states: width and height, else its viewBox.
std::optional<std::pair<double, double>> stated_size(RsvgHandle* drawing) {
  double width = 0, height = 0;
  if (!rsvg_handle_get_intrinsic_size_in_pixels(drawing, &width, &height)) {
    RsvgRectangle box{};
    gboolean has_box = FALSE;
    rsvg_handle_get_intrinsic_dimensions(drawing, nullptr, nullptr, nullptr, nullptr, &has_box,
                                         &box);
    if (!has_box) return std::nullopt;
    width = box.width;
    height = box.height;
  }
  const auto sound = [](double v) { return std::isfinite(v) && v > 0 && v < 1e9; };
  if (!sound(width) || !sound(height)) return std::nullopt;
  return std::pair{width, height};
}

Result<DrawnSvg> drawn(const std::string& bytes, int across, int down) {
  GError* error = nullptr;
  // Read from memory, the drawing has no folder, so it can load no other file.
  Drawing drawing(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(bytes.data()),
                                            bytes.size(), &error));
  if (!drawing) {
    SvgFailure failure(error);
    return problem(std::string("it is not an SVG drawing (") +
                   (failure ? failure->message : "no reason given") + ")");
  }
  const auto size = stated_size(drawing.get());
  if (!size) return problem("the drawing states no size; give its svg element a viewBox");
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, across, down));
  Pen pen(cairo_create(surface.get()));
  // The drawing fills the face exactly, stretched by no more than the aspect's tolerance.
  cairo_scale(pen.get(), across / size->first, down / size->second);
  const RsvgRectangle viewport{0, 0, size->first, size->second};
  const bool good = rsvg_handle_render_document(drawing.get(), pen.get(), &viewport, &error);
  SvgFailure failure(error);
  if (!good || cairo_status(pen.get()) != CAIRO_STATUS_SUCCESS)
    return problem(std::string("the drawing cannot be rendered (") +
                   (failure ? failure->message : "out of memory") + ")");
  return DrawnSvg{size->first, size->second, pixels_of(surface.get())};
}

void answer(PlainReader& question, PlainWriter& out) {
  std::string bytes;
  int across = 0, down = 0;
  if (!question.get(bytes) || !question.get(across) || !question.get(down))
    throw std::runtime_error("no question");
  const Result<DrawnSvg> svg = drawn(bytes, across, down);
  out.put(svg ? std::string() : svg.problem().what);
  if (!svg) return;
  out.put(svg->width);
  out.put(svg->height);
  out.put(svg->pixels.rgba);
}

const IsolatedJob draw_job("draw", answer);

// ---- in this process ---------------------------------------------------------------------------

/// Finds, without parsing, what makes a drawing unfit for a sign. Drawings in other encodings than
/// UTF-8 are not checked here; the limits of the job hold for them.
Result<void> check_drawing(std::string_view bytes) {
  // librsvg would decompress it without a limit.
  if (bytes.starts_with("\x1f\x8b"))
    return problem("the drawing is compressed; unpack it to plain SVG");
  if (std::count(bytes.begin(), bytes.end(), '<') > 2 * limits::max_drawing_elements)
    return problem("the drawing has more than " + std::to_string(limits::max_drawing_elements) +
                   " elements; simplify it");
  for (size_t at = bytes.find("filter"); at != std::string_view::npos;
       at = bytes.find("filter", at + 1)) {
    const size_t begin = bytes.find_last_of("< \t\r\n\"'", at);
    if (begin != std::string_view::npos && bytes[begin] == '<')
      return problem(
          "the drawing has filters, which a sign's two colours need none of; draw it "
          "without");
  }
  return {};
}

}  // namespace

Result<DrawnSvg> draw_svg(const std::string& bytes, int across, int down) {
  if (auto ok = check_drawing(bytes); !ok) return ok.problem();
  auto in = draw_job.run(
      [&](PlainWriter& question) {
        question.put(bytes);
        question.put(across);
        question.put(down);
      },
      for_a_sign);
  if (!in) return in.problem();
  std::string wrong;
  DrawnSvg out;
  out.pixels.width = across;
  out.pixels.height = down;
  const auto count = static_cast<size_t>(across) * static_cast<size_t>(down);
  const bool told = in->get(wrong);
  if (told && !wrong.empty()) return problem(wrong);
  if (!told || !in->get(out.width) || !in->get(out.height) || !in->get(out.pixels.rgba) ||
      out.pixels.rgba.size() != count || !(out.width > 0) || !(out.height > 0))
    return problem("the drawing cannot be rendered: the renderer gave no sound answer");
  return out;
}

}  // namespace luxodus

#include "actors/results/formats/drawing.hpp"

#include <cstring>

#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

/// The memory of the pixel (x, y); nullptr if the surface has no memory.
uint32_t* pixel_at(cairo_surface_t* surface, int x, int y) {
  unsigned char* data = cairo_image_surface_get_data(surface);
  if (data == nullptr) return nullptr;
  const auto stride = static_cast<size_t>(cairo_image_surface_get_stride(surface));
  return reinterpret_cast<uint32_t*>(data + static_cast<size_t>(y) * stride) + x;
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_)) {
  // Grey antialiasing and no hinting of metrics give the same picture on any desktop.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_, options);
  cairo_font_options_destroy(options);
  colour(1);
  cairo_paint(context_);
}

Canvas::~Canvas() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

bool Canvas::good() const {
  return cairo_status(context_) == CAIRO_STATUS_SUCCESS;
}

std::string Canvas::failure() const {
  return cairo_status_to_string(cairo_status(context_));
}

void Canvas::colour(double red, double green, double blue, double alpha) {
  cairo_set_source_rgba(context_, red, green, blue, alpha);
}

void Canvas::font(double size_px, bool bold) {
  cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, size_px);
}

double Canvas::text_width(const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context_, clean_utf8(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::go_to_text(double x, double y, const std::string& text, TextAlign align, double turn) {
  const double width = text_width(text);
  const double shift = align == TextAlign::left     ? 0
                       : align == TextAlign::centre ? -width / 2
                                                    : -width;
  cairo_save(context_);
  cairo_translate(context_, x, y);
  cairo_rotate(context_, turn);
  cairo_move_to(context_, shift, 0);
}

void Canvas::text(double x, double y, const std::string& text, TextAlign align, double turn) {
  go_to_text(x, y, text, align, turn);
  cairo_show_text(context_, clean_utf8(text).c_str());
  cairo_restore(context_);
  cairo_new_path(context_);
}

void Canvas::rimmed_text(double x, double y, const std::string& text, TextAlign align,
                         double turn) {
  go_to_text(x, y, text, align, turn);
  cairo_text_path(context_, clean_utf8(text).c_str());
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(context_, 5);
  colour(0.08, 0.85);
  cairo_stroke_preserve(context_);
  colour(1);
  cairo_fill(context_);
  cairo_restore(context_);
}

std::string Canvas::fitted(const std::string& text, double width_px) {
  std::string out = clean_utf8(text);
  if (text_width(out) <= width_px) return out;
  // Bisects the number of bytes kept; never cuts within a character, whose continuation bytes are
  // 10xxxxxx.
  const auto cut_at = [&](size_t length) {
    while (length > 0 && (static_cast<uint8_t>(out[length]) & 0xC0) == 0x80) --length;
    return out.substr(0, length);
  };
  size_t fits = 0;
  size_t wide = out.size() - 1;
  while (fits < wide) {
    const size_t middle = (fits + wide + 1) / 2;
    if (text_width(cut_at(middle) + "…") <= width_px) {
      fits = middle;
    } else {
      wide = middle - 1;
    }
  }
  return cut_at(fits) + "…";
}

void Canvas::line(double x0, double y0, double x1, double y1) {
  cairo_move_to(context_, x0, y0);
  cairo_line_to(context_, x1, y1);
  cairo_stroke(context_);
}

void Canvas::pixel(int x, int y, const std::array<uint8_t, 3>& rgb) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  uint32_t* at = pixel_at(surface_, x, y);
  if (at == nullptr) return;
  *at = uint32_t{0xFF} << 24 | uint32_t{rgb[0]} << 16 | uint32_t{rgb[1]} << 8 | rgb[2];
}

std::vector<uint8_t> Canvas::rgb() {
  flush();
  std::vector<uint8_t> out;
  out.reserve(static_cast<size_t>(width_) * static_cast<size_t>(height_) * 3);
  for (int y = 0; y < height_; ++y) {
    const uint32_t* row = pixel_at(surface_, 0, y);
    if (row == nullptr) return {};
    for (int x = 0; x < width_; ++x) {
      out.push_back(static_cast<uint8_t>(row[x] >> 16));
      out.push_back(static_cast<uint8_t>(row[x] >> 8));
      out.push_back(static_cast<uint8_t>(row[x]));
    }
  }
  return out;
}

}  // namespace luxodus

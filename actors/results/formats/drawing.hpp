// A thin wrapper of cairo for the pictures of this room: a canvas that frees itself, text that is
// always valid, colours by name. Internal to actors/results/formats. A canvas belongs to one
// thread.
#pragma once

#include <cairo.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace luxodus {

enum class TextAlign { left, centre, right };

/// An RGB picture to draw on, white at first. Coordinates in pixels, y downwards.
class Canvas {
 public:
  Canvas(int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// False once cairo has failed (out of memory): then nothing more is drawn.
  bool good() const;
  std::string failure() const;
  cairo_t* context() { return context_; }

  void colour(double grey, double alpha = 1) { colour(grey, grey, grey, alpha); }
  void colour(double red, double green, double blue, double alpha);
  void font(double size_px, bool bold = false);
  double text_width(const std::string& text);
  /// `y` is the base line. The text turns by `turn` radians about (x, y), clockwise.
  void text(double x, double y, const std::string& text, TextAlign align = TextAlign::left,
            double turn = 0);
  /// Text with a dark outline, readable on every colour.
  void rimmed_text(double x, double y, const std::string& text, TextAlign align, double turn);
  /// The text, ending in "…" where it would be wider than `width_px`.
  std::string fitted(const std::string& text, double width_px);
  void line(double x0, double y0, double x1, double y1);
  /// Fills one pixel; the caller asks `flush` before the first and `changed` after the last.
  void pixel(int x, int y, const std::array<uint8_t, 3>& rgb);
  void flush() { cairo_surface_flush(surface_); }
  void changed() { cairo_surface_mark_dirty(surface_); }
  /// All pixels, 3 bytes each, top row first.
  std::vector<uint8_t> rgb();

 private:
  /// Saves the state, which the caller restores, and moves to where a text begins.
  void go_to_text(double x, double y, const std::string& text, TextAlign align, double turn);

  int width_;
  int height_;
  cairo_surface_t* surface_;
  cairo_t* context_;
};

}  // namespace luxodus

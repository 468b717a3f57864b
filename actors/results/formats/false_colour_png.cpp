// From the outside in: the frame is laid out (plot, scale bar, lines of text), which gives the
// canvas its height; then values, contours, axes, bar and texts are drawn over each other. Long
// floors have the scale bar below, others beside, so that the plot gets more room.
#include "actors/results/formats/false_colour_png.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "actors/results/formats/contour_lines.hpp"
#include "actors/results/formats/drawing.hpp"
#include "actors/results/formats/light_colours.hpp"
#include "actors/results/formats/plot_axis.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

// Sizes in pixels for a picture 1600 wide; other widths scale all of them.
constexpr double design_width = 1600;
constexpr double margin = 44;
constexpr double title_size = 34;
constexpr double text_size = 23;
constexpr double tick_size = 21;
constexpr double contour_text_size = 20;
constexpr double bar_thickness = 34;
constexpr double max_plot_height = 1100;
constexpr double min_plot_height = 70;
constexpr double wide_aspect = 2.1;
// From this ratio of largest to smallest value on, a linear scale would show the small ones as
// black.
constexpr double logarithmic_ratio = 15;
// A larger ratio between the ends of an automatic logarithmic scale would hide differences of
// bright values.
constexpr double max_scale_ratio = 1e4;

struct Statistics {
  double low = 0, mean = 0, high = 0;
  double low_positive = 0;  // 0 if there is none
  size_t low_index = 0;
  size_t count = 0;
};

Statistics statistics_of(const std::vector<double>& values) {
  Statistics s;
  double sum = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    if (!std::isfinite(v)) continue;
    if (s.count == 0 || v < s.low) {
      s.low = v;
      s.low_index = i;
    }
    s.high = s.count == 0 ? v : std::max(s.high, v);
    if (v > 0 && (s.low_positive == 0 || v < s.low_positive)) s.low_positive = v;
    sum += v;
    ++s.count;
  }
  if (s.count > 0) s.mean = sum / static_cast<double>(s.count);
  return s;
}

/// Whether some cells have a value and some have none.
bool has_gaps(const FalseColourPicture& picture, const Statistics& s) {
  return s.count > 0 && s.count < picture.values.size();
}

/// Maps values to places on the colour scale.
struct Scale {
  bool logarithmic = false;
  double low = 0;
  double high = 1;

  double place(double value) const {
    if (!logarithmic) return std::clamp((value - low) / (high - low), 0.0, 1.0);
    if (value <= low) return 0;
    return std::min((std::log(value) - std::log(low)) / (std::log(high) - std::log(low)), 1.0);
  }
  std::vector<AxisTick> ticks(int about) const {
    return logarithmic ? log_ticks(low, high) : linear_ticks(low, high, about);
  }
};

Scale scale_of(const FalseColourPicture& picture, const Statistics& s) {
  Scale scale;
  scale.logarithmic = picture.scale == ColourScale::logarithmic ||
                      (picture.scale == ColourScale::automatic && s.low_positive > 0 &&
                       s.low >= 0 && s.high > logarithmic_ratio * s.low_positive);
  if (scale.logarithmic) {
    const double high = s.high > 0 ? s.high : 1;
    scale.high = picture.scale_high.value_or(round_up_125(high));
    const double low = s.low_positive > 0 ? s.low_positive : high / 10;
    scale.low = picture.scale_low.value_or(
        round_down_125(std::min(std::max(low, scale.high / max_scale_ratio), scale.high / 2)));
    return scale;
  }
  // The scale begins at zero unless the values stay far from it.
  double low = s.low < 0 || s.low > 0.6 * s.high ? s.low : 0;
  double high = s.high;
  const double span = high > low ? high - low : std::max(std::abs(high), 1.0);
  if (high <= low) high = low + span;
  const double step = round_up_125(span / 8);
  scale.low = picture.scale_low.value_or(std::floor(low / step + 1e-9) * step);
  scale.high = picture.scale_high.value_or(std::ceil(high / step - 1e-9) * step);
  return scale;
}

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
};

struct Layout {
  double k = 1;  // pixels per design pixel
  int width = 0, height = 0;
  Box plot, bar;
  bool bar_below = false;
  double title_y = 0, subtitle_y = 0, summary_y = 0;
};

Layout lay_out(const FalseColourPicture& p, size_t note_lines) {
  Layout l;
  l.k = p.width_px / design_width;
  l.width = p.width_px;
  const double aspect = p.length_u_m / p.length_v_m;
  l.bar_below = aspect > wide_aspect;
  double y = margin;
  if (!p.title.empty()) l.title_y = y += title_size * 0.8;
  if (!p.subtitle.empty()) l.subtitle_y = y += text_size * 1.55;
  y += p.title.empty() && p.subtitle.empty() ? 0 : 30;
  const double left = margin + 88;
  const double right = l.bar_below ? margin + 14 : margin + 190;
  const double room = design_width - left - right;
  // Longer floors are compressed; both axes state their length.
  const double height = std::clamp(room / aspect, min_plot_height, max_plot_height);
  const double width = std::min(room, std::max(height * aspect, 120.0));
  l.plot = {left + (room - width) / 2, y, width, height};
  y += height + 82;  // room for ticks and the axis' name
  if (l.bar_below) {
    l.bar = {left, y + 40, room, bar_thickness};
    y += 40 + bar_thickness + 44;
  } else {
    l.bar = {l.plot.x + width + 48, l.plot.y, bar_thickness, height};
  }
  l.summary_y = y + 32;
  y = l.summary_y + static_cast<double>(note_lines) * text_size * 1.5 + margin * 0.7;
  l.height = static_cast<int>(std::ceil(y * l.k));
  return l;
}

class Painter {
 public:
  Painter(const FalseColourPicture& picture, const Statistics& statistics)
      : p_(picture),
        s_(statistics),
        scale_(scale_of(picture, statistics)),
        l_(lay_out(picture, picture.notes.size() + (has_gaps(picture, statistics) ? 1 : 0))),
        canvas_(l_.width, l_.height) {}

  Canvas& draw() {
    paint_values();
    cairo_scale(canvas_.context(), l_.k, l_.k);
    draw_contours();
    draw_axes();
    if (marks_minimum()) draw_minimum();
    draw_bar();
    draw_texts();
    return canvas_;
  }

 private:
  double cell(int u, int v) const {
    return p_
        .values[static_cast<size_t>(v) * static_cast<size_t>(p_.cells_u) + static_cast<size_t>(u)];
  }
  double smooth_value(double u, double v) const;
  std::array<uint8_t, 3> no_value_colour(int x, int y) const;
  double x_of(double u_m) const {
    return l_.plot.x + (u_m - p_.origin_u_m) / p_.length_u_m * l_.plot.width;
  }
  double y_of(double v_m) const {
    return l_.plot.y + l_.plot.height - (v_m - p_.origin_v_m) / p_.length_v_m * l_.plot.height;
  }
  void clip_to_plot() {
    cairo_rectangle(canvas_.context(), l_.plot.x, l_.plot.y, l_.plot.width, l_.plot.height);
    cairo_clip(canvas_.context());
  }
  std::string with_unit(double value) const {
    return readable_number(value) + (p_.unit.empty() ? "" : " " + p_.unit);
  }

  bool marks_minimum() const { return p_.mark_minimum && s_.count > 0 && s_.low < s_.high; }

  void paint_values();
  void draw_contours();
  void draw_contour(const ContourLine& line);
  void label_contour(const std::vector<glm::dvec2>& path, const std::string& label);
  void draw_minimum();
  void draw_axes();
  void draw_bar();
  void draw_texts();
  std::string summary() const;

  const FalseColourPicture& p_;
  const Statistics& s_;
  Scale scale_;
  Layout l_;
  Canvas canvas_;
  std::vector<glm::dvec2> labels_;  // places of contour labels
};

/// The value at a place in cells from the corner, bilinear between the cell centres with a value.
double Painter::smooth_value(double u, double v) const {
  const int nearest_u = std::clamp(static_cast<int>(u), 0, p_.cells_u - 1);
  const int nearest_v = std::clamp(static_cast<int>(v), 0, p_.cells_v - 1);
  const double nearest = cell(nearest_u, nearest_v);
  if (!p_.smooth || !std::isfinite(nearest)) return nearest;
  const double cu = std::clamp(u - 0.5, 0.0, p_.cells_u - 1.0);
  const double cv = std::clamp(v - 0.5, 0.0, p_.cells_v - 1.0);
  const int u0 = static_cast<int>(cu);
  const int v0 = static_cast<int>(cv);
  double sum = 0;
  double weights = 0;
  for (const int j : {v0, v0 + 1}) {
    for (const int i : {u0, u0 + 1}) {
      const double weight = (1 - std::abs(cu - i)) * (1 - std::abs(cv - j));
      if (weight <= 0 || i >= p_.cells_u || j >= p_.cells_v) continue;
      const double value = cell(i, j);
      if (!std::isfinite(value)) continue;
      sum += weight * value;
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : nearest;
}

std::array<uint8_t, 3> Painter::no_value_colour(int x, int y) const {
  const int period = std::max(6, static_cast<int>(std::lround(14 * l_.k)));
  const bool stripe = (x + y) % period < std::max(2, period / 5);
  return stripe ? std::array<uint8_t, 3>{190, 194, 199} : std::array<uint8_t, 3>{226, 229, 232};
}

void Painter::paint_values() {
  const int x0 = static_cast<int>(std::lround(l_.plot.x * l_.k));
  const int x1 = static_cast<int>(std::lround((l_.plot.x + l_.plot.width) * l_.k));
  const int y0 = static_cast<int>(std::lround(l_.plot.y * l_.k));
  const int y1 = static_cast<int>(std::lround((l_.plot.y + l_.plot.height) * l_.k));
  canvas_.flush();
  for (int y = y0; y < y1; ++y) {
    const double v = (y1 - y - 0.5) / (y1 - y0) * p_.cells_v;
    for (int x = x0; x < x1; ++x) {
      const double u = (x - x0 + 0.5) / (x1 - x0) * p_.cells_u;
      const double value = smooth_value(u, v);
      canvas_.pixel(
          x, y, std::isfinite(value) ? light_colour(scale_.place(value)) : no_value_colour(x, y));
    }
  }
  canvas_.changed();
}

/// Centres of the cells plus both ends of the axis, so that lines extend to the border.
std::vector<double> contour_axis(int cells, double origin, double length) {
  std::vector<double> out = {origin};
  for (int i = 0; i < cells; ++i) out.push_back(origin + length * (i + 0.5) / cells);
  out.push_back(origin + length);
  return out;
}

void Painter::draw_contours() {
  const std::vector<double> u = contour_axis(p_.cells_u, p_.origin_u_m, p_.length_u_m);
  const std::vector<double> v = contour_axis(p_.cells_v, p_.origin_v_m, p_.length_v_m);
  std::vector<double> values;
  values.reserve(u.size() * v.size());
  for (int j = -1; j <= p_.cells_v; ++j) {
    for (int i = -1; i <= p_.cells_u; ++i) {
      values.push_back(cell(std::clamp(i, 0, p_.cells_u - 1), std::clamp(j, 0, p_.cells_v - 1)));
    }
  }
  cairo_save(canvas_.context());
  clip_to_plot();
  std::vector<std::pair<std::vector<glm::dvec2>, std::string>> to_label;
  for (const double level : p_.contours) {
    for (ContourLine& line : contour_lines(u, v, values, level)) {
      for (glm::dvec2& point : line.points) point = {x_of(point.x), y_of(point.y)};
      draw_contour(line);
      to_label.emplace_back(std::move(line.points), with_unit(level));
    }
  }
  for (const auto& [path, label] : to_label) label_contour(path, label);
  cairo_restore(canvas_.context());
}

void Painter::draw_contour(const ContourLine& line) {
  cairo_t* context = canvas_.context();
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  for (const bool rim : {true, false}) {
    for (const glm::dvec2& point : line.points) cairo_line_to(context, point.x, point.y);
    cairo_set_line_width(context, rim ? 5.0 : 2.4);
    canvas_.colour(rim ? 0.05 : 1.0, rim ? 0.55 : 1.0);
    cairo_stroke(context);
  }
}

/// Writes a label along the line, at the straightest free place; none on a line that is too short.
void Painter::label_contour(const std::vector<glm::dvec2>& path, const std::string& label) {
  canvas_.font(contour_text_size, true);
  const double width = canvas_.text_width(label) + 16;
  double length = 0;
  for (size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
  if (length < 1.8 * width) return;

  double best = std::numeric_limits<double>::max();
  glm::dvec2 place{0};
  glm::dvec2 along{1, 0};
  double from_start = 0;
  for (size_t i = 0, j = 0; i < path.size(); ++i) {
    if (i > 0) from_start += glm::distance(path[i - 1], path[i]);
    while (j + 1 < path.size() && glm::distance(path[i], path[j]) < width) ++j;
    const glm::dvec2 chord = path[j] - path[i];
    const double chord_length = glm::length(chord);
    if (j <= i || chord_length < width) continue;
    const glm::dvec2 middle = (path[i] + path[j]) * 0.5;
    const double inside_x = std::min(middle.x - l_.plot.x, l_.plot.x + l_.plot.width - middle.x);
    const double inside_y = std::min(middle.y - l_.plot.y, l_.plot.y + l_.plot.height - middle.y);
    if (inside_x < width * 0.6 || inside_y < contour_text_size) continue;
    double bend = 0;  // largest distance of the line from its chord
    for (size_t m = i; m <= j; ++m) {
      const glm::dvec2 d = path[m] - path[i];
      bend = std::max(bend, std::abs(chord.x * d.y - chord.y * d.x) / chord_length);
    }
    double cost =
        bend + 0.05 * std::abs(from_start - length / 2) + 6 * std::abs(chord.y) / chord_length;
    for (const glm::dvec2& other : labels_) {
      const double distance = glm::distance(other, middle);
      if (distance < width) cost += 1e4;
      if (distance < 3 * width) cost += 3 * width - distance;
    }
    if (cost < best) {
      best = cost;
      place = middle;
      along = chord;
    }
  }
  if (best >= 1e4) return;
  if (along.x < 0) along = -along;
  const double turn = std::atan2(along.y, along.x);
  // The base line lies a third of the letters' height below the middle of the line.
  const glm::dvec2 down = glm::dvec2(-std::sin(turn), std::cos(turn)) * (contour_text_size * 0.36);
  canvas_.rimmed_text(place.x + down.x, place.y + down.y, label, TextAlign::centre, turn);
  labels_.push_back(place);
}

void Painter::draw_minimum() {
  const auto columns = static_cast<size_t>(p_.cells_u);
  const double u = (static_cast<double>(s_.low_index % columns) + 0.5) / p_.cells_u;
  const double v = (static_cast<double>(s_.low_index / columns) + 0.5) / p_.cells_v;
  const double x = l_.plot.x + u * l_.plot.width;
  const double y = l_.plot.y + (1 - v) * l_.plot.height;
  cairo_t* context = canvas_.context();
  cairo_save(context);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  for (const bool rim : {true, false}) {
    cairo_set_line_width(context, rim ? 7 : 3.2);
    canvas_.colour(rim ? 0.05 : 1, rim ? 0.7 : 1);
    canvas_.line(x - 9, y - 9, x + 9, y + 9);
    canvas_.line(x - 9, y + 9, x + 9, y - 9);
  }
  cairo_restore(context);
}

void Painter::draw_axes() {
  cairo_t* context = canvas_.context();
  const double bottom = l_.plot.y + l_.plot.height;
  canvas_.colour(0.15);
  cairo_set_line_width(context, 2);
  cairo_rectangle(context, l_.plot.x, l_.plot.y, l_.plot.width, l_.plot.height);
  cairo_stroke(context);
  canvas_.font(tick_size);
  const int about_u = std::clamp(static_cast<int>(l_.plot.width / 130), 2, 12);
  for (const AxisTick& tick : linear_ticks(p_.origin_u_m, p_.origin_u_m + p_.length_u_m, about_u)) {
    const double x = x_of(tick.value);
    canvas_.line(x, bottom, x, bottom + 9);
    canvas_.text(x, bottom + 34, tick.label, TextAlign::centre);
  }
  const int about_v = std::clamp(static_cast<int>(l_.plot.height / 60), 2, 10);
  double widest = 0;
  for (const AxisTick& tick : linear_ticks(p_.origin_v_m, p_.origin_v_m + p_.length_v_m, about_v)) {
    const double y = y_of(tick.value);
    canvas_.line(l_.plot.x - 9, y, l_.plot.x, y);
    canvas_.text(l_.plot.x - 16, y + tick_size * 0.36, tick.label, TextAlign::right);
    widest = std::max(widest, canvas_.text_width(tick.label));
  }
  canvas_.font(text_size);
  const std::string unit = " [" + p_.length_unit + "]";
  canvas_.text(l_.plot.x + l_.plot.width / 2, bottom + 70, p_.label_u + unit, TextAlign::centre);
  canvas_.text(l_.plot.x - 32 - widest, l_.plot.y + l_.plot.height / 2, p_.label_v + unit,
               TextAlign::centre, -std::numbers::pi / 2);
}

void Painter::draw_bar() {
  cairo_t* context = canvas_.context();
  const Box& bar = l_.bar;
  const double length = l_.bar_below ? bar.width : bar.height;
  const auto at = [&](double place) {  // pixels along the bar, as a coordinate
    return l_.bar_below ? bar.x + place * length : bar.y + (1 - place) * length;
  };
  const int steps = 512;
  for (int i = 0; i < steps; ++i) {
    const LightColour c = light_colour((i + 0.5) / steps);
    canvas_.colour(c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, 1);
    // Each piece extends to the end of the bar: the next one covers it, which avoids gaps.
    const double from = static_cast<double>(i) / steps;
    if (l_.bar_below) {
      cairo_rectangle(context, at(from), bar.y, at(1) - at(from), bar.height);
    } else {
      cairo_rectangle(context, bar.x, bar.y, bar.width, at(from) - bar.y);
    }
    cairo_fill(context);
  }
  for (const double level : p_.contours) {
    if (level < scale_.low || level > scale_.high) continue;
    const double a = at(scale_.place(level));
    for (const bool rim : {true, false}) {
      cairo_set_line_width(context, rim ? 5 : 2.4);
      canvas_.colour(rim ? 0.05 : 1, rim ? 0.55 : 1);
      if (l_.bar_below)
        canvas_.line(a, bar.y, a, bar.y + bar.height);
      else
        canvas_.line(bar.x, a, bar.x + bar.width, a);
    }
  }
  canvas_.colour(0.15);
  cairo_set_line_width(context, 2);
  cairo_rectangle(context, bar.x, bar.y, bar.width, bar.height);
  cairo_stroke(context);
  canvas_.font(tick_size);
  double widest = 0;
  for (const AxisTick& tick : scale_.ticks(std::clamp(static_cast<int>(length / 90), 2, 10))) {
    widest = std::max(widest, canvas_.text_width(tick.label));
    const double a = at(scale_.place(tick.value));
    const double reach = tick.label.empty() ? 5 : 9;
    if (l_.bar_below) {
      canvas_.line(a, bar.y + bar.height, a, bar.y + bar.height + reach);
      canvas_.text(a, bar.y + bar.height + 33, tick.label, TextAlign::centre);
    } else {
      canvas_.line(bar.x + bar.width, a, bar.x + bar.width + reach, a);
      canvas_.text(bar.x + bar.width + 16, a + tick_size * 0.36, tick.label);
    }
  }
  const std::string name = p_.quantity + (p_.unit.empty() ? "" : " [" + p_.unit + "]");
  canvas_.font(text_size, true);
  if (l_.bar_below) {
    canvas_.text(bar.x, bar.y - 14, canvas_.fitted(name, bar.width));
  } else {
    canvas_.text(bar.x + bar.width + 34 + widest, bar.y + bar.height / 2,
                 canvas_.fitted(name, bar.height), TextAlign::centre, std::numbers::pi / 2);
  }
}

std::string Painter::summary() const {
  if (s_.count == 0) return "No cell of this grid has a value.";
  std::string out = "minimum " + with_unit(s_.low) + (marks_minimum() ? " (×)" : "") +
                    "   ·   mean " + with_unit(s_.mean) + "   ·   maximum " + with_unit(s_.high) +
                    "   ·   " + std::to_string(p_.cells_u) + " × " + std::to_string(p_.cells_v) +
                    " cells of " + readable_number(p_.length_u_m / p_.cells_u) + " × " +
                    readable_number(p_.length_v_m / p_.cells_v) + " " + p_.length_unit;
  return out;
}

void Painter::draw_texts() {
  const double left = margin + 24;
  const double room = design_width - 2 * left;
  canvas_.colour(0.1);
  canvas_.font(title_size, true);
  if (!p_.title.empty()) canvas_.text(left, l_.title_y, canvas_.fitted(p_.title, room));
  canvas_.font(text_size);
  canvas_.colour(0.32);
  if (!p_.subtitle.empty()) canvas_.text(left, l_.subtitle_y, canvas_.fitted(p_.subtitle, room));
  canvas_.colour(0.1);
  canvas_.text(left, l_.summary_y, canvas_.fitted(summary(), room));
  canvas_.colour(0.32);
  double y = l_.summary_y;
  std::vector<std::string> notes = p_.notes;
  if (has_gaps(p_, s_)) {
    notes.insert(notes.begin(),
                 std::to_string(p_.values.size() - s_.count) + " cells have no value (hatched)");
  }
  for (const std::string& note : notes) {
    y += text_size * 1.5;
    canvas_.text(left, y, canvas_.fitted(note, room));
  }
}

Result<void> check(const FalseColourPicture& p, const SourcePlace& place) {
  if (p.cells_u < 1 || p.cells_v < 1 || p.cells_u > limits::max_grid_edge ||
      p.cells_v > limits::max_grid_edge ||
      static_cast<uint64_t>(p.cells_u) * static_cast<uint64_t>(p.cells_v) >
          limits::max_drawn_cells) {
    return problem_in(place, "a grid of " + std::to_string(p.cells_u) + " x " +
                                 std::to_string(p.cells_v) +
                                 " cells cannot be drawn; edges are 1 to " +
                                 std::to_string(limits::max_grid_edge) + " cells");
  }
  if (p.values.size() != static_cast<size_t>(p.cells_u) * static_cast<size_t>(p.cells_v)) {
    return problem_in(place, "a grid of " + std::to_string(p.cells_u) + " x " +
                                 std::to_string(p.cells_v) + " cells has " +
                                 std::to_string(p.values.size()) + " values");
  }
  const auto length_good = [](double m) { return std::isfinite(m) && m > 0; };
  if (!length_good(p.length_u_m) || !length_good(p.length_v_m) || !std::isfinite(p.origin_u_m) ||
      !std::isfinite(p.origin_v_m)) {
    return problem_in(place, "the edges of a grid must be longer than zero and its corner finite");
  }
  if (p.width_px < limits::min_picture_edge_px || p.width_px > limits::max_picture_edge_px) {
    return problem_in(place, "a picture is " + std::to_string(limits::min_picture_edge_px) +
                                 " to " + std::to_string(limits::max_picture_edge_px) +
                                 " pixels wide");
  }
  if (p.contours.size() > limits::max_contours) {
    return problem_in(place, "at most " + std::to_string(limits::max_contours) + " contour lines");
  }
  return {};
}

}  // namespace

Result<PngImage> draw_false_colour(const FalseColourPicture& picture, const SourcePlace& place) {
  if (auto good = check(picture, place); !good) return good.problem();
  const Statistics statistics = statistics_of(picture.values);
  const Scale scale = scale_of(picture, statistics);
  if (!std::isfinite(scale.low) || !std::isfinite(scale.high) || scale.low >= scale.high ||
      (scale.logarithmic && scale.low <= 0)) {
    return problem_in(place, "the colour scale from " + shortest_number(scale.low) + " to " +
                                 shortest_number(scale.high) +
                                 " has no order; a logarithmic one must lie above zero");
  }
  Painter painter(picture, statistics);
  Canvas& canvas = painter.draw();
  if (!canvas.good())
    return problem_in(place, "cannot draw this picture: " + canvas.failure(), ProblemKind::system);
  PngImage image;
  image.width = cairo_image_surface_get_width(cairo_get_target(canvas.context()));
  image.height = cairo_image_surface_get_height(cairo_get_target(canvas.context()));
  image.rgb = canvas.rgb();
  image.text.emplace_back("Title", picture.title.empty() ? picture.quantity : picture.title);
  image.text.emplace_back(
      "Description",
      picture.quantity + " [" + picture.unit + "]: minimum " + shortest_number(statistics.low) +
          ", mean " + shortest_number(statistics.mean) + ", maximum " +
          shortest_number(statistics.high) + "; scale from " + shortest_number(scale.low) + " to " +
          shortest_number(scale.high) + (scale.logarithmic ? " (logarithmic)" : " (linear)"));
  image.text.insert(image.text.end(), picture.text.begin(), picture.text.end());
  return image;
}

Result<void> write_false_colour_png(const std::filesystem::path& path,
                                    const FalseColourPicture& picture) {
  Result<PngImage> image = draw_false_colour(picture, {path.string(), 0});
  if (!image) return image.problem();
  return write_png(path, image.value());
}

}  // namespace luxodus

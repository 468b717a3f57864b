// The plot is drawn back to front: grid, reference, error bars, lines, markers, frame, texts.
// Colours are those of Okabe and Ito (2008), which colour-blind readers can distinguish; markers
// differ in shape as well.
#include "actors/results/formats/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "actors/results/formats/plot_axis.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

constexpr std::array<std::string_view, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#56b4e9", "#e69f00", "#444444"};
constexpr double left = 96, right = 32, bottom_margin = 92;
constexpr double marker_radius = 4.6;
constexpr double legend_line = 24;
constexpr double label_gap = 10;  // between a point and its label

/// A coordinate to a hundredth of a unit: further digits only make files long.
std::string coordinate(double value) {
  std::array<char, 40> buffer;
  const double rounded = std::round(value * 1e2) / 1e2;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded + 0.0);
  return {buffer.data(), end.ptr};
}

/// log(a / b) without the quotient, which may overflow a double.
double log_ratio(double a, double b) {
  return std::log(a) - std::log(b);
}

struct Axis {
  bool logarithmic = false;
  double low = 0, high = 1;
  double from = 0, to = 1;  // where low and high are drawn

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  double place(double value) const {
    const double t =
        logarithmic ? log_ratio(value, low) / log_ratio(high, low) : (value - low) / (high - low);
    return from + t * (to - from);
  }
  double clamped(double value) const {
    if (value <= low || (logarithmic && value <= 0)) return from;
    return value >= high ? to : place(value);
  }
  std::vector<AxisTick> ticks(int about) const {
    return logarithmic ? log_ticks(low, high, about) : linear_ticks(low, high, about);
  }
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

void fit(Axis& axis, Range range) {
  if (!(range.low <= range.high)) range = axis.logarithmic ? Range{1, 10} : Range{0, 1};
  if (axis.logarithmic) {
    // Adds a margin; whole decades only if the data nearly fill them.
    const double air = std::max(std::exp(0.05 * log_ratio(range.high, range.low)), 1.25);
    axis.low = std::max(range.low / air, std::numeric_limits<double>::min());
    axis.high = std::min(range.high * air, std::numeric_limits<double>::max());
    return;
  }
  double span = range.high - range.low;
  if (!(span > 0)) span = std::max(std::abs(range.high), 1.0);
  const double step = round_up_125(span / 6);
  axis.low = std::floor((range.low - 0.02 * span) / step) * step;
  axis.high = std::ceil((range.high + 0.02 * span) / step) * step;
  if (range.low >= 0 && axis.low < 0) axis.low = 0;
}

class SvgPainter {
 public:
  explicit SvgPainter(const SvgPlot& plot) : p_(plot) {
    x_.logarithmic = p_.log_x;
    y_.logarithmic = p_.log_y;
    Range range_x, range_y;
    for (const PlotSeries& s : p_.series) {
      for (size_t i = 0; i < s.x.size(); ++i) {
        if (!shown(s, i)) {
          ++hidden_;
          continue;
        }
        range_x.take(s.x[i]);
        range_y.take(s.y[i]);
        const double e = s.error.empty() ? 0 : s.error[i];
        if (y_.shows(s.y[i] + e)) range_y.take(s.y[i] + e);
        // On a logarithmic axis an error bar down to zero would stretch the axis without limit.
        if (!p_.log_y || s.y[i] - e > s.y[i] / 10) range_y.take(s.y[i] - e);
      }
    }
    fit(x_, range_x);
    fit(y_, range_y);
    top_ = 28 + (p_.title.empty() ? 0 : 28) + (p_.subtitle.empty() ? 0 : 24);
    x_.from = left;
    x_.to = p_.width - right;
    y_.from = p_.height - bottom_margin - (hidden_ > 0 ? 20 : 0);
    y_.to = top_;
  }

  std::string draw() {
    begin();
    grid();
    out_ += "<g clip-path=\"url(#plot)\">\n";
    reference();
    for (size_t i = 0; i < p_.series.size(); ++i) series(p_.series[i], i);
    out_ += "</g>\n";
    frame();
    legend();
    texts();
    return out_ + "</svg>\n";
  }

 private:
  bool shown(const PlotSeries& s, size_t i) const {
    return x_.shows(s.x[i]) && y_.shows(s.y[i]) && (s.error.empty() || std::isfinite(s.error[i]));
  }
  void line(double x0, double y0, double x1, double y1, const std::string& style) {
    out_ += "<line x1=\"" + coordinate(x0) + "\" y1=\"" + coordinate(y0) + "\" x2=\"" +
            coordinate(x1) + "\" y2=\"" + coordinate(y1) + "\" " + style + "/>\n";
  }
  void text(double x, double y, const std::string& style, const std::string& content) {
    out_ += "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" " + style + ">" +
            xml_escape(content) + "</text>\n";
  }
  void begin();
  void grid();
  void reference();
  void series(const PlotSeries& s, size_t index);
  void error_bars(const PlotSeries& s);
  void labels(const PlotSeries& s);
  void marker(double x, double y, size_t index);
  void frame();
  void legend();
  void texts();
  std::pair<double, double> legend_place(double width, double height) const;

  const SvgPlot& p_;
  Axis x_, y_;
  double top_ = 0;
  size_t hidden_ = 0;
  std::string out_;
};

void SvgPainter::begin() {
  const std::string w = std::to_string(p_.width);
  const std::string h = std::to_string(p_.height);
  out_ =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
      w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " + h +
      "\" font-family=\"'DejaVu Sans', 'Segoe UI', "
      "Helvetica, Arial, sans-serif\" font-size=\"14\">\n";
  if (!p_.title.empty()) out_ += "<title>" + xml_escape(p_.title) + "</title>\n";
  out_ += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  out_ += "<clipPath id=\"plot\"><rect x=\"" + coordinate(x_.from) + "\" y=\"" + coordinate(y_.to) +
          "\" width=\"" + coordinate(x_.to - x_.from) + "\" height=\"" +
          coordinate(y_.from - y_.to) + "\"/></clipPath>\n";
}

void SvgPainter::grid() {
  const std::string minor = "stroke=\"#eef0f3\" stroke-width=\"1\"";
  const std::string major = "stroke=\"#d5dae1\" stroke-width=\"1\"";
  for (const bool labelled : {false, true}) {
    for (const AxisTick& tick : x_.ticks(9)) {
      if (tick.label.empty() == labelled) continue;
      const double x = x_.place(tick.value);
      line(x, y_.from, x, y_.to, labelled ? major : minor);
      if (labelled) text(x, y_.from + 24, "text-anchor=\"middle\" fill=\"#333\"", tick.label);
    }
    for (const AxisTick& tick : y_.ticks(7)) {
      if (tick.label.empty() == labelled) continue;
      const double y = y_.place(tick.value);
      line(x_.from, y, x_.to, y, labelled ? major : minor);
      if (labelled) text(x_.from - 10, y + 5, "text-anchor=\"end\" fill=\"#333\"", tick.label);
    }
  }
}

void SvgPainter::reference() {
  if (!p_.reference || p_.series.empty()) return;
  const PlotSeries& s = p_.series.front();
  size_t first = 0;
  while (first < s.x.size() && !shown(s, first)) ++first;
  if (first == s.x.size()) return;
  const double slope = p_.reference->slope;
  const auto at = [&](double x) {
    return x_.logarithmic ? s.y[first] * std::pow(x / s.x[first], slope)
                          : s.y[first] + slope * (x - s.x[first]);
  };
  line(x_.from, y_.place(at(x_.low)), x_.to, y_.place(at(x_.high)),
       "stroke=\"#7a828e\" stroke-width=\"1.6\" stroke-dasharray=\"7 5\"");
}

void SvgPainter::error_bars(const PlotSeries& s) {
  for (size_t i = 0; i < s.error.size(); ++i) {
    if (!shown(s, i) || s.error[i] <= 0) continue;
    const double x = x_.place(s.x[i]);
    const double low = y_.clamped(s.y[i] - s.error[i]);
    const double high = y_.clamped(s.y[i] + s.error[i]);
    line(x, low, x, high, "stroke-width=\"1.4\"");
    line(x - 4, high, x + 4, high, "stroke-width=\"1.4\"");
    // A bar that continues below the axis has no lower end to show.
    if (s.y[i] - s.error[i] > y_.low) line(x - 4, low, x + 4, low, "stroke-width=\"1.4\"");
  }
}

/// Labels to the right of a point, or to the left in the right half.
void SvgPainter::labels(const PlotSeries& s) {
  const double middle = 0.5 * (x_.from + x_.to);
  for (size_t i = 0; i < s.labels.size(); ++i) {
    if (!shown(s, i)) continue;
    const double x = x_.place(s.x[i]);
    const bool before = x > middle;
    text(before ? x - label_gap : x + label_gap, y_.place(s.y[i]) - label_gap / 2,
         std::string("stroke=\"none\" fill=\"#4a525e\" font-size=\"12\" text-anchor=\"") +
             (before ? "end\"" : "start\""),
         s.labels[i]);
  }
}

void SvgPainter::marker(double x, double y, size_t index) {
  const double r = marker_radius;
  const auto point = [&](double dx, double dy) {
    return coordinate(x + dx * r) + "," + coordinate(y + dy * r) + " ";
  };
  switch (index % 4) {
    case 0:
      out_ += "<circle cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"" +
              coordinate(r) + "\"/>\n";
      break;
    case 1:
      out_ += "<polygon points=\"" + point(-.9, -.9) + point(.9, -.9) + point(.9, .9) +
              point(-.9, .9) + "\"/>\n";
      break;
    case 2:
      out_ += "<polygon points=\"" + point(0, -1.2) + point(1.1, .8) + point(-1.1, .8) + "\"/>\n";
      break;
    default:
      out_ += "<polygon points=\"" + point(0, -1.3) + point(1.3, 0) + point(0, 1.3) +
              point(-1.3, 0) + "\"/>\n";
  }
}

void SvgPainter::series(const PlotSeries& s, size_t index) {
  const std::string colour(colours[index % colours.size()]);
  out_ += "<g stroke=\"" + colour + "\" fill=\"none\">\n";
  error_bars(s);
  if (s.line) {
    // A point that is not shown interrupts the line.
    bool open = false;
    for (size_t i = 0; i < s.x.size(); ++i) {
      if (!shown(s, i)) {
        if (open) out_ += "\"/>\n";
        open = false;
        continue;
      }
      if (!open) out_ += "<polyline stroke-width=\"2.2\" stroke-linejoin=\"round\" points=\"";
      open = true;
      out_ += coordinate(x_.place(s.x[i])) + "," + coordinate(y_.place(s.y[i])) + " ";
    }
    if (open) out_ += "\"/>\n";
  }
  out_ += "</g>\n";
  if (!s.markers) return;
  out_ += "<g fill=\"" + colour + "\" stroke=\"#ffffff\" stroke-width=\"1.2\">\n";
  for (size_t i = 0; i < s.x.size(); ++i) {
    if (shown(s, i)) marker(x_.place(s.x[i]), y_.place(s.y[i]), index);
  }
  out_ += "</g>\n";
  labels(s);
}

void SvgPainter::frame() {
  out_ += "<rect x=\"" + coordinate(x_.from) + "\" y=\"" + coordinate(y_.to) + "\" width=\"" +
          coordinate(x_.to - x_.from) + "\" height=\"" + coordinate(y_.from - y_.to) +
          "\" fill=\"none\" stroke=\"#444b55\" stroke-width=\"1.4\"/>\n";
}

/// Position of the legend: the corner with the fewest points behind it.
std::pair<double, double> SvgPainter::legend_place(double width, double height) const {
  constexpr double margin = 12;
  using Place = std::pair<double, double>;
  const double west = x_.from + margin, east = x_.to - margin - width;
  const double north = y_.to + margin, south = y_.from - margin - height;
  const std::array corners{Place{east, north}, Place{west, north}, Place{east, south},
                           Place{west, south}};
  const auto points_behind = [&](const Place& corner) {
    int points = 0;
    for (const PlotSeries& s : p_.series)
      for (size_t i = 0; i < s.x.size(); ++i) {
        if (!shown(s, i)) continue;
        const double x = x_.place(s.x[i]) - corner.first, y = y_.place(s.y[i]) - corner.second;
        points += x > -margin && x < width + margin && y > -margin && y < height + margin;
      }
    return points;
  };
  return *std::min_element(corners.begin(), corners.end(), [&](const Place& a, const Place& b) {
    return points_behind(a) < points_behind(b);
  });
}

void SvgPainter::legend() {
  struct Entry {
    std::string name;
    size_t index;
    bool reference;
  };
  std::vector<Entry> entries;
  for (size_t i = 0; i < p_.series.size(); ++i) {
    if (!p_.series[i].name.empty()) entries.push_back({p_.series[i].name, i, false});
  }
  if (p_.reference && !p_.reference->label.empty())
    entries.push_back({p_.reference->label, 0, true});
  if (entries.empty()) return;
  size_t longest = 0;
  for (const Entry& entry : entries) {
    const std::string clean = clean_utf8(entry.name);
    longest = std::max(
        longest, static_cast<size_t>(std::count_if(clean.begin(), clean.end(),
                                                   [](char c) { return (c & 0xC0) != 0x80; })));
  }
  // SVG cannot measure text; 8.6 units a letter suit DejaVu Sans, the widest of the named fonts.
  const double width = std::min(62 + 8.6 * static_cast<double>(longest), (x_.to - x_.from) - 24);
  const double height = legend_line * static_cast<double>(entries.size()) + 12;
  const auto [x, y] = legend_place(width, height);
  out_ += "<rect x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" width=\"" +
          coordinate(width) + "\" height=\"" + coordinate(height) +
          "\" rx=\"4\" fill=\"#ffffff\" fill-opacity=\"0.92\" stroke=\"#c6ccd4\"/>\n";
  double row = y + 6 + legend_line / 2;
  for (const Entry& entry : entries) {
    const std::string colour(entry.reference ? "#7a828e" : colours[entry.index % colours.size()]);
    const PlotSeries* s = entry.reference ? nullptr : &p_.series[entry.index];
    if (s == nullptr || s->line) {
      line(x + 12, row, x + 44, row,
           "stroke=\"" + colour + "\" stroke-width=\"2.2\"" +
               (entry.reference ? " stroke-dasharray=\"7 5\"" : ""));
    }
    if (s != nullptr && s->markers) {
      out_ += "<g fill=\"" + colour + "\" stroke=\"#ffffff\" stroke-width=\"1.2\">\n";
      marker(x + 28, row, entry.index);
      out_ += "</g>\n";
    }
    text(x + 54, row + 5, "fill=\"#222\"", entry.name);
    row += legend_line;
  }
}

void SvgPainter::texts() {
  double y = 14;
  if (!p_.title.empty()) {
    text(x_.from, y += 22, "font-size=\"20\" font-weight=\"bold\" fill=\"#16191d\"", p_.title);
  }
  if (!p_.subtitle.empty()) text(x_.from, y += 25, "fill=\"#555d68\"", p_.subtitle);
  text((x_.from + x_.to) / 2, y_.from + 58, "font-size=\"16\" text-anchor=\"middle\" fill=\"#222\"",
       p_.label_x);
  const double middle = (y_.from + y_.to) / 2;
  text(26, middle,
       "font-size=\"16\" text-anchor=\"middle\" fill=\"#222\" transform=\"rotate(-90 26 " +
           coordinate(middle) + ")\"",
       p_.label_y);
  if (hidden_ > 0) {
    text(x_.from, p_.height - 16, "font-size=\"13\" fill=\"#8a3b00\"",
         std::to_string(hidden_) + (hidden_ == 1 ? " point is" : " points are") +
             " not shown: no number, or not above zero on a logarithmic axis");
  }
}

}  // namespace

Result<std::string> svg_plot_text(const SvgPlot& plot, const SourcePlace& place) {
  if (plot.width < 320 || plot.height < 240 || plot.width > 10000 || plot.height > 10000) {
    return problem_in(place, "a plot is 320 x 240 to 10000 x 10000 units large");
  }
  if (plot.series.size() > limits::max_plot_series) {
    return problem_in(place,
                      "at most " + std::to_string(limits::max_plot_series) + " series in a plot");
  }
  for (const PlotSeries& s : plot.series) {
    const std::string name = "series '" + clean_utf8(s.name) + "'";
    if (s.y.size() != s.x.size() || (!s.error.empty() && s.error.size() != s.x.size()) ||
        (!s.labels.empty() && s.labels.size() != s.x.size())) {
      return problem_in(place, name + " has columns of different length", ProblemKind::bug);
    }
    if (s.x.size() > limits::max_plot_points)
      return problem_in(place, name + " has too many points");
  }
  if (plot.reference && (plot.log_x != plot.log_y || !std::isfinite(plot.reference->slope))) {
    return problem_in(place, "a reference slope needs two linear or two logarithmic axes");
  }
  return SvgPainter(plot).draw();
}

Result<void> write_svg_plot(const std::filesystem::path& path, const SvgPlot& plot) {
  Result<std::string> text = svg_plot_text(plot, {path.string(), 0});
  if (!text) return text.problem();
  return write_file_atomically(path, std::string_view(text.value()));
}

}  // namespace luxodus

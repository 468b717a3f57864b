// Line plots as self-contained SVG: several series with error bars, linear or logarithmic axes, a
// reference slope, a legend; used for error against particles and seconds. The text is plain XML
// with a sans-serif font and no scripts; equal content gives equal bytes. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t max_plot_series = 32;
inline constexpr size_t max_plot_points = 100000;  // of one series
}  // namespace limits

struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> error;  // +- of y, >= 0; empty: none
  bool line = true;
  bool markers = true;
  std::vector<std::string> labels = {};  // beside the points; empty: none
};

/// A dashed line of known slope through the first shown point of the first series: y ~ x^slope on
/// two logarithmic axes, y = slope x + constant on two linear ones.
struct PlotReference {
  double slope = -0.5;
  std::string label = "slope −1/2";
};

struct SvgPlot {
  std::string title;
  std::string subtitle;
  std::string label_x;  // with unit: "time [s]"
  std::string label_y;
  bool log_x = false;
  bool log_y = false;
  std::vector<PlotSeries> series;
  std::optional<PlotReference> reference;
  int width = 960;  // units of the drawing; it scales to any size
  int height = 640;
};

/// The SVG. Points that are not finite, or not positive on a logarithmic axis, are left out and
/// counted in a line below the plot. Errors: a series whose columns differ in length, more than the
/// limits, a reference slope with one logarithmic axis.
Result<std::string> svg_plot_text(const SvgPlot& plot, const SourcePlace& place);
/// Errors: as svg_plot_text and write_file_atomically.
Result<void> write_svg_plot(const std::filesystem::path& path, const SvgPlot& plot);

}  // namespace luxodus

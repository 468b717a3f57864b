#include "actors/results/formats/svg_plot.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Matchers::Contains;

namespace {

const SourcePlace plot_place{"plot.svg", 0};

SvgPlot convergence() {
  SvgPlot plot;
  plot.title = "Error against particles";
  plot.label_x = "particles";
  plot.label_y = "relative error";
  plot.log_x = plot.log_y = true;
  PlotSeries s;
  s.name = "wall mean";
  for (int i = 0; i < 5; ++i) {
    s.x.push_back(1000 * std::pow(4, i));
    s.y.push_back(0.1 * std::pow(0.5, i));
    s.error.push_back(s.y.back() / 4);
  }
  plot.series = {s};
  plot.reference = PlotReference{};
  return plot;
}

std::string drawn_plot(const SvgPlot& plot) {
  Result<std::string> text = svg_plot_text(plot, plot_place);
  REQUIRE(text.ok());
  return text.value();
}

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Renders it with librsvg, and counts the pixels that are not white.
size_t ink(const std::string& svg) {
  GError* error = nullptr;
  RsvgHandle* handle =
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error);
  REQUIRE(handle != nullptr);
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 480, 320);
  cairo_t* context = cairo_create(surface);
  const RsvgRectangle viewport{0, 0, 480, 320};
  REQUIRE(rsvg_handle_render_document(handle, context, &viewport, &error));
  cairo_surface_flush(surface);
  const auto* pixels = reinterpret_cast<const uint32_t*>(cairo_image_surface_get_data(surface));
  const auto inked = std::count_if(pixels, pixels + 480 * 320,
                                   [](uint32_t p) { return (p & 0xffffff) != 0xffffff; });
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  g_object_unref(handle);
  return static_cast<size_t>(inked);
}

/// The text between `before` and the next quote, looked for from `from` on.
std::string between(const std::string& text, const std::string& before, size_t from = 0) {
  const size_t at = text.find(before, from);
  REQUIRE(at != std::string::npos);
  return text.substr(at + before.size(), text.find('"', at + before.size()) - at - before.size());
}

std::vector<std::pair<double, double>> polyline(const std::string& svg) {
  std::istringstream list(between(svg, " points=\"", svg.find("<polyline")));
  std::vector<std::pair<double, double>> out;
  double x = 0, y = 0;
  char comma = 0;
  while (list >> x >> comma >> y) out.emplace_back(x, y);
  return out;
}

}  // namespace

TEST_CASE("points have their labels beside them, towards the middle of the plot") {
  SvgPlot plot = convergence();
  plot.series[0].labels = {"A & B", "C", "D", "E", "F"};
  const std::string svg = drawn_plot(plot);
  CHECK_THAT(svg, Contains(">A &amp; B</text>"));
  const auto anchor_of = [&](const std::string& label) {
    const size_t end = svg.find(">" + label + "</text>");
    REQUIRE(end != std::string::npos);
    return svg.substr(svg.rfind("<text", end), end - svg.rfind("<text", end));
  };
  CHECK_THAT(anchor_of("C"), Contains("text-anchor=\"start\""));
  CHECK_THAT(anchor_of("F"), Contains("text-anchor=\"end\""));
  plot.series[0].labels.pop_back();
  CHECK_FALSE(svg_plot_text(plot, plot_place).ok());
}

TEST_CASE("a plot is an SVG that another library renders", "[format][svg]") {
  const std::string svg = drawn_plot(convergence());
  CHECK(ink(svg) > 2000);
  CHECK_THAT(svg, Contains("Error against particles") && Contains("wall mean") &&
                      Contains("slope −1/2") && Contains("relative error"));
  CHECK(count(svg, "<circle") == 6);  // five points and the legend
  CHECK(svg == drawn_plot(convergence()));
  CHECK_THAT(svg, !Contains("<script") && !Contains("href"));
}

TEST_CASE("a power law is a straight line on logarithmic axes, and so is its reference",
          "[format][svg]") {
  const auto points = polyline(drawn_plot(convergence()));
  REQUIRE(points.size() == 5);
  const double slope = (points[4].second - points[0].second) / (points[4].first - points[0].first);
  CHECK(slope > 0);  // falling: y grows downwards
  for (const auto& [x, y] : points) {
    CHECK(y == Approx(points[0].second + slope * (x - points[0].first)).margin(0.05));
  }
  const std::string svg = drawn_plot(convergence());
  const size_t line = svg.rfind("<line ", svg.find("stroke=\"#7a828e\""));
  const double x1 = std::stod(between(svg, "x1=\"", line));
  const double y1 = std::stod(between(svg, "y1=\"", line));
  const double x2 = std::stod(between(svg, "x2=\"", line));
  const double y2 = std::stod(between(svg, "y2=\"", line));
  CHECK((y2 - y1) / (x2 - x1) == Approx(slope).epsilon(1e-3));
}

TEST_CASE("points that an axis cannot show are left out, counted, and interrupt the line",
          "[format][svg]") {
  SvgPlot plot = convergence();
  plot.series[0].y[1] = 0;
  plot.series[0].y[3] = std::nan("");
  const std::string svg = drawn_plot(plot);
  CHECK_THAT(svg, Contains("2 points are not shown"));
  CHECK(count(svg, "<polyline") == 3);
  CHECK(count(svg, "nan") == 0);
  plot.series[0].y[3] = 0.01;
  CHECK_THAT(drawn_plot(plot), Contains("1 point is not shown"));
  CHECK_THAT(drawn_plot(convergence()), !Contains("not shown"));
}

TEST_CASE("every plot can be drawn: empty, flat, one point, huge errors, huge ranges",
          "[format][svg]") {
  SvgPlot plot;
  CHECK(ink(drawn_plot(plot)) > 0);
  plot.log_x = plot.log_y = true;
  CHECK(ink(drawn_plot(plot)) > 0);
  for (const bool logarithmic : {false, true}) {
    plot.log_x = plot.log_y = logarithmic;
    for (const double y : {1e-300, 1e-9, 0.0, 3.0, 1e300}) {
      PlotSeries s{"s", {5, 5}, {y, y}, {1e3 * y, 0}, true, true};
      plot.series = {s, {"wide", {1, 1e9}, {1, 1e12}, {}, true, false}};
      plot.reference = PlotReference{};
      const std::string svg = drawn_plot(plot);
      CHECK(ink(svg) > 0);
      CHECK(count(svg, "nan") == 0);
      CHECK(count(svg, "inf") == 0);
    }
  }
}

TEST_CASE("names with unusual characters stay text", "[format][svg]") {
  SvgPlot plot = convergence();
  plot.title = "</title><script>alert(1)</script> & \xff";
  plot.series[0].name = "\"<&>'\" ]]> \x01";
  plot.label_x = "grün [€]";
  const std::string svg = drawn_plot(plot);
  CHECK(count(svg, "<script") == 0);
  CHECK_THAT(svg, Contains("&lt;script&gt;") && Contains("grün [€]"));
  CHECK(ink(svg) > 2000);
}

TEST_CASE("a plot with contradictory data is rejected, and an unwritable place named",
          "[format][svg]") {
  const auto refusal = [](auto change) {
    SvgPlot plot = convergence();
    change(plot);
    const Result<std::string> text = svg_plot_text(plot, plot_place);
    REQUIRE_FALSE(text.ok());
    return text.problem().what;
  };
  CHECK_THAT(refusal([](SvgPlot& p) { p.series[0].y.pop_back(); }),
             Contains("'wall mean'") && Contains("different length"));
  CHECK_THAT(refusal([](SvgPlot& p) { p.series[0].error.pop_back(); }),
             Contains("different length"));
  CHECK_THAT(refusal([](SvgPlot& p) { p.log_y = false; }), Contains("reference slope"));
  CHECK_THAT(refusal([](SvgPlot& p) { p.series.resize(100); }), Contains("at most 32 series"));
  CHECK_THAT(refusal([](SvgPlot& p) { p.width = 10; }), Contains("320 x 240"));
  const test::TemporaryFolder folder;
  CHECK(write_svg_plot(folder / "a.svg", convergence()).ok());
  CHECK_THAT(write_svg_plot(folder / "none" / "a.svg", convergence()).problem().text(),
             Contains("none/a.svg") && Contains("No such file"));
}

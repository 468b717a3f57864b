#include "topology/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "runtime/core/output_text.hpp"
#include "topology/layout.hpp"

namespace luxodus {
namespace {

constexpr double picture_px = 900;  // width and height, including the border
constexpr double border_px = 60;

/// Colours of the links, one for each rotation family.
std::vector<std::string> link_colours(const Graph& graph) {
  if (graph.rotation() == 1) return std::vector<std::string>(graph.links().size(), "#7a8aa0");
  std::map<GraphLink, size_t> families;
  std::vector<size_t> family;
  for (const GraphLink& link : graph.links()) {
    const GraphLink first = turned(graph.workers(), graph.rotation(), {&link, 1}).front();
    family.push_back(families.try_emplace(first, families.size()).first->second);
  }
  std::vector<std::string> colours;
  for (const size_t f : family) {
    // Evenly spaced hues of one lightness.
    const double hue = 6.0 * double(f) / double(families.size());
    const auto channel = [&](double at) {
      const double k = std::fmod(at + hue, 6.0);
      return static_cast<int>(195 - 150 * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
    };
    colours.push_back(fmt::format("#{:02x}{:02x}{:02x}", channel(5), channel(3), channel(1)));
  }
  return colours;
}

/// Escapes text for XML and for quoted strings of DOT.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : xml_escape(text)) out += c == '\\' ? std::string("&#92;") : std::string(1, c);
  return out;
}

double px(double along) {
  return picture_px / 2 + along * (picture_px / 2 - border_px);
}

}  // namespace

std::string graph_svg(const Graph& graph, std::string_view title) {
  const std::vector<DrawnPlace> places = layout(graph);
  const std::vector<std::string> colours = link_colours(graph);
  // Keeps vertices apart on the circle and numbers readable, as far as there is room.
  const double radius = std::clamp(800.0 / graph.vertices(), 3.0, 17.0);
  // A letter is about half as wide as high.
  const double title_px = std::min(16.0, 1.8 * picture_px / static_cast<double>(title.size() + 1));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" width=\"{0}\" "
      "height=\"{0}\" font-family=\"sans-serif\">\n"
      "<rect width=\"{0}\" height=\"{0}\" fill=\"#ffffff\"/>\n"
      "<text x=\"{1}\" y=\"26\" font-size=\"{4:.1f}\" text-anchor=\"middle\">{2}</text>\n"
      "<g stroke-width=\"{3:.2f}\" stroke-opacity=\"0.8\">\n",
      picture_px, picture_px / 2, escaped(title), std::clamp(radius / 7, 0.5, 2.2), title_px);
  for (size_t i = 0; i < graph.links().size(); ++i) {
    const auto [a, b] = graph.links()[i];
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
        px(places[a].x), px(-places[a].y), px(places[b].x), px(-places[b].y), colours[i]);
  }
  svg += fmt::format("</g>\n<g font-size=\"{:.1f}\" text-anchor=\"middle\">\n", radius * 0.95);
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    const double x = px(places[v].x), y = px(-places[v].y);
    const bool controller = v == graph.workers();
    svg += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" fill=\"{3}\" stroke=\"#20303f\"/>"
        "<text x=\"{0:.1f}\" y=\"{4:.1f}\" fill=\"{5}\">{6}</text>\n",
        x, y, controller ? 1.3 * radius : radius, controller ? "#20303f" : "#ffffff",
        y + 0.34 * radius, controller ? "#ffffff" : "#20303f", v);
  }
  return svg + "</g>\n</svg>\n";
}

std::string graph_dot(const Graph& graph, std::string_view title) {
  constexpr double points = 500;  // from the centre to the border [pt]
  const std::vector<DrawnPlace> places = layout(graph);
  const std::vector<std::string> colours = link_colours(graph);
  std::string dot = fmt::format(
      "graph luxodus {{\n  layout=neato; label=\"{}\"; labelloc=t;\n  node [shape=circle];\n",
      escaped(title));
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    dot += fmt::format("  {} [pos=\"{:.1f},{:.1f}!\"{}];\n", v, points * places[v].x,
                       points * places[v].y,
                       v == graph.workers() ? ", style=filled, fillcolor=gray" : "");
  }
  for (size_t i = 0; i < graph.links().size(); ++i) {
    const auto [a, b] = graph.links()[i];
    dot += fmt::format("  {} -- {} [color=\"{}\"];\n", a, b, colours[i]);
  }
  return dot + "}\n";
}

}  // namespace luxodus

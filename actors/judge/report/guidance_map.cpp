#include "actors/judge/report/guidance_map.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "actors/judge/report/svg_sheet.hpp"
#include "actors/results/formats/plot_axis.hpp"

namespace luxodus {

namespace {

/// Colours differ in lightness too, for black-and-white prints.
struct Look {
  const char* colour;
  const char* text;  // key
};
/// In the order of Guidance, from good to bad.
constexpr std::array<Look, 3> looks{{{"#2f8f5b", "guided.guided"},
                                     {"#e0b23a", "guided.undecided"},
                                     {"#4a2a33", "guided.not_guided"}}};
constexpr double left_mm = 16, right_mm = 4, top_mm = 4, foot_mm = 20;
constexpr double drawing_mm = 62;  // height of the drawing
constexpr double line_mm = 0.2;

const Look& worse(Guidance a, Guidance b) {
  return looks[static_cast<size_t>(std::max(a, b))];
}

/// Converts metres and seconds to millimetres of paper.
class MapFrame {
 public:
  MapFrame(const OverTime& over, const RouteOverTime& route, double width_mm)
      : length_m_(route.guided.length_m),
        width_mm_(width_mm - left_mm - right_mm),
        places_(route.guided.along_m) {
    for (const TimedState& state : over.states) times_.push_back(state.at_s);
    places_.push_back(length_m_);
  }
  double x(double metres) const { return left_mm + width_mm_ * metres / std::max(length_m_, 1e-9); }
  double y(double seconds) const {
    const double span = times_.back() - times_.front();
    const double share = span > 0 ? (seconds - times_.front()) / span : 0;
    return top_mm + drawing_mm * (1 - share);
  }
  const std::vector<double>& times() const { return times_; }
  /// Start of each piece of the route, and the end of the route.
  const std::vector<double>& places() const { return places_; }
  double length_m() const { return length_m_; }
  double bottom() const { return top_mm + drawing_mm; }

 private:
  double length_m_, width_mm_;
  std::vector<double> times_, places_;
};

std::string box(double x, double y, double width, double height, const char* colour) {
  return fmt::format(
      "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" fill=\"{}\" "
      "shape-rendering=\"crispEdges\"/>\n",
      x, y, width, height, colour);
}

std::string stroke(double x0, double y0, double x1, double y1, const char* colour, double width) {
  return fmt::format(
      "<line x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      x0, y0, x1, y1, colour, width);
}

/// Cells between two states, from each place to the next; the worse state counts.
std::string cells(const MapFrame& frame, const std::vector<std::vector<Guidance>>& guided) {
  std::string out;
  for (size_t t = 0; t < frame.times().size(); ++t) {
    const size_t next = std::min(t + 1, frame.times().size() - 1);
    if (next == t && t > 0) break;
    const double low = frame.times().size() == 1 ? frame.bottom() : frame.y(frame.times()[t]);
    const double high = frame.times().size() == 1 ? top_mm : frame.y(frame.times()[next]);
    for (size_t i = 0; i + 1 < frame.places().size(); ++i) {
      const double x = frame.x(frame.places()[i]), end = frame.x(frame.places()[i + 1]);
      out += box(x, high, end - x, low - high, worse(guided[t][i], guided[next][i]).colour);
    }
  }
  return out;
}

/// Lines from the start of each walker to his end, or to the last state.
std::string walkers_of(const MapFrame& frame, const RouteOverTime& route) {
  std::string out;
  for (const WalkRecord& walk : route.walks) {
    const auto& [start, end, at_m, at_s] = static_cast<const GuidedWalk&>(walk);
    const double share =
        at_s > start ? std::clamp((frame.times().back() - start) / (at_s - start), 0.0, 1.0) : 1.0;
    out += stroke(frame.x(0), frame.y(start), frame.x(at_m * share),
                  frame.y(start + (at_s - start) * share), "#fff", 0.7) +
           stroke(frame.x(0), frame.y(start), frame.x(at_m * share),
                  frame.y(start + (at_s - start) * share), "#1c2024", 0.35);
  }
  return out;
}

std::vector<double> times_to_write(const MapFrame& frame) {
  const double first = frame.times().front(), last = frame.times().back();
  if (!(first < last)) return {first};
  std::vector<double> out;
  for (const AxisTick& tick : linear_ticks(first, last, 6)) out.push_back(tick.value);
  return out;
}

std::string axes(const MapFrame& frame, const Texts& t) {
  std::string out;
  for (const AxisTick& tick : linear_ticks(0, frame.length_m(), 10))
    out += stroke(frame.x(tick.value), frame.bottom(), frame.x(tick.value), frame.bottom() + 1.2,
                  "#222", line_mm) +
           text_at(frame.x(tick.value), frame.bottom() + 4.2, t.number(tick.value, 4),
                   "text-anchor=\"middle\"");
  for (const double time : frame.times())
    out += stroke(left_mm - 1.2, frame.y(time), left_mm, frame.y(time), "#222", line_mm);
  for (const double tick : times_to_write(frame))
    out += text_at(left_mm - 2, frame.y(tick) + 0.9, t.number(tick, 4), "text-anchor=\"end\"");
  out += text_at(frame.x(frame.length_m() / 2), frame.bottom() + 8.6, t("guided.along"),
                 "text-anchor=\"middle\"");
  const double middle = top_mm + drawing_mm / 2;
  return out +
         text_at(4, middle, t("guided.time"),
                 fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 4 {:.3f})\"", middle)
                     .c_str());
}

std::string legend(const MapFrame& frame, const Texts& t) {
  std::string out;
  double x = left_mm;
  const double y = frame.bottom() + 14;
  for (const Look& look : looks) {
    const std::string text = t(look.text);
    out += box(x, y - 2.2, 4, 2.6, look.colour) + text_at(x + 5.2, y, text);
    x += 9 + text_width_mm(text, text_mm);
  }
  return out;
}

}  // namespace

std::string guidance_map(const OverTime& over_time, const RouteOverTime& route, const Texts& texts,
                         double width_mm) {
  const MapFrame frame(over_time, route, width_mm);
  const double height = top_mm + drawing_mm + foot_mm;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" "
             "viewBox=\"0 0 {0:.3f} {1:.3f}\" font-family=\"Liberation Sans, Arial, Helvetica, "
             "DejaVu Sans, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
             width_mm, height) +
         cells(frame, route.guided.at) + walkers_of(frame, route) + axes(frame, texts) +
         legend(frame, texts) + "</svg>\n";
}

}  // namespace luxodus

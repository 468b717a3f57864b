#include "actors/assess/plan_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenes/format/output_text.hpp"
#include "scenes/vision/false_colour.hpp"

namespace luxodus {

namespace {

constexpr double drawn_width = 1000, border = 12, scale_height = 46;
/// The ends of the scale of illuminance [lx]: the limits of the codes lie well within.
constexpr double lux_low = 0.1, lux_high = 100;

/// Metres of the plan to units of the drawing, north up.
class Sheet {
 public:
  explicit Sheet(const Json& plan) {
    for (const Json& line : plan["walls"]) {
      take(line[0].get<double>(), line[1].get<double>());
      take(line[2].get<double>(), line[3].get<double>());
    }
    for (const Json& p : plan["points"]) take(p[0].get<double>(), p[1].get<double>());
    unit_ = (drawn_width - 2 * border) / std::max(1e-9, high_[0] - low_[0]);
  }
  double x(double metres) const { return border + (metres - low_[0]) * unit_; }
  double y(double metres) const { return border + (high_[1] - metres) * unit_; }
  double length(double metres) const { return metres * unit_; }
  double height() const { return 2 * border + (high_[1] - low_[1]) * unit_; }

 private:
  void take(double x, double y) {
    low_[0] = std::min(low_[0], x);
    low_[1] = std::min(low_[1], y);
    high_[0] = std::max(high_[0], x);
    high_[1] = std::max(high_[1], y);
  }
  double low_[2] = {1e300, 1e300}, high_[2] = {-1e300, -1e300};
  double unit_ = 1;
};

std::string opening(double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n",
      drawn_width, height);
}

std::string walls(const Json& plan, const Sheet& sheet) {
  std::string path;
  for (const Json& line : plan["walls"])
    path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", sheet.x(line[0].get<double>()),
                        sheet.y(line[1].get<double>()), sheet.x(line[2].get<double>()),
                        sheet.y(line[3].get<double>()));
  return "<path d=\"" + path + "\" stroke=\"#333\" stroke-width=\"1\" fill=\"none\"/>\n";
}

/// A dot, and a tick to where it faces: of one sign, or of all.
std::string signs(const Json& plan, const Sheet& sheet, const std::string& only = "") {
  std::string out;
  for (const Json& sign : plan["signs"]) {
    if (!only.empty() && sign["name"].get<std::string>() != only) continue;
    const double x = sheet.x(sign["position"][0].get<double>());
    const double y = sheet.y(sign["position"][1].get<double>());
    out += fmt::format(
        "<g><title>{}</title><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/><path d=\"M{:.1f} "
        "{:.1f}l{:.1f} {:.1f}\" stroke=\"#000\" stroke-width=\"2\"/></g>\n",
        xml_escape(sign["name"].get<std::string>()), x, y, x, y,
        10 * sign["facing"][0].get<double>(), -10 * sign["facing"][1].get<double>());
  }
  return out;
}

std::string colour_of(double lux) {
  const double share = std::log(std::max(lux, 1e-12) / lux_low) / std::log(lux_high / lux_low);
  const Rgb8 rgb = map_colour(std::clamp(share, 0.0, 1.0));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb.r, rgb.g, rgb.b);
}

std::string colour_scale(double top) {
  std::string out;
  constexpr int steps = 100;
  const double width = drawn_width / 2;
  for (int i = 0; i < steps; ++i) {
    const double lux = lux_low * std::pow(lux_high / lux_low, (i + 0.5) / steps);
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"14\" fill=\"{}\"/>\n",
        border + width * i / steps, top, width / steps + 0.5, colour_of(lux));
  }
  for (const double tick : {0.1, 0.5, 1.0, 10.0, 100.0})
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       border + width * std::log(tick / lux_low) / std::log(lux_high / lux_low) +
                           (tick == lux_low ? 8 : 0),
                       top + 28, readable_number(tick));
  return out +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">lx</text>\n", border + width + 30, top + 28);
}

/// What is best of all signs for somebody at a place.
constexpr std::array<std::pair<const char*, const char*>, 4> sight_colours{
    {{"legible", "#2e9e4f"},
     {"undecided", "#e6c229"},
     {"visible but not legible", "#f08a24"},
     {"invisible", "#d1332e"}}};

}  // namespace

std::string plan_of_light(const Json& assessment) {
  const Json& plan = assessment["plan"];
  const Sheet sheet(plan);
  std::string out = opening(sheet.height() + scale_height);
  for (const Json& p : plan["points"])
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
        sheet.x(p[0].get<double>() - 0.25), sheet.y(p[1].get<double>() + 0.25), sheet.length(0.5),
        sheet.length(0.5), colour_of(p[2].get<double>()));
  return out + walls(plan, sheet) + signs(plan, sheet) + colour_scale(sheet.height()) + "</svg>\n";
}

std::string plan_of_sights(const Json& assessment, double eye_height_m, const std::string& sign) {
  const Json& plan = assessment["plan"];
  const Sheet sheet(plan);
  std::map<std::pair<double, double>, size_t> best;  // by place, a number of sight_colours
  for (const Json& sight : assessment["sights"]) {
    if (sight["eye_height"]["value"].get<double>() != eye_height_m) continue;
    if (!sign.empty() && sight["sign"].get<std::string>() != sign) continue;
    const std::string verdict = sight["verdict"].get<std::string>();
    const auto* at = std::find_if(sight_colours.begin(), sight_colours.end(),
                                  [&](const auto& colour) { return verdict == colour.first; });
    const auto rank = static_cast<size_t>(at - sight_colours.begin());
    const std::pair place{sight["eye"][0].get<double>(), sight["eye"][1].get<double>()};
    const auto known = best.try_emplace(place, rank).first;
    known->second = std::min(known->second, rank);
  }
  std::string out = opening(sheet.height()) + walls(plan, sheet);
  for (const auto& [place, rank] : best)
    out +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"{}\" stroke=\"#333\"/>\n",
                    sheet.x(place.first), sheet.y(place.second),
                    rank < sight_colours.size() ? sight_colours[rank].second : "#aaaaaa");
  return out + signs(plan, sheet, sign) + "</svg>\n";
}

}  // namespace luxodus

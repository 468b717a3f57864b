// The body is seen obliquely from below, as it looks on a ceiling: x to the right, y to the left,
// both away from the viewer upwards.
#include "actors/judge/report/luminaire_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "actors/judge/report/svg_sheet.hpp"
#include "actors/results/formats/plot_axis.hpp"

namespace luxodus {

namespace {

constexpr double polar_width_mm = 56, polar_height_mm = 46;
constexpr double body_width_mm = 36, body_height_mm = 34;
/// Light above the horizon below this share of the largest intensity does not move the centre.
constexpr double faint_up = 0.05;
/// Height of the numbers of rings.
constexpr double ring_text_mm = 2.1;
constexpr const char* curve_styles[] = {
    "fill=\"none\" stroke=\"#b3261e\" stroke-width=\"0.55\" stroke-linejoin=\"round\"",
    "fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"0.55\" stroke-dasharray=\"1.8 0.8\" "
    "stroke-linejoin=\"round\""};

std::string drawing(double width, double height, const std::string& body) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}mm\" "
             "height=\"{1}mm\" font-family=\"Liberation Sans, Arial, Helvetica, DejaVu Sans, "
             "sans-serif\">\n",
             width, height) +
         body + "</svg>";
}

/// Centre and radius of a polar diagram, and the intensity at its radius.
struct PolarFrame {
  glm::dvec2 centre{polar_width_mm / 2, 4};
  double radius_mm = 0, top_cd = 0, step_cd = 0;

  glm::dvec2 at(double gamma_deg, double cd) const {
    const double angle = gamma_deg * std::numbers::pi / 180, r = radius_mm * cd / top_cd;
    return centre + r * glm::dvec2(std::sin(angle), std::cos(angle));
  }
};

double largest(const std::vector<double>& curve) {
  return *std::max_element(curve.begin(), curve.end());
}

/// Largest intensity above the horizon.
double largest_up(const SheetRecord& sheet) {
  double out = 0;
  const size_t middle = sheet.c0_c180.size() / 2;
  for (const auto* curve : {&sheet.c0_c180, &sheet.c90_c270})
    for (size_t i = 0; i < curve->size(); ++i) {
      const double off =
          sheet.curve_step_deg * std::abs(static_cast<double>(i) - static_cast<double>(middle));
      if (off > 90) out = std::max(out, (*curve)[i]);
    }
  return out;
}

PolarFrame frame_of(const SheetRecord& sheet) {
  PolarFrame out;
  const double most = std::max({largest(sheet.c0_c180), largest(sheet.c90_c270), 1e-9});
  out.step_cd = round_up_125(most / 4);
  out.top_cd = out.step_cd * std::ceil(most / out.step_cd - 1e-9);
  const double foot = 7, up = largest_up(sheet);
  if (up > faint_up * most) {
    out.radius_mm = (polar_height_mm - foot - 4) / 2;
    out.centre.y = 4 + out.radius_mm;
  } else {
    out.radius_mm = std::min(polar_width_mm / 2 - 3, polar_height_mm - foot - 6);
  }
  return out;
}

std::vector<glm::dvec2> curve_points(const PolarFrame& frame, const SheetRecord& sheet,
                                     const std::vector<double>& curve) {
  std::vector<glm::dvec2> points;
  const auto middle = static_cast<double>(curve.size() / 2);
  for (size_t i = 0; i < curve.size(); ++i)
    points.push_back(frame.at((static_cast<double>(i) - middle) * sheet.curve_step_deg, curve[i]));
  return points;
}

/// Box of a ring's number.
struct RingLabel {
  glm::dvec2 centre{0}, half{0};
  std::string text;

  /// Whether a line passes beside it.
  bool is_free_of(const std::vector<glm::dvec2>& line) const {
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const glm::dvec2 from = (line[i] - centre) / half, to = (line[i + 1] - centre) / half;
      const glm::dvec2 way = to - from;
      const double share =
          std::clamp(-glm::dot(from, way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
      if (glm::length(from + share * way) < 1) return false;
    }
    return true;
  }
};

/// The numbers of rings along one direction, only those that no curve crosses.
std::vector<RingLabel> ring_labels(const PolarFrame& frame, double gamma_deg,
                                   const std::array<std::vector<glm::dvec2>, 2>& curves,
                                   const Texts& texts) {
  constexpr double gap_mm = 0.6;
  std::vector<RingLabel> out;
  for (double cd = frame.step_cd; cd < frame.top_cd * (1 + 1e-9); cd += frame.step_cd) {
    RingLabel label{frame.at(gamma_deg, cd), {}, texts.number(cd)};
    // An ellipse through the corners of the text's box.
    label.half = std::numbers::sqrt2 *
                 (glm::dvec2(text_width_mm(label.text, ring_text_mm), ring_text_mm) / 2.0 + gap_mm);
    if (gamma_deg == 0) label.centre += glm::dvec2(label.half.x / std::numbers::sqrt2, -0.4);
    if (label.is_free_of(curves[0]) && label.is_free_of(curves[1])) out.push_back(std::move(label));
  }
  return out;
}

/// The numbers of rings along the first direction in which most of them are free.
std::string ring_numbers(const PolarFrame& frame, bool whole,
                         const std::array<std::vector<glm::dvec2>, 2>& curves, const Texts& texts) {
  std::vector<RingLabel> best;
  for (const double gamma : {0., 15., -15., 45., -45., 75., -75., 105., -105., 135., -135., 165.}) {
    if (!whole && std::abs(gamma) > 90) continue;
    auto labels = ring_labels(frame, gamma, curves, texts);
    if (labels.size() > best.size()) best = std::move(labels);
  }
  std::string out;
  for (const RingLabel& label : best)
    out += text_at(label.centre.x, label.centre.y + 0.36 * ring_text_mm, label.text,
                   "text-anchor=\"middle\"", ring_text_mm);
  return out;
}

std::string polar_grid(const PolarFrame& frame, bool whole) {
  std::string out = "<g fill=\"none\" stroke=\"#b8c0c8\" stroke-width=\"0.15\">\n";
  const auto count = static_cast<int>(std::lround(frame.top_cd / frame.step_cd));
  for (int i = 1; i <= count; ++i) {
    const double r = frame.radius_mm * i / count;
    if (whole)
      out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", frame.centre.x,
                         frame.centre.y, r);
    else
      out +=
          fmt::format("<path d=\"M{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 0 {:.2f} {:.2f}\"/>\n",
                      frame.centre.x - r, frame.centre.y, r, r, frame.centre.x + r, frame.centre.y);
  }
  const int last = whole ? 180 : 90;
  for (int gamma = -last; gamma <= last; gamma += 30) {
    const glm::dvec2 end = frame.at(gamma, frame.top_cd);
    out += fmt::format("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\"/>\n", frame.centre.x,
                       frame.centre.y, end.x, end.y);
  }
  out += "</g>\n<g fill=\"#5c6670\">\n";
  for (const int gamma : {30, 60}) {
    const glm::dvec2 right = frame.at(gamma, frame.top_cd), left = frame.at(-gamma, frame.top_cd);
    out += text_at(right.x + 0.4, right.y + 1.6, std::to_string(gamma) + "°", "", 2.1) +
           text_at(left.x - 0.4, left.y + 1.6, std::to_string(gamma) + "°", "text-anchor=\"end\"",
                   2.1);
  }
  return out + "</g>\n";
}

std::string polar_curve(const std::vector<glm::dvec2>& points, const char* style) {
  return "<path class=\"curve\" d=\"" + path_of(points, false) + "\" " + style + "/>\n";
}

std::string polar_key(const Texts& texts) {
  const double y = polar_height_mm - 1.5;
  return fmt::format("<path d=\"M1 {0}h6\" {1}/><path d=\"M21 {0}h6\" {2}/>", y - 0.8,
                     curve_styles[0], curve_styles[1]) +
         text_at(8, y, "C0–C180", "", 2.3) + text_at(28, y, "C90–C270", "", 2.3) +
         text_at(polar_width_mm - 1, y, texts("sheet.cd_per_klm"), "text-anchor=\"end\"", 2.3);
}

/// A point of the body on paper, in its own unit.
glm::dvec2 seen(const glm::dvec3& p) {
  return {0.87 * (p.x - p.y), -0.5 * (p.x + p.y) - p.z};
}

using Outline = std::vector<glm::dvec3>;

Outline rectangle(double x, double y, double z) {
  return {{x, y, z}, {-x, y, z}, {-x, -y, z}, {x, -y, z}};
}

Outline ellipse(double x, double y, double z) {
  constexpr int corners = 48;
  Outline out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.emplace_back(x * std::cos(angle), y * std::sin(angle), z);
  }
  return out;
}

struct Face {
  Outline outline;
  const char* fill;
};

/// Faces from back to front.
std::vector<Face> faces_of(const glm::dvec3& size, bool round,
                           const std::optional<glm::dvec3>& lit) {
  const glm::dvec3 h = size / 2.0;
  std::vector<Face> out;
  if (round) {
    // The sides, from the tangents of the lower to those of the upper ellipse.
    out.push_back({ellipse(h.x, h.y, h.z), "#c3c9cf"});
    const double a = std::atan2(-h.y, h.x);
    const glm::dvec3 right(h.x * std::cos(a), h.y * std::sin(a), 0), left = -right;
    const glm::dvec3 up(0, 0, h.z);
    out.push_back({{right + up, right - up, left - up, left + up}, "#c3c9cf"});
    out.push_back({ellipse(h.x, h.y, -h.z), "#e6e9ec"});
  } else {
    out.push_back(
        {{{h.x, h.y, h.z}, {h.x, -h.y, h.z}, {h.x, -h.y, -h.z}, {h.x, h.y, -h.z}}, "#b9c0c7"});
    out.push_back(
        {{{h.x, h.y, h.z}, {-h.x, h.y, h.z}, {-h.x, h.y, -h.z}, {h.x, h.y, -h.z}}, "#cfd5da"});
    out.push_back({rectangle(h.x, h.y, -h.z), "#e6e9ec"});
  }
  if (lit && lit->x > 0 && lit->y > 0) {
    const double x = std::min(lit->x / 2, h.x), y = std::min(lit->y / 2, h.y);
    out.push_back({round ? ellipse(x, y, -h.z) : rectangle(x, y, -h.z), "#fff3c4"});
  }
  return out;
}

std::string extents_text(const glm::dvec3& size, bool round, const Texts& texts) {
  const auto mm = [&](double metres) { return texts.number(1000 * metres, 4); };
  return round && size.x == size.y ? "Ø " + mm(size.x) + " × " + mm(size.z) + " mm"
                                   : mm(size.x) + " × " + mm(size.y) + " × " + mm(size.z) + " mm";
}

}  // namespace

std::string polar_svg(const SheetRecord& sheet, const Texts& texts) {
  if (sheet.c0_c180.empty()) return "";
  const PolarFrame frame = frame_of(sheet);
  const bool whole = frame.centre.y > 5;
  const std::array curves{curve_points(frame, sheet, sheet.c0_c180),
                          curve_points(frame, sheet, sheet.c90_c270)};
  return drawing(polar_width_mm, polar_height_mm,
                 polar_grid(frame, whole) + polar_curve(curves[0], curve_styles[0]) +
                     polar_curve(curves[1], curve_styles[1]) + "<g fill=\"#5c6670\">\n" +
                     ring_numbers(frame, whole, curves, texts) + "</g>\n" + polar_key(texts));
}

std::string body_svg(const LuminaireRecord& luminaire, const SheetRecord& sheet,
                     const Texts& texts) {
  if (!sheet.body_m) return "";
  glm::dvec3 size = *sheet.body_m;
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0)) return "";
  const glm::dvec3 drawn = glm::max(size, glm::dvec3(0.01 * longest));  // flat ones have an edge
  const auto faces = faces_of(drawn, sheet.body_round, luminaire.opening_m);
  glm::dvec2 low(1e300), high(-1e300);
  for (const Face& face : faces)
    for (const glm::dvec3& p : face.outline) {
      low = glm::min(low, seen(p));
      high = glm::max(high, seen(p));
    }
  const double scale =
      std::min((body_width_mm - 4) / (high.x - low.x), (body_height_mm - 9) / (high.y - low.y));
  const glm::dvec2 middle = (low + high) / 2.0;
  const glm::dvec2 centre(body_width_mm / 2, (body_height_mm - 5) / 2);
  std::string out = "<g stroke=\"#333\" stroke-width=\"0.25\" stroke-linejoin=\"round\">\n";
  for (const Face& face : faces) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& p : face.outline) points.push_back(centre + (seen(p) - middle) * scale);
    out += "<path d=\"" + path_of(points, true) + "\" fill=\"" + face.fill + "\"/>\n";
  }
  return drawing(
      body_width_mm, body_height_mm,
      out + "</g>\n" +
          text_at(body_width_mm / 2, body_height_mm - 1.2,
                  extents_text(size, sheet.body_round, texts), "text-anchor=\"middle\"", 2.6));
}

}  // namespace luxodus

#include "scenes/formats/dxf/dxf_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus {
namespace {

/// A quarter of a circle becomes this many chords: they deviate by 0.5 % of the radius.
constexpr int chords_of_quarter = 8;
/// Chords of a span of a spline between two knots.
constexpr int chords_of_span = 8;
/// Highest degree of a spline; drawing programs make 3, at most 11.
constexpr int max_degree = 25;

int chords_of(double angle) {
  return std::max(
      1, static_cast<int>(std::ceil(std::abs(angle) / (std::numbers::pi / 2) * chords_of_quarter)));
}

/// De Boor's algorithm in homogeneous coordinates (x w, y w, w), for t between knots span and
/// span + 1.
glm::dvec2 spline_point(int degree, std::span<const double> knots,
                        std::span<const glm::dvec3> points, size_t span, double t) {
  const auto p = static_cast<size_t>(degree);
  std::vector<glm::dvec3> d(points.begin() + static_cast<std::ptrdiff_t>(span - p),
                            points.begin() + static_cast<std::ptrdiff_t>(span + 1));
  for (size_t r = 1; r <= p; ++r) {
    for (size_t j = p; j >= r; --j) {
      const double low = knots[j + span - p], high = knots[j + 1 + span - r];
      const double share = high > low ? (t - low) / (high - low) : 0;
      d[j] = (1 - share) * d[j - 1] + share * d[j];
    }
  }
  return glm::dvec2(d[p]) / d[p].z;
}

}  // namespace

DxfAxes::DxfAxes(const glm::dvec3& extrusion) {
  const double length = glm::length(extrusion);
  z = length > 0 && std::isfinite(length) ? extrusion / length : glm::dvec3(0, 0, 1);
  constexpr double near_z = 1.0 / 64;  // Autodesk's limit
  const bool steep = std::abs(z.x) < near_z && std::abs(z.y) < near_z;
  x = glm::normalize(glm::cross(steep ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
  y = glm::cross(z, x);
}

std::vector<glm::dvec2> elliptic_arc(const glm::dvec2& centre, const glm::dvec2& u,
                                     const glm::dvec2& v, double from, double to) {
  constexpr double turn = 2 * std::numbers::pi;
  double sweep = std::fmod(to - from, turn);
  if (!std::isfinite(sweep)) return {};
  if (sweep <= 0) sweep += turn;
  // Programs write a whole turn as 6.2831853071795871, too.
  constexpr double rounding = 1e-9;
  if (sweep < rounding || sweep > turn - rounding) sweep = turn;
  const int chords = chords_of(sweep);
  std::vector<glm::dvec2> out;
  for (int i = 0; i <= chords; ++i) {
    const double t = from + sweep * i / chords;
    out.push_back(centre + std::cos(t) * u + std::sin(t) * v);
  }
  if (sweep == turn) out.back() = out.front();
  return out;
}

std::vector<glm::dvec2> bulged_side(const glm::dvec2& from, const glm::dvec2& to, double bulge) {
  const double angle = 4 * std::atan(bulge);
  if (!std::isfinite(angle) || std::abs(angle) < 1e-6) return {to};
  const glm::dvec2 chord = to - from;
  const glm::dvec2 centre =
      (from + to) / 2.0 + glm::dvec2(-chord.y, chord.x) * ((1 - bulge * bulge) / (4 * bulge));
  const int chords = chords_of(angle);
  const glm::dvec2 r = from - centre;
  std::vector<glm::dvec2> out;
  for (int i = 1; i < chords; ++i) {
    const double a = angle * i / chords;
    out.push_back(centre + glm::dvec2(r.x * std::cos(a) - r.y * std::sin(a),
                                      r.x * std::sin(a) + r.y * std::cos(a)));
  }
  out.push_back(to);
  return out;
}

std::vector<glm::dvec2> b_spline(int degree, std::span<const double> knots,
                                 std::span<const glm::dvec2> points,
                                 std::span<const double> weights) {
  const size_t count = points.size();
  if (degree < 1 || degree > max_degree || count < static_cast<size_t>(degree) + 1 ||
      knots.size() != count + static_cast<size_t>(degree) + 1 ||
      !std::is_sorted(knots.begin(), knots.end()) || (!weights.empty() && weights.size() != count))
    return {};
  std::vector<glm::dvec3> weighted;
  for (size_t i = 0; i < count; ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    if (!(w > 0)) return {};
    weighted.emplace_back(points[i] * w, w);
  }
  std::vector<glm::dvec2> out;
  for (size_t span = static_cast<size_t>(degree); span < count; ++span) {
    const double low = knots[span], high = knots[span + 1];
    if (!(high > low)) continue;
    const int chords = degree == 1 ? 1 : chords_of_span;
    for (int i = out.empty() ? 0 : 1; i <= chords; ++i)
      out.push_back(spline_point(degree, knots, weighted, span, low + (high - low) * i / chords));
  }
  return out;
}

}  // namespace luxodus

// A Gaussian field rises through the flame. On a line, its value at the middle of the chord is
// turned into a factor of mean 1 by the distribution that is wanted there: a share `covered` of the
// time there is flame, brighter by as much.
//
// The field is lattice noise: independent standard normal values at the points of a lattice,
// interpolated with weights whose squares add up to 1. So it is standard normal everywhere, not
// only on average. Places are shifted by a second, independent field, which keeps that law.
#include "scenes/light/optics/flame_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace luxodus {

namespace {

/// Speed of the gas on the axis of a flame: this times the root of the height [m/s], height in m.
/// B. J. McCaffrey, "Purely buoyant diffusion flames", NBSIR 79-1910, 1979 (continuous flame).
constexpr double rise = 6.8;
/// Flames puff at 1.5 Hz over the root of their width in m: P. J. Pagni, Applied Mechanics Reviews
/// 43, 153, 1990.
constexpr double puffs = 1.5;

/// A part of the field: size across, relative to the flame's width; points of the lattice in the
/// time of a puff; share of the variance. Puffs, tongues and wisps.
struct Octave {
  double size, per_puff, variance;
};
constexpr std::array<Octave, 4> octaves{
    {{0.8, 2, 0.2}, {0.4, 3.2, 0.34}, {0.19, 5.5, 0.27}, {0.09, 10, 0.19}}};
/// The field that shifts places sideways, by at most about three times `shift` widths.
constexpr Octave shifting{0.5, 3, 1};
constexpr double shift = 0.11;
/// It rises more slowly, so that shapes change on their way.
constexpr double shifting_pace = 0.6;

/// Share of the time in which there is flame: on the axis of the base, what is lost up to the top,
/// and the share of it that is lost out to the rim.
constexpr double covered_at_base = 0.985, lost_at_top = 0.8, lost_at_rim = 0.97;
/// How steeply a flame brightens behind its edge: as this power of the field's rank.
constexpr double edge_power = 0.6;

constexpr size_t normal_values = 1024;

/// The inverse of the standard normal distribution, by halving.
double normal_quantile(double u) {
  double low = -8, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < u ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Values of equal probability, of mean 0 and variance 1.
std::array<double, normal_values> make_normals() {
  std::array<double, normal_values> out{};
  double squares = 0;
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(out.size()));
    squares += out[i] * out[i];
  }
  for (double& v : out) v /= std::sqrt(squares / static_cast<double>(out.size()));
  return out;
}

/// A well mixed number of a lattice point.
uint32_t mixed(const glm::ivec3& at, uint32_t seed) {
  uint32_t h = seed;
  for (int k = 0; k < 3; ++k) {
    h ^= static_cast<uint32_t>(at[k]) * 0x9e3779b1U;
    h = (h ^ (h >> 16)) * 0x7feb352dU;
    h = (h ^ (h >> 15)) * 0x846ca68bU;
    h ^= h >> 16;
  }
  return h;
}

/// Standard normal at every place.
double lattice_noise(const glm::dvec3& place, uint32_t seed) {
  static const std::array<double, normal_values> normals = make_normals();
  const glm::dvec3 floor = glm::floor(place), part = place - floor;
  glm::dvec3 weight[2];
  for (int k = 0; k < 3; ++k) {
    const double smooth = part[k] * part[k] * (3 - 2 * part[k]);
    weight[0][k] = std::cos(smooth * std::numbers::pi / 2);
    weight[1][k] = std::sin(smooth * std::numbers::pi / 2);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const uint32_t number = mixed(glm::ivec3(floor) + step, seed);
    sum += weight[step.x].x * weight[step.y].y * weight[step.z].z * normals[number % normal_values];
  }
  return sum;
}

}  // namespace

FlameShape::FlameShape(const QuadricBody& body, uint32_t seed) : body_(body), seed_(seed) {
  const Bounds box = body.bounds();
  const glm::dvec3 size = box.high - box.low;
  base_ = {(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2, box.low.z};
  height_m_ = size.z;
  width_m_ = std::max(size.x, size.y);
}

double FlameShape::field(const glm::dvec3& place, double time_s) const {
  const glm::dvec3 above = place - base_;
  const double height = std::max(0.0, above.z);
  const double on_the_way_s = 2 * std::sqrt(height) / rise;
  const double puffs_per_s = puffs / std::sqrt(width_m_);
  const auto at = [&](const Octave& octave, double x, double y, double pace) {
    return glm::dvec3(x / (octave.size * width_m_), y / (octave.size * width_m_),
                      octave.per_puff * puffs_per_s * (on_the_way_s - pace * time_s));
  };
  const double reach = shift * width_m_ * (0.4 + height / height_m_);
  const double x =
      above.x + reach * lattice_noise(at(shifting, above.x, above.y, shifting_pace), seed_);
  const double y =
      above.y + reach * lattice_noise(at(shifting, above.x, above.y, shifting_pace), seed_ + 1);
  double sum = 0;
  for (size_t k = 0; k < octaves.size(); ++k)
    sum += std::sqrt(octaves[k].variance) *
           lattice_noise(at(octaves[k], x, y, 1), seed_ + 2 + static_cast<uint32_t>(k));
  return sum;
}

/// How far a place is from the middle of the body to its rim, across the line: 0 to 1.
double FlameShape::off_axis(const glm::dvec3& place, const glm::dvec3& d) const {
  const glm::dvec3 across(-d.y, d.x, 0);
  const double length = glm::length(across);
  if (length < 1e-6) return 0;
  RayInterval parts[2];
  const int count = body_.intervals(place, across / length, {-2 * width_m_, 2 * width_m_}, parts);
  for (int i = 0; i < count; ++i) {
    if (!(parts[i].t0 <= 0 && parts[i].t1 >= 0)) continue;
    const double half = (parts[i].t1 - parts[i].t0) / 2;
    return half > 0 ? std::min(1.0, std::abs(parts[i].t0 + parts[i].t1) / 2 / half) : 0;
  }
  return 1;
}

double FlameShape::factor(const glm::dvec3& o, const glm::dvec3& d, const RayInterval& chord,
                          double opacity, double time_s) const {
  const glm::dvec3 place = o + d * ((chord.t0 + chord.t1) / 2);
  const double up = std::clamp((place.z - base_.z) / height_m_, 0.0, 1.0);
  const double off = off_axis(place, d);
  const double wanted =
      (covered_at_base - lost_at_top * std::pow(up, 1.4)) * (1 - lost_at_rim * std::pow(off, 3));
  // Where the mean flame is thick, it must be there always, or it would not take enough away. The
  // margin leaves it a soft edge.
  const double covered = std::clamp(std::max(wanted, 1.35 * opacity), opacity, 1.0);
  const double power = opacity > 0 ? std::min(edge_power, covered / opacity - 1) : edge_power;
  const double rank = 0.5 * std::erfc(-field(place, time_s) / std::numbers::sqrt2);
  const double within = (rank - (1 - covered)) / covered;
  if (!(within > 0)) return 0;
  return std::min((power + 1) / covered * std::pow(within, power),
                  opacity > 0 ? 1 / opacity : std::numeric_limits<double>::infinity());
}

}  // namespace luxodus

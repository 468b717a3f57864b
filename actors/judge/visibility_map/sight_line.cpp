// The logarithm of what a line to a point of the face lets pass is taken as a parabola in each
// direction of the face, through five points. The mean over a part follows from the moments of its
// area, to second order.
#include "actors/judge/visibility_map/sight_line.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

namespace {

/// Distance of the outer points from the centre, as a share of the face's edges.
constexpr double off_centre = 0.4;
/// A line that is thinner varies too little over a face to count [optical depth].
constexpr double thin_line = 0.01;
/// Relative error of a share: of what was not computed, and of each unit of its change over the
/// part and of the variance of its logarithm.
constexpr double error_at_least = 0.005, error_by_change = 0.1, error_by_variance = 0.5;

PartOfFace part_of(const CompiledScene& scene, const CompiledSign& compiled, size_t part) {
  const SignFace& face = scene.description->signs[compiled.sign].face;
  const ColourIndex wanted = compiled.parts[part];
  PartOfFace out;
  out.luminance.assign(static_cast<size_t>(scene.bands.count()), 0);
  double texels = 0, relative = 0;
  for (int y = 0; y < face.height; ++y)
    for (int x = 0; x < face.width; ++x) {
      const auto at =
          static_cast<size_t>(y) * static_cast<size_t>(face.width) + static_cast<size_t>(x);
      if (wanted == other_colour || face.colour[at] != wanted) continue;
      const glm::dvec2 place((x + 0.5) / face.width - 0.5, 0.5 - (y + 0.5) / face.height);
      texels += 1;
      relative +=
          face.relative_luminance.empty() ? 1.0 : static_cast<double>(face.relative_luminance[at]);
      out.mean += place;
      out.square += place * place;
      out.product += place.x * place.y;
    }
  if (!(texels > 0)) return out;
  out.mean /= texels;
  out.square /= texels;
  out.product /= texels;
  const CompiledFaceColour& colour = compiled.colours[wanted];
  out.group = static_cast<size_t>(colour.group);
  for (int b = 0; b < scene.bands.count(); ++b) {
    const auto band = static_cast<size_t>(b);
    out.luminance[band] = colour.radiance[band] * scene.bands[b].lm_per_w * relative / texels;
  }
  return out;
}

/// Optical depths in the middle band at five points, relative to that at the centre.
struct DepthOverFace {
  glm::dvec2 slope{0}, bend{0};  // first and second derivative

  /// Mean over a part of exp(-depth) over that at the centre, for a band whose depth is `scale`
  /// times that of the middle band; and the terms that its error depends on.
  struct Mean {
    double factor = 1, change = 0, variance = 0;
  };
  Mean over(const PartOfFace& part, double scale) const {
    const double change = -scale * (glm::dot(slope, part.mean) + 0.5 * glm::dot(bend, part.square));
    const glm::dvec2 spread = part.square - part.mean * part.mean;
    const double variance = scale * scale *
                            (slope.x * slope.x * spread.x + slope.y * slope.y * spread.y +
                             2 * slope.x * slope.y * (part.product - part.mean.x * part.mean.y));
    return {std::exp(change) * (1 + 0.5 * variance), std::abs(change), variance};
  }
};

template <class Resolver>
DepthOverFace depth_over(const CompiledScene& scene, const FaceOfSign& face, const Vec3& eye,
                         double at_centre, Resolver& resolver) {
  const int middle = scene.bands.count() / 2;
  const auto beyond = [&](const Vec3& off) {
    const Vec3 to = face.centre + off - eye;
    const Real length = glm::length(to);
    return optical_depth<MediaNeed::general>(scene.media, middle, eye, to / length, length,
                                             resolver) -
           at_centre;
  };
  DepthOverFace out;
  const auto share = static_cast<Real>(off_centre);
  const Vec3 edges[] = {face.across * share, face.up * share};
  for (int i = 0; i < 2; ++i) {
    const double more = beyond(edges[i]), less = beyond(-edges[i]);
    out.slope[i] = (more - less) / (2 * off_centre);
    out.bend[i] = (more + less) / (off_centre * off_centre);
  }
  return out;
}

}  // namespace

std::vector<FaceOfSign> faces_of(const CompiledScene& scene) {
  std::vector<FaceOfSign> out;
  for (const CompiledSign& compiled : scene.signs) {
    const Sign& sign = scene.description->signs[compiled.sign];
    FaceOfSign& face = out.emplace_back();
    face.sign = compiled.sign;
    face.back = compiled.back;
    face.centre = compiled.origin;
    face.across = compiled.axes[0] * static_cast<Real>(sign.width_m);
    face.up = compiled.axes[1] * static_cast<Real>(sign.height_m);
    face.normal = compiled.axes[2];
    face.exponent = sign.angular_exponent;
    for (size_t part = 0; part < face.parts.size(); ++part)
      face.parts[part] = part_of(scene, compiled, part);
  }
  return out;
}

std::vector<double> luminous_shares(const CompiledScene& scene) {
  std::vector<double> out;
  double total = 0;
  for (int b = 0; b < scene.bands.count(); ++b) {
    double power = 0;
    for (const Group& group : scene.groups) power += group.power_w[static_cast<size_t>(b)];
    out.push_back(power * scene.bands[b].lm_per_w);
    total += out.back();
  }
  for (double& share : out) share = total > 0 ? share / total : 1.0 / scene.bands.count();
  return out;
}

SightLine sight_line(const CompiledScene& scene, const GeometryAccess& access,
                     const FaceOfSign& face, const std::vector<double>& shares, const Vec3& eye) {
  const size_t bands = shares.size();
  std::vector<double> depths(bands, 0.0);
  DepthOverFace over;
  const Vec3 to = face.centre - eye;
  const Real length = glm::length(to);
  const double middle =
      scene.features.media == MediaNeed::none
          ? 0
          : with_resolver(scene, access, [&](auto resolver) {
              optical_depths(
                  scene.media, bands, [](size_t i) { return static_cast<int>(i); }, eye,
                  to / length, length, resolver, depths.data());
              const double centre = depths[bands / 2];
              if (centre > thin_line) over = depth_over(scene, face, eye, centre, resolver);
              return centre;
            });
  SightLine out;
  out.passed_scene = 0;
  for (size_t b = 0; b < bands; ++b) out.passed_scene += shares[b] * std::exp(-depths[b]);
  const double cosine = std::max(0.0, static_cast<double>(-glm::dot(face.normal, to) / length));
  const double angular = face.exponent == 0 ? 1 : std::pow(cosine, face.exponent);
  double change = 0, variance = 0;
  for (size_t p = 0; p < out.own.size(); ++p) {
    const PartOfFace& part = face.parts[p];
    double own = 0, own_passed = 0, scene_passed = 0;
    for (size_t b = 0; b < bands; ++b) {
      const DepthOverFace::Mean mean = over.over(part, middle > 0 ? depths[b] / middle : 1);
      const double passed = std::exp(-depths[b]) * mean.factor;
      own += part.luminance[b];
      own_passed += part.luminance[b] * passed;
      scene_passed += shares[b] * passed;
      change = std::max(change, mean.change);
      variance = std::max(variance, mean.variance);
    }
    out.own[p] = own * angular;
    out.passed[p] = std::min(1.0, own > 0 ? own_passed / own : scene_passed);
  }
  out.passed_error = middle > thin_line
                         ? error_at_least + error_by_change * change + error_by_variance * variance
                         : error_at_least;
  return out;
}

}  // namespace luxodus

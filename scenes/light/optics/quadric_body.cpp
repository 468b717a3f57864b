// Intervals of a ray in a quadric body. The ray is first clipped by box and clip planes, and its
// parameter moved to the middle of the rest, close to the body. Coefficients then have the body's
// own scale however far away the ray began, and the roots lose nothing to cancellation.
#include "scenes/light/optics/quadric_body.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace luxodus {

namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
/// Accepts axes read from a file with 7 digits, but not a scaled or skewed frame.
constexpr double orthonormal_tolerance = 1e-6;
/// Rays per side of the coarse volume quadrature; the fine one has twice as many: 512^2 rays take
/// some 30 ms.
constexpr int quadrature_rays = 256;

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// b^2 - 4 a c with the rounding errors of both products compensated (Kahan, 2004).
double discriminant(double a, double b, double c) {
  const double ac4 = 4 * a * c;
  const double bb = b * b;
  return (bb - ac4) + (std::fma(b, b, -bb) - std::fma(4 * a, c, -ac4));
}

}  // namespace

int below_zero(double a, double b, double c, RayInterval out[2]) {
  if (a == 0) {
    if (b == 0) {
      out[0] = {-no_end, no_end};
      return c <= 0 ? 1 : 0;
    }
    const double root = -c / b;
    out[0] = b > 0 ? RayInterval{-no_end, root} : RayInterval{root, no_end};
    return 1;
  }
  const double disc = discriminant(a, b, c);
  if (disc <= 0) {  // touching counts as a miss
    out[0] = {-no_end, no_end};
    return a < 0 ? 1 : 0;
  }
  // A sum of two numbers of equal sign; the other root follows from the product of the roots.
  const double q = -0.5 * (b + std::copysign(std::sqrt(disc), b));
  const double r = q / a;
  const double s = c / q;
  const double low = std::min(r, s);
  const double high = std::max(r, s);
  if (a > 0) {
    out[0] = {low, high};
    return 1;
  }
  out[0] = {-no_end, low};
  out[1] = {high, no_end};
  return 2;
}

Result<void> check_frame(const Frame& frame) {
  for (int k = 0; k < 3; ++k) {
    if (!finite(frame.axes[k])) return problem("has axes that are not finite");
    for (int l = 0; l <= k; ++l) {
      const double expected = k == l ? 1 : 0;
      if (std::abs(glm::dot(frame.axes[k], frame.axes[l]) - expected) > orthonormal_tolerance) {
        return problem("has axes that are not of unit length and perpendicular");
      }
    }
  }
  if (!finite(frame.origin)) return problem("has a place that is not finite");
  return {};
}

Result<QuadricBody> QuadricBody::make(const Medium& medium, const glm::dvec3& local_origin) {
  const auto fault = [&](const std::string& what) {
    return problem_in(medium.place, "medium \"" + medium.name + "\" " + what);
  };
  if (auto ok = check_frame(medium.frame); !ok) return fault(ok.problem().what);
  const Quadric& q = medium.quadric;
  bool good = finite(q.b) && std::isfinite(q.c);
  for (int k = 0; k < 3; ++k) good = good && finite(q.a[k]);
  for (const Quadric::Clip& clip : q.clips) {
    good = good && finite(clip.normal) && std::isfinite(clip.offset);
  }
  if (!good) return fault("has a quadric with numbers that are not finite");
  if (q.clips.size() > static_cast<size_t>(limits::max_clip_planes)) {
    return fault("has more than " + std::to_string(limits::max_clip_planes) + " clip planes");
  }
  const Bounds& box = medium.local_bounds;
  if (!finite(box.low) || !finite(box.high) || !(box.low.x < box.high.x) ||
      !(box.low.y < box.high.y) || !(box.low.z < box.high.z)) {
    return fault("has no bounds; give a box that holds the body");
  }
  QuadricBody out;
  out.origin_ = medium.frame.origin - local_origin;
  out.axes_ = medium.frame.axes;
  out.low_ = box.low;
  out.high_ = box.high;
  out.clips_ = q.clips;
  // Scaled so that values in the box are of order one: no square overflows or underflows.
  const double length = std::max(glm::length(box.low), glm::length(box.high));
  double size = std::abs(q.c);
  for (int k = 0; k < 3; ++k) {
    size = std::max(size, std::abs(q.b[k]) * length);
    for (int l = 0; l < 3; ++l) size = std::max(size, std::abs(q.a[k][l]) * length * length);
  }
  if (!std::isfinite(size)) return fault("has a quadric whose numbers are too large");
  const double scale = size > 0 ? 1 / size : 0;
  out.a_ = (q.a + glm::transpose(q.a)) * (0.5 * scale);
  out.b_ = q.b * scale;
  out.c_ = q.c * scale;
  out.measure_volume();
  const glm::dvec3 e = box.high - box.low;
  const double fill = out.volume_.m3 / (e.x * e.y * e.z);
  if (!(fill >= limits::min_body_fill)) {
    return fault(
        "fills less than 1/10000 of its bounds; give a box that fits, and check the quadric");
  }
  return out;
}

int QuadricBody::local_intervals(const glm::dvec3& o, const glm::dvec3& d, RayInterval within,
                                 RayInterval out[2]) const {
  within = inside_box(low_, high_, o, d, within);
  for (const Quadric::Clip& clip : clips_) {
    const double rise = glm::dot(clip.normal, d);
    const double room = clip.offset - glm::dot(clip.normal, o);
    if (rise > 0) {
      within.t1 = std::min(within.t1, room / rise);
    } else if (rise < 0) {
      within.t0 = std::max(within.t0, room / rise);
    } else if (room < 0) {
      return 0;
    }
  }
  if (within.empty()) return 0;
  const double middle = 0.5 * (within.t0 + within.t1);
  const glm::dvec3 p = o + d * middle;
  const glm::dvec3 ad = a_ * d;
  RayInterval roots[2];
  const int n = below_zero(glm::dot(d, ad), 2 * glm::dot(p, ad) + glm::dot(b_, d),
                           glm::dot(p, a_ * p) + glm::dot(b_, p) + c_, roots);
  int kept = 0;
  for (int i = 0; i < n; ++i) {
    const RayInterval piece = common(within, {middle + roots[i].t0, middle + roots[i].t1});
    if (!piece.empty()) out[kept++] = piece;
  }
  return kept;
}

bool QuadricBody::contains_local(const glm::dvec3& p) const {
  for (int k = 0; k < 3; ++k) {
    if (p[k] < low_[k] || p[k] >= high_[k]) return false;
  }
  for (const Quadric::Clip& clip : clips_) {
    if (glm::dot(clip.normal, p) > clip.offset) return false;
  }
  return glm::dot(p, a_ * p) + glm::dot(b_, p) + c_ <= 0;
}

Bounds QuadricBody::bounds() const {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? high_.x : low_.x, (corner & 2) != 0 ? high_.y : low_.y,
                       (corner & 4) != 0 ? high_.z : low_.z);
    out.extend(origin_ + axes_ * p);
  }
  return out;
}

// Cross-section at height z along `axis`: u^T A2 u + g(z).u + h(z) <= 0 in the other two
// coordinates. With A2 positive definite it is an ellipse about -A2^-1 g / 2 of area pi s(z) /
// sqrt(det A2), where s(z) = g^T A2^-1 g / 4 - h(z) is a parabola in z: its integral over the
// heights with s > 0 is the volume.
bool QuadricBody::closed_form_volume(int axis) {
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  double z0 = low_[axis];
  double z1 = high_[axis];
  for (const Quadric::Clip& clip : clips_) {
    if (clip.normal[x] != 0 || clip.normal[y] != 0) return false;
    const double n = clip.normal[axis];
    if (n > 0) z1 = std::min(z1, clip.offset / n);
    if (n < 0) z0 = std::max(z0, clip.offset / n);
    if (n == 0 && clip.offset < 0) return true;  // the body is empty
  }
  const double det = a_[x][x] * a_[y][y] - a_[x][y] * a_[x][y];
  if (!(a_[x][x] > 0) || !(det > 0)) return false;
  const double ixx = a_[y][y] / det;
  const double iyy = a_[x][x] / det;
  const double ixy = -a_[x][y] / det;
  const auto form = [&](glm::dvec2 u, glm::dvec2 v) {
    return u.x * v.x * ixx + u.y * v.y * iyy + (u.x * v.y + u.y * v.x) * ixy;
  };
  const glm::dvec2 slope(2 * a_[axis][x], 2 * a_[axis][y]);
  const glm::dvec2 fixed(b_[x], b_[y]);
  const double s2 = form(slope, slope) / 4 - a_[axis][axis];
  const double s1 = form(slope, fixed) / 2 - b_[axis];
  const double s0 = form(fixed, fixed) / 4 - c_;
  const auto s = [&](double z) { return (s2 * z + s1) * z + s0; };

  RayInterval body[2];
  const int n = below_zero(-s2, -s1, -s0, body);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const RayInterval z = common({z0, z1}, body[i]);
    if (z.empty()) continue;
    // Simpson's rule is exact for a parabola.
    sum += (z.t1 - z.t0) / 6 * (s(z.t0) + 4 * s(0.5 * (z.t0 + z.t1)) + s(z.t1));
    // Checks at many heights that the box does not cut the ellipses, with a margin for rounding.
    for (int k = 0; k <= 64; ++k) {
      const double height = z.t0 + (z.t1 - z.t0) * k / 64.0;
      const double radius = std::max(0.0, s(height));
      const glm::dvec2 g = slope * height + fixed;
      const glm::dvec2 centre(-0.5 * (ixx * g.x + ixy * g.y), -0.5 * (ixy * g.x + iyy * g.y));
      const glm::dvec2 reach(std::sqrt(radius * ixx), std::sqrt(radius * iyy));
      for (int m = 0; m < 2; ++m) {
        const int side = m == 0 ? x : y;
        const double room = 1e-9 * (high_[side] - low_[side]);
        if (centre[m] - reach[m] < low_[side] - room) return false;
        if (centre[m] + reach[m] > high_[side] + room) return false;
      }
    }
  }
  volume_ = {pi * sum / std::sqrt(det), 0};
  return true;
}

double QuadricBody::volume_by_rays(int n) {
  const glm::dvec3 size = high_ - low_;
  double sum = 0;
  double longest = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 o(low_.x + size.x * (i + 0.5) / n, low_.y + size.y * (j + 0.5) / n, low_.z);
      RayInterval piece[2];
      const int pieces = local_intervals(o, glm::dvec3(0, 0, 1), {0, size.z}, piece);
      for (int k = 0; k < pieces; ++k) {
        const double length = piece[k].t1 - piece[k].t0;
        sum += length;
        if (length > longest) {
          longest = length;
          inner_point_ = o + glm::dvec3(0, 0, 0.5 * (piece[k].t0 + piece[k].t1));
        }
      }
    }
  }
  return sum * size.x * size.y / (static_cast<double>(n) * n);
}

void QuadricBody::measure_volume() {
  const double coarse = volume_by_rays(quadrature_rays);
  for (const int axis : {2, 0, 1}) {
    if (closed_form_volume(axis)) return;
  }
  const double fine = volume_by_rays(2 * quadrature_rays);
  volume_ = {fine, std::abs(fine - coarse)};
}

}  // namespace luxodus

// The web is a chart of cells between neighbouring angles. In a cell the intensity is bilinear in
// azimuth phi and polar angle theta, and the solid angle element is sin(theta) dtheta dphi, so
//   flux of a cell = dphi * integral (m0 + (m1 - m0) t) sin(theta) dtheta,   t = (theta - a) /
//   width,
// with m0, m1 the means of the two corner values at the near and the far polar angle: exact, in
// closed form.
//
// Sampling: column by its share of the flux, row by its share of the column, then inside the cell
// the azimuth from its marginal density, which is linear (a square root), and the polar angle from
// its conditional density (c0 + slope x) sin(a + x), whose cumulative has a closed form but no
// closed inverse: Newton steps kept in a bracket. Nothing is rejected; u serves column and azimuth,
// v row and polar angle.
#include "scenes/light/optics/photometric_web.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace luxodus {
namespace {

namespace web_limits {
// Steps of 0.1 degree around need 3601. Ten times this is beyond measured luminaires: 32 MB of
// table.
constexpr size_t web_angles = 4096;
constexpr size_t web_values = size_t{1} << 22;
}  // namespace web_limits

constexpr double radian = std::numbers::pi / 180;
constexpr double below_one = 1 - 0x1p-53;

/// Integrals of sin(theta) and of (theta - a) sin(theta) over [a, a + x], given sin a and cos a;
/// and sine and cosine of the end.
struct Sweep {
  double even;
  double sloped;
  double end_sine;
  double end_cosine;
};

Sweep sweep(double sin_a, double cos_a, double x) {
  // Half angles keep 1 - cos x exact if x is small. There, as in nearly every cell of a real table,
  // a series is several times faster than the library (truncation below 2e-16 up to h = 0.15).
  const double h = 0.5 * x;
  double s = 0;
  double c = 0;
  if (h < 0.15) {
    const double q = h * h;
    const double qq = q * q;
    s = h * ((1 - q * (1.0 / 6)) + qq * ((1.0 / 120 - q * (1.0 / 5040)) + qq * (1.0 / 362880)));
    c = (1 - q * 0.5) +
        qq * ((1.0 / 24 - q * (1.0 / 720)) + qq * (1.0 / 40320 - q * (1.0 / 3628800)));
  } else {
    s = std::sin(h);
    c = std::cos(h);
  }
  const double sin_x = 2 * s * c;
  const double versine = 2 * s * s;
  const double cos_x = 1 - versine;
  return {sin_a * sin_x + cos_a * versine,
          sin_a * 2 * s * (x * c - s) + cos_a * (sin_x - x * cos_x), sin_a * cos_x + cos_a * sin_x,
          cos_a * cos_x - sin_a * sin_x};
}

/// The point in [0, 1] at which a density that runs linearly from w0 to w1 reaches `share` of its
/// integral.
double linear_inverse(double w0, double w1, double share) {
  const double root = std::sqrt(w0 * w0 + share * (w1 * w1 - w0 * w0));
  return w0 + root > 0 ? std::min(1.0, share * (w0 + w1) / (w0 + root)) : share;
}

/// A polar angle inside a row, as its distance x from the row's start, with its sine and cosine.
struct Inside {
  double x;
  double sine;
  double cosine;
};

/// The point in the row at which the density (c0 + slope x) sin(start + x) reaches `share` of its
/// integral.
template <class Row>
Inside polar_inverse(const Row& row, double c0, double slope, double share) {
  const double width = row.width;
  const double target = share * (c0 * row.even + slope * row.sloped);
  double low = 0;
  double high = width;
  double x = width * linear_inverse(c0 * row.sine, (c0 + slope * width) * row.end_sine, share);
  constexpr int max_steps = 60;  // bisection alone reaches the last bit in 53; Newton needs 2 to 4
  for (int step = 0; step < max_steps; ++step) {
    const Sweep part = sweep(row.sine, row.cosine, x);
    const double excess = c0 * part.even + slope * part.sloped - target;
    low = excess > 0 ? low : x;
    high = excess > 0 ? x : high;
    double next = x - excess / ((c0 + slope * x) * part.end_sine);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = next - x;
    x = next;
    // Newton's method squares the error: a step below 1e-6 of the distance to either end leaves
    // 1e-12, and two terms of the series update sine and cosine to the last bit.
    if (std::abs(moved) <= 1e-6 * std::min(x, width - x)) {
      return {x, part.end_sine + moved * (part.end_cosine - 0.5 * moved * part.end_sine),
              part.end_cosine - moved * (part.end_sine + 0.5 * moved * part.end_cosine)};
    }
  }
  return {x, std::sin(row.start + x), std::cos(row.start + x)};
}

/// Index of the interval of ascending `angles` that holds `angle`. Steps of most tables are equal:
/// then the first guess is right or one off, and no search with its mispredicted branches follows.
size_t interval_of(const std::vector<double>& angles, double angle) {
  const size_t last = angles.size() - 2;
  const double share = angle / angles.back();
  const double guess = share * static_cast<double>(last + 1);
  size_t at = guess > 0 ? std::min(static_cast<size_t>(guess), last) : 0;
  for (int steps = 0; steps < 2; ++steps) {
    if (at > 0 && angle < angles[at])
      --at;
    else if (at < last && angle >= angles[at + 1])
      ++at;
    else
      return at;
  }
  const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  return static_cast<size_t>(after - angles.begin()) - 1;
}

/// Whether all columns of a table are the same: the body is round about its axis.
bool columns_agree(const std::vector<double>& candela, size_t columns, size_t rows) {
  for (size_t a = 1; a < columns; ++a)
    if (!std::equal(candela.begin(), candela.begin() + static_cast<std::ptrdiff_t>(rows),
                    candela.begin() + static_cast<std::ptrdiff_t>(a * rows)))
      return false;
  return true;
}

/// First entry of an ascending run of cumulative shares beyond `u`, and how far into its step `u`
/// lies.
struct Choice {
  size_t index;
  double rest;  // in (0, 1)
};

Choice choose(const double* shares, size_t count, double u) {
  // u is random, so a branch on it would often be mispredicted: bisect without branches.
  const double* at = shares;
  for (size_t left = count; left > 1;) {
    const size_t half = left / 2;
    at += half * static_cast<size_t>(at[half - 1] <= u);
    left -= half;
  }
  const auto index = static_cast<size_t>(at - shares);
  const double low = index == 0 ? 0 : shares[index - 1];
  const double rest = (u - low) / (shares[index] - low);
  // Kept off the cell's edge, which may carry no light: a density of zero is useless.
  return {index, std::clamp(rest, 0x1p-54, below_one)};
}

double bilinear(const double* near_column, const double* far_column, double s, double t) {
  const double near = near_column[0] + t * (near_column[1] - near_column[0]);
  const double far = far_column[0] + t * (far_column[1] - far_column[0]);
  return near + s * (far - near);
}

/// Whether a list of angles runs from 0 to `last`.
Result<void> check_angles(const std::vector<double>& angles, double last, const char* name) {
  if (angles.size() < 2 || angles.size() > web_limits::web_angles) {
    return problem(std::string("a web needs 2 to ") + std::to_string(web_limits::web_angles) + " " +
                   name + " angles, not " + std::to_string(angles.size()));
  }
  if (angles.front() != 0 || angles.back() != last) {
    return problem(std::string(name) + " angles must run from 0 to " + std::to_string(int(last)) +
                   " degrees");
  }
  for (size_t i = 1; i < angles.size(); ++i) {
    if (!(angles[i] > angles[i - 1])) return problem(std::string(name) + " angles must ascend");
  }
  return {};
}

bool orthonormal(const glm::dmat3& axes) {
  const glm::dmat3 gram = glm::transpose(axes) * axes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(gram[i][j] - (i == j ? 1.0 : 0.0)) < 1e-9)) return false;
    }
  }
  return true;
}

}  // namespace

Result<PhotometricWeb> PhotometricWeb::make(std::vector<double> azimuth_deg,
                                            std::vector<double> polar_deg,
                                            std::vector<double> candela,
                                            const glm::dmat3& to_luminaire) {
  if (auto ok = check_angles(azimuth_deg, 360, "azimuth"); !ok) return ok.problem();
  if (auto ok = check_angles(polar_deg, 180, "polar"); !ok) return ok.problem();
  const size_t columns = azimuth_deg.size();
  const size_t rows = polar_deg.size();
  if (columns * rows > web_limits::web_values) return problem("the web holds too many values");
  if (candela.size() != columns * rows) {
    return problem("a web of " + std::to_string(columns) + " x " + std::to_string(rows) +
                   " angles needs as many intensities, not " + std::to_string(candela.size()));
  }
  for (double value : candela) {
    if (!(value >= 0 && std::isfinite(value))) {
      return problem("an intensity is negative or not a number");
    }
  }
  const double peak = *std::max_element(candela.begin(), candela.end());
  for (size_t p = 0; p < rows; ++p) {
    if (std::abs(candela[p] - candela[(columns - 1) * rows + p]) > 1e-9 * peak) {
      return problem("the column at 360 degrees must repeat the one at 0");
    }
  }
  if (!orthonormal(to_luminaire)) return problem("the axes of the web are not orthonormal");

  PhotometricWeb web;
  web.azimuth_deg_ = std::move(azimuth_deg);
  web.polar_deg_ = std::move(polar_deg);
  web.candela_ = std::move(candela);
  web.to_luminaire_ = to_luminaire;
  web.peak_cd_ = peak;
  web.round_ = columns_agree(web.candela_, columns, rows);
  web.column_cdf_.resize(columns - 1);
  web.row_cdf_.resize((columns - 1) * (rows - 1));
  for (size_t p = 0; p + 1 < rows; ++p) {
    const double start = web.polar_deg_[p] * radian;
    const double width = web.polar_deg_[p + 1] * radian - start;
    const double sine = std::sin(start);
    const double cosine = std::cos(start);
    const Sweep cell = sweep(sine, cosine, width);
    web.rows_.push_back(
        {start, sine, cosine, width, cell.even, cell.sloped, std::max(0.0, cell.end_sine)});
  }
  double total = 0;
  for (size_t a = 0; a + 1 < columns; ++a) {
    const double dphi = (web.azimuth_deg_[a + 1] - web.azimuth_deg_[a]) * radian;
    const double* near = &web.candela_[a * rows];
    const double* far = near + rows;
    double* shares = &web.row_cdf_[a * (rows - 1)];
    double column = 0;
    for (size_t p = 0; p + 1 < rows; ++p) {
      const Row& row = web.rows_[p];
      const double m0 = 0.5 * (near[p] + far[p]);
      const double m1 = 0.5 * (near[p + 1] + far[p + 1]);
      // max: rounding must not give a dark cell light.
      column += std::max(0.0, dphi * (m0 * row.even + (m1 - m0) / row.width * row.sloped));
      shares[p] = column;
    }
    if (column > 0) std::for_each(shares, shares + rows - 1, [&](double& s) { s /= column; });
    total += column;
    web.column_cdf_[a] = total;
  }
  if (!(total > 0 && std::isfinite(total))) return problem("the web holds no light");
  for (double& share : web.column_cdf_) share /= total;
  web.flux_lm_ = total;
  return web;
}

double PhotometricWeb::intensity(const glm::dvec3& direction) const {
  const glm::dvec3 d = direction * to_luminaire_;  // the transpose is the inverse
  const double polar = std::atan2(std::sqrt(d.x * d.x + d.y * d.y), d.z) / radian;
  const size_t p = interval_of(polar_deg_, polar);
  const double t = (polar - polar_deg_[p]) / (polar_deg_[p + 1] - polar_deg_[p]);
  const size_t rows = polar_deg_.size();
  if (round_) return bilinear(&candela_[p], &candela_[p], 0, std::min(t, 1.0));
  double azimuth = std::atan2(d.y, d.x) / radian;
  if (azimuth < 0) azimuth += 360;
  const size_t a = interval_of(azimuth_deg_, azimuth);
  const double s = (azimuth - azimuth_deg_[a]) / (azimuth_deg_[a + 1] - azimuth_deg_[a]);
  return bilinear(&candela_[a * rows + p], &candela_[(a + 1) * rows + p], std::min(s, 1.0),
                  std::min(t, 1.0));
}

PhotometricWeb::Sample PhotometricWeb::sample(double u, double v) const {
  const size_t rows = polar_deg_.size();
  const Choice column = choose(column_cdf_.data(), column_cdf_.size(), std::min(u, below_one));
  const Choice row = choose(&row_cdf_[column.index * (rows - 1)], rows - 1, std::min(v, below_one));
  const double* near = &candela_[column.index * rows + row.index];
  const double* far = near + rows;
  const Row& polar = rows_[row.index];

  // Azimuth: its marginal density in the cell weights the two corner values of an edge by solid
  // angle.
  const double far_weight = std::max(0.0, polar.sloped / polar.width);
  const double near_weight = std::max(0.0, polar.even - far_weight);
  const double s = linear_inverse(near[0] * near_weight + near[1] * far_weight,
                                  far[0] * near_weight + far[1] * far_weight, column.rest);

  const double c0 = near[0] + s * (far[0] - near[0]);
  const double c1 = near[1] + s * (far[1] - near[1]);
  const Inside at = polar_inverse(polar, c0, (c1 - c0) / polar.width, row.rest);

  const double azimuth_start = azimuth_deg_[column.index];
  const double azimuth =
      (azimuth_start + s * (azimuth_deg_[column.index + 1] - azimuth_start)) * radian;
  const glm::dvec3 d(at.sine * std::cos(azimuth), at.sine * std::sin(azimuth), at.cosine);
  return {to_luminaire_ * d, bilinear(near, far, s, at.x / polar.width) / flux_lm_};
}

double PhotometricWeb::pdf(const glm::dvec3& direction) const {
  return intensity(direction) / flux_lm_;
}

size_t PhotometricWeb::bytes() const {
  return sizeof(*this) +
         sizeof(double) * (azimuth_deg_.size() + polar_deg_.size() + candela_.size() +
                           column_cdf_.size() + row_cdf_.size()) +
         sizeof(Row) * rows_.size();
}

}  // namespace luxodus

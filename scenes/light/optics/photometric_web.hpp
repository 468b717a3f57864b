// The photometric web of a luminaire: luminous intensity [cd] over all directions, as a table, with
// its exact integral and sampling. Made by the LDT and IES readers. Immutable once made; any
// thread.
//
// Luminaire frame: the luminaire hangs horizontally, -Z points down (gamma 0), C0 lies along +X,
// C90 along +Y. The table lives in a polar frame of its own: for C-type files the pole is -Z (polar
// angle gamma, azimuth C), for B-type files the pole is horizontal. Intensity is bilinear in the
// two angles [deg].
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class PhotometricWeb {
 public:
  /// `azimuth_deg`: ascending, first 0, last 360 (the last column repeats the first);
  /// `polar_deg`: ascending, first 0, last 180; `candela[a * polar_deg.size() + p]`, >= 0, finite.
  /// `to_luminaire`: orthonormal map from the table's frame (pole +Z, azimuth 0 along +X) to the
  /// luminaire's; it may mirror: C angles turn about +Z of the luminaire, while their pole is -Z.
  /// Errors: a table that breaks these rules or has no light at all.
  static Result<PhotometricWeb> make(std::vector<double> azimuth_deg, std::vector<double> polar_deg,
                                     std::vector<double> candela, const glm::dmat3& to_luminaire);

  /// Intensity [cd] in a unit direction of the luminaire frame.
  double intensity(const glm::dvec3& direction) const;
  /// Integral over the sphere [lm] of exactly the function that `intensity` evaluates.
  double flux_lm() const { return flux_lm_; }
  /// Largest table value [cd].
  double peak_cd() const { return peak_cd_; }

  struct Sample {
    glm::dvec3 direction;  // unit, luminaire frame
    double pdf;            // [1/sr]; equals intensity / flux_lm up to rounding of the inversion
  };
  /// Direction distributed as intensity / flux. u, v in [0, 1).
  Sample sample(double u, double v) const;
  /// Density [1/sr] with which `sample` returns this direction.
  double pdf(const glm::dvec3& direction) const;

  const std::vector<double>& azimuth_deg() const { return azimuth_deg_; }
  const std::vector<double>& polar_deg() const { return polar_deg_; }
  const std::vector<double>& candela() const { return candela_; }
  const glm::dmat3& to_luminaire() const { return to_luminaire_; }
  size_t bytes() const;

 private:
  PhotometricWeb() = default;

  std::vector<double> azimuth_deg_;
  std::vector<double> polar_deg_;
  std::vector<double> candela_;
  glm::dmat3 to_luminaire_{1.0};
  double flux_lm_ = 0;
  double peak_cd_ = 0;
  bool round_ = false;  // all columns are the same
  // One row between neighbouring polar angles [rad]: its start with sine and cosine, its width w,
  // the integrals of sin(start + x) and of x sin(start + x) over x in [0, w], and the sine of its
  // end. Stored, because sampling needs them for every particle.
  struct Row {
    double start, sine, cosine, width, even, sloped, end_sine;
  };
  std::vector<Row> rows_;
  // Cumulative flux by cell, for sampling: columns, then rows within a column.
  std::vector<double> column_cdf_;
  std::vector<double> row_cdf_;
};

}  // namespace luxodus

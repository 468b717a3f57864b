// Wavelength bands: the few wavelength bins that are needed to distinguish a scene's spectra. A
// band holds radiant watts; its coefficients convert watts to photopic, scotopic and XYZ
// quantities, weighted within the band by the light that the scene emits. Immutable once made; any
// thread.
#pragma once

#include <vector>

#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

struct Band {
  double low_nm = spectrum_first_nm;
  double high_nm = spectrum_last_nm;
  double lm_per_w = 0;           // 683 * <V>
  double scotopic_lm_per_w = 0;  // 1700.05 * <V'>
  double x_per_w = 0;            // XYZ scaled so that y_per_w == lm_per_w
  double z_per_w = 0;
};

class Bands {
 public:
  /// Bands with the given edges [nm], ascending, first 380 and last 780, for light of this total
  /// emission shape (W/nm, any scale). A band where the scene emits nothing is weighted by equal
  /// energy.
  Bands(const std::vector<double>& edges_nm, const Spectrum& total_emission);

  int count() const { return static_cast<int>(bands_.size()); }
  const Band& operator[](int b) const { return bands_[static_cast<size_t>(b)]; }

  /// Integral of an emission spectrum (W/nm) over band b [W].
  double power(const Spectrum& emission_w_per_nm, int b) const;
  /// Watts in each band of light of this shape and luminous flux, adjusted so that their flux and
  /// chromaticity are those of the spectrum. The band coefficients, which are averages over all the
  /// scene's light, would miss them otherwise. No band loses more than four fifths of its watts; if
  /// fewer than three bands of independent colours are lit, only the flux is exact. Requires: shape
  /// has luminous flux.
  std::vector<double> powers(const Spectrum& shape, double lumens) const;
  /// Average of a property (reflectance, extinction) over band b, weighted by emission times (V +
  /// 0.01): accurate for luminance, and defined where V vanishes.
  double average(const Spectrum& property, int b) const;

 private:
  std::vector<Band> bands_;
  Spectrum weight_;
};

/// Edges [nm] of the bands that distinguish these spectra: `properties` are reflectances,
/// extinctions, albedos; `emissions` the emission shapes in use. Grey properties and one emission
/// shape give one band. Adjacent 20 nm bins are merged, most similar first, until all differ by
/// more than `tolerance` (relative to the largest value of each spectrum) and at most `most` are
/// left.
std::vector<double> told_apart(const std::vector<Spectrum>& properties,
                               const std::vector<Spectrum>& emissions, double tolerance, int most);

}  // namespace luxodus

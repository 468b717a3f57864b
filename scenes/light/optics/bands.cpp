// Bands. A spectrum is read as the polyline through its nodes, and a product of spectra as the
// polyline through the products at the nodes, so that the integrals over the bands add up to the
// trapezoidal sums of spectrum.cpp, wherever the edges lie.
#include "scenes/light/optics/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <stdexcept>

namespace luxodus {
namespace {

// Added to V in the weight of an average, so that a reflectance is defined at the invisible ends of
// the spectrum, too. 1 % of the peak of V is too little to change luminance.
constexpr double unseen_weight = 0.01;
// A band with less than this share of the emission counts as dark: its average would be a ratio of
// rounding errors.
constexpr double dark_share = 1e-12;
// Smallest error of a tristimulus value that is corrected, as a share of the luminous flux.
constexpr double told_colour = 1e-6;
// Largest share of its watts that a band may lose to correct the chromaticity.
constexpr double max_colour_loss = 0.8;
// Least determinant of the bands' colours relative to the product of its diagonal; less is
// rounding.
constexpr double min_independence = 1e-9;
constexpr double bin_nm = 20.0;
constexpr int bins = 20;

/// Integral of the polyline through the nodes over [low, high], both within [380, 780] nm.
double integral_over(const Spectrum& s, double low_nm, double high_nm) {
  double sum = 0;
  for (int i = 0; i + 1 < spectrum_samples; ++i) {
    const double a = std::max(low_nm, Spectrum::wavelength_nm(i));
    const double b = std::min(high_nm, Spectrum::wavelength_nm(i + 1));
    if (b > a) sum += 0.5 * (b - a) * (s.at(a) + s.at(b));
  }
  return sum;
}

Spectrum sight_weight() {
  return cie_y() + Spectrum::constant(unseen_weight);
}

/// The emission that weights [low, high]: the scene's, or equal energy where the scene is dark.
Spectrum emission_within(const Spectrum& emission, double low_nm, double high_nm) {
  const bool dark = integral_over(emission, low_nm, high_nm) <= dark_share * emission.integral();
  return dark ? Spectrum::constant(1) : emission;
}

double average_over(const Spectrum& property, const Spectrum& emission, double low_nm,
                    double high_nm) {
  const Spectrum w = emission_within(emission, low_nm, high_nm) * sight_weight();
  return integral_over(property * w, low_nm, high_nm) / integral_over(w, low_nm, high_nm);
}

/// A spectrum as told_apart compares it: over the 20 nm bins, relative to its largest value.
using BinValues = std::array<double, bins>;

/// A run of adjacent bins that may become a band.
struct Run {
  double low_nm;
  double high_nm;
  double weight;  // weight of its bins in the mean; 0 if dark, where nothing is distinguished
  std::vector<double> mean;
};

double difference(const Run& a, const Run& b) {
  if (a.weight <= 0 || b.weight <= 0) return 0;
  double most = 0;
  for (size_t k = 0; k < a.mean.size(); ++k) most = std::max(most, std::abs(a.mean[k] - b.mean[k]));
  return most;
}

Run merged(const Run& a, const Run& b) {
  Run out{a.low_nm, b.high_nm, a.weight + b.weight, a.mean};
  if (out.weight <= 0) return out;
  for (size_t k = 0; k < out.mean.size(); ++k)
    out.mean[k] = (a.weight * a.mean[k] + b.weight * b.mean[k]) / out.weight;
  return out;
}

double bin_low_nm(int bin) {
  return spectrum_first_nm + bin_nm * bin;
}

void make_relative(BinValues& v, double largest) {
  if (largest > 0)
    for (double& x : v) x /= largest;
}

Spectrum total_of(const std::vector<Spectrum>& emissions) {
  Spectrum total;
  for (const Spectrum& e : emissions)
    if (const double power = e.integral(); power > 0) total = total + e * (1 / power);
  return total.integral() > 0 ? total : equal_energy_shape();
}

std::vector<BinValues> property_values(const std::vector<Spectrum>& properties,
                                       const Spectrum& total) {
  std::vector<BinValues> out;
  for (const Spectrum& p : properties) {
    if (p.is_constant()) continue;
    BinValues v{};
    for (int b = 0; b < bins; ++b)
      v[static_cast<size_t>(b)] = average_over(p, total, bin_low_nm(b), bin_low_nm(b + 1));
    make_relative(v, *std::max_element(p.value.begin(), p.value.end()));
    out.push_back(v);
  }
  return out;
}

/// Each emission's share of all light, by bin: constant if there is only one shape.
std::vector<BinValues> share_values(const std::vector<Spectrum>& emissions, const Spectrum& total) {
  std::vector<BinValues> out;
  for (const Spectrum& e : emissions) {
    const double power = e.integral();
    if (!(power > 0)) continue;
    BinValues v{};
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (int b = 0; b < bins; ++b) {
      const double all = integral_over(total, bin_low_nm(b), bin_low_nm(b + 1));
      if (all <= dark_share * total.integral()) continue;
      const double share = integral_over(e, bin_low_nm(b), bin_low_nm(b + 1)) / power / all;
      v[static_cast<size_t>(b)] = share;
      low = std::min(low, share);
      high = std::max(high, share);
    }
    if (high - low <= 1e-6 * high) continue;
    make_relative(v, high);
    out.push_back(v);
  }
  return out;
}

}  // namespace

Bands::Bands(const std::vector<double>& edges_nm, const Spectrum& total_emission)
    : weight_(total_emission) {
  const bool ends_fit = edges_nm.size() >= 2 && edges_nm.front() == spectrum_first_nm &&
                        edges_nm.back() == spectrum_last_nm;
  if (!ends_fit || !std::is_sorted(edges_nm.begin(), edges_nm.end(), std::less_equal<>()))
    throw std::invalid_argument("band edges must ascend from 380 to 780 nm");
  if (!(weight_.integral() > 0)) weight_ = equal_energy_shape();
  for (size_t i = 0; i + 1 < edges_nm.size(); ++i) {
    const double low = edges_nm[i];
    const double high = edges_nm[i + 1];
    const Spectrum light = emission_within(weight_, low, high);
    const double power_w = integral_over(light, low, high);
    const auto per_watt = [&](const Spectrum& response) {
      return integral_over(light * response, low, high) / power_w;
    };
    Band band;
    band.low_nm = low;
    band.high_nm = high;
    band.lm_per_w = luminous_efficacy_lm_per_w * per_watt(cie_y());
    band.scotopic_lm_per_w = scotopic_efficacy_lm_per_w * per_watt(cie_scotopic());
    band.x_per_w = luminous_efficacy_lm_per_w * per_watt(cie_x());
    band.z_per_w = luminous_efficacy_lm_per_w * per_watt(cie_z());
    bands_.push_back(band);
  }
}

double Bands::power(const Spectrum& emission_w_per_nm, int b) const {
  const Band& band = (*this)[b];
  return integral_over(emission_w_per_nm, band.low_nm, band.high_nm);
}

std::vector<double> Bands::powers(const Spectrum& shape, double lumens) const {
  // Tristimulus values by the colour matching functions, scaled so that Y is the luminous flux.
  const double y = integral_over(shape * cie_y(), spectrum_first_nm, spectrum_last_nm);
  const auto tristimulus = [&](const Spectrum& response) {
    return integral_over(shape * response, spectrum_first_nm, spectrum_last_nm) / y * lumens;
  };
  const glm::dvec3 wanted(tristimulus(cie_x()), lumens, tristimulus(cie_z()));
  const auto of_band = [](const Band& band) {
    return glm::dvec3(band.x_per_w, band.lm_per_w, band.z_per_w);
  };
  std::vector<double> watts;
  double flux = 0;
  for (int b = 0; b < count(); ++b) {
    watts.push_back(power(shape, b));
    flux += watts.back() * (*this)[b].lm_per_w;
  }
  glm::dvec3 missing = wanted;
  glm::dmat3 normal(0);
  int lit = 0;
  for (size_t b = 0; b < bands_.size(); ++b) {
    watts[b] *= lumens / flux;
    const glm::dvec3 c = of_band(bands_[b]);
    missing -= watts[b] * c;
    normal += watts[b] * glm::outerProduct(c, c);
    if (watts[b] > 0) ++lit;
  }
  missing.y = 0;  // zero but for rounding
  if (lit < 3 || glm::length(missing) < told_colour * lumens) return watts;
  // Deep red bands alone have no Z, or a single chromaticity.
  const double independent = glm::determinant(normal);
  if (!(independent > min_independence * normal[0][0] * normal[1][1] * normal[2][2])) return watts;
  // Minimises the sum of squared relative changes, weighted by watts, under three linear
  // constraints.
  const glm::dvec3 multiplier = glm::inverse(normal) * missing;
  double step = 1;
  for (const Band& band : bands_)
    step = std::min(
        step, max_colour_loss / std::max(max_colour_loss, -glm::dot(multiplier, of_band(band))));
  for (size_t b = 0; b < bands_.size(); ++b)
    watts[b] *= 1 + step * glm::dot(multiplier, of_band(bands_[b]));
  return watts;
}

double Bands::average(const Spectrum& property, int b) const {
  const Band& band = (*this)[b];
  return average_over(property, weight_, band.low_nm, band.high_nm);
}

std::vector<double> told_apart(const std::vector<Spectrum>& properties,
                               const std::vector<Spectrum>& emissions, double tolerance, int most) {
  const Spectrum total = total_of(emissions);
  std::vector<BinValues> told = property_values(properties, total);
  const std::vector<BinValues> shares = share_values(emissions, total);
  told.insert(told.end(), shares.begin(), shares.end());

  const Spectrum weight = total * sight_weight();
  std::vector<Run> runs;
  for (int b = 0; b < bins; ++b) {
    const double low = bin_low_nm(b);
    const double high = bin_low_nm(b + 1);
    const bool dark = integral_over(total, low, high) <= dark_share * total.integral();
    Run run{low, high, dark ? 0 : integral_over(weight, low, high), {}};
    for (const BinValues& v : told) run.mean.push_back(v[static_cast<size_t>(b)]);
    runs.push_back(run);
  }

  const auto max_runs = static_cast<size_t>(std::max(1, most));
  while (runs.size() > 1) {
    size_t min_at = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i + 1 < runs.size(); ++i) {
      const double d = difference(runs[i], runs[i + 1]);
      if (d < least) {
        least = d;
        min_at = i;
      }
    }
    if (least > tolerance && runs.size() <= max_runs) break;
    // Either neighbour may take a dark run; the mean is that of a lit run.
    Run joined = merged(runs[min_at], runs[min_at + 1]);
    if (runs[min_at].weight <= 0) joined.mean = runs[min_at + 1].mean;
    runs[min_at] = joined;
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(min_at) + 1);
  }

  std::vector<double> edges{spectrum_first_nm};
  for (const Run& run : runs) edges.push_back(run.high_nm);
  return edges;
}

}  // namespace luxodus

#include "scenes/light/optics/surface.hpp"

namespace luxodus {

namespace {

/// Clamps; the comparison is written so that NaN gives the lower end.
double within(double value, double low, double high) {
  if (!(value > low)) return low;
  return value < high ? value : high;
}

}  // namespace

SurfaceModel make_surface(SurfaceKind kind, double reflectance, double specular, double roughness,
                          double ior, double internal_transmittance) {
  double diffuse = within(reflectance, 0.0, 1.0);
  double mirror = within(specular, 0.0, 1.0);
  const double sum = diffuse + mirror;
  if (kind == SurfaceKind::glossy && sum > 1.0) {
    diffuse /= sum;
    mirror /= sum;
  }
  SurfaceModel out;
  out.kind = kind;
  out.reflectance = static_cast<Real>(diffuse);
  out.specular = static_cast<Real>(mirror);
  // Two roundings may add up to more than 1: the diffuse part is reduced.
  if (kind == SurfaceKind::glossy)
    out.reflectance = std::min(out.reflectance, 1.0_r - out.specular);
  out.alpha = static_cast<Real>(within(roughness, surface_limits::min_alpha, 1.0));
  out.ior = static_cast<Real>(within(ior, surface_limits::min_ior, surface_limits::max_ior));
  out.log2_transmittance = log2_of(static_cast<Real>(within(internal_transmittance, 0.0, 1.0)));
  return out;
}

}  // namespace luxodus

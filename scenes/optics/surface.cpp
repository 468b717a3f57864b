// Compiling surfaces, and their mean reflectance by quadrature: the sampler of the tracer on a
// fixed grid, so that the summary is of the very model that is traced.
#include "scenes/optics/surface.hpp"

namespace luxodus {

namespace {

/// The upper end is named, so that NaN, which compares with nothing, ends at the lower.
double within(double value, double low, double high) {
  if (!(value > low)) return low;
  return value < high ? value : high;
}

/// Share reflected of light that arrives at this angle from the front.
double directional_reflectance(const SurfaceModel& model, Real cos_theta) {
  switch (model.kind) {
    case SurfaceKind::lambertian:
      return model.reflectance;
    case SurfaceKind::mirror:
      return model.specular;
    case SurfaceKind::glass_pane:
      return pane_shares(model, cos_theta).reflected;
    case SurfaceKind::dielectric:
      return fresnel_reflectance(cos_theta, model.ior);
    case SurfaceKind::open:
      return 0.0;
    case SurfaceKind::glossy:
      break;
  }
  if (model.specular <= 0.0_r) return model.reflectance;
  constexpr int cells = 32;
  SurfaceModel lobe = model;
  lobe.reflectance = 0.0_r;
  const Vec3 normal(0.0_r, 0.0_r, 1.0_r);
  const Vec3 incoming(safe_sqrt(1.0_r - cos_theta * cos_theta), 0.0_r, -cos_theta);
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Real u = (static_cast<Real>(i) + 0.5_r) / static_cast<Real>(cells);
      const Real v = (static_cast<Real>(j) + 0.5_r) / static_cast<Real>(cells);
      sum += static_cast<double>(sample_surface(lobe, incoming, normal, true, 0.0_r, u, v).weight);
    }
  }
  return static_cast<double>(model.reflectance) + sum / (cells * cells);
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
  // Two roundings may add up to more than 1: the diffuse part gives way.
  if (kind == SurfaceKind::glossy)
    out.reflectance = std::min(out.reflectance, 1.0_r - out.specular);
  out.alpha = static_cast<Real>(within(roughness, surface_limits::min_alpha, 1.0));
  out.ior = static_cast<Real>(within(ior, surface_limits::min_ior, surface_limits::max_ior));
  out.log2_transmittance = log2_of(static_cast<Real>(within(internal_transmittance, 0.0, 1.0)));
  return out;
}

double mean_hemispherical_reflectance(const SurfaceModel& model) {
  if (model.kind == SurfaceKind::lambertian) return model.reflectance;
  // Midpoints in cos^2 theta have equal shares of the cosine-weighted hemisphere; Fresnel's steep
  // end is resolved by many of them.
  const int rings = model.kind == SurfaceKind::glossy ? 64 : 4096;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double square = (i + 0.5) / rings;
    sum += directional_reflectance(model, static_cast<Real>(std::sqrt(square)));
  }
  return sum / rings;
}

}  // namespace luxodus

// Surface scattering compiled for one band. It is used both by flux particles and by paths traced
// from the eye, since every model is reciprocal. Promise: on average a surface never returns more
// light than arrives (weights are in [0, 1]), at any angle and roughness. Directions: `incoming`
// travels towards the surface; `normal` is the unit geometric normal on the side it comes from; wo
// and wi point away from the surface. The weight is for flux and for basic radiance L / n^2, which
// a refracting boundary preserves. Not here: textures, and which side of a triangle was hit. Pure
// functions; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/refraction.hpp"
#include "scenes/light/optics/sampling.hpp"

namespace luxodus {

enum class SurfaceKind {
  lambertian,  // reflectance
  glossy,      // reflectance (Lambert) + specular (GGX of roughness alpha)
  mirror,      // specular
  glass_pane,  // thin plane pane with both faces and the reflections between them
  dielectric,  // smooth boundary of a solid; ior is behind the front
  open,        // not there
};

namespace surface_limits {
/// Least GGX roughness: a narrower lobe acts as a mirror for every luminaire here, and its peak 1 /
/// (pi alpha^2) would depend on the rounding of the half vector.
inline constexpr double min_alpha = 1e-3;
}  // namespace surface_limits

/// One surface in one band. Made by make_surface; a texture may then scale the reflectance.
struct SurfaceModel {
  SurfaceKind kind = SurfaceKind::open;
  Real reflectance = 0;         // Lambertian part, [0, 1]
  Real specular = 0;            // mirror or GGX part, [0, 1]; reflectance + specular <= 1
  Real alpha = 0.3_r;           // GGX roughness, [1e-3, 1]
  Real ior = 1;                 // n behind / n in front; of the glass for a pane
  Real log2_transmittance = 0;  // log2 of the internal transmittance of a pane along its normal
};

struct SurfaceSample {
  Vec3 direction;  // of travel afterwards, unit
  Real weight;     // f cos / pdf of the sampled lobe, [0, 1]: the share of the power that continues
  bool transmitted;  // the light leaves on the other side
  bool specular;     // delta distribution: next-event estimation cannot connect to it
};

/// Compiles a surface. Values are clamped to their ranges; reflectance + specular above 1 (from
/// rounding of two averages) is scaled to 1. `roughness` is GGX alpha.
SurfaceModel make_surface(SurfaceKind kind, double reflectance, double specular, double roughness,
                          double ior, double internal_transmittance);

// ---- glass -------------------------------------------------------------------------------------

struct PaneShares {
  Real reflected;
  Real transmitted;
};

/// A thin pane with all reflections between its faces, incoherent, averaged over the polarisations:
/// R = r + (1-r)^2 r t^2 / (1 - r^2 t^2), T = (1-r)^2 t / (1 - r^2 t^2), t = internal^(1 / cos
/// behind).
inline PaneShares pane_shares(const SurfaceModel& model, Real cos_theta) {
  const FresnelTerms terms = fresnel(std::fabs(cos_theta), model.ior);
  if (terms.cos_behind <= 0.0_r) return {1.0_r, 0.0_r};
  const Real loss = -exp2_minus_one(model.log2_transmittance / terms.cos_behind);  // 1 - t
  const Real t = 1.0_r - loss;
  PaneShares sum{0.0_r, 0.0_r};
  for (const FresnelShares& f : {terms.s, terms.p}) {
    // 1 - r^2 t^2 = (1 - r t) (1 + r t) with 1 - r t = (1 - r) + r (1 - t): no cancellation at
    // grazing angles.
    const Real through = f.t * f.t * t / ((f.t + f.r * loss) * (1.0_r + f.r * t));
    sum.transmitted += 0.5_r * through;
    sum.reflected += 0.5_r * f.r * (1.0_r + t * through);
  }
  return sum;
}

/// Share of the power that passes a pane undeviated, in either direction: for shadow rays.
/// `cos_theta` is the cosine between the ray and the pane's normal, with any sign.
inline Real pane_transmittance(const SurfaceModel& model, Real cos_theta) {
  return pane_shares(model, cos_theta).transmitted;
}

// ---- glossy ------------------------------------------------------------------------------------

/// sqrt(cos^2 + alpha^2 sin^2): Smith's Lambda for GGX is (this / cos - 1) / 2; avoids the tangent.
inline Real ggx_stretch(Real cos_theta, Real alpha) {
  const Real cos_square = cos_theta * cos_theta;
  return std::sqrt(cos_square + alpha * alpha * std::max(0.0_r, 1.0_r - cos_square));
}

/// Microfacet normal seen from the local direction wo (z > 0), distributed as the visible normals
/// of GGX (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018): stretch to
/// the hemisphere, sample its projection as seen from wo, transform back.
inline Vec3 sample_ggx_visible_normal(const Vec3& wo, Real alpha, Real u, Real v) {
  const Vec3 view = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  // The visible half disc is cut along the axis that lies in the surface.
  const Real flat = view.x * view.x + view.y * view.y;
  const Vec3 t1 = flat > 1e-14_r ? Vec3(-view.y, view.x, 0.0_r) * (1.0_r / std::sqrt(flat))
                                 : Vec3(1.0_r, 0.0_r, 0.0_r);
  const Vec3 t2 = glm::cross(view, t1);
  const Vec2 disc = uniform_disc(u, v);
  const Real visible = 0.5_r * (1.0_r + view.z);
  const Real y = (1.0_r - visible) * safe_sqrt(1.0_r - disc.x * disc.x) + visible * disc.y;
  const Real z = safe_sqrt(1.0_r - disc.x * disc.x - y * y);
  const Vec3 h = t1 * disc.x + t2 * y + view * z;
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(1e-6_r, h.z)));
}

/// Density of microfacet normals of GGX [1/sr] (Trowbridge and Reitz 1975).
inline Real ggx_density(Real alpha, const Vec3& h, const Vec3& normal) {
  const Real cos_h = glm::dot(h, normal);
  const Vec3 flat = glm::cross(h, normal);  // for sin^2: 1 - cos^2 would lose a narrow lobe
  const Real alpha_square = alpha * alpha;
  const Real spread = cos_h * cos_h * alpha_square + glm::dot(flat, flat);
  return inverse_pi_f * alpha_square / (spread * spread);
}

// ---- used by the tracers -----------------------------------------------------------------------

/// BRDF [1/sr] of the non-delta part (Lambert + GGX with Smith's height-correlated masking, Heitz,
/// JCGT 3(2), 2014); 0 for mirror, pane, dielectric and open, and below the horizon.
inline Real evaluate_surface(const SurfaceModel& model, const Vec3& wo, const Vec3& wi,
                             const Vec3& normal) {
  const Real cos_o = glm::dot(wo, normal);
  const Real cos_i = glm::dot(wi, normal);
  if (!(cos_o > 0.0_r && cos_i > 0.0_r)) return 0.0_r;
  if (model.kind == SurfaceKind::lambertian) return model.reflectance * inverse_pi_f;
  if (model.kind != SurfaceKind::glossy) return 0.0_r;
  const Real d = ggx_density(model.alpha, glm::normalize(wo + wi), normal);
  const Real masking =
      cos_i * ggx_stretch(cos_o, model.alpha) + cos_o * ggx_stretch(cos_i, model.alpha);
  return model.reflectance * inverse_pi_f + model.specular * d * 0.5_r / masking;
}

/// Density [1/sr] with which `sample_surface` draws wi from the non-delta part; 0 for mirror, pane,
/// dielectric and open, and below the horizon.
inline Real surface_pdf(const SurfaceModel& model, const Vec3& wo, const Vec3& wi,
                        const Vec3& normal) {
  const Real cos_o = std::max(glm::dot(wo, normal), surface_limits::min_cos);
  const Real cos_i = glm::dot(wi, normal);
  if (!(cos_i > 0.0_r)) return 0.0_r;
  if (model.kind == SurfaceKind::lambertian) return cosine_pdf(cos_i);
  const Real sum = model.reflectance + model.specular;
  if (model.kind != SurfaceKind::glossy || !(sum > 0.0_r)) return 0.0_r;
  // Density of visible normals, per solid angle of the reflected direction: D G1 / (4 cos).
  const Real d = ggx_density(model.alpha, glm::normalize(wo + wi), normal);
  const Real lobe = d * 0.5_r / (cos_o + ggx_stretch(cos_o, model.alpha));
  return (model.reflectance * cosine_pdf(cos_i) + model.specular * lobe) / sum;
}

namespace surface_detail {

inline SurfaceSample sample_ggx(const SurfaceModel& model, const Vec3& incoming, const Vec3& normal,
                                Real u, Real v) {
  const Basis basis = basis_around(normal);
  Vec3 wo = basis.to_local(-incoming);
  wo.z = std::max(wo.z, surface_limits::min_cos);
  const Vec3 m = sample_ggx_visible_normal(wo, model.alpha, u, v);
  const Vec3 wi = m * (2.0_r * glm::dot(wo, m)) - wo;
  // Reflected into the surface, onto a second facet: the single-scattering model ends here.
  if (!(wi.z > 0.0_r)) return {normal, 0.0_r, false, false};
  const Real stretch_o = ggx_stretch(wo.z, model.alpha);
  const Real stretch_i = ggx_stretch(wi.z, model.alpha);
  const Real masking = wi.z * (wo.z + stretch_o) / (wi.z * stretch_o + wo.z * stretch_i);
  const Real weight = (model.reflectance + model.specular) * std::min(1.0_r, masking);
  return {renormalised(basis.to_world(wi)), weight, false, false};
}

inline Vec3 mirrored(const Vec3& incoming, const Vec3& normal, Real cos_theta) {
  return renormalised(incoming + normal * (2.0_r * cos_theta));
}

inline SurfaceSample sample_dielectric(const SurfaceModel& model, const Vec3& incoming,
                                       const Vec3& normal, bool front, Real u_lobe) {
  const Real cos_theta = std::clamp(-glm::dot(incoming, normal), 0.0_r, 1.0_r);
  const Real ior = front ? model.ior : 1.0_r / model.ior;
  const FresnelTerms terms = fresnel(cos_theta, ior);
  if (terms.cos_behind <= 0.0_r || u_lobe < 0.5_r * (terms.s.r + terms.p.r)) {
    return {mirrored(incoming, normal, cos_theta), 1.0_r, false, true};
  }
  return {refracted(incoming, normal, cos_theta, ior, terms.cos_behind), 1.0_r, true, true};
}

}  // namespace surface_detail

/// Samples one event: chooses a lobe with u_lobe and a direction in it with u, v. `front` tells a
/// dielectric that the light comes from outside. Requires: incoming, normal unit; incoming . normal
/// <= 0 up to rounding.
inline SurfaceSample sample_surface(const SurfaceModel& model, const Vec3& incoming,
                                    const Vec3& normal, bool front, Real u_lobe, Real u, Real v) {
  switch (model.kind) {
    case SurfaceKind::lambertian:
      break;
    case SurfaceKind::glossy: {
      // Lobes are chosen in proportion to their reflectance, so the weight of each is the sum of
      // both.
      const Real sum = model.reflectance + model.specular;
      if (u_lobe * sum < model.specular) {
        return surface_detail::sample_ggx(model, incoming, normal, u, v);
      }
      return {to_world(normal, cosine_hemisphere(u, v)), sum, false, false};
    }
    case SurfaceKind::mirror: {
      const Real cos_theta = std::max(0.0_r, -glm::dot(incoming, normal));
      return {surface_detail::mirrored(incoming, normal, cos_theta), model.specular, false, true};
    }
    case SurfaceKind::glass_pane: {
      const Real cos_theta = std::max(0.0_r, -glm::dot(incoming, normal));
      const PaneShares shares = pane_shares(model, cos_theta);
      const Real sum = std::min(1.0_r, shares.reflected + shares.transmitted);
      if (u_lobe * sum < shares.reflected) {
        return {surface_detail::mirrored(incoming, normal, cos_theta), sum, false, true};
      }
      return {incoming, sum, true, true};
    }
    case SurfaceKind::dielectric:
      return surface_detail::sample_dielectric(model, incoming, normal, front, u_lobe);
    case SurfaceKind::open:
      return {incoming, 1.0_r, true, true};
  }
  return {to_world(normal, cosine_hemisphere(u, v)), model.reflectance, false, false};
}

}  // namespace luxodus

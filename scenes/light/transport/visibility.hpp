// Straight lines through a scene, for whoever asks of places rather than of particles: what each
// emitter gives at a point, whether one point sees another, what is next in a direction. Without
// chance. One thread or fiber at a time.
#pragma once

#include <optional>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/direct_light.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Direct illuminance at a point [local coordinates] by each emitter of the scene that is asked
/// for, in their order [lx].
std::vector<double> direct_by_emitter(const CompiledScene& scene, const GeometryAccess& access,
                                      const Vec3& point, const Vec3& normal,
                                      const DirectOptions& options);

/// All direct light at a point by each of these emitters, in their order: with and without media,
/// and as if nothing solid were in the way.
std::vector<DirectFromEmitter> direct_lights(const CompiledScene& scene,
                                             const GeometryAccess& access, const Vec3& point,
                                             const Vec3& normal, const DirectOptions& options);

/// Direct light at a point by where it comes from: emitters that are large as seen from there come
/// in parts, each with what the media leave of it on its own way.
std::vector<ArrivingLight> direct_arrivals(const CompiledScene& scene, const GeometryAccess& access,
                                           const Vec3& point, const Vec3& normal,
                                           const DirectOptions& options);

/// Whether an emitter is a luminaire: neither a sign's own light nor a flame.
inline bool is_luminaire(const CompiledEmitter& e) {
  return e.kind != EmitterKind::sign_face && e.kind != EmitterKind::volume;
}

/// Share of light in the middle band that whatever is solid lets pass between two points.
double clear_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& to);

/// Optical depth of the media on the straight line between two points at a wavelength [nm], from
/// the bands about it; what is solid does not count.
double depth_between(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                     const Vec3& to, double wavelength_nm);

struct MetSurface {
  Real distance_m = 0;
  bool front = true;     // its front side is met
  uint32_t surface = 0;  // of the scene's
};
/// Nothing within `length_m`: none.
std::optional<MetSurface> next_surface(const CompiledScene& scene, const GeometryAccess& access,
                                       const Vec3& from, const Vec3& direction, Real length_m);

}  // namespace luxodus

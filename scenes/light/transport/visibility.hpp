// Visibility and direct light between places, for callers other than the tracers: direct light of
// each emitter at a point, visibility between two points, the next surface in a direction.
// Deterministic. One thread or fiber at a time.
#pragma once

#include <optional>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/direct_light.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Direct illuminance at a point [local coordinates] by each requested emitter, in their order
/// [lx].
std::vector<double> direct_by_emitter(const CompiledScene& scene, const GeometryAccess& access,
                                      const Vec3& point, const Vec3& normal,
                                      const DirectOptions& options);

/// All direct light at a point by each requested emitter, in their order: with and without media,
/// and without solids in the way.
std::vector<DirectFromEmitter> direct_lights(const CompiledScene& scene,
                                             const GeometryAccess& access, const Vec3& point,
                                             const Vec3& normal, const DirectOptions& options);

/// Direct light at a point by direction of arrival: emitters that are large as seen from there are
/// divided into parts, each attenuated by the media on its own line.
std::vector<ArrivingLight> direct_arrivals(const CompiledScene& scene, const GeometryAccess& access,
                                           const Vec3& point, const Vec3& normal,
                                           const DirectOptions& options);

/// Whether an emitter is a luminaire: neither a sign's emission nor a flame.
inline bool is_luminaire(const CompiledEmitter& e) {
  return e.kind != EmitterKind::sign_face && e.kind != EmitterKind::volume;
}

/// Transmittance of solids in the middle band between two points. `body`: of an emitter at one,
/// whose own body does not stop its light; 0 for none.
double clear_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& to, int body = 0);

/// Optical depth of the media on the line between two points at a wavelength [nm], interpolated
/// from the bands around it; solids are ignored.
double depth_between(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                     const Vec3& to, double wavelength_nm);

struct MetSurface {
  Real distance_m = 0;
  bool front = true;     // its front side was hit
  uint32_t surface = 0;  // of the scene
};
/// The next surface; none within `length_m`.
std::optional<MetSurface> next_surface(const CompiledScene& scene, const GeometryAccess& access,
                                       const Vec3& from, const Vec3& direction, Real length_m);

}  // namespace luxodus

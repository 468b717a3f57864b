#include "actors/judge/assess/line_of_sight.hpp"

#include "scenes/emergency/smoke_laws.hpp"

namespace luxodus {

namespace {

/// Wavelength of FDS's extinction [nm]: that of the red laser by which soot was measured.
constexpr double fds_wavelength_nm = 633;
/// A person within this distance of a sign in plan stands under it, and has no line to it [m].
constexpr double under_sign_m = 1e-6;

}  // namespace

LineOfSight line_of_sight(const Building& building, const GeometryAccess& access, const Sign& sign,
                          const SignView& view, const glm::dvec3& eye) {
  const PlanLine line = plan_line(view, eye);
  const glm::vec3 from = building.local(eye), to = building.local(line.to);
  LineOfSight out;
  out.distance_m = line.distance_m;
  const bool under = line.distance_m < under_sign_m;
  out.clear = under || clear_share(building.scene(), access, from, to) > 0;
  if (!under)
    out.extinction =
        depth_between(building.scene(), access, from, to, fds_wavelength_nm) / line.distance_m;
  out.visibility_m =
      line_of_sight_distance_m(jin_constant(sign.lighting), out.extinction, line.cosine);
  out.seen = out.clear && out.distance_m <= out.visibility_m;
  return out;
}

}  // namespace luxodus

#include "scenes/light/transport/emission.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Index of the interval of a cumulative table that w in [0, 1) falls into.
size_t find_interval(const std::vector<double>& cdf, double w) {
  const auto it = std::upper_bound(cdf.begin(), cdf.end(), w);
  return std::min(static_cast<size_t>(it - cdf.begin()), cdf.size() - 1);
}

EmissionPoint point_on_sign(const CompiledEmitter& e, Real u, Real v, double w) {
  const size_t texel = find_interval(e.texel_cdf, w);
  const auto columns = static_cast<size_t>(e.texel_columns);
  const Real rows = static_cast<Real>(e.texel_cdf.size() / columns);
  const Real x = (static_cast<Real>(texel % columns) + u) / static_cast<Real>(columns);
  const Real y = (static_cast<Real>(texel / columns) + v) / rows;
  const Vec3 p =
      e.origin + e.axes[0] * ((x - 0.5_r) * e.size.x) + e.axes[1] * ((0.5_r - y) * e.size.y);
  return {p, e.axes[2]};
}

/// Share of an emitter's extent that emits: its edges are excluded by a millionth, since light from
/// an edge that touches a wall would start in that wall.
constexpr Real off_the_edges = 1 - 0x1p-20_r;

EmissionPoint point_on_mesh(const CompiledEmitter& e, Real u, Real v, double w) {
  const size_t triangle = find_interval(e.texel_cdf, w);
  const Vec3* corner = &e.corners[3 * triangle];
  const Vec3 b = uniform_triangle(u, v);
  const Vec3 p = corner[0] * b.x + corner[1] * b.y + corner[2] * b.z;
  const Vec3 centre = (corner[0] + corner[1] + corner[2]) / 3.0_r;
  return {centre + (p - centre) * off_the_edges,
          glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]))};
}

/// Distance along the ray to a triangle's front, infinity if none (Moeller and Trumbore 1997).
Real triangle_distance(const Vec3* corner, const Ray& ray) {
  const Real none = std::numeric_limits<Real>::infinity();
  const Vec3 e1 = corner[1] - corner[0];
  const Vec3 e2 = corner[2] - corner[0];
  const Vec3 p = glm::cross(ray.direction, e2);
  const Real determinant = glm::dot(e1, p);
  if (determinant <= 0) return none;  // behind, or edge-on
  const Vec3 s = ray.origin - corner[0];
  const Real u = glm::dot(s, p);
  if (u < 0 || u > determinant) return none;
  const Vec3 q = glm::cross(s, e1);
  const Real v = glm::dot(ray.direction, q);
  if (v < 0 || u + v > determinant) return none;
  return glm::dot(e2, q) / determinant;
}

Real sphere_distance(const CompiledEmitter& e, const Ray& ray) {
  const Real radius = 0.5_r * e.size.x;
  const Vec3 to_centre = e.origin - ray.origin;
  const Real along = glm::dot(to_centre, ray.direction);
  const Vec3 offset = to_centre - ray.direction * along;
  const Real half = radius * radius - glm::dot(offset, offset);
  return half > 0 ? along - std::sqrt(half) : std::numeric_limits<Real>::infinity();
}

/// Lateral surface of a tube about local x, from outside.
Real tube_distance(const CompiledEmitter& e, const Ray& ray) {
  const Real none = std::numeric_limits<Real>::infinity();
  const Real radius = 0.5_r * e.size.y;
  const Vec3 o = ray.origin - e.origin;
  const Vec2 p(glm::dot(o, e.axes[1]), glm::dot(o, e.axes[2]));
  const Vec2 d(glm::dot(ray.direction, e.axes[1]), glm::dot(ray.direction, e.axes[2]));
  const Real a = glm::dot(d, d);
  if (a <= 0) return none;
  const Real along = -glm::dot(p, d) / a;
  const Vec2 closest = p + d * along;
  const Real half = (radius * radius - glm::dot(closest, closest)) / a;
  if (half <= 0) return none;
  const Real t = along - std::sqrt(half);
  const Real x = glm::dot(o + ray.direction * t, e.axes[0]);
  return std::abs(x) <= 0.5_r * e.size.x ? t : none;
}

/// Flat shapes emit to local -Z, isotropic ones to both sides.
Real flat_distance(const CompiledEmitter& e, const Ray& ray) {
  const Real none = std::numeric_limits<Real>::infinity();
  const Real cosine = glm::dot(ray.direction, e.axes[2]);
  if (cosine == 0 || (cosine < 0 && e.distribution != Distribution::isotropic &&
                      e.distribution != Distribution::web))
    return none;
  const Real t = glm::dot(e.origin - ray.origin, e.axes[2]) / cosine;
  const Vec3 p = ray.origin + ray.direction * t - e.origin;
  const Real x = glm::dot(p, e.axes[0]);
  const Real y = glm::dot(p, e.axes[1]);
  const bool in = e.kind == EmitterKind::disc
                      ? x * x + y * y <= 0.25_r * e.size.x * e.size.x
                      : std::abs(x) <= 0.5_r * e.size.x && std::abs(y) <= 0.5_r * e.size.y;
  return in ? t : none;
}

/// Normal of the face at one of its points; the axis of a photometric web is a different vector.
Vec3 outward(const CompiledEmitter& e, const EmissionPoint& point) {
  const Vec3 p = point.position - e.origin;
  if (e.kind == EmitterKind::sphere) return glm::normalize(p);
  if (e.kind == EmitterKind::tube) return glm::normalize(p - e.axes[0] * glm::dot(p, e.axes[0]));
  return point.axis;
}

struct FaceHit {
  Real distance = std::numeric_limits<Real>::infinity();  // no hit
  Vec3 normal{0};
};

/// Intersects a ray with an emitter's own face. The normal is valid if the hit is nearer than
/// `best`.
FaceHit meet_face(const CompiledEmitter& e, const Ray& ray, Real best) {
  FaceHit hit;
  hit.normal = -e.axes[2];
  switch (e.kind) {
    case EmitterKind::point:
    case EmitterKind::volume:
    case EmitterKind::sign_face:
      break;
    case EmitterKind::rectangle:
    case EmitterKind::disc:
      hit.distance = flat_distance(e, ray);
      break;
    case EmitterKind::sphere:
      hit.distance = sphere_distance(e, ray);
      if (hit.distance < best)
        hit.normal = glm::normalize(ray.origin + ray.direction * hit.distance - e.origin);
      break;
    case EmitterKind::tube:
      hit.distance = tube_distance(e, ray);
      if (hit.distance < best) {
        const Vec3 o = ray.origin + ray.direction * hit.distance - e.origin;
        hit.normal = glm::normalize(o - e.axes[0] * glm::dot(o, e.axes[0]));
      }
      break;
    case EmitterKind::mesh:
      for (size_t k = 0; k + 2 < e.corners.size(); k += 3) {
        const Real at = triangle_distance(&e.corners[k], ray);
        if (!(at > 0 && at < hit.distance)) continue;
        hit.distance = at;
        hit.normal = glm::normalize(
            glm::cross(e.corners[k + 1] - e.corners[k], e.corners[k + 2] - e.corners[k]));
      }
      break;
  }
  return hit;
}

}  // namespace

bool has_own_face(const CompiledEmitter& e) {
  return e.kind != EmitterKind::point && e.kind != EmitterKind::volume &&
         e.kind != EmitterKind::sign_face;
}

EmitterBound emitter_bound(const CompiledScene& scene, uint32_t emitter) {
  const CompiledEmitter& e = scene.emitters[emitter];
  EmitterBound bound{e.origin, 0};
  if (e.kind == EmitterKind::mesh) {
    bound.centre = e.corners.front();
    for (const Vec3& c : e.corners)
      bound.radius = std::max(bound.radius, glm::length(c - bound.centre));
  } else {
    bound.radius = 0.5_r * glm::length(e.size);  // at least half the diagonal of any shape
  }
  bound.radius = bound.radius * 1.001_r + scene.diagonal_m * 0x1p-18_r;  // over all roundings
  return bound;
}

EmissionPoint emission_point(const CompiledEmitter& e, Real u, Real v, double w) {
  const Vec3 down = -e.axes[2];
  switch (e.kind) {
    case EmitterKind::point:
    case EmitterKind::volume:
      return {e.origin, down};
    case EmitterKind::rectangle:
      return {e.origin + e.axes[0] * ((u - 0.5_r) * off_the_edges * e.size.x) +
                  e.axes[1] * ((v - 0.5_r) * off_the_edges * e.size.y),
              down};
    case EmitterKind::disc: {
      const Vec2 p = uniform_disc(u, v) * (0.5_r * e.size.x);
      return {e.origin + e.axes[0] * p.x + e.axes[1] * p.y, down};
    }
    case EmitterKind::sphere: {
      const Vec3 n = uniform_sphere(u, v);
      return {e.origin + n * (0.5_r * e.size.x), e.distribution == Distribution::web ? down : n};
    }
    case EmitterKind::tube: {
      const SinCos around = sin_cos_two_pi(v);
      const Vec3 n = e.axes[1] * around.cos + e.axes[2] * around.sin;
      return {e.origin + e.axes[0] * ((u - 0.5_r) * e.size.x) + n * (0.5_r * e.size.y),
              e.distribution == Distribution::web ? down : n};
    }
    case EmitterKind::mesh:
      return point_on_mesh(e, u, v, w);
    case EmitterKind::sign_face:
      return point_on_sign(e, u, v, w);
  }
  return {e.origin, down};
}

double sampled_area_m2(const CompiledEmitter& e, const Vec3& point) {
  if (e.kind != EmitterKind::sign_face) return e.area_m2;
  const auto columns = static_cast<size_t>(e.texel_columns);
  const size_t rows = e.texel_cdf.size() / columns;
  const Vec3 p = point - e.origin;
  const auto index = [](Real share, size_t count) {
    const Real at = share * static_cast<Real>(count);
    return std::min(static_cast<size_t>(std::max(0.0_r, at)), count - 1);
  };
  const size_t x = index(glm::dot(p, e.axes[0]) / e.size.x + 0.5_r, columns);
  const size_t y = index(0.5_r - glm::dot(p, e.axes[1]) / e.size.y, rows);
  const size_t texel = y * columns + x;
  const double share = e.texel_cdf[texel] - (texel > 0 ? e.texel_cdf[texel - 1] : 0.0);
  const double area = static_cast<double>(e.size.x) * static_cast<double>(e.size.y) /
                      static_cast<double>(e.texel_cdf.size());
  return share > 0 ? area / share : 0;
}

double apparent_face(const CompiledEmitter& e, const EmissionPoint& point, const Vec3& to_place,
                     Real distance) {
  if (e.kind == EmitterKind::point || e.kind == EmitterKind::volume) return 0;
  const Real facing = glm::dot(outward(e, point), to_place);
  const bool flat = e.kind == EmitterKind::rectangle || e.kind == EmitterKind::disc;
  const auto cosine = static_cast<double>(flat ? std::abs(facing) : std::max(0.0_r, facing));
  const auto d = static_cast<double>(distance);
  return sampled_area_m2(e, point.position) * cosine / (d * d);
}

EmitterHit nearest_emitter(const CompiledScene& scene, const Ray& ray, Real length) {
  constexpr Real rounding = 1e-5_r;  // of a scene's coordinates: a face's rim lies on its sphere
  EmitterHit best;
  best.distance = length;
  const EmittersWithFaces& faces = scene.emitters_with_faces;
  faces.around.for_each_near(ray, length, rounding * scene.diagonal_m, [&](uint32_t k, Real, Real) {
    const uint32_t i = faces.emitters[k];
    const FaceHit hit = meet_face(scene.emitters[i], ray, best.distance);
    if (hit.distance > 0 && hit.distance < best.distance)
      best = {hit.distance, i, {ray.origin + ray.direction * hit.distance, hit.normal}};
  });
  return best;
}

}  // namespace luxodus

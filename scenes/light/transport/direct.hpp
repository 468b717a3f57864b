// Deterministic direct light at a point: every emitter is cut into cells, shadow rays test the
// visibility of their points, and photometric web, cosine law and media give the light that
// arrives. Regulations judge this part alone. Excluded are collimated beams, which have no density
// of directions, and light turned by refracting solids or mirrors; the traced part counts them.
// Accuracy: 1e-3 of all that arrives, as long as occluders are not smaller than the spacing of
// points. Unoccluded cells of Lambertian polygons in clear air are computed in closed form, others
// by the Gauss-Legendre rule. If one straight edge divides a rectangle's cell, the edge is located
// and the visible part computed likewise; other partly hidden cells are quartered, those with the
// largest possible error first, up to limits::shadow_splits.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/direct_light.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/emitter_cells.hpp"
#include "scenes/light/transport/polygon_light.hpp"

namespace luxodus {

namespace limits {
/// Quarterings of partly hidden cells, of all emitters at one point: half of a lamp behind a
/// straight edge needs 63 for an accuracy of 1e-3.
inline constexpr int shadow_splits = 96;
/// Bisection steps that locate a shadow's edge on a side of a cell, and the distance from it at
/// which points confirm it, as a share of the cell.
inline constexpr int edge_steps = 12;
inline constexpr double edge_width = 0.01;
/// Rounds of quartering cells because a web varies within them.
inline constexpr int web_rounds = 3;
}  // namespace limits

/// Mean extinction on the line from a place to an emitter [1/m], in the middle band; 0 in clear
/// air.
template <class Resolver>
double mean_extinction(const CompiledScene& scene, const CompiledEmitter& emitter,
                       const Vec3& place, Resolver& resolver) {
  if (scene.features.media == MediaNeed::none) return 0;
  const Vec3 target = emitter.kind == EmitterKind::mesh ? emitter.corners[0] : emitter.origin;
  const Real distance = glm::length(target - place);
  if (!(distance > 0)) return 0;
  const Vec3 direction = (target - place) / distance;
  return optical_depth<MediaNeed::general>(scene.media, scene.bands.count() / 2, place, direction,
                                           distance, resolver) /
         static_cast<double>(distance);
}

/// The direct light of all emitters at one point. One thread or fiber at a time; suspends where the
/// resolver does.
template <class Resolver>
class DirectSum {
 public:
  /// Requires: all references outlive this.
  DirectSum(const CompiledScene& scene, const Vec3& point, const Vec3& normal,
            const DirectOptions& options, Resolver& resolver)
      : scene_(scene),
        place_(point),
        from_(offset_ray(point, normal, scene.min_offset_m)),
        normal_(normal),
        options_(options),
        resolver_(resolver),
        in_media_(options.media && scene.features.media != MediaNeed::none) {
    if (options.only.empty())
      for (uint32_t i = 0; i < scene.emitters.size(); ++i) add_emitter(i);
    for (const uint32_t i : options.only) add_emitter(i);
    resolve_shadows();
  }

  /// Light by requested emitter, in their order.
  std::vector<DirectFromEmitter> by_emitter() const {
    const auto& only = options_.only;
    std::vector<DirectFromEmitter> out(only.empty() ? scene_.emitters.size() : only.size());
    for (const Leaf& leaf : leaves_) {
      const auto at = std::lower_bound(only.begin(), only.end(), leaf.emitter);
      out[only.empty() ? leaf.emitter : static_cast<size_t>(at - only.begin())] += leaf.light;
    }
    return out;
  }

  /// Illuminance by direction of arrival. Light computed in closed form for a cell is listed for
  /// its points.
  std::vector<ArrivingLight> arriving() const {
    std::vector<ArrivingLight> out;
    for (const Leaf& leaf : leaves_)
      for (size_t i = 0; i < leaf.count; ++i)
        if (leaf.arriving[i].clear_air_lx > 0) out.push_back(leaf.arriving[i]);
    return out;
  }

 private:
  struct Leaf {
    uint32_t emitter = 0;
    EmitterCell cell;
    DirectFromEmitter light;
    std::array<ArrivingLight, 4> arriving{};
    size_t count = 0;
    double error_lx = 0;  // possible error of a partly hidden cell
  };

  /// Visibility of an emitter's point.
  enum class Seen { not_at_all, hidden, clear, dimmed };
  struct PointLight {
    DirectFromEmitter light;
    ArrivingLight arriving;
    Seen seen = Seen::not_at_all;  // no light goes there, or it comes from below the horizon
  };

  Viewpoint viewpoint(const CompiledEmitter& e) const {
    Viewpoint view{place_, normal_, 0, options_.part_share, false};
    if (in_media_) {
      view.sigma_t = mean_extinction(scene_, e, from_, resolver_);
      // Edges of layers and clouds may lie anywhere, so points are as dense as for a one-point
      // rule.
      if (scene_.features.media != MediaNeed::homogeneous) view.part_share *= 0.5;
    }
    view.clipped = is_closed_form(e) && !in_media_;
    return view;
  }

  bool is_known(uint32_t index, KnownSight sight) const {
    return !options_.known.empty() && options_.known[index] == sight;
  }

  static bool is_closed_form(const CompiledEmitter& e) {
    return has_flat_cells(e) && e.distribution == Distribution::lambertian;
  }

  void add_emitter(uint32_t index) {
    const CompiledEmitter& e = scene_.emitters[index];
    if (e.distribution == Distribution::collimated || is_known(index, KnownSight::hidden)) return;
    const EmitterCells cells(scene_, e, viewpoint(e));
    std::vector<EmitterCell> cut = cells.cut();
    if (options_.tolerance <= fine && cells.can_be_cut() && !is_closed_form(e))
      follow_distribution(e, cells, cut);
    for (const EmitterCell& cell : cut) add_leaf(index, cells, cell);
  }

  /// Unoccluded illuminance per lumen from a cell's points, without media.
  double geometric(const CompiledEmitter& e, const CellPoints& points) {
    double sum = 0;
    for (const EmitterPart& part : points.all()) {
      const Vec3 to_part = part.point.position - place_;
      const Real distance = glm::length(to_part);
      if (!(distance > 0)) continue;
      const Vec3 direction = to_part / distance;
      const Real cosine = glm::dot(normal_, direction);
      if (cosine <= 0) continue;
      sum += part.share * static_cast<double>(cosine) *
             static_cast<double>(directional_density(e, part.point, -direction, resolver_)) /
             (static_cast<double>(distance) * static_cast<double>(distance));
    }
    return sum;
  }

  /// Quarters cells within which the light varies faster than their points resolve: webs have a
  /// kink at every angle of the table, and spots have an edge.
  void follow_distribution(const CompiledEmitter& e, const EmitterCells& cells,
                           std::vector<EmitterCell>& cut) {
    if (cut.size() == 1 && cut.front().whole) return;
    double total = 0;
    for (const EmitterCell& cell : cut) total += geometric(e, cells.points(cell));
    for (int round = 0; round < limits::web_rounds; ++round) {
      std::vector<EmitterCell> finer;
      bool any = false;
      for (const EmitterCell& cell : cut) {
        const std::vector<EmitterCell> quarters = cells.quarters(cell);
        double sum = 0;
        for (const EmitterCell& q : quarters) sum += geometric(e, cells.points(q));
        const double change = std::abs(sum - geometric(e, cells.points(cell)));
        const bool room = finer.size() + 4 * cut.size() < limits::direct_cells;
        if (room && !cell.whole && change > 1e-4 * total) {
          finer.insert(finer.end(), quarters.begin(), quarters.end());
          any = true;
        } else {
          finer.push_back(cell);
        }
      }
      cut = std::move(finer);
      if (!any) return;
    }
  }

  double lumens_of(const CompiledEmitter& e) const {
    double lumens = 0;
    for (int b = 0; b < scene_.bands.count(); ++b)
      lumens += e.power_w[static_cast<size_t>(b)] * scene_.bands[b].lm_per_w;
    return lumens;
  }

  ShadowRay line_to(const CompiledEmitter& e, const EmitterPart& part) const {
    return connect(scene_, from_, part.point.position, part.point.axis,
                   e.kind != EmitterKind::volume);
  }

  /// Rays start slightly off the place, to avoid its own surface; angles and distances are those of
  /// the place itself.
  PointLight look_at(uint32_t index, const EmitterPart& part, double sigma_t,
                     bool known_clear = false) {
    const CompiledEmitter& e = scene_.emitters[index];
    PointLight out;
    const ShadowRay c = line_to(e, part);
    const Vec3 to_part = part.point.position - place_;
    const Real away = glm::length(to_part);
    if (!(c.distance > 0) || !(away > 0) || !(part.share > 0)) return out;
    const Vec3 direction = to_part / away;
    const Real density = directional_density(e, part.point, -direction, resolver_);
    if (density <= 0) return out;
    const auto cosine = std::max(0.0, static_cast<double>(glm::dot(normal_, direction)));
    // Below the horizon of the point only the fluence counts, and a ray into the surface is
    // blocked.
    double in_media = 0, clear = 0, open = 0;
    double solid = -1, min_solid = 1;
    const auto distance = static_cast<double>(away);
    for (int b = 0; b < scene_.bands.count(); ++b) {
      const double power = e.power_w[static_cast<size_t>(b)] * scene_.bands[b].lm_per_w;
      if (power <= 0) continue;
      if (known_clear)
        solid = 1;
      else if (solid < 0 || (scene_.features.surfaces && solid > 0))
        solid = solid_transmittance(scene_, c.ray, c.ray.length, b, resolver_, e.body);
      min_solid = std::min(min_solid, solid);
      const double passes = !in_media_ ? 1
                            : solid > 0
                                ? medium_transmittance(scene_, c.ray, c.distance, b, resolver_)
                                : std::exp(-sigma_t * distance);  // nearly: only bounds shadows
      clear += power * solid;
      in_media += power * solid * passes;
      open += power * passes;
    }
    const double per_lumen = static_cast<double>(density) / (distance * distance) * part.share;
    out.light.fluence_lm_m2 = in_media * per_lumen;
    out.light.illuminance_lx = in_media * per_lumen * cosine;
    out.light.clear_air_lx = clear * per_lumen * cosine;
    out.light.open_lx = open * per_lumen * cosine;
    out.arriving = {index, direction, out.light.illuminance_lx, out.light.clear_air_lx};
    if (cosine > 0)
      out.seen = !(solid > 0) ? Seen::hidden : min_solid < 1 ? Seen::dimmed : Seen::clear;
    else if (!(solid > 0))
      out.seen = Seen::not_at_all;
    return out;
  }

  /// Whether some corner of the cell is hidden, and whether some corner is visible.
  void look_at_corners(const CompiledEmitter& e, const EmitterCells& cells, const EmitterCell& cell,
                       bool& hidden, bool& seen) {
    const CellPoints corners = cells.corner_points(cell);
    for (const EmitterPart& part : corners.all()) {
      if (hidden && seen) return;
      const ShadowRay c = line_to(e, part);
      if (!(c.distance > 0) || glm::dot(normal_, c.ray.direction) <= 0) continue;
      if (directional_density(e, part.point, -c.ray.direction, resolver_) <= 0) continue;
      const bool passes = solid_transmittance(scene_, c.ray, c.ray.length, scene_.bands.count() / 2,
                                              resolver_, e.body) > 0;
      (passes ? seen : hidden) = true;
    }
  }

  void add_leaf(uint32_t index, const EmitterCells& cells, const EmitterCell& cell) {
    const CompiledEmitter& e = scene_.emitters[index];
    const double sigma_t = cells.viewpoint().sigma_t;
    Leaf leaf{index, cell, {}, {}, 0, 0};
    bool hidden = false, seen = false, all_clear = true, all_above = true;
    const CellPoints points = cells.points(cell);
    const bool known_clear = is_known(index, KnownSight::clear);
    for (const EmitterPart& part : points.all()) {
      const PointLight p = look_at(index, part, sigma_t, known_clear);
      leaf.light += p.light;
      leaf.arriving[leaf.count++] = p.arriving;
      hidden |= p.seen == Seen::hidden;
      seen |= p.seen == Seen::clear || p.seen == Seen::dimmed;
      all_clear &= p.seen != Seen::hidden && p.seen != Seen::dimmed;
      all_above &= p.seen != Seen::not_at_all;
    }
    if (cells.can_be_cut()) {
      if (options_.tolerance <= fine && !known_clear) look_at_corners(e, cells, cell, hidden, seen);
      if (hidden && seen) {
        leaf.error_lx = quarter * leaf.light.open_lx;
        if (options_.tolerance <= fine && e.kind == EmitterKind::rectangle)
          follow_edge(cells, leaf);
      }
      if (seen && !hidden && all_clear && is_closed_form(e))
        put_closed_form(e, cells.polygon(cell), all_above, leaf.light);
    }
    leaves_.push_back(leaf);
  }

  /// Whether a point of an emitter is visible from the place.
  bool sees(const CompiledEmitter& e, const EmitterPart& part) {
    const ShadowRay c = line_to(e, part);
    return c.distance > 0 && solid_transmittance(scene_, c.ray, c.ray.length,
                                                 scene_.bands.count() / 2, resolver_, e.body) == 1;
  }

  /// The shadow's edge between a visible and a hidden point, by bisection.
  glm::dvec2 edge_between(const CompiledEmitter& e, const EmitterCells& cells,
                          const EmitterCell& cell, glm::dvec2 seen, glm::dvec2 hidden) {
    for (int step = 0; step < limits::edge_steps; ++step) {
      const glm::dvec2 middle = 0.5 * (seen + hidden);
      (sees(e, cells.point_in(cell, middle, 1)) ? seen : hidden) = middle;
    }
    return 0.5 * (seen + hidden);
  }

  /// A rectangle's cell divided by one straight shadow edge, e.g. of a wall or a shelf: locates the
  /// edge on two sides of the cell and confirms it by points between. Other cells stay unchanged.
  void follow_edge(const EmitterCells& cells, Leaf& leaf) {
    const CompiledEmitter& e = scene_.emitters[leaf.emitter];
    constexpr double in = 1e-3;
    const glm::dvec2 corner[4] = {{in, in}, {1 - in, in}, {1 - in, 1 - in}, {in, 1 - in}};
    bool seen[4];
    int changes = 0;
    for (int i = 0; i < 4; ++i) {
      const EmitterPart part = cells.point_in(leaf.cell, corner[i], 1);
      if (glm::dot(normal_, part.point.position - place_) <= 0) return;  // below the horizon
      seen[i] = sees(e, part);
    }
    for (int i = 0; i < 4; ++i) changes += seen[i] != seen[(i + 1) % 4] ? 1 : 0;
    if (changes != 2) return;
    std::vector<glm::dvec2> outline;  // of the visible part, in order
    glm::dvec2 cut[2];
    int cuts = 0;
    for (int i = 0; i < 4; ++i) {
      const int next = (i + 1) % 4;
      if (seen[i]) outline.push_back(glm::round(corner[i]));
      if (seen[i] == seen[next]) continue;
      const glm::dvec2 at = seen[i] ? edge_between(e, cells, leaf.cell, corner[i], corner[next])
                                    : edge_between(e, cells, leaf.cell, corner[next], corner[i]);
      cut[cuts++] = at;
      outline.push_back(at);
    }
    if (is_straight(e, cells, leaf.cell, cut, outline)) put_part(cells, outline, leaf);
  }

  /// Whether points on either side of an edge, near its middle and its quarters, are visible as the
  /// edge implies.
  bool is_straight(const CompiledEmitter& e, const EmitterCells& cells, const EmitterCell& cell,
                   const glm::dvec2 (&cut)[2], const std::vector<glm::dvec2>& outline) {
    glm::dvec2 middle(0);
    for (const glm::dvec2& p : outline) middle += p / static_cast<double>(outline.size());
    const glm::dvec2 way = cut[1] - cut[0];
    if (!(glm::length(way) > 0)) return false;
    glm::dvec2 inwards = glm::normalize(glm::dvec2(-way.y, way.x));
    if (glm::dot(inwards, middle - cut[0]) < 0) inwards = -inwards;
    for (const double share : {0.25, 0.5, 0.75}) {
      for (const double side : {-1.0, 1.0}) {
        const glm::dvec2 p = cut[0] + share * way + side * limits::edge_width * inwards;
        if (glm::any(glm::lessThan(p, glm::dvec2(0))) ||
            glm::any(glm::greaterThan(p, glm::dvec2(1))))
          continue;
        if (sees(e, cells.point_in(cell, p, 1)) != (side > 0)) return false;
      }
    }
    return true;
  }

  /// The light of a fully visible part of a rectangle's cell.
  void put_part(const EmitterCells& cells, const std::vector<glm::dvec2>& outline, Leaf& leaf) {
    const CompiledEmitter& e = scene_.emitters[leaf.emitter];
    const EmitterCell& cell = leaf.cell;
    const double of_cell =
        static_cast<double>(cell.u1 - cell.u0) * static_cast<double>(cell.v1 - cell.v0);
    const double open = leaf.light.open_lx;
    leaf.light = {};
    leaf.count = 0;
    for (size_t i = 1; i + 1 < outline.size(); ++i) {
      const glm::dvec2 &a = outline[0], &b = outline[i], &c = outline[i + 1];
      const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
      ArrivingLight arriving{.emitter = leaf.emitter};
      // The midpoints of a triangle's sides integrate exactly up to the second power.
      for (const glm::dvec2& uv : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
        const PointLight p = look_at(leaf.emitter, cells.point_in(cell, uv, area * of_cell / 3),
                                     cells.viewpoint().sigma_t, true);
        leaf.light += p.light;
        arriving.direction = p.arriving.direction;
        arriving.illuminance_lx += p.light.illuminance_lx;
        arriving.clear_air_lx += p.light.clear_air_lx;
      }
      leaf.arriving[leaf.count++] = arriving;
    }
    if (is_closed_form(e)) {
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec2& uv : outline)
        polygon.push_back(glm::dvec3(cells.point_in(cell, uv, 1).point.position) -
                          glm::dvec3(place_));
      put_closed_form(e, polygon, true, leaf.light);
    }
    leaf.light.open_lx = open;
    leaf.error_lx = 0;
  }

  /// Replaces the sum over a cell's points. With media only the light in clear air is replaced.
  void put_closed_form(const CompiledEmitter& e, const std::vector<glm::dvec3>& polygon,
                       bool all_above, DirectFromEmitter& light) const {
    const double radiance = lumens_of(e) / (static_cast<double>(pi_f) * e.area_m2);
    const double lux = radiance * projected_solid_angle(polygon, glm::dvec3(normal_));
    light.clear_air_lx = lux;
    if (in_media_) return;
    light.illuminance_lx = light.open_lx = lux;
    if (all_above) light.fluence_lm_m2 = radiance * solid_angle(polygon);
  }

  /// Quarters the cells with the largest possible error until the total is small. Shadow edges
  /// cross cells at arbitrary positions, so their errors add like independent ones.
  void resolve_shadows() {
    double total = 0, squares = 0;
    for (const Leaf& leaf : leaves_) {
      total += leaf.light.illuminance_lx;
      squares += leaf.error_lx * leaf.error_lx;
    }
    const int most = options_.tolerance <= fine ? limits::shadow_splits : limits::shadow_splits / 8;
    const auto may_err_less = [](const Leaf& a, const Leaf& b) { return a.error_lx < b.error_lx; };
    for (int split = 0; split < most; ++split) {
      const double allowed = options_.tolerance * total;
      if (!(squares > allowed * allowed)) return;
      const auto worst = std::max_element(leaves_.begin(), leaves_.end(), may_err_less);
      if (!(worst->error_lx > 0)) return;
      const Leaf old = *worst;
      const CompiledEmitter& e = scene_.emitters[old.emitter];
      const EmitterCells cells(scene_, e, viewpoint(e));
      leaves_.erase(worst);
      total -= old.light.illuminance_lx;
      squares -= old.error_lx * old.error_lx;
      const size_t before = leaves_.size();
      for (const EmitterCell& q : cells.quarters(old.cell)) add_leaf(old.emitter, cells, q);
      for (size_t i = before; i < leaves_.size(); ++i) {
        total += leaves_[i].light.illuminance_lx;
        squares += leaves_[i].error_lx * leaves_[i].error_lx;
      }
    }
  }

  static constexpr double fine = 2e-3;     // up to this tolerance corners are tested, too
  static constexpr double quarter = 0.25;  // error of a cell with a shadow edge, of its light

  const CompiledScene& scene_;
  const Vec3 place_, from_, normal_;
  const DirectOptions options_;
  Resolver& resolver_;
  const bool in_media_;
  std::vector<Leaf> leaves_;
};

/// Light from all emitters at a point [local coordinates] with a normal.
template <class Resolver>
DirectLight direct_light(const CompiledScene& scene, const Vec3& point, const Vec3& normal,
                         const DirectOptions& options, Resolver& resolver) {
  DirectLight out;
  out.illuminance_lx.assign(scene.groups.size(), 0);
  out.fluence_lm_m2.assign(scene.groups.size(), 0);
  const auto by_emitter = DirectSum<Resolver>(scene, point, normal, options, resolver).by_emitter();
  for (size_t i = 0; i < by_emitter.size(); ++i) {
    const auto group = static_cast<size_t>(scene.emitters[i].group);
    out.illuminance_lx[group] += by_emitter[i].illuminance_lx;
    out.fluence_lm_m2[group] += by_emitter[i].fluence_lm_m2;
  }
  return out;
}

}  // namespace luxodus

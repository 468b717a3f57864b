// The participating media of a scene, compiled for tracing: exact optical depth and exact
// free-flight sampling, without step size or bias. Media overlap; their extinctions add.
// Homogeneous and layered media without footprint become one stack of slabs; footprints with a
// polygon become prisms; quadric bodies and data sets stay as they are. Kernels are templates on
// MediaNeed, so that a clear or homogeneous scene has no cost for the rest.
//
// Coordinates are Real, relative to the scene's local origin; optical depths are double. A factor
// of 0 removes a medium's extinction but not its emission; the caller decides by the power whether
// it glows. Immutable once compiled; any thread. Calls may wait where the resolver waits. Design:
// docs/decisions/0030-exact-free-flight.md.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/media_tables.hpp"
#include "scenes/light/optics/media_walk.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

/// Media that the kernels of a scene must support.
enum class MediaNeed {
  none,         // nothing absorbs or scatters
  homogeneous,  // one extinction everywhere
  layered,      // horizontal slabs
  general,      // prisms, bodies, data sets
};

struct MediumInput {
  const Medium* medium;
  double factor;  // the scenario's factor on extinction; 0: absent
  /// Contents of a data set whose arrays, and hence bricks, are not in memory here; else null.
  const BrickTable* table = nullptr;
};

/// [medium][brick]
using MediaBricks = std::vector<std::vector<Brick>>;

/// The value of a spectrum in a band.
using BandAverage = std::function<double(const Spectrum&, int band)>;

class MediaSet {
 public:
  /// An empty set.
  MediaSet();

  /// Errors: a value of a medium that is not finite, negative, out of range or beyond the limits,
  /// with name and place. Media are indexed in the given order; inputs need not outlive the call.
  static Result<MediaSet> compile(std::span<const MediumInput> media, int bands,
                                  const BandAverage& average, const glm::dvec3& local_origin);

  MediaNeed need() const { return need_; }
  int count() const { return count_; }
  int bands() const { return bands_; }

  /// The distinct phase functions; FreeFlight::phase is an index into them.
  const std::vector<Phase>& phases() const { return tables_->phases; }
  const Phase& phase(int i) const { return tables_->phases[static_cast<size_t>(i)]; }

  /// Number of resident bricks of a data set; 0 for other media.
  int brick_count(int medium) const {
    return static_cast<int>((*bricks_)[static_cast<size_t>(medium)].size());
  }
  const Brick& brick(int medium, int index) const {
    return (*bricks_)[static_cast<size_t>(medium)][static_cast<size_t>(index)];
  }
  const std::shared_ptr<const MediaBricks>& bricks() const { return bricks_; }

  /// The emission of a medium; null if it has none.
  const VolumeEmitter* emitter(int medium) const;
  /// Samples a point with density proportional to emission. Requires: emitter(medium) is not null.
  template <class Uniform, class Resolver>
  Vec3 sample_emission_point(int medium, Uniform&& next_uniform, Resolver& resolver) const {
    return emitter(medium)->sample(next_uniform, resolver);
  }
  /// Emission per volume [1/m3], normalised to 1 over the medium. Requires: emitter(medium) is not
  /// null.
  template <class Resolver>
  double emission_density(int medium, const Vec3& p, Resolver& resolver) const {
    BrickReader<Resolver> reader(resolver);
    return emitter(medium)->density(glm::dvec3(p), reader);
  }

  const MediaTables& tables() const { return *tables_; }

 private:
  friend class MediaCompiler;

  MediaNeed need_ = MediaNeed::none;
  int count_ = 0;
  int bands_ = 1;
  std::shared_ptr<const MediaTables> tables_;
  std::shared_ptr<const MediaBricks> bricks_;
};

/// A resolver that returns the set's own bricks.
class ResidentBricks {
 public:
  explicit ResidentBricks(const MediaSet& set) : set_(&set) {}
  const Brick& brick(int medium, int index) const { return set_->brick(medium, index); }

 private:
  const MediaSet* set_;
};

/// The end of a free flight through media.
struct FreeFlight {
  Real t = 0;       // distance flown [m]; t_max without a collision
  int medium = -1;  // the medium that collided
  int phase = -1;   // its phase function
  int component = -1;
  double albedo = 0;  // at that point; double, since 1 - albedo may be 1e-6
  bool collided = false;
};

namespace media_detail {

inline FreeFlight collision_in_stack(const MediaTables& tables, int band, LayerStack::Stop stop,
                                     double choice) {
  const std::span<const int> members = tables.stack.members(stop.slab);
  int chosen = members.front();
  if (members.size() > 1) {
    double rest = choice * tables.stack.sigma_t(band, stop.slab);
    for (const int c : members) {
      const double sigma = tables.sigma_of(band, c);
      if (!(sigma > 0)) continue;
      chosen = c;  // if rounding leaves a rest, the last with extinction is chosen
      if (rest < sigma) break;
      rest -= sigma;
    }
  }
  const MediaComponent& c = tables.component(chosen);
  return {static_cast<Real>(stop.t),      c.medium, c.phase, chosen,
          tables.albedo_of(band, chosen), true};
}

inline FreeFlight flight_in_stack(const MediaTables& tables, int band, const Vec3& origin,
                                  const Vec3& direction, Real t_max, double tau, double choice) {
  const LayerStack::Stop stop =
      tables.stack.fly(band, static_cast<double>(origin.z), static_cast<double>(direction.z),
                       static_cast<double>(t_max), tau);
  if (stop.slab < 0) return {.t = t_max};
  return collision_in_stack(tables, band, stop, choice);
}

template <class Resolver>
FreeFlight flight_in_all(const MediaTables& tables, int band, const Vec3& origin,
                         const Vec3& direction, Real t_max, double tau, double choice,
                         Resolver& resolver) {
  MediaWalk<Resolver> walk(tables, band, origin, direction, static_cast<double>(t_max), resolver);
  if (walk.only_stack()) {
    return flight_in_stack(tables, band, origin, direction, t_max, tau, choice);
  }
  while (walk.next()) {
    if (!(walk.sigma_t() > 0)) continue;
    const double here = walk.sigma_t() * (walk.t1() - walk.t0());
    if (tau < here) {
      const double t = walk.t0() + tau / walk.sigma_t();
      const auto chosen = walk.choose(choice);
      const MediaComponent& c = tables.component(chosen.component);
      return {static_cast<Real>(t), c.medium, c.phase, chosen.component, chosen.albedo, true};
    }
    tau -= here;
  }
  return {.t = t_max};
}

}  // namespace media_detail

/// Samples a free flight: the collision at optical depth `tau`, and its medium, chosen by share of
/// extinction with `choice` in [0, 1). The inversion is exact. Requires: N covers set.need();
/// direction of unit length; t_max >= 0 (infinity allowed); tau >= 0.
template <MediaNeed N, class Resolver>
FreeFlight free_flight(const MediaSet& set, int band, const Vec3& origin, const Vec3& direction,
                       Real t_max, double tau, double choice, [[maybe_unused]] Resolver& resolver) {
  if constexpr (N == MediaNeed::none) {
    return {.t = t_max};
  } else {
    const MediaTables& tables = set.tables();
    if constexpr (N == MediaNeed::homogeneous) {
      const double t = tau / tables.stack.sigma_t(band, 0);
      if (!(t < static_cast<double>(t_max))) return {.t = t_max};
      return media_detail::collision_in_stack(tables, band, {t, 0}, choice);
    } else if constexpr (N == MediaNeed::layered) {
      return media_detail::flight_in_stack(tables, band, origin, direction, t_max, tau, choice);
    } else {
      if (tables.bodies.empty() && tables.grids.empty()) {
        return media_detail::flight_in_stack(tables, band, origin, direction, t_max, tau, choice);
      }
      return media_detail::flight_in_all(tables, band, origin, direction, t_max, tau, choice,
                                         resolver);
    }
  }
}

/// Optical depth from the origin to t_max. Requirements as for free_flight.
template <MediaNeed N, class Resolver>
double optical_depth(const MediaSet& set, int band, const Vec3& origin, const Vec3& direction,
                     Real t_max, [[maybe_unused]] Resolver& resolver) {
  const auto length = static_cast<double>(t_max);
  if constexpr (N == MediaNeed::none) {
    return 0;
  } else {
    const MediaTables& tables = set.tables();
    if constexpr (N == MediaNeed::homogeneous) {
      const double sigma = tables.stack.sigma_t(band, 0);
      return sigma > 0 ? sigma * length : 0;
    } else {
      const bool only_stack =
          N == MediaNeed::layered || (tables.bodies.empty() && tables.grids.empty());
      if (only_stack) {
        return tables.stack.depth(band, static_cast<double>(origin.z),
                                  static_cast<double>(direction.z), length);
      }
      MediaWalk<Resolver> walk(tables, band, origin, direction, length, resolver);
      return walk.depth();
    }
  }
}

/// Optical depths of several bands in one pass: out[i] is that of band of_band(i). Valid for any
/// set.need().
template <class Resolver, class OfBand>
void optical_depths(const MediaSet& set, size_t bands, OfBand&& of_band, const Vec3& origin,
                    const Vec3& direction, Real t_max, Resolver& resolver, double* out) {
  const MediaTables& tables = set.tables();
  const auto length = static_cast<double>(t_max);
  for (size_t i = 0; i < bands; ++i)
    out[i] = tables.stack.depth(of_band(i), static_cast<double>(origin.z),
                                static_cast<double>(direction.z), length);
  if (tables.bodies.empty() && tables.grids.empty()) return;
  using Walk = MediaWalk<Resolver>;
  Walk walk(tables, Walk::no_band, origin, direction, length, resolver);
  walk.for_each_column([&](int component, double amount) {
    for (size_t i = 0; i < bands; ++i) {
      const double sigma = tables.sigma_of(of_band(i), component);
      if (sigma > 0) out[i] += sigma * amount;
    }
  });
}

/// Emission within a segment: a medium, and the mean over the segment of its emission per volume
/// [1/m3], normalised to 1 over the medium.
struct EmissionPart {
  int medium = -1;
  double density = 0;
};

/// A segment of a ray on which extinction, albedo and (except in interpolated flames) emission are
/// constant.
struct MediaSegment {
  Real t0 = 0;
  Real t1 = 0;
  double length = 0;                       // t1 - t0 before rounding
  double sigma_t = 0;                      // [1/m]
  double sigma_s = 0;                      // [1/m]
  std::span<const EmissionPart> emission;  // valid during the visit
};

/// Visits the segments of a ray that absorb, scatter or emit, front to back, until `visit(segment)`
/// returns false. Valid for any set.need().
template <class Resolver, class Visit>
void for_each_segment(const MediaSet& set, int band, const Vec3& origin, const Vec3& direction,
                      Real t_max, Resolver& resolver, Visit&& visit) {
  const MediaTables& tables = set.tables();
  std::array<EmissionPart, limits::max_volume_emitters> parts;
  MediaWalk<Resolver> walk(tables, band, origin, direction, static_cast<double>(t_max), resolver);
  while (walk.next()) {
    size_t n = 0;
    if (!tables.emitters.empty()) {
      walk.for_each_glow([&](int medium, double density) {
        if (n < parts.size()) parts[n++] = {medium, density};
      });
    }
    if (!(walk.sigma_t() > 0) && n == 0) continue;
    const MediaSegment segment{static_cast<Real>(walk.t0()),
                               static_cast<Real>(walk.t1()),
                               walk.t1() - walk.t0(),
                               walk.sigma_t(),
                               walk.sigma_s(),
                               {parts.data(), n}};
    if (!visit(segment)) return;
  }
}

/// Calls each(medium, phase, sigma_t, albedo) for every component that has extinction at a point.
template <class Resolver, class Each>
void for_each_medium_at(const MediaSet& set, int band, const Vec3& point, Resolver& resolver,
                        Each&& each) {
  const MediaTables& tables = set.tables();
  const glm::dvec3 p(point);
  BrickReader<Resolver> bricks(resolver);
  const auto say = [&](int component, double sigma, double albedo) {
    const MediaComponent& c = tables.component(component);
    if (sigma > 0) each(c.medium, c.phase, sigma, albedo);
  };
  const auto say_constant = [&](int c) {
    say(c, tables.sigma_of(band, c), tables.albedo_of(band, c));
  };
  for (const int c : tables.stack.members(tables.stack.slab_at(p.z))) say_constant(c);
  for (const PlacedBody& body : tables.bodies) {
    if (body.quadric >= 0) {
      if (tables.quadrics[static_cast<size_t>(body.quadric)].contains(p))
        say_constant(body.component);
      continue;
    }
    const FootprintPrism& prism = tables.prisms[static_cast<size_t>(body.prism)];
    if (!prism.covers(glm::dvec2(p))) continue;
    for (const LayerStack::Part& part : prism.parts()) {
      if (p.z >= part.z_low && p.z < part.z_high) say_constant(part.component);
    }
  }
  for (const PlacedGrid& placed : tables.grids) {
    const glm::dvec3 local = placed.grid.to_local(p);
    if (!placed.grid.contains_local(local)) continue;
    const glm::ivec3 cell = placed.grid.cell_at(local);
    const double sigma = cell_sigma(placed, tables.sigma_of(band, placed.component), cell, bricks);
    const double albedo =
        cell_albedo(placed, tables.albedo_of(band, placed.component), cell, bricks);
    say(placed.component, sigma, albedo);
  }
}

/// Sum of all extinctions at a point [1/m].
template <class Resolver>
double extinction_at(const MediaSet& set, int band, const Vec3& point, Resolver& resolver) {
  double sum = 0;
  for_each_medium_at(set, band, point, resolver,
                     [&](int, int, double sigma_t, double) { sum += sigma_t; });
  return sum;
}

}  // namespace luxodus

// Cuts a ray through media of all kinds into segments of constant extinction, front to back. A
// segment ends at the nearest of: a slab's boundary, a body's face, a cell's face, the end of the
// ray. Every segment has a length above 0 and every boundary is passed once, so a walk terminates.
// Lives on the stack of one flight, hence on one thread; it may wait where its resolver waits.
#pragma once

#include <array>
#include <limits>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/media_tables.hpp"

namespace luxodus {

template <class Resolver>
class MediaWalk {
 public:
  /// Band of a walk that is used for `for_each_column` only.
  static constexpr int no_band = -1;

  MediaWalk(const MediaTables& tables, int band, const Vec3& origin, const Vec3& direction,
            double t_max, Resolver& resolver)
      : tables_(&tables), band_(band), o_(origin), d_(direction), t_max_(t_max), bricks_(resolver) {
    find_bodies();
    find_grids();
  }

  /// Whether no prism, body or grid is on the ray: the stack alone decides.
  bool only_stack() const { return segments_count_ == 0 && grids_count_ == 0; }

  /// Advances to the next segment; false at the end of the ray.
  bool next();

  double t0() const { return t0_; }
  double t1() const { return t_; }
  double sigma_t() const { return sigma_t_; }

  struct Choice {
    int component = -1;
    double albedo = 0;
  };
  /// Samples the component that collides in the present segment, by share of extinction; u in [0,
  /// 1). Requires: sigma_t() > 0.
  Choice choose(double u);
  /// Scattering coefficient in the present segment [1/m].
  double sigma_s();
  /// Calls part(medium, density) for each emitting medium in the present segment; density is its
  /// mean over the segment [1/m3].
  template <class Part>
  void for_each_glow(Part&& part);

  /// Optical depth of the whole ray; call it before the first next(). Optical depths of media add,
  /// so segments are not merged.
  double depth();

  /// Calls column(component, amount) for what the whole ray passes outside the stack, possibly
  /// several times per component; call it before the first next(). The component's extinction in a
  /// band times the amount is its optical depth. Requires: made with no_band.
  template <class Column>
  void for_each_column(Column&& column);

 private:
  struct BodySegment {
    double t0;
    double t1;
    int component;
  };
  struct GridOnWay {
    GridCursor cursor;
    const PlacedGrid* placed;
    double factor;
    double sigma_t;  // in the present cell
  };

  void find_bodies();
  void find_grids();
  void add_segment(double t0, double t1, int component) {
    // MediaSet::compile bounds the sum of all segments; the check keeps memory safe if that is
    // wrong.
    if (segments_count_ < segments_.size()) {
      segments_[segments_count_++] = {t0, t1, component};
    }
  }
  void advance_grid(GridOnWay& g);
  /// Calls with(depth) for each cell of a grid along the whole ray.
  template <class With>
  void for_each_cell_depth(GridOnWay& g, With&& with);
  void enter_stack();
  void advance_stack();
  /// Calls each(component, sigma_t, grid or null) for everything in the present segment, in a fixed
  /// order.
  template <class Each>
  void for_each_present(Each&& each);

  const MediaTables* tables_;
  int band_;
  glm::dvec3 o_;
  glm::dvec3 d_;
  double t_max_;
  BrickReader<Resolver> bricks_;

  double t0_ = 0;
  double t_ = 0;
  double sigma_t_ = 0;

  bool stack_entered_ = false;
  int slab_ = 0;
  double slab_end_ = 0;
  double rise_inverse_ = 0;

  size_t segments_count_ = 0;
  size_t grids_count_ = 0;
  std::array<BodySegment, limits::max_ray_segments> segments_;
  std::array<GridOnWay, limits::max_grids> grids_;
};

template <class Resolver>
void MediaWalk<Resolver>::find_bodies() {
  const RayInterval way{0, t_max_};
  for (const PlacedBody& body : tables_->bodies) {
    if (inside_box(body.low, body.high, o_, d_, way).empty()) continue;
    if (body.prism >= 0) {
      tables_->prisms[static_cast<size_t>(body.prism)].for_each_segment(
          o_, d_, way,
          [this](double t0, double t1, int component) { add_segment(t0, t1, component); });
      continue;
    }
    RayInterval piece[2];
    const int n =
        tables_->quadrics[static_cast<size_t>(body.quadric)].intervals(o_, d_, way, piece);
    for (int i = 0; i < n; ++i) add_segment(piece[i].t0, piece[i].t1, body.component);
  }
}

template <class Resolver>
void MediaWalk<Resolver>::find_grids() {
  for (const PlacedGrid& placed : tables_->grids) {
    GridOnWay& g = grids_[grids_count_];
    if (!g.cursor.begin(placed.grid, o_, d_, {0, t_max_})) continue;
    g.placed = &placed;
    g.factor = band_ == no_band ? 1 : tables_->sigma_of(band_, placed.component);
    g.sigma_t = 0;
    ++grids_count_;
  }
}

template <class Resolver>
void MediaWalk<Resolver>::advance_grid(GridOnWay& g) {
  g.cursor.advance();
  g.sigma_t = 0;
  if (g.cursor.inside() && !g.cursor.clear()) {
    g.sigma_t = cell_sigma(*g.placed, g.factor, g.cursor.cell(), bricks_);
  }
}

template <class Resolver>
void MediaWalk<Resolver>::enter_stack() {
  stack_entered_ = true;
  slab_ = tables_->stack.slab_at(o_.z);
  rise_inverse_ = 1 / d_.z;
  slab_end_ = std::numeric_limits<double>::infinity();
  if (d_.z > 0) slab_end_ = (tables_->stack.z_high(slab_) - o_.z) * rise_inverse_;
  if (d_.z < 0) slab_end_ = (tables_->stack.z_low(slab_) - o_.z) * rise_inverse_;
}

template <class Resolver>
void MediaWalk<Resolver>::advance_stack() {
  const LayerStack& stack = tables_->stack;
  slab_ += d_.z > 0 ? 1 : -1;
  slab_end_ = ((d_.z > 0 ? stack.z_high(slab_) : stack.z_low(slab_)) - o_.z) * rise_inverse_;
}

template <class Resolver>
bool MediaWalk<Resolver>::next() {
  if (!(t_ < t_max_)) return false;
  if (!stack_entered_) enter_stack();
  while (slab_end_ <= t_) advance_stack();
  double end = std::min(t_max_, slab_end_);
  double sigma = tables_->stack.sigma_t(band_, slab_);
  for (size_t i = 0; i < grids_count_; ++i) {
    GridOnWay& g = grids_[i];
    // Skips cells that rounding leaves without length.
    while (g.cursor.t_end() <= t_) advance_grid(g);
    end = std::min(end, g.cursor.t_end());
    sigma += g.sigma_t;
  }
  for (size_t i = 0; i < segments_count_;) {
    const BodySegment& s = segments_[i];
    if (s.t1 <= t_) {
      segments_[i] = segments_[--segments_count_];
      continue;
    }
    if (s.t0 <= t_) {
      sigma += tables_->sigma_of(band_, s.component);
      end = std::min(end, s.t1);
    } else {
      end = std::min(end, s.t0);
    }
    ++i;
  }
  t0_ = t_;
  t_ = end;
  sigma_t_ = sigma;
  return true;
}

template <class Resolver>
template <class Each>
void MediaWalk<Resolver>::for_each_present(Each&& each) {
  for (const int c : tables_->stack.members(slab_)) {
    each(c, tables_->sigma_of(band_, c), static_cast<GridOnWay*>(nullptr));
  }
  for (size_t i = 0; i < grids_count_; ++i) {
    GridOnWay& g = grids_[i];
    if (g.cursor.inside() && !g.cursor.clear()) each(g.placed->component, g.sigma_t, &g);
  }
  for (size_t i = 0; i < segments_count_; ++i) {
    const BodySegment& s = segments_[i];
    if (s.t0 <= t0_) {
      each(s.component, tables_->sigma_of(band_, s.component), static_cast<GridOnWay*>(nullptr));
    }
  }
}

template <class Resolver>
typename MediaWalk<Resolver>::Choice MediaWalk<Resolver>::choose(double u) {
  double rest = u * sigma_t_;
  int chosen = -1;
  GridOnWay* chosen_grid = nullptr;
  bool found = false;
  for_each_present([&](int component, double sigma, GridOnWay* grid) {
    if (found || !(sigma > 0)) return;
    chosen = component;  // if rounding leaves a rest, the last with extinction is chosen
    chosen_grid = grid;
    found = rest < sigma;
    rest -= sigma;
  });
  const double constant = tables_->albedo_of(band_, chosen);
  if (chosen_grid == nullptr) return {chosen, constant};
  return {chosen, cell_albedo(*chosen_grid->placed, constant, chosen_grid->cursor.cell(), bricks_)};
}

template <class Resolver>
double MediaWalk<Resolver>::sigma_s() {
  double sum = 0;
  for_each_present([&](int component, double sigma, GridOnWay* grid) {
    if (!(sigma > 0)) return;
    double albedo = tables_->albedo_of(band_, component);
    if (grid != nullptr) albedo = cell_albedo(*grid->placed, albedo, grid->cursor.cell(), bricks_);
    sum += sigma * albedo;
  });
  return sum;
}

template <class Resolver>
template <class Part>
void MediaWalk<Resolver>::for_each_glow(Part&& part) {
  for_each_present([&](int component, double, GridOnWay* grid) {
    const MediaComponent& c = tables_->component(component);
    if (c.emitter < 0) return;
    const VolumeEmitter& emitter = tables_->emitters[static_cast<size_t>(c.emitter)];
    const double density = grid != nullptr ? emitter.mean_density(grid->cursor, t0_, t_, bricks_)
                                           : 1 / emitter.volume_m3();
    if (density > 0) part(c.medium, density);
  });
}

template <class Resolver>
double MediaWalk<Resolver>::depth() {
  double sum = tables_->stack.depth(band_, o_.z, d_.z, t_max_);
  for (size_t i = 0; i < segments_count_; ++i) {
    const BodySegment& s = segments_[i];
    const double sigma = tables_->sigma_of(band_, s.component);
    if (sigma > 0) sum += sigma * (s.t1 - s.t0);
  }
  for (size_t i = 0; i < grids_count_; ++i) {
    GridOnWay& g = grids_[i];
    if (g.factor == 0) continue;
    for_each_cell_depth(g, [&](double depth) { sum += depth; });
  }
  return sum;
}

template <class Resolver>
template <class Column>
void MediaWalk<Resolver>::for_each_column(Column&& column) {
  for (size_t i = 0; i < segments_count_; ++i)
    column(segments_[i].component, segments_[i].t1 - segments_[i].t0);
  for (size_t i = 0; i < grids_count_; ++i) {
    double sum = 0;
    for_each_cell_depth(grids_[i], [&](double depth) { sum += depth; });
    column(grids_[i].placed->component, sum);
  }
}

template <class Resolver>
template <class With>
void MediaWalk<Resolver>::for_each_cell_depth(GridOnWay& g, With&& with) {
  double t = 0;
  while (g.cursor.t_end() < std::numeric_limits<double>::infinity()) {
    const double end = std::max(t, g.cursor.t_end());
    with(g.sigma_t * (end - t));
    t = end;
    advance_grid(g);
  }
}

}  // namespace luxodus

// The error bound of a cell comes from what changes within it. Light that all its points see alike
// is smooth: the rule's error is at most the square of a single point's. Where the visible share of
// an emitter differs between points, a shadow's edge crosses the cell, and a quarter of that light
// is uncertain; the edges of several emitters' shadows are independent. Along one edge errors may
// be correlated, so those of cells are added. Corners reveal edges that pass beside the four
// points: those of quarters are always evaluated, those of whole cells only if a neighbour sees
// other emitters.
#include "actors/results/files/plane_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "runtime/core/hash.hpp"
#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace {

constexpr double gauss[2] = {0.2113248654051871, 0.7886751345948129};
/// How far inside a cell its corners are evaluated, as a share of its edge: on the edge they may
/// touch a wall.
constexpr double inset = 0.01;
/// Share of the light that becomes visible within a cell by which its mean may err.
constexpr double edge_share = 0.25;
/// Quarters narrower than this share of their cell are not divided: float hardly resolves their
/// points.
constexpr double narrowest = 0x1p-10;
/// Tolerance at points whose mean is taken.
constexpr double averaged_tolerance = 1e-2;

/// A piece of a cell; edges as shares of the plane's.
struct Piece {
  uint32_t cell = 0;
  double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
  double share() const { return (u1 - u0) * (v1 - v0); }
};

/// Mean light over a piece, and the bound of its error.
struct PieceLight {
  double lx = 0, clear_lx = 0;
  double error_lx = 0, error_clear_lx = 0;
  /// Light by source group, with media, then in clear air; kept only while needed, and only if
  /// there are several groups.
  std::vector<double> groups;
  /// What all its points see of each emitter: kept for quarters, which then evaluate only the
  /// others.
  std::vector<KnownSight> known;

  /// Whether the error is too small to refine.
  bool is_settled() const {
    return error_lx <= settled * lx && error_clear_lx <= settled * clear_lx;
  }
  static constexpr double settled = 0.1 * limits::plane_tolerance;
};

struct Leaf {
  Piece piece;
  PieceLight light;
};

using Lights = std::vector<DirectFromEmitter>;

/// Evaluates the points of one plane; each thread has a copy.
class PlanePoints {
 public:
  PlanePoints(const CompiledScene& scene, size_t index, const GeometryAccess& access)
      : scene_(scene),
        plane_(scene.description->planes[index]),
        normal_(scene.planes[index].normal),
        access_(access) {}

  glm::dvec3 place(double u, double v) const {
    return plane_.corner + plane_.edge_u * u + plane_.edge_v * v;
  }
  Lights look(double u, double v, double tolerance, std::span<const KnownSight> known = {}) const {
    DirectOptions options;
    options.tolerance = tolerance;
    options.known = known;
    return direct_lights(scene_, access_, Vec3(place(u, v) - scene_.local_origin), normal_,
                         options);
  }

  /// Mean of a whole cell, whose centre is given.
  PieceLight mean(const Piece& piece, const Lights& centre) const {
    std::vector<Lights> points = rule_points(piece, {});
    PieceLight out = sum_of(points);
    points.push_back(centre);
    add_errors(points, out);
    return out;
  }

  /// Mean including corners. `known`: from the surrounding points.
  PieceLight mean(const Piece& piece, std::span<const KnownSight> known) const {
    std::vector<Lights> points = rule_points(piece, known);
    PieceLight out = sum_of(points);
    points.push_back(in(piece, 0.5, 0.5, known));
    for (const double v : {inset, 1 - inset})
      for (const double u : {inset, 1 - inset}) points.push_back(in(piece, u, v, known));
    add_errors(points, out);
    out.known = known_of(points);
    return out;
  }

  double clear_of(const Lights& lights) const {
    double sum = 0;
    for (size_t e = 0; e < lights.size(); ++e)
      if (is_luminaire(scene_.emitters[e])) sum += lights[e].clear_air_lx;
    return sum;
  }

 private:
  /// Light at a place of a piece, u and v from 0 to 1.
  Lights in(const Piece& piece, double u, double v, std::span<const KnownSight> known) const {
    return look(piece.u0 + u * (piece.u1 - piece.u0), piece.v0 + v * (piece.v1 - piece.v0),
                averaged_tolerance, known);
  }
  std::vector<Lights> rule_points(const Piece& piece, std::span<const KnownSight> known) const {
    std::vector<Lights> points;
    for (const double v : gauss)
      for (const double u : gauss) points.push_back(in(piece, u, v, known));
    return points;
  }

  /// Emitters that all points see whole, or not at all.
  static std::vector<KnownSight> known_of(const std::vector<Lights>& points) {
    std::vector<KnownSight> known(points.front().size(), KnownSight::nothing);
    for (size_t e = 0; e < known.size(); ++e) {
      bool whole = true, hidden = true;
      for (const Lights& lights : points) {
        whole &= lights[e].open_lx > 0 && lights[e].illuminance_lx == lights[e].open_lx;
        hidden &= !(lights[e].illuminance_lx > 0);
      }
      if (whole || hidden) known[e] = whole ? KnownSight::clear : KnownSight::hidden;
    }
    return known;
  }

  PieceLight sum_of(const std::vector<Lights>& points) const {
    const size_t groups = scene_.groups.size();
    const double share = 1 / static_cast<double>(points.size());
    PieceLight out;
    out.groups.assign(2 * groups, 0);
    for (const Lights& lights : points) {
      for (size_t e = 0; e < lights.size(); ++e) {
        const auto g = static_cast<size_t>(scene_.emitters[e].group);
        const double clear = is_luminaire(scene_.emitters[e]) ? lights[e].clear_air_lx : 0;
        out.lx += share * lights[e].illuminance_lx;
        out.clear_lx += share * clear;
        out.groups[g] += share * lights[e].illuminance_lx;
        out.groups[groups + g] += share * clear;
      }
    }
    return out;
  }

  /// The first four points are those of the rule, the fifth is the centre.
  void add_errors(const std::vector<Lights>& points, PieceLight& out) const {
    double open_mean = 0, open_centre = 0;
    double squares = 0, clear_squares = 0;
    for (size_t e = 0; e < points.front().size(); ++e) {
      double low = 1, high = 0, open = 0, clear = 0;
      for (const Lights& lights : points) {
        const DirectFromEmitter& light = lights[e];
        if (!(light.open_lx > 0)) continue;
        const double seen = light.illuminance_lx / light.open_lx;
        low = std::min(low, seen);
        high = std::max(high, seen);
        open = std::max(open, light.open_lx);
        if (seen > 0) clear = std::max(clear, light.clear_air_lx / seen);
      }
      if (!(high > 0)) continue;
      for (size_t p = 0; p < 4; ++p) open_mean += 0.25 * points[p][e].open_lx;
      open_centre += points[4][e].open_lx;
      if (!(high - low > same_share)) continue;
      const double at_stake = edge_share * (high - low) * open;
      const double clear_at_stake = edge_share * (high - low) * clear;
      squares += at_stake * at_stake;
      if (is_luminaire(scene_.emitters[e])) clear_squares += clear_at_stake * clear_at_stake;
    }
    out.error_lx = std::sqrt(squares);
    out.error_clear_lx = std::sqrt(clear_squares);
    if (!(open_mean > 0)) return;
    const double change = std::abs(open_mean - open_centre) / open_mean;
    const double smooth = change * std::min(1.0, 4 * change);
    out.error_lx += smooth * out.lx;
    out.error_clear_lx += smooth * out.clear_lx;
  }

  /// Visible shares that differ by less are equal but for rounding.
  static constexpr double same_share = 1e-3;

  const CompiledScene& scene_;
  const PlaneMeasure& plane_;
  const Vec3 normal_;
  const GeometryAccess access_;
};

/// Hash of which emitters are seen whole, in part, or not at all.
uint64_t sight_hash(const Lights& lights) {
  Hasher hash;
  for (size_t e = 0; e < lights.size(); ++e) {
    const double seen = lights[e].open_lx > 0 ? lights[e].illuminance_lx / lights[e].open_lx : 0;
    if (seen > 0) hash.add(uint64_t{2 * e + (seen > 0.999 ? 1 : 0)});
  }
  return hash.value();
}

class PlaneQuadrature {
 public:
  PlaneQuadrature(const CompiledScene& scene, size_t index, const ParallelFor& runner,
                  const std::vector<char>& left_out)
      : scene_(scene),
        index_(index),
        runner_(runner),
        left_out_(left_out),
        columns_(static_cast<size_t>(scene.description->planes[index].cells_u)),
        rows_(static_cast<size_t>(scene.description->planes[index].cells_v)),
        groups_(scene.groups.size()) {}

  PlaneLight compute(const ParallelFor::Finished& finished) {
    look_at_cells(finished);
    look_at_corners();
    quarter_the_worst();
    return finish();
  }

 private:
  struct ErrorBounds {
    double lx = 0, clear_lx = 0;
  };

  size_t cells() const { return columns_ * rows_; }
  bool is_left_out(size_t cell) const { return !left_out_.empty() && left_out_[cell] != 0; }
  /// Share of all cells that means are taken over.
  double share_in() const {
    const auto out =
        std::count_if(left_out_.begin(), left_out_.end(), [](char c) { return c != 0; });
    return 1 - static_cast<double>(out) / static_cast<double>(cells());
  }
  Piece piece_of(size_t cell) const {
    const auto u = static_cast<double>(cell % columns_), v = static_cast<double>(cell / columns_);
    const auto nu = static_cast<double>(columns_), nv = static_cast<double>(rows_);
    return {static_cast<uint32_t>(cell), u / nu, v / nv, (u + 1) / nu, (v + 1) / nv};
  }

  void look_at_cells(const ParallelFor::Finished& finished) {
    out_.centres.resize(cells());
    for (std::vector<double>* lux :
         {&out_.point_lx, &out_.point_clear_lx, &out_.mean_lx, &out_.mean_clear_lx})
      lux->resize(cells());
    sight_.resize(cells());
    group_rows_.assign(rows_ * 2 * groups_, 0);
    row_leaves_.resize(rows_);
    const auto make = [&](const GeometryAccess& access) {
      return [this, points = PlanePoints(scene_, index_, access)](int64_t row) {
        for (size_t u = 0; u < columns_; ++u) look_at_cell(points, static_cast<size_t>(row), u);
      };
    };
    runner_.run(static_cast<int64_t>(rows_), make, finished);
    for (std::vector<Leaf>& row : row_leaves_) {
      leaves_.insert(leaves_.end(), row.begin(), row.end());
      row = {};
    }
  }

  void look_at_cell(const PlanePoints& points, size_t row, size_t column) {
    const size_t cell = row * columns_ + column;
    const Piece piece = piece_of(cell);
    const double u = (piece.u0 + piece.u1) / 2, v = (piece.v0 + piece.v1) / 2;
    out_.centres[cell] = points.place(u, v);
    if (is_left_out(cell)) return;
    const Lights centre = points.look(u, v, DirectOptions{}.tolerance);
    for (const DirectFromEmitter& light : centre) out_.point_lx[cell] += light.illuminance_lx;
    out_.point_clear_lx[cell] = points.clear_of(centre);
    sight_[cell] = sight_hash(centre);
    PieceLight light = points.mean(piece, centre);
    out_.mean_lx[cell] = light.lx;
    out_.mean_clear_lx[cell] = light.clear_lx;
    for (size_t g = 0; g < 2 * groups_; ++g)
      group_rows_[row * 2 * groups_ + g] += light.groups[g] * piece.share();
    light.groups = {};
    row_leaves_[row].push_back({piece, std::move(light)});
  }

  bool neighbour_sees_others(size_t cell) const {
    const size_t u = cell % columns_, v = cell / columns_;
    for (size_t y = v > 0 ? v - 1 : 0; y <= std::min(v + 1, rows_ - 1); ++y)
      for (size_t x = u > 0 ? u - 1 : 0; x <= std::min(u + 1, columns_ - 1); ++x)
        if (sight_[y * columns_ + x] != sight_[cell]) return true;
    return false;
  }

  /// Evaluates corners of cells next to which other emitters are seen.
  void look_at_corners() {
    std::vector<char> doubtful(cells(), 0);
    for (size_t cell = 0; cell < cells(); ++cell) doubtful[cell] = neighbour_sees_others(cell);
    sight_ = {};
    std::vector<Leaf> all, again;
    std::swap(all, leaves_);
    for (const Leaf& leaf : all) {
      if (doubtful[leaf.piece.cell] != 0)
        again.push_back(leaf);
      else
        keep(leaf);
    }
    measure(again);
    for (Leaf& leaf : again) {
      leaf.light.known = {};  // for all cells they would take too much memory
      keep(leaf);
    }
  }

  /// Puts a leaf among those to be quartered, or settles it.
  void keep(Leaf& leaf) {
    leaf.light.groups = {};
    keep(std::as_const(leaf));
  }
  void keep(const Leaf& leaf) {
    if (leaf.light.is_settled()) {
      settled_.lx += leaf.light.error_lx * leaf.piece.share();
      settled_.clear_lx += leaf.light.error_clear_lx * leaf.piece.share();
    } else {
      leaves_.push_back(leaf);
    }
  }

  void measure(std::vector<Leaf>& leaves) const {
    const auto make = [&](const GeometryAccess& access) {
      return [&leaves, points = PlanePoints(scene_, index_, access)](int64_t i) {
        Leaf& leaf = leaves[static_cast<size_t>(i)];
        leaf.light = points.mean(leaf.piece, std::vector<KnownSight>(std::move(leaf.light.known)));
      };
    };
    runner_.run(static_cast<int64_t>(leaves.size()), make, {});
  }

  ErrorBounds bounds() const {
    ErrorBounds sum = settled_;
    for (const Leaf& leaf : leaves_) {
      sum.lx += leaf.light.error_lx * leaf.piece.share();
      sum.clear_lx += leaf.light.error_clear_lx * leaf.piece.share();
    }
    return sum;
  }

  /// Share of the allowed error that a leaf takes, for the mean that is worse off.
  double weight_of(const Leaf& leaf, const ErrorBounds& allowed) const {
    const double cell_edge = 1 / static_cast<double>(columns_);
    if (leaf.piece.u1 - leaf.piece.u0 < narrowest * cell_edge) return 0;
    double weight = 0;
    if (allowed.lx > 0) weight = leaf.light.error_lx / allowed.lx;
    if (allowed.clear_lx > 0)
      weight = std::max(weight, leaf.light.error_clear_lx / allowed.clear_lx);
    return weight * leaf.piece.share();
  }

  void quarter_the_worst() {
    const double share = 1 / static_cast<double>(cells());
    const auto sum = [&](const std::vector<double>& lux) {
      return std::accumulate(lux.begin(), lux.end(), 0.0) * share;
    };
    const ErrorBounds allowed{limits::plane_tolerance * sum(out_.mean_lx),
                              limits::plane_tolerance * sum(out_.mean_clear_lx)};
    int64_t left = std::min(
        limits::max_plane_splits,
        limits::plane_splits + limits::plane_splits_per_cell * static_cast<int64_t>(cells()));
    if (!scene_.volume_points.empty()) left /= limits::plane_splits_by_flames;
    while (left > 0) {
      const ErrorBounds now = bounds();
      if (now.lx <= allowed.lx && now.clear_lx <= allowed.clear_lx) return;
      const std::vector<size_t> worst = choose(allowed, static_cast<size_t>(left));
      if (worst.empty()) return;
      left -= static_cast<int64_t>(worst.size());
      quarter(worst);
    }
  }

  /// Chooses the leaves with the largest errors, until the rest errs by half of what is allowed.
  std::vector<size_t> choose(const ErrorBounds& allowed, size_t most) const {
    std::vector<double> weight;
    for (const Leaf& leaf : leaves_) weight.push_back(weight_of(leaf, allowed));
    std::vector<size_t> order(leaves_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return weight[a] > weight[b]; });
    double rest = std::accumulate(weight.begin(), weight.end(), 0.0);
    size_t n = 0;
    for (; n < std::min(most, order.size()) && rest > 0.5 && weight[order[n]] > 0; ++n)
      rest -= weight[order[n]];
    order.resize(n);
    std::sort(order.begin(), order.end());
    return order;
  }

  void quarter(const std::vector<size_t>& worst) {
    // What a leaf gave to each source group, and what it sees, is computed again if it was not
    // kept.
    std::vector<Leaf> parents, quarters;
    for (const size_t i : worst) parents.push_back(leaves_[i]);
    const bool all = groups_ > 1;
    std::vector<Leaf> again;
    for (const Leaf& leaf : parents)
      if (all || leaf.light.known.empty()) again.push_back(leaf);
    measure(again);
    for (size_t i = 0, k = 0; i < parents.size(); ++i)
      if (all || parents[i].light.known.empty()) parents[i] = std::move(again[k++]);
    for (const Leaf& parent : parents) {
      const Piece& p = parent.piece;
      const double u = (p.u0 + p.u1) / 2, v = (p.v0 + p.v1) / 2;
      for (const Piece& quarter :
           {Piece{p.cell, p.u0, p.v0, u, v}, Piece{p.cell, u, p.v0, p.u1, v},
            Piece{p.cell, p.u0, v, u, p.v1}, Piece{p.cell, u, v, p.u1, p.v1}}) {
        quarters.push_back({quarter, {}});
        quarters.back().light.known = parent.light.known;
      }
    }
    measure(quarters);
    std::vector<char> gone(leaves_.size(), 0);
    for (const size_t i : worst) gone[i] = 1;
    std::vector<Leaf> old;
    std::swap(old, leaves_);
    for (size_t i = 0; i < old.size(); ++i)
      if (gone[i] == 0) leaves_.push_back(std::move(old[i]));
    for (const Leaf& leaf : parents) take(leaf, -1);
    for (Leaf& leaf : quarters) {
      take(leaf, 1);
      keep(leaf);
    }
  }

  /// Adds a leaf's light to the means, or removes it.
  void take(const Leaf& leaf, double sign) {
    const double of_cell = sign * leaf.piece.share() * static_cast<double>(cells());
    out_.mean_lx[leaf.piece.cell] += of_cell * leaf.light.lx;
    out_.mean_clear_lx[leaf.piece.cell] += of_cell * leaf.light.clear_lx;
    if (groups_ == 1) {
      group_rows_[0] += sign * leaf.piece.share() * leaf.light.lx;
      group_rows_[1] += sign * leaf.piece.share() * leaf.light.clear_lx;
    }
    for (size_t g = 0; groups_ > 1 && g < 2 * groups_; ++g)
      group_rows_[g] += sign * leaf.piece.share() * leaf.light.groups[g];
  }

  PlaneLight finish() {
    const ErrorBounds last = bounds();
    // Shares refer to all cells, means to those that are not left out; without any, nothing is
    // known.
    const double over = 1 / share_in();
    out_.bound_lx = last.lx * over;
    out_.bound_clear_lx = last.clear_lx * over;
    out_.group_lx.assign(groups_, 0);
    out_.group_clear_lx.assign(groups_, 0);
    for (size_t row = 0; row < rows_; ++row) {
      for (size_t g = 0; g < groups_; ++g) {
        out_.group_lx[g] += group_rows_[row * 2 * groups_ + g] * over;
        out_.group_clear_lx[g] += group_rows_[row * 2 * groups_ + groups_ + g] * over;
      }
    }
    for (std::vector<double>* means : {&out_.mean_lx, &out_.mean_clear_lx})
      for (double& lux : *means) lux = std::max(0.0, lux);  // rounding may leave less than zero
    for (size_t cell = 0; cell < cells(); ++cell)
      if (is_left_out(cell))
        out_.point_lx[cell] = out_.point_clear_lx[cell] = out_.mean_lx[cell] =
            out_.mean_clear_lx[cell] = std::nan("");
    return std::move(out_);
  }

  const CompiledScene& scene_;
  const size_t index_;
  const ParallelFor& runner_;
  const std::vector<char>& left_out_;
  const size_t columns_, rows_, groups_;
  PlaneLight out_;
  std::vector<uint64_t> sight_;
  std::vector<double> group_rows_;  // [row][2 * groups]; quarters' changes are in the first
  std::vector<std::vector<Leaf>> row_leaves_;
  std::vector<Leaf> leaves_;
  ErrorBounds settled_;  // errors of leaves that are not refined
};

}  // namespace

PlaneLight plane_light(const CompiledScene& scene, size_t index, const ParallelFor& runner,
                       const ParallelFor::Finished& finished, const std::vector<char>& left_out) {
  return PlaneQuadrature(scene, index, runner, left_out).compute(finished);
}

}  // namespace luxodus

// Which emitters light a place, as far as the cell of space around it tells: learned by a few
// shadow rays from places in the cell to points of each emitter, which know walls, the directions
// in which luminaires send their light, and smoke on the way. Pictures choose emitters by it
// (emitter_choice.hpp); what it errs by costs paths, never truth. A cell is learned when somebody
// first asks, from random numbers of its own, so it is the same whoever asks and when. Any thread;
// suspends where the resolver does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/glow_guide.hpp"
#include "scenes/transport/learned_cells.hpp"

namespace luxodus {

namespace limits {
/// Emitters that are asked from a cell: those of the most power over squared distance.
inline constexpr size_t asked_emitters = 256;
/// Of each: with half as many, emitters that a part of a cell sees are missed too often.
inline constexpr int sight_rays = 16;
/// An emitter that no ray has met may still be seen from somewhere in the cell: it counts as so
/// much of the light that would arrive without walls, through smoke as it is.
inline constexpr double unseen_share = 0.1;
/// The same of one that has sent nothing towards them, as of light that goes everywhere [1/sr].
inline constexpr double least_arriving = 0.03 / (4 * 3.14159265358979324);
/// Light of an emitter, of that of all, below which nobody asks whether it is hidden.
inline constexpr double looked_at_share = 1e-3;
/// Emitters of a cell that are weighed at each place of it: those of more than a share, and at most
/// so many.
inline constexpr size_t bright_emitters = 32;
inline constexpr double bright_share = 3e-3;
/// Share of the choices in a cell, as a whole, that go by what arrives there; the rest go by power.
inline constexpr double cell_choice = 0.9;
/// Memory of all cells when each has been learned [bytes]: where it would be more, cells are
/// larger. All count from the start, since which are learned first depends on the order of threads.
inline constexpr uint64_t sight_bytes = uint64_t{256} << 20;
}  // namespace limits

/// What is known of all emitters from the places of a cell.
struct CellSight {
  struct Bright {
    uint32_t emitter = 0;
    /// Root mean square over the cell of what arrives of a watt, without the inverse square [1/sr].
    double arriving = 0;
  };
  std::vector<Bright> bright;  // by number
  /// Of all emitters asked, by number, what arrives in the cell: sums up to each, the last is 1.
  std::vector<uint32_t> asked;
  std::vector<float> cumulative;
  double by_cell = 1;  // share of the choices by `cumulative`; the rest are by power alone

  /// What arrives of a watt of an emitter, as of `Bright`; 0 of one that is not bright here.
  double arriving_of(uint32_t emitter) const {
    for (const Bright& b : bright)
      if (b.emitter == emitter) return b.arriving;
    return 0;
  }
};

class EmitterSight {
 public:
  /// Requires: the scene outlives this.
  explicit EmitterSight(const CompiledScene& scene);

  /// Memory that it takes at most, when every cell has been learned [bytes].
  static uint64_t most_bytes(const CompiledScene& scene);

  template <class Resolver>
  const CellSight& at(const Vec3& place, Resolver& resolver) const {
    return cells_.at(place, [&](size_t cell) { return learn(cell, resolver); });
  }

 private:
  /// Of the random numbers of pictures: their paths have part 0.
  static constexpr uint32_t sight_part = 1;

  /// Of one emitter, over the rays of a cell.
  struct Asked {
    uint32_t emitter = 0;
    double over_square = 0;  // power over squared distance, as from the cell's middle
    double open = 0;         // root mean square of what would arrive of a watt
    double arriving = 0;     // of what arrives
    double light(double of) const { return over_square * of; }
  };

  std::vector<Asked> candidates(const Vec3& middle) const;
  CellSight conclude(std::vector<Asked> asked) const;

  template <class Resolver>
  CellSight learn(size_t cell, Resolver& resolver) const {
    std::vector<Asked> asked =
        candidates(cells_.grid().low_of(cell) + Vec3(0.5_r * cells_.grid().edge()));
    Random random(0, RandomStream::picture, sight_part);
    double all = 0;
    for (Asked& a : asked) {
      random.start(uint64_t{cell} * scene_.emitters.size() + a.emitter);
      look_openly(cell, a, random, resolver);
      all += a.light(a.open);
    }
    for (Asked& a : asked) {
      a.arriving = limits::unseen_share * a.open;
      if (!(a.light(a.open) > limits::looked_at_share * all)) continue;
      random.start(uint64_t{cell} * scene_.emitters.size() + a.emitter);
      look(cell, a, random, resolver);
    }
    return conclude(std::move(asked));
  }

  /// Calls ray(connection, density) for rays from the cell to an emitter.
  template <class Resolver, class OfRay>
  void for_each_ray(size_t cell, uint32_t emitter, Random& random, Resolver& resolver,
                    OfRay&& of_ray) const {
    const CompiledEmitter& e = scene_.emitters[emitter];
    const Vec3 low = cells_.grid().low_of(cell);
    for (int i = 0; i < limits::sight_rays; ++i) {
      const Real x = random.uniform();
      const Real y = random.uniform();
      const Real z = random.uniform();
      const EmissionPoint point = emission_point(scene_, e, random, resolver);
      const ShadowRay c = connect(scene_, low + Vec3(x, y, z) * cells_.grid().edge(),
                                  point.position, point.axis, e.kind != EmitterKind::volume);
      if (!(c.distance > 0)) continue;
      const auto density =
          static_cast<double>(directional_density(e, point, -c.ray.direction, resolver));
      if (density > 0) of_ray(c, density);
    }
  }

  template <class Resolver>
  void look_openly(size_t cell, Asked& a, Random& random, Resolver& resolver) const {
    double squares = 0;
    for_each_ray(cell, a.emitter, random, resolver,
                 [&](const ShadowRay&, double density) { squares += density * density; });
    a.open = std::max(limits::least_arriving, std::sqrt(squares / limits::sight_rays));
  }

  template <class Resolver>
  void look(size_t cell, Asked& a, Random& random, Resolver& resolver) const {
    double squares = 0, unseen = 0;
    for_each_ray(cell, a.emitter, random, resolver, [&](const ShadowRay& c, double density) {
      const double sent =
          density * medium_transmittance(scene_, c.ray, c.distance, band_, resolver);
      unseen += sent * sent;
      if (sent > 0 && passes_solids(scene_, c.ray, c.ray.length, resolver,
                                    [](const CompiledMaterial&, Real) {}))
        squares += sent * sent;
    });
    const double least = limits::unseen_share * limits::unseen_share * unseen;
    a.arriving = std::max(limits::unseen_share * limits::least_arriving,
                          std::sqrt(std::max(squares, least) / limits::sight_rays));
  }

  const CompiledScene& scene_;
  int band_ = 0;               // of the most lumens a watt
  std::vector<double> power_;  // of each emitter, in all bands, by how they look
  std::vector<EmitterBound> bounds_;
  LearnedCells<CellSight> cells_;
};

}  // namespace luxodus

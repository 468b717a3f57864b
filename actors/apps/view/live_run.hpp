// The light of one state of a live building, source group by source group: each is traced up to its
// goal, and light of an earlier state is reused where it still holds. Thread rule: one thread,
// which has an executor trace batches.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "actors/apps/view/bin_map.hpp"
#include "actors/results/run/executor.hpp"
#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/readout.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

/// The state whose light a group shows.
///
///   none ----traced----> own <----caught up---- before
///                         |                       ^
///                         +---- geometry moves ---+      (in the run that follows)
enum class ShownLight : uint8_t {
  none,    // no light yet
  own,     // of the present building
  before,  // of the building before geometry moved: approximate
};

class LiveRun {
 public:
  /// Reuses light of `before`, which may be null: in the same air that of groups with the same
  /// emitters; if the geometry differs, as light of before. Errors (exception): geometry that is
  /// not available.
  LiveRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
          const LiveRun* before, bool same_air);

  /// Whether triangles and their patches are those of `before`.
  bool same_geometry() const { return same_geometry_; }
  /// Maps patches to those of `before`; none if they belong to another building.
  const std::optional<BinMap>& bins() const { return bins_; }

  /// Which groups are traced: those without light, those without own light, all.
  enum class Scope { fresh, own, all };
  /// Traces batches until groups have the number that a level asks for: each its share of `level`
  /// times the groups. True when they have them; false when `stop` returns soon, which lets batches
  /// in progress finish, or now; any thread may call it. `tick` is called about four times a
  /// second, from one thread at a time.
  enum class Stop { none, soon, now };
  bool trace(int64_t level, Scope scope, Executor& executor, const std::function<Stop()>& stop,
             const std::function<void()>& tick);

  /// Groups of a scope with batches since the last tell(), and own light to show: if they show
  /// light of before, only once their own has caught up.
  std::vector<int> news(Scope scope = Scope::all) const;
  /// From now on these groups show their own current light.
  void tell(const std::vector<int>& groups);

  /// Makes all own light news again, because the viewers now show another state.
  void tell_anew() { std::fill(told_.begin(), told_.end(), 0); }
  /// Memory of its totals.
  size_t bytes() const { return own_->totals.bytes(); }

  ShownLight light(int group) const { return lights_[static_cast<size_t>(group)]; }
  const std::vector<ShownLight>& lights() const { return lights_; }
  int64_t groups_with(ShownLight light) const;
  /// Totals that hold a group's shown light, its own or that of before.
  const Totals& shown(int group) const {
    const auto& before = before_[static_cast<size_t>(group)];
    return before ? before->totals : own_->totals;
  }
  double worst_relative_error() const {
    return Readout(*scene_, own_->totals).worst_relative_error();
  }
  int64_t particles() const;
  double seconds() const;

  const CompiledScene& scene() const { return *scene_; }
  const std::shared_ptr<const CompiledScene>& shared_scene() const { return scene_; }
  const SceneIndex& index() const { return geometry_->index; }
  const ParallelFor& rows() const { return rows_; }

 private:
  /// Search structures, and the data they refer to.
  struct Geometry {
    explicit Geometry(std::shared_ptr<const CompiledScene> of)
        : scene(std::move(of)), index(device, *scene) {}
    std::shared_ptr<const CompiledScene> scene;
    EmbreeDevice device;
    SceneIndex index;
  };
  /// Results of batches. Runs share them instead of copying them: they may be gigabytes.
  struct TracedTotals {
    explicit TracedTotals(std::shared_ptr<const CompiledScene> of)
        : scene(std::move(of)),
          totals(scene->layout, static_cast<int>(scene->groups.size()), photopic_weights(*scene)) {}
    std::shared_ptr<const CompiledScene> scene;  // the totals refer to it
    Totals totals;
  };
  class LevelWork;
  void take_over(const LiveRun& before, const BinMap& bins);
  /// Groups that continue keep their random numbers, under their present number; no two share a
  /// stream.
  void keep_streams(const LiveRun& before);
  bool is_of(Scope scope, size_t group) const;
  int64_t wanted(size_t group, int64_t level) const;
  int64_t given(size_t group) const;
  int neediest(const std::vector<int64_t>& goal) const;
  BatchRange give(size_t group, int64_t most);

  std::shared_ptr<const CompiledScene> scene_;
  const uint64_t seed_;
  const int threads_;
  const std::optional<BinMap> bins_;
  const bool same_geometry_;
  std::shared_ptr<const Geometry> geometry_;
  ResidentParallelFor rows_;
  std::shared_ptr<TracedTotals> own_;
  std::vector<std::shared_ptr<const TracedTotals>> before_;  // of groups that show light of before
  std::vector<ShownLight> lights_;
  std::vector<int64_t> issued_, told_;          // batches of each group
  std::vector<std::vector<BatchRange>> again_;  // those issued that nobody has traced, by group
  std::vector<double> share_;                   // share of all batches
  std::vector<int> stream_;                     // replaces the group in the ids of its particles
  double seconds_ = 0;
};

}  // namespace luxodus

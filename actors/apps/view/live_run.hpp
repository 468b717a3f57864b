// The light of one state of a live building, source group by source group: each is traced as far as
// is asked for, and what an earlier state has given is taken over where it still holds. Thread
// rule: one thread, which has batches traced by others.
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

/// Whose light a group shows.
//
//   none ----traced----> own <----caught up---- before
//                         |                       ^
//                         +---- geometry moves ---+      (in the run that follows)
enum class ShownLight : uint8_t {
  none,    // nothing yet
  own,     // of this building
  before,  // of the building before something of its geometry moved: nearly right
};

class LiveRun {
 public:
  /// Takes over what holds of `before`, which may be null: in the same air the light of groups
  /// whose emitters are the same, as light of before where geometry is another. Errors (exception):
  /// geometry that cannot be had.
  LiveRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
          const LiveRun* before, bool same_air);

  /// Whether triangles and their patches are those of `before`.
  bool same_geometry() const { return same_geometry_; }
  /// Where patches are found in those of `before`; none where they are of another building.
  const std::optional<BinMap>& bins() const { return bins_; }

  /// Which groups are traced: without light, without light of before, all.
  enum class Scope { fresh, own, all };
  /// Has batches traced until groups have those that a level asks for: each its share of `level`
  /// times the groups. True when they have them; false when `stop` says so, which any thread may
  /// ask: soon, after what is being traced, or now. `tick` is called about four times a second,
  /// from one thread at a time.
  enum class Stop { none, soon, now };
  bool trace(int64_t level, Scope scope, Executor& executor, const std::function<Stop()>& stop,
             const std::function<void()>& tick);

  /// Groups of a scope that have batches which nobody has been told of, and own light to show:
  /// where it is of before, once their own has caught up.
  std::vector<int> news(Scope scope = Scope::all) const;
  /// From now on these show their own light, as it is.
  void tell(const std::vector<int>& groups);

  /// All own light is news again: whoever showed it shows another state now.
  void tell_anew() { std::fill(told_.begin(), told_.end(), 0); }
  /// What its totals take.
  size_t bytes() const { return own_->totals.bytes(); }

  ShownLight light(int group) const { return lights_[static_cast<size_t>(group)]; }
  const std::vector<ShownLight>& lights() const { return lights_; }
  int64_t groups_with(ShownLight light) const;
  /// Totals that show a group's light, its own or of before.
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
  /// Search structures, and what they refer to.
  struct Geometry {
    explicit Geometry(std::shared_ptr<const CompiledScene> of)
        : scene(std::move(of)), index(device, *scene) {}
    std::shared_ptr<const CompiledScene> scene;
    EmbreeDevice device;
    SceneIndex index;
  };
  /// What batches have given. Runs share it rather than copy it: it may be gigabytes.
  struct TracedTotals {
    explicit TracedTotals(std::shared_ptr<const CompiledScene> of)
        : scene(std::move(of)),
          totals(scene->layout, static_cast<int>(scene->groups.size()), photopic_weights(*scene)) {}
    std::shared_ptr<const CompiledScene> scene;  // which the totals refer to
    Totals totals;
  };
  class LevelWork;
  void take_over(const LiveRun& before, const BinMap& bins);
  /// Groups that go on keep their random numbers under another number of their own, and no two
  /// have the same.
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
  std::vector<std::vector<BatchRange>> again_;  // of those issued, by group: nobody has traced them
  std::vector<double> share_;                   // of all batches
  std::vector<int> stream_;  // what stands for a group in the ids of its particles
  double seconds_ = 0;
};

}  // namespace luxodus

// Next are batches of the group that has the smallest part of its goal. So a group that begins anew
// is traced alone until it has caught up with the others.
#include "actors/apps/view/live_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>
#include <set>

#include "actors/results/run/batch_plan.hpp"

namespace luxodus {

namespace {

constexpr double tick_every_s = 0.25;
/// How long to wait for batches in progress on a soft stop: longer than a node has work queued.
constexpr double patience_s = 0.1;
/// A group shows the light from before an edit until it has traced one batch for this many of the
/// earlier ones. Its error is then twice that of the earlier light, but it is of this building.
constexpr int64_t caught_up_at = 4;

using SteadyClock = std::chrono::steady_clock;
double since(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

bool same_triangles(const CompiledScene& a, const CompiledScene& b,
                    const std::optional<BinMap>& bins) {
  const auto same = [](const GeometryCell& x, const GeometryCell& y) {
    return x.triangles.size() == y.triangles.size() &&
           std::memcmp(x.triangles.data(), y.triangles.data(),
                       x.triangles.size() * sizeof(TriangleRecord)) == 0;
  };
  return bins && bins->is_same() &&
         std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(), same);
}

std::vector<const CompiledEmitter*> emitters_of(const CompiledScene& scene, int group) {
  std::vector<const CompiledEmitter*> out;
  for (const CompiledEmitter& e : scene.emitters)
    if (e.group == group) out.push_back(&e);
  return out;
}

/// Whether a group emits the same light from the same places.
bool same_emitters(const CompiledScene& a, int in_a, const CompiledScene& b, int in_b) {
  const auto same = [](const CompiledEmitter* x, const CompiledEmitter* y) {
    return x->origin == y->origin && x->axes == y->axes && x->size == y->size &&
           x->power_w == y->power_w && x->corners == y->corners && x->texel_cdf == y->texel_cdf;
  };
  const auto of_a = emitters_of(a, in_a), of_b = emitters_of(b, in_b);
  const auto& group_a = a.groups[static_cast<size_t>(in_a)];
  const auto& group_b = b.groups[static_cast<size_t>(in_b)];
  return group_a.band_share == group_b.band_share &&
         std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), same);
}

int group_named(const CompiledScene& scene, const std::string& name) {
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (scene.groups[g].name == name) return static_cast<int>(g);
  return -1;
}

}  // namespace

LiveRun::LiveRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
                 const LiveRun* before, bool same_air)
    : scene_(std::move(scene)),
      seed_(seed),
      threads_(threads),
      bins_(before == nullptr ? std::nullopt : BinMap::between(*before->scene_, *scene_)),
      same_geometry_(before != nullptr && same_triangles(*scene_, *before->scene_, bins_)),
      geometry_(same_geometry_ && same_air ? before->geometry_
                                           : std::make_shared<Geometry>(scene_)),
      rows_(geometry_->index, threads),
      own_(std::make_shared<TracedTotals>(scene_)),
      before_(scene_->groups.size()),
      lights_(scene_->groups.size(), ShownLight::none),
      issued_(scene_->groups.size(), 0),
      told_(scene_->groups.size(), 0),
      again_(scene_->groups.size()),
      share_(BatchPlan(*scene_).shares()),
      stream_(scene_->groups.size()) {
  std::iota(stream_.begin(), stream_.end(), 0);
  if (before != nullptr && same_air && bins_) take_over(*before, *bins_);
}

void LiveRun::take_over(const LiveRun& before, const BinMap& bins) {
  const bool shares =
      bins.is_same() &&
      std::equal(scene_->groups.begin(), scene_->groups.end(), before.scene_->groups.begin(),
                 before.scene_->groups.end(), [](const Group& a, const Group& b) {
                   return a.name == b.name && a.band_share == b.band_share;
                 });
  // With other groups or patches these have other numbers, so their light is copied.
  const std::shared_ptr<TracedTotals> copies =
      shares ? nullptr : std::make_shared<TracedTotals>(scene_);
  if (shares && same_geometry_) own_ = before.own_;
  for (size_t g = 0; g < lights_.size(); ++g) {
    const int group = static_cast<int>(g);
    const int old = group_named(*before.scene_, scene_->groups[g].name);
    if (old < 0 || before.light(old) == ShownLight::none ||
        !same_emitters(*scene_, group, *before.scene_, old)) {
      if (own_ == before.own_)
        own_->totals.restore(group, {SparseArray<Total>(scene_->layout.totals()), 0});
      continue;
    }
    const auto was = static_cast<size_t>(old);
    if (same_geometry_) {
      if (!shares) own_->totals.restore(group, before.own_->totals.state(old));
      issued_[g] = before.issued_[was];
      again_[g] = before.again_[was];
      for (BatchRange& batches : again_[g]) batches.group = group;
      told_[g] = before.told_[was];
    }
    lights_[g] = same_geometry_ ? before.lights_[was] : ShownLight::before;
    if (lights_[g] != ShownLight::before) continue;
    if (!shares) copies->totals.restore(group, bins.moved(before.shown(old).state(old)));
    before_[g] = shares ? (before.before_[was] ? before.before_[was] : before.own_) : copies;
  }
  keep_streams(before);
}

void LiveRun::keep_streams(const LiveRun& before) {
  std::set<int> kept;
  for (size_t g = 0; g < stream_.size(); ++g) {
    if (issued_[g] == 0) continue;
    const int old = group_named(*before.scene_, scene_->groups[g].name);
    kept.insert(stream_[g] = before.stream_[static_cast<size_t>(old)]);
  }
  int free = 0;
  for (size_t g = 0; g < stream_.size(); ++g) {
    if (issued_[g] > 0) continue;
    while (kept.count(free) > 0) ++free;
    stream_[g] = free++;
  }
}

bool LiveRun::is_of(Scope scope, size_t group) const {
  return scope == Scope::all || lights_[group] == ShownLight::none ||
         (scope == Scope::own && lights_[group] == ShownLight::own);
}

int64_t LiveRun::wanted(size_t group, int64_t level) const {
  const double batches =
      static_cast<double>(level) * share_[group] * static_cast<double>(share_.size());
  return std::max<int64_t>(1, std::llround(batches));
}

/// Batches that are traced, or being traced.
int64_t LiveRun::given(size_t group) const {
  int64_t out = issued_[group];
  for (const BatchRange& batches : again_[group]) out -= batches.count;
  return out;
}

/// The group with the smallest part of its goal; none: -1.
int LiveRun::neediest(const std::vector<int64_t>& goal) const {
  int chosen = -1;
  double least = 1;
  for (size_t g = 0; g < goal.size(); ++g) {
    const int64_t has = given(g);
    if (has >= goal[g]) continue;
    const double share = static_cast<double>(has) / static_cast<double>(goal[g]);
    if (share < least) {
      least = share;
      chosen = static_cast<int>(g);
    }
  }
  return chosen;
}

/// The next batches of a group: first those that were given back.
BatchRange LiveRun::give(size_t group, int64_t most) {
  if (again_[group].empty()) {
    const BatchRange out{static_cast<int>(group), stream_[group], issued_[group], most};
    issued_[group] += most;
    return out;
  }
  BatchRange& left = again_[group].back();
  const BatchRange out{left.group, left.stream, left.first, std::min(left.count, most)};
  left.first += out.count;
  left.count -= out.count;
  if (left.count == 0) again_[group].pop_back();
  return out;
}

/// One call of LiveRun::trace.
class LiveRun::LevelWork final : public Work {
 public:
  LevelWork(LiveRun& run, std::vector<int64_t> goal, const std::function<Stop()>& stop,
            const std::function<void()>& tick)
      : run_(run), goal_(std::move(goal)), stop_(stop), tick_(tick), start_(SteadyClock::now()) {}

  std::unique_ptr<BatchWorker> worker() const override {
    const CompiledScene& scene = *run_.scene_;
    return std::make_unique<ParticleWorker>(scene, GeometryAccess::resident(run_.geometry_->index),
                                            run_.seed_, BatchNumbers::of_groups,
                                            scene.batch_particles);
  }
  bool stopped() const override {
    const Stop stop = stop_();
    const double now = since(start_);
    if (stop == Stop::soon && !waits_since_) waits_since_ = now;
    return stop == Stop::now || (waits_since_ && now - *waits_since_ > patience_s);
  }
  Totals& totals() override { return run_.own_->totals; }

  std::optional<BatchRange> next(int64_t most) override {
    const std::lock_guard lock(mutex_);
    if (stop_() != Stop::none) return std::nullopt;
    if (const double now = since(start_); now - ticked_ >= tick_every_s) {
      ticked_ = now;
      tick_();
    }
    const int group = run_.neediest(goal_);
    if (group < 0) return std::nullopt;
    const auto g = static_cast<size_t>(group);
    return run_.give(g, std::min(most, goal_[g] - run_.given(g)));
  }
  void give_back(const BatchRange& batches) override {
    const std::lock_guard lock(mutex_);
    run_.again_[static_cast<size_t>(batches.group)].push_back(batches);
  }

 private:
  LiveRun& run_;
  const std::vector<int64_t> goal_;
  const std::function<Stop()>& stop_;
  const std::function<void()>& tick_;
  const SteadyClock::time_point start_;
  std::mutex mutex_;
  double ticked_ = 0;
  mutable std::optional<double> waits_since_;  // used by callers of stopped()
};

bool LiveRun::trace(int64_t level, Scope scope, Executor& executor,
                    const std::function<Stop()>& stop, const std::function<void()>& tick) {
  std::vector<int64_t> goal(issued_.size(), 0);
  for (size_t g = 0; g < goal.size(); ++g)
    if (is_of(scope, g)) goal[g] = wanted(g, level);
  if (neediest(goal) < 0) return true;
  const SteadyClock::time_point start = SteadyClock::now();
  LevelWork work(*this, goal, stop, tick);
  executor.trace(work);
  seconds_ += since(start);
  return neediest(goal) < 0;
}

std::vector<int> LiveRun::news(Scope scope) const {
  std::vector<int> out;
  for (size_t g = 0; g < lights_.size(); ++g) {
    const int group = static_cast<int>(g);
    const int64_t batches = own_->totals.batches(group);
    if (batches == told_[g] || !is_of(scope, g)) continue;
    if (!before_[g] || batches * caught_up_at >= before_[g]->totals.batches(group))
      out.push_back(group);
  }
  return out;
}

void LiveRun::tell(const std::vector<int>& groups) {
  for (const int group : groups) {
    const auto g = static_cast<size_t>(group);
    before_[g] = nullptr;
    lights_[g] = ShownLight::own;
    told_[g] = own_->totals.batches(group);
  }
}

int64_t LiveRun::groups_with(ShownLight light) const {
  return std::count(lights_.begin(), lights_.end(), light);
}

int64_t LiveRun::particles() const {
  int64_t batches = 0;
  for (size_t g = 0; g < issued_.size(); ++g) batches += given(g);
  return batches * scene_->batch_particles;
}

double LiveRun::seconds() const {
  return seconds_;
}

}  // namespace luxodus

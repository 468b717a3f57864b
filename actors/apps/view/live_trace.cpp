#include "actors/apps/view/live_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "actors/apps/view/edits_text.hpp"
#include "actors/apps/view/give_way.hpp"

namespace luxodus {

namespace {

/// The first light has at least this many batches, and at least one of each group.
constexpr int64_t first_batches = 16;
/// Groups without light get this many batches each, on average, before light of before is replaced
/// as well.
constexpr int64_t hurry_batches = 32;
/// Pending questions; more are dropped.
constexpr size_t max_questions = 64;

LiveAnswer answer_to(const LiveQuestion& question, const LiveRun& run, const LivePatch& patch) {
  const CompiledScene& scene = run.scene();
  const uint32_t bin = question.front ? patch.front : patch.back;
  LiveAnswer out{question.viewer, question.id, {}, {}, scene.surfaces[patch.surface].name};
  const auto sum = [&](uint32_t quantity, double per_lumen) {
    Estimate e;
    double variance = 0;
    for (size_t g = 0; g < scene.groups.size(); ++g) {
      const auto factor = question.factors.find(scene.groups[g].name);
      const double f = factor == question.factors.end() ? 1 : factor->second;
      const int group = static_cast<int>(g);
      if (run.light(group) == ShownLight::none) continue;
      const Readout readout(scene, run.shown(group));
      const Estimate of =
          readout.lumens(scene.blocks.patches, bin, quantity, group) * (f * per_lumen);
      e.value += of.value;
      variance += of.standard_error * of.standard_error;
    }
    e.standard_error = std::sqrt(variance);
    return e;
  };
  out.illuminance = sum(0, 1 / patch.area_m2);
  out.luminance = sum(1, 1 / (static_cast<double>(pi_f) * patch.area_m2));
  return out;
}

}  // namespace

LiveTrace::LiveTrace(std::shared_ptr<const SceneDescription> scene, const LiveOptions& options,
                     SceneEdits first, LiveAudience& audience)
    : scenes_(std::move(scene), options.scene_at),
      options_(options),
      executor_(options.executor ? options.executor
                                 : std::make_shared<ThreadExecutor>(options.threads)),
      audience_(audience),
      next_(std::move(first)),
      thread_([this] { work(); }) {}

LiveTrace::~LiveTrace() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  interrupt_ = true;
  changed_.notify_all();
  thread_.join();
}

void LiveTrace::trace_edits(SceneEdits edits, uint64_t number) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(edits);
    next_number_ = number;
  }
  interrupt_ = true;
  changed_.notify_all();
}

void LiveTrace::ask(LiveQuestion question) {
  {
    const std::lock_guard lock(mutex_);
    if (questions_.size() >= max_questions) return;
    questions_.push_back(std::move(question));
  }
  asked_ = true;
  changed_.notify_all();
}

void LiveTrace::work() {
  give_way_to_answers();
  for (;;) {
    std::optional<SceneEdits> edits;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ends_ || next_ || (run_ && !questions_.empty()); });
      if (ends_) return;
      edits = std::exchange(next_, std::nullopt);
      number_ = next_number_;
      interrupt_ = false;
    }
    try {
      if (edits) begin(*edits);
      if (run_) refine();
    } catch (const std::exception& e) {
      audience_.refuses(number_, e.what());
    }
  }
}

void LiveTrace::answer_all() {
  std::vector<LiveQuestion> questions;
  {
    const std::lock_guard lock(mutex_);
    questions.swap(questions_);
    asked_ = false;
  }
  for (const LiveQuestion& question : questions)
    if (question.triangle < geometry_.patches.size())
      audience_.answers(answer_to(question, *run_, geometry_.patches[question.triangle]));
}

/// As nodes that trace for this object make it (live_states.hpp).
StateObject LiveTrace::state_of(const SceneEdits& edits) const {
  return {options_.seed, edits_text(edits)};
}

namespace {

/// Whether these describe one building, possibly at two times.
bool same_but_for_time(SceneEdits a, const SceneEdits& b) {
  a.at_s = b.at_s;
  return edits_text(a) == edits_text(b);
}

}  // namespace

void LiveTrace::keep(const SceneEdits& next) {
  if (!same_but_for_time(traced_, next)) return kept_.clear();
  size_t bytes = run_->bytes();
  kept_.push_front({traced_, std::move(run_), geometry_, smoke_, look_});
  size_t stays = 1;
  for (; stays < kept_.size() && stays < limits::kept_states; ++stays) {
    bytes += kept_[stays].run->bytes();
    if (bytes > limits::kept_state_bytes) break;
  }
  kept_.resize(stays);
}

bool LiveTrace::take_kept(const SceneEdits& edits) {
  const auto at = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) {
    return one.edits.at_s == edits.at_s && same_but_for_time(one.edits, edits);
  });
  if (at == kept_.end()) return false;
  Kept taken = std::move(*at);
  kept_.erase(at);
  if (run_) keep(edits);
  run_ = std::move(taken.run);
  run_->tell_anew();
  if (taken.geometry.frame != geometry_.frame) {
    geometry_ = std::move(taken.geometry);
    geometry_.frame = readdressed(geometry_.frame, generation_ + 1, 0);
  }
  smoke_ = std::move(taken.smoke);
  look_ = std::move(taken.look);
  if (smoke_.frame) smoke_.frame = readdressed(smoke_.frame, generation_ + 1, 0);
  return true;
}

void LiveTrace::begin(const SceneEdits& edits) {
  executor_->foresee(state_of(edits));
  std::shared_ptr<const std::vector<uint32_t>> triangles_before;
  const bool again = run_ && traced_.at_s != edits.at_s && take_kept(edits);
  if (!again && !begin_anew(edits, triangles_before)) return;
  executor_->enter(state_of(edits));
  traced_ = edits;
  ++generation_;
  refined_ = false;
  error_ = std::numeric_limits<double>::quiet_NaN();
  // The cached light is of another state than the shown one: no viewer has it.
  const auto lights =
      again ? std::vector<ShownLight>(run_->lights().size(), ShownLight::none) : run_->lights();
  audience_.begins({generation_, edits, run_->shared_scene(), geometry_.frame, smoke_.frame, lights,
                    std::move(triangles_before), smoke_.flames, look_});
}

bool LiveTrace::begin_anew(const SceneEdits& edits,
                           std::shared_ptr<const std::vector<uint32_t>>& triangles_before) {
  const auto refuse = [&](const Problem& why) {
    audience_.refuses(number_, why.text());
    return false;
  };
  const auto scene = scenes_.at(edits.at_s);
  if (!scene) return refuse(scene.problem());
  auto compiled = compile_live(*scene.value(), edits);
  if (!compiled) return refuse(compiled.problem());
  const bool same_air = run_ && traced_.scenario == edits.scenario &&
                        traced_.smoke == edits.smoke && traced_.at_s == edits.at_s;
  auto run = std::make_unique<LiveRun>(compiled.value(), options_.seed, options_.threads,
                                       run_.get(), same_air);
  const uint32_t generation = generation_ + 1;
  std::optional<LiveGeometry> other;
  if (!run->same_geometry()) {
    auto geometry = geometry_of(run->scene(), generation);
    if (!geometry) return refuse(geometry.problem());
    if (same_air && run->bins() && !run->bins()->is_same())
      triangles_before = triangles_from(geometry_.patches, geometry->patches, *run->bins());
    other = std::move(geometry).value();
  }
  if (run_) keep(edits);
  if (other) geometry_ = *std::move(other);
  if (!same_air || !run->same_geometry()) smoke_ = smoke_of(run->scene(), run->index(), generation);
  look_ = std::make_shared<const LiveLook>(look_of(run->scene()));
  run_ = std::move(run);
  return true;
}

void LiveTrace::tell(bool done) {
  const int64_t old = run_->groups_with(ShownLight::before);
  audience_.goes_on({generation_, run_->particles(), error_, run_->seconds(), old, done});
}

bool LiveTrace::reach(int64_t level, LiveRun::Scope scope) {
  const auto stop = [this] {
    if (interrupt_) return LiveRun::Stop::now;
    return asked_ ? LiveRun::Stop::soon : LiveRun::Stop::none;
  };
  bool reached = false;
  while (!reached && !interrupt_) {
    reached = run_->trace(level, scope, *executor_, stop, [this] { tell(false); });
    if (asked_) answer_all();
  }
  const std::vector<int> groups = run_->news(scope);
  // A few at a time, so that an edit does not wait for the rest.
  const auto most = static_cast<size_t>(options_.threads);
  for (size_t first = 0; first < groups.size() && !interrupt_; first += most) {
    const auto begin = groups.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<int> some(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(most, groups.size() - first)));
    run_->tell(some);
    audience_.lit(generation_, light_frames(*run_, geometry_.patches, smoke_, generation_, some));
  }
  if (interrupt_) return false;
  if (groups.empty()) return true;
  error_ = run_->worst_relative_error();
  tell(false);
  return true;
}

void LiveTrace::refine() {
  using Scope = LiveRun::Scope;
  answer_all();
  if (refined_) return;
  const auto groups = static_cast<int64_t>(run_->lights().size());
  const int64_t most =
      std::max<int64_t>(1, options_.particles / (groups * run_->scene().batch_particles));
  if (const int64_t fresh = run_->groups_with(ShownLight::none); fresh > 0) {
    const int64_t first = (first_batches + fresh - 1) / fresh;
    if (!reach(std::min(first, most), Scope::fresh)) return;
  }
  for (int64_t level = 1;; level *= 2) {
    level = std::min(level, most);
    const bool all = level == most || level > hurry_batches;
    if (!reach(level, all ? Scope::all : Scope::own)) return;
    const bool good = error_ < options_.relative_error;
    if (level == most || (good && run_->groups_with(ShownLight::before) == 0)) break;
  }
  refined_ = true;
  tell(true);
}

}  // namespace luxodus

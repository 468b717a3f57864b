#include "actors/view/live_trace.hpp"

#include <cmath>

namespace luxodus {

namespace {

/// Batches of each group, on average, before the first light is shown.
constexpr int64_t first_batches = 1;
/// Questions that wait; more are forgotten.
constexpr size_t questions_most = 64;

LiveAnswer answer_to(const LiveQuestion& question, const CompiledScene& scene,
                     const Readout& readout, const LivePatch& patch) {
  const uint32_t bin = question.front ? patch.front : patch.back;
  LiveAnswer out{question.viewer, question.id, {}, {}, scene.surfaces[patch.surface].name};
  const auto sum = [&](uint32_t quantity, double per_lumen) {
    Estimate e;
    double variance = 0;
    for (size_t g = 0; g < scene.groups.size(); ++g) {
      const auto factor = question.factors.find(scene.groups[g].name);
      const double f = factor == question.factors.end() ? 1 : factor->second;
      const Estimate of = readout.lumens(scene.blocks.patches, bin, quantity, static_cast<int>(g)) *
                          (f * per_lumen);
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
                     LiveWish first, LiveAudience& audience)
    : scene_(std::move(scene)),
      options_(options),
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

void LiveTrace::wish(LiveWish wish) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(wish);
  }
  interrupt_ = true;
  changed_.notify_all();
}

void LiveTrace::ask(LiveQuestion question) {
  {
    const std::lock_guard lock(mutex_);
    if (questions_.size() >= questions_most) return;
    questions_.push_back(std::move(question));
  }
  asked_ = true;
  changed_.notify_all();
}

void LiveTrace::work() {
  for (;;) {
    LiveWish wish;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ends_ || next_; });
      if (ends_) return;
      wish = std::move(*next_);
      next_.reset();
      interrupt_ = false;
    }
    try {
      trace(wish);
    } catch (const std::exception& e) {
      audience_.refuses(e.what());
    }
  }
}

void LiveTrace::answer_all(const LocalRun& run, const std::vector<LivePatch>& patches) {
  std::vector<LiveQuestion> questions;
  {
    const std::lock_guard lock(mutex_);
    questions.swap(questions_);
    asked_ = false;
  }
  const Readout readout(run.scene(), run.totals());
  for (const LiveQuestion& question : questions)
    if (question.triangle < patches.size())
      audience_.answers(answer_to(question, run.scene(), readout, patches[question.triangle]));
}

void LiveTrace::trace(const LiveWish& wish) {
  auto compiled = compile_live(*scene_, wish);
  if (!compiled.ok()) return audience_.refuses(compiled.problem().text());
  LocalRun run(compiled.value(), options_.seed, options_.threads);
  const uint32_t generation = ++generation_;
  auto geometry = geometry_of(run.scene(), generation);
  if (!geometry.ok()) return audience_.refuses(geometry.problem().text());
  const std::vector<LivePatch>& patches = geometry->patches;
  audience_.begins({generation, wish, compiled.value(), geometry->frame,
                    smoke_frame(run.scene(), run.index(), generation)});
  run.set_pause([this] { return asked_.load(); }, [&] { answer_all(run, patches); });
  const auto tell = [&](const Progress& p, bool done) {
    audience_.goes_on({generation, p.particles, p.relative_error, run.seconds(), done});
  };
  Progress last;
  const int64_t first =
      first_batches * static_cast<int64_t>(run.scene().groups.size()) * run.scene().batch_particles;
  for (int64_t target = first; !interrupt_ && target < 2 * options_.particles; target *= 2) {
    StopRule stop;
    stop.particles = std::min(target, options_.particles);
    run.run(stop, interrupt_, [&](const Progress& p) { tell(last = p, false); });
    if (interrupt_) return;
    audience_.lit(generation, light_frames(run, patches, generation));
    last.particles = run.particles();
    last.relative_error = Readout(run.scene(), run.totals()).worst_relative_error();
    tell(last, false);
    if (last.relative_error < options_.relative_error) break;
  }
  tell(last, true);
  // Nothing more to trace: questions are still answered.
  for (std::unique_lock lock(mutex_); !ends_ && !next_;) {
    changed_.wait(lock, [&] { return ends_ || next_ || !questions_.empty(); });
    lock.unlock();
    answer_all(run, patches);
    lock.lock();
  }
}

}  // namespace luxodus

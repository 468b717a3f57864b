// The tracing behind a live view: one generation after another, each refined from few particles to
// many and sent at every doubling, so that the first light appears at once and later updates cost
// little. New edits end the current generation, and reuse its light where it still holds. Thread
// rule: its own thread traces and calls the audience; edits and questions may come from any other.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "actors/apps/view/frames.hpp"
#include "actors/apps/view/live_scene.hpp"
#include "actors/apps/view/look.hpp"
#include "actors/results/run/open_scene.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

struct LiveProgress {
  uint32_t generation = 0;
  int64_t particles = 0;
  double relative_error = 0;  // NaN until it is known
  double seconds = 0;
  int64_t groups_of_before = 0;  // that still show light of before
  bool done = false;
};

/// A viewer's question for the light at a place of a surface.
struct LiveQuestion {
  uint64_t viewer = 0;
  int64_t id = 0;
  uint32_t triangle = 0;
  bool front = true;
  std::map<std::string, double> factors;  // of source groups, by name; others are 1
};
struct LiveAnswer {
  uint64_t viewer = 0;
  int64_t id = 0;
  Estimate illuminance, luminance;  // [lx], [cd/m2]
  std::string surface;
};

/// A new generation, before its first light.
struct LiveGeneration {
  uint32_t number = 0;
  SceneEdits edits;
  std::shared_ptr<const CompiledScene> scene;
  LiveFrame geometry;              // the previous generation's frame if the triangles are the same
  LiveFrame smoke;                 // likewise; null without media
  std::vector<ShownLight> lights;  // for each group: the light that it goes on showing
  /// The triangle of the previous generation that corresponds to each, or none_index; null if all
  /// are the same, or none is.
  std::shared_ptr<const std::vector<uint32_t>> triangles_before = nullptr;
  /// Flames that are shown separately from voxels; null without media.
  std::shared_ptr<const std::vector<LiveFlame>> flames = nullptr;
  std::shared_ptr<const LiveLook> look = nullptr;  // made once, because making it takes longer than
                                                   // sending it
};

/// Receives the results. Called on the tracing thread.
class LiveAudience {
 public:
  virtual ~LiveAudience() = default;
  virtual void begins(const LiveGeneration& generation) = 0;
  virtual void lit(uint32_t generation, std::vector<LiveFrame> frames) = 0;
  virtual void goes_on(const LiveProgress& progress) = 0;
  virtual void answers(const LiveAnswer& answer) = 0;
  /// The edits of that number are not possible: the previous ones stay in force.
  virtual void refuses(uint64_t number, const std::string& why) = 0;
};

struct LiveOptions {
  uint64_t seed = 1;
  int threads = 1;
  int64_t particles = 100'000'000;           // limit for a generation
  double relative_error = 0.002;             // target at which it ends
  std::shared_ptr<Executor> executor = {};   // null: `threads` of this process
  SceneAtTime scene_at = {};                 // other times; empty: a single state
  std::shared_ptr<FrameScenes> judged = {};  // the scenes that verdicts use; null: the scenes
                                             // themselves
};

namespace limits {
/// States whose light is cached while another time is shown, and a limit on their totals [bytes].
inline constexpr size_t kept_states = 8;
inline constexpr size_t kept_state_bytes = size_t{1} << 30;
}  // namespace limits

class LiveTrace {
 public:
  /// Starts immediately. Requires: `audience` outlives this.
  LiveTrace(std::shared_ptr<const SceneDescription> scene, const LiveOptions& options,
            SceneEdits first, LiveAudience& audience);
  ~LiveTrace();
  LiveTrace(const LiveTrace&) = delete;
  LiveTrace& operator=(const LiveTrace&) = delete;

  /// `number`: identifies the edits if they are refused; the first have 0.
  void trace_edits(SceneEdits edits, uint64_t number);
  /// The scene at a time, as TimedScenes::at.
  Result<std::shared_ptr<const SceneDescription>> scene_at(std::optional<double> at_s) {
    return scenes_.at(at_s);
  }
  void ask(LiveQuestion question);

 private:
  void work();
  void begin(const SceneEdits& edits);
  /// Starts a generation for edits whose light is not cached. False after they were refused.
  bool begin_anew(const SceneEdits& edits,
                  std::shared_ptr<const std::vector<uint32_t>>& triangles_before);
  /// Shows the cached light of these edits, which differ from the traced ones only in their time.
  /// False if it is not cached.
  bool take_kept(const SceneEdits& edits);
  /// Caches what is traced if another time of it is requested, else discards it.
  void keep(const SceneEdits& next);
  StateObject state_of(const SceneEdits& edits) const;
  /// Traces until the target is reached or something is requested.
  void refine();
  /// Traces groups to a level and sends them; false if edits or the end have arrived.
  bool reach(int64_t level, LiveRun::Scope scope);
  void tell(bool done);
  void answer_all();

  TimedScenes scenes_;
  const LiveOptions options_;
  const std::shared_ptr<Executor> executor_;
  LiveAudience& audience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<SceneEdits> next_;
  uint64_t next_number_ = 0;
  std::vector<LiveQuestion> questions_;
  bool ends_ = false;
  std::atomic<bool> interrupt_{false};
  std::atomic<bool> asked_{false};
  // Used by the tracing thread only.
  uint32_t generation_ = 0;
  uint64_t number_ = 0;  // of the edits last looked at
  SceneEdits traced_;
  LiveGeometry geometry_;
  LiveSmoke smoke_;
  std::shared_ptr<const LiveLook> look_;
  std::unique_ptr<LiveRun> run_;
  /// States at other times, the last shown first.
  struct Kept {
    SceneEdits edits;
    std::unique_ptr<LiveRun> run;
    LiveGeometry geometry;
    LiveSmoke smoke;
    std::shared_ptr<const LiveLook> look;
  };
  std::deque<Kept> kept_;
  bool refined_ = false;
  double error_ = 0;
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace luxodus

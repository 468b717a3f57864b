// The tracing behind a live view: one generation after another, each from few particles to many,
// told of at every doubling, so that the first light is there at once and later ones cost little.
// New edits end the generation under way, and take over of its light what still holds. Thread
// rule: its own thread traces and tells; edits and questions may come from any other.
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

/// Light at a place of a surface, for somebody who has asked.
struct LiveQuestion {
  uint64_t viewer = 0;
  int64_t id = 0;
  uint32_t triangle = 0;
  bool front = true;
  std::map<std::string, double> factors;  // of source groups, by name; others 1
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
  LiveFrame geometry;  // the frame of the generation before where triangles are the same
  LiveFrame smoke;     // likewise; null where no medium is
  std::vector<ShownLight> lights;  // of each group: what it goes on showing
  /// Which triangle of the generation before each was, or none_index; null where all are the same
  /// ones, or none is.
  std::shared_ptr<const std::vector<uint32_t>> triangles_before = nullptr;
  /// Flames that are shown apart from voxels; null where no medium is.
  std::shared_ptr<const std::vector<LiveFlame>> flames = nullptr;
  std::shared_ptr<const LiveLook> look = nullptr;  // made once: it takes longer than telling it
};

/// Who is told. Called on the tracing thread.
class LiveAudience {
 public:
  virtual ~LiveAudience() = default;
  virtual void begins(const LiveGeneration& generation) = 0;
  virtual void lit(uint32_t generation, std::vector<LiveFrame> frames) = 0;
  virtual void goes_on(const LiveProgress& progress) = 0;
  virtual void answers(const LiveAnswer& answer) = 0;
  /// The edits of that number cannot be had: what was traced before goes on.
  virtual void refuses(uint64_t number, const std::string& why) = 0;
};

struct LiveOptions {
  uint64_t seed = 1;
  int threads = 1;
  int64_t particles = 100'000'000;           // of a generation, at most
  double relative_error = 0.002;             // at which it ends
  std::shared_ptr<Executor> executor = {};   // null: `threads` of this process
  SceneAtTime scene_at = {};                 // at other times; empty: there is one state
  std::shared_ptr<FrameScenes> judged = {};  // what verdicts are of; null: the scenes themselves
};

namespace limits {
/// States whose light is kept while another time is shown, and what their totals may take [bytes].
inline constexpr size_t kept_states = 8;
inline constexpr size_t kept_state_bytes = size_t{1} << 30;
}  // namespace limits

class LiveTrace {
 public:
  /// Begins at once. Requires: `audience` outlives this.
  LiveTrace(std::shared_ptr<const SceneDescription> scene, const LiveOptions& options,
            SceneEdits first, LiveAudience& audience);
  ~LiveTrace();
  LiveTrace(const LiveTrace&) = delete;
  LiveTrace& operator=(const LiveTrace&) = delete;

  /// `number`: under which it is refused, if it is; the first has 0.
  void edits(SceneEdits edits, uint64_t number);
  /// The scene at a time, as TimedScenes::at.
  Result<std::shared_ptr<const SceneDescription>> scene_at(std::optional<double> at_s) {
    return scenes_.at(at_s);
  }
  void ask(LiveQuestion question);

 private:
  void work();
  void begin(const SceneEdits& edits);
  /// A new generation of edits whose light is not kept. False after it was refused.
  bool begin_anew(const SceneEdits& edits,
                  std::shared_ptr<const std::vector<uint32_t>>& triangles_before);
  /// The light of these edits, which differ from those that are traced in their time alone.
  /// False where it is not kept.
  bool take_kept(const SceneEdits& edits);
  /// Keeps what is traced, where another time of it is asked for, and forgets it elsewhere.
  void keep(const SceneEdits& next);
  StateObject state_of(const SceneEdits& edits) const;
  /// Traces until it is good enough or something comes.
  void refine();
  /// Traces groups to a level and tells of it; false where edits or the end have come.
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
  // Of the tracing thread.
  uint32_t generation_ = 0;
  uint64_t number_ = 0;  // of the edits that it looked at last
  SceneEdits traced_;
  LiveGeometry geometry_;
  LiveSmoke smoke_;
  std::shared_ptr<const LiveLook> look_;
  std::unique_ptr<LiveRun> run_;
  /// States of other times, the last shown first.
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
  std::thread thread_;  // the last: it begins when all else is there
};

}  // namespace luxodus

// The state that all viewers of a live view share: the latest frames for those who come late, the
// factors of source groups, what is traced, and who may edit. Thread rule: everything is called on
// the thread of the server; what the tracing thread tells is posted there.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <set>

#include "actors/apps/view/live_json.hpp"
#include "actors/apps/view/page_message.hpp"
#include "actors/apps/view/view_pictures.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// One connection, as the hub sees it.
class Viewer {
 public:
  virtual ~Viewer() = default;
  virtual void send_text(const LiveFrame& text) = 0;
  /// `light`: it may be taken back while it waits.
  virtual void send_binary(const LiveFrame& frame, bool light) = 0;
  /// Takes back light that waits to be sent, in its order.
  virtual std::vector<LiveFrame> take_light() = 0;
};

struct HubOptions {
  LiveOptions live;
  SceneEdits first;
  std::filesystem::path save_folder;  // where variants are written
  ViewPictureLimits pictures = {};
};

class ViewHub final : private LiveAudience {
 public:
  /// `post` runs a function on the server's thread, from any thread.
  using Post = std::function<void(std::function<void()>)>;
  ViewHub(std::shared_ptr<const SceneDescription> scene, const HubOptions& options, Post post);
  ~ViewHub() override;

  void joins(Viewer& viewer);
  void leaves(Viewer& viewer);
  void says(Viewer& viewer, std::string_view text);
  size_t viewers() const { return viewers_.size(); }
  /// Drawings that lie under plans, as JSON text: made once, before anybody asks, for no edit
  /// changes them.
  const std::string& backdrops() const { return backdrops_; }

 private:
  void begins(const LiveGeneration& generation) override;
  void lit(uint32_t generation, std::vector<LiveFrame> frames) override;
  void goes_on(const LiveProgress& progress) override;
  void answers(const LiveAnswer& answer) override;
  void refuses(uint64_t number, const std::string& why) override;

  void handle(Viewer& viewer, const FactorEdit& edit);
  void handle(Viewer& viewer, const ScenarioEdit& edit);
  void handle(Viewer& viewer, const SmokeEdit& edit);
  void handle(Viewer& viewer, const StateEdit& edit);
  void handle(Viewer& viewer, const TimeEdit& edit);
  void handle(Viewer& viewer, const MoveEdit& edit);
  void handle(Viewer& viewer, const AddEdit& edit);
  void handle(Viewer& viewer, const RemoveEdit& edit);
  void handle(Viewer& viewer, const SaveEdit& edit);
  void handle(Viewer& viewer, const EditWish& edits);
  void handle(Viewer& viewer, const ProbeAsk& ask);
  void handle(Viewer& viewer, const JudgeAsk& ask);
  void handle(Viewer& viewer, const RenderAsk& ask);
  void handle(Viewer& viewer, const RenderStop& stop);
  void handle(Viewer& viewer, const SuggestAsk& ask);
  /// Has the edits traced. Until that begins it may be refused, and is taken back then.
  void edits();
  void take_back();
  void refuse(Viewer& viewer, const std::string& why);
  void to_all(const Json& message);
  void greet(Viewer& viewer);
  /// A frame of the generation before as one of this; null where its group is gone or begins anew.
  LiveFrame carried(const LiveFrame& frame, const LiveGeneration& from) const;
  /// The copy of that name, or the end of what was added.
  std::vector<SceneEdits::Copy>::const_iterator added(const std::string& name) const;
  /// Whether something can stand there; the viewer is told why not.
  bool can_stand(Viewer& viewer, bool is_sign, const glm::dvec3& position,
                 const std::optional<glm::dvec3>& facing);
  /// A question whose answer takes seconds: a sign to judge, or luminaires to suggest.
  using Question = std::variant<JudgeAsk, SuggestAsk>;
  void put(Viewer& viewer, Question question);
  /// Begins with the next question that somebody waits for, where none is being answered.
  void answer_next();
  /// The scene at a time, for answers and pictures. Errors: files that are others than when the
  /// view was opened; as LiveTrace::scene_at.
  Result<std::shared_ptr<const SceneDescription>> scene_as_opened(std::optional<double> at_s) const;
  Json answer_to(const Question& question, const SceneEdits& edits,
                 const std::map<std::string, double>& factors) const;
  void make_editor(Viewer* viewer);
  /// The scene at the time of the generation; as it was opened, before the first.
  const SceneDescription& scene_now() const {
    return generation_.scene ? *generation_.scene->description : *scene_;
  }
  /// Takes over how long the mains have failed in a scenario of the scene as it is now.
  void take_seconds(const std::string& scenario);
  /// Brings the shares of groups up to the time and the scenario.
  void share();
  Json scene_json(const Viewer& viewer, bool follows) const;
  Viewer* viewer_of(uint64_t number) const;

  const std::shared_ptr<const SceneDescription> scene_;
  const HubOptions options_;
  const Post post_;
  std::map<Viewer*, uint64_t> viewers_;
  uint64_t next_number_ = 1;
  Viewer* editor_ = nullptr;
  SceneEdits edits_;  // what the last edit made of it
  uint64_t wish_number_ = 0;
  LiveDimming dimming_;
  LiveGeneration generation_;
  /// The latest by kind and group, of any generation that it holds for.
  std::map<std::pair<uint32_t, uint32_t>, LiveFrame> light_;
  std::optional<LiveProgress> progress_;
  std::atomic<bool> ends_{false};
  std::thread answering_;
  bool is_answering_ = false;
  std::deque<std::pair<uint64_t, Question>> questions_;  // by viewer: the last that each asked
  const std::string backdrops_;
  std::unique_ptr<LiveTrace> trace_;        // the last but one: it tells at once
  std::unique_ptr<ViewPictures> pictures_;  // asks trace_ for the scene
};

}  // namespace luxodus

// The shared state of all viewers of a live view: the latest frames for viewers that join later,
// the factors of source groups, what is traced, and who may edit. Thread rule: everything is called
// on the server's thread; results of the tracing thread are posted there.
#pragma once

#include <filesystem>
#include <functional>
#include <set>

#include "actors/apps/view/edit_history.hpp"
#include "actors/apps/view/live_json.hpp"
#include "actors/apps/view/page_message.hpp"
#include "actors/apps/view/view_answers.hpp"
#include "actors/apps/view/view_pictures.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// A viewer's connection.
class Viewer {
 public:
  virtual ~Viewer() = default;
  virtual void send_text(const LiveFrame& text) = 0;
  /// `light`: the frame may be withdrawn while it waits.
  virtual void send_binary(const LiveFrame& frame, bool light) = 0;
  /// Withdraws light that waits to be sent, in order.
  virtual std::vector<LiveFrame> take_light() = 0;
};

struct HubOptions {
  LiveOptions live;
  SceneEdits first;
  std::filesystem::path save_folder;  // folder for saved variants
  ViewPictureLimits pictures = {};
  std::string people = R"({"step":1,"people":[]})";  // as people_json: nobody walks
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
  /// Drawings under plans, as JSON text: made once at the start, since no edit changes them.
  const std::string& backdrops() const { return backdrops_; }
  /// What viewers may add, as JSON text: made once at the start.
  const std::string& library() const { return library_; }
  /// People who walk, as JSON text.
  const std::string& people() const { return options_.people; }

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
  void handle(Viewer& viewer, const HistoryEdit& edit);
  void handle(Viewer& viewer, const EditWish& edits);
  void handle(Viewer& viewer, const ProbeAsk& ask);
  void handle(Viewer& viewer, const JudgeAsk& ask);
  void handle(Viewer& viewer, const RenderAsk& ask);
  void handle(Viewer& viewer, const RenderStop& stop);
  void handle(Viewer& viewer, const SuggestAsk& ask);
  void handle(Viewer& viewer, const ChecksAsk& ask);
  /// Has the edits traced. They may be refused until that begins, and are then taken back.
  void trace_edits();
  void take_back();
  void place_copy(const SceneEdits::Copy& copy, const AddEdit& edit);
  /// Records that an edit has changed the state, and tells all viewers.
  void note(EditKind kind, const std::string& name, std::optional<double> value = {});
  Json history_json() const;
  /// Dims all groups that differ from these factors, and tells all viewers.
  void dim_as(const std::map<std::string, double>& factors);
  void refuse(Viewer& viewer, const std::string& why);
  void to_all(const Json& message);
  void greet(Viewer& viewer);
  /// A frame of the previous generation for the present one; null if its group is gone or begins
  /// anew.
  LiveFrame carried(const LiveFrame& frame, const LiveGeneration& from) const;
  /// The copy with that name, or the end of the additions.
  std::vector<SceneEdits::Copy>::const_iterator added(const std::string& name) const;
  /// Whether something can be placed there; tells the viewer why not.
  bool can_stand(Viewer& viewer, bool is_sign, const glm::dvec3& position,
                 const std::optional<glm::dvec3>& facing);
  /// Asks about the building in its present state, in an answer that takes seconds.
  void put(Viewer& viewer, ViewQuestion question);
  /// The scene at a time, for answers and pictures. Errors: files that have changed since the view
  /// was opened; as LiveTrace::scene_at.
  Result<std::shared_ptr<const SceneDescription>> scene_as_opened(std::optional<double> at_s) const;
  void make_editor(Viewer* viewer);
  /// The scene at the time of the generation; as opened, before the first.
  const SceneDescription& scene_now() const {
    return generation_.scene ? *generation_.scene->description : *scene_;
  }
  /// Takes the time since the mains failure from a scenario of the present scene.
  void take_seconds(const std::string& scenario);
  /// Updates the shares of groups to the time and the scenario.
  void share();
  Json scene_json(const Viewer& viewer, bool follows) const;
  Viewer* viewer_of(uint64_t number) const;

  const std::shared_ptr<const SceneDescription> scene_;
  const HubOptions options_;
  const Post post_;
  std::map<Viewer*, uint64_t> viewers_;
  uint64_t next_number_ = 1;
  Viewer* editor_ = nullptr;
  SceneEdits edits_;  // result of the last edit
  uint64_t wish_number_ = 0;
  LiveDimming dimming_;
  EditHistory history_;
  LiveGeneration generation_;
  /// The latest frames by kind and group, of any generation that they are valid for.
  std::map<std::pair<uint32_t, uint32_t>, LiveFrame> light_;
  std::optional<LiveProgress> progress_;
  const std::string backdrops_, library_;
  std::unique_ptr<LiveTrace> trace_;        // calls back at once: members above exist by then
  std::unique_ptr<ViewPictures> pictures_;  // uses the scene of trace_
  std::unique_ptr<ViewAnswers> answers_;    // likewise
};

}  // namespace luxodus

#include "actors/view/view_hub.hpp"

#include <algorithm>
#include <cmath>

#include "actors/view/sign_verdicts.hpp"
#include "scenes/format/atomic_file.hpp"
#include "scenes/geometry/transform.hpp"

namespace luxodus {

namespace {

LiveFrame text_of(const Json& message) {
  return std::make_shared<const std::string>(
      message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// A name that is a file of its own and nothing else.
bool is_plain_name(const std::string& name) {
  return name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_- ") ==
             std::string::npos &&
         !name.empty() && name.front() != ' ' && name.back() != ' ';
}

}  // namespace

ViewHub::ViewHub(std::shared_ptr<const SceneDescription> scene, const HubOptions& options,
                 Post post)
    : scene_(std::move(scene)), options_(options), post_(std::move(post)), wish_(options.first) {
  if (const auto scenario = find_scenario(*scene_, wish_.scenario); scenario.ok())
    dimming_.seconds = seconds_said(scenario.value());
  trace_.reset(new LiveTrace(scene_, options_.live, wish_, *this));
}

ViewHub::~ViewHub() {
  ends_ = true;
  trace_.reset();
  if (judge_.joinable()) judge_.join();
}

// ---- from the tracing thread -------------------------------------------------------------------

void ViewHub::begins(const LiveGeneration& generation) {
  post_([this, generation] {
    const LiveGeneration before = std::exchange(generation_, generation);
    share();
    const bool same_geometry = before.geometry == generation.geometry;
    const bool same_smoke = before.smoke == generation.smoke;
    std::map<std::pair<uint32_t, uint32_t>, LiveFrame> kept;
    for (const auto& [at, frame] : light_)
      if (const LiveFrame now = carried(frame, before)) kept[{at.first, head_of(now).a}] = now;
    light_ = std::move(kept);
    for (const auto& [viewer, number] : viewers_) {
      const auto waiting = viewer->take_light();
      viewer->send_text(text_of(scene_json(*viewer, before.scene != nullptr)));
      if (!same_geometry) viewer->send_binary(generation.geometry, false);
      if (!same_smoke && generation.smoke) viewer->send_binary(generation.smoke, false);
      for (const LiveFrame& frame : waiting)
        if (const LiveFrame now = carried(frame, before)) viewer->send_binary(now, true);
    }
  });
}

LiveFrame ViewHub::carried(const LiveFrame& frame, const LiveGeneration& from) const {
  const FrameHead head = head_of(frame);
  if (!from.scene || head.a >= from.scene->groups.size()) return nullptr;
  const std::vector<Group>& now = generation_.scene->groups;
  for (uint32_t g = 0; g < now.size(); ++g)
    if (now[g].name == from.scene->groups[head.a].name)
      return generation_.lights[g] == ShownLight::none ? nullptr
                                                       : readdressed(frame, generation_.number, g);
  return nullptr;
}

void ViewHub::lit(uint32_t generation, std::vector<LiveFrame> frames) {
  post_([this, generation, frames = std::move(frames)] {
    if (generation != generation_.number) return;
    const auto key = [](const LiveFrame& frame) {
      const FrameHead head = head_of(frame);
      return std::pair{head.kind, head.a};
    };
    std::set<std::pair<uint32_t, uint32_t>> newer;
    for (const LiveFrame& frame : frames) {
      newer.insert(key(frame));
      light_[key(frame)] = frame;
    }
    for (const auto& [viewer, number] : viewers_) {
      for (const LiveFrame& frame : viewer->take_light())
        if (newer.count(key(frame)) == 0) viewer->send_binary(frame, true);
      for (const LiveFrame& frame : frames) viewer->send_binary(frame, true);
    }
  });
}

void ViewHub::goes_on(const LiveProgress& progress) {
  post_([this, progress] {
    progress_ = progress;
    to_all(progress_json(progress));
  });
}

void ViewHub::answers(const LiveAnswer& answer) {
  post_([this, answer] {
    if (Viewer* const viewer = viewer_of(answer.viewer))
      viewer->send_text(text_of(answer_json(answer)));
  });
}

void ViewHub::refuses(const std::string& why) {
  post_([this, why] { to_all({{"type", "refused"}, {"why", why}}); });
}

// ---- viewers -----------------------------------------------------------------------------------

Viewer* ViewHub::viewer_of(uint64_t number) const {
  for (const auto& [viewer, its] : viewers_)
    if (its == number) return viewer;
  return nullptr;
}

void ViewHub::joins(Viewer& viewer) {
  viewers_[&viewer] = next_number_++;
  if (editor_ == nullptr) editor_ = &viewer;
  if (generation_.scene) greet(viewer);
}

void ViewHub::leaves(Viewer& viewer) {
  viewers_.erase(&viewer);
  if (editor_ == &viewer) editor_ = nullptr;
}

/// All that there is so far.
void ViewHub::greet(Viewer& viewer) {
  viewer.send_text(text_of(scene_json(viewer, false)));
  viewer.send_binary(readdressed(generation_.geometry, generation_.number, 0), false);
  if (generation_.smoke)
    viewer.send_binary(readdressed(generation_.smoke, generation_.number, 0), false);
  for (const auto& [at, frame] : light_) viewer.send_binary(frame, true);
  if (progress_ && progress_->generation == generation_.number)
    viewer.send_text(text_of(progress_json(*progress_)));
}

Json ViewHub::scene_json(const Viewer& viewer, bool follows) const {
  return live_scene_json(*scene_, generation_, dimming_, &viewer == editor_, follows);
}

void ViewHub::to_all(const Json& message) {
  const LiveFrame text = text_of(message);
  for (const auto& [viewer, number] : viewers_) viewer->send_text(text);
}

void ViewHub::refuse(Viewer& viewer, const std::string& why) {
  viewer.send_text(text_of({{"type", "refused"}, {"why", why}}));
}

void ViewHub::says(Viewer& viewer, std::string_view text) {
  const auto message = parse_view_message(text);
  if (!message.ok()) return refuse(viewer, message.problem().what);
  if (is_edit(message.value()) && editor_ != &viewer)
    return refuse(viewer, "somebody else edits: take over first");
  std::visit([&](const auto& m) { handle(viewer, m); }, message.value());
}

void ViewHub::make_editor(Viewer* viewer) {
  if (editor_ == viewer) return;
  Viewer* const before = std::exchange(editor_, viewer);
  for (Viewer* one : {before, editor_})
    if (one != nullptr) one->send_text(text_of({{"type", "editor"}, {"editor", one == editor_}}));
}

// ---- edits -------------------------------------------------------------------------------------

void ViewHub::handle(Viewer& viewer, const FactorEdit& edit) {
  const auto& groups = generation_.scene ? generation_.scene->groups : std::vector<Group>();
  if (std::none_of(groups.begin(), groups.end(),
                   [&](const Group& g) { return g.name == edit.group; }))
    return refuse(viewer, "there is no light \"" + edit.group + "\" in this scenario");
  dimming_.factors[edit.group] = edit.factor;
  to_all({{"type", "factors"}, {"factors", {{edit.group, edit.factor}}}});
}

void ViewHub::handle(Viewer& viewer, const ScenarioEdit& edit) {
  const auto found = find_scenario(*scene_, edit.name);
  if (!found.ok()) return refuse(viewer, found.problem().what);
  wish_.scenario = edit.name;
  dimming_.seconds = seconds_said(found.value());
  trace_->wish(wish_);
}

void ViewHub::handle(Viewer&, const SmokeEdit& edit) {
  wish_.smoke = edit.factor;
  trace_->wish(wish_);
}

void ViewHub::share() {
  dimming_.shares = shares_after(*scene_, generation_.scene->scenario.operation, dimming_.seconds);
}

void ViewHub::handle(Viewer& viewer, const TimeEdit& edit) {
  if (!generation_.scene || generation_.scene->scenario.operation == Operation::mains)
    return refuse(viewer, "in this scenario the mains have not failed");
  dimming_.seconds = edit.seconds;
  share();
  Json shares = Json::object();
  for (const Group& group : generation_.scene->groups) {
    const auto at = dimming_.shares.find(group.name);
    shares[group.name] = at == dimming_.shares.end() ? 1.0 : at->second;
  }
  to_all({{"type", "time"},
          {"seconds", edit.seconds ? Json(*edit.seconds) : Json()},
          {"shares", shares}});
}

void ViewHub::handle(Viewer& viewer, const MoveEdit& edit) {
  const auto is_it = [&](const auto& one) { return one.name == edit.name; };
  const bool known = edit.is_sign
                         ? std::any_of(scene_->signs.begin(), scene_->signs.end(), is_it)
                         : std::any_of(scene_->emitters.begin(), scene_->emitters.end(), is_it);
  if (!known) return refuse(viewer, "there is no \"" + edit.name + "\" to move");
  if (edit.facing) {
    const auto aim = edit.is_sign ? frame_facing : frame_aiming;
    if (const auto frame = aim(edit.position, *edit.facing, {0, 0, 1}); !frame.ok())
      return refuse(viewer, frame.problem().what);
  }
  auto& moves = edit.is_sign ? wish_.signs : wish_.luminaires;
  moves[edit.name] = {edit.position, edit.facing};
  trace_->wish(wish_);
}

void ViewHub::handle(Viewer& viewer, const SaveEdit& edit) {
  if (!is_plain_name(edit.name))
    return refuse(viewer, "a name is made of letters, digits, spaces, _ and -");
  const auto file = options_.save_folder / (edit.name + ".toml");
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored))
    return refuse(viewer, file.string() + " is there already: take another name");
  const auto saved =
      write_file_atomically(file, variant_text(*scene_, wish_, dimming_.factors, edit.name));
  if (!saved.ok()) return refuse(viewer, saved.problem().text());
  viewer.send_text(text_of({{"type", "saved"}, {"file", file.string()}}));
}

void ViewHub::handle(Viewer& viewer, const EditWish& wish) {
  if (wish.wanted) return make_editor(&viewer);
  if (editor_ == &viewer) make_editor(nullptr);
}

// ---- questions ---------------------------------------------------------------------------------

void ViewHub::handle(Viewer& viewer, const ProbeAsk& ask) {
  trace_->ask({viewers_[&viewer], ask.id, ask.triangle, ask.front, dimming_.both()});
}

void ViewHub::handle(Viewer& viewer, const JudgeAsk& ask) {
  if (judging_) return refuse(viewer, "one sign after another: the last is not judged yet");
  judging_ = true;
  if (judge_.joinable()) judge_.join();
  const uint64_t number = viewers_[&viewer];
  // Beside the tracing: it shares the processors with it for some seconds.
  judge_ = std::thread([this, number, sign = ask.sign, wish = wish_, factors = dimming_.both()] {
    const Json verdicts = sign_verdicts(*scene_, wish, factors, sign, options_.live, ends_);
    post_([this, number, verdicts] {
      judging_ = false;
      if (Viewer* const asked = viewer_of(number)) asked->send_text(text_of(verdicts));
    });
  });
}

}  // namespace luxodus

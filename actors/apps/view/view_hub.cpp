#include "actors/apps/view/view_hub.hpp"

#include <algorithm>
#include <cmath>

#include "actors/apps/view/library.hpp"
#include "actors/judge/assess/assessment_inputs.hpp"
#include "actors/judge/inspect/inspect.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/output_text.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/world/files_as_read.hpp"

namespace luxodus {

namespace {

/// Things may stand outside the building up to this multiple of its size: across the street.
constexpr double sizes_outside = 10;

LiveFrame text_of(const Json& message) {
  return std::make_shared<const std::string>(message.dump());
}

bool is_there(const SceneDescription& scene, bool is_sign, const std::string& name) {
  const auto is_it = [&](const auto& one) { return one.name == name; };
  return is_sign ? std::any_of(scene.signs.begin(), scene.signs.end(), is_it)
                 : std::any_of(scene.emitters.begin(), scene.emitters.end(), is_it);
}

Json step_json(const EditStep& step) {
  return {{"kind", name_of(step.kind)},
          {"name", step.names.empty() ? Json() : Json(step.names.front())},
          {"count", step.names.size()},
          {"value", optional_json(step.value)}};
}

/// Whether a name is a plain file name.
bool is_plain_name(const std::string& name) {
  return name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_- ") ==
             std::string::npos &&
         !name.empty() && name.front() != ' ' && name.back() != ' ';
}

/// Written under another name first, where it is read back and inspected as by `luxodus check`: a
/// saved variant is a scene that can be computed.
Result<void> save_variant(const std::filesystem::path& file, const std::string& text,
                          const std::string& scenario, std::optional<double> at_s) {
  const auto trial = file.parent_path() / ("." + file.stem().string() + ".trial.toml");
  if (auto ok = write_file_atomically(trial, text); !ok) return ok.problem();
  auto read = read_scene(trial, at_s);
  std::error_code ignored;
  std::filesystem::remove(trial, ignored);
  const auto unfit = [](const Problem& why) {
    return problem("it is not saved, since it would be no scene: " + why.what);
  };
  if (!read.scene) return unfit(read.problems.list().front());
  const auto scene = std::make_shared<const SceneDescription>(std::move(*read.scene));
  const auto state = find_scenario(*scene, scenario);
  if (!state) return unfit(state.problem());
  if (auto compiled = compile_scene(scene, state.value(), {}); !compiled)
    return unfit(compiled.problem());
  const auto found = inspect(scene, {state.value()}, 1);
  if (!found) return unfit(found.problem());
  if (has_error(found.value())) return unfit(found->front().problem);  // errors come first
  return write_file_atomically(file, text);
}

/// Distance of a place from the box [m].
double outside(const Bounds& box, const glm::dvec3& place) {
  return glm::length(glm::max(glm::max(box.low - place, place - box.high), glm::dvec3(0)));
}

}  // namespace

ViewHub::ViewHub(std::shared_ptr<const SceneDescription> scene, const HubOptions& options,
                 Post post)
    : scene_(std::move(scene)),
      options_(options),
      post_(std::move(post)),
      edits_(options.first),
      history_({options.first, {}}),
      backdrops_(backdrops_json(backdrops_of(*scene_)).dump()),
      library_(library_json(*scene_).dump()) {
  if (const auto scenario = find_scenario(*scene_, edits_.scenario); scenario)
    dimming_.seconds = seconds_said(scenario.value());
  if (scene_->time && options_.live.scene_at) edits_.at_s = scene_->at_s;
  trace_.reset(new LiveTrace(scene_, options_.live, edits_, *this));
  const auto scene_at = [this](std::optional<double> at_s) { return scene_as_opened(at_s); };
  const auto tell = [this](uint64_t number, const Json& message) {
    post_([this, number, text = text_of(message)] {
      if (Viewer* const viewer = viewer_of(number)) viewer->send_text(text);
    });
  };
  pictures_ = std::make_unique<ViewPictures>(options_.live, scene_at, tell, options_.pictures);
  answers_ = std::make_unique<ViewAnswers>(options_.live, scene_at, tell);
}

ViewHub::~ViewHub() {
  answers_.reset();
  pictures_.reset();
  trace_.reset();
}

// ---- from the tracing thread -------------------------------------------------------------------

void ViewHub::begins(const LiveGeneration& generation) {
  post_([this, generation] {
    const LiveGeneration before = std::exchange(generation_, generation);
    if (before.scene && before.edits.at_s != generation.edits.at_s)
      take_seconds(generation.edits.scenario);
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
      if (generation.triangles_before)  // a viewer cannot reuse light of other triangles
        for (const auto& [at, frame] : light_) viewer->send_binary(frame, true);
      else
        for (const LiveFrame& frame : waiting)
          if (const LiveFrame now = carried(frame, before)) viewer->send_binary(now, true);
    }
  });
}

LiveFrame ViewHub::carried(const LiveFrame& frame, const LiveGeneration& from) const {
  const FrameHead head = head_of(frame);
  if (!from.scene || head.a >= from.scene->groups.size()) return nullptr;
  const std::vector<Group>& now = generation_.scene->groups;
  for (uint32_t g = 0; g < now.size(); ++g) {
    if (now[g].name != from.scene->groups[head.a].name) continue;
    if (generation_.lights[g] == ShownLight::none) return nullptr;
    const bool moves = generation_.triangles_before && is_surface_light(head);
    return readdressed(moves ? relaid(frame, *generation_.triangles_before) : frame,
                       generation_.number, g);
  }
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

void ViewHub::refuses(uint64_t number, const std::string& why) {
  post_([this, number, why] {
    // Later edits are judged by themselves, including what remains of the refused ones.
    if (number == wish_number_) {
      take_back();
      dim_as(history_.take_back({edits_, dimming_.factors}));
      to_all(history_json());
    }
    to_all({{"type", "refused"}, {"why", why}});
  });
}

void ViewHub::trace_edits() {
  trace_->trace_edits(edits_, ++wish_number_);
}

/// Restores the edits that are traced.
void ViewHub::take_back() {
  if (!generation_.scene) return;
  for (const SceneEdits::Copy& copy : edits_.added)
    if (std::none_of(generation_.edits.added.begin(), generation_.edits.added.end(),
                     [&](const SceneEdits::Copy& one) { return one.name == copy.name; }))
      dimming_.factors.erase(copy.is_sign ? group_of_sign(copy.name)
                                          : group_of_luminaire(copy.name));
  if (edits_.scenario != generation_.edits.scenario) take_seconds(generation_.edits.scenario);
  edits_ = generation_.edits;
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
  viewer.send_text(text_of(history_json()));
  if (generation_.scene) greet(viewer);
}

void ViewHub::leaves(Viewer& viewer) {
  pictures_->cancel(viewers_[&viewer]);
  answers_->forget(viewers_[&viewer]);
  viewers_.erase(&viewer);
  if (editor_ == &viewer) editor_ = nullptr;
}

/// Sends everything known so far.
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
  const auto message = decode_page_message(text);
  if (!message) return refuse(viewer, message.problem().what);
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
  if (edit.factor == 1)
    dimming_.factors.erase(edit.group);
  else
    dimming_.factors[edit.group] = edit.factor;
  to_all({{"type", "factors"}, {"factors", {{edit.group, edit.factor}}}});
  note(EditKind::factor, edit.group, edit.factor);
}

void ViewHub::handle(Viewer& viewer, const ScenarioEdit& edit) {
  const auto found = find_scenario(*scene_, edit.name);
  if (!found) return refuse(viewer, found.problem().what);
  edits_.scenario = edit.name;
  take_seconds(edit.name);
  note(EditKind::scenario, edit.name);
  trace_edits();
}

void ViewHub::handle(Viewer&, const SmokeEdit& edit) {
  edits_.smoke = edit.factor;
  note(EditKind::smoke, "", edit.factor);
  trace_edits();
}

void ViewHub::handle(Viewer& viewer, const StateEdit& edit) {
  if (!scene_->time || !options_.live.scene_at)
    return refuse(viewer, "this scene has one state: [time] gives it others");
  if (edit.at_s < scene_->time->from_s || edit.at_s > scene_->time->to_s)
    return refuse(viewer, "the states of this scene are from " +
                              readable_number(scene_->time->from_s, 6) + " to " +
                              readable_number(scene_->time->to_s, 6) + " s");
  edits_.at_s = edit.at_s;
  trace_edits();
}

void ViewHub::take_seconds(const std::string& scenario) {
  if (const auto found = find_scenario(scene_now(), scenario); found)
    dimming_.seconds = seconds_said(found.value());
}

void ViewHub::share() {
  const CompiledScene& now = *generation_.scene;
  dimming_.shares = shares_after(*now.description, now.scenario.operation, dimming_.seconds);
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
          {"seconds", optional_json(edit.seconds)},
          {"shares", shares}});
}

void ViewHub::handle(Viewer& viewer, const MoveEdit& edit) {
  const auto copy = added(edit.name);
  const bool is_copy = copy != edits_.added.end() && copy->is_sign == edit.is_sign;
  if (!is_copy && !is_there(*scene_, edit.is_sign, edit.name))
    return refuse(viewer, "there is no \"" + edit.name + "\" to move");
  if (!can_stand(viewer, edit.is_sign, edit.position, edit.facing)) return;
  auto& moves = edit.is_sign ? edits_.signs : edits_.luminaires;
  moves[edit.name] = {edit.position, edit.facing};
  note(EditKind::move, edit.name);
  trace_edits();
}

std::vector<SceneEdits::Copy>::const_iterator ViewHub::added(const std::string& name) const {
  return std::find_if(edits_.added.begin(), edits_.added.end(),
                      [&](const SceneEdits::Copy& copy) { return copy.name == name; });
}

bool ViewHub::can_stand(Viewer& viewer, bool is_sign, const glm::dvec3& position,
                        const std::optional<glm::dvec3>& facing) {
  if (generation_.scene) {
    const auto& box = generation_.scene->bounds;
    const double size = glm::length(box.high - box.low);
    // Nothing is lit farther away, and whatever is measured from the centre of all would lose the
    // building.
    if (const double far = outside(box, position); far > sizes_outside * size) {
      refuse(viewer, "that place is " + readable_number(far, 3) + " m outside of the building");
      return false;
    }
  }
  if (!facing) return true;
  const auto frame = (is_sign ? frame_facing : frame_aiming)(position, *facing, {0, 0, 1});
  if (!frame) refuse(viewer, frame.problem().what);
  return frame.ok();
}

void ViewHub::handle(Viewer& viewer, const AddEdit& edit) {
  if (edits_.added.size() >= limits::view_added)
    return refuse(viewer, "no more than " + std::to_string(limits::view_added) +
                              " can be added in one view: save it as a variant and view that");
  // A copy of a copy refers to the scene's original, so that either may be removed.
  const auto copied = added(edit.of);
  const bool of_copy =
      !edit.of_type && copied != edits_.added.end() && copied->is_sign == edit.is_sign;
  const SceneEdits::Copy copy{edit.is_sign, of_copy ? copied->of : edit.of,
                              name_for_copy(*scene_, edits_, edit.of, edit.of_type),
                              of_copy ? copied->of_type : edit.of_type};
  const Emitter* const luminaire = copy.is_sign ? nullptr : luminaire_to_copy(*scene_, copy);
  if (luminaire == nullptr && (!copy.is_sign || sign_to_copy(*scene_, copy) == nullptr))
    return refuse(viewer, "there is no \"" + edit.of + "\" to copy");
  if (luminaire != nullptr && luminaire->shape == EmitterShape::mesh)
    return refuse(viewer, "\"" + edit.of + "\" is a mesh, which does not move: it is not copied");
  if (copy.name.size() > limits::view_name_chars)
    return refuse(viewer, "the copy's name would be too long: give the original a shorter one");
  if (!can_stand(viewer, edit.is_sign, edit.position, edit.facing)) return;
  if (copy.is_sign && copy.of_type && !edit.facing)
    return refuse(viewer, "a sign of a type needs \"facing\": it hangs nowhere yet");
  place_copy(copy, edit);
  viewer.send_text(text_of({{"type", "added"},
                            {"kind", copy.is_sign ? "sign" : "luminaire"},
                            {"of", edit.of},
                            {"name", copy.name}}));
  note(EditKind::add, copy.name);
  trace_edits();
}

/// A copy stands and is dimmed like its original; one of a type has none.
void ViewHub::place_copy(const SceneEdits::Copy& copy, const AddEdit& edit) {
  auto& moves = copy.is_sign ? edits_.signs : edits_.luminaires;
  SceneEdits::Move move{edit.position, edit.facing};
  if (!edit.of_type) {
    if (const auto at = moves.find(edit.of); !move.facing && at != moves.end())
      move.facing = at->second.facing;
    const auto group_of = copy.is_sign ? group_of_sign : group_of_luminaire;
    if (const auto dimmed = dimming_.factors.find(group_of(edit.of));
        dimmed != dimming_.factors.end())
      dimming_.factors[group_of(copy.name)] = dimmed->second;
  }
  moves[copy.name] = move;
  edits_.added.push_back(copy);
}

void ViewHub::handle(Viewer& viewer, const RemoveEdit& edit) {
  const auto copy = added(edit.name);
  if (copy == edits_.added.end())
    return refuse(viewer,
                  "only what was added in this view is removed, and \"" + edit.name + "\" was not");
  (copy->is_sign ? edits_.signs : edits_.luminaires).erase(edit.name);
  dimming_.factors.erase(copy->is_sign ? group_of_sign(edit.name) : group_of_luminaire(edit.name));
  edits_.added.erase(copy);
  note(EditKind::remove, edit.name);
  trace_edits();
}

void ViewHub::note(EditKind kind, const std::string& name, std::optional<double> value) {
  EditStep step{kind, {}, value};
  if (!name.empty()) step.names.push_back(name);
  const auto noted = history_.note(std::move(step), {edits_, dimming_.factors},
                                   std::chrono::steady_clock::now());
  if (noted == EditHistory::Noted::continued)  // many times a second, while a slider is dragged
    to_all({{"type", "step"}, {"last", step_json(history_.steps().back())}});
  if (noted == EditHistory::Noted::changed) to_all(history_json());
}

Json ViewHub::history_json() const {
  Json steps = Json::array();
  for (const EditStep& step : history_.steps()) steps.push_back(step_json(step));
  return {{"type", "history"}, {"steps", std::move(steps)}, {"done", history_.done()}};
}

void ViewHub::handle(Viewer& viewer, const HistoryEdit& edit) {
  const auto done = static_cast<size_t>(edit.done);
  if (done > history_.steps().size())
    return refuse(viewer, "there are only " + std::to_string(history_.steps().size()) +
                              " steps to undo or redo");
  const EditedState state = history_.go_to(done);
  SceneEdits edits = state.edits;
  edits.at_s = edits_.at_s;
  dim_as(state.factors);
  if (edits.scenario != edits_.scenario) take_seconds(edits.scenario);
  const bool traced_anew = !(edits == edits_);
  edits_ = std::move(edits);
  to_all(history_json());
  if (traced_anew) trace_edits();
}

void ViewHub::dim_as(const std::map<std::string, double>& factors) {
  const auto of = [](const std::map<std::string, double>& all, const std::string& group) {
    const auto at = all.find(group);
    return at == all.end() ? 1.0 : at->second;
  };
  std::map<std::string, double> either = factors;
  either.insert(dimming_.factors.begin(), dimming_.factors.end());
  Json changed = Json::object();
  for (const auto& [group, ignored] : either)
    if (of(factors, group) != of(dimming_.factors, group)) changed[group] = of(factors, group);
  dimming_.factors = factors;
  if (!changed.empty()) to_all({{"type", "factors"}, {"factors", std::move(changed)}});
}

void ViewHub::handle(Viewer& viewer, const SaveEdit& edit) {
  if (!is_plain_name(edit.name))
    return refuse(viewer, "a name is made of letters, digits, spaces, _ and -");
  const auto file = options_.save_folder / (edit.name + ".toml");
  // A variant includes the file in its present state.
  if (scene_->files)
    if (auto ok = scene_->files->unchanged_on_disk(); !ok)
      return refuse(viewer, ok.problem().text());
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored))
    return refuse(viewer, file.string() + " is there already: take another name");
  const auto saved =
      save_variant(behind_links(file), variant_text(*scene_, edits_, dimming_.factors, edit.name),
                   edits_.scenario, scene_->at_s);
  if (!saved) return refuse(viewer, saved.problem().text());
  viewer.send_text(text_of({{"type", "saved"}, {"file", file.string()}}));
}

void ViewHub::handle(Viewer& viewer, const EditWish& edits) {
  if (edits.wanted) return make_editor(&viewer);
  if (editor_ == &viewer) make_editor(nullptr);
}

// ---- questions ---------------------------------------------------------------------------------

void ViewHub::handle(Viewer& viewer, const ProbeAsk& ask) {
  trace_->ask({viewers_[&viewer], ask.id, ask.triangle, ask.front, dimming_.both()});
}

void ViewHub::handle(Viewer& viewer, const JudgeAsk& ask) {
  put(viewer, ask);
}

void ViewHub::handle(Viewer& viewer, const RenderAsk& ask) {
  pictures_->order({viewers_[&viewer], ask, edits_, dimming_.both()});
}

void ViewHub::handle(Viewer& viewer, const RenderStop&) {
  pictures_->cancel(viewers_[&viewer]);
}

void ViewHub::handle(Viewer& viewer, const SuggestAsk& ask) {
  put(viewer, ask);
}

void ViewHub::handle(Viewer& viewer, const ChecksAsk& ask) {
  put(viewer, ask);
}

void ViewHub::put(Viewer& viewer, ViewQuestion question) {
  answers_->put({viewers_[&viewer], std::move(question), edits_, dimming_});
}

Result<std::shared_ptr<const SceneDescription>> ViewHub::scene_as_opened(
    std::optional<double> at_s) const {
  // If the scene's file was edited meanwhile, the question would be about another scene.
  if (scene_->files)
    if (auto ok = scene_->files->unchanged_on_disk(); !ok) return ok.problem();
  return trace_->scene_at(at_s);
}

}  // namespace luxodus

#include "actors/judge/visibility_map/sign_estimates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "actors/judge/visibility_map/signs_in_state.hpp"

namespace luxodus {

namespace {

/// A scene at a time, and the scenario judged in it.
struct State {
  std::shared_ptr<const SceneDescription> scene;
  Scenario scenario;
};

Result<State> state_at(const StatesToAssess& states, std::optional<double> time_s,
                       const std::string& scenario) {
  State out{states.last, {}};
  if (time_s) {
    auto scene = states.reader(*time_s);
    if (!scene) return scene.problem();
    out.scene = std::move(scene).value();
  }
  auto judged = judged_scenario(*out.scene, scenario);
  if (!judged) return judged.problem();
  out.scenario = std::move(judged).value();
  return out;
}

Result<void> check_pairs(const SceneDescription& scene, size_t eyes, size_t signs) {
  if (eyes <= limits::estimated_eyes && eyes * signs <= limits::estimated_pairs) return {};
  return problem_in(
      scene.file,
      fmt::format("{} places and {} signs make {} pairs; at most {} places and {} "
                  "pairs are estimated: take a larger spacing, or fewer signs",
                  eyes, signs, eyes * signs, limits::estimated_eyes, limits::estimated_pairs));
}

}  // namespace

Result<std::vector<uint32_t>> signs_named(const SceneDescription& scene,
                                          const std::vector<std::string>& names) {
  std::vector<uint32_t> out;
  if (names.empty()) {
    out.resize(scene.signs.size());
    std::iota(out.begin(), out.end(), 0);
    if (out.empty()) return problem_in(scene.file, "the scene has no sign: add [[sign]]");
    return out;
  }
  for (const std::string& name : names) {
    const auto at = std::find_if(scene.signs.begin(), scene.signs.end(),
                                 [&](const Sign& sign) { return sign.name == name; });
    if (at == scene.signs.end())
      return problem_in(scene.file,
                        fmt::format("there is no sign \"{}\"; see the names of [[sign]]", name));
    out.push_back(static_cast<uint32_t>(at - scene.signs.begin()));
  }
  return out;
}

Result<void> for_each_state(const EstimateRequest& request, const std::atomic<bool>& interrupt,
                            const AssessProgress& progress, const TakeState& take) {
  const StatesToAssess& states = request.states;
  const size_t count = std::max<size_t>(1, states.times_s.size());
  for (size_t i = 0; i < count; ++i) {
    const auto time_s = states.times_s.empty() ? std::nullopt : std::optional(states.times_s[i]);
    const auto state = state_at(states, time_s, request.options.scenario);
    if (!state) return state.problem();
    const auto signs = signs_named(*state->scene, request.signs);
    if (!signs) return signs.problem();
    if (auto ok = check_pairs(*state->scene, request.eyes.size(), signs->size()); !ok) return ok;
    const auto told = [&](const std::string& what, double share) {
      progress(count == 1 ? what
                          : fmt::format("state {} of {} ({:g} s), {}", i + 1, count, *time_s, what),
               (static_cast<double>(i) + share) / static_cast<double>(count));
    };
    auto made = SignsInState::make(*state->scene, state->scenario, signs.value(), request.eyes,
                                   request.options.one_of(count), interrupt, told);
    if (!made) return made.problem();
    take(i, std::move(made).value());
  }
  progress("all states", 1);
  return {};
}

SignEstimates::SignEstimates() = default;
SignEstimates::~SignEstimates() = default;

Result<std::unique_ptr<SignEstimates>> SignEstimates::make(const EstimateRequest& request,
                                                           const std::atomic<bool>& interrupt,
                                                           const AssessProgress& progress) {
  std::unique_ptr<SignEstimates> out(new SignEstimates);
  const auto signs = signs_named(*request.states.last, request.signs);
  if (!signs) return signs.problem();
  for (const uint32_t sign : signs.value())
    out->signs_.push_back(request.states.last->signs[sign].name);
  out->times_s_ = request.states.times_s;
  auto ok = for_each_state(request, interrupt, progress,
                           [&](size_t, std::unique_ptr<SignsInState> state) {
                             out->sure_errors_ = std::max(out->sure_errors_, state->sure_errors());
                             state->forget_estimates();
                             out->states_.push_back(std::move(state));
                           });
  if (!ok) return ok.problem();
  return out;
}

std::vector<SignEstimate> SignEstimates::at(std::span<const TimedEye> eyes) const {
  std::vector<SignEstimate> out(eyes.size() * signs_.size());
  std::vector<char> set(eyes.size(), 0);
  // States whose time is the first at or after that of an eye, and the one before.
  for (size_t s = 0; s < states_.size(); ++s) {
    std::vector<size_t> wanted;
    std::vector<glm::dvec3> places;
    for (size_t i = 0; i < eyes.size(); ++i) {
      bool uses = times_s_.empty();
      if (!uses && eyes[i].time_s >= times_s_.front() && eyes[i].time_s <= times_s_.back()) {
        const auto next = static_cast<size_t>(
            std::lower_bound(times_s_.begin(), times_s_.end(), eyes[i].time_s) - times_s_.begin());
        uses = s == next || (s + 1 == next && eyes[i].time_s < times_s_[next]);
      }
      if (!uses) continue;
      wanted.push_back(i);
      places.push_back(eyes[i].eye);
    }
    const std::vector<SignEstimate> here = states_[s]->of(places);
    for (size_t w = 0; w < wanted.size(); ++w) {
      for (size_t sign = 0; sign < signs_.size(); ++sign) {
        SignEstimate& estimate = out[wanted[w] * signs_.size() + sign];
        const SignEstimate& now = here[w * signs_.size() + sign];
        estimate = set[wanted[w]] != 0 ? worse_of(estimate, now) : now;
      }
      set[wanted[w]] = 1;
    }
  }
  return out;
}

SignEstimate SignEstimates::at(double time_s, const glm::dvec3& eye, size_t sign) const {
  const TimedEye one{time_s, eye};
  return at(std::span(&one, 1))[sign];
}

}  // namespace luxodus

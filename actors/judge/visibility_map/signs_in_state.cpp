// The veil of smoke before a face is what its line scatters into the eye. Divided by the share that
// the line takes away, it is the mean light on the line: the glow, which varies slowly from place
// to place. So is the light from beyond the face, divided by what the line lets pass. Both are
// traced at the supports. Light that the room throws on a face does not depend on the eye: all
// supports estimate it together.
#include "actors/judge/visibility_map/signs_in_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

/// Lines are also drawn to points close to the corners and the middles of the edges of a face, this
/// share of its edges apart: a face is whole only if its corners are.
constexpr double face_reach = 0.96;
/// Paths of each batch to each part of a view in the first round; each round has twice as many.
constexpr int64_t first_paths = 4;
/// Spacing of supports as a share of the distance to the sign, and its range [m].
constexpr double spacing_share = 0.35, least_spacing_m = 0.8, widest_spacing_m = 3;
/// Supports of one face: at first, and those that a round adds, at most.
constexpr size_t first_supports = 60, more_supports = 24;
/// Supports to which lines are drawn from a place, nearest first, at most.
constexpr size_t tried_supports = 12;
/// What a round makes of the errors: that of noise with four times the paths, and that of the
/// interpolation with supports half as far away. Where this decides nothing, nothing is traced.
constexpr Doubt next_round{0.5, 0.35};
/// By which a verdict on stinging smoke allows the share that its line lets pass to be less.
constexpr double sting_error = 0.02;
/// A pane of unknown colour may change the light of a sign by as much [share].
constexpr double pane_error = 0.05;

constexpr uint32_t no_face = none_index;

double spacing_at(double distance_m) {
  return std::clamp(spacing_share * distance_m, least_spacing_m, widest_spacing_m);
}

enum class Seen { nothing, part, whole };

struct FaceSeen {
  Seen seen = Seen::nothing;
  double solid = 0;  // at the centre: share of light that panes let pass
};

/// Hidden and whole are what an assessment says, and whole is asked for at the rim as well.
FaceSeen seen_of(const Building& building, const GeometryAccess& access, const Sign& sign,
                 const SignView& view, const glm::dvec3& eye) {
  FaceSeen out;
  const auto clear_to = [&](const glm::dvec2& uv) {
    const glm::dvec3 place = view.centre + sign.frame.axes[0] * (uv.x * sign.width_m) +
                             sign.frame.axes[1] * (uv.y * sign.height_m) + view.normal * 1e-3;
    return clear_share(building.scene(), access, building.local(eye), building.local(place));
  };
  int clear = 0, points = 0;
  for (const double v : {-0.5, 0.0, 0.5})
    for (const double u : {-0.5, 0.0, 0.5}) {
      const double share = clear_to(face_reach * glm::dvec2(u, v));
      ++points;
      clear += share > 0 ? 1 : 0;
      if (u == 0 && v == 0) out.solid = share;
    }
  const double within = building.seen_share(access, sign, view, eye);
  out.seen = clear == 0 && within == 0          ? Seen::nothing
             : clear == points && within == 1.0 ? Seen::whole
                                                : Seen::part;
  return out;
}

/// Sums and products whose errors add up: they hold bounds, which may all lie on one side.
Uncertain plus_bounds(const Uncertain& a, const Uncertain& b) {
  return {a.value + b.value, a.error + b.error};
}
Uncertain product_of_bounds(const Uncertain& a, const Uncertain& b) {
  return {a.value * b.value,
          std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
}

bool decides_more(const SignEstimate& a, const SignEstimate& b) {
  return a.answer != b.answer || a.surely_seen != b.surely_seen;
}

}  // namespace

SignsInState::SignsInState(JudgedScene judged, std::vector<uint32_t> signs,
                           const AssessOptions& options)
    : judged_(std::move(judged)),
      signs_(std::move(signs)),
      options_(options),
      traced_(judged_, options_) {}

SignsInState::~SignsInState() = default;

Result<std::unique_ptr<SignsInState>> SignsInState::make(
    const SceneDescription& scene, const Scenario& scenario, const std::vector<uint32_t>& signs,
    std::span<const glm::dvec3> eyes, const AssessOptions& options,
    const std::atomic<bool>& interrupt, const AssessProgress& progress) {
  auto judged = judged_scene(scene, scenario);
  if (!judged) return judged.problem();
  if (auto ok = irritation_is_said(scene, judged->scenario); !ok) return ok.problem();
  std::unique_ptr<SignsInState> out(new SignsInState(std::move(judged).value(), signs, options));
  if (auto ok = out->compile(); !ok) return ok.problem();
  if (auto ok = out->trace(eyes, interrupt, progress); !ok) return ok.problem();
  return out;
}

Result<void> SignsInState::compile() {
  auto made = Building::make(judged_.scene, judged_.scenario, options_.threads);
  if (!made) return made.problem();
  building_ = std::move(made).value();
  const CompiledScene& scene = building_->scene();
  faces_ = faces_of(scene);
  face_of_.assign(judged_.scene.signs.size(), {no_face, no_face});
  for (uint32_t f = 0; f < faces_.size(); ++f) face_of_[faces_[f].sign][faces_[f].back ? 1 : 0] = f;
  shares_ = luminous_shares(scene);
  factors_ = factors_of(scene, judged_.mixtures());
  glare_.emplace(*building_);
  by_face_.assign(faces_.size(), FaceLight(factors_.size()));
  const AssessmentSettings& people = judged_.scene.assessment;
  rules_ = {adapted_eye(people, judged_.scenario, people.age_years),
            people.irritant_smoke.value_or(false), 2, options_.place_unknown};
  return {};
}

void SignsInState::forget_estimates() {
  views_ = {};
  estimates_ = {};
}

size_t SignsInState::supports() const {
  size_t all = 0;
  for (const FaceLight& light : by_face_) all += light.supports().size();
  return all;
}

size_t SignsInState::lost_supports() const {
  size_t all = 0;
  for (const FaceLight& light : by_face_)
    for (const Support& support : light.supports()) all += is_lost(support) ? 1 : 0;
  return all;
}

bool SignsInState::is_lost(const Support& support) const {
  return traced_.is_face_lost(support.view) || traced_.is_beyond_lost(support.view);
}

// ---- what is seen from an eye ------------------------------------------------------------------

void SignsInState::look(const GeometryAccess& access, uint32_t eye_number, const glm::dvec3& eye,
                        std::span<SignEstimate> estimates, std::vector<View>& views) const {
  const bool stuck = building_->in_solid(access, eye);
  for (size_t slot = 0; slot < signs_.size(); ++slot) {
    const Sign& sign = judged_.scene.signs[signs_[slot]];
    SignEstimate& estimate = estimates[slot];
    View view;
    view.geometry = view_of_sign(sign, eye);
    const uint32_t face = face_of_[signs_[slot]][view.geometry.back_face ? 1 : 0];
    estimate.answer = SignAnswer::hidden;
    if (stuck || view.geometry.behind) continue;
    const FaceSeen seen = seen_of(*building_, access, sign, view.geometry, eye);
    if (seen.seen == Seen::nothing) continue;
    estimate.answer = SignAnswer::undecided;
    if (seen.seen == Seen::part || face == no_face || !(view.geometry.detail_arcmin > 0)) continue;
    view.eye = eye_number;
    view.slot = static_cast<uint32_t>(slot);
    view.face = face;
    view.solid = seen.solid;
    view.line =
        sight_line(building_->scene(), access, faces_[face], shares_, building_->local(eye));
    view.veils_cd_m2 = glare_->at(eye, view.geometry.centre, signs_[slot],
                                  judged_.scene.assessment.age_years, factors_);
    views.push_back(std::move(view));
  }
}

void SignsInState::find_near(const GeometryAccess& access, const glm::dvec3& eye,
                             View& view) const {
  const std::vector<Support>& supports = by_face_[view.face].supports();
  std::vector<NearSupport> by_distance;
  for (uint32_t s = 0; s < supports.size(); ++s)
    by_distance.push_back({s, glm::length(supports[s].eye - eye)});
  const size_t tried = std::min(tried_supports, by_distance.size());
  std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(tried),
                    by_distance.end(), [](const NearSupport& a, const NearSupport& b) {
                      return a.distance_m != b.distance_m ? a.distance_m < b.distance_m
                                                          : a.support < b.support;
                    });
  view.nears = 0;
  for (size_t i = 0; i < tried && view.nears < view.near.size(); ++i) {
    const glm::dvec3& other = supports[by_distance[i].support].eye;
    const bool sees =
        by_distance[i].distance_m < 1e-3 ||
        clear_share(building_->scene(), access, building_->local(eye), building_->local(other)) > 0;
    if (sees) view.near[view.nears++] = by_distance[i];
  }
}

// ---- the answer of a view ----------------------------------------------------------------------

double SignsInState::line_error(const View& view) {
  return view.line.passed_error + (view.solid < 1 ? pane_error : 0);
}

ViewLight SignsInState::light_of(const View& view, size_t mixture, const Uncertain& veil,
                                 const Uncertain& beyond) const {
  const FaceOfSign& face = faces_[view.face];
  const double sure = rules_.sure_errors;
  const double off = line_error(view);
  ViewLight out;
  for (size_t p = 0; p < face.parts.size(); ++p) {
    PartLight& part = out[p];
    const double passed = view.line.passed[p] * view.solid;
    part.own = {view.line.own[p] * factors_[mixture][face.parts[p].group], 0};
    part.reflected = by_face_[view.face].reflected(mixture)[p];
    part.transmission = {passed, passed * off / sure};
    part.visible = {1, 0};
    part.at_eye = plus_bounds(
        product_of_bounds(plus_bounds(part.own, part.reflected), part.transmission), veil);
  }
  PartLight& surround = out.back();
  surround.reflected =
      product_of_bounds(beyond, {view.line.passed_scene, view.line.passed_scene * off / sure});
  surround.at_eye = plus_bounds(surround.reflected, veil);
  surround.visible = {1, 0};
  return out;
}

Sight SignsInState::judge_in(const View& view, size_t mixture, const Doubt& doubt) const {
  const FaceLight& traced = by_face_[view.face];
  const double taken = 1 - view.line.passed_scene;
  Uncertain veil;
  if (taken > least_taken) {
    const Interpolated glow = traced.glow(mixture).at(view.near_supports());
    veil = times(taken, glow.at_worst(rules_.sure_errors, doubt));
    veil.value = std::max(0.0, veil.value);
  }
  const Uncertain beyond =
      traced.beyond(mixture).at(view.near_supports()).at_worst(rules_.sure_errors, doubt);
  const Sign& sign = judged_.scene.signs[signs_[view.slot]];
  const ViewLight light = light_of(view, mixture, veil, beyond);
  SignLook look = look_with_glare(view, light, mixture);
  Sight sight = judge_sight(sign, view.geometry, look, rules_);
  if (sight.verdict != SightVerdict::legible || !rules_.irritant_smoke) return sight;
  // Whether smoke stings depends on the line alone, and must hold with its error.
  look.transmission *= 1 - line_error(view) - sting_error;
  if (judge_sight(sign, view.geometry, look, rules_).stings) {
    sight.verdict = SightVerdict::undecided;
    sight.reason = remark(RemarkId::irritant_smoke);
  }
  return sight;
}

SignLook SignsInState::look_with_glare(const View& view, const ViewLight& light,
                                       size_t mixture) const {
  const SignFace& face = judged_.scene.signs[signs_[view.slot]].face;
  const double most = std::min(view.veils_cd_m2[mixture], any_luminance);
  if (view.exact_veils) return look_of(face, light, most);
  SignLook look = look_of(face, light, most / 2);
  for (Uncertain* background : {&look.ground, &look.surround})
    background->error += most / 2 / rules_.sure_errors;
  return look;
}

SignsInState::View SignsInState::without_glare(const View& view) {
  View out = view;
  out.exact_veils = true;
  std::fill(out.veils_cd_m2.begin(), out.veils_cd_m2.end(), 0.0);
  return out;
}

SignEstimate SignsInState::answer(const GeometryAccess& access, const glm::dvec3& eye,
                                  View& view) const {
  SignEstimate estimate = estimate_of(judge(view));
  if (view.exact_veils || estimate.answer != SignAnswer::undecided) return estimate;
  const SignEstimate best = estimate_of(judge(without_glare(view)));
  if (best.answer == SignAnswer::undecided && best.surely_seen == estimate.surely_seen)
    return estimate;
  const double age = judged_.scene.assessment.age_years;
  view.veils_cd_m2 = arriving_beside(*building_, access, eye, view.geometry.centre,
                                     signs_[view.slot], {age}, factors_)
                         .veils_cd_m2.front();
  view.exact_veils = true;
  return estimate_of(judge(view));
}

Sight SignsInState::judge(const View& view, const Doubt& doubt) const {
  Sight sight = judge_in(view, judged_.aged_mixture(0), doubt);
  if (judged_.ageing.any()) {
    Sight as_new = judge_in(view, judged_.new_mixture(0), doubt);
    if (is_worse(as_new, sight)) std::swap(sight, as_new);
  }
  // Light of new luminaires only veils more.
  if (!judged_.ageing.new_light_known && sight.verdict == SightVerdict::legible)
    sight.verdict = SightVerdict::not_assessed;
  return sight;
}

SignsInState::Needs SignsInState::needs_of(const View& view) const {
  // Glare is computed once it is all that is open.
  std::optional<View> unglared;
  if (!view.exact_veils) unglared = without_glare(view);
  const View& clear = unglared ? *unglared : view;
  const SignEstimate now = estimate_of(judge(clear));
  const auto decides = [&](const Doubt& doubt) {
    return decides_more(estimate_of(judge(clear, doubt)), now);
  };
  if (!decides(next_round)) return {};
  const bool by_noise = decides({next_round.noise, 1}), by_bound = decides({1, next_round.bound});
  if (by_noise) return {true, false};
  return {!by_bound, true};
}

void SignsInState::judge_all(std::span<const glm::dvec3> eyes) {
  building_->each(views_.size(), [&](const GeometryAccess& access, size_t v) {
    View& view = views_[v];
    if (!view.open) return;
    find_near(access, eyes[view.eye], view);
    SignEstimate& estimate = estimates_[view.eye * signs_.size() + view.slot];
    estimate = answer(access, eyes[view.eye], view);
    view.open = estimate.answer == SignAnswer::undecided;
    view.needs = view.open ? needs_of(view) : Needs{};
  });
}

std::vector<SignEstimate> SignsInState::of(std::span<const glm::dvec3> eyes) const {
  std::vector<SignEstimate> out(eyes.size() * signs_.size());
  building_->each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
    std::vector<View> views;
    const std::span<SignEstimate> here(out.data() + i * signs_.size(), signs_.size());
    look(access, static_cast<uint32_t>(i), eyes[i], here, views);
    for (View& view : views) {
      find_near(access, eyes[i], view);
      here[view.slot] = answer(access, eyes[i], view);
    }
  });
  return out;
}

// ---- supports ----------------------------------------------------------------------------------

size_t SignsInState::add_support(const View& view, const glm::dvec3& eye) {
  const FaceOfSign& face = faces_[view.face];
  Support support{eye, traced_.add(eye, face.sign, face.back), view.line.passed_scene, {}, {}};
  for (size_t p = 0; p < support.own.size(); ++p) {
    support.own[p] = view.line.own[p];
    support.arrives[p] = view.line.passed[p] * view.solid;
  }
  by_face_[view.face].add(support);
  return support.view;
}

/// Farthest points first, in units of the spacing there.
std::vector<size_t> SignsInState::add_supports(std::span<const glm::dvec3> eyes, int round) {
  const double finest = std::pow(0.5, round);
  const size_t most = round == 0 ? first_supports : more_supports;
  std::vector<std::vector<Wanted>> wanted(faces_.size());
  for (size_t v = 0; v < views_.size(); ++v) {
    const View& view = views_[v];
    if (round > 0 && !view.needs.supports) continue;
    double distance = std::numeric_limits<double>::infinity();
    for (const NearSupport& near : view.near_supports())
      distance = std::min(distance, near.distance_m / spacing_at(view.geometry.distance_m));
    if (distance >= finest) wanted[view.face].push_back({distance, v});
  }
  std::vector<size_t> added;
  for (std::vector<Wanted>& of_face : wanted)
    for (size_t n = 0; n < most && !of_face.empty(); ++n) {
      const auto farthest = std::max_element(
          of_face.begin(), of_face.end(),
          [](const Wanted& a, const Wanted& b) { return a.distance < b.distance; });
      if (farthest->distance < finest) break;
      const View& chosen = views_[farthest->view];
      const glm::dvec3 eye = eyes[chosen.eye];
      added.push_back(add_support(chosen, eye));
      for (Wanted& other : of_face) {
        const View& view = views_[other.view];
        other.distance = std::min(other.distance, glm::length(eyes[view.eye] - eye) /
                                                      spacing_at(view.geometry.distance_m));
      }
    }
  return added;
}

/// Those whose noise leaves views undecided.
std::vector<size_t> SignsInState::noisy_supports() const {
  std::vector<size_t> out;
  for (const View& view : views_) {
    if (!view.needs.paths) continue;
    for (const NearSupport& near : view.near_supports()) {
      const Support& support = by_face_[view.face].supports()[near.support];
      if (!is_lost(support)) out.push_back(support.view);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Compares each support with its neighbours.
void SignsInState::test_supports() {
  building_->each(faces_.size(), [&](const GeometryAccess& access, size_t face) {
    FaceLight& light = by_face_[face];
    for (uint32_t s = 0; s < light.supports().size(); ++s) {
      View place;
      place.face = static_cast<uint32_t>(face);
      find_near(access, light.supports()[s].eye, place);
      std::vector<NearSupport> others;
      for (const NearSupport& near : place.near_supports())
        if (near.support != s) others.push_back(near);
      light.test(s, others);
    }
  });
}

Result<void> SignsInState::trace_supports(const std::vector<size_t>& views, int round,
                                          const std::atomic<bool>& interrupt,
                                          const AssessProgress& progress) {
  if (auto ok = traced_.trace(views, first_paths << round, interrupt, progress); !ok) return ok;
  for (size_t face = 0; face < faces_.size(); ++face)
    by_face_[face].read(traced_, faces_[face], factors_);
  test_supports();
  return {};
}

Result<void> SignsInState::trace(std::span<const glm::dvec3> eyes,
                                 const std::atomic<bool>& interrupt,
                                 const AssessProgress& progress) {
  progress("lines of sight", 0);
  estimates_.assign(eyes.size() * signs_.size(), {});
  std::vector<std::vector<View>> views(eyes.size());
  building_->each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
    if (interrupt) return;
    look(access, static_cast<uint32_t>(i), eyes[i],
         {estimates_.data() + i * signs_.size(), signs_.size()}, views[i]);
  });
  if (interrupt) return problem("interrupted");
  for (std::vector<View>& of_eye : views) {
    views_.insert(views_.end(), std::make_move_iterator(of_eye.begin()),
                  std::make_move_iterator(of_eye.end()));
    of_eye = {};
  }
  const Comparisons comparisons{views_.size(), 2 * judged_.per_light(), options_.rounds};
  const double by_chance =
      luxodus::sure_errors(options_.wrong_verdicts, comparisons, static_cast<double>(view_batches));
  rules_.sure_errors = options_.sure_errors.value_or(by_chance);
  for (int round = 0; round < options_.rounds; ++round) {
    std::vector<size_t> traced = add_supports(eyes, round);
    if (round > 0) {
      const std::vector<size_t> noisy = noisy_supports();
      traced.insert(traced.end(), noisy.begin(), noisy.end());
      std::sort(traced.begin(), traced.end());
    }
    if (traced.empty()) break;
    const auto told = [&](const std::string& what, double share) {
      progress(fmt::format("round {}: {}", round + 1, what), (round + share) / options_.rounds);
    };
    if (auto ok = trace_supports(traced, round, interrupt, told); !ok) return ok;
    judge_all(eyes);
  }
  return {};
}

}  // namespace luxodus

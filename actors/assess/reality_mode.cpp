#include "actors/assess/reality_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "actors/assess/aged_light.hpp"
#include "actors/inspect/building.hpp"
#include "actors/run/run_executor.hpp"
#include "scenes/emergency/sign_face.hpp"
#include "scenes/emergency/veil.hpp"
#include "scenes/geometry/polygon.hpp"

namespace luxodus {

namespace {

/// Batches of a round at least, whose spread is the error; paths to each part of a sign in the
/// first round's batches, and at most in any: beyond that a round has more batches.
constexpr int64_t min_batches = 64, first_paths = 8, max_paths = 512;
/// compile's share of paths: 0.1 of the particles, divided among the parts.
constexpr double paths_per_particle = 0.1;

/// People keep so far from the walls of an area [m].
constexpr double area_border_m = 0.3;

/// Somebody at a place.
struct Stand {
  std::string from;
  double along_m = 0, stands_for = 0, height_m = 0;
  Observer observer;
  bool looks_ahead = true;  // else anywhere
};

Stand standing(const std::string& from, const glm::dvec3& foot, double height_m) {
  Stand stand;
  stand.from = from;
  stand.height_m = height_m;
  stand.observer.eye = foot + glm::dvec3(0, 0, height_m);
  stand.observer.name =
      fmt::format("{} at ({:.2f}, {:.2f}), {:.2f} m high", from, foot.x, foot.y, height_m);
  return stand;
}

void stand_on_routes(const SceneDescription& scene, std::vector<Stand>& out) {
  for (const EscapeRoute& route : scene.routes) {
    const auto people = walkers(route, scene.assessment.spacing_m);
    for (const Walker& walker : people)
      for (const double height : scene.assessment.eye_heights_m) {
        Stand stand = standing("route \"" + route.name + "\"", walker.foot, height);
        stand.along_m = walker.along_m;
        stand.stands_for = length_of(route) / static_cast<double>(people.size());
        stand.observer.gaze = walker.ahead;
        out.push_back(std::move(stand));
      }
  }
}

/// At the first height alone: where people cross an area they walk.
void stand_in_areas(const SceneDescription& scene, std::vector<Stand>& out) {
  for (const AssessedArea& area : scene.open_areas) {
    const auto places = within(area, area_border_m, scene.assessment.spacing_m);
    for (const glm::dvec3& place : places) {
      Stand stand = standing("open area \"" + area.name + "\"", place,
                             scene.assessment.eye_heights_m.front());
      stand.stands_for = std::abs(signed_area(area.outline)) / static_cast<double>(places.size());
      stand.looks_ahead = false;
      out.push_back(std::move(stand));
    }
  }
}

std::vector<Stand> stands_of(const SceneDescription& scene,
                             const std::vector<Observer>& observers) {
  std::vector<Stand> out;
  stand_on_routes(scene, out);
  stand_in_areas(scene, out);
  for (const Observer& observer : observers) {
    Stand stand;
    stand.from = "observer \"" + observer.name + "\"";
    stand.height_m = observer.eye.z;
    stand.observer = observer;
    out.push_back(std::move(stand));
  }
  return out;
}

/// Each round has four times the paths of the one before.
struct RoundSize {
  explicit RoundSize(int round)
      : paths(std::min(max_paths, first_paths << (2 * round))),
        batches(min_batches * ((first_paths << (2 * round)) / paths)) {}
  int64_t paths;  // of a batch, to each part
  int64_t batches;
};

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(
      std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

/// A sign as somebody faces it, before anything is known of its light.
SightRow row_of(const Stand& stand, const Sign& sign) {
  SightRow row;
  row.from = stand.from;
  row.stands_for = stand.stands_for;
  row.along_m = stand.along_m;
  row.height_m = stand.height_m;
  row.eye = stand.observer.eye;
  row.sign = sign.name;
  row.view = view_of_sign(sign, row.eye);
  row.back_face = row.view.back_face;
  row.gaze_deg = stand.looks_ahead ? angle_deg(row.view.centre - row.eye, stand.observer.gaze)
                                   : std::numeric_limits<double>::quiet_NaN();
  return row;
}

/// Veiling luminance in the eye [cd/m2].
struct Veil {
  double aged = 0, as_new = 0;
};

/// Of all emitters but the sign itself. Each part of an emitter lays its veil from where it is,
/// through the smoke before it: a flame is no point, and not in its middle. `renewals`: of source
/// groups.
Veil veil_of(const Building& building, const GeometryAccess& access, const SightRow& row,
             uint32_t sign, double age_years, const std::vector<double>& renewals) {
  const CompiledScene& scene = building.scene();
  const glm::dvec3 gaze = glm::normalize(row.view.centre - row.eye);
  Veil veil;
  for (const ArrivingLight& light :
       direct_arrivals(scene, access, building.local(row.eye), glm::vec3(gaze), {})) {
    const CompiledEmitter& emitter = scene.emitters[light.emitter];
    if (emitter.sign != none_index && scene.signs[emitter.sign].sign == sign) continue;
    const double part = light.illuminance_lx *
                        veil_per_lux(angle_deg(glm::dvec3(light.direction), gaze), age_years);
    veil.aged += part;
    veil.as_new += part * renewals[static_cast<size_t>(emitter.group)];
  }
  return veil;
}

/// Of independent samples, to first order.
Uncertain plus(const Uncertain& a, const Uncertain& b) {
  return {a.value + b.value, std::hypot(a.error, b.error)};
}
Uncertain product(const Uncertain& a, const Uncertain& b) {
  return {a.value * b.value, std::hypot(a.value * b.error, a.error * b.value)};
}

class RealityMode {
 public:
  /// `observers`: those that the scene names. Requires: all outlive it.
  RealityMode(const JudgedScene& judged, const std::vector<Observer>& observers,
              const OtherSmoke& smoke, const AssessOptions& options, Assessment& out)
      : judged_(judged), observers_(observers), smoke_(smoke), options_(options), out_(out) {}

  /// Who can see what, by straight lines. Errors: as assess_sights.
  Result<void> look_for_lines(const AssessProgress& progress);
  /// One round of paths for what is undecided. Errors: as assess_sights.
  Result<void> trace(int round, const std::atomic<bool>& interrupt, const AssessProgress& progress);
  bool anything_open() const { return !open_.empty(); }

 private:
  /// A row whose verdict is not yet there, and who looks.
  struct Open {
    size_t row;
    size_t stand;
    uint32_t sign;
    Veil veil;
  };
  RoundState round_state(int round) const;
  void judge_view(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
                  const Open& open) const;
  void judge(const CompiledScene& scene, const Totals& totals);

  const JudgedScene& judged_;
  const SceneDescription& scene_ = judged_.scene;
  const std::vector<Observer>& observers_;
  const OtherSmoke smoke_;
  const AssessOptions& options_;
  Assessment& out_;
  std::vector<Stand> stands_;
  std::vector<Open> open_;
  std::vector<size_t> asked_;  // stands of the round's observers
};

Result<void> RealityMode::look_for_lines(const AssessProgress& progress) {
  progress("lines of sight", 0);
  auto made = Building::make(scene_, judged_.scenario, options_.threads);
  if (!made) return made.problem();
  const Building& building = *made.value();
  const std::vector<double> renewals = judged_.ageing.renewals(building.scene());
  stands_ = stands_of(scene_, observers_);
  if (stands_.size() * scene_.signs.size() > limits::sights)
    return problem_in(scene_.file,
                      fmt::format("{} places and {} signs make more pairs than {}: take a larger "
                                  "spacing_m or fewer eye heights",
                                  stands_.size(), scene_.signs.size(), limits::sights));
  std::vector<std::vector<SightRow>> rows(stands_.size());
  std::vector<std::vector<Veil>> veils(stands_.size());
  std::vector<char> stuck(stands_.size(), 0);
  building.each(stands_.size(), [&](const GeometryAccess& access, size_t i) {
    const Stand& stand = stands_[i];
    stuck[i] = building.in_solid(access, stand.observer.eye) ? 1 : 0;
    for (uint32_t s = 0; s < scene_.signs.size(); ++s) {
      const Sign& sign = scene_.signs[s];
      if (!options_.sign.empty() && sign.name != options_.sign) continue;
      SightRow row = row_of(stand, sign);
      if (row.view.behind || (options_.wanted && !options_.wanted(row))) continue;
      const double seen = building.seen_share(access, sign, row.view, row.eye);
      row.look.visible_share = seen;
      row.line = line_of_sight(building, access, sign, row.view, row.eye);
      if (seen == 0) row.sight.verdict = SightVerdict::hidden;
      if (stuck[i] != 0) row.sight.reason = "the eye is in a solid thing";
      Veil veil;
      if (seen > 0 && stuck[i] == 0) {
        row.sight.verdict = SightVerdict::undecided;
        veil = veil_of(building, access, row, s, scene_.assessment.age_years, renewals);
        row.look.veil_cd_m2 = std::max(veil.aged, veil.as_new);
      }
      veils[i].push_back(veil);
      rows[i].push_back(std::move(row));
    }
  });
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t k = 0; k < rows[i].size(); ++k) {
      SightRow& row = rows[i][k];
      if (row.sight.verdict == SightVerdict::undecided) {
        const auto sign = std::find_if(scene_.signs.begin(), scene_.signs.end(),
                                       [&](const Sign& s) { return s.name == row.sign; });
        open_.push_back({out_.sights.size(), i, static_cast<uint32_t>(sign - scene_.signs.begin()),
                         veils[i][k]});
      }
      out_.sights.push_back(std::move(row));
    }
  return {};
}

/// Those who still have to look, and as many paths as the round has.
RoundState RealityMode::round_state(int round) const {
  RoundState out{judged_.scenario.name, scene_.at_s, smoke_, 0, {}};
  size_t last = stands_.size();
  for (const Open& open : open_) {
    if (open.stand != last) {
      out.observers.push_back(stands_[open.stand].observer);
      out.observers.back().signs.emplace();
      last = open.stand;
    }
    out.observers.back().signs->push_back(open.sign);
  }
  const auto paths = static_cast<double>(RoundSize(round).paths);
  const auto parts = static_cast<double>(3 * open_.size());
  // Half a path more, so that rounding down gives this many.
  out.eye_path_factor = (paths + 0.5) * parts /
                        (paths_per_particle * static_cast<double>(limits::round_batch_particles));
  return out;
}

/// What arrives at the eye from one sign, in aged light, or in new: its source groups, each times
/// its renewal.
class ViewReadout {
 public:
  ViewReadout(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
              std::vector<double> renewals)
      : readout_(readout), scene_(scene), target_(target), renewals_(std::move(renewals)) {}

  SignLook look(double veil, bool as_new) const;

 private:
  Uncertain of(uint32_t part, EyeQuantity quantity, bool as_new) const;

  const Readout& readout_;
  const CompiledScene& scene_;
  const EyeTarget& target_;
  std::vector<double> renewals_;  // of source groups
};

Uncertain ViewReadout::of(uint32_t part, EyeQuantity quantity, bool as_new) const {
  const uint32_t bin = target_.first_bin + part;
  const bool ages = quantity == EyeQuantity::at_eye || quantity == EyeQuantity::reflected;
  if (!as_new || !ages || renewals_.size() == 1) {
    const Estimate e = readout_.value(scene_.blocks.views, bin, static_cast<uint32_t>(quantity));
    const double renewal = as_new && ages ? renewals_.front() : 1;
    return {e.value * renewal, e.standard_error * renewal};
  }
  const auto part_of_group =
      quantity == EyeQuantity::at_eye ? GroupEyeQuantity::at_eye : GroupEyeQuantity::reflected;
  const auto groups = static_cast<uint32_t>(renewals_.size());
  Uncertain sum;
  for (uint32_t g = 0; g < groups; ++g) {
    const Estimate e = readout_.value(scene_.blocks.views_by_group, bin * groups + g,
                                      static_cast<uint32_t>(part_of_group));
    sum.value += renewals_[g] * e.value;
    // The groups' parts are of the same paths: errors may all go one way.
    sum.error += renewals_[g] * e.standard_error;
  }
  return sum;
}

SignLook ViewReadout::look(double veil, bool as_new) const {
  const SignFace& face = scene_.description->signs[scene_.signs[target_.sign].sign].face;
  const Uncertain white = of(0, EyeQuantity::at_eye, as_new);
  const Uncertain green = of(1, EyeQuantity::at_eye, as_new);
  const bool white_legend = face.legend == SignColour::white;
  const double w = colour_share(face, SignColour::white), g = colour_share(face, SignColour::green);
  const double all = std::max(w + g, 1e-12);
  SignLook look;
  look.legend = white_legend ? white : green;
  look.ground = white_legend ? green : white;
  look.face = {(w * white.value + g * green.value) / all,
               std::hypot(w * white.error, g * green.error) / all};
  look.surround = of(2, EyeQuantity::at_eye, as_new);
  const auto mean_of_colours = [&](EyeQuantity q) {
    return (w * of(0, q, as_new).value + g * of(1, q, as_new).value) / all;
  };
  look.visible_share = mean_of_colours(EyeQuantity::visible);
  const double passed = mean_of_colours(EyeQuantity::transmission);
  look.transmission = look.visible_share > 0 ? passed / look.visible_share : 0;
  look.veil_cd_m2 = veil;
  const auto arrives = [&](uint32_t part) {
    return product(
        plus(of(part, EyeQuantity::own, as_new), of(part, EyeQuantity::reflected, as_new)),
        of(part, EyeQuantity::transmission, as_new));
  };
  look.difference =
      plus(arrives(white_legend ? 0 : 1), product({-1, 0}, arrives(white_legend ? 1 : 0)));
  return look;
}

/// In aged light and, where it differs, in new: the worse verdict counts.
void RealityMode::judge_view(const Readout& readout, const CompiledScene& scene,
                             const EyeTarget& target, const Open& open) const {
  const SightRules rules{{scene_.assessment.age_years},
                         scene_.assessment.irritant_smoke.value_or(false)};
  const ViewReadout view(readout, scene, target, judged_.ageing.renewals(scene));
  const Sign& sign = scene_.signs[open.sign];
  SightRow& row = out_.sights[open.row];
  row.look = view.look(open.veil.aged, false);
  row.sight = judge_sight(sign, row.view, row.look, rules);
  row.in_new_light = false;
  row.other.reset();
  if (!judged_.ageing.any()) return;
  SightRow::Other as_new{view.look(open.veil.as_new, true), {}};
  as_new.sight = judge_sight(sign, row.view, as_new.look, rules);
  if (is_worse(as_new.sight, row.sight)) {
    std::swap(row.look, as_new.look);
    std::swap(row.sight, as_new.sight);
    row.in_new_light = true;
  }
  row.other = std::move(as_new);
}

void RealityMode::judge(const CompiledScene& scene, const Totals& totals) {
  const Readout readout(scene, totals);
  std::map<std::tuple<size_t, uint32_t, bool>, const EyeTarget*> targets;
  for (const EyeTarget& target : scene.eye_targets) {
    const CompiledSign& face = scene.signs[target.sign];
    targets[{asked_[target.observer], face.sign, face.back}] = &target;
  }
  std::vector<Open> still;
  for (const Open& open : open_) {
    SightRow& row = out_.sights[open.row];
    const auto target = targets.find({open.stand, open.sign, row.back_face});
    if (target == targets.end()) {  // within rounding of the face's own plane
      row.sight.verdict = SightVerdict::not_assessed;
      row.sight.reason = "it is seen edge-on";
      continue;
    }
    judge_view(readout, scene, *target->second, open);
    if (row.sight.verdict == SightVerdict::undecided) still.push_back(open);
  }
  open_ = std::move(still);
}

Result<void> RealityMode::trace(int round, const std::atomic<bool>& interrupt,
                                const AssessProgress& progress) {
  const std::string what = fmt::format("round {}: {} views", round + 1, open_.size());
  progress(what, 0);
  asked_.clear();
  for (const Open& open : open_)
    if (asked_.empty() || asked_.back() != open.stand) asked_.push_back(open.stand);
  const RoundState state = round_state(round);
  auto compiled = compile_round(judged_, state);
  if (!compiled) return compiled.problem();
  const uint64_t seed = options_.seed + static_cast<uint64_t>(round);
  LocalRun run(compiled.value(), seed, options_.threads);
  StopRule stop;
  stop.particles = RoundSize(round).batches * limits::round_batch_particles;
  RunThreads threads;
  RunExecutor& executor = options_.executor == nullptr ? threads : *options_.executor;
  executor.enter({seed, round_text(state)});
  const auto reason = executor.run(run, stop, interrupt, [&](const Progress& p) {
    progress(what, static_cast<double>(p.particles) / static_cast<double>(*stop.particles));
  });
  if (!reason) return reason.problem();
  if (reason.value() == StopReason::interrupted) return problem("interrupted");
  out_.paths += run.batches() * int64_t{run.scene().eye_paths_per_batch} *
                static_cast<int64_t>(3 * run.scene().eye_targets.size());
  judge(run.scene(), run.totals());
  progress(what, 1);
  return {};
}

}  // namespace

Result<void> assess_sights(const SceneDescription& scene, const Scenario& scenario,
                           const OtherSmoke& smoke, const AssessOptions& options,
                           const std::atomic<bool>& interrupt, const AssessProgress& progress,
                           Assessment& out) {
  const auto judged = judged_scene(scene, scenario, smoke);
  if (!judged) return judged.problem();
  if (auto ok = irritation_is_said(scene, judged->scenario); !ok) return ok.problem();
  RealityMode mode(judged.value(), scene.observers, smoke, options, out);
  if (auto ok = mode.look_for_lines(progress); !ok) return ok.problem();
  for (int round = 0; round < options.rounds && mode.anything_open(); ++round)
    if (auto ok = mode.trace(round, interrupt, progress); !ok) return ok.problem();
  return {};
}

}  // namespace luxodus

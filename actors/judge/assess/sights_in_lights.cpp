#include "actors/judge/assess/sights_in_lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "actors/judge/assess/arriving_beside.hpp"
#include "actors/judge/assess/traced_round.hpp"
#include "actors/judge/inspect/building.hpp"

namespace luxodus {

namespace {

/// Smallest number of batches of a round, whose spread gives the error; paths per batch to each
/// part of a sign, in the first round and at most: beyond that a round has more batches.
constexpr int64_t min_batches = 64, first_paths = 8, max_paths = 512;

/// Size of a round: four times the paths of the one before.
struct RoundSize {
  explicit RoundSize(int round)
      : paths(std::min(max_paths, first_paths << (2 * round))),
        batches(min_batches * ((first_paths << (2 * round)) / paths)) {}
  double all_paths() const { return static_cast<double>(paths * batches); }

  int64_t paths;  // of a batch, to each part of a sign
  int64_t batches;
};

/// Values of a view that are compared with a limit in each light: legend minus ground, and face
/// minus surround.
constexpr size_t values_of_light = 2;

/// The view of a sign before its light is known.
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

/// Ages of the eyes that are judged: those of the assessment first, then the others.
std::vector<double> ages_of(const AssessmentSettings& people) {
  std::vector<double> ages{people.age_years};
  for (const OtherEyes& eyes : people.other_eyes)
    ages.push_back(eyes.age_years.value_or(people.age_years));
  return ages;
}

}  // namespace

SightsInLights::SightsInLights(const JudgedScene& judged, const std::vector<Observer>& observers,
                               const OtherSmoke& smoke, const AssessOptions& options)
    : judged_(judged),
      observers_(observers),
      smoke_(smoke),
      options_(options),
      rows_(judged.lights.size()) {}

std::optional<double> SightsInLights::error_beyond_first(size_t light, size_t row) const {
  const double error = errors_beyond_first_[light][row];
  return std::isnan(error) ? std::nullopt : std::optional(error);
}

bool SightsInLights::is_open(size_t light) const {
  return std::find(open_[light].begin(), open_[light].end(), true) != open_[light].end();
}

Result<void> SightsInLights::look_for_lines(const AssessProgress& progress) {
  progress("lines of sight", 0);
  auto made = Building::make(scene_, judged_.scenario, options_.threads);
  if (!made) return made.problem();
  const Building& building = *made.value();
  const GroupFactors factors = factors_of(building.scene(), judged_.mixtures());
  const std::vector<double> ages = ages_of(scene_.assessment);
  stands_ = stands_of(scene_, observers_);
  if (stands_.size() * scene_.signs.size() > limits::sights)
    return problem_in(scene_.file,
                      fmt::format("{} places and {} signs make more pairs than {}: take a larger "
                                  "spacing_m or fewer eye heights",
                                  stands_.size(), scene_.signs.size(), limits::sights));
  std::vector<std::vector<SightRow>> rows(stands_.size());
  std::vector<std::vector<Faced>> faced(stands_.size());  // rows are counted within the stand
  building.each(stands_.size(), [&](const GeometryAccess& access, size_t i) {
    const Stand& stand = stands_[i];
    const bool stuck = building.in_solid(access, stand.observer.eye);
    for (uint32_t s = 0; s < scene_.signs.size(); ++s) {
      const Sign& sign = scene_.signs[s];
      if (!options_.sign.empty() && sign.name != options_.sign) continue;
      SightRow row = row_of(stand, sign);
      if (row.view.behind || (options_.wanted && !options_.wanted(row))) continue;
      const double seen = building.seen_share(access, sign, row.view, row.eye);
      row.look.visible_share = seen;
      row.line = line_of_sight(building, access, sign, row.view, row.eye);
      if (seen == 0) row.sight.verdict = SightVerdict::hidden;
      if (stuck) row.sight.reason = remark(RemarkId::eye_in_solid);
      if (seen > 0 && !stuck) {
        row.sight.verdict = SightVerdict::undecided;
        ArrivingBeside beside =
            arriving_beside(building, access, row.eye, row.view.centre, s, ages, factors);
        row.eye_light = beside.at_eye;
        auto& veils_by_age = beside.veils_cd_m2;
        Faced& view = faced[i].emplace_back(
            Faced{rows[i].size(), i, s, std::move(veils_by_age.front()), {}, {}});
        view.veils_of_other_eyes.assign(std::make_move_iterator(veils_by_age.begin() + 1),
                                        std::make_move_iterator(veils_by_age.end()));
        const std::vector<double>& veils = faced[i].back().veils_cd_m2;
        const auto of_lights = static_cast<std::ptrdiff_t>(judged_.lights_mixtures());
        row.look.veil_cd_m2 = *std::max_element(veils.begin(), veils.begin() + of_lights);
      }
      rows[i].push_back(std::move(row));
    }
  });
  for (size_t i = 0; i < rows.size(); ++i) {
    const size_t before = rows_.front().size();
    for (Faced& view : faced[i]) {
      view.row += before;
      faced_.push_back(std::move(view));
    }
    for (SightRow& row : rows[i]) rows_.front().push_back(std::move(row));
  }
  std::fill(rows_.begin() + 1, rows_.end(), rows_.front());
  const Comparisons comparisons{faced_.size(), values_of_light * judged_.per_light() * ages.size(),
                                options_.rounds};
  sure_errors_ = options_.sure_errors.value_or(
      luxodus::sure_errors(options_.wrong_verdicts, comparisons, static_cast<double>(min_batches)));
  open_.assign(lights(), std::vector<bool>(faced_.size(), true));
  errors_beyond_first_.assign(
      lights(),
      std::vector<double>(rows_.front().size(), std::numeric_limits<double>::quiet_NaN()));
  return {};
}

/// The observers of a round with their undecided signs, and the number of paths.
RoundState SightsInLights::round_state(int round, const std::vector<size_t>& views) const {
  RoundState out{judged_.scenario.name, scene_.at_s, smoke_, judged_.signs_apart, 0, {}};
  size_t last = stands_.size();
  for (const size_t view : views) {
    const Faced& faced = faced_[view];
    if (faced.stand != last) {
      out.observers.push_back(stands_[faced.stand].observer);
      out.observers.back().signs.emplace();
      last = faced.stand;
    }
    out.observers.back().signs->push_back(faced.sign);
  }
  out.eye_path_factor = eye_path_factor(RoundSize(round).paths, views.size());
  return out;
}

SignLook SightsInLights::look_by(const Faced& faced, const ViewLight& light,
                                 double veil_cd_m2) const {
  const SignFace& face = scene_.signs[faced.sign].face;
  SignLook look = look_of(face, light, veil_cd_m2);
  const size_t legend = face.legend_part();
  look.colours =
      chromaticity_->at_eye(faced.sign, arrived(light[legend]), arrived(light[1 - legend]));
  return look;
}

SignLook SightsInLights::look_in(const Faced& faced, size_t mixture, double veil_cd_m2) const {
  return look_by(faced, faced.light[mixture].mean(), veil_cd_m2);
}

SignLook SightsInLights::look_in(const Faced& faced, size_t mixture) const {
  return look_in(faced, mixture, faced.veils_cd_m2[mixture]);
}

Eye SightsInLights::eye_of(double age_years) const {
  return adapted_eye(scene_.assessment, judged_.scenario, age_years);
}

SightRules SightsInLights::rules_for(double age_years) const {
  return {eye_of(age_years), scene_.assessment.irritant_smoke.value_or(false), sure_errors_,
          options_.place_unknown};
}

SignLook SightsInLights::look_if(const Faced& faced, const SignsChanged& changed, bool as_new,
                                 const std::vector<double>& veils) const {
  const auto mixture = [&](size_t light) {
    return as_new ? judged_.new_mixture(light) : judged_.aged_mixture(light);
  };
  const size_t beyond = judged_.mixture_beyond_first(1, as_new);
  const double lit = changed.luminance * changed.size * changed.size;
  const ViewLight light = with_signs_scaled(
      {faced.light[mixture(0)].mean(), faced.light[mixture(1)].mean(), faced.light[beyond].mean()},
      changed.luminance, lit);
  const double veil = veils[mixture(0)] + (1 - lit) * veils[beyond];
  return look_by(faced, light, std::max(0.0, veil));
}

std::vector<Sight> SightsInLights::sights_if(size_t row, const SignsChanged& changed) const {
  const auto faced = std::lower_bound(faced_.begin(), faced_.end(), row,
                                      [](const Faced& one, size_t at) { return one.row < at; });
  if (faced == faced_.end() || faced->row != row || faced->light.empty()) return {};
  const Sign& sign = scene_.signs[faced->sign];
  SignView view = rows_.front()[row].view;
  for (double* size : {&view.width_arcmin, &view.height_arcmin, &view.detail_arcmin})
    *size *= changed.size;
  const auto sight_by = [&](const OtherEyes& eyes, const std::vector<double>& veils) {
    return worse_sight(sign, view, eyes,
                       [&](bool as_new) { return look_if(*faced, changed, as_new, veils); });
  };
  const auto& others = scene_.assessment.other_eyes;
  std::vector<Sight> out{sight_by(OtherEyes{}, faced->veils_cd_m2)};
  for (size_t e = 0; e < others.size(); ++e)
    out.push_back(sight_by(others[e], faced->veils_of_other_eyes[e]));
  return out;
}

/// The worse of the sights in aged and in new light.
Sight SightsInLights::worse_sight(const Sign& sign, const SignView& view, const OtherEyes& eyes,
                                  const std::function<SignLook(bool as_new)>& look) const {
  const SightRules rules = rules_for(eyes.age_years.value_or(scene_.assessment.age_years));
  const auto judged = [&](bool as_new) {
    const SignLook seen = look(as_new);
    return judge_sight(sign, view, eyes.protan ? as_protan_eyes_see(seen) : seen, rules);
  };
  Sight sight = judged(false);
  if (!judged_.ageing.any()) return sight;
  Sight as_new = judged(true);
  return is_worse(as_new, sight) ? as_new : sight;
}

/// Judges in aged light and, if luminaires age, in new light; the worse verdict counts.
void SightsInLights::judge_view(const Faced& faced, size_t light) {
  const SightRules rules = rules_for(scene_.assessment.age_years);
  const Sign& sign = scene_.signs[faced.sign];
  SightRow& row = rows_[light][faced.row];
  judge_by_other_eyes(faced, light);
  row.look = look_in(faced, judged_.aged_mixture(light));
  row.sight = judge_sight(sign, row.view, row.look, rules);
  row.in_new_light = false;
  row.other.reset();
  if (judged_.ageing.any())
    judge_in_new_light(row, sign, look_in(faced, judged_.new_mixture(light)), rules);
  // Light of new luminaires only veils more.
  if (!judged_.ageing.new_light_known && row.sight.verdict == SightVerdict::legible) {
    row.sight.verdict = SightVerdict::not_assessed;
    row.sight.reason = remark(RemarkId::initial_flux_unknown);
  }
}

/// From the same paths: other eyes have other thresholds and veils, protan ones other luminances.
void SightsInLights::judge_by_other_eyes(const Faced& faced, size_t light) {
  SightRow& row = rows_[light][faced.row];
  const AssessmentSettings& people = scene_.assessment;
  row.by_other_eyes.clear();
  for (size_t e = 0; e < people.other_eyes.size(); ++e) {
    Sight sight =
        worse_sight(scene_.signs[faced.sign], row.view, people.other_eyes[e], [&](bool as_new) {
          const size_t mixture = as_new ? judged_.new_mixture(light) : judged_.aged_mixture(light);
          return look_in(faced, mixture, faced.veils_of_other_eyes[e][mixture]);
        });
    if (!judged_.ageing.new_light_known && sight.verdict == SightVerdict::legible) {
      sight.verdict = SightVerdict::not_assessed;
      sight.reason = remark(RemarkId::initial_flux_unknown);
    }
    row.by_other_eyes.push_back(std::move(sight));
  }
}

/// The worse of the verdicts in aged and in new light counts.
void SightsInLights::judge_in_new_light(SightRow& row, const Sign& sign, SignLook look,
                                        const SightRules& rules) {
  SightRow::Other as_new{std::move(look), {}};
  as_new.sight = judge_sight(sign, row.view, as_new.look, rules);
  if (is_worse(as_new.sight, row.sight)) {
    std::swap(row.look, as_new.look);
    std::swap(row.sight, as_new.sight);
    row.in_new_light = true;
  }
  row.other = std::move(as_new);
}

/// Sets the error if both verdicts count in the same light, aged or new. Requires: this round has
/// judged both.
void SightsInLights::compare_with_first(const Faced& faced, size_t light) {
  const SightRow &first = rows_.front()[faced.row], &row = rows_[light][faced.row];
  double& error = errors_beyond_first_[light][faced.row];
  error = std::numeric_limits<double>::quiet_NaN();
  if (row.sight.verdict != SightVerdict::undecided || first.in_new_light != row.in_new_light)
    return;
  const SignLook beyond = look_in(faced, judged_.mixture_beyond_first(light, row.in_new_light));
  error = error_of_level_beyond(first.look, row.look, beyond, row.view,
                                eye_of(scene_.assessment.age_years));
}

void SightsInLights::pool(const Readout& readout, const CompiledScene& scene,
                          const EyeTarget& target, double paths, Faced& faced) const {
  faced.light.resize(faced.veils_cd_m2.size());
  for (size_t mixture = 0; mixture < faced.light.size(); ++mixture)
    faced.light[mixture].add(read_view(readout, scene, target, mixture), paths);
}

void SightsInLights::judge(const CompiledScene& scene, const Totals& totals, double paths,
                           const std::vector<size_t>& views) {
  const Readout readout(scene, totals);
  chromaticity_.emplace(scene);
  std::map<std::tuple<size_t, uint32_t, bool>, const EyeTarget*> targets;
  for (const EyeTarget& target : scene.eye_targets) {
    const CompiledSign& face = scene.signs[target.sign];
    targets[{observing_[target.observer], face.sign, face.back}] = &target;
  }
  for (const size_t view : views) {
    Faced& faced = faced_[view];
    const auto target = targets.find({faced.stand, faced.sign, rows_.front()[faced.row].back_face});
    if (target != targets.end()) pool(readout, scene, *target->second, paths, faced);
    for (size_t light = 0; light < lights(); ++light) {
      if (!open_[light][view]) continue;
      SightRow& row = rows_[light][faced.row];
      if (target == targets.end()) {  // edge-on within rounding
        row.sight.verdict = SightVerdict::not_assessed;
        row.sight.reason = remark(RemarkId::seen_edge_on);
      } else {
        judge_view(faced, light);
        if (light > 0 && open_.front()[view]) compare_with_first(faced, light);
      }
      open_[light][view] =
          options_.enough ? !options_.enough(row) : row.sight.verdict == SightVerdict::undecided;
    }
  }
}

Result<void> SightsInLights::trace(int round, const std::vector<bool>& asked,
                                   const std::atomic<bool>& interrupt,
                                   const AssessProgress& progress) {
  std::vector<size_t> views;
  for (size_t view = 0; view < faced_.size(); ++view) {
    bool open = false;
    for (size_t light = 0; light < lights(); ++light) open |= asked[light] && open_[light][view];
    if (open) views.push_back(view);
  }
  const std::string what = fmt::format("round {}: {} views", round + 1, views.size());
  progress(what, 0);
  observing_.clear();
  for (const size_t view : views)
    if (observing_.empty() || observing_.back() != faced_[view].stand)
      observing_.push_back(faced_[view].stand);
  const RoundRequest request{round_state(round, views),
                             options_.seed + static_cast<uint64_t>(round),
                             RoundSize(round).batches};
  const auto run = trace_round(judged_, request, options_, interrupt,
                               [&](double share) { progress(what, share); });
  if (!run) return run.problem();
  const CompiledScene& scene = run.value()->scene();
  const Totals& totals = run.value()->totals();
  paths_ += eye_paths_of(*run.value());
  if (auto ok = Readout(scene, totals).check_range(); !ok) return ok;
  judge(scene, totals, RoundSize(round).all_paths(), views);
  progress(what, 1);
  return {};
}

}  // namespace luxodus

// Rules for the illuminance some time after the mains have failed, and for durations. Fluxes are
// those at the end of the rated duration, where luminaires give least.
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "scenes/emergency/extremes.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/light/signs/onset.hpp"
#include "scenes/light/signs/sign_colours.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

/// Share of its flux that each luminaire gives after this time: 0 without a stated onset, and once
/// its supply is exhausted.
LuminaireFactors shares_after(const SceneDescription& scene, double seconds) {
  LuminaireFactors out;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    out.push_back(e.onset.empty() ? 0 : emergency_share(e, seconds));
  }
  return out;
}

/// A remark that names luminaires without a stated onset; none if all state it.
std::optional<Remark> silent(const SceneDescription& scene) {
  std::string first;
  int more = -1;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    if (!e.onset.empty()) continue;
    if (++more == 0) first = e.name;
  }
  if (more < 0) return std::nullopt;
  return more == 0 ? remark(RemarkId::onset_unsaid, first)
                   : remark(RemarkId::onset_unsaid_of_more, first, more);
}

bool none_states(const SceneDescription& scene) {
  const auto all = emergency_luminaires(scene);
  return std::all_of(all.begin(), all.end(),
                     [&](uint32_t number) { return scene.emitters[number].onset.empty(); });
}

Check in_time(const Rule& rule, const SceneDescription& scene, const Subject& subject,
              const JudgedPoints& points, double seconds, double limit_lx) {
  if (points.grid.empty()) return not_assessed(rule, subject, remark(RemarkId::nowhere_to_assess));
  const SpreadInterval spread = spread_of(points, shares_after(scene, seconds));
  if (spread.all.least < limit_lx)
    if (auto unsaid = silent(scene)) return not_assessed(rule, subject, *std::move(unsaid));
  Check check = judged_between(rule, subject, spread, least_of, Limit{limit_lx});
  check.conditions = {remark(RemarkId::after_mains_failure, seconds)};
  return check;
}

}  // namespace

std::vector<Check> checks_of_onset(const SceneDescription& scene, const Subject& subject,
                                   const JudgedPoints& points, double demanded_lx,
                                   const CodeChoice& codes) {
  if (none_states(scene)) return {};
  std::vector<Check> out;
  const auto add = [&](RuleId id, double seconds, double limit_lx) {
    out.push_back(in_time(rule_of(id, codes), scene, subject, points, seconds, limit_lx));
  };
  if (codes.european()) {
    add(RuleId::E10h, half_s, demanded_lx / 2);
    add(RuleId::E10f, full_s, demanded_lx);
  } else {
    add(RuleId::N5, nfpa_s, limit_of(RuleId::N5));
  }
  if (codes.has(Deviation::de_asr)) add(RuleId::E10g, german_s, demanded_lx);
  return out;
}

std::vector<Check> checks_of_task_onset(const SceneDescription& scene, const Subject& subject,
                                        const JudgedPoints& plane, double demanded_lx,
                                        const CodeChoice& codes) {
  if (none_states(scene) || !codes.european()) return {};
  return {in_time(rule_of(RuleId::E10t, codes), scene, subject, plane, task_s, demanded_lx)};
}

std::vector<LuminaireFactors> factors_of_checks(const SceneDescription& scene,
                                                const std::vector<CodeChoice>& codes,
                                                const FedLuminaires& fed) {
  const auto luminaires = emergency_luminaires(scene);
  std::vector<LuminaireFactors> out;
  const auto add = [&](LuminaireFactors factors) {
    const double most = factors.empty() ? 0 : *std::max_element(factors.begin(), factors.end());
    if (!(most > 0)) return;
    for (double& factor : factors) factor /= most;
    if (std::find(out.begin(), out.end(), factors) == out.end()) out.push_back(std::move(factors));
  };
  LuminaireFactors now(luminaires.size(), 1.0), as_new = now;
  for (size_t i = 0; i < std::min(now.size(), fed.size()); ++i) now[i] = fed[i] ? 1 : 0;
  for (size_t i = 0; i < as_new.size(); ++i)
    as_new[i] = 1 / scene.emitters[luminaires[i]].emergency_ageing;
  add(std::move(now));
  for (const CodeChoice& one : codes) {
    if (!one.european()) add(as_new);
    if (none_states(scene)) continue;
    for (const double seconds : {half_s, full_s, task_s})
      if (one.european()) add(shares_after(scene, seconds));
    if (!one.european()) add(shares_after(scene, nfpa_s));
    if (one.has(Deviation::de_asr)) add(shares_after(scene, german_s));
  }
  return out;
}

namespace {

/// Durations of everything on emergency supply, without photoluminescent signs.
struct SupplyHours {
  size_t said = 0, unsaid = 0;
  double shortest = std::numeric_limits<double>::infinity();
  std::string name;  // whose supply is the shortest

  void take(const std::optional<double>& duration_s, const std::string& whose) {
    constexpr double hour_s = 3600;
    ++(duration_s ? said : unsaid);
    if (!duration_s || *duration_s / hour_s >= shortest) return;
    shortest = *duration_s / hour_s;
    name = whose;
  }
};

SupplyHours supply_of(const SceneDescription& scene) {
  SupplyHours out;
  for (const Emitter& e : scene.emitters)
    if (e.emergency_flux > 0) out.take(e.duration_s, e.name);
  for (const Sign& sign : scene.signs)
    if (sign.lighting == SignLighting::internal && max_emergency_cd_m2(sign) > 0)
      out.take(sign.duration_s, sign.name);
  return out;
}

}  // namespace

Check check_of_duration(const SceneDescription& scene, const CodeChoice& codes) {
  const RuleId id = duration_rule(codes);
  const Subject all{SubjectKind::all_luminaires_and_signs};
  const SupplyHours supply = supply_of(scene);
  if (supply.said > 0 && (supply.unsaid == 0 || supply.shortest < limit_of(id))) {
    Check check = judged(rule_of(id, codes), all, supply.shortest);
    check.reasons.push_back(remark(RemarkId::shortest_supply, supply.name));
    return check;
  }
  Check check = not_assessed(
      rule_of(id, codes), all,
      remark(supply.said == 0 ? RemarkId::no_duration : RemarkId::some_durations_unsaid));
  check.limit = limit_of(id);
  check.unit = row_of(id).unit;
  return check;
}

std::vector<Check> checks_beyond(const SceneDescription& scene, const CodeChoice& codes) {
  std::vector<Check> out;
  const auto add = [&](RuleId id, SubjectKind subject, RemarkId reason) {
    out.push_back(not_assessed(rule_of(id, codes), {subject}, remark(reason)));
  };
  constexpr SubjectKind all = SubjectKind::all_luminaires_and_signs;
  if (scene.routes.empty())
    add(codes.european() ? (codes.set == RuleSet::en1838_2013 ? RuleId::E1 : RuleId::E5)
                         : RuleId::N1,
        SubjectKind::building, RemarkId::no_route);
  if (codes.european() && emphasis_of(scene).empty())
    add(RuleId::E12, SubjectKind::building, RemarkId::no_emphasis);
  const bool unsaid = none_states(scene);
  if (!codes.european()) {
    if (unsaid) add(RuleId::N5, SubjectKind::all_luminaires, RemarkId::no_onset);
    return out;
  }
  add(RuleId::E9, all, RemarkId::spectrum_rough);
  if (unsaid) add(RuleId::E10, SubjectKind::all_luminaires, RemarkId::no_onset);
  if (unsaid && codes.has(Deviation::de_asr))
    add(RuleId::E10g, SubjectKind::all_luminaires, RemarkId::no_onset);
  add(RuleId::E10, SubjectKind::all_signs, RemarkId::sign_onset_unsaid);
  add(RuleId::S8, all, RemarkId::colour_boxes_unknown);
  return out;
}

}  // namespace luxodus

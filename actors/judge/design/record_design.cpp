#include "actors/judge/design/record_design.hpp"

#include <algorithm>

#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/sign_files.hpp"

namespace luxodus {

namespace {

PlacedLuminaireRecord placed_of(const SceneDescription& scene, const PlacedLuminaire& one) {
  return {.name = one.name,
          .type = type_of(scene, one),
          .is_new = one.is_new(),
          .moved_from = one.moved_from,
          .position = one.candidate.position,
          .mount = one.candidate.aim ? "wall"
                   : one.is_placed() ? "ceiling"
                                     : "",
          .rotation_deg = one.candidate.rotation_deg};
}

std::vector<PlacedTypeRecord> types_of(const SceneDescription& scene, const DesignResult& result) {
  std::vector<PlacedTypeRecord> out;
  const auto& types = scene.design->types;
  for (size_t i = 0; i < types.size(); ++i) {
    const auto count = std::count_if(
        result.luminaires.begin(), result.luminaires.end(),
        [&](const PlacedLuminaire& one) { return one.is_new() && one.candidate.type == i; });
    const Emitter& emitter = types[i].emitter;
    out.push_back({types[i].name, static_cast<size_t>(count), types[i].cost, types[i].watts,
                   battery_class(types[i]), emitter.emergency_flux / emitter.emergency_ageing});
  }
  return out;
}

std::vector<ConstraintRecord> constraints_of(const DesignResult& result) {
  std::vector<ConstraintRecord> out;
  const auto& shares = result.answer.share_of_group;
  for (size_t i = 0; i < result.groups.size(); ++i) {
    const ConstraintGroup& group = result.groups[i];
    out.push_back({.kind = group.kind,
                   .rule = group.rule,
                   .subject = group.subject,
                   .asked = group.asked,
                   .words = demand_words(group),
                   .least_share = result.tightest[i],
                   .share_of_bound = shares.empty() ? 0 : shares[i]});
  }
  return out;
}

BindingRecord binding_of(const BindingDemand& one) {
  BindingRecord out{.saved = one.relaxed.saved,
                    .objective_without = one.relaxed.objective,
                    .fewer_luminaires = one.relaxed.fewer,
                    .exact = one.relaxed.exact,
                    .constraint = one.relaxed.without.group,
                    .luminaire = {}};
  if (one.relaxed.without.never_fails) out.luminaire = one.luminaire;
  return out;
}

OffPlaceRecord off_place_of(const PlaceTolerance& tolerance) {
  OffPlaceRecord out{tolerance.distance_m, tolerance.holds(), {}};
  for (const ShareOffPlace& one : tolerance.demands)
    out.demands.push_back({one.kind, one.rule, one.subject, one.share, one.place});
  return out;
}

SignPlanRecord signs_of(const SceneDescription& scene, const SignPlan& plan) {
  SignPlanRecord out{.placed = {},
                     .removed = plan.removed,
                     .types = {},
                     .objective = {plan.objective, plan.bound},
                     .candidates = {plan.places, plan.candidates, plan.left_out},
                     .unguided = plan.unguided};
  for (const PlacedSign& one : plan.signs) {
    PlacedSignRecord& sign = out.placed.emplace_back();
    sign.name = one.name;
    sign.is_new = one.is_new();
    sign.position = one.spot.position;
    sign.facing = one.spot.facing;
    if (one.is_new()) {
      sign.type = scene.design->sign_types[one.type].name;
      sign.mount = mount_words[static_cast<size_t>(one.spot.mount)];
    }
    for (const LeadsTo& way : one.leads_to)
      sign.leads_to.push_back({way.route, std::string(arrow_word(way.arrow))});
  }
  const auto& kinds = scene.design->sign_types;
  for (size_t i = 0; i < kinds.size(); ++i) {
    const auto count = std::count_if(plan.signs.begin(), plan.signs.end(),
                                     [&](const PlacedSign& one) { return one.type == i; });
    out.types.push_back({kinds[i].name, static_cast<size_t>(count), kinds[i].cost, kinds[i].watts});
  }
  return out;
}

std::optional<GuidedRecord> guided_of(const JudgedLayout& one) {
  if (one.guided.empty()) return std::nullopt;
  const FirstLoss loss = first_loss_of(one.guided);
  GuidedRecord out{loss.min_s, loss.max_s, loss.never_lost, {}};
  for (const GuidedUntil& route : one.guided)
    out.routes.push_back({route.route, route.height_m, route.least.until_s, route.most.until_s});
  return out;
}

SmokeLayoutRecord layout_of(const SmokeStage& stage, const JudgedLayout& one) {
  SmokeLayoutRecord out{.name = one.name,
                        .file = file_of(one),
                        .on_front = one.on_front,
                        .objective = one.objective,
                        .luminaires = one.placed,
                        .cost = one.cost,
                        .watts = one.watts,
                        .sign_factor = one.sign_factor,
                        .low_signs = one.low_signs.size(),
                        .rounds = one.rounds,
                        .open = one.is_open,
                        .guided = guided_of(one),
                        .people = {},
                        .places_lost = one.lost,
                        .places_won = one.won,
                        .worst = one.worst(),
                        .beyond_first = difference_of(stage.layouts.front(), one),
                        .scenarios = {}};
  if (one.people) out.people = {one.people->least_s, one.people->most_s, one.people->all_s};
  for (const SmokeVerdict& verdict : one.smoke) {
    SmokeScenarioRecord& scenario =
        out.scenarios.emplace_back(verdict.scenario, verdict.all, verdict.beyond_first);
    for (size_t i = 0; i < verdict.by_height.size(); ++i)
      scenario.by_height.push_back({verdict.by_height[i], stage.heights_m[i]});
  }
  return out;
}

}  // namespace

std::string file_of(const JudgedLayout& layout) {
  if (layout.sign_factor != 1) return "alternatives/layout_A_brighter_signs.toml";
  if (!layout.low_signs.empty()) return "alternatives/layout_A_low_signs.toml";
  return layout.name == "A" ? "layout.toml" : "alternatives/layout_" + layout.name + ".toml";
}

SmokeRecord record_of(const SmokeStage& stage) {
  SmokeRecord out{.scenarios = stage.scenarios,
                  .heights_m = stage.heights_m,
                  .ahead_deg = ahead_deg,
                  .end = stage.end,
                  .traces = stage.traces,
                  .paths = stage.paths,
                  .recommended = stage.recommended().name,
                  .layouts = {}};
  for (const JudgedLayout& one : stage.layouts) out.layouts.push_back(layout_of(stage, one));
  return out;
}

DesignRecord record_of(const SceneDescription& scene, const DesignResult& result,
                       const std::string& version) {
  const DesignSettings& design = *scene.design;
  const LayoutAnswer& answer = result.answer;
  DesignRecord out;
  out.program = "luxodus " + version;
  out.scene = {scene.name, scene.title};
  out.outcome = {answer.end, outcome_words(scene, result)};
  out.objective = {.kind = std::string(objective_words[static_cast<size_t>(design.objective)]),
                   .value = answer.objective,
                   .bound = answer.bound,
                   .gap = answer.gap(),
                   .greedy = {}};
  if (answer.greedy) out.objective.greedy = answer.greedy_objective;
  out.settings = {design.margin,
                  std::string(failure_words[static_cast<size_t>(design.failure)]),
                  design.spacing_m,
                  {}};
  for (const CodeChoice& choice : result.assessment.state.codes)
    out.settings.rules.emplace_back(named(choice.set).id);
  out.candidates = {result.places, result.candidates, result.points, result.left_out};
  out.hidden_by_furniture = result.hidden;
  out.types_not_placed = result.unused;
  out.unlit_flights = result.unlit_stair_flights;
  for (const PlacedLuminaire& one : result.luminaires)
    out.luminaires.push_back(placed_of(scene, one));
  out.removed = result.removed;
  out.types = types_of(scene, result);
  out.constraints = constraints_of(result);
  for (const BindingDemand& one : result.because) out.because.push_back(binding_of(one));
  out.checks = CountsRecord::of(counts_of(result.assessment.checks));
  for (const Check& check : result.others)
    out.failing_otherwise.push_back({check.rule.id, check.subject, check.reasons});
  out.refined = result.refined;
  out.between_points = result.between;
  if (result.tolerance && result.tolerance->distance_m > 0)
    out.off_place = off_place_of(*result.tolerance);
  if (result.signs) out.signs = signs_of(scene, *result.signs);
  if (result.smoke) out.smoke = record_of(*result.smoke);
  return out;
}

}  // namespace luxodus

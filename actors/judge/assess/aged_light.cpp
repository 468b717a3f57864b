#include "actors/judge/assess/aged_light.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/judge/assess/assessment.hpp"

namespace luxodus {

namespace {

std::string group_name(size_t number) {
  return "ageing " + std::to_string(number);
}

}  // namespace

GroupMixture AgeingShares::renewal() const {
  GroupMixture out;
  for (size_t i = 0; i < shares.size(); ++i) out.factors[group_name(i)] = 1 / shares[i];
  return out;
}

double aged_share(const Emitter& emitter, Operation operation) {
  const bool mains = operation == Operation::mains;
  const bool lit =
      operation != Operation::dark && (mains ? emitter.mains_flux : emitter.emergency_flux) > 0;
  if (!lit) return 1;
  return mains ? emitter.maintenance_factor : emitter.emergency_ageing;
}

Result<AgeingShares> group_by_ageing(SceneDescription& scene, Operation operation) {
  AgeingShares ageing;
  for (Emitter& e : scene.emitters) {
    const double share = aged_share(e, operation);
    if (operation == Operation::emergency && e.emergency_flux > 0 && !e.initial_flux_known)
      ageing.new_light_known = false;
    auto at = std::find(ageing.shares.begin(), ageing.shares.end(), share);
    if (at == ageing.shares.end()) at = ageing.shares.insert(at, share);
    e.group = group_name(static_cast<size_t>(at - ageing.shares.begin()));
    if (ageing.shares.size() > limits::ageings)
      return problem_in(e.place,
                        fmt::format("luminaires have more than {} different products of "
                                    "maintenance_factor and end_of_duration_factor: round them",
                                    limits::ageings));
  }
  for (Sign& sign : scene.signs) sign.group = group_name(0);
  for (Medium& medium : scene.media)
    if (medium.emission) medium.emission->group = group_name(0);
  scene.run.groups = GroupRule::by_circuit;
  return ageing;
}

}  // namespace luxodus

#include "actors/judge/report/schedule.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// A place up to this far below a floor still belongs to it [m].
constexpr double sunk_m = 0.5;

std::string letter_of(size_t number) {
  std::string out;
  for (size_t n = number + 1; n > 0; n = (n - 1) / 26)
    out.insert(out.begin(), static_cast<char>('A' + (n - 1) % 26));
  return out;
}

/// Everything that luminaires of one type have in common.
LuminaireRecord type_of(LuminaireRecord luminaire) {
  luminaire.name = luminaire.circuit = "";
  luminaire.position = glm::dvec3(0);
  luminaire.floor_m.reset();
  return luminaire;
}

SignRecord type_of(SignRecord sign) {
  sign.name = sign.circuit = "";
  sign.position = sign.facing = glm::dvec3(0);
  sign.floor_m.reset();
  return sign;
}

}  // namespace

Schedule::Schedule(const AssessmentRecord& assessment) {
  const auto& luminaires = assessment.luminaires;
  std::vector<LuminaireRecord> keys;
  type_of_.resize(luminaires.size());
  for (const bool emergency : {true, false})
    for (size_t i = 0; i < luminaires.size(); ++i) {
      if ((luminaires[i].emergency_flux.value > 0) != emergency) continue;
      const LuminaireRecord key = luxodus::type_of(luminaires[i]);
      const auto at = std::find(keys.begin(), keys.end(), key) - keys.begin();
      type_of_[i] = static_cast<size_t>(at);
      if (type_of_[i] == keys.size()) {
        keys.push_back(key);
        types_.push_back({letter_of(types_.size()), &luminaires[i], {}});
      }
      types_[type_of_[i]].members.push_back(i);
    }
  const auto& signs = assessment.signs;
  std::vector<SignRecord> sign_keys;
  for (size_t i = 0; i < signs.size(); ++i) {
    const SignRecord key = luxodus::type_of(signs[i]);
    const auto at = std::find(sign_keys.begin(), sign_keys.end(), key) - sign_keys.begin();
    if (static_cast<size_t>(at) == sign_keys.size()) {
      sign_keys.push_back(key);
      sign_types_.push_back({&signs[i], {}});
    }
    sign_types_[static_cast<size_t>(at)].members.push_back(i);
  }
  for (const PlanLevel& level : assessment.plan.levels) floors_.push_back(level.floor_m);
}

size_t Schedule::level_of(double z) const {
  size_t best = 0;
  for (size_t i = 0; i < floors_.size(); ++i)
    if (floors_[i] <= z + sunk_m) best = i;
  return best;
}

std::string product_of(const LuminaireRecord& luminaire) {
  return luminaire.product.empty() ? luminaire.file : luminaire.product;
}

}  // namespace luxodus

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

/// Everything that luminaires of one type have in common, as text.
std::string key_of(const Json& luminaire) {
  Json key = luminaire;
  for (const char* own : {"name", "position", "circuit"}) key.erase(own);
  return key.dump();
}

std::string sign_key(const Json& sign) {
  Json key = sign;
  for (const char* own : {"name", "position", "facing", "circuit"}) key.erase(own);
  return key.dump();
}

}  // namespace

Schedule::Schedule(const Json& assessment) {
  const Json& luminaires = assessment["luminaires"];
  std::vector<std::string> keys;
  type_of_.resize(luminaires.size());
  for (const bool emergency : {true, false})
    for (size_t i = 0; i < luminaires.size(); ++i) {
      if ((luminaires[i]["emergency_flux"]["value"].get<double>() > 0) != emergency) continue;
      const std::string key = key_of(luminaires[i]);
      const auto at = std::find(keys.begin(), keys.end(), key) - keys.begin();
      type_of_[i] = static_cast<size_t>(at);
      if (type_of_[i] == keys.size()) {
        keys.push_back(key);
        types_.push_back({letter_of(types_.size()), &luminaires[i], {}});
      }
      types_[type_of_[i]].members.push_back(i);
    }
  const Json& signs = assessment["signs"];
  std::vector<std::string> sign_keys;
  for (size_t i = 0; i < signs.size(); ++i) {
    const std::string key = sign_key(signs[i]);
    const auto at = std::find(sign_keys.begin(), sign_keys.end(), key) - sign_keys.begin();
    if (static_cast<size_t>(at) == sign_keys.size()) {
      sign_keys.push_back(key);
      sign_types_.push_back({&signs[i], {}});
    }
    sign_types_[static_cast<size_t>(at)].members.push_back(i);
  }
  for (const Json& level : assessment["plan"]["levels"])
    floors_.push_back(level["floor"].get<double>());
}

size_t Schedule::level_of(double z) const {
  size_t best = 0;
  for (size_t i = 0; i < floors_.size(); ++i)
    if (floors_[i] <= z + sunk_m) best = i;
  return best;
}

double Schedule::above_floor(double z) const {
  return z - floors_[level_of(z)];
}

std::string product_of(const Json& luminaire) {
  for (const char* key : {"product", "file"})
    if (const auto text = luminaire[key].get<std::string>(); !text.empty()) return text;
  return "";
}

}  // namespace luxodus

// Luminaires by type and signs by number, as plans, tables and drawings name them alike. From the
// JSON of an assessment. Pure; any thread. Requires everywhere: a JSON that check_assessment
// (actors/judge/assess) has passed.
#pragma once

#include <string>
#include <vector>

#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// Luminaires that are alike but for their place: one row of the schedule.
struct LuminaireType {
  std::string letter;  // "A", ..., "Z", "AA", ...
  const Json* one = nullptr;
  std::vector<size_t> members;  // numbers of "luminaires"
  bool emergency() const { return (*one)["emergency_flux"]["value"].get<double>() > 0; }
};

/// Signs that are alike but for their place.
struct SignType {
  const Json* one = nullptr;
  std::vector<size_t> members;  // numbers of "signs"
};

class Schedule {
 public:
  explicit Schedule(const Json& assessment);

  /// Emergency luminaires first, then those of the mains, each in the order of the scene.
  const std::vector<LuminaireType>& types() const { return types_; }
  const std::vector<SignType>& sign_types() const { return sign_types_; }
  const LuminaireType& type_of(size_t luminaire) const { return types_[type_of_[luminaire]]; }
  /// Number of the level that a height belongs to, and height above its floor [m].
  size_t level_of(double z) const;
  double above_floor(double z) const;
  size_t levels() const { return floors_.size(); }
  double floor(size_t level) const { return floors_[level]; }

 private:
  std::vector<LuminaireType> types_;
  std::vector<SignType> sign_types_;
  std::vector<size_t> type_of_;
  std::vector<double> floors_;
};

/// What a luminaire is called: its product, else its file, else its shape.
std::string product_of(const Json& luminaire);

}  // namespace luxodus

// Luminaires by type and signs by number, with the same names in plans, tables and drawings. Made
// of the record of an assessment, to which it keeps references. Immutable once made; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

/// Luminaires that differ in their place, circuit and name only: one row of the schedule.
struct LuminaireType {
  std::string letter;  // "A", ..., "Z", "AA", ...
  const LuminaireRecord* one = nullptr;
  std::vector<size_t> members;  // indices into the luminaires
  bool emergency() const { return one->emergency_flux.value > 0; }
};

/// Signs that differ in their place only.
struct SignType {
  const SignRecord* one = nullptr;
  std::vector<size_t> members;  // indices into the signs
};

class Schedule {
 public:
  explicit Schedule(const AssessmentRecord& assessment);

  /// Emergency luminaires first, then mains luminaires, each in the order of the scene.
  const std::vector<LuminaireType>& types() const { return types_; }
  const std::vector<SignType>& sign_types() const { return sign_types_; }
  const LuminaireType& type_of(size_t luminaire) const { return types_[type_of_[luminaire]]; }
  /// Index of the level of a height.
  size_t level_of(double z) const;
  /// The same of a luminaire or a sign, by the floor of its storey.
  template <class Thing>
  size_t level_of(const Thing& thing) const {
    return level_of(thing.floor_m.value_or(thing.position.z));
  }
  template <class Thing>
  double above_floor(const Thing& thing) const {
    return thing.position.z - floors_[level_of(thing)];
  }
  size_t levels() const { return floors_.size(); }
  double floor(size_t level) const { return floors_[level]; }

 private:
  std::vector<LuminaireType> types_;
  std::vector<SignType> sign_types_;
  std::vector<size_t> type_of_;
  std::vector<double> floors_;
};

/// Name of a luminaire's product: the product, or else its file, or else its shape.
std::string product_of(const LuminaireRecord& luminaire);

}  // namespace luxodus

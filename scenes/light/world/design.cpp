#include "scenes/light/world/design.hpp"

#include <cmath>

namespace luxodus {

std::string battery_class(const DesignType& type) {
  if (type.battery == Battery::unsaid) return "";
  std::string out = type.battery == Battery::central ? "Z" : "X";
  out += type.emitter.maintained ? " 1" : " 0";
  constexpr double minute_s = 60;
  if (type.emitter.duration_s)
    out += " " + std::to_string(std::lround(*type.emitter.duration_s / minute_s));
  return out;
}

double DesignSettings::weight_of(double cost, double watts) const {
  switch (objective) {
    case DesignObjective::number:
      return 1;
    case DesignObjective::cost:
      return cost;
    case DesignObjective::watts:
      return watts;
    case DesignObjective::weighted:
      return weight_number + weight_cost * cost + weight_watts * watts;
  }
  return 1;
}

}  // namespace luxodus

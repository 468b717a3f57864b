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

}  // namespace luxodus

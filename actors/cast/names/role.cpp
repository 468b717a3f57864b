#include "actors/cast/names/role.hpp"

#include <algorithm>

namespace luxodus {

const char* role_name(ActorName role) {
  return role_names.at(static_cast<size_t>(role));
}

std::string spoken_name(ActorName role) {
  std::string name = role_name(role);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace luxodus

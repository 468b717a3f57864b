// Which views of an assessment may guide: of signs that lead along the route of who looks. Pure;
// any thread.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "actors/judge/assess/assessment.hpp"

namespace luxodus {

/// As rows of an assessment name it: route "corridor".
std::string from_route(const EscapeRoute& route);

/// The pairs of place and sign of a scene that may guide, of all its routes.
class GuidingViews {
 public:
  /// Requires: the scene outlives this.
  explicit GuidingViews(const SceneDescription& scene);

  bool can_guide(const SightRow& row) const;
  const std::vector<Walker>& people(size_t route) const { return people_[route]; }

 private:
  const SceneDescription& scene_;
  std::vector<std::vector<Walker>> people_;
  std::map<std::pair<std::string, double>, std::pair<const EscapeRoute*, Walker>> places_;
};

}  // namespace luxodus

// Which views of an assessment may guide: those of signs that lead along the route of the person
// who looks. Whether a sign can be read is not considered. Immutable; any thread.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "actors/judge/assess/assessment.hpp"

namespace luxodus {

/// The pairs of place and sign that may guide, for all routes of a scene.
class GuidingViews {
 public:
  /// Requires: the scene outlives this.
  explicit GuidingViews(const SceneDescription& scene);

  bool can_guide(const SightRow& row) const;
  const std::vector<Walker>& people(size_t route) const { return people_[route]; }

 private:
  const SceneDescription& scene_;
  std::vector<std::vector<Walker>> people_;
  std::map<std::pair<Subject, double>, std::pair<const EscapeRoute*, Walker>> places_;
};

}  // namespace luxodus

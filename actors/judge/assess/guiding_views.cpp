#include "actors/judge/assess/guiding_views.hpp"

#include <algorithm>

namespace luxodus {

GuidingViews::GuidingViews(const SceneDescription& scene) : scene_(scene) {
  for (const EscapeRoute& route : scene.routes) {
    const auto& people = people_.emplace_back(walkers(route, scene.assessment.spacing_m));
    for (const Walker& walker : people)
      places_[{subject_of(route), walker.along_m}] = {&route, walker};
  }
}

bool GuidingViews::can_guide(const SightRow& row) const {
  const auto place = places_.find({row.from, row.along_m});
  if (place == places_.end()) return false;
  const auto sign = std::find_if(scene_.signs.begin(), scene_.signs.end(),
                                 [&](const Sign& one) { return one.name == row.sign; });
  return luxodus::can_guide(*place->second.first, place->second.second, *sign, row.view);
}

}  // namespace luxodus

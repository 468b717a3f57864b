#include "actors/judge/design/smoke_verdicts.hpp"

#include <algorithm>

#include "scenes/emergency/way.hpp"

namespace luxodus {

bool is_ahead(const SightRow& row) {
  return row.gaze_deg <= ahead_deg;
}

bool may_be_read(const SightRow& row) {
  return may_be_read(row.sight) && (!row.other || may_be_read(row.other->sight));
}

SeenPlaces places_of(const SceneDescription& scene, const std::vector<SightRow>& rows) {
  SeenPlaces out;
  for (const EscapeRoute& route : scene.routes) {
    const auto people = walkers(route, scene.assessment.spacing_m);
    for (const Walker& walker : people)
      for (const double height : scene.assessment.eye_heights_m)
        out[{subject_of(route), walker.along_m, height}].stands_for =
            length_of(route) / static_cast<double>(people.size());
  }
  for (const SightRow& row : rows) {
    const auto at = out.find({row.from, row.along_m, row.height_m});
    if (at == out.end() || !is_ahead(row)) continue;
    SeenPlace& seen = at->second;
    if (row.sight.verdict == SightVerdict::legible)
      seen.read = Read::a_sign;
    else if (may_be_read(row))
      seen.read = std::max(seen.read, Read::undecided);
  }
  return out;
}

LegibleShare share_of(const SeenPlaces& places,
                      const std::function<bool(const RoutePlace&)>& counts) {
  double all = 0, read = 0, perhaps = 0;
  for (const auto& [place, seen] : places) {
    if (!counts(place)) continue;
    all += seen.stands_for;
    if (seen.read == Read::a_sign) read += seen.stands_for;
    if (seen.read == Read::undecided) perhaps += seen.stands_for;
  }
  if (!(all > 0)) return {};
  return {read / all, (read + perhaps) / all};
}

}  // namespace luxodus

#include "actors/judge/thresholds/thresholds.hpp"

#include <algorithm>
#include <iterator>

namespace luxodus {

namespace {

bool is_of_faces(Sought sought) {
  return sought == Sought::luminance || sought == Sought::size;
}

Result<ThresholdRows> find_one(const ThresholdSearch& search, Sought sought,
                               const std::vector<Sought>& faces) {
  switch (sought) {
    case Sought::extinction:
      return find_extinctions(search);
    case Sought::distance:
      return find_distances(search);
    case Sought::height:
      return find_heights(search);
    case Sought::luminance:
    case Sought::size:
      return find_faces(search, faces);
  }
  return ThresholdRows{};
}

}  // namespace

Result<ThresholdRows> find_thresholds(const ThresholdSearch& search,
                                      const std::vector<Sought>& sought) {
  if (!sought.empty() && search.assessed.sights.empty())
    return problem_in(
        search.scene.file,
        "no sign is turned to any place from which people look, so there is nothing to "
        "find: add signs, or routes that pass them");
  std::vector<Sought> faces;
  std::copy_if(sought.begin(), sought.end(), std::back_inserter(faces), is_of_faces);
  ThresholdRows out;
  for (const Sought one : sought) {
    if (is_of_faces(one) && one != faces.front()) continue;  // found with the first
    const AssessProgress progress = [&](const std::string& what, double share) {
      search.progress(std::string("thresholds of ") + name_of(one) + ": " + what, share);
    };
    auto found = find_one({search.scene, search.scenario, search.assessed, search.options,
                           search.interrupt, progress},
                          one, faces);
    if (!found) return found;
    std::move(found->begin(), found->end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace luxodus

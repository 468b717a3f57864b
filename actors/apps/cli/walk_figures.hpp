// People as bodies: scenes in which those of trajectory files stand where they are at a time, for
// pictures and films with silhouettes. Pure function; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "actors/judge/walk/placed_people.hpp"

namespace luxodus::cli {

/// A scene file that includes `scene` and has a body and a head for everybody who is in the
/// building at a time.
std::string figures_scene(const std::filesystem::path& scene,
                          const std::vector<PlacedPerson>& people, double time_s);

/// "figures/30s.toml", "figures/30.5s.toml".
std::string figures_file(double time_s);

}  // namespace luxodus::cli

// Features of a scene by name, found in the scene itself: shows that the generator reaches all that
// a description can contain. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/random/random_scene.hpp"

namespace luxodus::test {

struct Feature {
  const char* name;
  bool (*in)(const RandomScene& scene);
};

const std::vector<Feature>& features();

/// Number of scenes with each feature, in their order.
using FeatureCounts = std::vector<int64_t>;
void count_features(const RandomScene& scene, FeatureCounts& counts);

}  // namespace luxodus::test

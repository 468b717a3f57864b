// Where signs may hang: on walls that a route runs against, over and beside the doors on its way,
// and under ceilings along it and at its bends. Geometry alone: who sees a sign there, and what it
// says, is found by sign_plan.hpp. Thread rule: one thread, which has rows run on others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

/// How a sign hangs; earlier ones are preferred where as few signs do.
enum class SignMount { above, beside, hanging };
inline constexpr std::array<std::string_view, 3> mount_words{
    "above a door or at the end of a way", "beside a door or a way", "under the ceiling"};

struct SignSpot {
  glm::dvec3 position{0};      // middle of the sign
  glm::dvec3 facing{1, 0, 0};  // level, of unit length
  SignMount mount = SignMount::hanging;
  std::vector<size_t> of_routes;  // that it was found on: numbers of the scene's routes
};

/// Why places were left out.
struct SignsLeftOut {
  size_t no_room = 0;     // no flat wall behind, or a body or a wall within the sign
  size_t keep_out = 0;    // in a keep-out zone
  size_t near_signs = 0;  // where a sign of the scene hangs
  size_t forbidden = 0;   // a rule fails that the sign decides by itself
  size_t unseen = 0;      // nobody on a route is guided by it
};

/// Places for signs of the size of `sign`. `bare`, `furnished`: the building without and with
/// furniture.
std::vector<SignSpot> sign_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Sign& sign, const Building& bare, const Building& furnished,
                                 SignsLeftOut& left_out);

/// A sign of a type at a place.
Sign sign_at(const Sign& type, const SignSpot& spot);

}  // namespace luxodus

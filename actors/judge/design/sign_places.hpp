// Places where signs may hang: on walls at the ends of route legs, over and beside doors on a
// route, and under ceilings along it and at its bends. This is geometry only; sign_plan.hpp decides
// who sees a sign and where its arrow points. Thread rule: one thread, which has rows computed by
// others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

/// How a sign hangs; among plans of equal weight earlier values are preferred.
enum class SignMount { above, beside, hanging };
inline constexpr std::array<std::string_view, 3> mount_words{
    "above a door or at the end of a way", "beside a door or a way", "under the ceiling"};

struct SignSpot {
  glm::dvec3 position{0};      // middle of the sign
  glm::dvec3 facing{1, 0, 0};  // horizontal unit vector
  SignMount mount = SignMount::hanging;
  std::vector<size_t> of_routes;  // indices of the scene's routes along which it was found
};

/// Numbers of places that were left out, by reason.
struct SignsLeftOut {
  size_t no_room = 0;     // no flat wall behind, or a body or wall within the sign
  size_t keep_out = 0;    // in a keep-out zone
  size_t near_signs = 0;  // a sign of the scene hangs there
  size_t forbidden = 0;   // the sign by itself violates a rule
  size_t unseen = 0;      // it guides nobody on a route
  static constexpr void fields(auto&& field, auto& m) {
    field("no_room", m.no_room)("keep_out", m.keep_out)("near_signs", m.near_signs);
    field("forbidden", m.forbidden)("unseen", m.unseen);
  }
};

/// Places for signs with the size of `sign`. `bare`, `furnished`: the building without and with
/// furniture.
std::vector<SignSpot> sign_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Sign& sign, const Building& bare, const Building& furnished,
                                 SignsLeftOut& left_out);

/// A sign of a type at a place.
Sign sign_at(const Sign& type, const SignSpot& spot);

}  // namespace luxodus

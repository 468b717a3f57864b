// What of a view of a sign needs no paths: the luminance of its own light towards the eye and what
// the smoke lets pass of it, computed on lines to five points of the face. (Whether solids hide it
// is decided on lines of their own, in signs_in_state.cpp.) Pure functions of a compiled scene;
// called within Building::each, with that call's access.
#pragma once

#include <array>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// One of the two parts of a face (SignFace::parts).
struct PartOfFace {
  std::vector<double> luminance;  // along the normal, by band [cd/m2]
  size_t group = 0;               // source group of its light
  // Moments of the part's area over the face, from its centre, in shares of width and height.
  glm::dvec2 mean{0}, square{0};
  double product = 0;
};

/// A face of a sign that eye paths look at.
struct FaceOfSign {
  uint32_t sign = 0;  // in the description
  bool back = false;
  Vec3 centre{0}, across{0}, up{0}, normal{0};  // local; whole edges
  double exponent = 0;                          // of the luminance in the cosine
  std::array<PartOfFace, 2> parts;
};

/// All faces of a scene, in the order of CompiledScene::signs.
std::vector<FaceOfSign> faces_of(const CompiledScene& scene);

/// Shares of each band in the luminous flux of all sources: the light of the scene.
std::vector<double> luminous_shares(const CompiledScene& scene);

/// Shares of light are of the media alone: panes are counted elsewhere.
struct SightLine {
  std::array<double, 2> own{};     // luminance at the face towards the eye, by part [cd/m2]
  std::array<double, 2> passed{};  // share of it that arrives, mean over the part
  double passed_scene = 1;         // the same of light of the scene's colour
  double passed_error = 0;         // largest relative error of the shares
};

/// `shares`: luminous_shares, the light of parts that have none of their own. Requires: an eye
/// before the face [local].
SightLine sight_line(const CompiledScene& scene, const GeometryAccess& access,
                     const FaceOfSign& face, const std::vector<double>& shares, const Vec3& eye);

}  // namespace luxodus

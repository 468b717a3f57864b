#include "actors/judge/assess/sign_chromaticity.hpp"

#include <algorithm>
#include <array>

#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/signs/sign_face.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// XYZ of light of this spectrum for Y = 1; zero of darkness.
Tristimulus unit_xyz(const Spectrum& light) {
  Tristimulus xyz = xyz_of(light);
  if (!(xyz[1] > 0)) return {};
  for (const size_t k : {0u, 2u}) xyz[k] /= xyz[1];
  xyz[1] = 1;
  return xyz;
}

void add(Tristimulus& sum, const Tristimulus& light, double factor) {
  for (size_t k = 0; k < 3; ++k) sum[k] += factor * light[k];
}

}  // namespace

SignChromaticity::SignChromaticity(const CompiledScene& scene) {
  Spectrum room;
  for (const ActiveSource& source : active_sources(*scene.description, scene.scenario))
    room = room + source.shape * source.watts;
  room_ = unit_xyz(room);
  for (const Sign& sign : scene.description->signs) {
    const SignFace& face = sign.face;
    const std::array<double, 2> share = part_shares(face);
    FaceLight& light = faces_.emplace_back();
    light.legend = face.legend;
    light.ground = face.ground;
    light.legend_share = share[face.legend_part()];
    light.ground_share = share[1 - face.legend_part()];
    for (const FaceColour& colour : sign.colours)
      light.colours.push_back({unit_xyz(colour.shape), unit_xyz(room * colour.reflectance)});
  }
}

ColoursAtEye SignChromaticity::at_eye(uint32_t sign, const ArrivedLight& legend,
                                      const ArrivedLight& ground) const {
  const FaceLight& face = faces_[sign];
  ColoursAtEye out;
  out.room = room_;
  const auto take = [&](ColourIndex colour, const ArrivedLight& light, double share, double sense,
                        Tristimulus& at_eye) {
    if (colour == other_colour) return;
    const FaceColourLight& unit = face.colours[colour];
    add(at_eye, unit.own, light.own);
    add(at_eye, unit.reflected, light.reflected);
    add(out.difference, at_eye, sense);
    add(at_eye, room_, light.path);
    add(out.face, at_eye, share / std::max(face.legend_share + face.ground_share, 1e-12));
  };
  take(face.legend, legend, face.legend_share, 1, out.legend);
  take(face.ground, ground, face.ground_share, -1, out.ground);
  return out;
}

}  // namespace luxodus

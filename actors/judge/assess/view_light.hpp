// Light of one view of a sign as paths have estimated it, pooled over rounds. Plain values; any
// thread.
#pragma once

#include <array>

#include "actors/judge/assess/sign_chromaticity.hpp"
#include "scenes/emergency/legibility.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

/// Light from one part of a sign, or from its surround: see EyeQuantity.
struct PartLight {
  Uncertain own, reflected, at_eye, transmission, visible;

  static constexpr void each(auto&& visit, auto&... parts) {
    visit(parts.own...);
    visit(parts.reflected...);
    visit(parts.at_eye...);
    visit(parts.transmission...);
    visit(parts.visible...);
  }
};

/// Of the two parts of a face (SignFace::parts), and of its surround.
using ViewLight = std::array<PartLight, 3>;

/// The light of a round in one mixture of source groups; without mixtures, in all light.
ViewLight read_view(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
                    size_t mixture);

/// The light of a view in a light, in the same without the light of all signs, and the difference
/// of the second from the first, estimated from the same paths.
struct LightBySigns {
  ViewLight all, dark, dark_minus_all;
};

/// The light of a view in which the faces have `own` times their luminance, and the light that
/// signs give to surfaces and smoke has the factor `lit`.
ViewLight with_signs_scaled(const LightBySigns& light, double own, double lit);

/// What arrives at the eye from a part of a face, for the estimate of its colour.
ArrivedLight arrived(const PartLight& part);

/// What arrives at the eye from a sign with this face, but for its colours. `veil_cd_m2`: of
/// disability glare.
SignLook look_of(const SignFace& face, const ViewLight& light, double veil_cd_m2);

namespace limits {
/// Standard deviation of the light of a path over its mean, at least. Most of the spread of paths
/// may be that of rare bright ones, such as those that pass a lamp at a few centimetres. As long as
/// none was met, the spread of the others says nothing of them.
inline constexpr double least_spread = 3;
}  // namespace limits

/// The mean of several rounds. Rounds are weighted by their paths, which were fixed beforehand.
class PooledLight {
 public:
  void add(const ViewLight& round, double paths);
  /// With errors that are not below those of limits::least_spread for as many paths.
  ViewLight mean() const;
  /// With errors by the spread of the paths alone.
  const ViewLight& sample_mean() const { return mean_; }

 private:
  ViewLight mean_{};
  double paths_ = 0;
};

}  // namespace luxodus

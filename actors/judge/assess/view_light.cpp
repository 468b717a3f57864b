#include "actors/judge/assess/view_light.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/signs/sign_face.hpp"

namespace luxodus {

namespace {

constexpr size_t surround = 2;

Uncertain whole(const Readout& readout, const CompiledScene& scene, uint32_t bin,
                EyeQuantity quantity) {
  const Estimate e = readout.value(scene.blocks.views, bin, static_cast<uint32_t>(quantity));
  return {e.value, e.standard_error};
}

Uncertain mixed(const Readout& readout, const CompiledScene& scene, size_t bin, size_t mixture,
                MixtureEyeQuantity quantity) {
  const size_t place = bin * scene.mixtures.size() + mixture;
  const Estimate e = readout.value(scene.blocks.views_by_mixture, static_cast<uint32_t>(place),
                                   static_cast<uint32_t>(quantity));
  return {e.value, e.standard_error};
}

/// A face's light without the light that smoke before it scatters into the eye.
Uncertain arriving(const PartLight& part) {
  return product(plus(part.own, part.reflected), part.transmission);
}

}  // namespace

ViewLight read_view(const Readout& readout, const CompiledScene& scene, const EyeTarget& target,
                    size_t mixture) {
  const CompiledSign& sign = scene.signs[target.sign];
  ViewLight out;
  for (uint32_t part = 0; part < out.size(); ++part) {
    const uint32_t bin = target.first_bin + part;
    out[part] = {whole(readout, scene, bin, EyeQuantity::own),
                 whole(readout, scene, bin, EyeQuantity::reflected),
                 whole(readout, scene, bin, EyeQuantity::at_eye),
                 whole(readout, scene, bin, EyeQuantity::transmission),
                 whole(readout, scene, bin, EyeQuantity::visible)};
    if (scene.mixtures.empty()) continue;
    // Transmission and occlusion are the same in all light.
    if (part != surround && sign.parts[part] != other_colour) {
      const auto group = static_cast<size_t>(sign.colours[sign.parts[part]].group);
      out[part].own = times(scene.mixtures[mixture][group], out[part].own);
    }
    out[part].reflected = mixed(readout, scene, bin, mixture, MixtureEyeQuantity::reflected);
    out[part].at_eye = mixed(readout, scene, bin, mixture, MixtureEyeQuantity::at_eye);
  }
  return out;
}

ViewLight with_signs_scaled(const LightBySigns& light, double own, double lit) {
  // Linear in `lit`. The terms come from the same paths, so errors add; the sum that starts from
  // the nearer of the two estimates has the smaller error.
  const auto scaled = [lit](const Uncertain& all, const Uncertain& dark, const Uncertain& beyond,
                            double from_face) {
    const double error =
        std::min(all.error + std::abs(1 - lit) * beyond.error, dark.error + lit * beyond.error);
    const double value = all.value + (1 - lit) * (beyond.value + from_face);
    return Uncertain{std::max(0.0, value), error};
  };
  ViewLight out = light.all;
  for (size_t part = 0; part < out.size(); ++part) {
    const PartLight &all = light.all[part], &dark = light.dark[part];
    const PartLight& beyond = light.dark_minus_all[part];
    const double from_face = all.own.value * all.transmission.value;  // on the straight way
    out[part].own = times(own, all.own);
    out[part].reflected = scaled(all.reflected, dark.reflected, beyond.reflected, 0);
    out[part].at_eye = scaled(all.at_eye, dark.at_eye, beyond.at_eye, from_face);
    out[part].at_eye.value = std::max(0.0, out[part].at_eye.value + (own - 1) * from_face);
  }
  return out;
}

ArrivedLight arrived(const PartLight& part) {
  const double passed = part.transmission.value;
  const double own = part.own.value * passed, reflected = part.reflected.value * passed;
  // Their noise may exceed the sum.
  return {own, reflected, std::max(0.0, part.at_eye.value - own - reflected)};
}

SignLook look_of(const SignFace& face, const ViewLight& light, double veil_cd_m2) {
  const std::array<double, 2> share = part_shares(face);
  const double all = std::max(share[0] + share[1], 1e-12);
  const auto of_face = [&](const Uncertain& a, const Uncertain& b) {
    return plus(times(share[0] / all, a), times(share[1] / all, b));
  };
  const size_t legend = face.legend_part(), ground = 1 - legend;
  SignLook look;
  look.legend = light[legend].at_eye;
  look.ground = light[ground].at_eye;
  look.face = of_face(light[0].at_eye, light[1].at_eye);
  look.surround = light[surround].at_eye;
  look.visible_share = of_face(light[0].visible, light[1].visible).value;
  const double passed = of_face(light[0].transmission, light[1].transmission).value;
  look.transmission = look.visible_share > 0 ? passed / look.visible_share : 0;
  look.veil_cd_m2 = veil_cd_m2;
  look.difference = minus(arriving(light[legend]), arriving(light[ground]));
  look.beyond_cd_m2 = light[surround].reflected.value;
  look.silhouette =
      minus(of_face(arriving(light[0]), arriving(light[1])), light[surround].reflected);
  return look;
}

void PooledLight::add(const ViewLight& round, double paths) {
  const double all = paths_ + paths;
  for (size_t part = 0; part < mean_.size(); ++part)
    PartLight::each(
        [&](Uncertain& mean, const Uncertain& more) {
          mean = plus(times(paths_ / all, mean), times(paths / all, more));
        },
        mean_[part], round[part]);
  paths_ = all;
}

ViewLight PooledLight::mean() const {
  ViewLight out = mean_;
  const double least = limits::least_spread / std::sqrt(std::max(1.0, paths_));
  for (PartLight& part : out)
    for (Uncertain* traced : {&part.reflected, &part.at_eye})
      traced->error = std::max(traced->error, least * std::abs(traced->value));
  return out;
}

}  // namespace luxodus

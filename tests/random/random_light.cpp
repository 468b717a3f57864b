// Emitters and signs.
#include <algorithm>
#include <numbers>
#include <numeric>

#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/signs/sign_face.hpp"
#include "tests/random/draw.hpp"

namespace luxodus::test {

namespace {

Spectrum normalised(Spectrum s) {
  return s * (1 / s.integral());
}

}  // namespace

Spectrum draw_emission(Draw& draw) {
  Dice& dice = draw.dice;
  switch (dice.below(draw.extreme ? 8 : 6)) {
    case 0:
      return blackbody_shape(dice.magnitude(500, 1e5));
    case 1:
      return white_led_shape(dice.between(2700, 6500));
    case 2:
      return dice.chance(0.5) ? illuminant_a_shape() : illuminant_d65_shape();
    case 3: {
      const double r = dice.between(0, 1);
      const double g = dice.between(0.01, 1);
      return emission_shape_from_linear_srgb(r, g, dice.between(0, 1));
    }
    case 6: {  // a line, also at invisible wavelengths
      Spectrum line;
      line.value[static_cast<size_t>(dice.whole(1, spectrum_samples - 2))] = 1;
      return normalised(line);
    }
    case 7: {
      Spectrum noise;
      for (double& v : noise.value) v = dice.chance(0.5) ? 0 : dice.magnitude(1e-6, 1);
      noise.value[40] = 1;
      return normalised(noise);
    }
    default:
      return equal_energy_shape();
  }
}

namespace {

std::shared_ptr<const PhotometricWeb> draw_web(Draw& draw) {
  Dice& dice = draw.dice;
  std::vector<double> azimuth{0}, polar{0}, candela;
  const int columns = dice.whole(1, 5), rows = dice.whole(1, 6);
  for (int i = 1; i < columns; ++i) azimuth.push_back(360.0 * i / columns);
  azimuth.push_back(360);
  for (int i = 1; i < rows; ++i) polar.push_back(180.0 * i / rows);
  if (draw.extreme && dice.chance(0.5)) polar.push_back(180 - 1e-3);
  polar.push_back(180);
  std::vector<double> column;
  for (size_t a = 0; a < azimuth.size() * polar.size(); ++a) {
    const bool repeats_first = a >= (azimuth.size() - 1) * polar.size();
    const double dark = dice.chance(0.3) ? 0 : dice.magnitude(1e-3, 1e5);
    candela.push_back(repeats_first ? candela[a % polar.size()] : dark);
  }
  candela[0] = candela[(azimuth.size() - 1) * polar.size()] = 10;
  // C angles turn about +Z of the luminaire, while their pole is -Z.
  const glm::dmat3 mirrored({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
  auto web =
      PhotometricWeb::make(azimuth, polar, candela, dice.chance(0.5) ? glm::dmat3(1.0) : mirrored);
  if (!web.ok()) return nullptr;
  return std::make_shared<const PhotometricWeb>(std::move(web).value());
}

void draw_emitter_shape(Draw& draw, Emitter& e) {
  using enum EmitterShape;
  Dice& dice = draw.dice;
  e.shape = dice.one_of({point, rectangle, disc, sphere, tube, mesh});
  const double most = 0.15 * draw.size_m;
  const double least = std::max(1e-6, (draw.extreme ? 1e-6 : 1e-2) * most);
  const double a = dice.magnitude(std::min(least, most), most);
  const double b = dice.magnitude(std::min(least, most), most);
  e.size = {a, b, 0};
  if (e.shape == mesh) {
    auto body = dice.chance(0.5) ? shapes::box({a, a, b}) : shapes::disc(a, dice.whole(3, 7));
    if (body.ok()) e.mesh = std::move(body.value().mesh);
    const glm::dvec3 axis = dice.direction();
    apply(rotation(axis, dice.between(0, 360)).value(), e.mesh);
    apply(translation(e.frame.origin), e.mesh);
    if (e.mesh.triangles.empty()) e.shape = point;
  }
}

void draw_distribution(Draw& draw, Emitter& e) {
  using enum Distribution;
  Dice& dice = draw.dice;
  const bool flat = e.shape == EmitterShape::point || e.shape == EmitterShape::rectangle ||
                    e.shape == EmitterShape::disc;
  e.distribution = flat ? dice.one_of({lambertian, isotropic, cosine_power, spot, collimated, web})
                        : dice.one_of({lambertian, isotropic, cosine_power});
  e.cosine_power = draw.extreme ? dice.one_of({0.0, 1e-6, 1e3, 1e4}) : dice.between(0, 20);
  e.spot_outer_deg = draw.extreme ? dice.one_of({1e-6, 1e-3, 90.0}) : dice.between(1, 90);
  const double inner = dice.one_of({0.0, 1.0, 0.5});
  e.spot_inner_deg = inner * e.spot_outer_deg;
  if (e.distribution == web && !(e.web = draw_web(draw))) e.distribution = lambertian;
}

void draw_flux(Draw& draw, Emitter& e) {
  Dice& dice = draw.dice;
  e.radiometric = dice.chance(0.3);
  e.mains_flux = draw.extreme ? dice.one_of({1e-3, 1.0, 1e3, 1e9}) : dice.magnitude(1, 1e5);
  if (dice.chance(0.1)) e.mains_flux = 0;
  if (dice.chance(0.6)) e.emergency_flux = 0.1 * e.mains_flux + 1;
  if (dice.chance(0.5)) e.circuit = dice.chance(0.5) ? "circuit a" : "circuit b";
  if (dice.chance(0.2)) e.group = "source group";
}

Result<SignFace> draw_face(Draw& draw, const Sign& sign) {
  Dice& dice = draw.dice;
  const int texels = dice.whole(8, 24);
  const int kind = dice.below(3);
  const ColourIndex colour = dice.chance(0.5) ? 0 : 1;
  const auto ground = static_cast<ColourIndex>(1 - colour);
  if (kind == 0) return uniform_face(colour, sign.width_m, sign.height_m, texels);
  if (kind == 1) {
    const double letter = 0.5 * sign.height_m;
    return face_from_text("EXIT", sign.width_m, sign.height_m, letter, 0.15 * letter, 0.05 * letter,
                          colour, ground, 64);
  }
  std::vector<ColourIndex> places(sign.colours.size());
  std::iota(places.begin(), places.end(), ColourIndex{0});
  SignFace face;
  face.width = texels;
  face.height = dice.whole(8, 24);
  face.legend = colour;
  face.ground = ground;
  for (int i = 0; i < face.width * face.height; ++i)
    face.colour.push_back(dice.chance(0.3) ? other_colour : dice.any(places));
  if (dice.chance(0.5)) return face;
  Image map;
  map.width = map.height = 4;
  map.channels = 1;
  for (int i = 0; i < 16; ++i) map.texels.push_back(static_cast<float>(dice.between(0.05, 1)));
  return with_luminance_map(std::move(face), sign.colours, map);
}

double draw_luminance(Draw& draw) {
  if (draw.dice.chance(0.1)) return 0;
  return draw.extreme ? draw.dice.one_of({1e-3, 1.0, 1e6}) : draw.dice.magnitude(1, 1000);
}

void draw_lighting(Draw& draw, Sign& sign) {
  using enum SignLighting;
  Dice& dice = draw.dice;
  sign.lighting = dice.one_of({internal, internal, external, photoluminescent});
  if (sign.lighting == external) return;
  for (FaceColour& colour : sign.colours) {
    colour.mains_cd_m2 = draw_luminance(draw);
    colour.emergency_cd_m2 = draw_luminance(draw);
  }
  if (sign.lighting != photoluminescent) return;
  const double end = dice.chance(0.3) ? 0 : 0.01;
  sign.decay = {{0, 1}, {60, 0.2}, {3600, end}};
}

}  // namespace

void draw_emitters(Draw& draw) {
  Dice& dice = draw.dice;
  const int count = draw.bare || dice.chance(0.1) ? 0 : dice.whole(1, 4);
  for (int i = 0; i < count; ++i) {
    Emitter e;
    e.name = "emitter " + std::to_string(i);
    const glm::dvec3 origin = draw.place();
    e.frame = frame_aiming(origin, dice.direction()).value();
    draw_emitter_shape(draw, e);
    draw_distribution(draw, e);
    draw_flux(draw, e);
    e.spectrum = draw_emission(draw);
    if (dice.chance(0.25)) e.body_material = dice.any(draw.scene.materials).name;
    draw.scene.emitters.push_back(std::move(e));
  }
}

void draw_signs(Draw& draw) {
  Dice& dice = draw.dice;
  const int count = draw.bare || dice.chance(0.5) ? 0 : dice.whole(1, 2);
  for (int i = 0; i < count; ++i) {
    Sign sign;
    sign.name = "sign " + std::to_string(i);
    sign.width_m = std::clamp(draw.size_m * dice.between(0.05, 0.2), 0.01, 20.0);
    sign.height_m = std::clamp(sign.width_m * dice.between(0.2, 1), 0.01, 20.0);
    sign.thickness_m = dice.chance(0.2) ? 0 : std::min(0.05 * sign.width_m, 1.0);
    sign.smallest_detail_m = 0.05 * sign.height_m;
    sign.double_sided = dice.chance(0.4);
    const glm::dvec3 centre = draw.place();
    const glm::dvec3 facing = dice.direction();
    sign.frame = frame_facing(centre, facing).value();
    sign.angular_exponent = dice.chance(0.6) ? 0 : dice.one_of({0.5, 3.0, 20.0});
    if (dice.chance(0.3)) sign.colours.push_back({.name = "red", .drawn = {0x9B, 0x24, 0x23}});
    draw_lighting(draw, sign);
    auto face = draw_face(draw, sign);
    if (!face.ok()) continue;
    sign.face = std::move(face).value();
    for (FaceColour& colour : sign.colours) {
      colour.shape = draw_emission(draw);
      colour.reflectance = draw_property(draw);
    }
    if (dice.chance(0.5)) sign.circuit = "circuit b";
    draw.scene.signs.push_back(std::move(sign));
  }
}

}  // namespace luxodus::test

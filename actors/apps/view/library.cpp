#include "actors/apps/view/library.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "actors/judge/assess/luminaire_sheets.hpp"
#include "runtime/core/base64.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace {

constexpr int curve_step_deg = 5;
/// Faces are drawn as small pictures of at most so many texels along a side.
constexpr int preview_texels = 96;

Json luminaire_json(const Emitter& e, const std::string& of, bool of_type) {
  Json out = {{"of", of},
              {"of_type", of_type},
              {"product", e.product},
              {"maker", e.facts.maker},
              {"file", e.file},
              {"mains", number_json(e.mains_flux)},
              {"emergency", number_json(e.emergency_flux)},
              {"unit", e.radiometric ? "W" : "lm"},
              {"curves", Json()}};
  const auto along = intensity_curve(e, 0, curve_step_deg);
  if (!along.empty()) out["curves"] = {along, intensity_curve(e, 90, curve_step_deg)};
  return out;
}

/// The face with fewer texels, each the nearest one: its place among the colours.
Json face_json(const SignFace& face) {
  const int columns = std::min(face.width, preview_texels);
  const int rows = std::min(face.height, preview_texels);
  std::string texels;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto y = static_cast<size_t>((2 * row + 1) * face.height / (2 * rows));
      const auto x = static_cast<size_t>((2 * column + 1) * face.width / (2 * columns));
      texels.push_back(
          static_cast<char>(face.colour[y * static_cast<size_t>(face.width) + x]));
    }
  return {{"columns", columns}, {"rows", rows}, {"texels", base64(texels)}};
}

Json sign_json(const Sign& sign, const std::string& of, bool of_type) {
  Json colours = Json::array();
  for (const FaceColour& one : sign.colours)
    colours.push_back({one.drawn[0], one.drawn[1], one.drawn[2]});
  return {{"of", of},          {"of_type", of_type},         {"file", sign.file},
          {"text", sign.text}, {"width", sign.width_m},      {"height", sign.height_m},
          {"colours", colours}, {"face", face_json(sign.face)}};
}

/// What tells kinds of luminaires apart, as far as a viewer sees.
auto kind_of(const Emitter& e) {
  return std::tuple(e.file, e.product, e.facts.maker, e.shape, e.size.x, e.size.y, e.distribution,
                    e.cosine_power, e.spot_inner_deg, e.spot_outer_deg, e.spectrum.value,
                    e.radiometric, e.mains_flux, e.emergency_flux);
}

auto kind_of(const Sign& sign) {
  std::vector<std::pair<double, double>> luminances;
  for (const FaceColour& one : sign.colours)
    luminances.emplace_back(one.mains_cd_m2, one.emergency_cd_m2);
  return std::tuple(sign.file, sign.text, sign.width_m, sign.height_m, sign.lighting,
                    sign.double_sided, std::move(luminances));
}

/// The first of each kind.
template <class List, class Add>
void add_kinds(const List& list, const Add& add) {
  std::set<decltype(kind_of(list.front()))> known;
  for (const auto& one : list)
    if (known.insert(kind_of(one)).second) add(one);
}

}  // namespace

Json library_json(const SceneDescription& scene) {
  Json luminaires = Json::array(), signs = Json::array();
  const auto add_luminaire = [&](const Emitter& e, const std::string& of, bool of_type) {
    if (e.shape != EmitterShape::mesh && luminaires.size() < limits::view_library)
      luminaires.push_back(luminaire_json(e, of, of_type));
  };
  const auto add_sign = [&](const Sign& sign, const std::string& of, bool of_type) {
    if (signs.size() < limits::view_library) signs.push_back(sign_json(sign, of, of_type));
  };
  if (scene.design) {
    for (const DesignType& type : scene.design->types)
      if (type.stated && type.like.empty()) add_luminaire(type.emitter, type.name, true);
    for (const DesignSignType& type : scene.design->sign_types)
      if (type.stated) add_sign(type.sign, type.name, true);
  }
  add_kinds(scene.emitters, [&](const Emitter& e) { add_luminaire(e, e.name, false); });
  add_kinds(scene.signs, [&](const Sign& sign) { add_sign(sign, sign.name, false); });
  return {{"step", curve_step_deg},
          {"luminaires", std::move(luminaires)},
          {"signs", std::move(signs)}};
}

}  // namespace luxodus

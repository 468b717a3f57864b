#include "actors/judge/assess/clear_signs.hpp"

#include "scenes/light/signs/sign_colours.hpp"

namespace luxodus {

namespace {

/// Panes that absorb a smaller share than this count as none.
constexpr double clear_glass = 1e-3;
/// A pane that transmits less hides a sign: one clear pane transmits 0.9, two transmit 0.8.
constexpr double dark_pane = 0.5;
/// Share of a face that must be visible.
constexpr double seen_face = 0.5;

/// A sign that is lit from within and dark in an emergency guides nobody.
bool is_dark(const Sign& sign) {
  return sign.lighting == SignLighting::internal && max_emergency_cd_m2(sign) == 0;
}

/// Share of the light from the middle of a face to an eye that panes transmit.
double passed_by_panes(const Building& building, const GeometryAccess& access, const SignView& view,
                       const glm::dvec3& eye) {
  return clear_share(building.scene(), access, building.local(eye),
                     building.local(view.centre + view.normal * 1e-3));
}

}  // namespace

std::optional<ClearSign> clear_sign(const Building& building, const GeometryAccess& access,
                                    const Sign& sign, uint32_t number, const SignView& view,
                                    const glm::dvec3& eye) {
  if (is_dark(sign) || view.behind || building.seen_share(access, sign, view, eye) <= seen_face)
    return std::nullopt;
  const double passed = passed_by_panes(building, access, view, eye);
  if (passed > 0 && passed < dark_pane) return std::nullopt;
  return ClearSign{number, view, passed > 0 && passed < 1 - clear_glass};
}

std::vector<std::vector<ClearSign>> clear_signs(const SceneDescription& scene,
                                                const Building& building,
                                                const std::vector<Walker>& people) {
  std::vector<std::vector<ClearSign>> out(people.size());
  building.each(people.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 eye = people[i].foot + glm::dvec3(0, 0, standing_eye_m);
    for (uint32_t s = 0; s < scene.signs.size(); ++s)
      if (const auto seen = clear_sign(building, access, scene.signs[s], s,
                                       view_of_sign(scene.signs[s], eye), eye))
        out[i].push_back(*seen);
  });
  return out;
}

}  // namespace luxodus

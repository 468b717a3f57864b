// Closed rooms lose no light: a ray that starts beside an edge must start inside, however sharp the
// corner and however small its triangles.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// The outline of a wedge: two sides of this length from a corner of `angle`, each cut into
/// `parts`, rotated by `turn` (radians).
std::vector<glm::dvec2> wedge(double angle, double length_m, int parts, double turn) {
  std::vector<glm::dvec2> outline;
  const auto add = [&](double along, double towards) {
    outline.emplace_back(along * std::cos(turn + towards), along * std::sin(turn + towards));
  };
  for (int i = 0; i <= parts; ++i) add(length_m * i / parts, 0);
  for (int i = parts; i > 0; --i) add(length_m * i / parts, angle);
  return outline;
}

/// The outline of a rectangle, all sides cut into `parts`.
std::vector<glm::dvec2> rectangle(const glm::dvec2& size, int parts, double turn) {
  std::vector<glm::dvec2> outline;
  const glm::dvec2 corners[] = {{0, 0}, {size.x, 0}, size, {0, size.y}};
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < parts; ++i) {
      const glm::dvec2 p = glm::mix(corners[side], corners[(side + 1) % 4], double(i) / parts);
      outline.emplace_back(p.x * std::cos(turn) - p.y * std::sin(turn),
                           p.x * std::sin(turn) + p.y * std::cos(turn));
    }
  }
  return outline;
}

/// A room over an outline, of reflectance 0.95, with a lamp at `lamp`; all its light must be
/// absorbed.
void check_closed(const std::vector<glm::dvec2>& outline, double height_m, const glm::dvec2& lamp,
                  int64_t particles) {
  std::string text = R"([run]
voxels = false
[[material]]
name = "bright"
reflectance = 0.95
[[object]]
name = "room"
shape = "prism"
material = "bright"
z = 0
)";
  text += fmt::format("height = {}\noutline = [", height_m);
  for (const glm::dvec2& p : outline) text += fmt::format("[{}, {}],\n", p.x, p.y);
  text += fmt::format(R"(]
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
flux_lm = 100
spectrum = "E"
position = [{}, {}, {}]
)",
                      lamp.x, lamp.y, height_m / 2);
  const Run run(scene_from_toml(text), {.particles = particles});
  CHECK(static_cast<double>(run.balance().escaped) / static_cast<double>(unit_weight) == 0);
}

}  // namespace

TEST_CASE("a wedge that narrows to a few degrees, its sides cut small, loses no light") {
  for (const double degrees : {10.0, 2.0}) {
    INFO(degrees << " degrees");
    const double angle = degrees * std::numbers::pi / 180;
    const double turn = 0.6;
    const glm::dvec2 lamp =
        24.0 * glm::dvec2(std::cos(turn + angle / 2), std::sin(turn + angle / 2));
    check_closed(wedge(angle, 32, 64, turn), 3.2, lamp, 1 << 18);
  }
}

TEST_CASE("a corridor at an angle to the axes, its walls cut small, loses no light") {
  const double turn = 33 * std::numbers::pi / 180;
  const glm::dvec2 along(std::cos(turn), std::sin(turn)), across(-along.y, along.x);
  check_closed(rectangle({32, 1}, 128, turn), 3.2, 16.0 * along + 0.5 * across, 1 << 18);
}

}  // namespace luxodus::light

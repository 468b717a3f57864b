// Computed direct light compared with closed forms and fine grid sums: to a thousandth everywhere,
// at grazing angles, in smoke, and if a part of a lamp is hidden.

#include "scenes/emergency/sight.hpp"
#include "scenes/emergency/veil.hpp"
#include "scenes/light/transport/polygon_light.hpp"
#include "scenes/light/transport/visibility.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double lumens = 1000;
constexpr double thousandth = 1e-3;

const std::vector<glm::dvec2> places{{0, 0},     {0.5, 0}, {0.5, 0.5}, {1, 0.3}, {2, 1},
                                     {3.1, 2.9}, {8, 4},   {12, 0},    {20, 15}, {40, 30}};

/// A floor far below everything, so that a scene has some geometry.
void add_floor(SceneDescription& scene) {
  add_quad(scene, "floor", {-60, -60, -1}, {120, 0, 0}, {0, 120, 0}, add_grey(scene, 0));
}

SceneDescription with_lamp(EmitterShape shape, const glm::dvec3& size, double height) {
  SceneDescription scene;
  Emitter& e = add_emitter(scene, shape, {0, 0, height}, {0, 0, -1}, 0);
  e.radiometric = false;
  e.mains_flux = lumens;
  e.size = size;
  add_floor(scene);
  return scene;
}

/// Configuration factor of a horizontal rectangle with a corner above the horizontal receiver
/// (Howell, B-4).
double corner_factor(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * pi);
}

/// Configuration factor of [x0, x1] x [y0, y1] at a height above the receiver at the origin.
double level_factor(double x0, double x1, double y0, double y1, double h) {
  return corner_factor(x1 / h, y1 / h) - corner_factor(x0 / h, y1 / h) -
         corner_factor(x1 / h, y0 / h) + corner_factor(x0 / h, y0 / h);
}

/// Sum over a lamp of 1 x 1 m that shines down, with gas in between.
double summed(const glm::dvec3& place, const glm::dvec3& normal, double height, double sigma) {
  constexpr int n = 700;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const glm::dvec3 to = glm::dvec3((i + 0.5) / n - 0.5, (k + 0.5) / n - 0.5, height) - place;
      const double d2 = glm::dot(to, to), d = std::sqrt(d2);
      sum += std::max(0.0, glm::dot(normal, to)) * to.z / (d2 * d2) * std::exp(-sigma * d);
    }
  return lumens / pi * sum / (n * n);
}

}  // namespace

TEST_CASE("computed light of a level lamp equals the configuration factor, near and grazing") {
  const auto lamp = lit(with_lamp(EmitterShape::rectangle, {1, 1, 0}, 1));
  for (const glm::dvec2& p : places) {
    INFO(p.x << ", " << p.y);
    const double expected = lumens * level_factor(-0.5 - p.x, 0.5 - p.x, -0.5 - p.y, 0.5 - p.y, 1);
    CHECK(lamp->direct_lx({p, 0}, {0, 0, 1}) == Approx(expected).epsilon(1e-5));
  }
}

TEST_CASE("computed light of a lamp cut by the horizon equals the fine sum") {
  const auto lamp = lit(with_lamp(EmitterShape::rectangle, {1, 1, 0}, 1));
  for (const glm::dvec3& way :
       {glm::dvec3(-1, 0, 0), glm::dvec3(-1, 0.3, 0.2), glm::dvec3(0.4, 0.2, -0.1)}) {
    const glm::dvec3 normal = glm::normalize(way);
    for (const glm::dvec2& p : places) {
      if (p.x > 12) continue;
      INFO(p.x << ", " << p.y << " facing " << normal.x << ", " << normal.y);
      const double expected = summed({p, 0.2}, normal, 1, 0);
      CHECK(lamp->direct_lx({p, 0.2}, normal) == Approx(expected).epsilon(thousandth).margin(1e-3));
    }
  }
}

TEST_CASE("computed light through gas equals the fine sum to a thousandth") {
  for (const double sigma : {0.1, 0.7, 3.0}) {
    SceneDescription scene = with_lamp(EmitterShape::rectangle, {1, 1, 0}, 1);
    add_homogeneous(scene, smoke(sigma, 0));
    const auto lamp = lit(std::move(scene));
    for (const glm::dvec2& p : places) {
      if (sigma * glm::length(p) > 12) continue;
      INFO(sigma << " /m at " << p.x << ", " << p.y);
      CHECK(lamp->direct_lx({p, 0}, {0, 0, 1}) ==
            Approx(summed({p, 0}, {0, 0, 1}, 1, sigma)).epsilon(thousandth));
    }
  }
}

TEST_CASE("computed light of a lamp behind a straight edge equals that of its visible part") {
  // A screen 1 m below the lamp, which is 2 m up: it hides twice the distance by which it passes
  // the middle.
  for (const double edge : {-0.2, -0.13, 0.0, 0.071, 0.21, 0.24}) {
    SceneDescription scene = with_lamp(EmitterShape::rectangle, {1, 1, 0}, 2);
    add_quad(scene, "screen", {-5, -5, 1}, {5 + edge, 0, 0}, {0, 10, 0}, add_grey(scene, 0));
    const auto lamp = lit(std::move(scene));
    INFO("edge at " << edge);
    const double expected = lumens * level_factor(2 * edge, 0.5, -0.5, 0.5, 2);
    CHECK(lamp->direct_lx({0, 0, 0}, {0, 0, 1}) == Approx(expected).epsilon(thousandth));
  }
}

TEST_CASE("computed light of a disc and of a sphere equals the closed form") {
  constexpr double h = 1.5, r = 0.4;
  const auto disc = lit(with_lamp(EmitterShape::disc, {2 * r, 0, 0}, h));
  const auto sphere = lit(with_lamp(EmitterShape::sphere, {2 * r, 0, 0}, h));
  for (const glm::dvec2& p : places) {
    INFO(p.x << ", " << p.y);
    // Howell, B-12: a disc in a horizontal plane.
    const double l = glm::length(p), z = h * h + l * l + r * r;
    const double factor = (1 - (h * h + l * l - r * r) / std::sqrt(z * z - 4 * r * r * l * l)) / 2;
    const double exitance = lumens / (pi * r * r);
    CHECK(disc->direct_lx({p, 0}, {0, 0, 1}) == Approx(exitance * factor).epsilon(thousandth));
    // A sphere above the horizon gives the light of a point.
    const double d2 = h * h + l * l;
    CHECK(sphere->direct_lx({p, 0}, {0, 0, 1}) ==
          Approx(lumens / (4 * pi) * h / (d2 * std::sqrt(d2))).epsilon(thousandth));
  }
}

TEST_CASE("computed light of a tube equals the fine sum over the side that faces the place") {
  constexpr double h = 1.2, length = 1.2, r = 0.02;
  const auto tube = lit(with_lamp(EmitterShape::tube, {length, 2 * r, 0}, h));
  for (const glm::dvec2& p : places) {
    INFO(p.x << ", " << p.y);
    constexpr int across = 400, along = 1500;
    double sum = 0;
    for (int i = 0; i < across; ++i) {
      const double psi = 2 * pi * (i + 0.5) / across;
      const glm::dvec3 n(0, std::cos(psi), std::sin(psi));
      for (int k = 0; k < along; ++k) {
        const glm::dvec3 at = glm::dvec3(((k + 0.5) / along - 0.5) * length, 0, h) + r * n;
        const glm::dvec3 to = at - glm::dvec3(p, 0);
        const double d2 = glm::dot(to, to);
        sum += to.z * std::max(0.0, -glm::dot(n, to)) / (d2 * d2);
      }
    }
    CHECK(tube->direct_lx({p, 0}, {0, 0, 1}) ==
          Approx(lumens / pi * sum / (across * along)).epsilon(thousandth));
  }
}

TEST_CASE("computed light of a mesh equals the configuration factor of its polygon") {
  SceneDescription scene = with_lamp(EmitterShape::mesh, {0, 0, 0}, 1);
  Emitter& e = scene.emitters.front();
  e.mesh.positions = {{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}};
  e.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};  // fronts face down
  const auto lamp = lit(std::move(scene));
  for (const glm::dvec2& p : places) {
    INFO(p.x << ", " << p.y);
    const double expected = lumens * level_factor(-0.5 - p.x, 0.5 - p.x, -0.5 - p.y, 0.5 - p.y, 1);
    CHECK(lamp->direct_lx({p, 0}, {0, 0, 1}) == Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("a polygon's projected solid angle and solid angle equal sums over all directions") {
  // A triangle, partly below the horizon, against directions on a fine grid of the sphere.
  const std::vector<glm::dvec3> corners{{1, 0.2, -0.4}, {0.3, 1.1, 0.5}, {-0.6, 0.1, 0.9}};
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, -0.1, 1));
  constexpr int n = 1500;
  double projected = 0, solid = 0;
  for (int i = 0; i < n; ++i) {
    const double z = -1 + 2 * (i + 0.5) / n, s = std::sqrt(1 - z * z);
    for (int k = 0; k < 2 * n; ++k) {
      const double phi = pi * (k + 0.5) / n;
      const glm::dvec3 w(s * std::cos(phi), s * std::sin(phi), z);
      bool inside = true;
      for (size_t c = 0; c < 3; ++c)
        inside &= glm::dot(glm::cross(corners[c], corners[(c + 1) % 3]), w) *
                      glm::dot(glm::cross(corners[0], corners[1]), corners[2]) >
                  0;
      if (!inside) continue;
      const double d = 4 * pi / (2.0 * n * n);
      solid += d;
      projected += d * std::max(0.0, glm::dot(normal, w));
    }
  }
  CHECK(solid_angle(corners) == Approx(solid).epsilon(2e-3));
  CHECK(projected_solid_angle(corners, normal) == Approx(projected).epsilon(2e-3));
}

TEST_CASE("light of a flame comes from where it glows, whatever else is in the scene") {
  for (const double post : {0.0, 60.0}) {
    SceneDescription scene;
    add_floor(scene);
    if (post > 0) add_quad(scene, "post", {0, post, 0}, {0.1, 0, 0}, {0, 0, 3}, 0);
    Medium& flame = add_ball(scene, {3, 3.6, 0.8}, 0.3, smoke(0, 0));
    flame.emission.emplace().power_w = 100;
    const auto scene_with_flame = compile(std::move(scene));
    const CompiledEmitter& e = scene_with_flame->emitters.front();
    const glm::dvec3 middle = glm::dvec3(e.origin) + scene_with_flame->local_origin;
    INFO(middle.x << ", " << middle.y << ", " << middle.z);
    CHECK(glm::distance(middle, {3, 3.6, 0.8}) < 0.01);
    CHECK(static_cast<double>(std::max({e.size.x, e.size.y, e.size.z})) ==
          Approx(0.6).epsilon(0.05));
  }
}

TEST_CASE("the veil of a flame comes from where it glows, through the smoke before each part") {
  // A ball of gas that absorbs a quarter over a metre, seen from so near that it is not a point,
  // compared with a sum over its volume.
  constexpr double radius = 0.5, sigma = 0.3, age = 65;
  const glm::dvec3 centre(3, 1.2, 1.4), eye(2, 0, 1.6), gaze(1, 0, 0);
  const auto weight = [&](const glm::dvec3& to) {
    const double angle = std::acos(glm::dot(glm::normalize(to), gaze)) * 180 / pi;
    return veil_per_lux(angle, age) * std::max(0.0, glm::dot(glm::normalize(to), gaze));
  };
  double expected = 0;
  int inside = 0;
  constexpr int n = 60;
  for (int i = 0; i < n * n * n; ++i) {
    const glm::dvec3 p =
        radius * (2.0 * (glm::dvec3(i % n, i / n % n, i / (n * n)) + 0.5) / double(n) - 1.0);
    if (glm::length(p) > radius) continue;
    ++inside;
    const glm::dvec3 to = centre + p - eye, w = glm::normalize(to);
    // The length within the ball of the line from the point to the eye.
    const double along = glm::dot(p, -w);
    const double length = -along + std::sqrt(along * along + radius * radius - glm::dot(p, p));
    expected += std::exp(-sigma * length) * weight(to) / glm::dot(to, to);
  }
  std::vector<double> veils;
  for (const double post : {0.0, 60.0}) {
    SceneDescription scene;
    add_floor(scene);
    if (post > 0) add_quad(scene, "post", {0, post, 0}, {0.1, 0, 0}, {0, 0, 3}, 0);
    Medium& flame = add_ball(scene, centre, radius, smoke(sigma, 0));
    flame.emission.emplace().power_w = 100;
    const auto seen = lit(std::move(scene));
    const CompiledScene& s = seen->scene();
    double veil = 0;
    for (const ArrivingLight& light :
         direct_arrivals(s, GeometryAccess::resident(seen->local().index()),
                         Vec3(eye - s.local_origin), Vec3(gaze), {}))
      veil += light.illuminance_lx *
              veil_per_lux(std::acos(glm::dot(glm::dvec3(light.direction), gaze)) * 180 / pi, age);
    veils.push_back(veil);
    const double lm = s.emitters.front().luminous_flux_lm;
    CHECK(veil == Approx(lm / (4 * pi) * expected / inside).epsilon(0.01));
  }
  CHECK(veils[1] == Approx(veils[0]).epsilon(1e-3));
}

TEST_CASE("computed light of a flame equals that of its volume to a thousandth") {
  constexpr double radius = 0.5;
  SceneDescription scene;
  add_floor(scene);
  Medium& flame = add_ball(scene, {0, 0, 2}, radius, smoke(0, 0));
  flame.emission.emplace().power_w = 100;
  const auto ball = lit(std::move(scene));
  const double watts = ball->scene().emitters.front().luminous_flux_lm;
  for (const glm::dvec2& p : places) {
    const double d2 = glm::dot(p, p) + 4;
    INFO(p.x << ", " << p.y);
    // For a uniform ball without extinction, by symmetry the flux through any sphere around it: the
    // vector of light is that of a point.
    CHECK(ball->direct_lx({p, 0}, {0, 0, 1}) ==
          Approx(watts / (4 * pi) * 2 / (d2 * std::sqrt(d2))).epsilon(2 * thousandth));
  }
}

}  // namespace luxodus::light

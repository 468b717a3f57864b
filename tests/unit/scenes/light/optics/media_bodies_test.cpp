// Quadric bodies and prisms: chords, volumes, clip planes, concave footprints, and long distances.
#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

using namespace luxodus;
using namespace luxodus::media_test;

namespace {

Result<QuadricBody> made_bodies(const QuadricShape& shape, const Frame& frame = {}) {
  return QuadricBody::make(body(shape, smoke(1), frame), glm::dvec3(0));
}

double chord(const QuadricBody& b, const glm::dvec3& o, const glm::dvec3& d) {
  RayInterval piece[2];
  const int n = b.intervals(o, d, {0, 1e30}, piece);
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += piece[i].t1 - piece[i].t0;
  return sum;
}

Medium prism(std::vector<glm::dvec2> polygon, double low, double high, double sigma_t) {
  Medium m = everywhere(smoke(sigma_t));
  m.footprint = {std::move(polygon), low, high};
  return m;
}

}  // namespace

TEST_CASE("the volumes of the named bodies are their closed forms", "[optics][media]") {
  const auto volume = [](const QuadricShape& s) { return made_bodies(s)->volume(); };
  CHECK(volume(ellipsoid({1, 2, 3})).m3 == Approx(4 * pi / 3 * 6).epsilon(1e-12));
  CHECK(volume(cylinder(0.5, 2)).m3 == Approx(pi * 0.25 * 2).epsilon(1e-12));
  CHECK(volume(cone(0.5, 2)).m3 == Approx(pi * 0.25 * 2 / 3).epsilon(1e-12));
  CHECK(volume(paraboloid(0.5, 2)).m3 == Approx(pi * 0.25 * 2 / 2).epsilon(1e-12));
  CHECK(volume(cone(1e-3, 2e-3)).m3 == Approx(pi * 2e-9 / 3).epsilon(1e-12));
  CHECK(volume(cone(1e4, 1e4)).m3 == Approx(pi * 1e12 / 3).epsilon(1e-12));
  CHECK(volume(cone(1, 1)).error_m3 == 0);
}

TEST_CASE("the volume of a body without a closed form errs by no more than it states",
          "[optics][media]") {
  QuadricShape half = ellipsoid({1, 1, 1});
  half.quadric.clips.push_back({glm::normalize(glm::dvec3(1, 1, 1)), 0.0});
  const QuadricBody::Volume cut = made_bodies(half)->volume();
  CHECK(cut.error_m3 > 0);
  CHECK(cut.error_m3 < 1e-3 * cut.m3);
  CHECK(std::abs(cut.m3 - 2 * pi / 3) < 3 * cut.error_m3 + 1e-4);
  // A box that clips the body bounds its volume, too.
  QuadricShape boxed = ellipsoid({1, 1, 1});
  boxed.bounds.high.x = 0;
  const QuadricBody::Volume sliced = made_bodies(boxed)->volume();
  CHECK(std::abs(sliced.m3 - 2 * pi / 3) < 3 * sliced.error_m3 + 1e-4);
  // One-sheet hyperboloid x^2 + y^2 - z^2 <= 1 between z = -1 and 1: pi (2 + 2/3).
  QuadricShape waist;
  waist.quadric.a[0][0] = waist.quadric.a[1][1] = 1;
  waist.quadric.a[2][2] = -1;
  waist.quadric.c = -1;
  waist.bounds = {glm::dvec3(-1.5, -1.5, -1), glm::dvec3(1.5, 1.5, 1)};
  CHECK(made_bodies(waist)->volume().m3 == Approx(pi * 8 / 3).epsilon(1e-12));
}

TEST_CASE("chords of a sphere have their closed form from any distance", "[optics][media]") {
  Frame frame;
  frame.axes = turned(0.7);
  frame.origin = {1, 2, 3};
  for (const double r : {1e-3, 1.0, 1e3}) {
    const auto sphere = made_bodies(ellipsoid(glm::dvec3(r)), frame);
    REQUIRE(sphere.ok());
    for (const double far : {0.0, 10.0, 1e4}) {
      for (const double b : {0.0, 0.5, 0.99}) {
        const glm::dvec3 o = frame.origin + glm::dvec3(-2 * r - far, b * r, 0);
        // At 10 km the turned origin is rounded by some 4e-12 m; a chord of a 1 mm sphere at 0.99 r
        // takes that times b / (r (1 - b^2)) = 5e4 / m.
        CHECK(chord(*sphere.operator->(), o, {1, 0, 0}) ==
              Approx(2 * r * std::sqrt(1 - b * b)).epsilon(2e-7));
      }
      const glm::dvec3 miss = frame.origin + glm::dvec3(-2 * r - far, 1.001 * r, 0);
      CHECK(chord(*sphere.operator->(), miss, {1, 0, 0}) == 0);
    }
  }
}

TEST_CASE("rays along an axis or a side, where the quadratic degenerates, are exact",
          "[optics][media]") {
  const auto tube = made_bodies(cylinder(1, 3));
  CHECK(chord(*tube.operator->(), {0.5, 0, -1}, {0, 0, 1}) == Approx(3).epsilon(1e-14));
  CHECK(chord(*tube.operator->(), {1.5, 0, -1}, {0, 0, 1}) == 0);
  CHECK(chord(*tube.operator->(), {0.5, 0, -1}, {1e-30, 0, 1}) == Approx(3).epsilon(1e-14));
  const auto bowl = made_bodies(paraboloid(1, 1));
  CHECK(chord(*bowl.operator->(), {0.5, 0, -1}, {0, 0, 1}) == Approx(0.75).epsilon(1e-14));
  CHECK(chord(*bowl.operator->(), {0.5, 0, 5}, {0, 0, -1}) == Approx(0.75).epsilon(1e-14));
  // Parallel to a side of the cone (45 degrees): one root is at infinity.
  const auto hat = made_bodies(cone(1, 1));
  const double s = std::sqrt(0.5);
  CHECK(chord(*hat.operator->(), {0, 0, 0}, {s, 0, -s}) == 0);
  CHECK(chord(*hat.operator->(), {-0.5, 0, 0}, {s, 0, s}) == Approx(0.75 / s).epsilon(1e-12));
  // Through the apex: a double root, which a rounding error of 1e-16 moves by its square root.
  CHECK(chord(*hat.operator->(), {0, 0, -1}, {0, 0, 1}) == Approx(1).epsilon(1e-7));
}

TEST_CASE("the roots of a quadratic are exact where the textbook formula loses all digits",
          "[optics][media]") {
  RayInterval r[2];
  REQUIRE(below_zero(1, -1e8, 1, r) == 1);  // roots 1e8 and 1e-8
  CHECK(r[0].t0 == Approx(1e-8).epsilon(1e-14));
  CHECK(r[0].t1 == Approx(1e8).epsilon(1e-14));
  REQUIRE(below_zero(-1, 0, 4, r) == 2);
  CHECK(r[0].t1 == -2);
  CHECK(r[1].t0 == 2);
  REQUIRE(below_zero(1e-300, 1, -1, r) == 1);
  CHECK(r[0].t1 == Approx(1));
  CHECK(below_zero(1, 0, 1, r) == 0);
  CHECK(below_zero(0, 0, 1, r) == 0);
  CHECK(below_zero(0, 0, 0, r) == 1);
  // Roots 1 and 1 + 2^-24, exact coefficients: the discriminant 2^-48 is a difference of nearly
  // equal products.
  REQUIRE(below_zero(1, -(2 + 0x1p-24), 1 + 0x1p-24, r) == 1);
  CHECK(r[0].t1 - r[0].t0 == Approx(0x1p-24).epsilon(1e-7));
}

TEST_CASE("a ray has two segments in a hyperboloid of two sheets", "[optics][media]") {
  QuadricShape sheets;  // x^2 + y^2 - z^2 + 1 <= 0
  sheets.quadric.a[0][0] = sheets.quadric.a[1][1] = 1;
  sheets.quadric.a[2][2] = -1;
  sheets.quadric.c = 1;
  sheets.bounds = {glm::dvec3(-3), glm::dvec3(3)};
  const MediaSet set = compiled({body(sheets, smoke(0.5))});
  CHECK(depth(set, {0, 0, -9}, {0, 0, 1}, 20) == Approx(0.5 * 4));
  CHECK(fly(set, {0, 0, -9}, {0, 0, 1}, 20, 1.5).t == Approx(11.0F));  // 6 + 2 + 2 + 1
  CHECK(fly(set, {0, 0, 0}, {0, 0, 1}, 20, 0.5).t == Approx(2.0F));
  CHECK(extinction(set, {0, 0, 2}) == 0.5);
  CHECK(extinction(set, {0, 0, 0}) == 0);
}

TEST_CASE("the mean chord of a convex body is 4 V / S", "[optics][media]") {
  // Lines of uniform density: a random direction, and a point on a disc that covers the body.
  const auto mean = [](const QuadricBody& b, double radius, uint64_t seed, double& error) {
    Draws draw(seed);
    double n = 0;
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < 200000; ++i) {
      const glm::dvec3 d = draw.direction();
      const glm::dvec3 side = glm::normalize(
          glm::cross(d, std::abs(d.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
      const double r = radius * std::sqrt(draw());
      const double a = draw.between(0, 2 * pi);
      const glm::dvec3 o =
          side * (r * std::cos(a)) + glm::cross(d, side) * (r * std::sin(a)) - d * (2 * radius);
      const double c = chord(b, o, d);
      if (c <= 0) continue;
      n += 1;
      sum += c;
      squares += c * c;
    }
    const double m = sum / n;
    error = std::sqrt((squares / n - m * m) / n);
    return m;
  };
  double error = 0;
  const auto sphere = made_bodies(ellipsoid(glm::dvec3(0.8)));
  double m = mean(*sphere.operator->(), 1, 21, error);
  CHECK(std::abs(m - 4 * 0.8 / 3) < 4 * error);
  // Cylinder: 4 pi r^2 h / (2 pi r (r + h)).
  const auto can = made_bodies(cylinder(0.5, 0.7));
  m = mean(*can.operator->(), 1, 22, error);
  CHECK(std::abs(m - 2 * 0.5 * 0.7 / 1.2) < 4 * error);
}

TEST_CASE("points drawn in a body are uniform", "[optics][media]") {
  Frame frame;
  frame.axes = turned(1.1);
  frame.origin = {3, -2, 5};
  Medium flame = body(cone(1, 2), smoke(0), frame);
  glow(flame);
  const MediaSet set = compiled({flame});
  ResidentBricks bricks(set);
  REQUIRE(set.emitter(0) != nullptr);
  CHECK(set.emitter(0)->volume_m3() == Approx(2 * pi / 3));
  Draws draw(23);
  const int n = 100000;
  double height = 0;
  int inner = 0;
  for (int i = 0; i < n; ++i) {
    const glm::vec3 p = set.sample_emission_point(0, draw, bricks);
    const glm::dvec3 local = (glm::dvec3(p) - frame.origin) * frame.axes;
    REQUIRE(std::hypot(local.x, local.y) <= 1 - local.z / 2 + 1e-5);
    height += local.z;
    if (std::hypot(local.x, local.y) < 0.5 * (1 - local.z / 2)) ++inner;
  }
  // Height h: mean h/4, variance 3 h^2 / 80; a quarter lies in the inner half of every disc.
  CHECK(std::abs(height / n - 0.5) < 4 * std::sqrt(3 * 4 / 80.0 / n));
  CHECK(std::abs(inner / static_cast<double>(n) - 0.25) < 4 * std::sqrt(0.25 * 0.75 / n));
  const glm::vec3 middle(frame.origin + frame.axes * glm::dvec3(0, 0, 0.5));
  CHECK(set.emission_density(0, middle, bricks) == Approx(3 / (2 * pi)));
  CHECK(set.emission_density(0, glm::vec3(0), bricks) == 0);
}

TEST_CASE("a ray crosses each arm of a concave footprint, in either orientation",
          "[optics][media]") {
  // A comb of three teeth, open to the north.
  std::vector<glm::dvec2> comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                                  {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int turn = 0; turn < 2; ++turn) {
    const MediaSet set = compiled({prism(comb, 0, 2, 1)});
    CHECK(depth(set, {-1, 2, 1}, {1, 0, 0}, 10) == Approx(3));
    CHECK(depth(set, {-1, 0.5F, 1}, {1, 0, 0}, 10) == Approx(5));
    CHECK(depth(set, {-1, 4, 1}, {1, 0, 0}, 10) == 0);
    CHECK(depth(set, {2.5F, 2, 1}, {1, 0, 0}, 1) == Approx(0.5));
    CHECK(depth(set, {0.5F, 2, -5}, {0, 0, 1}, 10) == Approx(2));
    CHECK(depth(set, {1.5F, 2, -5}, {0, 0, 1}, 10) == 0);
    CHECK(fly(set, {-1, 2, 1}, {1, 0, 0}, 10, 2.5).t == Approx(5.5F));
    CHECK(extinction(set, {0.5F, 2, 1}) == 1);
    CHECK(extinction(set, {1.5F, 2, 1}) == 0);
    CHECK(extinction(set, {0.5F, 2, 2.5F}) == 0);
    // Through corners and along walls: fully in or fully out, never half and never without end.
    const double along = depth(set, {-1, 3, 1}, {1, 0, 0}, 10);
    CHECK((along == Approx(0).margin(1e-12) || along == Approx(3)));
    CHECK(depth(set, {-1, -1, 1}, glm::normalize(glm::vec3(1, 1, 0)), 1.4F) == 0);
    std::reverse(comb.begin(), comb.end());
  }
}

TEST_CASE("rooms that share a wall neither overlap nor leak", "[optics][media]") {
  Draws draw(24);
  INFO("seed " << draw.seed());
  const MediaSet halves = compiled({prism({{0, 0}, {1.7, 0}, {2.3, 4}, {0, 4}}, 0, 3, 1),
                                    prism({{1.7, 0}, {5, 0}, {5, 4}, {2.3, 4}}, 0, 3, 1)});
  const MediaSet whole = compiled({prism({{0, 0}, {5, 0}, {5, 4}, {0, 4}}, 0, 3, 1)});
  for (int i = 0; i < 5000; ++i) {
    const glm::vec3 o(draw.point({-1, -1, -1}, {6, 5, 4}));
    const glm::vec3 d(draw.direction());
    REQUIRE(depth(halves, o, d, 20) == Approx(depth(whole, o, d, 20)).epsilon(1e-12).margin(1e-12));
  }
}

TEST_CASE("a layered medium with a footprint is thick where it is layered", "[optics][media]") {
  Medium m = layers({{0, 1, smoke(1)}, {1, 2, smoke(0)}, {2, 3, smoke(5)}});
  m.footprint.polygon = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  m.footprint.z_high = 2.5;
  const MediaSet set = compiled({m});
  CHECK(depth(set, {1, 1, -1}, {0, 0, 1}, 10) == Approx(1 + 2.5));
  CHECK(depth(set, {3, 1, -1}, {0, 0, 1}, 10) == 0);
  CHECK(depth(set, {-1, 1, 2.25F}, {1, 0, 0}, 10) == Approx(10));
  CHECK(fly(set, {1, 1, 0}, {0, 0, 1}, 10, 1 + 1.25).t == Approx(2.25F));
}

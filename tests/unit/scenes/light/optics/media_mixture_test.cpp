// Random mixtures of media compared with a reference that only evaluates single points, and equal
// descriptions of one smoke compared with each other.
#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

using namespace luxodus;
using namespace luxodus::media_test;

namespace {

bool in_polygon(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
  double turns = 0;  // winding angle, unlike the parity rule under test
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i] - p;
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()] - p;
    turns += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return std::abs(turns) > pi;
}

bool in_footprint(const Footprint& f, const glm::dvec3& p) {
  if (p.z < f.z_low || p.z >= f.z_high) return false;
  return f.polygon.empty() || in_polygon(f.polygon, glm::dvec2(p));
}

/// Extinction of one medium at a point, directly from its description.
double plain_extinction(const Medium& m, const glm::dvec3& p) {
  const glm::dvec3 local = glm::transpose(m.frame.axes) * (p - m.frame.origin);
  switch (m.kind) {
    case MediumKind::homogeneous:
      return in_footprint(m.footprint, p) ? m.optics.extinction.sigma_t : 0;
    case MediumKind::layered:
      if (!in_footprint(m.footprint, p)) return 0;
      for (const Layer& l : m.layers) {
        if (p.z >= l.z_low && p.z < l.z_high) return l.optics.extinction.sigma_t;
      }
      return 0;
    case MediumKind::bounded:
      for (const Quadric::Clip& c : m.quadric.clips) {
        if (glm::dot(c.normal, local) > c.offset) return 0;
      }
      return glm::dot(local, m.quadric.a * local) + glm::dot(m.quadric.b, local) + m.quadric.c <= 0
                 ? m.optics.extinction.sigma_t
                 : 0;
    case MediumKind::data_set:
      break;
  }
  const glm::dvec3 share = local / m.data.extent;
  for (int k = 0; k < 3; ++k) {
    if (share[k] < 0 || share[k] >= 1) return 0;
  }
  const auto x = static_cast<size_t>(share.x * m.data.nx);
  const auto y = static_cast<size_t>(share.y * m.data.ny);
  const auto z = static_cast<size_t>(share.z * m.data.nz);
  return static_cast<double>(
      m.data.extinction[(z * static_cast<size_t>(m.data.ny) + y) * static_cast<size_t>(m.data.nx) +
                        x]);
}

Frame random_frame(Draws& draw) {
  Frame f;
  f.axes = turned(draw.between(-3, 3));
  f.origin = draw.point({0, 0, 0}, {6, 6, 3});
  return f;
}

std::vector<glm::dvec2> random_star(Draws& draw) {
  const int corners = 3 + draw.below(9);
  const double cx = draw.between(1, 5);
  const double cy = draw.between(1, 5);
  std::vector<glm::dvec2> out;
  for (int i = 0; i < corners; ++i) {
    const double r = draw.between(0.3, 3);
    const double a = 2 * pi * i / corners;
    out.emplace_back(cx + r * std::cos(a), cy + r * std::sin(a));
  }
  return out;
}

Medium random_medium(Draws& draw) {
  const SmokeOptics optics = smoke(draw.between(0.05, 1));
  const int kind = draw.below(5);
  if (kind == 0) {
    Medium m = everywhere(optics);
    if (draw() < 0.8) m.footprint = {random_star(draw), draw.between(-1, 1), draw.between(1, 4)};
    return m;
  }
  if (kind == 1) {
    std::vector<Layer> list;
    double z = draw.between(-1, 1);
    for (int i = 0; i < 6; ++i) {
      const double next = z + draw.between(0.05, 0.8);
      if (draw() < 0.7) list.push_back({z, next, smoke(draw() < 0.2 ? 0 : draw.between(0, 1))});
      z = next;
    }
    Medium m = layers(list);
    if (draw() < 0.4) m.footprint.polygon = random_star(draw);
    return m;
  }
  if (kind == 2)
    return body(ellipsoid(draw.point(glm::dvec3(0.3), glm::dvec3(2))), optics, random_frame(draw));
  if (kind == 3) {
    const double r = draw.between(0.2, 2);
    const double h = draw.between(0.2, 3);
    const int shape = draw.below(3);
    const QuadricShape q = shape == 0 ? cylinder(r, h) : shape == 1 ? cone(r, h) : paraboloid(r, h);
    return body(q, optics, random_frame(draw));
  }
  const int nx = 1 + draw.below(40);
  const int ny = 1 + draw.below(20);
  const int nz = 1 + draw.below(20);
  Medium m =
      grid(nx, ny, nz, draw.point(glm::dvec3(0.5), glm::dvec3(4)), optics, random_frame(draw));
  for (int i = 0; i < nx * ny * nz; ++i) {
    m.data.extinction.push_back(draw() < 0.5 ? 0.0F : static_cast<float>(draw()));
  }
  return m;
}

double marched(const std::vector<Medium>& media, const glm::dvec3& o, const glm::dvec3& d,
               double length, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 p = o + d * (length * (i + 0.5) / steps);
    for (const Medium& m : media) sum += plain_extinction(m, p);
  }
  return sum * length / steps;
}

}  // namespace

TEST_CASE("optical depth of random mixtures equals a march that evaluates single points",
          "[optics][media]") {
  Draws draw(41);
  INFO("seed " << draw.seed());
  const int steps = 20000;
  const double length = 9;
  double worst = 0;
  for (int scene = 0; scene < 60; ++scene) {
    std::vector<Medium> media;
    const int count = 1 + draw.below(5);
    for (int i = 0; i < count; ++i) media.push_back(random_medium(draw));
    const MediaSet set = compiled(media);
    for (int ray = 0; ray < 10; ++ray) {
      const glm::vec3 o(draw.point({-2, -2, -2}, {8, 8, 5}));
      const glm::vec3 d(draw.direction());
      const double exact = depth(set, o, d, static_cast<float>(length));
      const double plain = marched(media, glm::dvec3(o), glm::dvec3(d), length, steps);
      // Each face errs by up to half a step times its jump in extinction (below 1/m); signs are
      // random.
      INFO("scene " << scene << " ray " << ray);
      REQUIRE(std::abs(exact - plain) < 12 * 0.5 * length / steps);
      worst = std::max(worst, std::abs(exact - plain));
    }
  }
  CHECK(worst > 0);
}

TEST_CASE("in random mixtures free flight, segments and optical depth agree", "[optics][media]") {
  Draws draw(42);
  INFO("seed " << draw.seed());
  int collided = 0;
  for (int scene = 0; scene < 100; ++scene) {
    std::vector<Medium> media;
    const int count = 1 + draw.below(6);
    for (int i = 0; i < count; ++i) media.push_back(random_medium(draw));
    const MediaSet set = compiled(media);
    ResidentBricks bricks(set);
    for (int ray = 0; ray < 50; ++ray) {
      const glm::vec3 o(draw.point({-2, -2, -2}, {8, 8, 5}));
      const glm::vec3 d(draw.direction());
      const double all = depth(set, o, d, 9);
      double sum = 0;
      float end = 0;
      bool ordered = true;
      for_each_segment(set, 0, o, d, 9, bricks, [&](const MediaSegment& s) {
        ordered = ordered && s.t0 >= end && s.t1 >= s.t0 && s.sigma_t > 0;
        end = s.t1;
        sum += s.sigma_t * s.length;
        return true;
      });
      REQUIRE(ordered);
      REQUIRE(sum == Approx(all).epsilon(1e-12).margin(1e-12));
      const double tau = draw() * all;
      const FreeFlight f = fly(set, o, d, 9, tau, draw());
      REQUIRE(f.collided == (all > 0));
      REQUIRE_FALSE(fly(set, o, d, 9, all * (1 + 1e-9) + 1e-300).collided);
      if (!f.collided) continue;
      ++collided;
      REQUIRE(std::abs(depth(set, o, d, f.t) - tau) < 6 * 6e-8 * 9 + 1e-12);
      REQUIRE(f.medium >= 0);
      REQUIRE(f.medium < count);
    }
  }
  CHECK(collided > 1000);
}

TEST_CASE(
    "the colliding medium is present at the collision, and the sum at a point is that of all media",
    "[optics][media]") {
  Draws draw(43);
  INFO("seed " << draw.seed());
  int off = 0;
  int collided = 0;
  for (int scene = 0; scene < 60; ++scene) {
    std::vector<Medium> media;
    for (int i = 0; i < 5; ++i) media.push_back(random_medium(draw));
    const MediaSet set = compiled(media);
    ResidentBricks bricks(set);
    for (int ray = 0; ray < 50; ++ray) {
      const glm::vec3 o(draw.point({-2, -2, -2}, {8, 8, 5}));
      const glm::vec3 d(draw.direction());
      double sum = 0;
      for (const Medium& m : media) sum += plain_extinction(m, glm::dvec3(o));
      REQUIRE(extinction(set, o) == Approx(sum).epsilon(1e-12).margin(1e-14));
      const FreeFlight f = fly(set, o, d, 9, -std::log1p(-draw()), draw());
      if (!f.collided) continue;
      ++collided;
      const glm::dvec3 place = glm::dvec3(o) + glm::dvec3(d) * static_cast<double>(f.t);
      if (!(plain_extinction(media[static_cast<size_t>(f.medium)], place) > 0)) ++off;
    }
  }
  // Only a point within a float step (1e-6 m) of a face may count as the other side.
  CHECK(collided > 500);
  CHECK(off <= 2);
}

TEST_CASE("one smoke described in six ways gives equal results", "[optics][media]") {
  const double s = 0.8;
  // A ray inside [0, 6]^3 meets the same smoke however far the description extends beyond.
  std::vector<std::vector<Medium>> ways;
  ways.push_back({everywhere(smoke(s))});
  ways.push_back({layers({{-20, 20, smoke(s)}})});
  std::vector<Layer> six;
  for (int i = 0; i < 6; ++i) six.push_back({i * 1.0, i + 1.0, smoke(s)});
  ways.push_back({layers(six)});
  Frame middle;
  middle.origin = {3, 3, 3};
  ways.push_back({body(ellipsoid({1e6, 2e6, 3e6}), smoke(s), middle)});
  Frame below;
  below.origin = {-1, -1, -1};
  Medium voxels = grid(37, 21, 18, {8, 8, 8}, smoke(9), below);
  voxels.data.extinction.assign(37 * 21 * 18, static_cast<float>(s));
  ways.push_back({voxels});
  ways.push_back({everywhere(smoke(s / 2)), everywhere(smoke(s / 2))});
  Medium room = everywhere(smoke(s));
  room.footprint.polygon = {{-1, -1}, {7, -1}, {7, 7}, {-1, 7}};
  ways.push_back({room});

  std::vector<MediaSet> sets;
  for (const auto& way : ways) sets.push_back(compiled(way));
  Draws draw(44);
  INFO("seed " << draw.seed());
  ResidentBricks none(sets[0]);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 a = draw.point(glm::dvec3(0), glm::dvec3(6));
    const glm::dvec3 b = draw.point(glm::dvec3(0), glm::dvec3(6));
    const glm::vec3 o(a);
    const glm::vec3 d(glm::normalize(b - a));
    const auto t_max = static_cast<float>(glm::length(b - a)) * 0.9999F;
    const double tau = -std::log1p(-draw());
    const FreeFlight expected =
        free_flight<MediaNeed::homogeneous>(sets[0], 0, o, d, t_max, tau, 0.5, none);
    for (size_t k = 0; k < sets.size(); ++k) {
      INFO("way " << k);
      // Voxels hold float: 0.8 is rounded.
      REQUIRE(depth(sets[k], o, d, t_max) ==
              Approx(s * static_cast<double>(t_max)).epsilon(k == 4 ? 1e-7 : 1e-10));
      const FreeFlight f = fly(sets[k], o, d, t_max, tau);
      REQUIRE(f.collided == expected.collided);
      REQUIRE(f.t == Approx(expected.t).epsilon(3e-7));
    }
  }
}

TEST_CASE("a flight of infinite or zero length, or of any slope, terminates", "[optics][media]") {
  Draws draw(45);
  INFO("seed " << draw.seed());
  std::vector<Medium> media;
  for (int i = 0; i < 12; ++i) media.push_back(random_medium(draw));
  const MediaSet set = compiled(media);
  const float parts[] = {0.0F, 1e-45F, -1e-38F, 1e-30F, -1e-12F, 0.5F, -0.5F, 1.0F, -1.0F};
  for (const float x : parts) {
    for (const float y : parts) {
      for (const float z : parts) {
        const glm::vec3 d(x, y, z);
        if (!(glm::length(glm::dvec3(d)) > 0.1)) continue;
        const glm::vec3 unit(glm::normalize(glm::dvec3(d)));
        for (const glm::vec3& o : {glm::vec3(0), glm::vec3(1, 2, 1), glm::vec3(-1e4F, 3, 1)}) {
          const FreeFlight f = fly(set, o, unit, infinite, 5);
          REQUIRE(f.t >= 0);
          const FreeFlight stay = fly(set, o, unit, 0, 0);
          REQUIRE_FALSE(stay.collided);
          REQUIRE(depth(set, o, unit, 0) == 0);
          REQUIRE(depth(set, o, unit, 1e5F) >= 0);
        }
      }
    }
  }
}

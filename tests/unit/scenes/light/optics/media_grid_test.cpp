// Data sets: bricks, cells crossed by integer steps, resolvers that evict bricks, and flames
// sampled by strength.
#include <map>
#include <memory>

#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

using namespace luxodus;
using namespace luxodus::media_test;

namespace {

Frame placed(const glm::dvec3& at, double angle) {
  Frame f;
  f.origin = at;
  f.axes = turned(angle);
  return f;
}

/// A grid of several bricks, some of them clear, with every quantity varying by cell.
Medium cloud(int nx, int ny, int nz, uint64_t seed, const Frame& frame) {
  Medium m = grid(nx, ny, nz, {0.1 * nx, 0.08 * ny, 0.12 * nz}, smoke(1, 0.5), frame);
  Draws draw(seed);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const bool clear = x / 16 % 2 == 1 && y / 16 % 2 == 0;
        m.data.extinction.push_back(clear ? 0.0F : static_cast<float>(draw.between(0, 2)));
        m.data.albedo.push_back(static_cast<float>(draw()));
        m.data.emission.push_back(static_cast<float>(draw()));
      }
    }
  }
  return m;
}

/// Keeps at most one brick, in memory that the next call overwrites, like a small cache.
class ForgetfulBricks {
 public:
  explicit ForgetfulBricks(const MediaSet& set) : set_(&set) {}
  const Brick& brick(int medium, int index) {
    ++calls;
    held_ = std::make_unique<Brick>(set_->brick(medium, index));
    return *held_;
  }
  int calls = 0;

 private:
  const MediaSet* set_;
  std::unique_ptr<Brick> held_;
};

}  // namespace

TEST_CASE("bricks hold every cell once, and equal content has an equal name", "[optics][media]") {
  const Medium m = cloud(35, 17, 5, 31, {});
  const MediaSet set = compiled({m});
  REQUIRE(set.brick_count(0) == 3 * 2 * 1);
  double sum = 0;
  for (int b = 0; b < set.brick_count(0); ++b) {
    CHECK(set.brick(0, b).extinction.size() == 4096);
    for (const float e : set.brick(0, b).extinction) sum += static_cast<double>(e);
  }
  double expected = 0;
  for (const float e : m.data.extinction) expected += static_cast<double>(e);
  CHECK(sum == Approx(expected).epsilon(1e-12));
  const MediaSet again = compiled({m});
  Medium other = m;
  other.data.albedo[3] += 0.001F;
  const MediaSet changed = compiled({other});
  CHECK(again.brick(0, 0).content == set.brick(0, 0).content);
  CHECK(again.brick(0, 1).content != set.brick(0, 0).content);
  CHECK(changed.brick(0, 0).content != set.brick(0, 0).content);
  CHECK(changed.brick(0, 1).content == set.brick(0, 1).content);
}

TEST_CASE("rays along a grid's axes meet its cells one by one", "[optics][media]") {
  Medium m = grid(40, 1, 1, {40, 1, 1}, smoke(1));
  for (int x = 0; x < 40; ++x) m.data.extinction.push_back(static_cast<float>(x % 5));
  const MediaSet set = compiled({m});
  CHECK(depth(set, {-1, 0.5F, 0.5F}, {1, 0, 0}, 100) == Approx(80));
  CHECK(depth(set, {41, 0.5F, 0.5F}, {-1, 0, 0}, 100) == Approx(80));
  CHECK(depth(set, {3.5F, 0.5F, 0.5F}, {1, 0, 0}, 2) == Approx(1.5 + 4));
  CHECK(depth(set, {7.5F, 0.5F, -1}, {0, 0, 1}, 10) == Approx(2));
  // On a face, the upper cell counts. On the grid's last face the ray is outside.
  CHECK(depth(set, {7, 0.5F, -1}, {0, 0, 1}, 10) == Approx(2));
  CHECK(depth(set, {8, 0, -1}, {0, 0, 1}, 10) == Approx(3));
  CHECK(depth(set, {8.5F, 1, -1}, {0, 0, 1}, 10) == 0);
  CHECK(fly(set, {-1, 0.5F, 0.5F}, {1, 0, 0}, 100, 10 + 1 + 1).t == Approx(1 + 5 + 2 + 0.5));
  CHECK_FALSE(fly(set, {-1, 0.5F, 0.5F}, {1, 0, 0}, 100, 80.0001).collided);
}

TEST_CASE("a grid of one value equals a homogeneous box in any orientation", "[optics][media]") {
  const Frame frame = placed({1, 2, 3}, 0.9);
  Medium even = grid(33, 20, 18, {2, 3, 4}, smoke(7), frame);
  even.data.extinction.assign(33 * 20 * 18, 0.75F);
  const Medium constant = grid(3, 5, 7, {2, 3, 4}, smoke(0.75), frame);
  QuadricShape box;  // without a quadric: everything within the bounds
  box.bounds = {glm::dvec3(0), glm::dvec3(2, 3, 4)};
  const MediaSet a = compiled({even});
  const MediaSet b = compiled({constant});
  const MediaSet c = compiled({body(box, smoke(0.75), frame)});
  Draws draw(32);
  INFO("seed " << draw.seed());
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 o(draw.point({-3, -3, -3}, {6, 6, 8}));
    const glm::vec3 d(draw.direction());
    const double expected = depth(c, o, d, 9);
    REQUIRE(depth(a, o, d, 9) == Approx(expected).epsilon(1e-11).margin(1e-11));
    REQUIRE(depth(b, o, d, 9) == Approx(expected).epsilon(1e-11).margin(1e-11));
  }
}

TEST_CASE("a grid's extinction follows its medium's wavelength law", "[optics][media]") {
  Medium m = grid(1, 1, 1, {1, 1, 1}, {Extinction{99, 580, 2, std::nullopt}, flat(0.5), {}});
  m.data.extinction = {3.0F};
  const std::vector<MediumInput> inputs = {{&m, 2.0}};
  const auto set = MediaSet::compile(
      inputs, 81, [](const Spectrum& s, int b) { return s.value[static_cast<size_t>(b)]; },
      glm::dvec3(0));
  REQUIRE(set.ok());
  ResidentBricks bricks(set.value());
  CHECK(extinction_at(set.value(), 40, glm::vec3(0.5F), bricks) == Approx(6));
  CHECK(extinction_at(set.value(), 0, glm::vec3(0.5F), bricks) ==
        Approx(6 * std::pow(580 / 380.0, 2)));
  m.optics.extinction.table = flat(5);
  const auto by_table = MediaSet::compile(inputs, 1, first_sample, glm::dvec3(0));
  CHECK(extinction(by_table.value(), glm::vec3(0.5F)) == Approx(6));
}

TEST_CASE("bricks that are evicted and fetched again give the same bits", "[optics][media]") {
  Medium first = cloud(40, 35, 20, 33, placed({0, 0, 0}, 0.3));
  first.data.interpolate_emission = true;
  glow(first);
  const Medium second = cloud(50, 20, 33, 34, placed({1, 1, 0}, -0.5));
  const MediaSet set = compiled({first, second, everywhere(smoke(0.1))});
  ResidentBricks resident(set);
  ForgetfulBricks forgetful(set);
  Draws draw(35);
  INFO("seed " << draw.seed());
  for (int i = 0; i < 500; ++i) {
    const glm::vec3 o(draw.point({-2, -2, -2}, {6, 6, 5}));
    const glm::vec3 d(draw.direction());
    const double tau = -std::log1p(-draw());
    const double choice = draw();
    const FreeFlight a = free_flight<MediaNeed::general>(set, 0, o, d, 8, tau, choice, resident);
    const FreeFlight b = free_flight<MediaNeed::general>(set, 0, o, d, 8, tau, choice, forgetful);
    REQUIRE(a.t == b.t);
    REQUIRE(a.medium == b.medium);
    REQUIRE(a.albedo == b.albedo);
    REQUIRE(optical_depth<MediaNeed::general>(set, 0, o, d, 8, resident) ==
            optical_depth<MediaNeed::general>(set, 0, o, d, 8, forgetful));
    std::vector<double> seen[2];
    for_each_segment(set, 0, o, d, 8, resident, [&](const MediaSegment& s) {
      seen[0].insert(seen[0].end(), {s.length, s.sigma_t, s.sigma_s});
      for (const EmissionPart& e : s.emission) seen[0].push_back(e.density);
      return true;
    });
    for_each_segment(set, 0, o, d, 8, forgetful, [&](const MediaSegment& s) {
      seen[1].insert(seen[1].end(), {s.length, s.sigma_t, s.sigma_s});
      for (const EmissionPart& e : s.emission) seen[1].push_back(e.density);
      return true;
    });
    REQUIRE(seen[0] == seen[1]);
    Draws u(static_cast<uint64_t>(i));
    Draws v(static_cast<uint64_t>(i));
    REQUIRE(set.sample_emission_point(0, u, resident) ==
            set.sample_emission_point(0, v, forgetful));
  }
  CHECK(forgetful.calls > 0);
}

TEST_CASE("clear bricks are crossed without being fetched", "[optics][media]") {
  Medium m = grid(64, 16, 16, {64, 16, 16}, smoke(1));
  m.data.extinction.assign(64 * 16 * 16, 0.0F);
  for (int i = 0; i < 16 * 16; ++i) {
    m.data.extinction[static_cast<size_t>(i) * 64 + 50] = 2.0F;  // only in the last brick
  }
  const MediaSet set = compiled({m});
  ForgetfulBricks bricks(set);
  const glm::vec3 d = glm::normalize(glm::vec3(1, 0.1F, 0.05F));
  const FreeFlight f =
      free_flight<MediaNeed::general>(set, 0, {-1, 2, 3}, d, 100, 0.5, 0.5, bricks);
  CHECK(bricks.calls <= 2);  // one for the optical depth, one for the albedo
  CHECK(f.collided);
  CHECK(f.t == Approx(51 / static_cast<double>(d.x) + 0.25));
}

TEST_CASE("emission points follow the strength of cells, constant within a cell",
          "[optics][media]") {
  Medium m = grid(20, 18, 3, {20, 18, 3}, smoke(0));
  Draws value(36);
  double total = 0;
  for (int i = 0; i < 20 * 18 * 3; ++i) {
    m.data.emission.push_back(value() < 0.3 ? 0.0F : static_cast<float>(value()));
    total += static_cast<double>(m.data.emission.back());
  }
  glow(m);
  const MediaSet set = compiled({m});
  ResidentBricks bricks(set);
  Draws draw(37);
  const int n = 400000;
  std::vector<double> hits(m.data.emission.size(), 0);
  glm::dvec3 within(0);
  for (int i = 0; i < n; ++i) {
    const glm::vec3 p = set.sample_emission_point(0, draw, bricks);
    const int x = std::min(static_cast<int>(p.x), 19);
    const int y = std::min(static_cast<int>(p.y), 17);
    const int z = std::min(static_cast<int>(p.z), 2);
    hits[static_cast<size_t>((z * 18 + y) * 20 + x)] += 1;
    within += glm::dvec3(p) - glm::dvec3(x, y, z);
  }
  // Chi-square over cells with light: mean = variance / 2 = degrees of freedom.
  double chi = 0;
  int cells = 0;
  int dark_hits = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const double expected = n * static_cast<double>(m.data.emission[i]) / total;
    if (expected < 5) {
      if (expected == 0) dark_hits += static_cast<int>(hits[i]);
      continue;
    }
    chi += (hits[i] - expected) * (hits[i] - expected) / expected;
    ++cells;
  }
  // A coordinate may round up onto the next cell's face: some 1e-6 of all points.
  CHECK(dark_hits <= 5);
  CHECK(std::abs(chi - cells) < 4 * std::sqrt(2.0 * cells));
  for (int k = 0; k < 3; ++k) CHECK(std::abs(within[k] / n - 0.5) < 4 * std::sqrt(1 / 12.0 / n));
  CHECK(set.emission_density(0, {3.5F, 4.5F, 1.5F}, bricks) ==
        Approx(static_cast<double>(m.data.emission[(1 * 18 + 4) * 20 + 3]) / total));
}

TEST_CASE("interpolated emission is sampled with exactly the density it states",
          "[optics][media]") {
  Medium m = grid(3, 2, 1, {1.5, 1, 2}, smoke(0), placed({1, 0, 0}, 0.4));
  m.data.emission = {1, 0, 4, 2, 3, 0};
  m.data.interpolate_emission = true;
  glow(m);
  const MediaSet set = compiled({m});
  ResidentBricks bricks(set);
  // Bins of a quarter cell; expectation by midpoints of a fine grid (the density is bilinear in
  // each bin).
  const int bx = 12;
  const int by = 8;
  std::vector<double> expected(static_cast<size_t>(bx * by), 0);
  double whole = 0;
  for (int j = 0; j < by; ++j) {
    for (int i = 0; i < bx; ++i) {
      const glm::dvec3 local((i + 0.5) * 1.5 / bx, (j + 0.5) * 1.0 / by, 0.3);
      const double f =
          set.emission_density(0, glm::vec3(m.frame.origin + m.frame.axes * local), bricks);
      expected[static_cast<size_t>(j * bx + i)] = f * 3.0 / (bx * by);
      whole += f * 3.0 / (bx * by);
    }
  }
  CHECK(whole == Approx(1).epsilon(1e-6));
  Draws draw(38);
  const int n = 400000;
  std::vector<double> hits(expected.size(), 0);
  for (int i = 0; i < n; ++i) {
    const glm::dvec3 p(set.sample_emission_point(0, draw, bricks));
    const glm::dvec3 local = (p - m.frame.origin) * m.frame.axes;
    REQUIRE(local.z > -1e-5);
    REQUIRE(local.z < 2 + 1e-5);
    const int x = std::clamp(static_cast<int>(local.x / 1.5 * bx), 0, bx - 1);
    const int y = std::clamp(static_cast<int>(local.y * by), 0, by - 1);
    hits[static_cast<size_t>(y * bx + x)] += 1;
  }
  double chi = 0;
  double cells = -1;
  double dark_hits = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const double mean = n * expected[i];
    if (expected[i] < 1e-12) {  // the outer corners of cells without light
      dark_hits += hits[i];
      continue;
    }
    chi += (hits[i] - mean) * (hits[i] - mean) / mean;
    cells += 1;
  }
  CHECK(cells > 80);
  CHECK(dark_hits == 0);
  CHECK(std::abs(chi - cells) < 4 * std::sqrt(2 * cells));
}

TEST_CASE("segments carry the exact mean of a flame's emission", "[optics][media]") {
  for (const bool interpolate : {false, true}) {
    Medium m = cloud(20, 9, 7, 39, placed({0, 0, 0}, 0.8));
    m.data.interpolate_emission = interpolate;
    glow(m);
    Medium candle = body(cone(0.3, 1), smoke(0.2), placed({0.5, 0, 0.2}, 0));
    glow(candle);
    const MediaSet set = compiled({m, candle});
    ResidentBricks bricks(set);
    Draws draw(40);
    for (int i = 0; i < 30; ++i) {
      const glm::vec3 o(draw.point({-1, -1, -1}, {2, 2, 2}));
      const glm::vec3 d(draw.direction());
      double sums[2] = {};
      for_each_segment(set, 0, o, d, 4, bricks, [&](const MediaSegment& s) {
        for (const EmissionPart& e : s.emission) sums[e.medium] += e.density * s.length;
        return true;
      });
      double marched[2] = {};
      const int steps = 20000;
      for (int k = 0; k < steps; ++k) {
        const glm::vec3 p = o + d * (4.0F * (static_cast<float>(k) + 0.5F) / steps);
        for (int medium = 0; medium < 2; ++medium) {
          marched[medium] += set.emission_density(medium, p, bricks) * 4.0 / steps;
        }
      }
      // Ray marching errs by some steps at faces; densities are of order 1.
      CHECK(sums[0] == Approx(marched[0]).epsilon(2e-3).margin(2e-3));
      CHECK(sums[1] == Approx(marched[1]).epsilon(1e-2).margin(1e-2));
    }
  }
}

TEST_CASE("a flame without extinction glows although no kernel needs media", "[optics][media]") {
  Medium candle = body(cylinder(1, 2), smoke(0));
  glow(candle);
  const MediaSet set = compiled({candle});
  CHECK(set.need() == MediaNeed::none);
  ResidentBricks bricks(set);
  double sum = 0;
  for_each_segment(set, 0, {0, 0, -1}, {0, 0, 1}, 10, bricks, [&](const MediaSegment& s) {
    CHECK(s.sigma_t == 0);
    for (const EmissionPart& e : s.emission) sum += e.density * s.length;
    return true;
  });
  CHECK(sum == Approx(2 / (2 * pi)));
  Medium dark = grid(1, 1, 1, {1, 1, 1}, smoke(1));
  dark.data.emission = {0.0F};
  glow(dark);
  CHECK_FALSE(try_compile({dark}).ok());
}

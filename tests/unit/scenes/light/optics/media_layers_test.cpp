// Stacks of slabs: Beer-Lambert, boundaries, extreme numbers, choice among media, and errors.
#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

using namespace luxodus;
using namespace luxodus::media_test;

namespace {

const glm::vec3 upwards(0, 0, 1);
const glm::vec3 down(0, 0, -1);

Medium three_layers(double a, double b, double c) {
  return layers({{0, 1, smoke(a)}, {1, 2, smoke(b)}, {2, 3, smoke(c)}});
}

template <MediaNeed N>
double depth_with(const MediaSet& set, const glm::vec3& o, const glm::vec3& d, float t) {
  ResidentBricks bricks(set);
  return optical_depth<N>(set, 0, o, d, t, bricks);
}

}  // namespace

TEST_CASE("a scene's media determine which kernel it needs", "[optics][media]") {
  CHECK(compiled({}).need() == MediaNeed::none);
  CHECK(MediaSet().need() == MediaNeed::none);
  CHECK(compiled({everywhere(smoke(0))}).need() == MediaNeed::none);
  CHECK(compiled({everywhere(smoke(1))}).need() == MediaNeed::homogeneous);
  CHECK(compiled({everywhere(smoke(1)), everywhere(smoke(2))}).need() == MediaNeed::homogeneous);
  CHECK(compiled({three_layers(1, 2, 3)}).need() == MediaNeed::layered);
  CHECK(compiled({three_layers(0, 0, 0)}).need() == MediaNeed::none);
  Medium cut = everywhere(smoke(1));
  cut.footprint.z_high = 2;
  CHECK(compiled({cut}).need() == MediaNeed::layered);
  cut.footprint.polygon = {{0, 0}, {1, 0}, {0, 1}};
  CHECK(compiled({cut}).need() == MediaNeed::general);
  CHECK(compiled({body(ellipsoid({1, 1, 1}), smoke(1))}).need() == MediaNeed::general);
  CHECK(compiled({body(ellipsoid({1, 1, 1}), smoke(0))}).need() == MediaNeed::none);
  CHECK(compiled({grid(2, 2, 2, {1, 1, 1}, smoke(1))}).need() == MediaNeed::general);
}

TEST_CASE("a factor scales extinction, and 0 removes a medium", "[optics][media]") {
  const Medium a = everywhere(smoke(0.5));
  const Medium b = everywhere(smoke(2));
  const std::vector<MediumInput> inputs = {{&a, 3.0}, {&b, 0.0}};
  const auto set = MediaSet::compile(inputs, 1, first_sample, glm::dvec3(0));
  REQUIRE(set.ok());
  CHECK(set->count() == 2);
  CHECK(depth(set.value(), {0, 0, 0}, upwards, 2) == Approx(3.0).epsilon(1e-15));
  const std::vector<MediumInput> none = {{&a, 0.0}, {&b, 0.0}};
  CHECK(MediaSet::compile(none, 1, first_sample, glm::dvec3(0))->need() == MediaNeed::none);
}

TEST_CASE("extinction follows Angstrom's law from its own wavelength", "[optics][media]") {
  const Extinction e{2.0, 633, 1, std::nullopt};
  const Spectrum s = e.spectrum();
  for (int i = 0; i < spectrum_samples; ++i) {
    CHECK(s.value[static_cast<size_t>(i)] == Approx(2.0 * 633 / Spectrum::wavelength_nm(i)));
  }
  const Extinction table{2.0, 633, 1, flat(0.7)};
  CHECK(table.spectrum().value[40] == 0.7);
  // Each band has its own value: here band b is the spectrum's sample b.
  const Medium m = everywhere({e, flat(0), {}});
  const std::vector<MediumInput> inputs = {{&m, 1.0}};
  const auto set = MediaSet::compile(
      inputs, 81, [](const Spectrum& x, int b) { return x.value[static_cast<size_t>(b)]; },
      glm::dvec3(0));
  REQUIRE(set.ok());
  ResidentBricks bricks(set.value());
  for (int b = 0; b < 81; b += 20) {
    CHECK(optical_depth<MediaNeed::homogeneous>(set.value(), b, {0, 0, 0}, upwards, 1, bricks) ==
          Approx(2.0 * 633 / Spectrum::wavelength_nm(b)));
  }
}

TEST_CASE("layers obey Beer-Lambert: depth is the sum of extinction times slant thickness",
          "[optics][media]") {
  const MediaSet set = compiled({three_layers(0.5, 0, 4)});
  CHECK(depth(set, {0, 0, -1}, upwards, 10) == Approx(4.5).epsilon(1e-14));
  CHECK(depth(set, {0, 0, 9}, down, 20) == Approx(4.5).epsilon(1e-14));
  CHECK(depth(set, {0, 0, 0.5F}, upwards, 2) == Approx(0.25 + 4 * 0.5).epsilon(1e-14));
  const float c = 0.6F;
  const glm::vec3 slant(0.8F, 0, c);
  CHECK(depth(set, {0, 0, -1}, slant, 100) == Approx(4.5 / static_cast<double>(c)).epsilon(1e-14));
  CHECK(depth(set, {0, 0, -1}, upwards, infinite) == Approx(4.5).epsilon(1e-14));
  CHECK(depth(set, {0, 0, 5}, upwards, infinite) == 0);
}

TEST_CASE("free flight collides where the optical depth is reached, and skips empty layers",
          "[optics][media]") {
  const MediaSet set = compiled({three_layers(0.5, 0, 4)});
  CHECK(fly(set, {0, 0, 0}, upwards, 10, 0.25).t == Approx(0.5F));
  // The optical depth of the first layer is 0.5: any more is reached in the third, never in the
  // empty one.
  CHECK(fly(set, {0, 0, 0}, upwards, 10, 0.5).t == 2.0F);
  CHECK(fly(set, {0, 0, 0}, upwards, 10, 0.5 + 1e-12).t == Approx(2.0F));
  CHECK(fly(set, {0, 0, 0}, upwards, 10, 0.5 - 1e-12).t == Approx(1.0F));
  CHECK(fly(set, {0, 0, 3}, down, 10, 4.25).t == Approx(2.5F));
  const FreeFlight through = fly(set, {0, 0, 0}, upwards, 10, 4.5 + 1e-9);
  CHECK_FALSE(through.collided);
  CHECK(through.t == 10.0F);
  CHECK_FALSE(fly(set, {0, 0, 0}, upwards, 1.5F, 0.6).collided);
  // tau = 0 collides where the smoke begins.
  CHECK(fly(set, {0, 0, 1.25F}, upwards, 10, 0).t == Approx(0.75F));
  CHECK_FALSE(fly(set, {0, 0, 7}, upwards, infinite, 0).collided);
  CHECK_FALSE(fly(set, {0, 0, 1.5F}, {1, 0, 0}, infinite, 0).collided);
}

TEST_CASE("a ray along a boundary belongs to the layer above it, however little it rises",
          "[optics][media]") {
  const MediaSet set = compiled({three_layers(1, 10, 100)});
  CHECK(depth(set, {0, 0, 1}, {1, 0, 0}, 5) == 50.0);
  CHECK(depth(set, {0, 0, 2}, {1, 0, 0}, 5) == 500.0);
  CHECK(depth(set, {0, 0, 3}, {1, 0, 0}, 5) == 0.0);
  CHECK(depth(set, {0, 0, 0}, {1, 0, 0}, 5) == 5.0);
  for (const float rise : {1e-45F, 1e-30F, 1e-12F}) {
    INFO(rise);
    CHECK(depth(set, {0, 0, 1}, {1, 0, rise}, 5) == Approx(50.0).epsilon(1e-9));
    CHECK(depth(set, {0, 0, 1}, {1, 0, -rise}, 5) == Approx(5.0).epsilon(1e-9));
    CHECK(fly(set, {0, 0, 1}, {1, 0, rise}, 5, 20).t == 2.0F);
    CHECK(fly(set, {0, 0, 1}, {1, 0, -rise}, 5, 2).t == 2.0F);
  }
  // Half of the ray is just below the boundary at 0, half just above it: the boundary is passed by
  // distance.
  const MediaSet ground = compiled({layers({{-1, 0, smoke(1)}, {0, 1, smoke(3)}})});
  CHECK(depth(ground, {0, 0, -1e-30F}, {1, 0, 1e-30F}, 2) == Approx(4.0).epsilon(1e-6));
  CHECK(fly(ground, {0, 0, -1e-30F}, {1, 0, 1e-30F}, 2, 2.5).t == Approx(1.5F));
}

TEST_CASE("tall stacks, where slabs are skipped, equal the plain sum over slabs",
          "[optics][media]") {
  Draws draw(11);
  INFO("seed " << draw.seed());
  std::vector<Layer> many;
  std::vector<double> sigma;
  for (int i = 0; i < 200; ++i) {
    const double s = i % 7 == 3 ? 0 : draw.between(0, 3);
    sigma.push_back(s);
    many.push_back({i * 0.05, (i + 1) * 0.05, smoke(s)});
  }
  const MediaSet set = compiled({layers(many)});
  int collided = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 o(draw.point({-1, -1, -1}, {1, 1, 11}));
    const glm::vec3 d(draw.direction());
    const auto t_max = static_cast<float>(draw.between(0, 12));
    const auto z0 = static_cast<double>(o.z);
    const auto dz = static_cast<double>(d.z);
    double sum = 0;  // slab by slab, without any running sum
    for (int k = 0; k < 200; ++k) {
      const double a = (k * 0.05 - z0) / dz;
      const double b = ((k + 1) * 0.05 - z0) / dz;
      const double in = std::max(0.0, std::min(a, b));
      const double out = std::min(static_cast<double>(t_max), std::max(a, b));
      if (out > in) sum += sigma[static_cast<size_t>(k)] * (out - in);
    }
    REQUIRE(depth_with<MediaNeed::layered>(set, o, d, t_max) ==
            Approx(sum).epsilon(1e-10).margin(1e-12));
    const double tau = -std::log1p(-draw());
    const FreeFlight f = fly(set, o, d, t_max, tau);
    REQUIRE(f.collided == (tau < sum));
    if (!f.collided) continue;
    ++collided;
    REQUIRE(depth(set, o, d, f.t) == Approx(tau).margin(3 * 1e-6 * 12));
  }
  CHECK(collided > 5000);
}

TEST_CASE("free flight inverts optical depth from 1 mm to 10 km and tau from 1e-6 to 1e4",
          "[optics][media]") {
  Draws draw(12);
  INFO("seed " << draw.seed());
  for (const double scale : {1e-3, 1.0, 1e4}) {
    for (const double tau_scale : {1e-6, 1e-3, 1.0, 100.0, 1e4}) {
      const double s = tau_scale / scale;
      const MediaSet set = compiled({layers({{0, 0.2 * scale, smoke(s)},
                                             {0.2 * scale, 0.5 * scale, smoke(0)},
                                             {0.5 * scale, 0.6 * scale, smoke(3 * s)},
                                             {0.6 * scale, scale, smoke(2 * s)}})});
      for (int i = 0; i < 200; ++i) {
        const glm::vec3 o(draw.point({0, 0, -0.5 * scale}, {scale, scale, 1.5 * scale}));
        const glm::vec3 d(draw.direction());
        const auto t_max = static_cast<float>(2 * scale);
        const double all = depth(set, o, d, t_max);
        const double tau = draw() * all;
        if (!(tau > 0)) continue;
        const FreeFlight f = fly(set, o, d, t_max, tau);
        REQUIRE(f.collided);
        // One float rounding of t: 6e-8 t, times the largest extinction.
        REQUIRE(std::abs(depth(set, o, d, f.t) - tau) <=
                3 * s * 6e-8 * static_cast<double>(f.t) + 1e-12 * all);
        REQUIRE_FALSE(fly(set, o, d, t_max, all * (1 + 1e-9)).collided);
      }
    }
  }
}

TEST_CASE("coordinates of a million metres lose no precision after the move to the local origin",
          "[optics][media]") {
  const glm::dvec3 far(1e6, 2e6, 1e6);
  Medium m = layers({{1e6, 1e6 + 1, smoke(1)}, {1e6 + 1, 1e6 + 2, smoke(5)}});
  m.footprint.polygon = {{1e6, 2e6}, {1e6 + 4, 2e6}, {1e6 + 4, 2e6 + 4}, {1e6, 2e6 + 4}};
  Frame frame;
  frame.origin = far + glm::dvec3(10, 0, 0);
  const MediaSet set = compiled({m, body(ellipsoid({1, 1, 1}), smoke(2), frame)}, far);
  CHECK(depth(set, {1, 1, -1}, upwards, 10) == Approx(6.0).epsilon(1e-9));
  CHECK(depth(set, {-5, 1, 0.5F}, {1, 0, 0}, 10) == Approx(4.0).epsilon(1e-9));
  CHECK(depth(set, {10, 0, -5}, upwards, 10) == Approx(4.0).epsilon(1e-9));
}

TEST_CASE("overlapping media collide in proportion to their extinctions", "[optics][media]") {
  const MediaSet set = compiled({everywhere(smoke(1, 0.1, forward(0.5))), everywhere(smoke(2, 0.2)),
                                 layers({{0, 1, smoke(3, 0.3, forward(0.5))}}),
                                 body(ellipsoid({9, 9, 9}), smoke(4, 0.4)),
                                 grid(1, 1, 1, {1, 1, 1}, smoke(6, 0.6))});
  CHECK(set.phases().size() == 2);
  Draws draw(13);
  const int n = 40000;
  int hits[5] = {};
  const double albedo[5] = {0.1, 0.2, 0.3, 0.4, 0.6};
  for (int i = 0; i < n; ++i) {
    const double choice = draw();
    const FreeFlight f = fly(set, {0.5F, 0.5F, 0.5F}, upwards, 10, 1e-3, choice);
    REQUIRE(f.collided);
    REQUIRE(f.medium >= 0);
    ++hits[f.medium];
    REQUIRE(f.albedo == Approx(albedo[f.medium]).epsilon(1e-12));
    const bool is_forward = set.phase(f.phase).kind == PhaseKind::henyey_greenstein;
    REQUIRE(is_forward == (f.medium == 0 || f.medium == 2));
  }
  const double share[5] = {1 / 16.0, 2 / 16.0, 3 / 16.0, 4 / 16.0, 6 / 16.0};
  for (int k = 0; k < 5; ++k) {
    const double error = std::sqrt(share[k] * (1 - share[k]) / n);
    CHECK(std::abs(hits[k] / static_cast<double>(n) - share[k]) < 4 * error);
  }
}

TEST_CASE("the last medium is chosen at the very end of the unit interval", "[optics][media]") {
  const MediaSet set =
      compiled({everywhere(smoke(0.1)), everywhere(smoke(0.2)), everywhere(smoke(0.7))});
  const double last = 1 - 0x1p-53;
  CHECK(fly(set, {0, 0, 0}, upwards, 100, 1, 0).medium == 0);
  CHECK(fly(set, {0, 0, 0}, upwards, 100, 1, last).medium == 2);
}

TEST_CASE("the albedo of nearly conservative smoke keeps the precision of 1 - albedo",
          "[optics][media]") {
  const MediaSet set = compiled({everywhere(smoke(1, 1 - 1e-6))});
  CHECK(1 - fly(set, {0, 0, 0}, upwards, 100, 1).albedo == Approx(1e-6).epsilon(1e-9));
}

TEST_CASE("flights through smoke are exponential", "[optics][media]") {
  const MediaSet set = compiled({three_layers(1, 0, 2)});
  Draws draw(14);
  const int n = 100000;
  int passed = 0;
  for (int i = 0; i < n; ++i) {
    const double tau = -std::log1p(-draw());
    if (!fly(set, {0, 0, 0}, upwards, 2.5F, tau).collided) ++passed;
  }
  const double expected = std::exp(-2.0);
  const double error = std::sqrt(expected * (1 - expected) / n);
  CHECK(std::abs(passed / static_cast<double>(n) - expected) < 4 * error);
}

TEST_CASE("invalid media are refused by name and place", "[optics][media]") {
  const auto says = [](const Medium& m, const std::string& word) {
    const auto set = try_compile({m});
    if (set.ok()) return false;
    INFO(set.problem().text());
    return set.problem().text().find("test.toml:7: medium \"" + m.name + "\"") == 0 &&
           set.problem().what.find(word) != std::string::npos;
  };
  const double nan = std::nan("");
  CHECK(says(everywhere(smoke(nan)), "extinction"));
  CHECK(says(everywhere(smoke(-1)), "extinction"));
  CHECK(says(everywhere(smoke(1.0 / 0.0)), "extinction"));
  CHECK(says(everywhere(smoke(1, 1.5)), "albedo"));
  CHECK(says(everywhere(smoke(1, nan)), "albedo"));
  CHECK(says(layers({{1, 1, smoke(1)}}), "layer 1"));
  CHECK(says(layers({{0, 2, smoke(1)}, {1, 3, smoke(1)}}), "layer 2"));
  CHECK(says(layers({{nan, 2, smoke(1)}}), "layer 1"));
  Medium cut = everywhere(smoke(1));
  cut.footprint.polygon = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  CHECK(says(cut, "crosses itself"));
  cut.footprint.polygon = {{0, 0}, {1, 1}};
  CHECK(says(cut, "3 corners"));
  cut.footprint.polygon.assign(300, {0, 0});
  CHECK(says(cut, "at most"));
  Medium bare = make_medium("bare", MediumKind::bounded, smoke(1));
  CHECK(says(bare, "bounds"));
  Medium skewed = body(ellipsoid({1, 1, 1}), smoke(1));
  skewed.frame.axes[0].x = 2;
  CHECK(says(skewed, "axes"));
  Medium outside = body(ellipsoid({1, 1, 1}), smoke(1));
  outside.local_bounds = {glm::dvec3(5), glm::dvec3(6)};
  CHECK(says(outside, "fills"));
  Medium data = grid(2, 2, 2, {1, 1, 1}, smoke(1));
  data.data.extinction = {1, 2, 3};
  CHECK(says(data, "3 values"));
  data.data.extinction.assign(8, -1.0F);
  CHECK(says(data, "cell 0"));
  Medium flame = everywhere(smoke(1));
  glow(flame);
  CHECK(says(flame, "emit"));
}

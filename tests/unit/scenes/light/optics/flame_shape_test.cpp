// Flames at a moment: over time, what lines through them give and take is that of their mean.
#include "scenes/light/optics/flame_shape.hpp"

#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

using namespace luxodus;
using namespace luxodus::media_test;

namespace {

/// A line through a flame 1 m high on a base 0.5 m wide, its tip at the origin's top.
struct FlameLine {
  const char* name;
  glm::dvec3 from, to;
};

const std::array<FlameLine, 6> flame_lines{{{"low, through the axis", {-2, 0, 0.1}, {2, 0, 0.1}},
                                            {"half way up", {-2, 0.05, 0.5}, {2, 0.05, 0.5}},
                                            {"at the rim", {-2, 0.2, 0.15}, {2, 0.2, 0.15}},
                                            {"near the tip", {-2, 0, 0.9}, {2, 0, 0.9}},
                                            {"steeply down", {-0.3, 0.1, 1.5}, {0.2, 0, -0.2}},
                                            {"straight down", {0.05, 0.1, 2}, {0.05, 0.1, -1}}}};

QuadricBody cone_flame() {
  auto made = QuadricBody::make(body(cone(0.25, 1), smoke(1), {}), glm::dvec3(0));
  REQUIRE(made.ok());
  return std::move(made).value();
}

struct MomentMean {
  double value = 0, error = 0;
};

/// The mean of `value_of(k)`, and its standard error if all are independent.
template <class ValueOf>
MomentMean mean_over(int count, const ValueOf& value_of) {
  double sum = 0, squares = 0;
  for (int k = 0; k < count; ++k) {
    const double v = value_of(k);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1))};
}

/// The chord of a line; false if it misses.
bool chord_in(const QuadricBody& body, const FlameLine& line, glm::dvec3& d, RayInterval& chord) {
  d = glm::normalize(line.to - line.from);
  RayInterval parts[2];
  const int count = body.intervals(line.from, d, {0, glm::distance(line.from, line.to)}, parts);
  chord = parts[0];
  return count == 1;
}

}  // namespace

TEST_CASE("over seeds a flame's moments have the mean emission and transmittance of every line",
          "[optics][flames]") {
  const QuadricBody cone_body = cone_flame();
  for (const double extinction : {0.0, 1.5, 12.0})
    for (const FlameLine& line : flame_lines) {
      glm::dvec3 d;
      RayInterval chord;
      REQUIRE(chord_in(cone_body, line, d, chord));
      const double mean_through = std::exp(-extinction * (chord.t1 - chord.t0));
      const auto factor = [&](int k) {
        return FlameShape(cone_body, static_cast<uint32_t>(k) * 77U)
            .factor(line.from, d, chord, 1 - mean_through, 0.3);
      };
      INFO(line.name << ", extinction " << extinction);
      // Both are linear in the factor; it decides them alone.
      const MomentMean emitted = mean_over(40'000, factor);
      CHECK(std::abs(emitted.value - 1) < 4 * emitted.error + 1e-9);
      CHECK(emitted.error < 0.015);  // largest at the rim, where flame is rare
      const MomentMean through =
          mean_over(40'000, [&](int k) { return 1 - factor(k) * (1 - mean_through); });
      CHECK(std::abs(through.value - mean_through) < 4 * through.error + 1e-9);
      for (int k = 0; k < 1000; ++k) {
        CHECK(factor(k) >= 0);
        CHECK(factor(k) * (1 - mean_through) <= 1 + 1e-12);
      }
    }
}

TEST_CASE("over time a flame has its mean, too", "[optics][flames]") {
  const QuadricBody cone_body = cone_flame();
  const FlameShape shape(cone_body, 1);
  for (const FlameLine& line : flame_lines) {
    glm::dvec3 d;
    RayInterval chord;
    REQUIRE(chord_in(cone_body, line, d, chord));
    const double opacity = 1 - std::exp(-1.5 * (chord.t1 - chord.t0));
    INFO(line.name);
    // Moments half a second apart are all but independent: a puff takes 0.47 s. Means of blocks of
    // 20 s tell the error without that assumption.
    const MomentMean blocks = mean_over(400, [&](int block) {
      double sum = 0;
      for (int k = 0; k < 40; ++k)
        sum += shape.factor(line.from, d, chord, opacity, 20.0 * block + 0.5 * k);
      return sum / 40;
    });
    CHECK(std::abs(blocks.value - 1) < 4 * blocks.error);
    CHECK(blocks.error < 0.02);
  }
}

TEST_CASE("the field of a flame is standard normal at every place", "[optics][flames]") {
  const QuadricBody cone_body = cone_flame();
  for (const glm::dvec3 place :
       {glm::dvec3(0, 0, 0.01), glm::dvec3(0.07, -0.03, 0.4), glm::dvec3(0.01, 0.02, 0.95)}) {
    std::array<double, 4> moments{};
    constexpr int count = 40'000;
    for (int k = 0; k < count; ++k) {
      const double g = FlameShape(cone_body, static_cast<uint32_t>(k) * 31U).field(place, 1.7);
      double power = 1;
      for (double& moment : moments) moment += (power *= g) / count;
    }
    // Standard errors over n: 1, 2, 15 and 96 are the variances of g, g^2, g^3 and g^4.
    CHECK(std::abs(moments[0]) < 4 * std::sqrt(1.0 / count));
    CHECK(std::abs(moments[1] - 1) < 4 * std::sqrt(2.0 / count));
    CHECK(std::abs(moments[2]) < 4 * std::sqrt(15.0 / count));
    CHECK(std::abs(moments[3] - 3) < 4 * std::sqrt(96.0 / count));
  }
}

TEST_CASE("a flame moves without jumps, and as often as flames puff", "[optics][flames]") {
  const QuadricBody cone_body = cone_flame();
  const FlameShape shape(cone_body, 5);
  const glm::dvec3 place(0.03, 0.02, 0.5);
  const MomentMean step = mean_over(20'000, [&](int k) {
    return std::abs(shape.field(place, 1e-4 * (k + 1)) - shape.field(place, 1e-4 * k));
  });
  CHECK(step.value < 0.01);
  // A tenth of a puff apart it is much alike, two puffs apart it is not.
  const auto alike = [&](double apart_s) {
    return mean_over(20'000, [&](int k) {
      return shape.field(place, 0.37 * k) * shape.field(place, 0.37 * k + apart_s);
    });
  };
  CHECK(alike(0.01).value > 0.8);
  CHECK(std::abs(alike(1.1).value) < 0.05);
  // The same seed and time give the same shape.
  CHECK(FlameShape(cone_body, 5).field(place, 3.3) == shape.field(place, 3.3));
}

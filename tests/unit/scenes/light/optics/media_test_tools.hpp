// Shared by the tests of media: short makers of media, uniform numbers, and queries of a set. Each
// object belongs to one thread.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "scenes/light/optics/media_set.hpp"
#include "scenes/light/optics/quadric_shapes.hpp"

namespace luxodus::media_test {

using std::numbers::pi;
inline constexpr float infinite = std::numeric_limits<float>::infinity();

/// Uniform numbers with a seed that is printed on failure and may be set.
class Draws {
 public:
  explicit Draws(uint64_t fixed) : seed_(fixed) {
    if (const char* given = std::getenv("LUXODUS_SEED")) seed_ = std::strtoull(given, nullptr, 10);
    engine_.seed(seed_);
  }
  uint64_t seed() const { return seed_; }
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  int below(int n) { return static_cast<int>((*this)() * n); }
  glm::dvec3 point(const glm::dvec3& low, const glm::dvec3& high) {
    const double x = between(low.x, high.x);
    const double y = between(low.y, high.y);
    const double z = between(low.z, high.z);
    return {x, y, z};
  }
  glm::dvec3 direction() {
    const double z = between(-1, 1);
    const double a = between(0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }

 private:
  uint64_t seed_;
  std::mt19937_64 engine_;
};

inline Spectrum flat(double value) {
  Spectrum s;
  s.value.fill(value);
  return s;
}

inline SmokeOptics smoke(double sigma_t, double albedo = 0, Phase phase = {}) {
  return {Extinction{sigma_t, 633, 0, std::nullopt}, flat(albedo), std::move(phase)};
}

inline Phase forward(double g) {
  return {PhaseKind::henyey_greenstein, g, {}, {}};
}

inline Medium make_medium(const std::string& name, MediumKind kind, const SmokeOptics& optics) {
  return Medium{name,    {"test.toml", 7}, kind,     optics,    {},          Footprint{},
                Frame{}, Quadric{},        Bounds{}, DataSet{}, std::nullopt};
}

inline Medium everywhere(const SmokeOptics& optics) {
  return make_medium("everywhere", MediumKind::homogeneous, optics);
}

inline Medium layers(std::vector<Layer> list) {
  Medium m = make_medium("layers", MediumKind::layered, smoke(0));
  m.layers = std::move(list);
  return m;
}

inline Medium body(const QuadricShape& shape, const SmokeOptics& optics, const Frame& frame = {}) {
  Medium m = make_medium("body", MediumKind::bounded, optics);
  m.quadric = shape.quadric;
  m.local_bounds = shape.bounds;
  m.frame = frame;
  return m;
}

inline Medium grid(int nx, int ny, int nz, const glm::dvec3& extent, const SmokeOptics& optics,
                   const Frame& frame = {}) {
  Medium m = make_medium("grid", MediumKind::data_set, optics);
  m.data.nx = nx;
  m.data.ny = ny;
  m.data.nz = nz;
  m.data.extent = extent;
  m.frame = frame;
  return m;
}

inline void glow(Medium& m) {
  m.emission = MediumEmission{1, 1, flat(1.0 / 400), "", ""};
}

/// Axes rotated about an oblique line.
inline glm::dmat3 turned(double angle) {
  const glm::dvec3 k = glm::normalize(glm::dvec3(1, 2, 3));
  const auto turn = [&](const glm::dvec3& v) {
    return v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) +
           k * (glm::dot(k, v) * (1 - std::cos(angle)));
  };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

inline double first_sample(const Spectrum& s, int) {
  return s.value[0];
}

inline Result<MediaSet> try_compile(const std::vector<Medium>& media,
                                    const glm::dvec3& origin = glm::dvec3(0)) {
  std::vector<MediumInput> inputs;
  for (const Medium& m : media) inputs.push_back({&m, 1.0});
  return MediaSet::compile(inputs, 1, first_sample, origin);
}

inline MediaSet compiled(const std::vector<Medium>& media,
                         const glm::dvec3& origin = glm::dvec3(0)) {
  auto set = try_compile(media, origin);
  if (!set) FAIL(set.problem().text());
  return std::move(set).value();
}

inline double depth(const MediaSet& set, const glm::vec3& o, const glm::vec3& d, float t_max) {
  ResidentBricks bricks(set);
  return optical_depth<MediaNeed::general>(set, 0, o, d, t_max, bricks);
}

inline FreeFlight fly(const MediaSet& set, const glm::vec3& o, const glm::vec3& d, float t_max,
                      double tau, double choice = 0.5) {
  ResidentBricks bricks(set);
  return free_flight<MediaNeed::general>(set, 0, o, d, t_max, tau, choice, bricks);
}

inline double extinction(const MediaSet& set, const glm::vec3& p) {
  ResidentBricks bricks(set);
  return extinction_at(set, 0, p, bricks);
}

}  // namespace luxodus::media_test

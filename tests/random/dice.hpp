// Random draws for scenes, from ranges as wide as the program accepts. A scene follows from its
// number alone. Rule: never two draws in one expression, since their order would depend on the
// compiler. Thread rule: one thread.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "runtime/core/random.hpp"

namespace luxodus::test {

class Dice {
 public:
  /// `what` gives different sequences for the same number.
  Dice(uint64_t number, uint64_t what) : random_(what, RandomStream::test) {
    random_.start(number);
  }

  bool chance(double probability) { return random_.uniform_double() < probability; }
  /// 0 to count - 1.
  int below(int count) {
    return static_cast<int>((uint64_t{random_.bits()} * static_cast<uint64_t>(count)) >> 32);
  }
  /// Both ends included.
  int whole(int low, int high) { return low + below(high - low + 1); }
  double between(double low, double high) { return low + (high - low) * random_.uniform_double(); }
  /// Uniform in the logarithm. Requires: 0 < low <= high.
  double magnitude(double low, double high) {
    return std::min(high, low * std::exp(std::log(high / low) * random_.uniform_double()));
  }
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }
  template <class T>
  const T& any(const std::vector<T>& values) {
    return values[static_cast<size_t>(below(static_cast<int>(values.size())))];
  }

  /// A uniform point in the box.
  glm::dvec3 point(const glm::dvec3& low, const glm::dvec3& high) {
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = between(low[k], high[k]);
    return p;
  }
  /// A unit vector: along an axis, almost so, or in any direction.
  glm::dvec3 direction() {
    glm::dvec3 d(0);
    const int way = below(8);
    if (way < 4) d[below(3)] = chance(0.5) ? 1 : -1;
    if (way == 3) d += 1e-7 * point(glm::dvec3(-1), glm::dvec3(1));
    if (way < 4) return glm::normalize(d);
    const double z = between(-1, 1);
    const double turn = between(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
  }
  uint64_t bits64() { return random_.bits64(); }

 private:
  Random random_;
};

}  // namespace luxodus::test

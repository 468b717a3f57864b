#include "runtime/core/sobol.hpp"

#include <algorithm>
#include <bit>

#include "runtime/core/random.hpp"

namespace luxodus {

namespace {

constexpr uint32_t bits = 32;
constexpr uint32_t dimensions = SobolSet::dimensions;

/// A primitive polynomial over GF(2), its inner coefficients as bits, and the first odd numbers m.
struct Recurrence {
  uint32_t degree, coefficients;
  uint32_t m[6];
};
constexpr Recurrence recurrences[dimensions - 1] = {
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
};

/// By bit of the index, then dimension; the first binary digit is the highest bit.
using DirectionNumbers = std::array<SobolSet::Point, bits>;

constexpr DirectionNumbers make_direction_numbers() {
  DirectionNumbers v{};
  for (uint32_t i = 0; i < bits; ++i) v[i][0] = 1u << (bits - 1 - i);
  for (uint32_t d = 1; d < dimensions; ++d) {
    const Recurrence& r = recurrences[d - 1];
    for (uint32_t i = 0; i < bits; ++i) {
      if (i < r.degree) {
        v[i][d] = r.m[i] << (bits - 1 - i);
        continue;
      }
      v[i][d] = v[i - r.degree][d] ^ (v[i - r.degree][d] >> r.degree);
      for (uint32_t k = 1; k < r.degree; ++k) {
        if ((r.coefficients >> (r.degree - 1 - k) & 1) != 0) v[i][d] ^= v[i - k][d];
      }
    }
  }
  return v;
}

constexpr DirectionNumbers direction_numbers = make_direction_numbers();

/// Column j of a random lower triangular matrix with ones on the diagonal: digit j maps to digit j
/// and to random digits after it.
constexpr uint32_t lower_column(uint32_t j, uint32_t random) {
  const uint32_t diagonal = 1u << (bits - 1 - j);
  return diagonal | (random & (diagonal - 1));
}

}  // namespace

void SobolSet::choose(uint64_t number, uint32_t count) {
  const auto columns = static_cast<uint32_t>(std::bit_width(count > 1 ? count - 1 : 1));
  if (number == number_ && columns == columns_) return;
  number_ = number;
  columns_ = columns;
  Random random(seed_, RandomStream::scramble, static_cast<uint32_t>(stream_));
  random.start(number);
  for (uint32_t& word : shift_) word = random.bits();
  // A direction number has no digit after its own place, so the first columns are enough.
  std::array<Point, bits> matrix;  // by column, all dimensions contiguous: vectorises
  for (uint32_t d = 0; d < dimensions; ++d)
    for (uint32_t j = 0; j < columns; ++j) matrix[j][d] = lower_column(j, random.bits());
  for (uint32_t i = 0; i < columns; ++i) {
    scrambled_[i] = {};
    for (uint32_t j = 0; j <= i; ++j) {
      for (uint32_t d = 0; d < dimensions; ++d) {
        const uint32_t digit = direction_numbers[i][d] >> (bits - 1 - j) & 1;
        scrambled_[i][d] ^= matrix[j][d] & (0u - digit);
      }
    }
  }
}

}  // namespace luxodus

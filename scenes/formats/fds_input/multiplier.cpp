#include "scenes/formats/fds_input/multiplier.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace luxodus::fds_input {

namespace {

constexpr int no_first = -999, no_last = 999;  // defaults of FDS for what is not skipped

/// Reads "N_LOWER" and "N_UPPER"; both are 0 after a failure, for values out of range.
void range_of(GroupKeys& keys, const std::string& letter, int64_t most, int& first, int& last) {
  first = keys.integer(letter + "_LOWER", 0);
  last = keys.integer(letter + "_UPPER", 0);
  const int64_t count = int64_t{last} - first + 1;
  if (count >= 0 && count <= most && std::abs(int64_t{first}) <= most) return;
  keys.fail(letter + "_UPPER", fmt::format("&MULT makes {} copies along {}: at most {} are made",
                                           count, letter, most));
  first = last = 0;
}

void skip_of(GroupKeys& keys, const std::string& letter, int axis, Multiplier& out, bool& any) {
  const int low = keys.integer(letter + "_LOWER_SKIP", no_first);
  const int high = keys.integer(letter + "_UPPER_SKIP", no_last);
  any = any || low >= out.first[axis] || high <= out.last[axis];
  out.skip_first[axis] = std::max(low, out.first[axis]);
  out.skip_last[axis] = std::min(high, out.last[axis]);
}

}  // namespace

int64_t Multiplier::count() const {
  const glm::i64vec3 n = glm::i64vec3(last) - glm::i64vec3(first) + int64_t{1};
  return n.x * n.y * n.z;
}

Box Multiplier::copy(const Box& box, const glm::ivec3& number) const {
  const glm::dvec3 n = sequential ? glm::dvec3(number.x) : glm::dvec3(number);
  return {box.low + shift + n * step_low, box.high + shift + n * step_high};
}

bool Multiplier::skips(const glm::ivec3& number) const {
  return glm::all(glm::greaterThanEqual(number, skip_first)) &&
         glm::all(glm::lessThanEqual(number, skip_last));
}

Multiplier multiplier_of(GroupKeys& keys, int64_t most) {
  Multiplier out;
  out.id = keys.text("ID");
  const std::vector<double> dxb = keys.array("DXB", std::vector<double>(6, 0.0));
  const char* const letters[] = {"I", "J", "K"};
  const char* const steps[] = {"DX", "DY", "DZ"};
  const char* const shifts[] = {"DX0", "DY0", "DZ0"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const double step = keys.number(steps[i], 0);
    out.step_low[axis] = step != 0 ? step : dxb[2 * i];
    out.step_high[axis] = step != 0 ? step : dxb[2 * i + 1];
    out.shift[axis] = keys.number(shifts[i], 0);
    range_of(keys, letters[i], most, out.first[axis], out.last[axis]);
  }
  int first = 0, last = 0;
  range_of(keys, "N", most, first, last);
  out.sequential = first != 0 || last != 0;
  if (out.sequential) {
    out.first = glm::ivec3(first, 0, 0);
    out.last = glm::ivec3(last, 0, 0);
  }
  // Each axis is within `most`, so that the product of two does not overflow.
  const glm::i64vec3 n = glm::i64vec3(out.last) - glm::i64vec3(out.first) + int64_t{1};
  if (n.x * n.y > most || n.x * n.y * n.z > most) {
    keys.fail("ID", fmt::format("&MULT makes more than {} copies", most));
    out.first = out.last = glm::ivec3(0);
  }
  bool any = false;
  if (out.sequential) {
    skip_of(keys, "N", 0, out, any);
    out.skip_first.y = out.skip_first.z = out.skip_last.y = out.skip_last.z = 0;
  } else {
    for (int axis = 0; axis < 3; ++axis)
      skip_of(keys, letters[static_cast<size_t>(axis)], axis, out, any);
  }
  if (!any) {
    out.skip_first = glm::ivec3(1);
    out.skip_last = glm::ivec3(0);
  }
  return out;
}

}  // namespace luxodus::fds_input

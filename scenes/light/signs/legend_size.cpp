// Exact Euclidean distance transforms by lower envelopes of parabolas, in rows and then in columns
// (Felzenszwalb and Huttenlocher 2012), so that the time is linear in the texels. A point is as
// wide as asked if it lies within half of that width of a centre that is so far from the next other
// texel: a morphological opening.
#include "scenes/light/signs/legend_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace luxodus {

namespace {

constexpr double unreached = 1e18;  // a squared distance that no face has

/// All that a texel may be: a colour of the sign, or none of them.
constexpr std::array<ColourIndex, limits::max_face_colours + 1> classes = [] {
  std::array<ColourIndex, limits::max_face_colours + 1> out{};
  for (size_t i = 0; i < limits::max_face_colours; ++i) out[i] = static_cast<ColourIndex>(i);
  out.back() = other_colour;
  return out;
}();

/// Squared distances along a line: out[i] = min over j of (step (i - j))^2 + at[j].
class LineDistance {
 public:
  explicit LineDistance(size_t longest) : at_(longest), apex_(longest), from_(longest + 1) {}

  /// The line is values[first], values[first + stride], ...
  void transform(std::vector<double>& values, size_t first, size_t stride, size_t count,
                 double step) {
    for (size_t i = 0; i < count; ++i) at_[i] = values[first + i * stride];
    size_t last = 0;
    apex_[0] = 0;
    from_[0] = -std::numeric_limits<double>::infinity();
    from_[1] = std::numeric_limits<double>::infinity();
    const double square = step * step;
    const auto meets = [&](size_t a, size_t b) {
      const auto x = static_cast<double>(a), y = static_cast<double>(b);
      return ((at_[b] + square * y * y) - (at_[a] + square * x * x)) / (2 * square * (y - x));
    };
    for (size_t i = 1; i < count; ++i) {
      double where = meets(apex_[last], i);
      while (where <= from_[last]) where = meets(apex_[--last], i);
      apex_[++last] = i;
      from_[last] = where;
      from_[last + 1] = std::numeric_limits<double>::infinity();
    }
    size_t k = 0;
    for (size_t i = 0; i < count; ++i) {
      while (from_[k + 1] < static_cast<double>(i)) ++k;
      const double apart = step * (static_cast<double>(i) - static_cast<double>(apex_[k]));
      values[first + i * stride] = apart * apart + at_[apex_[k]];
    }
  }

 private:
  std::vector<double> at_;
  std::vector<size_t> apex_;
  std::vector<double> from_;
};

struct Grid {
  size_t across, down;
  double across_m, down_m;  // of a texel

  size_t texels() const { return across * down; }
};

/// Squared distance from each texel to the nearest one that `wanted` names [m2].
template <class Wanted>
std::vector<double> distances(const Grid& grid, const Wanted& wanted) {
  std::vector<double> out(grid.texels());
  for (size_t i = 0; i < out.size(); ++i) out[i] = wanted(i) ? 0 : unreached;
  LineDistance line(std::max(grid.across, grid.down));
  for (size_t y = 0; y < grid.down; ++y)
    line.transform(out, y * grid.across, 1, grid.across, grid.across_m);
  for (size_t x = 0; x < grid.across; ++x)
    line.transform(out, x, grid.across, grid.down, grid.down_m);
  return out;
}

/// Distance from a texel to the nearest place beyond the face [m].
double to_edge(const Grid& grid, size_t i) {
  const size_t x = i % grid.across, y = i / grid.across;
  return std::min(static_cast<double>(std::min(x + 1, grid.across - x)) * grid.across_m,
                  static_cast<double>(std::min(y + 1, grid.down - y)) * grid.down_m);
}

/// Texels on the edge of a face.
std::vector<size_t> edge_of(const Grid& grid) {
  std::vector<size_t> out;
  for (size_t x = 0; x < grid.across; ++x)
    for (const size_t y : {size_t{0}, grid.down - 1}) out.push_back(y * grid.across + x);
  for (size_t y = 0; y < grid.down; ++y)
    for (const size_t x : {size_t{0}, grid.across - 1}) out.push_back(y * grid.across + x);
  return out;
}

/// For each texel, whether it belongs to the ground: the colour of most of the edge, as far as it
/// is connected with the edge.
std::vector<char> ground_of(const SignFace& face, const Grid& grid) {
  const std::vector<size_t> edge = edge_of(grid);
  std::array<size_t, classes.size()> counts{};
  for (const size_t i : edge) ++counts[std::min<size_t>(face.colour[i], classes.size() - 1)];
  const ColourIndex ground =
      classes[static_cast<size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin())];
  std::vector<char> out(grid.texels(), 0);
  std::vector<size_t> open;
  const auto reach = [&](size_t i) {
    if (out[i] != 0 || face.colour[i] != ground) return;
    out[i] = 1;
    open.push_back(i);
  };
  for (const size_t i : edge) reach(i);
  while (!open.empty()) {
    const size_t i = open.back(), x = i % grid.across, y = i / grid.across;
    open.pop_back();
    if (x > 0) reach(i - 1);
    if (x + 1 < grid.across) reach(i + 1);
    if (y > 0) reach(i - grid.across);
    if (y + 1 < grid.down) reach(i + grid.across);
  }
  return out;
}

}  // namespace

std::optional<LegendSize> legend_size(const Sign& sign, double width_m) {
  const SignFace& face = sign.face;
  const Grid grid{static_cast<size_t>(face.width), static_cast<size_t>(face.height),
                  sign.width_m / face.width, sign.height_m / face.height};
  const std::vector<char> ground = ground_of(face, grid);
  const double texel_m = std::max(grid.across_m, grid.down_m);
  // A circle ends half a texel before the middle of the next one; a part of an even number of
  // texels has its middle between two, half a texel from either.
  const double enough_m = width_m / 2 - texel_m / 2;
  double widest_m = 0;
  size_t parts = 0, finer = 0;
  // A part has one colour.
  for (const ColourIndex colour : classes) {
    const auto of_part = [&](size_t i) { return ground[i] == 0 && face.colour[i] == colour; };
    if (std::find(face.colour.begin(), face.colour.end(), colour) == face.colour.end()) continue;
    auto radius = distances(grid, [&](size_t i) { return !of_part(i); });
    for (size_t i = 0; i < radius.size(); ++i) {
      radius[i] = of_part(i) ? std::min(std::sqrt(radius[i]), to_edge(grid, i)) : 0;
      widest_m = std::max(widest_m, 2 * radius[i]);
    }
    const auto to_centre =
        distances(grid, [&](size_t i) { return radius[i] > 0 && radius[i] >= enough_m; });
    for (size_t i = 0; i < radius.size(); ++i) {
      if (!(radius[i] > 0)) continue;
      ++parts;
      finer += std::sqrt(to_centre[i]) > width_m / 2 + texel_m / 2 ? 1 : 0;
    }
  }
  if (parts == 0) return std::nullopt;
  return LegendSize{widest_m, static_cast<double>(finer) / static_cast<double>(parts)};
}

}  // namespace luxodus

// Each square gives up to two segments between two of its edges. An inner edge belongs to two
// squares, so segments form chains over edges; a chain is followed from a free end, or from
// anywhere if it is closed.
#include "actors/results/formats/contour_lines.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace luxodus {
namespace {

// Edges are numbered: even ones run along x from point (i, j), odd ones along y.
using Edge = uint64_t;
constexpr Edge no_edge = ~Edge{0};

struct Links {
  Edge first = no_edge;
  Edge second = no_edge;
  bool walked = false;
};

class Contour {
 public:
  Contour(std::span<const double> x, std::span<const double> y, std::span<const double> values,
          double level)
      : x_(x), y_(y), values_(values), level_(level) {}

  std::vector<ContourLine> lines() {
    for (size_t j = 0; j + 1 < y_.size(); ++j) {
      for (size_t i = 0; i + 1 < x_.size(); ++i) add_square(i, j);
    }
    std::vector<ContourLine> out;
    for (auto& [edge, links] : links_) {
      if (!links.walked && links.second == no_edge) out.push_back(walk(edge));
    }
    for (auto& [edge, links] : links_) {
      if (!links.walked) out.push_back(walk(edge));
    }
    return out;
  }

 private:
  double value(size_t i, size_t j) const { return values_[j * x_.size() + i]; }
  Edge along_x(size_t i, size_t j) const { return 2 * (j * x_.size() + i); }
  Edge along_y(size_t i, size_t j) const { return 2 * (j * x_.size() + i) + 1; }

  void link(Edge a, Edge b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      Links& links = links_[from];
      (links.first == no_edge ? links.first : links.second) = to;
    }
  }

  void add_square(size_t i, size_t j) {
    const std::array<double, 4> corner = {value(i, j), value(i + 1, j), value(i + 1, j + 1),
                                          value(i, j + 1)};
    double mean = 0;
    for (const double c : corner) {
      if (!std::isfinite(c)) return;
      mean += c / 4;
    }
    // The edges counter-clockwise from the bottom; edge k joins corners k and k + 1.
    const std::array<Edge, 4> edge = {along_x(i, j), along_y(i + 1, j), along_x(i, j + 1),
                                      along_y(i, j)};
    std::array<size_t, 4> crossed{};
    size_t count = 0;
    for (size_t k = 0; k < 4; ++k) {
      if ((corner[k] >= level_) != (corner[(k + 1) % 4] >= level_)) crossed[count++] = k;
    }
    if (count == 2) link(edge[crossed[0]], edge[crossed[1]]);
    if (count == 4) {
      // Corner 0 is cut off when it differs from the middle, else corners 1 and 3 are.
      const bool cut_first = (corner[0] >= level_) != (mean >= level_);
      link(edge[0], edge[cut_first ? 3 : 1]);
      link(edge[2], edge[cut_first ? 1 : 3]);
    }
  }

  glm::dvec2 crossing(Edge edge) const {
    const size_t point = static_cast<size_t>(edge / 2);
    const size_t i = point % x_.size();
    const size_t j = point / x_.size();
    const bool vertical = edge % 2 == 1;
    const size_t i2 = vertical ? i : i + 1;
    const size_t j2 = vertical ? j + 1 : j;
    const double t = (level_ - value(i, j)) / (value(i2, j2) - value(i, j));
    return {x_[i] + t * (x_[i2] - x_[i]), y_[j] + t * (y_[j2] - y_[j])};
  }

  ContourLine walk(Edge start) {
    ContourLine line;
    Edge at = start;
    Edge before = no_edge;
    while (at != no_edge) {
      Links& links = links_.at(at);
      if (links.walked) break;
      links.walked = true;
      line.points.push_back(crossing(at));
      const Edge next = links.first != before ? links.first : links.second;
      before = at;
      at = next;
    }
    line.closed = at == start;
    if (line.closed) line.points.push_back(line.points.front());
    return line;
  }

  std::span<const double> x_;
  std::span<const double> y_;
  std::span<const double> values_;
  double level_;
  std::map<Edge, Links> links_;
};

}  // namespace

std::vector<ContourLine> contour_lines(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> values, double level) {
  return Contour(x, y, values, level).lines();
}

}  // namespace luxodus
